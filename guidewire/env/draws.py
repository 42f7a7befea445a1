"""What a seed draws for an episode, and what options put in its place."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from numbers import Integral, Real
from typing import Any

import numpy as np

from guidewire.env.randomisation import Draw, drawn_from, eased, is_choice, middle_of
from guidewire.env.spaces import Error
from guidewire.env.task import LIMITS, Task, check_instruments

_OPTIONS = ("nominal", "anatomy", "target", "instrument", "friction", "tip_turn", "insertion", "snapshot")


def draw_of(task: Task, random: np.random.Generator) -> Draw:
    """An episode of a task by chance."""
    anatomy, target, instrument, friction, turn = (int(random.integers(max(n, 1))) for n in (
        len(task.anatomies), len(task.targets), len(task.instruments), len(task.frictions), task.tip_turns))
    values = _checked(task, "random", {name: drawn_from(given, random) for name, given in task.random.items()})
    return _with_values(Draw(anatomy, target, task.instruments[instrument] if task.instruments else None,
                             float(task.frictions[friction]), _turn(turn, task.tip_turns), task.insertion), values)


def eased_draw(task: Task, draw: Draw, difficulty: float) -> Draw:
    """A draw made easier: at a difficulty of 0 the nearest target of the first vessel with the first of all lists, no
    turn and the middle of what is random; at 1 the draw itself. Between them its place in each list, of targets by
    their ways, and the distance of each number from the middle are the fraction."""
    def part(index: int) -> int:
        return int(difficulty * index + 1e-9)

    order = task.by_way
    own = {name: eased(task.random[name], value, difficulty) if name in task.random else value
           for name, value in {**draw.random, **{key: getattr(draw, key) for key in _OPTIONS[4:7]}}.items()}
    if "friction" not in task.random:
        own["friction"] = task.frictions[part(list(task.frictions).index(draw.friction))]
    if "tip_turn" not in task.random:
        own["tip_turn"] = difficulty * draw.tip_turn
    instrument = task.instruments[part(list(task.instruments).index(draw.instrument))] if task.instruments else None
    return _with_values(replace(draw, anatomy=part(draw.anatomy), target=order[part(order.index(draw.target))],
                                instrument=instrument, random={}), own)


def with_options(task: Task, drawn: Draw, options: Mapping[str, Any]) -> Draw:
    """What was drawn with the options of a reset in its place.

    Raises
    ------
    Error : there is no such option, or its value is not allowed.
    """
    if not isinstance(options, Mapping):
        raise Error(f"options = {options!r} are not allowed: needs a dict")
    options = dict(options)
    allowed = dict.fromkeys((*_OPTIONS, *task.random))
    for key in options:
        if key not in allowed:
            raise Error(f"option \"{key}\" is not allowed: there are {', '.join(allowed)}")
    if options.get("snapshot") is not None and len(options) > 1:
        raise Error("option \"snapshot\" stands alone")
    options.pop("snapshot", None)
    nominal = options.pop("nominal", False)
    if not isinstance(nominal, (bool, np.bool_)):
        raise Error(f"option \"nominal\" = {nominal!r} is not allowed: needs True or False")
    if nominal:
        first = Draw(0, 0, task.instruments[0] if task.instruments else None, float(task.frictions[0]), 0.0,
                     task.insertion)
        drawn = _with_values(first, {name: middle_of(given) for name, given in task.random.items()})
    for key, count in (("anatomy", len(task.anatomies)), ("target", len(task.targets))):
        if key in options:
            value = options[key]
            if not isinstance(value, Integral) or isinstance(value, bool) or not 0 <= value < count:
                raise Error(f"option \"{key}\" = {value!r} is not allowed: needs a whole number below {count}")
            options[key] = int(value)
    check_instruments("option \"instrument\" =", options.get("instrument"))
    options = _checked(task, "option", options)
    for key in options:
        if key in task.random and key not in LIMITS and not is_choice(task.random[key], options[key]):
            options[key] = _finite(key, options[key])
    return _with_values(drawn, options)


def _checked(task: Task, source: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values with those as numbers that have to be some."""
    return {key: _numbers(f"{source} \"{key}\"", value, *LIMITS[key], task.hubs if key == "insertion" else 0)
            if key in LIMITS else value for key, value in values.items()}


def _with_values(draw: Draw, values: Mapping[str, Any]) -> Draw:
    own = {key: value for key, value in values.items() if key in _OPTIONS}
    rest = {key: value for key, value in values.items() if key not in _OPTIONS}
    return replace(draw, **own, random={**draw.random, **rest})


def _numbers(name: str, value: Any, least: float, most: float, hubs: int) -> Any:
    if hubs > 0 and isinstance(value, (list, tuple, np.ndarray)) and len(value) == hubs:
        return [_numbers(name, one, least, most, 0) for one in value]
    is_number = isinstance(value, Real) and not isinstance(value, bool)
    if not is_number or not least <= value <= most:
        of_all = f", or {hubs} of them" if hubs > 1 else ""
        raise Error(f"{name} = {value!r} is not allowed: needs a number from {least:g} to {most:g}{of_all}")
    return float(value)


def _finite(key: str, value: Any) -> Any:
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_finite(key, one) for one in value]
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise Error(f"option \"{key}\" = {value!r} is not allowed: needs finite numbers")
    return int(value) if isinstance(value, Integral) else float(value)


def _turn(index: int, count: int) -> float:
    """Even turns from 0, the shorter way round."""
    return 2.0 * np.pi * (index if 2 * index <= count else index - count) / count
