"""Relaxation times of the thesis's longitudinal study, from study to log to fit, against an independent program's."""

import dataclasses

import pytest

from analysis.tables import read_table
from guidewire.studies.builtin import STUDIES
from guidewire.studies.table import Axis, Grid
from guidewire.sweeps.sweep import Means, sweep

# tau in s; from another double-precision implementation of the thesis's method, to the digits it printed.
TAU = {
    "constraint-solver-steps": {100: 1.548, 300: 0.504, 500: 0.297, 1000: 0.148},
    "rod-elements": {10: 0.092, 30: 0.297, 40: 0.520},
    "total-mass": {0.01: 0.297, 0.1: 0.478, 1.0: 2.34},
    "displacement": {1: 0.297, 10: 0.297, 100: 0.297},
    # Step by step the method does not contain dt, so tau is the same number of steps: 29.7.
    "time-step": {1e-4: 0.00297, 1e-2: 0.297, 1e-1: 2.97},
}


@pytest.fixture(scope="module")
def made(runner_command, tmp_path_factory):
    """Folder of all studies, made at once: they share the run of Table 4.1."""
    folder = tmp_path_factory.mktemp("thesis")
    studies = [dataclasses.replace(STUDIES[name], grid=Grid((Axis(key_of(name), tuple(values)),)))
               for name, values in TAU.items()]
    assert sweep([(study, folder) for study in studies], folder / "runs", Means(runner_command)).failures == []
    return folder


def key_of(name):
    (axis,) = STUDIES[name].grid.axes
    return axis.key


@pytest.mark.parametrize("name", TAU)
@pytest.mark.few(1)
def test_tau_is_that_of_an_independent_program(made, name):
    table = read_table(made / name, key_of(name))
    assert {row.run.outcome for row in table.rows} == {"converged"}
    for row in table.rows:
        assert row.relaxation.time == pytest.approx(TAU[name][row.value], rel=0.01), row.value
