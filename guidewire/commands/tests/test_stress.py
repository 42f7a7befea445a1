"""Logs with stress are read whole, and what is drawn of them shows every element and entry."""

from __future__ import annotations

import numpy as np
import pytest

from analysis.tests.chain import write_log
from guidewire.figures.stress import draw_stress
from guidewire.logs.logs import LogError
from guidewire.logs.stress import read_stress

N, ENTRIES = 5, 4


def _write(folder, with_stress=True):
    stresses = [{"stress": {
        "kineticEnergy": 1.0 * k, "elasticEnergy": 2.0, "potentialEnergy": -1.0 * k,
        "curvature": [[3.0 * k, 4.0 * k, 0.5]] * (N + 1), "couple": [[0.0, 0.0, 0.1 * i] for i in range(N + 1)],
        "strain": [[0.0, 0.0, 1e-3]] * N, "force": [[0.0, 1.0 * j, 0.0] for j in range(N)],
        "angularVelocities": [[0.0, 0.0, 7.0]] * N}} for k in range(ENTRIES)]
    write_log(folder, [[(0.0, 0.1 * k * i * i, 2.0 * i) for i in range(N + 1)] for k in range(ENTRIES)], 0.1,
              stresses if with_stress else ())


def test_a_log_with_stress_is_read_whole(tmp_path):
    _write(tmp_path)
    log = read_stress(tmp_path)
    assert log.curvature.shape == log.couple.shape == log.positions.shape == (ENTRIES, N + 1, 3)
    assert log.strain.shape == log.force.shape == log.angular_velocity.shape == (ENTRIES, N, 3)
    assert log.bending[2] == pytest.approx(np.full(N + 1, 10.0))  # (6, 8)
    assert log.arc_length == pytest.approx(2.0 * np.arange(N + 1))
    assert log.energy.sum(axis=1) == pytest.approx(np.full(ENTRIES, 2.0))
    assert read_stress(tmp_path, every=2).time == pytest.approx([0.0, 0.2])


def test_a_log_without_stress_is_refused(tmp_path):
    _write(tmp_path, with_stress=False)
    with pytest.raises(LogError, match="logStrains"):
        read_stress(tmp_path)


def test_the_figure_shows_each_element_joint_and_entry(tmp_path):
    _write(tmp_path)
    figure = draw_stress(read_stress(tmp_path))
    shape, energy, force, couple = figure.axes[:4]
    assert len(shape.collections[0].get_segments()) == N
    assert [line.get_label() for line in energy.lines] == ["kinetic", "elastic", "potential", "sum"]
    assert force.collections[0].get_array().size == N * ENTRIES
    assert couple.collections[0].get_array().size == (N + 1) * ENTRIES
    assert {axes.get_ylabel() for axes in figure.axes} >= {"energy (J)", "arc length (units)", "force (N)",
                                                          "couple (N m)", "curvature (rad/m)"}
