"""Rest shapes in a plane of a rod that bends and neither stretches nor shears (Euler's elastica).

A clamp at s = 0 holds the rod along the first axis. With the angle t(s) against that axis, EI t'' = -q(s) cos t, where
q(s) is the force across that the part beyond s carries; t(0) = 0, and t'(L) = 0 at a tip without a couple.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp

_TOLERANCE = 1e-10  # relative residual of the boundary value problem
_STEP = 4.0  # largest growth of the load between two problems, each the guess of the next


@dataclass(frozen=True)
class PlaneShape:
    """A curve in a plane, in units of its length.

    Attributes
    ----------
    arc : (k,), s/L, ascending from 0 to 1.
    along, across : (k,), coordinates over L along the clamp's axis and in the direction in which the load acts.
    angle : (k,), of the tangent against the clamp's axis, rad.
    """

    arc: np.ndarray
    along: np.ndarray
    across: np.ndarray
    angle: np.ndarray

    @property
    def tip(self) -> tuple[float, float]:
        """Coordinates of the free end over L, along and across."""
        return float(self.along[-1]), float(self.across[-1])


def tip_loaded(load: float, points: np.ndarray) -> PlaneShape:
    """Under a dead force F across at the tip.

    Parameters
    ----------
    load : k = F L^2/EI.
    points : s/L at which the shape is wanted, ascending from 0 to 1.
    """
    return _solve(lambda s: np.ones_like(s), load, points)


def heavy(load: float, points: np.ndarray) -> PlaneShape:
    """Under its own weight w per length, across.

    Parameters
    ----------
    load : w L^3/EI.
    points : s/L, ascending from 0 to 1.
    """
    return _solve(lambda s: 1.0 - s, load, points)


def heavy_on_plane(load: float, drop: float, points: np.ndarray) -> tuple[PlaneShape, float]:
    """Under its own weight, with the tip on a frictionless plane along the clamp's axis.

    Parameters
    ----------
    load : w L^3/EI.
    drop : of the plane below the clamp over L, less than the free tip's.
    points : s/L, ascending from 0 to 1.

    Returns
    -------
    (shape, force) : force of the plane on the tip over EI/L^2. The tip alone touches where the force is so small that
    the rod still comes down to the plane at an angle.
    """

    def slope(s: np.ndarray, y: np.ndarray, force: np.ndarray) -> np.ndarray:
        return np.stack([y[1], -(load * (1.0 - s) - force[0]) * np.cos(y[0]), np.cos(y[0]), np.sin(y[0])])

    def ends(a: np.ndarray, b: np.ndarray, force: np.ndarray) -> np.ndarray:
        return np.array([a[0], a[2], a[3], b[1], b[3] - drop])

    mesh = np.linspace(0.0, 1.0, 41)
    free = heavy(load, mesh)
    if not 0.0 < drop < free.tip[1]:
        raise ValueError(f"the free tip comes down by {free.tip[1]}, the plane lies {drop} below")
    guess = np.stack([free.angle, np.gradient(free.angle, mesh), free.along, free.across])
    solution = solve_bvp(slope, ends, mesh, guess, p=np.array([0.0]), tol=_TOLERANCE, max_nodes=100_000)
    if not solution.success:
        raise ArithmeticError(f"elastica on a plane: {solution.message}")
    angle, _, along, across = solution.sol(points)
    return PlaneShape(points, along, across, angle), float(solution.p[0])


def _solve(carried: Callable[[np.ndarray], np.ndarray], load: float, points: np.ndarray) -> PlaneShape:
    """Return the shape under `load` times `carried`, from an unloaded rod through growing loads."""
    mesh = np.linspace(0.0, 1.0, 41)
    guess = np.zeros((4, mesh.size))
    guess[2] = mesh
    current = min(load, 1.0)
    while True:

        def slope(s: np.ndarray, y: np.ndarray, q: float = current) -> np.ndarray:
            return np.stack([y[1], -q * carried(s) * np.cos(y[0]), np.cos(y[0]), np.sin(y[0])])

        def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
            return np.array([a[0], a[2], a[3], b[1]])

        solution = solve_bvp(slope, ends, mesh, guess, tol=_TOLERANCE, max_nodes=100_000)
        if not solution.success:
            raise ArithmeticError(f"elastica under the load {current}: {solution.message}")
        if current == load:
            break
        mesh, guess = solution.x, solution.y
        current = min(load, _STEP * current)
    angle, _, along, across = solution.sol(points)
    return PlaneShape(points, along, across, angle)
