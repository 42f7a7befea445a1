"""Motion of a pendulum: a rod on a ball joint at its first end, released from the horizontal under its own weight, in a
plane.

No couple acts at either end, so the slope's derivative vanishes there: the series is one of cosines.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from analysis.validation.plane_rod import PlaneRod
from analysis.validation.release import Release
from analysis.validation.wire import Wire


@lru_cache(maxsize=None)
def tip_motion(wire: Wire, gravity: float, duration: float, samples: int, modes: int = 6) -> Release:
    """Return the tip's motion; `across` is positive downwards.

    Parameters
    ----------
    wire : the rod.
    gravity : m/s^2.
    duration : s.
    samples : number of times, evenly from 0 to `duration`.
    modes : of the series in space, the rigid turn among them; more of them show how far it has converged.
    """
    system = pendulum(wire, gravity, modes)
    along, across = system.tip(system.motion(np.zeros(modes), np.linspace(0.0, duration / wire.time_unit, samples)))
    return Release(np.linspace(0.0, duration, samples), wire.length * along, wire.length * across)


def pendulum(wire: Wire, gravity: float, modes: int) -> PlaneRod:
    """Return the rod in a series of cosines."""
    waves = np.pi * np.arange(modes)

    def series(arc: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        phases = np.multiply.outer(arc, waves)
        return np.cos(phases), -waves * np.sin(phases)

    slender = wire.second_moment / (wire.area * wire.length**2)
    return PlaneRod(series, slender, wire.line_density * gravity * wire.length**3 / wire.bending)
