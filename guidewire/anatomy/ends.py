"""Closed ends cut open, for a vessel that was closed by caps."""

from __future__ import annotations

from guidewire.anatomy.centreline import find_centreline
from guidewire.anatomy.distance_grid import cut_open
from guidewire.anatomy.inspection import sort_rims
from guidewire.anatomy.mesh import Edges, find_rims
from guidewire.anatomy.repair import Change, Repaired, with_rims_apart

_BACK = 1.0  # radii inside of an end: behind any cap, round or flat


def open_ends(repaired: Repaired) -> Repaired:
    """The vessel without the last radius of every branch that ends closed."""
    mesh = repaired.mesh
    line = find_centreline(mesh, repaired.rims)
    count = 0
    for end in line.ends:
        if end.is_open:
            continue
        cut = cut_open(mesh, end.centre + _BACK * end.radius * end.direction, end.direction, 1.5 * end.radius)
        count += cut is not mesh
        mesh = cut
    mesh, _ = with_rims_apart(mesh)
    change = Change("closed ends cut open one radius inside", count)
    return Repaired(mesh, sort_rims(mesh, find_rims(mesh, Edges.of(mesh))), [*repaired.changes, change])
