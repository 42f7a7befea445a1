"""Inspection of a mesh: rims, bodies, size, unit, orientation, and every defect with its position."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from guidewire.anatomy.intersections import self_intersections
from guidewire.anatomy.mesh import AnatomyError, Edges, Mesh, Rim, find_bodies, find_rims, signed_volume, turned_alike

UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
# What is known of vessels: radii, m, a range within which one is as likely as another; and of the largest side over the
# radius the median against the logarithm of the radius, which falls from a coronary artery with its branches to an
# aorta. Deviations are of logarithms.
_RADIUS, _BEYOND = (0.7e-3, 14e-3), 0.25
_SLENDER, _SPREAD = ((1e-3, 3e-3, 6e-3, 12e-3), (40.0, 33.0, 25.0, 17.0)), 0.65
_LONGEST = 0.8  # m, a side of a body
_EDGE, _EDGE_SPREAD = 0.7e-3, 1.5  # m, of the median edge, which comes from voxels of some tenths of a mm to one
_STRANGE = 0.0015  # of the largest density, that of a vessel unlike all that is known: no size alone excludes a unit
_FILES = {"mm": 0.82, "cm": 0.13, "m": 0.05}  # fraction of files in a unit, where nothing else is known
_CERTAIN = 0.97  # of the probability, from which on a unit is taken without being given
_NEVER = 3.0  # ranges' deviations of the radius: no vessel
_WELD = 1e-3  # of the median edge: vertices so near are one
_SIDES = 5  # of a rim; a gap of fewer is one triangle that is missing, or two
_HOLE = 2.5  # a lumen so many times wider than its rim: the rim is a hole in its side
_RAYS = 1500  # sampled for the double wall
_FACING = 0.3  # of them, that meet the wall from outside: the lumen is outside


@dataclass(frozen=True)
class Unit:
    """name : of UNITS; reason : one line; is_sure : whether it is known, or certain from the sizes."""

    name: str
    reason: str
    is_sure: bool

    @property
    def metres(self) -> float:
        """Return its length, m."""
        return UNITS[self.name]


@dataclass
class Inspection:
    """What was found; places are (k, 3) in the file's units.

    near_vertices : pairs nearer than weld_length that are not one vertex; slivers : triangles without area, or with two
    corners in one; crowded : middles of edges of more than two triangles; turned : edges whose two triangles are
    oriented against each other; crossings : where the mesh passes through itself; body_sizes : triangles of each body;
    volume : signed, positive with normals outward; double_wall : fraction of rays out of the wall that meet it again.
    """

    vertices: int
    triangles: int
    low: np.ndarray
    high: np.ndarray
    unit: Unit
    weld_length: float
    near_vertices: int
    slivers: np.ndarray
    crowded: np.ndarray
    turned: np.ndarray
    crossings: np.ndarray
    body_sizes: list[int]
    body_centres: np.ndarray
    rims: list[Rim]
    volume: float
    double_wall: float
    notes: list[str] = field(default_factory=list)

    @property
    def has_double_wall(self) -> bool:
        """Whether the lumen lies outside of the surface."""
        return self.double_wall > _FACING

    @property
    def is_vessel(self) -> bool:
        """Whether the program takes the mesh as it is, its rims named."""
        return not (self.near_vertices or len(self.slivers) or len(self.crowded) or len(self.crossings)
                    or len(self.body_sizes) > 1 or self.has_double_wall or any(rim.is_hole for rim in self.rims))


def weld_exactly(mesh: Mesh) -> Mesh:
    """Vertices with the same coordinates made one."""
    # Sorting one column of bytes is many times as fast as three of numbers.
    rows = np.ascontiguousarray(mesh.vertices + 0.0).view(np.dtype((np.void, 24))).ravel()
    _, first, inverse = np.unique(rows, return_index=True, return_inverse=True)
    return Mesh(mesh.vertices[first], inverse[mesh.triangles])


def weld(mesh: Mesh, length: float) -> tuple[Mesh, int, float]:
    """Vertices nearer than a length made one, at their mean. Returns the mesh, how many are fewer, and how far the
    farthest moved."""
    pairs = cKDTree(mesh.vertices).query_pairs(length, output_type="ndarray")
    if not len(pairs):
        return mesh, 0, 0.0
    n = len(mesh.vertices)
    count, labels = connected_components(coo_matrix((np.ones(len(pairs)), pairs.T), shape=(n, n)), directed=False)
    sizes = np.bincount(labels)
    means = np.stack([np.bincount(labels, mesh.vertices[:, k]) / sizes for k in range(3)], axis=1)
    moved = np.linalg.norm(means[labels] - mesh.vertices, axis=1).max()
    return Mesh(means, labels[mesh.triangles]), n - count, float(moved)


def weld_length_of(mesh: Mesh) -> float:
    """Return the length below which vertices of a mesh are one: a thousandth of its median edge."""
    lengths = mesh.edge_lengths()
    return _WELD * float(np.median(lengths[lengths > 0.0])) if (lengths > 0.0).any() else 0.0


def without_slivers(mesh: Mesh) -> tuple[Mesh, np.ndarray]:
    """Return the mesh without triangles of two equal corners, and repeated ones; and the places of these."""
    ordered = np.sort(mesh.triangles, axis=1)
    flat = (ordered[:, 0] == ordered[:, 1]) | (ordered[:, 1] == ordered[:, 2])
    _, first = np.unique(ordered, axis=0, return_index=True)
    kept = np.zeros(len(ordered), dtype=bool)
    kept[first] = True
    kept &= ~flat
    return mesh.part(kept), mesh.corners[~kept].mean(axis=1)


def without_fins(mesh: Mesh) -> tuple[Mesh, np.ndarray]:
    """Return the mesh without triangles that stand on an edge of more than two triangles and end in the open, and the
    middles (k, 3) of those. Of such triangles those with two open edges go first: one with a single open edge may be
    the wall's own, at a rim."""
    places = np.empty((0, 3))
    while True:
        edges = Edges.of(mesh)
        at_edges = edges.counts[edges.of_triangles]
        opened = np.where((at_edges > 2).any(axis=1), (at_edges == 1).sum(axis=1), 0)
        fin = opened == 2 if (opened == 2).any() else opened == 1
        if not fin.any():
            return mesh, places
        places = np.vstack([places, mesh.corners[fin].mean(axis=1)])
        mesh = mesh.part(~fin)


def inspect(mesh: Mesh, unit: str | None = None, said_by: str = "as given") -> Inspection:
    """Return all that can be said of a mesh as a file has it.

    Parameters
    ----------
    unit : where it is known, and not guessed.
    said_by : who says it.

    Raises
    ------
    AnatomyError : it has no triangle with an area.
    """
    raw = weld_exactly(mesh)
    length = weld_length_of(raw)
    welded, near, _ = weld(raw, length)
    clean, slivers = without_slivers(welded)
    if not len(clean.triangles):
        raise AnatomyError("no triangle has three different corners")
    edges = Edges.of(clean)
    clean, _ = turned_alike(clean)  # rims and volumes are those of triangles that agree
    bodies = find_bodies(clean)
    main = clean.part(bodies == 0)
    plain, _ = without_fins(clean)  # a fin has no rim of a lumen
    rims = sort_rims(plain, find_rims(plain, Edges.of(plain)))
    crossings, _ = self_intersections(clean)
    same = edges.forward.ravel()[edges.halves()]
    turned = edges.ends[edges.counts == 2][same[:, 0] == same[:, 1]]
    return Inspection(
        vertices=len(raw.vertices), triangles=len(mesh.triangles), low=raw.vertices.min(axis=0),
        high=raw.vertices.max(axis=0), unit=find_unit(clean, unit, said_by), weld_length=length, near_vertices=near,
        slivers=slivers, crowded=clean.vertices[edges.ends[edges.counts > 2]].mean(axis=1),
        turned=clean.vertices[turned].mean(axis=1), crossings=crossings,
        body_sizes=np.bincount(bodies).tolist(),
        body_centres=np.array([clean.part(bodies == k).vertices.mean(axis=0) for k in range(bodies.max() + 1)]),
        rims=rims, volume=signed_volume(main, find_rims(main, Edges.of(main))), double_wall=float(facing(main).mean()),
    )


def sort_rims(mesh: Mesh, rims: list[Rim]) -> list[Rim]:
    """The rims with holes told from ends: around a hole the lumen is much wider than the rim."""
    from guidewire.anatomy.surfaces import distances

    steps = np.array([1.0, 2.0, 3.0])
    points = [rim.centre + max(rim.radius, 1e-12) * steps[:, None] * rim.normal for rim in rims]
    found = []
    for rim, wide in zip(rims, distances(np.concatenate(points), mesh).reshape(-1, 3) if rims else ()):
        # The distance from the rim's own plane bounds the first ones; a lumen as wide as the rim gives its radius.
        is_hole = len(rim.vertices) < _SIDES or bool((wide > _HOLE * rim.radius).any())
        found.append(Rim(rim.number, rim.centre, rim.radius, rim.normal, rim.vertices, is_hole))
    ends = [rim for rim in found if not rim.is_hole] + [rim for rim in found if rim.is_hole]
    return [Rim(number, rim.centre, rim.radius, rim.normal, rim.vertices, rim.is_hole)
            for number, rim in enumerate(ends, 1)]


def find_unit(mesh: Mesh, known: str | None = None, said_by: str = "as given") -> Unit:
    """Return the unit of a file's numbers: the one that is known, or else the most likely one, from the radii, lengths
    and edges that vessels and their files have. Where it is not certain, the reason asks for it."""
    radius, side = typical_radius(mesh), float(np.ptp(mesh.vertices, axis=0).max())
    if known:
        return Unit(known, f"{said_by}; {_sizes(known, radius, side)}", True)
    edge = float(np.median(mesh.edge_lengths()))
    likely = {name: _FILES[name] * _likelihood(metres * radius, metres * side, metres * edge)
              for name, metres in UNITS.items()}
    best = max(likely, key=likely.get)
    probability = min(likely[best] / max(sum(likely.values()), 1e-300), 0.999)
    if probability >= _CERTAIN:
        return Unit(best, f"guessed, {probability:.1%} likely; {_sizes(best, radius, side)}", True)
    listed = "; or ".join(f"--unit {name}, {_sizes(name, radius, side)}" for name in sorted(
        likely, key=likely.get, reverse=True)[:2])
    return Unit(best, f"not certain from the sizes: give {listed}", False)


def _sizes(unit: str, radius: float, side: float) -> str:
    return (f"the lumen's median radius is then {1e3 * UNITS[unit] * radius:.3g} mm and the vessel "
            f"{1e3 * UNITS[unit] * side:.4g} mm long")


def _likelihood(radius: float, side: float, edge: float) -> float:
    """Return how likely the sizes of a vessel, m, are, over the most likely ones."""
    out = _out_of(radius, *_RADIUS) / _BEYOND
    slender = np.log(side / radius / np.interp(np.log(radius), np.log(_SLENDER[0]), _SLENDER[1])) / _SPREAD
    long = _out_of(side, 0.0, _LONGEST) / _BEYOND
    fine = np.log(max(edge, 1e-300) / _EDGE) / _EDGE_SPREAD
    known = np.exp(-0.5 * (out**2 + slender**2 + long**2 + fine**2))
    return float(known + _STRANGE * np.exp(-0.5 * (np.maximum(out - _NEVER, 0.0)**2 + long**2)))


def _out_of(size: float, low: float, high: float) -> float:
    """Return the logarithm by which a size is out of a range."""
    return max(np.log(max(low, 1e-300) / max(size, 1e-300)), np.log(max(size, 1e-300) / high), 0.0)


def typical_radius(mesh: Mesh) -> float:
    """Median of half the distance from the wall to the wall opposite, over a sample of its triangles."""
    across = _meetings(mesh, inward=signed_volume(mesh) > 0.0)
    across = across[np.isfinite(across)]
    return 0.5 * float(np.median(across)) if len(across) else 0.1 * float(np.ptp(mesh.vertices, axis=0).max())


def narrow_radius(mesh: Mesh) -> float:
    """Return half the distance to the wall opposite below which a tenth of the sampled triangles are."""
    across = _meetings(mesh, inward=signed_volume(mesh) > 0.0)
    across = across[np.isfinite(across)]
    return 0.5 * float(np.quantile(across, 0.1)) if len(across) else typical_radius(mesh)


def facing(mesh: Mesh) -> np.ndarray:
    """(k,) for sampled triangles: whether a ray out of the surface meets it again as a lumen's wall would.

    Out of an outer wall rays leave for good, or meet a neighbouring vessel; in a double wall half of the surface is the
    lumen's, and there they meet the wall opposite, with a thin wall behind their start.
    """
    outward = signed_volume(mesh) > 0.0
    out, into = _meetings(mesh, inward=not outward), _meetings(mesh, inward=outward)
    return np.isfinite(out) & np.isfinite(into) & (into < 0.7 * out)


def cast_rays(mesh: Mesh, chosen: np.ndarray, directions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return (k,): how far rays go from the middles of chosen triangles until they meet the mesh, infinite if they do
    not; and (k,): the triangle there, or -1."""
    from vtkmodules.vtkCommonCore import mutable
    from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator

    from guidewire.anatomy.surfaces import to_vtk

    locator = vtkStaticCellLocator()
    data = to_vtk(mesh)
    locator.SetDataSet(data)
    locator.BuildLocator()
    far, skip = 2.0 * mesh.diagonal, 1e-6 * mesh.diagonal
    starts = mesh.corners[chosen].mean(axis=1)
    lengths, met = np.full(len(chosen), np.inf), np.full(len(chosen), -1)
    part, sub, number, cell = mutable(0.0), mutable(0), mutable(0), vtkGenericCell()
    point, inner = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    for k, (start, direction) in enumerate(zip(starts, directions)):
        if locator.IntersectWithLine(start + skip * direction, start + far * direction, 1e-9 * far, part, point, inner,
                                     sub, number, cell):
            lengths[k] = np.linalg.norm(np.array(point) - start)
            met[k] = int(number)
    return lengths, met


def _meetings(mesh: Mesh, inward: bool) -> np.ndarray:
    areas = mesh.area_vectors()
    size = np.linalg.norm(areas, axis=1)
    # Evenly over the surface: every so much area one ray.
    ladder = np.cumsum(size)
    chosen = np.searchsorted(ladder, (np.arange(_RAYS) + 0.5) / _RAYS * ladder[-1])
    chosen = np.unique(chosen[size[chosen] > 0.0])
    normals = areas[chosen] / size[chosen][:, None]
    return cast_rays(mesh, chosen, -normals if inward else normals)[0]
