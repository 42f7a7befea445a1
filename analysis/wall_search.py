"""A second search for the distance of a wire's core line from walls, and for which side it is on: written for checks on
logs, from geometry alone.

A mesh is asked in three ways: which segments cross a triangle (orientation of five tetrahedra), how far segments are
from triangles (points, edges and faces in closed form), on which side a point lies (the number of triangles that a ray
meets). Walls in closed form are functions of a point that change by no more than the distance to the next point, so
that the least value along a segment is found by halving it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

from guidewire.logs.surfaces import read_obj

_LEAF = 4  # triangles
_BLOCK = 200_000  # pairs at a time
_FINEST = 1e-12  # of a segment's length
_FLAT = 1e-9  # height over width below which a hull is a plate


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.einsum("...i,...i", a, b)


class MeshSearch:
    """The triangles of a closed mesh, shape (t, 3, 3) in units, in a tree of boxes."""

    def __init__(self, triangles: np.ndarray) -> None:
        depth = max(0, int(np.ceil(np.log2(len(triangles) / _LEAF))))
        size = _LEAF << depth
        order = np.resize(np.arange(len(triangles)), size)  # some stand twice; pairs are made unique
        centres = triangles.mean(axis=1)
        for level in range(depth):
            nodes = order.reshape(1 << level, -1)
            spread = np.ptp(centres[nodes], axis=1).argmax(axis=1)
            keys = np.take_along_axis(centres[nodes], spread[:, None, None], axis=2)[:, :, 0]
            order = np.take_along_axis(nodes, np.argsort(keys, axis=1, kind="stable"), axis=1).ravel()
        self._triangles = triangles
        self._order = order
        self._boxes = []
        low, high = triangles.min(axis=1)[order], triangles.max(axis=1)[order]
        self._low, self._high = low, high
        for level in range(depth + 1):
            shape = (1 << level, -1, 3)
            self._boxes.append((low.reshape(shape).min(axis=1), high.reshape(shape).max(axis=1)))

    def _near(self, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pairs (box, triangle) whose boxes share a point; low and high have shape (p, 3)."""
        box, node = np.arange(len(low)), np.zeros(len(low), int)
        for level, (node_low, node_high) in enumerate(self._boxes):
            if level:
                box, node = np.repeat(box, 2), np.repeat(2 * node, 2)
                node[1::2] += 1
            meet = _meet(low, high, box, node_low, node_high, node)
            box, node = box[meet], node[meet]
        box = np.repeat(box, _LEAF)
        slot = (node[:, None] * _LEAF + np.arange(_LEAF)).ravel()
        meet = _meet(low, high, box, self._low, self._high, slot)
        return self._each_once(box[meet], self._order[slot[meet]])

    def _near_segments(self, a: np.ndarray, b: np.ndarray, range_: float) -> tuple[np.ndarray, np.ndarray]:
        """Pairs (segment, triangle) that may be within a range: of the boxes around 8 pieces of each segment."""
        fraction = np.linspace(0.0, 1.0, 9)[:, None, None]
        ends = (1.0 - fraction) * a + fraction * b
        low = np.minimum(ends[:-1], ends[1:]).reshape(-1, 3) - range_ - 1e-9
        high = np.maximum(ends[:-1], ends[1:]).reshape(-1, 3) + range_ + 1e-9
        piece, triangle = self._near(low, high)
        return self._each_once(piece % len(a), triangle)

    def _each_once(self, first: np.ndarray, triangle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Pairs (first, triangle) in ascending order, each once."""
        return np.divmod(np.unique(first * len(self._triangles) + triangle), len(self._triangles))

    def crosses(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Return whether each segment a b, shapes (p, 3), goes through a triangle, shape (p,)."""
        result = np.zeros(len(a), bool)
        for block in _blocks(len(a), 4000):
            segment, triangle = self._near_segments(a[block], b[block], 0.0)
            through = _goes_through(a[block][segment], b[block][segment], self._triangles[triangle])
            result[block] = np.bincount(segment[through], minlength=len(a[block])) > 0
        return result

    def least_distance(self, a: np.ndarray, b: np.ndarray, known: float) -> float:
        """Least distance in units of segments a b, shapes (p, 3), that cross no triangle, where it is below a known
        one."""
        for block in _blocks(len(a), 500):
            segment, triangle = self._near_segments(a[block], b[block], known)
            for part in _blocks(len(segment), _BLOCK):
                corners = self._triangles[triangle[part]]
                p, q = a[block][segment[part]], b[block][segment[part]]
                known = min(known, _segment_triangle(p, q, corners).min(initial=np.inf))
        return known

    def distance(self, points: np.ndarray) -> np.ndarray:
        """Distance in units of each point, shapes (p, 3) and (p,)."""
        bound = np.full(len(points), np.inf)
        corners = self._triangles[:: max(1, len(self._triangles) // 2000), 0]
        for block in _blocks(len(points), 2000):
            bound[block] = np.linalg.norm(points[block][:, None] - corners, axis=2).min(axis=1)
        for block in _blocks(len(points), 200):
            reach = bound[block][:, None]
            point, triangle = self._near(points[block] - reach, points[block] + reach)
            found = _point_triangle(points[block][point], self._triangles[triangle])
            np.minimum.at(bound, block.start + point, found)
        return bound

    def inside(self, points: np.ndarray) -> np.ndarray:
        """Return whether a ray from each point along x meets an odd number of triangles, shapes (p, 3) and (p,)."""
        turned, turn = _turned(self)
        points = points @ turn.T
        far = turned._high[:, 0].max() + 1.0
        result = np.zeros(len(points), bool)
        for block in _blocks(len(points), 20_000):
            start = points[block]
            end = start.copy()
            end[:, 0] = np.maximum(far, start[:, 0])
            ray, triangle = turned._near(start, end)
            a, b, c = (turned._triangles[triangle, k] - start[ray] for k in range(3))
            sides = np.column_stack([u[:, 1] * v[:, 2] - u[:, 2] * v[:, 1] for u, v in ((a, b), (b, c), (c, a))])
            around = np.all(sides > 0.0, axis=1) | np.all(sides < 0.0, axis=1)
            ahead = dot(a, np.cross(b - a, c - a)) * np.cross(b - a, c - a)[:, 0] > 0.0
            result[block] = np.bincount(ray[around & ahead], minlength=len(start)) % 2 == 1
        return result


def crosses_itself(vertices: np.ndarray, faces: np.ndarray) -> bool:
    """Return whether an edge of a mesh, vertices (v, 3) and faces (t, 3), goes through a face that has neither of its
    ends."""
    edges = np.unique(np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1), axis=0)
    search = MeshSearch(vertices[faces])
    for block in _blocks(len(edges), 4000):
        ends = edges[block]
        edge, face = search._near_segments(vertices[ends[:, 0]], vertices[ends[:, 1]], 0.0)
        apart = ~(faces[face][:, None, :] == ends[edge][:, :, None]).any(axis=(1, 2))
        p, q = vertices[ends[edge[apart]]].transpose(1, 0, 2)
        if _goes_through(p, q, vertices[faces[face[apart]]]).any():
            return True
    return False


def _turned(search: MeshSearch) -> tuple[MeshSearch, np.ndarray]:
    """Return the same triangles turned by an odd rotation, so that no ray meets an edge of a regular mesh; and the
    turn."""
    if not hasattr(search, "turned"):
        turn = np.linalg.qr(np.array([[0.7, 0.31, 0.11], [-0.29, 0.83, 0.23], [0.13, -0.17, 0.91]]))[0]
        search.turned = (MeshSearch(search._triangles @ turn.T), turn)
    return search.turned


def _meet(low: np.ndarray, high: np.ndarray, box: np.ndarray,
          other_low: np.ndarray, other_high: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Which pairs (box, other) of boxes with these corners, (p, 3) and (q, 3), share a point: axis by axis, of those
    that share one so far."""
    left = np.arange(len(box))
    for axis in range(3):
        a, b = box[left], other[left]
        left = left[(low[a, axis] <= other_high[b, axis]) & (other_low[b, axis] <= high[a, axis])]
    return left


def _blocks(count: int, size: int):
    return [slice(first, min(first + size, count)) for first in range(0, count, size)]


def _goes_through(p: np.ndarray, q: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (triangles[:, k] - p for k in range(3))
    path = q - p
    normal = np.cross(b - a, c - a)
    before, after = dot(normal, a), dot(normal, a - path)
    sides = np.column_stack([dot(path, np.cross(u, v)) for u, v in ((a, b), (b, c), (c, a))])
    around = np.all(sides >= 0.0, axis=1) | np.all(sides <= 0.0, axis=1)
    return around & (before * after < 0.0)


def _point_triangle(p: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Distance of points (k, 3) from triangles (k, 3, 3): of the foot in the plane, or of the three sides."""
    a, b, c = (triangles[:, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    size = np.linalg.norm(normal, axis=1)
    sides = np.column_stack([dot(normal, np.cross(v - u, p - u)) for u, v in ((a, b), (b, c), (c, a))])
    over = np.all(sides >= 0.0, axis=1) & (size > 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        height = np.where(over, np.abs(dot(normal, p - a)) / size, np.inf)
    for u, v in ((a, b), (b, c), (c, a)):
        height = np.minimum(height, _point_segment(p, u, v))
    return height


def _point_segment(p: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    path = b - a
    length = dot(path, path)
    s = np.clip(dot(p - a, path) / np.where(length > 0.0, length, 1.0), 0.0, 1.0)
    return np.linalg.norm(p - a - s[..., None] * path, axis=-1)


def _segment_triangle(p: np.ndarray, q: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Distance of segments that do not cross their triangles: of an end, or of the segment from a side."""
    least = np.minimum(_point_triangle(p, triangles), _point_triangle(q, triangles))
    for k in range(3):
        least = np.minimum(least, _segment_segment(p, q, triangles[:, k], triangles[:, (k + 1) % 3]))
    return least


def _segment_segment(p: np.ndarray, q: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distance of segments p q and a b: of two ends' feet, or of the lines' common normal where its feet lie within."""
    least = np.minimum.reduce([_point_segment(p, a, b), _point_segment(q, a, b),
                               _point_segment(a, p, q), _point_segment(b, p, q)])
    u, v, w = q - p, b - a, p - a
    normal = np.cross(u, v)
    square = dot(normal, normal)
    with np.errstate(invalid="ignore", divide="ignore"):
        s = dot(np.cross(v, w), normal) / square
        t = dot(np.cross(u, w), normal) / square
        height = np.abs(dot(normal, w)) / np.sqrt(square)
    within = (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)
    return np.where(within, np.minimum(least, height), least)


class ClosedForm:
    """A wall as the largest of several functions of a point, each a signed distance that changes by no more than the
    distance to the next point: positive where a wire may be.

    Parameters
    ----------
    terms : the functions' values at points (p, 3), shape (terms, p).
    are_concave : whether none of them has a minimum inside a segment, as of the inside of a convex body.
    """

    def __init__(self, terms: Callable[[np.ndarray], np.ndarray], are_concave: bool) -> None:
        self._terms = terms
        self._are_concave = are_concave

    def distance(self, points: np.ndarray) -> np.ndarray:
        """Signed distance in units of points (p, 3), shape (p,)."""
        return self._terms(points).max(axis=0)

    def least_along(self, a: np.ndarray, b: np.ndarray, known: float) -> float:
        """Least distance on segments a b, shapes (p, 3), where it is below a known one."""
        length = np.linalg.norm(b - a, axis=1)
        at_a, at_b = self._terms(a), self._terms(b)
        finest = _FINEST * length.max(initial=1.0)
        while len(a):
            ends_a, ends_b = at_a.max(axis=0), at_b.max(axis=0)
            known = min(known, ends_a.min(), ends_b.min())
            bound = 0.5 * (ends_a + ends_b - length)
            if self._are_concave:
                bound = np.maximum(bound, np.minimum(at_a, at_b).max(axis=0))
            less = (bound < known) & (length > finest)
            a, b, at_a, at_b, length = a[less], b[less], at_a[:, less], at_b[:, less], 0.5 * length[less]
            middle = 0.5 * (a + b)
            at = self._terms(middle)
            a, b = np.concatenate([a, middle]), np.concatenate([middle, b])
            at_a, at_b = np.concatenate([at_a, at], axis=1), np.concatenate([at, at_b], axis=1)
            length = np.tile(length, 2)
        return known


def rotation_of(degrees: np.ndarray) -> np.ndarray:
    """Return the matrix of Euler angles in degrees, about z first, then x, then y, all about fixed axes."""
    x, y, z = np.radians(degrees)
    about_x = np.array([[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]])
    about_y = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    about_z = np.array([[np.cos(z), -np.sin(z), 0], [np.sin(z), np.cos(z), 0], [0, 0, 1]])
    return about_y @ about_x @ about_z


def triangles_of(scene: dict[str, Any], folder: Path) -> np.ndarray:
    """Corners (t, 3, 3) in units of the mesh of a parameter file that lies in a folder, where position, rotation and
    scale put them: x -> position + R (scale x). Empty where the vessel is none."""
    if scene["vessel"]["shape"] != "mesh":
        return np.empty((0, 3, 3))
    mesh = read_obj(folder / scene["vessel"]["file"])
    vertices = mesh.vertices * scene.get("scale", 1.0) @ rotation_of(scene.get("rotation", (0.0, 0.0, 0.0))).T
    return (vertices + scene.get("position", 0.0))[mesh.triangles]


@dataclass(frozen=True)
class Walls:
    """The walls of a scene: the vessel's mesh, or None, and all others in closed form."""

    mesh: MeshSearch | None
    others: list[ClosedForm]

    @classmethod
    def of(cls, scene: dict[str, Any], triangles: np.ndarray) -> Walls:
        """Make it of a parameter file; triangles (t, 3, 3) in units are those of its mesh at their place, if it has
        one."""
        others = list(scene.get("obstacles") or [])
        is_mesh = scene["vessel"]["shape"] == "mesh"
        others += [] if is_mesh else [scene["vessel"]]
        return cls(MeshSearch(triangles) if is_mesh else None, [closed_form(wall) for wall in others])

    def beyond(self, points: np.ndarray) -> np.ndarray:
        """Return whether points (..., 3) are beyond each wall, shape (walls, ...); a mesh must be closed for it."""
        flat = points.reshape(-1, 3)
        answers = [wall.distance(flat) <= 0.0 for wall in self.others]
        if self.mesh:
            answers.append(~self.mesh.inside(flat))
        return np.array(answers).reshape(-1, *points.shape[:-1])

    def distances(self, points: np.ndarray) -> np.ndarray:
        """Distances in units of points (..., 3) from each wall, on either side of it, shape (walls, ...)."""
        flat = points.reshape(-1, 3)
        answers = [np.abs(wall.distance(flat)) for wall in self.others]
        if self.mesh:
            answers.append(self.mesh.distance(flat))
        return np.array(answers).reshape(-1, *points.shape[:-1])

    def crosses(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Return whether each segment a b, shapes (p, 3), goes through a wall, shape (p,)."""
        through = self.mesh.crosses(a, b) if self.mesh else np.zeros(len(a), bool)
        for wall in self.others:
            near = np.flatnonzero(wall.distance(a) + wall.distance(b) <= np.linalg.norm(b - a, axis=1))
            for k in near:
                through[k] = through[k] or wall.least_along(a[k:k + 1], b[k:k + 1], 0.0) < 0.0
        return through


def closed_form(wall: dict[str, Any]) -> ClosedForm:
    """Return a wall in closed form: a vessel that is a plane or a tube with corners, or any obstacle."""
    shape = wall["shape"]
    if shape == "plane":
        normal = np.array(wall["normal"], float)
        normal /= np.linalg.norm(normal)
        return ClosedForm(lambda x: ((x - wall["point"]) @ normal)[None], True)
    if wall.get("smooth"):
        raise ValueError("a tube with rounded corners is not searched here")
    if shape == "tube":
        knots, radii = np.array(wall["knots"], float), np.array(wall["radius"], float)
        return ClosedForm(_tube(knots, radii, wall.get("openStart", True), wall.get("openEnd", True)), True)
    if shape == "sphere":
        return ClosedForm(lambda x: (np.linalg.norm(x - wall["centre"], axis=1) - wall["radius"])[None], False)
    if shape == "capsule":
        start, end = np.array(wall["from"], float), np.array(wall["to"], float)
        return ClosedForm(lambda x: (_point_segment(x, start, end) - wall["radius"])[None], False)
    if shape == "hull":
        return ClosedForm(_hull(np.array(wall["points"], float), wall.get("radius", 0.0)), False)
    turn, half = rotation_of(np.array(wall["rotation"], float)), np.array(wall["halfSize"], float)

    def box(x: np.ndarray) -> np.ndarray:
        beyond = np.abs((x - wall["centre"]) @ turn) - half
        return (np.linalg.norm(np.maximum(beyond, 0.0), axis=1) + np.minimum(beyond.max(axis=1), 0.0))[None]

    return ClosedForm(box, False)


def _hull(points: np.ndarray, radius: float) -> Callable[[np.ndarray], np.ndarray]:
    """Distance from what is within a radius of the convex hull of points (p, 3), which may lie in a plane."""
    _, sizes, axes = np.linalg.svd(points - points.mean(axis=0))
    if sizes[2] > _FLAT * sizes[0]:
        hull = ConvexHull(points)
        corners, planes = points[hull.simplices], hull.equations
    else:
        rim = points[ConvexHull((points - points.mean(axis=0)) @ axes[:2].T).vertices]
        corners = np.array([[rim[0], rim[k], rim[k + 1]] for k in range(1, len(rim) - 1)])
        planes = np.array([[0.0, 0.0, 0.0, np.inf]])    # nothing is inside a plate

    def terms(x: np.ndarray) -> np.ndarray:
        height = (x @ planes[:, :3].T + planes[:, 3]).max(axis=1)
        pairs = np.repeat(x, len(corners), axis=0), np.tile(corners, (len(x), 1, 1))
        outside = _point_triangle(*pairs).reshape(len(x), len(corners)).min(axis=1)
        return (np.where(height < 0.0, height, outside) - radius)[None]

    return terms


def _tube(knots: np.ndarray, radii: np.ndarray, open_start: bool, open_end: bool
          ) -> Callable[[np.ndarray], np.ndarray]:
    """R - |x - c| over balls on each piece of a line whose radius changes linearly from knot to knot; its open ends go
    on straight with the radius that they have."""
    far = 1e4 * np.linalg.norm(np.diff(knots, axis=0), axis=1).sum()
    before = knots[0] + far * (knots[0] - knots[1]) / np.linalg.norm(knots[0] - knots[1])
    behind = knots[-1] + far * (knots[-1] - knots[-2]) / np.linalg.norm(knots[-1] - knots[-2])
    if open_start:
        knots, radii = np.vstack([before, knots]), np.r_[radii[0], radii]
    if open_end:
        knots, radii = np.vstack([knots, behind]), np.r_[radii, radii[-1]]

    def terms(x: np.ndarray) -> np.ndarray:
        values = []
        for a, b, r, s in zip(knots, knots[1:], radii, radii[1:]):
            length = np.linalg.norm(b - a)
            axis = (b - a) / length
            along = (x - a) @ axis
            across = np.linalg.norm(x - a - along[:, None] * axis, axis=1)
            slope = (s - r) / length
            at = np.clip(along + slope * across / np.sqrt(1.0 - slope**2), 0.0, length)
            values.append(r + slope * at - np.hypot(along - at, across))
        return np.array(values)

    return terms
