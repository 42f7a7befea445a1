"""Breakages of tests: what Unity's NUnit lacks, methods that its runner cannot call, fixtures that it cannot make."""

from __future__ import annotations

from tools.unitycheck.tests.breakages import GUIDEWIRE, RUNTIME, Breakage, insert, replace, write

PLAY = f"{GUIDEWIRE}/Tests/Unity/Play/WirePlayTests.cs"
TUBE = f"{GUIDEWIRE}/Tests/Unity/TubeMeshTests.cs"
NEW = f"{GUIDEWIRE}/Tests/Core/OddTests.cs"


def source(body: str, head: str = "public sealed class OddTests") -> str:
    return ("using System.Collections;\nusing System.Collections.Generic;\nusing NUnit.Framework;\n\n"
            f"namespace Guidewire.Core.Tests\n{{\n    {head}\n    {{\n        {body}\n    }}\n}}\n")


def lacks(statement: str, rule: str = "nunit") -> Breakage:
    return Breakage(write(NEW, source(f"[Test] public void A() {{ {statement} }}")), NEW, rule)


def method(body: str, rule: str = "test-method") -> Breakage:
    return Breakage(write(NEW, source(body)), NEW, rule)


def fixture(head: str, body: str = "") -> Breakage:
    return Breakage(write(NEW, source(f"[Test] public void A() {{ }} {body}", head)), NEW, "test-fixture")


BREAKAGES = {
    "Multiple": lacks("Assert.Multiple(() => { });"),
    "MultipleAsync": lacks("Assert.MultipleAsync(null);", "CS0117"),
    "scope of several": lacks("using (Assert.EnterMultipleScope()) { }", "CS0117"),
    "warning": lacks('Assert.Warn("a");'),
    "warning on a condition": lacks("Warn.If(true);"),
    "any of": lacks("Assert.That(1, Is.AnyOf(1, 2));", "CS0117"),
    "properties comparer": lacks("Assert.That(1, Is.EqualTo(1).UsingPropertiesComparer());", "CS1061"),
    "item at a place": lacks("Assert.That(new int[1], Has.ItemAt(0).EqualTo(0));", "CS0117"),
    "asynchronous that": lacks("Assert.ThatAsync(null, null);", "CS0117"),
    "classic assertions": lacks("ClassicAssert.AreEqual(1, 1);", "CS0103"),
    "key with its value": lacks("Assert.That(new Dictionary<int, int>(), Contains.Key(1).WithValue(1));", "CS1061"),
    "exactly one": lacks("Assert.That(new int[1], Has.One.EqualTo(0));", "CS0117"),
    "attachment": lacks('TestContext.AddTestAttachment("a");', "CS0117"),
    "progress": lacks('TestContext.Progress.WriteLine("a");'),
    "parallel switched off": Breakage(write(NEW, source("[Test, NonParallelizable] public void A() { }")), NEW,
                                      "CS0246"),
    "life cycle": Breakage(write(NEW, source("[Test] public void A() { }", "[FixtureLifeCycle(LifeCycle."
                                             "InstancePerTestCase)] public class OddTests")), NEW, "CS0246"),
    "tolerance for all": Breakage(write(NEW, source("[Test, DefaultFloatingPointTolerance(1)] public void A() { }")),
                                  NEW, "CS0246"),
    "cancelled after": Breakage(write(NEW, source("[Test, CancelAfter(3)] public void A() { }")), NEW, "CS0246"),
    "test that nobody waits for": method("[Test] public async void A() { }"),
    "UnityTest that returns void": Breakage(replace(PLAY, "public IEnumerator Loop", "public void Loop"), PLAY,
                                            "unity-test"),
    "UnityTest with cases": Breakage(replace(PLAY, r"\[UnityTest\]", "[UnityTest, TestCase(1)]"), PLAY, "unity-test"),
    "UnityTest that is a Test": Breakage(replace(PLAY, r"\[UnityTest\]", "[UnityTest, Test]"), PLAY, "unity-test"),
    "UnityTest that is private": Breakage(replace(PLAY, "public IEnumerator Loop", "private IEnumerator Loop"), PLAY,
                                          "test-method"),
    "Test that yields frames": Breakage(replace(PLAY, r"\[UnityTest\]", "[Test]"), PLAY, "unity-test"),
    "UnitySetUp that returns void": Breakage(insert(PLAY, "[UnitySetUp] public void Make() { }"), PLAY, "unity-test"),
    "private test": method("[Test] private void A() { }"),
    "test that returns a number": method("[Test] public int A() { return 1; }"),
    "test with parameters and no case": method("[Test] public void A(int a) { }"),
    "case with too few arguments": method("[TestCase(1)] public void A(int a, int b) { }"),
    "case with too many arguments": method("[TestCase(1, 2)] public void A(int a) { }"),
    "case that expects what is not returned": method("[TestCase(1, ExpectedResult = 2)] public void A(int a) { }"),
    "source that is not there": method("[TestCaseSource(nameof(Bs))] public void A(int a) { }"),
    "source by a name that is not there": method('[TestCaseSource("Bs")] public void A(int a) { }'),
    "source that is not static": method("private IEnumerable<int> Bs => new[] { 1 };"
                                        " [TestCaseSource(nameof(Bs))] public void A(int a) { }"),
    "values that are not there": method("[Test] public void A([ValueSource(nameof(Bs))] int a) { }"),
    "set-up with a parameter": method("[Test] public void A() { } [SetUp] public void B(int a) { }"),
    "set-up that is private": method("[Test] public void A() { } [SetUp] private void B() { }"),
    "tear-down that returns": method("[Test] public void A() { } [TearDown] public int B() { return 1; }"),
    "generic test": method("[Test] public void A<T>() { }"),
    "fixture with arguments that nobody gives": fixture("public class OddTests", "public OddTests(int a) { }"),
    "fixture with a private constructor": fixture("public class OddTests", "private OddTests() { }"),
    "fixture with too many arguments": fixture("[TestFixture(1, 2)] public class OddTests",
                                               "public OddTests(int a) { }"),
    "generic fixture": fixture("public class OddTests<T>"),
    "nested fixture": fixture("public class Outer { public class OddTests", "}"),
    "fixture that is a struct": fixture("public struct OddTests"),
    "fixture that is a behaviour": Breakage(replace(TUBE, "class TubeMeshTests", "class TubeMeshTests : MonoBehaviour"),
                                            TUBE, "test-fixture"),
    "test in a player": Breakage(write(f"{RUNTIME}/OddTests.cs", source("[Test] public void A() { }").replace(
        "Guidewire.Core.Tests", "Guidewire.Runtime")), f"{RUNTIME}/OddTests.cs", "test-assembly"),
    "NUnit in a player": Breakage(write(f"{RUNTIME}/OddTests.cs", "using NUnit.Framework;\n"), f"{RUNTIME}/OddTests.cs",
                                  "CS0246"),
    "engine's test tools in the shared tests": Breakage(
        write(NEW, "using UnityEngine.TestTools;\n"), NEW, "CS0246"),
}
