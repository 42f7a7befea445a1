"""What commands that make runs share: the runner, what makes the runs, and lines for those that failed."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from guidewire import installed
from guidewire.commands.progress import bar_of, seconds_counted
from guidewire.runs import building

if TYPE_CHECKING:
    from guidewire.studies.table import Source
    from guidewire.sweeps.sweep import Means, SweepResult


def runner_of(arguments: argparse.Namespace) -> list[str]:
    """Return the command that makes runs, as `--runner` says."""
    if arguments.runner == "headless":
        return build_runner()
    installed.refuse("--runner unity")
    from guidewire.runs import unity_runner

    unity = unity_runner.find(arguments.unity)
    if unity.is_editor:
        arguments.jobs = 1    # one editor a project folder: it locks it
    return unity_runner.adapter(unity)


def build_benchmarks() -> list[str]:
    """Return the command of the benchmarks, built if need be."""
    with seconds_counted() as tell:
        return building.build(building.BENCHMARKS, tell)


def build_runner() -> list[str]:
    """Return the runner's command, built if need be."""
    with seconds_counted() as tell:
        return building.build(building.RUNNER, tell)


def means_of(arguments: argparse.Namespace, command: list[str], name: str, folder: Path | None = None) -> Means:
    """Return what makes runs, as the command line says."""
    from guidewire.sweeps.sweep import Means

    return Means(command, arguments.jobs, arguments.cluster, folder, build_benchmarks, bar_of(name))


def make(asked: Sequence[tuple[Source, Path]], out: Path, means: Means) -> SweepResult:
    """Make the runs that studies or checks ask for and say what failed."""
    from guidewire import library

    result = library.make(asked, out, means)
    tell_failures(result)
    return result


def tell_failures(result: SweepResult) -> None:
    """A line for each run without a result."""
    for answer in result.failures:
        print(f"guidewire: {answer.name}: {answer.message}", file=sys.stderr)
