"""The fast checks of the material rod, on the real runner; and how checks are driven."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path

import pytest

from analysis.validation.report import FAST, Report, as_csv, as_markdown
from guidewire.logs.runs import read_runs
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Result, replay
from guidewire.sweeps.sweep import Means, SweepResult, sweep
from tools.testing import FULL_CAMPAIGNS

# All only where campaigns run in full. Elsewhere one of each kind of row that no test of Core has: a large load,
# tolerances, a tube with clearance.
ONE_OF_A_KIND = ("heavy-cantilever", "tolerance", "twisted-tube")
CHECKS = FAST if FULL_CAMPAIGNS in os.environ else tuple(check for check in FAST if check.name in ONE_OF_A_KIND)


def make(checks: Sequence[Check], folder: Path, command: list[str]) -> SweepResult:
    """Make the runs of checks into a folder."""
    return sweep([(check, folder) for check in checks], folder / "runs", Means(command))


@pytest.fixture(scope="module")
def fast_report(tmp_path_factory: pytest.TempPathFactory, runner_command: list[str]) -> Report:
    folder = tmp_path_factory.mktemp("validation")
    done = make(CHECKS, folder, runner_command)
    assert done.failures == []
    return Report({check: replay(check, folder) for check in CHECKS})


@pytest.mark.parametrize("check", CHECKS, ids=lambda check: check.name)
def test_direct_solver_keeps_its_gates(fast_report: Report, check: Check) -> None:
    results = fast_report.findings[check].results
    assert any(result.gate is not None for result in results)
    assert [result for result in results if result.passed is False] == []


def test_report_has_a_line_for_every_result(fast_report: Report) -> None:
    lines = as_csv(fast_report).splitlines()
    assert len(lines) == 1 + len(fast_report.results)
    text = as_markdown(fast_report)
    passed, failed, shown = fast_report.counts
    assert failed == 0 and f"{passed} lines passed, 0 failed, {shown} have no gate" in text
    assert all(f"![{check.title}]" in text for check in CHECKS)


def _adaptive():
    """Asks for a second run whose number of elements follows from the first."""
    runs = yield [Case("first", {"numberRodElements": 4})]
    n = int(runs["first"].number("numberRodElements"))
    runs = yield [Case("second", {"numberRodElements": 2 * n}, repeats=2)]
    value = runs["second"].number("numberRodElements")
    return Finding((Result("elements", "direct", value, 8.0, abs(value - 8.0), 0.0),), lambda figure: None, "")


def test_later_cases_follow_from_earlier_runs(tmp_path: Path, runner_command: list[str]) -> None:
    check = Check("adaptive", "Test", "adaptive", _adaptive)
    done = make([check], tmp_path, runner_command)
    assert done.made == 4 and done.failures == []
    assert replay(check, tmp_path).results[0].passed


def _wrong():
    yield [Case("right", {"numberRodElements": 4})]
    yield [Case("wrong", {"numberRodElements": -1})]
    raise AssertionError("goes on after a run without a result")


def test_check_whose_run_has_no_result_is_dropped_and_reported(tmp_path: Path, runner_command: list[str]) -> None:
    done = make([Check("wrong", "Test", "wrong", _wrong)], tmp_path, runner_command)
    (failure,) = done.failures
    assert failure.exit_code == 2 and "numberRodElements" in failure.message


@pytest.mark.skipif(FULL_CAMPAIGNS not in os.environ, reason="it needs the benchmarks, which are built for it alone")
def test_a_motion_timed_in_turns_is_the_motion_of_its_run(tmp_path: Path, runner_command: list[str]) -> None:
    """The stopwatch times the very steps that a run makes, and its figure is its own quotient. How large it is, is no
    matter of a test: other work on the machine would decide."""
    scene = {"numberRodElements": 8, "timeStep": 0.01, "maxSimulationSteps": 3, "constraintSolverSteps": 20,
             "displacementDirection": [0, 1, 0], "deltaThreshold": 0}

    def plan():
        yield [Case("timed", scene, in_turns=True), Case("run", scene)]
        return Finding((), lambda figure: None, "")

    check = Check("cost", "Test", "cost", plan, "params/default.json")
    assert make([check], tmp_path, runner_command).failures == []
    timed, made = (read_runs(tmp_path / "cost")[name] for name in ("timed", "run"))
    for name in ("outcome", "reason", "steps", "inGameTime", "parameterHash"):
        assert timed.summary[name] == made.summary[name], name
    for name in ("elementIterationsPerMillisecond", "wallTimePerSecond", "elementIterationTime"):
        assert 0.0 < timed.measured(name) < math.inf, name
