"""The instruments of a run steered by a page: which one is selected, and the steering of each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from guidewire.sessions.session import Session, State
from guidewire.sessions.steered import Steered, exact_push, exact_turn


class HeldInstruments:
    """The wire and the catheters of a run; one of their hubs is held at a time.

    Attributes
    ----------
    held : number of the one whose hub is held.
    aim : turn that the held hub goes to, rad; None: it turns as the hand does.
    steered : what was steered of each of them since the run's start; empty before the first run.
    """

    def __init__(self) -> None:
        self.held = 0
        self.aim: float | None = None
        self.steered: list[Steered] = []
        self._instruments: Sequence[Mapping[str, Any]] = ()
        self._has_hand = False
        self._parameters: Mapping[str, Any] = {}

    def begin(self, session: Session, described: Mapping[str, Any], held: int = 0) -> None:
        """A run, described as by `Session.describe`, is at its start, and this hub is held."""
        self.held, self.aim = held, None
        self._instruments = described["instruments"]
        self._has_hand = session.hand
        self._parameters = session.parameters
        self.steered = [Steered(self._parameters) for _ in self._instruments]

    def exchange(self, described: Mapping[str, Any], parameters: Mapping[str, Any]) -> None:
        """Another instrument is in the place of one, and the run goes on: no table says that."""
        self.aim = None
        self._instruments = described["instruments"]
        self._parameters = parameters
        self.invalidate("an instrument was exchanged within the run: start anew to record")

    def hold(self, number: int) -> None:
        """Take another one; raises ValueError where there is none of this number."""
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(self._instruments):
            raise ValueError("no such instrument")
        self.held, self.aim = number, None

    def key_of(self, number: int, name: str) -> str:
        """The key that names an instrument; raises ValueError where it cannot have this name."""
        if name not in self._instruments[number]["choices"]:
            raise ValueError("no such instrument")
        return self._instruments[number]["key"]

    def towards_aim(self, state: State, steps: int, most: float) -> float:
        """Turn in each of so many steps that brings the held hub to its aim, rad, of at most this size."""
        hub = state.hub if self.held == 0 else state.catheters[self.held - 1]
        if self.aim is None or hub is None:
            return 0.0
        return min(max((self.aim - hub.turn) / steps, -most), most)

    def in_a_step(self, push: float, turn: float) -> tuple[float, float]:
        """What is asked of the held hub in a step, units and rad, such that a table can say it."""
        if not self._has_hand:
            return 0.0, 0.0
        metres = self._parameters.get("metresPerUnit")
        return (push, exact_turn(turn)) if metres is None else (exact_push(push, metres), exact_turn(turn))

    def add(self, number: int, push: float, turn: float, steps: int, state: State) -> None:
        """Note a call that asked for so many steps with so much push (units) and turn (rad) of one hub in each."""
        self.add_all([(push, turn) if k == number else (0.0, 0.0) for k in range(len(self.steered))], steps, state)

    def add_all(self, moves: Sequence[tuple[float, float]], steps: int, state: State) -> None:
        """The same of all hubs, as of `moves`."""
        for k, (steered, (push, turn)) in enumerate(zip(self.steered, moves)):
            steered.add(push, turn, steps, state, self._insertion_of(k, state))

    @property
    def second(self) -> int | None:
        """Which instrument the other hand holds: the one after the held; None where there is one alone."""
        return (self.held + 1) % len(self._instruments) if len(self._instruments) > 1 else None

    def moves(self, hand: tuple[float, float], other: tuple[float, float]) -> list[tuple[float, float]]:
        """What is asked of each hub in a step, units and rad, by both hands, such that tables can say it."""
        moves = [(0.0, 0.0)] * len(self._instruments)
        moves[self.held] = self.in_a_step(*hand)
        if self.second is not None:
            moves[self.second] = self.in_a_step(*other)
        return moves

    def _insertion_of(self, number: int, state: State) -> float | None:
        """Return the insertion of a hub that other hubs may stop and no force limit, m."""
        catheters = self._parameters.get("catheters") or []
        own = self._parameters if number == 0 else catheters[number - 1]
        if not catheters or own.get("hubForceLimit") not in (None, 0, "hand"):
            return None
        return state.hub.insertion if number == 0 else state.catheters[number - 1].insertion

    def invalidate(self, why: str) -> None:
        """From here on no table says what was steered."""
        for steered in self.steered:
            steered.invalidate(why)

    def status(self) -> dict[str, Any]:
        """What a page shows of the instruments."""
        return {"held": self.held, "instruments": [one["title"] for one in self._instruments],
                "chosen": [one["name"] for one in self._instruments],
                "named": [one["choices"] for one in self._instruments if one["choices"]]}

    @property
    def problem(self) -> str:
        """Why no table says what was steered; empty where one does."""
        return self.steered[0].problem if self.steered else "no run is open"

    def to_csv(self, number: int) -> str:
        """What was steered of one hub since the start, as a drive table. Raises IndexError where there is none."""
        return self.steered[number].to_csv()
