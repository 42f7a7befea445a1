"""Searches for the load at which a rod leaves its shape.

Of rest shapes the load at which the first one stops being one that a rod stays in is found by dividing an interval. In
a motion the rod is pushed a little off its shape and let go, damped; below the limit the push dies out, above it grows.
Near the limit either takes long, so what is found there is an interval.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from analysis.validation import pictures, scenes
from analysis.validation.states import wall_time
from guidewire.figures.wording import number
from guidewire.logs.runs import Run
from guidewire.studies.keys import value_text
from guidewire.studies.table import Case
from guidewire.sweeps.check import Result

SECTION = "Stability limits"
LEFT = 1e-3  # of L: a rest shape farther off the first one is another shape
_WIDE = (0.7, 1.4)  # of the expected load: where the search begins
_PARTS = 6  # into which a round divides the interval
_ROUNDS = 5

@dataclass(frozen=True)
class Limit:
    """What a search found.

    Attributes
    ----------
    load : where the first shape is left; not a number where no such load was seen, or only the interval about it.
    seen : from each load to the distance, over L, from the first shape.
    cost : wall time of all runs, s.
    low, high : ends of the interval in which the load lies, fractions of the expected one.
    """

    load: float
    seen: Mapping[float, float]
    cost: float
    low: float = math.nan
    high: float = math.nan


Search = scenes.Asking[Limit]


def limit(
    name: str,
    expected: float,
    case: Callable[[float], Mapping[str, Any]],
    left: Callable[[Run], float],
    start: Mapping[str, Any] | None = None,
) -> Search:
    """Find where a rest shape loses its stability, by dividing an interval of loads again and again.

    Parameters
    ----------
    name : prefix of the cases.
    expected : the load about which the search begins; the result does not depend on it as long as it lies in `_WIDE`.
    case : from a load to a run's parameters.
    left : from a run to the distance, over L, that the rod is away from its first shape; not a number where the run
        says nothing, such as one that found no rest shape.
    start : of every run.

    Returns
    -------
    Limit : its load is the middle of the last interval.
    """
    low, high = _WIDE[0] * expected, _WIDE[1] * expected
    seen: dict[float, float] = {}
    cost = 0.0
    for _ in range(_ROUNDS):
        loads = [float(load) for load in np.linspace(low, high, _PARTS + 1)]
        cases = {load: Case(f"{name}{value_text(load)}", case(load), start=start) for load in loads if load not in seen}
        runs = yield list(cases.values())
        seen |= {load: left(runs[one.key]) for load, one in cases.items()}
        cost += sum(wall_time(runs[one.key]) for one in cases.values())
        stable = [load for load in loads if seen[load] < LEFT]
        unstable = [load for load in loads if seen[load] >= LEFT]
        if not stable or not unstable or max(stable) > min(unstable):
            return Limit(math.nan, seen, cost)
        low, high = max(stable), min(unstable)
    return Limit(0.5 * (low + high), seen, cost)


PUSH = 1e-4  # of L, off the first shape at the start of a motion
_FRACTIONS = (0.90, 0.94, 0.98, 1.02, 1.06, 1.10)  # of the expected limit


def pushed(
    name: str,
    expected: float,
    case: Callable[[str, float], Case],
    left: Callable[[Run], float],
    push: float = PUSH,
    fractions: Sequence[float] = _FRACTIONS,
) -> Search:
    """Find where a push dies out and where it grows, at fractions of the expected limit, those next to 1 first and the
    rest only where those do not show both.

    Parameters
    ----------
    name : prefix of the cases.
    case : from a name and a load to a run.
    left : from a run to the distance, over L, that the rod is away from its first shape.
    push : that distance at the start.
    fractions : ascending, half of them below 1.

    Returns
    -------
    Limit : with its interval; that is not a number where every push does the same.
    """
    inner = len(fractions) // 2
    cost, seen = 0.0, {}
    for asked in ((fractions[inner - 1], fractions[inner]), (*fractions[:inner - 1], *fractions[inner + 1:])):
        cases = {fraction: case(f"{name}{value_text(fraction)}", fraction * expected) for fraction in asked}
        runs = yield list(cases.values())
        seen |= {fraction: left(runs[one.key]) for fraction, one in cases.items()}
        cost += sum(wall_time(runs[one.key]) for one in cases.values())
        if seen[fractions[inner - 1]] < push <= seen[fractions[inner]]:
            break
    below = [fraction for fraction in seen if seen[fraction] < push]
    above = [fraction for fraction in seen if not seen[fraction] < push]
    low, high = max(below, default=math.nan), min(above, default=math.nan)
    loads = {fraction * expected: distance for fraction, distance in seen.items()}
    return Limit(math.nan, loads, cost, low, high) if low < high else Limit(math.nan, loads, cost)


def limit_line(what: str, expected: float, found: Limit, gate: float, unit: str) -> Result:
    """Return the direct solver's line of `limit`; it says how many searches for a rest shape gave up."""
    silent = sum(math.isnan(distance) for distance in found.seen.values())
    if silent:
        what += f" ({silent} of {len(found.seen)} searches found no rest shape)"
    return Result(what, "direct", found.load, expected, abs(found.load / expected - 1.0), gate, unit, found.cost)


def pushed_line(what: str, solver: str, expected: float, found: Limit, gate: float, unit: str) -> Result:
    """Return the line of `pushed`: value in the middle of the interval, error to its farther end."""
    if found.low < found.high:
        ends = f"between {found.low:g} and {found.high:g} of the reference"
    else:
        fractions = [load / expected for load in found.seen]
        ends = f"none found from {number(min(fractions), 2)} to {number(max(fractions), 2)} of the reference"
    return Result(f"{what}, {ends}", solver, 0.5 * (found.low + found.high) * expected, expected,
                  max(abs(found.low - 1.0), abs(found.high - 1.0)), gate, unit, found.cost,
                  "farther end of the interval")


def branches(
    x_label: str, y_label: str, found: Mapping[tuple[str, str], Limit], least: float = 1e-12
) -> Callable[[Figure], None]:
    """Distance from the first shape over the load, a line at each limit that is one.

    Parameters
    ----------
    found : (solver, what else) to what was seen; each solver has its marker, each other word its colour.
    least : the smallest distance drawn; what is less lies at it.
    """

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        words = list(dict.fromkeys(word for _, word in found))
        for (solver, word), one in found.items():
            color = f"C{words.index(word)}"
            loads = sorted(load for load, distance in one.seen.items() if math.isfinite(distance))
            axes.plot(loads, [max(one.seen[load], least) for load in loads], pictures.SOLVER_MARKERS[solver],
                      fillstyle="none", color=color, label=f"{solver}, {word}")
            if math.isfinite(one.load):
                axes.axvline(one.load, color=color, linewidth=0.9, linestyle="--")
        axes.set_yscale("log")
        pictures.label(axes, x_label, y_label)

    return draw
