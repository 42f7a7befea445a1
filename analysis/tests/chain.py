"""An independent rod for these tests: the seed's method for motion along the wire alone, where it is a 1-D chain.

All orientations stay at identity because a stretch error along d3 turns nothing, so with G = (z_{j+1} - z_j)/l - 1 and
D = w_j + w_{j+1} + 4 l^2 each iteration moves z_j by +g w_j l G/D and z_{j+1} by -g w_{j+1} l G/D, element by element
(thesis, section 2.1; Kugelstadt and Schoemer 2016). Verlet prediction, the first sphere displaced once and then held.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import zip_longest
from pathlib import Path
from typing import Protocol

import numpy as np

from guidewire.studies.keys import run_key
from guidewire.studies.table import Case

EPSILON = 0.001  # units
HOLD = 100  # steps


@dataclass(frozen=True)
class Chain:
    """Parameters of a run, Table 4.1 by default, and its motion up to the steady state or ``most_steps``.

    z has shape (steps + 1, n + 1), prediction_error (steps + 1,), both in units; the steady state is -1 where none.
    """

    constraint_solver_steps: int = 500
    elements: int = 30
    displacement: float = 10.0
    time_step: float = 0.01
    total_mass: float = 0.01
    length: float = 300.0
    offset: float = -120.0
    stretch_gain: float = 0.1
    most_steps: int = 4000
    z: np.ndarray = field(init=False, repr=False)
    prediction_error: np.ndarray = field(init=False, repr=False)
    steady_state_step: int = field(init=False)

    def __post_init__(self) -> None:
        for name, value in zip(("z", "prediction_error", "steady_state_step"), self._simulate()):
            object.__setattr__(self, name, value)

    @property
    def steps(self) -> int:
        """Steps made."""
        return len(self.z) - 1

    def _simulate(self) -> tuple[np.ndarray, np.ndarray, int]:
        n, iterations = self.elements, self._iterations()
        u = self.displacement * (np.arange(n + 1) == 0)
        old, track, errors = u, [u], [0.0]
        been_above, below = False, 0
        while len(track) <= self.most_steps and below < HOLD:
            predicted = 2.0 * u - old
            old, u = u, iterations @ predicted
            track.append(u)
            errors.append(abs(predicted[n] - u[n]))
            been_above = been_above or errors[-1] >= EPSILON
            below = below + 1 if been_above and errors[-1] < EPSILON else 0
        return self.rest + track, np.array(errors), len(track) - HOLD if below == HOLD else -1

    def _iterations(self) -> np.ndarray:
        """All iterations of a step as a linear map of the displacements z - rest, shape (n + 1, n + 1): on a straight
        line each constraint is linear in the positions."""
        n, l = self.elements, self.length / self.elements
        weights = [0.0] + [(n + 1) / self.total_mass] * n
        u = np.eye(n + 1)
        for j, (w, v) in enumerate(zip(weights, weights[1:])):
            step = self.stretch_gain / (w + v + 4 * l * l) * (u[j + 1] - u[j])
            u[j] += w * step
            u[j + 1] -= v * step
        return np.linalg.matrix_power(u, self.constraint_solver_steps)

    @property
    def time(self) -> np.ndarray:
        """In-game time of each entry, in s."""
        return np.arange(self.steps + 1) * self.time_step

    @property
    def rest(self) -> np.ndarray:
        """z of each sphere before the displacement, in units."""
        return self.offset + self.length * np.arange(self.elements + 1) / self.elements

    @property
    def parameters(self) -> dict:
        """parameters.json of this run."""
        return {
            "constraintSolverSteps": self.constraint_solver_steps,
            "numberRodElements": self.elements,
            "displacement": self.displacement,
            "displacementDirection": [0, 0, 1],
            "timeStep": self.time_step,
            "totalMass": self.total_mass,
            "guidewireLength": self.length,
            "guidewireOffset": self.offset,
            "stretchStiffness": self.stretch_gain,
            "deltaThreshold": EPSILON,
            "steadyStateHold": HOLD,
        }

    def entry(self, step: int, milliseconds_per_step: float = 2.0, spheres: list[int] | None = None) -> dict:
        """One entry of positions.json."""
        z, last = self.z[step], self.z[max(step - 1, 0)]
        return {
            "totalTime": step * self.time_step,
            "elapsedMilliseconds": step * milliseconds_per_step,
            "delta": float(self.prediction_error[step]),
            "sphere": {
                str(i): {
                    "x": 0.0, "y": 0.0, "z": float(z[i]),
                    "vx": 0.0, "vy": 0.0, "vz": float((z[i] - last[i]) / self.time_step),
                }
                for i in (range(self.elements + 1) if spheres is None else spheres)
            },
        }

    def log(self, milliseconds_per_step: float = 2.0) -> str:
        """positions.json as the runner writes it, one entry a line."""
        lines = (f'"{k}": {json.dumps(self.entry(k, milliseconds_per_step))}' for k in range(self.steps + 1))
        return "{\n" + ",\n".join(lines) + "\n}\n"

    def write(self, folder: Path, milliseconds_per_step: float = 2.0) -> Path:
        """Writes a run folder."""
        folder.mkdir(parents=True)
        (folder / "positions.json").write_text(self.log(milliseconds_per_step))
        (folder / "parameters.json").write_text(json.dumps(self.parameters))
        steady = self.steady_state_step
        summary = {
            "outcome": "finished" if steady < 0 else "converged",
            "steps": self.steps,
            "averageStepTime": milliseconds_per_step,
            "medianStepTime": milliseconds_per_step,
            "computationTime": self.steps * milliseconds_per_step / 1000.0,
            "steadyStateStep": steady,
            "complete": True,
        }
        (folder / "summary.json").write_text(json.dumps(summary))
        return folder


def small(**changed: float) -> Chain:
    """A quick run of the same kind: 10 elements, 100 solver steps."""
    return Chain(**{"constraint_solver_steps": 100, "elements": 10, **changed})  # type: ignore[arg-type]


def write_log(folder: Path, positions: Sequence, time_step: float, parts: Sequence[dict] = ()) -> None:
    """Writes positions.json of spheres without velocities: positions of shape (k, n + 1, 3); parts are what else the
    entries hold."""
    numbers = ("x", "y", "z", "vx", "vy", "vz")
    entries = {str(k): {"totalTime": time_step * k, "elapsedMilliseconds": 0.0, "delta": 0.0,
                        "sphere": {str(i): dict(zip(numbers, (*place, 0.0, 0.0, 0.0)))
                                   for i, place in enumerate(spheres)}, **part}
               for k, (spheres, part) in enumerate(zip_longest(positions, parts, fillvalue={}))}
    (folder / "positions.json").write_text(json.dumps(entries))


class WrittenRun(Protocol):
    """What a study is made of."""

    @property
    def parameters(self) -> dict:
        """parameters.json of this run."""

    def write(self, folder: Path, milliseconds_per_step: float = 2.0) -> Path:
        """Writes a run folder."""


def write_study(
    folder: Path, name: str, key: str | None, chains: Sequence[WrittenRun], repeats: int = 3,
    variants: Sequence[str] = (),
) -> Path:
    """Writes a study folder: each run and timed repeats of it, of 2, 3, 4 ... ms a step, and study.json.

    ``key`` is the study's axis; ``variants`` are the runs' where that does not tell them apart.
    """
    rows = []
    for index, chain in enumerate(chains):
        values = {} if key is None else {key: chain.parameters[key]}
        case = Case(run_key(variants[index] if variants else "", values), values)
        for repeat in (None, *range(1, repeats + 1)):
            place = case.key if repeat is None else f"{case.key}-repeat-{repeat}"
            chain.write(folder / place, 2.0 if repeat is None else 1.0 + repeat)
            rows.append({"key": case.key, "variant": variants[index] if variants else "", "values": values,
                         "parameters": "params/default.json", "overrides": values, "folder": place,
                         "repeat": repeat})
    (folder / "study.json").write_text(json.dumps({"study": name, "runs": rows}))
    return folder
