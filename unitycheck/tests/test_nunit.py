"""Tests keep to Unity's NUnit 3.5."""

from __future__ import annotations

import pytest

from unitycheck import nunit

LACKING = ["Assert.Multiple(() => { });", "Assert.Warn(\"x\");", "Assert.That(x, Is.AnyOf(1, 2));", "Warn.If(x);",
           "[assembly: NonParallelizable]", "[FixtureLifeCycle(LifeCycle.InstancePerTestCase)]",
           "[Test, CancelAfter(3)]",
           "x.UsingPropertiesComparer()", "[DefaultFloatingPointTolerance(1)]", "TestContext.AddTestAttachment(f);",
           "data.SetArgDisplayNames(\"a\")", "await Assert.ThatAsync(f);", "public async Task Rod_Falls() { }",
           "public async void Rod_Falls() { }", "class Outer { [TestFixture] class Inner { } }",
           "ClassicAssert.AreEqual(1, x);"]
PRESENT = ["Assert.That(x, Is.EqualTo(1.0).Within(1e-9), \"why\");", "Assert.Throws<Error>(() => F());",
           "[TestFixture] class C { }",
           "[TestCase(1)] [Category(\"Fast\")] public void F(int x) { }", "x.Multiple(3);",
           "CollectionAssert.AreEqual(a, b);",
           "Assume.That(x);", "TestContext.WriteLine(x);", "// Assert.Multiple"]


@pytest.mark.parametrize("source", LACKING)
def test_lacking(source: str) -> None:
    assert nunit.scan(source) != []


@pytest.mark.parametrize("source", PRESENT)
def test_present(source: str) -> None:
    assert nunit.scan(source) == []


def test_file_is_named_only_under_tests(sample) -> None:
    sample.edit("Assets/Guidewire/Tests/Core/NumberTests.cs", "{\n}",
                "{\n    class T { void F() { Assert.Multiple(null); } }\n}")
    sample.edit("Assets/Guidewire/Core/Number.cs", "    {\n    }",
                "    {\n        void F() { Assert.Multiple(null); }\n    }")
    assert sample.broken() == {("Assets/Guidewire/Tests/Core/NumberTests.cs", "nunit")}
