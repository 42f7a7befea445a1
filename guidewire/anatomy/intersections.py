"""Self-intersections of a mesh: edges of a triangle that pierce another one with no vertex in common."""

from __future__ import annotations

import numpy as np

from guidewire.anatomy.mesh import Mesh

_CHUNK = 2_000_000  # pairs of boxes compared at once


def self_intersections(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Do as `_crossings`, once for each mesh, since check, repair and remeshing ask for that of the same one."""
    known = vars(mesh)
    if "crossings" not in known:
        known["crossings"] = _crossings(mesh)
    return known["crossings"]


def _crossings(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Return points (k, 3) where an edge pierces a triangle, and (k, 2) the edge's triangle and the pierced one.

    Pairs come from a lattice of cells a little larger than the median edge: two triangles that meet share a cell.
    Triangles that touch in a plane common to both, or only in a vertex, do not count.
    """
    corners = mesh.corners
    low, high = corners.min(axis=1), corners.max(axis=1)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    hits, pairs, order = [np.empty((0, 3))], [np.empty((0, 2), dtype=int)], [np.empty(0, dtype=int)]
    for first, second, part in _together(_candidates(low, high, float(np.median(high - low)) * 2.0 + 1e-300)):
        near = ((low[first] <= high[second]) & (low[second] <= high[first])).all(axis=1)
        first, second, part = first[near], second[near], part[near]
        apart = ~(mesh.triangles[first][:, :, None] == mesh.triangles[second][:, None, :]).any(axis=(1, 2))
        first, second, part = first[apart], second[apart], part[apart]
        for side, (a, b) in enumerate(((first, second), (second, first))):
            # An edge can only pierce what has not all of its triangle on one side.
            sides = np.einsum("kij,kj->ki", corners[a] - corners[b, :1], normals[b])
            both = (sides.min(axis=1) < 0.0) & (sides.max(axis=1) > 0.0)
            a, b = a[both], b[both]
            for k in range(3):
                point, pierced = _pierce(corners[a, k], corners[a, (k + 1) % 3], corners[b])
                hits.append(point[pierced])
                pairs.append(np.stack([a[pierced], b[pierced]], axis=1))
                order.append(6 * part[both][pierced] + 3 * side + k)
    # However many parts were taken together, the first of equal points is the same.
    sorting = np.argsort(np.concatenate(order), kind="stable")
    points, found = np.concatenate(hits)[sorting], np.concatenate(pairs)[sorting]
    if not len(points):
        return points, found
    # An edge belongs to two triangles, and a pair may share several cells.
    _, kept = np.unique(np.round(points / (1e-9 * mesh.diagonal)), axis=0, return_index=True)
    return points[kept], found[kept]


def relaxed(mesh: Mesh) -> Mesh:
    """Return the mesh with vertices of triangles that cross others moved to the middle of their neighbours, until none
    do."""
    for _ in range(10):
        _, pairs = self_intersections(mesh)
        if not len(pairs):
            break
        vertices = mesh.vertices.copy()
        for vertex in np.unique(mesh.triangles[pairs.ravel()]):
            around = np.unique(mesh.triangles[(mesh.triangles == vertex).any(axis=1)])
            vertices[vertex] = mesh.vertices[around].mean(axis=0)
        mesh = Mesh(vertices, mesh.triangles)
    return mesh


def _together(parts):
    """Small parts of pairs as one, with the number of the part of each pair."""
    kept, count = [], 0
    for number, (first, second) in enumerate(parts):
        kept.append((first, second, np.full(len(first), number)))
        count += len(first)
        if count >= _CHUNK:
            yield tuple(map(np.concatenate, zip(*kept)))
            kept, count = [], 0
    if kept:
        yield tuple(map(np.concatenate, zip(*kept)))


def _candidates(low: np.ndarray, high: np.ndarray, size: float):
    """Pairs of triangles whose boxes share a cell, in chunks, each pair once per common cell."""
    origin = low.min(axis=0)
    first_cell = np.floor((low - origin) / size).astype(np.int64)
    spans = np.floor((high - origin) / size).astype(np.int64) - first_cell + 1
    # A triangle far larger than the others would fill too many cells.
    while spans.prod(axis=1).sum() > 40 * len(low) + 1_000_000:
        size *= 1.5
        first_cell = np.floor((low - origin) / size).astype(np.int64)
        spans = np.floor((high - origin) / size).astype(np.int64) - first_cell + 1
    counts = spans.prod(axis=1)
    owner = np.repeat(np.arange(len(low)), counts)
    within = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    span = spans[owner]
    offset = np.stack([within // (span[:, 1] * span[:, 2]), within // span[:, 2] % span[:, 1], within % span[:, 2]], 1)
    cell = first_cell[owner] + offset
    shape = cell.max(axis=0) + 1
    key = (cell[:, 0] * shape[1] + cell[:, 1]) * shape[2] + cell[:, 2]
    order = np.argsort(key, kind="stable")
    owner, key = owner[order], key[order]
    start = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    end = np.r_[start[1:], len(key)]
    shift = 1
    position = np.arange(len(owner))
    last = np.repeat(end, end - start)
    while True:
        own = position[position + shift < last[position]]
        if not len(own):
            return
        for k in range(0, len(own), _CHUNK):
            part = own[k:k + _CHUNK]
            yield owner[part], owner[part + shift]
        position = own
        shift += 1


def _pierce(start: np.ndarray, end: np.ndarray, triangle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find where segments (k, 3) meet the planes of triangles (k, 3, 3), and whether that is inside both."""
    a, b, c = np.moveaxis(triangle, 1, 0)
    normal = np.cross(b - a, c - a)
    above, below = np.einsum("ij,ij->i", start - a, normal), np.einsum("ij,ij->i", end - a, normal)
    crosses = above * below < 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        point = start + (above / (above - below))[:, None] * (end - start)
        for u, w in ((a, b), (b, c), (c, a)):
            crosses &= np.einsum("ij,ij->i", np.cross(w - u, point - u), normal) > 0.0
    return point, crosses
