"""The runner's own table of parameters, as `--keys` prints it and docs/parameters.md holds it: what each key allows
and which methods take it."""

from __future__ import annotations

import math
import re
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

_ROW = re.compile(r"^\| `(?P<name>\w+)` \| (?P<allowed>.*) \| `(?P<default>.*)` \| "
                  r"(?P<solvers>[^|]*) \| (?P<meaning>.*) \|$")
_KINDS = {
    "true or false": "switch", "one of": "word", "a number": "number", "a whole number": "whole",
    "three numbers": "vector", "a text": "text", "a list": "list", "null, {": "object", "null or {": "object",
    "null or three numbers": "vector",
    "null or a number": "number", "null, true": "switch",
    "null or a list": "list", "null, a name": "end", '"" or three letters': "text",
}
_WHOLE = re.compile(r"from (\d+) to (\d+)")
_LOW = re.compile(r"(>=?) ([^\s,]+)")
_HIGH = re.compile(r"<= (\S+)")


@dataclass(frozen=True)
class Key:
    """One key of the table.

    Attributes
    ----------
    name : as it stands in files.
    kind : "switch", "word", "number", "whole", "vector", "text", "list", "object" or "end" (of a vessel).
    solvers : words of the methods that take it.
    words : what a key of kind "word" allows, and one of kind "number" beside numbers.
    low, high : the range of a number; infinite where there is no border.
    low_is_allowed : whether `low` itself is.
    needs_length : whether a vector must differ from 0.
    may_be_null : whether null is allowed.
    allowed, default, meaning : what is allowed, the default and what the key means, in words.
    """

    name: str
    kind: str
    solvers: tuple[str, ...]
    words: tuple[str, ...] = ()
    low: float = -math.inf
    high: float = math.inf
    low_is_allowed: bool = True
    needs_length: bool = False
    may_be_null: bool = False
    allowed: str = ""
    default: str = ""
    meaning: str = ""

    def holds(self, number: float) -> bool:
        """Return whether a number lies in the range; one that is none does not."""
        above = number >= self.low if self.low_is_allowed else number > self.low
        return math.isfinite(number) and above and number <= self.high


def read_key_table(command: Sequence[str]) -> dict[str, Key]:
    """Name to key, in the table's order, of the runner that `command` starts."""
    done = subprocess.run([*command, "--keys"], capture_output=True, text=True, check=True)
    return parse_key_table(done.stdout)


def parse_key_table(text: str) -> dict[str, Key]:
    """Name to key, in the table's order.

    Raises ValueError where a row of the table is written in another way.
    """
    rows = [_ROW.match(line) for line in text.splitlines() if line.startswith("| `")]
    if not rows or not all(rows):
        raise ValueError("a row of the table of keys cannot be read")
    solver = next(row for row in rows if row["name"] == "solver")
    methods = _words(solver["allowed"])
    keys = [_key(row, methods) for row in rows]
    return {key.name: key for key in keys}


def _words(allowed: str) -> tuple[str, ...]:
    return tuple(re.findall(r'"(\w+)"', allowed))


def _key(row: re.Match[str], methods: tuple[str, ...]) -> Key:
    allowed, solvers = row["allowed"], row["solvers"]
    kind = next(kind for start, kind in _KINDS.items() if allowed.startswith(start))
    taken = methods if solvers == "all" else tuple(re.split(", | or ", solvers))
    assert set(taken) <= set(methods), row["name"]
    low, high, low_is_allowed = -math.inf, math.inf, True
    if kind == "whole":
        low, high = map(float, _WHOLE.search(allowed).groups())
    elif kind == "number":
        if found := _LOW.search(allowed):
            low, low_is_allowed = float(found[2].rstrip(",")), found[1] == ">="
        if found := _HIGH.search(allowed):
            high = float(found[1])
    return Key(
        row["name"], kind, taken, words=_words(allowed) if kind in ("word", "number") else (), low=low, high=high,
        low_is_allowed=low_is_allowed, needs_length="not all 0" in allowed, may_be_null=allowed.startswith("null"),
        allowed=allowed, default=row["default"], meaning=row["meaning"],
    )


def own_keys(table: Mapping[str, Key], solver: str) -> set[str]:
    """Return those that a method takes."""
    return {name for name, key in table.items() if solver in key.solvers}


def foreign_keys(table: Mapping[str, Key], solver: str) -> list[str]:
    """Return those that it does not take."""
    return [name for name, key in table.items() if solver not in key.solvers]
