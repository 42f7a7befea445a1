"""A program that takes our place on the terminal, and how one ended that no longer answers."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path


def how_it_ended(code: int) -> str:
    """Words for the exit code of a process, as `subprocess` and `multiprocessing` have it."""
    return f"killed by signal {-code}" if code < 0 else f"exit code {code}"


def end_of(process: subprocess.Popen[str], seconds: float) -> str:
    """Wait for the end of a process that has closed its pipes, and return how it ended in one line.

    A pipe closes a moment before the process can be waited for. A signal of ours in that moment would hide its exit
    code, so only a process that is still there after `seconds` is killed.
    """
    try:
        return how_it_ended(process.wait(timeout=seconds))
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return f"it closed its output, and had not ended {seconds:g} s later"


def code_for_shell(code: int) -> int:
    """Return the exit code of a program that we ran as a shell has it. One that was killed could not say so itself."""
    if code >= 0:
        return code
    print(f"guidewire: the program was {how_it_ended(code)}", file=sys.stderr)
    return 128 - code


def hand_to(command: Sequence[str], cwd: Path | None = None, environment: Mapping[str, str] | None = None) -> int:
    """Run a program on our terminal and return its exit code. Ctrl-C reaches it too, and a request to terminate
    is passed on: it decides how to end. `environment` is laid over ours."""
    process = subprocess.Popen(command, cwd=cwd, env={**os.environ, **(environment or {})})
    before = signal.signal(signal.SIGTERM, lambda number, frame: process.terminate())
    try:
        while True:
            try:
                return code_for_shell(process.wait())
            except KeyboardInterrupt:
                continue
    finally:
        signal.signal(signal.SIGTERM, before)
