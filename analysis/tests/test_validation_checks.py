"""The measuring parts of the checks, without runs: each against a case whose answer is known."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.validation import balance, dynamics, pictures, ring, scenes, stability, tested
from analysis.validation.beam import mode_numbers
from analysis.validation.clamp import fit_frequency
from analysis.validation.dynamics import rms_error
from analysis.validation.report import ROWS, Report, as_csv, as_markdown, draw_finding, draw_overview
from analysis.validation.states import State
from analysis.validation.wire import BASE, Wire
from guidewire.figures.style import CAPTION_ID
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Result, not_run


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


def test_two_step_rate_is_exact_for_a_parabola() -> None:
    time = 0.1 * np.arange(5)
    momentum = np.stack([time**2, 3.0 * time, 0.0 * time], axis=1)
    rates = balance._rates(momentum, 0.1, two_steps=True)
    np.testing.assert_allclose(rates[1:, 0], 2.0 * time[2:], atol=1e-12)
    np.testing.assert_allclose(rates[:, 1], 3.0)


def test_period_is_twice_the_distance_of_zeros() -> None:
    time = np.linspace(0.0, 20.0, 400)
    assert balance._period(time, np.exp(-0.01 * time) * np.cos(3.0 * time), time) == pytest.approx(
        2.0 * np.pi / 3.0, rel=1e-3)


def test_gain_of_the_bar_moves_a_sphere_as_its_spring_does() -> None:
    """One sweep over one extended element, by the projection's own formula, against s e/m dt^2."""
    step, extension = 2.5e-7, 1e-3  # s, units
    weight, length = 1.0 / dynamics.BAR_MASS, BASE.length / 30 / scenes.UNIT
    moved = dynamics.bar_gain(step) * weight * length * (extension / length) / (2.0 * weight + 4.0 * length**2)
    assert moved == pytest.approx(dynamics.BAR_SPRING * extension * weight * step**2, rel=1e-12)


def test_link_counts_the_turns_of_a_twisted_ring() -> None:
    n, twist = 96, 10.0
    around = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    turn = twist * (np.arange(n) + 0.5) / n
    # About -x by the ring's angle, then about the element's own axis by its turn.
    bend = np.stack([-np.sin(0.5 * around), 0.0 * turn, 0.0 * turn, np.cos(0.5 * around)], axis=1)
    s, c = np.sin(0.5 * turn), np.cos(0.5 * turn)
    frames = np.stack([bend[:, 0] * c, -bend[:, 0] * s, bend[:, 3] * s, bend[:, 3] * c], axis=1)
    state = State(0.0, np.zeros((n + 1, 3)), np.zeros((n + 1, 3)), frames)
    assert ring.link(state) == pytest.approx(twist, rel=1e-3)


def test_frequency_is_found_beside_another_mode() -> None:
    time = np.linspace(0.0, 12.0, 4801)
    motion = 0.3 * np.cos(2.0 * np.pi * 1.01 * time + 0.4) + 1e-4 * np.cos(2.0 * np.pi * 6.3 * time) + 5.0
    assert fit_frequency(time, motion, 1.0) == pytest.approx(1.01, rel=1e-7)


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


def test_mode_start_has_frames_along_its_elements() -> None:
    start = scenes.mode_start(BASE, 10, float(mode_numbers(1)[0]), 1e-2)
    places, frames = np.array(start["positions"]), np.array(start["orientations"])
    state = State(0.0, places, places, frames)
    chords = np.diff(places, axis=0)
    np.testing.assert_allclose(state.directors, chords / np.linalg.norm(chords, axis=1)[:, None], atol=1e-12)
    assert places[-1, 1] == pytest.approx(-1e-2 * BASE.length / scenes.UNIT)


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


def test_settled_motion_steps_as_the_runner_allows_and_takes_its_loads() -> None:
    asked: list[Case] = []
    found = answered(scenes.settled("explicit", BASE, {"tipForce": [0.0, -1.0, 0.0]}, name="limit"), asked)
    assert [case.key for case in asked] == ["limit"] and found["tipForce"] == [0.0, -1.0, 0.0]
    assert found["timeStep"] == 1000.0 * STABLE and found["timeStep"] / found["substeps"] <= 0.75 * STABLE


def _report() -> Report:
    results = (
        Result("good", "direct", 1.0, 1.0, 1e-4, 1e-3), Result("bad", "xpbd", 2.0, 1.0, 1.0, 1e-3),
        Result("lost", "explicit", math.nan, 1.0, math.nan, 1e-3), Result("shown", "pbd", 1.0, math.nan, 0.1, None),
        not_run("left out", "pbd", "it cannot"),
    )
    draw = pictures.orders("n (1)", "error (1)", {"a": ((10, 20), (1e-2, 1e-4))}, [(-2.0, "order 2")], (1e-3, "gate"))
    finding = Finding(results, draw, "Two points.")
    return Report({Check("one", "Test", "one check", lambda: iter(())): finding})


def test_report_counts_and_names_what_failed() -> None:
    report = _report()
    assert report.counts == (1, 2, 1, 1)
    figure, caption = draw_overview(report)
    assert "1 lines passed, 2 failed, 1 have no gate and are only shown, 1 say why" in caption
    assert "one check: 2 lines, worst explicit, lost" in caption
    filled = [line for line in figure.axes[0].lines if line.get_fillstyle() == "full" and line.get_marker() in "os^"]
    assert len(filled) == 2
    assert as_csv(report).count("FAILED") == 2 and as_markdown(report).count("FAILED") == 2


def test_line_without_figure_gives_its_reason_and_no_number() -> None:
    line = next(row for row in as_markdown(_report()).splitlines() if "left out" in row)
    assert line == "| left out. Not run: it cannot | pbd | - | - | - | - | - | - |"
    assert next(row for row in as_csv(_report()).splitlines() if "left out" in row).endswith(",it cannot")
    lost = next(row for row in as_markdown(_report()).splitlines() if row.startswith("| lost"))
    assert "not finite" in lost and "FAILED" in lost


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
        "Held by tests of Core", "The clamp", "Statics", "Stability limits", "Dynamics", "In the vessel",
        "Independence", "A published suite", "A wire in a catheter"}
