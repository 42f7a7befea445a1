"""Logs of format npz, of the real runner: they hold what the text holds, and what a killed run leaves is read."""

import json
import os
import signal
import subprocess
import time
import zipfile

import numpy as np
import pytest

from analysis.twist import read_twist
from guidewire.logs.logs import LogError, read_entries, read_log
from guidewire.logs.runs import read_run
from guidewire.logs.stress import read_stress
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request, Runner

VESSEL = {"guidewireLength": 60, "numberRodElements": 6, "guidewireOffset": -60, "displacement": 0, "sphereRadius": 2,
          "drive": "push", "displacementPerStep": 1, "maxSimulationSteps": 20, "logContacts": True,
          "logOrientations": True, "constraintSolverSteps": 20,
          "vessel": {"shape": "tube", "knots": [[0, 0, -70], [0, 0, 0], [0, 30, 30]], "radius": 4}}
MATERIAL = {"solver": "direct", "proximalEnd": "clamped", "numberRodElements": 5, "gravity": [0, -9.81, 0],
            "maxSimulationSteps": 7, "deltaThreshold": 0, "logStrains": True}
HUB = {**MATERIAL, "gravity": [0, 0, 0], "guidewireLength": 60, "numberRodElements": 12, "guidewireOffset": -55,
       "drive": "displace", "insertionSpeed": 0.01, "logHub": True, "logContacts": True,
       "vessel": {"shape": "tube", "knots": [[0, 0, -10], [0, 0, 40], [0, 20, 80]], "radius": 4}}
SCENES = {"the hub and each wall": HUB, "a sheath": {**HUB, "sheath": {"exit": [0, 0, 0], "direction": [0, 0, 1]}},
          "gains, contacts and orientations": VESSEL, "every third step": {**VESSEL, "logEvery": 3},
          "the last sphere": {**VESSEL, "logSpheres": "last"}, "strains": MATERIAL,
          "no steps": {"maxSimulationSteps": 0, "numberRodElements": 2}}


@pytest.fixture(scope="module")
def make(runner_command):
    """A function that makes a run of a scene into a folder, by one process for all of them; its folder."""
    runner = Runner(runner_command)

    def run(folder, scene, **more):
        folder.mkdir(exist_ok=True)
        answer = runner.run(Request("run", None, folder / "run", {**scene, **more}))
        assert answer.exit_code == 0, answer.message
        return folder / "run"

    yield run
    runner.close()


def without_wall_times(folder):
    return [(step, {key: value for key, value in entry.items() if key != "elapsedMilliseconds"})
            for step, entry in read_entries(folder)]


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_arrays_hold_what_the_text_holds(make, tmp_path, scene):
    text = make(tmp_path / "text", scene)
    arrays = make(tmp_path / "arrays", scene, logFormat="npz")
    assert sorted(os.listdir(arrays)) == ["parameters.json", "positions.npz", "summary.json"]
    assert read_run(arrays).summary["log"] == "positions.npz"
    assert without_wall_times(arrays) == without_wall_times(text)
    for chosen in ({"spheres": "all"}, {"velocities": True}, {"every": 2}):
        one, other = read_log(text, **chosen), read_log(arrays, **chosen)
        for name in ("steps", "time", "prediction_error", "spheres", "positions", "velocities", "final_step",
                     "final_spheres", "final_positions"):
            np.testing.assert_array_equal(getattr(other, name), getattr(one, name), err_msg=name)
        assert other.complete and other.elapsed.shape == one.elapsed.shape


def test_32_bits_are_as_near_as_they_are(make, tmp_path):
    exact = read_log(make(tmp_path / "exact", VESSEL, logFormat="npz"), "all", velocities=True)
    near = read_log(make(tmp_path / "near", VESSEL, logFormat="npz32"), "all", velocities=True)
    for name in ("positions", "velocities"):
        np.testing.assert_array_equal(getattr(near, name), getattr(exact, name).astype(np.float32))
    np.testing.assert_array_equal(near.time, exact.time)


@pytest.mark.parametrize("words, bits", [("npz", 64), ("npz32", 32)])
def test_a_log_is_as_large_as_its_numbers(make, tmp_path, words, bits):
    scene = {"numberRodElements": 100, "constraintSolverSteps": 1, "maxSimulationSteps": 50, "deltaThreshold": 0}
    folder = make(tmp_path / "run", scene, logFormat=words)
    numbers = 51 * 101 * 6 * bits // 8 + 51 * 5 * 8
    assert numbers <= (folder / "positions.npz").stat().st_size <= numbers + 4096
    # 10 s at 1 ms: 10 001 of these entries are 48.9 and 24.6 MB.
    assert 10_001 * numbers / 51 < {64: 50e6, 32: 25e6}[bits]
    with np.load(folder / "positions.npz") as log:
        assert log["positions"].dtype == np.dtype(f"<f{bits // 8}") and log["positions"].shape == (51, 101, 3)


def test_analyses_take_arrays(make, tmp_path):
    text = make(tmp_path / "text", MATERIAL)
    arrays = make(tmp_path / "arrays", MATERIAL, logFormat="npz")
    np.testing.assert_array_equal(read_stress(arrays).couple, read_stress(text).couple)
    turned = {"twistPerStep": 0.1, "displacement": 0, "maxSimulationSteps": 5, "logOrientations": True,
              "numberRodElements": 4}
    text = make(tmp_path / "text", turned)
    arrays = make(tmp_path / "arrays", turned, logFormat="npz")
    np.testing.assert_array_equal(read_twist(read_run(arrays)).tip, read_twist(read_run(text)).tip)


def test_a_log_of_another_format_does_not_stay_beside_a_new_one(make, tmp_path):
    for word, name in (("npz", "positions.npz"), ("json", "positions.json"), ("npz32", "positions.npz")):
        folder = make(tmp_path / "run", VESSEL, logFormat=word)
        assert sorted(os.listdir(folder)) == ["parameters.json", name, "summary.json"]


def test_what_a_killed_run_leaves_is_read_up_to_its_last_whole_step(runner_command, tmp_path):
    out = tmp_path / "out"
    process = subprocess.Popen([*runner_command, "-parameters", str(ROOT / "params/default.json"), "-out", str(out),
                                "-logFormat", "npz", "-maxSimulationSteps", "1000000", "-deltaThreshold", "0"])
    partial = out / "positions.npz.partial"
    while not partial.exists() or partial.stat().st_size < 10_000:
        time.sleep(0.02)
    process.send_signal(signal.SIGKILL)
    process.wait()
    log = read_log(out, "all")
    assert not log.complete and "last whole step" in log.warning and "\n" not in log.warning
    np.testing.assert_array_equal(log.steps, np.arange(len(log.steps)))
    row = 8 * (5 + 2 * 3 * 31)  # bytes of an entry of 31 spheres
    with open(partial, "rb") as file:
        np.lib.format.read_magic(file)
        np.lib.format.read_array_header_1_0(file)
        assert len(log.steps) == (partial.stat().st_size - file.tell()) // row
    os.truncate(partial, partial.stat().st_size - row)
    assert read_log(out).final_step == log.final_step - 1
    os.truncate(partial, 60)
    with pytest.raises(LogError, match="not a position log"):
        read_log(out)


def test_an_interrupted_run_leaves_a_whole_log(runner_command, tmp_path):
    out = tmp_path / "out"
    process = subprocess.Popen([*runner_command, "-parameters", str(ROOT / "params/default.json"), "-out", str(out),
                                "-logFormat", "npz", "-maxSimulationSteps", "1000000", "-deltaThreshold", "0"],
                               stdout=subprocess.DEVNULL)
    while not (out / "positions.npz.partial").exists():
        time.sleep(0.02)
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    assert process.wait(20) == 130
    log = read_log(out)
    assert log.complete and log.final_step == read_run(out).summary["steps"]


def test_a_full_disk_is_said(runner_command, tmp_path):
    os.symlink("/dev/full", tmp_path / "positions.npz.partial")
    done = subprocess.run([*runner_command, "-parameters", str(ROOT / "params/default.json"), "-out", str(tmp_path),
                           "-logFormat", "npz", "-maxSimulationSteps", "3"], capture_output=True, text=True,
                          check=False)
    assert done.returncode == 5 and done.stderr.count("\n") == 1 and "the log could not be written" in done.stderr
    assert read_run_summary(tmp_path)["log"] == "positions.npz.partial"


def read_run_summary(folder):
    return json.loads((folder / "summary.json").read_text())


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"no log", b"\x93NUMPY\x01\x00\xff\xff{}"])
def test_what_is_no_log_is_one_line(tmp_path, content):
    (tmp_path / "positions.npz").write_bytes(content)
    with pytest.raises(LogError, match="positions.npz: not a position log") as refused:
        read_log(tmp_path)
    assert "\n" not in str(refused.value)


def test_a_zip_of_something_else_and_one_that_is_broken_are_one_line(make, tmp_path):
    with zipfile.ZipFile(tmp_path / "positions.npz", "w") as other:
        other.writestr("a.txt", "b")
    with pytest.raises(LogError, match="it has no delta"):
        read_log(tmp_path)
    log = make(tmp_path / "run", VESSEL, logFormat="npz") / "positions.npz"
    content = bytearray(log.read_bytes())
    content[len(content) // 2] ^= 0xFF
    log.write_bytes(content)
    with pytest.raises(LogError, match="positions.npz"):
        list(read_entries(log))


@pytest.mark.parametrize("kind", ["json", "npz"])
def test_logs_of_older_versions_have_the_same_quantities(make, tmp_path, kind):
    folder = make(tmp_path, MATERIAL, logFormat=kind)
    expected = read_stress(folder).angular_velocity
    log = folder / f"positions.{kind}"
    if kind == "json":
        log.write_text(log.read_text().replace("angularVelocities", "angularVelocity"))
    else:
        with np.load(log) as arrays:
            old = {name.replace("Velocities", "Velocity"): arrays[name] for name in arrays.files}
        np.savez(log, **old)
    assert expected.any()
    assert read_stress(folder).angular_velocity.tobytes() == expected.tobytes()
