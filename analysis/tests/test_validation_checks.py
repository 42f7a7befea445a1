"""The measuring parts of the checks, without runs: each against a case whose answer is known."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.validation import bar, pictures, scenes, stability, tested
from analysis.validation.dynamics import rms_error
from analysis.validation.report import ROWS, Report, as_csv, as_markdown, draw_finding, draw_overview
from analysis.validation.states import State
from analysis.validation.wire import BASE, Wire
from guidewire.figures.style import CAPTION_ID
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Result


def drive(search: stability.Search) -> stability.Limit:
    """Drives a search for a limit with runs that know only the load they were made for; each takes 0.5 s."""
    summary = {"steps": 1, "computationTime": 0.5}
    cases = next(search)
    try:
        while True:
            cases = search.send({case.key: Run(Path(), case.overrides, summary) for case in cases})
    except StopIteration as end:
        return end.value


def search(limit: float, expected: float) -> float:
    branch = stability.limit(
        "load=", expected, lambda load: {"load": load}, lambda run: max(0.0, run.number("load") - limit)
    )
    return drive(branch).load


@pytest.mark.parametrize("limit", [0.75, 0.99, 1.0, 1.01, 1.3])
def test_limit_is_found_wherever_it_lies_in_the_interval(limit: float) -> None:
    assert search(limit, 1.0) == pytest.approx(limit, abs=2e-3)


def test_limit_outside_the_interval_is_not_a_number() -> None:
    assert math.isnan(search(0.5, 1.0)) and math.isnan(search(2.0, 1.0))


def test_search_passes_over_loads_whose_run_says_nothing() -> None:
    silent = []

    def left(run: Run) -> float:
        load = run.number("load")
        if 0.9 < load < 1.0 and len(silent) < 2:
            silent.append(load)
            return math.nan
        return max(0.0, load - 1.001) + (0.0 if load < 1.001 else stability.LEFT)

    found = drive(stability.limit("load=", 1.0, lambda load: {"load": load}, left))
    assert len(silent) == 2 and found.load == pytest.approx(1.001, abs=5e-3)
    assert "(2 of " in stability.limit_line("rod", 1.0, found, 0.03, "N").what


def push(limit: float) -> stability.Limit:
    """What `pushed` finds where a push doubles above the limit and is halved below it."""
    return drive(stability.pushed(
        "load=", 2.0, lambda key, load: Case(key, {"load": load}),
        lambda run: stability.PUSH * (2.0 if run.number("load") > 2.0 * limit else 0.5)))


@pytest.mark.parametrize("limit, ends", [(1.0, (0.98, 1.02)), (0.95, (0.94, 0.98)), (1.07, (1.06, 1.10))])
def test_push_grows_above_the_limit_and_dies_out_below(limit: float, ends: tuple[float, float]) -> None:
    found = push(limit)
    assert (found.low, found.high) == ends
    assert found.cost == 0.5 * len(found.seen) and len(found.seen) == (2 if limit == 1.0 else 6)
    line = stability.pushed_line("rod", "explicit", 2.0, push(limit), 0.03, "N")
    assert line.error == pytest.approx(max(abs(end - 1.0) for end in ends)) and line.passed == (limit == 1.0)


def test_push_that_always_grows_shows_no_limit() -> None:
    line = stability.pushed_line("rod", "explicit", 2.0, push(0.5), 0.03, "N")
    assert line.passed is False and math.isnan(line.value) and "none found" in line.what


def test_gain_of_the_bar_moves_a_sphere_as_its_spring_does() -> None:
    """One sweep over one extended element, by the projection's own formula, against s e/m dt^2."""
    step, extension = 2.5e-7, 1e-3  # s, units
    weight, length = 1.0 / bar.BAR_MASS, BASE.length / 30 / scenes.UNIT
    moved = bar.bar_gain(step) * weight * length * (extension / length) / (2.0 * weight + 4.0 * length**2)
    assert moved == pytest.approx(bar.BAR_SPRING * extension * weight * step**2, rel=1e-12)


def test_rows_of_tests_are_read_the_worst_of_each_and_one_beyond_its_limit_fails(tmp_path: Path) -> None:
    said = {"one": "row: order | 2.01 | 2 | 0.1",
            "two": "more\nrow: order | 1.95 | 2 | 0.1\nrow: force | NaN | 1 | 1E-06"}
    tests = "".join(f'<UnitTest id="{name}"><TestMethod className="Guidewire.Core.Tests.ClampTests"/></UnitTest>'
                    for name in said)
    cases = "".join(f'<UnitTestResult testId="{name}"><Output><StdOut>{text}</StdOut></Output></UnitTestResult>'
                    for name, text in said.items())
    (tmp_path / "a.trx").write_text(f'<TestRun xmlns="urn:x">{tests}{cases}</TestRun>')
    force, order = tested.read(tmp_path / "a.trx")
    assert (order.what, order.value, order.passed) == ("order (ClampTests)", 1.95, True)
    assert force.passed is False


def test_rms_error_is_relative_to_the_reference() -> None:
    reference = np.array([3.0, 4.0])
    assert rms_error(reference + np.array([0.3, -0.4]), reference) == pytest.approx(0.1)


def test_twists_go_on_beyond_half_a_turn() -> None:
    turns = np.linspace(0.0, 3.0 * np.pi, 20)
    frames = np.stack([0.0 * turns, 0.0 * turns, np.sin(0.5 * turns), np.cos(0.5 * turns)], axis=1)
    np.testing.assert_allclose(State(0.0, np.zeros((21, 3)), np.zeros((21, 3)), frames).twists, turns)


STABLE = 1.7e-7  # s, what a runner may state


def answered(plan: scenes.Asking[dict], asked: list[Case]) -> dict:
    """Drives a plan with runs that state `STABLE`; `asked` takes the cases."""
    summary = {"solver": {"stableSubstep": STABLE}}
    try:
        cases = next(plan)
        while True:
            asked += cases
            cases = plan.send({case.key: Run(Path(), case.overrides, summary) for case in cases})
    except StopIteration as end:
        return end.value


@pytest.mark.parametrize("step", [1e-3, 1e-5])
def test_explicit_substeps_are_below_the_limit_that_the_runner_states_and_fill_the_step(step: float) -> None:
    asked: list[Case] = []
    keys = {**scenes.wire_parameters(BASE), "numberRodElements": 12, "distalEnd": "clamped"}
    method = answered(scenes.small_steps("explicit", BASE, step, keys), asked)
    assert 0.7 * STABLE < step / method["substeps"] <= 0.75 * STABLE
    (case,) = asked  # of the same wire and supports, and without a step
    assert case.overrides == {**keys, "solver": "explicit", "maxSimulationSteps": 0}


def test_xpbd_substeps_are_set_by_the_wire_alone() -> None:
    for wire in (BASE, Wire(radius=5e-3)):
        asked: list[Case] = []
        method = answered(scenes.small_steps("xpbd", wire, 1e-3, scenes.wire_parameters(wire)), asked)
        assert asked == [] and 1e-3 / method["substeps"] <= 4.0 * scenes.shear_substep(wire)


def _report() -> Report:
    results = (
        Result("good", "direct", 1.0, 1.0, 1e-4, 1e-3), Result("bad", "xpbd", 2.0, 1.0, 1.0, 1e-3),
        Result("lost", "explicit", math.nan, 1.0, math.nan, 1e-3), Result("shown", "pbd", 1.0, math.nan, 0.1, None),
    )
    draw = pictures.orders("n (1)", "error (1)", {"a": ((10, 20), (1e-2, 1e-4))}, [(-2.0, "order 2")], (1e-3, "gate"))
    finding = Finding(results, draw, "Two points.")
    return Report({Check("one", "Test", "one check", lambda: iter(())): finding})


def test_report_counts_and_names_what_failed() -> None:
    report = _report()
    assert report.counts == (1, 2, 1)
    figure, caption = draw_overview(report)
    assert "1 lines passed, 2 failed, 1 have no gate and are only shown" in caption
    assert "one check: 2 lines, worst explicit, lost" in caption
    filled = [line for line in figure.axes[0].lines if line.get_fillstyle() == "full" and line.get_marker() in "os^"]
    assert len(filled) == 2
    assert as_csv(report).count("FAILED") == 2 and as_markdown(report).count("FAILED") == 2


def test_picture_shows_points_gate_and_caption() -> None:
    figure: Figure = draw_finding(next(iter(_report().findings.values())))
    (axes,) = figure.axes
    assert axes.get_xlabel() == "n (1)" and axes.get_xscale() == axes.get_yscale() == "log"
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), [1e-2, 1e-4])
    assert {"order 2", "gate"} <= {line.get_label() for line in axes.lines}
    assert next(text for text in figure.texts if text.get_gid() == CAPTION_ID).get_text() == "Two points."


def test_every_check_has_its_own_name() -> None:
    assert len({check.name for check in ROWS}) == len(ROWS)
    assert {check.section for check in ROWS} == {
        "Held by tests of Core", "Statics", "Stability limits", "Dynamics", "In the vessel", "Independence",
        "A published suite"}
