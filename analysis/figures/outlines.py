"""Sections of walls by the plane x = 0, drawn in the y-z plane."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon

from guidewire.logs.logs import LogError
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import Surface, read_obj

_COLOUR = "0.55"
_PLANE = 1000.0  # half the length of a plane's line, units: beyond every picture
_MESHES = Path(__file__).resolve().parents[2] / "params" / "meshes"


def draw_surroundings(axes: Axes, run: Run) -> None:
    """Draws the vessel and the boxes that a run's parameters name; z to the right, y up, both in units.

    Raises
    ------
    guidewire.logs.logs.LogError : the vessel is of a kind that is not drawn, or its file cannot be read.
    """
    vessel = run.parameters.get("vessel")
    if vessel and vessel["shape"] == "tube":
        for side in tube_sides(np.array(vessel["knots"], float), vessel["radius"]):
            axes.plot(side[:, 2], side[:, 1], color=_COLOUR, linewidth=1.2)
    elif vessel:
        axes.add_collection(LineCollection(_cut(run.parameters, vessel), colors=_COLOUR, linewidths=1.2), autolim=False)
    for obstacle in run.parameters.get("obstacles") or []:
        if obstacle["shape"] == "box":
            (_, y, z), (_, across, along) = obstacle["centre"], obstacle["halfSize"]
            corners = [(z + i * along, y + j * across) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            axes.add_patch(Polygon(corners, facecolor="0.88", edgecolor=_COLOUR, zorder=1))


def _cut(parameters: Mapping[str, Any], vessel: Mapping[str, Any]) -> np.ndarray:
    """Segments as of `section` of a vessel that is a plane or a mesh; a mesh's file stands there as the run's own
    folder saw it, and is else sought by its bare name among the repository's."""
    if any(parameters.get(key) not in (None, rest) for key, rest in
           (("position", [0, 0, 0]), ("rotation", [0, 0, 0]), ("scale", [1, 1, 1]))):
        raise LogError("a vessel that is moved, turned or scaled is not drawn")
    if vessel["shape"] == "mesh":
        file, own = Path(vessel["file"]), _MESHES / Path(vessel["file"]).name
        return section(read_obj(own if not file.is_file() and own.is_file() else file))
    if vessel["shape"] != "plane":
        raise LogError(f"a vessel of shape {vessel['shape']} is not drawn")
    normal = np.asarray(vessel["normal"], float)
    (_, y, z), offset = normal, normal @ np.asarray(vessel.get("point", (0, 0, 0)), float)
    reach = _PLANE / np.hypot(z, y) * np.array([y, -z])
    foot = offset / (z * z + y * y) * np.array([z, y])
    return np.array([[foot - reach, foot + reach]])


def section(surface: Surface) -> np.ndarray:
    """Find where the triangles meet the plane x = 0: segments (k, 2, 2), each two points (z, y), in units."""
    corners = surface.vertices[surface.triangles]
    # A vertex in the plane itself counts as on its positive side, so that every cut has two ends.
    side = corners[..., 0] >= 0.0
    cut = corners[side.any(axis=1) & ~side.all(axis=1)]
    ends = []
    for triangle in cut:
        points = []
        for a, b in zip(triangle, np.roll(triangle, -1, axis=0)):
            if (a[0] >= 0.0) != (b[0] >= 0.0):
                points.append((a + a[0] / (a[0] - b[0]) * (b - a))[[2, 1]])
        ends.append(points)
    return np.array(ends).reshape(-1, 2, 2)


def tube_sides(knots: np.ndarray, radius: float) -> np.ndarray:
    """Return both sides of a tube in the y-z plane, shape (2, k, 3), in units: its knots moved across by the radius."""
    directions = np.diff(knots, axis=0)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    # Where two pieces meet, along the bisector, so far that both sides keep their distance.
    mean = np.concatenate([directions[:1], directions[:-1] + directions[1:], directions[-1:]])
    mean /= np.linalg.norm(mean, axis=1)[:, None]
    cosine = np.einsum("ki,ki->k", mean, np.concatenate([directions[:1], directions]))
    across = np.stack([np.zeros(len(mean)), mean[:, 2], -mean[:, 1]], axis=1) * (radius / cosine)[:, None]
    return np.stack([knots + across, knots - across])
