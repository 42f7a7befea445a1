"""Reconstruction of a wall from its signed distance on a grid."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import binary_dilation, label
from scipy.spatial import cKDTree

from guidewire.anatomy.mesh import AnatomyError, Mesh, Rim, close_rims, find_bodies, signed_volume
from guidewire.anatomy.surfaces import contour, distances, nearest, to_vtk

_MOST_NODES = 40_000_000
_SAMPLES = 8000  # points at which a displacement is measured


def remesh(mesh: Mesh, rims: list[Rim], spacing: float) -> tuple[Mesh, float]:
    """Return the outer boundary of what a surface encloses, open at its rims, and how far it is from the surface at
    most.

    Parameters
    ----------
    mesh : any triangles that enclose a lumen, its rims closed by fans.
    rims : where the result is cut open again.
    spacing : of the grid; larger where it would have too many nodes.

    Raises
    ------
    AnatomyError : the triangles enclose nothing at this spacing.
    """
    closed = close_rims(mesh, rims) if rims else mesh
    low, high = closed.vertices.min(axis=0), closed.vertices.max(axis=0)
    spacing = max(spacing, float(np.prod(high - low + 8.0 * spacing) / _MOST_NODES) ** (1.0 / 3.0))
    origin = low - 4.0 * spacing
    shape = tuple(int(n) for n in np.ceil((high - origin) / spacing) + 5)
    values = signed_distances(closed, origin, spacing, shape)
    if not (values > 0.0).any():
        raise AnatomyError(f"the surface encloses nothing that is wider than {spacing:.3g}")
    made = contour(values, 0.0, origin, spacing)
    made = made.part(find_bodies(made) == 0)
    if signed_volume(made) > 0.0:
        made = made.turned()
    moved = displacement(closed, made)
    for rim in rims:
        if np.abs((mesh.vertices[rim.vertices] - rim.centre) @ rim.normal).max() > 1.5 * spacing:
            made = _without_lid(made, close_rims(mesh, [rim]), len(mesh.triangles))
        else:
            made = cut_open(made, rim.centre + 1.5 * spacing * rim.normal, rim.normal, 1.5 * rim.radius)
    return made, moved


def _without_lid(made: Mesh, closed: Mesh, count: int) -> Mesh:
    """Return a remeshed surface without the piece nearest to a lid, the triangles of the surface before from `count`
    on: at a rim out of a plane any plane would take a piece of the wall as well."""
    _, triangles = nearest(made.corners.mean(axis=1), closed)
    lid = np.flatnonzero(triangles >= count)
    kept = np.ones(len(made.triangles), dtype=bool)
    if len(lid):
        kept[lid[find_bodies(made.part(lid)) == 0]] = False
    left = made.part(kept)
    return left.part(find_bodies(left) == 0)


def displacement(before: Mesh, after: Mesh, places: np.ndarray | None = None, reach: float = np.inf) -> float:
    """Return the largest distance of the new wall from the old one, and of the old one where it is outside of the new
    one; both closed. With places (k, 3), within a distance of them."""
    from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

    def sample(points: np.ndarray) -> np.ndarray:
        near = points if places is None else points[cKDTree(places).query(points)[0] < reach]
        return near[:: max(1, len(near) // _SAMPLES)]

    outside = vtkImplicitPolyDataDistance()
    outside.SetInput(to_vtk(after if signed_volume(after) > 0.0 else after.turned()))
    old = sample(np.concatenate([before.vertices, before.corners.mean(axis=1)]))
    lost = max([0.0, *(outside.EvaluateFunction(*point) for point in old)])
    return float(max(lost, distances(sample(after.vertices), before).max(initial=0.0)))


def signed_distances(mesh: Mesh, origin: np.ndarray, spacing: float, shape: tuple[int, int, int]) -> np.ndarray:
    """Distances from a closed surface on a grid, positive inside, up to some spacings from it; beyond, a larger number.

    The sign is that of regions: what is connected with the grid's border without crossing the surface is outside. So
    pieces of the surface within the lumen do not count, wherever they overlap.
    """
    points, near = _sampled(mesh, 0.45 * spacing), np.full(shape, np.inf, dtype=np.float32)
    band = np.zeros(shape, dtype=bool)
    cells = np.floor((points - origin) / spacing).astype(int)
    for i in range(-1, 3):
        for j in range(-1, 3):
            for k in range(-1, 3):
                band[tuple((cells + (i, j, k)).T)] = True
    nodes = np.argwhere(band)
    near[band] = distances(origin + spacing * nodes, mesh)
    # No path between neighbouring nodes farther than 0.9 spacings from the wall crosses it.
    free, count = label(~band | (near > 0.9 * spacing))
    sign = np.where(free == free[0, 0, 0], -1.0, 1.0).astype(np.float32)
    values = np.where(band, near, 4.0 * spacing) * sign
    close = band & (near <= 0.9 * spacing)
    where = np.argwhere(close)
    values[close] = near[close] * _sides(mesh, origin + spacing * where, where, sign, free)
    # What is not next to the outside is within the lumen, whatever pieces of the surface are there.
    within = close & ~binary_dilation(free == free[0, 0, 0], np.ones((3, 3, 3)))
    values[within] = np.maximum(near[within], 0.05 * spacing)
    return values


def _sides(mesh: Mesh, points: np.ndarray, nodes: np.ndarray, sign: np.ndarray, free: np.ndarray) -> np.ndarray:
    """+1 or -1 for nodes at the wall: the side of the nearest triangle on which the regions are outside."""
    from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

    distance = vtkImplicitPolyDataDistance()
    oriented = mesh if signed_volume(mesh) > 0.0 else mesh.turned()
    distance.SetInput(to_vtk(oriented))
    side = np.array([-np.sign(distance.EvaluateFunction(*point)) for point in points])
    # Where all neighbours with a region are of one, the wall there lies within it or the normal is wrong.
    total, inner = np.zeros(len(nodes)), np.zeros(len(nodes))
    for step in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)):
        at = tuple(np.clip(nodes + step, 0, np.array(free.shape) - 1).T)
        known = free[at] > 0
        total += known
        inner += known & (sign[at] > 0.0)
    side[(total >= 5) & (inner == total)] = 1.0
    side[(total >= 5) & (inner == 0)] = -1.0
    return side


def cut_open(mesh: Mesh, point: np.ndarray, normal: np.ndarray, reach: float) -> Mesh:
    """Return the mesh without what is behind a plane, as far as that is one piece near a point; normals as before."""
    from vtkmodules.vtkCommonDataModel import vtkPlane
    from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkTriangleFilter

    from guidewire.anatomy.surfaces import from_vtk

    # By the nearest corner: on a straight piece a triangle may be much longer than the lumen is wide.
    near = np.linalg.norm(mesh.corners - point, axis=2).min(axis=1) < 3.0 * reach
    behind = ((mesh.corners - point) @ normal < 0.0).any(axis=1) & near
    if not behind.any():
        return mesh
    piece = mesh.part(behind)
    bodies = find_bodies(piece)
    ids = np.flatnonzero(behind)
    middle = piece.corners.mean(axis=1)
    body = bodies[int(np.argmin(np.linalg.norm(middle - point, axis=1)))]
    chosen = np.zeros(len(mesh.triangles), dtype=bool)
    chosen[ids[bodies == body]] = True
    plane = vtkPlane()
    plane.SetOrigin(*point)
    plane.SetNormal(*normal)
    clip = vtkClipPolyData()
    clip.SetInputData(to_vtk(mesh.part(chosen)))
    clip.SetClipFunction(plane)
    clip.Update()
    cut = vtkTriangleFilter()
    cut.SetInputData(clip.GetOutput())
    cut.Update()
    rest = mesh.part(~chosen)
    if cut.GetOutput().GetNumberOfPolys() == 0:
        joined = rest
    else:
        front = from_vtk(cut.GetOutput())
        joined = Mesh(np.concatenate([rest.vertices, front.vertices]),
                      np.concatenate([rest.triangles, front.triangles + len(rest.vertices)]))
    from guidewire.anatomy.inspection import weld, weld_length_of, without_slivers

    joined, _, _ = weld(joined, weld_length_of(mesh))
    joined, _ = without_slivers(joined)
    # What the cut left hanging behind the plane is a body of its own.
    bodies = find_bodies(joined)
    return joined.part(bodies == 0)


def _sampled(mesh: Mesh, step: float) -> np.ndarray:
    """Return points on all triangles, no farther apart than a step."""
    corners = mesh.corners
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    parts = np.maximum(1, np.ceil(longest / step).astype(int))
    found = [mesh.vertices]
    for n in np.unique(parts):
        own = corners[parts == n]
        i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
        inside = i + j <= n
        a, b = i[inside] / n, j[inside] / n
        weights = np.stack([1.0 - a - b, a, b])
        found.append(np.einsum("kw,tkx->twx", weights, own).reshape(-1, 3))
    return np.concatenate(found)
