"""The energy of a chain of rod elements, written down a second time and with nothing of the runner's but its formulas.

With x_0 and the clamp's frame given, R_j the frame of element j and theta the rotation vector of a joint,

    V = sum_j l/2 Gamma_j . K_s Gamma_j + sum_j 1/2 theta_j . K_j theta_j - F . x_n,    Gamma_j = R_j^T dx_j/l - e3,

K_s = diag(GA, GA, EA), K_j = diag(EI, EI, GJ)/(w_j l) with Gregory's weights w = 3/8, 7/6, 23/24 at the clamp. Nothing
is differentiated by hand: gradients come from the energy by complex steps, exact to rounding, second derivatives by
central differences of gradients. A couple m along the axes of the wire's end adds -m, along those of the last
element, to that element's gradient, wherever it has turned to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from analysis.validation.wire import Wire

GREGORY = (3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0)
_COMPLEX_STEP = 1e-30
_DIFFERENCE = 1e-5  # rad, or of L
_SERIES_BELOW = 1e-2  # angle squared


@dataclass(frozen=True)
class ChainEnergy:
    """A clamped chain about one of its shapes, in units of L and EI/L.

    Unknowns are u, shape (n, 6): block j holds the shift of node j+1 over L and the turn of element j along its own
    axes, a rotation vector from the shape given.

    Attributes
    ----------
    wire : Wire
    positions : (n+1, 3), m.
    orientations : (n, 4), unit quaternions x, y, z, w. The clamp's frame is that of the axes.
    force, moment : (3,), N along fixed axes, N m along the tip's own.
    """

    wire: Wire
    positions: np.ndarray
    orientations: np.ndarray
    force: np.ndarray
    moment: np.ndarray

    @property
    def count(self) -> int:
        """n."""
        return len(self.orientations)

    def terms(self, u: np.ndarray) -> np.ndarray:
        """The energy in n parts, shape (n,); part j depends on blocks j-1 and j only."""
        n, wire = self.count, self.wire
        scale = wire.length / wire.bending
        x = self.positions + wire.length * np.concatenate([np.zeros((1, 3)), u[:, :3]])
        q = _times(self.orientations, _exp(u[:, 3:]))
        l = wire.length / n
        gamma = _turned_back(q, np.diff(x, axis=0) / l) - [0.0, 0.0, 1.0]
        stretch = 0.5 * l * gamma**2 @ [wire.shearing, wire.shearing, wire.stretching]
        before = np.concatenate([[[0.0, 0.0, 0.0, 1.0]], q[:-1]])
        theta = _log(_times(before * [-1.0, -1.0, -1.0, 1.0], q))
        weight = np.ones(n)
        weight[:3] = GREGORY
        bend = 0.5 / (weight * l) * (theta**2 @ [wire.bending, wire.bending, wire.torsion])
        parts = stretch + bend
        parts[-1] -= self.force @ x[-1]
        return scale * parts

    def joint_angles(self) -> np.ndarray:
        """Angle between successive frames at the shape itself, rad, shape (n,)."""
        before = np.concatenate([[[0.0, 0.0, 0.0, 1.0]], self.orientations[:-1]])
        return np.linalg.norm(_log(_times(before * [-1.0, -1.0, -1.0, 1.0], self.orientations)), axis=1)

    def gradient(self, u: np.ndarray) -> np.ndarray:
        """Of the energy, shape (n, 6), without the couple: by complex steps in every second block at once."""
        gradient = np.zeros((self.count, 6))
        for colour in (0, 1):
            for axis in range(6):
                moved = u.astype(complex)
                moved[colour::2, axis] += 1j * _COMPLEX_STEP
                slope = self.terms(moved).imag / _COMPLEX_STEP
                total = slope + np.append(slope[1:], 0.0)
                gradient[colour::2, axis] = total[colour::2]
        return gradient

    def second_derivative(self, u: np.ndarray) -> np.ndarray:
        """Of the energy, shape (6 n, 6 n), without the couple."""
        n = self.count
        h = np.zeros((n, 6, n, 6))
        for colour in range(3):
            columns = np.arange(colour, n, 3)
            for axis in range(6):
                step = np.zeros((n, 6))
                step[colour::3, axis] = _DIFFERENCE
                slope = (self.gradient(u + step) - self.gradient(u - step)) / (2.0 * _DIFFERENCE)
                for shift in (-1, 0, 1):
                    rows = columns + shift
                    inside = (rows >= 0) & (rows < n)
                    h[rows[inside], :, columns[inside], axis] = slope[rows[inside]]
        h = h.reshape(6 * n, 6 * n)
        return 0.5 * (h + h.T)

    @property
    def scaled_moment(self) -> np.ndarray:
        """m L/EI along the last element's axes, shape (3,): half an element's curvature B^-1 m before the end."""
        moment, wire = np.asarray(self.moment, dtype=float), self.wire
        half = 0.5 * wire.length / self.count * moment / [wire.bending, wire.bending, wire.torsion]
        return wire.length / wire.bending * Rotation.from_rotvec(half).apply(moment)

    def residual(self) -> np.ndarray:
        """What is out of balance at the shape itself, the couple included, shape (n, 6)."""
        residual = self.gradient(np.zeros((self.count, 6)))
        residual[-1, 3:] -= self.scaled_moment
        return residual

    def tangent(self) -> np.ndarray:
        """Derivative of the residual, shape (6 n, 6 n); not symmetric under a couple.

        For a turn u of the last element the couple's work is m . J(u) du with J = 1 - [u]/2 + ..., so that its part of
        the derivative is [m]/2.
        """
        k = self.second_derivative(np.zeros((self.count, 6)))
        a, b, c = 0.5 * self.scaled_moment
        k[-3:, -3:] += [[0.0, -c, b], [c, 0.0, -a], [-b, a, 0.0]]
        return k


def _exp(turn: np.ndarray) -> np.ndarray:
    """Unit quaternions of rotation vectors, shapes (n, 3) and (n, 4), real or complex."""
    square = np.sum(turn * turn, axis=1)
    small = np.abs(square) < _SERIES_BELOW
    angle = np.sqrt(np.where(small, 1.0, square))
    h = 0.25 * square
    scale = np.where(small, 0.5 * (1.0 - h / 6.0 * (1.0 - h / 20.0 * (1.0 - h / 42.0 * (1.0 - h / 72.0)))),
                     np.sin(0.5 * angle) / angle)
    real = np.where(small, 1.0 - h / 2.0 * (1.0 - h / 12.0 * (1.0 - h / 30.0 * (1.0 - h / 56.0))), np.cos(0.5 * angle))
    return np.concatenate([scale[:, None] * turn, real[:, None]], axis=1)


def _log(q: np.ndarray) -> np.ndarray:
    """Rotation vectors of unit quaternions with a real part above 0 (turns below pi)."""
    q = np.where(q[:, 3:].real < 0.0, -q, q)
    square = np.sum(q[:, :3] ** 2, axis=1) / q[:, 3] ** 2  # tan^2 of half the angle
    small = np.abs(square) < _SERIES_BELOW
    tangent = np.sqrt(np.where(small, 1.0, square))
    series = sum((-square) ** k / (2 * k + 1) for k in range(9))
    scale = 2.0 * np.where(small, series, np.arctan(tangent) / tangent) / q[:, 3]
    return scale[:, None] * q[:, :3]


def _times(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    a, b = p[:, :3], q[:, :3]
    vector = p[:, 3:] * b + q[:, 3:] * a + np.cross(a, b)
    return np.concatenate([vector, (p[:, 3] * q[:, 3] - np.sum(a * b, axis=1))[:, None]], axis=1)


def _turned_back(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """R^T v, shape (n, 3)."""
    a, w = q[:, :3], q[:, 3:]
    return v - 2.0 * w * np.cross(a, v) + 2.0 * np.cross(a, np.cross(a, v))
