"""Checks of a run's arguments before anything is built, so that a typing error does not cost a build.

Whatever is refused here the runner would refuse too; what is let pass here, such as keys that do not go together, the
runner still checks. Its table of keys is taken from docs/parameters.md.
"""

from __future__ import annotations

import difflib
import json
import re
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from guidewire.json_text import problem_of
from guidewire.prepare import DOOR, ROOT, PreparationError
from guidewire.runs import building
from guidewire.runs.key_table import Key, parse_key_table, read_key_table

_TABLE = ROOT / "docs" / "parameters.md"
_PART = re.compile(r"[.\[]")  # behind a key: what follows names a part of it, which the runner looks for
_BEYOND_DOUBLE = 1 << 1024
_CLOSE = 0.85  # of two words, by difflib: a letter or two of eight are wrong
_LONGEST = 80  # characters of a value or a path that a line shows


def check_file(file: Path) -> None:
    """Raises PreparationError, one line, where a parameter file cannot be read or holds what no run takes."""
    try:
        text = file.read_text(encoding="utf-8-sig")
        content = json.loads(text)
    except OSError as error:
        raise PreparationError(f"{file}: {error.strerror}: give a parameter file, such as params/default.json"
                               ) from error
    except json.JSONDecodeError as error:
        raise PreparationError(f"{file}: not JSON: {problem_of(text, error)}") from error
    except (ValueError, RecursionError) as error:
        raise PreparationError(f"{file}: not JSON: {error}") from error
    if not isinstance(content, dict):
        raise PreparationError(f"{file}: not a JSON object of keys and values, such as {{\"timeStep\": 0.01}}")
    if "study" in content:
        raise PreparationError(f"{file}: a study, not a parameter file: '{DOOR} sweep {file}' makes its runs")
    table = read_table()
    for name, value in content.items():
        _check(table, name, value, str(file), json.dumps(value), content.get("solver", "pbd"))


def check_overrides(overrides: Sequence[tuple[str, str]]) -> None:
    """Raises PreparationError, one line, for a key that is not known or a number out of its range."""
    table = read_table()
    for name, text in overrides:
        try:
            value: Any = float(text)
        except ValueError:
            value = text
        _check(table, name, value, "command line", text)


def check_out(folder: Path) -> None:
    """Raises PreparationError, one line, where a folder can be neither written to nor made. Leaves nothing."""
    above = folder.absolute()
    try:
        while not above.exists() and above != above.parent:
            above = above.parent
        if not above.is_dir():
            raise NotADirectoryError(0, f"{_short(above)} is a file")
        _try_name(above, folder)
        with tempfile.TemporaryFile(dir=above):
            pass
    except OSError as error:
        raise PreparationError(f"out = {_short(folder)} cannot be written ({error.strerror}): give a folder that this "
                               "user may write to") from error


def _try_name(above: Path, folder: Path) -> None:
    """Make the folders that are missing and take them away again: only the system knows which names it takes."""
    missing = folder.absolute().relative_to(above).parts
    made: list[Path] = []
    try:
        for part in missing:
            path = (made[-1] if made else above) / part
            path.mkdir()
            made.append(path)
    finally:
        for path in reversed(made):
            path.rmdir()


def read_table() -> dict[str, Key]:
    """Return every key by name; none where the page that has them cannot be read."""
    try:
        return parse_key_table(_TABLE.read_text(encoding="utf-8").split("<!-- keys -->")[1])
    except (OSError, ValueError, IndexError):
        return {}  # the page is gone or of another version: the runner says what is wrong


def read_built_table(command: Sequence[str] | None = None) -> dict[str, Key]:
    """Return every key of a runner, a new one among them that the page does not have; where none is built those of the
    page.

    Parameters
    ----------
    command : of the runner; None: the one that is built, be it of what is there now or not.
    """
    command = command or building.built(building.RUNNER)
    try:
        return read_key_table(command) if command else read_table()
    except (OSError, ValueError, subprocess.CalledProcessError):
        return read_table()


def unit_of(name: str) -> str:
    """Unit of a key; empty where it has none, or is none."""
    key = read_table().get(name)
    found = re.search(r"\(([^()]+)\)$", key.allowed) if key else None
    return found[1] if found and key.kind in ("number", "whole", "vector") else ""


def _check(table: dict[str, Key], name: str, value: Any, source: str, shown: str, solver: str | None = None) -> None:
    if not table:
        return
    whole = _PART.split(name, maxsplit=1)[0]
    key = table.get(whole)
    if key is None:
        by_small = {known.lower(): known for known in table if solver is None or solver in table[known].solvers}
        near = difflib.get_close_matches(whole.lower(), by_small, n=1, cutoff=_CLOSE)
        if not near or whole in read_built_table():
            return  # the runner knows what else it may be called
        hint = f"did you mean '{by_small[near[0]]}{name[len(whole):]}'?"
        raise PreparationError(f"{source}: unknown key '{_short(name)}': {hint}")
    is_null = value is None or shown == "null"
    if (name != whole or key.kind not in ("number", "whole") or (is_null and key.may_be_null) or value in key.words
            or shown in key.words):
        return
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < _BEYOND_DOUBLE
    if not is_number or not key.holds(value) or (key.kind == "whole" and value != int(value)):
        raise PreparationError(f"{source}: {name} = {_short(shown)} is not allowed: needs {key.allowed}")


def _short(text: object) -> str:
    shown = " ".join(str(text).splitlines())
    return shown if len(shown) <= _LONGEST else shown[:_LONGEST - 3] + "..."
