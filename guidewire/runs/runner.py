"""One runner process that takes one run after another.

A runner started with `-lines` reads one JSON request a line and writes one JSON answer a line, so a sweep pays for no
process start. A runner that dies takes one run with it: that run is answered here as failed, and the next request gets
a new process. Started `-attached`, it ends by itself where we are gone.
"""

from __future__ import annotations

import json
import math
import signal
import subprocess
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from guidewire.runs.process import end_of

BAD_INPUT = 2
FAILED = 5  # something that was asked for is not there
INTERNAL_ERROR = 70
INTERRUPTED = 130
_SECONDS_TO_END = 20.0
_POLL_INTERVAL = 0.25  # s, of the watch for late replies


@dataclass(frozen=True)
class Request:
    """One run to be made.

    Attributes
    ----------
    name : what people call it; the answer repeats it.
    parameters : parameter file; None: the defaults.
    out : folder of the run; None where its parameters are only checked.
    overrides : parameter key to value, which override the file.
    repeat : number of a timed repeat (from 1), or None for a run whose wall time does not matter.
    log : whether it leaves a log.
    """

    name: str
    parameters: Path | None
    out: Path | None
    overrides: dict[str, Any] = field(default_factory=dict)
    repeat: int | None = None
    log: bool = True

    def to_line(self, check: bool = False) -> str:
        """Return the request as the runner reads it; `check` asks for no more than the address of the run."""
        message: dict[str, Any] = {"id": self.name, "set": self.overrides}
        if self.parameters is not None:
            message["parameters"] = str(self.parameters)
        if check:
            message["check"] = True
        else:
            message["out"] = str(self.out)
            if not self.log:
                message["log"] = False
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


@dataclass(frozen=True)
class Checked:
    """A run that can be made.

    Attributes
    ----------
    address : runs with the same address have the same results, wall times apart.
    version : what would make it; part of the address.
    """

    address: str
    version: str


class Runner:
    """One runner process in lines mode, started when first needed and again after it died.

    Parameters
    ----------
    command : what starts it, without `-lines`.
    folder : where it stands, and from where it counts the files that requests name; None: where we stand.
    """

    def __init__(self, command: Sequence[str], folder: Path | None = None) -> None:
        self._command = [*command, "-lines", "-attached"]
        self._folder = folder
        self._process: subprocess.Popen[str] | None = None
        self._ahead = ""  # a request that the process has already, and that is not asked for yet
        self._deadline = math.inf  # of the reply that is waited for, on the monotonic clock
        self._too_late = False

    @property
    def process(self) -> int | None:
        """Its process id, where it runs."""
        return self._process.pid if self._process is not None and self._process.poll() is None else None

    def run(self, request: Request, seconds: float | None = None, following: Request | None = None) -> Answer:
        """Make one run and wait for its end, at most so long. Never raises for what the runner does.

        Parameters
        ----------
        request : the run.
        seconds : how long it may take; None: as long as it likes.
        following : the run that is asked for next: the process has it at once and does not wait for us in between.
        """
        reply = self._ask(request, request.to_line(), seconds, following.to_line() if following else "")
        if isinstance(reply, Answer):
            return reply
        try:
            return Answer(request.name, int(reply["exitCode"]), reply["outcome"], str(reply["message"]))
        except (KeyError, TypeError, ValueError):
            return self._not_an_answer(request, json.dumps(reply))

    def check(self, request: Request, following: Request | None = None) -> Checked | Answer:
        """Return the address of a run, or why it cannot be made; `following` is the run that is checked next."""
        ahead = following.to_line(check=True) if following else ""
        reply = self._ask(request, request.to_line(check=True), _SECONDS_TO_END, ahead)
        if isinstance(reply, Answer):
            return reply
        try:
            if reply["exitCode"] == 0:
                return Checked(str(reply["address"]), str(reply["version"]))
            return Answer(request.name, int(reply["exitCode"]), None, str(reply["message"]))
        except (KeyError, TypeError, ValueError):
            return self._not_an_answer(request, json.dumps(reply))

    def interrupt(self) -> None:
        """Ask for a clean end of the run that is under way, as Ctrl-C does."""
        if self._process is not None and self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)

    def close(self) -> None:
        """End the process; one that does not end by itself in time is killed."""
        process, self._process, self._ahead = self._process, None, ""
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

    def _ask(self, request: Request, line: str, seconds: float | None, ahead: str) -> dict[str, Any] | Answer:
        """Return the runner's reply, or what became of a run that got none."""
        if self._ahead not in ("", line):
            self.close()  # the next reply would be to what nobody asks for any more
        try:
            process = self._start()
            self._deadline = math.inf if seconds is None else time.monotonic() + seconds
            was_sent = self._send(process, ahead if self._ahead else line + ahead)
            self._ahead = ahead
            reply = process.stdout.readline()
        except OSError as error:
            return self._died(request, str(error))
        finally:
            self._deadline = math.inf
        if self._too_late:
            late = f"took longer than its time limit of {seconds:g} s" if was_sent else "it takes no requests"
            return self._died(request, late)
        if not reply.endswith("\n"):    # it has closed its output, perhaps within an answer
            return self._died(request)
        try:
            answer = json.loads(reply)
        except ValueError:
            answer = None
        return answer if isinstance(answer, dict) else self._not_an_answer(request, reply)

    def _send(self, process: subprocess.Popen[str], text: str) -> bool:
        """Write to the process, and return whether it still reads. One that does not has died or is about to. The end
        of its output will say so, as it does where it dies after we wrote."""
        try:
            process.stdin.write(text)
            process.stdin.flush()
            return True
        except OSError:
            self._deadline = min(self._deadline, time.monotonic() + _SECONDS_TO_END)
            return False

    def _start(self) -> subprocess.Popen[str]:
        if self._process is None or self._process.poll() is not None:
            self.close()
            # A session of its own: Ctrl-C on the terminal reaches only us, and we pass it on once.
            self._process = subprocess.Popen(
                self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8",
                errors="replace", start_new_session=True, cwd=self._folder,
            )
            self._too_late = False
            threading.Thread(target=self._watch, args=(self._process,), daemon=True).start()
        return self._process

    def _watch(self, process: subprocess.Popen[str]) -> None:
        """Kill the process where a reply is late. A thread of its own, because reading a pipe has no time limit."""
        while process is self._process and process.poll() is None:
            if time.monotonic() > self._deadline:
                self._too_late = True
                process.kill()
            time.sleep(_POLL_INTERVAL)

    def _not_an_answer(self, request: Request, line: str) -> Answer:
        return self._died(request, f"it wrote {line.strip()[:200]!r} instead of an answer")

    def _died(self, request: Request, why: str = "") -> Answer:
        """Return that there is no answer: `why` this process is ended; without a reason how it has ended by itself."""
        process = self._process
        if process is None:
            return Answer(request.name, INTERNAL_ERROR, None, f"the runner did not start: {why}")
        if why:
            process.kill()
        ended = why or end_of(process, _SECONDS_TO_END)
        self.close()
        return Answer(request.name, INTERNAL_ERROR, None, f"the runner died during this run ({ended})")
