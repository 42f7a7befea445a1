"""Loops of a lumen: where two of its ways meet again, so that the tree of its centreline is cut there; and necks, where
two vessels touch.

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
_NECK = 0.85  # of what is around it: a narrower place may be where two vessels touch
_NEAR = 4.0  # radii of the wider lumen around, within which both vessels pass by, and the neck lies
_WIDER = np.array([1.0, 1.4, 2.0, 2.8, 4.0])  # times that wider: how wide what is around may be
_CHUNK = 2_000_000  # distances computed at once


@dataclass(frozen=True)
class Loop:
    """place (3,) where two ways meet; radius : of the lumen there, about; points : of the centreline on the two sides.
    """

    place: np.ndarray
    radius: float
    points: tuple[int, int]


@dataclass(frozen=True)
class Neck:
    """place (3,) where two vessels may touch; radius : of the way between them; points : of the centreline there."""

    place: np.ndarray
    radius: float
    points: tuple[int, ...]


def find_necks(points: np.ndarray, radii: np.ndarray, parents: np.ndarray, loops: list[Loop]) -> list[Neck]:
    """Find where two vessels touch: a narrow place from which, on two sides, two wider ways lead on. Between two
    stretches of one vessel there is one on each; and where it branches the sphere of the fork is the largest.

    Parameters
    ----------
    points, radii, parents : of the tree, (k, 3), (k,), (k,).
    loops : ways of the tree between which there is another one, of points with an index of its own.
    """
    # Branches of a tree may run side by side in one vessel: points within half a radius are one place.
    tree, place_of = cKDTree(points), np.full(len(points), -1)
    for k in range(len(points)):
        if place_of[k] < 0:
            near = np.array(tree.query_ball_point(points[k], 0.5 * max(radii[k], 1e-300)))
            place_of[near[place_of[near] < 0]] = k
    beside: dict[int, set[int]] = {int(place): set() for place in place_of}
    for a, b in [*((k, parent) for k, parent in enumerate(parents) if parent >= 0), *(loop.points for loop in loops)]:
        if place_of[a] != place_of[b]:
            beside[int(place_of[a])].add(int(place_of[b]))
            beside[int(place_of[b])].add(int(place_of[a]))

    def reached(start: int, barred: set[int], limit: float, most: float = np.inf) -> tuple[set[int], int]:
        """Places from one on that are narrower than the most, up to a limit, and how many ways lead on beyond it."""
        gone, left, exits = {start: 0.0}, [start], []
        while left:
            place = left.pop()
            for other in beside[place] - barred:
                far = gone[place] + float(np.linalg.norm(points[other] - points[place]))
                if radii[other] >= most or far >= gone.get(other, np.inf):
                    continue
                gone[other] = far
                if far <= limit:
                    left.append(other)
                elif all(np.linalg.norm(points[other] - known) > 0.5 * limit for known in exits):
                    exits.append(points[other])
        return set(gone), len(exits)

    found: list[Neck] = []
    for start in sorted(beside, key=lambda place: radii[place]):
        if len(beside[start]) < 2 or radii[start] > min(radii[other] for other in beside[start]) or any(
                start in neck.points for neck in found):
            continue
        neck: set[int] = set()
        for wide in radii[start] / _NECK * _WIDER:
            own, ways = reached(start, set(), _NEAR * wide, wide)
            if ways:
                break
            sides: list[tuple[set[int], int]] = []
            for first in {other for place in own for other in beside[place]} - own:
                if not any(first in side for side, _ in sides):
                    sides.append(reached(first, own, _NEAR * wide))
            counts = [count for _, count in sides]
            if sum(counts) > 3 and sum(counts) - max(counts) > 1:
                neck = own
        if neck:
            found.append(Neck(points[start], float(radii[start]), tuple(np.flatnonzero(np.isin(place_of, list(neck))))))
    return found


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
