"""Logs of format npz: an array for each quantity; the first index is the entry.

A complete log is a zip of .npy files. What a killed run leaves is one .npy file of rows, an entry each, whose header
says 0 rows: as many as are whole in its length count.
"""

from __future__ import annotations

import re
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

_STRESS = ("kineticEnergy", "elasticEnergy", "potentialEnergy", "curvature", "couple", "strain", "force",
           "angularVelocity")
_HUB = {"hubInsertion": "insertion", "hubTurn": "turn", "hubForce": "force", "hubTorque": "torque",
        "tipDirection": "tipDirection", "twist": "twist", "largestCurvature": "largestCurvature",
        "lengthInBody": "lengthInBody"}
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
        self._names = names
        if self["step"].size == 0:
            raise ValueError("holds no whole step")

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._arrays[name]
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

    def entries(self) -> Iterator[tuple[int, dict[str, Any]]]:
        """Step and entry, as they stand in a log of format json."""
        columns = {name: self[name] for name in self._names}
        spheres = [str(index) for index in self.spheres]
        for k, step in enumerate(columns["step"].tolist()):
            entry = {name: columns[name][k].item() for name in ("totalTime", "elapsedMilliseconds", "delta")}
            entry["sphere"] = {
                index: dict(zip(("x", "y", "z", "vx", "vy", "vz"), (*place, *velocity)))
                for index, place, velocity in zip(spheres, columns["positions"][k].tolist(),
                                                  columns["velocities"][k].tolist())}
            if "orientations" in columns:
                entry["orientation"] = {str(j): dict(zip("xyzw", q))
                                        for j, q in enumerate(columns["orientations"][k].tolist())}
            if "curvature" in columns:
                entry["stress"] = {name: columns[name][k].tolist() for name in _STRESS}
            if "inBody" in columns:
                entry["inBody"] = int(columns["inBody"][k])
            if "hubForce" in columns:
                entry["hub"] = {key: _vector(columns[name][k]) if name == "tipDirection" else columns[name][k].item()
                                for name, key in _HUB.items() if name in columns}
            if self.catheters:
                entry["catheters"] = [_catheter(columns, name.removesuffix("Positions"), k) for name in self.catheters]
            if "contactForces" in columns:
                entry["contact"] = {
                    "total": _vector(columns["contactTotal"][k]), "reaction": _vector(columns["reaction"][k]),
                    "sphere": {str(i): _vector(force) for i, force in enumerate(columns["contactForces"][k])
                               if force.any()}}
            if "wallForces" in columns:
                entry["contact"]["wall"] = {str(w): _vector(force) for w, force in enumerate(columns["wallForces"][k])}
            if "elementForces" in columns:
                entry["contact"] |= {
                    "totalMean": _vector(columns["contactTotalMean"][k]),
                    "reactionAtEnd": _vector(columns["reactionAtEnd"][k]),
                    "pressure": columns["wallPressure"][k].item(),
                    "element": {str(j): _vector(force) for j, force in enumerate(columns["elementForces"][k])
                                if force.any()}}
            if "wallDisplacements" in columns:
                moved = columns["wallDisplacements"][k]
                entry["contact"] |= {
                    "largestDisplacement": np.linalg.norm(moved, axis=1).max().item(),
                    "displacement": {str(j): _vector(own) for j, own in enumerate(moved) if own.any()}}
            yield step, entry


def _read_rows(source: Path) -> np.ndarray:
    with open(source, "rb") as file:
        version = np.lib.format.read_magic(file)
        if version != (1, 0):
            raise ValueError(f"version {version} of .npy")
        _, _, kind = np.lib.format.read_array_header_1_0(file)
        start = file.tell()
    whole = (source.stat().st_size - start) // kind.itemsize
    return np.fromfile(source, dtype=kind, count=whole, offset=start)


def _catheter(columns: Mapping[str, np.ndarray], prefix: str, k: int) -> dict[str, Any]:
    names = {"Positions": "sphere", "Orientations": "orientation", "ContactForces": "contactForces",
             "WallDisplacements": "wallDisplacements"}
    whole = [name.removeprefix(prefix) for name in columns if re.fullmatch(prefix + r"[A-Z]\w*", name)]
    return {names.get(name, name.lower()): columns[prefix + name][k].tolist() for name in whole}


def _vector(values: np.ndarray) -> dict[str, float]:
    return dict(zip("xyz", values.tolist()))
