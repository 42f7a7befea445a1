"""The commands as a user types them, with the real runner."""

import argparse
import contextlib
import io
import json
import re
import subprocess
import sys
import threading
from dataclasses import dataclass
from pathlib import Path

import pytest

from analysis import gallery
from guidewire.__main__ import main
from guidewire.commands import command_line, commands, making
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building


@dataclass(frozen=True)
class Done:
    """What a command left: exit code and what it and the programs that it started wrote."""

    returncode: int
    stdout: str
    stderr: str


@pytest.fixture
def typed(capfd, monkeypatch):
    """A function that executes a command as the program does, in this process: no packages are imported anew."""
    def type_in(*words):
        monkeypatch.setattr(sys, "argv", ["guidewire.py", *map(str, words)])
        capfd.readouterr()
        try:
            code = main()
        except SystemExit as end:  # words that cannot be read
            code = end.code
        return Done(code, *capfd.readouterr())

    return type_in


@pytest.fixture(scope="module")
def demo(tmp_path_factory):
    """The folder of a demo, and how it ended, in this process."""
    folder = tmp_path_factory.mktemp("demo")
    with contextlib.redirect_stdout(io.StringIO()) as said, contextlib.redirect_stderr(io.StringIO()) as complained:
        code = commands.run(commands.parse(["demo", "--out", str(folder)]))
    return folder, Done(code, said.getvalue(), complained.getvalue())


def test_the_demo_prints_tau_and_period_of_the_thesis_run_and_draws_four_figures(demo):
    folder, done = demo
    assert done.returncode == 0, done.stderr
    tau = float(done.stdout.split("tau = ")[1].split()[0])
    period = float(done.stdout.split("period = ")[1].split()[0])
    # An independent double-precision implementation gave 0.297 s and 0.24 s for Table 4.1.
    assert tau == pytest.approx(0.297, rel=0.01)
    assert period == pytest.approx(0.24, abs=0.005)
    for number in ("4.1", "4.2", "4.3", "4.4"):
        assert (folder / f"figure-{number}.png").stat().st_size > 10_000
        assert len((folder / f"figure-{number}.txt").read_text()) > 100
    assert "index.md" in done.stdout


def test_the_demo_a_second_time_runs_nothing_again(demo, monkeypatch):
    folder, _ = demo
    drawn = gallery.Gallery(folder / "index.md", ())    # its figures are those of the first time
    monkeypatch.setattr(gallery, "draw", lambda *_: drawn)
    logs = [*folder.glob("runs/*/*/positions.json"), folder / "branch" / "positions.json", folder / "branch.gif"]
    before = [log.stat().st_mtime_ns for log in logs]
    assert len(logs) == 3
    assert commands.run(commands.parse(["demo", "--out", str(folder)])) == 0
    assert [log.stat().st_mtime_ns for log in logs] == before


def test_a_run_writes_its_three_files_and_takes_parameters_from_the_command_line(typed, tmp_path):
    done = typed("run", ROOT / "params" / "default.json", "--set", "maxSimulationSteps=5", "--set",
                 "guidewireOffset=-3", "--set", "sweepOrder=bilateral", "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "parameters.json", "positions.json", "summary.json",
    ]
    parameters = json.loads((tmp_path / "out" / "parameters.json").read_text())
    assert (parameters["guidewireOffset"], parameters["sweepOrder"]) == (-3, "bilateral")
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["steps"] == 5


def test_a_run_of_what_is_built_starts_no_compiler_and_says_nothing_of_it(typed, runner_command, tmp_path):
    log = ROOT / "results" / "build.log"
    before = log.stat().st_mtime_ns
    scene = ROOT / "params" / "default.json"
    done = typed("run", scene, "--set", "maxSimulationSteps=2", "--set", "displacement=1", "--out", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert log.stat().st_mtime_ns == before


def test_a_run_with_a_bad_value_passes_on_the_runners_line_and_code(typed, tmp_path):
    done = typed("run", ROOT / "params" / "default.json", "--set", "timeStep=0", "--out", tmp_path / "out")
    assert done.returncode == 2
    assert [line for line in done.stderr.splitlines() if line.startswith("guidewire: ")] == [
        line for line in done.stderr.splitlines() if "timeStep" in line
    ]
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("key", ["out", "parameters", "repeat", "lines", "logFile"])
def test_a_word_of_the_runner_is_no_parameter(typed, tmp_path, key):
    done = typed("run", ROOT / "params" / "default.json", "--set", f"{key}=x", "--out", tmp_path / "out")
    assert done.returncode == 2
    assert f"'{key}' is no parameter" in done.stderr
    assert not (tmp_path / "out").exists()


def test_paths_are_those_of_the_folder_where_the_user_stands(typed, tmp_path, monkeypatch):
    (tmp_path / "mine.json").write_text(json.dumps({"maxSimulationSteps": 2}))
    monkeypatch.chdir(tmp_path)
    assert typed("run", "mine.json").returncode == 0
    assert (tmp_path / "results" / "mine" / "summary.json").exists()


def test_a_run_is_drawn_beside_a_measurement_and_what_cannot_be_compared_is_one_line(demo, tmp_path, capsys):
    run = next(log.parent for log in demo[0].glob("runs/*/*/positions.json") if '"all"' in
               (log.parent / "parameters.json").read_text())
    measured = tmp_path / "measured.csv"
    measured.write_text("time,x,y,z\n0,0,0,0\n0.1,0,0,1e2\n")
    assert commands.run(commands.parse(["compare", str(run), str(measured)])) == 0
    assert "centreline: RMS distance" in capsys.readouterr().out and (run / "compare.png").stat().st_size > 10_000
    measured.write_text("time,force\n0,1\n")
    with pytest.raises(PreparationError, match="needs a run of solver direct with logHub") as error:
        commands.run(commands.parse(["compare", str(run), str(measured)]))
    assert "\n" not in str(error.value)


def test_an_unknown_figure_is_one_line_that_names_those_there_are(typed):
    done = typed("figures", "9.9")
    assert done.returncode == 2
    assert "no figure 9.9" in done.stderr and "4.5" in done.stderr


def test_a_folder_that_cannot_be_made_is_one_line(typed):
    done = typed("sweep", "default", "--out", "/proc/guidewire")
    assert done.returncode == 2
    assert [line for line in done.stderr.splitlines() if "/proc/guidewire" in line] == done.stderr.splitlines()[-1:]


def test_an_error_of_the_program_itself_is_one_line_and_a_trace_in_a_file(capsys):
    def broken(_):
        raise ZeroDivisionError("a mistake")

    assert commands.run(argparse.Namespace(action=broken, command="run")) == 70
    line = capsys.readouterr().err
    assert line.count("\n") == 1 and "ZeroDivisionError: a mistake" in line
    assert "in broken" in Path(line.split("please report ")[1].strip()).read_text()


class Screen(io.StringIO):
    """Standard error that is a terminal or not, and says when a first second was counted."""

    def __init__(self, is_terminal):
        super().__init__()
        self.counted = threading.Event()
        self._is_terminal = is_terminal

    def isatty(self):
        return self._is_terminal

    def write(self, text):
        if " s" in text:
            self.counted.set()
        return super().write(text)


@pytest.mark.parametrize("is_terminal", [True, False])
def test_a_build_is_reported_in_lines_whose_seconds_are_counted_on_a_terminal_only(monkeypatch, is_terminal):
    screen = Screen(is_terminal)
    monkeypatch.setattr(sys, "stderr", screen)

    def build(_, tell):
        tell("waiting")
        assert not is_terminal or screen.counted.wait(60.0)
        tell("building it")
        return ["program"]

    monkeypatch.setattr(building, "build", build)
    assert making.build_runner() == ["program"]
    lines = screen.getvalue().splitlines() if not is_terminal else screen.getvalue().split("\n")[:-1]
    assert [line.split("\r")[0] for line in lines] == ["waiting", "building it"]
    assert ("\rwaiting: 1 s" in screen.getvalue()) == is_terminal


def test_a_reader_that_has_gone_is_no_error():
    program = subprocess.Popen([sys.executable, str(ROOT / "guidewire.py"), "keys"], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE)
    program.stdout.close()
    assert program.stderr.read() == b"" and program.wait() == 141


def test_every_command_is_in_one_group_of_the_help_and_the_package_lists_only_what_it_can_do(monkeypatch, capsys):
    names = [name for group in command_line.GROUPS.values() for name in group]
    for installed in (False, True):
        monkeypatch.setattr(command_line, "INSTALLED", installed)
        with pytest.raises(SystemExit):
            command_line.parse(["--help"])
        listed = re.findall(r"^  ([a-z][a-z-]+) +[^-]", capsys.readouterr().out, re.M)
        assert listed == [name for name in names if not installed or name not in command_line.OF_THE_REPOSITORY]
    monkeypatch.undo()
    for name in {*names, "demo"}:
        with pytest.raises(SystemExit) as ended:
            command_line.parse([name, "--help"])
        assert ended.value.code == 0
    assert sorted(names) == sorted({*commands._ACTIONS, *commands._ELSEWHERE})
