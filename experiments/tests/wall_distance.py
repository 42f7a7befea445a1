"""Distances of a wire's core line from walls, read off parameters and logs alone: what the runner is held to.

Plain closed forms over all triangles, pieces or faces near a segment; nothing of the simulation's own search.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull

_FAR = 1e4  # units that an open tube goes on
_SAMPLES = 400  # of a segment, before the search for its least distance is refined
_REFINEMENTS = 9
_KEPT = 6  # samples that are refined
_FLAT = 1e-9  # height over width below which a hull is a plate


def placed(vertices: np.ndarray, parameters: dict[str, Any]) -> np.ndarray:
    """Vertices (v, 3) in units where position, rotation and scale put them: x -> position + R (scale x)."""
    turn = rotation(parameters.get("rotation", (0.0, 0.0, 0.0)))
    scaled = vertices * np.asarray(parameters.get("scale", (1.0, 1.0, 1.0)), float)
    return scaled @ turn.T + np.asarray(parameters.get("position", (0.0, 0.0, 0.0)), float)


def rotation(degrees) -> np.ndarray:
    """Matrix of Euler angles in degrees: about z first, then x, then y, all about the fixed axes."""
    x, y, z = np.radians(degrees)
    about_z = np.array([[np.cos(z), -np.sin(z), 0], [np.sin(z), np.cos(z), 0], [0, 0, 1]])
    about_x = np.array([[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]])
    about_y = np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    return about_y @ about_x @ about_z


def read_triangles(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (v, 3) and triangles (t, 3) of an OBJ file, as they stand there."""
    vertices, triangles = [], []
    for line in path.read_text().splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            vertices.append([float(word) for word in words[:3]])
        elif kind == "f":
            corners = [int(word.split("/")[0]) - 1 for word in words]
            triangles += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    return np.array(vertices), np.array(triangles)


@dataclass(frozen=True)
class Triangles:
    """Triangles (t, 3, 3) in units, or what is within a radius of the convex body that they bound."""

    corners: np.ndarray
    radius: float = 0.0
    faces: np.ndarray | None = None  # (f, 4): outward normals and offsets of the body

    def distance(self, a: np.ndarray, b: np.ndarray, within: float) -> float:
        """Least distance of segment a b, 0 where it cuts a triangle; infinite where it is more than `within`."""
        if self.faces is not None and np.all(self.faces[:, :3] @ a + self.faces[:, 3] < 0.0):
            return -self.radius
        border = within + self.radius
        near = np.all(self.corners.max(axis=1) >= np.minimum(a, b) - border, axis=1)
        near &= np.all(self.corners.min(axis=1) <= np.maximum(a, b) + border, axis=1)
        if not near.any():
            return np.inf
        return float(_segment_triangles(a, b, self.corners[near]).min()) - self.radius


@dataclass(frozen=True)
class Capsule:
    """All points within a radius of a segment, units."""

    start: np.ndarray
    end: np.ndarray
    radius: float

    def distance(self, a: np.ndarray, b: np.ndarray, within: float) -> float:
        return float(_segment_segments(a[None], b[None], self.start[None], self.end[None])[0]) - self.radius


@dataclass(frozen=True)
class Plane:
    """The half-space that a unit normal points into."""

    point: np.ndarray
    normal: np.ndarray

    def distance(self, a: np.ndarray, b: np.ndarray, within: float) -> float:
        return float(min((a - self.point) @ self.normal, (b - self.point) @ self.normal))


@dataclass(frozen=True)
class Tube:
    """The union of all balls whose centres run along the knots (k, 3) and whose radii (k,) change linearly between."""

    knots: np.ndarray
    radii: np.ndarray

    def depths(self, points: np.ndarray) -> np.ndarray:
        """How deep points (p, 3) lie in the lumen, shape (p,)."""
        deepest = np.full(len(points), -np.inf)
        for start, end, first, last in zip(self.knots, self.knots[1:], self.radii, self.radii[1:]):
            length = np.linalg.norm(end - start)
            axis = (end - start) / length
            along = (points - start) @ axis
            away = np.linalg.norm(np.cross(axis, points - start), axis=1)
            slope = (last - first) / length
            at = np.clip(along + slope * away / np.sqrt(1.0 - slope * slope), 0.0, length)
            centre = start + at[:, None] * axis
            deepest = np.maximum(deepest, first + slope * at - np.linalg.norm(points - centre, axis=1))
        return deepest

    def distance(self, a: np.ndarray, b: np.ndarray, within: float) -> float:
        share = np.linspace(0.0, 1.0, _SAMPLES + 1)
        depths = self.depths(a + share[:, None] * (b - a))
        least = depths.min()
        if least > within + np.linalg.norm(b - a) / _SAMPLES:
            return float(least)
        for middle in share[np.argsort(depths)[:_KEPT]]:
            low, high = max(0.0, middle - 1.0 / _SAMPLES), min(1.0, middle + 1.0 / _SAMPLES)
            for _ in range(_REFINEMENTS):
                finer = np.linspace(low, high, 41)
                values = self.depths(a + finer[:, None] * (b - a))
                at = int(values.argmin())
                least = min(least, values[at])
                low, high = finer[max(0, at - 1)], finer[min(40, at + 1)]
        return float(least)


def read_walls(parameters: dict[str, Any], folder: Path) -> list:
    """The vessel and the obstacles of a parameter file that lies in a folder."""
    walls = [_vessel(parameters, folder)]
    return walls + [_obstacle(entry) for entry in parameters.get("obstacles", [])]


def read_case(path: Path) -> tuple[dict[str, Any], list]:
    """A parameter file and its walls."""
    parameters = json.loads(path.read_text())
    return parameters, read_walls(parameters, path.parent)


def least_distance(walls: list, positions: np.ndarray, within: float) -> tuple[float, int]:
    """Least distance of any rod element from any wall, and in how many entries an element cuts one.

    Parameters
    ----------
    walls : list
        As `read_walls` gives them.
    positions : ndarray, shape (k, n + 1, 3)
        Of all spheres after successive steps, in units.
    within : float
        Distances above it need not be known.
    """
    least, cuts = np.inf, 0
    for wire in positions:
        for a, b in zip(wire, wire[1:]):
            distance = min(wall.distance(a, b, within) for wall in walls)
            least = min(least, distance)
            cuts += distance <= 0.0
    return least, cuts


def _vessel(parameters: dict[str, Any], folder: Path):
    vessel = parameters["vessel"]
    if vessel["shape"] == "plane":
        normal = np.array(vessel["normal"], float)
        return Plane(np.array(vessel["point"], float), normal / np.linalg.norm(normal))
    if vessel["shape"] == "mesh":
        vertices, triangles = read_triangles(folder / vessel["file"])
        return Triangles(placed(vertices, parameters)[triangles])
    knots, radii = np.array(vessel["knots"], float), np.array(vessel["radius"], float)
    if vessel["openStart"]:
        away = (knots[0] - knots[1]) / np.linalg.norm(knots[0] - knots[1])
        knots, radii = np.vstack([knots[0] + _FAR * away, knots]), np.r_[radii[0], radii]
    if vessel["openEnd"]:
        away = (knots[-1] - knots[-2]) / np.linalg.norm(knots[-1] - knots[-2])
        knots, radii = np.vstack([knots, knots[-1] + _FAR * away]), np.r_[radii, radii[-1]]
    return Tube(knots, radii)


def _obstacle(entry: dict[str, Any]):
    if entry["shape"] in ("sphere", "capsule"):
        start = entry["centre"] if entry["shape"] == "sphere" else entry["from"]
        end = entry["centre"] if entry["shape"] == "sphere" else entry["to"]
        return Capsule(np.array(start, float), np.array(end, float), entry["radius"])
    points = np.array(entry.get("points", []), float)
    if entry["shape"] == "box":
        signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        points = (signs * np.array(entry["halfSize"])) @ rotation(entry["rotation"]).T + np.array(entry["centre"])
    return _hull(points, entry.get("radius", 0.0))


def _hull(points: np.ndarray, radius: float) -> Triangles:
    """What is within a radius of the convex hull of points (p, 3), which may lie in a plane."""
    _, sizes, axes = np.linalg.svd(points - points.mean(axis=0))
    if sizes[2] > _FLAT * sizes[0]:
        hull = ConvexHull(points)
        return Triangles(points[hull.simplices], radius, hull.equations)
    rim = points[ConvexHull((points - points.mean(axis=0)) @ axes[:2].T).vertices]
    return Triangles(np.array([[rim[0], rim[k], rim[k + 1]] for k in range(1, len(rim) - 1)]), radius)


def _point_segments(p: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    along = d - c
    square = (along * along).sum(-1)
    share = np.clip(((p - c) * along).sum(-1) / np.where(square > 0.0, square, 1.0), 0.0, 1.0)
    return np.linalg.norm(p - c - share[..., None] * along, axis=-1)


def _segment_segments(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Distances of segments a b from segments c d, all (m, 3)."""
    u, v, w = b - a, d - c, a - c
    uu, uv, vv = (u * u).sum(-1), (u * v).sum(-1), (v * v).sum(-1)
    below = uu * vv - uv * uv
    safe = np.where(below > 0.0, below, 1.0)
    s = (uv * (v * w).sum(-1) - vv * (u * w).sum(-1)) / safe
    t = (uu * (v * w).sum(-1) - uv * (u * w).sum(-1)) / safe
    inside = (below > 0.0) & (s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0)
    between = np.linalg.norm(w + s[..., None] * u - t[..., None] * v, axis=-1)
    ends = (_point_segments(a, c, d), _point_segments(b, c, d), _point_segments(c, a, b), _point_segments(d, a, b))
    return np.minimum(np.where(inside, between, np.inf), np.min(ends, axis=0))


def _segment_triangles(a: np.ndarray, b: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Distances of segment a b from triangles (m, 3, 3), 0 where it cuts one."""
    first, second = np.broadcast_to(a, corners[:, 0].shape), np.broadcast_to(b, corners[:, 0].shape)
    edges = [(corners[:, k], corners[:, (k + 1) % 3]) for k in range(3)]
    least = np.min([_segment_segments(first, second, *edge) for edge in edges], axis=0)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    square = (normal * normal).sum(-1)

    def covers(points: np.ndarray) -> np.ndarray:
        sides = [(np.cross(end - start, points - start) * normal).sum(-1) >= 0.0 for start, end in edges]
        return np.all(sides, axis=0)

    heights = [((end - corners[:, 0]) * normal).sum(-1) for end in (first, second)]
    for end, height in zip((first, second), heights):
        foot = end - (height / square)[:, None] * normal
        least = np.where(covers(foot), np.minimum(least, np.abs(height) / np.sqrt(square)), least)
    crosses = heights[0] * heights[1] < 0.0
    share = np.where(crosses, heights[0] / np.where(crosses, heights[0] - heights[1], 1.0), 0.0)
    return np.where(crosses & covers(first + share[:, None] * (second - first)), 0.0, least)
