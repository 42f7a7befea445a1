"""The checker against this repository: clean as it is, and each of many seeded breakages found and named.

A breakage is laid over the project in memory: the files on disk are read once and never touched.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import pytest

from tools.testing import FULL_CAMPAIGNS
from tools.unitycheck import checks, sceneparameters, sources
from tools.unitycheck.project import Project
from tools.unitycheck.tests.breakages import Breakage, assemblies, assets, language, scenes, scripts, unitytests

ROOT = Path(__file__).resolve().parents[3]
KINDS = {"scenes": scenes.BREAKAGES, "scripts": scripts.BREAKAGES, "assemblies": assemblies.BREAKAGES,
         "language": language.BREAKAGES, "assets": assets.BREAKAGES, "tests": unitytests.BREAKAGES}
BREAKAGES = {f"{kind}: {name}": breakage for kind, table in KINDS.items() for name, breakage in table.items()}
# Where campaigns do not run in full, the last breakage of each rule in each table.
LAST = {(name.partition(":")[0], breakage.rule): name for name, breakage in BREAKAGES.items()}
MADE = list(BREAKAGES if FULL_CAMPAIGNS in os.environ else LAST.values())
# Four at once, far from each other in the tables: a third of the time.
COUNT = -(-len(MADE) // 4)
GROUPS = [MADE[first::COUNT] for first in range(COUNT)]


@pytest.fixture(scope="session")
def repository() -> Project:
    """This repository, read once, and compiled as it is before anything is changed."""
    project = Project(ROOT)
    assert sources.answer(project) is not None, "Guidewire.UnityCheck is not built"
    return project


def named(project: Project) -> set[tuple[str, str]]:
    return {(violation.path, violation.rule) for violation in checks.run(project)}


def assert_named(project: Project, breakage: Breakage) -> None:
    changes = breakage.change(project)
    assert (breakage.path, breakage.rule) in named(project.with_changes(changes, {*changes, breakage.path}))


def test_repository_keeps_every_rule(repository: Project) -> None:
    assert [str(violation) for violation in checks.run(repository)] == []


@pytest.mark.parametrize("names", GROUPS, ids=" | ".join)
def test_breakages_are_found_and_named(repository: Project, names: Sequence[str]) -> None:
    breakages = [BREAKAGES[name] for name in names]
    if len(breakages) == 1:
        assert_named(repository, breakages[0])
        return
    changes = [breakage.change(repository) for breakage in breakages]
    merged = {path: data for change in changes for path, data in change.items()}
    if len(merged) == sum(map(len, changes)):
        found = named(repository.with_changes(merged, {*merged, *(breakage.path for breakage in breakages)}))
        if all((breakage.path, breakage.rule) in found for breakage in breakages):
            return
    # One may hide another, or two change one file.
    half = len(names) // 2
    test_breakages_are_found_and_named(repository, names[:half])
    test_breakages_are_found_and_named(repository, names[half:])


@pytest.mark.parametrize("name", scenes.READ)
def test_breakage_is_found_by_the_reader_itself(repository: Project, name: str) -> None:
    if sceneparameters.program(str(repository.root)) is None:
        pytest.skip("the console program is not built, or older than its sources")
    assert_named(repository, scenes.READ[name])


def test_every_breakage_is_in_a_group() -> None:
    assert sorted(name for group in GROUPS for name in group) == sorted(MADE)
    assert {BREAKAGES[name].rule for name in MADE} == {breakage.rule for breakage in BREAKAGES.values()}


def test_there_are_at_least_150_breakages_of_six_kinds() -> None:
    assert len(KINDS) == 6 and all(KINDS.values())
    assert len(BREAKAGES) >= 150
