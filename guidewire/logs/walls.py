"""Walls of a run: what they are, and in its log how far those that give way are displaced."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from guidewire.logs.logs import PositionLog, read_entries
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import Surface


def name_walls(parameters: Mapping[str, Any], walls: Sequence[Surface]) -> list[tuple[str, Surface]]:
    """Return each wall of a run with what it is; the vessel stands first where there is one."""
    return [("vessel" if k == 0 and parameters.get("vessel") else "obstacle", wall) for k, wall in enumerate(walls)]


def soft_walls(parameters: Mapping[str, Any]) -> list[int]:
    """Return the numbers of a run's walls that give way, the vessel first where there is one."""
    walls = [one for one in (parameters.get("vessel"), *(parameters.get("obstacles") or ())) if one]
    return [k for k, wall in enumerate(walls) if wall.keys() & {"wallStiffness", "modulus"}]


def displacements_in(entry: Mapping[str, Any]) -> list[np.ndarray]:
    """Return the displacements of an entry of a log at the elements of the wire and of each catheter, (n, 3), m; none
    where all walls are rigid, or the log does not have them."""
    if "displacement" not in entry.get("contact", {}):
        return []
    wire = np.zeros((len(entry["sphere"]) - 1, 3))
    for index, own in entry["contact"]["displacement"].items():
        wire[int(index)] = [own[axis] for axis in "xyz"]
    return [wire, *(np.array(one["wallDisplacements"]) for one in entry.get("catheters", ()))]


def drawn_of(run: Run, log: PositionLog) -> list[tuple[list[np.ndarray], list[np.ndarray]]]:
    """Return what each entry of a log is drawn by, as `State.drawn` has it. The log has all spheres."""
    displaced = {}
    if soft_walls(run.parameters) and run.parameters.get("logContacts"):
        displaced = {step: displacements_in(entry) for step, entry in read_entries(run.folder)}
    return [([log.positions[k], *(one[k] for one in log.catheters)], displaced.get(int(step), []))
            for k, step in enumerate(log.steps)]
