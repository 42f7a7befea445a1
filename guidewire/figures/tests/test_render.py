"""Pictures of a run: the geometry is checked against closed forms, the pixels against where things must be."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from guidewire.figures import render
from guidewire.figures.raster import Camera, Picture, draw
from guidewire.logs import surfaces
from guidewire.logs.logs import LogError, PositionLog
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import Surface

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


def test_refined_triangles_cover_the_same_area_with_short_sides() -> None:
    whole = square(0.0, -1.0)
    fine = surfaces.refine(whole, 3.0)
    corners = fine.vertices[fine.triangles]
    normals = 0.5 * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert normals.sum(axis=0) == pytest.approx([0.0, 0.0, -400.0])  # the square's own: they face as it does
    assert (normals[:, 2] < 0.0).all()
    assert np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() <= 3.0
    assert surfaces.refine(whole, 30.0) is whole


def test_coinciding_spheres_have_no_curvature_and_are_drawn() -> None:
    wire = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 10.0], [0, 5.0, 20.0]])
    assert np.isfinite(surfaces.curvature(wire)).all() and surfaces.curvature(wire)[1] == 0.0
    assert np.isfinite(surfaces.tube(wire, RADIUS).vertices).all()


LENGTH = 50.0  # of the wire that is drawn, units


def make_run(**parameters: object) -> tuple[Run, PositionLog]:
    """A run of three states, 0.1 s apart, of a straight wire along z; in each it lies 40 units higher."""
    wire = np.stack([np.zeros(6), np.zeros(6), np.linspace(0.0, LENGTH, 6)], axis=1)
    positions = wire + 40.0 * np.arange(3)[:, None, None] * np.array([0.0, 1.0, 0.0])
    steps, time = np.arange(3), 0.1 * np.arange(3)
    log = PositionLog(Path("run"), steps, time, time, 0.0 * time, np.arange(6), positions, None, 2, np.arange(6),
                      positions[-1], None)
    return Run(Path("run"), {"sphereRadius": 3.0, **parameters}, None), log


def place_of(picture: Image.Image, stage: render.Stage, point: tuple[float, float, float]) -> tuple[int, int, int]:
    """Colour where a point is seen."""
    right, up, forward = stage.camera.view(np.array([point]))[0]
    scale = 0.5 * render.SIZE[1] / np.tan(0.5 * np.radians(stage.camera.field_of_view)) / forward
    return picture.convert("RGB").getpixel((int(render.SIZE[0] / 2 + scale * right),
                                            int(render.SIZE[1] / 2 - scale * up)))


def test_a_picture_shows_the_last_moment_or_each_moment_in_its_own_colour() -> None:
    run, log = make_run()
    stage = render.set_stage(run, log, [], render.View())
    middles = [(0.0, 40.0 * k, 0.5 * LENGTH) for k in range(3)]
    last = render.draw_picture(run, log, [], render.View(), [])
    seen = [place_of(last, stage, middle) for middle in middles]
    assert max(seen[0]) < 40 and max(seen[1]) < 40 and min(seen[2]) > 80, "the last alone, grey where it is straight"
    both = render.draw_picture(run, log, [], render.View(), [0.19, 0.0, 0.01])
    seen = [place_of(both, stage, middle) for middle in middles]
    assert max(seen[0]) > 80 and max(seen[1]) < 40 and max(seen[2]) > 80
    assert seen[2][1] - seen[0][1] > 60, "plasma: the later, the more green"


def test_instruments_have_a_colour_each_and_a_line_with_their_hub() -> None:
    run, log = make_run(wireRadius=2e-3, metresPerUnit=1e-3)
    away = log.positions - [0.0, 15.0, 0.0]    # a catheter beside the wire, to look at
    hub = np.array([[0.0, 0.0], [0.01, 0.5], [0.0204, np.pi]])
    described = [{"title": name, "radii": [radius]} for name, radius in (("wire", 2.0), ("tube", 3.0))]
    wire, catheter = render.instruments_of(described, [None, hub])
    assert (wire.line(2), catheter.line(2), catheter.line(None)) == ("wire", "tube: 20 mm in, turned by 180°", "tube")
    log = replace(log, catheters=(away,))
    stage = render.set_stage(run, log, [], render.View(), (wire, catheter))
    picture = render.draw_picture(run, log, [], render.View(), [], (wire, catheter))
    for one, height in ((wire, 80.0), (catheter, 65.0)):
        seen = np.array(place_of(picture, stage, (0.0, height, 0.5 * LENGTH))) / 255.0
        assert seen @ one.colour > 0.98 * np.linalg.norm(seen) * np.linalg.norm(one.colour), one.name


def test_a_sheath_is_drawn_around_what_is_in_it() -> None:
    run, log = make_run(wireRadius=2e-3, metresPerUnit=1e-3)
    stage = render.set_stage(run, log, [], render.View(), sheath=np.array([[0.0, 80.0, 20.0], [0.0, 80.0, 0.0]]))
    (sheath,) = stage.obstacles
    assert np.hypot(sheath.vertices[:, 0], sheath.vertices[:, 1] - 80.0).max() == pytest.approx(4.0)


@pytest.mark.parametrize("metres, unit", [(1e-3, 1.0), (2.5e-2, 25.0), (None, 1.0)])
def test_the_bar_is_as_long_as_it_says(metres: float | None, unit: float) -> None:
    run, log = make_run(**({} if metres is None else {"wireRadius": 2.0 * metres, "metresPerUnit": metres}))
    view = render.View(distance=137.0)
    pixels = np.asarray(render.draw_picture(run, log, [], view, []).convert("RGB")).astype(int)
    bar = (np.abs(pixels[render.SIZE[1] - 16, render.SIZE[0] // 2:] - 225).max(axis=1) < 12).sum()
    long = 2.0 * 137.0 * np.tan(np.radians(22.5)) * bar / render.SIZE[1] * unit    # mm or units, across the middle
    rounded = 10.0 ** np.floor(np.log10(long * 1.02))
    assert min(abs(long / (k * rounded) - 1.0) for k in (1, 2, 5)) < 0.02
    assert 0.09 < bar / render.SIZE[0] <= 0.26


def test_a_film_has_as_many_pictures_as_asked_for_and_no_more_than_moments(tmp_path: Path) -> None:
    run, log = make_run()
    for frames, count in ((1, 1), (2, 2), (40, 3)):
        counted: list[tuple[int, int]] = []
        images = render.draw_film(run, log, [], render.View(), frames, lambda *done: counted.append(done))
        assert len(images) == count and counted == [(k, count) for k in range(1, count + 1)]
    render.save_images(images, tmp_path / "film.gif")
    with Image.open(tmp_path / "film.gif") as film:
        assert film.n_frames == 3


def sheathed() -> tuple[Run, PositionLog, list[Surface]]:
    """A wire of 1000 units along z, of which 20 and then 60 are out of its sheath, and a vessel from z = 0 to 100."""
    z = np.linspace(-1000.0, 0.0, 51)
    wires = [np.stack([np.zeros(51), np.zeros(51), z + out], axis=1) for out in (20.0, 60.0)]
    _, log = make_run()
    steps, time = np.arange(2), 0.1 * np.arange(2)
    log = replace(log, steps=steps, time=time, spheres=np.arange(51), positions=np.array(wires), final_step=1,
                  final_spheres=np.arange(51), final_positions=wires[1])
    run = Run(Path("run"), {"sphereRadius": 3.0, "sheath": {}, "vessel": {"shape": "mesh"}},
              {"hub": {"spheresInBody": 3}})
    corners = np.array([[-10.0, -10.0, 0.0], [10.0, -10.0, 0.0], [10.0, 30.0, 100.0]])
    return run, log, [Surface(corners, np.array([[0, 1, 2]]), np.zeros(3))]


def test_of_a_wire_in_a_sheath_the_vessel_and_what_is_in_it_fill_the_picture() -> None:
    run, log, walls = sheathed()
    stage = render.set_stage(run, log, walls, render.View())
    assert np.linalg.norm(np.array(stage.camera.target) - [0.0, 10.0, 50.0]) < 15.0
    assert 100.0 < stage.camera.distance < 200.0, "1.05 times the diagonal of the vessel, not of the 1000 units"
    bare = render.set_stage(Run(run.folder, {"sphereRadius": 3.0}, None), log, [], render.View())
    assert bare.camera.distance > 1000.0


def test_zoom_and_the_tip_that_is_followed_move_the_camera() -> None:
    run, log = make_run()
    plain = render.set_stage(run, log, [], render.View()).camera
    near = render.set_stage(run, log, [], render.View(zoom=2.5)).camera
    assert near.target == plain.target and near.distance == pytest.approx(plain.distance / 2.5)
    for time, tip in ((0.0, (0.0, 0.0, LENGTH)), (0.2, (0.0, 80.0, LENGTH))):
        view = render.View(target=tip, follows_tip=True)
        stage = render.set_stage(run, log, [], view)
        assert stage.camera.distance == pytest.approx(plain.distance / 4.0)
        picture = render.draw_picture(run, log, [], render.View(follows_tip=True), [time])
        assert np.array_equal(np.asarray(picture), np.asarray(render.draw_picture(run, log, [], view, [time])))
        assert max(place_of(picture, stage, (tip[0], tip[1], tip[2] - 3.0))) > 80, "the wire ends in the middle"


def test_an_obstacle_before_the_wire_tints_it_and_the_vessel_lies_behind() -> None:
    front, back = (Surface(square(0.0, 1.0).vertices[:, [2, 1, 0]] + [x, 80.0, 0.5 * LENGTH],
                           square(0.0, 1.0).triangles[:, ::-1], np.zeros(4)) for x in (20.0, -20.0))
    bare_run, log = make_run()
    vessel_run, _ = make_run(vessel={"shape": "plane"})
    stage = render.set_stage(bare_run, log, [], render.View())
    at = (0.0, 80.0, 0.5 * LENGTH)
    plain, tinted, before_wall = (
        np.array(place_of(render.draw_picture(run, log, walls, render.View(), []), stage, at))
        for run, walls in ((bare_run, []), (bare_run, [front]), (vessel_run, [back])))
    assert np.abs(tinted - plain).max() > 15 and min(tinted) > 60
    assert np.abs(before_wall - plain).max() <= 2


@pytest.mark.parametrize("parameters, radius", [
    ({"sphereRadius": 3.0}, 3.0), ({"wireRadius": 2e-3, "metresPerUnit": 1e-3}, 2.0),
    ({"wireRadius": 1e-6, "metresPerUnit": 1e-3}, np.hypot(80.0, LENGTH) / 400.0),
])
def test_the_wire_has_its_own_radius_unless_that_is_too_thin_to_be_seen(parameters: dict, radius: float) -> None:
    run, log = make_run(**parameters)
    assert render.set_stage(run, log, [], render.View()).radius == pytest.approx(radius)
    assert render.set_stage(run, log, [], render.View(radius=3.0)).radius == 3.0


@pytest.mark.parametrize("value, rounded", [(0.01, 0.01), (0.011, 0.02), (3.0, 5.0), (70.0, 100.0)])
def test_full_red_is_a_round_number(value: float, rounded: float) -> None:
    assert render._round_up(value) == pytest.approx(rounded)


def test_what_cannot_be_drawn_is_said() -> None:
    run, log = make_run()
    lost = replace(log, positions=np.where(log.time[:, None, None] > 0.15, np.nan, log.positions))
    with pytest.raises(LogError, match="step 2 has a position that is not finite"):
        render.draw_picture(run, lost, [], render.View(), [])
    assert render.draw_picture(run, lost, [], render.View(), [0.1]).size == render.SIZE
    with pytest.raises(LogError, match="logSpheres"):
        render.set_stage(run, replace(log, spheres=log.spheres[-1:], positions=log.positions[:, -1:]), [],
                         render.View())
