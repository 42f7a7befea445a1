"""The wire that the checks are about: a straight round rod of one material."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Wire:
    """A round wire: A = pi r^2, I = pi r^4/4, J = 2 I.

    Attributes
    ----------
    length, radius : L and r, m.
    youngs_modulus, shear_modulus : E and G, Pa.
    density : rho, kg/m^3.
    shear_factor : what of GA resists shear.
    """

    length: float = 0.3
    radius: float = 0.5e-3
    youngs_modulus: float = 60e9
    shear_modulus: float = 23e9
    density: float = 6450.0
    shear_factor: float = 0.9

    @property
    def area(self) -> float:
        """A, m^2."""
        return math.pi * self.radius**2

    @property
    def second_moment(self) -> float:
        """I, m^4."""
        return 0.25 * math.pi * self.radius**4

    @property
    def bending(self) -> float:
        """EI, N m^2."""
        return self.youngs_modulus * self.second_moment

    @property
    def torsion(self) -> float:
        """GJ, N m^2."""
        return 2.0 * self.shear_modulus * self.second_moment

    @property
    def stretching(self) -> float:
        """EA, N."""
        return self.youngs_modulus * self.area

    @property
    def shearing(self) -> float:
        """GA times the shear factor, N."""
        return self.shear_factor * self.shear_modulus * self.area

    @property
    def line_density(self) -> float:
        """rho A, kg/m."""
        return self.density * self.area

    @property
    def time_unit(self) -> float:
        """L^2 sqrt(rho A/EI), s: the unit in which the cantilever's motion does not depend on the material."""
        return self.length**2 * math.sqrt(self.line_density / self.bending)


BASE = Wire()
