"""Studies in short: the first, a middle and the last value of each axis, of a bisection the first and a middle one and
two variants; one timed repeat at most, a tenth of the in-game time, a quarter of a reference's iterations. Enough to
draw every figure, too little to read one off."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from guidewire.studies.bisection import Bisection
from guidewire.studies.table import Axis, Grid, Rows, Study

_BISECTED_VARIANTS = 2
_DURATION = 0.1  # of that of the study
_MANY = 1000  # iterations a step, from which a quarter is made


def shortened(study: Study) -> Study:
    """Return the study in short; it has the same name."""
    table = study.grid
    if isinstance(table, Bisection):
        variants = dict(list(table.grid.variants.items())[:_BISECTED_VARIANTS])
        return replace(study, grid=replace(table, grid=replace(_thinned(table.grid, last=False), variants=variants)))
    return replace(study, grid=_thinned(table)) if isinstance(table, Grid) else study


def _thinned(grid: Grid, last: bool = True) -> Grid:
    duration = None if grid.duration is None else _DURATION * grid.duration
    variants = {name: _with_fewer_iterations(own) for name, own in grid.variants.items()}
    axes = tuple(_thinned_axis(axis, last) for axis in grid.axes)
    return replace(grid, axes=axes, common=_with_fewer_iterations(grid.common), variants=variants,
                   repeats=min(1, grid.repeats), duration=duration)


def _thinned_axis(axis: Axis | Rows, last: bool) -> Axis | Rows:
    if isinstance(axis, Rows) or len(axis.values) <= (3 if last else 2):
        return axis
    kept = (axis.values[0], axis.values[len(axis.values) // 2], axis.values[-1])
    return Axis(axis.key, kept if last else kept[:2])


def _with_fewer_iterations(overrides: Mapping[str, Any]) -> Mapping[str, Any]:
    iterations = overrides.get("constraintSolverSteps", 0)
    return overrides if iterations < _MANY else {**overrides, "constraintSolverSteps": iterations // 4}
