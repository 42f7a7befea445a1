using System;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using Newtonsoft.Json.Linq;

namespace Guidewire.Unity.Tests
{
    /// <summary>What Unity compiles against: .NET Standard 2.1 in players, in assemblies of the editor's alone .NET
    /// Framework, of which the reference assemblies of 4.7.2 are the nearest, and its own NUnit.</summary>
    public sealed class LibraryRuleTests
    {
        /// <summary>What Unity's profile has and .NET Framework has not.</summary>
        private static readonly string[] OnlyUnitys = { "System.Math.Clamp(", "System.Array.Fill(" };

        /// <summary>What the compiler writes by itself, in another way where a library lacks it: sums of texts and
        /// numbers, and an array where a method of Core takes a span, which Unity's profile has.</summary>
        private static readonly Regex OfTheCompiler = new Regex(
            @"^System\.Runtime\.CompilerServices\.(\w*Attribute|SwitchExpressionException"
            + @"|DefaultInterpolatedStringHandler|RuntimeHelpers\.CreateSpan)\b"
            + @"|^System\.String\.(Concat\(System\.ReadOnlySpan|op_Implicit)|^System\.Numerics\.Complex\.op_"
            + @"|^System\.(ReadOnly)?Span`1($|\.op_Implicit|\.get_Item)");

        /// <summary>What NUnit 3.6 added to 3.5, by the difference of the two libraries.</summary>
        private static readonly string[] NewerThanUnitys =
        {
            "Assert.Multiple", "Assert.Warn", "Warn.If", "Warn.Unless", "TestContext.get_Progress",
        };

        /// <summary>Packages whose sources are not among those that Unity publishes with the editor.</summary>
        private static readonly Regex OfPackages = new Regex(@"^UnityEngine\.(InputSystem|TestTools)\.");

        private static readonly Lazy<HashSet<string>> Standard =
            new Lazy<HashSet<string>>(() => LibraryRules.Members(Given("Standard")));

        private static readonly Lazy<HashSet<string>> Framework = new Lazy<HashSet<string>>(() => LibraryRules.Members(
            new[] { "mscorlib", "System", "System.Core", "System.Numerics" }
                .Select(name => Path.Combine(Given("Framework"), name + ".dll")).ToArray()));

        private static readonly Lazy<HashSet<string>> NUnit = new Lazy<HashSet<string>>(() => LibraryRules.Members(
            Given("NUnit")).Select(WithoutTypes).ToHashSet());

        private static string Given(string key)
        {
            return typeof(LibraryRuleTests).Assembly.GetCustomAttributes<AssemblyMetadataAttribute>()
                .First(one => one.Key == key).Value!;
        }

        private static string WithoutTypes(string member)
        {
            string name = member.Split('(')[0];
            return name.Substring(name.LastIndexOf('.') + 1);
        }

        private static string Built(string assembly) =>
            Path.Combine(TestContext.CurrentContext.TestDirectory, assembly + ".dll");

        /// <summary>The tests of Core as they were built: they are in Tests.slnf.</summary>
        private static string CoreTests => Built("Guidewire.Core.Tests").Replace(
            "Guidewire.Unity.Tests" + Path.DirectorySeparatorChar, "Guidewire.Core.Tests" + Path.DirectorySeparatorChar,
            StringComparison.Ordinal);

        private static IEnumerable<string> Missing(string file, HashSet<string> library)
        {
            return LibraryRules.Used(file, "System").Where(one => !library.Contains(one)
                && !OfTheCompiler.IsMatch(one)
                && !OnlyUnitys.Any(start => one.StartsWith(start, StringComparison.Ordinal)));
        }

        private static IEnumerable<string> NewerNUnit(string file)
        {
            return LibraryRules.Used(file, "nunit").Where(one => !NUnit.Value.Contains(WithoutTypes(one))
                || NewerThanUnitys.Any(end => one.Contains("." + end, StringComparison.Ordinal)));
        }

        [Test]
        public void APlayer_NeedsNoMoreThanItsLibraries()
        {
            Assert.That(Missing(Built("Guidewire.Runtime"), Standard.Value), Is.Empty);
            Assert.That(LibraryRules.Used(Built("Guidewire.Runtime"), "UnityStubs").Where(
                one => one.StartsWith("UnityEditor.", StringComparison.Ordinal)), Is.Empty);
        }

        [Test]
        public void TheEditorsAssemblies_NeedNoMoreThanTheirs()
        {
            Assert.That(Missing(Built("Guidewire.Editor"), Framework.Value), Is.Empty);
            Assert.That(Missing(CoreTests, Framework.Value), Is.Empty);
            Assert.That(NewerNUnit(CoreTests), Is.Empty);
        }

        [Test]
        public void WhatTheyLack_IsNamed()
        {
            string own = Built("Guidewire.Unity.Tests");
            Assert.That(Missing(own, Framework.Value), Is.SupersetOf(new[]
            {
                "System.Double.IsFinite(Double)", "System.MemoryExtensions.AsSpan(String)", "System.Range",
                "System.String.Contains(Char)",
            }));
            Assert.That(Missing(own, Standard.Value), Has.Member("System.Random.get_Shared()")
                .And.No.Member("System.Double.IsFinite(Double)"));
            Assert.That(NewerNUnit(own), Has.Some.StartsWith("NUnit.Framework.Assert.Multiple("));
            Assert.That(LibraryRules.Used(own, "UnityStubs"), Has.Some.StartsWith("UnityEditor."));
        }

        // Each is used once, so that the test above can look for it.
        internal static int Odd(string text, int[] numbers)
        {
            Assert.Multiple(() => Assert.That(text.Contains('a'), Is.True));
            return MemoryExtensions.AsSpan(text).Length + numbers[1..].Length + Random.Shared.Next()
                + (double.IsFinite(numbers[0]) ? 1 : 0);
        }

        // The table is made by tools/unitycheck/published.py from the list that this test writes.
        [Test]
        public void MembersOfUnity_AreInEveryPublishedVersion_AndNotObsolete()
        {
            string[] used = new[] { "Guidewire.Runtime", "Guidewire.Editor" }
                .SelectMany(name => LibraryRules.Used(Built(name), "UnityStubs"))
                .Concat(LibraryRules.Used(Built("Guidewire.Unity.Tests"), "UnityStubs").Where(
                    one => one.Contains("CreateAssetWith", StringComparison.Ordinal)))    // as of a newer editor
                .Where(one => !OfPackages.IsMatch(one)).Distinct()
                .OrderBy(one => one, StringComparer.Ordinal).ToArray();
            File.WriteAllLines(Path.Combine(TestContext.CurrentContext.WorkDirectory, "unity-members.txt"), used);
            string[] table = File.ReadAllLines(Path.Combine(Stage.Root,
                "headless/Guidewire.Unity.Tests/published-members.txt"));
            Assert.That(table[0], Does.EndWith("2022.3.76f1 6000.0.58f2 6000.3.19f1 6000.7.0a1"));
            Assert.That(used, Is.SubsetOf(table.Select(line => line.Split(' ')[0])), "not looked up yet");
            Assert.That(table.Skip(1).Where(line => line.Contains(' ')).Where(line => used.Contains(line.Split(' ')[0]))
                .Select(line => Regex.Replace(line, @"^UnityEditor\.ProjectWindowUtil\.(\w+)\(.*?\)", "$1")),
                Is.EqualTo(new[]
                {
                    "CreateAssetWithContent 2022.3.76f1 6000.0.58f2 6000.3.19f1",
                    "CreateAssetWithTextContent 6000.7.0a1",
                }), "both behind an #if, at 6000.4");
        }

        [TestCase("Core")]
        [TestCase("Io")]
        [TestCase("Runtime")]
        [TestCase("Editor")]
        public void ADefinition_NamesWhatItsAssemblyUses(string name)
        {
            string file = Path.Combine(Stage.Root, "Assets/Guidewire", name, "Guidewire." + name + ".asmdef");
            IEnumerable<string> named = JObject.Parse(File.ReadAllText(file))["references"]!.Values<string>()!;
            Assert.That(Assembly.LoadFrom(Built("Guidewire." + name)).GetReferencedAssemblies().Select(one => one.Name)
                .Where(one => one!.StartsWith("Guidewire.", StringComparison.Ordinal)), Is.SubsetOf(named));
        }
    }
}
