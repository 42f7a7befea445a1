"""Arguments and files are checked before anything is built, and the check refuses nothing that the runner takes."""

import os
import subprocess
import sys

import pytest

from guidewire.commands import commands
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building, checking
from guidewire.runs.runner import Request

SCENE = str(ROOT / "params" / "default.json")
LONG_NAME = "x" * 300


class Built(Exception):
    """Something was to be built."""


@pytest.fixture
def unbuilt(monkeypatch, tmp_path):
    """A function that types a command where the compiler must not be started; returns the line that refused it."""
    def build(*_):
        raise Built

    monkeypatch.setattr(building, "build", build)
    monkeypatch.chdir(tmp_path)

    def type_in(*words):
        with pytest.raises(PreparationError) as refused:
            commands.parse(words).action(commands.parse(words))
        line = str(refused.value)
        assert "\n" not in line and len(line) < 300
        return line

    return type_in


@pytest.mark.parametrize("text, words", [
    (None, ["No such file", "params/default.json"]), ("hello", ["not JSON", "line 1"]),
    ('{"timeStep": 0.1,\n "damping": }', ["not JSON", "line 2, column 13"]), ("[1]", ["not a JSON object"]),
    ('{"timestpe": 0.1}', ["'timestpe'", "did you mean 'timeStep'?"]),
    ('{"timeStep": 0}', ["timeStep = 0", "a number > 0 (s)"]), ('{"timeStep": "1"}', ['timeStep = "1"']),
    ('{"damping": 1.5}', ["<= 1"]), ('{"numberRodElements": 2.5}', ["2.5", "a whole number"]),
    ('{"numberRodElements": true}', ["true"]), ('{"timeStep": 1' + "0" * 400 + "}", ["timeStep"]),
    ("[" * 100_000, ["not JSON"]),
    ('{"study": "a", "axes": {}}', ["a study, not a parameter file", "sweep scene.json' makes its runs"]),
])
def test_a_bad_file_is_refused_before_a_build(unbuilt, tmp_path, text, words):
    if text is not None:
        (tmp_path / "scene.json").write_text(text)
    line = unbuilt("run", "scene.json")
    assert line.startswith("scene.json: ")
    for word in words:
        assert word in line


@pytest.mark.parametrize("assignment, words", [
    ("timestep=0.1", ["'timestep'", "'timeStep'"]), ("timeStep=fast", ["timeStep = fast", "> 0"]),
    ("timeStep=-1", ["-1"]), ("timeStep=nan", ["nan"]), ("timeStpe=1", ["'timeStpe'", "'timeStep'"]),
    ("maxSimulationSteps=0.5", ["a whole number"]),
])
def test_a_bad_assignment_is_refused_before_a_build(unbuilt, assignment, words):
    line = unbuilt("run", SCENE, "--set", assignment)
    assert line.startswith("command line: ")
    for word in words:
        assert word in line


@pytest.mark.parametrize("out", ["/proc/guidewire", "/dev/null", "a-file", "a-file/below", LONG_NAME,
                                 f"new/{LONG_NAME}"])
@pytest.mark.parametrize("command", [["run", SCENE], ["sweep", "default"], ["figures", "4.5"], ["demo"],
                                     ["modes", SCENE], ["instrument", "amplatz-0.035"]], ids=lambda words: words[0])
def test_a_folder_that_cannot_be_is_named_before_a_build(unbuilt, tmp_path, command, out):
    (tmp_path / "a-file").write_text("kept")
    line = unbuilt(*command, "--out", out)
    assert line.startswith(f"out = {out[:60]}") and "cannot be written" in line
    assert [path.name for path in tmp_path.iterdir()] == ["a-file"], "nothing is left"
    assert (tmp_path / "a-file").read_text() == "kept"


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_of_another_user_is_named_before_a_build(unbuilt):
    theirs = os.path.join(os.path.expanduser("~root"), "guidewire")
    assert "Permission denied" in unbuilt("run", SCENE, "--out", theirs)


def test_an_empty_name_is_no_folder(capsys):
    with pytest.raises(SystemExit) as end:
        commands.parse(["run", SCENE, "--out", ""])
    assert end.value.code == 2 and capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("out", ["results/a/b", "."])
def test_a_folder_that_can_be_is_let_pass_and_is_not_made(unbuilt, tmp_path, out):
    arguments = commands.parse(["run", SCENE, "--out", out])
    with pytest.raises(Built):
        arguments.action(arguments)
    assert list(tmp_path.iterdir()) == []


def test_every_scene_of_the_repository_and_every_effective_value_is_let_pass(live, tmp_path):
    for scene in sorted((ROOT / "params").glob("*.json")):
        checking.check_file(scene)
        answer = live.run(Request(scene.stem, scene, tmp_path / scene.stem, {"maxSimulationSteps": 0}))
        assert answer.exit_code == 0, answer.message
        checking.check_file(tmp_path / scene.stem / "parameters.json")


@pytest.mark.parametrize("name", ["vessel.radius", "wireSections[-1].youngsModulus", "gravity[1]", "bendingStiffness"])
def test_parts_of_keys_and_null_are_left_to_the_runner(name):
    checking.check_overrides([(name, "null"), (name, "0.1")])


def test_a_part_of_a_key_that_is_not_known_is_refused_with_the_near_one():
    with pytest.raises(PreparationError, match=r"unknown key 'vesel\.radius': did you mean 'vessel\.radius'\?"):
        checking.check_overrides([("vesel.radius", "1")])


def type_keys(capsys, *words):
    arguments = commands.parse(["keys", *words])
    assert arguments.action(arguments) == 0
    return capsys.readouterr().out


def test_keys_are_found_by_name_by_meaning_and_by_solver(capsys):
    assert type_keys(capsys).count("; solver ") == len(checking.read_table())
    found = type_keys(capsys, "stiffness", "--solver", "direct")
    assert "bendingStiffness: null or a number > 0 (N m^2); default null; solver xpbd, direct" in found
    assert "bendStiffness:" not in found and "EI of the whole wire" in found
    assert type_keys(capsys, "Vessel.radius").startswith("vessel: null, {")
    assert "youngsModulus" not in type_keys(capsys, "bendStiffness") and "Kelvin" in type_keys(capsys, "kelvin")


def test_keys_are_those_of_the_runner_that_is_built(monkeypatch, tmp_path, capsys, runner_command):
    """A key of a contributor's own, which the page does not have, and which is spelt like one that it has."""
    printed = subprocess.run([*runner_command, "--keys"], capture_output=True, text=True, check=True).stdout
    row = next(line for line in printed.splitlines() if line.startswith("| `massDamping`"))
    (tmp_path / "keys.md").write_text(printed + row.replace("massDamping", "massDampings") + "\n")
    (tmp_path / "runner.py").write_text("print(open(__file__.replace('runner.py', 'keys.md')).read())")
    command = [sys.executable, str(tmp_path / "runner.py")]
    monkeypatch.setattr(building, "built", lambda project: command)
    monkeypatch.setattr(building, "build", lambda project, tell: command)
    assert type_keys(capsys, "massDampings").startswith("massDampings: ")
    checking.check_overrides([("massDampings", "1")])
    with pytest.raises(PreparationError, match="did you mean 'massDamping'"):
        checking.check_overrides([("masDamping", "1")])


@pytest.mark.parametrize("words, said", [
    (["stiffnes_"], "no key has 'stiffnes_'"), (["dampin9"], "near are damping"),
    (["bendStiffness", "--solver", "direct"], "solver direct takes no key with 'bendStiffness': near are bend"),
])
def test_a_word_without_a_key_is_refused_with_near_ones(unbuilt, monkeypatch, words, said):
    monkeypatch.setattr(building, "built", lambda project: None)
    line = unbuilt("keys", *words)
    assert said in line and (words[-1] != "direct" or "bendStiffness," not in line)
