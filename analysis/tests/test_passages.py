"""Which points are inside a vessel, and passages counted by that."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from analysis.passages import MeshError, Wall, count_passages, sample_wire
from analysis.tests.conftest import BOX, box_passages, write_box
from analysis.tests.waves import Wave
from guidewire.logs.surfaces import read_obj


def tube_of_triangles(radius: float = 10.0, rings: int = 60, sides: int = 24) -> tuple[np.ndarray, np.ndarray]:
    """An open tube along z from 0 to 5 (rings - 1)."""
    angle = 2.0 * np.pi * np.arange(sides) / sides
    vertices = np.array([
        (radius * np.cos(a), radius * np.sin(a), 5.0 * k) for k in range(rings) for a in angle
    ])
    faces = []
    for k in range(rings - 1):
        for i in range(sides):
            a, b = k * sides + i, k * sides + (i + 1) % sides
            faces += [(a, b, a + sides), (b, b + sides, a + sides)]
    return vertices, np.array(faces)


@pytest.fixture(scope="module")
def box(tmp_path_factory: pytest.TempPathFactory) -> Wall:
    path = tmp_path_factory.mktemp("box") / "box.obj"
    write_box(path)
    surface = read_obj(path)
    return Wall.of(surface.vertices, surface.triangles)


def test_points_inside_a_closed_mesh_are_known(box: Wall) -> None:
    points = np.random.default_rng(1).uniform(BOX[0] - 20.0, BOX[1] + 20.0, (3000, 3))
    expected = np.all((points > BOX[0]) & (points < BOX[1]), axis=1)
    np.testing.assert_array_equal(box.closed.inside(points), expected)


def test_an_open_rim_is_closed() -> None:
    wall = Wall.of(*tube_of_triangles())
    assert len(wall.fans) == 2 * 24
    points = np.random.default_rng(2).uniform((-15.0, -15.0, -20.0), (15.0, 15.0, 315.0), (3000, 3))
    angle = np.arctan2(points[:, 1], points[:, 0])
    # The tube is a prism of 24 sides: its wall is at 10 cos(pi/24)/cos(distance from the middle of a side).
    step = 2.0 * np.pi / 24
    edge = 10.0 * np.cos(step / 2.0) / np.cos(np.mod(angle, step) - step / 2.0)
    expected = (np.hypot(points[:, 0], points[:, 1]) < edge) & (points[:, 2] > 0.0) & (points[:, 2] < 295.0)
    np.testing.assert_array_equal(wall.closed.inside(points), expected)


def test_a_mesh_that_turns_over_is_reported() -> None:
    vertices, faces = tube_of_triangles()
    faces[7] = faces[7][::-1]
    with pytest.raises(MeshError, match="same sense"):
        Wall.of(vertices, faces)


def test_ten_samples_an_element_and_the_last_sphere() -> None:
    points = sample_wire(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 10.0], [0.0, 5.0, 10.0]]))
    np.testing.assert_allclose(points[:10, 2], np.arange(10))
    np.testing.assert_allclose(points[10:, 1], 0.5 * np.arange(11))


def test_passages_are_those_in_closed_form(box: Wall) -> None:
    for elements in (1, 4, 9):
        wave = Wave(elements=elements)
        assert count_passages(box, wave.positions) == box_passages(wave) > 0


@pytest.mark.parametrize(("way", "passages"), [((0.0, 0.0, -20.0), 0), ((20.0, 0.0, 0.0), 21)])
def test_leaving_through_a_rim_is_no_passage(way: tuple[float, float, float], passages: int) -> None:
    wall = Wall.of(*tube_of_triangles())
    wire = np.array([[0.0, 0.0, 5.0], [0.0, 0.0, 10.0], [0.0, 0.0, 15.0]])
    assert count_passages(wall, np.stack([wire, wire + np.array(way)])) == passages


def test_the_vessel_of_the_scenes_is_closed_but_for_its_entrance() -> None:
    surface = read_obj(Path(__file__).resolve().parents[2] / "params" / "meshes" / "arch.obj")
    wall = Wall.of(surface.vertices, surface.triangles)
    assert len(wall.fans) > 0 and np.ptp(wall.fans[:, :, 2]) < 1e-6
    points = np.array([[0.0, 0.0, -300.0], [0.0, 60.0, 140.0], [0.0, 120.0, 40.0], [0.0, 60.0, 60.0]])
    assert wall.closed.inside(points).tolist() == [True, True, True, False]
