using System;
using System.Reflection;
using System.Text.RegularExpressions;

namespace Guidewire.Unity.Tests
{
    /// <summary>What is public in the package's Unity assembly is public on purpose: docs/unity.md lists it.</summary>
    public sealed class SurfaceTests
    {
        private const BindingFlags Own = BindingFlags.Public | BindingFlags.Instance | BindingFlags.Static
            | BindingFlags.DeclaredOnly;

        private static SortedSet<string> Public()
        {
            var names = new SortedSet<string>(StringComparer.Ordinal);
            foreach (Type type in typeof(SimulationLoop).Assembly.GetExportedTypes())
            {
                names.Add(type.Name);
                foreach (MemberInfo member in type.GetMembers(Own))
                {
                    bool isPart = member is ConstructorInfo || (member is MethodInfo method && method.IsSpecialName)
                        || member.Name == "value__";
                    if (!isPart)
                    {
                        names.Add(type.Name + "." + member.Name);
                    }
                }
            }
            return names;
        }

        private static SortedSet<string> Listed()
        {
            string page = File.ReadAllText(Path.Combine(Stage.Root, "docs", "unity.md"));
            string section = page.Substring(page.IndexOf("### What is public", StringComparison.Ordinal));
            section = section.Substring(0, section.IndexOf("\n## ", StringComparison.Ordinal));
            var names = new SortedSet<string>(StringComparer.Ordinal);
            foreach (Match row in Regex.Matches(section, @"^\| `(\w+)` \| (.*) \| .* \|$", RegexOptions.Multiline))
            {
                names.Add(row.Groups[1].Value);
                foreach (Match member in Regex.Matches(row.Groups[2].Value, @"`(\w+)`"))
                {
                    names.Add(row.Groups[1].Value + "." + member.Groups[1].Value);
                }
            }
            return names;
        }

        [Test]
        public void EveryPublicMember_IsListed_AndNothingElse() => Assert.That(Listed(), Is.EqualTo(Public()));

        [Test]
        public void NoPublicMember_NamesATypeOfAnotherLibrary(
            [Values(typeof(SimulationLoop), typeof(Io.SimulationSession), typeof(Simulation))] Type one)
        {
            foreach (Type type in one.Assembly.GetExportedTypes())
            {
                foreach (MemberInfo member in type.GetMembers(Own))
                {
                    Assert.That(member.ToString(), Does.Not.Contain("Newtonsoft"), type.Name + "." + member.Name);
                }
            }
        }
    }
}
