"""Formats numbers for captions."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np


def number(value: float, digits: int = 3) -> str:
    """Return a number with so many significant digits, as 0.297, 1,548 or 2.1e-5."""
    if not math.isfinite(value):
        return "not finite"
    if value == 0.0:
        return "0"
    exponent = math.floor(math.log10(abs(value)))
    exponent += abs(round(value, digits - 1 - exponent)) >= 10.0 ** (exponent + 1)  # 0.9996 is 1.00
    if -4 <= exponent < 6:
        return f"{value:,.{max(digits - 1 - exponent, 0)}f}"
    return f"{value / 10.0**exponent:.{digits - 1}f}e{exponent}"


def span(values: Sequence[float] | np.ndarray, digits: int = 3) -> str:
    """Return the range of the finite values, as "0.15 to 1.55", or one number where both ends read the same."""
    finite = np.asarray(values)[np.isfinite(values)]
    if finite.size == 0:
        return "no value"
    low, high = number(finite.min(), digits), number(finite.max(), digits)
    return low if low == high else f"{low} to {high}"


def percent(fraction: float, digits: int = 2) -> str:
    """Return a fraction as "4.8 %"."""
    return f"{number(100.0 * fraction, digits)} %"


def exponent(x: Sequence[float] | np.ndarray, y: Sequence[float] | np.ndarray) -> float:
    """p of the power law y ~ x^p, by least squares of the logarithms."""
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def relative_spread(values: Sequence[float] | np.ndarray) -> float:
    """(largest - smallest)/median of the finite values; not a number where there is none."""
    finite = np.asarray(values)[np.isfinite(values)]
    if finite.size == 0:
        return math.nan
    return float((finite.max() - finite.min()) / np.median(finite))


def beside(loads: Sequence[float | None]) -> str:
    """Return what was measured of the machine beside timed runs, each with the processors that others kept busy."""
    known = [load for load in loads if load is not None]
    if not known:
        return "and the load of other programs was not measured"
    busiest = max(known)
    load = f"at most {number(busiest, 2)} processors" if busiest >= 0.01 else "less than 0.01 of a processor"
    return f"while other programs kept {load} busy"
