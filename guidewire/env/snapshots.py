"""Snapshots of an episode as bytes: a line of JSON, the numbers of arrays, and what the session saved."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from guidewire.env.spaces import Error


def packed(head: Mapping[str, Any], arrays: Sequence[np.ndarray], bits: bytes) -> bytes:
    """Return the bytes that `unpacked` takes apart."""
    shapes = [[one.shape, one.dtype.str] for one in arrays]
    line = json.dumps({**head, "arrays": shapes}).encode()
    return b"".join([line, b"\n", *(np.ascontiguousarray(one).tobytes() for one in arrays), bits])


def unpacked(saved: Any, task: str) -> tuple[dict[str, Any], list[np.ndarray], bytes]:
    """Return the three parts of a snapshot.

    Raises
    ------
    Error : it is none, or of another task.
    """
    try:
        line, _, rest = saved.partition(b"\n")
        head = json.loads(line)
        arrays = []
        for shape, kind in head["arrays"]:
            dtype = np.dtype(kind)
            count = int(np.prod(shape, dtype=int))
            arrays.append(np.frombuffer(rest, dtype, count).reshape(shape).copy())
            rest = rest[count * dtype.itemsize:]
        name = head["task"]
    except (AttributeError, ValueError, KeyError, TypeError) as error:
        raise Error("option \"snapshot\" is not what save() gave") from error
    if name != task:
        raise Error(f"this snapshot is of task '{name}', not of '{task}'")
    return head, arrays, rest
