"""The centreline of a vessel for other programs: .vtp for ParaView and VMTK, .mrk.json for 3D Slicer."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from guidewire.anatomy.centreline import Centreline
from guidewire.anatomy.inspection import Unit
from guidewire.anatomy.patient import Axes
from guidewire.anatomy.vtp import write_vtp
from guidewire.runs.whole_files import write_whole

LINES, MARKUPS = "centreline.vtp", "centreline.mrk.json"
_SCHEMA = ("https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
           "markups-schema-v1.0.3.json#")


def centreline_names(axes: Axes) -> list[str]:
    """Return what is written: 3D Slicer needs to know where the axes point."""
    return [LINES, MARKUPS] if axes.is_known else [LINES]


def write_centreline(folder: Path, line: Centreline, unit: Unit, axes: Axes) -> None:
    """Lines with radii, one a branch, which begins at the point that it leaves: in the units and axes of the vessel's
    mesh, for 3D Slicer in mm."""
    branches = branches_of(line)
    radii = np.maximum(line.radii, 1e-6 * float(line.radii.max()))    # at the wall of a closed end it is none
    numbers = np.array([line.branches[branch[-1]] for branch in branches])
    write_vtp(folder / LINES, line.points, branches, at_points={"Radius": radii}, of_cells={"Branch": numbers},
              space=axes.of_vessel())
    if not axes.is_known:
        (folder / MARKUPS).unlink(missing_ok=True)    # of the vessel that was here before
        return
    mm = 1e3 * unit.metres
    write_whole(folder / MARKUPS, json.dumps({"@schema": _SCHEMA, "markups": [
        _curve(f"branch {number}", mm * line.points[branch], mm * radii[branch])
        for number, branch in zip(numbers, branches)]}) + "\n")


def branches_of(line: Centreline) -> list[np.ndarray]:
    """Indices of the points of each branch, from the one before its first; a link of a loop is a branch of two."""
    found = []
    for number in np.unique(line.branches):
        own = np.flatnonzero(line.branches == number)
        # Points of a branch follow each other; where one does not, another piece begins.
        borders = np.flatnonzero(line.parents[own][1:] != own[:-1]) + 1
        for piece in np.split(own, borders):
            parent = line.parents[piece[0]]
            whole = np.r_[parent, piece] if parent >= 0 else piece
            if len(whole) > 1:
                found.append(whole)
    return [*found, *(np.array(loop.points) for loop in line.loops)]


def _curve(name: str, points: np.ndarray, radii: np.ndarray) -> dict:
    return {"type": "Curve", "coordinateSystem": "LPS", "coordinateUnits": "mm", "name": name,
            "controlPoints": [{"id": str(k), "label": f"{name}-{k}", "position": [round(v, 6) for v in point]}
                              for k, point in enumerate(points.tolist(), 1)],
            "measurements": [{"name": "Radius", "enabled": False, "units": "mm",
                              "controlPointValues": [round(v, 6) for v in radii.tolist()]}]}
