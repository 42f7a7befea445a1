"""Measurements of a real wire in CSV files: shapes, pictures, hub forces and critical values.

The first line names the columns, each with a unit behind it where it is not the usual one: `x_mm`, `force_mN`,
`turn_deg`. Lengths without a unit are in the units of the run.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from guidewire.logs.logs import LogError

# Unit to its size in the unit that numbers are kept in; "" is that unit. Of a length "" is the run's unit.
_LENGTH = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}
_UNITS: dict[str, dict[str, float]] = {
    "time": {"": 1.0, "s": 1.0, "ms": 1e-3}, "insertion": {"": 1.0, **_LENGTH}, "turn": {"": 1.0, "rad": 1.0,
                                                                                        "deg": math.pi / 180.0},
    "force": {"": 1.0, "N": 1.0, "mN": 1e-3}, "torque": {"": 1.0, "Nm": 1.0, "Nmm": 1e-3, "mNm": 1e-3},
    "x": _LENGTH, "y": _LENGTH, "z": _LENGTH, "u": {"": 1.0, "px": 1.0}, "v": {"": 1.0, "px": 1.0},
}
_POINTS = ("x", "y", "z")
HUB = tuple((over, value) for over in ("time", "insertion", "turn") for value in ("force", "torque"))
SHAPES = (("x", "y", "z"), ("x", "y"), ("x", "z"), ("y", "z"))
FORMS = (*map(",".join, HUB), *map(",".join, SHAPES), *(f"time,{','.join(one)}" for one in SHAPES), "view,u,v",
         "time,view,u,v", "critical KEY")
_COLUMN = re.compile(r"^(\w+?)(?:_(um|mm|cm|m|ms|s|rad|deg|mN|N|Nmm|mNm|Nm|px))?$")


@dataclass(frozen=True)
class Shape:
    """Points of the wire at one moment.

    Attributes
    ----------
    time : s; None: at the run's end.
    view : of which camera the points are a picture; empty where they lie in space or in a plane.
    points : (p, 3) or (p, 2), in the run's units, or pixels of the view.
    """

    time: float | None
    view: str
    points: np.ndarray


@dataclass(frozen=True)
class Measurement:
    """What one file holds.

    Attributes
    ----------
    file : where it was read.
    columns : their names, without units.
    shapes : of shapes and pictures; empty for others.
    over, values : (k,) each, of a quantity at the hub: time (s), insertion (m) or turn (rad), and force (N) or torque
        (N m); of a critical value `over` is empty and `values` are its repeats, in the key's own unit.
    """

    file: Path
    columns: tuple[str, ...]
    shapes: tuple[Shape, ...] = ()
    over: np.ndarray = field(default_factory=lambda: np.empty(0))
    values: np.ndarray = field(default_factory=lambda: np.empty(0))

    @property
    def critical(self) -> str:
        """The key whose critical value was measured; empty where the file holds something else."""
        return self.columns[0].split()[1] if self.columns[0].startswith("critical ") else ""

    @property
    def axes(self) -> tuple[int, ...]:
        """Axes of the world along which the points of shapes are given."""
        return tuple(_POINTS.index(name) for name in self.columns if name in _POINTS)

    @property
    def count(self) -> int:
        """How many points or values there are."""
        return sum(len(shape.points) for shape in self.shapes) + len(self.values)


def read_measurement(file: Path, metres_per_unit: float, forms: Sequence[str] = FORMS) -> Measurement:
    """Read a measurement.

    Parameters
    ----------
    file : CSV, in UTF-8, its first line the names of the columns.
    metres_per_unit : of the run.
    forms : what the caller takes, for the error line.

    Raises
    ------
    LogError : the file cannot be read or holds something else; one line.
    """
    lines = _lines(file)
    first = [name.strip() for name in lines[0][1]] if lines else []
    columns, factors = _columns(first, metres_per_unit)
    plain = tuple(name for name in columns if name not in ("time", "view"))
    is_known = columns in HUB or plain in SHAPES or plain == ("u", "v") or len(columns) == 1 and factors
    if not is_known or columns[:1] == ("critical",):
        raise LogError(f"{file}: the first line is \"{','.join(first)}\", must be {' or '.join(forms)}, each name "
                       f"with its unit behind it where that is another, such as x_mm{_marks(first)}")
    rows, views = _rows(file, lines[1:], first, columns)
    numbers = rows * np.array([factor for name, factor in zip(columns, factors) if name != "view"])
    if columns in HUB:
        return Measurement(file, columns, over=numbers[:, 0], values=numbers[:, 1])
    if plain not in SHAPES and plain != ("u", "v"):
        return Measurement(file, columns, values=numbers[:, 0])
    times = numbers[:, columns.index("time")] if "time" in columns else np.full(len(numbers), np.nan)
    points = numbers[:, -len(plain):]
    keys = list(zip(times.tolist() if "time" in columns else [None] * len(points), views or [""] * len(points)))
    shapes = tuple(Shape(time, view, points[[k for k, key in enumerate(keys) if key == (time, view)]])
                   for time, view in dict.fromkeys(keys))
    return Measurement(file, columns, shapes)


def _marks(row: Sequence[str], count: int = 0) -> str:
    """What to say of semicolons, and of twice as many parts as there are columns; else nothing."""
    if any(";" in text for text in row):
        return "; semicolons are no separators: write commas between columns and points in numbers"
    return "; decimal commas separate columns: write points in numbers" if count and len(row) == 2 * count else ""


def _lines(file: Path) -> list[tuple[int, list[str]]]:
    try:
        with file.open(newline="", encoding="utf-8-sig") as stream:
            return [(number, row) for number, row in enumerate(csv.reader(stream), 1) if any(map(str.strip, row))]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        said = error.strerror if isinstance(error, OSError) else "is not a comma-separated text file in UTF-8"
        raise LogError(f"{file}: {said}") from error


def _columns(first: Sequence[str], metres_per_unit: float) -> tuple[tuple[str, ...], list[float]]:
    """Names and the factors to the unit in which numbers are kept; none where a name or a unit is not known."""
    if len(first) == 1 and first[0].startswith("critical "):
        key = first[0].split()[1]
        is_degrees = key.endswith("_deg")
        return (f"critical {key.removesuffix('_deg').removesuffix('_rad')}",), [math.pi / 180.0 if is_degrees else 1.0]
    names, factors = [], []
    for text in first:
        found = _COLUMN.match(text)
        name, unit = (found[1].lower(), found[2] or "") if found else ("", "")
        if name == "view" and not unit:
            names.append(name)
            factors.append(1.0)
            continue
        units = _UNITS.get(name, {})
        if name in _POINTS:
            units = {"": 1.0, **{key: size / metres_per_unit for key, size in units.items()}}
        elif name == "insertion":
            units = {**units, "": metres_per_unit}
        if unit not in units:
            return (), []
        names.append(name)
        factors.append(units[unit])
    return tuple(names), factors


def _rows(file: Path, lines: Sequence[tuple[int, list[str]]], first: Sequence[str], columns: Sequence[str]
          ) -> tuple[np.ndarray, list[str]]:
    """Numbers (k, columns but "view"), and the views where there are some."""
    rows, views = [], []
    view = columns.index("view") if "view" in columns else None
    for number, row in lines:
        texts = [text for k, text in enumerate(row) if k != view]
        try:
            values = [float(text) for text in texts]
        except ValueError:
            values = []
        if len(row) != len(columns) or len(values) != len(texts) or not all(map(math.isfinite, values)):
            raise LogError(f"{file}: line {number} is \"{','.join(row)}\", must be {len(columns)} finite numbers: "
                           f"{','.join(first)}{_marks(row, len(columns))}")
        if columns[0] == "time" and rows and values[0] < rows[-1][0]:
            raise LogError(f"{file}: line {number}: time {values[0]:g} s after {rows[-1][0]:g} s, times must ascend")
        rows.append(values)
        if view is not None:
            views.append(row[view].strip())
    if not rows:
        raise LogError(f"{file}: holds no line of numbers after the first line")
    return np.array(rows), views
