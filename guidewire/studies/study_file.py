"""Reads a study that a user wrote: a JSON file with the keys in `KEYS`.

Whatever is wrong in it is one line that names the file, the key, the value and what is allowed.
"""

from __future__ import annotations

import difflib
import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from guidewire.json_text import problem_of, without_notes
from guidewire.studies.bisection import Bisection, Holds
from guidewire.studies.keys import Named, Value, checked_key, value_text
from guidewire.studies.sampling import METHODS, Range, sample
from guidewire.studies.table import RUN_SECONDS, Axis, Grid, Rows, Study

OUTCOMES = ("converged", "finished", "diverged", "failed")
LIMIT = 100_000  # runs, above which a study has to be asked for twice
KEYS = {
    "study": "its name, and that of its folder in the results",
    "question": "what it asks, for people",
    "scene": "parameter file, counted from this one's folder",
    "common": "parameters of every run, which override the scene's",
    "variants": "names, each with further parameters; every other combination is run with each",
    "axes": "parameters, each with a list of values or a range with a count; every combination is run",
    "list": "objects of parameters that change together, one for each run",
    "sample": "points within ranges, at random or as a Latin hypercube",
    "bisection": "a parameter and a range in which the frontier between runs that hold and runs that fail is sought",
    "repeats": "timed repeats of every run",
    "duration": "in-game time of every run in s, instead of a number of steps",
    "leastSteps": "steps that a run of a duration makes at least",
    "logs": "whether runs leave their logs",
    "timeLimit": "wall time that a run may take, s",
}
_RANGE = ("from", "to", "scale", "whole")
_SCALES = ("linear", "log")


class StudyFileError(Exception):
    """A study cannot be read; the text is one line that says what is wrong."""


def read_study_file(path: Path, most_runs: int | None = LIMIT) -> Study:
    """Return the study that a file holds.

    Parameters
    ----------
    path : of the file.
    most_runs : how many runs it may ask for; None: as many as it likes.

    Raises
    ------
    StudyFileError : the file cannot be read, something in it is not allowed, or it asks for too many runs.
    """
    return _Reader(path, most_runs).read()


class _Reader:
    """One file that is read."""

    def __init__(self, path: Path, most_runs: int | None) -> None:
        self._path = path
        self._most_runs = most_runs

    def read(self) -> Study:
        found = self._load()
        self._only("", found, KEYS)
        if "list" in found:
            self._array("list", found["list"])
        for key in ("study", "scene"):
            if key not in found:
                raise self._error(f"has no '{key}': {KEYS[key]}")
        scene = self._path.parent / self._text("scene", found["scene"])
        if not scene.is_file():
            raise self._wrong("scene", found["scene"], "a parameter file, counted from this file's folder")
        table = self._built("", self._table, found)
        self._limit(table.count)
        return Study(
            self._built("study", checked_key, self._text("study", found["study"])),
            self._text("question", found.get("question", "")), str(scene.resolve()), table,
            OUTCOMES if isinstance(table, Bisection) else OUTCOMES[:3],
            self._choice("logs", found.get("logs", False), (False, True)),
            self._number("timeLimit", found.get("timeLimit", RUN_SECONDS), above=0), self._path,
        )

    def _load(self) -> dict[str, Any]:
        def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
            for key, _ in pairs:
                if [other for other, _ in pairs].count(key) > 1:
                    raise self._error(f"'{key}' stands there twice")
            return dict(pairs)

        try:
            text = self._path.read_text(encoding="utf-8-sig")
            found = json.loads(text, object_pairs_hook=once)
        except OSError as error:
            raise self._error(f"{error.strerror}") from error
        except json.JSONDecodeError as error:
            raise self._error(f"is not JSON ({problem_of(text, error)})") from error
        except ValueError as error:
            raise self._error(f"is not JSON ({error})") from error
        return self._object("", without_notes(found))

    def _table(self, found: Mapping[str, Any]) -> Grid | Bisection:
        variants = self._object("variants", found.get("variants", {}))
        duration = found.get("duration")
        common = self._object("common", found.get("common", {}))
        axes = self._axes(found)
        grid = Grid(
            tuple(axes), common, {name: self._object(f"variants.{name}", own) for name, own in variants.items()},
            self._whole("repeats", found.get("repeats", 0), 0),
            None if duration is None else self._number("duration", duration, above=0),
            self._whole("leastSteps", found.get("leastSteps", 0), 0),
        )
        if duration is not None:
            for place in (common, *grid.variants.values()):
                if "timeStep" in place:
                    self._number("timeStep", place["timeStep"], above=0)
            held = {key for axis in axes for key in axis.keys} | set(common)
            if not all("timeStep" in held | set(own) for own in (grid.variants or {"": {}}).values()):
                raise self._error("a study with 'duration' says 'timeStep' in 'common', in a variant or as an axis")
        if "bisection" not in found:
            if not axes and not variants:
                raise self._error("asks for no run: give 'axes', 'list', 'sample', 'variants' or 'bisection'")
            return grid
        return self._bisection(grid, self._object("bisection", found["bisection"]))

    def _axes(self, found: Mapping[str, Any]) -> list[Axis | Rows]:
        self._limit(self._asked(found))  # before so many values are made
        axes: list[Axis | Rows] = []
        for key, given in self._object("axes", found.get("axes", {})).items():
            where = f"axes.{key}"
            if isinstance(given, dict):
                self._only(where, given, (*_RANGE, "count"))
                values = self._range(where, key, given).spaced(self._whole(f"{where}.count", given.get("count"), 2))
            else:
                values = self._values(where, given)
            axes.append(self._built(where, Axis, key, tuple(values)))
        if "list" in found:
            axes.append(self._list(found["list"]))
        if "sample" in found:
            axes.append(self._sample(self._object("sample", found["sample"])))
        return axes

    def _asked(self, found: Mapping[str, Any]) -> int:
        """Runs that the axes ask for together."""
        counts = [len(found.get("list", [1])), max(1, len(found.get("variants", {}))),
                  1 + self._whole("repeats", found.get("repeats", 0), 0)]
        if "sample" in found:
            counts.append(self._whole("sample.count", self._object("sample", found["sample"]).get("count"), 1))
        for key, given in self._object("axes", found.get("axes", {})).items():
            many = self._whole(f"axes.{key}.count", given.get("count"), 2) if isinstance(given, dict) else None
            counts.append(len(self._values(f"axes.{key}", given)) if many is None else many)
        return math.prod(counts)

    def _limit(self, count: int) -> None:
        if self._most_runs is not None and count > self._most_runs:
            raise self._error(f"asks for {count:,} runs: give --yes if that is meant")

    def _list(self, given: Any) -> Rows:
        rows = [self._object(f"list[{k}]", row) for k, row in enumerate(self._array("list", given))]
        if not rows:
            raise self._wrong("list", given, "at least one object of parameters")
        for k, row in enumerate(rows):
            if row.keys() != rows[0].keys():
                raise self._wrong(f"list[{k}]", row, f"the keys of the first: {', '.join(rows[0]) or 'none'}")
            for key, value in row.items():
                row[key] = self._value(f"list[{k}].{key}", value)
                self._built(f"list[{k}].{key}", value_text, row[key])
        return Rows("run", tuple(rows[0]), tuple(tuple(row[key] for key in rows[0]) for row in rows))

    def _sample(self, given: Mapping[str, Any]) -> Rows:
        self._only("sample", given, ("method", "count", "seed", "ranges"))
        ranges = []
        for key, own in self._object("sample.ranges", given.get("ranges", {})).items():
            where = f"sample.ranges.{key}"
            self._only(where, self._object(where, own), _RANGE)
            ranges.append(self._range(where, key, own))
        if not ranges:
            raise self._wrong("sample.ranges", given.get("ranges", {}), "parameters, each with 'from' and 'to'")
        method = self._choice("sample.method", given.get("method"), METHODS)
        count = self._whole("sample.count", given.get("count"), 1)
        return sample(method, ranges, count, self._whole("sample.seed", given.get("seed", 0), 0))

    def _bisection(self, grid: Grid, given: Mapping[str, Any]) -> Bisection:
        self._only("bisection", given, ("key", *_RANGE, "width", "holds"))
        key = self._text("bisection.key", given.get("key", ""))
        holds = self._object("bisection.holds", given.get("holds", {}))
        self._only("bisection.holds", holds, ("outcomes", "atMost"))
        outcomes = self._array("bisection.holds.outcomes", holds.get("outcomes", list(OUTCOMES[:2])))
        for outcome in outcomes:
            self._choice("bisection.holds.outcomes", outcome, OUTCOMES)
        most = self._object("bisection.holds.atMost", holds.get("atMost", {}))
        for name, value in most.items():
            self._number(f"bisection.holds.atMost.{name}", value)
        return Bisection(grid, self._range("bisection", key, given),
                         self._number("bisection.width", given.get("width"), above=0), Holds(tuple(outcomes), most))

    def _range(self, where: str, key: str, given: Mapping[str, Any]) -> Range:
        low, high = (self._number(f"{where}.{end}", given.get(end)) for end in ("from", "to"))
        scale = self._choice(f"{where}.scale", given.get("scale", "linear"), _SCALES)
        whole = self._choice(f"{where}.whole", given.get("whole", False), (False, True))
        return self._built(where, Range, key, low, high, scale == "log", whole)

    def _values(self, where: str, given: Any) -> Sequence[Value]:
        if not isinstance(given, list):
            raise self._wrong(where, given, "a list of values, or an object with 'from', 'to' and 'count'")
        return [self._value(f"{where}[{k}]", value) for k, value in enumerate(given)]

    def _value(self, where: str, given: Any) -> Value:
        """Return a value, or one with a name: {"name": "wide", "value": {..}}."""
        if not isinstance(given, dict):
            return given
        self._only(where, given, ("name", "value"))
        for key in ("name", "value"):
            if key not in given:
                raise self._error(f"{where} has no '{key}': an object or a list stands as "
                                  '{"name": "a", "value": ..}')
        return Named(self._text(f"{where}.name", given["name"]), given["value"])

    def _built(self, where: str, make: Callable[..., Any], *given: Any) -> Any:
        """Return the object made of these values; a ValueError becomes a line that says where in the file they are."""
        try:
            return make(*given)
        except ValueError as error:
            raise self._error(f"{where}: {error}" if where else str(error)) from error

    def _only(self, where: str, given: Mapping[str, Any], allowed: Sequence[str] | Mapping[str, str]) -> None:
        for key in given:
            if key not in allowed:
                near = difflib.get_close_matches(key, list(allowed), 1)
                hint = f"did you mean '{near[0]}'?" if near else f"{', '.join(allowed)} are allowed"
                raise self._error(f"{where + ': ' if where else ''}unknown key '{key}': {hint}")

    def _text(self, where: str, given: Any) -> str:
        if not isinstance(given, str) or (not given and where != "question"):
            raise self._wrong(where, given, "a text")
        return given

    def _object(self, where: str, given: Any) -> dict[str, Any]:
        if not isinstance(given, dict):
            raise self._wrong(where or "the file", given, "an object")
        return given

    def _array(self, where: str, given: Any) -> list[Any]:
        if not isinstance(given, list):
            raise self._wrong(where, given, "a list")
        return given

    def _number(self, where: str, given: Any, above: float | None = None) -> float:
        # Python reads NaN and Infinity, which are no JSON; neither is above or below anything.
        is_number = isinstance(given, (int, float)) and not isinstance(given, bool) and abs(given) < float("inf")
        if not is_number or (above is not None and not given > above):
            raise self._wrong(where, given, "a number" + (f" above {above}" if above is not None else ""))
        return given

    def _whole(self, where: str, given: Any, least: int) -> int:
        if not isinstance(given, int) or isinstance(given, bool) or given < least:
            raise self._wrong(where, given, f"a whole number from {least}")
        return given

    def _choice(self, where: str, given: Any, allowed: Sequence[Any]) -> Any:
        if not any(given is one or (given == one and isinstance(given, str)) for one in allowed):
            raise self._wrong(where, given, " or ".join(json.dumps(one) for one in allowed))
        return given

    def _wrong(self, where: str, given: Any, allowed: str) -> StudyFileError:
        said = "is missing" if given is None else f"= {json.dumps(given)[:120]} is not allowed"
        return self._error(f"{where} {said}: {allowed}")

    def _error(self, text: str) -> StudyFileError:
        return StudyFileError(f"{self._path}: {text}")
