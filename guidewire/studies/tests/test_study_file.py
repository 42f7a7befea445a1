"""Studies that users write: what a file may hold, what it is made into, and that whatever is wrong in it is one
line."""

import json
import math
import subprocess
import sys

import pytest

from guidewire.prepare import ROOT
from guidewire.studies.bisection import Bisection, Holds
from guidewire.studies.sampling import Range, sample
from guidewire.studies.study_file import StudyFileError, read_study_file
from guidewire.studies.table import Axis, Grid, Rows

SCENE = {"study": "mine", "scene": "scene.json"}


@pytest.fixture
def read(tmp_path):
    def read(text, **options):
        (tmp_path / "scene.json").write_text("{}")
        path = tmp_path / "mine.json"
        path.write_text(text if isinstance(text, str) else json.dumps({**SCENE, **text}))
        return read_study_file(path, **options)

    return read


def test_axes_lists_variants_and_samples_are_multiplied(read, tmp_path):
    study = read({
        "question": "why?", "common": {"damping": 0.1}, "variants": {"a": {}, "b": {"damping": 0.2}},
        "axes": {"timeStep": [0.1, 0.2], "totalMass": {"from": 0.01, "to": 1, "count": 3, "scale": "log"}},
        "list": [{"gravity": 1, "displacement": 2}, {"gravity": 3, "displacement": 4}],
        "sample": {"method": "latinHypercube", "count": 5, "ranges": {"sphereRadius": {"from": 1, "to": 2}}},
        "repeats": 1, "logs": True, "timeLimit": 60, "duration": 1.0, "leastSteps": 7,
    })
    assert (study.name, study.title, study.scene, study.logs, study.seconds) == (
        "mine", "why?", str(tmp_path / "scene.json"), True, 60)
    cases = study.grid.cases()
    assert len(cases) == 2 * 2 * 3 * 2 * 5 and study.grid.count == 2 * len(cases)
    first = cases[0]
    assert first.key == "a,timeStep=0.1,totalMass=0.01,run-1,sample-1"
    assert first.overrides["maxSimulationSteps"] == 10 and first.overrides["displacement"] == 2
    assert [case.values["totalMass"] for case in cases[:30:10]] == pytest.approx([0.01, 0.1, 1.0])
    assert cases[-1].overrides["damping"] == 0.2 and cases[-1].overrides["maxSimulationSteps"] == 7


def test_a_bisection_is_read(read):
    study = read({"axes": {"numberRodElements": [5, 10]}, "bisection": {
        "key": "timeStep", "from": 1e-4, "to": 0.1, "scale": "log", "width": 0.1,
        "holds": {"outcomes": ["finished"], "atMost": {"passages": 0}}}})
    assert study.grid == Bisection(Grid((Axis("numberRodElements", (5, 10)),)), Range("timeStep", 1e-4, 0.1, True), 0.1,
                                   Holds(("finished",), {"passages": 0}))
    assert "failed" in study.results  # a solver that gives up is what a frontier is made of


def test_a_latin_hypercube_has_one_point_in_each_part_of_each_range():
    rows = sample("latinHypercube", [Range("a", 0.0, 1.0), Range("b", 1.0, 100.0, True)], 20, 3)
    assert rows == sample("latinHypercube", [Range("a", 0.0, 1.0), Range("b", 1.0, 100.0, True)], 20, 3)
    assert sorted(int(20 * a) for a, _ in rows.rows) == list(range(20))
    assert sorted(int(20 * math.log(b) / math.log(100.0)) for _, b in rows.rows) == list(range(20))


def test_whole_numbers_of_a_range_are_all_as_likely():
    ones = [row[0] for row in sample("random", [Range("n", 1, 3, whole=True)], 3000, 1).rows]
    assert {type(n) for n in ones} == {int}
    for n in (1, 2, 3):  # 1000 expected, standard deviation 26
        assert abs(ones.count(n) - 1000) < 130
    assert Range("n", 1, 100, True, True).spaced(3) == [1, 10, 100]


def _drive(table, holds):
    """Drives a bisection whose runs hold where `holds` says so; what it found and the values that it asked for."""
    rounds, asked = table.rounds(), []
    cases = next(rounds)
    while True:
        asked += [case.values[table.range.key] for case in cases]
        ended = {case.key: {"outcome": "finished" if holds(case.values) else "diverged"} for case in cases}
        try:
            cases = rounds.send(ended)
        except StopIteration as end:
            return end.value.rows, asked


@pytest.mark.parametrize("range_, width", [
    (Range("x", 0.0, 8.0), 0.1), (Range("x", 0.01, 100.0, True), 0.05), (Range("x", 0, 1000, whole=True), 1)])
@pytest.mark.parametrize("above", [True, False])
def test_a_bisection_closes_in_from_either_side_in_as_many_runs_as_it_says(range_, width, above):
    table = Bisection(Grid((Axis("y", (1, 2)),)), range_, width)
    rows, asked = _drive(table, lambda values: (values["x"] > 2.5 * values["y"]) == above)
    for row, limit in zip(rows, (2.5, 5.0)):
        assert row["low"] <= limit <= row["high"]
        gap = row["high"] / row["low"] - 1.0 if range_.logarithmic else row["high"] - row["low"]
        assert gap <= width
        assert row["note"] == ("holds above" if above else "holds below") and row["fails"] == "diverged"
    assert len(asked) <= table.count


def test_a_run_holds_by_outcome_and_by_its_numbers():
    holds = Holds(("finished",), {"passages": 0})
    assert holds.why_not({"outcome": "finished", "passages": 0}) == ""
    assert holds.why_not({"outcome": "finished", "passages": 2}) == "passages"
    assert holds.why_not({"outcome": "finished", "passages": None}) == "passages"
    assert holds.why_not({"outcome": "converged", "passages": 0}) == "converged"


AXES = {"axes": {"timeStep": [0.1]}}


@pytest.mark.parametrize("given, said", [
    ("{", "is not JSON"),
    ("[]", "the file = [] is not allowed: an object"),
    ('{"study": "a", "study": "b"}', "'study' stands there twice"),
    ('{"study": "a"}', "has no 'scene': parameter file"),
    ({**AXES, "axis": {}}, "unknown key 'axis': did you mean 'axes'?"),
    ({**AXES, "study": "a/b"}, "study: 'a/b' cannot name a run"),
    ({**AXES, "scene": "nothing.json"}, 'scene = "nothing.json" is not allowed: a parameter file'),
    ({}, "asks for no run"),
    ({"axes": {"timeStep": []}}, "axes.timeStep: timeStep takes no value"),
    ({"axes": {"timeStep": 3}}, "axes.timeStep = 3 is not allowed: a list of values"),
    ({"axes": {"timeStep": [1, 1]}}, "timeStep takes 1 twice"),
    ({"axes": {"timeStep": [None]}}, "None cannot be a value of an axis"),
    ({"axes": {"timeStep": {"from": 1, "to": 2}}}, "axes.timeStep.count is missing: a whole number from 2"),
    ({"axes": {"timeStep": {"from": 2, "to": 1, "count": 3}}}, "goes from 2 to 1"),
    ({"axes": {"timeStep": {"from": 0, "to": 1, "count": 3, "scale": "log"}}}, "a logarithmic range lies above 0"),
    ({"axes": {"timeStep": {"from": 1, "to": 2, "count": 3, "scale": "cubic"}}}, 'scale = "cubic" is not allowed'),
    ({"list": []}, "list = [] is not allowed"),
    ({"list": [{"a": 1}, {"b": 1}]}, 'list[1] = {"b": 1} is not allowed: the keys of the first: a'),
    ({**AXES, "list": [{"timeStep": 1}]}, "timeStep is an axis twice"),
    ({"sample": {"method": "sobol", "count": 3, "ranges": {"a": {"from": 0, "to": 1}}}}, 'sample.method = "sobol"'),
    ({"sample": {"method": "random", "count": 0, "ranges": {"a": {"from": 0, "to": 1}}}}, "sample.count = 0"),
    ({"sample": {"method": "random", "count": 3, "ranges": {}}}, "sample.ranges = {}"),
    ({**AXES, "variants": {"a": {"timeStep": 1}}}, "timeStep is an axis, and variant a sets it too"),
    ({**AXES, "repeats": -1}, "repeats = -1 is not allowed: a whole number from 0"),
    ({**AXES, "timeLimit": 0}, "timeLimit = 0 is not allowed: a number above 0"),
    ({**AXES, "logs": 1}, "logs = 1 is not allowed: false or true"),
    ({"axes": {"totalMass": [1]}, "duration": 1}, "a study with 'duration' says 'timeStep'"),
    ({"bisection": {"key": "x", "from": 0, "to": 1, "width": 0}}, "bisection.width = 0 is not allowed"),
    ({"bisection": {"key": "x", "from": 0, "to": 1, "width": 1, "holds": {"outcomes": ["well"]}}}, '"well"'),
    ({**AXES, "bisection": {"key": "timeStep", "from": 0, "to": 1, "width": 1}}, "is an axis, and bisected too"),
    ({"axes": {"a": {"from": 0, "to": 1, "count": 10_000_000}}}, "asks for 10,000,000 runs: give --yes"),
    ({"sample": {"method": "random", "count": 10_000_000, "ranges": {"a": {"from": 0, "to": 1}}}}, "10,000,000 runs"),
])
def test_what_is_wrong_is_one_line_that_names_the_file(read, tmp_path, given, said):
    with pytest.raises(StudyFileError) as caught:
        read(given)
    line = str(caught.value)
    assert said in line and "\n" not in line and line.startswith(str(tmp_path / "mine.json"))


def test_many_runs_may_be_asked_for(read):
    assert read({"axes": {"a": {"from": 0, "to": 1, "count": 100_001}}}, most_runs=None).grid.count == 100_001


def test_a_row_has_a_value_for_each_parameter():
    with pytest.raises(ValueError, match="run 2 has 1 values for 2 parameters"):
        Rows("run", ("a", "b"), ((1, 2), (3,)))


def test_an_axis_that_is_no_parameter_is_one_line_and_nothing_is_written(runner_command, tmp_path):
    (tmp_path / "mine.json").write_text(json.dumps(
        {"study": "mine", "scene": str(ROOT / "params/default.json"), "axes": {"timestep": [0.1, 0.2]}}))
    done = subprocess.run([sys.executable, str(ROOT / "guidewire.py"), "sweep", "mine.json"], cwd=tmp_path,
                          capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == ("guidewire: mine.json: run timestep=0.1: unknown key 'timestep': did you mean 'timeStep'? "
                           "(and 1 more of 2 runs)\n")
    assert [path.name for path in tmp_path.iterdir()] == ["mine.json"]


def test_a_run_needs_none_of_the_packages_of_a_sweep():
    code = ("import sys; from guidewire.commands import commands; commands.parse(['run', 'a.json']); "
            "assert not {'dask', 'distributed', 'tqdm', 'numpy', 'scipy', 'psutil'} & set(sys.modules)")
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True)


def test_a_whole_object_is_a_value_of_an_axis_by_its_name(read):
    straight, bent = {"shape": "tube", "radius": 2}, {"shape": "tube", "radius": [1, 2]}
    study = read({"axes": {"vessel": [{"name": "straight", "value": straight}, {"name": "bent", "value": bent}],
                           "vessel.radius": [3.0, 4.0], "obstacles[0].radius": [1]}})
    cases = study.grid.cases()
    assert [case.key for case in cases[:2]] == [
        "vessel=straight,vessel.radius=3.0,obstacles[0].radius=1",
        "vessel=straight,vessel.radius=4.0,obstacles[0].radius=1"]
    assert cases[2].overrides == {"vessel": bent, "vessel.radius": 3.0, "obstacles[0].radius": 1}


def test_a_bisection_beside_a_named_value_runs_with_the_value_and_tells_the_name(read):
    study = read({"axes": {"gravity": [{"name": "down", "value": [0, -9.81, 0]}]},
                  "bisection": {"key": "timeStep", "from": 0.01, "to": 0.1, "width": 0.01, "holds": {}}})
    rounds = study.grid.rounds()
    cases = next(rounds)
    assert all(case.overrides["gravity"] == [0, -9.81, 0] for case in cases)
    with pytest.raises(StopIteration) as end:
        rounds.send({case.key: {"outcome": "finished"} for case in cases})
    assert end.value.value.rows[0]["gravity"] == "down"


@pytest.mark.parametrize("value, said", [
    ({"name": "a"}, "axes.vessel[0] has no 'value'"), ({"value": {}}, "axes.vessel[0] has no 'name'"),
    ({"name": "a", "value": 1, "x": 2}, "unknown key 'x'"), ({"shape": "tube"}, "unknown key 'shape': name, value"),
    ({"name": "", "value": 1}, "axes.vessel[0].name"), ([1, 2, 3], '{"name": .., "value": ..}'),
])
def test_an_object_without_a_name_is_refused_with_how_it_stands(read, value, said):
    with pytest.raises(StudyFileError) as refused:
        read({"axes": {"vessel": [value]}})
    assert said in str(refused.value) and "\n" not in str(refused.value)


def test_two_objects_of_one_name_are_refused(read):
    with pytest.raises(StudyFileError, match="vessel takes a twice"):
        read({"axes": {"vessel": [{"name": "a", "value": 1}, {"name": "a", "value": 2}]}})
