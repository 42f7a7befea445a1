"""Loops, sacs, and ends that are opened."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.centreline import find_centreline  # noqa: E402
from guidewire.anatomy.ends import open_ends  # noqa: E402
from guidewire.anatomy.images import Image  # noqa: E402
from guidewire.anatomy.loops import count_loops, find_necks  # noqa: E402
from guidewire.anatomy.masks import mesh_of_image  # noqa: E402
from guidewire.anatomy.repair import repair  # noqa: E402

SIDE = 0.6


def vessel_of(*parts, size=(56, 24, 90), low=(-16.5, -7.0, -3.0)):
    """The repaired wall of capsules, each (start, end, radius), in voxels."""
    grid = SIDE * np.indices(size).transpose(1, 2, 3, 0) + low
    inside = np.zeros(size, dtype=bool)
    for start, end, radius in parts:
        start, end = np.array(start, float), np.array(end, float)
        part = np.clip((grid - start) @ (end - start) / max(np.sum((end - start) ** 2), 1e-9), 0.0, 1.0)
        inside |= np.linalg.norm(grid - start - part[..., None] * (end - start), axis=-1) < radius
    to_space = np.diag([SIDE, SIDE, SIDE, 1.0])
    to_space[:3, 3] = low
    return repair(mesh_of_image(Image(inside.astype(np.uint8), to_space)).mesh)


TRUNKS = ([0, 0, 0], [0, 0, 10], 2.2), ([0, 0, 38], [0, 0, 47], 2.2)
RING = [([0, 0, 10], [s * 9, 0, 19], 1.8) for s in (1, -1)] + [([s * 9, 0, 19], [s * 9, 0, 29], 1.8)
                                                               for s in (1, -1)] + [
    ([s * 9, 0, 29], [0, 0, 38], 1.8) for s in (1, -1)]


def test_a_branch_that_ends_beside_a_wide_vessel_is_an_end() -> None:
    """A hairpin of radius 4 and 8 whose legs are 28 mm apart; a branch of the first ends 1.2 mm before the second, less
    than its radius from its wall."""
    legs = [([-12, 0, 0], [-12, 0, 50], 4.0), ([-12, 0, 50], [16, 0, 55], 4.0), ([16, 0, 55], [16, 0, 10], 8.0)]
    repaired = vessel_of(*legs, ([-12, 0, 25], [5.3, 0, 25], 1.5), size=(84, 36, 120), low=(-22.0, -10.5, -6.0))
    ends = [end.centre for end in find_centreline(repaired.mesh, repaired.rims).ends]
    assert len(ends) == 3 and min(np.linalg.norm(end - [5.3, 0.0, 25.0]) for end in ends) < 2.0


@pytest.mark.long("the graph of a fork, and of a dome, which is no end either")
def test_a_ring_between_two_trunks_is_a_loop_and_no_end() -> None:
    repaired = vessel_of(*TRUNKS, *RING)
    assert count_loops(repaired.mesh) == 1
    line = find_centreline(repaired.mesh, repaired.rims)
    assert len(line.ends) == 2 and len(line.loops) == 1
    # On the axis, also where the ways meet; voxels of a third of the radius make the lumen some 15 % narrower.
    assert line.radii[line.narrowest] > 0.8 * 1.8
    assert sorted(round(float(end.centre[2]), -1) for end in line.ends) == [0.0, 50.0]
    # Both sides of the ring are in the graph: points of the line within a radius of the middles of both.
    for side in (9.0, -9.0):
        assert np.linalg.norm(line.points - [side, 0.0, 24.0], axis=1).min() < 1.8
    # Between the ends the path is one of both equal ways, and no longer than either.
    way = 2 * 10.0 + 2 * np.hypot(9.0, 9.0) + 10.0 + 5.0
    assert line.length(line.path(line.ends[0].point, line.ends[1].point)) == pytest.approx(way, rel=0.1)
    assert len(open_ends(repaired).rims) == 2


@pytest.mark.parametrize("shape, expected", [("X", 1), ("neck", 1), ("stenosis", 0), ("fork", 0)])
def test_a_neck_lies_between_two_vessels_that_pass(shape: str, expected: int) -> None:
    """Trees of points: two vessels of radius 2.5 that touch, by a neck of radius 1 or all in one place; one vessel with
    a stenosis; a fork."""
    arms = {"X": [(-1, 0, 0), (1, 0, 0), (0, -1, 0), (0, 1, 0)], "neck": [(-1, 0, 0), (1, 0, 0)],
            "stenosis": [(0, 0, -1)], "fork": [(0, 0, -1), (-1, 0, 1), (1, 0, 1)]}[shape]
    others = {"X": [], "neck": [(0, -1, 0), (0, 1, 0)], "stenosis": [(0, 0, 1)], "fork": []}[shape]
    points, radii, parents = [np.zeros(3)], [1.7 if shape == "X" else 3.0 if shape == "fork" else 2.5], [-1]

    def lay(parent: int, way: tuple, steps: int, radius: float) -> int:
        for _ in range(steps):
            points.append(points[parent] + 0.6 * np.array(way) / np.linalg.norm(way))
            radii.append(radius)
            parents.append(parent)
            parent = len(points) - 1
        return parent

    for way in arms:
        lay(0, way, 40, 2.5)
    if others:
        last = lay(lay(0, (0, 0, 1), 7, 1.0), (0, 0, 1), 1, 2.5)
        for way in others:
            lay(last, way, 40, 2.5)
    found = find_necks(np.array(points), np.array(radii), np.array(parents), [])
    assert len(found) == expected
    if shape == "neck":
        assert found[0].radius == 1.0 and 0.0 < found[0].place[2] < 4.8


@pytest.mark.long("necks, and ends of a fork, of which a crescent has two too")
def test_edges_of_a_crescent_are_no_ends() -> None:
    i, j, k = np.indices((50, 50, 70)) - np.array([24.5, 24.5, 34.5])[:, None, None, None]
    inside = (np.hypot(i, j) < 18.0) & (np.hypot(i - 7.0, j) > 16.0) & (np.abs(k) < 30.0)
    repaired = repair(mesh_of_image(Image(inside.astype(np.uint8), np.eye(4))).mesh)
    assert len(find_centreline(repaired.mesh, repaired.rims).ends) == 2


def test_the_dome_of_an_aneurysm_is_no_inlet_and_stays_closed() -> None:
    repaired = vessel_of(([0, 0, 0], [0, 0, 46], 2.0), ([0, 0, 24], [5.5, 0, 24], 1.1), ([8, 0, 24], [8, 0, 24], 4.0))
    line = find_centreline(repaired.mesh, repaired.rims)
    sacs = [end for end in line.ends if end.is_sac]
    assert len(line.ends) == 3 and len(sacs) == 1
    assert sacs[0].number == 3 and sacs[0].centre[0] > 9.0
    assert len(open_ends(repaired).rims) == 2
    assert len(open_ends(repaired, [1]).rims) == 1


def test_ends_of_a_plain_fork_are_no_sacs_and_stand_in_the_order_of_their_radii() -> None:
    repaired = vessel_of(([0, 0, 0], [0, 0, 20], 3.0), ([0, 0, 20], [9, 0, 44], 2.4), ([0, 0, 20], [-9, 0, 40], 1.8))
    line = find_centreline(repaired.mesh, repaired.rims)
    assert not any(end.is_sac for end in line.ends) and not line.loops
    assert [end.radius for end in line.ends] == sorted((end.radius for end in line.ends), reverse=True)
    np.testing.assert_allclose(line.ends[0].centre[2], -3.0, atol=1.0)
