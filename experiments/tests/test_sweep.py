"""What a study's folder holds, that done runs are not run again, that timed runs run alone, and that a study and a
check are made in one way."""

import json
import os
import signal
import threading
from dataclasses import dataclass

import pytest

from analysis.logs import LogError
from analysis.validation.check import Check
from experiments.sweep import sweep
from studies.table import Axis, Case, Grid, Study


def study_of(name, *axes, scene="params/default.json", **options):
    return Study(name, f"a study, {name}", scene, Grid(axes, **options))


SMALL = study_of("small", Axis("sleep", (0.01, 0.02, 0.05)), repeats=2)


def ignore(*_):
    pass


def table_of(folder):
    return json.loads((folder / "study.json").read_text())


def test_study_json_lists_every_run_with_its_folder_and_outcome(fake, tmp_path):
    sweep([SMALL], fake.command, tmp_path, 2, ignore)
    rows = table_of(tmp_path / "small")["runs"]
    assert [row["folder"] for row in rows] == [
        "sleep=0.01", "sleep=0.02", "sleep=0.05",
        "sleep=0.01/repeat-1", "sleep=0.02/repeat-1", "sleep=0.05/repeat-1",
        "sleep=0.01/repeat-2", "sleep=0.02/repeat-2", "sleep=0.05/repeat-2",
    ]
    for row in rows:
        assert (tmp_path / "small" / row["folder"] / "summary.json").exists()
        assert (row["outcome"], row["exitCode"], row["parameters"]) == ("converged", 0, "params/default.json")
        log = {} if row["repeat"] is None else {"logSpheres": "last", "logOrientations": False}
        assert row["overrides"] == {**row["values"], **log} and row["variant"] == ""
    assert [row["values"]["sleep"] for row in rows] == 3 * [0.01, 0.02, 0.05]
    assert [row["repeat"] for row in rows] == [None] * 3 + [1] * 3 + [2] * 3


def test_study_json_of_two_axes_says_both_values_of_each_run(fake, tmp_path):
    study = study_of("map", Axis("sleep", (0.0, 0.01)), Axis("totalMass", (1, 1.0, 2.0)), variants={"a": {}, "b": {}})
    sweep([study], fake.command, tmp_path, 2, ignore)
    rows = table_of(tmp_path / "map")["runs"]
    assert [(row["variant"], row["values"]["sleep"], row["values"]["totalMass"]) for row in rows] == [
        (variant, seconds, mass) for variant in "ab" for seconds in (0.0, 0.01) for mass in (1, 1.0, 2.0)]
    assert len({row["folder"] for row in rows}) == 12 and rows[1]["key"] == "a,sleep=0.0,totalMass=1.0"


def test_timed_runs_have_no_other_run_beside_them(fake, tmp_path):
    sweep([SMALL], fake.command, tmp_path, 2, ignore)
    spans = [(start, end, request.get("repeat")) for _, start, end, request in fake.calls()]
    for start, end, repeat in spans:
        if repeat is not None:
            assert not [1 for other in spans if other != (start, end, repeat) and other[0] < end and start < other[1]]


def test_a_second_time_nothing_is_run_again(fake, tmp_path):
    first = sweep([SMALL], fake.command, tmp_path, 2, ignore)
    second = sweep([SMALL], fake.command, tmp_path, 2, ignore)
    assert not any(answer.reused for answer in first.answers.values())
    assert all(answer.reused for answer in second.answers.values())


def test_a_failed_run_is_told_and_the_others_are_made(fake, tmp_path):
    study = study_of("failing", Axis("die", (1,)), common={"exitCode": 2})
    mixed = study_of("mixed", Axis("exitCode", (2,)), repeats=1)
    for bad in (study, mixed):
        result = sweep([bad], fake.command, tmp_path, 1, ignore)
        assert len(result.failures) == len(result.answers) == 1 + bad.grid.repeats
        assert {row["outcome"] for row in table_of(tmp_path / bad.name)["runs"]} == {None}
        assert 0 not in {row["exitCode"] for row in table_of(tmp_path / bad.name)["runs"]}


@pytest.mark.timed
def test_after_ctrl_c_study_json_says_what_was_done(fake, tmp_path):
    long = study_of("long", Axis("sleep", (0.01, 60.0)), repeats=1)
    timer = threading.Timer(1.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        sweep([long], fake.command, tmp_path, 1, ignore)
    rows = table_of(tmp_path / "long")["runs"]
    assert [row["outcome"] for row in rows] == ["converged", "interrupted", None, None]
    assert rows[2]["message"] == "not run yet"


@dataclass(frozen=True)
class Rounds:
    """A source that asks round by round, and may only go on when what it asked for stands in its folder."""

    name: str
    asked: tuple
    title: str = "asks again"
    scene: str = "params/default.json"
    results: tuple = ("converged",)

    def rounds(self, folder):
        for cases in self.asked:
            yield cases
            assert all((folder / case.folder() / "summary.json").exists() for case in cases)


def test_a_study_and_a_check_that_ask_for_the_same_make_the_same(fake, tmp_path):
    def plan():
        yield SMALL.grid.cases()

    check = Check("small", "Test", SMALL.title, plan, SMALL.scene)
    requests = {}
    for word, source in (("study", SMALL), ("check", check)):
        place = tmp_path / word
        fake.journal.unlink(missing_ok=True)
        if word == "study":
            sweep([source], fake.command, place, 1, ignore)
        else:
            with pytest.raises(LogError, match="parameters.json"):  # which the fake runner does not write
                sweep([source], fake.command, place, 1, ignore)
        requests[word] = [{**request, "out": os.path.relpath(request["out"], place)}
                          for *_, request in fake.calls()]
        requests[word + "'s table"] = table_of(place / "small")
    assert requests["study"] == requests["check"] and len(requests["study"]) == 9
    assert requests["study's table"] == requests["check's table"]


def test_what_is_asked_later_is_made_after_what_was_asked_first_and_stands_in_the_same_table(fake, tmp_path):
    totals = []
    source = Rounds("again", ([Case("first", {}), Case("other", {})], [Case("then", {"sleep": 0.01}, repeats=2)]))
    result = sweep([source, SMALL], fake.command, tmp_path, 2, lambda done, total, answer: totals.append((done, total)))
    assert totals[-1] == (14, 14) and result.failures == []
    assert [row["folder"] for row in table_of(tmp_path / "again")["runs"]] == [
        "first", "other", "then", "then/repeat-1", "then/repeat-2"]
    ends = {request["id"]: end for _, _, end, request in fake.calls()}
    starts = {request["id"]: start for _, start, _, request in fake.calls()}
    assert starts["again/then"] > max(ends["again/first"], ends["again/other"], ends["small/sleep=0.05/repeat-2"])


def test_who_lost_a_run_is_not_asked_for_more_and_the_others_are(fake, tmp_path):
    bad = Rounds("bad", ([Case("lost", {"exitCode": 2})], [Case("never", {})]))
    good = Rounds("good", ([Case("one", {})], [Case("two", {})]))
    result = sweep([bad, good], fake.command, tmp_path, 1, ignore)
    assert [answer.name for answer in result.failures] == ["bad/lost"]
    assert set(result.answers) == {"bad/lost", "good/one", "good/two"}


@pytest.mark.parametrize("second", ["one", "One"])
def test_two_runs_in_one_folder_are_refused_also_where_letters_have_no_case(fake, tmp_path, second):
    with pytest.raises(ValueError, match="two runs in one folder"):
        sweep([Rounds("twice", ([Case("one", {})], [Case(second, {"sleep": 1})]))], fake.command, tmp_path, 1, ignore)


def test_a_start_is_written_beside_its_run_and_named_in_it(fake, tmp_path):
    sweep([Rounds("started", ([Case("run", {}, repeats=1, start={"positions": []})],))], fake.command, tmp_path, 1,
          ignore)
    file = tmp_path / "started" / "run" / "start.json"
    assert json.loads(file.read_text()) == {"positions": []}
    assert {request["set"]["startFile"] for *_, request in fake.calls()} == {str(file)}


def test_a_cost_in_turns_is_asked_of_the_stopwatch_and_of_nobody_else(fake, tmp_path):
    asked = []

    def stopwatch():
        asked.append(len(fake.calls()))
        return fake.command

    sweep([SMALL], fake.command, tmp_path, 1, ignore, stopwatch)
    assert asked == []
    sweep([Rounds("costly", ([Case("cost", {}, in_turns=True), Case("run", {}, repeats=1)],))], fake.command, tmp_path,
          1, ignore, stopwatch)
    assert asked == [11]  # after the study's nine, the run and its repeat
    assert fake.calls()[-1][3]["id"] == "costly/cost"
