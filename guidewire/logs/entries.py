"""Entries of a log of format json against the arrays of a log of format npz, by the table of quantities."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from guidewire.quantities import CATHETER, WIRE, Quantity, catheter_name

OLDER_NAMES = {"angularVelocities": "angularVelocity"}  # in older logs


def arrays_of(step: int, entry: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Return what an entry has, by the names of arrays.

    Raises KeyError, TypeError or ValueError where it is not an entry.
    """
    indices = [int(index) for index in entry["sphere"]]
    nodes = max(indices) + 1
    arrays = {"step": np.asarray(step), "firstSphere": np.asarray(min(indices))}
    for row in WIRE:
        for value in _values(entry.get(row.group, {}) if row.group else entry, row):
            arrays[row.name] = _numbers(value, row, nodes)
    for number, catheter in enumerate(entry.get("catheters", ())):
        for row in CATHETER:
            for value in _values(catheter, row):
                arrays[catheter_name(row.name, number)] = _numbers(value, row, nodes)
    return arrays


def entry_of(arrays: Mapping[str, np.ndarray], k: int) -> dict[str, Any]:
    """Return entry `k` of arrays whose first index counts entries, as a log of format json has it."""
    entry: dict[str, Any] = {}
    first = int(arrays["firstSphere"][k])
    for row in WIRE:
        if row.key is not None and row.name in arrays:
            group = entry.setdefault(row.group, {}) if row.group else entry
            _put(group, row, np.asarray(arrays[row.name][k]), first if row.key == "sphere" and not row.group else 0)
    number = 0
    while catheter_name("positions", number) in arrays:
        catheter: dict[str, Any] = {}
        for row in CATHETER:
            name = catheter_name(row.name, number)
            if row.key is not None and name in arrays:
                _put(catheter, row, np.asarray(arrays[name][k]), 0)
        entry.setdefault("catheters", []).append(catheter)
        number += 1
    return entry


def _values(group: Mapping[str, Any], row: Quantity) -> list[Any]:
    """Return what a group has of a quantity: one value, or none."""
    keys = (row.key, OLDER_NAMES.get(row.key or ""))
    return [group[key] for key in keys if key in group][:1]


def _numbers(value: Any, row: Quantity, nodes: int) -> np.ndarray:
    if row.form == "value":
        return np.asarray(_number(value) if row.width == 1 else _row(value, row))
    if row.form == "rows":
        return np.array(value, dtype=float)
    if row.form == "byindex":
        return np.array([_row(one, row) for one in value.values()])
    numbers = np.zeros((nodes - (row.place == "element"), row.width))
    for index, one in value.items():
        numbers[int(index)] = _row(one, row)
    return numbers


def _row(value: Mapping[str, Any], row: Quantity) -> list[float]:
    return [_number(value[letter]) for letter in row.letters]


def _number(value: Any) -> Any:
    return math.nan if value is None else value if isinstance(value, int) else float(value)


def _put(group: dict[str, Any], row: Quantity, numbers: np.ndarray, first: int) -> None:
    if row.form == "value":
        group[row.key] = numbers.item() if row.width == 1 else dict(zip(row.letters, numbers.tolist()))
    elif row.form == "rows":
        group[row.key] = numbers.tolist()
    else:
        rows = group.setdefault(row.key, {})
        for index, own in _shown(numbers, row.form == "nonzero"):
            rows.setdefault(str(first + index), {}).update(zip(row.letters, own.tolist()))


def _shown(rows: np.ndarray, only_nonzero: bool) -> Iterator[tuple[int, np.ndarray]]:
    return ((index, own) for index, own in enumerate(rows) if own.any() or not only_nonzero)
