"""The measuring parts of the checks, without runs: each against a case whose answer is known."""

from __future__ import annotations

import math
from collections.abc import Generator, Mapping
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.figures.style import CAPTION_ID
from analysis.runs import Run
from analysis.validation import chart, pictures, scenes, stability
from analysis.validation.beam import mode_numbers
from analysis.validation.check import Check, Finding, Result
from analysis.validation.clamp import fit_frequency
from analysis.validation.dynamics import rms_error
from analysis.validation.elastica import column_load
from analysis.validation.report import ROWS, Report, as_csv, as_markdown, draw_finding, draw_overview
from analysis.validation.states import State
from analysis.validation.wire import BASE, Wire


def drive(branch: Generator, answer) -> tuple[float, dict[float, float]]:
    """Drives a search for a limit with runs that know only the load they were made for."""
    cases = next(branch)
    try:
        while True:
            runs: Mapping[str, Run] = {case.key: Run(Path(), case.overrides, None) for case in cases}
            cases = branch.send(runs)
    except StopIteration as end:
        return end.value


def search(limit: float, expected: float) -> float:
    branch = stability.limit(
        "load=", expected, lambda load: {"load": load}, lambda run: max(0.0, run.number("load") - limit)
    )
    return drive(branch, None)[0]


@pytest.mark.parametrize("limit", [0.75, 0.99, 1.0, 1.01, 1.3])
def test_limit_is_found_wherever_it_lies_in_the_interval(limit: float) -> None:
    assert search(limit, 1.0) == pytest.approx(limit, abs=2e-3)


def test_limit_outside_the_interval_is_not_a_number() -> None:
    assert math.isnan(search(0.5, 1.0)) and math.isnan(search(2.0, 1.0))


def test_implied_load_is_that_of_the_beam_column() -> None:
    """A column of half the stiffness, F/P (tan u/u - 1) with u^2 = P/0.5, has half the critical load."""
    thrust, side = 0.4, 1e-3
    u = math.sqrt(thrust / 0.5)
    tip = side / thrust * (math.tan(u) / u - 1.0)
    assert stability._implied_load(thrust, side, tip) == pytest.approx(0.5 * column_load(), rel=1e-9)


def test_link_counts_the_turns_of_a_twisted_ring() -> None:
    n, twist = 96, 10.0
    around = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    turn = twist * (np.arange(n) + 0.5) / n
    # About -x by the ring's angle, then about the element's own axis by its turn.
    bend = np.stack([-np.sin(0.5 * around), 0.0 * turn, 0.0 * turn, np.cos(0.5 * around)], axis=1)
    s, c = np.sin(0.5 * turn), np.cos(0.5 * turn)
    frames = np.stack([bend[:, 0] * c, -bend[:, 0] * s, bend[:, 3] * s, bend[:, 3] * c], axis=1)
    state = State(0.0, np.zeros((n + 1, 3)), np.zeros((n + 1, 3)), frames)
    assert stability._link(state) == pytest.approx(twist, rel=1e-3)


def test_frequency_is_found_beside_another_mode() -> None:
    time = np.linspace(0.0, 12.0, 4801)
    motion = 0.3 * np.cos(2.0 * np.pi * 1.01 * time + 0.4) + 1e-4 * np.cos(2.0 * np.pi * 6.3 * time) + 5.0
    assert fit_frequency(time, motion, 1.0) == pytest.approx(1.01, rel=1e-7)


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


@pytest.mark.parametrize("solver", ["explicit", "xpbd"])
def test_small_steps_are_below_the_limit_and_fill_the_step(solver: str) -> None:
    for wire in (BASE, Wire(radius=5e-3)):
        method = scenes.small_steps(solver, wire, 1e-3)
        substep = 1e-3 / method["substeps"]
        assert substep <= {"explicit": 1.0, "xpbd": 4.0}[solver] * scenes.stable_substep(wire)


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
    assert "1 passed, 2 failed; 1 more" in caption and "bad" in caption and "lost" in caption
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
    assert len({check.id for check in ROWS}) == len(ROWS)
    assert {check.section for check in ROWS} == {
        "The clamp", "Statics", "Stability limits", "Dynamics", "Independence"}


def test_gains_stand_in_every_panel_of_the_chart_between_the_same_ends() -> None:
    twist = chart._twist_points(0.1)
    assert {point.solver for point in twist} == {"pbd", "xpbd", "explicit", "direct"}
    for point in twist:
        assert point.case.overrides["distalEnd"] == "clamped" and "twistPerStep" not in point.case.overrides


def test_twist_of_gains_is_off_by_an_element_at_either_clamp() -> None:
    # Inner element j of n stands at (j - 1/2)/(n - 2) instead of (j + 1/2)/n: (n - 2 j - 1)/(n (n - 2)) apart.
    n = 30
    assert chart._pbd_twist_error(n) == pytest.approx((n - 5) / (n * (n - 2)), rel=1e-12)
