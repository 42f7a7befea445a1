"""What a study's folder holds, that done runs are not run again, and that timed runs run alone."""

import json
import os
import signal
import threading

import pytest

from experiments.studies import STUDIES, Study
from experiments.sweep import run_study

SMALL = Study("small", "a small study", "params/default.json", "sleep", (0.01, 0.02, 0.05), repeats=2)


def ignore(*_):
    pass


def table_of(folder):
    return json.loads((folder / "study.json").read_text())


def test_the_thesis_sweeps_are_the_thesis_ranges():
    thesis = {
        "constraintSolverSteps": (100, 1000), "numberRodElements": (5, 60), "displacement": (1, 100),
        "timeStep": (1e-4, 1e-1), "totalMass": (1e-3, 1.0),
    }
    swept = [study for study in STUDIES.values() if study.parameter and not study.name.endswith("gain")]
    assert len(swept) == 14
    for study in swept:
        assert (min(study.values), max(study.values)) == thesis[study.parameter], study.name


def test_every_thesis_sweep_holds_the_default_value():
    table_4_1 = {
        "constraintSolverSteps": 500, "numberRodElements": 30, "displacement": 10, "timeStep": 0.01,
        "totalMass": 0.01,
    }
    for study in STUDIES.values():
        assert study.parameter is None or table_4_1[study.parameter] in study.values


@pytest.mark.parametrize("study", STUDIES.values(), ids=STUDIES)
def test_no_two_runs_share_a_folder(study):
    folders = [run.folder for run in study.runs()]
    assert len(set(folders)) == len(folders) == (
        max(1, len(study.variants)) * max(1, len(study.values)) * (1 + study.repeats)
    )


def test_each_variant_takes_every_value_and_a_duration_sets_the_steps():
    study = Study("both", "", "params/default.json", "timeStep", (0.1, 0.3), common={"displacement": 1}, repeats=0,
                  variants={"many": {"displacement": 2}, "few": {}}, duration=0.9, least_steps=5)
    assert [(run.key, dict(run.overrides)) for run in study.runs()] == [
        ("many,timeStep=0.1", {"displacement": 2, "timeStep": 0.1, "maxSimulationSteps": 9}),
        ("many,timeStep=0.3", {"displacement": 2, "timeStep": 0.3, "maxSimulationSteps": 5}),
        ("few,timeStep=0.1", {"displacement": 1, "timeStep": 0.1, "maxSimulationSteps": 9}),
        ("few,timeStep=0.3", {"displacement": 1, "timeStep": 0.3, "maxSimulationSteps": 5}),
    ]


def test_variants_without_a_parameter_are_runs_of_their_own_name():
    study = Study("alone", "", "params/default.json", repeats=0, variants={"a": {}, "b": {"displacement": 3}})
    assert [(run.key, run.value, run.folder) for run in study.runs()] == [("a", None, "a"), ("b", None, "b")]


def test_study_json_lists_every_run_with_its_folder_and_outcome(fake, tmp_path):
    result = run_study(SMALL, fake.command, tmp_path, 2, ignore)
    rows = table_of(result.folder)["runs"]
    assert [row["folder"] for row in rows] == [
        "sleep=0.01", "sleep=0.02", "sleep=0.05",
        "sleep=0.01/repeat-1", "sleep=0.02/repeat-1", "sleep=0.05/repeat-1",
        "sleep=0.01/repeat-2", "sleep=0.02/repeat-2", "sleep=0.05/repeat-2",
    ]
    for row in rows:
        assert (result.folder / row["folder"] / "summary.json").exists()
        assert (row["outcome"], row["exitCode"], row["parameters"]) == ("converged", 0, "params/default.json")
        log = {} if row["repeat"] is None else {"logSpheres": "last"}
        assert row["overrides"] == {"sleep": row["value"], **log}
    assert [row["repeat"] for row in rows] == [None] * 3 + [1] * 3 + [2] * 3


def test_timed_runs_have_no_other_run_beside_them(fake, tmp_path):
    run_study(SMALL, fake.command, tmp_path, 2, ignore)
    spans = [(start, end, request.get("repeat")) for _, start, end, request in fake.calls()]
    for start, end, repeat in spans:
        if repeat is not None:
            assert not [1 for other in spans if other != (start, end, repeat) and other[0] < end and start < other[1]]


def test_a_second_time_nothing_is_run_again(fake, tmp_path):
    first = run_study(SMALL, fake.command, tmp_path, 2, ignore)
    second = run_study(SMALL, fake.command, tmp_path, 2, ignore)
    assert not any(answer.reused for answer in first.answers.values())
    assert all(answer.reused for answer in second.answers.values())


def test_a_failed_run_is_told_and_the_others_are_made(fake, tmp_path):
    study = Study("failing", "", "params/default.json", "die", (1,), common={"exitCode": 2}, repeats=0)
    mixed = Study("mixed", "", "params/default.json", "exitCode", (2,), repeats=1)
    for bad in (study, mixed):
        result = run_study(bad, fake.command, tmp_path, 1, ignore)
        assert len(result.failures) == len(bad.runs())
        assert {row["outcome"] for row in table_of(result.folder)["runs"]} == {None}
        assert 0 not in {row["exitCode"] for row in table_of(result.folder)["runs"]}


@pytest.mark.timed
def test_after_ctrl_c_study_json_says_what_was_done(fake, tmp_path):
    long = Study("long", "", "params/default.json", "sleep", (0.01, 60.0), repeats=1)
    timer = threading.Timer(1.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        run_study(long, fake.command, tmp_path, 1, ignore)
    rows = table_of(tmp_path / "long")["runs"]
    assert [row["outcome"] for row in rows] == ["converged", "interrupted", None, None]
    assert rows[2]["message"] == "not run yet"
