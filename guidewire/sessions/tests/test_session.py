"""Sessions against runs and against each other, what they refuse, and scripts that the door starts."""

import json
import os
import pickle
import re
import signal
import subprocess
import sys

import numpy as np
import pytest

from guidewire.logs.logs import read_log
from guidewire.prepare import ROOT
from guidewire.runs import building
from guidewire.sessions import session_hosts
from guidewire.sessions.session import Session, SessionError

WIRE = {"numberRodElements": 8, "constraintSolverSteps": 20, "deltaThreshold": 0, "displacement": 0}
TUBE = {**WIRE, "guidewireOffset": -310, "sphereRadius": 4, "collisionStiffness": 0.1, "damping": 0.1,
        "vessel": {"shape": "tube", "knots": [[0, 0, -330], [0, 0, 0], [0, 40, 60]], "radius": 10}}
ACCURATE = ROOT / "params" / "insertion-accurate.json"
MATERIAL = {"solver": "direct", "proximalEnd": "clamped", "numberRodElements": 8, "gravity": [0, -9.81, 0],
            "maxSimulationSteps": 5, "initialState": "equilibrium", "deltaThreshold": 0}
MOTION = ("positions", "velocities", "orientations", "angular_velocities", "contact_forces")


def assert_same_bits(a, b):
    for name in MOTION:
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), err_msg=name)
    assert (a.step, a.time, a.outcome, a.prediction_error) == (b.step, b.time, b.outcome, b.prediction_error)


@pytest.mark.parametrize("scene", [{**TUBE, "drive": "push", "displacementPerStep": 0.7}, MATERIAL],
                         ids=["gains in a tube", "material"])
def test_a_session_without_a_hand_takes_the_steps_of_a_run(runner_command, tmp_path, scene):
    scene = {**scene, "maxSimulationSteps": 6, "logOrientations": True}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    subprocess.run([*runner_command, "-parameters", str(tmp_path / "scene.json"), "-out", str(tmp_path / "run")],
                   check=True, capture_output=True)
    log = read_log(tmp_path / "run", "all", velocities=True)
    with Session(tmp_path / "scene.json", hand=False) as session:
        states = [session.state, *(session.step() for _ in range(6))]
    np.testing.assert_array_equal([state.positions for state in states], log.positions)
    np.testing.assert_array_equal([state.velocities for state in states], log.velocities)
    np.testing.assert_array_equal([state.time for state in states], log.time)
    assert [state.outcome for state in states] == [None] * 6 + ["finished"]
    assert states[-1].reason == "all 6 steps are done"


def test_what_a_hand_asks_is_made_in_equal_parts_along_and_about_the_first_element():
    with Session(**WIRE) as session:
        assert session.hand and session.parameters["numberRodElements"] == 8
        before = session.state
        state = session.step(push=3.0, turn=0.6, steps=4)
    assert state.step == 4
    assert state.positions[0] - before.positions[0] == pytest.approx([0.0, 0.0, 3.0])
    assert state.orientations[0] == pytest.approx([0.0, 0.0, np.sin(0.3), np.cos(0.3)])
    assert state.positions.shape == (9, 3) and state.orientations.shape == (8, 4)
    assert state.angular_velocities.shape == (8, 3) and not state.contact_forces.any()
    assert (state.curvature, state.couple, state.strain, state.force) == (None, None, None, None)


def test_a_hand_pushes_and_turns_a_wire_with_a_material_and_reads_off_what_it_feels():
    scene = {**MATERIAL, "initialState": "straight", "gravity": [0, 0, 0], "drive": "displace"}
    with Session(**scene, hand=True) as session:
        hub = session.step(push=2.0, turn=0.4, steps=4).hub
        assert (hub.insertion, hub.turn) == (pytest.approx(2e-3), pytest.approx(0.4))
        assert hub.tip_position == pytest.approx(session.state.positions[-1])
        assert hub.turn + hub.twist == pytest.approx(0.4) and hub.tip_direction == pytest.approx([0.0, 0.0, 1.0])


def test_a_hand_takes_a_wire_out_of_its_sheath_whatever_its_files_drive_would_ask_for():
    endless = {"maxSimulationSteps": 1_000_000_000, "deltaThreshold": 0}
    with Session(ROOT / "params" / "sheath.json", hand=True, **endless) as session:
        start = session.state
        assert start.energy.kinetic == 0.0 and start.energy.elastic > 0.0    # its bent tip is straight at first
        state = session.step(push=1.0, steps=3)
    assert state.hub.insertion == pytest.approx(1e-3) and state.hub.length_in_body == pytest.approx(0.031, abs=1e-6)
    assert state.energy.kinetic > 0.0 and state.energy.elastic < start.energy.elastic
    with pytest.raises(SessionError, match="is longer than the wire"):
        Session(ROOT / "params" / "sheath.json", hand=False, **endless)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_sessions_side_by_side_save_restore_and_reset_to_the_same_bits(friction):
    scene = {**TUBE, "vessel": {**TUBE["vessel"], "frictionCoefficient": friction}}
    with Session(**scene) as one, Session(**scene) as other:
        start = one.state
        one.step(push=40.0, steps=20)
        saved = one.save()
        middle = one.state
        end = one.step(push=30.0, turn=1.0, steps=15)
        assert end.contact_forces.any(), "the scene has contacts"
        assert_same_bits(other.state, start)
        assert_same_bits(other.restore(saved), middle)
        assert_same_bits(other.step(push=30.0, turn=1.0, steps=15), end)
        assert_same_bits(one.restore(saved), middle)
        assert_same_bits(one.reset(), start)
        one.step(push=40.0, steps=20)
        assert_same_bits(one.step(push=30.0, turn=1.0, steps=15), end)


def test_what_is_changed_holds_from_there_on_and_what_cannot_be_changes_nothing():
    with Session(**WIRE) as session, Session(**WIRE) as other:
        session.step(push=5.0, steps=5)
        before = session.state
        changed = session.change(timeStep=2 * session.parameters["timeStep"], damping=0.2)
        np.testing.assert_array_equal(changed.positions, before.positions)
        assert session.parameters["damping"] == 0.2
        assert session.step().time == pytest.approx(before.time + session.parameters["timeStep"])
        now = session.state
        for wrong in ({"damping": -1}, {"solver": "direct"}, {"nonsense": 1}):
            with pytest.raises(SessionError) as refused:
                session.change(**wrong)
            assert "\n" not in str(refused.value)
            assert_same_bits(session.state, now)
        assert not np.array_equal(session.step(push=1.0).positions, other.step(push=6.0, steps=6).positions)
        assert session.reset().step == 0 and session.parameters["damping"] == 0.2


@pytest.mark.parametrize("integrator", ["bdf2", "esdirk3", "implicitEuler"])
@pytest.mark.few(1)
def test_damping_of_the_material_begins_in_the_midst_of_a_motion_that_mass_alone_damps(integrator):
    """As if there had been next to none before; also where it was there, was taken away and comes again."""
    wire = {**MATERIAL, "initialState": "straight", "maxSimulationSteps": 100, "integrator": integrator,
            "timeStep": 0.002, "massDamping": 5.0}
    found = []
    for none in (0.0, 1e-9):
        with Session(**wire, materialDamping=none, native=False) as session:
            for now in (0.02, none, 0.02):
                session.step(steps=5)
                session.change(materialDamping=now)
            found.append(session.step(steps=5))
    assert found[0].outcome is None
    assert np.abs(found[0].positions - found[1].positions).max() < 2e-3 * np.abs(found[1].positions[:, 1]).max()


@pytest.mark.parametrize("sheath", [{"exit": [0.0, 0.0, -15.0]}, {"exit": [0.0, 0.0, -2.0]}, {}])
def test_an_exit_that_is_changed_is_that_of_a_state_saved_since(sheath):
    with Session(ROOT / "params" / "sheath.json", hand=True) as session:
        session.step(push=1.0, steps=5)
        changed = session.change(sheath=sheath)
        saved = session.save()
        end = session.step(push=1.0, turn=0.1, steps=5)
        assert end.hub.length_in_body == pytest.approx(changed.hub.length_in_body + 1e-3, abs=1e-6)
        assert session.restore(saved).hub.length_in_body == changed.hub.length_in_body
        assert_same_bits(session.step(push=1.0, turn=0.1, steps=5), end)


def test_a_mesh_that_stays_has_the_friction_of_the_last_change_that_was_made():
    """Its triangles are examined once; a refused change leaves the wall of the run as it is."""
    with Session(ACCURATE, native=False) as session, Session(ACCURATE, native=False) as other:
        for one in (session, other):
            one.step(steps=90)
        with pytest.raises(SessionError):
            session.change(**{"vessel.frictionCoefficient": 0.4, "numberRodElements": 30})
        assert_same_bits(session.step(steps=20), other.step(steps=20))
        session.change(**{"vessel.frictionCoefficient": 0.4})
        rubbed, free = session.step(steps=20), other.step(steps=20)
        assert np.abs(rubbed.positions - free.positions).max() > 1e-3
        assert_same_bits(session.reset(), other.reset())
        other.change(**{"vessel.frictionCoefficient": 0.4})
        assert_same_bits(session.step(steps=110), other.step(steps=110))


def test_a_material_states_its_forces_and_is_carried_by_its_support():
    with Session(**MATERIAL) as session:
        assert not session.hand
        state = session.step()
        values = session.parameters
    weight = 9.81 * values["density"] * np.pi * values["wireRadius"]**2 * 1e-3 * values["guidewireLength"]
    assert state.reaction == pytest.approx([0.0, weight, 0.0], rel=1e-3, abs=1e-6 * weight)
    assert state.force.shape == state.strain.shape == (8, 3)
    assert state.curvature.shape == state.couple.shape == (9, 3)
    # The couple at the clamp carries the weight of a wire that is nearly straight at its middle.
    lever = 1e-3 * (state.positions[:, 2].mean() - state.positions[0, 2])
    assert abs(state.couple[0, 0]) == pytest.approx(weight * lever, rel=0.02)


def test_a_step_after_the_end_says_that_the_run_has_ended_and_a_reset_begins_anew():
    with Session(**WIRE, hand=False, maxSimulationSteps=2) as session:
        ended = session.step(steps=5)
        assert (ended.step, ended.outcome) == (2, "finished")
        with pytest.raises(SessionError, match=r"^the run has ended after step 2 \(finished: .*\): reset or restore"):
            session.step()
        assert_same_bits(session.state, ended)
        assert session.reset().outcome is None and session.step().step == 1


@pytest.mark.parametrize("scene", [
    WIRE, {**MATERIAL, "hand": True, "initialState": "straight", "gravity": [0, 0, 0]}], ids=["gains", "material"])
def test_what_a_hand_steers_goes_on_beyond_maxSimulationSteps(scene):
    with Session(**{**scene, "maxSimulationSteps": 2, "deltaThreshold": 0.0}) as session:
        state = session.step(push=0.1, steps=5)
        assert (state.step, state.outcome) == (5, None)


@pytest.mark.parametrize("asked, said", [
    ({"steps": 1.5}, "steps = 1.5 is not allowed"), ({"steps": True}, "steps = True"), ({"steps": "2"}, "steps = '2'"),
    ({"push": "a"}, "push = 'a' is not allowed"), ({"turn": None}, "turn = None"),
    ({"push": [1.0, 2.0]}, "push = [1.0, 2.0]"),
    ({"push": True}, "push = True"),
])
def test_a_step_of_something_else_than_numbers_is_refused_in_one_line(asked, said):
    with Session(**WIRE) as session:
        with pytest.raises(SessionError) as refused:
            session.step(**asked)
        assert said in str(refused.value) and "\n" not in str(refused.value)
        assert session.step(push=np.float32(0.5), steps=np.int64(2)).step == 2


def test_parts_of_parameters_are_laid_over_the_files_and_changed_while_the_wire_goes_on():
    vessel = {"shape": "tube", "knots": [[0, 0, -400], [0, 0, 400]], "radius": 30.0}
    with Session(vessel=vessel, **{"vessel.radius": 25.0, "gravity[1]": -1.0}) as session:
        assert (session.parameters["vessel"]["radius"], session.parameters["gravity"][1]) == (25.0, -1.0)
        before = session.step(steps=2)
        after = session.change(**{"vessel.frictionCoefficient": 0.1})
        assert (after.step, session.parameters["vessel"]["frictionCoefficient"]) == (before.step, 0.1)
        assert session.parameters["vessel"]["radius"] == 25.0
        for change, said in (({"vessel.radius": 0.001}, "lumen"), ({"vessel.colour": 1}, "unknown key 'vessel.colour'"),
                             ({"obstacles[0].radius": 1}, "obstacles is null")):
            with pytest.raises(SessionError, match=re.escape(said)):
                session.change(**change)
        session.change(vessel={**vessel, "radius": 28.0})
        assert session.parameters["vessel"]["radius"] == 28.0 and session.step().step == before.step + 1


@pytest.mark.parametrize("arguments, words", [
    ({"timestep": 0.1}, ["'timestep'", "'timeStep'"]), ({"timeStep": -1}, ["timeStep = -1", "number > 0"]),
    ({"file": "nowhere.json"}, ["nowhere.json"]), ({"solver": "xpbd", "hand": True}, ["xpbd", "not steered"]),
    ({"solver": "direct", "hand": True}, ["proximalEnd", "clamped"]),
    ({"gravity": np.array([1.0, 2.0])}, ["gravity = [1.0,2.0]", "three numbers"]),
])
def test_what_cannot_be_opened_is_one_line(arguments, words):
    with pytest.raises(SessionError) as refused:
        Session(**arguments)
    line = str(refused.value)
    assert "\n" not in line
    for word in words:
        assert word in line


def test_what_cannot_be_done_is_one_line_and_the_session_goes_on():
    with Session(**MATERIAL) as session, Session(**WIRE) as other:
        before = session.state
        for wrong, words in (
            (lambda: session.step(push=1.0), "push and turn need a steered session"),
            (lambda: session.step(steps=0), "steps = 0 is not allowed"),
            (lambda: session.step(steps=10**12), "steps = 1000000000000 is not allowed"),
            (lambda: session.step(turn=float("nan")), "turn = nan is not allowed"),
            (lambda: session.change(timeStep=float("nan")), "^timeStep = nan is not allowed: needs a finite number$"),
            (lambda: session.change(timeStep=float("inf")), "^timeStep = inf is not allowed"),
            (lambda: session.restore(other.save()), "not saved by a session with these parameters"),
            (lambda: session.restore(session.save()[:-8]), "is incomplete"),
            (lambda: session.restore(b""), "is incomplete"),
            (lambda: session.restore("text"), "the bytes that save gave"),
        ):
            with pytest.raises(SessionError, match=words) as refused:
                wrong()
            assert "\n" not in str(refused.value)
        assert_same_bits(session.restore(session.save()), before)
    with pytest.raises(SessionError, match="closed"):
        session.step()
    assert_same_bits(session.state, before)


def test_a_runner_that_dies_is_said_and_leaves_no_process():
    with Session(**WIRE, native=False) as session:
        process = session._host.process
        process.send_signal(signal.SIGKILL)
        with pytest.raises(SessionError, match="killed by signal 9"):
            session.step()
        assert process.poll() is not None
    with Session(**WIRE, native=False) as session:
        process = session._host.process
    assert process.poll() == 0


@pytest.mark.parametrize("program, said", [
    ("raise SystemExit(3)", r"ended \(exit code 3\)"),
    ("import os, time; os.close(0); os.close(1); time.sleep(0.2); os._exit(7)", r"ended \(exit code 7\)"),
    ("input(); print('{\"id\": ', end=''); raise SystemExit(4)", r"ended \(exit code 4\)"),
    ("input(); print('Unhandled exception'); input()", "wrote 'Unhandled exception' instead of an answer"),
])
@pytest.mark.parametrize("is_late", [False, True])
def test_a_runner_that_ends_at_once_says_how(monkeypatch, program, said, is_late):
    """Whether it dies before or after the request is written must not matter."""
    class Process(session_hosts.Process):
        def __init__(self, command):
            super().__init__(command)
            if is_late and "input" not in program:
                self.process.wait()

    monkeypatch.setattr(session_hosts, "Process", Process)
    monkeypatch.setattr(building, "build", lambda *words: [sys.executable, "-c", program])
    with pytest.raises(SessionError, match=said):
        Session(**WIRE, native=False)


def test_an_older_processor_takes_runners(monkeypatch):
    monkeypatch.setattr(session_hosts, "has_avx2", lambda: False)
    monkeypatch.setattr(building, "native_library", lambda: ROOT / "library.so")
    with Session(**WIRE) as session:
        assert session.step().step == 1 and isinstance(session._host, session_hosts.Process)
    with pytest.raises(SessionError, match="needs a processor of x86-64-v3"):
        Session(**WIRE, native=True)


def test_a_key_of_a_file_that_is_passed_over_is_warned_of(tmp_path):
    (tmp_path / "scene.json").write_text(json.dumps({**MATERIAL, "bendStiffness": 0.2}))
    with pytest.warns(UserWarning, match="bendStiffness"):
        Session(tmp_path / "scene.json").close()


SCRIPT = """
import sys
from guidewire import Session, read_log, read_run
with Session(numberRodElements=3, constraintSolverSteps=1) as session:
    print(session.step(push=1.0).step, *sys.argv[1:])
sys.exit(7)
"""


def test_a_script_anywhere_has_the_sessions_of_guidewire(runner_command, tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    done = subprocess.run([sys.executable, str(ROOT / "guidewire.py"), "python", "script.py", "-x", "--set", "1"],
                          cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (7, "1 -x --set 1\n", "")


def test_a_script_that_is_not_there_is_one_line(tmp_path):
    done = subprocess.run([sys.executable, str(ROOT / "guidewire.py"), "python", "script.py"], cwd=tmp_path,
                          capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (2, "guidewire: script.py: no such file: give a Python script\n")


def test_the_module_lends_what_it_names_and_nothing_else():
    check = ("import guidewire; from guidewire import *; print(*[name for name in guidewire.__all__ "
             "if getattr(guidewire, name) is not globals()[name]]); guidewire.nothing")
    done = subprocess.run([sys.executable, "-c", check], capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert done.stdout == "\n" and "has no attribute 'nothing'" in done.stderr


def test_pictures_show_the_wire_and_are_the_same_of_a_state_and_of_its_positions():
    with Session(**TUBE) as session:
        before = session.picture(pixels=64, field_of_view=100, centre=[0, 0, -20])
        start = session.state
        session.step(push=60.0, steps=30)
        after = session.picture(pixels=64, field_of_view=100, centre=[0, 0, -20])
        assert before.shape == (64, 64) and before.dtype == np.uint8
        assert (after < before).sum() > 20, "the wire has come into the picture"
        np.testing.assert_array_equal(start.picture(pixels=64, field_of_view=100, centre=[0, 0, -20]), before)
        noisy = [session.picture(pixels=32, noise=0.1, seed=seed) for seed in (1, 1, 2)]
        np.testing.assert_array_equal(noisy[0], noisy[1])
        assert (noisy[0] != noisy[2]).mean() > 0.5
        assert session.picture(vessel="contrast").min() < session.picture(vessel="none", attenuation=0).min()
    with pytest.raises(SessionError, match="closed"):
        start.picture()
    with pytest.raises(SessionError, match="no session"):
        pickle.loads(pickle.dumps(start)).picture()


@pytest.mark.parametrize("wrong, said", [
    ({"pixels": 0}, "pixels = 0 is not allowed: needs a whole number from 1 to 2048"), ({"pixels": 9.5}, "pixels"),
    ({"lao": 361}, "lao"), ({"cranial": "up"}, "cranial"), ({"centre": [0, 0]}, "centre"),
    ({"vessel": "red"}, "vessel"),
    ({"field_of_view": 0}, "fieldOfView"), ({"noise": -1}, "noise"), ({"seed": -1}, "seed"), ({"blur": 1e9}, "blur"),
    ({"background": 0}, "background"), ({"colour": 1}, "view has no colour"), ({"contrast": float("inf")}, "contrast"),
])
def test_a_picture_that_cannot_be_taken_is_one_line_and_changes_nothing(shared, wrong, said):
    with pytest.raises(SessionError) as refused:
        shared.picture(**wrong)
    assert said in str(refused.value) and "\n" not in str(refused.value)
    assert shared.picture(pixels=8).shape == (8, 8)


@pytest.fixture(scope="module")
def shared():
    """A session of a wire without walls."""
    with Session(**WIRE) as session:
        yield session
