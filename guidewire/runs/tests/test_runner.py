"""What runner.py promises when the runner works, dies, babbles, takes too long, or loses us."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import closing
from pathlib import Path

import pytest

from guidewire.logs.logs import read_entries
from guidewire.prepare import ROOT
from guidewire.runs import runner
from guidewire.runs.process import hand_to
from guidewire.runs.runner import Checked, Request, Runner


def requests(tmp_path, *wishes, **options):
    return [
        Request(f"run-{i}", Path("scene.json"), tmp_path / f"run-{i}", wish, **options) for i, wish in enumerate(wishes)
    ]


def answers_of(command, wanted):
    with closing(Runner(command)) as one:
        return [one.run(request) for request in wanted]


def test_one_process_makes_many_runs(fake, tmp_path):
    answers = answers_of(fake.command, requests(tmp_path, *[{}] * 5))
    assert [(a.name, a.exit_code, a.outcome) for a in answers] == [(f"run-{i}", 0, "converged") for i in range(5)]
    assert len({process for process, *_ in fake.calls()}) == 1


def test_the_request_carries_parameters_overrides_and_repeat_and_whether_it_logs(fake, tmp_path):
    answers_of(fake.command, [*requests(tmp_path, {"sleep": 0}, repeat=3), *requests(tmp_path, {}, log=False)])
    asked = [request for *_, request in fake.calls()]
    same = {"id": "run-0", "parameters": "scene.json", "out": str(tmp_path / "run-0")}
    assert asked == [{**same, "set": {"sleep": 0}, "repeat": 3}, {**same, "set": {}, "log": False}]


def test_a_check_tells_the_address_and_runs_nothing(fake, tmp_path):
    with closing(Runner(fake.command)) as one:
        first, same, other = (one.check(request) for request in requests(tmp_path, {"a": 1}, {"a": 1}, {"a": 2}))
        refused = one.check(Request("bad", None, None, {"refused": "unknown key"}))
    assert isinstance(first, Checked) and first == same and first.address != other.address
    assert (refused.exit_code, refused.outcome, refused.message) == (2, None, "unknown key")
    assert not fake.journal.exists()


def test_a_runner_has_the_next_request_before_the_reply_is_read(fake, tmp_path):
    first, second = requests(tmp_path, {"sleep": 0.01}, {})
    with closing(Runner(fake.command)) as one:
        assert one.run(first, following=second).name == "run-0"
        until = time.monotonic() + 20.0
        while len(fake.calls()) < 2 and time.monotonic() < until:
            time.sleep(0.01)
        assert [request["id"] for *_, request in fake.calls()] == ["run-0", "run-1"]    # nobody has asked for it yet
        assert one.run(second).name == "run-1"
    assert len(fake.calls()) == 2


def test_a_runner_that_dies_takes_the_run_ahead_not_with_it(fake, tmp_path):
    wanted = requests(tmp_path, {"die": 70}, {}, {})
    with closing(Runner(fake.command)) as one:
        answers = [one.run(request, following=after) for request, after in zip(wanted, [*wanted[1:], None])]
    assert [answer.outcome for answer in answers] == [None, "converged", "converged"]


def test_a_run_that_was_not_announced_gets_its_own_reply(fake, tmp_path):
    first, announced, other = requests(tmp_path, {}, {}, {})
    with closing(Runner(fake.command)) as one:
        one.run(first, following=announced)
        checked = one.check(other)
        assert isinstance(checked, Checked)
        assert one.run(other).name == "run-2"


@pytest.mark.parametrize("wish, word", [
    ({"signal": signal.SIGKILL}, "killed by signal 9"),
    ({"die": 70}, "exit code 70"),
    ({"babble": "Unhandled exception"}, "Unhandled exception"),
    ({"babble": "{}"}, "{}"),
    ({"babble": "[1, 2]"}, "[1, 2]"),
])
def test_a_runner_that_dies_takes_one_run_with_it_and_no_other(fake, tmp_path, wish, word):
    answers = answers_of(fake.command, requests(tmp_path, {}, wish, {}, wish, {}))
    for k in (1, 3):
        assert (answers[k].exit_code, answers[k].outcome) == (runner.INTERNAL_ERROR, None)
        assert word in answers[k].message
    assert [answers[k].outcome for k in (0, 2, 4)] == ["converged"] * 3


def test_a_run_over_its_time_limit_is_ended_and_the_next_one_is_made(fake, tmp_path):
    started = time.monotonic()
    with closing(Runner(fake.command)) as one:
        late, next_one = (one.run(request, seconds)
                          for request, seconds in zip(requests(tmp_path, {"sleep": 60}, {}), (1.0, 60.0)))
    assert time.monotonic() - started < 50.0
    assert (late.outcome, next_one.outcome) == (None, "converged")
    assert "longer than its time limit of 1 s" in late.message


def test_an_ordinary_failure_keeps_its_code_and_its_line(fake, tmp_path):
    (answer,) = answers_of(fake.command, requests(tmp_path, {"exitCode": 2}))
    assert (answer.exit_code, answer.outcome, answer.message) == (2, None, "guidewire: bad key")


def test_a_runner_that_cannot_be_started_fails_every_run(tmp_path):
    answers = answers_of([str(tmp_path / "nothing")], requests(tmp_path, {}, {}))
    assert [answer.exit_code for answer in answers] == [runner.INTERNAL_ERROR] * 2
    assert "did not start" in answers[0].message


class LateWriter(Runner):
    """Writes when the process that it started has had the time to die."""

    def _start(self):
        process = super()._start()
        process.wait()
        return process


ENDS = [("raise SystemExit(3)", "exit code 3"), ("import os; os.kill(os.getpid(), 9)", "killed by signal 9"),
        ("import os; os.close(0); os.close(1); import time; time.sleep(0.2); os._exit(7)", "exit code 7")]


@pytest.mark.parametrize("kind, program, how", [
    *((LateWriter, program, how) for program, how in ENDS),
    *((Runner, "import sys; sys.stdin.readline(); " + program, how) for program, how in ENDS),
])
def test_a_runner_that_ends_at_once_fails_every_run_and_says_how(tmp_path, kind, program, how):
    """Whether it dies before or after the request is written must not matter."""
    with closing(kind([sys.executable, "-c", program])) as one:
        answers = [one.run(request) for request in requests(tmp_path, {}, {})]
    assert [answer.exit_code for answer in answers] == [runner.INTERNAL_ERROR] * 2
    assert [answer.message for answer in answers] == [f"the runner died during this run ({how})"] * 2


def test_a_runner_that_is_lost_within_its_answer_says_how_it_ended(tmp_path):
    program = "import os; os.write(1, b'{\"id\": 1, \\xff'); os._exit(4)"
    (answer,) = answers_of([sys.executable, "-c", program], requests(tmp_path, {}))
    assert answer.message == "the runner died during this run (exit code 4)"


def test_a_runner_that_takes_no_requests_is_ended(tmp_path, monkeypatch):
    monkeypatch.setattr(runner, "_SECONDS_TO_END", 0.5)

    class Deaf(Runner):
        def _start(self):
            process = super()._start()
            process.stdout.readline()    # it has closed its input by now
            return process

    program = "import os, time; os.close(0); print('closed', flush=True); time.sleep(60)"
    with closing(Deaf([sys.executable, "-c", program])) as one:
        (request,) = requests(tmp_path, {})
        assert one.run(request).message == "the runner died during this run (it takes no requests)"


def test_an_interrupt_ends_the_run_under_way(fake, tmp_path):
    with closing(Runner(fake.command)) as one:
        started = time.monotonic()

        def interrupt():
            while not list(tmp_path.rglob("begun")) and time.monotonic() < started + 30.0:
                time.sleep(0.01)
            one.interrupt()

        threading.Thread(target=interrupt).start()
        (request,) = requests(tmp_path, {"sleep": 60})
        assert one.run(request).outcome == "interrupted"
    assert time.monotonic() - started < 50.0


def test_no_process_is_left_behind(fake, tmp_path):
    answers_of(fake.command, requests(tmp_path, {}, {"die": 1}, {}))
    for process, *_ in fake.calls():
        with pytest.raises(ProcessLookupError):
            os.kill(process, 0)


def test_the_real_runner_ends_its_run_when_its_parent_process_is_gone(runner_command, tmp_path):
    endless = '{"id": 1, "out": "%s", "set": {"deltaThreshold": 0, "maxSimulationSteps": 100000000}}' % tmp_path
    attached = subprocess.Popen([*runner_command, "-lines", "-attached"], stdin=subprocess.PIPE, text=True,
                                stdout=subprocess.PIPE)
    attached.stdin.write(endless + "\n")
    attached.stdin.flush()
    while not (tmp_path / "positions.json.partial").exists():
        assert attached.poll() is None
        time.sleep(0.02)
    answer, _ = attached.communicate(timeout=60)
    assert '"outcome":"interrupted"' in answer


@pytest.mark.long("two wires in one mesh in turns stand in the tests of Core")
def test_runs_one_after_another_in_one_mesh_have_the_bits_of_each_alone(runner_command, tmp_path):
    """Its wall is made once; a run must not feel what those before it have left."""
    scene = {"parameters": str(ROOT / "params" / "insertion-accurate.json")}
    changes = [{}, {"wireRadius": 0.0003, "insertionSpeed": 0.2}, {"vessel.frictionCoefficient": 0.2}, {},
               {"scale": [1.1, 1.1, 1.1]}, {}]
    texts = [json.dumps({"id": k, **scene, "out": str(tmp_path / str(k)), "set": {"maxSimulationSteps": 60, **more}})
             for k, more in enumerate(changes)]
    done = subprocess.run([*runner_command, "-lines"], input="\n".join(texts) + "\n", capture_output=True, text=True,
                          timeout=120, check=True)
    assert [json.loads(line)["outcome"] for line in done.stdout.splitlines()] == ["finished"] * len(changes)
    for k, text in enumerate(texts):
        alone = json.loads(text)
        alone["out"] = str(tmp_path / f"alone-{k}")
        subprocess.run([*runner_command, "-lines"], input=json.dumps(alone) + "\n", capture_output=True, text=True,
                       timeout=120, check=True)
        assert steps_of(tmp_path / str(k)) == steps_of(tmp_path / f"alone-{k}"), changes[k]


def steps_of(folder):
    """What a run has logged, but for wall times."""
    steps = [{**step, "elapsedMilliseconds": 0.0} for _, step in read_entries(folder)]
    assert len(steps) == 61
    return steps


@pytest.mark.parametrize("program, code, said", [
    ("raise SystemExit(3)", 3, ""),
    ("import os; os.kill(os.getpid(), 9)", 137, "guidewire: the program was killed by signal 9\n"),
])
def test_a_program_that_was_killed_is_said(capsys, program, code, said):
    assert hand_to([sys.executable, "-c", program]) == code
    assert capsys.readouterr().err == said
