"""Runs beside their repeats with finer settings: what holds, and what is said where it does not."""

import json
import subprocess
import sys

import numpy as np
import pytest

from guidewire.advice import repeats
from guidewire.logs.runs import read_run
from guidewire.prepare import ROOT

WIRE = {"solver": "direct", "guidewireLength": 100.0, "numberRodElements": 8, "proximalEnd": "clamped",
        "timeStep": 0.002,
        "maxSimulationSteps": 40, "deltaThreshold": 0.0, "massDamping": 400.0, "tipForce": [0.0, 0.1, 0.0]}


def run(folder, tip=(0.0, 0.0, 100.0), outcome="finished", reliable=True, force=0.5, largest=1.0):
    """A run's folder as the runner leaves it."""
    folder.mkdir()
    (folder / "parameters.json").write_text(json.dumps({"guidewireLength": 100.0}))
    (folder / "summary.json").write_text(json.dumps({
        "outcome": outcome, "reliable": reliable, "hub": {"force": force, "torque": 0.0},
        "extremes": {"axialForce": largest}, "largestWallForce": 0.2}))
    sphere = dict(zip(("x", "y", "z"), tip)) | dict.fromkeys(("vx", "vy", "vz"), 0.0)
    (folder / "positions.json").write_text("{\n" + ",\n".join(
        f'"{step}": ' + json.dumps({"totalTime": 0.1 * step, "elapsedMilliseconds": 0.0, "delta": 0.0,
                                   "sphere": {"0": sphere}}) for step in range(2)) + "\n}\n")
    return read_run(folder)


@pytest.mark.parametrize("other, said", [
    ({}, None), ({"tip": (0.0, 0.9, 100.0)}, None), ({"force": 0.59}, None), ({"largest": 3.0}, None),
    ({"tip": (0.0, 1.1, 100.0)}, "with half the time step the tip ends 1.10 units elsewhere, 1.1 % of the "
                                 "wire's length"),
    ({"tip": (0.0, float("nan"), 100.0)}, "the tip ends not finite units elsewhere"),
    ({"force": 0.7}, "the force of the hub at the end differs by 0.200 N, 20 % of its largest"),
    ({"outcome": "failed"}, "with half the time step it ends failed, not finished"),
    ({"reliable": False}, "with half the time step it is not reliable"),
])
def test_a_result_holds_as_long_as_nothing_of_it_moves_far(tmp_path, other, said):
    first, second = run(tmp_path / "a"), run(tmp_path / "b", **other)
    found = repeats.differences(first, {"half the time step": second})
    assert (found == []) if said is None else (len(found) == 1 and said in found[0]), found
    assert repeats.verdict(first, {"half the time step": second}).startswith(
        "the result holds with half" if said is None else "the result does not hold: with half")
    table = repeats.as_markdown(first, {"half the time step": second})
    assert len({line.count("|") for line in table.splitlines()}) == 1 and "| force of the hub, N | 0.500 |" in table


@pytest.mark.parametrize("changes, code, said", [
    ({}, 0, "the result holds with half the time step and with twice the elements"),
    ({"timeStep": 0.01, "maxSimulationSteps": 5, "massDamping": 0.0, "tipForce": [0.0, 0.5, 0.0]}, 6,
     "the result does not hold: "),
])
@pytest.mark.few(1)
def test_a_run_is_checked_beside_itself(runner_command, tmp_path, changes, code, said):
    (tmp_path / "wire.json").write_text(json.dumps({**WIRE, **changes}))
    done = subprocess.run([sys.executable, ROOT / "guidewire.py", "run", tmp_path / "wire.json", "--out",
                           tmp_path / "out",
                           "--check", "--elements"], capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == code and said in done.stdout, done.stdout + done.stderr
    assert "warning" not in done.stderr
    half, fine = (read_run(tmp_path / "out" / "check" / name) for name in ("half-the-time-step", "twice-the-elements"))
    assert half.number("timeStep") == 0.5 * {**WIRE, **changes}["timeStep"] and fine.number("numberRodElements") == 16
    moved = np.linalg.norm(repeats.ending_of(half).tip - repeats.ending_of(read_run(tmp_path / "out")).tip)
    assert (moved > 1.0) == (code == 6)
    assert (tmp_path / "out" / "check.md").read_text() in done.stdout
