"""Pictures of a run: the geometry is checked against closed forms, the pixels against where things must be."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from analysis import render, surfaces
from analysis.raster import Camera, Picture, draw
from analysis.surfaces import Surface

RADIUS = 4.0


def arc(count: int, radius: float, angle: float) -> np.ndarray:
    """Points on a circle in the y-z plane, shape (count, 3)."""
    at = np.linspace(0.0, angle, count)
    return np.stack([np.zeros(count), radius * (1 - np.cos(at)), radius * np.sin(at)], axis=1)


def test_curvature_of_a_circle() -> None:
    bend = surfaces.curvature(arc(41, 50.0, 1.6))
    assert bend[1:-1] == pytest.approx(1 / 50.0, rel=1e-3)  # chord against arc: (kappa l)^2/24 = 7e-5
    assert bend[0] == bend[-1] == 0.0


def test_tube_lies_at_its_radius_around_a_circle() -> None:
    tube = surfaces.tube(arc(41, 50.0, 1.6), RADIUS)
    rings = tube.vertices.reshape(-1, 16, 3)[4:-4]
    from_axis = np.hypot(rings[..., 0], np.hypot(rings[..., 1] - 50.0, rings[..., 2]) - 50.0)
    assert from_axis == pytest.approx(RADIUS, abs=0.02)


def test_tube_is_closed_and_faces_outwards() -> None:
    tube = surfaces.tube(np.array([[0, 0, z] for z in np.linspace(0, 100, 11)], float), RADIUS, sides=64)
    a, b, c = (tube.vertices[tube.triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    assert volume == pytest.approx(np.pi * RADIUS**2 * 100 + 4 / 3 * np.pi * RADIUS**3, rel=0.01)


def test_obj_is_turned_inwards(tmp_path: Path) -> None:
    outward = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1/1 4/1 3/1\nf 2 3 4\n"
    (tmp_path / "a.obj").write_text(outward)
    (tmp_path / "b.obj").write_text(outward.replace("f 1 3 2", "f 1 2 3").replace("f 1 2 4", "f 1 4 2")
                                    .replace("f 1/1 4/1 3/1", "f 1 3 4").replace("f 2 3 4", "f 2 4 3"))
    for name in ("a.obj", "b.obj"):
        surface = surfaces.read_obj(tmp_path / name)
        a, b, c = (surface.vertices[surface.triangles[:, k]] for k in range(3))
        assert np.einsum("ij,ij->", a, np.cross(b, c)) < 0.0


@pytest.mark.parametrize("yaw, pitch", [(0.0, 0.0), (-90.0, 15.0), (130.0, -40.0)])
def test_camera_looks_at_its_target(yaw: float, pitch: float) -> None:
    camera = Camera((1.0, 2.0, 3.0), 50.0, yaw, pitch)
    assert camera.view(np.array([[1.0, 2.0, 3.0]]))[0] == pytest.approx([0.0, 0.0, 50.0], abs=1e-12)
    axes = camera.axes()
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)
    assert axes[1][1] >= 0.0, "up is up"


def square(z: float, facing: float) -> Surface:
    """A square of side 20 at depth z before a camera that looks along +z from z = -50."""
    vertices = np.array([[-10, -10, z], [10, -10, z], [10, 10, z], [-10, 10, z]], float)
    triangles = np.array([[0, 2, 1], [0, 3, 2]]) if facing < 0 else np.array([[0, 1, 2], [0, 2, 3]])
    return Surface(vertices, triangles, np.zeros(4))


def test_square_covers_its_pixels() -> None:
    camera, picture = Camera((0, 0, 0), 50.0, 0.0, 0.0, 90.0), Picture.blank(100, 100, (0, 0, 0))
    draw(picture, camera, square(0.0, -1.0), np.ones((4, 3)))
    covered = np.isfinite(picture.depth)
    # 10 units at a distance of 50 are a tenth of the picture's width on each side of the middle.
    assert covered.sum() == 20 * 20
    assert covered[40:60, 40:60].all()
    assert picture.depth[50, 50] == pytest.approx(50.0)


def test_nearer_square_hides_the_farther_in_either_order() -> None:
    camera = Camera((0, 0, 0), 50.0, 0.0, 0.0, 90.0)
    red, blue = np.tile([1.0, 0, 0], (4, 1)), np.tile([0, 0, 1.0], (4, 1))
    for order in ([(-10.0, red), (10.0, blue)], [(10.0, blue), (-10.0, red)]):
        picture = Picture.blank(100, 100)
        for z, colours in order:
            draw(picture, camera, square(z, -1.0), colours)
        assert picture.colour[50, 50, 2] == 0.0 and picture.colour[50, 50, 0] > 0.4


def test_back_is_not_drawn() -> None:
    picture = Picture.blank(100, 100)
    draw(picture, Camera((0, 0, 0), 50.0, 0.0, 0.0), square(0.0, 1.0), np.ones((4, 3)))
    assert not np.isfinite(picture.depth).any()


def write_run(folder: Path, vessel: object) -> None:
    """A run of three states of a straight wire that moves along z."""
    folder.mkdir()
    entries = {str(k): {"totalTime": 0.1 * k, "elapsedMilliseconds": k, "delta": 0.0, "sphere": {
        str(i): {"x": 0, "y": 0, "z": 10.0 * i + k, "vx": 0, "vy": 0, "vz": 0} for i in range(6)}} for k in range(3)}
    lines = ",\n".join(f"{json.dumps(key)}: {json.dumps(entry)}" for key, entry in entries.items())
    (folder / "positions.json").write_text("{\n" + lines + "\n}\n")
    (folder / "parameters.json").write_text(json.dumps({"sphereRadius": 3.0, "vessel": vessel}))


def test_pictures_of_a_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_run(tmp_path / "run", {"shape": "plane", "point": [0, -5, 0], "normal": [0, 1, 0]})
    assert render.main([str(tmp_path / "run"), "--out", str(tmp_path / "out"), "--frames", "3"]) == 0
    assert capsys.readouterr().out.split() == [str(tmp_path / "out" / name) for name in ("run.png", "run.gif")]
    with Image.open(tmp_path / "out" / "run.png") as picture:
        assert picture.size == render.SIZE
        middle = picture.convert("RGB").getpixel((render.SIZE[0] // 2, render.SIZE[1] // 2))
    assert min(middle) > 80, "the wire passes the middle"
    with Image.open(tmp_path / "out" / "run.gif") as film:
        assert film.n_frames == 3


def test_what_cannot_be_drawn_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_run(tmp_path / "run", {"shape": "mesh", "file": str(tmp_path / "nowhere.obj")})
    assert render.main([str(tmp_path / "run"), "--out", str(tmp_path / "out")]) == 2
    error = capsys.readouterr().err
    assert error.startswith("guidewire: ") and "nowhere.obj" in error and error.count("\n") == 1
