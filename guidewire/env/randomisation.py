"""Distributions that a task's values are drawn from, and what was drawn."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from guidewire.env.spaces import Error

_ALLOWED = ("[from, to], {\"uniform\": [from, to]}, {\"logUniform\": [from, to]}, {\"normal\": [mean, deviation], "
            "\"within\": [from, to]}, {\"integers\": [from, to]}, {\"choice\": [...]}, or {\"vector\": [one for each "
            "axis]}")


@dataclass(frozen=True)
class Draw:
    """What a seed has drawn for an episode; see Task.

    Attributes
    ----------
    instrument : a name, or of the wire and the catheters, or None: the scene's.
    tip_turn : of all instruments, rad.
    insertion : of each hub, or of all, m.
    random : by name, of the task's `random`.
    """

    anatomy: int
    target: int
    instrument: Any
    friction: float
    tip_turn: float
    insertion: Any
    random: dict[str, Any] = field(default_factory=dict)

    def as_options(self) -> dict[str, Any]:
        """Return the options of a reset that draws the same."""
        return {key: value for key, value in vars(self).items() if key != "random"} | self.random


def check_distribution(name: str, given: Any) -> None:
    """Raises Error, one line, where it is no distribution."""
    kind, numbers, within = _parts(given)
    is_pair = isinstance(numbers, (list, tuple)) and len(numbers) == 2 and all(map(_is_number, numbers))
    is_whole = is_pair and all(type(one) is int for one in numbers)
    good = {
        "uniform": is_pair and numbers[0] <= numbers[1], "logUniform": is_pair and 0.0 < numbers[0] <= numbers[1],
        "normal": is_pair and numbers[1] >= 0.0, "integers": is_whole and numbers[0] <= numbers[1],
        "choice": isinstance(numbers, (list, tuple)) and len(numbers) > 0,
        "vector": isinstance(numbers, (list, tuple)) and len(numbers) > 0,
    }.get(kind, False)
    if within is not None:
        good = good and isinstance(within, (list, tuple)) and len(within) == 2 and all(map(_is_number, within))
        good = good and within[0] < within[1] and within[0] <= numbers[0] <= within[1]
        good = good and numbers[1] <= 100.0 * (within[1] - within[0])    # drawn until it is within
    if not good:
        raise Error(f"random \"{name}\" = {json.dumps(given)} is not allowed: needs {_ALLOWED}")
    if kind == "vector":
        for one in numbers:
            check_distribution(name, one)


def drawn_from(given: Any, random: np.random.Generator) -> Any:
    """A value of a distribution."""
    kind, numbers, within = _parts(given)
    if kind == "vector":
        return [drawn_from(one, random) for one in numbers]
    if kind == "choice":
        return numbers[int(random.integers(len(numbers)))]
    if kind == "integers":
        return int(random.integers(numbers[0], numbers[1] + 1))
    if kind == "uniform":
        return float(random.uniform(*numbers))
    if kind == "logUniform":
        return float(np.exp(random.uniform(math.log(numbers[0]), math.log(numbers[1]))))
    value = float(random.normal(*numbers))
    while within is not None and not within[0] <= value <= within[1]:
        value = float(random.normal(*numbers))
    return value


def bounds_of(given: Any) -> tuple[float, float]:
    """Return the least and the largest number that a distribution draws; (nan, nan) where it draws others."""
    kind, numbers, within = _parts(given)
    if kind == "normal":
        return (-math.inf, math.inf) if within is None else (within[0], within[1])
    if kind == "vector":
        numbers = [one for axis in numbers for one in bounds_of(axis)]
    elif kind == "choice":
        numbers = [one for each in numbers for one in (each if isinstance(each, (list, tuple)) else [each])]
    return (min(numbers), max(numbers)) if all(map(_is_number, numbers)) else (math.nan, math.nan)


def is_choice(given: Any, value: Any) -> bool:
    """Whether a value is one of those that a distribution lists, whatever kind of value these are."""
    kind, numbers, _ = _parts(given)
    return kind == "choice" and any(type(one) is type(value) and one == value for one in numbers)


def eased(given: Any, value: Any, difficulty: float) -> Any:
    """Return a drawn value brought nearer to the middle of its distribution: at a difficulty of 0 it is that, at 1 the
    value itself. A choice is one of the first that are listed."""
    kind, numbers, _ = _parts(given)
    if kind == "vector":
        return [eased(one, other, difficulty) for one, other in zip(numbers, value)]
    if kind == "choice":
        index = next(k for k, one in enumerate(numbers) if type(one) is type(value) and one == value)
        return numbers[int(difficulty * index + 1e-9)]
    middle = middle_of(given)
    eased_value = (1.0 - difficulty) * middle + difficulty * value
    return round(eased_value) if kind == "integers" else eased_value


def middle_of(given: Any) -> Any:
    """What an episode without chance has: the middle, or the first."""
    kind, numbers, _ = _parts(given)
    if kind == "vector":
        return [middle_of(one) for one in numbers]
    if kind == "uniform":
        return 0.5 * (numbers[0] + numbers[1])
    return math.sqrt(numbers[0] * numbers[1]) if kind == "logUniform" else numbers[0]


def _parts(given: Any) -> tuple[str, Any, Any]:
    if isinstance(given, (list, tuple)):
        return "uniform", given, None
    if not isinstance(given, Mapping):
        return "", None, None
    within = given.get("within")
    kinds = [key for key in given if key != "within"]
    if len(kinds) != 1 or within is not None and kinds != ["normal"]:
        return "", None, None
    return kinds[0], given[kinds[0]], within


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
