"""Relaxation times of the thesis's longitudinal study, from study to log to fit, against an independent program's."""

import dataclasses

import pytest

from analysis.tables import read_table
from experiments.sweep import Means, sweep
from studies.builtin import STUDIES
from studies.table import Axis, Grid

# tau in s; from another double-precision implementation of the thesis's method, to the digits it printed.
TAU = {
    "constraint-solver-steps": {100: 1.548, 300: 0.504, 500: 0.297, 1000: 0.148},
    "rod-elements": {10: 0.092, 30: 0.297, 40: 0.520},
    "total-mass": {0.01: 0.297, 0.1: 0.478, 1.0: 2.34},
    "displacement": {1: 0.297, 10: 0.297, 100: 0.297},
    # Step by step the method does not contain dt, so tau is the same number of steps: 29.7.
    "time-step": {1e-4: 0.00297, 1e-2: 0.297, 1e-1: 2.97},
}


@pytest.mark.parametrize("name", TAU)
def test_tau_is_that_of_an_independent_program(runner_command, tmp_path, name):
    (axis,) = STUDIES[name].grid.axes
    study = dataclasses.replace(STUDIES[name], grid=Grid((Axis(axis.key, tuple(TAU[name])),)))
    result = sweep([(study, tmp_path)], tmp_path / "runs", Means(runner_command, 2))
    assert result.failures == []
    table = read_table(tmp_path / name, axis.key)
    assert {row.run.outcome for row in table.rows} == {"converged"}
    for row in table.rows:
        assert row.relaxation.time == pytest.approx(TAU[name][row.value], rel=0.01), row.value
