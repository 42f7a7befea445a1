"""The frontier between runs that hold and runs that fail: for every point of a grid, by bisection of one parameter.

First both ends of the parameter's range are run. Where one holds and the other does not, the middle is run, and again
the middle of the half that has a change in it, until that is narrow enough: the frontier lies within.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from guidewire.studies.keys import told_values, value_text
from guidewire.studies.sampling import Range
from guidewire.studies.table import Case, Findings, Grid, Rounds

FRONTIER = "frontier.csv"


@dataclass(frozen=True)
class Holds:
    """What a run has to come to if it is to hold.

    Attributes
    ----------
    outcomes : of the run, one of these.
    at_most : numbers of its summary to the largest value that still holds.
    """

    outcomes: tuple[str, ...] = ("converged", "finished")
    at_most: Mapping[str, float] = field(default_factory=dict)

    def why_not(self, summary: Mapping[str, Any]) -> str:
        """Return what is wrong with a run, in a word or the name of a number; empty where it holds."""
        if summary["outcome"] not in self.outcomes:
            return str(summary["outcome"])
        return next((name for name, most in self.at_most.items()
                     if summary.get(name) is None or not summary[name] <= most), "")


@dataclass(frozen=True)
class Bisection:
    """Runs that close in on a frontier.

    Attributes
    ----------
    grid : for each of its points the frontier is sought.
    range : of the parameter that is bisected.
    width : at which the search ends: a difference, with a logarithmic range a part of the value.
    holds : what a run that holds comes to.
    """

    grid: Grid
    range: Range
    width: float
    holds: Holds = Holds()

    def __post_init__(self) -> None:
        if not self.width > 0.0:
            raise ValueError(f"a width of {self.width:g} is never reached: it has to be above 0")
        for axis in self.grid.axes:
            if self.range.key in axis.keys:
                raise ValueError(f"{self.range.key} is an axis, and bisected too")

    @property
    def count(self) -> int:
        """How many runs it is at most."""
        low, high = self.range.low, self.range.high
        parts = math.log(high / low) / math.log1p(self.width) if self.range.logarithmic else (high - low) / self.width
        return self.grid.count * (2 + max(0, math.ceil(math.log2(parts))))

    def rounds(self) -> Rounds:
        """Both ends, then middle after middle. Returns one row for each point: the `low` and `high` value between which
        the frontier lies, what is wrong beyond, or in `note` why there is none."""
        points = [_Search(self, case) for case in self.grid.cases()]
        wanted = [(point, value) for point in points for value in (self.range.at(0.0), self.range.at(1.0))]
        while wanted:
            cases = {point.case_at(value).key: (point, value) for point, value in wanted}
            ended = yield [point.case_at(value) for point, value in wanted]
            for key, (point, value) in cases.items():
                point.note(value, self.holds.why_not(ended[key]))
            wanted = [(point, middle) for point in points for middle in [point.middle()] if middle is not None]
        return Findings(FRONTIER, [point.found() for point in points])


class _Search:
    """The search at one point of the grid."""

    def __init__(self, asked: Bisection, case: Case) -> None:
        self._asked = asked
        self._case = case
        self._seen: dict[float, str] = {}  # value to what is wrong there

    def case_at(self, value: float) -> Case:
        """Return the run with this value of the parameter."""
        values = {**self._case.values, self._asked.range.key: value}
        name = f"{self._asked.range.key}={value_text(value)}"
        key = name if self._case.key == "default" else f"{self._case.key},{name}"
        changed = self._asked.grid.variants.get(self._case.variant, {})
        return Case(key, self._asked.grid.overrides(changed, values), self._case.repeats, variant=self._case.variant,
                    values=values)

    def note(self, value: float, why_not: str) -> None:
        """What the run with this value came to."""
        self._seen[value] = why_not

    def middle(self) -> float | None:
        """Return what to run next; None where the search has ended."""
        between = self._between()
        if between is None:
            return None
        low, high = between
        if self._asked.range.whole:
            return None if high - low <= max(1.0, self._asked.width) else (low + high) // 2
        if self._asked.range.logarithmic:
            return None if high / low - 1.0 <= self._asked.width else math.sqrt(low * high)
        return None if high - low <= self._asked.width else 0.5 * (low + high)

    def found(self) -> dict[str, Any]:
        """Return the row of this point."""
        row = {"variant": self._case.variant, **told_values(self._case.values), "key": self._asked.range.key}
        between = self._between()
        if between is None:
            word = "fails" if any(self._seen.values()) else "holds"
            return {**row, "low": None, "high": None, "fails": "", "note": f"{word} at both ends"}
        low, high = between
        return {**row, "low": low, "high": high, "fails": self._seen[low] or self._seen[high],
                "note": "holds below" if not self._seen[low] else "holds above"}

    def _between(self) -> tuple[float, float] | None:
        """Neighbouring values, one of which holds and one does not; None where both ends are alike."""
        values: Sequence[float] = sorted(self._seen)
        return next(((low, high) for low, high in zip(values, values[1:])
                     if bool(self._seen[low]) != bool(self._seen[high])), None)
