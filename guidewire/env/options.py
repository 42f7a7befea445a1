"""Checks of the options that an environment is made with."""

from __future__ import annotations

import math
from numbers import Integral, Real

from guidewire.env.spaces import Error


def need_number(name: str, value: object, low: float = -math.inf, above: bool = False) -> None:
    """A finite number from `low` on, or above it.

    Raises
    ------
    Error : it is none.
    """
    is_number = isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
    if not is_number or value < low or (above and value == low):
        bound = "" if low == -math.inf else f" {'above' if above else 'from'} {low:g}"
        raise Error(f"{name} = {value!r} is not allowed: needs a finite number{bound}")


def need_count(name: str, value: object, low: int) -> None:
    """A whole number from `low` on.

    Raises
    ------
    Error : it is none.
    """
    if not isinstance(value, Integral) or isinstance(value, bool) or value < low:
        raise Error(f"{name} = {value!r} is not allowed: needs a whole number from {low}")
