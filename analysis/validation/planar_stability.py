"""Rods bent in a plane by their own weight, and the loads at which they leave it or snap within it.

A rod that bends and twists and neither stretches nor shears, in units of its length and of the stiffness B1 of
bending in the plane; B2 and C are those of bending out of the plane and of torsion. The angle t(s) of the tangent,
counted from the clamp's axis, obeys t'' = -W sin(g - t) with the weight W(s) beyond s and its direction g.

Out of the plane the frame rotates by a about the in-plane normal d2 = (sin t, -cos t) and by b about the tangent. With
u = t', m = u - k0 (k0 the curvature at rest), n2 = -W sin(g - t), n3 = W cos(g - t), linearised about the plane shape:

    a' = M2/B2 + u b,  b' = M3/C - u a,
    M2' = (u - m/C) M3 - n2 b + n3 a,  M3' = (m/B2 - u) M2,

from M' + d3 x n = 0 in the rod's axes, n being dead. A clamp at 0 and a free end at 1 ask for a(0) = b(0) = 0 and
M2(1) = M3(1) = 0: where the determinant of these is 0, the plane shape gains or loses its stability.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp
from scipy.optimize import brentq

_TOLERANCE = 1e-9
_STEPS = 200
_NEWTON = 30


@dataclass(frozen=True)
class PlaneRest:
    """A clamped rod with a free end.

    Attributes
    ----------
    curvature : k0 L, at rest, in the plane.
    direction : g, of the weight from the clamp's axis, rad.
    lateral, torsion : B2/B1 and C/B1.
    """

    curvature: float
    direction: float
    lateral: float
    torsion: float

    def limits(self, loads: np.ndarray, tip: float | None = None) -> list[float]:
        """Loads w L^3/B1 between the given ones at which the determinant changes its sign.

        Each shape is the guess of the next: from a small load on, along the branch of the shape at rest; or from any
        load at which the tip's angle is near `tip`.
"""
        tip = self.curvature if tip is None else tip
        before, found = (0.0, 0.0), []
        for load in loads:
            start, (tip, value) = tip, self._at(load, tip)
            if value * before[1] < 0.0:
                found.append(float(brentq(lambda at, start=start: self._at(at, start)[1], *sorted((before[0], load)),
                                          xtol=1e-7 * load, rtol=1e-7)))
            before = (load, value)
        return found

    def unrolled(self, load: float) -> float:
        """Angle of the tip on the branch of the rod that hangs straight but for a curl at its tip, rad."""

        def slope(s: np.ndarray, y: np.ndarray) -> np.ndarray:
            return np.stack([y[1], -load * (1.0 - s) * np.sin(self.direction - y[0])])

        def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
            return np.array([a[0], b[1] - self.curvature])

        mesh = np.linspace(0.0, 1.0, 81)
        return float(solve_bvp(slope, ends, mesh, np.zeros((2, mesh.size)), tol=_TOLERANCE, max_nodes=100_000).y[0, -1])

    def _at(self, load: float, tip: float) -> tuple[float, float]:
        tip, angle, u = self._shape(load, tip)
        return tip, self._determinant(load, angle, u)

    def _shape(self, load: float, tip: float) -> tuple[float, np.ndarray, np.ndarray]:
        """Angle of the tip, and angle and curvature at 2 k + 1 places from the clamp on, by shooting from the tip,
        whose angle is near `tip`; the third and fourth numbers are the derivatives of the first two with respect to
        it."""

        def rates(beyond: float, y: np.ndarray) -> np.ndarray:
            turn = self.direction - y[0]
            return np.array([-y[1], load * beyond * math.sin(turn), -y[3], -load * beyond * math.cos(turn) * y[2]])

        for _ in range(_NEWTON):
            path = _runge_kutta(rates, np.array([tip, self.curvature, 1.0, 0.0]), 1.0, 2 * _STEPS)
            angle, _, change, _ = path[-1]
            if abs(angle) < _TOLERANCE:
                return tip, path[::-1, 0], path[::-1, 1]
            tip -= angle / change
        raise ArithmeticError(f"plane rod of curvature {self.curvature}: no shape under the load {load}")

    def _determinant(self, load: float, angle: np.ndarray, u: np.ndarray) -> float:
        """By the classical Runge-Kutta scheme: the product of its steps' matrices."""
        s = np.linspace(0.0, 1.0, 2 * _STEPS + 1)
        m, weight = u - self.curvature, load * (1.0 - s)
        rates = np.zeros((len(s), 4, 4))  # of a, b, M2, M3
        rates[:, 0, 1], rates[:, 0, 2] = u, 1.0 / self.lateral
        rates[:, 1, 0], rates[:, 1, 3] = -u, 1.0 / self.torsion
        turn = self.direction - angle
        rates[:, 2, 0], rates[:, 2, 1] = weight * np.cos(turn), weight * np.sin(turn)
        rates[:, 2, 3], rates[:, 3, 2] = u - m / self.torsion, m / self.lateral - u
        first, middle, last, h = rates[:-1:2], rates[1::2], rates[2::2], 1.0 / _STEPS
        one = np.eye(4)
        second = middle @ (one + 0.5 * h * first)
        third = middle @ (one + 0.5 * h * second)
        fourth = last @ (one + h * third)
        y = one[:, 2:]
        for step in one + h / 6.0 * (first + 2.0 * second + 2.0 * third + fourth):
            y = step @ y
        return float(np.linalg.det(y[2:]))


def snap(slack: float) -> float:
    """Weight w L^3/B1 against its height at which an arch between clamps becomes unstable in its plane and snaps.

    A rod of length 1 bent between clamps on one axis, 1 - slack apart, under its own weight. Symmetrical shapes are
    followed from no weight, with couple and thrust at the clamp as unknowns. They end where there is none for more
    weight, or become unstable before, where couple, thrust and shear force of the clamp may change at the same
    weight.
"""

    def ends(p: np.ndarray, length: float = 1.0) -> np.ndarray:
        moment, along, across, load = p

        def rates(s: float, y: np.ndarray) -> np.ndarray:
            # Force of the part beyond s: along, and across + w s against the height.
            bend = np.sin(y[0]) * along - np.cos(y[0]) * (across + load * s)
            return np.stack([y[1], bend, np.cos(y[0]), np.sin(y[0])])

        none = np.zeros_like(moment)
        angle, _, x, y = _runge_kutta(rates, np.stack([none, moment, none, none]), length, _STEPS)[-1]
        return np.stack([angle, x - length * (1.0 - slack), y])

    def jacobian(p: np.ndarray, length: float = 1.0) -> np.ndarray:
        step = 1e-6 * np.maximum(1.0, np.abs(p))
        values = ends(np.concatenate([p + np.diag(step), p - np.diag(step)]).T, length)  # all at once
        return (values[:, :4] - values[:, 4:]) / (2.0 * step)

    def shape(p: np.ndarray, load: float) -> np.ndarray | None:
        p = np.array([p[0], p[1], -0.5 * load, load])
        for _ in range(_NEWTON):
            off = ends(p, 0.5)[:2]
            if np.max(np.abs(off)) < _TOLERANCE:
                return p
            p[:2] -= np.linalg.solve(jacobian(p, 0.5)[:2, :2], off)
        return None

    def stable(p: np.ndarray) -> float:
        return float(np.linalg.det(jacobian(p)[:, :3]))

    # A clamped column that has buckled a little: t = c sin(2 pi s), its slack c^2/4, its thrust 4 pi^2.
    low = shape(np.array([4.0 * math.pi * math.sqrt(slack), -4.0 * math.pi**2]), 0.0)
    sign, step = stable(low), 2.0
    while step > 1e-4:
        high = shape(low, low[3] + step)
        if high is None or np.max(np.abs(high - low)) > 0.2 * np.max(np.abs(low)):
            step *= 0.5
        elif sign * stable(high) < 0.0:
            return float(brentq(lambda load: stable(shape(low, load)), low[3], high[3], xtol=1e-4))
        else:
            low = high
    return float(low[3])


def _runge_kutta(
    rates: Callable[[float, np.ndarray], np.ndarray], start: np.ndarray, length: float, steps: int
) -> np.ndarray:
    """States at the ends of equal steps of the classical scheme, shape (steps + 1, ...)."""
    h, path = length / steps, [start]
    for k in range(steps):
        y = path[-1]
        first = rates(k * h, y)
        second = rates((k + 0.5) * h, y + 0.5 * h * first)
        third = rates((k + 0.5) * h, y + 0.5 * h * second)
        path.append(y + h / 6.0 * (first + 2.0 * second + 2.0 * third + rates((k + 1) * h, y + h * third)))
    return np.array(path)
