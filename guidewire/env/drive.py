"""From actions to motions of the hub: limits, delay and noise of the drive."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from guidewire.env.options import need_count, need_number
from guidewire.env.spaces import Box, Discrete, Error, InvalidAction

_DIRECTIONS = tuple((speed, rotation) for speed in (0.0, 1.0, -1.0) for rotation in (0.0, 1.0, -1.0))


@dataclass(frozen=True)
class Drive:
    """What holds the hub.

    Attributes
    ----------
    actions : "continuous": speed and rotation rate as fractions of the largest, each from -1 to 1; "discrete": one
        of 9, 3 i + j with i and j from none, forwards, backwards of speed and rotation rate.
    step_time : simulated time of a step, s; a multiple of the scene's timeStep.
    speed, rotation : largest, m/s and rad/s; None: the task's.
    delay : steps by which a command comes late.
    noise : standard deviation of speed and of rotation rate, as a fraction of each.
    retraction : whether the hub may be pulled.

    Raises
    ------
    Error : one of them is not allowed.
    """

    actions: str = "continuous"
    step_time: float = 0.14
    speed: float | None = None
    rotation: float | None = None
    delay: int = 0
    noise: float = 0.0
    retraction: bool = True

    def __post_init__(self) -> None:
        if self.actions not in ("continuous", "discrete"):
            raise Error(f"actions = {self.actions!r} is not allowed: needs \"continuous\" or \"discrete\"")
        need_number("step_time", self.step_time, 0.0, above=True)
        need_count("delay", self.delay, 0)
        need_number("noise", self.noise, 0.0)
        for name, value in (("speed", self.speed), ("rotation", self.rotation)):
            if value is not None:
                need_number(name, value, 0.0, above=True)

    def space(self) -> Box | Discrete:
        """Of its actions."""
        if self.actions == "discrete":
            return Discrete(len(_DIRECTIONS))
        return Box(-1.0, 1.0, (2,), np.float32)

    def command(self, action: object) -> tuple[float, float]:
        """Fractions of the largest speed and rotation rate that an action stands for.

        Raises
        ------
        InvalidAction : it has another shape, is no number, or is out of range.
        """
        if self.actions == "discrete":
            whole = isinstance(action, (int, np.integer)) and not isinstance(action, bool) or (
                isinstance(action, np.ndarray) and action.shape == () and np.issubdtype(action.dtype, np.integer))
            if not whole or not 0 <= int(action) < len(_DIRECTIONS):
                raise InvalidAction(f"action {action!r}: needs a whole number from 0 to {len(_DIRECTIONS) - 1}")
            return _DIRECTIONS[int(action)]
        try:
            numbers = np.asarray(action, dtype=float)
        except (TypeError, ValueError) as error:
            raise InvalidAction(f"action {action!r}: needs 2 numbers from -1 to 1") from error
        if numbers.shape != (2,):
            raise InvalidAction(f"action of shape {numbers.shape}: needs shape (2,)")
        if not (np.abs(numbers) <= 1.0).all():    # NaN is not, either
            raise InvalidAction(f"action {numbers.tolist()}: needs numbers from -1 to 1")
        return float(numbers[0]), float(numbers[1])


class DriveState:
    """A drive within an episode.

    Parameters
    ----------
    drive : its properties.
    speed, rotation : largest, m/s and rad/s.
    """

    def __init__(self, drive: Drive, speed: float, rotation: float) -> None:
        self._drive = drive
        self._speed, self._rotation = speed * drive.step_time, rotation * drive.step_time
        self._waiting: deque[tuple[float, float]] = deque([(0.0, 0.0)] * drive.delay)

    def motion(self, command: tuple[float, float], random: np.random.Generator) -> tuple[float, float]:
        """Insertion, m, and turn, rad, of this step, before what limits the insertion."""
        self._waiting.append(command)
        speed, rotation = self._waiting.popleft()
        if speed < 0.0 and not self._drive.retraction:
            speed = 0.0
        if self._drive.noise > 0.0:
            one, other = random.normal(1.0, self._drive.noise, 2).tolist()
            speed, rotation = speed * one, rotation * other
        return self._speed * speed, self._rotation * rotation
