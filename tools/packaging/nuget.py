"""The NuGet packages: Core and Io, each for netstandard2.1 and net10.0."""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

from guidewire.installed import version
from guidewire.prepare import PreparationError
from guidewire.runs.building import HEADLESS, dotnet

PROJECTS = ("Guidewire.Core", "Guidewire.Io")


def build(out: Path, tell: Callable[[str], None]) -> list[Path]:
    """Pack both into a folder; returns the files.

    Raises
    ------
    PreparationError : one line, where one cannot be packed.
    """
    with tempfile.TemporaryDirectory(prefix="guidewire-package-") as folder:  # what the repository has built stays
        return [_pack(project, out, folder, tell) for project in PROJECTS]


def _pack(project: str, out: Path, folder: str, tell: Callable[[str], None]) -> Path:
    tell(f"packing {project}")
    command = [dotnet()[0], "pack", "-c", "Release", "--nologo", "-v", "q", str(HEADLESS / project), "-o",
               str(out.absolute()), "--artifacts-path", folder]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    file = out / f"{project}.{version()}.nupkg"
    if done.returncode != 0 or not file.is_file():
        lines = [line.strip() for line in done.stdout.splitlines() if "error" in line]
        raise PreparationError(f"{project} cannot be packed: {(lines or ['no message'])[0]}")
    return file
