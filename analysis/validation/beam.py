"""Small motions of a cantilever: modes and frequencies."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from analysis.validation.wire import Wire


def mode_numbers(count: int) -> np.ndarray:
    """Return the first roots b = beta L of cos b cosh b = -1, shape (count,)."""

    def condition(b: float) -> float:
        return math.cos(b) + 1.0 / math.cosh(b)

    return np.array([brentq(condition, k * math.pi, (k + 1) * math.pi, xtol=1e-14) for k in range(count)])


def frequencies(wire: Wire, count: int) -> np.ndarray:
    """Return the frequencies of a thin cantilever (Euler-Bernoulli), Hz, shape (count,)."""
    return mode_numbers(count) ** 2 / (2.0 * math.pi * wire.time_unit)


def mode_shape(number: float, arc: np.ndarray, derivative: int = 0) -> np.ndarray:
    """Mode of a thin cantilever, or a derivative of it by s/L, 2 at the free end.

    Parameters
    ----------
    number : b, from `mode_numbers`.
    arc : s/L, any shape.
    derivative : 0 to 3.

    Notes
    -----
    cosh bs - cos bs - c (sinh bs - sin bs), c = (cosh b + cos b)/(sinh b + sin b), with the growing exponential's
    factor (1 - c)/2 taken from a form that does not cancel.
    """
    b, turn = number, 0.5 * math.pi * derivative
    below = math.sinh(b) + math.sin(b)
    c = (math.cosh(b) + math.cos(b)) / below
    growing = 0.5 * (math.sin(b) - math.cos(b) - math.exp(-b)) / below
    falling = 0.5 * (1.0 + c) * (-1.0) ** derivative
    phase = b * arc + turn  # the n-th derivative of cos and sin adds n quarter turns
    sign = 1.0 if b == 0.0 or _at_tip(b, c, growing, 0.5 * (1.0 + c)) > 0.0 else -1.0
    value = growing * np.exp(b * arc) + falling * np.exp(-b * arc) - np.cos(phase) + c * np.sin(phase)
    return sign * b**derivative * value


def _at_tip(b: float, c: float, growing: float, falling: float) -> float:
    """Return the mode's value at the tip, before it is scaled."""
    return growing * math.exp(b) + falling * math.exp(-b) - math.cos(b) + c * math.sin(b)
