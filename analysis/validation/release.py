"""Free motion of a cantilever released from its rest shape under a tip load, geometrically exact, in a plane.

The series is that of the slopes of the linear modes (`PlaneRod`), with e = I/(A L^2) (1 + E/kG): the rotary inertia
and, as its second part, the shear, k its factor. To first order in I/(A L^2) shear lowers a cantilever's frequencies as
E/kG more rotary inertia does, because the mode's third derivative is the slope of the mode turned end for end, so that
the integrals of (w''')^2 and beta^4 (w')^2 are equal.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from analysis.validation.beam import mode_numbers, mode_shape
from analysis.validation.plane_rod import PlaneRod
from analysis.validation.wire import Wire


@dataclass(frozen=True)
class Release:
    """Motion of the tip.

    Attributes
    ----------
    time : (k,), in s.
    along, across : (k,), the tip's coordinates, m; across is positive where the load pulled.
    """

    time: np.ndarray
    along: np.ndarray
    across: np.ndarray


@lru_cache(maxsize=None)
def tip_motion(wire: Wire, load: float, duration: float, samples: int, modes: int = 12) -> Release:
    """The tip's motion after the load is taken off at time 0.

    Parameters
    ----------
    wire : the rod.
    load : F L^2/EI that held it before.
    duration : s.
    samples : number of times, evenly from 0 to `duration`.
    modes : of the series in space; more of them show how far it has converged.
    """
    slender = wire.second_moment / (wire.area * wire.length**2)
    system = cantilever(modes, slender * (1.0 + wire.youngs_modulus / (wire.shear_factor * wire.shear_modulus)))
    times = np.linspace(0.0, duration / wire.time_unit, samples)
    along, across = system.tip(system.motion(system.rest(load), times))
    return Release(np.linspace(0.0, duration, samples), wire.length * along, wire.length * across)


def cantilever(modes: int, rotary_inertia: float) -> PlaneRod:
    """Return a rod that is clamped at its first end, in the slopes of so many linear modes."""
    numbers = mode_numbers(modes)

    def series(arc: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        # Slopes scaled to about 1; the second derivative is the curvature.
        return tuple(np.stack([mode_shape(b, arc, order) / (2.0 * b) for b in numbers], axis=1) for order in (1, 2))

    return PlaneRod(series, rotary_inertia)
