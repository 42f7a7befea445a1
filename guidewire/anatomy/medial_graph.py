"""Distance from a wall, and the graph of the largest spheres inside it: vertices of the Voronoi diagram of the wall's
points (Amenta, Bern 1999), lines between neighbouring ones weighted with 1/radius (Antiga et al. 2003)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import Delaunay, QhullError, cKDTree

from guidewire.anatomy.mesh import AnatomyError, Mesh, Rim

_AROUND = np.array([[np.cos(k * np.pi / 3.0), np.sin(k * np.pi / 3.0)] for k in range(6)])
BLIND = 1.0  # a blind end is a branch if it goes on so many radii beyond its parent's wall


class WallDistance:
    """Distance from a mesh's triangles."""

    def __init__(self, mesh: Mesh) -> None:
        from vtkmodules.vtkCommonCore import mutable
        from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator

        from guidewire.anatomy.surfaces import to_vtk

        self._data = to_vtk(mesh)
        self._locator = vtkStaticCellLocator()
        self._locator.SetDataSet(self._data)
        self._locator.BuildLocator()
        self._words = ([0.0, 0.0, 0.0], vtkGenericCell(), mutable(0), mutable(0), mutable(0.0))

    def distance(self, point: Sequence[float] | np.ndarray) -> float:
        self._locator.FindClosestPoint(point, *self._words)
        return float(self._words[4]) ** 0.5

    def inside(self, points: np.ndarray) -> np.ndarray:
        """Return (k,): whether points (k, 3) are inside, of a closed mesh."""
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkPolyData
        from vtkmodules.vtkFiltersModeling import vtkSelectEnclosedPoints
        from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

        places, asked = vtkPoints(), vtkPolyData()
        places.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=1))
        asked.SetPoints(places)
        enclosed = vtkSelectEnclosedPoints()
        enclosed.SetInputData(asked)
        enclosed.SetSurfaceData(self._data)
        enclosed.Update()
        return vtk_to_numpy(enclosed.GetOutput().GetPointData().GetArray("SelectedPoints")).astype(bool)

    def centre(self, point: np.ndarray, tangent: np.ndarray, radius: float, most: float) -> np.ndarray:
        """Find where the distance is largest across a tangent, no farther than `most` from a point."""
        u = np.cross(tangent, np.eye(3)[np.argmin(np.abs(tangent))])
        u /= np.linalg.norm(u)
        w = np.cross(tangent, u)
        # Numbers of Python: an operation of numpy on three of them takes as long as the search for a triangle.
        ways = (_AROUND[:, :1] * u + _AROUND[:, 1:] * w).tolist()
        start = best = tuple(point.tolist())
        value, step = self.distance(best), 0.3 * radius
        while step > 0.004 * radius:
            found = None
            for way in ways:
                tried = (best[0] + step * way[0], best[1] + step * way[1], best[2] + step * way[2])
                if math.dist(tried, start) > most:
                    continue
                distance = self.distance(tried)
                if distance > value + 1e-9 * radius:
                    found, value = tried, distance
            if found is None:
                step *= 0.5
            else:
                best = found
        return np.array(best)


def _tetrahedra(points: np.ndarray) -> Delaunay:
    """Make the tetrahedra of points, which Qhull displaces by its rounding where too many of them lie on one sphere for
    exact merging."""
    try:
        return Delaunay(points)
    except QhullError:
        try:
            return Delaunay(points, qhull_options="Qbb Qc QJ")
        except QhullError as error:
            raise AnatomyError("the wall's points lie in one plane") from error


class MedialGraph:
    """Voronoi vertices inside a lumen, and the lines between neighbouring ones.

    centres : (m, 3); radii : (m,); weights, lengths : sparse (m, m), of the lines: length over radius, and length.
    """

    def __init__(self, samples: Mesh) -> None:
        points, normals = samples.vertices, samples.vertex_normals()
        cells = _tetrahedra(points)
        corners = points[cells.simplices]
        rows = corners[:, 1:] - corners[:, :1]
        right = 0.5 * np.einsum("ijk,ijk->ij", rows, rows)
        volume = np.linalg.det(rows)
        size = np.linalg.norm(rows, axis=2).max(axis=1)
        solid = np.abs(volume) > 1e-9 * size**3
        offset = np.zeros((len(rows), 3))
        offset[solid] = np.linalg.solve(rows[solid], right[solid][..., None])[..., 0]
        radii = np.linalg.norm(offset, axis=1)
        centres = corners[:, 0] + offset
        ahead = np.einsum("ijk,ijk->ij", corners - centres[:, None], normals[cells.simplices])
        solid &= ((centres > points.min(axis=0)) & (centres < points.max(axis=0))).all(axis=1)
        inside = solid & ((ahead > 0.0).sum(axis=1) >= 3) & (ahead.sum(axis=1) > radii)
        number = np.full(len(rows), -1)
        number[inside] = np.arange(inside.sum())
        self.centres, self.radii = centres[inside], radii[inside]
        a = np.repeat(np.flatnonzero(inside), 4)
        b = cells.neighbors[inside].ravel()
        real = (b > a) & inside[b]
        a, b = number[a[real]], number[b[real]]
        lengths = np.linalg.norm(self.centres[a] - self.centres[b], axis=1) + 1e-12 * self.radii[a]
        shape = (inside.sum(), inside.sum())
        self.lengths = coo_matrix((lengths, (a, b)), shape=shape).tocsr()
        cost = lengths * 0.5 * (1.0 / self.radii[a] + 1.0 / self.radii[b])
        self.weights = coo_matrix((cost, (a, b)), shape=shape).tocsr()
        if not len(self.radii):
            raise AnatomyError("the surface has no lumen")
        self.bodies = connected_components(self.weights, directed=False)[1]
        self.largest = int(np.argmax(np.bincount(self.bodies, self.radii)))

    def at_rim(self, rim: Rim) -> int:
        """Return the vertex of the diagram from which a path goes straight to a rim."""
        away = np.linalg.norm(self.centres - rim.centre, axis=1)
        near = np.flatnonzero((away < 2.0 * rim.radius) & (self.bodies == self.largest))
        if not len(near):
            near = np.argsort(away + 1e9 * (self.bodies != self.largest))[:20]
        wide = near[self.radii[near] > 0.6 * self.radii[near].max()]
        target = rim.centre + 0.8 * rim.radius * rim.normal
        return int(wide[np.argmin(np.linalg.norm(self.centres[wide] - target, axis=1))])

    def radii_near(self, nodes: list[int]) -> list[float]:
        """Return the largest radius of the 100 vertices around each of these: of those in a corner too."""
        _, near = cKDTree(self.centres).query(self.centres[nodes], k=min(100, len(self.centres)))
        return list(self.radii[near].max(axis=-1))

    def two_ends(self) -> list[int]:
        """Find of a lumen without rims the two vertices that are farthest from each other."""
        inside = self.bodies == self.largest
        some = int(np.flatnonzero(inside)[np.argmax(self.radii[inside])])
        ends = []
        for _ in range(2):
            lengths = dijkstra(self.lengths, directed=False, indices=some)
            lengths[~np.isfinite(lengths)] = -1.0
            some = int(np.argmax(lengths))
            ends.append(some)
        return ends

    def blind_ends(self, known: set[int], before: np.ndarray, lengths: np.ndarray) -> list[int]:
        """Ends of branches that no path leads into yet: the farthest vertex from the root that is not near a path, and
        so on. Near is up to so many radii of the path as the corners of an oval or faceted lumen are away."""
        found: list[int] = []
        bare = np.isfinite(lengths)
        fresh = list(known)
        while True:
            # Along a path radii change slowly, so that the nearest of its spheres decide.
            count = min(8, len(fresh))
            away, near = cKDTree(self.centres[fresh]).query(self.centres[bare], k=count)
            radii = self.radii[np.asarray(fresh)][near]
            bare[bare] = (away > (1.0 + BLIND) * radii).reshape(-1, count).all(axis=1)
            if not bare.any():
                return found
            tip = int(np.flatnonzero(bare)[np.argmax(lengths[bare])])
            found.append(tip)
            fresh = [node for node in walk_back(before, tip) if node not in known]
            known.update(fresh)


def walk_back(before: np.ndarray, node: int) -> list[int]:
    """Return the path to a node, from the root."""
    found = [int(node)]
    while before[found[-1]] >= 0:
        found.append(int(before[found[-1]]))
    return found[::-1]
