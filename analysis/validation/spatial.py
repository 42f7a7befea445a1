"""Rest shape in space of a curved rod that bends, twists, stretches and shears, under a dead force at its tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp

_TOLERANCE = 1e-8
_LOAD_STEPS = 6


@dataclass(frozen=True)
class CurvedRod:
    """A clamped rod of constant curvature, in the units of one's choice.

    Attributes
    ----------
    length : float
        L.
    curvature : float
        At rest, about d1; the rod leaves the origin along z and bends towards -y.
    bending, torsion, stretching, shearing : float
        EI, GJ, EA, GA.
    """

    length: float
    curvature: float
    bending: float
    torsion: float
    stretching: float
    shearing: float

    def tip(self, force: np.ndarray) -> np.ndarray:
        """Position of the tip, shape (3,), under a force of shape (3,) in fixed axes.

        State: place r, unit quaternion of the frame (w, x, y, z), couple m in fixed axes. r' = R (e3 + S^-1 R^T f),
        q' = q (0, k)/2 with k = k_rest + B^-1 R^T m, m' = -r' x f; r and q given at 0, m = 0 at the tip.
        """
        rest = np.array([self.curvature, 0.0, 0.0])
        bend = np.array([self.bending, self.bending, self.torsion])
        stretch = np.array([self.shearing, self.shearing, self.stretching])
        mesh = np.linspace(0.0, self.length, 41)
        half = 0.5 * self.curvature * mesh
        guess = np.zeros((10, mesh.size))
        guess[1] = (np.cos(2.0 * half) - 1.0) / self.curvature
        guess[2] = np.sin(2.0 * half) / self.curvature
        guess[3], guess[4] = np.cos(half), np.sin(half)
        for part in np.arange(1, _LOAD_STEPS + 1) / _LOAD_STEPS:
            pull = part * np.asarray(force, dtype=float)

            def slope(_: np.ndarray, y: np.ndarray, pull: np.ndarray = pull) -> np.ndarray:
                q, couple = y[3:7], y[7:10]
                axes = _rotations(q)  # (3, 3, k), columns d1, d2, d3
                strain = np.einsum("jik,j->ik", axes, pull) / stretch[:, None]
                strain[2] += 1.0
                tangent = np.einsum("ijk,jk->ik", axes, strain)
                turn = rest[:, None] + np.einsum("jik,jk->ik", axes, couple) / bend[:, None]
                return np.concatenate([tangent, 0.5 * _times_vector(q, turn), -np.cross(tangent.T, pull).T])

            def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
                return np.concatenate([a[:3], a[3:7] - [1.0, 0.0, 0.0, 0.0], b[7:10]])

            solution = solve_bvp(slope, ends, mesh, guess, tol=_TOLERANCE, max_nodes=100_000)
            if not solution.success:
                raise ArithmeticError(f"curved rod under {pull}: {solution.message}")
            mesh, guess = solution.x, solution.y
        return solution.y[:3, -1]


def _rotations(q: np.ndarray) -> np.ndarray:
    w, x, y, z = q
    return np.array([
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ])


def _times_vector(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """q (0, v) for shapes (4, k) and (3, k)."""
    w, x, y, z = q
    a, b, c = v
    return np.array([
        -x * a - y * b - z * c, w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a,
    ])
