"""The contents of instrument files as text: names, and each number with its basis and its source.

The numbers themselves are read by the program that simulates them; here they are only shown.
"""

from __future__ import annotations

import difflib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from guidewire.prepare import ROOT, PreparationError

FOLDER = "instruments"


@dataclass(frozen=True)
class Stated:
    """A number or a shape of a file: value with its unit, basis (measured, derived or assumed), and source."""

    what: str
    value: str
    basis: str
    source: str


def files() -> dict[str, Path]:
    """Name to file of all instruments: of two with one name that of the current folder, not the program's."""
    found: dict[str, Path] = {}
    for folder in (Path.cwd() / FOLDER, ROOT / FOLDER):
        for file in sorted(folder.glob("*.json")):
            found.setdefault(file.stem, file)
    return dict(sorted(found.items()))


def check_name(name: str) -> None:
    """Raises PreparationError, one line, for a name that no instrument has."""
    if name not in files():
        near = difflib.get_close_matches(name, files(), 1, 0.0)
        raise PreparationError(f"there is no instrument '{name}': did you mean '{near[0]}'?")


def read_stated(file: Path) -> list[Stated]:
    """Return all that a file states with a source, in its order."""
    return list(_stated(json.loads(file.read_text(encoding="utf-8-sig")), ""))


def _stated(content: Mapping[str, Any], path: str) -> Sequence[Stated]:
    found: list[Stated] = []
    for name, value in content.items():
        if isinstance(value, list) and name != "bends":
            for number, item in enumerate(value):
                found += _stated(item, f"{path}{name}[{number}].")
        elif isinstance(value, dict):
            text = str(value.get("value", value.get("shape", "")))
            text += f" ({value['coating']})" if "coating" in value else ""
            found.append(Stated(path + name, text, str(value.get("basis", "")), str(value.get("source", ""))))
    return found
