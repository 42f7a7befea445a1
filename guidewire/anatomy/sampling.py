"""Polylines in even steps, and surfaces with more or fewer vertices."""

from __future__ import annotations

import numpy as np

from guidewire.anatomy.mesh import Edges, Mesh

_MOST_CUTS = 8.0  # triangles of a sample over its points, as cut at all long edges


def resample(line: np.ndarray, step: float) -> np.ndarray:
    """Return a polyline (k, 3) in even steps, its ends kept; two points at least."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    arc = np.r_[0.0, np.cumsum(steps)]
    if not arc[-1] > 0.0:
        return line[[0, -1]] if len(line) > 1 else np.repeat(line, 2, axis=0)
    count = max(2, int(round(arc[-1] / step)) + 1)
    stations = np.linspace(0.0, arc[-1], count)
    return np.stack([np.interp(stations, arc, line[:, k]) for k in range(3)], axis=1)


def sample(mesh: Mesh, count: int) -> Mesh:
    """Return the same surface with triangles cut, until there are about so many vertices; or with fewer of them."""
    area = np.linalg.norm(mesh.area_vectors(), axis=1).sum()
    limit = np.sqrt(2.3 * area / count)
    if len(mesh.vertices) > 2 * count:
        return thinned(mesh, limit)
    longest = _longest(mesh)
    # Triangles that are long and narrow are cut across only: cut at all edges they would be as many as their length
    # squared.
    is_narrow = ((longest / limit)**2).sum() > _MOST_CUTS * count
    for _ in range(64 if is_narrow else 12):
        edges = Edges.of(mesh)
        ends = mesh.vertices[edges.ends]
        lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
        long = lengths > 1.5 * limit
        if not long.any():
            break
        if is_narrow:
            own = edges.of_triangles[np.arange(len(mesh.triangles)), lengths[edges.of_triangles].argmax(axis=1)]
            is_longest = np.zeros(len(long), dtype=bool)
            is_longest[own] = True
            long &= is_longest
        mesh = cut_edges(mesh, edges, long)
    return thinned(mesh, limit) if is_narrow else mesh


def _longest(mesh: Mesh) -> np.ndarray:
    """Return (t,): the longest edge of each triangle."""
    corners = mesh.corners
    return np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).max(axis=1)


def thinned(mesh: Mesh, size: float) -> Mesh:
    """Return one vertex a cell of a lattice; triangles that lose a corner are dropped."""
    cells = np.floor((mesh.vertices - mesh.vertices.min(axis=0)) / size).astype(np.int64)
    shape = cells.max(axis=0) + 1
    key = (cells[:, 0] * shape[1] + cells[:, 1]) * shape[2] + cells[:, 2]
    _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
    triangles = inverse[mesh.triangles]
    whole = (triangles[:, 0] != triangles[:, 1]) & (triangles[:, 1] != triangles[:, 2]) & (
        triangles[:, 2] != triangles[:, 0])
    return Mesh(mesh.vertices[first], triangles[whole])


def cut_edges(mesh: Mesh, edges: Edges, long: np.ndarray) -> Mesh:
    """Return every triangle cut at the middles of its long edges."""
    middle = np.full(len(edges.ends), -1)
    middle[long] = len(mesh.vertices) + np.arange(long.sum())
    vertices = np.concatenate([mesh.vertices, mesh.vertices[edges.ends[long]].mean(axis=1)])
    parts = []
    halves = middle[edges.of_triangles]
    marked = halves >= 0
    count = marked.sum(axis=1)
    parts.append(mesh.triangles[count == 0])
    for k in range(3):
        # Corners a, b, c with the edge a-b first.
        turn = [k, (k + 1) % 3, (k + 2) % 3]
        one = (count == 1) & marked[:, k]
        a, b, c = mesh.triangles[one][:, turn].T
        m = halves[one, k]
        parts += [np.stack([a, m, c], 1), np.stack([m, b, c], 1)]
        two = (count == 2) & ~marked[:, k]
        a, b, c = mesh.triangles[two][:, turn].T
        m, n = halves[two, (k + 1) % 3], halves[two, (k + 2) % 3]
        parts += [np.stack([a, b, m], 1), np.stack([a, m, n], 1), np.stack([n, m, c], 1)]
    three = count == 3
    a, b, c = mesh.triangles[three].T
    p, q, r = halves[three].T
    parts += [np.stack([a, p, r], 1), np.stack([p, b, q], 1), np.stack([r, q, c], 1), np.stack([p, q, r], 1)]
    return Mesh(vertices, np.concatenate(parts))
