"""Checks of the options that an environment is made with."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from numbers import Integral, Real
from typing import Any

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


def made_of(kind: type, name: str, given: Any) -> Any:
    """Return an object of options, made of a plain dict where it is one, as a file or a spec in JSON has it.

    Raises
    ------
    Error : it is neither, or has an option that there is not.
    """
    if isinstance(given, kind):
        return given
    names = [field.name for field in dataclasses.fields(kind)]
    if not isinstance(given, Mapping) or not set(given) <= set(names):
        raise Error(f"{name} = {given!r} is not allowed: needs {kind.__name__}, or a dict with some of "
                    f"{', '.join(names)}")
    return kind(**given)
