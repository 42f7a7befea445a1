"""Lets the headless runner work: one run after another in each process, several processes at once.

A runner started with `-lines` reads one JSON request a line and writes one JSON answer a line, so a sweep pays for
no process start. A runner that dies takes one run with it, not the sweep: that run is answered here as failed, and
the next request gets a new process.
"""

from __future__ import annotations

import json
import queue
import signal
import subprocess
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

INTERNAL_ERROR = 70
INTERRUPTED = 130
_SECONDS_TO_END = 20.0


@dataclass(frozen=True)
class Request:
    """One run to be made.

    Attributes
    ----------
    name : what the answer is recognised by; unique among the requests of one call of `run_all`.
    parameters : parameter file.
    out : folder of the run.
    overrides : parameter key to value, laid over the file.
    repeat : number of a timed repeat (from 1), or None for a run whose wall time does not matter.
    """

    name: str
    parameters: Path
    out: Path
    overrides: dict[str, Any] = field(default_factory=dict)
    repeat: int | None = None

    def to_line(self) -> str:
        """The request as the runner reads it; a complete run of the same parameters is not run again."""
        message: dict[str, Any] = {
            "id": self.name, "parameters": str(self.parameters), "set": self.overrides, "out": str(self.out),
            "reuse": True,
        }
        if self.repeat is not None:
            message["repeat"] = self.repeat
        return json.dumps(message) + "\n"


@dataclass(frozen=True)
class Answer:
    """What became of one run. `outcome` is None where there was none (bad parameters, a runner that died)."""

    name: str
    exit_code: int
    outcome: str | None
    message: str
    reused: bool


class Runner:
    """One runner process in lines mode, started when first needed and again after it died."""

    def __init__(self, command: Sequence[str]) -> None:
        self._command = [*command, "-lines"]
        self._process: subprocess.Popen[str] | None = None
        self._interrupted = False

    def run(self, request: Request) -> Answer:
        """Make one run and wait for its end. Never raises for what the runner does."""
        used = self._process is not None
        answer = self._ask(request)
        if used and self._process is None and not self._interrupted:
            # What killed a process that had worked before may be its past: the run gets a process of its own, once.
            answer = self._ask(request)
        return answer

    def _ask(self, request: Request) -> Answer:
        try:
            process = self._start()
            process.stdin.write(request.to_line())
            process.stdin.flush()
            line = process.stdout.readline()
        except OSError as error:
            return self._died(request, str(error))
        try:
            answer = json.loads(line)
            return Answer(
                request.name, int(answer["exitCode"]), answer["outcome"], str(answer["message"]),
                bool(answer["reused"]),
            )
        except (ValueError, KeyError, TypeError):
            return self._died(request, f"it wrote {line.strip()[:200]!r} instead of an answer" if line else "")

    def interrupt(self) -> None:
        """Ask for a clean end of the run that is under way, as Ctrl-C does."""
        self._interrupted = True
        if self._process is not None and self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)

    def close(self) -> None:
        """End the process; one that does not end by itself in time is killed."""
        process, self._process = self._process, None
        if process is None:
            return
        try:
            process.stdin.close()
        except OSError:
            pass  # it is dead already
        try:
            process.wait(timeout=_SECONDS_TO_END)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        process.stdout.close()

    def _start(self) -> subprocess.Popen[str]:
        if self._process is None or self._process.poll() is not None:
            self.close()
            # A session of its own: Ctrl-C on the terminal reaches only us, and we pass it on once.
            self._process = subprocess.Popen(
                self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8",
                start_new_session=True,
            )
        return self._process

    def _died(self, request: Request, why: str) -> Answer:
        process = self._process
        if process is None:
            return Answer(request.name, INTERNAL_ERROR, None, f"the runner did not start: {why}", False)
        if why:
            process.kill()
        code = process.wait()
        ended = f"killed by signal {-code}" if code < 0 else f"exit code {code}"
        self.close()
        return Answer(request.name, INTERNAL_ERROR, None, f"the runner died during this run ({why or ended})", False)


def run_all(
    command: Sequence[str],
    requests: Sequence[Request],
    jobs: int,
    on_answer: Callable[[Request, Answer], None],
) -> None:
    """Make all runs, at most `jobs` at once, each process taking the next request when it is free.

    Parameters
    ----------
    command : the runner, as `building.build` returns it.
    requests : the runs.
    jobs : number of processes.
    on_answer : called in the calling thread, once per request, in the order in which runs end.

    Raises
    ------
    KeyboardInterrupt : after Ctrl-C, when every run under way has ended cleanly and been passed to `on_answer`.
    """
    waiting: queue.SimpleQueue[Request] = queue.SimpleQueue()
    for request in requests:
        waiting.put(request)
    answers: queue.SimpleQueue[tuple[Request, Answer] | None] = queue.SimpleQueue()
    runners = [Runner(command) for _ in range(max(1, min(jobs, len(requests))))]
    stop = threading.Event()

    def work(runner: Runner) -> None:
        try:
            while not stop.is_set():
                request = waiting.get_nowait()
                answers.put((request, runner.run(request)))
        except queue.Empty:
            pass
        finally:
            runner.close()
            answers.put(None)

    threads = [threading.Thread(target=work, args=(runner,), daemon=True) for runner in runners]
    for thread in threads:
        thread.start()
    running, interrupted = len(threads), False
    while running:
        try:
            ended = answers.get()
            if ended is None:
                running -= 1
            else:
                on_answer(*ended)
        except KeyboardInterrupt:
            interrupted = True
            stop.set()
            for runner in runners:
                runner.interrupt()
    if interrupted:
        raise KeyboardInterrupt
