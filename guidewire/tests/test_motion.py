"""Vessels that move: the map in Python is the runner's, and what is refused."""

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from guidewire.anatomy.motion import VesselMotion, beat_of_heart, motion_of, write_centreline
from guidewire.logs.logs import read_columns, read_log
from guidewire.logs.runs import read_run
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request
from guidewire.sessions.session import Session

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


@pytest.mark.parametrize("size", [np.ones(3), np.array([-1.5, 1.5, 1.5])])
def test_the_centreline_goes_where_the_table_says(tmp_path, size):
    ostium, base, apex = np.zeros(3), np.array([20.0, -10.0, 0.0]), np.array([60.0, 40.0, -60.0])
    phases = np.arange(16) / 16
    points = np.linspace(ostium, apex, 40) + np.sin(np.linspace(0, 3, 40))[:, None] * np.array([0.0, 0.0, 12.0])
    moved = beat_of_heart([points], ostium, base, apex, phases)
    write_centreline(tmp_path / "beat.csv", [points], moved, phases)
    own = {"heartRate": 70, "centreline": str(tmp_path / "beat.csv"), "rampTime": 0.0}
    turn = Rotation.from_euler("xyz", [0.0, 0.0, 0.0] if size[0] == 1.0 else [0.3, 2.0, -1.0])

    def placed(x):
        return turn.apply(size * x) + [1.0, 2.0, 3.0]

    motion = VesselMotion(own, 1e-3, placed)
    assert 5.0 < np.linalg.norm(moved[0], axis=2).max() < 20.0
    for k, phase in enumerate(phases):
        motion.set_time(phase * motion.period)
        np.testing.assert_allclose(motion.moved(placed(points)), placed(points + moved[0][k]), atol=0.03)


def write_frames(folder, line, radius, maps):
    """Write a tube around a line (k, 3) as each map moves it, and its anatomy; return names and vertices at rest."""
    tangents = np.gradient(line, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    one = np.cross(tangents, [1.0, 0.0, 0.0])
    one /= np.linalg.norm(one, axis=1)[:, None]
    two = np.cross(tangents, one)
    angles = np.arange(16) * np.pi / 8
    rings = line[:, None] + radius * (np.cos(angles)[:, None] * one[:, None] + np.sin(angles)[:, None] * two[:, None])
    vertices = rings.reshape(-1, 3)
    k, j = np.meshgrid(np.arange(len(line) - 1), np.arange(16), indexing="ij")
    a, b = 16 * k + j, 16 * k + (j + 1) % 16
    faces = 1 + np.concatenate([np.stack(c, axis=-1).reshape(-1, 3) for c in ([a, b, a + 16], [b, b + 16, a + 16])])
    names = [f"frame{p}.obj" for p in range(len(maps))]
    for name, moved in zip(names, maps):
        rows = [f"v {x:.15g} {y:.15g} {z:.15g}" for x, y, z in moved(vertices)]
        (folder / name).write_text("\n".join(rows + [f"f {p} {q} {r}" for p, q, r in faces]))
    ends = [{"number": n, "name": f"end {n}", "centre": line[at].tolist(), "radius": radius, "direction": way.tolist(),
             "open": True, "point": at % len(line)} for n, at, way in ((1, 0, tangents[0]), (2, -1, -tangents[-1]))]
    (folder / "anatomy.json").write_text(json.dumps({"ends": ends, "centreline": {
        "points": np.c_[line, np.full(len(line), radius)].tolist(), "parents": list(range(-1, len(line) - 1)),
        "branches": [1] * len(line), "names": ["branch 1"]}}))
    return names, vertices


LINE = np.concatenate([np.c_[np.zeros((38, 2)), np.arange(-75.0, 0.0, 2.0)], BEND[5:]])


@pytest.fixture
def beating(tmp_path):
    """A mesh that bends, with its frames: a parameter file."""
    maps = [lambda x, s=np.sin(2 * np.pi * p / 10): x + s * np.clip(x[:, 2:] / 40, 0, 2)**2 * [2, -1, 0.5]
            for p in range(10)]
    names, _ = write_frames(tmp_path, LINE, 3.0, maps)
    own = json.loads(json.dumps(SCENE))
    own["vessel"] = {"shape": "mesh", "file": names[0], "anatomy": "anatomy.json",
                     "motion": {"period": 0.5, "phase": 0.3, "frames": names}}
    file = tmp_path / "frames.json"
    file.write_text(json.dumps(own))
    return file


def test_frames_move_a_wire_as_their_fit_in_python_says(live, beating, tmp_path):
    answer = live.run(Request("frames", beating, tmp_path / "run"))
    assert answer.exit_code == 0, answer.message
    run = read_run(tmp_path / "run")
    assert any("beside the fitted motion" in line for line in run.summary["warnings"])
    log = read_log(run.folder, "all")
    moved = read_columns(run.folder, ["vesselDisplacement"], log.steps)["vesselDisplacement"]
    motion = motion_of(run.parameters)
    for time, tip, own in zip(log.time[::8], log.positions[::8, -1], moved[::8]):
        motion.set_time(time)
        np.testing.assert_allclose(own, tip - motion.at_rest(tip[None])[0][0], atol=1e-8)
    assert np.linalg.norm(moved, axis=1).max() > 0.3


def test_twist_and_width_of_frames_are_those_of_the_closed_form(tmp_path):
    line, phases = np.c_[np.zeros((41, 2)), np.linspace(0, 80, 41)], np.arange(12) / 12

    def at(phase):
        def moved(x):
            angle = 0.01 * np.sin(2 * np.pi * phase) * x[:, 2]
            wide = 1 + 0.1 * np.sin(2 * np.pi * phase)
            return np.c_[wide * (np.cos(angle) * x[:, 0] - np.sin(angle) * x[:, 1]),
                         wide * (np.sin(angle) * x[:, 0] + np.cos(angle) * x[:, 1]), x[:, 2] * (1 + 0.1 * (wide - 1))]
        return moved

    names, rest = write_frames(tmp_path, line, 3.0, [at(phase) for phase in phases])
    motion = VesselMotion({"period": 1, "rampTime": 0, "frames": [str(tmp_path / name) for name in names]}, 1e-3,
                          vessel={"anatomy": str(tmp_path / "anatomy.json")})
    for phase in (0.25, 0.75, 0.375):    # the last one lies between frames
        motion.set_time(phase)
        np.testing.assert_allclose(motion.moved(rest[80:-80]), at(phase)(rest[80:-80]), atol=0.01)


@pytest.mark.parametrize("change, expected", [
    (lambda names: names[:2], "a list of three or more meshes"), (lambda names: [], "a list of three or more meshes"),
    (lambda names: [names[0], "none.obj", names[2]], "none.obj"), (lambda names: names[:2] + ["ring.obj"], "is empty"),
    (lambda names: names[:2] + ["other.obj"], "has other triangles than"),
    (lambda names: names[3:], "is not the vessel at rest"), (lambda names: [1, 2, 3], "a list of texts"),
])
def test_frames_that_do_not_fit_are_refused(live, beating, tmp_path, change, expected):
    own = json.loads(beating.read_text())
    (tmp_path / "ring.obj").write_text("")
    (tmp_path / "other.obj").write_text((tmp_path / "frame2.obj").read_text().rpartition("\n")[0])
    own["vessel"]["motion"]["frames"] = change(own["vessel"]["motion"]["frames"])
    beating.write_text(json.dumps(own))
    answer = live.run(Request("wrong", beating, tmp_path / "run"))
    assert answer.exit_code == 2 and expected in answer.message and "\n" not in answer.message.strip()


@pytest.mark.parametrize("change, expected", [
    ({"period": 0}, "motion.period = 0 is not allowed"),
    ({"heartRate": 60}, "no period beside it"),
    ({"phase": 2}, "a number from 0 to 1"),
    ({"rigid": {"translation": [1, 0, 0]}}, "one of rigid, centreline and frames"),
    ({"rampTime": -1}, "a number >= 0 (s)"),
    ({"centreline": "none.csv"}, "none.csv"),
    ({"centreline": "turned.csv"}, "a table whose scale is > 0 everywhere"),
    ({"beats": 3}, "unknown key 'vessel.motion.beats'"),
    ({"breathing": {"period": 1, "centreline": "wave.csv"}}, "only one cycle may move the centreline"),
])
def test_what_is_wrong_is_said_in_one_line(live, scene, tmp_path, change, expected):
    own = json.loads(scene.read_text())
    own["vessel"]["motion"].update(change)
    rows = [f"{s},{p},0,0,{s},{0.5 - p}" for s in (0.0, 0.1) for p in (0.0, 0.25, 0.75)]
    (scene.parent / "turned.csv").write_text("\n".join(["station,phase,x,y,z,scale", *rows]))
    scene.write_text(json.dumps(own))
    answer = live.run(Request("wrong", scene, tmp_path / "run"))
    assert answer.exit_code == 2 and expected in answer.message and "\n" not in answer.message.strip()


def test_a_field_that_folds_and_other_solvers_are_refused(live, scene, tmp_path):
    own = json.loads(scene.read_text())
    own["vessel"]["motion"]["breathing"]["period"] = 12.0    # a whole number of beats
    scene.write_text(json.dumps(own))
    rows = [row.split(",") for row in (scene.parent / "wave.csv").read_text().splitlines()]
    phase = rows[0].index("phase")
    (scene.parent / "wave.csv").write_text("\n".join(",".join(row) for row in [rows[0], *(
        [*row[:6], *(str((60.0 if float(row[phase]) > 0.7 else 0.0) * float(one)) for one in row[6:])]
        for row in rows[1:])]))
    answer = live.run(Request("folds", scene, tmp_path / "run"))
    assert answer.exit_code == 2 and "folds the vessel" in answer.message
    own["vessel"]["motion"] = {"period": 1, "rigid": {"translation": [1, 0, 0]}}
    scene.write_text(json.dumps({**own, "solver": "xpbd", "integrator": "verlet"}))
    answer = live.run(Request("other", scene, tmp_path / "run"))
    assert answer.exit_code == 2 and "vessel.motion" in answer.message and "solver direct" in answer.message


def test_a_lumen_that_narrows_leaves_the_wire_out_of_its_wall(live, tmp_path):
    """By a fifth, around a wire that lies on its wall: gaps at rest would let it a fifth of its radius into it."""
    phases, line = np.arange(8) / 8, np.c_[np.zeros((11, 2)), np.linspace(-60, 60, 11)]
    scales = np.tile(0.9 - 0.1 * np.cos(2 * np.pi * (phases - 0.5))[:, None], (1, 11))
    write_centreline(tmp_path / "narrow.csv", [line], [np.zeros((8, 11, 3))], phases, [scales])
    scene = {**SCENE, "insertionSpeed": 0, "gravity": [0, -9.81, 0], "wireRadius": 4e-4, "youngsModulus": 1e9,
             "shearModulus": 4e8, "guidewireLength": 100, "guidewireOffset": -50, "numberRodElements": 50,
             "rotation": [0, 0, 0], "position": [0, 0, 0],
             "vessel": {"shape": "tube", "knots": [[0, 0, -60], [0, 0, 60]], "radius": 1,
                        "motion": {"period": 0.4, "rampTime": 0, "centreline": "narrow.csv"}}}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    answer = live.run(Request("narrow", tmp_path / "scene.json", tmp_path / "run"))
    assert answer.exit_code == 0, answer.message
    log, summary = read_log(tmp_path / "run", "all"), json.loads((tmp_path / "run/summary.json").read_text())
    assert summary["maxPenetration"] == 0.0 and summary["outcome"] == "finished"
    deepest = np.abs(log.positions[:, :, :2]).max(axis=(1, 2))
    wide = 0.9 - 0.1 * np.cos(2 * np.pi * (log.time / 0.4 - 0.5))
    assert (deepest + 0.4 < wide + 1e-9).all() and (wide - deepest).min() < 0.5
    closed = np.where(np.isin(np.arange(8), (3, 4))[:, None], 0.01, np.ones((8, 11)))    # splines are below 0 between
    for given, expected in ((1 - 4.0 * (1 - scales), "by 1/0.2 thicker for the lumen that narrows, starts outside"),
                            (closed, "the motion closes the vessel")):
        write_centreline(tmp_path / "narrow.csv", [line], [np.zeros((8, 11, 3))], phases, [given])
        answer = live.run(Request("wrong", tmp_path / "scene.json", tmp_path / "wrong"))
        assert answer.exit_code == 2 and expected in answer.message


def test_contrast_agent_goes_with_its_vessel(tmp_path):
    """A vessel that moves along itself is seen as the one that stands still is from a place that goes along."""
    names, _ = write_frames(tmp_path, np.c_[np.zeros((61, 2)), np.linspace(-60, 60, 61)], 3.0, [lambda x: x])
    scene = {**SCENE, "rotation": [0, 0, 0], "position": [0, 0, 0], "timeStep": 0.1, "insertionSpeed": 0}
    pictures = []
    for motion in ({}, {"motion": {"period": 0.8, "rampTime": 0, "rigid": {"translation": [0, 0, 12]}}}):
        vessel = {"shape": "mesh", "file": str(tmp_path / names[0]), "anatomy": str(tmp_path / "anatomy.json"),
                  **motion}
        with Session(**{**scene, "vessel": vessel}) as session:
            session.step(steps=2)
            session.inject(1.0, 10.0, None)
            session.agent(0.1)
            pictures.append(session.picture(vessel="injected", attenuation=0, field_of_view=60, pixels=96,
                                            centre=[0, 0, 12 if motion else 0]).astype(int))
    seen = [(picture < 150).sum() for picture in pictures]
    assert 100 < seen[0] < 96 * 10 / 2 and np.abs(pictures[0] - pictures[1]).mean() < 0.3, seen


@pytest.mark.long("a run of the shipped tree")
def test_the_shipped_tree_beats_and_the_wire_follows(live, tmp_path):
    answer = live.run(Request("coronary", ROOT / "params/coronary.json", tmp_path / "run"))
    summary = json.loads((tmp_path / "run/summary.json").read_text())
    assert answer.exit_code == 0 and summary["reliable"] and summary["passages"] == 0
    assert summary["maxPenetration"] == 0.0 and summary["extremes"]["wallWork"] != 0.0
    assert summary["centreline"]["inLumen"] and summary["centreline"]["farthest"] > 80.0
