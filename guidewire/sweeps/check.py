"""A check: which runs it needs, and what it finds in them.

A check is written as one generator. It yields the cases that it needs, gets their run folders, may ask for more where
what it needs depends on what it saw, and returns what it found:

    def plan():
        runs = yield [Case("n=30", {"numberRodElements": 30})]
        ...
        return Finding(...)

Whoever makes the runs drives it once (guidewire/sweeps/sweep.py), and whoever draws them drives it again over the
folders that are there (`replay`).
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Generic, TypeVar

from matplotlib.figure import Figure

from guidewire.logs.logs import LogError
from guidewire.logs.runs import Run, read_runs
from guidewire.studies.keys import TABLE
from guidewire.studies.table import RUN_SECONDS, Case, Rounds


@dataclass(frozen=True)
class Result:
    """One line of the table.

    Attributes
    ----------
    what : what was measured, with the scene's numbers.
    solver : which solver, with what distinguishes it.
    value, reference : in ``unit``; the reference is not a number where there is none.
    error : as the check defines it.
    gate : largest error allowed; None where the number is only shown.
    cost : wall time in s, or in s per simulated second where there is a motion.
    error_in : what the error is a part of, or its unit.
    """

    what: str
    solver: str
    value: float
    reference: float
    error: float
    gate: float | None
    unit: str = ""
    cost: float | None = None
    error_in: str = "relative"

    @property
    def passed(self) -> bool | None:
        """None where there is no gate. An error that is not a number does not pass."""
        return None if self.gate is None else bool(self.error <= self.gate)


@dataclass(frozen=True)
class Finding:
    """What a check found: lines of the table, and its picture with a caption; `width` in inches."""

    results: tuple[Result, ...]
    draw: Callable[[Figure], None]
    caption: str
    width: float = 8.0


Plan = Generator[Sequence[Case], Mapping[str, Run], Finding]
Found = TypeVar("Found")


@dataclass(frozen=True)
class Check(Generic[Found]):
    """One row of the validation, or of the chart: what it finds is a Finding, or has lines with gates as that has.

    Attributes
    ----------
    name : folder of its runs and name of its picture.
    section, title : for the report.
    plan : makes the generator described above.
    scene : parameter file whose values its cases override.
    results : outcomes that count as a result: a solver that gives up with a reason is one too.
    logs : whether its runs leave logs.
    seconds : how long a run may take.
    """

    name: str
    section: str
    title: str
    plan: Callable[[], Generator[Sequence[Case], Mapping[str, Run], Found]] = field(repr=False)
    scene: str = "params/cantilever.json"
    results: tuple[str, ...] = ("converged", "finished", "diverged", "failed")
    logs: bool = True
    seconds: float = RUN_SECONDS

    @property
    def origin(self) -> str:
        """Its name, where one of its runs cannot be made."""
        return self.name

    def rounds(self, folder: Path) -> Rounds:
        """Yields the cases that the plan asks for, gives it their runs in `folder`, and returns what it found."""
        plan = self.plan()
        try:
            cases = next(plan)
            while True:
                yield cases
                cases = plan.send(read_cases(cases, folder))
        except StopIteration as end:
            return end.value


def replay(check: Check[Found], folder: Path) -> Found:
    """Drive a check over runs that were made before.

    Parameters
    ----------
    check : the check.
    folder : folder of all checks; this one's cases stand below its name.

    Raises
    ------
    guidewire.logs.logs.LogError : a run is missing.
    """
    rounds = check.rounds(folder / check.name)
    try:
        while True:
            next(rounds)
    except StopIteration as end:
        return end.value


def read_cases(cases: Sequence[Case], folder: Path) -> dict[str, Run]:
    """Runs of these cases, by key."""
    made = read_runs(folder) if cases else {}
    missing = next((case.key for case in cases if case.key not in made), None)
    if missing is not None:
        raise LogError(f"{folder / TABLE}: has no run {missing}")
    return {case.key: made[case.key] for case in cases}
