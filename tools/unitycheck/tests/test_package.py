"""Assets/Guidewire as a package: in the repository, and as it lies in another project's Packages."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest

from tools.unitycheck import checks, packages, sources
from tools.unitycheck.project import HOME, PACKAGE, Project, at_home

ROOT = Path(__file__).resolve().parents[3]
FILE = f"{HOME}/package.json"
FULL = "GUIDEWIRE_ALL" in os.environ


@pytest.fixture(scope="module")
def host(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project of somebody else's with the package in its Packages, and nothing of the repository beside it."""
    root = tmp_path_factory.mktemp("host")
    shutil.copytree(ROOT / HOME, root / PACKAGE)
    (root / "Assets").mkdir()
    (root / "Packages" / "manifest.json").write_bytes((ROOT / "Packages" / "manifest.json").read_bytes())
    shutil.copytree(ROOT / "ProjectSettings", root / "ProjectSettings")
    build = root / "ProjectSettings" / "EditorBuildSettings.asset"
    text = build.read_text(encoding="utf-8")
    build.write_text(text[:text.index("  m_Scenes:")] + "  m_Scenes: []\n  m_configObjects: {}\n", encoding="utf-8")
    shutil.copy(ROOT / ".gitattributes", root)
    return root


def test_the_package_lies_in_packages_without_a_violation(host: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its C# only with all tests: it is compiled where it stands in the repository."""
    if not FULL:
        monkeypatch.setattr(sources, "is_built", lambda: False)
    assert [str(violation) for violation in checks.run(Project(host))] == []


def test_a_broken_package_is_found_there(host: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sources, "is_built", lambda: False)
    meta = f"{PACKAGE}/Core/Simulation.cs.meta"
    text = (host / meta).read_text(encoding="utf-8").replace("guid: ", "guid: 0", 1)
    broken = Project(host).with_changes({meta: text.encode(), f"{PACKAGE}/Io/Guidewire.Io.asmdef": None})
    rules = {violation.rule for violation in checks.run(broken)}
    assert "guid-form" in rules and len(rules) > 1


def test_paths_of_the_package_are_known_wherever_it_lies() -> None:
    assert at_home(f"{PACKAGE}/Core/A.cs") == f"{HOME}/Core/A.cs" and at_home(PACKAGE) == HOME
    assert at_home(f"{PACKAGE}s/A.cs") == f"{PACKAGE}s/A.cs" and at_home("Assets/A.cs") == "Assets/A.cs"


def test_the_package_keeps_its_rules() -> None:
    assert list(packages.check(Project(ROOT))) == []
    assert json.loads((ROOT / FILE).read_text(encoding="utf-8"))["name"] == PACKAGE.rpartition("/")[2]


@pytest.mark.parametrize("change, rule", [
    ({"name": "Guidewire"}, "package-file"), ({"version": "1.0"}, "package-file"), ({"displayName": 1}, "package-file"),
    ({"dependencies": {"com.unity.nuget.newtonsoft-json": "3.2.0"}}, "package-version"),
    ({"dependencies": {"com.unity.inputsystem": "1.14.2"}}, "package-version"),
    ({"samples": [{"displayName": "x", "path": "Samples~/None"}]}, "package-file"),
    ({"samples": [{"displayName": "x", "path": "Core"}]}, "package-file"),
])
def test_a_package_that_breaks_a_rule_is_named(change: dict, rule: str) -> None:
    project = Project(ROOT)
    data = {**json.loads(project.text(FILE)), **change}
    found = list(packages.check(project.with_changes({FILE: json.dumps(data).encode()})))
    assert [(violation.path, violation.rule) for violation in found] == [(FILE, rule)]


def test_a_package_needs_its_change_log() -> None:
    found = list(packages.check(Project(ROOT).with_changes({f"{HOME}/CHANGELOG.md": None})))
    assert [(violation.path, violation.rule) for violation in found] == [(FILE, "package-file")]
