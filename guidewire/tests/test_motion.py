"""Vessels that move: the map in Python is the runner's, and what is refused."""

import json

import numpy as np
import pytest

from guidewire.anatomy.motion import VesselMotion, beat_of_heart, motion_of, write_centreline
from guidewire.logs.logs import read_columns, read_log
from guidewire.logs.runs import read_run
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request

BEND = np.array([[0.0, 60.0 * (1 - np.cos(a)), 60.0 * np.sin(a)] for a in np.linspace(-0.2, 1.4, 33)])
SCENE = {"solver": "direct", "integrator": "implicitEuler", "timeStep": 0.02, "maxSimulationSteps": 40,
         "guidewireLength": 60, "guidewireOffset": -40, "numberRodElements": 60, "wireRadius": 2e-4, "massDamping": 20,
         "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": 0.03, "deltaThreshold": 0,
         "logEvery": 1, "logFormat": "npz", "rotation": [0, 0, 40], "position": [0, 0, 2],
         "vessel": {"shape": "tube", "knots": [[0, 0, -60], *BEND[6:].tolist()], "radius": 3, "smooth": True}}


@pytest.fixture
def scene(tmp_path):
    """A parameter file whose tube waves and breathes."""
    phases = np.arange(12) / 12
    share = np.clip(BEND[:, 2] / 40.0, 0.0, 1.0)**2
    waves = np.sin(2 * np.pi * (phases[:, None] - 0.01 * BEND[:, 2])) + np.sin(0.02 * np.pi * BEND[:, 2])
    moved = (waves * share)[..., None] * np.array([2.0, 1.0, -1.0])
    write_centreline(tmp_path / "wave.csv", [BEND], [moved], phases)
    own = json.loads(json.dumps(SCENE))
    own["vessel"]["motion"] = {"period": 0.5, "phase": 0.3, "centreline": "wave.csv", "breathing":
                               {"period": 3, "rigid": {"rotation": [2, 0, 3], "translation": [0.3, 0, 0]}}}
    file = tmp_path / "scene.json"
    file.write_text(json.dumps(own))
    return file


def test_the_map_is_that_of_the_runner(live, scene, tmp_path):
    answer = live.run(Request("moving", scene, tmp_path / "run"))
    assert answer.exit_code == 0, answer.message
    run = read_run(tmp_path / "run")
    log = read_log(run.folder, "all")
    moved = read_columns(run.folder, ["vesselDisplacement", "vesselPhase"], log.steps)
    motion = motion_of(run.parameters)
    largest = 0.0
    for time, tip, own, phase in zip(log.time[::5], log.positions[::5, -1], moved["vesselDisplacement"][::5],
                                     moved["vesselPhase"][::5]):
        motion.set_time(time)
        rest, slope = motion.at_rest(tip[None])
        np.testing.assert_allclose(own, tip - rest[0], atol=1e-9)
        np.testing.assert_allclose(motion.moved(rest)[0], tip, atol=1e-9)
        assert phase == pytest.approx((0.3 + time / 0.5) % 1.0)
        assert np.linalg.det(slope[0]) > 0.0
        largest = max(largest, np.linalg.norm(own))
    assert largest > 0.5
    assert run.summary["passages"] == 0


def test_the_centreline_goes_where_the_table_says(tmp_path):
    ostium, base, apex = np.zeros(3), np.array([20.0, -10.0, 0.0]), np.array([60.0, 40.0, -60.0])
    phases = np.arange(16) / 16
    points = np.linspace(ostium, apex, 40) + np.sin(np.linspace(0, 3, 40))[:, None] * np.array([0.0, 0.0, 12.0])
    moved = beat_of_heart([points], ostium, base, apex, phases)
    write_centreline(tmp_path / "beat.csv", [points], moved, phases)
    motion = VesselMotion({"heartRate": 70, "centreline": str(tmp_path / "beat.csv"), "rampTime": 0.0}, 1e-3)
    assert 5.0 < np.linalg.norm(moved[0], axis=2).max() < 20.0
    for k, phase in enumerate(phases):
        motion.set_time(phase * motion.period)
        np.testing.assert_allclose(motion.moved(points), points + moved[0][k], atol=0.02)


@pytest.mark.parametrize("change, expected", [
    ({"period": 0}, "motion.period = 0 is not allowed"),
    ({"heartRate": 60}, "no period beside it"),
    ({"phase": 2}, "a number from 0 to 1"),
    ({"rigid": {"translation": [1, 0, 0]}}, "one of rigid and centreline"),
    ({"rampTime": -1}, "a number >= 0 (s)"),
    ({"centreline": "none.csv"}, "none.csv"),
    ({"beats": 3}, "unknown key 'vessel.motion.beats'"),
    ({"breathing": {"period": 1, "centreline": "wave.csv"}}, "only one cycle may move the centreline"),
])
def test_what_is_wrong_is_said_in_one_line(live, scene, tmp_path, change, expected):
    own = json.loads(scene.read_text())
    own["vessel"]["motion"].update(change)
    scene.write_text(json.dumps(own))
    answer = live.run(Request("wrong", scene, tmp_path / "run"))
    assert answer.exit_code == 2 and expected in answer.message and "\n" not in answer.message.strip()


def test_a_field_that_folds_and_other_solvers_are_refused(live, scene, tmp_path):
    own = json.loads(scene.read_text())
    rows = (scene.parent / "wave.csv").read_text().splitlines()
    (scene.parent / "wave.csv").write_text("\n".join([rows[0]] + [
        ",".join([*row.split(",")[:6], *(str(60.0 * float(one)) for one in row.split(",")[6:])]) for row in rows[1:]]))
    answer = live.run(Request("folds", scene, tmp_path / "run"))
    assert answer.exit_code == 2 and "folds the vessel" in answer.message
    own["vessel"]["motion"] = {"period": 1, "rigid": {"translation": [1, 0, 0]}}
    scene.write_text(json.dumps({**own, "solver": "xpbd", "integrator": "verlet"}))
    answer = live.run(Request("other", scene, tmp_path / "run"))
    assert answer.exit_code == 2 and "vessel.motion" in answer.message and "solver direct" in answer.message


@pytest.mark.long("a run of the shipped tree")
def test_the_shipped_tree_beats_and_the_wire_follows(live, tmp_path):
    answer = live.run(Request("coronary", ROOT / "params/coronary.json", tmp_path / "run"))
    summary = json.loads((tmp_path / "run/summary.json").read_text())
    assert answer.exit_code == 0 and summary["reliable"] and summary["passages"] == 0
    assert summary["maxPenetration"] == 0.0 and summary["extremes"]["wallWork"] != 0.0
    assert summary["centreline"]["inLumen"] and summary["centreline"]["farthest"] > 80.0
