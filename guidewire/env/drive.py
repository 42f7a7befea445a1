"""From actions to motions of the hubs: limits, delay and noise of the drive."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from guidewire.env.instruments import of_each
from guidewire.env.options import need_count, need_number
from guidewire.env.spaces import Box, Discrete, Error, InvalidAction

if TYPE_CHECKING:
    from guidewire.env.task import Task

_DIRECTIONS = tuple((speed, rotation) for speed in (0.0, 1.0, -1.0) for rotation in (0.0, 1.0, -1.0))
Command = list[tuple[float, float]]  # of each hub


@dataclass(frozen=True)
class Drive:
    """What holds the hubs.

    Attributes
    ----------
    actions : "continuous": of each hub, the wire's first, speed and rotation rate as fractions of the largest, each
        from -1 to 1; "discrete": of each hub one of 9, 3 i + j with i and j from none, forwards, backwards of speed and
        rotation rate; with k hubs a number below 9^k, whose digits to the base 9 these are, the wire's the lowest.
    step_time : simulated time of a step, s; a multiple of the scene's timeStep.
    speed, rotation : largest, m/s and rad/s, of all hubs or of each; None: the task's.
    delay : steps by which a command comes late.
    noise : standard deviation of speed and of rotation rate, as a fraction of each.
    retraction : whether the hubs may be pulled.
    stops_at_ends : whether a hub stops where the tip of its instrument meets an open end of the vessel.

    Raises
    ------
    Error : one of them is not allowed.
    """

    actions: str = "continuous"
    step_time: float = 0.14
    speed: float | Sequence[float] | None = None
    rotation: float | Sequence[float] | None = None
    delay: int = 0
    noise: float = 0.0
    retraction: bool = True
    stops_at_ends: bool = False

    def __post_init__(self) -> None:
        if self.actions not in ("continuous", "discrete"):
            raise Error(f"actions = {self.actions!r} is not allowed: needs \"continuous\" or \"discrete\"")
        need_number("step_time", self.step_time, 0.0, above=True)
        need_count("delay", self.delay, 0)
        need_number("noise", self.noise, 0.0)
        for name, value in (("speed", self.speed), ("rotation", self.rotation)):
            for one in [] if value is None else of_each(value, 1):
                need_number(name, one, 0.0, above=True)

    def check(self, hubs: int) -> None:
        """Raises Error where lists are not for so many hubs."""
        for name, value in (("speed", self.speed), ("rotation", self.rotation)):
            if value is not None and len(of_each(value, hubs)) != hubs:
                raise Error(f"{name} = {value!r} is not allowed: needs a number, or one for each of the {hubs} hubs")

    def limits(self, task: Task) -> tuple[list[float], list[float]]:
        """Largest speed, m/s, and rotation rate, rad/s, of each hub: its own, else the task's."""
        return (of_each(task.speed if self.speed is None else self.speed, task.hubs),
                of_each(task.rotation if self.rotation is None else self.rotation, task.hubs))

    def space(self, hubs: int = 1) -> Box | Discrete:
        """Return the space of its actions."""
        if self.actions == "discrete":
            return Discrete(len(_DIRECTIONS)**hubs)
        return Box(-1.0, 1.0, (2 * hubs,), np.float32)

    def command(self, action: object, hubs: int = 1) -> Command:
        """Fractions of the largest speed and rotation rate that an action stands for, of each hub.

        Raises
        ------
        InvalidAction : it has another shape, is no number, or is out of range.
        """
        if self.actions == "discrete":
            whole = isinstance(action, (int, np.integer)) and not isinstance(action, bool) or (
                isinstance(action, np.ndarray) and action.shape == () and np.issubdtype(action.dtype, np.integer))
            if not whole or not 0 <= int(action) < len(_DIRECTIONS)**hubs:
                raise InvalidAction(f"action {action!r}: needs a whole number from 0 to {len(_DIRECTIONS)**hubs - 1}")
            return [_DIRECTIONS[int(action) // len(_DIRECTIONS)**k % len(_DIRECTIONS)] for k in range(hubs)]
        try:
            numbers = np.asarray(action, dtype=float)
        except (TypeError, ValueError) as error:
            raise InvalidAction(f"action {action!r}: needs {2 * hubs} numbers from -1 to 1") from error
        if numbers.shape != (2 * hubs,):
            raise InvalidAction(f"action of shape {numbers.shape}: needs shape ({2 * hubs},)")
        if not (np.abs(numbers) <= 1.0).all():    # NaN is not, either
            raise InvalidAction(f"action {numbers.tolist()}: needs numbers from -1 to 1")
        listed = numbers.tolist()
        return list(zip(listed[::2], listed[1::2]))


class DriveState:
    """A drive within an episode.

    Parameters
    ----------
    drive : its properties.
    speeds, rotations : largest of each hub, m/s and rad/s.
    noise : in place of the drive's.

    Attributes
    ----------
    waiting : commands that are not made yet.
    """

    def __init__(self, drive: Drive, speeds: Sequence[float], rotations: Sequence[float], noise: float | None = None
                 ) -> None:
        self._retraction, self._noise = drive.retraction, drive.noise if noise is None else noise
        self._largest = [(speed * drive.step_time, rotation * drive.step_time)
                         for speed, rotation in zip(speeds, rotations)]
        self.waiting: deque[Command] = deque([[(0.0, 0.0)] * len(self._largest)] * drive.delay)

    def motion(self, command: Command, random: np.random.Generator) -> list[tuple[float, float]]:
        """Insertion, m, and turn, rad, of each hub in this step, before what limits the insertion."""
        self.waiting.append(command)
        motions = []
        for (speed, rotation), (most, most_turn) in zip(self.waiting.popleft(), self._largest):
            if speed < 0.0 and not self._retraction:
                speed = 0.0
            if self._noise > 0.0:
                one, other = random.normal(1.0, self._noise, 2).tolist()
                speed, rotation = speed * one, rotation * other
            motions.append((most * speed, most_turn * rotation))
        return motions
