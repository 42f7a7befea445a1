"""The table of a study's runs, runs.csv: which columns can be plotted against one another."""

from __future__ import annotations

import csv
import difflib
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from guidewire.logs.logs import LogError
from guidewire.studies.keys import RESULTS, TABLE

# Summary quantities: what they are, and their unit; of a wire with a material.
QUANTITIES: Mapping[str, tuple[str, str]] = {
    "hub.force": ("force of the hub at the end", "N"), "hub.torque": ("torque of the hub at the end", "N m"),
    "hub.insertion": ("insertion", "m"), "hub.turn": ("rotation of the hub", "rad"),
    "hub.twist": ("twist from hub to tip", "rad"), "hub.lengthInBody": ("length in the body", "m"),
    "hub.largestCurvature": ("largest curvature at the end", "1/m"),
    "extremes.axialForce": ("largest force of the hub", "N"),
    "extremes.axialTorque": ("largest torque of the hub", "N m"),
    "extremes.curvature": ("largest curvature", "1/m"), "extremes.strain": ("largest strain", ""),
    "extremes.elementForce": ("largest force of walls on an element", "N"),
    "extremes.wallPressure": ("largest pressure of a wall", "Pa"),
    "extremes.wallDisplacement": ("largest displacement of a wall", "m"),
    "extremes.wallWork": ("work of walls that move or follow with a delay", "J"),
    "extremes.frictionWork": ("work of friction", "J"), "extremes.frictionPower": ("largest power of friction", "W"),
    "largestContactForce": ("largest contact force", "N"), "largestWallForce": ("largest force of all walls", "N"),
    "maxPenetration": ("largest penetration", "units"), "driveShortfall": ("shortfall of the drive", "units"),
    "inGameTime": ("in-game time", "s"), "computationTime": ("computation time", "s"), "wallTime": ("wall time", "s"),
    "averageStepTime": ("average wall time of a step", "ms"), "medianStepTime": ("median wall time of a step", "ms"),
    "steps": ("steps", ""), "passages": ("passages of walls", ""), "predictionError": ("prediction error", "units"),
    "relaxationTime": ("relaxation time", "s"), "relaxationTimeError": ("standard error of the relaxation time", "s"),
    "relaxationPeriod": ("period of the oscillation", "s"), "solver.energy": ("energy at the end", "J"),
    "hub.tipPosition": ("position of the tip", "units"),
}
_FORCES = ("largestContactForce", "largestWallForce")  # with gains in units of their own
_GAINS_FORCE = "mass unit * unit/s$^2$"


@dataclass(frozen=True)
class Line:
    """Points that belong together.

    Attributes
    ----------
    by : value of the parameter that makes a colour; empty where none does.
    rest : values of the other parameters that vary, "key = value" each.
    x, y : of the points, x ascending; texts where x is no number.
    error : standard errors of y, which the table has in a column of y's name and "Error"; 0 where it has none.
    """

    by: str
    rest: str
    x: tuple[float | str, ...]
    y: tuple[float, ...]
    error: tuple[float, ...] = ()


@dataclass(frozen=True)
class Curves:
    """What is drawn of a table.

    Attributes
    ----------
    lines : curves, in the table's order.
    x, y, by : keys as they stand in the table; `by` is empty where nothing makes a colour.
    y_label : what y is, with its unit.
    runs, lost : runs that are drawn, and runs without a number there.
    question : of the study; empty where its table of what was asked for is gone.
    """

    lines: tuple[Line, ...]
    x: str
    y: str
    by: str
    y_label: str
    runs: int
    lost: int
    question: str


def read_curves(table: Path, x: str, y: str, by: str | None = None) -> Curves:
    """One quantity of a table over another.

    Parameters
    ----------
    table : runs.csv, or the folder of a study.
    x, y, by : columns, or their last parts where only one column ends so; y also an item of a list, as
        ``hub.tipPosition[2]``. A line is drawn for each value of `by`, and of what else was varied.

    Raises
    ------
    LogError : in one line, where the table cannot be read, a column is not there, or nothing can be drawn.
    """
    file = table / RESULTS if table.is_dir() else table
    rows = _read(file)
    columns = tuple(rows[0])
    name, index = _item(y)
    varied, question = _varied(file, columns)
    numbers = [column for column in columns if any(_number(row[column]) is not None for row in rows)]
    x, name, by = (_column(file, columns, "--" + flag, asked, offered) if asked else "" for flag, asked, offered in (
        ("x", x, varied), ("y", name, numbers), ("by", by, varied)))
    chosen = [row for row in rows if not row.get("repeat")] or rows
    points: dict[tuple[str, str], list[tuple[float | str, float, float]]] = {}
    lost = 0
    for row in chosen:
        value = _number(row[name] if index is None else _of_list(row[name], index))
        if value is None or not row[x]:
            lost += 1
            continue
        rest = ", ".join(f"{key} = {row[key]}" for key in varied if key not in (x, by) and row.get(key))
        across = _number(row[x])
        error = _number(row.get(name + "Error", "")) if index is None else None
        points.setdefault((row[by] if by else "", rest), []).append(
            (row[x] if across is None else across, value, error or 0.0))
    if not points:
        raise LogError(f"{file}: {y} is a number in none of {len(chosen)} runs; there are {', '.join(numbers)}")
    texts = any(isinstance(across, str) for line in points.values() for across, *_ in line)
    lines = tuple(Line(colour, rest, *zip(*([(str(across), *of_y) for across, *of_y in line] if texts
                                            else sorted(line))))
                  for (colour, rest), line in points.items())
    return Curves(lines, x, name + ("" if index is None else f"[{index}]"), by, _label(name, index, rows[0]),
                  len(chosen) - lost, lost, question)


def label_of(name: str, unit: str) -> str:
    """Label of an axis: what a column is, with its unit; `unit` is that of a parameter."""
    words, own = QUANTITIES.get(name, (name, unit))
    return f"{words} ({own})" if own else words


def _read(file: Path) -> list[dict[str, str]]:
    try:
        with file.open(newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
    except OSError as error:
        raise LogError(f"{file}: {error.strerror}: give the {RESULTS} of a study, or its folder") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise LogError(f"{file}: is no table ({error})") from error
    if not rows or "key" not in rows[0] or "outcome" not in rows[0]:
        raise LogError(f"{file}: is not a table of a study's runs")
    return rows


def _varied(file: Path, columns: Sequence[str]) -> tuple[list[str], str]:
    """What a study varies, and its question. Without study.json: what stands before the column of repeats."""
    try:
        asked = json.loads((file.parent / TABLE).read_text(encoding="utf-8"))
        keys = dict.fromkeys(key for run in asked["runs"] for key in run["values"])
        return ["variant", *keys], str(asked.get("question", ""))
    except (OSError, ValueError, KeyError, TypeError):
        return list(columns[1:columns.index("repeat")]) if "repeat" in columns else [], ""


def _column(file: Path, columns: Sequence[str], flag: str, asked: str, offered: Sequence[str]) -> str:
    """The column that is meant; `offered` are those that an error names."""
    if asked in columns:
        return asked
    ends = [column for column in columns if column.endswith("." + asked)]
    if len(ends) == 1:
        return ends[0]
    near = difflib.get_close_matches(asked, offered, 1)
    hint = f"did you mean '{near[0]}'? " if near else ""
    raise LogError(f"{file}: {flag} {asked}: no such column: {hint}there are {', '.join(ends or offered)}")


def _item(asked: str) -> tuple[str, int | None]:
    name, bracket, index = asked.partition("[")
    return (name, int(index[:-1])) if bracket and index[:-1].lstrip("-").isdecimal() and index.endswith("]") else (
        asked, None)


def _of_list(cell: str, index: int) -> str:
    try:
        return str(json.loads(cell)[index])
    except (ValueError, IndexError, TypeError, KeyError):
        return ""


def _number(cell: str) -> float | None:
    try:
        number = float(cell)
    except ValueError:
        return None
    return number if math.isfinite(number) else None


def _label(name: str, index: int | None, row: Mapping[str, str]) -> str:
    words, unit = QUANTITIES.get(name, (name, ""))
    if name in _FORCES and row.get("stiffness") == "gains":
        unit = _GAINS_FORCE
    words += "" if index is None else f", {'xyz'[index]}" if name.endswith("Position") else f"[{index}]"
    return f"{words} ({unit})" if unit else words
