"""Files and calls as a new user writes them: each does what it says, or ends in one line that says what is wrong."""

import contextlib
import io
import json
import pickle

import numpy as np
import pytest

from guidewire import Environment, Session, SessionError, VectorEnvironment
from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.lines import read_lines
from guidewire.env.spaces import Error
from guidewire.env.task import find_task
from guidewire.library import find_study
from guidewire.prepare import PreparationError
from guidewire.runs import checking
from guidewire.runs.runner import Request

SMALL = '"maxSimulationSteps": 1, "displacement": 0'
DRIVEN = {"solver": "direct", "drive": "displace", "proximalEnd": "clamped", "guidewireLength": 50,
          "numberRodElements": 5,
          "timeStep": 0.5, "maxSimulationSteps": 2, "deltaThreshold": 0, "driveFile": "hub.csv", "logHub": True}
STUDY = '"study": "mine", "scene": "scene.json"'
TASK = '"anatomies": [{"make": "iliac", "seed": 1, "inlet": 1, "target": 2}], "targets": [2]'


def assert_one_line(text, words):
    assert words in text and "\n" not in text.strip() and "Traceback" not in text, text


@pytest.mark.parametrize("text, said", [
    ("{" + SMALL + ', "note": "my first wire"}', None),
    ("\ufeff{" + SMALL + "}", None),
    ('{"timeStep": 0,01}', "JSON has a decimal point, not a comma"),
    ('{"timeStep": 0.01  // s\n}', "line 1, column 20 has a comment, and JSON has none"),
    ('# my wire\n{"timeStep": 0.01}', "line 1, column 1 has a comment"),
    ('{"comment": "my wire"}', "a text for readers goes under the key 'note'"),
    ('{"timestep": 0.01}', "did you mean 'timeStep'?"),
    ('{"timeStep": "0.01"}', 'timeStep = "0.01" is not allowed'),
    ('{"timeStep": 0.01,}', "comma before '}'"),
    ("{'timeStep': 0.01}", "a key in double quotes"),
    ('{"solver": "Direct"}', 'solver = "Direct" is not allowed'),
    ('{"gravity": -9.81}', "three numbers"),
    ("timeStep: 0.01", "not JSON"),
])
def test_parameter_files(live, tmp_path, text, said):
    file = tmp_path / "scene.json"
    file.write_text(text, encoding="utf-8")
    answer = live.run(Request("a", file, tmp_path / "out"))
    if said is None:
        checking.check_file(file)
        assert answer.exit_code == 0, answer.message
        return
    assert answer.exit_code == 2
    assert_one_line(answer.message, said)
    try:    # before a build: what is refused there has the same reason
        checking.check_file(file)
    except PreparationError as error:
        assert_one_line(str(error), "scene.json")


@pytest.mark.parametrize("text, said", [
    ("time,insertion,rotation\n0,0,0\n1,0.01,0.5\n", None),
    ("time,rotation,insertion\n0,0,0\n1,0.5,0.01\n", None),
    ("time_s,insertion_mm,rotation_deg\n0,0,0\n1,10,28.64788975654116\n", None),
    ("# time insertion rotation\n0, 0, 0\n1, 0.01, 0.5\n", None),
    ("time;insertion;rotation\n0;0;0\n1;0,01;0,5\n", "no semicolons"),
    ("0;0;0\n1;0,01;0,5\n", "commas separate columns, and numbers have a decimal point"),
    ("0,0,0\n1,0,01,0,5\n", "numbers have a decimal point, not a comma"),
    ("0 0 0\n1 0.01 0.5\n", "commas separate columns"),
    ("t,x,phi\n0,0,0\n1,0.01,0.5\n", "has a column 't': allowed are time, insertion, rotation"),
    ("time,insertion\n0,0\n1,0.01\n", "has no column 'rotation'"),
    ("time,insertion_inches,rotation\n0,0,0\n1,0.4,0.5\n", "in an unknown unit: allowed are m, cm, mm"),
    ("0,0,0\n1,0.01,0.5\n0.5,0.02,0.5\n", "increase"),
    ("", "at least one row"),
])
def test_drive_tables(live, tmp_path, text, said):
    (tmp_path / "scene.json").write_text(json.dumps(DRIVEN))
    (tmp_path / "hub.csv").write_text(text)
    answer = live.run(Request("a", tmp_path / "scene.json", tmp_path / "out"))
    if said is None:
        hub = json.loads((tmp_path / "out" / "summary.json").read_text())["hub"]
        assert hub["insertion"] == pytest.approx(0.01) and hub["turn"] == pytest.approx(0.5)
        return
    assert answer.exit_code == 2 and "hub.csv" in answer.message
    assert_one_line(answer.message, said)


@pytest.mark.parametrize("asked, said", [
    (lambda s: s.step(push="1"), "push = '1' is not allowed: needs a finite number"),
    (lambda s: s.step(1.0, 0.0, 0), "steps = 0 is not allowed"),
    (lambda s: s.step(steps=2.5), "steps = 2.5 is not allowed"),
    (lambda s: s.step(hub=1), "hub"),
    (lambda s: s.change(timestep=0.1), "set: unknown key 'timestep': did you mean 'timeStep'?"),
    (lambda s: s.change(timeStep="fast"), "set: timeStep = \"fast\" is not allowed"),
    (lambda s: s.change(numberRodElements=7), "numberRodElements needs to leave 30 elements"),
    (lambda s: Session(None, maxsteps=3), "unknown key 'maxsteps'"),
    (lambda s: Session("nowhere.json"), "nowhere.json: no such file"),
    (lambda s: pickle.dumps(s), "a session cannot be pickled"),
    (lambda s: s.restore(b"1234"), ""),
    (lambda s: (s.close(), s.step()), "this session is closed"),
])
def test_sessions(runner_command, asked, said):
    with Session(None, hand=True) as session:
        state = session.step(push=1.0)
        assert repr(state).startswith("State(step 1, ") and "\n" not in repr(state)
        with pytest.raises(SessionError) as caught:
            asked(session)
        assert_one_line(str(caught.value), said)
        if session.is_open:
            assert session.step().step == 2    # it goes on


@pytest.mark.parametrize("asked, said", [
    (lambda folder: Environment("artry"), "did you mean 'artery'?"),
    (lambda folder: Environment(folder / "nowhere.json"), "nowhere.json: No such file"),
    (lambda folder: Environment(_file(folder, "{" + TASK + ", // a tube\n}")), "has a comment, and JSON has none"),
    (lambda folder: Environment(_file(folder, '{"tolerance": 0,5, ' + TASK + "}")), "a decimal point, not a comma"),
    (lambda folder: Environment(_file(folder, "[1]")), "a task is one JSON object"),
    (lambda folder: Environment(_file(folder, '{"goal": 2, ' + TASK + "}")), 'has no key "goal"'),
    (lambda folder: Environment("artery", safe_force=-1.0), "safe_force = -1.0"),
    (lambda folder: Environment("artery").step(np.zeros(2)), "reset"),
    (lambda folder: VectorEnvironment("artery", 0), "num_envs"),
    (lambda folder: VectorEnvironment("artery", 2, backend="process"), "needs \"threads\" or \"processes\""),
    (lambda folder: Environment("artery", render_mode="ansi"), "render_mode"),
])
def test_environments(tmp_path, asked, said):
    with pytest.raises(Error) as caught:
        asked(tmp_path)
    assert_one_line(str(caught.value), said)


def test_a_task_of_ones_own_with_a_note_is_an_environment(runner_command, tmp_path):
    pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")
    with Environment(_file(tmp_path, '{"note": "mine", "overrides": {"timeStep": 0.07}, ' + TASK + "}")) as environment:
        environment.reset(seed=1)
        environment.step(environment.action_space.sample())


def test_a_task_whose_scene_has_another_time_step_takes_one_that_divides_an_action(tmp_path):
    for step, taken in ((0.05, 0.14 / 3.0), (0.07, 0.07), (1.0, 0.14), (0.02, 0.02)):
        (tmp_path / "scene.json").write_text(json.dumps({"timeStep": step}))
        task = find_task(_file(tmp_path, '{"scene": "scene.json", ' + TASK + "}"))
        assert task.overrides["timeStep"] == pytest.approx(taken)
    stated = find_task(_file(tmp_path, '{"scene": "scene.json", "overrides": {"timeStep": 0.1}, ' + TASK + "}"))
    assert stated.overrides["timeStep"] == 0.1


def _file(folder, text):
    (folder / "task.json").write_text(text)
    return folder / "task.json"


@pytest.mark.parametrize("text, said", [
    ("x,y,z,radius\n0,0,0,1\n0,0,9,2\n", None),
    ("radius,z,y,x\n1,0,0,0\n2,9,0,0\n", None),
    ("x_mm;y_mm;z_mm;r_mm\n0;0;0;1\n0;0;9;2\n", None),
    ("index,x,y,z,MaximumInscribedSphereRadius\n0,0,0,0,1\n1,0,0,9,2\n", None),
    ("0,0,0,1\n0,0,9,2\n", None),
    ("x,y,z\n0,0,0\n0,0,9\n", "line 1 has no column radius"),
    ("a,b,c,d\n0,0,0,1\n0,0,9,2\n", "line 1 has no column x: needed are x, y, z, radius"),
    ("x_mm,y_mm,z_mm,radius_cm\n0,0,0,1\n0,0,9,2\n", "in one unit"),
    ("x;y;z;radius\n0;0;0;1,5\n0;0;9;2,5\n", "line 2 is not x, y, z, radius: 0;0;0;1,5; numbers have a decimal point"),
    ("0 0 0 1\n0 0 9 2\n", "line 1 is not x, y, z, radius"),
    ("0,0,0,1\n", "1 points: a centreline has two or more"),
    ("0,0,0,1\n0,0,9,-2\n", "a radius above 0"),
    ("", "0 points"),
])
def test_anatomies(tmp_path, text, said):
    (tmp_path / "line.csv").write_text(text)
    if said is None:
        found = read_lines(tmp_path / "line.csv", ".csv")
        line = found.lines[0]
        assert line.points.tolist() == [[0, 0, 0], [0, 0, 9]] and line.radii.tolist() == [1, 2]
        assert found.unit == ("mm" if "_mm" in text else "")
        return
    with pytest.raises(AnatomyError) as caught:
        read_lines(tmp_path / "line.csv", ".csv")
    assert_one_line(str(caught.value), said)


@pytest.mark.parametrize("text, said", [
    ("{" + STUDY + ', "note": "why", "axes": {"timeStep": [0.1, 0.2]}}', None),
    ("{" + STUDY + ', "axes": {"timeStep": {"from": 0.1, "to": 0.2, "count": 3}}}', None),
    ("{" + STUDY + ', "axes": {"timeStep": [0,1]}} # steps', "has a comment, and JSON has none"),
    ("{" + STUDY + ', "timeLimit": 0,5, "axes": {"timeStep": [1]}}', "a decimal point, not a comma"),
    ("{" + STUDY + ', "axis": {"timeStep": [0.1]}}', "did you mean 'axes'?"),
    ('{"study": "mine", "axes": {"timeStep": [0.1]}}', "has no 'scene'"),
    ('{"study": "mine", "scene": "nowhere.json", "axes": {"timeStep": [0.1]}}', "a parameter file"),
    ("{" + STUDY + "}", "asks for no run"),
    ("{" + STUDY + ', "axes": {"timeStep": 0.1}}', "timeStep"),
    ("{" + STUDY + ', "axes": {"timeStep": [0.1]}, "repeats": -1}', "repeats"),
    ("{" + STUDY + ', "axes": {"timeStep": {"from": 1}}}', "count"),
    ('{"study": "my/study", "scene": "scene.json", "axes": {"timeStep": [0.1]}}', "my/study"),
    ("", "is not JSON"),
])
def test_sweeps(tmp_path, text, said):
    (tmp_path / "scene.json").write_text("{}")
    (tmp_path / "mine.json").write_text(text)
    with contextlib.redirect_stderr(io.StringIO()) as complaints:
        if said is None:
            assert find_study(tmp_path / "mine.json", None).grid.count in (2, 3)
            return
        with pytest.raises(PreparationError) as caught:
            find_study(tmp_path / "mine.json", None)
    assert_one_line(str(caught.value), said)
    assert complaints.getvalue() == ""
