"""What a live run asks of its session: to open, to step all hubs at once; and how a refused value is told."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from guidewire.sessions.session import Session, SessionError, State

ENDLESS = {"maxSimulationSteps": 1_000_000_000, "deltaThreshold": 0}
REST = (0.0, 0.0)


def start(scene: Path, by_hand: bool, named: Mapping[str, str]) -> Session:
    """Return a session that is steered without end, or the file's own run where that cannot be or is not asked for."""
    if by_hand:
        try:
            return Session(scene, hand=True, native=False, **ENDLESS, **named)
        except SessionError:
            pass  # what is wrong with the file itself is said below
    return Session(scene, hand=False, native=False, **named)


def step(session: Session, moves: Sequence[tuple[float, float]], steps: int, hub: int) -> State:
    """Make steps with this push (units) and turn (rad) of each hub in each; where one hand rests, of the held one."""
    if all(move == REST for k, move in enumerate(moves) if k != hub):
        push, turn = moves[hub]
        return session.step(push * steps, turn * steps, steps, hub)
    return session.step([push * steps for push, _ in moves], [turn * steps for _, turn in moves], steps)


_NOT_ALLOWED = re.compile(r"(?:.*: )?(\w+) = .* is not allowed: (needs .*)", re.DOTALL)


def refusal(key: str, value: Any, message: str) -> str:
    """Say why a field's new value is refused, for who typed it: which value, and what is allowed.

    Parameters
    ----------
    key, value : of the field.
    message : the runner's line. Where the value does not go with another key, it names that key with its file.
    """
    said = _NOT_ALLOWED.fullmatch(message)
    if said is None:
        return message.removeprefix("set: ")
    named, needs = said.groups()
    asked = f"{key} = {json.dumps(value)}"
    return f"{asked} is not allowed: {needs}" if named == key else f"{asked} does not go with {named}, which {needs}"
