"""Vessels that move, as the page draws them."""

import json
from dataclasses import replace

import numpy as np
import pytest

from guidewire.anatomy.motion import motion_of
from guidewire.commands.drawn import walls_of
from guidewire.logs.logs import read_log
from guidewire.logs.runs import read_run
from guidewire.logs.surfaces import Surface
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session
from guidewire.viewer.live import ENDLESS, LiveFrames
from guidewire.viewer.recording import read_recording
from guidewire.viewer.tests.test_page_session import doubles, follow
from guidewire.viewer.tests.test_soft_walls import _padded

SCENE = {"solver": "direct", "integrator": "implicitEuler", "timeStep": 0.01, "maxSimulationSteps": 30,
         "guidewireLength": 40, "guidewireOffset": 0, "numberRodElements": 20, "wireRadius": 2e-4, "massDamping": 20,
         "proximalEnd": "clamped", "drive": "hold", "displacement": 0, "deltaThreshold": 0, "logFormat": "npz",
         "vessel": {"shape": "tube", "knots": [[0, 0, -10], [0, 0, 80]], "radius": 2, "motion":
                    {"period": 0.4, "phase": 0.2, "rigid": {"translation": [0.5, -1, 2], "rotation": [0, 0, 5]},
                     "breathing": {"heartRate": 20, "rigid": {"translation": [0, 0.5, 0]}}}}}


MOVED = """
import { Recording, unpackRecording } from "./recording.js";
const recording = new Recording(unpackRecording(numbers(data.block).buffer));
const moved = data.frames.map((frame) => {
  recording.moveWalls(frame);
  return [recording.at("time", frame)[0], told(recording.walls[0].vertices)];
});
console.log(JSON.stringify({ moved, moves: recording.moves, target: [...recording.targetAt(data.frames.at(-1))] }));
"""


def check_moved(recording, motion, wall, frames, tolerance):
    """Compare vertices and the target of the page with the motion; return the largest displacement, and the answer."""
    got = follow(MOVED, block=_padded(recording.to_bytes()), frames=frames)
    size = 0.0
    for time, moved in got["moved"]:
        motion.set_time(time)
        exact = motion.moved(wall.vertices)
        size = max(size, np.abs(exact - wall.vertices).max())
        np.testing.assert_allclose(doubles(moved).reshape(-1, 3), exact, atol=tolerance)
    assert got["moves"] == len(frames)
    return size, got


def triangles_of(vertices):
    count = len(vertices) // 3 * 3
    return Surface(vertices[:count], np.arange(count).reshape(-1, 3), np.zeros(count))


def test_the_page_moves_vertices_as_a_rigid_motion_does(live, tmp_path):
    """But for what is linear between 32 phases, 1 - cos(pi/32) of the amplitude, and cycles are added, without turns of
    one by the other."""
    scene = tmp_path / "scene.json"
    scene.write_text(json.dumps(SCENE))
    answer = live.run(Request("moving", scene, tmp_path / "run"))
    assert answer.exit_code == 0, answer.message
    run = read_run(tmp_path / "run")
    with Session(scene, native=False) as session:
        described = session.describe()
    wall = triangles_of(np.random.default_rng(1).uniform(-3.0, 3.0, (60, 3)))
    motion = motion_of(run.parameters)
    size, _ = check_moved(read_recording(run, [wall], 100, described, lambda _: []), motion, wall, [3, 17, 30], 0.02)
    assert size > 0.5
    log = read_log(run.folder, spheres="all")
    with walls_of(run, log, np.zeros(3), 100.0) as (rest, at):
        motion.set_time(float(log.time[20]))
        np.testing.assert_allclose(at(20)[0].vertices, motion.moved(rest[0].vertices), atol=1e-12)
        assert np.abs(at(20)[0].vertices - rest[0].vertices).max() > 0.1


def test_the_page_moves_a_coronary_tree_to_the_first_order_also_at_another_heart_rate(runner_command):
    """Within a twentieth of its radius. A heart rate that is changed counts from the phase that it finds."""
    with Session(ROOT / "params/coronary.json", hand=True, native=False, **ENDLESS) as session:
        frames = LiveFrames(session, "beat")
        wall = triangles_of(session.walls()[0].vertices[::60])
        motion = motion_of(session.parameters)
        before = session.step(steps=20)
        whole = frames.record(0.0)
        size, got = check_moved(replace(whole, walls=[("vessel", wall)]), motion, wall, [0, 1], 0.1)
        assert size > 5.0
        target = motion.moved(np.array(whole.described["target"]["points"][-1:]))[0]
        np.testing.assert_allclose(got["target"], target, atol=0.1)
        session.change(**{"vessel.motion.heartRate": 140})
        after = session.step(steps=5)
        assert before.vessel_phase == pytest.approx(0.4 * 70 / 60 % 1)
        assert after.vessel_phase == pytest.approx((before.vessel_phase + 0.1 * 140 / 60) % 1)
        channels = {one.name: one.values for one in frames.record(0.0).channels}
        assert channels["vesselPhase"][-1, 0] == after.vessel_phase
        assert np.linalg.norm(after.vessel_displacement) > 0.0
        # The page draws by the phase of a frame: at 140 beats as at the time that has this phase at 70.
        equal = after.vessel_phase * 60 / 70 + 60 / 70
        motion.set_time(equal)
        moved = follow(MOVED, block=_padded(replace(frames.record(0.0), walls=[("vessel", wall)]).to_bytes()),
                       frames=[1])["moved"][0][1]
        np.testing.assert_allclose(doubles(moved).reshape(-1, 3), motion.moved(wall.vertices), atol=0.1)
