"""Loops of a lumen: where two of its ways meet again, so that the tree of its centreline is cut there.

A closed surface of v vertices, e edges and f triangles encloses (2 - v + e - f)/2 loops. Each vertex of the wall
belongs to the inscribed sphere of the centreline with the least power. Where neighbouring vertices belong to spheres
that are far from each other along the tree, two ways through the vessel meet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from guidewire.anatomy.mesh import Edges, Mesh

_FAR = 6.0  # radii of both spheres, along the tree: ways farther apart are no two branches of one fork
_CHUNK = 2_000_000  # distances computed at once


@dataclass(frozen=True)
class Loop:
    """place (3,) where two ways meet; radius : of the lumen there, about; points : of the centreline on the two sides.
    """

    place: np.ndarray
    radius: float
    points: tuple[int, int]


def count_loops(closed: Mesh) -> int:
    """Count of a closed surface the most circles along which it can be cut without falling apart."""
    used = len(np.unique(closed.triangles))
    return (2 - used + len(Edges.of(closed).ends) - len(closed.triangles)) // 2


def find_loops(closed: Mesh, points: np.ndarray, radii: np.ndarray, parents: np.ndarray) -> list[Loop]:
    """Find where ways meet that the tree does not join, as many as the surface has loops, or fewer.

    Parameters
    ----------
    closed : the wall, closed.
    points, radii, parents : of the tree, (k, 3), (k,), (k,).
    """
    count = count_loops(closed)
    if count <= 0:
        return []
    owner = _owners(closed.vertices, points, radii)
    ends = Edges.of(closed).ends
    pairs = owner[ends]
    rows = np.flatnonzero(pairs[:, 0] != pairs[:, 1])
    unique, of_row = np.unique(np.sort(pairs[rows], axis=1), axis=0, return_inverse=True)
    depth = _depths(points, parents)
    apart = np.array([_apart(depth, parents, a, b) for a, b in unique])
    far = apart > _FAR * radii[unique].sum(axis=1)
    is_far = far[of_row]
    rows, of_row = rows[is_far], of_row[is_far]
    if not len(rows):
        return []
    middles = closed.vertices[ends[rows]].mean(axis=1)
    reach = radii[unique[of_row]].max(axis=1)
    near = cKDTree(middles).query_pairs(float(reach.max()), output_type="ndarray")
    near = near[np.linalg.norm(middles[near[:, 0]] - middles[near[:, 1]], axis=1) <= reach[near].max(axis=1)]
    graph = coo_matrix((np.ones(len(near)), near.T), shape=(len(rows), len(rows)))
    labels = connected_components(graph, directed=False)[1]
    found = []
    for label in range(labels.max() + 1):
        own = np.flatnonzero(labels == label)
        place = middles[own].mean(axis=0)
        gaps = np.linalg.norm(points[unique[of_row[own], 0]] - points[unique[of_row[own], 1]], axis=1)
        a, b = unique[of_row[own[int(np.argmin(gaps))]]]
        radius = float(np.linalg.norm(middles[own] - place, axis=1).mean())
        found.append((float(apart[of_row[own]].max()), Loop(place, radius, (int(a), int(b)))))
    found.sort(key=lambda one: -one[0])
    return [loop for _, loop in found[:count]]


def _owners(vertices: np.ndarray, points: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Return (v,): of each vertex the sphere with the least power."""
    weights = np.einsum("ij,ij->i", points, points) - radii**2
    step = max(1, _CHUNK // len(points))
    return np.concatenate([np.argmin(weights - 2.0 * vertices[k:k + step] @ points.T, axis=1)
                           for k in range(0, len(vertices), step)])


def _depths(points: np.ndarray, parents: np.ndarray) -> np.ndarray:
    """Return (k,): distances from the root along the tree."""
    depth = np.zeros(len(points))
    for k in range(1, len(points)):  # parents come first
        depth[k] = depth[parents[k]] + np.linalg.norm(points[k] - points[parents[k]])
    return depth


def _apart(depth: np.ndarray, parents: np.ndarray, a: int, b: int) -> float:
    """Length of the tree's path between two points."""
    total = depth[a] + depth[b]
    while a != b:
        if a > b:
            a = parents[a]
        else:
            b = parents[b]
    return float(total - 2.0 * depth[a])
