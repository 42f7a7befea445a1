"""A wall mended in one place: a piece of another surface is put in there, and joined by a band of triangles."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from guidewire.anatomy.mesh import Edges, Mesh, find_bodies, find_rims, pinched_triangles
from guidewire.anatomy.surfaces import distances

_BESIDE = 0.5  # of a step: what is kept lies so near the other surface, in the mean


def patched(mesh: Mesh, made: Mesh, places: np.ndarray, reach: float, step: float) -> Mesh | None:
    """Return the wall of a mesh, but that of another surface where it is near places.

    Parameters
    ----------
    mesh, made : the wall, and a surface that lies on it but for these places.
    places : (k, 3), not empty.
    reach : distance from them, as far as the other surface is taken.
    step : width of the band between the two.

    Returns
    -------
    The wall, its triangles not yet oriented alike; None where the borders of the two pieces are no pairs of rings.
    """
    tree = cKDTree(places)

    def far(surface: Mesh) -> np.ndarray:
        return tree.query(surface.vertices)[0][surface.triangles]

    kept = _with_plain_rims(mesh.part((far(mesh) > reach).all(axis=1)))
    bodies = find_bodies(kept)
    # A wall inside of the lumen is not of the other surface.
    outer = [k for k in range(bodies.max() + 1)
             if distances(kept.part(bodies == k).corners.mean(axis=1), made).mean() < _BESIDE * step]
    kept = kept.part(np.isin(bodies, outer))
    piece = _with_plain_rims(made.part((far(made) < reach - step).all(axis=1)))
    known = cKDTree(mesh.vertices[np.unique(np.concatenate(
        [rim.vertices for rim in find_rims(mesh, Edges.of(mesh))] or [np.empty(0, dtype=int)]))].reshape(-1, 3))
    rings = [ring for ring in _rings(kept) if not known.n or known.query(kept.vertices[ring])[0].max() > 0.0]
    others = _rings(piece)
    if not rings or len(rings) != len(others):
        return None
    away = np.array([[np.linalg.norm(kept.vertices[one].mean(axis=0) - piece.vertices[other].mean(axis=0))
                      for other in others] for one in rings])
    nearest = away.argmin(axis=1)
    if len(set(nearest)) < len(rings):
        return None
    bands = [_band(kept.vertices, ring, piece.vertices, others[k], len(kept.vertices)) for ring,
             k in zip(rings, nearest)]
    return Mesh(np.concatenate([kept.vertices, piece.vertices]),
                np.concatenate([kept.triangles, piece.triangles + len(kept.vertices), *bands]))


def _with_plain_rims(mesh: Mesh) -> Mesh:
    """Without triangles at vertices where a rim meets itself or another one."""
    while len(mesh.triangles):
        pinched = pinched_triangles(mesh)
        if not pinched.any():
            break
        mesh = mesh.part(~pinched)
    return mesh


def _rings(mesh: Mesh) -> list[np.ndarray]:
    """Return the vertices of each rim in order."""
    edges = Edges.of(mesh)
    beside: dict[int, list[int]] = {}
    for a, b in edges.ends[edges.counts == 1].tolist():
        beside.setdefault(a, []).append(b)
        beside.setdefault(b, []).append(a)
    found = []
    while beside:
        ring = [next(iter(beside))]
        while True:
            left = [one for one in beside.pop(ring[-1]) if one in beside]
            if not left:
                break
            ring.append(left[0])
        found.append(np.array(ring))
    return found


def _band(places: np.ndarray, ring: np.ndarray, others: np.ndarray, other: np.ndarray, count: int) -> np.ndarray:
    """Triangles between two rings, whose cross edges have the least sum of squares; numbers of the second from `count`
    on."""
    a, b = places[ring], others[other]
    start = int(np.argmin(np.linalg.norm(b - a[0], axis=1)))
    b, other = np.roll(b, -start, axis=0), np.roll(other, -start)
    if _area(a) @ _area(b) < 0.0:
        b, other = np.roll(b[::-1], 1, axis=0), np.roll(other[::-1], 1)
    a, b = np.vstack([a, a[:1]]), np.vstack([b, b[:1]])
    squares = ((a[:, None] - b[None]) ** 2).sum(axis=2)
    total = np.full_like(squares, np.inf)
    total[0] = np.cumsum(squares[0])
    for i in range(1, len(a)):
        total[i, 0] = total[i - 1, 0] + squares[i, 0]
        for j in range(1, len(b)):
            total[i, j] = squares[i, j] + min(total[i - 1, j], total[i, j - 1])
    first, second = np.append(ring, ring[0]), np.append(other, other[0]) + count
    triangles, i, j = [], len(a) - 1, len(b) - 1
    while i or j:
        if j == 0 or (i and total[i - 1, j] <= total[i, j - 1]):
            triangles.append((first[i - 1], first[i], second[j]))
            i -= 1
        else:
            triangles.append((first[i], second[j], second[j - 1]))
            j -= 1
    return np.array(triangles, dtype=np.int64)


def _area(ring: np.ndarray) -> np.ndarray:
    """Return (3,): twice the area vector of a ring of points."""
    from_middle = ring - ring.mean(axis=0)
    return np.cross(from_middle, np.roll(from_middle, -1, axis=0)).sum(axis=0)
