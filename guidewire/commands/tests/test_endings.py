"""How runs end that do not end by themselves: killed, interrupted, on a full disk; and runs that are very long."""

import json
import os
import random
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pytest

from guidewire.logs.logs import LogError, read_log
from guidewire.prepare import ROOT

FULL = os.environ.get("GUIDEWIRE_ALL") == "1"
# A small wire that never comes to rest and logs some 50 MB a second: longer than any test waits, but not for ever.
LONG = {
    "numberRodElements": 10, "constraintSolverSteps": 2, "deltaThreshold": 0, "maxSimulationSteps": 1_000_000,
}


@pytest.fixture
def scratch():
    """A folder that is gone after the test: the logs here are large."""
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder)


@pytest.fixture
def start(runner_command):
    """A function that starts a run; what still runs at the end of the test is killed."""
    started = []

    def start_run(scene, out, *more):
        process = subprocess.Popen([*runner_command, "-parameters", str(scene), "-out", str(out), *more],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        started.append(process)
        return process

    yield start_run
    for process in started:
        process.kill()
        process.communicate()


def scene_of(folder, **changes):
    path = folder / "scene.json"
    path.write_text(json.dumps({**LONG, **changes}))
    return path


def drop(path, key):
    """Take a key out of a scene's file."""
    scene = json.loads(path.read_text())
    del scene[key]
    path.write_text(json.dumps(scene))


def wait_for_log(out, least=200_000):
    """Return when the log under way has some bytes; a run that writes none in 30 s fails the test."""
    partial = out / "positions.json.partial"
    for _ in range(3000):
        if partial.exists() and partial.stat().st_size >= least:
            return
        time.sleep(0.01)
    pytest.fail("no log was written")


def assert_steps_are_whole(log, time_step=0.01):
    np.testing.assert_array_equal(log.steps, np.arange(len(log.steps)))
    np.testing.assert_allclose(log.time, time_step * log.steps, rtol=1e-12)
    assert np.all(np.isfinite(log.positions))


@pytest.mark.parametrize("moment", range(8 if FULL else 1))
def test_a_killed_run_leaves_a_log_up_to_its_last_whole_step(start, scratch, moment):
    out = scratch / "out"
    process = start(scene_of(scratch), out)
    wait_for_log(out)
    time.sleep(random.Random(moment).uniform(0.0, 2.0 if FULL else 0.2))
    process.kill()
    process.wait()
    assert not (out / "summary.json").exists() and not (out / "positions.json").exists()
    log = read_log(out, spheres="all")
    assert_steps_are_whole(log)
    assert not log.complete
    assert f"read up to step {log.final_step}" in log.warning and "cut short" in log.warning
    assert log.final_step == last_whole_entry((out / "positions.json.partial").read_text())


def last_whole_entry(text):
    """The number of the last entry that is there from its first to its last character; entries stand one a line."""
    last, before = text.rstrip().splitlines()[-1], text.rstrip().splitlines()[-2]
    for line in (last, before):
        try:
            return int(*json.loads("{" + line.rstrip(",") + "}"))
        except ValueError:
            continue
    pytest.fail("the last two lines are no entries")


def test_a_run_killed_at_its_very_start_leaves_nothing_that_reads_as_a_result(start, scratch):
    for wait in (0.02, 0.05, 0.1, 0.2):
        out = scratch / f"out-{wait}"
        process = start(scene_of(scratch), out)
        time.sleep(wait)
        process.kill()
        process.wait()
        assert not (out / "summary.json").exists() and not (out / "positions.json").exists()
        try:
            assert not read_log(out).complete
        except LogError as error:
            assert "\n" not in str(error)


def contents(folder):
    return {name: (folder / name).read_bytes() for name in ("positions.json", "parameters.json", "summary.json")}


@pytest.mark.parametrize("number, code", [(signal.SIGKILL, -9), (signal.SIGINT, 130), (signal.SIGTERM, 130)])
@pytest.mark.few(1)
def test_a_run_that_is_stopped_leaves_an_earlier_result_as_it_was(start, scratch, number, code):
    out = scratch / "out"
    assert start(scene_of(scratch, maxSimulationSteps=10), out).wait() == 0
    before = contents(out)
    process = start(scene_of(scratch), out, "--force")
    wait_for_log(out)
    process.send_signal(number)
    said, _ = process.communicate(timeout=30)
    assert process.returncode == code
    assert contents(out) == before
    if code == 130:
        assert said.count("\n") == 1 and f"{out} held before is kept" in said and "positions.json.partial" in said


def test_a_run_of_other_parameters_replaces_an_earlier_result_only_where_it_is_forced_to(start, scratch):
    out = scratch / "out"
    assert start(scene_of(scratch, maxSimulationSteps=10), out).wait() == 0
    before = contents(out)
    refused = start(scene_of(scratch, maxSimulationSteps=11, timeStep=0.005), out)
    said, complained = refused.communicate(timeout=30)
    assert (refused.returncode, said) == (2, "") and complained.count("\n") == 1
    for word in (str(out), "timeStep is 0.01 there and 0.005 here", "maxSimulationSteps is 10 there", "--force"):
        assert word in complained
    assert contents(out) == before and sorted(path.name for path in out.iterdir()) == sorted(before)
    assert start(scratch / "scene.json", out, "--force").wait() == 0
    assert json.loads((out / "summary.json").read_text())["steps"] == 11


def test_the_same_run_again_is_already_there_and_writes_nothing(start, scratch):
    out = scratch / "out"
    assert start(scene_of(scratch, maxSimulationSteps=10), out).wait() == 0
    before = contents(out), [path.stat().st_mtime_ns for path in sorted(out.iterdir())]
    again = start(scratch / "scene.json", out)
    said, complained = again.communicate(timeout=30)
    assert (again.returncode, complained) == (0, "")
    assert said.startswith(f"already there: {out} (finished, not reliable: all 10 steps are done)")
    assert (contents(out), [path.stat().st_mtime_ns for path in sorted(out.iterdir())]) == before


def test_a_run_that_was_interrupted_is_no_complete_one_and_is_replaced(start, scratch):
    out = scratch / "out"
    process = start(scene_of(scratch), out)
    wait_for_log(out)
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=30) == 130
    assert start(scene_of(scratch, maxSimulationSteps=10), out).wait() == 0
    assert json.loads((out / "summary.json").read_text())["steps"] == 10


def test_a_long_run_tells_a_terminal_and_no_pipe_how_far_it_is_and_takes_the_line_away_again(
    start, runner_command, scratch
):
    import fcntl
    import pty
    import termios

    # A wire at rest, which warns of nothing whenever it is stopped.
    at_rest = scene_of(scratch, displacement=0.0)
    piped = start(at_rest, scratch / "piped")  # runs for longer than the other one
    screen, terminal = pty.openpty()
    # A fast machine's line has some columns more than 80, where it is cut.
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 120, 0, 0))
    process = subprocess.Popen(
        [*runner_command, "-parameters", str(at_rest), "-out", str(scratch / "out")],
        stdin=terminal, stdout=terminal, stderr=terminal)
    os.close(terminal)
    seen = ""
    try:
        while seen.count(" left") < 2:  # it comes after a second; a run without it would go on for minutes
            seen += os.read(screen, 4096).decode()
        process.send_signal(signal.SIGINT)
        while process.poll() is None or select.select([screen], [], [], 0)[0]:
            try:
                seen += os.read(screen, 4096).decode()
            except OSError:
                break  # the terminal's other end is closed
    finally:
        process.kill()
        process.wait()
        os.close(screen)
    line = re.search(r"step (\d+) of 1000000, \d+ (?:s|min|h) left, (\d+) steps/s, t = ([\d.]+) s, ([\d.]+) x "
                     r"real time",
                     seen)
    assert line, seen
    step, rate, time_in_game, factor = map(float, line.groups())
    assert time_in_game == pytest.approx(0.01 * step)
    assert factor == pytest.approx(0.01 * rate, abs=0.51 + 0.0051)  # both are rounded
    lines = seen.split("\n")
    assert max(map(len, lines[0].split("\r"))) < 100, "one line, written over"
    assert len(lines) == 2 and "\rinterrupted: stopped from outside after step " in lines[0]
    piped.send_signal(signal.SIGINT)
    said, complained = piped.communicate(timeout=30)
    assert said.startswith("interrupted: ") and said.count("\n") == 1 and complained == ""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_ends_with_130_and_a_complete_log(start, scratch, number):
    out = scratch / "out"
    process = start(scene_of(scratch), out)
    wait_for_log(out)
    process.send_signal(number)
    assert process.wait(timeout=30) == 130
    summary = json.loads((out / "summary.json").read_text())
    assert summary["outcome"] == "interrupted" and summary["complete"] is True
    assert not (out / "positions.json.partial").exists()
    log = read_log(out, spheres="all")
    assert log.complete and log.final_step == summary["steps"] > 0
    assert_steps_are_whole(log)
    assert json.loads((out / "positions.json").read_text())


@pytest.fixture
def small_disk(scratch):
    """A file system of 1 MiB."""
    disk = scratch / "disk"
    disk.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", str(disk)], capture_output=True,
                             text=True, check=False)
    if mounted.returncode != 0:
        pytest.skip(f"a small disk cannot be mounted here: {mounted.stderr.strip()}")
    yield disk
    subprocess.run(["umount", str(disk)], check=True)


def without_warnings(complaint):
    """Lines but those on the wire at the end: where a run breaks off it may just swing beyond its length."""
    return [line for line in complaint.splitlines() if not line.startswith("guidewire: warning: the wire is ")]


def test_a_disk_that_fills_ends_a_run_as_failed_and_says_so(start, scratch, small_disk):
    out = small_disk / "out"
    process = start(scene_of(scratch), out)
    _, complaint = process.communicate(timeout=60)
    assert process.returncode == 5
    lines = without_warnings(complaint)
    assert len(lines) == 1 and lines[0].startswith("guidewire: failed: ") and "space" in lines[0].lower()
    assert not (out / "positions.json").exists()
    if (out / "summary.json").exists():
        assert json.loads((out / "summary.json").read_text())["outcome"] == "failed"
    assert_steps_are_whole(read_log(out, spheres="all"))


def test_a_disk_that_fills_leaves_an_earlier_result_whole(start, scratch, small_disk):
    out = small_disk / "out"
    assert start(scene_of(scratch, maxSimulationSteps=10), out).wait() == 0
    before = contents(out)
    process = start(scene_of(scratch), out, "--force")
    _, complaint = process.communicate(timeout=60)
    assert process.returncode == 5 and "is kept" in complaint and len(without_warnings(complaint)) == 1
    assert contents(out) == before


def test_a_sweep_goes_on_after_a_full_disk(runner_command, scratch, small_disk):
    requests = [
        {"id": 1, "parameters": str(scene_of(scratch)), "out": str(small_disk / "out")},
        {"id": 2, "parameters": str(scratch / "scene.json"), "set": {"maxSimulationSteps": 3},
         "out": str(scratch / "out")},
    ]
    done = subprocess.run([*runner_command, "-lines"], input="\n".join(map(json.dumps, requests)) + "\n",
                          capture_output=True, text=True, check=False, timeout=60)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert [(a["id"], a["exitCode"], a["outcome"]) for a in answers] == [(1, 5, "failed"), (2, 0, "finished")]


def memory_of(command):
    """Bytes of memory that a program held at most; it must end with 0."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, cwd=ROOT)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    return used.ru_maxrss * 1024


@pytest.mark.long("5 s; rows of a log leave the memory as they are written")
def test_a_long_run_takes_constant_memory(runner_command, scratch):
    steps, runs = 100_000 if FULL else 40_000, {}
    for count in (1_000, steps):
        out = scratch / str(count)
        scene = scene_of(scratch, maxSimulationSteps=count)
        runs[count] = (out, memory_of([*runner_command, "-parameters", str(scene), "-out", str(out)]))
    long, short = runs[steps][0], runs[1_000][0]
    log_bytes = (long / "positions.json").stat().st_size
    assert log_bytes > 1000 * steps
    # Held in memory the log would add at least its own size; what the runtime takes for itself varies by some MB.
    assert runs[steps][1] - runs[1_000][1] < 0.2 * log_bytes
    reader = "import sys, pathlib; from guidewire.logs.logs import read_log; read_log(pathlib.Path(sys.argv[1]))"
    reading = {folder: memory_of([sys.executable, "-c", reader, str(folder)]) for folder in (long, short)}
    assert reading[long] - reading[short] < 0.2 * log_bytes

    log = read_log(long)
    assert log.complete and log.final_step == steps
    assert_steps_are_whole(log)


MATERIAL = {
    "numberRodElements": 12, "guidewireLength": 300.0, "guidewireOffset": 0.0,
    "proximalEnd": "clamped", "timeStep": 1e-3, "maxSimulationSteps": 40, "deltaThreshold": 0.0,
    "tipForce": [0.0, 0.06, 0.0],
}


@pytest.mark.parametrize(("solver", "substeps", "outcome"), [
    ("xpbd", 1, "finished"), ("xpbd", 20, "diverged"), ("explicit", 3000, "diverged"),
])
def test_material_run_that_went_wrong_says_so_wherever_one_looks(scratch, start, solver, substeps, outcome):
    scene = scene_of(scratch, **MATERIAL, solver=solver, substeps=substeps)
    if solver == "explicit":
        drop(scene, "constraintSolverSteps")
    process = start(scene, scratch / "out")
    said, complained = process.communicate(timeout=60)
    summary = json.loads((scratch / "out" / "summary.json").read_text())
    assert summary["outcome"] == outcome, summary["reason"]
    assert process.returncode == {"finished": 0, "diverged": 4}[outcome]
    word = outcome + (", not reliable" if outcome == "finished" else "")
    assert f"{word}: {summary['reason']} -> " in said and complained == "" and not summary["reliable"]
    assert "raise substeps" in summary["reason"]
    assert ("had not converged" in summary["reason"]) == (outcome == "finished")
    text = (scratch / "out" / "positions.json").read_text()
    assert "null" not in text and "NaN" not in text
    assert np.all(np.isfinite(read_log(scratch / "out").positions))


def test_material_run_that_went_well_has_no_warning(scratch, start):
    scene = scene_of(scratch, **MATERIAL, solver="xpbd", substeps=300)
    process = start(scene, scratch / "out")
    said, _ = process.communicate(timeout=60)
    assert process.returncode == 0 and "finished: all 40 steps are done -> " in said
