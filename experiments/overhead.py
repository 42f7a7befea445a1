"""Overhead of short runs: parameters, files, tables, and scheduling."""

from __future__ import annotations

import argparse
import csv
import os
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from guidewire.commands.making import build_benchmarks, build_runner
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs.process import hand_to
from guidewire.studies.keys import RESULTS
from guidewire.studies.table import Axis, Grid, Study
from guidewire.sweeps.sweep import Means, sweep

_STEPS = 100
_ITERATIONS = 50


def bench(arguments: argparse.Namespace) -> int:
    """`bench`: the cost of a step part by part, or the overhead of short runs."""
    if arguments.runs is None:
        return hand_to([*build_benchmarks(), str(ROOT / "params" / "sheath.json")])
    print(measure(build_runner(), arguments.runs, arguments.jobs))
    return 0


@dataclass(frozen=True)
class Overhead:
    """What runs cost; start of the cluster and of its runners apart.

    Attributes
    ----------
    runs : their number.
    jobs : runs at once.
    wall : time from the first check to the last table, s.
    steps : sum of the runs' own step times, s.
    processor : time that this process and its runners spent on a processor, their start included, s.
    """

    runs: int
    jobs: int
    wall: float
    steps: float
    processor: float

    @property
    def beside_steps(self) -> float:
        """What the places of the runs did other than steps, ms a run; of a machine that does nothing else."""
        return 1e3 * (self.jobs * self.wall - self.steps) / self.runs

    @property
    def beside_steps_on_processors(self) -> float:
        """The same by time on processors, which other programs lengthen less, ms a run."""
        return 1e3 * (self.processor - self.steps) / self.runs

    def __str__(self) -> str:
        return (f"{self.runs} runs of {_STEPS} steps, m = {_ITERATIONS}, {self.jobs} at once: "
                f"{1e3 * self.steps / self.runs:.2f} ms a run in steps, {self.beside_steps:.2f} ms beside them "
                f"({self.beside_steps_on_processors:.2f} ms on processors)")


def measure(command: Sequence[str], runs: int, jobs: int) -> Overhead:
    """Make so many short runs of the default scene, each with a displacement of its own, and take the time.

    Raises
    ------
    PreparationError : a run has no result.
    """
    study = Study(
        "short-runs", "what short runs cost", "params/default.json",
        Grid((Axis("displacement", tuple(5.0 + 5.0 * k / runs for k in range(runs))),),
             {"maxSimulationSteps": _STEPS, "constraintSolverSteps": _ITERATIONS}), logs=False,
    )
    with tempfile.TemporaryDirectory(prefix="guidewire-short-runs-") as folder:
        before, started = _processor(), time.monotonic()
        result = sweep([(study, Path(folder))], Path(folder) / "runs", Means(command, jobs))
        wall, processor = time.monotonic() - started - result.cluster_seconds, _processor() - before
        if result.failures:
            raise PreparationError(f"{result.failures[0].name}: {result.failures[0].message}")
        with open(Path(folder) / study.name / RESULTS, encoding="utf-8", newline="") as file:
            steps = sum(float(row["computationTime"]) for row in csv.DictReader(file))
    return Overhead(runs, jobs, wall, steps, processor)


def _processor() -> float:
    """Time on processors of this process and of those that it has waited for, s."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system
