"""A picture of a vessel: its wall from two sides, rims with their numbers, the centreline, defects."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from guidewire.anatomy.centreline import Centreline
from guidewire.anatomy.inspection import Inspection
from guidewire.anatomy.mesh import Mesh
from guidewire.anatomy.sampling import thinned

_MOST = 60_000  # triangles drawn
_LIGHT = np.array([0.3, 0.4, 0.85])


def draw(mesh: Mesh, found: Inspection, line: Centreline | None, title: str) -> Figure:
    """Return the vessel along the two axes across which it is largest; lengths in mm."""
    mm = 1e3 * found.unit.metres
    order = np.argsort(-np.ptp(mesh.vertices, axis=0), kind="stable")
    across = [(order[0], order[1], order[2]), (order[0], order[2], order[1])]
    sides = mm * np.ptp(mesh.vertices, axis=0)[order]
    width = 11.0
    heights = [max(2.2, min(9.0, width * sides[k] / sides[0])) for k in (1, 2)]
    figure = Figure(figsize=(width + 1.6, sum(heights) + 1.6), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(2, 1, gridspec_kw={"height_ratios": heights})
    figure.suptitle(title)
    for panel, (i, j, depth) in zip(panels, across):
        _wall(panel, mesh, mm, i, j, depth)
        if line is not None:
            _centreline(panel, line, mm, i, j)
        for places, colour, label in ((found.crossings, "magenta", "crossings"), (found.crowded, "red", "bad edges"),
                                      (found.slivers, "orange", "slivers")):
            if len(places):
                panel.plot(mm * places[:, i], mm * places[:, j], "x", color=colour, label=label, zorder=5)
        ends = line.ends if line is not None else found.rims
        for end in ends:
            panel.plot(mm * end.centre[i], mm * end.centre[j], "o", color="tab:blue", ms=4, zorder=6)
            panel.annotate(str(end.number), (mm * end.centre[i], mm * end.centre[j]), xytext=(4, 4),
                           textcoords="offset points", color="tab:blue", weight="bold", zorder=7)
        panel.set_xlabel(f"{'xyz'[i]} (mm)")
        panel.set_ylabel(f"{'xyz'[j]} (mm)")
        panel.set_aspect("equal")
        panel.margins(0.03)
        if panel.get_legend_handles_labels()[1]:
            panel.legend(loc="best")
    return figure


def _wall(panel, mesh: Mesh, mm: float, i: int, j: int, depth: int) -> None:
    if len(mesh.triangles) > _MOST:
        area = np.linalg.norm(mesh.area_vectors(), axis=1).sum()
        mesh = thinned(mesh, np.sqrt(2.3 * area / _MOST))
    corners = mesh.corners
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    shade = 0.55 + 0.4 * np.abs(normals[:, [i, j, depth]] @ _LIGHT)
    order = np.argsort(corners[:, :, depth].mean(axis=1), kind="stable")
    colours = np.clip(shade[order, None] * np.array([0.93, 0.78, 0.74]), 0.0, 1.0)
    panel.add_collection(PolyCollection(mm * corners[order][:, :, [i, j]], facecolors=colours, edgecolors="none",
                                        alpha=0.35, rasterized=True))
    panel.autoscale_view()


def _centreline(panel, line: Centreline, mm: float, i: int, j: int) -> None:
    own = np.flatnonzero(line.parents >= 0)
    pieces = np.stack([line.points[own], line.points[line.parents[own]]], axis=1)[:, :, [i, j]]
    drawn = LineCollection(mm * pieces, array=mm * line.radii[own], cmap="viridis", linewidths=1.5, zorder=4)
    panel.add_collection(drawn)
    panel.figure.colorbar(drawn, ax=panel, label="radius (mm)", shrink=0.8)
