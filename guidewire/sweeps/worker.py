"""A worker of the cluster: keeps runners alive and makes batches of runs with them.

This code travels to workers by value (see guidewire/sweeps/cluster.py): they need dask's packages and, under the paths
that they have here, the programs that make runs and the folder of the results.
"""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any

from distributed import WorkerPlugin, get_worker

from guidewire.runs.runner import Answer, Checked, Request, Runner
from guidewire.runs.whole_files import write_whole
from guidewire.sweeps.load import DISTURBED, LoadBeside
from guidewire.sweeps.store import LOAD, read_whole

_MEASURED_AT_MOST = 3

Plain = Sequence[Any]  # of a job: what every worker can read, whatever code it has
# Jobs travel as one text: dask looks into lists, for each of their parts, for what it should compute first.


@dataclass(frozen=True)
class Job:
    """A run to be made.

    Attributes
    ----------
    request : what the runner is asked.
    timed : whether the load of the machine is measured beside it.
    seconds : how long it may take.
    """

    request: Request
    timed: bool
    seconds: float

    def to_plain(self) -> Plain:
        """Return the job as it travels."""
        asked = self.request
        return (asked.name, str(asked.parameters), str(asked.out or ""), asked.overrides, asked.repeat, asked.log,
                self.timed,
                self.seconds)

    @classmethod
    def of(cls, plain: Plain) -> Job:
        """Return the job that has travelled."""
        name, parameters, out, overrides, repeat, log, timed, seconds = plain
        return cls(Request(name, Path(parameters), Path(out), overrides, repeat, log), timed, seconds)

    @property
    def is_done(self) -> bool:
        """Whether its folder holds the whole run."""
        return read_whole(self.request.out, self.request.log, self.timed) is not None


def to_text(jobs: Sequence[Job]) -> str:
    """Return a batch of jobs as it travels."""
    return json.dumps([job.to_plain() for job in jobs])


def of_text(text: str) -> list[Job]:
    """Return the batch that has travelled."""
    return [Job.of(plain) for plain in json.loads(text)]


class WorkerProblem(Exception):
    """A worker cannot make these runs; the text is one line that says why."""


class Runners(WorkerPlugin):
    """The runners of one worker, by the command that starts them; as many as it has threads.

    Parameters
    ----------
    version : what has to make the runs; empty: whatever is there.
    folder : where runners stand.
    """

    def __init__(self, version: str, folder: Path) -> None:
        self._version = version
        self._folder = folder

    def setup(self, worker: object) -> None:
        """dask's call on the worker."""
        self._lock = threading.Lock()
        self._free: dict[tuple[str, ...], list[Runner]] = {}
        self._all: list[Runner] = []
        self._stopped = False

    def teardown(self, worker: object) -> None:
        """dask's call at the worker's end."""
        with self._lock:
            for runner in self._all:
                runner.close()

    def stop(self) -> None:
        """End the runs under way as Ctrl-C does, and make no other."""
        with self._lock:
            self._stopped = True
            for runner in self._all:
                runner.interrupt()

    def start(self, command: Sequence[str], count: int) -> None:
        """Start so many runners of a command, at once; raises as `runner` does."""
        with ThreadPoolExecutor(count) as pool:
            started = list(pool.map(self._start, [command] * count))
        with self._lock:
            self._free.setdefault(tuple(command), []).extend(started)

    @contextmanager
    def runner(self, command: Sequence[str]) -> Iterator[Runner]:
        """Provide a runner of a command that nobody else uses meanwhile, started and found to be of the right version.

        Raises
        ------
        WorkerProblem : it does not start, or is of another version.
        """
        key = tuple(command)
        with self._lock:
            free = self._free.setdefault(key, [])
            runner = free.pop() if free else None
        runner = runner or self._start(command)
        try:
            yield runner
        finally:
            with self._lock:
                free.append(runner)

    def _start(self, command: Sequence[str]) -> Runner:
        runner = Runner(command, self._folder)
        found = runner.check(Request("version", None, None))
        if isinstance(found, Checked) and found.version == (self._version or found.version):
            with self._lock:
                self._all.append(runner)
            return runner
        runner.close()
        if isinstance(found, Checked):
            raise WorkerProblem(f"has another version ({found.version}; here {self._version})")
        raise WorkerProblem(f"cannot start {' '.join(command)}: {found.message}")

    def make(self, command: Sequence[str], jobs: Sequence[Job]) -> list[Answer]:
        """Make what is not done of a batch; one that was begun by a worker that was lost goes on here."""
        answers = []
        missing = {job.request.out: job.request for job in jobs if not job.is_done}
        with self.runner(command) as runner:
            for job in jobs:
                if self._stopped:
                    break
                if missing.pop(job.request.out, None) is None:
                    answers.append(Answer(job.request.name, 0, None, "made by a worker that was lost"))
                elif job.timed:
                    answers.append(_time(runner, job))
                else:
                    answers.append(runner.run(job.request, job.seconds, next(iter(missing.values()), None)))
        return answers


def make(plugin: str, command: Sequence[str], jobs: str) -> dict[str, Any]:
    """`Runners.make` of the worker that this is run on: `answers`, the `seconds` that they took, and the `problem` of a
    worker that cannot make any, in one line."""
    started = time.monotonic()
    try:
        answers = get_worker().plugins[plugin].make(command, of_text(jobs))
    except WorkerProblem as problem:
        return {"answers": [], "seconds": 0.0, "problem": str(problem)}
    described = [(answer.name, answer.exit_code, answer.outcome, answer.message) for answer in answers]
    return {"answers": described, "seconds": time.monotonic() - started, "problem": ""}


def check(plugin: str, command: Sequence[str], jobs: str) -> list[Plain]:
    """Return of each job the address of its run, or exit code and line of why it cannot be made."""
    found = []
    requests = [job.request for job in of_text(jobs)]
    with get_worker().plugins[plugin].runner(command) as runner:
        for request, following in zip_longest(requests, requests[1:]):
            checked = runner.check(request, following)
            found.append((checked.address,) if isinstance(checked, Checked) else (checked.exit_code, checked.message))
    return found


def probe(plugin: str, command: Sequence[str], mark: str, dask_worker: Any) -> str:
    """Start the runners of a worker, which dask names: outside of tasks `get_worker` gives any of this process. Why it
    cannot make runs, in one line; empty where it can. It must see what is at `mark`."""
    if not Path(mark).exists():
        return f"does not see {Path(mark).parent}: workers need the folder of the results under the same path"
    count = dask_worker.state.nthreads if hasattr(dask_worker, "state") else dask_worker.nthreads  # by dask's version
    try:
        dask_worker.plugins[plugin].start(command, count)
    except WorkerProblem as problem:
        return str(problem)
    return ""


def stop(plugin: str, dask_worker: Any) -> None:
    """`Runners.stop` of a worker, which dask names."""
    dask_worker.plugins[plugin].stop()


def _time(runner: Runner, job: Job) -> Answer:
    """Return a timed run with the load beside it, measured again where others disturbed it."""
    for measured in range(1, _MEASURED_AT_MOST + 1):
        load = LoadBeside(runner.process) if runner.process is not None else None
        answer = runner.run(job.request, job.seconds)
        if load is None or runner.process is None or answer.outcome is None:
            return answer
        busy = load.others_busy()
        if busy < DISTURBED:
            break
    text = json.dumps({"othersBusy": busy, "timesMeasured": measured}) + "\n"
    try:
        write_whole(job.request.out / LOAD, text)
    except OSError as error:
        return Answer(job.request.name, answer.exit_code, None, f"the load could not be written: {error.strerror}")
    return answer
