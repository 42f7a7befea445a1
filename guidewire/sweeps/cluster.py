"""The workers that make runs, by dask.distributed: a cluster within this process, or a scheduler that runs elsewhere.

Runs are handed out in batches that take about half a second, two for each place, so that handing out costs little and
the last batches end together. What goes wrong with a run costs that run, and it is made once more:

- dask gives the batch of a lost worker to another one, which goes on where it was;
- a batch that has lost several workers is made again run by run;
- a run without a whole result (its runner died, it took too long, the disk was full) is handed out again at the end.
"""

from __future__ import annotations

import logging
import platform
import tempfile
import threading
import time
import uuid
import warnings
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import closing, nullcontext
from pathlib import Path
from types import TracebackType

import cloudpickle
import dask
import distributed
from distributed import Client, Future, KilledWorker, LocalCluster
from distributed.client import CancelledError

from guidewire.prepare import PreparationError
from guidewire.runs import process, runner, whole_files
from guidewire.runs.runner import INTERNAL_ERROR, Answer, Request, Runner
from guidewire.sweeps import load, store, worker
from guidewire.sweeps.worker import Job, Runners

_BATCH = 0.5  # s, what a batch should take
_CHECKED = 500  # runs, of which a batch of checks is at most
_IN_HAND = 2  # batches for each place: one at work, one that waits
_WHOLE = ("converged", "finished", "diverged")  # with these, a runner has written all that was asked for
_TO_ANSWER = 5.0  # s, for a scheduler
_TO_END = 60.0  # s, for a run that was interrupted
_POLL_INTERVAL = 5.0  # s, for workers that came or went
_WITHOUT_WORKERS = 60.0  # s, that a sweep waits for workers to come back

_TRAVELLING = (load, process, runner, store, whole_files, worker)  # the code that workers elsewhere get with the runs
OnAnswer = Callable[[Job, Answer], None]


class Cluster:
    """Workers that make runs, to be used in a `with` statement.

    Parameters
    ----------
    command : the runner.
    results : folder of the runs; every worker has to see it.
    folder : where runners stand; None: where we stand.
    address : of a running scheduler; None: a cluster within this process.
    jobs : runs at once, of the cluster within this process.

    Raises
    ------
    PreparationError : no scheduler at the address, no worker there, or one that cannot make these runs.
    """

    def __init__(
        self, command: Sequence[str], results: Path, folder: Path | None, address: str | None, jobs: int
    ) -> None:
        logging.getLogger("distributed").setLevel(logging.CRITICAL)
        self._command = tuple(command)
        self._address = address
        self._cluster: LocalCluster | None = None
        self._plugin = ""
        self._scratch = tempfile.TemporaryDirectory(prefix="guidewire-workers-")
        dask.config.set({
            "temporary-directory": self._scratch.name,
            "distributed.diagnostics.computations.ignore-modules": [".*"],  # no sources for a dashboard
            # Nobody looks at the profiles that dask takes of all threads, and Python 3.11 can hang while it takes one
            # (github.com/python/cpython/issues/106883).
            "distributed.worker.profile.enabled": False,
        })
        self._works = (worker.make, worker.check)
        if address is not None:
            for module in _TRAVELLING:
                cloudpickle.register_pickle_by_value(module)  # workers elsewhere have no such package
            # Copies: dask keeps what it has pickled once, which may have been for workers within this process.
            self._works = tuple(cloudpickle.loads(cloudpickle.dumps(work)) for work in self._works)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of other versions, which we look for ourselves, and of ports in use
                if address is None:
                    self._cluster = LocalCluster(
                        n_workers=1, threads_per_worker=jobs, processes=False, dashboard_address=None, memory_limit=0,
                        silence_logs=logging.CRITICAL,
                    )
                self._client = Client(self._cluster or address, timeout=_TO_ANSWER)
        except (OSError, ValueError) as error:
            self._forget()
            raise PreparationError(f"no scheduler answers at {address}: start one with 'dask-scheduler', "
                                   "and give the address that it prints") from error
        try:
            self._prepare(results, (folder or Path.cwd()).absolute())  # workers stand elsewhere
        except BaseException as error:
            is_gone = isinstance(error, (CancelledError, OSError)) and self._client.status != "running"
            self.close()
            if is_gone:
                raise self._gone() from error
            raise

    def __enter__(self) -> Cluster:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None and issubclass(kind, KeyboardInterrupt):
            # What dask still waits for is given up as it is meant to be; it would say so with traces.
            for name in ("asyncio", "tornado"):
                logging.getLogger(name).setLevel(logging.CRITICAL)
        self.close()

    def close(self) -> None:
        """End the runners, and the cluster within this process."""
        if self._plugin:
            try:
                self._client.unregister_worker_plugin(self._plugin)
            except (OSError, CancelledError):
                pass  # the scheduler is gone
        self._client.close()
        if self._cluster is not None:
            self._cluster.close()
        self._forget()

    @property
    def places(self) -> int:
        """Runs that can be made at once; none while the scheduler does not answer."""
        if self._client.status != "running":
            if self._client.status == "closed":
                raise self._gone()
            return 0
        return sum(found["nthreads"] for found in self._client.scheduler_info()["workers"].values())

    def check(self, jobs: Sequence[Job]) -> list[str | Answer]:
        """Return the addresses of runs, or why they cannot be made, in their order.

        Raises
        ------
        PreparationError : the scheduler is gone, or the runner dies of a check.
        """
        size = max(1, min(_CHECKED, -(-len(jobs) // (_IN_HAND * max(1, self.places)))))
        try:
            checked = [found for part in self._client.gather([
                self._client.submit(self._works[1], self._plugin, self._command, worker.to_text(jobs[k:k + size]),
                                    pure=False)
                for k in range(0, len(jobs), size)
            ]) for found in part]
        except KilledWorker as error:
            raise PreparationError("parameters could not be checked: a worker was lost again and again") from error
        except CancelledError as error:
            raise self._gone() from error
        return [found[0] if len(found) == 1 else Answer(job.request.name, found[0], None, found[1])
                for job, found in zip(jobs, checked)]

    def make(self, jobs: Sequence[Job], on_answer: OnAnswer, alone: bool = False,
             command: Sequence[str] | None = None) -> None:
        """Make runs.

        Parameters
        ----------
        jobs : the runs.
        on_answer : called in the calling thread, once for each job, in the order in which runs end. An answer without
            an outcome is of a run that was begun twice and has no whole result.
        alone : make one at a time.
        command : what makes them instead of the runner.

        Raises
        ------
        KeyboardInterrupt : after Ctrl-C, when every run under way has ended cleanly and been passed to `on_answer`.
        PreparationError : the scheduler is gone, or all workers are.
        """
        queue = _Queue(self, command or self._command, jobs, on_answer)
        try:
            queue.drain(1 if alone else None)
        except KeyboardInterrupt:
            self._client.run(worker.stop, self._plugin)
            queue.take_up()
            raise
        except CancelledError as error:
            raise self._gone() from error

    def submit(self, command: Sequence[str], jobs: Sequence[Job]) -> Future:
        """Hand out a batch."""
        return self._client.submit(
            self._works[0], self._plugin, tuple(command), worker.to_text(jobs), pure=False
        )

    def _forget(self) -> None:
        """Take back what was changed for all of dask."""
        if self._address is not None:
            for module in _TRAVELLING:
                cloudpickle.unregister_pickle_by_value(module)
        self._scratch.cleanup()

    def _gone(self) -> PreparationError:
        return PreparationError(f"the scheduler at {self._address} is gone; {_KEPT}")

    def _prepare(self, results: Path, folder: Path) -> None:
        """Let every worker start a runner, or say in one line which cannot make these runs."""
        if not self._client.scheduler_info()["workers"]:
            raise PreparationError(f"the scheduler at {self._address} has no worker: start one with "
                                   f"'dask-worker {self._address}'")
        for place, theirs in self._client.get_versions()["workers"].items():
            for name, here in _HERE.items():
                there = theirs["packages"][name] if name != "python" else _major_minor(theirs["packages"][name])
                if there != here:
                    raise PreparationError(f"worker {place} has another version of {name} ({there}; here {here})")
        version = "" if self._address is None else self._version_here()
        plugin = f"guidewire-{uuid.uuid4()}"
        register = getattr(self._client, "register_plugin", None) or self._client.register_worker_plugin
        register(Runners(version, folder), name=plugin)
        self._plugin = plugin
        there = next(place for place in (results, *results.parents) if place.is_dir())
        with nullcontext() if self._address is None else tempfile.NamedTemporaryFile(dir=there) as mark:
            problems = self._client.run(worker.probe, self._plugin, self._command, mark.name if mark else str(there))
        for place, problem in problems.items():
            if problem:
                raise PreparationError(f"worker {place} {problem}")

    def _version_here(self) -> str:
        """Return the version of the runner, which those of the workers have to have."""
        with closing(Runner(self._command)) as here:
            found = here.check(Request("version", None, None))
        if isinstance(found, Answer):
            raise PreparationError(found.message)
        return found.version


def _major_minor(version: str) -> str:
    return ".".join(version.split(".")[:2])


_HERE = {"python": _major_minor(platform.python_version()), "distributed": distributed.__version__}
_KEPT = "completed runs are kept, the same command continues from here"


class _Queue:
    """Jobs that wait, and batches that workers have."""

    def __init__(self, cluster: Cluster, command: Sequence[str], jobs: Sequence[Job], on_answer: OnAnswer) -> None:
        self._cluster = cluster
        self._command = command
        self._waiting = deque(jobs)
        self._again: list[Job] = []  # have failed once; handed out when all others are done
        self._second: set[Path] = set()  # folders of runs that are made the second time
        self._flying: dict[Future, list[Job]] = {}
        # a batch of this queue; `distributed.wait` asks the client of the whole process
        self._landed = threading.Event()
        self._on_answer = on_answer
        self._seconds = 0.0  # that workers spent
        self._answered = 0

    def drain(self, at_most: int | None) -> None:
        """Make all jobs, at most so many batches at once."""
        lonely = time.monotonic()
        while self._waiting or self._flying or self._again:
            if not self._waiting and not self._flying:
                self._waiting.extend(self._again)
                self._again.clear()
            places = self._cluster.places
            if places:
                lonely = time.monotonic()
            elif time.monotonic() - lonely > _WITHOUT_WORKERS:
                raise PreparationError(f"no worker is left; {_KEPT}")
            while self._waiting and len(self._flying) < (at_most or _IN_HAND * max(1, places)):
                self._hand_out(1 if at_most else self._size(places))
            self._take_back()

    def take_up(self) -> None:
        """What the runs under way came to, when nothing more is to be made."""
        for future, jobs in self._flying.items():
            try:
                answers = future.result(timeout=_TO_END)["answers"]
            except (KilledWorker, CancelledError, OSError, TimeoutError, distributed.TimeoutError):
                continue
            for job, answer in zip(jobs, answers):
                self._on_answer(job, Answer(*answer))

    def _size(self, places: int) -> int:
        """Runs of the next batch: so many that they take so long, and at most an even part of those that wait."""
        if not self._answered or self._waiting[0].request.out in self._second:
            return 1
        even = len(self._waiting) // (_IN_HAND * max(1, places))
        return max(1, min(even, int(_BATCH * self._answered / max(self._seconds, 1e-3))))

    def _hand_out(self, size: int) -> None:
        batch = [self._waiting.popleft() for _ in range(size)]
        future = self._cluster.submit(self._command, batch)
        self._flying[future] = batch
        future.add_done_callback(lambda _: self._landed.set())

    def _take_back(self) -> None:
        """Wait for a batch, and take those that have ended."""
        self._landed.wait(_POLL_INTERVAL)
        self._landed.clear()
        for future in [future for future in self._flying if future.done()]:
            jobs = self._flying.pop(future)
            try:
                made = future.result()
            except KilledWorker:
                answers = [Answer(job.request.name, INTERNAL_ERROR, None, "its worker was lost") for job in jobs]
            else:
                if made["problem"]:
                    raise PreparationError(f"a worker {made['problem']}")
                answers = [Answer(*answer) for answer in made["answers"]]
                self._seconds += made["seconds"]
                self._answered += len(answers)
            for job, answer in zip(jobs, answers):
                if answer.outcome in _WHOLE or job.is_done or job.request.out in self._second:
                    self._on_answer(job, answer)
                else:
                    self._second.add(job.request.out)
                    self._again.append(job)
