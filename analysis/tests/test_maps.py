"""Maps of outcomes: what class a run is of, and what the figure draws and says."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.figures import maps, wire_maps
from analysis.figures.maps import VIEWS, drag_error, kind_of, read_map
from analysis.tests.outcomes import SUMMARY
from analysis.twist import Twist
from guidewire.logs.runs import Run
from guidewire.studies.maps import MAPS
from guidewire.studies.quick import shortened
from guidewire.studies.table import Grid
from guidewire.studies.wire_maps import WIRE_MAPS


@pytest.mark.parametrize("changed, error, kind", [
    ({}, 0.05, "finished"), ({}, 0.2, "inaccurate"), ({"maxPenetration": 1.5}, 0.2, "penetrating"),
    ({"passages": 1, "maxPenetration": 9.0}, 0.0, "passed a wall"), ({"outcome": "failed"}, math.nan, "failed"),
    ({"outcome": "diverged", "passages": 3}, math.nan, "diverged"), ({"outcome": "converged"}, 0.0, "converged"),
    ({"solver": {"stepsNotConverged": 2}}, 0.0, "not converged"),
])
def test_a_run_is_of_the_worst_class_that_it_can_be(changed: dict, error: float, kind: str) -> None:
    assert kind_of(Run(Path(), {"sphereRadius": 5.0}, {**SUMMARY, **changed}), error) == kind


def test_the_figure_draws_every_run_and_says_what_holds(drawn: dict[str, tuple[Figure, str]]) -> None:
    figure, caption = drawn["maps"]
    for axes, study in zip(figure.axes, MAPS):
        assert len([line for line in axes.lines if line.get_linestyle() == "None"]) == study.grid.count, study.name
    assert "xpbd holds from 50 substeps with m = 1" in caption
    assert "darboux: 3.25 holds, 1 does not" in caption and "rotationVector: 3.25 holds" in caption


def test_errors_are_measured_against_the_run_that_is_the_reference(studies: dict[str, Path]) -> None:
    cells = read_map(next(view for view in VIEWS if view.study == "map-heavy-tip"), studies["map-heavy-tip"])
    assert [cell.error for cell in cells if cell.y == "direct"] == [0.0] * 4
    assert cells[1].error == pytest.approx(0.001 / 10.0)


def test_a_fall_that_is_damped_between_steps_is_too_fast_by_the_closed_form() -> None:
    """By doing the steps: v -> (v + g h) e^(-a h), and the way with v + g h."""
    for drag in (0.1, 1.0, 10.0):
        speed = 0.0
        for _ in range(2000):
            moved = speed + 1.0
            speed = moved * math.exp(-drag)
        assert moved / (1.0 / drag) - 1.0 == pytest.approx(drag_error(drag), rel=1e-9)
    assert drag_error(maps._DRAG_LIMIT) == pytest.approx(maps.INACCURATE, rel=1e-3)


@pytest.mark.parametrize("short", [False, True])
def test_every_map_has_the_runs_that_others_are_measured_against(short: bool) -> None:
    of_wires = [study for study in WIRE_MAPS if isinstance(study.grid, Grid)]
    for view, study in zip((*VIEWS, *wire_maps.VIEWS), (*MAPS, *of_wires)):
        assert view.study == study.name
        cases = (shortened(study) if short else study).grid.cases()
        for case in cases if view.reference is not None else ():
            run = Run(Path(), case.overrides, None, case.key, None, case.variant, case.values)
            assert view.reference(run) in {other.key for other in cases}, study.name


@pytest.mark.long("its axes and its caption are drawn and read")
def test_the_figure_of_a_wire_draws_every_run_and_says_what_holds(
    drawn: dict[str, tuple[Figure, str]]
) -> None:
    figure, caption = drawn["maps-wire"]
    for axes, study in zip(figure.axes, wire_maps.STUDIES[:-1]):
        count = next(one.grid.count for one in WIRE_MAPS if one.name == study)
        assert len([line for line in axes.lines if line.get_linestyle() == "None"]) == count, study
    assert [label.get_text() for label in figure.axes[0].get_yticklabels()] == ["6", "12", "24", "48"]
    assert "direct 70.0 to 100, xpbd 70.0 to 100, explicit 70.0 to 100 rad/m" in caption
    assert "bisections (circles) are within 0.093 %" in caption    # 4.305, the chain has 4.3010


def test_a_turn_is_lost_where_the_wire_springs_by_a_whole_one() -> None:
    base = np.array([0.0, 3.0, 6.0, 9.0])
    behind = np.array([0.0, 2.5, 5.0, 7.4])
    for lost in (False, True):
        tip = base - behind + lost * np.array([0.0, 0.0, 0.0, 2.0 * math.pi])
        assert wire_maps.lost_turn(Twist(np.arange(4), base, tip, np.zeros(4))) is lost


def test_one_mode_by_implicit_euler_is_off_as_its_steps_say() -> None:
    """Its 16 steps done one by one, and the fall of a damped mode, 1 - exp(-s t) (cos w t + s/w sin w t)."""
    x, v, h = 0.0, 0.0, 0.25
    for _ in range(16):
        x, v = np.linalg.solve([[1.0, -h], [h, 1.0 + 0.3 * h]], [x, v + h])
    s = 0.5 * 0.3
    w = math.sqrt(1.0 - s * s)
    exact = 1.0 - math.exp(-s * 4.0) * (math.cos(w * 4.0) + s / w * math.sin(w * 4.0))
    assert wire_maps.euler_error(0.3, h, 4.0) == pytest.approx(abs(x / exact - 1.0), rel=1e-9)


def test_a_straight_twisted_wire_between_clamps_bends_where_its_linear_equation_has_a_shape() -> None:
    """The deflection z = x + i y of a wire under the couple M obeys EI z(4) = i M z(3): 1, s, s^2 and exp(i m s) with
    m = M L/EI, of which a sum has no value and no slope at both ends where a determinant is 0."""
    def determinant(m: float) -> float:
        e = np.exp(1j * m)
        return abs(np.linalg.det([[1, 0, 0, 1], [0, 1, 0, 1j * m], [1, 1, 1, e], [0, 1, 2, 1j * m * e]]))

    moments = np.linspace(5.0, 12.0, 7001)
    found = moments[np.argmin([determinant(m) for m in moments])]
    assert found == pytest.approx(wire_maps.GREENHILL, abs=2e-3)
