"""Measurements of a real wire in a CSV file, and the error of a run against them.

Two kinds, distinguished by their first line: `time,force` (s, and N at the hub), or `time,x,y,z` (s, and a point of the
centreline in the run's units), where lines of the same time are points of one shape.
"""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.logs.hub import read_hub
from guidewire.logs.logs import LogError, PositionLog, read_log

COLUMNS = (("time", "force"), ("time", "x", "y", "z"))
_EARLY = 1e-9  # of the run's duration, by which a time may lie outside it


@dataclass(frozen=True)
class ComparedForce:
    """Force at the hub.

    Attributes
    ----------
    time, measured, run : (k,), s, N, N; the run's at the measured times.
    left_out : measured values before the run's start or after its end.
    """

    time: np.ndarray
    measured: np.ndarray
    run: np.ndarray
    left_out: int

    @property
    def errors(self) -> np.ndarray:
        """Run less measurement, N."""
        return self.run - self.measured

    def summary(self) -> str:
        """One line."""
        errors = np.abs(self.errors)
        worst, peak = int(np.argmax(errors)), float(np.max(np.abs(self.measured)))
        part = f" ({100.0 * _rms(errors) / peak:.3g} % of the measured peak)" if peak > 0.0 else ""
        return (f"force of the hub: RMS error {_rms(errors):.3g} N{part}, largest {errors[worst]:.3g} N at t = "
                f"{self.time[worst]:g} s; {_counted(len(errors), self.left_out, 'value')}")


@dataclass(frozen=True)
class ComparedShapes:
    """Shapes of the centreline, all in the run's units.

    Attributes
    ----------
    time : (k,), of each shape, s.
    measured : (p, 3) each, their points.
    run : (k, n + 1, 3), the run's nodes at these times.
    distances : (p,) each, of each point from the line through the nodes at its time.
    left_out : shapes before the run's start or after its end.
    """

    time: np.ndarray
    measured: tuple[np.ndarray, ...]
    run: np.ndarray
    distances: tuple[np.ndarray, ...]
    left_out: int

    def summary(self) -> str:
        """One line."""
        every = np.concatenate(self.distances)
        worst = max(range(len(self.time)), key=lambda k: float(np.max(self.distances[k])))
        return (f"centreline: RMS distance {_rms(every):.3g} units, largest {np.max(every):.3g} units at t = "
                f"{self.time[worst]:g} s; {len(every)} points, {_counted(len(self.time), self.left_out, 'shape')}")


def compare(folder: Path, file: Path) -> ComparedForce | ComparedShapes:
    """A run beside a measurement.

    Raises
    ------
    LogError : the file or the run cannot be read, the run does not log what was measured, or no time lies within it.
    """
    rows = _read(file)
    if rows.shape[1] == 2:
        hub = read_hub(folder)
        use = _within(rows[:, 0], hub.time, file)
        force = _finite(np.interp(rows[use, 0], hub.time, hub.force), folder)
        return ComparedForce(rows[use, 0], rows[use, 1], force, int(np.count_nonzero(~use)))
    log = read_log(folder, spheres="all")
    if len(log.spheres) < 2:
        raise LogError(f"{log.source}: holds one sphere only; a shape needs a run with logSpheres = \"all\"")
    times, first = np.unique(rows[:, 0], return_index=True)
    shapes = np.split(rows[:, 1:], first[1:])
    use = _within(times, log.time, file)
    kept = tuple(shape for shape, kept in zip(shapes, use) if kept)
    nodes = _finite(np.array([_nodes_at(log, time) for time in times[use]]), folder)
    distances = tuple(_distances(points, line) for points, line in zip(kept, nodes))
    return ComparedShapes(times[use], kept, nodes, distances, int(np.count_nonzero(~use)))


def _read(file: Path) -> np.ndarray:
    """Numbers of the file, shape (k, 2) or (k, 4), times ascending."""
    allowed = " or ".join(",".join(names) for names in COLUMNS)
    try:
        with file.open(newline="", encoding="utf-8-sig") as stream:
            lines = [(number, row) for number, row in enumerate(csv.reader(stream), 1) if any(map(str.strip, row))]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        said = error.strerror if isinstance(error, OSError) else "is not a comma-separated text file in UTF-8"
        raise LogError(f"{file}: {said}") from error
    names = tuple(name.strip().lower() for name in lines[0][1]) if lines else ()
    if names not in COLUMNS:
        raise LogError(f"{file}: the first line is \"{','.join(names)}\", must be {allowed}")
    rows = []
    for number, row in lines[1:]:
        try:
            values = [float(value) for value in row]
        except ValueError:
            values = []
        if len(values) != len(names) or not all(map(math.isfinite, values)):
            raise LogError(f"{file}: line {number} is \"{','.join(row)}\", must be {len(names)} finite numbers: "
                           f"{','.join(names)}")
        if rows and values[0] < rows[-1][0]:
            raise LogError(f"{file}: line {number}: time {values[0]:g} s after {rows[-1][0]:g} s, times must ascend")
        rows.append(values)
    if not rows:
        raise LogError(f"{file}: holds no line of numbers after the first line")
    return np.array(rows)


def _finite(values: np.ndarray, folder: Path) -> np.ndarray:
    if not np.all(np.isfinite(values)):
        raise LogError(f"{folder}: the run's log has numbers that are not finite at the measured times")
    return values


def _within(times: np.ndarray, run: np.ndarray, file: Path) -> np.ndarray:
    early = _EARLY * (run[-1] - run[0])
    use = (times >= run[0] - early) & (times <= run[-1] + early)
    if not np.any(use):
        raise LogError(f"{file}: times from {times[0]:g} to {times[-1]:g} s, none within the run's {run[0]:g} to "
                       f"{run[-1]:g} s")
    return use


def _nodes_at(log: PositionLog, time: float) -> np.ndarray:
    """Linear between log entries, shape (n + 1, 3)."""
    after = min(int(np.searchsorted(log.time, time)), len(log.time) - 1)
    before = max(after - 1, 0)
    span = log.time[after] - log.time[before]
    part = min(max((time - log.time[before]) / span, 0.0), 1.0) if span > 0.0 else 0.0
    return (1.0 - part) * log.positions[before] + part * log.positions[after]


def _distances(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    """Of points (p, 3) from a chain of straight pieces between nodes (n + 1, 3), shape (p,)."""
    chords = np.diff(line, axis=0)
    squares = np.maximum(np.sum(chords**2, axis=1), np.finfo(float).tiny)
    off = points[:, None, :] - line[None, :-1, :]
    along = np.clip(np.sum(off * chords, axis=2) / squares, 0.0, 1.0)
    return np.min(np.linalg.norm(off - along[:, :, None] * chords, axis=2), axis=1)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _counted(count: int, left_out: int, what: str) -> str:
    outside = f", {left_out} more outside the run's time" if left_out else ""
    return f"{count} {what}{'' if count == 1 else 's'} within the run{outside}"
