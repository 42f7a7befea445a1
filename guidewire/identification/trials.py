"""Runs of a scene with trial values, side by side, by runners that stay up."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from guidewire.logs.logs import LogError
from guidewire.runs.runner import BAD_INPUT, Request, Runner

SECONDS = 600.0    # that a run may take
_AS_RUN = {"logSpheres": "all", "logFormat": "json"}


class Trials:
    """Makes runs; a context that ends its runners.

    Parameters
    ----------
    command : what starts a runner.
    scene : parameter file; None: the defaults.
    fixed : parameters that override the file's in every run.
    jobs : runs at once.

    Attributes
    ----------
    made : how many runs were made.
    """

    def __init__(self, command: Sequence[str], scene: Path | None, fixed: Mapping[str, Any],
                 jobs: int | None = None) -> None:
        self.made = 0
        self._scene, self._fixed = scene and scene.resolve(), {**fixed, **_AS_RUN}
        count = jobs or os.cpu_count() or 1
        self._free = [Runner(command) for _ in range(count)]
        self._all = tuple(self._free)
        self._pool = ThreadPoolExecutor(count)
        self._folder = Path(tempfile.mkdtemp(prefix="guidewire-identify-"))

    def __enter__(self) -> Trials:
        return self

    def __exit__(self, *error: object) -> None:
        for runner in self._all:
            runner.interrupt()
            runner.close()
        self._pool.shutdown(cancel_futures=True)
        shutil.rmtree(self._folder, ignore_errors=True)

    def run(self, many: Sequence[Mapping[str, Any]]) -> list[Path | str]:
        """Return the folder of each run, by its overrides, or one line that says why it has no result."""
        first = self.made
        self.made += len(many)
        return list(self._pool.map(self._one, range(first, first + len(many)), many))

    def forget(self, folder: Path | str) -> None:
        """Remove what a run has left."""
        if isinstance(folder, Path):
            shutil.rmtree(folder, ignore_errors=True)

    def _one(self, number: int, overrides: Mapping[str, Any]) -> Path | str:
        out = self._folder / str(number)
        runner = self._free.pop()
        try:
            answer = runner.run(Request(f"run {number + 1}", self._scene, out, {**self._fixed, **overrides}), SECONDS)
        finally:
            self._free.append(runner)
        if answer.outcome in ("converged", "finished"):
            return out
        return answer.message if answer.exit_code == BAD_INPUT or answer.outcome is None else \
            f"{answer.outcome}: {answer.message}"


def effective(folder: Path) -> dict[str, Any]:
    """Return every value that a run took.

    Raises
    ------
    LogError : it has left none.
    """
    try:
        return json.loads((folder / "parameters.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise LogError(f"{folder / 'parameters.json'}: {error}") from error
