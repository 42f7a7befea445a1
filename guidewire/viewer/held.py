"""The instruments of a run steered by a page: which one is held, and what is asked of each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from guidewire.sessions.session import State

Motion = Sequence[tuple[float, float]]    # push (units) and turn (rad) of each hub


class HeldInstruments:
    """The wire and the catheters of a run; one of their hubs is held at a time.

    Parameters
    ----------
    described : as by `Session.describe`.
    held : number of the one whose hub is held.

    Attributes
    ----------
    aim : turn that the held hub goes to, rad; None: it turns as the hand does.
    """

    def __init__(self, described: Mapping[str, Any] | None = None, held: int = 0) -> None:
        self.held = held
        self.aim: float | None = None
        self._instruments: Sequence[Mapping[str, Any]] = () if described is None else described["instruments"]

    def exchange(self, described: Mapping[str, Any]) -> None:
        """Another instrument is in the place of one, and the run goes on."""
        self.aim = None
        self._instruments = described["instruments"]

    def hold(self, number: int) -> None:
        """Take another one; raises ValueError where there is none of this number."""
        self._check(number)
        self.held, self.aim = number, None

    def key_of(self, number: int, name: str) -> str:
        """The key that names an instrument; raises ValueError where there is none or it cannot have this name."""
        self._check(number)
        if name not in self._instruments[number]["choices"]:
            raise ValueError("no such instrument")
        return self._instruments[number]["key"]

    def _check(self, number: int) -> None:
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(self._instruments):
            raise ValueError("no such instrument")

    def towards_aim(self, state: State, steps: int, most: float) -> float:
        """Turn in each of so many steps that brings the held hub to its aim, rad, of at most this size."""
        hub = state.hub if self.held == 0 else state.catheters[self.held - 1]
        if self.aim is None or hub is None:
            return 0.0
        return min(max((self.aim - hub.turn) / steps, -most), most)

    def motion(self, hand: tuple[float, float], other: tuple[float, float]) -> Motion:
        """What both hands ask of each hub: one of the held, the other of the next one."""
        motion = [(0.0, 0.0)] * len(self._instruments)
        if len(motion) > 1:
            motion[(self.held + 1) % len(motion)] = other
        motion[self.held] = hand
        return motion

    def status(self) -> dict[str, Any]:
        """What a page shows of the instruments."""
        return {"held": self.held, "instruments": [one["title"] for one in self._instruments],
                "chosen": [one["name"] for one in self._instruments],
                "named": [one["choices"] for one in self._instruments if one["choices"]]}


class SteeredCalls:
    """Calls of `Session.step` by which a page steers a run, from its start.

    Attributes
    ----------
    made : push (units), turn (rad) and steps of each; with catheters a list of pushes and one of turns.
    state : after them; None before the first.
    problem : why they do not repeat the run, in one phrase; empty where they do.
    """

    def __init__(self) -> None:
        self.begin()

    def begin(self) -> None:
        """The run is at its start."""
        self.made: list[tuple[Any, Any, int]] = []
        self.state: State | None = None
        self.problem = ""

    def add(self, motion: Motion, steps: int, state: State) -> None:
        """Note a call that asked for so many steps with this motion in each."""
        pushes, turns = ([steps * one for one in part] for part in zip(*motion))
        self.made.append((pushes, turns, steps) if len(motion) > 1 else (pushes[0], turns[0], steps))
        self.state = state
