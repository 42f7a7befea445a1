"""Rest shape in space of a rod that bends, twists, stretches and shears, under a dead force at its tip and a couple
that turns with the tip."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp

from analysis.validation.wire import Wire

_TOLERANCE = 1e-8
_LOAD_STEPS = 6


@dataclass(frozen=True)
class CurvedRod:
    """A clamped rod of constant curvature, straight at 0, in the units of one's choice.

    Attributes
    ----------
    length : L.
    curvature : at rest, about d1; the rod leaves the origin along z and bends towards -y.
    bending, torsion, stretching, shearing : EI, GJ, EA, GA.
    """

    length: float
    curvature: float
    bending: float
    torsion: float
    stretching: float
    shearing: float

    def tip(self, force: np.ndarray, couple: np.ndarray | None = None) -> np.ndarray:
        """Position of the tip, shape (3,), under a force of shape (3,) in fixed axes and a couple of shape (3,) along
        the tip's own axes.

        State: place r, unit quaternion of the frame (w, x, y, z), couple m in fixed axes. r' = R (e3 + S^-1 R^T f),
        q' = q (0, k)/2 with k = k_rest + B^-1 R^T m, m' = -r' x f; r and q given at 0, R^T m at the tip.
        """
        rest = np.array([self.curvature, 0.0, 0.0])
        bend = np.array([self.bending, self.bending, self.torsion])
        stretch = np.array([self.shearing, self.shearing, self.stretching])
        mesh = np.linspace(0.0, self.length, 41)
        half = 0.5 * self.curvature * mesh
        guess = np.zeros((10, mesh.size))
        guess[1] = -mesh * np.sinc(half / np.pi) * np.sin(half)
        guess[2] = mesh * np.sinc(half / np.pi) * np.cos(half)
        guess[3], guess[4] = np.cos(half), np.sin(half)
        for part in np.arange(1, _LOAD_STEPS + 1) / _LOAD_STEPS:
            pull = part * np.asarray(force, dtype=float)
            end = part * (np.zeros(3) if couple is None else np.asarray(couple, dtype=float))

            def slope(_: np.ndarray, y: np.ndarray, pull: np.ndarray = pull) -> np.ndarray:
                q, couple = y[3:7], y[7:10]
                axes = _rotations(q)  # (3, 3, k), columns d1, d2, d3
                strain = np.einsum("jik,j->ik", axes, pull) / stretch[:, None]
                strain[2] += 1.0
                tangent = np.einsum("ijk,jk->ik", axes, strain)
                turn = rest[:, None] + np.einsum("jik,jk->ik", axes, couple) / bend[:, None]
                return np.concatenate([tangent, 0.5 * _times_vector(q, turn), -np.cross(tangent.T, pull).T])

            def ends(a: np.ndarray, b: np.ndarray, end: np.ndarray = end) -> np.ndarray:
                axes = _rotations(b[3:7, None])[:, :, 0]
                return np.concatenate([a[:3], a[3:7] - [1.0, 0.0, 0.0, 0.0], axes.T @ b[7:10] - end])

            solution = solve_bvp(slope, ends, mesh, guess, tol=_TOLERANCE, max_nodes=100_000)
            if not solution.success:
                raise ArithmeticError(f"curved rod under {pull}: {solution.message}")
            mesh, guess = solution.x, solution.y
        return solution.y[:3, -1]


@dataclass(frozen=True)
class Bend:
    """A curved rod, the round wire with its stiffness, and the force at its tip."""

    rod: CurvedRod
    wire: Wire
    force: np.ndarray


def bathe_bolourchi() -> Bend:
    """Return the bend of Bathe and Bolourchi (1979): 45 degrees of radius 100, a unit square section, E = 1e7, nu = 0,
    under
    600 across its plane. A round wire of r^2 = 1/3 and E = 3e7/pi has the square's EA, GA, EI and GJ."""
    young = 3e7 / math.pi
    wire = Wire(25.0 * math.pi, math.sqrt(1.0 / 3.0), young, 0.5 * young, 1.0, 1.0)
    rod = CurvedRod(wire.length, 0.01, wire.bending, wire.torsion, wire.stretching, wire.shearing)
    return Bend(rod, wire, np.array([600.0, 0.0, 0.0]))


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
