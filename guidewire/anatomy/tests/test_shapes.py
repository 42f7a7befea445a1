"""Vessels made by code, and their centrelines."""

from __future__ import annotations

import os

import numpy as np
import pytest
from scipy.spatial import ConvexHull, Delaunay, cKDTree

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.centreline import find_centreline  # noqa: E402
from guidewire.anatomy.inspection import inspect  # noqa: E402
from guidewire.anatomy.medial_graph import WallDistance  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError, Edges, close_rims, find_rims  # noqa: E402
from guidewire.anatomy.shapes import _carina, _spline, make, name_of, tubes_of  # noqa: E402
from guidewire.anatomy.tests.solids import SLANT, frame, tube  # noqa: E402
from guidewire.anatomy.tubes import Tube, _Field, _union, mesh_of_tubes  # noqa: E402
from tools.seeds import of_the_day  # noqa: E402

FULL = os.environ.get("GUIDEWIRE_ALL") == "1"
MADE = [("arch", 1, 1), ("siphon", 1, 1), ("arch", 2, 7), ("siphon", 1, 2), ("arch", 3, 1), ("siphon", 1, 3),
        ("iliac", 1, 1), ("coronary", 1, 1)]    # two a day

# A bent stem and two bent arms of different radius.
FORK = [Tube(_spline([[0.0, 0.0, -26.0], [2.0, 0.0, -13.0], [0.0, 0.0, 0.0]]), np.linspace(4.0, 3.5, 40),
             ends=(True, False)),
        Tube(_spline([[0.0, 0.0, 0.0], [8.0, 2.0, 14.0], [10.0, 2.0, 22.0]]), np.linspace(3.0, 2.6, 40), 0),
        Tube(_spline([[0.0, 0.0, 0.0], [-9.0, 0.0, 12.0], [-16.0, 2.0, 16.0]]), np.full(40, 2.5), 0)]


@pytest.fixture(scope="module")
def fork():
    return mesh_of_tubes(FORK, 0.5)


def test_tubes_make_a_vessel_with_an_open_rim_at_each_end(fork) -> None:
    found = inspect(fork)
    assert not (len(found.crowded) or len(found.crossings) or len(found.turned)) and len(found.body_sizes) == 1
    assert found.volume < 0.0 and not any(rim.is_hole for rim in found.rims)
    assert [rim.radius for rim in found.rims] == pytest.approx([4.0, 2.6, 2.5], rel=0.02)


def test_tubes_out_of_reach_change_no_distance_near_the_wall(fork) -> None:
    fields = [_Field(tube) for tube in FORK]
    points = fork.vertices + np.random.default_rng(2).uniform(-0.4, 0.4, fork.vertices.shape)
    for near, far in zip(_union(fields, FORK, 0.5, points, 0.8), _union(fields, FORK, 0.5, points, 1e3)):
        np.testing.assert_array_equal(near, far)
        assert np.abs(far).max() < 0.8


def test_the_ends_of_an_arch_have_names() -> None:
    tubes, _ = tubes_of("arch", 2, 2)
    assert name_of("arch", tubes, tubes[0].points[-1]) == "descending aorta"
    # The trunk divides: its branch towards the head is the right carotid, that of the arch the left one.
    assert name_of("arch", tubes, tubes[5].points[-1]) == "right common carotid"
    assert name_of("arch", tubes, tubes[2].points[-1]) == "left common carotid"
    assert tubes[5].points[-1][0] < tubes[2].points[-1][0] < tubes[3].points[-1][0]
    assert name_of("iliac", tubes, tubes[0].points[-1]) == ""


def test_the_centreline_lies_on_the_tubes_axes(fork) -> None:
    line = find_centreline(fork, find_rims(fork, Edges.of(fork)))
    assert len(line.ends) == 3 and len(np.unique(line.branches)) == 3
    _check_line(FORK, line)


@pytest.mark.parametrize("from_z, ends", [(15.0, 3), (-1.0, 2)])
@pytest.mark.few(1)
def test_a_blind_branch_ends_where_its_path_leaves_the_lumen(fork, monkeypatch: pytest.MonkeyPatch, from_z: float,
                                                             ends: int) -> None:
    """Through a coarse wall a path may go on outside. In the shorter arm that is so here from a height on: at its tip,
    or all along it."""
    rims = find_rims(fork, Edges.of(fork))
    open_ends = sorted(rims, key=lambda rim: rim.centre[0])[1:]
    closed = close_rims(fork, [rim for rim in rims if rim not in open_ends])
    monkeypatch.setattr(WallDistance, "inside",
                        lambda wall, points: (points[:, 0] > -1.0) | (points[:, 2] < from_z))
    line = find_centreline(closed, find_rims(closed, Edges.of(closed)))
    assert len(line.ends) == ends
    if ends == 3:
        (tip,) = (end for end in line.ends if not end.is_open)
        assert np.linalg.norm(tip.centre - FORK[2].points[-1]) < 2.0 * FORK[2].radii[-1]


def test_points_inside_a_closed_wall_are_told_from_points_beside_it() -> None:
    wall = tube(3.0, 40.0)
    closed = WallDistance(close_rims(wall, find_rims(wall, Edges.of(wall))))
    u, _, axis = frame(SLANT)
    on_axis = np.linspace(1.0, 39.0, 20)[:, None] * axis
    assert closed.inside(on_axis + 2.8 * u).all() and not closed.inside(on_axis + 3.1 * u).any()
    assert not closed.inside(np.array([-0.5, 40.5])[:, None] * axis).any()


@pytest.mark.skipif(not FULL, reason="the fork's centreline is tested in either case")
@pytest.mark.parametrize("kind, number, seed", [MADE[k] for k in (of_the_day(2, len(MADE)) if FULL else (0,))])
def test_the_centreline_of_a_made_vessel_lies_on_its_axes(kind: str, number: int, seed: int) -> None:
    mesh, _, _ = make(kind, number, seed, None, None)
    _check_line(tubes_of(kind, number, seed)[0], find_centreline(mesh, find_rims(mesh, Edges.of(mesh))))


@pytest.mark.parametrize("kind, number", [("arch", 1), ("arch", 2), ("arch", 3), ("iliac", 1), ("siphon", 1),
                                          ("coronary", 1)])
@pytest.mark.few(1)
def test_branches_that_have_parted_are_not_joined_again(kind: str, number: int) -> None:
    """A ball of the edges' radius that touches two walls joins their lumens, so nearer walls are drawn anew."""
    for seed in range(1, 31):
        tubes, _ = tubes_of(kind, number, seed)
        for k, tube in enumerate(tubes):
            for other in tubes[:k]:
                away = np.linalg.norm(tube.points[:, None] - other.points, axis=2) - other.radii
                gap = away.min(axis=1) - tube.radii
                parted = np.flatnonzero(gap > 2.5 * _carina(tubes))
                assert not len(parted) or gap[parted[0]:].min() > 1.9 * _carina(tubes), (seed, k)


def _check_line(tubes: list[Tube], line) -> None:
    """Place within a tenth of the radius, radius within a twentieth, over 95 % of what is two radii from branchings."""
    tree = cKDTree(line.points)
    off, wrong = [], []
    for tube in tubes:
        far = np.ones(len(tube.points), bool)
        for branch in tubes:
            if branch.parent >= 0:
                parent = tubes[branch.parent]
                origin = branch.points[0]
                radius = parent.radii[np.argmin(np.linalg.norm(parent.points - origin, axis=1))]
                far &= np.linalg.norm(tube.points - origin, axis=1) > 2.0 * max(radius, branch.radii[0])
        away, nearest = tree.query(tube.points[far])
        step = 0.13 * tube.radii[far]  # half of that of the centreline's points
        off += list(np.sqrt(np.maximum(away**2 - step**2, 0.0)) / tube.radii[far])
        wrong += list(np.abs(line.radii[nearest] / tube.radii[far] - 1.0))
    assert len(off) > 60
    assert np.mean(np.array(off) < 0.10) >= 0.95
    assert np.mean(np.array(wrong) < 0.05) >= 0.95


def test_the_same_seed_gives_the_same_mesh_and_another_one_another() -> None:
    first, again, other = (tubes_of("coronary", 1, seed)[0] for seed in (3, 3, 4))
    assert all(np.array_equal(a.points, b.points) for a, b in zip(first, again))
    assert not np.array_equal(first[0].points, other[0].points)
    one, same = (mesh_of_tubes([first[0]], 1.0) for _ in range(2))
    assert np.array_equal(one.vertices, same.vertices)


@pytest.mark.parametrize("number", [1, 2, 3])
@pytest.mark.few(1)
def test_the_type_of_an_arch_is_the_drop_of_its_first_branch(number: int) -> None:
    for seed in range(20):
        tubes, _ = tubes_of("arch", number, seed)
        arch, carotid = tubes[0], tubes[2].radii[0]
        # The outer curve: from the centreline outwards, across it and in the plane of the arch.
        along = np.gradient(arch.points, axis=0)
        outward = np.stack([-along[:, 2], np.zeros(len(along)), along[:, 0]], axis=1)
        curve = arch.points[:, 2] + arch.radii * outward[:, 2] / np.linalg.norm(outward, axis=1)
        at = np.argmin(np.linalg.norm(arch.points - tubes[1].points[0], axis=1))
        drop = (curve.max() - curve[at]) / (2.0 * carotid)
        # The trunk's origin lies up to half a step of the arch's points from the nearest one.
        assert number - 1.0 < drop < number, (seed, drop)


@pytest.mark.parametrize("angle, carina", [
    pytest.param(40.0, 0.4, marks=pytest.mark.long("a blunter edge at a wider angle")), (90.0, 0.8)])
@pytest.mark.few(1)
def test_the_edge_between_branches_has_the_stated_radius_of_curvature(angle: float, carina: float) -> None:
    half = np.radians(0.5 * angle)
    arms = [Tube(np.linspace([0.0, 0.0, 0.0], [15.0 * np.sin(s * half), 0.0, 15.0 * np.cos(half)], 20),
                 np.full(20, 2.0), 0) for s in (-1.0, 1.0)]
    stem = Tube(np.linspace([0.0, 0.0, -10.0], [0.0, 0.0, 0.0], 20), np.full(20, 2.0), ends=(True, False))
    mesh = mesh_of_tubes([stem, *arms], carina)
    # In the plane of the axes the walls are straight lines, their distance from the axes 2: the ball between them.
    near = mesh.vertices[(np.abs(mesh.vertices[:, 1]) < 0.35)]
    apex = 2.0 / np.sin(half)  # where the two lines meet
    centre = np.array([0.0, 0.0, apex + carina / np.sin(half)])
    touching = near[(np.abs(near[:, 0]) < 0.7 * carina * np.cos(half)) & (near[:, 2] > 0.0) & (near[:, 2] < centre[2])]
    assert len(touching) > 3
    away = np.hypot(touching[:, 0], touching[:, 2] - centre[2])
    # Off the plane the walls recede by y^2/4 at most.
    assert np.abs(away - carina).max() < 0.06 * carina + 0.35**2 / 4.0 / np.sin(half)


@pytest.mark.parametrize("stenosis, aneurysm, tube", [(0.4, None, 2), (None, 1.8, 0)])
def test_stenosis_and_aneurysm_have_the_diameter_asked_for(stenosis, aneurysm, tube) -> None:
    from guidewire.anatomy.shapes import _changed

    tubes, places = tubes_of("iliac", 1, 1)
    factor = stenosis or aneurysm
    own, place = places[0 if stenosis else 1]
    changed = _changed(tubes[own], place, factor)
    ratio = changed.radii / tubes[own].radii
    assert own == tube and (ratio.min() if factor < 1.0 else ratio.max()) == pytest.approx(factor, rel=0.02)
    assert ratio[0] == pytest.approx(1.0) and ratio[-1] == pytest.approx(1.0)


@pytest.mark.parametrize("kind, number, stenosis, aneurysm, expected", [
    ("arch", 4, None, None, "type 1, 2 or 3"), ("iliac", 1, 1.5, None, "below 1"), ("iliac", 1, None, 0.5, "above 1"),
])
def test_what_is_not_made_is_one_line(kind, number, stenosis, aneurysm, expected) -> None:
    with pytest.raises(AnatomyError, match=expected):
        make(kind, number, 1, stenosis, aneurysm)


def test_points_too_regular_for_exact_merging_are_displaced_by_rounding(monkeypatch: pytest.MonkeyPatch) -> None:
    from guidewire.anatomy import medial_graph

    asked = []

    def fails_once(points, qhull_options=None):
        asked.append(qhull_options)
        if qhull_options is None:
            raise medial_graph.QhullError("QH6271: a wide merge error")
        return Delaunay(points, qhull_options=qhull_options)

    points = np.random.default_rng(1).uniform(size=(40, 3))
    monkeypatch.setattr(medial_graph, "Delaunay", fails_once)
    found = medial_graph._tetrahedra(points)
    assert asked == [None, "Qbb Qc QJ"]
    corners = points[found.simplices]
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])).sum() / 6.0
    assert volume == pytest.approx(ConvexHull(points).volume, rel=1e-6)
    with pytest.raises(AnatomyError, match="in one plane"):
        medial_graph._tetrahedra(points[:3])
