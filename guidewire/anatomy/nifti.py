"""Voxels of NIfTI files."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.voxels import Voxels, three_sizes, unpacked, voxels_of

_MM = {1: 1e3, 3: 1e-3}  # of a length in a NIfTI file, by its code of units: m, um; others are mm
_NIFTI_TYPES = {2: "u1", 4: "i2", 8: "i4", 16: "f4", 64: "f8", 256: "i1", 512: "u2", 768: "u4", 1024: "i8", 1280: "u8"}


def read_nifti(file: Path, is_packed: bool) -> Voxels:
    """Voxels in RAS where the file has a transform.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    data = file.read_bytes()
    if is_packed:
        if not data.startswith(b"\x1f\x8b"):
            raise AnatomyError("not packed by gzip, as the name says")
        data = unpacked(data)
    if len(data) < 348:
        raise AnatomyError(f"{len(data)} bytes: a NIfTI header has 348")
    order = "<" if struct.unpack_from("<i", data)[0] == 348 else ">"
    if struct.unpack_from(order + "i", data)[0] != 348:
        raise AnatomyError("not a NIfTI-1 file: its first number is not 348")
    dim = struct.unpack_from(order + "8h", data, 40)
    sizes = three_sizes([max(n, 0) for n in dim[1:1 + max(min(dim[0], 7), 0)]])
    code = struct.unpack_from(order + "h", data, 70)[0]
    if code not in _NIFTI_TYPES:
        raise AnatomyError(f"voxels of the type {code}: one number a voxel is needed")
    pixdim = struct.unpack_from(order + "8f", data, 76)
    offset, slope, intercept = struct.unpack_from(order + "3f", data, 108)
    if not np.isfinite(offset):
        raise AnatomyError(f"its voxels begin at byte {offset:g}: a number is needed")
    values = voxels_of(data[max(int(offset), 348):], np.dtype(order + _NIFTI_TYPES[code]), sizes)
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
    return Voxels(values, to_file, "RAS" if s_code > 0 or q_code > 0 else "")
