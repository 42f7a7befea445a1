"""A wire as the effective parameters of a run state it: stiffness and rest curvature along it, and pieces of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

WIRE_KEYS = ("wireRadius", "innerRadius", "shearFactor", "bendingStiffness", "torsionalStiffness", "density")


@dataclass(frozen=True)
class Wire:
    """A wire, piecewise uniform.

    Attributes
    ----------
    parameters : effective parameters of a run with it, in millimetres (metresPerUnit 0.001).
    ends : (k + 1,), where its pieces end, m from the proximal end.
    bending, torsional : (k,), EI and GJ of each piece, N m^2.
    curvature : (k,), rest curvature of each piece about d1, 1/m.
    """

    parameters: Mapping[str, Any]
    ends: np.ndarray
    bending: np.ndarray
    torsional: np.ndarray
    curvature: np.ndarray

    @property
    def length(self) -> float:
        """m."""
        return float(self.ends[-1])

    @property
    def radius(self) -> float:
        """m."""
        return float(self.parameters["wireRadius"])

    @property
    def shaft(self) -> float:
        """Length of the uniform, straight shaft, m."""
        return float(self.ends[1])

    @property
    def straight(self) -> float:
        """Say where the first bend of the tip begins, or the tip itself, m."""
        bent = np.flatnonzero(self.curvature)
        return float(self.ends[bent[0]]) if len(bent) else self.length

    def stiffness(self, s: np.ndarray) -> np.ndarray:
        """EI at arc lengths s, m: N m^2."""
        return self.bending[self._piece(s)]

    def torsional_stiffness(self, s: np.ndarray) -> np.ndarray:
        """GJ at arc lengths s, m: N m^2."""
        return self.torsional[self._piece(s)]

    def axial(self, bending: np.ndarray) -> np.ndarray:
        """EA of pieces with this EI, as of a homogeneous section: N."""
        return 4.0 * bending / self._squares

    def shear(self, torsional: np.ndarray) -> np.ndarray:
        """GA of pieces with this GJ, with the shear factor: N."""
        return 2.0 * self.parameters["shearFactor"] * torsional / self._squares

    @property
    def _squares(self) -> float:
        return self.radius**2 + float(self.parameters["innerRadius"]) ** 2

    def rest_curvature(self, s: np.ndarray) -> np.ndarray:
        """Rest curvature at arc lengths s, m: 1/m."""
        return self.curvature[self._piece(s)]

    def piece(self, start: float, end: float, elements: int) -> dict[str, Any]:
        """Parameters of a wire that is the piece of this one from start to end (m), of equal elements."""
        sections = [
            {**{key: value for key, value in section.items() if key != "numberRodElements"},
             "from": max(0.0, section["from"] - 1e3 * start), "to": min(section["to"], 1e3 * end) - 1e3 * start}
            for section in self.parameters["wireSections"]
            if section["to"] > 1e3 * start + 1e-6 and section["from"] < 1e3 * end - 1e-6
        ]
        return {"solver": "direct", **{key: self.parameters[key] for key in WIRE_KEYS}, "wireSections": sections,
                "guidewireLength": 1e3 * (end - start), "numberRodElements": elements, "guidewireOffset": 0.0,
                "deltaThreshold": 0.0}

    def _piece(self, s: np.ndarray) -> np.ndarray:
        return np.clip(np.searchsorted(self.ends, s, side="right") - 1, 0, len(self.bending) - 1)


def wire_of(parameters: Mapping[str, Any]) -> Wire:
    """The wire of a run whose sections, if any, follow each other up to its end, as an instrument's do."""
    sections = [section for section in parameters["wireSections"] if "bendingStiffness1" in section]    # no markers
    start = sections[0]["from"] if sections else parameters["guidewireLength"]
    ends = np.array([0.0, start, *(section["to"] for section in sections)]) * 1e-3
    bending = [parameters["bendingStiffness"], *(section["bendingStiffness1"] for section in sections)]
    torsional = [parameters["torsionalStiffness"], *(section["torsionalStiffness"] for section in sections)]
    curvature = [0.0, *(section["restCurvature"][0] for section in sections)]
    return Wire(parameters, ends, np.array(bending), np.array(torsional), np.array(curvature))
