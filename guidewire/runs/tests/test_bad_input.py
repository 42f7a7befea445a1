"""What a user can get wrong ends in one line that helps, exit code 2, and nothing written."""

import hashlib
import json
import os
import shutil
import subprocess

import pytest

from guidewire.runs.runner import Request

GOOD = {"numberRodElements": 4, "constraintSolverSteps": 10, "maxSimulationSteps": 5}


def run(command, *arguments, **options):
    return subprocess.run([*command, *map(str, arguments)], capture_output=True, text=True, check=False, **options)


def contents(folder):
    """Name to digest of everything in a folder."""
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir()}


def assert_one_line(done, *words):
    """Exit code 2 and one line on stderr with these words, no stack trace, nothing on stdout."""
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith("guidewire: ") and done.stdout == "", done.stderr
    assert_helps(done.stderr, words)


def assert_answered(answer, *words):
    """Exit code 2 and one line with these words, no stack trace."""
    assert (answer.exit_code, answer.outcome) == (2, None), answer
    assert_helps(answer.message, words)


def assert_helps(message, words):
    assert len(message.splitlines()) == 1
    assert all(word in message for word in words), message
    assert not any(trace in message for trace in ("   at ", "Exception", "Newtonsoft", ".cs:"))


@pytest.fixture(scope="module")
def good_run(runner_command, tmp_path_factory):
    """A folder with a scene and the result of its run."""
    folder = tmp_path_factory.mktemp("good")
    (folder / "good.json").write_text(json.dumps(GOOD))
    assert run(runner_command, "-parameters", folder / "good.json", "-out", folder / "earlier").returncode == 0
    return folder


@pytest.fixture
def earlier(good_run, tmp_path):
    """A folder that holds the result of an earlier run, in one that is the test's own."""
    shutil.copytree(good_run, tmp_path, dirs_exist_ok=True)
    return tmp_path / "earlier"


# What stands in the file; the words that the line must hold beside the file's name.
BAD_FILES = {
    "not JSON": ("hello", ["JSON"]),
    "empty": ("", ["JSON"]),
    "a list": ("[1, 2]", ["object"]),
    "cut short": ('{"timeStep": 0.01', ["JSON"]),
    "trailing comma": ('{"timeStep": 0.01,}', ["JSON", "comma"]),
    "comment": ('{"timeStep": 0.01} // s', ["JSON"]),
    "single quotes": ("{'timeStep': 0.01}", ["JSON"]),
    "duplicate key": ('{"timeStep": 0.01, "timeStep": 0.02}', ["timeStep", "second time"]),
    "duplicate key behind an escape": ('{"timeStep": 0.01, "time\\u0053tep": 0.02}', ["timeStep", "second time"]),
    "escape that is none": ('{"startFile": "\\u00G0"}', ["JSON", "escape"]),
    "escape that is cut short": ('{"startFile": "\\u00"}', ["JSON", "escape"]),
    "misspelt key": ('{"timestepp": 0.01}', ["timestepp", "timeStep"]),
    "wrong case": ('{"timestep": 0.01}', ["timestep", "'timeStep'"]),
    "string for number": ('{"timeStep": "0.01"}', ["timeStep", '"0.01"', "number > 0", "(s)"]),
    "bool for number": ('{"timeStep": true}', ["timeStep", "true", "number > 0"]),
    "null": ('{"timeStep": null}', ["timeStep", "null", "number > 0"]),
    "list for number": ('{"timeStep": [0.01]}', ["timeStep", "[0.01]", "number > 0"]),
    "number for bool": ('{"SteadyState": 1}', ["SteadyState", "1", "true or false"]),
    "number for word": ('{"drive": 1}', ["drive", "1", "hold"]),
    "unknown word": ('{"sweepOrder": "naif"}', ["sweepOrder", "naif", "naive", "bilateral"]),
    "NaN": ('{"timeStep": NaN}', ["JSON"]),
    "Infinity": ('{"timeStep": Infinity}', ["JSON"]),
    "-Infinity": ('{"guidewireOffset": -Infinity}', ["JSON"]),
    "number beyond double": ('{"timeStep": 1e999}', ["timeStep", "number > 0"]),
    "negative": ('{"timeStep": -0.01}', ["timeStep", "-0.01", "number > 0"]),
    "zero": ('{"totalMass": 0}', ["totalMass", "0", "number > 0"]),
    "negative zero": ('{"guidewireLength": -0.0}', ["guidewireLength", "number > 0"]),
    "negative steps": ('{"maxSimulationSteps": -1}', ["maxSimulationSteps", "-1", "whole number from 0"]),
    "no elements": ('{"numberRodElements": 0}', ["numberRodElements", "0", "whole number from 1"]),
    "a billion elements": ('{"numberRodElements": 1000000000}', ["numberRodElements", "1000000000", "whole number"]),
    "half an element": ('{"numberRodElements": 2.5}', ["numberRodElements", "2.5", "whole number"]),
    "a huge whole number": ('{"numberRodElements": 1' + "0" * 40 + "}", ["numberRodElements", "whole number"]),
    "damping above 1": ('{"damping": 1.5}', ["damping", "1.5", "<= 1"]),
    "two numbers for a vector": ('{"gravity": [0, 1]}', ["gravity", "[0,1]", "three numbers"]),
    "no direction": ('{"displacementDirection": [0, 0, 0]}', ["displacementDirection", "[0,0,0]", "not all 0"]),
    "old and new key disagree": ('{"VerletIntegration": true, "integrator": "euler"}',
                                 ["VerletIntegration", "integrator", "disagree"]),
    "a file to start from that is missing": ('{"startFile": "no-such-start.json"}',
                                             ["startFile", "no-such-start.json", "no such"]),
    "nested beyond any meaning": ("[" * 100_000, ["JSON"]),
}


@pytest.mark.parametrize("text, words", BAD_FILES.values(), ids=BAD_FILES)
def test_a_bad_file_is_one_line_and_writes_nothing(live, tmp_path, earlier, text, words):
    scene = tmp_path / "scene.json"
    scene.write_text(text)
    before = contents(earlier)
    assert_answered(live.run(Request("bad", scene, earlier)), str(scene), *words)
    assert contents(earlier) == before
    assert_answered(live.run(Request("bad", scene, tmp_path / "fresh")), str(scene), *words)
    assert not (tmp_path / "fresh").exists()


@pytest.mark.parametrize("name", ["not JSON", "misspelt key", "nested beyond any meaning"])
def test_the_console_says_the_line_of_the_answer(runner_command, live, tmp_path, earlier, name):
    scene = tmp_path / "scene.json"
    scene.write_text(BAD_FILES[name][0])
    before = contents(earlier)
    done = run(runner_command, "-parameters", scene, "-out", earlier)
    assert_one_line(done, str(scene))
    assert done.stderr == f"guidewire: {live.run(Request('bad', scene, earlier)).message}\n"
    assert contents(earlier) == before


BAD_ARGUMENTS = {
    "unknown key": (["-colour", "red"], ["-colour"]),
    "misspelt key": (["-timeStpe", "0.1"], ["-timeStpe", "timeStep"]),
    "value missing": (["-timeStep"], ["-timeStep", "number > 0"]),
    "value is no number": (["-timeStep", "fast"], ["timeStep", "fast", "number > 0"]),
    "value is out of range": (["-timeStep", "-1"], ["timeStep", "-1", "number > 0"]),
    "NaN": (["-timeStep", "NaN"], ["timeStep", "NaN", "number > 0"]),
    "value without key": (["0.1"], ["'0.1'", "key"]),
    "empty argument": (["", "1"], ["key"]),
    "repeat is no number": (["-repeat", "x"], ["repeat", "x", "whole number"]),
    "a billion elements": (["-numberRodElements", "1e9"], ["numberRodElements", "whole number"]),
}


@pytest.mark.parametrize("arguments, words", BAD_ARGUMENTS.values(), ids=BAD_ARGUMENTS)
def test_a_bad_argument_is_one_line_and_writes_nothing(runner_command, tmp_path, earlier, arguments, words):
    before = contents(earlier)
    done = run(runner_command, "-parameters", tmp_path / "good.json", "-out", earlier, *arguments)
    assert_one_line(done, *words)
    assert contents(earlier) == before


def test_a_missing_file_is_one_line(runner_command, tmp_path):
    done = run(runner_command, "-parameters", tmp_path / "nothing.json", "-out", tmp_path / "out")
    assert_one_line(done, str(tmp_path / "nothing.json"), "no such file")
    assert not (tmp_path / "out").exists()


def test_a_folder_for_a_file_is_one_line(runner_command, tmp_path):
    done = run(runner_command, "-parameters", tmp_path, "-out", tmp_path / "out")
    assert_one_line(done, str(tmp_path), "folder")
    assert not (tmp_path / "out").exists()


def test_a_file_of_bytes_that_are_no_text_is_one_line(runner_command, tmp_path):
    scene = tmp_path / "scene.json"
    scene.write_bytes(bytes(range(256)) * 10)
    assert_one_line(run(runner_command, "-parameters", scene, "-out", tmp_path / "out"), str(scene), "JSON")


def test_no_arguments_and_no_folder_are_one_line(runner_command, tmp_path):
    assert_one_line(run(runner_command), "-parameters")
    scene = tmp_path / "good.json"
    scene.write_text(json.dumps(GOOD))
    assert_one_line(run(runner_command, "-parameters", scene, cwd=tmp_path), "-out")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["good.json"]


def test_an_output_folder_that_is_a_file_is_one_line(runner_command, tmp_path, earlier):
    place = tmp_path / "a-file"
    place.write_text("precious")
    for out in (place, place / "below"):
        assert_one_line(run(runner_command, "-parameters", tmp_path / "good.json", "-out", out), str(out), "out")
    assert place.read_text() == "precious"


def test_an_output_folder_that_nobody_may_write_to_is_one_line(runner_command, tmp_path, earlier):
    if os.geteuid() == 0:
        # Root may write everywhere but where the kernel itself has the say.
        out = "/proc/guidewire"
        assert_one_line(run(runner_command, "-parameters", tmp_path / "good.json", "-out", out), out, "out")
        return
    earlier.chmod(0o555)
    before = contents(earlier)
    done = run(runner_command, "-parameters", tmp_path / "good.json", "-out", earlier)
    earlier.chmod(0o755)
    assert_one_line(done, str(earlier), "out")
    assert contents(earlier) == before


def test_bad_input_in_lines_mode_is_answered_and_the_next_request_is_served(runner_command, tmp_path, earlier):
    bad = tmp_path / "bad.json"
    bad.write_text('{"timeStep": 0}')
    requests = [
        {"id": 1, "parameters": str(bad), "out": str(tmp_path / "out")},
        {"id": 2, "parameters": str(tmp_path / "good.json"), "set": {"timeStep": "x"}, "out": str(tmp_path / "out")},
        {"id": 3, "parameters": 3, "out": str(tmp_path / "out")},
        {"id": 4, "parameters": str(tmp_path / "good.json"), "out": str(tmp_path / "good")},
    ]
    lines = ["this is no JSON", *map(json.dumps, requests), '{"id": 5,}', "[]", "{}"]
    done = run([*runner_command, "-lines"], input="\n".join(lines) + "\n")
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert done.stderr == "" and done.returncode == 0
    assert [answer["exitCode"] for answer in answers] == [2, 2, 2, 2, 0, 2, 2, 2]
    assert [answer["id"] for answer in answers[1:5]] == [1, 2, 3, 4]
    assert all("\n" not in answer["message"] and answer["message"] for answer in answers)
    assert not (tmp_path / "out").exists() and (tmp_path / "good" / "summary.json").exists()


STRAIGHT = {"positions": [[0, 0, 0], [0, 0, 1]], "orientations": [[0, 0, 0, 1]]}
BAD_STARTS = {
    "no positions": ({"positions": None}, ["positions", "list of 2"]),
    "one position too few": ({"positions": [[0, 0, 0]]}, ["positions", "list of 2"]),
    "one orientation too many": ({"orientations": [[0, 0, 0, 1]] * 2}, ["orientations", "list of 1"]),
    "a position of two numbers": ({"positions": [[0, 0, 0], [0, 1]]}, ["positions[1]", "three numbers"]),
    "a word for a number": ({"positions": [[0, 0, 0], [0, 0, "1"]]}, ["positions[1]", "three numbers"]),
    "no direction": ({"orientations": [[0, 0, 0, 0]]}, ["orientations[0]", "not all 0"]),
    "velocities of one sphere": ({"velocities": [[0, 0, 0]]}, ["velocities", "list of 2"]),
    "an unknown key": ({"position": []}, ["position", "positions, orientations"]),
}


@pytest.mark.parametrize("change, words", BAD_STARTS.values(), ids=BAD_STARTS)
def test_a_bad_file_to_start_from_is_one_line_and_writes_nothing(live, tmp_path, change, words):
    start, scene = tmp_path / "start.json", tmp_path / "scene.json"
    start.write_text(json.dumps({**STRAIGHT, **change}))
    scene.write_text(json.dumps({"numberRodElements": 1, "guidewireLength": 1, "startFile": str(start)}))
    answer = live.run(Request("start", scene, tmp_path / "out"))
    assert_answered(answer, str(scene), "startFile", str(start), *words)
    assert not (tmp_path / "out").exists()
