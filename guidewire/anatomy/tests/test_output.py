"""The wire that a scene is written with."""

from __future__ import annotations

import numpy as np
import pytest

from guidewire.anatomy.centreline import Centreline, End
from guidewire.anatomy.inspection import Unit
from guidewire.anatomy.mesh import Edges, find_rims
from guidewire.anatomy.output import _bent_rims, _flexible_length, default_target
from guidewire.anatomy.repair import Repaired
from guidewire.anatomy.tests.solids import SLANT, tube


def path_with_a_turn(radius: float) -> np.ndarray:
    """200 mm straight, half a circle, 50 mm back, in steps of a millimetre."""
    angles = np.linspace(0.0, np.pi, int(np.pi * radius) + 1)[1:]
    turn = np.stack([radius * (1.0 - np.cos(angles)), np.zeros_like(angles), 200.0 + radius * np.sin(angles)], axis=1)
    there = np.stack([np.zeros(201), np.zeros(201), np.arange(201.0)], axis=1)
    return np.vstack([there, turn, turn[-1] - np.stack([np.zeros(50), np.zeros(50), np.arange(1.0, 51.0)], axis=1)])


@pytest.mark.parametrize(("bend", "lumen", "expected"), [
    (8.0, 3.0, 8.0 * np.pi + 50.0),  # 143 degrees over 20 mm
    (40.0, 3.0, 0.0),  # 29 degrees
    (8.0, 6.0, 0.0),  # a lumen in which the wire takes a wider bend
])
def test_a_wire_is_flexible_from_a_tight_and_narrow_bend_on(bend: float, lumen: float, expected: float) -> None:
    points = path_with_a_turn(bend)
    length = _flexible_length(points, np.full(len(points), lumen))
    # It turns by 75 of the 143 degrees when 20 mm reach half-way into the bend, and lengths are multiples of 5 mm.
    assert expected - 5.0 <= length <= expected + 10.0 if expected else length == 0.0


def test_a_bend_at_the_inlet_of_a_long_path_leaves_the_wire_stiff() -> None:
    points = path_with_a_turn(8.0)[::-1]
    onward = points[-1] + np.outer(np.arange(1.0, 201.0), points[-1] - points[-2])
    points = np.vstack([points, onward])
    assert _flexible_length(points, np.full(len(points), 3.0)) == 0.0


def test_a_rim_that_is_not_flat_is_told_from_one_that_is_cut_off_at_a_slant() -> None:
    mesh = tube()
    along = mesh.vertices @ SLANT
    side = mesh.vertices - along[:, None] * SLANT
    across = side @ np.linalg.svd(SLANT[None])[2][1] / 3.0
    for bent, count in ((0.0, 0), (4.0, 1)):
        # One end is cut off at a slant, and bent into a saddle or not.
        at_end = np.isclose(along, along.max())
        moved = mesh.vertices + (at_end * (3.0 * across + bent * across**2))[:, None] * SLANT
        made = type(mesh)(moved, mesh.triangles)
        rims = find_rims(made, Edges.of(made))
        found = _bent_rims(Repaired(made, rims, []))
        assert len(found) == count and all(0.8 < off < 4.0 for off in found.values())


def fork(*branches: tuple[int, float]) -> Centreline:
    """100 mm of 5 mm radius, then straight branches of a length, mm, and a radius, mm; a point a millimetre."""
    parents, points, radii, names = [-1, *range(100)], [[0.0, 0.0, z] for z in range(101)], [5.0] * 101, [1] * 101
    ends = [End(1, "rim 1", np.zeros(3), 5.0, np.array([0.0, 0.0, 1.0]), True, 0)]
    for number, (length, radius) in enumerate(branches, 2):
        along = np.array([np.sin(number), np.cos(number), 1.0]) / np.sqrt(2.0)
        for k in range(1, length + 1):
            parents.append(100 if k == 1 else len(points) - 1)
            points.append([0.0, 0.0, 100.0] + k * along)
            radii.append(radius)
            names.append(number)
        ends.append(End(number, f"rim {number}", points[-1], radius, -along, True, len(points) - 1))
    return Centreline(np.array(points), np.array(radii), np.array(parents), np.array(names), tuple(ends))


@pytest.mark.parametrize(("branches", "expected"), [
    (((100, 1.4), (93, 2.3)), 3),  # 200 and 193 mm: the wider one
    (((93, 2.3), (100, 1.4)), 2),
    (((100, 1.4), (80, 2.3)), 2),  # 180 mm: a tenth shorter
    (((100, 2.3), (93, 2.3)), 2),  # as wide: the longer one
    (((100, 0.4), (80, 0.6)), 3),  # the longer one too narrow for the wire
    (((100, 0.4), (80, 0.3)), 2),  # both are
])
def test_the_default_target_is_the_widest_of_the_ends_that_are_about_as_far_as_the_farthest(branches, expected) -> None:
    line = fork(*branches)
    assert default_target(line, line.ends[0], Unit("mm", "", True), 0.36).number == expected
