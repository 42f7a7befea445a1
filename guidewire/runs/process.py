"""A child process with its own log and time limit, and its processor time."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from guidewire.prepare import ROOT


class Process:
    """A program that runs in a process group of its own, with all its output in a log of its own.

    Attributes
    ----------
    code : exit code, negative for the signal that killed it; None while it runs.
    wall : how long it ran, s.
    processor : time that it and the processes that it waited for spent on a processor, s.

    Parameters
    ----------
    name : what its log is called.
    command : what starts it.
    environment : all of it.
    logs : folder of the log.
    seconds : how long it may run.
    niceness : by how much it gives way to other programs.
    """

    def __init__(
        self, name: str, command: Sequence[str], environment: Mapping[str, str], logs: Path, seconds: float,
        niceness: int = 0,
    ) -> None:
        self.code: int | None = None
        self.wall = self.processor = 0.0
        self._log = logs / (file_name(name) + ".log")
        self._seconds = seconds
        self._started = time.monotonic()
        with self._log.open("wb") as output:
            self._process = subprocess.Popen(
                command, cwd=ROOT, env=dict(environment), stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                start_new_session=True,
            )
        if niceness:
            os.setpriority(os.PRIO_PROCESS, self._process.pid, niceness)

    def has_ended(self) -> bool:
        """Whether it has; kills it where its time is over."""
        if self.code is None:
            self._wait(os.WNOHANG)
        if self.code is None and time.monotonic() - self._started > self._seconds:
            self.kill()
            with self._log.open("ab") as output:
                output.write(f"\nstopped after {self._seconds:.0f} s\n".encode())
        return self.code is not None

    def kill(self) -> None:
        """End it and every process of its group."""
        os.killpg(self._process.pid, signal.SIGKILL)
        self._wait(0)

    def last_lines(self, count: int = 60) -> str:
        """The last lines that it wrote, and in which file the others are."""
        lines = self._log.read_text(encoding="utf-8", errors="replace").splitlines()
        return "\n".join([f"--- the last lines of {os.path.relpath(self._log)}", *lines[-count:], "---"])

    def _wait(self, options: int) -> None:
        ended, status, used = os.wait4(self._process.pid, options)
        if ended:
            self.code = self._process.returncode = os.waitstatus_to_exitcode(status)
            self.wall = time.monotonic() - self._started
            self.processor = used.ru_utime + used.ru_stime


def hand_to(command: Sequence[str], cwd: Path | None = None, environment: Mapping[str, str] | None = None) -> int:
    """Run a program on our terminal and return its exit code. Ctrl-C reaches it too, and a request to terminate
    is passed on: it decides how to end. `environment` is laid over ours."""
    process = subprocess.Popen(command, cwd=cwd, env={**os.environ, **(environment or {})})
    before = signal.signal(signal.SIGTERM, lambda number, frame: process.terminate())
    try:
        while True:
            try:
                code = process.wait()
                return code if code >= 0 else 128 - code
            except KeyboardInterrupt:
                continue
    finally:
        signal.signal(signal.SIGTERM, before)


def file_name(name: str) -> str:
    """A name as part of a file's."""
    return re.sub(r"[^A-Za-z0-9.]+", "-", name)
