"""Sections of walls by the plane x = 0, drawn in the y-z plane."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Polygon

from analysis.runs import Run
from analysis.surfaces import Surface, wall

_COLOUR = "0.55"
_PLANE = 1000.0  # half the side of the patch of a plane, units: beyond every picture


def draw_surroundings(axes: Axes, run: Run) -> None:
    """Draws the vessel and the boxes that a run's parameters name; z to the right, y up, both in units.

    Raises
    ------
    analysis.surfaces.SurfaceError
        The vessel is of a kind that is not drawn.
    """
    vessel = run.parameters.get("vessel")
    if vessel and vessel["shape"] == "tube":
        for side in tube_sides(np.array(vessel["knots"], float), vessel["radius"]):
            axes.plot(side[:, 2], side[:, 1], color=_COLOUR, linewidth=1.2)
    elif (surface := wall(run.parameters, np.zeros(3), _PLANE)) is not None:
        axes.add_collection(LineCollection(section(surface), colors=_COLOUR, linewidths=1.2), autolim=False)
    for obstacle in run.parameters.get("obstacles") or []:
        if obstacle["shape"] == "box":
            (_, y, z), (_, across, along) = obstacle["centre"], obstacle["halfSize"]
            corners = [(z + i * along, y + j * across) for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            axes.add_patch(Polygon(corners, facecolor="0.88", edgecolor=_COLOUR, zorder=1))


def section(surface: Surface) -> np.ndarray:
    """Where the triangles meet the plane x = 0: segments (k, 2, 2), each two points (z, y), in units."""
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
    """Both sides of a tube in the y-z plane, shape (2, k, 3), in units: its knots moved across by the radius."""
    directions = np.diff(knots, axis=0)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    # Where two pieces meet, along the bisector, so far that both sides keep their distance.
    mean = np.concatenate([directions[:1], directions[:-1] + directions[1:], directions[-1:]])
    mean /= np.linalg.norm(mean, axis=1)[:, None]
    cosine = np.einsum("ki,ki->k", mean, np.concatenate([directions[:1], directions]))
    across = np.stack([np.zeros(len(mean)), mean[:, 2], -mean[:, 1]], axis=1) * (radius / cosine)[:, None]
    return np.stack([knots + across, knots - across])
