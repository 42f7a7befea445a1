"""Vessels that give way as a whole: the key `beam`, and how pictures draw them."""

import json

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from guidewire.anatomy.motion import GivenVessel
from guidewire.commands.drawn import walls_of
from guidewire.env.route import Route
from guidewire.installed import ROOT
from guidewire.logs.logs import read_columns, read_log
from guidewire.logs.runs import read_run
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session
from guidewire.tests.test_motion import write_frames
from guidewire.viewer.live import LiveFrames
from guidewire.viewer.recording import read_recording
from guidewire.viewer.tests.test_page_session import doubles, follow
from guidewire.viewer.tests.test_soft_walls import _padded

BEAM = {"bendingStiffness": 2e-4, "axialStiffness": 20, "foundation": 1000}
ARC = [[0.0, 40 * (1 - np.cos(a)), 40 * np.sin(a)] for a in np.linspace(0.0, 1.2, 25)]
SCENE = {"solver": "direct", "integrator": "implicitEuler", "timeStep": 0.05, "maxSimulationSteps": 20,
         "guidewireLength": 120, "guidewireOffset": -118, "numberRodElements": 40, "wireRadius": 4e-4,
         "massDamping": 20, "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": 0.04, "deltaThreshold": 0,
         "vessel": {"shape": "tube", "knots": [[0, 0, -120], *ARC], "radius": 3, "beam": BEAM}}


def run(live, folder, change=None, beam=None):
    own = json.loads(json.dumps({**SCENE, **(change or {})}))
    if beam is not None:
        own["vessel"]["beam"] = beam
    (folder / "scene.json").write_text(json.dumps(own))
    return live.run(Request("beam", folder / "scene.json", folder / "run"))


@pytest.mark.parametrize("beam, expected", [
    ({"foundation": 1e3}, "bendingStiffness = (missing) is not allowed"),
    ({**BEAM, "youngsModulus": 1e6}, "no bendingStiffness beside it"),
    ({**BEAM, "lumenRadius": 3e-3}, "a youngsModulus beside it"),
    ({"bendingStiffness": 1e-4, "foundation": 1e3}, "axialStiffness = (missing)"),
    ({**BEAM, "foundation": 0}, "a number > 0 (Pa)"),
    ({**BEAM, "spacing": 1e-5}, "a larger spacing is needed"),
    ({**BEAM, "held": ["middle"]}, '"all", or a list of "start" and "end"'),
    ({**BEAM, "from": "a"}, "from its start to its end"),
    ({**BEAM, "stiffness": 1}, "unknown key 'vessel.beam.stiffness'"),
])
def test_what_is_wrong_with_a_beam_is_said_in_one_line(live, tmp_path, beam, expected):
    answer = run(live, tmp_path, beam=beam)
    assert answer.exit_code == 2 and expected in answer.message and "\n" not in answer.message.strip()


@pytest.mark.parametrize("change, expected", [
    ({"solver": "xpbd", "integrator": "verlet"}, "solver direct: with the others a vessel does not give way"),
    ({"obstacles": [{"shape": "sphere", "centre": [50, 0, 0], "radius": 2}]}, "what is in it gives way with it"),
    ({"vessel": {**SCENE["vessel"], "modulus": 1e6, "wallThickness": 1e-3, "lumenRadius": 3e-3,
                 "surroundingModulus": 1e4, "relaxationTime": 0.1}}, "beside a relaxationTime"),
    ({"vessel": {**SCENE["vessel"], "knots": [[0, 0, -120], [0, 0, 0], [0, 30, 0]], "radius": 12}},
     "bends more tightly than the vessel is wide"),
    ({"vessel": {"shape": "plane", "point": [0, -5, 0], "normal": [0, 1, 0], "beam": BEAM}}, "unknown key"),
])
def test_what_it_does_not_go_with_is_refused(live, tmp_path, change, expected):
    answer = run(live, tmp_path, change)
    assert answer.exit_code == 2 and expected in answer.message and "\n" not in answer.message.strip()


def test_a_pipe_is_the_beam_of_its_modulus(live, tmp_path):
    pipe = {"youngsModulus": 0.5e6, "wallThickness": 1e-3, "lumenRadius": 4e-3, "foundation": 1000, "held": ["start"]}
    fourth, square = 5e-3 ** 4 - 4e-3 ** 4, 5e-3 ** 2 - 4e-3 ** 2
    beam = {"bendingStiffness": 0.25 * np.pi * 0.5e6 * fourth, "axialStiffness": np.pi * 0.5e6 * square,
            "foundation": 1000, "held": "start"}
    ends = []
    for k, own in enumerate((pipe, beam)):
        (tmp_path / str(k)).mkdir()
        assert run(live, tmp_path / str(k), beam=own).exit_code == 0
        ends.append(read_log(tmp_path / str(k) / "run", "all").positions[-1])
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-9)


def test_pictures_draw_the_vessel_where_it_keeps_the_wire(live, tmp_path):
    answer = run(live, tmp_path)
    assert answer.exit_code == 0, answer.message
    own, log = read_run(tmp_path / "run"), read_log(tmp_path / "run", "all")
    centrelines = read_columns(own.folder, ["vesselCentreline"])["vesselCentreline"]
    assert np.abs(centrelines[0, :, 3:]).max() == 0.0
    shift = np.linalg.norm(centrelines[-1, :, 3:], axis=1)
    assert shift.max() > 0.3 and shift[0] < 1e-3 and shift[-1] < 1e-2    # both ends are held
    with walls_of(own, log, np.zeros(3), 100.0) as (rest, at):
        drawn = at(len(log.steps) - 1)[0].vertices
    vessel = GivenVessel(centrelines[0, :, :3])
    np.testing.assert_allclose(drawn, vessel.moved(rest[0].vertices, centrelines[-1, :, 3:]), atol=1e-12)
    # A node is as far from the drawn centreline as the lumen lets it, which it is not from that at rest.
    at_rest = CubicSpline(np.arange(len(shift)), centrelines[0, :, :3])(np.linspace(0.0, len(shift) - 1.0, 2000))
    moved = vessel.moved(at_rest, centrelines[-1, :, 3:])
    beyond = log.positions[-1][log.positions[-1][:, 2] > 1.0]
    far = [np.linalg.norm(beyond[:, None] - one[None], axis=2).min(axis=1).max() for one in (moved, at_rest)]
    assert far[0] < 3.0 - 0.4 + 0.05 < far[1], shift.max()
    got = follow("""
        import { Recording, unpackRecording } from "./recording.js";
        const recording = new Recording(unpackRecording(numbers(data.block).buffer));
        recording.moveWalls(recording.count - 1);
        console.log(JSON.stringify({ moved: told(recording.walls[0].vertices) }));
        """, block=_padded(read_recording(own, rest, 100, {}, lambda _: []).to_bytes()))
    # Beyond its ends the tube goes on straight, and a small difference of the end's direction becomes large.
    along = rest[0].vertices - ARC[-1]
    within = (rest[0].vertices[:, 2] > -121.0) & (along @ (np.array(ARC[-1]) - ARC[-2]) < 2.0)
    np.testing.assert_allclose(doubles(got["moved"]).reshape(-1, 3)[within], drawn[within], atol=0.05)
    with Session(tmp_path / "scene.json", native=False) as session:
        state, frames = session.step(steps=20), LiveFrames(session, "live")
        np.testing.assert_array_equal(state.vessel_centreline, centrelines[-1])
        held = {one.name: one.values for one in frames.record(0.0).channels}
        np.testing.assert_array_equal(held["vesselCentreline"][-1], centrelines[-1].ravel())


def test_environments_have_their_distances_in_the_vessel_that_gave_way(tmp_path):
    """As the core has them, whose map has the beam's own splines."""
    names, _ = write_frames(tmp_path, np.concatenate([np.c_[np.zeros((10, 2)), np.linspace(-10, -1, 10)], ARC]), 3.0,
                            [lambda x: x])
    vessel = {"shape": "mesh", "file": str(tmp_path / names[0]), "anatomy": str(tmp_path / "anatomy.json"),
              "beam": {**BEAM, "foundation": 300}}
    scene = {key: value for key, value in SCENE.items() if key != "guidewireOffset"}
    with Session(**{**scene, "vessel": vessel, "sheath": {}, "inlet": 1, "target": 2}) as session:
        state = session.step(steps=20)
        route = Route(json.loads((tmp_path / "anatomy.json").read_text()), 2)
        route.follow(state)
        tip = state.positions[-1]
        assert route.place(tip)[1] == pytest.approx(state.place.left, abs=0.2)
        np.testing.assert_allclose(tip - route._belongs(tip)[1], state.vessel_displacement, atol=0.02)
    assert np.linalg.norm(state.vessel_displacement) > 0.3
    line = state.vessel_centreline
    near = line[:, :3] + np.random.default_rng(3).uniform(-1.5, 1.5, (len(line), 3))
    beam = GivenVessel(line[:, :3])
    np.testing.assert_allclose(beam.at_rest(beam.moved(near, line[:, 3:]), line[:, 3:]), near, atol=0.02)


def test_a_beam_that_turns_as_a_body_is_drawn_as_one():
    rest = np.array(ARC)
    turn = np.array([[1, 0, 0], [0, np.cos(0.3), -np.sin(0.3)], [0, np.sin(0.3), np.cos(0.3)]])
    points = rest[3:-3] + np.random.default_rng(2).uniform(-2, 2, (len(rest) - 6, 3))
    moved = GivenVessel(rest).moved(points, rest @ turn.T - rest)
    np.testing.assert_allclose(moved, points @ turn.T, atol=2e-3)


@pytest.mark.long("two runs of the shipped artery")
def test_a_stiff_wire_straightens_the_shipped_artery_and_a_soft_one_does_not(live, tmp_path):
    moved = {}
    for name in ("lunderquist-extra-stiff-0.035", "bentson-0.035"):
        answer = live.run(Request(name, ROOT / "params/iliac.json", tmp_path / name, {"instrument": name}))
        summary = json.loads((tmp_path / name / "summary.json").read_text())
        assert answer.exit_code == 0 and summary["reliable"] and summary["passages"] == 0
        centreline = read_columns(tmp_path / name, ["vesselCentreline"])["vesselCentreline"][-1]
        moved[name[:3]] = np.linalg.norm(centreline[:, 3:], axis=1).max()
    assert 7.0 < moved["lun"] < 11.0 and moved["ben"] < 2.5
