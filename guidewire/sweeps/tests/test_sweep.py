"""What the tables of a study hold, that done runs are not made again and are shared, that timed runs are made one at a
time, that what goes wrong with a run costs that run, and that a study and a check are made in one way."""

import csv
import json
import os
import signal
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import pytest

from guidewire.logs.logs import LogError
from guidewire.prepare import PreparationError
from guidewire.studies.bisection import FRONTIER, Bisection, Holds
from guidewire.studies.sampling import Range
from guidewire.studies.table import Axis, Case, Grid, Study
from guidewire.sweeps import sweep as sweeping
from guidewire.sweeps import worker
from guidewire.sweeps.check import Check
from guidewire.sweeps.sweep import WALL_TIMES, Means


@pytest.fixture(autouse=True)
def undisturbed(monkeypatch):
    """Whatever else the machine does, timed runs are measured once."""
    monkeypatch.setattr(worker, "DISTURBED", 1e9)


def sweep(sources, command, out, jobs=2, **means):
    return sweeping.sweep([(source, out) for source in sources], out / "runs", Means(command, jobs, **means))


def study_of(name, *axes, scene="params/default.json", logs=True, **options):
    return Study(name, f"a study, {name}", scene, Grid(axes, **options), logs=logs)


SMALL = study_of("small", Axis("sleep", (0.01, 0.02, 0.05)), repeats=2)


def asked_of(folder):
    return json.loads((folder / "study.json").read_text())["runs"]


def results_of(folder):
    with open(folder / "runs.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_a_sweep_takes_no_profile_of_threads(fake, tmp_path, monkeypatch):
    taken = []
    frames = sys._current_frames
    monkeypatch.setattr(sys, "_current_frames", lambda: taken.append(threading.current_thread().name) or frames())
    sweep([study_of("longer", Axis("sleep", (0.5, 1.5)))], fake.command, tmp_path)
    assert taken == []


def test_study_json_lists_every_run_with_its_folder(fake, tmp_path):
    sweep([SMALL], fake.command, tmp_path)
    rows = asked_of(tmp_path / "small")
    assert [(row["values"]["sleep"], row["repeat"]) for row in rows] == [
        (seconds, repeat) for repeat in (None, 1, 2) for seconds in (0.01, 0.02, 0.05)]
    assert len({row["folder"] for row in rows}) == 9
    for row in rows:
        folder = tmp_path / "small" / row["folder"]
        assert (folder / "summary.json").exists() and (folder / "load.json").exists() == (row["repeat"] is not None)
        log = {} if row["repeat"] is None else {"logSpheres": "last", "logOrientations": False}
        assert row["overrides"] == {**row["values"], **log} and row["variant"] == ""
        assert row["parameters"] == "params/default.json"


def test_runs_csv_has_one_line_for_each_run_with_its_values_and_what_came_of_it(fake, tmp_path):
    study = study_of("map", Axis("sleep", (0.0, 0.01)), Axis("totalMass", (1, 1.0, 2.0)), variants={"a": {}, "b": {}})
    sweep([study], fake.command, tmp_path)
    rows = results_of(tmp_path / "map")
    assert [(row["variant"], row["sleep"], row["totalMass"]) for row in rows] == [
        (variant, seconds, mass) for variant in "ab" for seconds in ("0.0", "0.01") for mass in ("1", "1.0", "2.0")]
    assert len({row["key"] for row in rows}) == 12 and rows[1]["key"] == "a,sleep=0.0,totalMass=1.0"
    assert {(row["outcome"], row["steps"]) for row in rows} == {("converged", "2")}


def test_timed_runs_have_no_other_run_beside_them(fake, tmp_path):
    sweep([SMALL], fake.command, tmp_path)
    spans = [(start, end, request.get("repeat")) for _, start, end, request in fake.calls()]
    assert len(spans) == 9
    for start, end, repeat in spans:
        if repeat is not None:
            assert not [1 for other in spans if other != (start, end, repeat) and other[0] < end and start < other[1]]


def test_a_timed_run_that_others_disturb_is_measured_again(fake, tmp_path, monkeypatch):
    monkeypatch.setattr(worker, "DISTURBED", -1.0)
    sweep([study_of("one", repeats=1)], fake.command, tmp_path)
    (row,) = [row for row in results_of(tmp_path / "one") if row["repeat"]]
    assert row["timesMeasured"] == "3" and float(row["othersBusy"]) >= 0.0
    assert [request.get("repeat") for *_, request in fake.calls()] == [None, 1, 1, 1]


def test_a_second_time_nothing_is_made_again(fake, tmp_path):
    first = sweep([SMALL], fake.command, tmp_path)
    second = sweep([SMALL], fake.command, tmp_path)
    assert (first.made, first.found, second.made, second.found) == (9, 0, 0, 9)
    assert len(fake.calls()) == 9


def test_two_studies_share_a_run_and_a_timed_one_stands_in_for_no_other(fake, tmp_path):
    other = study_of("other", Axis("sleep", (0.02, 0.03)))
    result = sweep([SMALL, other], fake.command, tmp_path)
    assert (result.made, result.found) == (10, 1)
    shared = [row["folder"] for name in ("small", "other") for row in asked_of(tmp_path / name)
              if row["key"] == "sleep=0.02" and row["repeat"] is None]
    assert len(shared) == 2 and len(set(shared)) == 1


def test_a_run_without_a_log_is_made_again_where_one_is_needed_and_not_the_reverse(fake, tmp_path):
    def wanting(logs):
        return study_of("logs" if logs else "none", Axis("sleep", (0.0, 0.01)), logs=logs)

    assert [sweep([wanting(logs)], fake.command, tmp_path).made for logs in (False, True, False)] == [2, 2, 0]
    assert {row["log"] for row in results_of(tmp_path / "none")} == {"positions.json"}


@pytest.mark.parametrize("wish, said", [
    ({"die": 70}, "exit code 70"),
    ({"signal": 9}, "killed by signal 9"),
    ({"babble": "?"}, "instead of an answer"),
    ({"lost": 1}, "disk is full"),
])
@pytest.mark.few(1)
def test_a_run_that_goes_wrong_is_made_once_more_and_named_where_that_fails_too(fake, tmp_path, wish, said):
    variants = {"good": {"sleep": 0.01}, "bad": {**wish, "exitCode": 2} if "babble" in wish else wish, "fine": {}}
    result = sweep([study_of("mixed", variants=variants)], fake.command, tmp_path, 1)
    rows = results_of(tmp_path / "mixed")
    assert [row["outcome"] for row in rows] == ["converged", "failed", "converged"] and said in rows[1]["reason"]
    assert [answer.name for answer in result.failures] == ["mixed: bad"]
    again = sweep([study_of("again", variants={"once": {**wish, "once": 1}})], fake.command, tmp_path, 1)
    assert again.failures == [] and [row["outcome"] for row in results_of(tmp_path / "again")] == ["converged"]


def test_a_run_over_its_time_limit_is_named(fake, tmp_path):
    slow = Study("slow", "slow", "params/default.json", Grid((Axis("sleep", (0.0, 60.0)),)), seconds=2.0)
    sweep([slow], fake.command, tmp_path, 1)
    assert [(row["outcome"], "time limit" in row["reason"]) for row in results_of(tmp_path / "slow")] == [
        ("converged", False), ("failed", True)]


def test_a_run_that_cannot_be_made_is_reported_before_anything_is_made_or_written(fake, tmp_path):
    bad = study_of("bad", Axis("refused", ("unknown key",)), variants={"a": {}, "b": {}})
    with pytest.raises(PreparationError, match="^bad: run a,refused=.*: unknown key .and 1 more of 2 runs.$"):
        sweep([SMALL, bad], fake.command, tmp_path)
    assert not fake.journal.exists() and not (tmp_path / "small").exists()


def test_after_ctrl_c_runs_csv_says_what_was_done(fake, tmp_path):
    long = study_of("long", Axis("sleep", (0.01, 60.0)), repeats=1)

    def interrupt():
        while len(list(tmp_path.glob("runs/**/begun"))) < 2:    # the second run is under way, and the first has ended
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        sweep([long], fake.command, tmp_path, 1)
    rows = results_of(tmp_path / "long")
    assert [row["outcome"] for row in rows] == ["converged", "interrupted", "", ""]
    assert rows[2]["reason"] == "not run yet"


@dataclass(frozen=True)
class Rounds:
    """A source that asks round by round, and may only go on when what it asked for is done."""

    name: str
    asked: tuple
    title: str = "asks again"
    scene: str = "params/default.json"
    results: tuple = ("converged",)
    logs: bool = True
    seconds: float = 60.0
    origin: str = "rounds"

    def rounds(self, folder):
        for cases in self.asked:
            ended = yield cases
            assert {key: summary["outcome"] for key, summary in ended.items()} == {
                case.key: "converged" for case in cases}
            assert {row["key"] for row in asked_of(folder)} >= {case.key for case in cases}


def test_a_study_and_a_check_that_ask_for_the_same_make_the_same(fake, tmp_path):
    def plan():
        yield SMALL.grid.cases()

    check = Check("small", "Test", SMALL.title, plan, SMALL.scene)
    made = {}
    for word, source in (("study", SMALL), ("check", check)):
        place = tmp_path / word
        fake.journal.unlink(missing_ok=True)
        if word == "study":
            sweep([source], fake.command, place, 1)
        else:
            with pytest.raises(LogError, match="parameters.json"):  # which the fake runner does not write
                sweep([source], fake.command, place, 1)
        made[word] = [{**request, "out": os.path.relpath(request["out"], place)} for *_, request in fake.calls()]
        made[word + "'s table"] = (place / "small" / "study.json").read_text()
    assert made["study"] == made["check"] and len(made["study"]) == 9
    assert made["study's table"] == made["check's table"]


def test_what_is_asked_later_is_made_after_what_was_asked_first_and_stands_in_the_same_tables(fake, tmp_path):
    shown = []

    class Bar:
        def __init__(self, number, total, found):
            self.line = [number, total, found]
            shown.append(self.line)

        def update(self, n):
            self.line[2] += n

        def close(self):
            pass

    source = Rounds("again", ([Case("first", {"a": 1}), Case("other", {})], [Case("then", {"sleep": 0.03}, repeats=2)]))
    result = sweep([source, SMALL], fake.command, tmp_path, bar=Bar)
    assert shown == [[1, 11, 11], [2, 3, 3]] and result.failures == []
    keys = ["first", "other", "then", "then", "then"]
    assert [row["key"] for row in asked_of(tmp_path / "again")] == keys
    assert [row["key"] for row in results_of(tmp_path / "again")] == keys
    ends = [(request["id"], start, end) for _, start, end, request in fake.calls()]
    last = max(end for name, _, end in ends if name != "then")
    assert min(start for name, start, _ in ends if name == "then") > last


def test_who_lost_a_run_is_not_asked_for_more_and_the_others_are(fake, tmp_path):
    bad = Rounds("bad", ([Case("lost", {"exitCode": 2})], [Case("never", {"a": 1})]))
    good = Rounds("good", ([Case("one", {"a": 2})], [Case("two", {"a": 3})]))
    result = sweep([bad, good], fake.command, tmp_path, 1)
    assert [answer.name for answer in result.failures] == ["bad: lost"]
    assert {request["id"] for *_, request in fake.calls()} == {"lost", "one", "two"}


@pytest.mark.parametrize("second", ["one", "One"])
def test_two_runs_of_one_name_are_refused_also_where_letters_have_no_case(fake, tmp_path, second):
    with pytest.raises(ValueError, match="two runs of one name"):
        sweep([Rounds("twice", ([Case("one", {})], [Case(second, {"sleep": 1})]))], fake.command, tmp_path)


def test_a_start_is_written_beside_the_table_and_named_in_the_run(fake, tmp_path):
    sweep([Rounds("started", ([Case("run", {}, repeats=1, start={"positions": []})],))], fake.command, tmp_path)
    file = tmp_path / "started" / "starts" / "run.json"
    assert json.loads(file.read_text()) == {"positions": []}
    assert {request["set"]["startFile"] for *_, request in fake.calls()} == {str(file)}


def test_a_cost_in_turns_is_asked_of_the_stopwatch_and_of_nobody_else(fake, tmp_path):
    asked = []

    def stopwatch():
        asked.append(len(fake.calls()))
        return [*fake.command, "stopwatch"]

    sweep([SMALL], fake.command, tmp_path, stopwatch=stopwatch)
    assert asked == []
    costly = Rounds("costly", ([Case("cost", {"b": 1}, in_turns=True), Case("run", {"b": 1}, repeats=1)],))
    sweep([costly], fake.command, tmp_path, stopwatch=stopwatch)
    assert asked == [11]  # after the study's nine, the run and its repeat
    assert fake.calls()[-1][3]["id"] == "cost" and fake.calls()[-1][0] != fake.calls()[-2][0]


def test_untimed_runs_are_made_at_once_and_one_job_makes_one_at_a_time(fake, tmp_path):
    for jobs, overlapping in ((1, False), (2, True)):
        fake.journal.unlink(missing_ok=True)
        sweep([study_of("pair", Axis("sleep", (0.2, 0.21, 0.22, 0.23)))], fake.command, tmp_path / str(jobs), jobs)
        spans = sorted((start, end) for _, start, end, _ in fake.calls())
        assert any(end > later for (_, end), (later, _) in zip(spans, spans[1:])) == overlapping


SCENE = {"maxSimulationSteps": 5, "constraintSolverSteps": 5}
REAL = Grid((Axis("displacement", tuple(0.5 * k for k in range(1, 21))),), SCENE)


def test_two_sweeps_at_once_in_one_process_make_each_its_own(fake, tmp_path):
    def make(name):
        return sweep([study_of(name, Axis("sleep", (0.1, 0.2, 0.3)))], fake.command, tmp_path / name)

    with ThreadPoolExecutor(2) as threads:
        first, second = threads.map(make, ("first", "second"))
    assert (first.made, second.made) == (3, 3) and first.failures == second.failures == []
    assert len(results_of(tmp_path / "first" / "first")) == len(results_of(tmp_path / "second" / "second")) == 3


def test_results_do_not_depend_on_workers_or_batches(runner_command, tmp_path):
    tables = []
    for name, jobs, axis in (("one", 1, REAL.axes[0]), ("three", 3, Axis("displacement", REAL.axes[0].values[::-1]))):
        study = Study("same", "the same?", "params/default.json", Grid((axis,), SCENE), logs=False)
        sweep([study], runner_command, tmp_path / name, jobs)
        rows = results_of(tmp_path / name / "same")
        tables.append(sorted((tuple((k, v) for k, v in row.items() if k not in WALL_TIMES) for row in rows)))
    assert len(tables[0]) == 20 and tables[0] == tables[1]


def test_a_bisection_closes_in_on_the_frontier_and_says_where_there_is_none(runner_command, tmp_path):
    """The stretch gain breaks down at 2 across the wire; below 1 nothing does."""
    common = {"displacementDirection": [0, 1, 0], "numberRodElements": 10, "maxSimulationSteps": 1000}
    table = Bisection(Grid((), common, {"wide": {}}), Range("stretchStiffness", 0.6, 3.0), 0.05, Holds())
    calm = Bisection(Grid((), common), Range("stretchStiffness", 0.6, 1.0), 0.05, Holds())
    studies = [Study(name, "where?", "params/default.json", own, ("converged", "finished", "diverged"), logs=False)
               for name, own in (("gain", table), ("calm", calm))]
    sweep(studies, runner_command, tmp_path)
    found, none = (list(csv.DictReader(open(tmp_path / name / FRONTIER))) for name in ("gain", "calm"))
    (row,) = found
    low, high = float(row["low"]), float(row["high"])
    assert low <= 2.03 and high >= 1.97 and high - low <= 0.05
    assert (row["variant"], row["fails"], row["note"]) == ("wide", "diverged", "holds below")
    assert none[0]["note"] == "holds at both ends"
    assert len(results_of(tmp_path / "gain")) == table.count == 8 and len(results_of(tmp_path / "calm")) == 2
