"""The checker against this repository: clean as it is, and each of many seeded breakages found and named.

A breakage is laid over the project in memory: the files on disk are read once and never touched.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from unitycheck import checks, sceneparameters
from unitycheck.project import Project
from unitycheck.tests.breakages import Breakage, assemblies, assets, language, scenes, scripts, unitytests

ROOT = Path(__file__).resolve().parents[2]
KINDS = {"scenes": scenes.BREAKAGES, "scripts": scripts.BREAKAGES, "assemblies": assemblies.BREAKAGES,
         "language": language.BREAKAGES, "assets": assets.BREAKAGES, "tests": unitytests.BREAKAGES}
BREAKAGES = {f"{kind}: {name}": breakage for kind, table in KINDS.items() for name, breakage in table.items()}


@pytest.fixture(scope="session")
def repository() -> Project:
    """This repository, read once."""
    return Project(ROOT)


def assert_named(project: Project, breakage: Breakage) -> None:
    broken = project.with_changes(breakage.change(project))
    found = {(violation.path, violation.rule) for violation in checks.run(broken)}
    assert (breakage.path, breakage.rule) in found


def test_repository_keeps_every_rule(repository: Project) -> None:
    assert [str(violation) for violation in checks.run(repository)] == []


@pytest.mark.parametrize("name", BREAKAGES)
def test_breakage_is_found_and_named(repository: Project, name: str) -> None:
    assert_named(repository, BREAKAGES[name])


@pytest.mark.built
@pytest.mark.parametrize("name", scenes.READ)
def test_breakage_is_found_by_the_reader_itself(repository: Project, name: str) -> None:
    if sceneparameters.program(str(repository.root)) is None:
        pytest.skip("the console program is not built, or older than its sources")
    assert_named(repository, scenes.READ[name])


def test_there_are_at_least_150_breakages_of_six_kinds() -> None:
    assert len(KINDS) == 6 and all(KINDS.values())
    assert len(BREAKAGES) >= 150
