"""One run, and a table of runs: the one description from which studies, checks and figures take theirs.

A `Grid` is a table of parameters over any number of axes, a `Case` one line of it. Whoever wants runs is a `Source`: it
yields cases, and when they are made it may ask for more. A `Study` asks once, for its grid; a check (see
analysis/validation/check.py) may ask again when it has seen the results.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Protocol

from studies.keys import Value, checked_key, repeat_folder, run_key, value_text

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
        texts = [value_text(value) for value in self.values]
        twice = next((text for text in texts if texts.count(text) > 1), None)
        if twice is not None:
            raise ValueError(f"{self.key} takes {twice} twice")
        if not texts:
            raise ValueError(f"{self.key} takes no value")


@dataclass(frozen=True)
class Case:
    """One run, with the repeats of it that are timed.

    Attributes
    ----------
    key : its name among the runs of whoever asks for it, and its folder.
    overrides : parameter key to value, laid over the scene.
    repeats : timed repeats, made with no other run beside them.
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

    def folder(self, repeat: int | None = None) -> str:
        """Folder of the run, or of one of its repeats, below that of whoever asked for it."""
        return self.key if repeat is None else f"{self.key}/{repeat_folder(repeat)}"


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

    axes: tuple[Axis, ...] = ()
    common: Mapping[str, Any] = field(default_factory=dict)
    variants: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    repeats: int = 0
    duration: float | None = None
    least_steps: int = 0

    def __post_init__(self) -> None:
        keys = [axis.key for axis in self.axes]
        for key in keys:
            if keys.count(key) > 1:
                raise ValueError(f"{key} is an axis twice")
            for name, variant in self.variants.items():
                if key in variant:
                    raise ValueError(f"{key} is an axis, and variant {name} sets it too")

    def cases(self) -> list[Case]:
        """Every run, the last axis first."""
        return [
            Case(run_key(name, values), self._overrides(variant, values), self.repeats, variant=name, values=values)
            for name, variant in (self.variants or {"": {}}).items()
            for values in (
                dict(zip((axis.key for axis in self.axes), point))
                for point in itertools.product(*(axis.values for axis in self.axes))
            )
        ]

    def _overrides(self, variant: Mapping[str, Any], values: Mapping[str, Value]) -> dict[str, Any]:
        overrides = {**self.common, **variant, **values}
        if self.duration is not None:
            steps = max(math.ceil(self.duration / overrides["timeStep"] - _ROUNDING), self.least_steps)
            overrides["maxSimulationSteps"] = steps
        return overrides


Rounds = Generator[Sequence[Case], None, Any]


class Source(Protocol):
    """Who asks for runs.

    Attributes
    ----------
    name : folder of its runs.
    title : what its runs are for, for people.
    scene : parameter file, relative to the repository.
    results : outcomes that count as a result.
    """

    name: str
    title: str
    scene: str
    results: tuple[str, ...]

    def rounds(self, folder: Path) -> Rounds:
        """Yields the cases that it needs, goes on when they stand in `folder`, and may then yield more."""
        ...


@dataclass(frozen=True)
class Study:
    """A scene and the table of its runs.

    Attributes
    ----------
    name : folder of the study in the results, and its name on the command line.
    title : what is varied, for people.
    scene : parameter file, relative to the repository.
    grid : its runs.
    results : outcomes that count as a result: a diverged run has one.
    """

    name: str
    title: str
    scene: str
    grid: Grid = Grid()
    results: tuple[str, ...] = ("converged", "finished", "diverged")

    def rounds(self, folder: Path) -> Rounds:
        """One round: what a study asks for does not depend on what its runs show."""
        yield self.grid.cases()
