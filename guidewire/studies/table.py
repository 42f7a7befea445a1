"""One run, and a table of runs: the one description from which studies, checks and figures take theirs.

A `Grid` is a table of parameters over any number of axes, a `Case` one line of it. An axis may be of one parameter, or
of several that change together: that is how lists and samples stand in a table. Whoever wants runs is a `Source`: it
yields cases, and when they are made it may ask for more. A `Study` of a grid asks once; one of a bisection
(guidewire/studies/bisection.py) and a check (guidewire/sweeps/check.py) ask again when they have seen the results.
"""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Optional, Protocol

from guidewire.studies.keys import Value, checked_key, plain_values, run_key, value_text

_ROUNDING = 1e-6  # of a step: 0.3/0.1 is three steps


@dataclass(frozen=True)
class Axis:
    """A parameter that takes several values.

    Attributes
    ----------
    key : of the parameter.
    values : in the unit of the key, no value twice.
    """

    key: str
    values: tuple[Value, ...]

    def __post_init__(self) -> None:
        texts = Counter(value_text(value) for value in self.values)
        twice = next((text for text, count in texts.items() if count > 1), None)
        if twice is not None:
            raise ValueError(f"{self.key} takes {twice} twice")
        if not texts:
            raise ValueError(f"{self.key} takes no value")

    @property
    def keys(self) -> tuple[str, ...]:
        """Return what is varied."""
        return (self.key,)

    def points(self) -> list[tuple[str, dict[str, Value]]]:
        """Return each value with its name."""
        return [(run_key("", {self.key: value}), {self.key: value}) for value in self.values]


@dataclass(frozen=True)
class Rows:
    """Parameters that change together: each row gives all of them.

    Attributes
    ----------
    name : what a row is called, with its number: "sample" makes sample-1, sample-2, ...
    keys : of the parameters.
    rows : their values, in the order of the keys.
    """

    name: str
    keys: tuple[str, ...]
    rows: tuple[tuple[Value, ...], ...]

    def __post_init__(self) -> None:
        if not self.rows:
            raise ValueError(f"{self.name} has no row")
        for number, row in enumerate(self.rows, 1):
            if len(row) != len(self.keys):
                raise ValueError(f"{self.name} {number} has {len(row)} values for {len(self.keys)} parameters")
            for value in row:
                value_text(value)

    @property
    def values(self) -> tuple[tuple[Value, ...], ...]:
        """Return the rows."""
        return self.rows

    def points(self) -> list[tuple[str, dict[str, Value]]]:
        """Return each row with its name."""
        digits = len(str(len(self.rows)))
        return [(f"{self.name}-{number:0{digits}}", dict(zip(self.keys, row)))
                for number, row in enumerate(self.rows, 1)]


@dataclass(frozen=True)
class Case:
    """One run, with the repeats of it that are timed.

    Attributes
    ----------
    key : its name among the runs of whoever asks for it, and its folder.
    overrides : parameter key to value, which override the scene.
    repeats : timed repeats, made with no other run of ours beside them.
    start : positions, orientations and so on to start from, as a start file holds them.
    in_turns : not run, but its cost measured: its motion and sweeps of the thesis's rod are timed in turns in one
        process, because that ratio holds on a busy machine, where wall times do not.
    variant : name of its variant; empty where there is none.
    values : the values of the axes, by key.
    """

    key: str
    overrides: Mapping[str, Any]
    repeats: int = 0
    start: Mapping[str, Any] | None = None
    in_turns: bool = False
    variant: str = ""
    values: Mapping[str, Value] = field(default_factory=dict)

    def __post_init__(self) -> None:
        checked_key(self.key)


@dataclass(frozen=True)
class Grid:
    """Runs at every combination of values.

    Attributes
    ----------
    axes : what is varied; none: one run for each variant.
    common : overrides of every run.
    variants : name to further overrides; every combination of values is run with each. Empty: once, with none.
    repeats : timed repeats of every run.
    duration : in-game time of every run in s; None: the scene's number of steps. The step size must then stand in
        `common`, a variant or the values.
    least_steps : steps that a run of `duration` makes at least, so that runs can be compared step by step too.
    """

    axes: tuple[Axis | Rows, ...] = ()
    common: Mapping[str, Any] = field(default_factory=dict)
    variants: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    repeats: int = 0
    duration: float | None = None
    least_steps: int = 0

    def __post_init__(self) -> None:
        keys = [key for axis in self.axes for key in axis.keys]
        for key in keys:
            if keys.count(key) > 1:
                raise ValueError(f"{key} is an axis twice")
            for name, variant in self.variants.items():
                if key in variant:
                    raise ValueError(f"{key} is an axis, and variant {name} sets it too")

    @property
    def count(self) -> int:
        """How many runs it is, timed repeats among them."""
        points = math.prod(len(axis.values) for axis in self.axes)
        return max(1, len(self.variants)) * points * (1 + self.repeats)

    def cases(self) -> list[Case]:
        """Return every run, the last axis first."""
        cases = []
        for variant, changed in (self.variants or {"": {}}).items():
            for point in itertools.product(*(axis.points() for axis in self.axes)):
                values = {key: value for _, own in point for key, value in own.items()}
                name = ",".join([*([variant] if variant else []), *(name for name, _ in point)])
                cases.append(Case(name or "default", self.overrides(changed, values), self.repeats, variant=variant,
                                  values=values))
        return cases

    def rounds(self) -> Rounds:
        """One round: what a grid asks for does not depend on what its runs show."""
        yield self.cases()

    def overrides(self, variant: Mapping[str, Any], values: Mapping[str, Value]) -> dict[str, Any]:
        """Return the overrides of the scene for one run."""
        overrides = {**self.common, **variant, **plain_values(values)}
        if self.duration is not None:
            steps = max(math.ceil(self.duration / overrides["timeStep"] - _ROUNDING), self.least_steps)
            overrides["maxSimulationSteps"] = steps
        return overrides


@dataclass(frozen=True)
class Findings:
    """What a source may end its rounds with: a table of its own, to be written beside that of its runs."""

    name: str
    rows: Sequence[Mapping[str, Any]]


# Yields cases, is sent the summaries of their untimed runs by key, None for a run that is not done; may return
# Findings.
Rounds = Generator[Sequence[Case], Mapping[str, Optional[Mapping[str, Any]]], Any]


class Source(Protocol):
    """Who asks for runs.

    Attributes
    ----------
    name : folder of its tables.
    title : what its runs are for, for people.
    scene : parameter file, relative to the repository.
    results : outcomes that count as a result.
    logs : whether its runs leave logs.
    seconds : how long a run may take.
    origin : what to name where one of its runs cannot be made.
    """

    name: str
    title: str
    scene: str
    results: tuple[str, ...]
    logs: bool
    seconds: float

    @property
    def origin(self) -> str:
        ...

    def rounds(self, folder: Path) -> Rounds:
        """Yields the cases that it needs, goes on when they are made, and may then yield more; `folder` is that of its
        tables."""
        ...


class Table(Protocol):
    """The runs of a study."""

    @property
    def count(self) -> int:
        """How many runs it is at most."""
        ...

    def rounds(self) -> Rounds:
        """Yields its cases."""
        ...


RUN_SECONDS = 3600.0  # that a run may take, where nothing else is said


@dataclass(frozen=True)
class Study:
    """A scene and the table of its runs.

    Attributes
    ----------
    name : folder of the study in the results, and its name on the command line.
    title : what is varied, or the question that is asked, for people.
    scene : parameter file, relative to the repository.
    grid : its runs.
    results : outcomes that count as a result: a diverged run has one.
    logs : whether its runs leave logs, which figures are drawn from.
    seconds : how long a run may take.
    file : where it was read from; None: it is one of ours.
    """

    name: str
    title: str
    scene: str
    grid: Table = Grid()
    results: tuple[str, ...] = ("converged", "finished", "diverged")
    logs: bool = True
    seconds: float = RUN_SECONDS
    file: Path | None = None

    @property
    def origin(self) -> str:
        """The study's file, or its name."""
        return str(self.file or self.name)

    def rounds(self, folder: Path) -> Rounds:
        """Return the rounds of its table."""
        return self.grid.rounds()
