"""Baseline policies: turn and retry, the same with catheters that follow, and random actions."""

from __future__ import annotations

from typing import Any

import numpy as np

from guidewire.env.environment import Environment
from guidewire.env.instruments import of_each
from guidewire.env.observation import DEFAULT
from guidewire.env.task import Task


class TurnAndRetry:
    """Pushes; where the way to the target has become longer, or no shorter for a while, it pulls back until the tip is
    out of the wrong branch and before its mouth, turns, and pushes again. At a target that is to be held it rests.

    Parameters
    ----------
    environment : with continuous actions, and "distance" and "hub" in its observation.
    wrong : by which the distance has grown in a wrong branch, units, beyond what it grows by at a branch's mouth: its
        centreline begins on that of its parent, so the place of a tip that enters it, or only passes it, jumps by
        about the parent's radius; one and a half of the largest radius are allowed for.
    patience : steps without progress.
    back : from the mouth, units.
    turn : between two tries, rad; by the golden angle no two tries have the same side.
    hub : number of the instrument that does so.
    """

    def __init__(self, environment: Environment, wrong: float = 3.0, patience: int = 6, back: float = 12.0,
                 turn: float = np.pi * (3.0 - 5.0**0.5), hub: int = 0) -> None:
        self._environment, self._wrong, self._patience = environment, wrong, patience
        self._back, self._turn = back, turn
        _, rates = environment.drive.limits(environment.task)
        self._hub = hub
        self._turn_of_step = rates[hub] * environment.drive.step_time

    def reset(self, observation: Any) -> None:
        """Begin another episode."""
        self._best, self._waited = float(np.ravel(observation["distance"])[self._hub]), 0
        self._limit = self._wrong + 1.5 * self._environment.widest
        self._mouth: float | None = None    # least distance on the way back
        self._to_turn = 0.0

    def act(self, observation: Any) -> np.ndarray:
        """Return the next action."""
        distance = float(np.ravel(observation["distance"])[self._hub])
        insertion = float(np.ravel(observation["hub"])[2 * self._hub])
        if self._mouth is not None:
            self._mouth = min(self._mouth, distance)
            if insertion > 0.5 and distance < self._mouth + self._back:
                return np.array([-1.0, 0.0], dtype=np.float32)
            self._mouth, self._to_turn = None, self._turn
        if self._environment.task.hold and distance <= 0.8 * self._environment.task.tolerance and self._hub == 0:
            return np.zeros(2, dtype=np.float32)
        if self._to_turn > 1e-9:
            part = min(1.0, self._to_turn / self._turn_of_step)
            self._to_turn -= part * self._turn_of_step
            self._best, self._waited = distance, 0
            return np.array([0.0, part], dtype=np.float32)
        if distance < self._best - 0.2:
            self._best, self._waited = distance, 0
        else:
            self._waited += 1
        if distance > self._best + self._limit or self._waited > self._patience:
            self._mouth = distance
            return np.array([-1.0, 0.0], dtype=np.float32)
        return np.array([1.0, 0.0], dtype=np.float32)


class Follow(TurnAndRetry):
    """The wire turns and retries, and waits at the target; catheters follow it: each goes on as long as what is inside
    is ahead of it by more than `ahead`, and back as long as that is nearer than `least`.

    Parameters
    ----------
    environment : with "overlap" in its observation besides.
    ahead, least : units, by which the tip inside is beyond the catheter's; None: half of what the task allows it to
        stay behind, at most 15, and a third of that.
    options : of TurnAndRetry.
    """

    def __init__(self, environment: Environment, ahead: float | None = None, least: float | None = None,
                 **options: Any) -> None:
        super().__init__(environment, **options)
        within = [one for one in of_each(environment.task.follow, environment.hubs - 1) if one is not None]
        self._ahead = min([15.0, *(0.5 * one for one in within)]) if ahead is None else ahead
        self._least = self._ahead / 3.0 if least is None else least

    def act(self, observation: Any) -> np.ndarray:
        """Return the next action."""
        is_there = observation["distance"][0] <= self._environment.task.tolerance
        actions = [np.zeros(2, dtype=np.float32) if is_there else super().act(observation)]
        for extension, _ in observation["overlap"]:
            push = 1.0 if extension > self._ahead else -1.0 if extension < self._least else 0.0
            actions.append(np.array([push, 0.0], dtype=np.float32))
        return np.concatenate(actions)


class Lead(TurnAndRetry):
    """The catheter turns and retries, with the wire `behind` in it, so that its tip has its own bend; once it is as
    near to the target as the task asks for, the wire goes on. Where the wire comes no nearer to the target, or goes
    elsewhere, the catheter tries again.

    Parameters
    ----------
    environment : of one catheter, with "overlap" in its observation besides.
    behind : units, from the catheter's tip to the wire's.
    still : steps of the wire without progress.
    options : of TurnAndRetry.
    """

    def __init__(self, environment: Environment, behind: float = 60.0, still: int = 12, **options: Any) -> None:
        super().__init__(environment, hub=1, **options)
        self._behind, self._still = behind, still
        self._near = of_each(environment.task.follow, 1)[0] or environment.task.tolerance

    def reset(self, observation: Any) -> None:
        """Begin another episode."""
        super().reset(observation)
        self._nearest: float | None = None    # distance of the wire since it goes on
        self._stood = 0

    def act(self, observation: Any) -> np.ndarray:
        """Return the next action."""
        left, extension = observation["distance"], observation["overlap"][0][0]
        is_trying = self._mouth is not None or self._to_turn > 1e-9
        if not is_trying and (left[1] <= 0.8 * self._near or extension > 0.0 and left[1] <= self._near):
            is_nearer = self._nearest is None or left[0] < self._nearest - 0.2
            self._nearest, self._stood = (left[0], 0) if is_nearer else (self._nearest, self._stood + 1)
            if left[0] <= self._environment.task.tolerance:
                return np.zeros(4, dtype=np.float32)
            if left[0] <= self._nearest + self._limit and self._stood <= self._still:
                return np.array([1.0, 0.0, 0.0, 0.0], dtype=np.float32)
            self._mouth = float(left[1])
        self._nearest, self._stood = None, 0
        catheter = super().act(observation)
        wire = 1.0 if extension < -self._behind - 5.0 else -1.0 if extension > -self._behind + 5.0 else catheter[0]
        return np.array([wire, 0.0, *catheter], dtype=np.float32)


def parts_of(task: Task) -> tuple[str, ...]:
    """Return the parts of an observation that the policy of a task needs."""
    return (*DEFAULT, "overlap") if task.hubs > 1 else DEFAULT


def baseline_of(environment: Environment) -> TurnAndRetry:
    """Return the policy that comes with an environment's task."""
    name = environment.task.baseline or ("follow" if environment.hubs > 1 else "retry")
    return {"retry": TurnAndRetry, "follow": Follow, "lead": Lead}[name](environment)


class Chance:
    """Even random actions, held for some steps, more forwards than backwards.

    Parameters
    ----------
    environment : whose actions.
    seed : of all of them.
    """

    def __init__(self, environment: Environment, seed: int = 0) -> None:
        self._space, self._seed = environment.action_space, seed
        self._episode = -1

    def reset(self, observation: Any) -> None:
        """Another episode, with a seed of its own."""
        self._episode += 1
        self._random = np.random.default_rng([self._seed, self._episode])
        self._held = 0

    def act(self, observation: Any) -> Any:
        """Return the next action."""
        if self._held == 0:
            self._held = int(self._random.integers(1, 12))
            if hasattr(self._space, "n"):
                self._action = int(self._random.integers(self._space.n))
            else:
                hubs = self._space.shape[0] // 2
                self._action = self._random.uniform([-0.6, -1.0] * hubs, [1.0] * 2 * hubs).astype(np.float32)
        self._held -= 1
        return self._action
