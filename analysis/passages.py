"""Passages through a vessel's wall, counted from logs by winding numbers: independent of the simulation's own count.

The winding number of a closed surface around a point is the sum of the triangles' solid angles over 4 pi, 1 inside and
0 outside (van Oosterom and Strackee 1983). Open rims are closed by fans first. A passage is a point of the wire, ten an
element and the last sphere, that is inside after one entry of the log and outside after the next one, and did not leave
through a rim.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

SAMPLES = 10  # points an element

_LEAF = 48  # triangles in a cluster
_FAR = 3.0  # cluster radii from which on a cluster counts as one dipole: an error of some 1e-3 of a turn
_BLOCK = 4_000_000  # point-triangle pairs at a time


class MeshError(Exception):
    """A mesh that cannot be closed. The message is one line."""


@dataclass(frozen=True)
class Wall:
    """A vessel's wall.

    Attributes
    ----------
    triangles : ndarray, shape (t, 3, 3)
        Corners, in units; all seen from the same side in the same sense.
    fans : ndarray, shape (f, 3, 3)
        Triangles that close the open rims.
    """

    triangles: np.ndarray
    fans: np.ndarray

    @classmethod
    def of(cls, vertices: np.ndarray, faces: np.ndarray) -> Wall:
        """A wall from vertices (v, 3) in units and triangles (t, 3) of their indices.

        Raises
        ------
        MeshError
            An edge belongs to two triangles in the same sense, or its rims are no simple loops.
        """
        edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
        known = {(int(a), int(b)) for a, b in edges}
        if len(known) != len(edges):
            raise MeshError("two triangles share an edge in the same sense")
        following = {b: a for a, b in known if (b, a) not in known}  # the closing fan runs against the rim's edges
        fans = []
        while following:
            start, loop = next(iter(following)), []
            at = start
            while at in following:
                loop.append(at)
                at = following.pop(at)
            if at != start:
                raise MeshError("a rim is not a simple loop")
            ring = vertices[loop]
            centre = np.broadcast_to(ring.mean(axis=0), ring.shape)
            fans.append(np.stack([ring, np.roll(ring, -1, axis=0), centre], axis=1))
        return cls(vertices[faces], np.concatenate(fans) if fans else np.empty((0, 3, 3)))

    def winding_numbers(self, points: np.ndarray) -> np.ndarray:
        """Turns of the closed wall around points (p, 3) in units, shape (p,); their sign is the triangles' sense."""
        return _Clusters(np.concatenate([self.triangles, self.fans])).winding_numbers(points)


def sample_wire(positions: np.ndarray) -> np.ndarray:
    """Points at s = 0, 0.1, ... 0.9 of each element and the last sphere: (..., n + 1, 3) to (..., 10 n + 1, 3)."""
    fraction = np.arange(SAMPLES)[:, None] / SAMPLES
    first, second = positions[..., :-1, None, :], positions[..., 1:, None, :]
    points = (1.0 - fraction) * first + fraction * second
    points = points.reshape(*positions.shape[:-2], -1, 3)
    return np.concatenate([points, positions[..., -1:, :]], axis=-2)


def inside(wall: Wall, positions: np.ndarray) -> np.ndarray:
    """Whether each sample of a wire is in the lumen: positions (k, n + 1, 3) in units to bool (k, 10 n + 1).

    A sample whose way since the entry before is shorter than its distance from every triangle is where it was; only
    the others are asked again.
    """
    points = sample_wire(positions)
    closed = np.concatenate([wall.triangles, wall.fans])
    clusters = _Clusters(closed)
    centres = closed.mean(axis=1)
    reach = np.max(np.linalg.norm(closed - centres[:, None], axis=-1))
    distance = cKDTree(centres).query(points[:-1].reshape(-1, 3))[0].reshape(len(points) - 1, points.shape[1]) - reach
    moved = np.linalg.norm(np.diff(points, axis=0), axis=-1)
    unsure = np.concatenate([np.ones((1, points.shape[1]), bool), moved >= distance])
    state = np.zeros(points.shape[:2], bool)
    state[unsure] = np.abs(clusters.winding_numbers(points[unsure])) > 0.5
    last_asked = np.maximum.accumulate(np.where(unsure, np.arange(len(points))[:, None], 0), axis=0)
    return np.take_along_axis(state, last_asked, axis=0)


def count_passages(wall: Wall, positions: np.ndarray) -> int:
    """Passages of a wire's samples through the wall.

    Parameters
    ----------
    wall : Wall
        The vessel.
    positions : ndarray, shape (k, n + 1, 3)
        Of all spheres after successive steps, in units.
    """
    lumen = inside(wall, positions)
    points = sample_wire(positions)
    left = lumen[:-1] & ~lumen[1:]
    return int(np.count_nonzero(~_meet(points[:-1][left], points[1:][left], wall.fans)))


def _meet(start: np.ndarray, end: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Whether each segment (p, 3) to (p, 3) meets one of the triangles (t, 3, 3), shape (p,)."""

    def volume(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
        return np.einsum("...i,...i", np.cross(b - a, c - a), d - a)

    p, q = start[:, None], end[:, None]
    a, b, c = (triangles[None, :, k] for k in range(3))
    sides = [volume(p, q, *pair) for pair in ((a, b), (b, c), (c, a))]
    around = np.all(np.array(sides) >= 0.0, axis=0) | np.all(np.array(sides) <= 0.0, axis=0)
    across = volume(a, b, c, p) * volume(a, b, c, q) <= 0.0
    return np.any(around & across, axis=1)


class _Clusters:
    """Triangles in groups of neighbours, so that those far from a point count as one dipole."""

    def __init__(self, triangles: np.ndarray) -> None:
        self._triangles = triangles
        areas = 0.5 * np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        centres = triangles.mean(axis=1)
        self._groups = list(_split(centres, np.arange(len(triangles))))
        size = np.linalg.norm(areas, axis=1)
        weights = [size[group, None] / size[group].sum() if size[group].sum() > 0 else 1.0 / group.size
                   for group in self._groups]
        self._centres = np.array([(w * centres[g]).sum(axis=0) for w, g in zip(weights, self._groups)])
        self._areas = np.array([areas[group].sum(axis=0) for group in self._groups])
        self._radii = np.array([
            np.linalg.norm(triangles[group] - centre, axis=-1).max()
            for group, centre in zip(self._groups, self._centres)
        ])

    def winding_numbers(self, points: np.ndarray) -> np.ndarray:
        turns = np.zeros(len(points))
        for group, centre, area, radius in zip(self._groups, self._centres, self._areas, self._radii):
            offset = centre - points
            distance = np.linalg.norm(offset, axis=1)
            far = distance > _FAR * radius
            turns[far] += offset[far] @ area / distance[far] ** 3
            turns[~far] += self._solid_angles(group, points[~far])
        return turns / (4.0 * np.pi)

    def _solid_angles(self, group: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Sum of a group's solid angles seen from points (p, 3), shape (p,)."""
        angles = np.empty(len(points))
        block = max(1, _BLOCK // group.size)
        for first in range(0, len(points), block):
            a, b, c = (self._triangles[group, k] - points[first:first + block, None] for k in range(3))
            la, lb, lc = (np.linalg.norm(v, axis=-1) for v in (a, b, c))
            volume = np.einsum("...i,...i", a, np.cross(b, c))
            dots = [np.einsum("...i,...i", u, v) for u, v in ((a, b), (b, c), (c, a))]
            below = la * lb * lc + dots[0] * lc + dots[1] * la + dots[2] * lb
            angles[first:first + block] = 2.0 * np.arctan2(volume, below).sum(axis=1)
        return angles


def _split(centres: np.ndarray, group: np.ndarray):
    """Groups of at most _LEAF indices, halved along the longest side."""
    if group.size <= _LEAF:
        yield group
        return
    axis = np.ptp(centres[group], axis=0).argmax()
    order = group[np.argsort(centres[group, axis], kind="stable")]
    yield from _split(centres, order[: group.size // 2])
    yield from _split(centres, order[group.size // 2:])
