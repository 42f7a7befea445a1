"""What a session asks its host, as JSON has it: checks of numbers, and what an answer says."""

from __future__ import annotations

import base64
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.sessions.session_state import SessionError


def accepted(answer: dict[str, Any]) -> dict[str, Any]:
    """Return the answer; raise SessionError where it says why the request cannot be met."""
    if answer["exitCode"] != 0:
        raise SessionError(answer["message"].removeprefix("request: "))
    return answer


def plain(value: Any) -> Any:
    """Return what JSON has for a numpy array or number, and for a path."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"a parameter cannot be a {type(value).__name__}")


def whole(name: str, value: Any, least: str) -> int:
    """Return a whole number, or raise SessionError with what is allowed."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)):
        raise SessionError(f"{name} = {value!r} is not allowed: needs a whole number from {least}")
    return int(value)


def numbers(name: str, value: Any, hub: int, hubs: int) -> list[float]:
    """Return a number for each hub, or for none where all of them have 0."""
    try:
        one_each = [0.0] * hubs if not isinstance(value, (list, tuple, np.ndarray)) and value == 0.0 else list(value)
    except TypeError:
        one_each = []
    if hub != 0 or len(one_each) != hubs:
        raise SessionError(f"{name} = {value!r} is not allowed: needs a number, or a list of one for each of the "
                           f"{hubs} hubs, with hub = 0")
    return [number(name, one) for one in one_each]


def number(name: str, value: Any) -> float:
    """Return a finite number, or raise SessionError with what is allowed."""
    is_number = isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)
    if not is_number or not math.isfinite(value):
        raise SessionError(f"{name} = {value!r} is not allowed: needs a finite number")
    return float(value)


def in_a_row(positions: Sequence[np.ndarray], displacements: Sequence[np.ndarray] = ()) -> np.ndarray:
    """All numbers of nodes and then of walls, as requests have them."""
    return np.concatenate([np.asarray(one, dtype="<f8").ravel() for one in (*positions, *displacements)])


def text_of(numbers: np.ndarray) -> str:
    return base64.b64encode(numbers.tobytes()).decode("ascii")
