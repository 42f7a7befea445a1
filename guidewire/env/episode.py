"""Results of an episode: success, safe success, wall forces, displacements."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from guidewire.sessions.session import State

# Largest force of a wall on one sphere of the wire that counts as safe, N: the "proposed 1.5 N vessel rupture
# threshold" with which two abstracts compare mean forces at the tip: 0.24 N in Robertshaw et al., "Reinforcement
# Learning for Safe Autonomous Two Device Navigation of Cerebral Vessels in Mechanical Thrombectomy" (2025), and 0.15 N
# in Robertshaw et al., "Toward Safe Autonomous Robotic Endovascular Interventions using World Models" (2026,
# arXiv:2604.20151). Read as abstracts: neither says what measurement is behind it. No lower limit with a source was
# found; another one may be chosen (`safe_force` of an environment).
SAFE_FORCE = 1.5


@dataclass
class Report:
    """An episode so far.

    Attributes
    ----------
    safe_force : limit of a safe success, N.
    success : whether the target was reached.
    end : "target", "time", "force", "simulation", or "" while it goes on.
    reason : what the simulation said where it ended the episode.
    time : simulated, s.
    left : distance to the target along the centreline, units.
    largest_force : of a wall on one sphere after any time step, N.
    impulse : of all walls, the sum over spheres and time steps of |F| dt, N s.
    path : of the tip, units.
    inserted, retracted, turned : distances of the hub forwards and backwards, m, and its rotation in both senses, rad.
    forces : largest force of a wall on one sphere after each time step, N.
    """

    safe_force: float
    success: bool = False
    end: str = ""
    reason: str = ""
    time: float = 0.0
    left: float = float("inf")
    largest_force: float = 0.0
    impulse: float = 0.0
    path: float = 0.0
    inserted: float = 0.0
    retracted: float = 0.0
    turned: float = 0.0
    forces: list[float] = field(default_factory=list)

    @property
    def safe_success(self) -> bool:
        """Whether the target was reached with no larger force on the way."""
        return self.success and self.largest_force <= self.safe_force

    def add(self, before: State, after: State, insertion: float, turn: float) -> float:
        """Take in a time step; returns its largest force, N.

        Parameters
        ----------
        before, after : the wire.
        insertion, turn : of the hub in it, m and rad.
        """
        forces = np.sqrt(np.einsum("ij,ij->i", after.contact_forces, after.contact_forces))
        largest = float(forces.max())
        dt = after.time - before.time
        self.forces.append(largest)
        self.time += dt
        self.largest_force = max(self.largest_force, largest)
        self.impulse += float(forces.sum()) * dt
        self.path += math.dist(after.positions[-1].tolist(), before.positions[-1].tolist())
        self.inserted += max(insertion, 0.0)
        self.retracted += max(-insertion, 0.0)
        self.turned += abs(turn)
        return largest

    def as_info(self) -> dict[str, Any]:
        """For `info`, forces as an array."""
        return {**vars(self), "safe_success": self.safe_success, "forces": np.array(self.forces)}
