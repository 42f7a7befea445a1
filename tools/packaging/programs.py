"""The programs of the wheel: the native library for processors of x86-64-v3 and for older ones, and the runner."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path

from guidewire.installed import LIBRARY, RUNNER
from guidewire.prepare import PreparationError
from guidewire.runs import building

FOLDER = "native"  # place in the package, by which `guidewire.prepare` knows that it is installed


def build(folder: Path, tell: Callable[[str], None]) -> dict[str, Path]:
    """Build all of them; returns each file by its place in the package.

    Parameters
    ----------
    folder : takes what is built.
    tell : called with a line before each.

    Raises
    ------
    PreparationError : one line, where something does not build.
    """
    newer = building.build_native(tell)
    compiler = shutil.which("gcc") or shutil.which("clang")
    source = building.HEADLESS / building.NATIVE
    tell("building the native library for older processors")
    _run([building.dotnet()[0], "publish", "-c", "Release", "--nologo", "-v", "q", str(source), "-p:Baseline=true",
          f"-p:PublishDir={folder}{os.sep}"], folder)
    _run([compiler, "-O2", "-Wall", "-Wextra", "-Werror", "-s", "-o", str(folder / RUNNER), str(source / "runner.c"),
          "-ldl"], folder)
    return {f"{FOLDER}/{LIBRARY[True]}": newer, f"{FOLDER}/{LIBRARY[False]}": folder / f"{building.NATIVE}.so",
            f"{FOLDER}/{RUNNER}": folder / RUNNER}


def _run(command: Sequence[str], folder: Path) -> None:
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        log = folder / "error.txt"
        log.write_text(done.stdout + done.stderr, encoding="utf-8")
        lines = [line.strip() for line in (done.stdout + done.stderr).splitlines() if "error" in line]
        raise PreparationError(f"{Path(command[0]).name} failed: {(lines or ['no message'])[0]} (log: {log})")
