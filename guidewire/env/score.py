"""Episodes of a policy, and their results."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from guidewire.env.environment import Environment
from guidewire.env.recorded import digest_of


class Policy(Protocol):
    """What acts. A policy keeps nothing from one episode to the next but what it has learned."""

    def reset(self, observation: Any) -> None:
        """An episode begins."""

    def act(self, observation: Any) -> Any:
        """Return the next action."""


@dataclass(frozen=True)
class Played:
    """An episode.

    Attributes
    ----------
    seed : of its reset.
    total : of its rewards.
    report : as in `info`.
    digest : of the wire at the end.
    faults : what is not as it must be: numbers that are not finite, spaces that do not hold.
    """

    seed: int
    total: float
    report: dict[str, Any]
    digest: str
    faults: list[str]


def play(environment: Environment, policy: Policy, seed: int) -> Played:
    """Play one episode."""
    observation, _ = environment.reset(seed=seed)
    policy.reset(observation)
    total, faults, steps = 0.0, [], 0
    while True:
        if not environment.observation_space.contains(observation) or not _is_finite(observation):
            faults.append(f"step {steps}: observation {observation}")
        observation, reward, terminated, truncated, info = environment.step(policy.act(observation))
        total, steps = total + reward, steps + 1
        if not np.isfinite(reward):
            faults.append(f"step {steps}: reward {reward}")
        if terminated or truncated:
            report = info["report"]
            faults += _faults_of(environment, report, terminated, truncated)
            return Played(seed, total, report, digest_of(environment.session.state), faults)


def digest(played: Sequence[Played]) -> str:
    """A sum over the ends of all episodes."""
    return hashlib.sha256("".join(one.digest for one in played).encode()).hexdigest()[:16]


def _is_finite(observation: Any) -> bool:
    parts = observation.values() if isinstance(observation, dict) else [observation]
    return all(np.isfinite(part).all() for part in parts)


def _faults_of(environment: Environment, report: dict[str, Any], terminated: bool, truncated: bool) -> list[str]:
    """Return what an outcome claims and the wire does not show."""
    faults = []
    scene = environment.task
    tip = environment.session.state.positions[-1]
    goal = environment.target_position
    if report["success"] != (report["end"] == "target") or terminated == truncated:
        faults.append(f"end {report['end']}, success {report['success']}, terminated {terminated}, truncated "
                      f"{truncated}")
    # Of a path of length d between two points the chord is at most d; the tip is within a radius of its own place.
    if report["success"] and np.linalg.norm(tip - goal) > scene.tolerance + environment.widest:
        faults.append(f"target reached, and the tip is {np.linalg.norm(tip - goal):.3g} units from it")
    if report["end"] == "time" and not scene.time - environment.drive.step_time < report["time"] <= scene.time + 1e-6:
        faults.append(f"out of time after {report['time']:g} s of {scene.time:g} s")
    if not all(np.isfinite(report[key]) for key in ("time", "left", "largest_force", "impulse", "path")):
        faults.append(f"not finite: {report}")
    if report["end"] == "left the vessel" and (report["success"] or not terminated):
        faults.append("out of the vessel, and the episode has not ended so")
    if len(report["forces"]) and report["largest_force"] != max(report["forces"]):
        faults.append("largest force is not that of the forces over time")
    return faults
