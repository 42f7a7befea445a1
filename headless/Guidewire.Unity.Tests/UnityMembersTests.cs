using System;
using System.Linq;

namespace Guidewire.Unity.Tests
{
    /// <summary>Everything of Unity's that the package calls stands in one list, with its signature: whoever has
    /// Unity's reference at hand checks that list against it.</summary>
    public sealed class UnityMembersTests
    {
        private static readonly string List = Path.Combine(Stage.Root,
            "headless/Guidewire.Unity.Tests/UnityMembers.txt");

        [Test]
        public void WhatIsCalled_IsWhatTheListHas()
        {
            var called = new SortedSet<string>(StringComparer.Ordinal);
            foreach (string name in new[] { "Guidewire.Runtime", "Guidewire.Editor" })
            {
                called.UnionWith(UnityMembers.Of(Path.Combine(TestContext.CurrentContext.TestDirectory,
                    name + ".dll")));
            }
            if (Environment.GetEnvironmentVariable("GUIDEWIRE_WRITE_MEMBERS") == "1")
            {
                File.WriteAllText(List, string.Join("\n", called) + "\n");
            }
            Assert.That(called, Has.Count.GreaterThan(200));
            string[] listed = File.ReadAllLines(List);
            Assert.That(called.Except(listed), Is.Empty, "called and not listed: check each against Unity's reference");
            Assert.That(listed.Except(called), Is.Empty, "listed and no longer called");
        }
    }
}
