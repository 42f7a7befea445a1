"""Walls that give way, as they are drawn: by the core, on the page, in X-ray pictures and by `render`."""

import json
from base64 import b64encode
from types import SimpleNamespace

import numpy as np
import pytest

from guidewire.commands import commands, drawn
from guidewire.logs.logs import read_log
from guidewire.logs.runs import read_run
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session, SessionError
from guidewire.viewer.recording import read_recording
from guidewire.viewer.tests.browsing import DRAWN
from guidewire.viewer.tests.test_page_session import doubles, follow
from guidewire.viewer.tests.test_view import serving

RADIUS = 0.45  # mm
REACH = 4 * RADIUS  # beyond the wire's surface
TUBE = 2.0
# A heavy wire sinks into the floor of a tube.
SCENE = {"solver": "direct", "integrator": "implicitEuler", "timeStep": 0.01, "maxSimulationSteps": 60,
         "guidewireLength": 60, "guidewireOffset": 0, "numberRodElements": 24, "wireRadius": 1e-3 * RADIUS,
         "youngsModulus": 60e9, "massDamping": 20, "proximalEnd": "clamped", "drive": "hold", "displacement": 0,
         "deltaThreshold": 0, "gravity": [0, -9810, 0], "logContacts": True, "logFormat": "npz",
         "vessel": {"shape": "tube", "knots": [[0, 0, -10], [0, 0, 80]], "radius": TUBE, "wallStiffness": 2e5}}


@pytest.fixture(scope="module")
def soft(live, tmp_path_factory):
    """A run, its scene, and of a session that made the same steps the state and the walls, at rest and drawn."""
    folder = tmp_path_factory.mktemp("soft")
    (folder / "scene.json").write_text(json.dumps(SCENE))
    live.run(Request("soft", folder / "scene.json", folder / "run"))
    with Session(folder / "scene.json", hand=False) as session:
        state = session.step(steps=SCENE["maxSimulationSteps"])
        (rest,), (moved,) = session.walls(), session.walls(drawn=state.drawn)
    return SimpleNamespace(run=folder / "run", scene=folder / "scene.json", state=state, rest=rest, moved=moved)


def test_a_vertex_at_a_contact_goes_with_it_and_one_beyond_its_reach_stays(soft):
    displaced, x = soft.state.wall_displacements, soft.state.positions
    sunk = np.linalg.norm(displaced, axis=1)
    assert 0.1e-3 < sunk.max() < 0.9e-3 * RADIUS
    np.testing.assert_allclose(1e3 * sunk.max(), -x[:, 1].min() + RADIUS - TUBE, atol=1e-6)
    went = soft.moved.vertices - soft.rest.vertices
    floor = (np.abs(soft.rest.vertices[:, 0]) < 1e-9) & (soft.rest.vertices[:, 1] < 0.0)
    for j in np.flatnonzero(sunk):
        beside = floor & (soft.rest.vertices[:, 2] > x[j, 2]) & (soft.rest.vertices[:, 2] < x[j + 1, 2])
        largest = 1e3 * sunk[max(j - 1, 0):j + 2].max()
        np.testing.assert_allclose(went[beside], [[0.0, -1e3 * sunk[j], 0.0]] * beside.sum(), atol=0.2 * largest)
    assert floor.sum() > 5
    ends = np.repeat(x, 2, axis=0)[1:-1].reshape(-1, 2, 3)
    along = np.linspace(0.0, 1.0, 50)[:, None, None]
    wire = ((1.0 - along) * ends[:, 0] + along * ends[:, 1]).reshape(-1, 3)
    away = np.linalg.norm(soft.rest.vertices[:, None] - wire[None], axis=2).min(axis=1)
    far = away > RADIUS + REACH
    assert far.any() and not went[far].any()


def test_the_page_and_its_recording_move_vertices_as_the_core_does(soft):
    run = read_run(soft.run)
    recording = read_recording(run, [soft.rest], 100, {}, lambda _: [])
    channels = {channel.name: channel.values[-1] for channel in recording.channels}
    np.testing.assert_allclose(channels["wallDisplacements"], 1e3 * soft.state.wall_displacements.ravel(), rtol=1e-12)
    got = follow("""
        import { CArm } from "./carm.js";
        import { Lumen } from "./lumen.js";
        import { Recording, unpackRecording } from "./recording.js";
        const recording = new Recording(unpackRecording(numbers(data.block).buffer));
        const arm = new CArm(0, 0, [0, -1, 55], 8, 64, undefined, 64);
        const thicknesses = [0, recording.count - 1].map((frame) => {
          recording.moveWalls(frame);
          const thickness = new Float32Array(64 * 64);
          new Lumen(recording.walls[0]).add(arm, thickness);
          return told(thickness);
        });
        const moved = told(recording.walls[0].vertices);
        recording.moveWalls(0);
        console.log(JSON.stringify({ moved, back: told(recording.walls[0].vertices), thicknesses }));
        """, block=_padded(recording.to_bytes()))
    np.testing.assert_allclose(doubles(got["moved"]), soft.moved.vertices.ravel(), atol=1e-5)
    np.testing.assert_allclose(doubles(got["back"]), soft.rest.vertices.ravel(), atol=1e-5)
    before, after = (doubles(one).reshape(64, 64) for one in got["thicknesses"])
    # Seen from the side in AP the floor is lower by what it gives way: rays below it pass the lumen there.
    grown = (after > 0.0).sum(axis=1) - (before > 0.0).sum(axis=1)
    sunk = 1e3 * np.linalg.norm(soft.state.wall_displacements, axis=1).max()
    assert grown.max() * 8 / 64 == pytest.approx(sunk, abs=1.01 * 8 / 64)
    assert np.abs(after - before).max() > 0.1


def _padded(block):
    return b64encode(block + b" " * (-len(block) % 8)).decode()


def test_x_ray_pictures_show_the_displaced_wall(soft):
    view = {"lao": 0, "centre": [0, -2, 50], "field_of_view": 12, "pixels": 240, "vessel": "contrast", "contrast": 0.5,
            "attenuation": 0.0, "background": 1.0}
    with Session(soft.scene, hand=False) as session:
        rest = session.picture_of(soft.state.positions, **view)
        state = session.step(steps=SCENE["maxSimulationSteps"])
        shown = session.picture(**view)
        assert np.array_equal(state.picture(**view), shown)
        assert np.array_equal(session.picture_of(state.positions, **view), rest), "at rest where nothing else is said"
        with pytest.raises(SessionError, match="displacements of walls at 24 elements"):
            session.picture_of(state.positions, [np.zeros((3, 3))], **view)
    lower = (shown < 250).sum(axis=1) - (rest < 250).sum(axis=1)  # pixels of 0.05 mm
    sunk = 1e3 * np.linalg.norm(state.wall_displacements, axis=1)
    assert lower.max() * 0.05 == pytest.approx(sunk.max(), abs=0.06)


def test_render_draws_walls_as_the_log_has_them(soft, tmp_path):
    run, log = read_run(soft.run), read_log(soft.run, "all")
    with drawn.walls_of(run, log, np.array([0.0, 0.0, 30.0]), 60.0) as ((rest,), moved):
        (last,), (first,) = moved(len(log.steps) - 1), moved(0)
    went = np.linalg.norm(last.vertices - rest.vertices, axis=1).max()
    assert went == pytest.approx(1e3 * np.linalg.norm(soft.state.wall_displacements, axis=1).max(), rel=0.1)
    np.testing.assert_array_equal(first.vertices, rest.vertices)
    for more in ([], ["--fluoroscopy"]):
        out = tmp_path / f"picture{len(more)}.png"
        arguments = commands.parse(["render", str(soft.run), "--out", str(out), *more])
        assert arguments.action(arguments) == 0 and out.is_file()


@pytest.mark.long("the same vertices are compared without a browser")
def test_the_picture_of_the_page_has_the_displaced_wall(soft, browse, tmp_path):
    with serving(tmp_path, str(soft.run), with_three=True) as (address, _):
        low = ("(() => { const y = viewer.shown.models[0].walls.children[0].geometry.getAttribute('position').array; "
               "let low = 0; for (let i = 1; i < y.length; i += 3) low = Math.min(low, y[i]); return low; })()")
        answer = browse(["open", address], DRAWN, ["see", low], ["see", "viewer.shown.go(60)"], ["see", low])
    before, _, after = answer["seen"]
    assert before == pytest.approx(-TUBE, abs=1e-6) and after < -TUBE - 0.1
