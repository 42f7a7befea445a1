"""A chain of masses and springs whose first mass is displaced at once and then held, solved exactly."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh_tridiagonal

from analysis.validation import scenes
from analysis.validation.wire import BASE

BAR_ELEMENTS = 30
BAR_MASS = BASE.line_density * BASE.length / (BAR_ELEMENTS + 1)  # kg, of a sphere
BAR_SPRING = BASE.stretching * BAR_ELEMENTS / BASE.length  # N/m


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

    def _modes(self) -> tuple[np.ndarray, np.ndarray]:
        diagonal = np.full(self.elements, 2.0)
        diagonal[-1] = 1.0
        squared, modes = eigh_tridiagonal(diagonal, np.full(self.elements - 1, -1.0))
        return squared * self.spring / self.mass, modes


def bar_gain(step: float) -> float:
    """k_A of one sweep a step that pulls as the springs do.

    A sweep moves a sphere of mass m by k e/(m D) for an extension e, D = 2/m + 4 w_q l^2 (w_q = 1, l in units): over
    dt^2 that is the acceleration s e/m of a spring s where k = s D dt^2.
    """
    length = BASE.length / BAR_ELEMENTS / scenes.UNIT
    return BAR_SPRING * (2.0 / BAR_MASS + 4.0 * length * length) * step * step
