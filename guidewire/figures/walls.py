"""The walls of a run as triangles, from the runner, which alone knows what its parameters mean."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.logs.runs import PARAMETERS_NAME, Run
from guidewire.logs.surfaces import Surface
from guidewire.prepare import PreparationError


def read_walls(build_runner: Callable[[], list[str]], run: Run, middle: np.ndarray, reach: float) -> list[Surface]:
    """The vessel, where the run has one, and its obstacles; as `walls_of` with the run's own parameters."""
    return walls_of(build_runner, run.parameters, run.folder / PARAMETERS_NAME, middle, reach)


def walls_of(build_runner: Callable[[], list[str]], parameters: Mapping[str, Any], file: Path, middle: np.ndarray,
             reach: float) -> list[Surface]:
    """The vessel, where there is one, and obstacles.

    Parameters
    ----------
    build_runner : returns the command that starts the runner; not called where there are no walls.
    parameters : effective values.
    file : the parameter file that they are of.
    middle : ndarray (3,), units, and
    reach : units: of a wall without end what is so near.

    Raises
    ------
    PreparationError : the runner cannot read the file, or a mesh that it names.
    """
    if not parameters.get("vessel") and not parameters.get("obstacles"):
        return []
    numbers = [repr(float(number)) for number in (*middle, reach)]
    command = [*build_runner(), "--walls", str(file), *numbers]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise PreparationError(done.stderr.strip().removeprefix("guidewire: "))
    walls = []
    for wall in json.loads(done.stdout):
        vertices = np.array(wall["vertices"], dtype=float)
        walls.append(Surface(vertices, np.array(wall["triangles"], dtype=int), np.zeros(len(vertices))))
    return walls
