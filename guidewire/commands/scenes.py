"""`guidewire.py scenes`: the scenes that come with the program, and a copy of them to work with."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from guidewire.prepare import ROOT, PreparationError

SCENES = "params"


def names() -> list[str]:
    """Return the parameter files, such as params/default.json."""
    return [f"{SCENES}/{path.name}" for path in sorted((ROOT / SCENES).glob("*.json"))]


def copy(folder: Path) -> Path:
    """Copy them, with the meshes and tables that they name, into `params` of a folder; returns that.

    Raises
    ------
    PreparationError : a file of one of their names is there already; nothing is copied then.
    """
    source, place = ROOT / SCENES, folder / SCENES
    files = [path.relative_to(source) for path in sorted(source.rglob("*")) if path.is_file()]
    for file in files:
        if (place / file).exists():
            raise PreparationError(f"{os.path.relpath(place / file)} is there already: give another folder")
    for file in files:
        (place / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / file, place / file)
    return place
