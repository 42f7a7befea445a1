"""What the readers of voxels share: the voxels of one file as it has them, and numbers out of bytes."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import AnatomyError

_MOST_VOXELS = 1 << 30


@dataclass(frozen=True)
class Segment:
    """A part of a segmentation: its name, the value of its voxels, and the layer that these are in."""

    name: str
    value: float
    layer: int = 0


@dataclass(frozen=True)
class Voxels:
    """What a file says of its voxels.

    values : ndarray (i, j, k), or (i, j, k, layers) of a segmentation whose segments overlap; to_file : ndarray (4, 4),
    from indices to mm in the file's axes; said : what the file says these are, empty where it says nothing; unit :
    "mm", or empty where the file has none; segments : that the file names; left_out, notes : lines of a report; sha256
    : of the bytes where they are of several files.
    """

    values: np.ndarray
    to_file: np.ndarray
    said: str = ""
    unit: str = "mm"
    segments: tuple[Segment, ...] = ()
    left_out: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    sha256: str = ""


NO_SIZES = "the file says no size of its voxels: 1 mm is taken"


def voxels_of(data: bytes, dtype: np.dtype, sizes: list[int]) -> np.ndarray:
    """Numbers of a type, the first index fastest, in the byte order of this machine."""
    needed = int(np.prod(sizes)) * dtype.itemsize
    if len(data) < needed:
        raise AnatomyError(f"the file breaks off: {int(np.prod(sizes))} voxels need {needed} bytes, there are "
                           f"{len(data)}")
    values = np.frombuffer(data, dtype, count=int(np.prod(sizes))).reshape(sizes, order="F")
    return values.astype(dtype.newbyteorder("="))


def numbers_of(text: bytes, sizes: list[int]) -> np.ndarray:
    """Numbers that are written out, the first index fastest."""
    try:
        numbers = np.array(text.split(), dtype=float)
    except ValueError as error:
        raise AnatomyError("its voxels are no numbers") from error
    count = int(np.prod(sizes))
    if numbers.size < count:
        raise AnatomyError(f"the file breaks off: of {count} voxels there are {numbers.size}")
    return numbers[:count].reshape(sizes, order="F")


def voxels_beside(file: Path, name: str) -> bytes:
    """Bytes of the file that a header names, from the header's folder; AnatomyError where there is none."""
    place = file.parent / name
    if not place.is_file():
        raise AnatomyError(f"its voxels are in another file, '{name[:60]}', and there is none of this name beside it")
    return place.read_bytes()


def check_count(sizes: list[int]) -> None:
    """Raises AnatomyError where a header tells of more voxels than are read."""
    voxels = float(np.prod([float(n) for n in sizes]))
    if voxels > _MOST_VOXELS:
        raise AnatomyError(f"the header tells of {voxels:.3g} voxels: {_MOST_VOXELS:.3g} at most are read")


def three_sizes(sizes: list[int]) -> list[int]:
    """Return the sizes without axes of one voxel behind the third."""
    while len(sizes) > 3 and 1 in sizes:
        sizes = list(sizes)
        sizes.remove(1)
    if len(sizes) != 3 or min(sizes) < 1:
        raise AnatomyError(f"an image of {' x '.join(map(str, sizes)) or 'no'} voxels: three sizes are needed, and one "
                           "number a voxel")
    check_count(sizes)
    return sizes


def unpacked(data: bytes, unpack: Callable[[bytes], bytes] = gzip.decompress) -> bytes:
    """Raises AnatomyError where bytes are not packed so, or break off."""
    try:
        return unpack(data)
    except (OSError, EOFError, zlib.error, ValueError) as error:
        raise AnatomyError("the packed voxels break off, or are not packed as the file says") from error
