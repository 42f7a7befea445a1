"""Distances between runs: against wires whose distance is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from analysis.distances import DistanceError, Trajectory, at_arc_length, distances, trajectory
from analysis.tests.chain import Chain
from guidewire.logs.logs import read_log
from guidewire.logs.runs import read_run

LENGTH = 12.0  # units
RATE = np.array([0.1, -0.2, 0.3])  # units/s


def wire(elements: int, time_step: float, steps: int, shift: tuple[float, ...] = (0.0, 0.0, 0.0)) -> Trajectory:
    """A straight wire along z that drifts at RATE: linear in arc length and in time, so interpolation is exact."""
    arc = LENGTH * np.arange(elements + 1) / elements
    time = time_step * np.arange(steps + 1)
    positions = np.zeros((steps + 1, elements + 1, 3))
    positions[..., 2] = arc
    positions += time[:, None, None] * RATE + np.array(shift)
    return Trajectory(np.arange(steps + 1), time, arc, positions)


@pytest.mark.parametrize(("elements", "time_step"), [(4, 0.5), (3, 0.5), (7, 0.3), (24, 0.05)])
def test_same_wire_in_other_elements_and_steps_has_no_distance(elements: int, time_step: float) -> None:
    found = distances(wire(elements, time_step, 10), wire(24, 0.05, 100))
    assert found.values.shape == (11, elements + 1)
    np.testing.assert_allclose(found.values, 0.0, atol=1e-14)


def test_shifted_wire_is_at_the_shift(tmp_path: Path) -> None:
    found = distances(wire(4, 0.5, 10, shift=(3.0, 0.0, 4.0)), wire(24, 0.05, 100))
    np.testing.assert_allclose(found.final, 5.0, rtol=1e-14)
    np.testing.assert_allclose(found.values.mean(axis=1), 5.0, rtol=1e-14)
    assert found.mean == pytest.approx(5.0, rel=1e-14)
    np.testing.assert_allclose(found.arc_length, [0.0, 3.0, 6.0, 9.0, 12.0])


def test_equal_step_number_is_another_moment_than_equal_time() -> None:
    """At step k a run of half the step has drifted half as long: k dt/2 |RATE| apart."""
    run, reference = wire(4, 0.5, 10), wire(4, 0.25, 20)
    found = distances(run, reference, match="step")
    np.testing.assert_array_equal(found.steps, np.arange(11))
    expected = np.arange(11) * 0.25 * np.linalg.norm(RATE)
    np.testing.assert_allclose(found.values.mean(axis=1), expected, atol=1e-14)
    np.testing.assert_allclose(distances(run, reference, match="time").values, 0.0, atol=1e-14)


def test_thinned_logs_are_compared_where_both_have_a_step() -> None:
    def thinned(whole: Trajectory, every: int) -> Trajectory:
        return Trajectory(whole.steps[::every], whole.time[::every], whole.arc_length, whole.positions[::every])

    found = distances(thinned(wire(4, 0.5, 12), 3), thinned(wire(6, 0.5, 12, shift=(1.0, 0.0, 0.0)), 2), match="step")
    np.testing.assert_array_equal(found.steps, [0, 6, 12])
    np.testing.assert_allclose(found.values, 1.0, rtol=1e-14)


def test_only_moments_that_both_runs_have_are_compared() -> None:
    found = distances(wire(4, 0.5, 10), wire(4, 0.5, 6))
    np.testing.assert_array_equal(found.steps, np.arange(7))
    found = distances(wire(4, 0.1, 3), wire(4, 0.1 / 3, 9))  # 3 * 0.1 and 9 * 0.1/3 differ in their last digit
    np.testing.assert_array_equal(found.steps, np.arange(4))
    late = wire(4, 0.5, 10)
    late = Trajectory(late.steps + 100, late.time + 50.0, late.arc_length, late.positions)
    with pytest.raises(DistanceError, match="no in-game time in common"):
        distances(late, wire(4, 0.5, 10))
    with pytest.raises(DistanceError, match="no step in common"):
        distances(late, wire(4, 0.5, 10), match="step")
    with pytest.raises(ValueError, match="must be 'time' or 'step'"):
        distances(late, late, match="distance")


def test_points_of_a_bent_wire_lie_on_its_elements() -> None:
    corner = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, 2.0, 2.0]])
    points = at_arc_length(corner, np.array([0.0, 2.0, 4.0]), np.array([0.0, 0.5, 2.0, 3.5, 4.0]))
    np.testing.assert_allclose(points, [[0, 0, 0], [0, 0, 0.5], [0, 0, 2], [0, 1.5, 2], [0, 2, 2]], atol=1e-15)


def test_a_longer_wire_cannot_be_compared() -> None:
    reference = wire(4, 0.5, 2)
    longer = Trajectory(reference.steps, reference.time, reference.arc_length * 1.01, reference.positions)
    with pytest.raises(DistanceError, match="not all within the logged wire"):
        distances(longer, reference)


def test_reference_may_know_its_last_sphere_alone_only_for_the_last_sphere() -> None:
    run, reference = wire(4, 0.5, 2), wire(4, 0.5, 2)
    tip = Trajectory(reference.steps, reference.time, reference.arc_length[-1:], reference.positions[:, -1:])
    with pytest.raises(DistanceError, match="not all within the logged wire"):
        distances(run, tip)
    own_tip = Trajectory(run.steps, run.time, run.arc_length[-1:], run.positions[:, -1:] + 1.0)
    np.testing.assert_allclose(distances(own_tip, tip).values, 3.0**0.5)


def test_runs_are_compared_from_their_folders(tmp_path: Path) -> None:
    """Positions step by step do not depend on dt: equal step numbers are at no distance, equal times are."""
    read = {}
    for name, time_step in (("coarse", 0.01), ("fine", 0.005)):
        chain = Chain(constraint_solver_steps=20, elements=5, most_steps=40, time_step=time_step)
        folder = chain.write(tmp_path / name)
        read[name] = trajectory(read_run(folder), read_log(folder, spheres="all"))
    np.testing.assert_allclose(read["fine"].arc_length, [0, 60, 120, 180, 240, 300])
    assert distances(read["coarse"], read["fine"], match="step").mean == 0.0
    by_time = distances(read["coarse"], read["fine"])
    assert by_time.time[-1] == pytest.approx(0.2) and by_time.mean > 0.1
