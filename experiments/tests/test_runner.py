"""What runner.py promises when the runner works, dies, babbles, or is interrupted."""

import os
import signal
import sys
import threading
import time
from pathlib import Path

import pytest

from experiments import runner
from experiments.runner import Request, run_all


def requests(tmp_path, *wishes, repeat=None):
    return [
        Request(f"run-{i}", Path("scene.json"), tmp_path / f"run-{i}", wish, repeat) for i, wish in enumerate(wishes)
    ]


def answers_of(command, wanted, jobs=1):
    answers = {}
    run_all(command, wanted, jobs, lambda request, answer: answers.__setitem__(request.name, answer))
    return answers


def test_every_run_is_answered_once(fake, tmp_path):
    answers = answers_of(fake.command, requests(tmp_path, *[{}] * 7), jobs=3)
    assert sorted(answers) == [f"run-{i}" for i in range(7)]
    assert {(a.exit_code, a.outcome, a.reused) for a in answers.values()} == {(0, "converged", False)}


@pytest.mark.timed
def test_runs_overlap_with_two_jobs_and_never_with_one(fake, tmp_path):
    for jobs, overlapping in ((1, False), (2, True)):
        fake.journal.unlink(missing_ok=True)
        answers_of(fake.command, requests(tmp_path / str(jobs), *[{"sleep": 0.2}] * 4), jobs)
        spans = sorted((start, end) for _, start, end, _ in fake.calls())
        assert any(end > later for (_, end), (later, _) in zip(spans, spans[1:])) == overlapping


def test_one_process_serves_many_runs(fake, tmp_path):
    answers_of(fake.command, requests(tmp_path, *[{}] * 5))
    assert len({process for process, *_ in fake.calls()}) == 1


def test_the_request_carries_parameters_overrides_repeat_and_reuse(fake, tmp_path):
    answers_of(fake.command, requests(tmp_path, {"sleep": 0}, repeat=3))
    (*_, request), = fake.calls()
    assert request == {
        "id": "run-0", "parameters": "scene.json", "set": {"sleep": 0}, "out": str(tmp_path / "run-0"),
        "repeat": 3, "reuse": True,
    }


@pytest.mark.parametrize("wish, word", [
    ({"signal": signal.SIGKILL}, "killed by signal 9"),
    ({"die": 70}, "exit code 70"),
    ({"babble": "Unhandled exception"}, "Unhandled exception"),
    ({"babble": "{}"}, "{}"),
    ({"babble": "[1, 2]"}, "[1, 2]"),
])
def test_a_runner_that_dies_takes_one_run_with_it_and_no_other(fake, tmp_path, wish, word):
    answers = answers_of(fake.command, requests(tmp_path, {}, wish, {}, wish, {}))
    for name in ("run-1", "run-3"):
        assert (answers[name].exit_code, answers[name].outcome) == (runner.INTERNAL_ERROR, None)
        assert word in answers[name].message
    assert [answers[f"run-{i}"].outcome for i in (0, 2, 4)] == ["converged"] * 3


def test_a_runner_that_dies_between_two_runs_takes_none_with_it(fake, tmp_path):
    answers = answers_of(fake.command, requests(tmp_path, *[{"dieLater": 1}] * 20))
    assert [answer.outcome for answer in answers.values()] == ["converged"] * 20


def test_an_ordinary_failure_keeps_its_code_and_its_line(fake, tmp_path):
    answer = answers_of(fake.command, requests(tmp_path, {"exitCode": 2}))["run-0"]
    assert (answer.exit_code, answer.outcome, answer.message) == (2, None, "guidewire: bad key")


def test_a_runner_that_cannot_be_started_fails_every_run(tmp_path):
    answers = answers_of([str(tmp_path / "nothing")], requests(tmp_path, {}, {}))
    assert [answer.exit_code for answer in answers.values()] == [runner.INTERNAL_ERROR] * 2
    assert "did not start" in answers["run-0"].message


def test_a_runner_that_ends_at_once_fails_every_run(tmp_path):
    answers = answers_of([sys.executable, "-c", "raise SystemExit(3)"], requests(tmp_path, {}, {}))
    assert [answer.exit_code for answer in answers.values()] == [runner.INTERNAL_ERROR] * 2
    assert "exit code 3" in answers["run-0"].message


@pytest.mark.timed
def test_ctrl_c_ends_the_runs_under_way_and_starts_no_other(fake, tmp_path):
    answers = {}
    # A second after the start both runs are under way; they would last 60 s.
    timer = threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT))
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        run_all(
            fake.command, requests(tmp_path, *[{"sleep": 60}] * 4), 2,
            lambda request, answer: answers.__setitem__(request.name, answer),
        )
    assert time.monotonic() - started < 30
    assert {name: answer.outcome for name, answer in answers.items()} == {
        "run-0": "interrupted", "run-1": "interrupted",
    }


def test_no_process_is_left_behind(fake, tmp_path):
    answers_of(fake.command, requests(tmp_path, {}, {"die": 1}, {}), jobs=2)
    for process, *_ in fake.calls():
        with pytest.raises(ProcessLookupError):
            os.kill(process, 0)
