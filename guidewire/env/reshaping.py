"""Vessels of a drawn shape: all of a vessel moved by a smooth field, and the wire's direction at its inlet tilted."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.spaces import Error

STRAIN = 0.08  # of a coefficient of 1: of nine at most 0.24 together, so that no place meets another one
MOST_TILT = 30.0  # degrees
_ANATOMY = "anatomy.json"


class Field:
    """A displacement of space: along each axis a sum of three waves, one along each axis, as long as the vessel's
    diagonal.

    Parameters
    ----------
    box : (2, 3), corners of the box around the vessel, in its own units.
    coefficients : nine from -1 to 1: of the displacement along x the waves along x, y and z, then along y, then z.
    """

    def __init__(self, box: np.ndarray, coefficients: Sequence[float]) -> None:
        low, high = box
        self._middle, self._wave = 0.5 * (low + high), 2.0 * math.pi / float(np.linalg.norm(high - low))
        self._strains = STRAIN * np.array(coefficients, dtype=float).reshape(3, 3)

    def moved(self, points: np.ndarray) -> np.ndarray:
        """Say where points (n, 3) go."""
        return points + np.sin(self._wave * (points - self._middle)) @ self._strains.T / self._wave

    def gradients(self, points: np.ndarray) -> np.ndarray:
        """Return (n, 3, 3): what small vectors at points (n, 3) are multiplied by."""
        return np.eye(3) + self._strains * np.cos(self._wave * (points - self._middle))[:, None, :]


def reshaped(scene: Mapping[str, Any], anatomy: Mapping[str, Any], warp: Sequence[float] | None,
             entry: Sequence[float] | None, folder: Path) -> tuple[dict[str, Any], Mapping[str, Any]]:
    """Return a scene with another vessel, whose anatomy is written into a folder, and that anatomy. The core moves the
    mesh, by the same field.

    Parameters
    ----------
    scene, anatomy : of the vessel as it is.
    warp : coefficients of a Field, or None.
    entry : tilt of the inlet about two axes across it, degrees, or None.

    Raises
    ------
    Error : the numbers are not allowed, or the vessel is no mesh that can be moved; one line.
    """
    _check("warp", warp, 9, 1.0)
    _check("entry", entry, 2, MOST_TILT)
    vessel, anatomy = dict(scene["vessel"]), json.loads(json.dumps(anatomy))
    if warp is not None and any(warp):
        file = Path(vessel.get("file", ""))
        if file.suffix.lower() != ".obj":
            raise Error(f"random \"warp\" is not allowed: it needs a vessel that is a mesh in a file .obj, not {file}")
        vessel["warp"] = [float(one) for one in warp]
        # The rims of the mesh as it is in its file.
        vessel.setdefault("openRims", {end["name"]: end["centre"] for end in anatomy["ends"] if end["open"]})
        field = Field(_box(file), warp)
        _move(anatomy, field)
        if isinstance(vessel.get("motion"), Mapping) and "centreline" in vessel["motion"]:
            unit = float(vessel.get("metresPerUnit", scene.get("metresPerUnit", 1e-3)))
            table = _moved_table(Path(vessel["motion"]["centreline"]), field, unit, folder)
            vessel["motion"] = {**vessel["motion"], "centreline": str(table)}
    if entry is not None and any(entry):
        end = _inlet(anatomy, scene.get("inlet"))
        end["direction"] = _tilted(np.array(end["direction"]), entry).tolist()
    (folder / _ANATOMY).write_text(json.dumps(anatomy), encoding="utf-8")
    vessel["anatomy"] = str(folder / _ANATOMY)
    return {**scene, "vessel": vessel}, anatomy


def _move(anatomy: dict[str, Any], field: Field) -> None:
    """Centreline and ends where the field moves them; a radius by what is left of it across the centreline."""
    line = anatomy["centreline"]
    points, parents = np.array(line["points"], dtype=float), np.array(line["parents"])
    places, radii = points[:, :3], points[:, 3]
    before = np.maximum(parents, 0)
    before[0] = int(np.argmax(parents == 0))
    along = places - places[before]
    along[0] *= -1.0
    gradients = field.gradients(places)
    shrunk = _across(gradients, along)
    line["points"] = np.c_[field.moved(places), shrunk * radii].tolist()
    for end in anatomy["ends"]:
        centre = np.array([end["centre"]], dtype=float)
        direction = field.gradients(centre)[0] @ np.array(end["direction"], dtype=float)
        end["centre"] = field.moved(centre)[0].tolist()
        end["direction"] = (direction / np.linalg.norm(direction)).tolist()
        end["radius"] *= float(shrunk[end["point"]])


def _moved_table(file: Path, field: Field, unit: float, folder: Path) -> Path:
    """Write what a centreline does with its places at rest where the field moves them, and return that file. Its
    displacements stay.

    unit : of the field, m.
    """
    from guidewire.anatomy.motion import SIZES    # needs scipy

    with open(file, encoding="utf-8-sig", newline="") as text:
        head, *rows = [row for row in csv.reader(text) if row and not row[0].lstrip().startswith("#")]
    names = [name.strip().partition("_") for name in head]
    columns = [next(k for k, (name, _, _) in enumerate(names) if name == axis) for axis in "xyz"]
    sizes = np.array([SIZES.get(names[k][2], 1.0) / unit for k in columns])
    places = np.array([[row[k] for k in columns] for row in rows], dtype=float)
    for row, place in zip(rows, field.moved(places * sizes) / sizes):
        for k, value in zip(columns, place.tolist()):
            row[k] = repr(value)
    moved = folder / file.name
    with open(moved, "w", encoding="utf-8", newline="") as text:
        csv.writer(text).writerows([head, *rows])
    return moved


def _across(gradients: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Return (n,): the least stretch of a section across (n, 3), seen along where that goes."""
    thin = np.argmin(np.abs(along), axis=1)
    first = np.cross(along, np.eye(3)[thin])
    first /= np.maximum(np.linalg.norm(first, axis=1), 1e-300)[:, None]
    second = np.cross(along, first)
    second /= np.maximum(np.linalg.norm(second, axis=1), 1e-300)[:, None]
    moved = np.einsum("nij,njk->nik", gradients, np.stack([first, second], axis=2))
    axis = np.einsum("nij,nj->ni", gradients, along)
    axis /= np.maximum(np.linalg.norm(axis, axis=1), 1e-300)[:, None]
    moved -= axis[:, :, None] * np.einsum("ni,nik->nk", axis, moved)[:, None, :]
    return np.linalg.svd(moved, compute_uv=False)[:, -1]


def _inlet(anatomy: dict[str, Any], inlet: Any) -> dict[str, Any]:
    for end in anatomy["ends"]:
        if not isinstance(inlet, bool) and str(inlet).strip().lower() in (str(end["number"]), end["name"].lower()):
            return end
    raise Error(f"random \"entry\" is not allowed: it needs an inlet that is an end of the vessel, not {inlet!r}")


def _tilted(direction: np.ndarray, degrees: Sequence[float]) -> np.ndarray:
    """By so many degrees about two axes across: as far as their root of squares says, about one axis."""
    first = np.cross(direction, np.eye(3)[int(np.argmin(np.abs(direction)))])
    first /= np.linalg.norm(first)
    second = np.cross(direction, first)
    turn = math.radians(degrees[0]) * first + math.radians(degrees[1]) * second
    angle = float(np.linalg.norm(turn))
    return math.cos(angle) * direction + math.sin(angle) * np.cross(turn / angle, direction)


def _check(name: str, numbers: Sequence[float] | None, count: int, most: float) -> None:
    if numbers is not None and (np.shape(numbers) != (count,) or not (np.abs(numbers) <= most).all()):
        raise Error(f"random \"{name}\" = {numbers!r} is not allowed: needs {count} numbers from {-most:g} to {most:g}")


@lru_cache(maxsize=16)
def _box(file: Path) -> np.ndarray:
    """(2, 3): corners of the box around a mesh."""
    try:
        lines = file.read_text(encoding="utf-8").splitlines()
        vertices = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], dtype=float)
    except (OSError, ValueError) as error:
        raise Error(f"{file}: {error}") from error
    return np.array([vertices.min(axis=0), vertices.max(axis=0)])
