"""What is sought: keys of a parameter file, or parts of them, each with its range and its scale."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from guidewire.prepare import PreparationError
from guidewire.runs.key_table import Key

_FRAME = re.compile(r"^(start\.(?:proximal|distal)Frame)\.([xyz])$")
_PART = re.compile(r"[^.\[\]]+")
_ANGLE = 0.5    # rad: scale of an unknown angle that starts at 0


@dataclass(frozen=True)
class Unknown:
    """A number that is sought.

    Attributes
    ----------
    key : as it stands on the command line.
    start : its value in the scene.
    low, high : its bounds, in its own unit.
    scale : a change of it that matters; of a number that is sought by its logarithm 1.
    by_ratio : whether its logarithm is sought: for what is above 0 in the scene and by its range.
    unit : of the key; empty where it has none.
    """

    key: str
    start: float
    low: float
    high: float
    scale: float
    by_ratio: bool
    unit: str

    def value(self, step: float) -> float:
        """Return the value at so many scales from the start."""
        return self.start * math.exp(step) if self.by_ratio else self.start + self.scale * step

    def step(self, value: float) -> float:
        """Return the inverse of `value`; infinite where there is none."""
        if not self.by_ratio:
            return (value - self.start) / self.scale
        return math.log(value / self.start) if value > 0.0 else -math.inf


def unknowns_of(keys: Sequence[str], scene: Mapping[str, Any], table: Mapping[str, Key],
                bounds: Mapping[str, tuple[float, float]]) -> list[Unknown]:
    """Return the unknowns that keys name; a key of three numbers is three.

    Parameters
    ----------
    keys : such as "bendingStiffness", "wireSections[1].youngsModulus", or "start.proximalFrame.z": the angle in rad by
        which the frame is turned about the world's z axis from where it is in the scene.
    scene : every effective value.
    table : keys of parameter files.
    bounds : by key; others have the key's range.

    Raises
    ------
    PreparationError : a key is not known, is no number, has no value in the scene, or starts beyond a bound.
    """
    found: list[Unknown] = []
    for name in keys:
        value = 0.0 if _FRAME.match(name) else _value_at(scene, name)
        if isinstance(value, list) and len(value) == 3 and not any(isinstance(part, (list, dict)) for part in value):
            found += [_unknown(f"{name}[{k}]", float(part), scene, table, bounds) for k, part in enumerate(value)]
        elif isinstance(value, bool) or not isinstance(value, (int, float)):
            raise PreparationError(f"{name} = {json.dumps(value)} in the scene: only a number can be sought; give it a "
                                      "value to start from")
        else:
            found.append(_unknown(name, float(value), scene, table, bounds))
    if len({one.key for one in found}) < len(found):
        raise PreparationError("a key is sought twice")
    strange = [key for key in bounds if key not in {one.key for one in found}]
    if strange:
        raise PreparationError(f"--bounds {strange[0]}: that key is not sought")
    return found


def overrides(unknowns: Sequence[Unknown], values: Sequence[float], scene: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters, and parts of them, that give the unknowns these values."""
    made: dict[str, Any] = {}
    turns: dict[str, np.ndarray] = {}
    for one, value in zip(unknowns, values):
        frame = _FRAME.match(one.key)
        if frame is None:
            made[one.key] = float(value)
        else:
            turns.setdefault(frame[1], np.zeros(3))["xyz".index(frame[2])] = value
    for name, turn in turns.items():
        base = _value_at(scene, name)
        made[name] = (Rotation.from_rotvec(turn) * Rotation.from_quat(base)).as_quat().tolist()
    return made


def _unknown(name: str, start: float, scene: Mapping[str, Any], table: Mapping[str, Key],
             bounds: Mapping[str, tuple[float, float]]) -> Unknown:
    whole = _PART.match(name)
    is_frame = _FRAME.match(name) is not None
    key = table.get(whole[0]) if whole and not is_frame else None
    low, high = (key.low, key.high) if key is not None and name == key.name else (-math.inf, math.inf)
    given = bounds.get(name, (low, high))
    if not given[0] < given[1]:
        raise PreparationError(f"--bounds {name}: {given[0]:g} is not below {given[1]:g}")
    if not low <= given[0] or not given[1] <= high:
        raise PreparationError(f"--bounds {name}: must lie within {low:g} and {high:g}")
    if not given[0] <= start <= given[1]:
        raise PreparationError(f"{name} = {start:g} in the scene lies outside its bounds {given[0]:g} and {given[1]:g}")
    unit = re.search(r"\(([^()]+)\)$", key.allowed) if key is not None else None
    is_positive = start > 0.0 and given[0] >= 0.0 or start > 0.0 and key is None and not is_frame
    return Unknown(name, start, *given, 1.0 if is_positive else _scale(name, start, scene), is_positive,
                   "rad" if is_frame else unit[1] if unit else "")


def _scale(name: str, start: float, scene: Mapping[str, Any]) -> float:
    if start != 0.0:
        return abs(start)
    if "urvature" in name:
        return 1.0 / (float(scene["guidewireLength"]) * float(scene["metresPerUnit"]))
    return _ANGLE if _FRAME.match(name) or "otation" in name else 1.0


def _value_at(scene: Mapping[str, Any], name: str) -> Any:
    value: Any = scene
    for part in _PART.findall(name):
        try:
            value = value[int(part)] if isinstance(value, list) else value[part]
        except (KeyError, IndexError, ValueError, TypeError):
            raise PreparationError(f"{name}: the scene has no such key or part: 'keys' lists what there is") from None
    if isinstance(value, dict) and set(value) == {"x", "y", "z"}:
        return [value["x"], value["y"], value["z"]]
    return value


def placed(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters with each part, such as "vessel.radius" or "wireSections[0].from", inside the key that it belongs
    to."""
    made = json.loads(json.dumps({key: value for key, value in parameters.items() if _PART.fullmatch(key)}))
    for name, value in parameters.items():
        *above, last = _PART.findall(name)
        if not above:
            continue
        holder: Any = made
        for part in above:
            if isinstance(holder, dict):
                holder = holder.setdefault(part, [0.0, 0.0, 0.0] if last.isdigit() else {})
            else:
                holder = holder[int(part)]
        if isinstance(holder, list):
            holder[int(last)] = value
        else:
            holder[last] = value
    return made
