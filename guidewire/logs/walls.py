"""Walls of a run: what they are, and in its log how far those that give way are displaced."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from guidewire.logs.logs import PositionLog, read_columns
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import Surface
from guidewire.quantities import catheter_name


def name_walls(parameters: Mapping[str, Any], walls: Sequence[Surface]) -> list[tuple[str, Surface]]:
    """Return each wall of a run with what it is; the vessel stands first where there is one."""
    return [("vessel" if k == 0 and parameters.get("vessel") else "obstacle", wall) for k, wall in enumerate(walls)]


def soft_walls(parameters: Mapping[str, Any]) -> list[int]:
    """Return the numbers of a run's walls that give way, the vessel first where there is one."""
    walls = [one for one in (parameters.get("vessel"), *(parameters.get("obstacles") or ())) if one]
    return [k for k, wall in enumerate(walls) if wall.keys() & {"wallStiffness", "modulus"}]


def read_displacements(run: Run, steps: np.ndarray, catheters: int) -> list[np.ndarray]:
    """Return the displacements of soft walls at the elements of the wire and of each catheter, (k, n, 3), m, of entries
    of a run's log; none where all walls are rigid, or the log does not have them."""
    names = ["wallDisplacements", *(catheter_name("wallDisplacements", number) for number in range(catheters))]
    columns = read_columns(run.folder, names, steps)
    return [columns[name] for name in names if name in columns]


def given_walls(parameters: Mapping[str, Any]) -> list[int]:
    """Return the numbers of the walls that give way as a beam: the vessel with what is in it, or none."""
    if "beam" not in (parameters.get("vessel") or {}):
        return []
    return list(range(1 + len(parameters.get("obstacles") or ())))


def drawn_of(run: Run, log: PositionLog) -> list[tuple[list[np.ndarray], list[np.ndarray]]]:
    """Return what each entry of a log is drawn by, as `State.drawn` has it. The log has all spheres."""
    displaced = []
    if soft_walls(run.parameters) and run.parameters.get("logContacts"):
        displaced = read_displacements(run, log.steps, len(log.catheters))
    return [([log.positions[k], *(one[k] for one in log.catheters)], [one[k] for one in displaced])
            for k in range(len(log.steps))]
