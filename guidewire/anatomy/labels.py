"""Which voxels of a mask are taken: by values, by names of a table, or by the segments of 3D Slicer."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np

from guidewire.anatomy.images import Image
from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.voxels import Segment

_LISTED = 12
_VALUES = ("labelvalue", "label", "value", "index", "id", "integerlabel")  # headings of a table, in small letters
_NAMES = ("name", "segment", "structure", "text", "labelname")


def read_names(file: Path) -> tuple[Segment, ...]:
    """Names of values, from a .json or a .csv.

    The JSON is an object of names and values, in either direction, or has one under "labels". The table has the
    headings value (or label, labelvalue, index, id) and name (or segment, structure), as 3D Slicer's tables of colours
    do.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    try:
        text = file.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise AnatomyError(f"{file}: {getattr(error, 'strerror', None) or 'not a text in UTF-8'}") from error
    pairs = _of_json(file, text) if file.name.lower().endswith(".json") else _of_table(file, text)
    if not pairs:
        raise AnatomyError(f"{file}: no names of labels")
    return tuple(Segment(name, value) for name, value in pairs)


def _of_json(file: Path, text: str) -> list[tuple[str, float]]:
    try:
        content = json.loads(text)
        content = content.get("labels", content)
        pairs = [(str(key), one) if isinstance(one, (int, float)) else (str(one), float(key))
                 for key, one in content.items()]
    except (ValueError, TypeError, AttributeError, RecursionError) as error:
        raise AnatomyError(f"{file}: not an object of names and values, such as {{\"aorta\": 1}}") from error
    return [(name, float(value)) for name, value in pairs]


def _of_table(file: Path, text: str) -> list[tuple[str, float]]:
    lines = text.splitlines()
    separator = next((mark for mark in ";\t" if lines and mark in lines[0]), ",")
    rows = [row for row in csv.reader(lines, delimiter=separator) if row]
    headings = ["".join(word.lower().replace("_", "").split()) for word in rows[0]] if rows else []
    places = [next((headings.index(word) for word in words if word in headings), None) for words in (_VALUES, _NAMES)]
    if None in places:
        raise AnatomyError(f"{file}: a .json, or a table with the headings value and name, is needed")
    try:
        return [(row[places[1]].strip(), float(row[places[0]])) for row in rows[1:]]
    except (ValueError, IndexError) as error:
        raise AnatomyError(f"{file}: a row is no value and name") from error


def voxels_with(image: Image, labels: str | None, segments: str | None) -> tuple[np.ndarray, str, tuple[str, ...]]:
    """(i, j, k) of bool: the voxels of labels or segments; the words for what was asked; and names left out.

    labels : values or names with commas between them; segments : names alone.

    Raises
    ------
    AnatomyError : there is none of such a name, or the image has several layers and no segment is asked for.
    """
    values = image.values
    if segments is None and values.ndim == 4:
        raise AnatomyError(f"{values.shape[3]} layers of segments that overlap: --segment takes one or more of "
                           f"{_told(image.segments, with_layers=True)}")
    option = "label" if segments is None else "segment"
    asked = segments if segments is not None else labels or ""
    if segments is not None and not image.segments:
        raise AnatomyError(f"--segment {segments}: the file names no segments; --label takes values of voxels")
    chosen = [_find(image, word, option) for word in _words(asked, image.segments)]
    inside = np.zeros(values.shape[:3], dtype=bool)
    for one in chosen:
        layer = values if values.ndim == 3 else values[..., min(one.layer, values.shape[3] - 1)]
        inside |= np.isclose(layer, one.value, rtol=1e-6, atol=1e-6)    # a file's own factor may round
    others = tuple(f"'{one.name}'" for one in image.segments if one.value != 0.0 and one not in chosen)
    if not image.segments:
        others = tuple(f"{value:g}" for value in values_of(values)
                       if value != 0.0 and not any(np.isclose(value, one.value) for one in chosen))
    return inside, f"--{option} {asked}: ", others


def _words(asked: str, segments: tuple[Segment, ...]) -> list[str]:
    """Return the words between commas; a name may have commas itself."""
    if any(asked.strip().lower() == segment.name.lower() for segment in segments):
        return [asked]
    return asked.split(",")


def _find(image: Image, word: str, option: str) -> Segment:
    named = [segment for segment in image.segments if segment.name.lower() == word.strip().lower()]
    if len(named) == 1:
        return named[0]
    if len(named) > 1:
        raise AnatomyError(f"--{option} {word.strip()}: {len(named)} segments have this name")
    try:
        if option == "label":
            value = float(word)
            return next((one for one in image.segments if one.value == value), Segment("", value))
    except ValueError:
        pass
    raise AnatomyError(f"--{option} {word.strip()}: there is no such {'segment' if image.segments else 'number'}"
                       + (f": there are {_told(image.segments, image.values.ndim == 4)}" if image.segments else
                          "; names of labels come with --label-names FILE, or from the header of a .seg.nrrd"))


def _told(segments: tuple[Segment, ...], with_layers: bool) -> str:
    return ", ".join(f"'{one.name}' ({f'layer {one.layer}, ' if with_layers else ''}label {one.value:g})"
                     for one in segments[:_LISTED]) + (", .." if len(segments) > _LISTED else "")


def values_of(values: np.ndarray) -> np.ndarray:
    """Return the different values of an array, ascending."""
    if values.dtype.kind in "iu" and values.dtype.itemsize <= 2:    # counting is many times as fast as sorting
        low = int(values.min())
        return np.flatnonzero(np.bincount((values.ravel().astype(np.int32) - low))) + low
    return np.unique(values)


def told_values(image: Image, found: np.ndarray, most: int) -> str:
    """Return the values of an image, with their names, for a line."""
    names = {segment.value: f" '{segment.name}'" for segment in image.segments}
    return (", ".join(f"{value:g}{names.get(float(value), '')}" for value in found) if len(found) <= most
            else f"from {found[0]:g} to {found[-1]:g}")
