"""Repairs of a mesh, each counted and with the largest displacement that it made.

The order is from the smallest change to the largest: what a step mends, no later one touches. A remesh through a signed
distance comes last, and only where crossings or edges of more than two triangles are left.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from guidewire.anatomy.distance_grid import cut_open, displacement, remesh
from guidewire.anatomy.double_wall import are_folds, inner_wall
from guidewire.anatomy.inspection import (
    facing, narrow_radius, sort_rims, typical_radius, weld, weld_exactly, weld_length_of, without_fins,
    without_slivers,
)
from guidewire.anatomy.intersections import relaxed, self_intersections
from guidewire.anatomy.medial_graph import WallDistance
from guidewire.anatomy.mesh import (
    AnatomyError, Edges, Mesh, Rim, close_rims, find_bodies, find_rims, find_sheets, one_sided_at,
    pinched_triangles, signed_volume, turned_alike,
)
from guidewire.anatomy.patch import patched
from guidewire.anatomy.surfaces import distances

_FACING = 0.3
_ROUNDS = 3
_MOST_MOVED = 0.25  # of the typical radius, by a lid
_STRAY = 0.05  # of the largest body's box: a body up to that is a remnant
_NESTED = 0.5  # of the largest sheet's box: a wall of a nested pair is at least so large
_REACHES = (3.0, 5.0, 8.0)  # steps of the grid around crossings, as far as the wall is reconstructed
_WITHIN = 0.6  # of the vertices of the inner wall of a nested pair that crosses or touches lie within the outer one


@dataclass(frozen=True)
class Change:
    """name : what was done; count : how many; moved : largest displacement of the wall, the file's units; place : of
    the first, or None; leaves_out : whether a part of the file is no part of the vessel since."""

    name: str
    count: int
    moved: float = 0.0
    place: np.ndarray | None = None
    leaves_out: bool = False


@dataclass(frozen=True)
class Repaired:
    """mesh : one surface, normals into the lumen, closed but for its rims; rims : ends, the largest first; changes :
    what was done, in order."""

    mesh: Mesh
    rims: list[Rim]
    changes: list[Change]

    @property
    def moved(self) -> float:
        """Bound on the displacement of the wall: the sum of the steps'."""
        return sum(change.moved for change in self.changes)


def with_rims_apart(mesh: Mesh) -> tuple[Mesh, np.ndarray]:
    """Return the mesh's largest body without the triangles around vertices at which a rim touches itself or another
    one, and these vertices' places (k, 3)."""
    places = np.empty((0, 3))
    while True:
        mesh = mesh.part(find_bodies(mesh) == 0)
        edges = Edges.of(mesh)
        triangle, k = np.argwhere(edges.counts[edges.of_triangles] == 1).T
        met = np.bincount(mesh.triangles[triangle, k], minlength=len(mesh.vertices)) > 1
        if not met.any():
            return mesh, places
        places = np.vstack([places, mesh.vertices[met]])
        mesh = mesh.part(~met[mesh.triangles].any(axis=1))


def repair(mesh: Mesh) -> Repaired:
    """Return a mesh that the program takes as a vessel.

    Raises
    ------
    AnatomyError : what is left cannot be repaired; the line names the first place.
    """
    work = _Work(mesh)
    work.weld()
    work.drop_slivers()
    work.turn_alike()
    work.keep_inner_sheet()
    work.drop_bodies()
    work.keep_inner_wall()
    work.cut_crowded()
    work.drop_bodies()
    work.cut_crossings()
    work.fill_holes()
    work.cut_crossings_of_lids()
    work.remesh_if_needed()
    work.part_rims()
    work.orient()
    rims = [rim for rim in sort_rims(work.mesh, find_rims(work.mesh, Edges.of(work.mesh)))]
    return Repaired(work.mesh, rims, work.changes)


class _Work:
    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self.changes: list[Change] = []
        self._removed: Mesh | None = None  # the wall where triangles were taken out
        self._ends: list[tuple[Rim, np.ndarray]] = []  # before that: the rims, and their vertices' places

    def _note(self, name: str, count: int, moved: float = 0.0, place: np.ndarray | None = None,
              leaves_out: bool = False) -> None:
        if count:
            self.changes.append(Change(name, count, moved, place, leaves_out))

    def part_rims(self) -> None:
        self.mesh, places = with_rims_apart(self.mesh)
        self._note("places where rims touch themselves or each other cut away", len(places), 0.0,
                   places[0] if len(places) else None)

    def weld(self) -> None:
        exact = weld_exactly(self.mesh)
        self.mesh, count, moved = weld(exact, weld_length_of(exact))
        self._note("vertices welded that were nearer than a thousandth of the median edge", count, moved)

    def drop_slivers(self) -> None:
        self.mesh, places = without_slivers(self.mesh)
        self._note("triangles without area, or duplicates removed", len(places), 0.0,
                   places[0] if len(places) else None)

    def keep_inner_sheet(self) -> None:
        """Keep, of two nested walls that cross, or that share vertices where they touch, the inner one. Sheets are
        joined at edges of two triangles only."""
        sheets = find_sheets(self.mesh)
        extents = [np.ptp(self.mesh.part(sheets == k).vertices, axis=0).max() for k in range(sheets.max() + 1)]
        large = [k for k, extent in enumerate(extents) if extent > _NESTED * max(extents)]
        if len(large) < 2:
            return
        points, pairs = self_intersections(self.mesh)
        for outer, inner in permutations(large, 2):
            crossing = (np.sort(sheets[pairs], axis=1) == sorted((outer, inner))).all(axis=1)
            is_shared = np.isin(self.mesh.triangles[sheets == inner], self.mesh.triangles[sheets == outer])
            shared = np.unique(self.mesh.triangles[sheets == inner][is_shared])
            if not (crossing.any() or len(shared)):
                continue
            if _fraction_within(self.mesh.part(sheets == inner), self.mesh.part(sheets == outer)) < _WITHIN:
                continue
            at = np.concatenate([points[crossing], self.mesh.vertices[shared]])
            for place, count in self._stretches(at):
                self._note("crossings and common vertices of two nested walls, of which the inner one is kept as it is",
                           count, 0.0, place)
            self.mesh = self.mesh.part(sheets != outer)
            return

    def _stretches(self, points: np.ndarray) -> list[tuple[np.ndarray, int]]:
        """Return points (k, 3) near each other in one stretch of the wall: middle and number of each, the longest
        first."""
        if not len(points):
            return []
        reach = 2.0 * float(np.quantile(self.mesh.edge_lengths(), 0.9))
        pairs = cKDTree(points).query_pairs(reach, output_type="ndarray")
        graph = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(len(points), len(points)))
        labels = connected_components(graph, directed=False)[1]
        found = [(points[labels == k].mean(axis=0), int((labels == k).sum())) for k in range(labels.max() + 1)]
        return sorted(found, key=lambda stretch: -stretch[1])

    def drop_bodies(self) -> None:
        bodies = find_bodies(self.mesh)
        if bodies.max() == 0:
            return
        keep = _inner_body(self.mesh, bodies)
        _, pairs = self_intersections(self.mesh)
        met = bodies[pairs]
        crossing = set(met[(met == keep).any(axis=1)].ravel().tolist()) - {keep}
        if crossing:
            # Bodies that overlap are one lumen; the remesh joins them.
            place = self.mesh.part(np.isin(bodies, list(crossing))).vertices.mean(axis=0)
            self._note("bodies that overlap the largest one joined with it", len(crossing), 0.0, place)
            bodies = np.where(np.isin(bodies, list(crossing)), keep, bodies)
        if (bodies == keep).all():
            return
        others = self.mesh.part(bodies != keep)
        size = np.ptp(self.mesh.part(bodies == keep).vertices, axis=0).max()
        for k in np.unique(bodies):
            extent = np.ptp(self.mesh.part(bodies == k).vertices, axis=0).max()
            if k != keep and extent > _STRAY * size and not _is_around(self.mesh, bodies, k, keep):
                place = np.round(self.mesh.part(bodies == k).vertices.mean(axis=0), 4).tolist()
                raise AnatomyError(f"{len(np.unique(bodies))} separate surfaces; besides the largest one "
                                   f"another, around {place}, is {extent / size:.0%} of its size: a vessel is one; "
                                   "take one out, or join them")
        self._note("stray bodies removed", len(np.unique(bodies)) - 1, 0.0, others.vertices.mean(axis=0),
                   leaves_out=True)
        self.mesh = self.mesh.part(bodies == keep)

    def keep_inner_wall(self) -> None:
        """Keep of a double wall joined at its ends the side from which fewer rays escape, cut straight at its ends."""
        if facing(self.mesh).mean() <= _FACING:
            return
        if signed_volume(self.mesh) < 0.0:
            self.mesh = self.mesh.turned()
            self._note("normals of a double wall turned out of it", len(self.mesh.triangles))
        part, thickness = inner_wall(self.mesh)
        count = len(self.mesh.triangles) - len(part.triangles)
        points, pairs = self_intersections(self.mesh)
        is_inner = np.isin(_keys(self.mesh), _keys(part))
        between = points[is_inner[pairs[:, 0]] != is_inner[pairs[:, 1]]]
        rims = find_rims(part, Edges.of(part))
        # Where the walls cross, the border between them may have gone from one to the other.
        is_near = np.zeros(len(points), dtype=bool)
        for rim in rims:
            is_near |= np.linalg.norm(points - rim.centre, axis=1) < 2.0 * rim.radius
        if not are_folds(self.mesh, pairs[is_near], thickness):
            raise AnatomyError(f"the walls of a double wall cross each other, {_listed(self._stretches(points))}: "
                               "which one is the lumen's is not certain there")
        for place, crossings in self._stretches(between):
            self._note("crossings of the two walls of a double wall, of which the inner one is kept as it is",
                       crossings, 0.0, place)
        ends = [rim for rim in sort_rims(part, rims) if not rim.is_hole]
        deepest = [((part.vertices[rim.vertices] - rim.centre) @ rim.normal).max() for rim in ends]
        for rim, depth in zip(ends, deepest):
            inside = max(depth, 0.0) + thickness
            part = cut_open(part, rim.centre + inside * rim.normal, rim.normal, 1.5 * rim.radius)
        self._note("triangles of an outer wall removed, the lumen's kept", count, leaves_out=True)
        self.mesh = part

    def cut_crowded(self) -> None:
        """Fins off, then the triangles around edges of more than two; their holes are filled afterwards."""
        self.mesh, places = without_fins(self.mesh)
        self._note("triangles of fins removed", len(places), 0.0, places[0] if len(places) else None)
        edges = Edges.of(self.mesh)
        bad = (edges.counts[edges.of_triangles] > 2).any(axis=1)
        if bad.any():
            self._take_out(bad, "triangles at edges of more than two removed")

    def cut_crossings(self) -> None:
        _, pairs = self_intersections(self.mesh)
        if not len(pairs):
            return
        bad = np.zeros(len(self.mesh.triangles), dtype=bool)
        bad[pairs.ravel()] = True
        if bad.sum() <= max(40, 0.02 * len(bad)) and find_bodies(self.mesh).max() == 0:
            before, known = self.mesh, list(self.changes)
            self._take_out(bad, "triangles that passed through others removed")
            self.fill_holes()
            if not len(self_intersections(self.mesh)[1]):
                return
            self.mesh, self.changes = before, known
        # What is left goes through the distance grid.

    def cut_crossings_of_lids(self) -> None:
        """Few crossings that are left, or that lids over holes made: out with a ring of triangles around them."""
        for _ in range(_ROUNDS):
            _, pairs = self_intersections(self.mesh)
            if not 0 < len(pairs) <= 40 or find_bodies(self.mesh).max() > 0:
                return
            before, known = self.mesh, list(self.changes)
            at = np.unique(before.triangles[pairs.ravel()])
            self._take_out(np.isin(self.mesh.triangles, at).any(axis=1),
                           "triangles that passed through others removed, with those around")
            self.fill_holes()
            if self.changes[-1].moved > _MOST_MOVED * typical_radius(before):
                self.mesh, self.changes = before, known  # a piece of the vessel went with them
                return

    def _take_out(self, bad: np.ndarray, name: str) -> None:
        place = self.mesh.corners[bad][0].mean(axis=0)
        self._note(name, int(bad.sum()), 0.0, place)
        before = self.mesh
        if self._removed is None:
            self._ends = [(rim, before.vertices[rim.vertices]) for rim in find_rims(before, Edges.of(before))]
        work = before.part(~bad)
        # A vertex between two fans would leave rims that touch: the smaller fan goes as well.
        for _ in range(20):
            pinched = pinched_triangles(work)
            if not pinched.any():
                break
            work = work.part(~pinched)
        bodies = find_bodies(work)
        self.mesh = work.part(bodies == 0)
        self._removed = before.part(~np.isin(_keys(before), _keys(self.mesh)))

    def fill_holes(self) -> None:
        rims = sort_rims(self.mesh, find_rims(self.mesh, Edges.of(self.mesh)))
        if not rims:
            return
        typical = typical_radius(self.mesh)
        holes = [rim for rim in rims if rim.is_hole or (self._removed is not None and (
            rim.radius < 0.25 * typical or not self._is_end(rim)))]
        if holes:
            depth = max(_bulge(self.mesh, rim) for rim in holes)
            filled, _ = without_slivers(close_rims(self.mesh, holes))
            if self._removed is not None:
                gone = self._removed
                depth = float(distances(np.concatenate([gone.vertices, gone.corners.mean(axis=1)]), filled).max())
            self._note("holes in the side filled", len(holes), depth, holes[0].centre)
            self.mesh = filled

    def _is_end(self, rim: Rim) -> bool:
        """Return whether a rim was there before triangles were taken out, at least in part, or lies where one was."""
        places = self.mesh.vertices[rim.vertices]
        return any(np.isin(_rows(places), _rows(known)).any() or
                   np.linalg.norm(rim.centre - before.centre) < max(rim.radius, before.radius)
                   for before, known in self._ends)

    def remesh_if_needed(self) -> None:
        edges = Edges.of(self.mesh)
        crowded = edges.ends[edges.counts > 2]
        points, _ = self_intersections(self.mesh)
        if not len(crowded) and not len(points):
            return
        place = points[0] if len(points) else self.mesh.vertices[crowded[0]].mean(axis=0)
        count = len(points) + len(crowded)
        rims = sort_rims(self.mesh, find_rims(self.mesh, edges))
        before, ends = self.mesh, [rim for rim in rims if not rim.is_hole]
        spacing = 0.25 * narrow_radius(before)
        made, moved = remesh(before, ends, spacing)
        places = np.concatenate([points, before.vertices[crowded].reshape(-1, 3)])
        step = max(spacing, float(np.median(before.edge_lengths())))
        for reach in _REACHES:
            mended = patched(before, made, places, reach * step, step)
            if mended is not None and _is_whole(mended := relaxed(mended), len(ends)):
                self.mesh, _ = turned_alike(mended)
                closed = close_rims(self.mesh, find_rims(self.mesh, Edges.of(self.mesh)))
                self._note("crossings left: the wall reconstructed there from its signed distance", count,
                           displacement(close_rims(before, ends), closed, places, reach * step), place)
                return
        self.mesh = relaxed(made)
        self._note("crossings left: the whole wall reconstructed from its signed distance", count, moved, place)
        points, _ = self_intersections(self.mesh)
        if len(points):
            raise AnatomyError(f"the surface passes through itself at {len(points)} places, the first at "
                               f"{np.round(points[0], 4).tolist()}, and a remesh does not mend it")

    def turn_alike(self) -> None:
        """Turn triangles to agree with their neighbours. Rims have their senses from their triangles."""
        self.mesh, turned = turned_alike(self.mesh)
        self._note("triangles turned to agree with their neighbours", turned)

    def orient(self) -> None:
        self.turn_alike()
        mesh = self.mesh
        place = one_sided_at(mesh)
        if place is not None:
            raise AnatomyError(f"the surface has one side only, at {np.round(place, 4).tolist()}: triangles cannot be "
                               "turned to agree")
        rims = find_rims(mesh, Edges.of(mesh))
        if signed_volume(mesh, rims) > 0.0:
            mesh = mesh.turned()
            self._note("normals turned into the lumen", len(mesh.triangles))
        self.mesh = mesh


def _is_whole(mesh: Mesh, ends: int) -> bool:
    """Return whether a surface is of one body, with so many rims, and does not cross itself."""
    edges = Edges.of(mesh)
    return bool((edges.counts <= 2).all() and find_bodies(mesh).max() == 0 and len(find_rims(mesh, edges)) == ends
                and not len(self_intersections(mesh)[1]))


def _keys(mesh: Mesh) -> np.ndarray:
    """Return (t,): a number of each triangle's middle, the same for the same middle."""
    return _rows(mesh.corners.mean(axis=1))


def _rows(points: np.ndarray) -> np.ndarray:
    """Return (k,): a number of each point (k, 3), the same for the same place."""
    return np.ascontiguousarray(points + 0.0).view(np.dtype((np.void, 24))).ravel()


def _bulge(mesh: Mesh, rim: Rim) -> float:
    """Return how far the wall may have been from a flat lid over a hole: that of a sphere, at most its radius."""
    off = np.abs((mesh.vertices[rim.vertices] - rim.centre) @ rim.normal).max()
    return float(min(max(off, 0.1 * rim.radius), max(rim.radius, off)))


def _fraction_within(inner: Mesh, outer: Mesh) -> float:
    """Return the fraction of sampled vertices of a surface that lie within another one, its rims closed."""
    rims = find_rims(outer, Edges.of(outer))
    points = inner.vertices[:: max(1, len(inner.vertices) // 300)]
    return float(WallDistance(close_rims(outer, rims) if rims else outer).inside(points).mean())


def _listed(stretches: list[tuple[np.ndarray, int]]) -> str:
    return "; ".join(f"{count} times around {np.round(place, 4).tolist()}" for place, count in stretches)


def _inner_body(mesh: Mesh, bodies: np.ndarray) -> int:
    """Return the largest body, or the one inside of it that is nearly as large: the lumen of a wall of two surfaces."""
    sizes = [np.ptp(mesh.part(bodies == k).vertices, axis=0).max() for k in range(bodies.max() + 1)]
    largest = int(np.argmax(sizes))
    for k in range(bodies.max() + 1):
        if k != largest and sizes[k] > 0.5 * sizes[largest] and _is_around(mesh, bodies, largest, k):
            return k
    return largest


def _is_around(mesh: Mesh, bodies: np.ndarray, outer: int, inner: int) -> bool:
    """Return whether the vertices of one body lie inside of another one."""
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersModeling import vtkSelectEnclosedPoints

    from guidewire.anatomy.surfaces import to_vtk

    select = vtkSelectEnclosedPoints()
    select.SetSurfaceData(to_vtk(mesh.part(bodies == outer)))
    select.SetInputData(vtkPolyData())
    select.Initialize(to_vtk(mesh.part(bodies == outer)))
    points = mesh.part(bodies == inner).vertices
    points = points[:: max(1, len(points) // 100)]
    return np.mean([select.IsInsideSurface(*point) for point in points]) > 0.9
