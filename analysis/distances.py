"""Distances between two runs: sphere by sphere at the same arc length, over the run at the same time or step.

Where no closed form says where a sphere should be, the thesis measures the distance to a reference run (section 4.2).
Runs with different n have their spheres at different arc lengths s_i = i L/n, so the reference is interpolated
linearly along its elements, which are straight.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from guidewire.logs.logs import PositionLog
from guidewire.logs.runs import Run

_SAME = 1e-9  # relative difference up to which two times or lengths, computed differently, are the same


class DistanceError(Exception):
    """Two runs that cannot be compared. The message is one line."""


@dataclass(frozen=True)
class Trajectory:
    """A wire over time.

    Attributes
    ----------
    steps : (k,) of int, ascending.
    time : (k,), in-game time in s, ascending.
    arc_length : (s,), of each sphere, from the first one along the undeformed wire, in units, ascending.
    positions : (k, s, 3), in units.
    """

    steps: np.ndarray
    time: np.ndarray
    arc_length: np.ndarray
    positions: np.ndarray


@dataclass(frozen=True)
class Distances:
    """Distance of a run's spheres to a reference, at the moments that both have.

    Attributes
    ----------
    steps : (k,) of int, steps of the run.
    time : (k,), in-game time of the run, in s.
    arc_length : (s,), of the run's spheres, in units.
    values : (k, s), in units.
    """

    steps: np.ndarray
    time: np.ndarray
    arc_length: np.ndarray
    values: np.ndarray

    @property
    def final(self) -> np.ndarray:
        """Distance of each sphere at the last moment that both runs have, shape (s,), in units."""
        return self.values[-1]

    @property
    def mean(self) -> float:
        """Mean over the spheres and the moments, in units."""
        return float(self.values.mean())


def trajectory(run: Run, log: PositionLog) -> Trajectory:
    """Return a run's log with the arc length of its spheres."""
    spacing = run.number("guidewireLength") / run.number("numberRodElements")
    return Trajectory(log.steps, log.time, log.spheres * spacing, log.positions)


def at_arc_length(positions: np.ndarray, arc_length: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Return points of a wire at given arc lengths, linear along its elements.

    Parameters
    ----------
    positions : (..., s, 3), in units.
    arc_length : (s,), of these spheres, ascending, in units.
    wanted : (q,), in units, within the wire.

    Returns
    -------
    ndarray, shape (..., q, 3)
        In units.

    Raises
    ------
    DistanceError : an arc length beyond the ends.
    """
    slack = _SAME * max(abs(arc_length[0]), abs(arc_length[-1]))
    if np.min(wanted) < arc_length[0] - slack or np.max(wanted) > arc_length[-1] + slack:
        raise DistanceError(
            f"arc lengths {np.min(wanted):g} to {np.max(wanted):g} are not all within the logged wire, from "
            f"{arc_length[0]:g} to {arc_length[-1]:g} units"
        )
    return _interpolate(positions, arc_length, wanted, axis=positions.ndim - 2)


def distances(run: Trajectory, reference: Trajectory, match: str = "time") -> Distances:
    """Distance of each sphere of a run to the reference at the same arc length.

    Parameters
    ----------
    run, reference : the runs to compare.
    match : "time" or "step": compare at the same in-game time (the reference is interpolated linearly between its
        steps) or at the same step number.

    Raises
    ------
    DistanceError : the two have no moment in common, or the run has spheres beyond the reference's ends.
    """
    if match == "time":
        end = reference.time[-1] + _SAME * max(abs(reference.time[-1]), abs(run.time[-1]))
        shared = np.flatnonzero((run.time >= reference.time[0]) & (run.time <= end))
        if shared.size == 0:
            raise DistanceError("the runs have no in-game time in common")
        moments = _interpolate(reference.positions, reference.time, run.time[shared], axis=0)
    elif match == "step":
        _, shared, there = np.intersect1d(run.steps, reference.steps, return_indices=True)
        if shared.size == 0:
            raise DistanceError("the runs have no step in common")
        moments = reference.positions[there]
    else:
        raise ValueError(f"match = {match!r}: must be 'time' or 'step'")
    expected = at_arc_length(moments, reference.arc_length, run.arc_length)
    values = np.linalg.norm(run.positions[shared] - expected, axis=-1)
    return Distances(run.steps[shared], run.time[shared], run.arc_length, values)


def _interpolate(values: np.ndarray, known: np.ndarray, wanted: np.ndarray, axis: int) -> np.ndarray:
    """Linear along one axis; beyond the ends the end value."""
    if known.size == 1:
        return np.repeat(values, wanted.size, axis=axis)
    right = np.clip(np.searchsorted(known, wanted), 1, known.size - 1)
    fraction = np.clip((wanted - known[right - 1]) / (known[right] - known[right - 1]), 0.0, 1.0)
    shape = [1] * values.ndim
    shape[axis] = wanted.size
    fraction = fraction.reshape(shape)
    return (1.0 - fraction) * np.take(values, right - 1, axis=axis) + fraction * np.take(values, right, axis=axis)
