"""Where a straight rod that is twisted leaves its shape."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq


def clamped_moment(tension: float = 0.0) -> float:
    """Critical couple M L/EI of a straight rod between clamps, one of which slides (Greenhill 1883).

    The deflection u + i v in the plane across obeys u'''' - i M u''' - T u'' = 0, with 0 and exp(i k s),
    k = (M +- sqrt(M^2 - 4 T))/2, as solutions; it and its slope vanish at both ends.

    Parameters
    ----------
    tension : T L^2/EI, a pull, at least 0. Without one the condition is tan(M/2) = M/2.
    """

    def condition(moment: float) -> float:
        half = 0.5 * math.sqrt(moment * moment - 4.0 * tension)
        first, second = 0.5 * moment + half, 0.5 * moment - half
        rows = []
        for s in (-0.5, 0.5):
            ends = np.exp(1j * s * np.array([first, second]))
            rows.append([1.0, s, *ends])
            rows.append([0.0, 1.0, 1j * first * ends[0], 1j * second * ends[1]])
        # Reflection about the middle makes the determinant imaginary; equal k are no deflection.
        determinant = np.linalg.det(np.array(rows)).imag
        return float(determinant) / half

    if tension == 0.0:
        return 2.0 * brentq(lambda x: math.sin(x) - x * math.cos(x), math.pi, 1.5 * math.pi, xtol=1e-14)
    lowest = 2.0 * math.sqrt(tension)
    grid = np.linspace(lowest * (1.0 + 1e-6), lowest + 4.0 * math.pi, 400)
    values = [condition(moment) for moment in grid]
    for low, high, a, b in zip(grid, grid[1:], values, values[1:]):
        if a * b < 0.0:
            return brentq(condition, low, high, xtol=1e-13)
    raise ArithmeticError(f"no critical couple found under the tension {tension}")
