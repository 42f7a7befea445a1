"""Contents of the wheel by their place below `guidewire`: the package itself, and the repository's data."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from guidewire.prepare import ROOT
from guidewire.viewer.parts import THREE, three

HOME = "guidewire"
PACKAGE = ROOT / HOME
_LEFT_OUT = {"tests", "__pycache__"}
_OF_THE_PACKAGE = (".py", ".typed", ".json", ".csv", ".obj", ".js", ".html", ".css", ".mplstyle")
_DATA = {"params": (".json", ".csv", ".obj"), "instruments": (".json",)}  # folder beside the package, endings
_FILES = ("docs/parameters.md",)


def files() -> dict[str, Path]:
    """Files of the package, and data, by place."""
    found = {path.relative_to(PACKAGE).as_posix(): path for path in _below(PACKAGE, _OF_THE_PACKAGE)}
    for folder, endings in _DATA.items():
        found.update({path.relative_to(ROOT).as_posix(): path for path in _below(ROOT / folder, endings)})
    return {**found, **{name: ROOT / name for name in _FILES}}


def page(tell: Callable[[str], None]) -> dict[str, Path]:
    """What the page takes from npm, by its place; installed where it is not there, as `viewer.parts` says."""
    found = three(tell)
    place = THREE.relative_to(PACKAGE).as_posix()
    licence = found["three.module.js"].parents[1] / "LICENSE"
    return {f"{place}/{name}": path for name, path in {**found, "LICENSE": licence}.items()}


def place_of(name: str) -> str:
    """Place in the wheel of what has this place below `guidewire`."""
    return f"{HOME}/{name}"


def _below(folder: Path, endings: tuple[str, ...]) -> Iterator[Path]:
    for path in sorted(folder.rglob("*")):
        if path.suffix in endings and path.is_file() and not _LEFT_OUT & set(path.relative_to(folder).parts[:-1]):
            yield path
