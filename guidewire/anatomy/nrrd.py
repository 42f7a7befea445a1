"""Voxels of NRRD files, those of 3D Slicer's segmentations with their segments among them. Those of a .nhdr are in
another file."""

from __future__ import annotations

import bz2
import hashlib
import re
from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.voxels import (
    NO_SIZES, Segment, Voxels, check_count, numbers_of, three_sizes, unpacked, voxels_beside,
    voxels_of,
)

_MM_OF = {"mm": 1.0, "cm": 10.0, "m": 1e3, "um": 1e-3, "µm": 1e-3, "micron": 1e-3}  # of a length in an NRRD file
_NRRD_TYPES = {
    "i1": ("signed char", "int8", "int8_t"), "u1": ("uchar", "unsigned char", "uint8", "uint8_t"),
    "i2": ("short", "short int", "signed short", "signed short int", "int16", "int16_t"),
    "u2": ("ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"),
    "i4": ("int", "signed int", "int32", "int32_t"), "u4": ("uint", "unsigned int", "uint32", "uint32_t"),
    "i8": ("longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"),
    "u8": ("ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"),
    "f4": ("float",), "f8": ("double",),
}


def read_nrrd(file: Path) -> Voxels:
    """Voxels, with the segments that 3D Slicer names in the header.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    data = file.read_bytes()
    if not data.startswith(b"NRRD"):
        raise AnatomyError("not a NRRD: it does not begin with 'NRRD'")
    end = re.search(rb"\r?\n\r?\n", data)
    head = data[:end.start() if end else len(data)].decode("utf-8", "replace").splitlines()[1:]
    fields, more = {}, {}
    for line in head:
        name, colon, value = line.partition(":")
        if colon and not line.startswith("#"):
            is_more = value.startswith("=")    # a key of who wrote the file, not of NRRD
            (more if is_more else fields)[name.strip().lower()] = value[is_more:].strip()
    named = fields.get("data file", fields.get("datafile", ""))
    if end is None and not named:
        raise AnatomyError("the header breaks off: no empty line ends it")
    packed = voxels_beside(file, named) if named else data[end.end():] if end else b""
    try:
        sizes = [int(word) for word in fields["sizes"].split()]
    except (KeyError, ValueError) as error:
        raise AnatomyError("the header has no sizes") from error
    rows, said = _directions(fields, len(sizes))
    kept = [k for k, n in enumerate(sizes) if n > 1 or rows[k] is not None]
    segments = _segments(more)
    layers = [k for k in kept if rows[k] is None]
    if layers and (not segments or len(layers) > 1):
        raise AnatomyError(f"{sizes[layers[0]]} numbers a voxel: a mask has one")
    three_sizes([sizes[k] for k in kept if k not in layers])
    stored = [sizes[k] for k in kept] if layers else three_sizes([sizes[k] for k in kept])
    check_count(stored)
    kind = next((kind for kind, names in _NRRD_TYPES.items() if fields.get("type", "").lower() in names), None)
    if kind is None:
        raise AnatomyError(f"voxels of the type '{fields.get('type', '')}': numbers are needed")
    dtype = np.dtype((">" if fields.get("endian", "little").lower() == "big" else "<") + kind)
    values = _encoded(packed, fields, dtype, stored)
    if layers:
        values = np.moveaxis(values, kept.index(layers[0]), -1)
    to_file = np.eye(4)
    to_file[:3, :3] = np.array([rows[k] for k in kept if rows[k] is not None][:3]).T
    origin = re.search(r"\(([^()]*)\)", fields.get("space origin", ""))
    if origin:
        to_file[:3, 3] = _numbers(origin[1].split(","), "space origin", 3)
    units = re.findall(r'"([^"]*)"', fields.get("space units", "")) or ["mm"]
    if units[0].lower() not in _MM_OF:
        raise AnatomyError(f"space units '{units[0]}': one of {', '.join(_MM_OF)} is needed")
    to_file[:3] *= _MM_OF[units[0].lower()]
    has_sizes = "space directions" in fields or "spacings" in fields
    return Voxels(values, to_file, said, segments=segments, notes=() if has_sizes else (NO_SIZES,),
                  sha256=hashlib.sha256(data + packed).hexdigest() if named else "")


def _segments(more: dict[str, str]) -> tuple[Segment, ...]:
    """Return those of 3D Slicer, whose keys are Segment0_Name, Segment0_LabelValue, Segment0_Layer and so on."""
    found = []
    for key, name in more.items():
        number = re.fullmatch(r"segment(\d+)_name", key)
        if number:
            value, layer = (more.get(f"segment{number[1]}_{word}", default)
                            for word, default in (("labelvalue", "1"), ("layer", "0")))
            if not (value.isdecimal() and layer.isdecimal()):
                raise AnatomyError(f"segment '{name}': its label value '{value}' or its layer '{layer}' is no number")
            found.append(Segment(name, int(value), int(layer)))
    return tuple(found)


def _encoded(data: bytes, fields: dict[str, str], dtype: np.dtype, sizes: list[int]) -> np.ndarray:
    encoding = fields.get("encoding", "raw").lower()
    for _ in range(_skipped(fields, "line")):
        _, mark, data = data.partition(b"\n")
        if not mark:
            raise AnatomyError("the file breaks off: it has fewer lines than its line skip")
    if encoding in ("gzip", "gz"):
        data = unpacked(data)
    elif encoding in ("bzip2", "bz2"):
        data = unpacked(data, bz2.decompress)
    elif encoding == "hex":
        data = unpacked(b"".join(data.split()), lambda text: bytes.fromhex(text.decode("ascii", "replace")))
    elif encoding in ("ascii", "text", "txt"):
        return numbers_of(data, sizes)
    elif encoding != "raw":
        raise AnatomyError(f"encoding '{encoding}': one of raw, gzip, bzip2, hex, ascii is needed")
    skip = _skipped(fields, "byte")
    data = data[len(data) - int(np.prod(sizes)) * dtype.itemsize if skip == -1 else max(skip, 0):]
    return voxels_of(data, dtype, sizes)


def _skipped(fields: dict[str, str], what: str) -> int:
    text = fields.get(f"{what} skip", fields.get(f"{what}skip", "0"))
    try:
        return int(text)
    except ValueError as error:
        raise AnatomyError(f"{what} skip '{text[:40]}': a whole number is needed") from error


def _directions(fields: dict[str, str], count: int) -> tuple[list[list[float] | None], str]:
    """Return the step from voxel to voxel along each axis, None where it is none of space; and the space that they are
    in."""
    if "space directions" in fields:
        rows = [None if match[0] == "none" else _numbers(match[1].split(","), "space directions", 3)
                for match in re.finditer(r"none|\(([^()]*)\)", fields["space directions"])]
        if len(rows) != count:
            raise AnatomyError(f"space directions of {len(rows)} axes: there are {count}")
        said = fields.get("space", "")
        return rows, "" if said.lower().startswith("scanner") else said.lower().replace("-time", "").replace(
            "3d-", "3D-")
    spacings = fields.get("spacings", " ".join(["1"] * count)).split()
    steps = _numbers(spacings, "spacings", count)
    found: list[list[float] | None] = []
    for step in steps:
        axis = len([row for row in found if row is not None])
        found.append(None if np.isnan(step) or axis == 3 else [step * float(k == axis) for k in range(3)])
    return found, ""


def _numbers(words: list[str], name: str, count: int) -> list[float]:
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != count:
        raise AnatomyError(f"{name} with '{','.join(words)[:40]}': {count} numbers are needed")
    return numbers
