"""Quantities at the hub and the tip over time, from a log with ``logHub``."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.logs.logs import LOG_NAMES, LogError, find_log, read_columns


_NAMES = {"insertion": "hubInsertion", "turn": "hubTurn", "force": "hubForce", "torque": "hubTorque", "twist": "twist",
          "largest_curvature": "largestCurvature", "tip_direction": "tipDirection"}


@dataclass(frozen=True)
class HubLog:
    """All entries of one log, ``k`` of them; SI units but for `tip`.

    Attributes
    ----------
    time : (k,), in s.
    insertion, turn : (k,), displacement of the hub along its axis, m, and rotation about it, rad, since the start.
    force, torque : (k,), of the hub on the wire, N and N m; a push is positive.
    twist : (k,), of the wire from hub to tip, rad.
    largest_curvature : (k,), of any joint, rad/m.
    tip, tip_direction : (k, 3), in units; a unit vector.
    """

    time: np.ndarray
    insertion: np.ndarray
    turn: np.ndarray
    force: np.ndarray
    torque: np.ndarray
    twist: np.ndarray
    largest_curvature: np.ndarray
    tip: np.ndarray
    tip_direction: np.ndarray


def read_hub(path: Path) -> HubLog:
    """Reads a log or a run folder's log.

    Raises
    ------
    LogError : the log cannot be read, or says nothing of the hub.
    """
    columns = read_columns(path, ("totalTime", "positions", *_NAMES.values()))
    if not columns.keys() >= set(_NAMES.values()):
        raise LogError(f"{find_log(path)}: has no data of the hub: needs a run of solver direct with logHub")
    return HubLog(columns["totalTime"], tip=np.asarray(columns["positions"][:, -1], dtype=float),
                  **{field: np.asarray(columns[name], dtype=float) for field, name in _NAMES.items()})


@dataclass(frozen=True)
class HubCurve:
    """A run, and those that tell how sure it is.

    Attributes
    ----------
    name : of its folder.
    log : the run; of a study its first one.
    others : finer runs that ``run --check`` left in its folder, or the other runs of a study.
    """

    name: str
    log: HubLog
    others: tuple[HubLog, ...]

    def band(self, quantity: str) -> np.ndarray:
        """Lowest and highest value of all runs at the times of `log`, (2, k), by linear interpolation in time. A run
        that ended early has no value beyond."""
        values = [getattr(self.log, quantity)]
        values += [np.interp(self.log.time, other.time, getattr(other, quantity), right=np.nan)
                   for other in self.others]
        return np.array([np.nanmin(values, axis=0), np.nanmax(values, axis=0)])


def read_hub_curve(folder: Path) -> HubCurve:
    """Read a run with those of its ``check``, or all runs of a study that left logs.

    Raises
    ------
    LogError : a log cannot be read, or says nothing of the hub; a study's folder has no log.
    """
    first, *others = (read_hub(run) for run in runs_in(folder))
    return HubCurve(folder.name, first, tuple(others))


def runs_in(folder: Path) -> list[Path]:
    """Return the folders of a run and of those of its ``check``, or of all runs of a study that left logs.

    Raises
    ------
    LogError : no run of the study has a log.
    """
    if not (folder / "runs.csv").is_file():
        return [folder, *sorted(path.parent for path in (folder / "check").glob("*/summary.json"))]
    runs = [path.parent for path in sorted(folder.glob("*/summary.json"))
            if any((path.parent / name).is_file() for name in LOG_NAMES)]
    if not runs:
        raise LogError(f"{folder}: no run of this study has a log: make them with --logs")
    return runs


_SUDDEN = math.radians(1.0)  # of turning, within which a snap takes place


def snap_turns(turn: np.ndarray, torque: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Between which turns of a hub its instrument has snapped: where, within a degree of turning or between two
    entries, the torque has changed by more than half of its largest.

    Parameters
    ----------
    turn, torque : (k,), in rad and in any unit.

    Returns
    -------
    tuple of ndarray
        Turns of the entries before and after each snap, rad.
    """
    turned = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(turn)))))
    far = np.maximum(np.searchsorted(turned, turned + _SUDDEN, side="right") - 1, np.arange(1, len(turn) + 1))
    far = np.minimum(far, len(turn) - 1)
    sudden = np.abs(torque[far] - torque) > 0.5 * np.max(np.abs(torque), initial=0.0)
    steps = np.abs(np.diff(torque))
    found = sorted({k + int(np.argmax(steps[k:far[k]])) for k in np.flatnonzero(sudden)})
    return turn[found], turn[[k + 1 for k in found]]
