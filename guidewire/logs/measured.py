"""Measurements of a real wire in a CSV file, and the error of a run against them.

Two kinds, distinguished by their first line: `time,force` (s, and N at the hub), or `time,x,y,z` (s, and a point of the
centreline in the run's units), where lines of the same time are points of one shape. Other units stand behind the
names, such as `force_mN` and `x_mm` (guidewire.logs.measurement).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.logs.curves import offsets, smooth
from guidewire.logs.hub import read_hub
from guidewire.logs.logs import LogError, PositionLog, read_log
from guidewire.logs.measurement import read_measurement
from guidewire.logs.runs import read_run

FORMS = ("time,force", "time,x,y,z")
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
        """Say it in one line."""
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
    distances : (p,) each, of each point from the curve through the nodes at its time.
    left_out : shapes before the run's start or after its end.
    """

    time: np.ndarray
    measured: tuple[np.ndarray, ...]
    run: np.ndarray
    distances: tuple[np.ndarray, ...]
    left_out: int

    def summary(self) -> str:
        """Say it in one line."""
        every = np.concatenate(self.distances)
        worst = max(range(len(self.time)), key=lambda k: float(np.max(self.distances[k])))
        return (f"centreline: RMS distance {_rms(every):.3g} units, largest {np.max(every):.3g} units at t = "
                f"{self.time[worst]:g} s; {len(every)} points, {_counted(len(self.time), self.left_out, 'shape')}")


def compare(folder: Path, file: Path) -> ComparedForce | ComparedShapes:
    """Return a run beside a measurement.

    Raises
    ------
    LogError : the file or the run cannot be read, the run does not log what was measured, or no time lies within it.
    """
    measured = read_measurement(file, float(read_run(folder).parameters.get("metresPerUnit", 1.0)), FORMS)
    if measured.columns == ("time", "force"):
        hub = read_hub(folder)
        use = _within(measured.over, hub.time, file)
        force = _finite(np.interp(measured.over[use], hub.time, hub.force), folder)
        return ComparedForce(measured.over[use], measured.values[use], force, int(np.count_nonzero(~use)))
    if measured.columns != ("time", "x", "y", "z"):
        raise LogError(f"{file}: the first line is \"{','.join(measured.columns)}\", must be {' or '.join(FORMS)}")
    log = read_log(folder, spheres="all")
    if len(log.spheres) < 2:
        raise LogError(f"{log.source}: holds one sphere only; a shape needs a run with logSpheres = \"all\"")
    times = np.array([shape.time for shape in measured.shapes])
    use = _within(times, log.time, file)
    kept = tuple(shape.points for shape, kept in zip(measured.shapes, use) if kept)
    nodes = _finite(np.array([nodes_at(log, time) for time in times[use]]), folder)
    distances = tuple(np.linalg.norm(offsets(points, smooth(line))[0], axis=1) for points, line in zip(kept, nodes))
    return ComparedShapes(times[use], kept, nodes, distances, int(np.count_nonzero(~use)))


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


def nodes_at(log: PositionLog, time: float) -> np.ndarray:
    """Return the nodes at a time, linear between log entries, shape (n + 1, 3)."""
    after = min(int(np.searchsorted(log.time, time)), len(log.time) - 1)
    before = max(after - 1, 0)
    span = log.time[after] - log.time[before]
    part = min(max((time - log.time[before]) / span, 0.0), 1.0) if span > 0.0 else 0.0
    return (1.0 - part) * log.positions[before] + part * log.positions[after]


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _counted(count: int, left_out: int, what: str) -> str:
    outside = f", {left_out} more outside the run's time" if left_out else ""
    return f"{count} {what}{'' if count == 1 else 's'} within the run{outside}"
