"""Voxels of NRRD and NIfTI files: values as the file means them, and where they lie in the patient."""

from __future__ import annotations

import bz2
import gzip
import re
import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import FARTHEST, AnatomyError
from guidewire.anatomy.patient import Axes, axes_named

_MOST_VOXELS = 1 << 30
_MM = {1: 1e3, 3: 1e-3}  # of a length in a NIfTI file, by its code of units: m, um; others are mm
_MM_OF = {"mm": 1.0, "cm": 10.0, "m": 1e3, "um": 1e-3, "µm": 1e-3, "micron": 1e-3}  # of a length in an NRRD file
_NIFTI_TYPES = {2: "u1", 4: "i2", 8: "i4", 16: "f4", 64: "f8", 256: "i1", 512: "u2", 768: "u4", 1024: "i8", 1280: "u8"}
_NRRD_TYPES = {
    "i1": ("signed char", "int8", "int8_t"), "u1": ("uchar", "unsigned char", "uint8", "uint8_t"),
    "i2": ("short", "short int", "signed short", "signed short int", "int16", "int16_t"),
    "u2": ("ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"),
    "i4": ("int", "signed int", "int32", "int32_t"), "u4": ("uint", "unsigned int", "uint32", "uint32_t"),
    "i8": ("longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"),
    "u8": ("ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"),
    "f4": ("float",), "f8": ("double",),
}


@dataclass(frozen=True)
class Image:
    """values : ndarray (i, j, k); to_space : ndarray (4, 4), from indices of voxels to mm, in LPS where the axes are
    known, else in the file's own; axes : those of the file."""

    values: np.ndarray
    to_space: np.ndarray
    axes: Axes = Axes()


def read_image(file: Path, kind: str, axes: Axes | None = None) -> Image:
    """A mask or an image.

    Parameters
    ----------
    kind : ".nrrd", ".nii" or ".nii.gz".
    axes : of the file, in place of those that it states.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    try:
        values, to_file, said = _nrrd(file) if kind == ".nrrd" else _nifti(file, is_packed=kind == ".nii.gz")
        if axes is None and said == "3D-left-handed":
            raise AnatomyError(f"space '{said}' is mirrored and names no axes of the patient: give --axes")
        axes = axes or (axes_named(said) if said and "handed" not in said else Axes())
    except AnatomyError as error:
        raise AnatomyError(f"{file}: {error}") from error
    to_space = to_file.copy()
    to_space[:3] = axes.to_lps @ to_file[:3]
    is_finite = bool(np.isfinite(to_space).all())
    if is_finite and (np.abs(to_space[:3]) @ [*values.shape, 1.0]).max() > FARTHEST:
        raise AnatomyError(f"{file}: a voxel may lie beyond {FARTHEST:g} mm")
    if not is_finite or not abs(np.linalg.det(to_space)) > 0.0:
        raise AnatomyError(f"{file}: its directions of voxels are no three directions in space")
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        raise AnatomyError(f"{file}: {int((~np.isfinite(values)).sum())} voxels are not finite")
    return Image(values, to_space, axes)


def _voxels(data: bytes, dtype: np.dtype, sizes: list[int]) -> np.ndarray:
    needed = int(np.prod(sizes)) * dtype.itemsize
    if len(data) < needed:
        raise AnatomyError(f"the file breaks off: {int(np.prod(sizes))} voxels need {needed} bytes, there are "
                           f"{len(data)}")
    values = np.frombuffer(data, dtype, count=int(np.prod(sizes))).reshape(sizes, order="F")
    return values.astype(dtype.newbyteorder("="))


def _three_sizes(sizes: list[int]) -> list[int]:
    """The sizes without axes of one voxel behind the third."""
    while len(sizes) > 3 and 1 in sizes:
        sizes = list(sizes)
        sizes.remove(1)
    voxels = float(np.prod([float(n) for n in sizes])) if sizes else 0.0
    if len(sizes) != 3 or min(sizes) < 1:
        raise AnatomyError(f"an image of {' x '.join(map(str, sizes)) or 'no'} voxels: three sizes are needed, and one "
                           "number a voxel")
    if voxels > _MOST_VOXELS:
        raise AnatomyError(f"the header tells of {voxels:.3g} voxels: {_MOST_VOXELS:.3g} at most are read")
    return sizes


def _unpacked(file: Path, data: bytes, unpack=gzip.decompress) -> bytes:
    try:
        return unpack(data)
    except (OSError, EOFError, zlib.error, ValueError) as error:
        raise AnatomyError("the packed voxels break off, or are not packed as the file says") from error


def _nifti(file: Path, is_packed: bool) -> tuple[np.ndarray, np.ndarray, str]:
    """Values, from voxels to mm in the file's axes, and those axes: RAS where the file has a transform."""
    data = file.read_bytes()
    if is_packed:
        if not data.startswith(b"\x1f\x8b"):
            raise AnatomyError("not packed by gzip, as the name says")
        data = _unpacked(file, data)
    if len(data) < 348:
        raise AnatomyError(f"{len(data)} bytes: a NIfTI header has 348")
    order = "<" if struct.unpack_from("<i", data)[0] == 348 else ">"
    if struct.unpack_from(order + "i", data)[0] != 348:
        raise AnatomyError("not a NIfTI-1 file: its first number is not 348")
    dim = struct.unpack_from(order + "8h", data, 40)
    sizes = _three_sizes([max(n, 0) for n in dim[1:1 + max(min(dim[0], 7), 0)]])
    code = struct.unpack_from(order + "h", data, 70)[0]
    if code not in _NIFTI_TYPES:
        raise AnatomyError(f"voxels of the type {code}: one number a voxel is needed")
    pixdim = struct.unpack_from(order + "8f", data, 76)
    offset, slope, intercept = struct.unpack_from(order + "3f", data, 108)
    if not np.isfinite(offset):
        raise AnatomyError(f"its voxels begin at byte {offset:g}: a number is needed")
    values = _voxels(data[max(int(offset), 348):], np.dtype(order + _NIFTI_TYPES[code]), sizes)
    if np.isfinite(slope) and slope != 0.0 and (slope != 1.0 or intercept != 0.0):
        values = values * np.float64(slope) + np.float64(intercept)    # the file's own formula
    q_code, s_code = struct.unpack_from(order + "2h", data, 252)
    to_file = np.eye(4)
    if s_code > 0:
        to_file[:3] = np.array(struct.unpack_from(order + "12f", data, 280)).reshape(3, 4)
    elif q_code > 0:
        b, c, d, *origin = struct.unpack_from(order + "6f", data, 256)
        a = np.sqrt(max(0.0, 1.0 - b * b - c * c - d * d))
        turn = np.array([[a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
                         [2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b)],
                         [2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c]])
        to_file[:3, :3] = turn * np.array([pixdim[1], pixdim[2], pixdim[3] * (-1.0 if pixdim[0] < 0.0 else 1.0)])
        to_file[:3, 3] = origin
    else:
        to_file[:3, :3] = np.diag(pixdim[1:4])
    to_file[:3] *= _MM.get(data[123] & 7, 1.0)
    return values, to_file, "RAS" if s_code > 0 or q_code > 0 else ""


def _nrrd(file: Path) -> tuple[np.ndarray, np.ndarray, str]:
    """Values, from voxels to mm in the file's axes, and what the file says these are."""
    data = file.read_bytes()
    if not data.startswith(b"NRRD"):
        raise AnatomyError("not a NRRD: it does not begin with 'NRRD'")
    end = re.search(rb"\r?\n\r?\n", data)
    head = data[:end.start() if end else len(data)].decode("utf-8", "replace").splitlines()[1:]
    fields = {}
    for line in head:
        name, colon, value = line.partition(":")
        if colon and not value.startswith("=") and not line.startswith("#"):
            fields[name.strip().lower()] = value.strip()
    if end is None or "data file" in fields or "datafile" in fields:
        raise AnatomyError("its voxels are in another file, or the header breaks off: an NRRD with its own voxels is "
                           "needed")
    try:
        sizes = [int(word) for word in fields["sizes"].split()]
    except (KeyError, ValueError) as error:
        raise AnatomyError("the header has no sizes") from error
    rows, said = _directions(fields, len(sizes))
    kept = [k for k, n in enumerate(sizes) if n > 1 or rows[k] is not None]
    extra = [sizes[k] for k in kept if rows[k] is None]
    if extra:
        raise AnatomyError(f"{extra[0]} numbers a voxel: a mask has one")
    three = _three_sizes([sizes[k] for k in kept])
    kind = next((kind for kind, names in _NRRD_TYPES.items() if fields.get("type", "").lower() in names), None)
    if kind is None:
        raise AnatomyError(f"voxels of the type '{fields.get('type', '')}': numbers are needed")
    dtype = np.dtype((">" if fields.get("endian", "little").lower() == "big" else "<") + kind)
    values = _encoded(file, data[end.end():], fields, dtype, three)
    to_file = np.eye(4)
    to_file[:3, :3] = np.array([rows[k] for k in kept if rows[k] is not None][:3]).T
    origin = re.search(r"\(([^()]*)\)", fields.get("space origin", ""))
    if origin:
        to_file[:3, 3] = _numbers(origin[1].split(","), "space origin", 3)
    units = re.findall(r'"([^"]*)"', fields.get("space units", "")) or ["mm"]
    if units[0].lower() not in _MM_OF:
        raise AnatomyError(f"space units '{units[0]}': one of {', '.join(_MM_OF)} is needed")
    to_file[:3] *= _MM_OF[units[0].lower()]
    return values, to_file, said


def _encoded(file: Path, data: bytes, fields: dict[str, str], dtype: np.dtype, sizes: list[int]) -> np.ndarray:
    encoding = fields.get("encoding", "raw").lower()
    for _ in range(_skipped(fields, "line")):
        _, mark, data = data.partition(b"\n")
        if not mark:
            raise AnatomyError("the file breaks off: it has fewer lines than its line skip")
    if encoding in ("gzip", "gz"):
        data = _unpacked(file, data)
    elif encoding in ("bzip2", "bz2"):
        data = _unpacked(file, data, bz2.decompress)
    elif encoding == "hex":
        data = _unpacked(file, b"".join(data.split()), lambda text: bytes.fromhex(text.decode("ascii", "replace")))
    elif encoding in ("ascii", "text", "txt"):
        try:
            numbers = np.array(data.split(), dtype=float)
        except ValueError as error:
            raise AnatomyError("its voxels are no numbers") from error
        if numbers.size < np.prod(sizes):
            raise AnatomyError(f"the file breaks off: of {int(np.prod(sizes))} voxels there are {numbers.size}")
        return numbers[:int(np.prod(sizes))].reshape(sizes, order="F")
    elif encoding != "raw":
        raise AnatomyError(f"encoding '{encoding}': one of raw, gzip, bzip2, hex, ascii is needed")
    skip = _skipped(fields, "byte")
    data = data[len(data) - int(np.prod(sizes)) * dtype.itemsize if skip == -1 else max(skip, 0):]
    return _voxels(data, dtype, sizes)


def _skipped(fields: dict[str, str], what: str) -> int:
    text = fields.get(f"{what} skip", fields.get(f"{what}skip", "0"))
    try:
        return int(text)
    except ValueError as error:
        raise AnatomyError(f"{what} skip '{text[:40]}': a whole number is needed") from error


def _directions(fields: dict[str, str], count: int) -> tuple[list[list[float] | None], str]:
    """Of each axis the step from voxel to voxel, None where it is none of space; and the space that they are in."""
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
