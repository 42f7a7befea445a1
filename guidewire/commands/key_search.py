"""`guidewire.py keys`: the keys of parameter files, from the runner."""

from __future__ import annotations

import difflib
from collections.abc import Mapping

from guidewire.prepare import PreparationError
from guidewire.runs.key_table import Key


def find_keys(table: Mapping[str, Key], word: str, solver: str) -> list[Key]:
    """Keys that hold a word in their name, and then those that hold it in what they mean or allow; all without a word.

    Parameters
    ----------
    table : as the runner prints it.
    word : such as "friction", or a part of a key, "vessel.radius"; whatever its case.
    solver : that takes them; empty: any.

    Raises
    ------
    PreparationError : no key of that solver holds it.
    """
    own = [key for key in table.values() if not solver or solver in key.solvers]
    asked = word.lower().split(".")[0].split("[")[0]
    named = [key for key in own if asked in key.name.lower()]
    found = named + [key for key in own if key not in named and asked in f"{key.meaning} {key.allowed}".lower()]
    if not found:
        by_small = {key.name.lower(): key.name for key in own}
        near = [by_small[name] for name in difflib.get_close_matches(asked, by_small, 3)]
        takes = f"solver {solver} takes no key with" if solver else "no key has"
        raise PreparationError(f"{takes} '{word}': " + (f"near are {', '.join(near)}" if near else "'keys' lists all"))
    return found


def describe(key: Key) -> str:
    """Return what a key allows, who takes it and what it means, in two lines."""
    return (f"{key.name}: {key.allowed}; default {key.default}; solver {', '.join(key.solvers)}\n"
            f"    {key.meaning}")
