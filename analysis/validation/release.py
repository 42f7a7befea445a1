"""Free motion of a cantilever let go from its rest shape under a tip load, geometrically exact, in a plane.

The rod neither stretches nor shears; the angle of its tangent is t(s, time) = sum a_k(time) p_k(s), with p_k the slopes
of the linear modes. Lengths are in L, times in L^2 sqrt(rho A/EI). From the principle of virtual work, with x' = cos t,
y' = sin t and J the integral from 0 to s:

    M a.. + K a = X^T W J(cos t t.^2) + Y^T W J(sin t t.^2),
    X = -J sin t P, Y = J cos t P, M = X^T W X + Y^T W Y + e P^T W P, K = P'^T W P',

with the quadrature's weights W and e = I/(A L^2) (1 + E/kG): the rotary inertia and, as its second part, the shear, k
its factor. To first order in I/(A L^2) shear lowers a cantilever's frequencies as E/kG more rotary inertia does,
because the mode's third derivative is the slope of the mode turned end for end, so that the integrals of (w''')^2 and
beta^4 (w')^2 are equal.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import legendre
from scipy.integrate import solve_ivp
from scipy.linalg import cho_factor, cho_solve

from analysis.validation.beam import mode_numbers, mode_shape
from analysis.validation.wire import Wire

_POINTS = 48  # of the quadrature; 16 modes have 16 half waves
_TOLERANCE = 1e-10  # relative, of the integration in time


@dataclass(frozen=True)
class Release:
    """Motion of the tip.

    Attributes
    ----------
    time : ndarray, shape (k,)
        In s.
    along, across : ndarray, shape (k,)
        The tip's coordinates, m; across is positive where the load pulled.
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
    system = _Cantilever(modes, slender * (1.0 + wire.youngs_modulus / (wire.shear_factor * wire.shear_modulus)))
    start = system.rest(load)
    times = np.linspace(0.0, duration / wire.time_unit, samples)
    solution = solve_ivp(
        system.slope, (0.0, times[-1]), np.concatenate([start, np.zeros(modes)]), method="DOP853", t_eval=times,
        rtol=_TOLERANCE, atol=_TOLERANCE * 1e-4,
    )
    if not solution.success:
        raise ArithmeticError(f"free motion: {solution.message}")
    along, across = system.tip(solution.y[:modes])
    return Release(np.linspace(0.0, duration, samples), wire.length * along, wire.length * across)


class _Cantilever:
    def __init__(self, modes: int, rotary_inertia: float) -> None:
        nodes, weights = legendre.leggauss(_POINTS)
        arc = 0.5 * (nodes + 1.0)
        numbers = mode_numbers(modes)
        # Slopes of the modes, scaled to about 1; the second derivative is the curvature.
        self._slopes = np.stack([mode_shape(b, arc, 1) / (2.0 * b) for b in numbers], axis=1)
        bends = np.stack([mode_shape(b, arc, 2) / (2.0 * b) for b in numbers], axis=1)
        self._weights = 0.5 * weights
        self._integral = _integral_matrix(nodes)
        self._stiffness = bends.T @ (self._weights[:, None] * bends)
        self._rotary = rotary_inertia * self._slopes.T @ (self._weights[:, None] * self._slopes)

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
            - self._stiffness @ a
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
        """The tip over L for coordinates of shape (modes, k)."""
        angle = self._slopes @ a
        return self._weights @ np.cos(angle), self._weights @ np.sin(angle)


def _integral_matrix(nodes: np.ndarray) -> np.ndarray:
    """J: values at the Gauss points to the integral from 0 to each, exact for the polynomial through them."""
    basis = legendre.legvander(nodes, nodes.size - 1)
    integrals = np.stack(
        [legendre.legval(nodes, legendre.legint(unit, lbnd=-1.0)) for unit in np.eye(nodes.size)], axis=1
    )
    return 0.5 * integrals @ np.linalg.inv(basis)
