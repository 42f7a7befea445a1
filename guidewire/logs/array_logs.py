"""Logs of format npz: an array for each quantity; the first index is the entry.

A complete log is a zip of .npy files. What a killed run leaves is one .npy file of rows, an entry each, whose header
says 0 rows: as many as are whole in its length count.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.logs.entries import OLDER_NAMES, entry_of

_NEEDED = ("step", "totalTime", "elapsedMilliseconds", "delta", "firstSphere", "positions", "velocities")


class ArrayLog:
    """One log; an array is read when it is asked for.

    Attributes
    ----------
    warning : one line where the log ends before the run did, else None.

    Raises
    ------
    OSError : the file cannot be read.
    ValueError : it is no such log, or holds no whole entry; one line without the file's name.
    """

    def __init__(self, source: Path) -> None:
        self.warning: str | None = None
        try:
            if zipfile.is_zipfile(source):
                self._arrays: Any = np.load(source, allow_pickle=False)
                names = set(self._arrays.files)
            else:
                self._arrays = _read_rows(source)
                names = set(self._arrays.dtype.names or ())
                self.warning = f"{source}: cut short, read up to step {self._arrays['step'][-1]}, its last whole step"
        except (ValueError, IndexError, zipfile.BadZipFile) as error:
            raise ValueError(f"not a position log ({error})") from error
        if not names.issuperset(_NEEDED):
            raise ValueError(f"not a position log (it has no {', '.join(sorted(set(_NEEDED) - names))})")
        self._older = {older: name for name, older in OLDER_NAMES.items() if older in names}
        self._names = {self._older.get(name, name) for name in names}
        if self["step"].size == 0:
            raise ValueError("holds no whole step")

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._arrays[next((older for older, new in self._older.items() if new == name), name)]
        except zipfile.BadZipFile as error:
            raise ValueError(f"not a position log ({error})") from error

    def __contains__(self, name: str) -> bool:
        return name in self._names

    @property
    def spheres(self) -> np.ndarray:
        """Indices of the spheres that it holds."""
        return self["firstSphere"][0] + np.arange(self["positions"].shape[1])

    @property
    def catheters(self) -> list[str]:
        """Names of the arrays of the catheters' positions, outermost first."""
        return sorted((name for name in self._names if re.fullmatch(r"catheter\d*Positions", name)),
                      key=lambda name: (len(name), name))

    def columns(self, names: Iterable[str] | None = None) -> dict[str, np.ndarray]:
        """Arrays by their names, those of `names` that the log has, or all; the first index counts entries."""
        columns = {name: self[name] for name in (self._names if names is None else names) if name in self}
        if names is None and "wallDisplacements" in columns and "largestDisplacement" not in columns:    # older logs
            columns["largestDisplacement"] = np.linalg.norm(columns["wallDisplacements"], axis=2).max(axis=1)
        return columns

    def entries(self) -> Iterator[tuple[int, dict[str, Any]]]:
        """Step and entry, as they stand in a log of format json."""
        columns = self.columns()
        for k, step in enumerate(columns["step"].tolist()):
            yield step, entry_of(columns, k)


def _read_rows(source: Path) -> np.ndarray:
    with open(source, "rb") as file:
        version = np.lib.format.read_magic(file)
        if version != (1, 0):
            raise ValueError(f"version {version} of .npy")
        _, _, kind = np.lib.format.read_array_header_1_0(file)
        start = file.tell()
    whole = (source.stat().st_size - start) // kind.itemsize
    return np.fromfile(source, dtype=kind, count=whole, offset=start)
