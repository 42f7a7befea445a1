"""Contents of the wheel: files of the repository, and their paths below `guidewire`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from experiments.packaging.imports import HOME, rewrite
from experiments.prepare import ROOT
from viewer.parts import THREE, three

# The first-party packages; one that is not there is left out.
PACKAGES = ("analysis", "anatomy", "environments", "experiments", "studies", "viewer")
_LEFT_OUT = {"tests", "headless", "__pycache__"}
_DATA = {  # folder, endings
    "params": (".json", ".csv", ".obj"), "instruments": (".json",), "viewer/page": (".js", ".html", ".css", ".json"),
    "environments": (".json", ".csv", ".obj"),
}
_FILES = ("docs/parameters.md", "analysis/guidewire.mplstyle")
_ENVIRONMENTS = '''"""Environments for reinforcement learning."""

from guidewire.environments import *  # noqa: F403
from guidewire.environments import __all__ as __all__
'''
_MAIN = '''"""`python -m guidewire` is the command `guidewire`."""

import sys

from guidewire import main

sys.exit(main())
'''


def sources() -> dict[str, str]:
    """Python files of the package by their place, imports rewritten.

    Raises
    ------
    UnclearImport : an import cannot be rewritten.
    """
    there = [package for package in PACKAGES if (ROOT / package / "__init__.py").is_file()]
    files = {"__init__.py": ROOT / "guidewire.py"}
    for package in there:
        files.update({str(path.relative_to(ROOT)): path for path in _below(ROOT / package, (".py",))})
    made = {place: rewrite(path.read_text(encoding="utf-8"), there, place) for place, path in files.items()}
    if "environments" in there:
        made["env.py"] = _ENVIRONMENTS
    return {**made, "__main__.py": _MAIN, "py.typed": ""}


def data() -> dict[str, Path]:
    """Other files of the package by their place."""
    files = {str(path.relative_to(ROOT)): path for folder, endings in _DATA.items()
             for path in _below(ROOT / folder, endings)}
    return {**files, **{name: ROOT / name for name in _FILES}}


def page(tell: Callable[[str], None]) -> dict[str, Path]:
    """What the page takes from npm, by its place; installed where it is not there, as `viewer.parts` says."""
    files = three(tell)
    place = THREE.relative_to(ROOT)
    licence = files["three.module.js"].parents[1] / "LICENSE"
    return {str(place / name): path for name, path in {**files, "LICENSE": licence}.items()}


def place_of(name: str) -> str:
    """Place in the wheel of what has this place below `guidewire`."""
    return f"{HOME}/{name}"


def _below(folder: Path, endings: tuple[str, ...]) -> Iterator[Path]:
    for path in sorted(folder.rglob("*")):
        if path.suffix in endings and path.is_file() and not _LEFT_OUT & set(path.relative_to(folder).parts[:-1]):
            yield path
