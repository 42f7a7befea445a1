"""Wires whose motion is written down in closed form: what distances between runs are tested on.

Sphere i at arc length s_i stands at y = size (1 - (s_i/L) (1 - cos(2 pi k/P))) after k steps, P steps to a swing, with
x and z at rest; the swing of a run with more solver steps is shorter. Between two runs the distance at equal moments is
therefore size (s_i/L) |cos - cos'|, and its mean over evenly spaced spheres half of that at the last one.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Wave:
    """Parameters of a run of so many steps; ``more`` are further ones, ``measured`` what stands in its summary."""

    steps: int = 100
    constraint_solver_steps: int = 500
    elements: int = 10
    displacement: float = 10.0
    time_step: float = 0.01
    total_mass: float = 0.01
    length: float = 300.0
    offset: float = -120.0
    direction: tuple[float, float, float] = (0.0, 1.0, 0.0)
    more: Mapping[str, Any] = field(default_factory=dict)
    measured: Mapping[str, Any] = field(default_factory=dict)
    turning: bool = False  # log orientations too: element j turned about itself by 0.01 (j + 1) rad a step

    @property
    def arc_length(self) -> np.ndarray:
        """Of each sphere, in units."""
        return self.length * np.arange(self.elements + 1) / self.elements

    def cosine(self, step: np.ndarray | float) -> np.ndarray:
        """Phase after so many steps; P = 12,000 solver steps, so that it does not hang on the time step."""
        return np.cos(2.0 * np.pi * np.asarray(step) * self.constraint_solver_steps / 12_000.0)

    @property
    def positions(self) -> np.ndarray:
        """Shape (steps + 1, n + 1, 3), in units."""
        positions = np.zeros((self.steps + 1, self.elements + 1, 3))
        swing = 1.0 - self.cosine(np.arange(self.steps + 1))[:, None]
        positions[..., 1] = self.displacement * (1.0 - self.arc_length / self.length * swing)
        positions[..., 2] = self.offset + self.arc_length
        return positions

    @property
    def parameters(self) -> dict:
        """parameters.json of this run."""
        return {
            "constraintSolverSteps": self.constraint_solver_steps, "numberRodElements": self.elements,
            "displacement": self.displacement, "displacementDirection": list(self.direction),
            "timeStep": self.time_step, "totalMass": self.total_mass, "guidewireLength": self.length,
            "guidewireOffset": self.offset, "sphereRadius": 5.0, "collisionStiffness": 0.01, "vessel": None,
            "elementContact": "barycentric", "displacementPerStep": 0.5, **self.more,
        }

    def write(self, folder: Path, milliseconds_per_step: float = 2.0) -> Path:
        """Writes a run folder."""
        folder.mkdir(parents=True)
        steps, positions = np.arange(self.steps + 1), self.positions
        np.savez(folder / "positions.npz", step=steps, totalTime=steps * self.time_step,
                 elapsedMilliseconds=steps * milliseconds_per_step, delta=np.full(len(steps), 0.5),
                 firstSphere=np.zeros(len(steps), int), positions=positions, velocities=np.zeros_like(positions),
                 **({"orientations": self._orientations()} if self.turning else {}))
        (folder / "parameters.json").write_text(json.dumps(self.parameters))
        summary = {"outcome": "finished", "steps": self.steps, "averageStepTime": milliseconds_per_step,
                   "medianStepTime": milliseconds_per_step, "passages": 0, "maxPenetration": 0.5, "driveShortfall": 0.0,
                   "driveAsked": 50.0, **self.measured,
                   "computationTime": self.steps * milliseconds_per_step / 1000.0, "complete": True}
        (folder / "summary.json").write_text(json.dumps(summary))
        return folder

    def _orientations(self) -> np.ndarray:
        """Shape (steps + 1, n, 4): x, y, z, w."""
        halves = 0.005 * np.arange(1, self.elements + 1) * np.arange(self.steps + 1)[:, None]
        still = np.zeros_like(halves)
        return np.stack([still, still, np.sin(halves), np.cos(halves)], axis=-1)
