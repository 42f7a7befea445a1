"""The planar elastica of a clamped tip under a force, as a boundary value problem: independent of the simulation.

With the angle t of the cross-section, stretch e = F sin t/EA and shear g = F cos t/GA: t' = k + M/EI, M' = -F z',
y' = (1 + e) sin t + g cos t, z' = (1 + e) cos t - g sin t, t(0) = y(0) = z(0) = 0, M(l) = 0 and y(l) given; F is found.
Shear adds 1 % to the deflection of a short thick tip.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_bvp

from guidewire.benches.wire import Wire


class ElasticaError(Exception):
    """The boundary value problem has not converged. The message is one line."""


def load_at(wire: Wire, gauge: float, deflection: float) -> float:
    """Return the force (N) that displaces the tip across by deflection (m) from its rest; gauge (m) is free of the
    clamp.

    Each uniform piece is mapped to [0, 1], with its own four functions, continuous from piece to piece.

    Raises
    ------
    ElasticaError : there is no solution.
    """
    edges, bending, torsional, curvature = _pieces(wire, gauge)
    stretch, shear = wire.axial(bending)[:, None], wire.shear(torsional)[:, None]
    steps, count = np.diff(edges), len(bending)
    rest = _rest_shape(edges, curvature)
    load = 3.0 * deflection * bending.min() / gauge**3  # a measure of the force
    x = np.linspace(0.0, 1.0, 31)

    def slopes(_: np.ndarray, state: np.ndarray, unknown: np.ndarray) -> np.ndarray:
        angle, moment = state[0::4], state[1::4] * load * gauge
        sine, cosine, force = np.sin(angle), np.cos(angle), unknown[0] * load
        along, across = 1.0 + force * sine / stretch, force * cosine / shear
        slope = np.empty_like(state)
        slope[0::4] = curvature[:, None] + moment / bending[:, None]
        slope[2::4], slope[3::4] = along * sine + across * cosine, along * cosine - across * sine
        slope[1::4] = -unknown[0] * slope[3::4] / gauge
        return slope * np.repeat(steps, 4)[:, None]

    def ends(first: np.ndarray, last: np.ndarray, unknown: np.ndarray) -> np.ndarray:
        tip = [last[-3], last[-2] - rest[1, -1] - deflection]
        return np.concatenate([[first[0], first[2], first[3]], first[4:] - last[:-4], tip])

    guess = np.empty((4 * count, len(x)))
    for k in range(count):
        here = edges[k] + steps[k] * x
        guess[4 * k] = rest[0, k] + curvature[k] * steps[k] * x
        guess[4 * k + 1] = 1.0 - here / gauge
        guess[4 * k + 2] = rest[1, k] + (rest[1, k + 1] - rest[1, k]) * x
        guess[4 * k + 3] = rest[2, k] + (rest[2, k + 1] - rest[2, k]) * x
    solution = solve_bvp(slopes, ends, x, guess, p=[1.0], tol=1e-5, max_nodes=2000)
    if not solution.success:
        raise ElasticaError(f"the boundary value problem of the tip has no solution: {solution.message}")
    return float(solution.p[0]) * load


def rest_tip(wire: Wire, gauge: float) -> np.ndarray:
    """Say where the unloaded tip stands, (y, z) in m from the clamp."""
    return rest_shape(wire, gauge)[:, -1]


def rest_shape(wire: Wire, gauge: float, points: int = 401) -> np.ndarray:
    """Return the unloaded shape of the last gauge (m) of a wire, (2, k): y and z in m from its first point."""
    edges, _, _, curvature = _pieces(wire, gauge)
    fine = np.unique(np.concatenate([edges, np.linspace(0.0, gauge, points)]))
    pieces = np.clip(np.searchsorted(edges, 0.5 * (fine[1:] + fine[:-1])) - 1, 0, len(curvature) - 1)
    return _rest_shape(fine, curvature[pieces])[1:]


def _pieces(wire: Wire, gauge: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Edges (k + 1,) from the clamp in m, EI and GJ (k,) and rest curvature (k,) in the plane of the bends."""
    start = wire.length - gauge
    inner = wire.ends[(wire.ends > start + 1e-9) & (wire.ends < wire.length - 1e-9)]
    edges = np.concatenate([[start], inner, [wire.length]])
    middle = 0.5 * (edges[1:] + edges[:-1])
    return edges - start, wire.stiffness(middle), wire.torsional_stiffness(middle), -wire.rest_curvature(middle)


def _rest_shape(mesh: np.ndarray, curvature: np.ndarray) -> np.ndarray:
    """Angle, y and z (3, k) of a chain of arcs with these curvatures."""
    steps = np.diff(mesh)
    angle = np.concatenate([[0.0], np.cumsum(curvature * steps)])
    middle = 0.5 * (angle[1:] + angle[:-1])
    chord = steps * np.sinc(0.5 * curvature * steps / np.pi)
    return np.vstack([angle, np.concatenate([[0.0], np.cumsum(chord * np.sin(middle))]),
                      np.concatenate([[0.0], np.cumsum(chord * np.cos(middle))])])
