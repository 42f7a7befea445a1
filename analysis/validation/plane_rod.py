"""Motion in a plane of a rod that bends and neither stretches nor shears, held at its first end, geometrically exact.

The angle of its tangent is t(s, time) = sum a_k(time) p_k(s). Lengths are in L, times in L^2 sqrt(rho A/EI). From the
principle of virtual work, with x' = cos t, y' = sin t and J the integral from 0 to s:

    M a.. + K a = X^T W J(cos t t.^2) + Y^T W J(sin t t.^2) + g Y^T W 1,
    X = -J sin t P, Y = J cos t P, M = X^T W X + Y^T W Y + e P^T W P, K = P'^T W P',

with the quadrature's weights W, the weight g per length over EI/L^3, along y, and e = I/(A L^2) for rotary inertia.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp
from scipy.linalg import cho_factor, cho_solve

_POINTS = 48  # of the quadrature; 16 modes have 16 half waves
_TOLERANCE = 1e-10  # relative, of the integration in time


class PlaneRod:
    """The rod in a series of slopes.

    Parameters
    ----------
    series : from s/L, shape (k,), to the slopes p and their derivatives p', shape (k, modes) each.
    rotary_inertia : e.
    weight : g.
    """

    def __init__(
        self, series: Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]], rotary_inertia: float, weight: float = 0.0
    ) -> None:
        nodes, weights = legendre.leggauss(_POINTS)
        self._slopes, bends = series(0.5 * (nodes + 1.0))
        self._weights = 0.5 * weights
        self._weight = weight
        self._integral = _integral_matrix(nodes)
        self._stiffness = bends.T @ (self._weights[:, None] * bends)
        self._rotary = rotary_inertia * self._slopes.T @ (self._weights[:, None] * self._slopes)

    def motion(self, start: np.ndarray, times: np.ndarray) -> np.ndarray:
        """Coordinates a at these times, from 0 on, of a motion from rest at `start`, shape (modes, k)."""
        solution = solve_ivp(
            self.slope, (0.0, times[-1]), np.concatenate([start, np.zeros(len(start))]), method="DOP853",
            t_eval=times, rtol=_TOLERANCE, atol=_TOLERANCE * 1e-4,
        )
        if not solution.success:
            raise ArithmeticError(f"free motion: {solution.message}")
        return solution.y[:len(start)]

    def slope(self, _: float, state: np.ndarray) -> np.ndarray:
        """d/dtime of (a, a.)."""
        a, rate = np.split(state, 2)
        angle, spin = self._slopes @ a, self._slopes @ rate
        cosine, sine = np.cos(angle), np.sin(angle)
        x = -self._integral @ (sine[:, None] * self._slopes)
        y = self._integral @ (cosine[:, None] * self._slopes)
        wx, wy = self._weights[:, None] * x, self._weights[:, None] * y
        mass = x.T @ wx + y.T @ wy + self._rotary
        force = (
            wx.T @ (self._integral @ (cosine * spin**2)) + wy.T @ (self._integral @ (sine * spin**2))
            - self._stiffness @ a + self._weight * (self._weights @ y)
        )
        return np.concatenate([rate, cho_solve(cho_factor(mass), force)])

    def energy(self, state: np.ndarray) -> float:
        """Kinetic and bending energy, in units of EI/L."""
        a, rate = np.split(state, 2)
        angle, spin = self._slopes @ a, self._slopes @ rate
        x, y = self._integral @ (np.sin(angle) * spin), self._integral @ (np.cos(angle) * spin)
        return 0.5 * float(self._weights @ (x * x + y * y) + rate @ self._rotary @ rate + a @ self._stiffness @ a)

    def rest(self, load: float) -> np.ndarray:
        """Coordinates a of the rest shape under a force across at the tip: K a = load Y(1)^T, by Newton's method."""
        a = np.zeros(len(self._stiffness))
        for _ in range(50):
            angle = self._slopes @ a
            residual = self._stiffness @ a - load * self._slopes.T @ (self._weights * np.cos(angle))
            tangent = self._stiffness + load * self._slopes.T @ (
                (self._weights * np.sin(angle))[:, None] * self._slopes
            )
            step = np.linalg.solve(tangent, -residual)
            a += step
            if np.max(np.abs(step)) < 1e-14:
                return a
        raise ArithmeticError(f"no rest shape under the load {load}")

    def tip(self, a: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the tip over L for coordinates of shape (modes, k)."""
        angle = self._slopes @ a
        return self._weights @ np.cos(angle), self._weights @ np.sin(angle)


def _integral_matrix(nodes: np.ndarray) -> np.ndarray:
    """J: values at the Gauss points to the integral from 0 to each, exact for the polynomial through them."""
    basis = legendre.legvander(nodes, nodes.size - 1)
    integrals = np.stack(
        [legendre.legval(nodes, legendre.legint(unit, lbnd=-1.0)) for unit in np.eye(nodes.size)], axis=1
    )
    return 0.5 * integrals @ np.linalg.inv(basis)
