"""The fast checks of the material rod, on the real runner; and how checks are driven."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from analysis.runs import read_run
from analysis.validation import scenes
from analysis.validation.check import Check, Finding, Result, replay
from analysis.validation.report import FAST, Report, as_csv, as_markdown
from analysis.validation.wire import BASE, Wire
from experiments.sweep import sweep
from studies.table import Case


@pytest.fixture(scope="module")
def fast_report(tmp_path_factory: pytest.TempPathFactory, runner_command: list[str]) -> Report:
    done = sweep(FAST, runner_command, tmp_path_factory.mktemp("validation"), 2, lambda *_: None)
    assert done.failures == []
    return Report({check: replay(check, done.folder) for check in FAST})


@pytest.mark.parametrize("check", FAST, ids=lambda check: check.name)
def test_direct_solver_keeps_its_gates(fast_report: Report, check: Check) -> None:
    results = fast_report.findings[check].results
    assert any(result.gate is not None for result in results) or all(result.reason for result in results)
    assert [result for result in results if result.passed is False] == []


def test_report_has_a_line_for_every_result(fast_report: Report) -> None:
    lines = as_csv(fast_report).splitlines()
    assert len(lines) == 1 + len(fast_report.results)
    text = as_markdown(fast_report)
    passed, failed, shown, silent = fast_report.counts
    assert failed == 0 and f"{passed} lines passed, 0 failed, {shown} have no gate" in text
    reasons = [result.reason for _, result in fast_report.results if result.reason]
    assert len(reasons) == silent and all(f": {reason} |" in text for reason in reasons)
    assert all(f"![{check.title}]" in text for check in FAST)


def _adaptive():
    """Asks for a second run whose number of elements follows from the first."""
    runs = yield [Case("first", {"numberRodElements": 4})]
    n = int(runs["first"].number("numberRodElements"))
    runs = yield [Case("second", {"numberRodElements": 2 * n}, repeats=2)]
    value = runs["second"].number("numberRodElements")
    return Finding((Result("elements", "direct", value, 8.0, abs(value - 8.0), 0.0),), lambda figure: None, "")


def test_later_cases_follow_from_earlier_runs(tmp_path: Path, runner_command: list[str]) -> None:
    check = Check("adaptive", "Test", "adaptive", _adaptive)
    asked = []
    done = sweep([check], runner_command, tmp_path, 1, lambda *_: asked.append(1))
    assert len(asked) == 4 and done.failures == []
    assert replay(check, done.folder).results[0].passed


def _wrong():
    yield [Case("wrong", {"numberRodElements": -1})]
    raise AssertionError("goes on after a run without a result")


def test_check_whose_run_has_no_result_is_dropped_and_told(tmp_path: Path, runner_command: list[str]) -> None:
    done = sweep([Check("wrong", "Test", "wrong", _wrong)], runner_command, tmp_path, 1, lambda *_: None)
    (failure,) = done.failures
    assert failure.exit_code == 2 and "numberRodElements" in failure.message


def _highest_frequency(wire: Wire, n: int) -> float:
    """Of small motions of a free chain with lumped masses, rad/s: across it, with elements that turn, and along it."""
    length = wire.length / n
    turning = np.full(n, wire.second_moment / wire.area)
    mass = wire.line_density * length * np.array([0.5, *np.ones(n - 1), 0.5, *turning])
    shear = np.zeros((n, 2 * n + 1))  # (y' - angle), of n+1 places and n angles
    for j in range(n):
        shear[j, [j, j + 1, n + 1 + j]] = -1.0 / length, 1.0 / length, -1.0
    bend = np.diff(np.eye(2 * n + 1)[n + 1:], axis=0)
    stiffness = wire.shearing * length * shear.T @ shear + wire.bending / length * bend.T @ bend
    across = np.linalg.eigvalsh(stiffness / np.sqrt(np.outer(mass, mass)))[-1]
    side = np.diff(np.eye(n + 1), axis=0)
    along = np.linalg.eigvalsh(
        wire.stretching / length * side.T @ side / np.sqrt(np.outer(mass[:n + 1], mass[:n + 1])))[-1]
    return math.sqrt(max(across, along))


ROUNDED = 1.0 + 1e-9
_WIRES = {"thin": (BASE, 30), "thick": (Wire(radius=5e-3), 60), "coarse": (Wire(radius=5e-3), 4)}


def _slack(wire: Wire, n: int) -> float:
    """By how much a bound of omega^2 that adds shear against turning, shear against shifting and bending may be too
    high: the truth is at least what shear does on its own, and what turning elements with resting nodes do."""
    length = wire.length / n
    turning = wire.shearing / (wire.density * wire.second_moment)
    shifting = 4.0 * wire.shear_factor * wire.shear_modulus / (wire.density * length**2)
    bending = 4.0 * wire.youngs_modulus / (wire.density * length**2)
    return (turning + shifting + bending) / max(turning + shifting, turning + (1.0 - 1.0 / n) * bending)


def test_stable_substep_that_a_run_states_is_that_of_the_linear_chain(
    tmp_path: Path, runner_command: list[str]
) -> None:
    """It must not be above 2/omega_max, and is below by no more than its bound of omega allows."""
    stated = {}

    def plan():
        keys = {name: {**scenes.wire_parameters(wire), "numberRodElements": n, "proximalEnd": "free"}
                for name, (wire, n) in _WIRES.items()}
        stated.update((yield from scenes.stable_substeps(keys)))
        return Finding((), lambda figure: None, "")

    done = sweep([Check("limits", "Test", "limits", plan)], runner_command, tmp_path, 1, lambda *_: None)
    replay(Check("limits", "Test", "limits", plan), done.folder)
    for name, (wire, n) in _WIRES.items():
        limit = 2.0 / _highest_frequency(wire, n)
        assert limit / math.sqrt(_slack(wire, n)) <= stated[name] * ROUNDED, name
        assert stated[name] <= limit * ROUNDED, name


def test_a_motion_timed_in_turns_is_the_motion_of_its_run(tmp_path: Path, runner_command: list[str]) -> None:
    """The stopwatch times the very steps that a run makes, and its figure is its own quotient. How large it is, is no
    matter of a test: other work on the machine would decide."""
    scene = {"numberRodElements": 8, "timeStep": 0.01, "maxSimulationSteps": 3, "constraintSolverSteps": 20,
             "displacementDirection": [0, 1, 0], "deltaThreshold": 0}

    def plan():
        yield [Case("timed", scene, in_turns=True), Case("run", scene)]
        return Finding((), lambda figure: None, "")

    check = Check("cost", "Test", "cost", plan, "params/default.json")
    done = sweep([check], runner_command, tmp_path, 1, lambda *_: None)
    assert done.failures == []
    timed, made = (read_run(done.folder / "cost" / name) for name in ("timed", "run"))
    for name in ("outcome", "reason", "steps", "inGameTime", "parameterHash"):
        assert timed.summary[name] == made.summary[name], name
    for name in ("elementIterationsPerMillisecond", "wallTimePerSecond", "elementIterationTime"):
        assert 0.0 < timed.measured(name) < math.inf, name
