"""Results of an episode: success, safe success, wall forces, displacements."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from guidewire.env.instruments import Instrument, names_of

# Largest force of a wall on one sphere of an instrument that counts as safe, N: the "proposed 1.5 N vessel rupture
# threshold" with which two abstracts compare mean forces at the tip: 0.24 N in Robertshaw et al., "Reinforcement
# Learning for Safe Autonomous Two Device Navigation of Cerebral Vessels in Mechanical Thrombectomy" (2025), and 0.15 N
# in Robertshaw et al., "Toward Safe Autonomous Robotic Endovascular Interventions using World Models" (2026,
# arXiv:2604.20151). Read as abstracts: neither says what measurement is behind it. No lower limit with a source was
# found; another one may be chosen (`safe_force` of an environment).
SAFE_FORCE = 1.5


@dataclass
class Part:
    """What one instrument did and felt in an episode so far.

    Attributes
    ----------
    left : distance of its tip to the target along the centreline, units.
    largest_force, strand_force, impulse, path, inserted, retracted, turned : as of Report, its own.
    """

    left: float = float("inf")
    largest_force: float = 0.0
    strand_force: float = 0.0
    impulse: float = 0.0
    path: float = 0.0
    inserted: float = 0.0
    retracted: float = 0.0
    turned: float = 0.0


@dataclass
class Report:
    """An episode so far.

    Attributes
    ----------
    safe_force : limit of a safe success, N.
    success : whether the target was reached.
    end : "target", "time", "force", "left the vessel", "simulation", or "" while it goes on.
    reason : what the simulation said where it ended the episode.
    time : simulated, s.
    largest_force : of a wall on one sphere of any instrument after any time step, N.
    strand_force : largest force of an instrument's own strands on one of its spheres after any time step, N.
    impulse : of all walls, the sum over spheres and time steps of |F| dt, N s.
    forces : largest force of a wall on one sphere after each time step, N.
    parts : of each instrument, the wire first.
    contrast : agent that was injected, ml.
    exposures : X-ray pictures that observations had, each plane for itself.
    way : of the wire's tip to the target along the centreline where the episode began, units.
    left, path : of the wire: distance to the target along the centreline, and way of the tip, units.
    inserted, retracted, turned : of the wire: distances of the hub forwards and backwards, m, and its rotation in both
        senses, rad.
    """

    safe_force: float
    success: bool = False
    end: str = ""
    reason: str = ""
    time: float = 0.0
    contrast: float = 0.0
    exposures: int = 0
    way: float = 0.0
    forces: list[float] = field(default_factory=list)
    parts: list[Part] = field(default_factory=lambda: [Part()])

    largest_force = property(lambda self: max(part.largest_force for part in self.parts))
    strand_force = property(lambda self: max(part.strand_force for part in self.parts))
    impulse = property(lambda self: sum(part.impulse for part in self.parts))
    left, path, inserted, retracted, turned = (    # of the wire
        property(lambda self, name=name: getattr(self.parts[0], name))
        for name in ("left", "path", "inserted", "retracted", "turned"))

    @property
    def safe_success(self) -> bool:
        """Whether the target was reached with no larger force on the way."""
        return self.success and self.largest_force <= self.safe_force

    def add(self, dt: float, before: Sequence[Instrument], after: Sequence[Instrument]) -> list[float]:
        """Take in a time step, s, from the instruments before and after it; returns the largest force on each, N."""
        most = []
        for part, one, other in zip(self.parts, before, after):
            forces = np.sqrt(np.einsum("ij,ij->i", other.contact_forces, other.contact_forces))
            largest = float(forces.max())
            most.append(largest)
            part.largest_force = max(part.largest_force, largest)
            if other.strand_forces is not None:
                part.strand_force = max(part.strand_force, float(np.linalg.norm(other.strand_forces, axis=1).max()))
            part.impulse += float(forces.sum()) * dt
            part.path += math.dist(other.positions[-1].tolist(), one.positions[-1].tolist())
            insertion = other.hub.insertion - one.hub.insertion    # less than asked for where another hub stops it
            part.inserted += max(insertion, 0.0)
            part.retracted += max(-insertion, 0.0)
            part.turned += abs(other.hub.turn - one.hub.turn)
        self.forces.append(max(most))
        self.time += dt
        return most

    def as_info(self) -> dict[str, Any]:
        """Return for `info` numbers, "forces" as a list, and of several instruments "instruments" by name."""
        shown = {key: value for key, value in vars(self).items() if key not in ("parts", "forces")}
        shown |= {key: getattr(self, key) for key in ("safe_success", "left", "largest_force", "strand_force",
                                                      "impulse", "path", "inserted", "retracted", "turned")}
        shown["forces"] = list(self.forces)
        if len(self.parts) > 1:
            shown["instruments"] = {name: dict(vars(part)) for name, part in zip(names_of(len(self.parts)), self.parts)}
        return shown
