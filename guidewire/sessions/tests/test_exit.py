"""Scripts that leave sessions and environments open end in silence, however they start processes."""

import os
import subprocess
import sys

import pytest

from guidewire.prepare import ROOT

LEFT_OPEN = """
import multiprocessing, os, sys, threading
from concurrent.futures import ProcessPoolExecutor
from guidewire import Environment, Session, VectorEnvironment

kept = []


def leave(number=0):
    session = Session(None, hand=True, maxSimulationSteps=100)
    state = session.step(push=1.0)
    kept.append((session, state, session.step(), state.positions[-1]))    # a state is read off, one is not
    return number


def in_processes(kind):
    context = multiprocessing.get_context(kind)
    processes = [context.Process(target=leave) for _ in range(2)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
        assert process.exitcode == 0, process.exitcode


def main(way):
    if way == "here":
        leave()
    elif way == "thread":
        thread = threading.Thread(target=leave)
        thread.start()
        thread.join()
    elif way == "pool":
        with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
            assert list(pool.map(leave, range(2))) == [0, 1]
    elif way == "environments":
        environment = Environment("artery")
        environment.reset(seed=1)
        kept.append(environment)
        for backend in ("threads", "processes"):
            several = VectorEnvironment("artery", 2, backend=backend)
            several.reset(seed=1)
            kept.append(several)
    elif way == "os.fork":
        session = Session(None, hand=True, maxSimulationSteps=100)
        kept.append((session, session.step()))
        child = os.fork()
        if child == 0:
            sys.exit(0)
        assert os.waitpid(child, 0)[1] == 0
        assert session.step().step == 2
    else:
        in_processes(way)
    print("done")


if __name__ == "__main__":
    main(sys.argv[1])
"""


@pytest.mark.parametrize("way", ["here", "thread", "fork", "spawn", "forkserver", "pool", "environments", "os.fork"])
@pytest.mark.few(2)
def test_a_script_that_leaves_sessions_open_ends_in_silence(runner_command, tmp_path, way):
    (tmp_path / "left_open.py").write_text(LEFT_OPEN)
    done = subprocess.run([sys.executable, "left_open.py", way], cwd=tmp_path,
                          env={**os.environ, "PYTHONPATH": str(ROOT)},
                          capture_output=True, text=True, timeout=300, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "done\n", "")


def test_environments_over_processes_without_a_main_guard_are_one_line(runner_command, tmp_path):
    (tmp_path / "script.py").write_text("from guidewire import VectorEnvironment\n"
                                        "several = VectorEnvironment('artery', 2, backend='processes')\n"
                                        "several.reset(seed=1)\n")
    done = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(ROOT)},
                          capture_output=True, text=True, timeout=300, check=False)
    last = done.stderr.splitlines()[-1]
    assert done.returncode == 1 and 'belongs below if __name__ == "__main__":' in last
    assert done.stderr.count("Traceback") == 1
