"""What a hand steers, saved as drive tables, moves the same instruments by the same bits."""

import json
import random
import subprocess

import numpy as np
import pytest

from guidewire.logs.logs import read_log
from guidewire.prepare import ROOT
from guidewire.runs import building
from guidewire.sessions.session import Session, SessionError

NATIVE = [False, pytest.param(True, marks=pytest.mark.skipif(not building.native_library(),
                                                             reason="the native library is not built"))]


def run_of_tables(runner_command, folder, file, tables, steps):
    """The log of a run that these tables drive."""
    words = []
    for number, table in enumerate(tables):
        (folder / f"steered-{number}.csv").write_text(table)
        words += [f"-{f'catheters[{number - 1}].' if number else ''}driveFile", str(folder / f"steered-{number}.csv")]
    subprocess.run([*runner_command, "-parameters", str(file), "-out", str(folder / "run"), "-insertionSpeed", "0",
                    *words, "-maxSimulationSteps", str(steps), "-deltaThreshold", "0", "-logEvery", "1"], check=True,
                   capture_output=True)
    return read_log(folder / "run", "all")


@pytest.mark.parametrize("scene", ["insertion-accurate.json", "catheter.json", pytest.param(
    "sheath.json", marks=pytest.mark.long("2 s; the same table in a mesh"))])
@pytest.mark.parametrize("native", NATIVE)
@pytest.mark.few(2)
def test_saved_tables_give_the_bits_that_were_steered(runner_command, tmp_path, scene, native):
    file = ROOT / "params" / scene
    dice = random.Random(5)
    with Session(file, hand=True, native=native, records_steering=True, maxSimulationSteps=10**9,
                 deltaThreshold=0) as session:
        speed = 40.0 * session.parameters["timeStep"] if session.hubs == 1 else 0.8
        session.step(speed, 0.1)
        shown = [session.reset()]
        for steps in (1, 4, 3, 1, 7, 70 if session.hubs > 1 else 16, 2):    # 70: a library makes 64 at once
            pushes = [speed * dice.choice([1.0, 0.4, -0.3, 0.123456, 0.0]) * steps for _ in range(session.hubs)]
            turns = [0.03 * dice.uniform(-1.0, 1.0) * steps for _ in pushes]
            shown.append(session.step(pushes, turns, steps) if dice.random() < 0.7 or session.hubs == 1
                         else session.step(pushes[1], turns[1], steps, hub=1))
        assert session.unrecorded == ""
        tables = session.drive_tables()
        session.change(massDamping=30.0)
        assert session.unrecorded == "massDamping was changed within the run: start anew to record"
        with pytest.raises(SessionError, match="massDamping was changed"):
            session.drive_tables()
        session.reset()
        assert session.unrecorded == "" and len(session.drive_tables()[0].splitlines()) == 3
    log = run_of_tables(runner_command, tmp_path, file, tables, shown[-1].step)
    for state in shown:
        np.testing.assert_array_equal(log.positions[state.step], state.positions, err_msg=f"step {state.step}")
        for k, catheter in enumerate(state.catheters):
            np.testing.assert_array_equal(log.catheters[k][state.step], catheter.positions)


@pytest.mark.parametrize("held, push, gone", [(0, 0.8, 8.0), (1, -0.8, -8.0), (0, -7.0, -50.0)])
@pytest.mark.few(1)
def test_saved_tables_of_a_hub_that_was_stopped_are_taken_and_repeat_it(runner_command, tmp_path, held, push, gone):
    """By the other hub, which it carries along, or as the wire's tip is in the catheter's first element; then it goes
    back."""
    file = tmp_path / "scene.json"
    tube = {"wireRadius": 8e-4, "lumenRadius": 6e-4, "youngsModulus": 4e9, "shearModulus": 1.5e9}
    file.write_text(json.dumps({
        "solver": "direct", "guidewireLength": 64.0, "numberRodElements": 8, "wireRadius": 4e-4, "massDamping": 20.0,
        "proximalEnd": "clamped", "drive": "displace", "timeStep": 0.01, "deltaThreshold": 0.0,
        "restCurvature": [5.0, 0.0, 0.0], "catheters": [{"start": 4.0, "length": 50.0, "elements": 5, **tube}]}))
    with Session(file, hand=True, native=False, records_steering=True, maxSimulationSteps=10**9) as session:
        shown = [session.state]
        shown += [session.step(part * push * steps, 0.01 * steps, steps, held)
                  for part, steps in ((1.0, 4), (1.0, 4), (0.5, 4), (-1.0, 2))]
        tables = session.drive_tables()
    hub = shown[-1].catheters[0] if held else shown[-1].hub
    assert hub.insertion == pytest.approx(1e-3 * (gone - 2.0 * push), abs=1e-12)
    log = run_of_tables(runner_command, tmp_path, file, tables, 14)
    for state in shown:
        np.testing.assert_allclose(log.positions[state.step], state.positions, rtol=0.0, atol=1e-6)
        np.testing.assert_allclose(log.catheters[0][state.step], state.catheters[0].positions, rtol=0.0, atol=1e-6)


def test_what_no_table_can_say_is_one_phrase(runner_command):
    with Session(ROOT / "params" / "insertion.json", hand=True, native=False, records_steering=True) as session:
        assert "solver direct" in session.unrecorded
    with Session(ROOT / "params" / "insertion-accurate.json", native=False, records_steering=True) as session:
        assert session.unrecorded == "no hand steers this run"
        session.restore(session.save())
        with pytest.raises(SessionError, match="no hand steers"):
            session.drive_tables()
    with Session(ROOT / "params" / "insertion-accurate.json", hand=True, native=False) as session:
        with pytest.raises(SessionError, match="does not record"):
            session.drive_tables()
