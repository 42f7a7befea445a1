"""What is found in a mesh, and what is done about it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.distance_grid import remesh  # noqa: E402
from guidewire.anatomy.inspection import inspect  # noqa: E402
from guidewire.anatomy.mesh import (  # noqa: E402
    AnatomyError, Edges, Mesh, find_rims, one_sided_at, signed_volume, turned_alike,
)
from guidewire.anatomy.repair import repair, with_rims_apart  # noqa: E402
from guidewire.anatomy.surfaces import distances  # noqa: E402
from guidewire.anatomy.tests.solids import SLANT, double_walled, joined, tube  # noqa: E402

POLYGON = np.sqrt(24.0 / (2.0 * np.pi) * np.sin(2.0 * np.pi / 24.0))  # radius of the circle with a 24-gon's area


def soup(mesh: Mesh, jitter: float = 0.0) -> Mesh:
    """Every triangle with vertices of its own, moved a little."""
    corners = mesh.corners.reshape(-1, 3)
    moved = corners + jitter * np.random.default_rng(1).standard_normal(corners.shape)
    return Mesh(moved, np.arange(len(corners)).reshape(-1, 3))


def is_vessel(mesh: Mesh) -> bool:
    edges = Edges.of(mesh)
    rims = find_rims(mesh, edges)
    forward = np.bincount(edges.of_triangles.ravel(), edges.forward.ravel())
    return bool((edges.counts <= 2).all() and (forward[edges.counts == 2] == 1).all()
                and signed_volume(mesh, rims) < 0.0 and inspect(mesh).is_vessel)


def check(mesh: Mesh, said: str, radius: float = 3.0, ends: int = 2) -> None:
    repaired = repair(mesh)
    assert any(said in change.name and change.count > 0 for change in repaired.changes), repaired.changes
    assert is_vessel(repaired.mesh)
    assert [rim.radius for rim in repaired.rims] == pytest.approx([POLYGON * radius] * ends, rel=0.02)
    # What is left of the wall lies on it, up to what the repair says.
    assert distances(repaired.mesh.vertices, mesh).max() <= repaired.moved + 1e-9


def test_a_good_mesh_is_only_turned() -> None:
    names = [change.name for change in repair(tube()).changes]
    assert names == ["normals turned into the lumen"]
    assert repair(tube().turned()).changes == []


def test_rims_have_number_place_radius_and_normal() -> None:
    found = inspect(tube())
    assert [rim.number for rim in found.rims] == [1, 2] and not any(rim.is_hole for rim in found.rims)
    for rim in found.rims:
        at_start = np.linalg.norm(rim.centre) < 1e-9
        np.testing.assert_allclose(rim.centre, np.zeros(3) if at_start else 40.0 * SLANT, atol=1e-9)
        np.testing.assert_allclose(rim.normal, SLANT if at_start else -SLANT, atol=1e-9)
        assert rim.radius == pytest.approx(POLYGON * 3.0, rel=1e-9)


@pytest.mark.parametrize("unit, scale", [("mm", 1.0), ("cm", 0.1), ("m", 0.001)])
@pytest.mark.parametrize("radius, length", [(12.0, 400.0), (3.0, 150.0), (1.0, 80.0)])
def test_unit_is_guessed_from_sizes_or_asked_for(unit: str, scale: float, radius: float, length: float) -> None:
    guess = inspect(tube(scale * radius, scale * length, rings=60)).unit
    assert guess.name == unit if guess.is_sure else f"--unit {unit}" in guess.reason
    assert f"{radius:.3g} mm" in guess.reason.replace(f"{0.99 * radius:.3g}", f"{radius:.3g}")


def test_jitter_is_welded() -> None:
    check(soup(tube(), 1e-5), "welded")


def test_zero_edges_and_triangles_there_twice_go() -> None:
    mesh = tube()
    check(Mesh(mesh.vertices, np.concatenate([mesh.triangles, mesh.triangles[:3], [[0, 0, 1]]])), "without area")


def test_turned_triangles_are_turned_back() -> None:
    mesh = tube()
    triangles = mesh.triangles.copy()
    triangles[100:160] = triangles[100:160, ::-1]
    found = inspect(Mesh(mesh.vertices, triangles))
    assert len(found.turned) > 0
    check(Mesh(mesh.vertices, triangles), "turned to agree")


@pytest.mark.parametrize("turned", [slice(0, 1), slice(None, None, 3)])
def test_turned_triangles_at_a_rim_cost_nothing(turned: slice) -> None:
    good = tube()
    bad = Mesh(good.vertices, good.triangles.copy())
    bad.triangles[turned] = bad.triangles[turned][:, ::-1]
    repaired, found = repair(bad), inspect(bad)
    assert len(repaired.mesh.triangles) == len(good.triangles) and len(repaired.rims) == 2
    assert abs(found.volume) == pytest.approx(abs(inspect(good).volume)) and len(found.turned)


def test_a_band_of_one_side_is_found_and_stays_as_it_is() -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
    across = np.stack([np.cos(0.5 * turn) * np.cos(turn), np.cos(0.5 * turn) * np.sin(turn), np.sin(0.5 * turn)], 1)
    middle = 5.0 * np.stack([np.cos(turn), np.sin(turn), 0.0 * turn], 1)
    k = np.arange(40)
    after, twist = (k + 1) % 40, k == 39
    a, b = np.where(twist, after + 40, after), np.where(twist, after, after + 40)
    band = Mesh(np.concatenate([middle - across, middle + across]),
                np.concatenate([np.stack([k, a, b], 1), np.stack([k, b, k + 40], 1)]))
    place = one_sided_at(band)
    assert place is not None and np.linalg.norm(place) == pytest.approx(5.0, abs=1.1) and turned_alike(band)[1] == 0
    assert one_sided_at(tube()) is None


def test_an_edge_joins_bodies_and_a_vertex_does_not() -> None:
    wall = tube()
    flake = np.array([wall.vertices[250], *(1.1 * wall.vertices[250] + [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0]])])
    check(Mesh(np.concatenate([wall.vertices, flake]), np.concatenate(
        [wall.triangles, [np.arange(3) + len(wall.vertices)]])), "stray bodies")


def test_a_fin_is_cut_off_and_named_with_its_place() -> None:
    mesh = tube()
    edge = mesh.triangles[200][:2]
    out = 1.4 * (mesh.vertices[edge[0]] - (mesh.vertices[edge[0]] @ SLANT) * SLANT)
    tip = (mesh.vertices[edge[0]] @ SLANT) * SLANT + out
    finned = Mesh(np.vstack([mesh.vertices, tip]), np.vstack([mesh.triangles, [*edge, len(mesh.vertices)]]))
    found = inspect(finned)
    np.testing.assert_allclose(found.crowded, [mesh.vertices[edge].mean(axis=0)], atol=1e-9)
    check(finned, "fins")


def test_fins_on_many_edges_go_and_the_wall_stays_whole_up_to_its_rims() -> None:
    mesh = tube()
    edges = Edges.of(mesh)
    chosen = edges.ends[np.random.default_rng(3).choice(np.flatnonzero(edges.counts == 2), 300, replace=False)]
    tips = 1.2 * mesh.vertices[chosen].mean(axis=1)
    fins = np.column_stack([chosen, len(mesh.vertices) + np.arange(300)])
    finned = Mesh(np.vstack([mesh.vertices, tips]), np.vstack([mesh.triangles, fins]))
    found, repaired = inspect(finned), repair(finned)
    assert len(found.crowded) == 300 and len(found.rims) == 2
    assert len(repaired.mesh.triangles) == len(mesh.triangles)
    assert [change.count for change in repaired.changes if "fins" in change.name] == [300]


def test_a_stray_body_goes_and_a_large_one_is_refused() -> None:
    small = tube(0.2, 0.5, rings=2)
    check(joined(tube(), Mesh(small.vertices + 20.0, small.triangles)), "stray bodies")
    other = Mesh(tube().vertices + 30.0, tube().triangles)
    with pytest.raises(AnatomyError, match="2 separate surfaces; .* around"):
        repair(joined(tube(), other))


def test_a_hole_in_the_side_is_filled_and_ends_stay_open() -> None:
    mesh = tube(sides=48, rings=60)
    away = np.linalg.norm(mesh.corners.mean(axis=1) - mesh.corners[1500].mean(axis=0), axis=1)
    holed = mesh.part(away > 0.9)
    assert sum(rim.is_hole for rim in inspect(holed).rims) == 1
    repaired = repair(holed)
    assert [change.count for change in repaired.changes if "holes" in change.name] == [1]
    assert len(repaired.rims) == 2 and is_vessel(repaired.mesh)
    # The lid is flat, the wall was round: distance of the chord from the arc.
    assert 0.0 < distances(mesh.vertices, repaired.mesh).max() <= repaired.moved


def test_an_end_is_no_hole_where_triangles_are_longer_than_the_lumen_is_wide() -> None:
    mesh = tube(length=60.0, rings=2)
    assert [rim.is_hole for rim in inspect(mesh).rims] == [False, False]
    assert not repair(mesh).changes[:-1] and len(repair(mesh).rims) == 2


@pytest.mark.parametrize("missing", [[20], [20, 68]])
def test_a_missing_triangle_is_a_hole_though_it_is_as_wide_as_the_lumen(missing: list[int]) -> None:
    mesh = tube(sides=8, rings=6, length=30.0)
    holed = mesh.part(~np.isin(np.arange(len(mesh.triangles)), missing))
    assert [len(rim.vertices) for rim in inspect(holed).rims if rim.is_hole] == [2 + len(missing)]
    assert len(repair(holed).rims) == 2


def test_of_a_double_wall_the_inner_one_is_kept() -> None:
    phantom = double_walled()
    found = inspect(phantom)
    assert found.has_double_wall and not found.rims
    assert not inspect(tube()).has_double_wall
    check(phantom, "outer wall")


def test_an_inner_body_of_a_closed_outer_one_is_kept() -> None:
    from guidewire.anatomy.mesh import close_rims

    inner, outer = (close_rims(t, find_rims(t, Edges.of(t))) for t in (tube(3.0, 36.0), tube(4.0, 40.0)))
    repaired = repair(joined(outer, Mesh(inner.vertices + 2.0 * SLANT, inner.triangles)))
    assert abs(signed_volume(repaired.mesh)) == pytest.approx(abs(signed_volume(inner)), rel=1e-9)


def test_crossing_tubes_are_joined_by_a_remesh() -> None:
    from guidewire.anatomy.mesh import close_rims

    across = np.array([0.81, 0.3, 0.5]) / np.linalg.norm([0.81, 0.3, 0.5])
    side = tube(2.0, 15.0, across, rings=10)
    side = Mesh(side.vertices + 20.0 * SLANT, side.triangles)
    side = close_rims(side, find_rims(side, Edges.of(side)))
    main = tube()
    mesh = joined(main, side)
    assert len(inspect(mesh).crossings) > 10
    repaired = repair(mesh)
    assert any("signed distance" in change.name for change in repaired.changes)
    assert is_vessel(repaired.mesh)
    # The tip of the side tube is part of the lumen now, and the wall within the main tube is not.
    tip = 20.0 * SLANT + 15.0 * across
    assert distances(tip[None], repaired.mesh)[0] < 1.0
    assert distances((20.0 * SLANT)[None], repaired.mesh)[0] > 2.0


def kinked(sides: int = 36, rings: int = 60) -> Mesh:
    """A tube of radius 3 bent by 60 degrees about an axis 2 mm from its own: it crosses itself inside the bend."""
    mesh = tube(axis=np.array([0.0, 0.0, 1.0]), sides=sides, rings=rings)
    x, y, z = mesh.vertices.T
    bend = 2.0  # mm, radius of the axis
    past = z - 20.0
    angle = np.clip(past / bend, 0.0, np.pi / 3.0)
    beyond = past - bend * angle
    turned = np.stack([bend - (bend - x) * np.cos(angle) + beyond * np.sin(angle), y,
                       (bend - x) * np.sin(angle) + beyond * np.cos(angle)], axis=1)
    return Mesh(turned, mesh.triangles)


def test_a_gash_where_crossing_triangles_were_is_no_end() -> None:
    assert len(inspect(kinked()).crossings) > 10
    repaired = repair(kinked())
    assert [rim.radius for rim in repaired.rims] == pytest.approx([3.0] * 2, rel=0.02) and is_vessel(repaired.mesh)


def test_a_rim_that_touches_itself_is_cut_back_to_where_it_does_not() -> None:
    mesh = tube()
    on_rim = (mesh.triangles < 24).sum(axis=1)
    one = int(np.flatnonzero(on_rim == 1)[0])  # a corner on the rim, the edge opposite inside
    pinched = mesh.part(np.arange(len(mesh.triangles)) != one)
    edges = Edges.of(pinched)
    triangle, k = np.argwhere(edges.counts[edges.of_triangles] == 1).T
    assert np.bincount(pinched.triangles[triangle, k]).max() == 2
    parted, places = with_rims_apart(pinched)
    edges = Edges.of(parted)
    triangle, k = np.argwhere(edges.counts[edges.of_triangles] == 1).T
    assert np.bincount(parted.triangles[triangle, k]).max() == 1 and len(find_rims(parted, edges)) == 2
    assert places == pytest.approx(mesh.vertices[mesh.triangles[one][mesh.triangles[one] < 24]])
    assert len(with_rims_apart(mesh)[0].triangles) == len(mesh.triangles)


def test_a_remeshed_wall_is_open_where_it_was_at_a_rim_out_of_a_plane_too() -> None:
    mesh = tube(rings=40)
    along = mesh.vertices @ SLANT
    side = mesh.vertices - along[:, None] * SLANT
    across = side @ np.linalg.svd(SLANT[None])[2][1] / 3.0
    # The last 5 mm are bent into a saddle of 2 mm to either side.
    part = np.clip((along - 35.0) / 5.0, 0.0, 1.0)
    mesh = Mesh(mesh.vertices + (part * (4.0 * across**2 - 2.0))[:, None] * SLANT, mesh.triangles)
    rims = find_rims(mesh, Edges.of(mesh))
    made, _ = remesh(mesh, rims, 0.5)
    found = find_rims(made, Edges.of(made))
    assert len(found) == 2
    for rim in found:
        before = min(rims, key=lambda one: np.linalg.norm(one.centre - rim.centre))
        assert abs(rim.radius / before.radius - 1.0) < 0.1
        away, _ = cKDTree(mesh.vertices[before.vertices]).query(made.vertices[rim.vertices])
        assert away.max() < 1.0  # mm: corners of the rim are 0.8 apart, a plane cuts 2.4 away


@pytest.mark.long("crossing tubes are joined, and crossing walls named in the tests of double walls")
def test_one_crossing_is_mended_in_its_place_and_the_wall_elsewhere_stays() -> None:
    """The kinked tube in many triangles: more than are taken out one by one. Elsewhere no vertex moves."""
    mesh = kinked(sides=80, rings=200)
    crossings = inspect(mesh).crossings
    repaired = repair(mesh)
    change = next(one for one in repaired.changes if "signed distance" in one.name)
    assert "there" in change.name and 0.0 < change.moved < 0.6 and is_vessel(repaired.mesh)
    away, _ = cKDTree(crossings).query(mesh.vertices)
    moved, _ = cKDTree(repaired.mesh.vertices).query(mesh.vertices)
    assert moved[away > 6.0].max() < 1e-9 and np.mean(moved < 1e-9) > 0.9
    assert distances(repaired.mesh.vertices, mesh).max() <= change.moved + 1e-9
    assert [rim.radius for rim in repaired.rims] == pytest.approx([3.0] * 2, rel=0.01)


@pytest.mark.long("crossing tubes are joined by a remesh")
def test_two_crossings_far_apart_are_mended_where_they_are() -> None:
    once = kinked(sides=80, rings=200)
    once = Mesh(once.vertices + [0.0, 0.0, 20.0], once.triangles)  # its inlet in z = 0
    twice = joined(once, Mesh(once.vertices * [-1.0, 1.0, -1.0], once.triangles))
    assert np.ptp(inspect(twice).crossings[:, 2]) > 30.0
    repaired = repair(twice)
    assert any("there" in one.name for one in repaired.changes) and is_vessel(repaired.mesh)
    assert [rim.radius for rim in repaired.rims] == pytest.approx([3.0] * 2, rel=0.01)
