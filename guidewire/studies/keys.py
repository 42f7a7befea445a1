"""Names of runs, which contain the exact values and so are unique.

A run's name is its variant and its values, such as `seed,numberRodElements=30,timeStep=0.03333333333333333`. A number
is written with as many digits as it takes to read the same number again, a whole number without a point and any other
with one, so that 1 and 1.0 are two names. A text that is no plain word stands percent-encoded between apostrophes.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Union
from urllib.parse import quote


@dataclass(frozen=True)
class Named:
    """A value that is too long to stand in a name, such as a whole vessel, with the name that stands for it.

    Attributes
    ----------
    name : in tables and names of runs.
    value : of the parameter, as in a file.
    """

    name: str
    value: Any


Value = Union[int, float, bool, str, Named]  # what an axis can take

TABLE = "study.json"  # in a study's folder: what was asked for
RESULTS = "runs.csv"  # beside it: what came of it
_LONGEST = 200  # bytes of a file's name; file systems take 255
_WORD = re.compile(r"[A-Za-z][A-Za-z0-9-]*", re.ASCII)
_FILE = re.compile(r"[A-Za-z0-9'][A-Za-z0-9 .,=+%'_~\[\]-]*(?<![ .])", re.ASCII)
_NO_WORDS = ("true", "false")  # as texts they are written like other texts, between apostrophes


def value_text(value: Value) -> str:
    """Return a value as it stands in names; different values, also of different types, have different texts.

    Raises
    ------
    ValueError : it is neither a finite number nor true or false nor a text.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return int.__repr__(value)
    if isinstance(value, float) and math.isfinite(value):
        return float.__repr__(value)
    if isinstance(value, Named):
        return value_text(value.name)
    if isinstance(value, str):
        plain = _WORD.fullmatch(value) and value not in _NO_WORDS
        return value if plain else f"'{quote(value, safe='', errors='surrogatepass')}'"
    raise ValueError(f"{value!r} cannot be a value of an axis: a number, true, false or a text can, "
                     'and anything else as a variant, which has a name, or as {"name": .., "value": ..}')


def plain_values(values: Mapping[str, Value]) -> dict[str, Any]:
    """Return what the parameters are, as a file has them."""
    return {key: value.value if isinstance(value, Named) else value for key, value in values.items()}


def told_values(values: Mapping[str, Value]) -> dict[str, Any]:
    """Return what tables say of the parameters: of a named value its name."""
    return {key: value.name if isinstance(value, Named) else value for key, value in values.items()}


def run_key(variant: str, values: Mapping[str, Value]) -> str:
    """Name of the run of a variant (may be empty) with these values by key; "default" where there is neither."""
    parts = [variant] if variant else []
    parts += [f"{key}={value_text(value)}" for key, value in values.items()]
    return checked_key(",".join(parts) or "default")


def checked_key(key: str) -> str:
    """Return the name itself, where it can be that of a file.

    Raises
    ------
    ValueError : it cannot, on one of the file systems in use.
    """
    if not _FILE.fullmatch(key):
        raise ValueError(f"{key!r} cannot name a run: letters, digits and .,=+%'_~[]- can, and spaces between them")
    if len(key) > _LONGEST:
        raise ValueError(f"{key!r} is too long to name a run: {len(key)} bytes, at most {_LONGEST}")
    return key
