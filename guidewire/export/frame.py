"""Where the numbers of an export are: axes of the patient, and mm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.patient import axes_named
from guidewire.logs.surfaces import Surface
from guidewire.viewer.recording import units_of


@dataclass(frozen=True)
class Frame:
    """matrix : ndarray (3, 3), from the run's axes to those of the export; scale : mm a unit; letters : of the axes,
    empty where nothing says how they lie in the patient; unit : "mm", or "units" with gains."""

    matrix: np.ndarray
    scale: float
    letters: str
    unit: str

    def points(self, points: np.ndarray) -> np.ndarray:
        """(..., 3): positions."""
        return self.scale * self.vectors(points)

    def vectors(self, vectors: np.ndarray) -> np.ndarray:
        """(..., 3): such as forces, whose size stays."""
        return vectors @ self.matrix.T

    def surface(self, surface: Surface) -> tuple[np.ndarray, np.ndarray]:
        """Vertices, and triangles that face where they did."""
        is_mirrored = np.linalg.det(self.matrix) < 0.0
        return self.points(surface.vertices), surface.triangles[:, ::-1] if is_mirrored else surface.triangles

    @property
    def space(self) -> str:
        """Name the space for 3D Slicer, which knows two."""
        return self.letters if self.letters in ("LPS", "RAS") else ""

    def describe(self) -> str:
        """Describe it in one line."""
        return (f"axes {self.letters} of the patient, {self.unit}" if self.letters
                else f"the scene's own axes, {self.unit}: nothing says how they lie in the patient (patientAxes)")


def frame_of(parameters: Mapping[str, Any], patient: Mapping[str, Any] | None, asked: str | None) -> Frame:
    """Return the frame for a run.

    Parameters
    ----------
    parameters : effective values.
    patient : as in `Session.describe`.
    asked : letters such as "RAS"; None: LPS where the run's axes are known, else its own.

    Raises
    ------
    AnatomyError : axes are asked for, and those of the run are not known.
    """
    metres = units_of(parameters).metres
    scale, unit = (1.0, "units") if metres is None else (1e3 * metres, "mm")
    if patient is None:
        if asked is not None:
            raise AnatomyError(f"--axes {asked}: nothing says how the axes of this run lie in the patient; patientAxes "
                               "of its scene, or --axes of the command anatomy, does")
        return Frame(np.eye(3), scale, "", unit)
    to_lps = np.array([patient["left"], -np.asarray(patient["chest"], dtype=float), patient["head"]], dtype=float)
    wanted = axes_named(asked or "LPS")
    return Frame(wanted.to_lps.T @ to_lps, scale, wanted.letters, unit)
