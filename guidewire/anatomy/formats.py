"""File extensions of vessels, without the packages needed to read them."""

from __future__ import annotations

from pathlib import Path

MESHES = (".stl", ".obj", ".ply", ".vtp")
MASKS = (".nii", ".nii.gz", ".nrrd")
CENTRELINES = (".csv", ".mrk.json")
ENDINGS = (*MESHES, *MASKS, *CENTRELINES)


def is_anatomy(file: Path) -> bool:
    """Whether a path is named as a file that `guidewire.py anatomy` reads, and is no folder."""
    return not file.is_dir() and file.name.lower().endswith(ENDINGS)
