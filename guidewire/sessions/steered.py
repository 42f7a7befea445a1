"""Recorded steering as a table for `driveFile`, which repeats the motion of the hub with the same bits.

The core moves a steered hub by metresPerUnit * push in a step, and a hub with a table by the difference of two of its
values. The two are the same double where the displacement is a multiple of 2^-48 m: sums of those are exact up to 16 m.
So a page's steering is rounded to such displacements (3.6e-15 m), and turns to multiples of 2^-40 rad.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from guidewire.sessions.session import State

_GRAIN = 2.0 ** -48  # m
_TURN_GRAIN = 2.0 ** -40  # rad
_CONSTANT = 1e-6  # of a step: so long before and after its end the table stands still
_STOPPED = 1e-9  # m: a hub that went less than asked by more than that came to another one
_TRIES = 200  # displacements beside the wanted one; about every second is met
RULES = {"grain": _GRAIN, "turnGrain": _TURN_GRAIN, "constant": _CONSTANT, "stopped": _STOPPED, "tries": _TRIES}


def exact_push(wanted: float, metres: float) -> float:
    """Return a push in a step, units, near a wanted one, for which metres * push is a multiple of the grain."""
    middle = round(metres * wanted / _GRAIN)
    for k in range(_TRIES):
        displacement = (middle + (k + 1) // 2 * (1 if k % 2 else -1)) * _GRAIN
        push = displacement / metres
        for near in (push, math.nextafter(push, math.inf), math.nextafter(push, -math.inf)):
            if metres * near == displacement:
                return near
    raise ArithmeticError(f"no push near {wanted} units gives an exact displacement")  # every second one does


def exact_turn(wanted: float) -> float:
    """Return a turn in a step, rad, near a wanted one, that is a multiple of the grain."""
    return round(wanted / _TURN_GRAIN) * _TURN_GRAIN


def obstacle(parameters: Mapping[str, Any]) -> str:
    """Why a run with these values cannot be moved by a table, in one phrase; empty where it can."""
    if parameters.get("solver") != "direct" or parameters.get("drive") != "displace":
        return "only a wire of solver direct with drive \"displace\" takes a drive table"
    return ""


class Steered:
    """What a hand has done with a hub since a run's start: the calls of its session, and from them the table.

    Parameters
    ----------
    parameters : effective values of the run.

    Attributes
    ----------
    calls : push (units) and turn (rad) in all steps of a call of `Session.step`, and their number.
    state : of the wire after them; None before the first.
    problem : why no table says what was steered, in one phrase; empty where one does.
    """

    def __init__(self, parameters: Mapping[str, Any]) -> None:
        self.problem = obstacle(parameters)
        self.calls: list[tuple[float, float, int]] = []
        self.state: State | None = None
        self._dt = float(parameters["timeStep"])
        self._metres = float(parameters.get("metresPerUnit", 1e-3))
        self._insertion = self._rotation = self._carried = 0.0
        self._rows: list[tuple[int, float, float]] = [(0, 0.0, 0.0)]  # step, m, rad

    @property
    def steps(self) -> int:
        """Steps of all calls."""
        return self._rows[-1][0]

    def add(self, push: float, turn: float, steps: int, state: State, insertion: float | None = None) -> None:
        """Note a call that asked for so many steps with so much push (units) and turn (rad) in each.

        With the hub's insertion after it (m), of one that meets other hubs, the table goes no farther than that. What
        another hub made of it by carrying this one along is left out: it does so again.
        """
        if self.problem:
            return
        before = self.state.step if self.state is not None else 0
        self.state = state
        self.calls.append((push * steps, turn * steps, steps))
        displacement = self._metres * push
        asked = self._insertion + self._carried + displacement * (state.step - before)
        beyond = 0.0 if insertion is None else insertion - asked
        end = None
        if insertion is not None and abs(beyond) > _STOPPED:
            if beyond * displacement < 0.0:
                end = insertion - self._carried
            else:
                self._carried += beyond
        for step in range(before + 1, state.step + 1):
            self._insertion += displacement
            if end is not None:
                self._insertion = min(self._insertion, end) if displacement > 0.0 else max(self._insertion, end)
            self._rotation += turn
            self._rows.append((step, self._insertion, self._rotation))

    def invalidate(self, why: str) -> None:
        """From here on no table says what was steered."""
        self.problem = self.problem or why

    def to_csv(self) -> str:
        """Return the table, as `driveFile` takes it.

        A step asks for the values at its beginning and at its end. The core's time at those differs from a multiple of
        dt by roundings, so around each multiple the value is constant.
        """
        lines = ["time,insertion,rotation", "0.0,0.0,0.0"]
        for step, insertion, rotation in self._rows:
            for side in ((-1, 1) if step else (1,)):
                time = step * self._dt + side * _CONSTANT * self._dt
                lines.append(f"{time!r},{insertion!r},{rotation!r}")
        return "\n".join(lines) + "\n"
