"""Results of runs with a material, in SI units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from guidewire.logs.logs import read_columns, read_entries, read_log
from guidewire.logs.runs import Run, read_repeats

_MILLIMETRE = 1e-3  # m; the unit of runs with gains here, which have none of their own


@dataclass(frozen=True)
class State:
    """A wire at one time.

    Attributes
    ----------
    time : s.
    positions : (n+1, 3), m.
    velocities : (n+1, 3), m/s.
    orientations : (n, 4), unit quaternions x, y, z, w; None where the run did not log them.
    """

    time: float
    positions: np.ndarray
    velocities: np.ndarray
    orientations: np.ndarray | None

    @property
    def in_plane(self) -> np.ndarray:
        """Positions as (z, -y), along the wire and down, shape (n+1, 2)."""
        return self.positions[:, [2, 1]] * np.array([1.0, -1.0])

    @property
    def twists(self) -> np.ndarray:
        """Turn of each element about z from its start, rad, shape (n,), without jumps; for a straight wire along z."""
        return np.unwrap(2.0 * np.arctan2(self.orientations[:, 2], self.orientations[:, 3]), period=2.0 * np.pi)


def last_state(run: Run) -> State:
    """Return the state at the end of a run."""
    entry = None
    for _, entry in read_entries(run.folder):
        pass
    return _state(entry, _metres(run))


def tip_motion(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Times in s, shape (k,), and places of the last sphere in m, shape (k, 3)."""
    log = read_log(run.folder)
    return log.time, _metres(run) * log.positions[:, 0]


def tip_at(run: Run, time: np.ndarray) -> np.ndarray:
    """Places of the last sphere at these times (s), m, shape (k, 3), by cubics through logged places and velocities."""
    log = read_log(run.folder, velocities=True)
    metres = _metres(run)
    return CubicHermiteSpline(log.time, metres * log.positions[:, 0], metres * log.velocities[:, 0])(time)


def reactions(run: Run) -> np.ndarray:
    """Force of the first sphere's support, its mean over each step, N, shape (steps, 3); the run must log contacts."""
    return read_columns(run.folder, ("reaction",))["reaction"][1:]


def solver_report(run: Run, name: str) -> float | np.ndarray:
    """Return what the solver said of itself at the end of a run: a number, or a vector of shape (3,)."""
    value = run.summary["solver"][name]
    if value is None:
        return float("nan")
    return np.array(value, dtype=float) if isinstance(value, list) else float(value)


def wall_time(run: Run, repeats: int = 0) -> float:
    """Wall time of a run's steps in s, or of finding its rest shape where it has none: the median of the timed repeats,
    if any."""
    runs = read_repeats(run, repeats) or [run]
    return float(np.median([r.measured("computationTime" if r.measured("steps") else "setUpTime") for r in runs]))


def wall_time_per_second(run: Run, repeats: int = 0) -> float:
    """Wall time per simulated second."""
    return wall_time(run, repeats) / run.measured("inGameTime")


def _metres(run: Run) -> float:
    return run.number("metresPerUnit") if "metresPerUnit" in run.parameters else _MILLIMETRE


def _state(entry: dict, metres: float) -> State:
    spheres = [entry["sphere"][str(i)] for i in range(len(entry["sphere"]))]
    logged = entry.get("orientation")
    frames = None
    if logged is not None:
        frames = np.array([[logged[str(j)][axis] for axis in "xyzw"] for j in range(len(logged))], dtype=float)
    return State(
        float(entry["totalTime"]),
        metres * np.array([[s["x"], s["y"], s["z"]] for s in spheres], dtype=float),
        metres * np.array([[s["vx"], s["vy"], s["vz"]] for s in spheres], dtype=float),
        frames,
    )
