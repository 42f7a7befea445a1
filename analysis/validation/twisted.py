"""Closed forms for twisted rods: torsion, and where straight rods and rings leave their shape."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


def torsion_torque(torsion: float, length: float, angle: float) -> float:
    """Torque GJ angle/L of a straight rod whose ends are turned against each other, N m."""
    return torsion * angle / length


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


def ring_twist(bending: float, torsion: float, mode: int = 2) -> float:
    """Twist 2 pi sqrt(k^2 - 1) EI/GJ, in rad, at which a closed ring leaves its plane in k waves (Michell, Zajac)."""
    return 2.0 * math.pi * math.sqrt(mode * mode - 1.0) * bending / torsion


@dataclass(frozen=True)
class LocalisedHelix:
    """An endless rod that is straight and twisted far away, and wound up about its middle (Coyne 1990).

    sin^2(a/2) = (1 - m^2) sech^2(sqrt(1 - m^2) sqrt(T/B) s) for the angle a between tangent and axis, with
    m = M/(2 sqrt(B T)). The ends come closer by 4 sqrt(B/T) sqrt(1 - m^2) and turn by M L/C + 4 arccos m.

    Attributes
    ----------
    load : m, dimensionless.
    tension, moment : T and M, in units of B/length^2 and B/length with the units of B and the lengths given.
    """

    load: float
    tension: float
    moment: float
    bending: float

    def angle(self, arc: np.ndarray) -> np.ndarray:
        """a at the distance s from the middle, rad; same shape."""
        rest = math.sqrt(1.0 - self.load**2)
        width = rest * math.sqrt(self.tension / self.bending)
        return 2.0 * np.arcsin(rest / np.cosh(width * arc))

    @property
    def largest_angle(self) -> float:
        """a in the middle, rad: cos a = 2 m^2 - 1."""
        return math.acos(2.0 * self.load**2 - 1.0)


def localised_helix(bending: float, torsion: float, length: float, shortening: float, turn: float) -> LocalisedHelix:
    """Return the localised helix of a rod whose ends were brought closer and turned by `turn` rad.

    `bending` B and `torsion` C in one unit of stiffness, `length` and `shortening` in one unit of length.
    """

    def tension_at(load: float) -> float:
        return bending * (4.0 * math.sqrt(1.0 - load * load) / shortening) ** 2

    def excess(load: float) -> float:
        moment = 2.0 * load * math.sqrt(bending * tension_at(load))
        return moment * length / torsion + 4.0 * math.acos(load) - turn

    # The couple has its maximum at m = 1/sqrt 2; beyond it lie the gentle helices that a turning end meets first.
    load = brentq(excess, math.sqrt(0.5), 1.0 - 1e-12, xtol=1e-14)
    tension = tension_at(load)
    return LocalisedHelix(load, tension, 2.0 * load * math.sqrt(bending * tension), bending)
