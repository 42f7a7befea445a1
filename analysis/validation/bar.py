"""A chain of masses and springs whose first mass is displaced at once and then held, solved exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh_tridiagonal


@dataclass(frozen=True)
class BarChain:
    """n springs k between n+1 equal masses m.

    Attributes
    ----------
    elements : n.
    mass, spring : m, kg, and k, N/m.
    displacement : of mass 0, m, from t = 0 on.
    """

    elements: int
    mass: float
    spring: float
    displacement: float

    def motion(self, time: np.ndarray, node: int) -> np.ndarray:
        """Displacement of a mass at these times (s), m; same shape.

        The distances from the new rest start at -displacement and swing in the chain's own modes.
        """
        squared, modes = self._modes()
        amplitudes = modes[node - 1] * (modes.T @ np.full(self.elements, -self.displacement))
        return self.displacement + np.cos(np.multiply.outer(time, np.sqrt(squared))) @ amplitudes

    def first_mode(self) -> tuple[float, np.ndarray]:
        """Return the slowest motion: its angular frequency, rad/s, and displacements of all masses, shape (n+1,), the
        largest of them 1, where the last mass is half as heavy as the others, as lumping makes it."""
        n = self.elements
        # u_j = sin(j a): k (2 - 2 cos a) = m w^2 in the middle, and at half the mass its own image about it, so that
        # the chain's end is the middle of one of 2 n springs: n a = pi/2.
        angle = 0.5 * math.pi / n
        return 2.0 * math.sqrt(self.spring / self.mass) * math.sin(0.5 * angle), np.sin(angle * np.arange(n + 1))

    @property
    def frequencies(self) -> np.ndarray:
        """Angular frequencies, rad/s, shape (n,), ascending."""
        return np.sqrt(self._modes()[0])

    def _modes(self) -> tuple[np.ndarray, np.ndarray]:
        diagonal = np.full(self.elements, 2.0)
        diagonal[-1] = 1.0
        squared, modes = eigh_tridiagonal(diagonal, np.full(self.elements - 1, -1.0))
        return squared * self.spring / self.mass, modes
