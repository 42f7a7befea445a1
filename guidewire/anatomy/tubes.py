"""Lumens made of tubes around centrelines, rounded where they meet, as triangle meshes.

A tube's outer distance at p is |p - c| - r, with c the nearest point of its centreline. Where two tubes meet, a ball of
the carina's radius R that touches both from outside rounds the edge between them. With the distances a, b and their
gradients m, n the ball's centre is at p + u m + v n with m.(u m + v n) = R - a, n.(u m + v n) = R - b; between the two
points of contact, where u and v are positive, the distance is R - |u m + v n|, elsewhere the smaller of a and b.
That is exact where the walls are flat over a length R.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from guidewire.anatomy.distance_grid import cut_open
from guidewire.anatomy.intersections import relaxed
from guidewire.anatomy.lumens import Lumen, near_lines
from guidewire.anatomy.mesh import Edges, Mesh, find_bodies, signed_volume
from guidewire.anatomy.sampling import cut_edges, resample
from guidewire.anatomy.surfaces import contour, decimate

_FINE = 3.5  # cells a smallest radius
_FLAT = 0.004  # of the smallest radius: error of the decimation
_EDGES = 0.5  # longest edge of a triangle at a carina, of its radius
_CHUNK = 200_000  # nodes evaluated at once
_STEEPEST = -0.97  # cosine between two walls, up to which an edge is rounded


@dataclass(frozen=True)
class Tube:
    """points (k, 3) and radii (k,), mm; parent : index of the tube it leaves, -1 for none; ends : whether it is open at
    its start and at its end."""

    points: np.ndarray
    radii: np.ndarray
    parent: int = -1
    ends: tuple[bool, bool] = (False, True)


def mesh_of_tubes(tubes: list[Tube], carina: float) -> Mesh:
    """Return the wall of the union, normals into the lumen, open where tubes are.

    carina : radius of curvature of the edges between tubes, mm.
    """
    fields = [_Field(_extended(tube)) for tube in tubes]
    lumens = tuple(Lumen(field.points[::4], field.radii[::4]) for field in fields)
    spacing = min(float(tube.radii.min()) for tube in tubes) / _FINE
    low = np.min([f.points.min(axis=0) - f.radii.max() for f in fields], axis=0) - 3.0 * spacing
    high = np.max([f.points.max(axis=0) + f.radii.max() for f in fields], axis=0) + 3.0 * spacing
    shape = tuple(int(n) for n in np.ceil((high - low) / spacing) + 1)
    near = near_lines(lumens, low, spacing, shape)
    values = np.full(shape, -spacing, dtype=np.float32)
    nodes = np.argwhere(near)
    for k in range(0, len(nodes), _CHUNK):
        part = nodes[k:k + _CHUNK]
        values[tuple(part.T)] = -_union(fields, tubes, carina, low + spacing * part, spacing)[0]
    mesh = contour(values, 0.0, low, spacing)
    mesh = mesh.part(find_bodies(mesh) == 0)
    mesh = Mesh(_onto(mesh.vertices, spacing, lambda p: _union(fields, tubes, carina, p, spacing)[0]), mesh.triangles)
    if len(tubes) > 1:
        mesh = _refined(mesh, fields, tubes, carina, spacing)
    mesh = relaxed(decimate(mesh, _FLAT * _FINE * spacing))
    if signed_volume(mesh) > 0.0:
        mesh = mesh.turned()
    for tube in tubes:
        for is_open, line, radius in zip(tube.ends, (tube.points, tube.points[::-1]), (tube.radii[0], tube.radii[-1])):
            if is_open:
                inward = (line[1] - line[0]) / np.linalg.norm(line[1] - line[0])
                mesh = cut_open(mesh, line[0], inward, 1.5 * float(radius))
    return mesh


class _Field:
    """Outer distance of a tube, and its gradient."""

    def __init__(self, tube: Tube) -> None:
        step = 0.25 * float(tube.radii.min())
        arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(tube.points, axis=0), axis=1))]
        self.points = resample(tube.points, step)
        self.radii = np.interp(np.linspace(0.0, arc[-1], len(self.points)), arc, tube.radii)
        self._tree = cKDTree(self.points)
        self._widest = float(self.radii.max()) + step

    def evaluate(self, points: np.ndarray, reach: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Which of points (k, 3) may be nearer to the wall than a reach; their distances and the gradients of these, of
        length 1."""
        away, nearest = self._tree.query(points, distance_upper_bound=self._widest + reach)
        near = np.flatnonzero(np.isfinite(away))
        points, nearest = points[near], nearest[near]
        best, off, where = np.full(len(points), np.inf), np.zeros_like(points), np.zeros(len(points))
        for first in (nearest - 1, nearest):
            first = np.clip(first, 0, len(self.points) - 2)
            start = self.points[first]
            along = self.points[first + 1] - start
            part = np.einsum("ij,ij->i", points - start, along) / np.einsum("ij,ij->i", along, along)
            part = np.clip(part, 0.0, 1.0)
            away = points - start - part[:, None] * along
            size = np.linalg.norm(away, axis=1)
            closer = size < best
            best[closer], off[closer] = size[closer], away[closer]
            where[closer] = (first + part)[closer]
        radius = np.interp(where, np.arange(len(self.radii)), self.radii)
        return near, best - radius, off / np.maximum(best, 1e-12)[:, None]


def _union(fields: list[_Field], tubes: list[Tube], carina: float, points: np.ndarray, depth: float
           ) -> tuple[np.ndarray, np.ndarray]:
    """Outer distance (k,) of all tubes, rounded between each tube and its parent, and between tubes of one parent, and
    the same without rounding; exact down to so deep within, mm, and not where no tube is within reach of a carina."""
    # A ball rounds an edge where a + cosine * (R - b) < R: the cosine is above -1, so a tube farther than this is none.
    found = [field.evaluate(points, 2.0 * carina + 3.0 * depth) for field in fields]
    plain = np.full(len(points), np.inf)
    for near, distance, _ in found:
        plain[near] = np.minimum(plain[near], distance)
    total = plain.copy()
    for k, tube in enumerate(tubes):
        partners = [tube.parent] + [j for j in range(k) if tubes[j].parent == tube.parent]
        for j in partners:
            if j >= 0:
                both, own, other = np.intersect1d(found[k][0], found[j][0], assume_unique=True, return_indices=True)
                rounded = _rounded(*(part[own] for part in found[k][1:]), *(part[other] for part in found[j][1:]),
                                   carina)
                total[both] = np.minimum(total[both], rounded)
    return total, plain


def _rounded(a: np.ndarray, m: np.ndarray, b: np.ndarray, n: np.ndarray, radius: float) -> np.ndarray:
    cosine = np.maximum(np.einsum("ij,ij->i", m, n), _STEEPEST)
    determinant = np.maximum(1.0 - cosine**2, 1e-6)
    u = (radius - a - cosine * (radius - b)) / determinant
    v = (radius - b - cosine * (radius - a)) / determinant
    length = np.sqrt(np.maximum(u * u + v * v + 2.0 * cosine * u * v, 0.0))
    between = (u > 0.0) & (v > 0.0)
    return np.where(between, radius - length, np.minimum(a, b))


def _refined(mesh: Mesh, fields: list[_Field], tubes: list[Tube], carina: float, depth: float) -> Mesh:
    """The mesh with triangles at rounded edges cut until these are smooth, the new vertices on the wall."""
    for _ in range(6):
        edges = Edges.of(mesh)
        ends = mesh.vertices[edges.ends]
        long = np.flatnonzero(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1) > _EDGES * carina)
        seam = np.zeros(len(long), dtype=bool)
        for points in (ends[long, 0], ends[long].mean(axis=1), ends[long, 1]):
            rounded, plain = _union(fields, tubes, carina, points, depth)
            seam |= rounded < plain - 1e-4 * carina
        if not seam.any():
            break
        chosen = np.zeros(len(edges.ends), dtype=bool)
        chosen[long[seam]] = True
        known = len(mesh.vertices)
        mesh = cut_edges(mesh, edges, chosen)
        vertices = mesh.vertices.copy()
        vertices[known:] = _onto(vertices[known:], carina, lambda p: _union(fields, tubes, carina, p, depth)[0])
        mesh = Mesh(vertices, mesh.triangles)
    return mesh


def _extended(tube: Tube) -> Tube:
    """Longer by a radius where it is open: what is behind the cut is taken off."""
    points, radii = tube.points, tube.radii
    if tube.ends[0]:
        ahead = (points[0] - points[1]) / np.linalg.norm(points[0] - points[1])
        points, radii = np.vstack([points[0] + radii[0] * ahead, points]), np.r_[radii[0], radii]
    if tube.ends[1]:
        ahead = (points[-1] - points[-2]) / np.linalg.norm(points[-1] - points[-2])
        points, radii = np.vstack([points, points[-1] + radii[-1] * ahead]), np.r_[radii, radii[-1]]
    return Tube(points, radii, tube.parent, tube.ends)


def _onto(vertices: np.ndarray, spacing: float, distance) -> np.ndarray:
    """Vertices moved onto the wall by Newton's method, by a quarter of a cell a step at most."""
    step = 1e-3 * spacing
    for _ in range(3):
        value = distance(vertices)
        gradient = np.stack([(distance(vertices + step * e) - value) / step for e in np.eye(3)], axis=1)
        squared = np.maximum(np.einsum("ij,ij->i", gradient, gradient), 0.25)
        move = np.clip(value / squared, -0.25 * spacing, 0.25 * spacing)
        vertices = vertices - move[:, None] * gradient
    return vertices
