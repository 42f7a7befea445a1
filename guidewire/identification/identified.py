"""Values that were found from measurements, and identified.json, which has them."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.identification.residuals import Residuals


@dataclass(frozen=True)
class Value:
    """One value that was found.

    Attributes
    ----------
    key, unit : of the unknown.
    start : value in the scene.
    value : None where the measurement does not tell it.
    error : standard error; of what is sought by its logarithm, value times the error of the logarithm.
    low, high : the interval of 95 %.
    at_bound : whether it ended at a bound, where errors mean nothing.
    """

    key: str
    unit: str
    start: float
    value: float | None
    error: float
    low: float
    high: float
    at_bound: bool


@dataclass(frozen=True)
class Identified:
    """It has what was found.

    Attributes
    ----------
    values : by unknown, in the order in which they were asked for.
    correlation : (p, p), of the values.
    rms : of each measurement, in its unit.
    residuals : of each measurement, at the values found.
    notes : what cannot be told apart, and what the residuals say; sentences.
    runs, failed : how many runs were made, and why some of them gave no result.
    parameters : overrides with which the scene has the values found.
    is_complete : whether the search came to its end.
    """

    values: tuple[Value, ...]
    correlation: np.ndarray
    rms: tuple[float, ...]
    residuals: tuple[Residuals, ...]
    notes: tuple[str, ...]
    runs: int
    failed: tuple[str, ...]
    parameters: Mapping[str, Any] = field(default_factory=dict)
    is_complete: bool = True

    def __getitem__(self, key: str) -> Value:
        """Return the value of a key."""
        return next(one for one in self.values if one.key == key)


def to_json(found: Identified, scene: str, measured: Sequence[Path]) -> str:
    """Return the contents of identified.json."""
    def number(value: float | None) -> float | None:
        return None if value is None or not math.isfinite(value) else float(value)

    return json.dumps({
        "scene": scene, "complete": found.is_complete, "runs": found.runs, "failedRuns": list(found.failed),
        "values": [{"key": one.key, "unit": one.unit, "start": one.start, "value": number(one.value),
                    "standardError": number(one.error), "interval95": [number(one.low), number(one.high)],
                    "atBound": one.at_bound} for one in found.values],
        "correlation": [[number(value) for value in row] for row in found.correlation],
        "measurements": [{"file": file.name, "rms": rms, "points": len(part.offsets),
                          "correlationOfResiduals": part.correlation}
                         for file, rms, part in zip(measured, found.rms, found.residuals)],
        "notes": list(found.notes),
    }, indent=2) + "\n"
