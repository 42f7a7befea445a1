"""A scheduler and its workers as processes of their own: results, lost workers, other versions; and a sweep that is
killed and goes on."""

import csv
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from distributed import LocalCluster

from guidewire.prepare import ROOT, PreparationError
from guidewire.studies.table import Axis, Grid, Study
from guidewire.sweeps import cluster
from guidewire.sweeps.sweep import WALL_TIMES, Means, sweep

SCENE = {"maxSimulationSteps": 5, "constraintSolverSteps": 5}


class Processes:
    """A scheduler and two workers."""

    def __init__(self, folder):
        self._folder = folder
        self._scheduler = self._start("dask_scheduler", "--port", "0", "--host", "127.0.0.1")
        self.workers = [self._start("dask_worker", "--nthreads", "1", "--no-nanny", "--local-directory", str(folder))
                        for _ in range(2)]

    @property
    def address(self):
        """Of the scheduler, when it is up: its file is there before all of it is written."""
        end = time.monotonic() + 60.0
        while True:
            try:
                return json.loads(wait_for(self._folder / "scheduler.json").read_text())["address"]
            except ValueError:
                assert time.monotonic() < end
                time.sleep(0.02)

    def _start(self, program, *options):
        # Not where the repository stands: workers elsewhere do not see its packages either.
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.{program}", "--no-dashboard", "--scheduler-file",
             str(self._folder / "scheduler.json"), *options],
            cwd=self._folder, env=os.environ | {"DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False"},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def close(self):
        for process in (*self.workers, self._scheduler):
            process.kill()
            process.wait()


def wait_for(path, seconds=60.0):
    end = time.monotonic() + seconds
    while not path.exists():
        assert time.monotonic() < end, path
        time.sleep(0.02)
    return path


@pytest.fixture(scope="module")
def processes(tmp_path_factory):
    made = Processes(tmp_path_factory.mktemp("cluster"))
    from distributed import Client

    try:
        with Client(made.address) as client:
            client.wait_for_workers(2, timeout=60)
        yield made
    finally:
        made.close()


def results_of(folder):
    with open(folder / "runs.csv", newline="") as file:
        return list(csv.DictReader(file))


def study_of(name, *axes, logs=False, **options):
    return Study(name, "a study", "params/default.json", Grid(axes, **options), logs=logs)


def test_workers_elsewhere_make_the_same_results(processes, runner_command, tmp_path):
    study = study_of("same", Axis("displacement", tuple(0.5 * k for k in range(1, 21))), common=SCENE)
    tables = []
    for name, address in (("here", None), ("there", processes.address)):
        result = sweep([(study, tmp_path / name)], tmp_path / name / "runs", Means(runner_command, 2, address))
        assert result.made == 20 and result.failures == []
        tables.append([{k: v for k, v in row.items() if k not in WALL_TIMES}
                       for row in results_of(tmp_path / name / "same")])
    assert tables[0] == tables[1]


def test_files_that_a_study_names_count_from_its_folder_however_that_was_typed(
        processes, runner_command, tmp_path, monkeypatch):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "load.csv").write_text("0,0\n1,1\n")
    monkeypatch.chdir(tmp_path)
    study = study_of("loaded", Axis("numberRodElements", (4, 5)), common={
        "solver": "direct", "maxSimulationSteps": 1, "loadTables": {"tipForce": "load.csv"}})
    result = sweep([(study, tmp_path)], tmp_path / "runs", Means(runner_command, 2, processes.address, Path("mine")))
    assert (result.made, result.failures) == (2, [])


def test_workers_of_another_version_are_one_line(processes, fake, tmp_path, monkeypatch):
    monkeypatch.setenv("FAKE_VERSION", "fake 2")
    with pytest.raises(PreparationError, match=r"^worker tcp.* has another version \(fake 1; here fake 2\)$"):
        sweep([(study_of("one"), tmp_path)], tmp_path / "runs", Means(fake.command, 1, processes.address))
    assert list(tmp_path.iterdir()) == []


def test_no_scheduler_at_the_address_and_one_without_workers_are_one_line(fake, tmp_path, monkeypatch):
    with monkeypatch.context() as patched, pytest.raises(
            PreparationError, match="^no scheduler answers at tcp://127.0.0.1:9: start one"):
        patched.setattr(cluster, "_TO_ANSWER", 1.0)
        sweep([(study_of("one"), tmp_path)], tmp_path / "runs", Means(fake.command, 1, "tcp://127.0.0.1:9"))
    monkeypatch.setattr(cluster, "_TO_ANSWER", 60.0)
    with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address=None, processes=True) as empty:
        with pytest.raises(PreparationError, match="has no worker: start one with 'dask-worker tcp://"):
            sweep([(study_of("one"), tmp_path)], tmp_path / "runs", Means(fake.command, 1, empty.scheduler_address))


def test_a_worker_that_is_killed_costs_no_run(processes, fake, tmp_path):
    """The last of this file that needs both workers. Its last runs end only when the worker has gone."""
    gone = tmp_path / "gone"
    study = study_of("killed", Axis("sleep", tuple(0.05 + 1e-4 * k for k in range(12))),
                     variants={"before": {}, "after": {"until": str(gone)}})

    def kill():
        wait_for(fake.journal)
        while len(fake.calls()) < 6:
            time.sleep(0.02)
        processes.workers[0].kill()
        processes.workers[0].wait()
        gone.touch()

    killer = threading.Thread(target=kill)
    killer.start()
    result = sweep([(study, tmp_path)], tmp_path / "runs", Means(fake.command, 1, processes.address))
    killer.join()
    assert processes.workers[0].poll() == -signal.SIGKILL
    rows = results_of(tmp_path / "killed")
    assert (result.made, result.failures) == (24, []) and {row["outcome"] for row in rows} == {"converged"}
    assert len({row["key"] for row in rows}) == len({row["folder"] for row in rows}) == 24


@pytest.mark.long("a worker that is killed costs no run")
def test_a_sweep_that_is_killed_goes_on_where_it_was(runner_command, tmp_path):
    axes = {"displacement": {"from": 1, "to": 40, "count": 40}}
    (tmp_path / "study.json").write_text(json.dumps({
        "study": "mine", "scene": os.path.relpath(ROOT / "params/default.json", tmp_path), "axes": axes,
        "common": {"maxSimulationSteps": 100, "constraintSolverSteps": 50, "deltaThreshold": 0}}))
    command = [sys.executable, str(ROOT / "guidewire.py"), "sweep", "study.json"]
    killed = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    runs = tmp_path / "results" / "runs"
    while len(first := list(runs.glob("*/*/summary.json"))) < 10:
        assert killed.poll() is None
        time.sleep(0.02)
    killed.kill()
    killed.wait()
    before = {path: path.stat().st_mtime_ns for path in first}
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    rows = results_of(tmp_path / "results" / "mine")
    assert len(rows) == len({row["folder"] for row in rows}) == 40 and {row["outcome"] for row in rows} == {"finished"}
    assert {path: path.stat().st_mtime_ns for path in first} == before
    assert len(list(runs.glob("*/*/summary.json"))) == 40 and not list(runs.glob("*/*/*.partial"))


@pytest.mark.parametrize("when", ["get_versions", "run"])
@pytest.mark.long("that none is at an address is one line, too")
def test_a_scheduler_that_is_killed_while_its_workers_are_asked_is_one_line(fake, tmp_path, monkeypatch, when):
    made = Processes(tmp_path)
    try:
        with cluster.Client(made.address) as client:
            client.wait_for_workers(2, timeout=60)
        address, original = made.address, getattr(cluster.Client, when)

        def killed(self, *arguments, **options):
            made.close()
            return original(self, *arguments, **options)

        monkeypatch.setattr(cluster.Client, when, killed)
        with pytest.raises(PreparationError, match=f"^the scheduler at {address} is gone; "):
            sweep([(study_of("one"), tmp_path)], tmp_path / "runs", Means(fake.command, 1, address))
    finally:
        made.close()
