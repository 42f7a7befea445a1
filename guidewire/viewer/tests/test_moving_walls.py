"""Vessels that move, as the page draws them."""

import json

import numpy as np

from guidewire.anatomy.motion import motion_of
from guidewire.commands.drawn import walls_of
from guidewire.logs.logs import read_log
from guidewire.logs.runs import read_run
from guidewire.logs.surfaces import Surface
from guidewire.runs.runner import Request
from guidewire.viewer.recording import read_recording
from guidewire.viewer.tests.test_page_session import doubles, follow
from guidewire.viewer.tests.test_soft_walls import _padded

SCENE = {"solver": "direct", "integrator": "implicitEuler", "timeStep": 0.01, "maxSimulationSteps": 30,
         "guidewireLength": 40, "guidewireOffset": 0, "numberRodElements": 20, "wireRadius": 2e-4, "massDamping": 20,
         "proximalEnd": "clamped", "drive": "hold", "displacement": 0, "deltaThreshold": 0, "logFormat": "npz",
         "vessel": {"shape": "tube", "knots": [[0, 0, -10], [0, 0, 80]], "radius": 2, "motion":
                    {"period": 0.4, "phase": 0.2, "rigid": {"translation": [0.5, -1, 2], "rotation": [0, 0, 5]},
                     "breathing": {"heartRate": 20, "rigid": {"translation": [0, 0.5, 0]}}}}}


def test_the_page_moves_vertices_as_the_motion_does(live, tmp_path):
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    answer = live.run(Request("moving", tmp_path / "scene.json", tmp_path / "run"))
    assert answer.exit_code == 0, answer.message
    run = read_run(tmp_path / "run")
    vertices = np.random.default_rng(1).uniform(-3.0, 3.0, (60, 3))
    wall = Surface(vertices, np.arange(60).reshape(20, 3), np.zeros(60))
    recording = read_recording(run, [wall], 100, {}, lambda _: [])
    got = follow("""
        import { Recording, unpackRecording } from "./recording.js";
        const recording = new Recording(unpackRecording(numbers(data.block).buffer));
        const moved = [3, recording.count - 1].map((frame) => {
          recording.moveWalls(frame);
          return [recording.at("time", frame)[0], told(recording.walls[0].vertices)];
        });
        console.log(JSON.stringify({ moved, moves: recording.moves }));
        """, block=_padded(recording.to_bytes()))
    motion = motion_of(run.parameters)
    for time, moved in got["moved"]:
        motion.set_time(time)
        # Linear between 32 phases: 1 - cos(pi/32) of the amplitude; cycles are added, without turns of one by the other.
        np.testing.assert_allclose(doubles(moved).reshape(-1, 3), motion.moved(vertices), atol=0.02)
    assert got["moves"] == 2
    log = read_log(run.folder, spheres="all")
    with walls_of(run, log, np.zeros(3), 100.0) as (rest, at):
        motion.set_time(float(log.time[20]))
        np.testing.assert_allclose(at(20)[0].vertices, motion.moved(rest[0].vertices), atol=1e-12)
        assert np.abs(at(20)[0].vertices - rest[0].vertices).max() > 0.1
