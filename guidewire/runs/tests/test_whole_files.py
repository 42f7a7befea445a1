"""Files that are there whole or not at all, a full disk among what is met, and what an interrupt leaves and says."""

import argparse
import errno
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from PIL import Image

from guidewire.commands import commands
from guidewire.prepare import ROOT
from guidewire.runs.whole_files import whole_file, write_whole

SMALL = {"numberRodElements": 4, "constraintSolverSteps": 2, "maxSimulationSteps": 40, "deltaThreshold": 0}


def test_a_file_takes_its_place_when_it_is_whole(tmp_path):
    file = tmp_path / "a.txt"
    write_whole(file, "old")
    with whole_file(file) as partial:
        partial.write_text("new")
        assert partial.suffix == ".txt" and file.read_text() == "old"
    assert file.read_text() == "new" and [path.name for path in tmp_path.iterdir()] == ["a.txt"]


@pytest.mark.parametrize("error", [OSError(errno.ENOSPC, "No space left on device"), KeyboardInterrupt()])
def test_of_a_file_that_does_not_become_whole_nothing_is_left(tmp_path, error):
    with pytest.raises(type(error)) as raised:
        with whole_file(tmp_path / "a.png") as partial:
            partial.write_bytes(b"half")
            raise error
    assert not list(tmp_path.iterdir())
    assert isinstance(error, KeyboardInterrupt) or raised.value.filename == str(tmp_path / "a.png")


def test_a_full_disk_is_one_line_with_exit_code_5(capsys, tmp_path):
    def full(_):
        with whole_file(tmp_path / "a.csv"):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    assert commands.run(argparse.Namespace(action=full, command="sweep")) == 5
    line = capsys.readouterr().err
    assert line.count("\n") == 1 and line.startswith(f"guidewire: {tmp_path / 'a.csv'}: No space left on device")


@pytest.fixture(scope="module")
def run(runner_command, tmp_path_factory):
    """Folder of a run with a log."""
    folder = tmp_path_factory.mktemp("small")
    (folder / "scene.json").write_text(json.dumps(SMALL))
    subprocess.run([*runner_command, "-parameters", str(folder / "scene.json"), "-out", str(folder / "run")],
                   check=True,
                   capture_output=True)
    return folder / "run"


@pytest.fixture
def full_disk(monkeypatch):
    """No more than so many bytes of a text fit on the disk, and of pictures none."""
    def refuse(*_, **__):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def write_text(path, text, **_):
        path.write_bytes(text.encode()[:100])
        refuse()

    monkeypatch.setattr(Path, "write_text", write_text)
    monkeypatch.setattr(Image.Image, "save", lambda image, path, **_: (Path(path).write_bytes(b"half"), refuse()))
    monkeypatch.setattr("guidewire.viewer.command.three", lambda tell: {})


def said_by(capsys, *words):
    """What a command says on a full disk."""
    assert commands.run(commands.parse([str(word) for word in words])) == 5
    line = capsys.readouterr().err.splitlines()[-1]
    assert line.startswith("guidewire: ") and "No space left on device" in line
    return line


@pytest.mark.parametrize("words", [
    ["render", "RUN", "--out", "new/a.png"], ["render", "RUN", "--out", "new/a.gif", "--frames", "3"],
    ["view", "RUN", "--html", "new/a.html"], ["plot", "TABLE", "--x", "timeStep", "--y", "steps", "--out", "new/a.png"],
], ids=["picture", "film", "page", "plot"])
@pytest.mark.few(1)
def test_what_does_not_fit_on_the_disk_is_reported_in_one_line_and_leaves_no_file(run, tmp_path, monkeypatch, capsys,
                                                                              request, words):
    monkeypatch.chdir(tmp_path)
    table = tmp_path / "runs.csv"
    table.write_text("key,variant,timeStep,repeat,outcome,steps\na,,0.1,,finished,3\nb,,0.2,,finished,4\n")
    request.getfixturevalue("full_disk")
    line = said_by(capsys, *({"RUN": run, "TABLE": table}.get(word, word) for word in words))
    assert f": {words[words.index('--out' if '--out' in words else '--html') + 1]}: " in f": {line.split(' ', 1)[1]}"
    assert not list((tmp_path / "new").iterdir())


def test_a_sweep_on_a_full_disk_is_reported_in_one_line_and_leaves_no_half_table(
        runner_command, tmp_path, monkeypatch, capsys, request):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(json.dumps({**SMALL, "maxSimulationSteps": 1}))
    (tmp_path / "two.json").write_text(json.dumps(
        {"study": "two", "scene": "scene.json", "repeats": 1, "axes": {"timeStep": [0.01, 0.02]}}))
    request.getfixturevalue("full_disk")
    assert "results/two/" in said_by(capsys, "sweep", "two.json")
    assert not [path for path in (tmp_path / "results").rglob("*") if path.is_file()]


def test_a_request_to_terminate_ends_the_runner_too(runner_command, tmp_path):
    (tmp_path / "long.json").write_text(json.dumps({**SMALL, "maxSimulationSteps": 1_000_000_000}))
    process = subprocess.Popen([sys.executable, str(ROOT / "guidewire.py"), "run", "long.json", "--out", "out", "--set",
                                "logEvery=1000000000"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    end = time.monotonic() + 60.0
    while not list(tmp_path.glob("out/*")):    # the runner's own; the folder alone is made before it starts, too
        assert time.monotonic() < end and process.poll() is None
        time.sleep(0.05)
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    process.send_signal(signal.SIGTERM)
    assert process.wait(30.0) == 130
    assert len(children) == 1 and not Path(f"/proc/{children[0]}").exists()
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["outcome"] == "interrupted"


@pytest.mark.parametrize("command, said", [
    ("sweep", "interrupted; completed runs are kept, the same command continues from here"),
    ("render", "interrupted; nothing was written"), ("test", "interrupted"),
])
def test_an_interrupted_command_says_what_is_true_of_it(capsys, command, said):
    def interrupted(_):
        raise KeyboardInterrupt

    assert commands.run(argparse.Namespace(action=interrupted, command=command)) == 130
    assert capsys.readouterr().err == f"guidewire: {said}\n"


@pytest.mark.long("runs and sweeps that are interrupted have tests of their own")
def test_checks_that_are_interrupted_leave_no_trace_on_the_screen(tmp_path):
    script = Path(__file__).with_name("interrupted_check.py")
    done = subprocess.run([sys.executable, str(script), str(tmp_path)], capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": str(ROOT)}, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "interrupted\n", "")
