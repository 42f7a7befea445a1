"""Centreline of a lumen: the tree of paths along which the inscribed spheres are largest, with their radii.

The centres of the largest spheres that fit between points of the wall are vertices of the points' Voronoi diagram
(Amenta, Bern 1999). The paths are the shortest ones through them, where length is weighted with 1/radius (Antiga et
al. 2003). Their points are then moved, across the path, to where the distance from the triangles is largest.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from guidewire.anatomy.inspection import narrow_radius
from guidewire.anatomy.loops import Loop, Neck, find_loops, find_necks
from guidewire.anatomy.medial_graph import BLIND, MedialGraph, WallDistance, walk_back
from guidewire.anatomy.mesh import AnatomyError, Mesh, Rim, close_rims, signed_volume
from guidewire.anatomy.sampling import resample, sample

_SAMPLES = (6_000, 40_000)  # points of the wall, at least and at most
_DENSITY = 40.0  # of them on the square of a narrow radius
_STEP = 0.25  # between points of the centreline, of the radius
_THIN = 0.15  # a branch with a blind end is at least so wide, of the nearest path's radius
_NEAREST = 12  # nodes of other paths that a blind end is compared with
_EDGE = 2.0  # radii of a blind end: so far before and behind it the lumen goes on where it is an edge
_AT_RIM = 3.0  # radii of a rim
_SMOOTHING = 1.5  # points, of the Gaussian along a branch
_ROUNDS = 3
# radii of the lumen, from where the two ways of a loop meet: the tree's end there is no end of the vessel
_AT_CUT = 3.0
_CORNER = 1.0  # of the widest radius: along so much of a way that runs into the wall its width is compared
_SAC = 4.0  # widest radii from the tip of a sac, within which its neck is
_WIDER = 1.2  # of a neck: so much wider is the vessel behind it; a branch of a trunk goes on as it is
_NECK = 0.75  # of a sac's widest radius, that its neck has at most


@dataclass(frozen=True)
class End:
    """An end of the centreline: number and name as users give them; centre (3,); radius; direction (3,), into the
    lumen; is_open : whether it is a rim; point : index of the centreline's point there; is_sac : whether it is the dome
    of a sac with a neck, such as an aneurysm: no wire enters there."""

    number: int
    name: str
    centre: np.ndarray
    radius: float
    direction: np.ndarray
    is_open: bool
    point: int
    is_sac: bool = False


@dataclass(frozen=True)
class Centreline:
    """A tree of k points: points (k, 3), radii (k,) of the inscribed spheres, parents (k,), -1 at the root and else
    smaller than the point's own index; branches (k,), from 1; ends, the widest first and sacs last; loops, where ways
    meet that the tree does not join; necks, where two vessels may touch."""

    points: np.ndarray
    radii: np.ndarray
    parents: np.ndarray
    branches: np.ndarray
    ends: tuple[End, ...]
    loops: tuple[Loop, ...] = ()
    necks: tuple[Neck, ...] = ()

    def chain(self, point: int) -> np.ndarray:
        """Indices from a point to the root."""
        found = [point]
        while self.parents[found[-1]] >= 0:
            found.append(int(self.parents[found[-1]]))
        return np.array(found)

    def path(self, start: int, end: int) -> np.ndarray:
        """Indices from a point to another one, the shorter way round loops."""
        if self.loops:
            return self._shortest(start, end)
        one, other = self.chain(start), self.chain(end)
        common = np.isin(one, other)
        meeting = one[np.argmax(common)]
        return np.r_[one[:np.argmax(common) + 1], other[:np.flatnonzero(other == meeting)[0]][::-1]]

    def _shortest(self, start: int, end: int) -> np.ndarray:
        own = np.flatnonzero(self.parents >= 0)
        rows = np.r_[own, [loop.points[0] for loop in self.loops]].astype(int)
        columns = np.r_[self.parents[own], [loop.points[1] for loop in self.loops]].astype(int)
        lengths = np.maximum(np.linalg.norm(self.points[rows] - self.points[columns], axis=1), 1e-300)
        graph = coo_matrix((lengths, (rows, columns)), shape=(len(self.points), len(self.points))).tocsr()
        before = dijkstra(graph, directed=False, indices=start, return_predecessors=True)[1]
        return np.array(walk_back(before, end))

    def length(self, indices: np.ndarray) -> float:
        """Return the length of the polyline through these points."""
        return float(np.linalg.norm(np.diff(self.points[indices], axis=0), axis=1).sum())

    def inner(self) -> np.ndarray:
        """Return (k,): points farther than a radius from every closed end, where the sphere is bounded by the end as
        well, and in no neck between two vessels."""
        inner = np.ones(len(self.points), dtype=bool)
        inner[[point for neck in self.necks for point in neck.points]] = False
        for end in self.ends:
            if not end.is_open:
                inner &= np.linalg.norm(self.points - end.centre, axis=1) > 1.2 * end.radius
        return inner if inner.any() else np.ones(len(self.points), dtype=bool)

    @property
    def narrowest(self) -> int:
        """The point with the smallest radius, closed ends apart."""
        inner = np.flatnonzero(self.inner())
        return int(inner[np.argmin(self.radii[inner])])


def find_centreline(mesh: Mesh, rims: list[Rim], root: np.ndarray | None = None) -> Centreline:
    """The centreline of one lumen between its rims and its blind ends.

    Parameters
    ----------
    mesh : one surface, consistently oriented, closed but for the rims.
    rims : all of them.
    root : a point near the end that the tree begins at; the widest end where it is not given.

    Raises
    ------
    AnatomyError : there is no path between two ends.
    """
    closed = close_rims(mesh, rims) if rims else mesh
    if signed_volume(closed) < 0.0:
        closed = closed.turned()
    wall = WallDistance(closed)
    area = np.linalg.norm(closed.area_vectors(), axis=1).sum()
    graph = MedialGraph(sample(closed, int(np.clip(_DENSITY * area / narrow_radius(closed)**2, *_SAMPLES))))
    nodes = [graph.at_rim(rim) for rim in rims]
    if not nodes:
        nodes = graph.two_ends()
    if root is None:
        start = nodes[int(np.argmax([rim.radius for rim in rims] if rims else graph.radii_near(nodes)))]
    else:
        start = min(nodes, key=lambda node: np.linalg.norm(graph.centres[node] - root))
    cost, before = dijkstra(graph.weights, directed=False, indices=start, return_predecessors=True)
    lost = [rim for rim, node in zip(rims, nodes) if not np.isfinite(cost[node])]
    if lost:
        raise AnatomyError(f"no path leads to {lost[0].name} at {np.round(lost[0].centre, 4).tolist()}: the lumen is "
                           "closed in between")
    known = set(walk_back(before, start)) if len(nodes) == 1 else set().union(*(walk_back(before, n) for n in nodes))
    blind = graph.blind_ends(known, before, dijkstra(graph.lengths, directed=False, indices=start))
    return _Builder(graph, wall, WallDistance(mesh) if rims else wall, rims, nodes, blind, start, before).build(closed)


class _Builder:
    """Makes a smooth tree of the paths."""

    def __init__(self, graph: MedialGraph, wall: WallDistance, without_caps: WallDistance, rims: list[Rim],
                 nodes: list[int], blind: list[int], start: int, before: np.ndarray) -> None:
        self._graph, self._wall, self._open = graph, wall, without_caps
        self._start, self._before = start, before
        self._targets = list(nodes) + blind
        self._rims: list[Rim | None] = [*rims, *[None] * (len(self._targets) - len(rims))]
        self._points: list[np.ndarray] = []
        self._radii: list[float] = []
        self._parents: list[int] = []
        self._branches: list[int] = []

    def build(self, closed: Mesh) -> Centreline:
        paths = [self._trim(walk_back(self._before, target), rim) for target, rim in zip(self._targets, self._rims)]
        chains = self._inside(paths)
        kept = self._apart(chains, [len(chain) < len(path) for chain, path in zip(chains, paths)])
        chains = [chains[k] for k in kept]
        self._targets, self._rims = [self._targets[k] for k in kept], [self._rims[k] for k in kept]
        if self._rims[self._targets.index(self._start)] is None:
            # The same at the root: all paths begin with the piece out of its corner.
            longest = max(chains, key=len)
            corner = len(longest) - len(self._without_corner(longest[::-1]))
            others = [chain for target, chain in zip(self._targets, chains) if target != self._start]
            while any(len(chain) <= corner or chain[corner] != longest[corner] for chain in others):
                corner -= 1
            chains = [chain[corner:] or longest[corner:corner + 1] for chain in chains]
        uses: dict[int, int] = {}
        for chain in chains:
            for node in chain:
                uses[node] = uses.get(node, 0) + 1
        order = sorted(range(len(chains)), key=lambda k: (self._rims[k] is None, k))
        at: dict[int, int] = {}  # index of the tree's point of a node where branches meet
        last: dict[int, int] = {}
        root = self._targets.index(self._start)
        if len(order) == 1:
            raise AnatomyError("the lumen has one end only: no path leads through it")
        for k in order:
            if k != root:
                self._lay(chains[k], self._rims[k], uses, at)
                last[k] = len(self._points) - 1
        last[root] = 0
        loops = find_loops(closed, np.array(self._points), np.array(self._radii), np.array(self._parents))
        # The cut of a loop is no end of the vessel: the way goes on to the other side.
        cut = [k for k in order if self._rims[k] is None and self._is_cut(last[k], loops)]
        ends = [self._end(k, last[k]) for k in order if k not in cut]
        gone = self._corners([last[k] for k in cut if k != root])
        loops = [self._joined(replace(loop, points=(self._before_any(gone, loop.points[0]),
                                                    self._before_any(gone, loop.points[1])))) for loop in loops]
        if len(ends) < 2:
            raise AnatomyError("the lumen has one end only: no path leads through it")
        ends.sort(key=lambda end: (end.is_sac, -end.radius))
        named = [replace(end, number=number, name=end.name or f"end {number}") for number, end in enumerate(ends, 1)]
        kept = np.setdiff1d(np.arange(len(self._points)), list(gone))
        number = np.full(len(self._points) + 1, -1)    # the last is that of no parent
        number[kept] = np.arange(len(kept))
        radii = np.array([self._open.distance(self._points[k]) for k in kept])
        branches = np.unique(np.array(self._branches)[kept], return_inverse=True)[1] + 1
        loops = [replace(loop, points=tuple(number[list(loop.points)].tolist())) for loop in loops]
        places, parents = np.array(self._points)[kept], number[np.array(self._parents)[kept]]
        return Centreline(places, radii, parents, branches,
                          tuple(replace(end, point=int(number[end.point])) for end in named), tuple(loops),
                          tuple(find_necks(places, radii, parents, loops)))

    def _corners(self, tips: list[int]) -> set[int]:
        """Points from these on back to the nearest one in no sphere of another branch that is about as wide as the way
        before it: where a way runs into another one, or into the wall, it is not on the axis."""
        uses = np.bincount(np.array(self._parents[1:]), minlength=len(self._points))
        places, radii, branches = np.array(self._points), np.array(self._radii), np.array(self._branches)
        found: set[int] = set()
        for tip in tips:
            chain, gone, widest = [tip], 0.0, 0.0
            while self._parents[chain[-1]] >= 0 and gone < _CORNER * widest + 2.0 * self._radii[chain[-1]]:
                chain.append(self._parents[chain[-1]])
                gone += float(np.linalg.norm(self._points[chain[-1]] - self._points[chain[-2]]))
                widest = max(widest, self._radii[chain[-1]])
            others = branches != branches[tip]
            point = tip
            while uses[point] == (point != tip) and self._parents[point] >= 0 and (
                    radii[point] < 0.9 * widest and point in chain
                    or (np.linalg.norm(places[others] - places[point], axis=1) < radii[others]).any()):
                found.add(point)
                point = self._parents[point]
        return found

    def _before_any(self, gone: set[int], point: int) -> int:
        while point in gone:
            point = self._parents[point]
        return point

    def _is_cut(self, tip: int, loops: list[Loop]) -> bool:
        return any(np.linalg.norm(self._points[tip] - self._points[point]) < _AT_CUT * loop.radius
                   for loop in loops for point in loop.points)

    def _joined(self, loop: Loop) -> Loop:
        """Return a loop whose two sides in the tree are next to each other: what the tree lacks between them is a
        branch."""
        one, other = loop.points
        sides = np.array([self._points[one], self._points[other]])
        away = np.linalg.norm(sides - loop.place, axis=1)
        if np.linalg.norm(sides[0] - sides[1]) < 2.0 * _STEP * min(self._radii[one], self._radii[other]):
            return loop
        centres, radii = self._graph.centres, self._graph.radii
        near = np.flatnonzero(np.linalg.norm(centres - loop.place, axis=1) < 1.5 * away.max() + 2.0 * loop.radius)
        start, end = (int(np.argmin(np.linalg.norm(centres[near] - point, axis=1))) for point in sides)
        cost, before = dijkstra(self._graph.weights[near][:, near], directed=False, indices=start,
                                return_predecessors=True)
        if not np.isfinite(cost[end]):
            return loop
        nodes = near[walk_back(before, end)]
        line, own = self._smooth(np.vstack([sides[0], centres[nodes], sides[1]]),
                                 np.r_[self._radii[one], radii[nodes], self._radii[other]], None, None, (False, False),
                                 False)
        branch, parent = max(self._branches) + 1, one
        for point, radius in zip(line[1:-1], own[1:-1]):
            self._append(point, radius, parent, branch)
            parent = len(self._points) - 1
        return replace(loop, points=(parent, other))

    def _inside(self, chains: list[list[int]]) -> list[list[int]]:
        """Paths to blind ends without what is outside: through a thin or coarse wall the graph may go on there."""
        is_blind = [rim is None and target != self._start for rim, target in zip(self._rims, self._targets)]
        nodes = sorted({node for chain, blind in zip(chains, is_blind) if blind for node in chain})
        outside = set(np.array(nodes)[~self._wall.inside(self._graph.centres[nodes])].tolist()) if nodes else set()
        kept = []
        for chain, blind in zip(chains, is_blind):
            count = len(chain)
            while blind and count > 1 and chain[count - 1] in outside:
                count -= 1
            kept.append(chain[:count])
        return kept

    def _is_at_rim(self, chain: list[int]) -> bool:
        """Return whether a path ends near a rim: beyond one that is not plane the wall of one side goes on."""
        tip = self._graph.centres[chain[-1]]
        return any(np.linalg.norm(tip - rim.centre) < _AT_RIM * rim.radius for rim in self._rims if rim is not None)

    def _apart(self, chains: list[list[int]], is_cut: list[bool]) -> list[int]:
        """Which paths to keep: rims, the root's, and of blind ends those that are not near the paths before, nor cut
        off at the wall near a rim."""
        graph, kept = self._graph, []
        typical = float(np.median(graph.radii[np.concatenate(chains)]))
        for k, chain in enumerate(chains):
            if is_cut[k] and self._is_at_rim(chain):
                continue
            others = [node for j in kept for node in chains[j]]
            if self._rims[k] is None and self._targets[k] != self._start and others:
                away = np.linalg.norm(graph.centres[others] - graph.centres[chain[-1]], axis=1)
                beside = graph.radii[others[int(np.argmin(away))]]
                near = np.flatnonzero(away < (1.0 + BLIND) * graph.radii[others])
                near = near[np.argsort(away[near])[:_NEAREST]]
                if self._sees(chain[-1], np.array(others)[near]) or graph.radii[chain[-1]] < _THIN * min(
                        beside, typical) or self._is_edge(chain[-1], others, int(np.argmin(away))):
                    continue
            kept.append(k)
        return kept

    def _sees(self, tip: int, nodes: np.ndarray) -> bool:
        """Return whether a straight way within the lumen leads from a blind end to one of these nodes: beside another
        vessel, which a wall parts from it, a branch is one all the same."""
        graph, parts = self._graph, np.linspace(0.1, 0.9, 9)[:, None]
        ways = (graph.centres[tip] + parts * (graph.centres[node] - graph.centres[tip]) for node in nodes)
        return any(all((np.linalg.norm(graph.centres - place, axis=1) < graph.radii).any() for place in way)
                   for way in ways)

    def _is_edge(self, tip: int, others: list[int], nearest: int) -> bool:
        """Return whether a blind end is the edge of a lumen that is no circle, such as a crescent: it goes on there
        along the path beside, before and behind. A branch is as wide as its end, and a dome as well."""
        graph = self._graph
        path = graph.centres[others]
        own = path[np.linalg.norm(path - path[nearest], axis=1) < 2.0 * graph.radii[others[nearest]]]
        along = np.linalg.svd(own - own.mean(axis=0), full_matrices=False)[2][0]
        step = _EDGE * graph.radii[tip] * along
        return all((np.linalg.norm(graph.centres - place, axis=1) < graph.radii).any()
                   for place in (graph.centres[tip] - step, graph.centres[tip] + step))

    def _trim(self, chain: list[int], rim: Rim | None) -> list[int]:
        """Return a path from the root; without its last piece, into the corner of a blind end."""
        return chain if rim is not None else self._without_corner(chain)

    def _without_corner(self, chain: list[int]) -> list[int]:
        radii = self._graph.radii[chain]
        keep = len(chain)
        while keep > 2 and radii[keep - 1] < 0.9 * radii[max(0, keep - 6):keep].max():
            keep -= 1
        return chain[:keep]

    def _lay(self, chain: list[int], rim: Rim | None, uses: dict[int, int], at: dict[int, int]) -> None:
        """Append the pieces of a path that the tree does not have yet."""
        cuts = [k for k in range(1, len(chain)) if uses[chain[k]] != uses[chain[k - 1]]]
        borders = sorted({0, *(k - 1 for k in cuts), len(chain) - 1})
        if len(borders) == 1:
            borders = [0, 0]
        for low, high in zip(borders[:-1], borders[1:]):
            if chain[high] in at:
                continue
            nodes = chain[low:high + 1]
            is_last = high == len(chain) - 1
            tail = rim if is_last else None
            head = self._rims[self._targets.index(self._start)] if low == 0 and not at else None
            centres = self._graph.centres[nodes].copy()
            if chain[low] in at:
                centres[0] = self._points[at[chain[low]]]
            if not is_last:
                centres[-1] = self._fork(chain[high])
            line, radii = self._smooth(centres, self._graph.radii[nodes], tail, head,
                                       is_free=(low == 0 and not at, is_last), is_root=low == 0 and not at)
            if low == 0 and not at:
                self._append(line[0], radii[0], -1, 1)
                at[chain[0]] = 0
            parent = at[chain[low]]
            branch = max(self._branches) + (1 if len(self._points) > 1 else 0)
            for point, radius in zip(line[1:], radii[1:]):
                self._append(point, radius, parent, branch)
                parent = len(self._points) - 1
            at[chain[high]] = parent

    def _fork(self, node: int) -> np.ndarray:
        """Return where the sphere of a fork is largest: paths meet where they are short, beside its axis."""
        place, radius = self._graph.centres[node], float(self._graph.radii[node])
        for axis in np.eye(3):
            place = self._open.centre(place, axis, radius, 0.5 * radius)
        return place

    def _append(self, point: np.ndarray, radius: float, parent: int, branch: int) -> None:
        self._points.append(point)
        self._radii.append(radius)
        self._parents.append(parent)
        self._branches.append(branch)

    def _smooth(self, line: np.ndarray, radii: np.ndarray, tail: Rim | None, head: Rim | None,
                is_free: tuple[bool, bool], is_root: bool) -> tuple[np.ndarray, np.ndarray]:
        """Return the points of a piece in even steps, each where the inscribed sphere is largest, and their radii."""
        step = _STEP * float(np.median(radii))
        # A rim bounds no sphere, so its piece is centred with the others; a blind end's wall is met afterwards.
        if is_free[1] and tail is not None:
            line = np.vstack([line, tail.centre])
        if is_root and is_free[0] and head is not None:
            line = np.vstack([head.centre, line])
        line = resample(line, step)
        for _ in range(_ROUNDS):
            line = _filtered(line)
            tangents = np.gradient(line, axis=0) if len(line) > 1 else np.zeros_like(line)
            for k in range(1, len(line) - 1):
                size = np.linalg.norm(tangents[k])
                if size > 0.0:
                    radius = self._open.distance(line[k])
                    line[k] = self._open.centre(line[k], tangents[k] / size, max(radius, 1e-3 * step), 0.5 * radius)
            line = resample(_filtered(line), step)
        if is_free[1] and tail is None:
            line = np.concatenate([line, self._to_wall(line, step)])
        if is_root and is_free[0] and head is None:
            line = np.concatenate([self._to_wall(line[::-1], step)[::-1], line])
        return line, np.array([self._wall.distance(point) for point in line])

    def _to_wall(self, line: np.ndarray, step: float) -> np.ndarray:
        """Go from the end of a line straight on to the wall of a blind end."""
        back = line[-1] - line[max(0, len(line) - 6)]
        direction = back / max(np.linalg.norm(back), 1e-300)
        # Sphere tracing: the distance from the wall is free to go. One radius on is the wall of a round end.
        end, most = line[-1], 2.0 * self._wall.distance(line[-1])
        for _ in range(60):
            free = 0.99 * self._wall.distance(end)
            end = end + free * direction
            if free < 1e-3 * step or np.linalg.norm(end - line[-1]) > most:
                break
        gap = float(np.linalg.norm(end - line[-1]))
        count = max(1, int(round(gap / step)))
        return line[-1] + np.linspace(0.0, 1.0, count + 1)[1:, None] * (end - line[-1])

    def _widest_after(self, point: int) -> int:
        """Find, of the points after one, away from the root, that beyond which there is most of the vessel, its radii
        summed along the tree; -1 at an end."""
        after = np.flatnonzero(np.asarray(self._parents) == point)
        if len(after) < 2:
            return int(after[0]) if len(after) else -1
        beyond = np.array(self._radii, dtype=float)
        for k in range(len(beyond) - 1, 0, -1):  # parents come first
            beyond[self._parents[k]] += beyond[k]
        return int(after[np.argmax(beyond[after])])

    def _end(self, k: int, point: int) -> End:
        """Return an end, not numbered yet; a closed one without a name."""
        rim = self._rims[k]
        points, parents = self._points, self._parents
        path = [point]
        reach = 0.0
        radius = rim.radius if rim else 0.0
        # The direction is that of the centreline over the first radius, or two where the sphere grows on; at branchings
        # into most of the vessel.
        while reach < 2.0 * max(radius, self._radii[path[-1]]):
            after = parents[path[-1]] if point != 0 else self._widest_after(path[-1])
            if after < 0:
                break
            reach += float(np.linalg.norm(points[after] - points[path[-1]]))
            path.append(after)
        if rim is None:
            radius = max(self._radii[i] for i in path)
        direction = self._into_lumen(path, radius)
        if direction is None:
            direction = rim.normal
        return End(0, rim.name if rim else "", points[point], radius, direction, rim is not None, point,
                   rim is None and self._is_sac(point))

    def _is_sac(self, point: int) -> bool:
        """Return whether a closed end is a dome: behind its widest place, and near it, there is a much narrower
        neck."""
        path, arc = [point], [0.0]
        widest = 0.0
        while len(path) < 2 or arc[-1] < _SAC * widest:
            after = self._parents[path[-1]] if point != 0 else self._widest_after(path[-1])
            if after < 0:
                break
            arc.append(arc[-1] + float(np.linalg.norm(self._points[after] - self._points[path[-1]])))
            path.append(after)
            # The parent vessel may be wider than the sac: it begins behind the neck.
            radii = np.array([self._radii[k] for k in path])
            neck = radii[radii[:-1].argmax():].min()
            if len(path) > 2 and neck < _NECK * radii[:-1].max() and radii[-1] > _WIDER * neck:
                return True
            widest = max(widest, self._radii[after])
        return False

    def _into_lumen(self, path: list[int], radius: float) -> np.ndarray | None:
        """Direction of a path's chord from its first point; None where it has no length. Where the place one radius
        along the longest chord is in no inscribed sphere of the path (a bend), the chord with the most clearance
        there."""
        points, radii = np.array([self._points[k] for k in path]), np.array([self._radii[k] for k in path])
        chords = points[1:] - points[0]
        sizes = np.linalg.norm(chords, axis=1)
        chords = chords[sizes > 0.0] / sizes[sizes > 0.0, None]
        if not len(chords):
            return None
        places = points[0] + radius * chords
        clearance = (radii - np.linalg.norm(places[:, None] - points, axis=2)).max(axis=1)
        return chords[-1] if clearance[-1] > 0.0 else chords[int(np.argmax(clearance))]


def _filtered(line: np.ndarray) -> np.ndarray:
    """Return a line smoothed along itself, its ends kept."""
    if len(line) < 5:
        return line
    # Reflected through its ends, so that a line keeps its direction there.
    pad = min(len(line) - 1, 8)
    before, after = 2.0 * line[0] - line[pad:0:-1], 2.0 * line[-1] - line[-2:-pad - 2:-1]
    smooth = gaussian_filter1d(np.concatenate([before, line, after]), _SMOOTHING, axis=0)[pad:-pad]
    smooth[0], smooth[-1] = line[0], line[-1]
    return smooth
