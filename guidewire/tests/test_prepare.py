"""Which Python is chosen, what is tried to make one, and that a machine without any gets one clear line."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

from guidewire import prepare

MISSING = ("no_such_package",)


class HandedOver(Exception):
    pass


@pytest.fixture
def bare(tmp_path, monkeypatch):
    """A machine where nothing can be made: every program that prepare would start is noted and fails."""
    tried = []

    def fail(command, seconds):
        tried.append(command)
        if command[1:3] == ["-m", "venv"]:
            Path(command[3]).mkdir()
            return True
        return False

    def note(python):
        raise HandedOver(str(python))

    monkeypatch.setattr(prepare, "VENV", tmp_path / ".venv")
    monkeypatch.setattr(prepare, "_log_run", fail)
    monkeypatch.setattr(prepare, "_hand_over", note)
    return tried


def python_that_answers(path, code):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\nexit {code}\n")
    path.chmod(0o755)
    return path


def test_a_python_has_what_it_can_import():
    assert prepare.has_packages(sys.executable, ("json", "xml"))
    assert not prepare.has_packages(sys.executable, ("json",) + MISSING)


def test_what_is_no_python_has_nothing(tmp_path):
    assert not prepare.has_packages(tmp_path / "nothing", ())
    assert not prepare.has_packages(python_that_answers(tmp_path / "old", 1), ())


def test_the_running_python_is_kept_when_it_has_everything(bare):
    prepare.require_packages(("json",))
    prepare.require_version()
    assert bare == []


def test_a_venv_that_has_everything_is_used_and_nothing_is_installed(bare, monkeypatch):
    python = python_that_answers(prepare.VENV / "bin" / "python", 0)
    with pytest.raises(HandedOver, match=str(python)):
        prepare.require_packages(MISSING)
    assert bare == []


def test_pip_is_tried_before_apt_and_gives_up_soon(bare, monkeypatch):
    monkeypatch.setattr(prepare.os, "geteuid", lambda: 0)
    monkeypatch.setattr(prepare.shutil, "which", lambda name: "/usr/bin/" + name)
    with pytest.raises(prepare.PreparationError):
        prepare.require_packages(MISSING)
    venv, pip, update, install = bare
    assert venv[1:3] == ["-m", "venv"]
    assert pip[1:4] == ["-m", "pip", "install"]
    assert [pip[pip.index(option) + 1] for option in ("--retries", "--timeout")] == ["1", "10"]
    assert update[-1] == "update"
    assert install[-1] == "python3-no_such_package" and "install" in install


def test_where_nothing_works_one_line_says_what_to_install(bare, monkeypatch):
    monkeypatch.setattr(prepare.os, "geteuid", lambda: 1000)
    with pytest.raises(prepare.PreparationError) as caught:
        prepare.require_packages(MISSING)
    line = str(caught.value)
    assert "\n" not in line
    assert "apt-get install python3-no_such_package" in line and "requirements.txt" in line
    assert not any("apt-get" in command[0] for command in bare)


def test_a_venv_that_could_not_be_filled_is_removed_and_one_that_was_there_is_kept(bare):
    with pytest.raises(prepare.PreparationError):
        prepare.require_packages(MISSING)
    assert not prepare.VENV.exists()
    prepare.VENV.mkdir()
    with pytest.raises(prepare.PreparationError):
        prepare.require_packages(MISSING)
    assert prepare.VENV.exists()


def test_an_old_python_hands_over_to_a_newer_one(bare, monkeypatch):
    monkeypatch.setattr(prepare, "MINIMUM_VERSION", (4, 0))
    python = python_that_answers(prepare.VENV / "bin" / "python", 0)
    with pytest.raises(HandedOver, match=str(python)):
        prepare.require_version()


def test_an_old_python_alone_is_one_clear_line(bare, monkeypatch):
    monkeypatch.setattr(prepare, "MINIMUM_VERSION", (4, 0))
    monkeypatch.setattr(prepare, "has_packages", lambda python, packages: False)
    with pytest.raises(prepare.PreparationError, match="^Python 4.0 or newer is needed, this is 3"):
        prepare.require_version()


@pytest.mark.parametrize("line, said", [
    (["fly"], "invalid choice: 'fly'"),
    (["rnu"], "there is no 'rnu': did you mean 'run'?"),
    (["run"], "FILE"),
    (["run", "a.json", "--set", "timeStep"], "'timeStep' is not KEY=VALUE"),
    (["sweep", "time-stp"], "there is no study 'time-stp': did you mean 'time-step'?"),
    (["sweep", "no-such-file.json"], "no-such-file.json: No such file or directory"),
    (["sweep", "time-step", "--jobs", "0"], "'0' is not a whole number above 0"),
    (["anatomy", "a.nrrd", "--label", "1", "--threshold", "3"], "--threshold: not allowed with argument --label"),
    (["anatomy", "a.nrrd", "--segment", "Aorta", "--label", "1"], "--label: not allowed with argument --segment"),
    ([], "COMMAND"),
])
def test_a_wrong_command_line_is_one_line_and_exit_code_2(line, said):
    door = prepare.ROOT / "guidewire.py"
    done = subprocess.run([sys.executable, str(door), *line], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert said in done.stderr and done.stderr.count("\n") == 1 and done.stdout == ""


def test_pip_installs_a_pinned_version_of_everything_that_is_needed():
    lines = (prepare.ROOT / "requirements.txt").read_text().splitlines()
    pinned = {line.split("==")[0] for line in lines if line and not line.startswith("#")}
    needed = {prepare._PIP_NAMES.get(name, name) for name in prepare.TESTING}
    assert pinned == {*needed, "dask"}  # dask and distributed go together


def test_what_must_run_on_an_old_python_uses_no_newer_syntax():
    for path in ("guidewire.py", "guidewire/prepare.py", "guidewire/__init__.py", "guidewire/__main__.py"):
        ast.parse((prepare.ROOT / path).read_text(), feature_version=(3, 6))
