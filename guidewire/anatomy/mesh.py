"""Triangle meshes as arrays: edges, rims, bodies, normals, volume."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

FARTHEST = 1e9  # from 0 that a coordinate may be, in the file's unit


class AnatomyError(Exception):
    """An input that is no vessel, or an answer that there is none. The message is one line."""


@dataclass(frozen=True)
class Mesh:
    """v vertices and t triangles.

    vertices : ndarray (v, 3), the file's units.
    triangles : ndarray of int (t, 3).
    """

    vertices: np.ndarray
    triangles: np.ndarray

    @property
    def corners(self) -> np.ndarray:
        """Positions of the three corners of each triangle, (t, 3, 3)."""
        return self.vertices[self.triangles]

    @property
    def diagonal(self) -> float:
        """Length of the diagonal of the box around it."""
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))

    def area_vectors(self) -> np.ndarray:
        """Return (t, 3): along the normal, as long as the triangle is large."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        return 0.5 * np.cross(b - a, c - a)

    def edge_lengths(self) -> np.ndarray:
        """Return (3 t,), each inner edge twice."""
        corners = self.corners
        return np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).ravel()

    def vertex_normals(self) -> np.ndarray:
        """Return (v, 3): sums of the normals around, weighted with the angle at the vertex, of length 1 (0 where it has
        none).
        """
        corners = self.corners
        normals = self.area_vectors()
        normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
        total = np.zeros_like(self.vertices)
        for k in range(3):
            u, w = corners[:, (k + 1) % 3] - corners[:, k], corners[:, (k + 2) % 3] - corners[:, k]
            angle = np.arctan2(np.linalg.norm(np.cross(u, w), axis=1), np.einsum("ij,ij->i", u, w))
            np.add.at(total, self.triangles[:, k], normals * angle[:, None])
        return total / np.maximum(np.linalg.norm(total, axis=1), 1e-300)[:, None]

    def part(self, kept: np.ndarray) -> Mesh:
        """Return the triangles of a mask (t,), and only the vertices that they use."""
        used, triangles = np.unique(self.triangles[kept], return_inverse=True)
        return Mesh(self.vertices[used], triangles.reshape(-1, 3))

    def turned(self) -> Mesh:
        """Return the same with its normals to the other side."""
        return Mesh(self.vertices, self.triangles[:, ::-1].copy())


@dataclass(frozen=True)
class Edges:
    """The e edges of a mesh.

    ends : ndarray of int (e, 2), the smaller vertex first; counts : (e,), triangles at each;
    of_triangles : (t, 3), the edge from corner k to corner k + 1; forward : bool (t, 3), whether it runs from the
    smaller vertex to the larger.
    """

    ends: np.ndarray
    counts: np.ndarray
    of_triangles: np.ndarray
    forward: np.ndarray

    @staticmethod
    def of(mesh: Mesh) -> Edges:
        """Return all edges of a mesh."""
        halves = np.stack([mesh.triangles, np.roll(mesh.triangles, -1, axis=1)], axis=2).reshape(-1, 2)
        low, high = halves.min(axis=1), halves.max(axis=1)
        keys, inverse, counts = np.unique(low * len(mesh.vertices) + high, return_inverse=True, return_counts=True)
        ends = np.stack(np.divmod(keys, max(len(mesh.vertices), 1)), axis=1)
        return Edges(ends, counts, inverse.reshape(-1, 3), (halves[:, 0] == low).reshape(-1, 3))

    def halves(self) -> np.ndarray:
        """Return (p, 2): sides of triangles, 3 t + k, at the edges that have exactly two."""
        order = np.argsort(self.of_triangles.ravel(), kind="stable")
        first = np.concatenate([[0], np.cumsum(self.counts)])[:-1][self.counts == 2]
        return np.stack([order[first], order[first + 1]], axis=1)

    def pairs(self) -> np.ndarray:
        """Return (p, 2): triangles on the two sides of the edges that have exactly two."""
        return self.halves() // 3


@dataclass(frozen=True)
class Rim:
    """A closed chain of edges that have one triangle.

    number : 1 is the largest; centre : (3,); radius : that of a circle of the same area; normal : (3,), of length 1,
    into the lumen; vertices : indices, in no order; is_hole : it lies in the side of a wider lumen, not at its end.
    """

    number: int
    centre: np.ndarray
    radius: float
    normal: np.ndarray
    vertices: np.ndarray
    is_hole: bool = False

    @property
    def name(self) -> str:
        """What reports and parameter files call it."""
        return f"rim {self.number}"


def find_rims(mesh: Mesh, edges: Edges) -> list[Rim]:
    """Return all rims, the largest first."""
    open_halves = np.argwhere(edges.counts[edges.of_triangles] == 1)
    if not len(open_halves):
        return []
    triangle, k = open_halves.T
    start, end = mesh.triangles[triangle, k], mesh.triangles[triangle, (k + 1) % 3]
    opposite = mesh.triangles[triangle, (k + 2) % 3]
    labels = _labels(len(mesh.vertices), start, end)[start]
    rims = []
    for label in np.unique(labels):
        own = labels == label
        a, b = mesh.vertices[start[own]], mesh.vertices[end[own]]
        weights = np.linalg.norm(b - a, axis=1)
        if not weights.sum() > 0.0:
            continue
        centre = np.average(0.5 * (a + b), axis=0, weights=weights)
        area = 0.5 * np.cross(a - centre, b - centre).sum(axis=0)
        size = float(np.linalg.norm(area))
        inward = (mesh.vertices[opposite[own]] - 0.5 * (a + b)).mean(axis=0)
        normal = area / size if size > 0.0 else inward / max(np.linalg.norm(inward), 1e-300)
        normal = normal if normal @ inward >= 0.0 else -normal
        rims.append(Rim(0, centre, float(np.sqrt(size / np.pi)), normal, np.unique(np.r_[start[own], end[own]])))
    rims.sort(key=lambda rim: -rim.radius)
    return [Rim(number, rim.centre, rim.radius, rim.normal, rim.vertices) for number, rim in enumerate(rims, 1)]


def find_bodies(mesh: Mesh) -> np.ndarray:
    """Return (t,): the body of each triangle, 0 the one with the most triangles. As in the runner an edge joins
    triangles, a vertex does not."""
    n, edges = len(mesh.triangles), Edges.of(mesh)
    return _ranked(_labels(n + len(edges.ends), np.repeat(np.arange(n), 3), n + edges.of_triangles.ravel())[:n])


def find_sheets(mesh: Mesh) -> np.ndarray:
    """Return (t,): as bodies, but only triangles on the two sides of an edge of two are of one sheet."""
    return _ranked(_labels(len(mesh.triangles), *Edges.of(mesh).pairs().T))


def _ranked(labels: np.ndarray) -> np.ndarray:
    """Return (t,): numbers from 0 instead of labels, 0 for the most frequent one."""
    _, inverse, counts = np.unique(labels, return_inverse=True, return_counts=True)
    rank = np.empty(len(counts), dtype=int)
    rank[np.argsort(-counts, kind="stable")] = np.arange(len(counts))
    return rank[inverse]


def turned_alike(mesh: Mesh) -> tuple[Mesh, int]:
    """Return the mesh with the triangles of each sheet oriented as most of them are, and how many were turned. A sheet
    of one side stays as it is."""
    first, second = _senses(mesh)
    sheets = np.unique(np.minimum(first, second), return_inverse=True)[1]
    turned = first > second
    share = np.bincount(sheets, turned) / np.maximum(np.bincount(sheets), 1)
    turned = np.where(first == second, False, turned ^ (share > 0.5)[sheets])
    triangles = mesh.triangles.copy()
    triangles[turned] = triangles[turned][:, ::-1]
    return Mesh(mesh.vertices, triangles), int(turned.sum())


def one_sided_at(mesh: Mesh) -> np.ndarray | None:
    """Return (3,): a place of a sheet whose triangles cannot be oriented alike, as of a Moebius band; None without."""
    first, second = _senses(mesh)
    found = np.flatnonzero(first == second)
    return mesh.corners[found[0]].mean(axis=0) if len(found) else None


def _senses(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Return (t,), (t,): components of the double cover of a surface, of each triangle as it is and as turned. A sheet
    of two sides has two components, one of one side has one."""
    edges, n = Edges.of(mesh), len(mesh.triangles)
    halves = edges.halves()
    a, b = (halves // 3).T
    differs = edges.forward.ravel()[halves[:, 0]] == edges.forward.ravel()[halves[:, 1]]
    labels = _labels(2 * n, np.r_[a, a + n], np.r_[b + n * differs, b + n * ~differs])
    return labels[:n], labels[n:]


def signed_volume(mesh: Mesh, rims: list[Rim] | None = None) -> float:
    """Volume inside, positive where normals point out of it; rims are closed by fans to their centres."""
    origin = mesh.vertices.mean(axis=0)
    a, b, c = np.moveaxis(mesh.corners - origin, 1, 0)
    total = np.einsum("ij,ij->", a, np.cross(b, c))
    if rims:
        edges = Edges.of(mesh)
        triangle, k = np.argwhere(edges.counts[edges.of_triangles] == 1).T
        start, end = mesh.triangles[triangle, k], mesh.triangles[triangle, (k + 1) % 3]
        for rim in rims:
            own = np.isin(start, rim.vertices)
            p, q = mesh.vertices[start[own]] - origin, mesh.vertices[end[own]] - origin
            total += float((np.cross(q, p) @ (rim.centre - origin)).sum())
    return float(total / 6.0)


def close_rims(mesh: Mesh, rims: list[Rim]) -> Mesh:
    """Return the mesh with a fan of triangles over each of these rims."""
    edges = Edges.of(mesh)
    triangle, k = np.argwhere(edges.counts[edges.of_triangles] == 1).T
    start, end = mesh.triangles[triangle, k], mesh.triangles[triangle, (k + 1) % 3]
    vertices, triangles = [mesh.vertices], [mesh.triangles]
    for count, rim in enumerate(rims):
        own = np.isin(start, rim.vertices)
        middle = np.full(own.sum(), len(mesh.vertices) + count)
        vertices.append(rim.centre[None])
        triangles.append(np.stack([end[own], start[own], middle], axis=1))
    return Mesh(np.concatenate(vertices), np.concatenate(triangles))


def pinched_triangles(mesh: Mesh) -> np.ndarray:
    """Return (t,): triangles at a vertex where more than one piece of rim begins, but for the larger fan there."""
    edges = Edges.of(mesh)
    opened = edges.ends[edges.counts == 1].ravel()
    counts = np.bincount(opened, minlength=len(mesh.vertices))
    bad = np.zeros(len(mesh.triangles), dtype=bool)
    for vertex in np.flatnonzero(counts > 2):
        around = np.flatnonzero((mesh.triangles == vertex).any(axis=1))
        shared = [[len(set(mesh.triangles[a]) & set(mesh.triangles[b])) >= 2 for b in around] for a in around]
        _, labels = connected_components(np.array(shared, dtype=int), directed=False)
        bad[around[labels != np.argmax(np.bincount(labels))]] = True
    return bad


def _labels(count: int, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    graph = coo_matrix((np.ones(len(a), dtype=np.int8), (a, b)), shape=(count, count))
    return connected_components(graph, directed=False)[1]
