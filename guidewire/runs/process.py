"""A program that takes our place on the terminal."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path


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
