"""A problem of the chart, its settings, and the result of each: error, cost, outcome."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from analysis.validation.scenes import Asking
from guidewire.logs.runs import Run, busiest, read_repeats
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check

METHODS = ("pbd", "xpbd", "explicit", "direct")
LOST = ("passed a wall", "diverged", "failed")
FRAME = 1.0 / 90.0  # s, of a display with 90 Hz
TICK = 1e-3  # s, of a haptic loop with 1 kHz
FLOOR = 1e-6  # an error below is rounding: as good as this one
_REPEATS = {"pbd": 3, "direct": 5}  # the other methods take long enough to be timed once
_LEVELS = (0.1, 0.01, 0.001)


@dataclass(frozen=True)
class Setting:
    """One way to solve a problem.

    Attributes
    ----------
    method : one of METHODS.
    words : what it is set to, as tables say it.
    label : the same in a few characters, as pictures say it.
    case : the run, with its timed repeats.
    """

    method: str
    words: str
    label: str
    case: Case


@dataclass(frozen=True)
class Point:
    """What came of a setting.

    Attributes
    ----------
    setting : Setting
    outcome : "finished" or "converged", or one of LOST.
    reason : as the run says it.
    error : as the problem measures it; not a number where the run was lost.
    cost, least, most : wall time in s per simulated second: median, smallest and largest of the timed repeats.
    step : wall time of a time step, s, of the median.
    others_busy : processors that other programs kept busy beside the repeat that they disturbed most; None where nobody
        looked.
    """

    setting: Setting
    outcome: str
    reason: str
    error: float
    cost: float
    least: float
    most: float
    step: float
    others_busy: float | None

    @property
    def drawn(self) -> float:
        """Its error, or FLOOR where that is larger."""
        return max(self.error, FLOOR)

    @property
    def held(self) -> bool:
        """Whether it has an error."""
        return self.outcome not in LOST and math.isfinite(self.error)


def seconds(point: Point) -> float:
    """Cost as the chart has it, s per simulated second."""
    return point.cost


def milliseconds(point: Point) -> float:
    """Wall time of a time step, ms."""
    return 1e3 * point.step


Cost = Callable[[Point], float]
Measure = Callable[[Run], float]


@dataclass(frozen=True)
class Asked:
    """What a problem asks for.

    Attributes
    ----------
    settings : sequence of Setting
    measure : from the runs of `references` to the error of a run, and a sentence on what the reference is worth.
    references : finer runs that are the reference, or show that it has converged.
    gain : of pbd's bend-twist constraint, where it was tuned.
    """

    settings: Sequence[Setting]
    measure: Callable[[Mapping[str, Run]], tuple[Measure, str]]
    references: Sequence[Case] = ()
    gain: float | None = None


@dataclass(frozen=True)
class Problem:
    """One panel of the chart.

    Attributes
    ----------
    name : folder of its runs.
    title : a few words.
    error : what its error is, and of what it is a part.
    ask : makes the generator that finds what it needs to know and returns what it asks for.
    absent : methods that cannot solve it, and why.
    """

    name: str
    title: str
    error: str
    ask: Callable[[], Asking[Asked]] = field(repr=False)
    absent: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Charted:
    """A problem with all its points, and none of the lines with gates that a finding has."""

    problem: Problem
    points: Sequence[Point]
    reference: str
    gain: float | None
    results: tuple[()] = ()

    def front(self, cost: Cost = seconds, method: str | None = None) -> list[Point]:
        """Points, of all methods or of one, that no other one beats in both error and cost, from the cheapest on."""
        return pareto([p for p in self.points if p.held and method in (None, p.setting.method)], cost)

    def cheapest(self, error: float) -> Point | None:
        """Return the cheapest point with at most this error."""
        good = [point for point in self.points if point.held and point.error <= error]
        return min(good, key=lambda point: point.cost, default=None)


def pareto(points: Sequence[Point], cost: Cost = seconds) -> list[Point]:
    """Return points that no other one beats in both error and cost, from the cheapest on."""
    front: list[Point] = []
    for point in sorted(points, key=lambda point: (cost(point), point.drawn)):
        if not front or point.drawn < front[-1].drawn:
            front.append(point)
    return front


def case(key: str, method: str, overrides: Mapping[str, object], start: Mapping[str, object] | None = None) -> Case:
    """Return a run of a method with as many timed repeats as the method is worth."""
    return Case(key, {"solver": method, **overrides}, _REPEATS.get(method, 1), start)


def in_short(problem: Problem) -> Problem:
    """Return the problem with the first two settings of the methods that are timed often, and one of the others;
    once."""
    def ask() -> Asking[Asked]:
        asked = yield from problem.ask()
        own = [[setting for setting in asked.settings if setting.method == method] for method in METHODS]
        kept = [setting for mine in own for setting in mine[:2 if mine and mine[0].method in _REPEATS else 1]]
        once = [replace(setting, case=replace(setting.case, repeats=1)) for setting in kept]
        return replace(asked, settings=once)

    return replace(problem, ask=ask)


def check_of(problem: Problem) -> Check[Charted]:
    """Return what makes the runs of a problem and reads its points."""
    return Check(problem.name, "Chart", problem.title, partial(_plan, problem))


def _plan(problem: Problem) -> Generator[Sequence[Case], Mapping[str, Run], Charted]:
    asked = yield from problem.ask()
    runs = yield [*asked.references, *(setting.case for setting in asked.settings)]
    measure, reference = asked.measure(runs)
    points = [_point(setting, runs[setting.case.key], measure) for setting in asked.settings]
    return Charted(problem, points, reference, asked.gain)


def _point(setting: Setting, run: Run, measure: Measure) -> Point:
    outcome, error = run.outcome, math.nan
    if outcome not in LOST:
        error = measure(run)
        if run.summary.get("passages", 0) > 0:
            outcome = "passed a wall"
    repeats = read_repeats(run, setting.case.repeats)
    costs = sorted(_cost(repeat) for repeat in repeats)
    cost = float(np.median(costs))
    return Point(setting, outcome, str(run.measured("reason")), error, cost, costs[0], costs[-1],
                 cost * run.number("timeStep"), busiest(repeats))


def _cost(run: Run) -> float:
    """Wall time of the steps over the simulated time; without steps that of the search for the rest shape over the
    time step, which then stands for the motion that is not made."""
    steps = run.measured("steps")
    if not steps:
        return run.measured("setUpTime") / run.number("timeStep")
    return run.measured("computationTime") / run.measured("inGameTime")


def repeats_in_words() -> str:
    """Return how often the methods are timed."""
    others = " and ".join(method for method in METHODS if method not in _REPEATS)
    return "; ".join(f"{method}: {count}" for method, count in _REPEATS.items()) + f"; {others}: 1"


def best_by_error(charted: Charted) -> list[tuple[float, Point | None]]:
    """Return the cheapest setting for errors of 10, 1 and 0.1 %."""
    return [(level, charted.cheapest(level)) for level in _LEVELS]
