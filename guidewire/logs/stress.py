"""Stresses and strains along the wire over time, from a log with ``logStrains``."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.logs.logs import LogError, find_log, read_columns


@dataclass(frozen=True)
class StressLog:
    """All entries of one log, ``k`` of them, of a wire of ``n`` elements.

    Attributes
    ----------
    time : (k,), in s.
    positions : (k, n+1, 3), in units.
    curvature : (k, n+1, 3), curvature about d1 and d2 and twist at each joint, rad/m.
    couple : (k, n+1, 3), at each joint, N m, along the world's axes.
    strain : (k, n, 3), shear along d1 and d2 and stretch of each element.
    force : (k, n, 3), in each element, N, along the world's axes.
    angular_velocity : (k, n, 3), of each element along its own axes, rad/s.
    energy : (k, 3), kinetic, elastic and potential, J.
    """

    time: np.ndarray
    positions: np.ndarray
    curvature: np.ndarray
    couple: np.ndarray
    strain: np.ndarray
    force: np.ndarray
    angular_velocity: np.ndarray
    energy: np.ndarray

    @property
    def arc_length(self) -> np.ndarray:
        """Say where each joint stands along the wire as it was at first, shape (n+1,), in units."""
        steps = np.linalg.norm(np.diff(self.positions[0], axis=0), axis=1)
        return np.concatenate(([0.0], np.cumsum(steps)))

    @property
    def bending(self) -> np.ndarray:
        """Size of the curvature at each joint, shape (k, n+1), rad/m."""
        return np.hypot(self.curvature[..., 0], self.curvature[..., 1])


_NAMES = {"curvature": "curvature", "couple": "couple", "strain": "strain", "force": "force",
          "angular_velocity": "angularVelocities"}
_ENERGIES = ("kineticEnergy", "elasticEnergy", "potentialEnergy")


def read_stress(path: Path, every: int = 1) -> StressLog:
    """Reads every `every`-th entry of a log or of a run folder's log.

    Raises
    ------
    LogError : the log cannot be read, or holds no stress or not all spheres.
    """
    columns = read_columns(path, ("totalTime", "positions", *_NAMES.values(), *_ENERGIES))
    if "curvature" not in columns or columns["positions"].shape != columns["curvature"].shape:
        raise LogError(f"{find_log(path)}: has no stress along the wire: needs a run of a material with"
                       " logStrains and all spheres")
    kept = {name: np.asarray(values[::every], dtype=float) for name, values in columns.items()}
    return StressLog(time=kept["totalTime"], positions=kept["positions"],
                     energy=np.stack([kept[name] for name in _ENERGIES], axis=1),
                     **{field: kept[name] for field, name in _NAMES.items()})
