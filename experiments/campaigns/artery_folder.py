"""The forked artery of ``params/meshes`` as ``guidewire.py anatomy`` would write it, with the centreline that it was
made from: a vessel with an open end and two arms, for what needs no repair."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from experiments.scene_meshes import ARTERY, ARTERY_ENTRANCE, artery_lumens
from guidewire.anatomy import output
from guidewire.anatomy.centreline import Centreline, End
from guidewire.anatomy.inspection import Unit
from guidewire.anatomy.mesh import Mesh
from guidewire.anatomy.reading import Source
from guidewire.logs.surfaces import read_obj
from guidewire.runs.whole_files import write_whole


def write(folder: Path, target: int) -> Path:
    """Write vessel, ends and scene into a folder; returns ``scene.json``. Ends are 1, the inlet, and 2 and 3, the arms.
    """
    whole, second = artery_lumens()
    inside = whole.centres[:, 2] > ARTERY_ENTRANCE
    entrance = np.array([0.0, 0.0, ARTERY_ENTRANCE])
    first_line = np.vstack([entrance, whole.centres[inside]])
    first_radii = np.r_[np.interp(ARTERY_ENTRANCE, whole.centres[:, 2][:2], whole.radii[:2]), whole.radii[inside]]
    (line, radii), (arm, arm_radii) = _fine(first_line, first_radii), _fine(second.centres, second.radii)
    fork = int(np.argmin(np.linalg.norm(line - second.centres[0], axis=1)))
    n, m = len(line), len(arm) - 1
    branches = np.r_[np.where(np.arange(n) <= fork, 1, 2), np.full(m, 3)]
    points = np.vstack([line, arm[1:]])
    tips = (0, n - 1, n + m - 1)
    ahead = [line[1] - line[0], line[-2] - line[-1], arm[-2] - arm[-1]]
    ends = tuple(End(k, f"end {k}", points[tip], float(np.r_[radii, arm_radii[1:]][tip]),
                     along / np.linalg.norm(along), k == 1, tip)
                 for k, (tip, along) in enumerate(zip(tips, ahead), 1))
    parents = np.r_[-1, np.arange(n - 1), fork, n + np.arange(m - 1)]
    centreline = Centreline(points, np.r_[radii, arm_radii[1:]], parents, branches, ends)
    found, unit = read_obj(ARTERY), Unit("mm", "as made", True)
    mesh = Mesh(found.vertices, found.triangles)
    output.write_vessel(folder, mesh, centreline, unit, Source(mesh, "mm", "as made", name=ARTERY.name))
    write_whole(folder / output.SCENE,
                json.dumps(output.scene(centreline, unit, ends[0], ends[target - 1], 0.36), indent=2) + "\n")
    return folder / output.SCENE


def _fine(line: np.ndarray, radii: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A line's points (k, 3) and radii (k,) at steps of half a millimetre."""
    arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
    at = np.linspace(0.0, arc[-1], int(2.0 * arc[-1]) + 1)
    return np.stack([np.interp(at, arc, line[:, k]) for k in range(3)], axis=1), np.interp(at, arc, radii)
