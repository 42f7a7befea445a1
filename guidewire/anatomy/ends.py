"""Closed ends cut open, for a vessel that was closed by caps."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from guidewire.anatomy.centreline import End, find_centreline
from guidewire.anatomy.distance_grid import cut_open
from guidewire.anatomy.inspection import sort_rims
from guidewire.anatomy.mesh import AnatomyError, Edges, Mesh, find_rims
from guidewire.anatomy.reading import Faces
from guidewire.anatomy.repair import Change, Repaired, with_rims_apart
from guidewire.anatomy.surfaces import nearest

_BACK = 1.0  # radii inside of an end: behind any cap, round or not quite flat
_FLAT = np.cos(np.radians(3.0))  # between normals of a flat cap
_SHARP = np.cos(np.radians(40.0))  # between a cap and the wall around it
_RAISED = 0.8  # of a face's area, that its projection has at least where it is a cap
_SIZES = (0.5, 1.7)  # radius of a cap over that of the lumen


def open_ends(repaired: Repaired, numbers: list[int] | None = None) -> Repaired:
    """Return the vessel without its caps, and without the last radius of other branches that end closed.

    numbers : of the ends to open, as a report without opened ones has them; None: all but domes of sacs.

    Raises
    ------
    AnatomyError : there is no such end.
    """
    mesh = repaired.mesh
    line = find_centreline(mesh, repaired.rims)
    known = [end.number for end in line.ends]
    for number in numbers or []:
        if number not in known:
            raise AnatomyError(f"--open {number}: there are the ends {', '.join(map(str, known))}")
    changes = {"caps taken off": 0, "closed ends cut open one radius inside": 0}
    for end in line.ends:
        if end.is_open or (end.is_sac if numbers is None else end.number not in numbers):
            continue
        cap = _flat_cap(mesh, end)
        cut = cut_open(mesh, end.centre + _BACK * end.radius * end.direction, end.direction, 1.5 * end.radius) if (
            cap is None) else mesh.part(~cap)
        if cut is not mesh:
            changes["caps taken off" if cap is not None else "closed ends cut open one radius inside"] += 1
        mesh = cut
    mesh, _ = with_rims_apart(mesh)
    return Repaired(mesh, sort_rims(mesh, find_rims(mesh, Edges.of(mesh))),
                    [*repaired.changes, *(Change(name, count) for name, count in changes.items() if count)])


def without_caps(repaired: Repaired, faces: Faces) -> Repaired:
    """Return the vessel without those of a file's faces that are flat, or nearly, and have a sharp rim: its caps,
    however small the vessels are that end there."""
    mesh = repaired.mesh
    own, vectors = np.unique(faces.of(mesh), return_inverse=True)[1], mesh.area_vectors()
    areas = np.linalg.norm(vectors, axis=1)
    normals = vectors / np.maximum(areas, 1e-300)[:, None]
    pairs = Edges.of(mesh).pairs()
    pairs = pairs[own[pairs[:, 0]] != own[pairs[:, 1]]]
    is_sharp = np.einsum("ij,ij->i", normals[pairs[:, 0]], normals[pairs[:, 1]]) < _SHARP
    count = int(own.max()) + 1
    borders, sharp = (np.bincount(own[pairs].ravel(), np.repeat(weights, 2), count)
                      for weights in (np.ones(len(pairs)), is_sharp))
    sums = np.stack([np.bincount(own, vectors[:, k], count) for k in range(3)], axis=1)
    is_flat = np.linalg.norm(sums, axis=1) > _RAISED * np.bincount(own, areas, count)
    caps = np.flatnonzero(is_flat & (sharp > 0.9 * borders) & (borders > 0.0))
    if not len(caps):
        return repaired
    mesh, _ = with_rims_apart(mesh.part(~np.isin(own, caps)))
    return Repaired(mesh, sort_rims(mesh, find_rims(mesh, Edges.of(mesh))),
                    [*repaired.changes, Change("caps taken off, faces of the file", len(caps))])


def _is_as_wide(area: float, end: End) -> bool:
    """Return whether an area is that of a cap over an end."""
    return _SIZES[0] * end.radius < np.sqrt(area / np.pi) < _SIZES[1] * end.radius


def _flat_cap(mesh: Mesh, end: End) -> np.ndarray | None:
    """Return (t,): the triangles of a flat cap with a sharp rim over an end; None where there is none."""
    normals = mesh.area_vectors()
    areas = np.linalg.norm(normals, axis=1)
    normals = normals / np.maximum(areas, 1e-300)[:, None]
    seed = int(nearest(end.centre[None], mesh)[1][0])
    is_flat = normals @ normals[seed] > _FLAT
    pairs = Edges.of(mesh).pairs()
    both = pairs[is_flat[pairs].all(axis=1)]
    graph = coo_matrix((np.ones(len(both)), both.T), shape=(len(areas), len(areas)))
    labels = connected_components(graph, directed=False)[1]
    cap = is_flat & (labels == labels[seed])
    border = pairs[cap[pairs].sum(axis=1) == 1]
    if not len(border) or not _is_as_wide(float(areas[cap].sum()), end):
        return None
    is_sharp = np.einsum("ij,ij->i", normals[border[:, 0]], normals[border[:, 1]]) < _SHARP
    return cap if is_sharp.mean() > 0.9 else None
