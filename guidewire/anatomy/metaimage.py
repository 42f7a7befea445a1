"""Voxels of MetaImage files (.mha, and .mhd with its voxels in another file), as ITK writes them.

The first three numbers of TransformMatrix are where the first index goes, and positions are in LPS, which ITK takes for
granted. https://itk.org/Wiki/ITK/MetaIO/Documentation
"""

from __future__ import annotations

import hashlib
import re
import zlib
from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.voxels import NO_SIZES, Voxels, numbers_of, three_sizes, unpacked, voxels_beside, voxels_of

_TYPES = {"CHAR": "i1", "UCHAR": "u1", "SHORT": "i2", "USHORT": "u2", "INT": "i4", "UINT": "u4", "LONG": "i4",
          "ULONG": "u4", "LONG_LONG": "i8", "ULONG_LONG": "u8", "FLOAT": "f4", "DOUBLE": "f8"}
_HEAD = 1 << 16  # bytes within which a header ends


def read_metaimage(file: Path) -> Voxels:
    """Read voxels in LPS.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    data = file.read_bytes()
    end = re.search(rb"^[ \t]*ElementDataFile[ \t]*=[ \t]*([^\r\n]*?)[ \t]*\r?\n", data[:_HEAD], re.MULTILINE)
    if end is None:
        raise AnatomyError("not a MetaImage, or its header breaks off: it has no line ElementDataFile")
    named = "" if end[1] == b"LOCAL" else end[1].decode("utf-8", "replace")
    fields = {}
    for line in data[:end.start()].decode("utf-8", "replace").splitlines():
        name, _, value = line.partition("=")
        fields[name.strip().lower()] = value.strip()
    sizes = [int(number) for number in _numbers(fields, ("dimsize",), None)]
    three = three_sizes(sizes)
    dimensions = len(sizes)
    if _numbers(fields, ("elementnumberofchannels",), 1, [1.0])[0] != 1.0:
        raise AnatomyError(f"{fields['elementnumberofchannels']} numbers a voxel: a mask has one")
    said = fields.get("elementtype", "")
    if said.removeprefix("MET_") not in _TYPES:
        raise AnatomyError(f"voxels of the type '{said}': numbers are needed")
    is_big = _is_true(fields, "binarydatabyteordermsb") or _is_true(fields, "elementbyteordermsb")
    dtype = np.dtype((">" if is_big else "<") + _TYPES[said.removeprefix("MET_")])
    voxels = voxels_beside(file, named) if named else data[end.end():]
    skip = int(_numbers(fields, ("headersize",), 1, [0.0])[0])
    read = hashlib.sha256(data + voxels).hexdigest() if named else ""
    voxels = voxels[len(voxels) - int(np.prod(three)) * dtype.itemsize if skip == -1 else max(skip, 0):]
    if _is_true(fields, "compresseddata"):
        voxels = unpacked(voxels, zlib.decompress)
    is_binary = fields.get("binarydata", "True").lower() == "true"
    values = voxels_of(voxels, dtype, three) if is_binary else numbers_of(voxels, three)
    spacing = _numbers(fields, ("elementspacing", "elementsize"), dimensions, [1.0] * dimensions)
    turn = np.array(_numbers(fields, ("transformmatrix", "rotation", "orientation"), dimensions**2,
                             np.eye(dimensions).ravel().tolist())).reshape(dimensions, dimensions)
    origin = _numbers(fields, ("offset", "position", "origin"), dimensions, [0.0] * dimensions)
    to_file = np.eye(4)
    to_file[:3, :3] = turn[:3, :3].T * np.array(spacing[:3])
    to_file[:3, 3] = origin[:3]
    has_sizes = "elementspacing" in fields or "elementsize" in fields
    return Voxels(values, to_file, "LPS", notes=() if has_sizes else (NO_SIZES,), sha256=read)


def _numbers(fields: dict[str, str], names: tuple[str, ...], count: int | None, default: list[float] | None = None
             ) -> list[float]:
    name = next((name for name in names if name in fields), None)
    if name is None and default is not None:
        return default
    text = fields.get(name, "") if name else ""
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        numbers = []
    if not numbers or len(numbers) != (count or len(numbers)) or not np.isfinite(numbers).all():
        raise AnatomyError(f"{name or names[0]} with '{text[:40]}': {count or 'whole'} numbers are needed")
    return numbers


def _is_true(fields: dict[str, str], name: str) -> bool:
    return fields.get(name, "").lower() == "true"
