"""The inner surface of a double wall whose two surfaces are joined at the ends of the vessel.

A triangle of the inner surface looks at the wall opposite, one of the outer surface into the open: the fraction of a
cone of rays that meet the mesh says which it is, but not everywhere (branches side by side, the lips at the ends). The
border is that of least cost (Greig, Porteous and Seheult 1989, J. R. Stat. Soc. B 51:271): the area of triangles on the
side that their rays speak against, and the border's length times the wall's thickness. It is a minimum cut of a graph.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, dijkstra, maximum_flow

from guidewire.anatomy.inspection import cast_rays
from guidewire.anatomy.mesh import Edges, Mesh, find_bodies, signed_volume

_CONE = 14  # rays out of a triangle
_LIP = 5.0  # median thicknesses of the wall
_BORDER = 0.3  # cost of a border of one thickness' length, over that of a thickness' square
_FOLD = 3.0  # thicknesses along the surface: between walls that cross the way around a lip is longer
_LARGEST = 2**28  # capacity of an edge of the graph; the flow is computed in integers of 32 bits


def inner_wall(mesh: Mesh) -> tuple[Mesh, float]:
    """Return the largest piece of the inner surface, and the median thickness of the wall."""
    normals = _normals(mesh)
    enclosed = _enclosure(mesh, normals)
    thickness, behind = cast_rays(mesh, np.arange(len(normals)), -normals)
    median = float(np.median(thickness))
    inward = np.where(behind >= 0, enclosed - enclosed[behind], -1.0)
    # Behind a lip, which joins the two surfaces, the wall is as thick as it is long.
    inward[thickness > _LIP * median] = 0.0
    areas = np.linalg.norm(mesh.area_vectors(), axis=1)
    part = mesh.part(_least_border(mesh, areas * inward, _BORDER * median))
    return part.part(find_bodies(part) == 0), median


def are_folds(mesh: Mesh, pairs: np.ndarray, thickness: float) -> bool:
    """Return whether the triangles of each of the pairs (k, 2) that cross are so near each other along the surface that
    it is one wall that is folded there."""
    if not len(pairs):
        return True
    one, other = Edges.of(mesh).pairs().T
    middles = mesh.corners.mean(axis=1)
    graph = coo_matrix((np.linalg.norm(middles[one] - middles[other], axis=1), (one, other)),
                       shape=(len(middles), len(middles))).tocsr()
    return all(np.isfinite(dijkstra(graph, directed=False, indices=first, limit=_FOLD * thickness)[
        pairs[pairs[:, 0] == first, 1]]).all() for first in np.unique(pairs[:, 0]))


def _least_border(mesh: Mesh, evidence: np.ndarray, cost: float) -> np.ndarray:
    """Return (t,): the triangles chosen so that the sum of the evidence (t,) over them, less the border's length times
    a cost, is the largest."""
    edges = Edges.of(mesh)
    ends = mesh.vertices[edges.ends[edges.counts == 2]]
    one, other = edges.pairs().T
    lengths = cost * np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    scale = _LARGEST / max(np.abs(evidence).max(), lengths.max(initial=0.0), 1e-300)
    gain, border = np.rint(scale * evidence).astype(np.int32), np.rint(scale * lengths).astype(np.int32)
    source, sink = len(evidence), len(evidence) + 1
    chosen, refused = np.flatnonzero(gain > 0), np.flatnonzero(gain < 0)
    start = np.r_[one, other, np.full(len(chosen), source), refused]
    end = np.r_[other, one, chosen, np.full(len(refused), sink)]
    graph = coo_matrix((np.r_[border, border, gain[chosen], -gain[refused]], (start, end)),
                       shape=(sink + 1, sink + 1)).tocsr()
    result = maximum_flow(graph, source, sink)
    left = graph - (result.flow if hasattr(result, "flow") else result.residual)  # scipy before 1.11: residual
    left.eliminate_zeros()
    is_chosen = np.zeros(sink + 1, dtype=bool)
    is_chosen[breadth_first_order(left, source, return_predecessors=False)] = True
    return is_chosen[:source]


def _normals(mesh: Mesh) -> np.ndarray:
    """Return (t, 3): of length 1, out of what the surface encloses."""
    normals = mesh.area_vectors()
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    return normals * (1.0 if signed_volume(mesh) > 0.0 else -1.0)


def _enclosure(mesh: Mesh, normals: np.ndarray) -> np.ndarray:
    """Return (t,): of a cone of rays out of each triangle the fraction that meets the mesh."""
    u = np.cross(normals, np.eye(3)[np.argmin(np.abs(normals), axis=1)])
    u /= np.maximum(np.linalg.norm(u, axis=1), 1e-300)[:, None]
    w = np.cross(normals, u)
    everything, total = np.arange(len(normals)), np.zeros(len(normals))
    for k in range(_CONE):
        # A golden spiral over the hemisphere, without its rim, where rays graze the wall.
        height = 1.0 - 0.85 * (k + 0.5) / _CONE
        angle = k * np.pi * (3.0 - np.sqrt(5.0))
        side = np.sqrt(1.0 - height**2)
        rays = height * normals + side * (np.cos(angle) * u + np.sin(angle) * w)
        total += np.isfinite(cast_rays(mesh, everything, rays)[0])
    return total / _CONE
