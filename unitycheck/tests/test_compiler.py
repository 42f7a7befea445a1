"""What a compiler finds needs no rule: the projects that compile Unity's tests refuse what Unity does not have."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from unitycheck.tests.test_mutations import ROOT

PROJECT = ROOT / "experiments/headless/Guidewire.Core.Tests.OldNUnit"
pytestmark = pytest.mark.built
_SECONDS = 900

# One statement a line; each must be refused, whatever the others are.
NEWER = {
    "TestContext.AddTestAttachment(\"a\");": "CS0117",
    "Assert.ThatAsync(null, null);": "CS0117",
    "Assert.That(1, Is.AnyOf(1, 2));": "CS0117",
    "Assert.That(new int[1], Has.ItemAt(0).EqualTo(0));": "CS0117",
    "Assert.That(1, Is.EqualTo(1).UsingPropertiesComparer());": "CS1061",
    "new TestCaseData(1).SetArgDisplayNames(\"a\");": "CS1061",
    "System.Random.Shared.Next();": "CS0117",
    "System.Math.FusedMultiplyAdd(1.0, 1.0, 1.0);": "CS0117",
    "System.ArgumentNullException.ThrowIfNull(null);": "CS0117",
}

# A line each; the errors of a language version stand beside each other, whatever else is wrong.
NEWER_LANGUAGE = ("record struct B(int C);", "class G { public required int H; }")


def compile_with(source: str, folder: Path) -> list[tuple[int, str]]:
    """(line, error) of every error in one source, compiled with the tests."""
    odd = folder / "Odd.cs"
    odd.write_text(source, encoding="utf-8")
    done = subprocess.run(
        ["dotnet", "build", str(PROJECT), "-c", "Release", "--nologo", "-v", "q", "--no-restore", "--no-dependencies",
         f"-p:OddSource={odd}"],
        capture_output=True, text=True, timeout=_SECONDS, stdin=subprocess.DEVNULL, cwd=ROOT)
    found = re.findall(r"Odd\.cs\((\d+),\d+\): error (CS\d+)", done.stdout)
    assert found or done.returncode == 0, done.stdout
    return [(int(line), error) for line, error in found]


@pytest.fixture(autouse=True)
def built() -> None:
    """The project's own references have to be there."""
    if shutil.which("dotnet") is None or not any((PROJECT / "bin/Release").glob("**/Guidewire.Core.Tests.dll")):
        pytest.skip("the tests' projects are not built")


def test_newer_members_do_not_compile(tmp_path: Path) -> None:
    head = "using NUnit.Framework;\nnamespace A { class B { void C() {\n"
    found = set(compile_with(head + "\n".join(NEWER) + "\n} } }\n", tmp_path))
    for line, (statement, error) in enumerate(NEWER.items(), head.count("\n") + 1):
        assert (line, error) in found, statement


def test_newer_language_does_not_compile(tmp_path: Path) -> None:
    found = compile_with("namespace A {\n" + "\n".join(NEWER_LANGUAGE) + "\n}\n", tmp_path)
    lines = {line for line, error in found if error == "CS8773"}
    assert lines == set(range(2, 2 + len(NEWER_LANGUAGE))), found
