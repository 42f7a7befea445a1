"""What a page steers, saved as a drive table, moves the same wire by the same bits."""

import json
import math
import random
import subprocess

import numpy as np
import pytest

from guidewire.logs.logs import read_log
from guidewire.prepare import ROOT
from guidewire.runs import building
from guidewire.sessions.session import Session
from guidewire.viewer.held import HeldInstruments
from guidewire.sessions.steered import Steered, exact_push, exact_turn

SCENES = [pytest.param("insertion-accurate.json", id="a mesh"),
          pytest.param("sheath.json", id="a sheath", marks=pytest.mark.long("2 s; the same table in a mesh"))]


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.few(1)
def test_a_saved_table_gives_the_bits_that_were_steered(runner_command, tmp_path, scene):
    file = ROOT / "params" / scene
    dice = random.Random(5)
    with Session(file, hand=True, native=False, maxSimulationSteps=10**9, deltaThreshold=0) as session:
        steered = Steered(session.parameters)
        metres, dt = session.parameters["metresPerUnit"], session.parameters["timeStep"]
        shown = [session.state.positions]
        for steps in (1, 4, 2, 1, 8, 16, 1, 8):    # as pictures of the page are, by powers of two
            push = exact_push(40.0 * dt * dice.choice([1.0, 1.0, -0.3, 0.123456, 0.0]), metres)
            turn = exact_turn(math.pi * dt * dice.uniform(-1.0, 1.0))
            state = session.step(push * steps, turn * steps, steps)
            steered.add(push, turn, steps, state)
            shown.append(state.positions)
    assert steered.problem == "" and steered.steps == 41
    (tmp_path / "steered.csv").write_text(steered.to_csv())
    subprocess.run([*runner_command, "-parameters", str(file), "-out", str(tmp_path / "run"), "-insertionSpeed", "0",
                    "-driveFile", str(tmp_path / "steered.csv"), "-maxSimulationSteps", str(steered.steps),
                    "-deltaThreshold", "0", "-logEvery", "1"], check=True, capture_output=True)
    log = read_log(tmp_path / "run", "all")
    ends = np.cumsum([0, 1, 4, 2, 1, 8, 16, 1, 8])
    for end, positions in zip(ends, shown, strict=True):
        np.testing.assert_array_equal(log.positions[end], positions, err_msg=f"step {end}")


def test_saved_tables_of_wire_and_catheter_give_the_bits_that_were_steered(runner_command, tmp_path):
    file = ROOT / "params" / "catheter.json"
    dice = random.Random(8)
    with Session(file, hand=True, native=False, maxSimulationSteps=10**9, deltaThreshold=0) as session:
        instruments = HeldInstruments()
        assert instruments.problem == "no run is open"
        instruments.begin(session, session.describe())
        shown = [(session.state.positions, session.state.catheters[0].positions)]
        for held, steps in ((1, 4), (0, 8), (1, 8), (1, 1), (0, 4)):
            instruments.hold(held)
            push, turn = instruments.in_a_step(0.8 * dice.uniform(-0.2, 1.0), 0.06 * dice.uniform(-1.0, 1.0))
            state = session.step(push * steps, turn * steps, steps, held)
            instruments.add(held, push, turn, steps, state)
            shown.append((state.positions, state.catheters[0].positions))
        with pytest.raises(ValueError):
            instruments.hold(2)
    log = run_of_tables(runner_command, tmp_path, file, [instruments.to_csv(k) for k in (0, 1)], 25)
    for end, (wire, catheter) in zip(np.cumsum([0, 4, 8, 8, 1, 4]), shown, strict=True):
        np.testing.assert_array_equal(log.positions[end], wire, err_msg=f"step {end}")
        np.testing.assert_array_equal(log.catheters[0][end], catheter, err_msg=f"step {end}")


@pytest.mark.parametrize("native", [False, pytest.param(True, marks=pytest.mark.skipif(
    not building.native_library(), reason="the native library is not built"))])
def test_tables_of_hubs_that_moved_at_once_give_the_bits_of_one_step_of_all(runner_command, tmp_path, native):
    file = ROOT / "params" / "catheter.json"
    dice = random.Random(9)
    with Session(file, hand=True, native=native, maxSimulationSteps=10**9, deltaThreshold=0) as session:
        assert session.hubs == 2
        tables = [Steered(session.parameters) for _ in range(session.hubs)]
        metres = session.parameters["metresPerUnit"]
        shown = [(session.state.positions, session.state.catheters[0].positions)]
        for steps in (4, 1, 8, 70, 2):    # 70: a library makes 64 at once
            pushes = [exact_push(0.8 * dice.uniform(-0.2, 0.5), metres) for _ in tables]
            turns = [exact_turn(0.06 * dice.uniform(-1.0, 1.0)) for _ in tables]
            state = session.step(np.array(pushes) * steps, [turn * steps for turn in turns], steps)
            for table, push, turn in zip(tables, pushes, turns):
                table.add(push, turn, steps, state)
            shown.append((state.positions, state.catheters[0].positions))
    log = run_of_tables(runner_command, tmp_path, file, [table.to_csv() for table in tables], 85)
    for end, (wire, catheter) in zip(np.cumsum([0, 4, 1, 8, 70, 2]), shown, strict=True):
        np.testing.assert_array_equal(log.positions[end], wire, err_msg=f"step {end}")
        np.testing.assert_array_equal(log.catheters[0][end], catheter, err_msg=f"step {end}")


def run_of_tables(runner_command, folder, file, tables, steps):
    """The log of a run driven by the saved tables of a wire and its catheter."""
    for number, table in enumerate(tables):
        (folder / f"steered-{number}.csv").write_text(table)
    subprocess.run([*runner_command, "-parameters", str(file), "-out", str(folder / "run"), "-driveFile",
                    str(folder / "steered-0.csv"), "-catheters[0].driveFile", str(folder / "steered-1.csv"),
                    "-maxSimulationSteps", str(steps), "-deltaThreshold", "0", "-logEvery", "1"], check=True,
                   capture_output=True)
    return read_log(folder / "run", "all")


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
    with Session(file, hand=True, native=False, maxSimulationSteps=10**9) as session:
        instruments = HeldInstruments()
        instruments.begin(session, session.describe())
        shown = [(session.state.positions, session.state.catheters[0].positions)]
        for part, steps in ((1.0, 4), (1.0, 4), (0.5, 4), (-1.0, 2)):
            one, turn = instruments.in_a_step(part * push, 0.01)
            state = session.step(one * steps, turn * steps, steps, held)
            instruments.add(held, one, turn, steps, state)
            shown.append((state.positions, state.catheters[0].positions))
    hub = state.catheters[0] if held else state.hub
    assert hub.insertion == pytest.approx(1e-3 * (gone - 2.0 * push), abs=1e-12)
    log = run_of_tables(runner_command, tmp_path, file, [instruments.to_csv(k) for k in (0, 1)], 14)
    for end, (wire, catheter) in zip(np.cumsum([0, 4, 4, 4, 2]), shown, strict=True):
        np.testing.assert_allclose(log.positions[end], wire, rtol=0.0, atol=1e-6, err_msg=f"step {end}")
        np.testing.assert_allclose(log.catheters[0][end], catheter, rtol=0.0, atol=1e-6, err_msg=f"step {end}")


def test_exact_pushes_are_near_what_is_wanted_and_sums_of_them_have_no_rounding():
    for metres in (1e-3, 1e-2, 0.025, 1.0):
        for wanted in (0.4, -0.04, 0.0, 1.2345e-3, 7e-7):
            push = exact_push(wanted, metres)
            displacement = metres * push
            assert abs(push - wanted) * metres < 1e-12
            times = min(10_000, int(12.0 / max(abs(displacement), 1e-6)))    # to 12 m
            running = 0.0
            for _ in range(times):
                running += displacement
            assert running == math.fsum([displacement] * times)


def test_what_no_table_can_say_is_one_phrase():
    assert "solver direct" in Steered({"solver": "pbd", "drive": "push", "timeStep": 0.01}).problem
    steered = Steered({"solver": "direct", "drive": "displace", "timeStep": 0.01, "metresPerUnit": 1e-3})
    assert steered.problem == ""
    steered.invalidate("timeStep was changed")
    steered.add(1.0, 0.0, 5, None)
    assert steered.calls == [] and steered.problem == "timeStep was changed" and json.dumps(steered.problem)
