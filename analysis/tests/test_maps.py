"""Maps of outcomes: what class a run is of, and what the figure draws and says."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from analysis.figures import FIGURES, maps
from analysis.figures.maps import VIEWS, drag_error, kind_of, read_map
from analysis.runs import Run
from analysis.tests.outcomes import SUMMARY
from studies.maps import MAPS
from studies.quick import shortened


@pytest.mark.parametrize("changed, error, kind", [
    ({}, 0.05, "finished"), ({}, 0.2, "inaccurate"), ({"maxPenetration": 1.5}, 0.2, "penetrating"),
    ({"passages": 1, "maxPenetration": 9.0}, 0.0, "passed a wall"), ({"outcome": "failed"}, math.nan, "failed"),
    ({"outcome": "diverged", "passages": 3}, math.nan, "diverged"), ({"outcome": "converged"}, 0.0, "converged"),
    ({"solver": {"stepsNotConverged": 2}}, 0.0, "not converged"),
])
def test_a_run_is_of_the_worst_class_that_it_can_be(changed: dict, error: float, kind: str) -> None:
    assert kind_of(Run(Path(), {"sphereRadius": 5.0}, {**SUMMARY, **changed}), error) == kind


def test_the_figure_draws_every_run_and_says_what_holds(studies: dict[str, Path]) -> None:
    figure, caption = FIGURES["maps"].draw(studies)
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
    for view, study in zip(VIEWS, MAPS):
        cases = (shortened(study) if short else study).grid.cases()
        for case in cases if view.reference is not None else ():
            run = Run(Path(), case.overrides, None, case.key, None, case.variant, case.values)
            assert view.reference(run) in {other.key for other in cases}, study.name
