"""Series of DICOM slices: which there are in a folder, and the voxels of one of them.

Positions are in LPS. A slice lies at ImagePositionPatient; its columns go along the first three numbers of
ImageOrientationPatient, its rows along the others (DICOM PS3.3, C.7.6.2). The slices of a tilted gantry are sheared,
and their voxels are taken so.
"""

from __future__ import annotations

import hashlib
import importlib.util
import itertools
import logging
import os
import re
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.anatomy.mesh import FARTHEST, AnatomyError
from guidewire.anatomy.voxels import Voxels, check_count

_MOST_FILES = 20_000
_LISTED = 8
_FEWEST = 3  # slices of a volume
_NAME = 64  # characters of a description, as many as DICOM allows
_SAME = 1e-4  # of a direction's components
_EVEN, _OFF = 0.02, 0.1  # of the median step, and of a pixel: by how much a slice may lie elsewhere
_TAGS = ["SOPClassUID", "SeriesInstanceUID", "SeriesNumber", "SeriesDescription", "Modality",
         "ImageType", "ImageOrientationPatient", "ImagePositionPatient", "PixelSpacing", "Rows", "Columns",
         "SamplesPerPixel", "NumberOfFrames", "SpecificCharacterSet", "InstanceNumber"]
_NO_VOLUMES = {  # by SOP class
    "1.2.840.10008.5.1.4.1.1.66.4": "a DICOM segmentation",
    "1.2.840.10008.5.1.4.1.1.66.5": "a DICOM surface segmentation",
    "1.2.840.10008.5.1.4.1.1.481.3": "a set of contours (RTSTRUCT)",
    "1.2.840.10008.1.3.10": "a list of files (DICOMDIR)",
}
# A stream of JPEG, JPEG-LS or JPEG 2000 states its sizes and ends with a mark, behind which are fill bytes and the
# sequence's end.
_STREAMS = tuple(f"1.2.840.10008.1.2.4.{number}" for number in (50, 51, 57, 70, 80, 81, 90, 91))
_SIZED, _TAIL, _WHOLE = re.compile(rb"\xff[\xc0-\xc3\xf7\x51]"), 16, b"\xff\xc0\xff\xd9"
_WAY = "3D Slicer opens it and saves it as .nrrd"


@dataclass(frozen=True)
class _Slice:
    file: Path
    position: np.ndarray


@dataclass
class _Stack:
    """Slices of one series, of one orientation and size. number : in the list, from 1."""

    head: Any
    slices: list[_Slice]
    number: int = 0

    @property
    def description(self) -> str:
        return " ".join(str(self.head.get("SeriesDescription", "")).split())[:_NAME]

    def __str__(self) -> str:
        head = self.head
        name = f"'{self.description}'" if self.description else f"series {head.get('SeriesNumber', '-')}"
        count = len(self.slices)
        return (f"{name}, {head.get('Modality', None) or 'image'} of {count} slice{'s' if count > 1 else ''} of "
                f"{head.Columns} x {head.Rows}, {_localiser(head)}{float(head.PixelSpacing[0]):.3g} mm")


def read_dicom(path: Path, series: str | None = None) -> Voxels:
    """Voxels of a series in a folder and the folders in it, or of the series that a file belongs to.

    Parameters
    ----------
    series : its number in the list that an error has, or its description.

    Raises
    ------
    AnatomyError : one line, for what is no volume, or where there are several.
    """
    import pydicom

    logging.getLogger("pydicom").setLevel(logging.CRITICAL)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        own = _head(path) if path.is_file() else None
        if path.is_file():
            if own is None:
                raise AnatomyError("not a DICOM file")
            _check_kind(own)
        stacks, others = _stacks(path if own is None else path.parent)
        if own is not None:
            stacks = [stack for stack in stacks if stack.head.SeriesInstanceUID == own.get("SeriesInstanceUID", "")]
            others = []
        chosen = _chosen(stacks, others, series)
        slices, step = _in_order(chosen)
        values, sha256 = _values(pydicom, chosen, slices)
    head = chosen.head
    rows, columns = (float(number) for number in head.PixelSpacing)
    to_file = np.eye(4)
    turn = np.array(head.ImageOrientationPatient, dtype=float)
    to_file[:3, 0], to_file[:3, 1], to_file[:3, 2] = columns * turn[:3], rows * turn[3:], step
    to_file[:3, 3] = slices[0].position
    left = [f"{stack}, of the same {'series' if own is not None else 'folder'}" for stack in stacks
            if stack is not chosen] + others
    notes = [f"DICOM: {chosen}; slices {np.linalg.norm(step):.4g} mm apart"]
    normal = np.cross(turn[:3], turn[3:])
    tilt = np.degrees(np.arccos(min(1.0, abs(normal @ step) / np.linalg.norm(step))))
    if tilt > 0.5:
        notes.append(f"the gantry is tilted by {tilt:.3g} degrees: the voxels are sheared, and taken so")
    return Voxels(values, to_file, "LPS", left_out=tuple(left), notes=tuple(notes), sha256=sha256)


def _head(file: Path) -> Any | None:
    """Return what a file says of itself, without its voxels; None where it is no DICOM file."""
    import pydicom

    try:
        return pydicom.dcmread(str(file), stop_before_pixels=True, specific_tags=_TAGS)
    except Exception as error:    # pydicom raises many kinds on a damaged file
        if isinstance(error, (KeyboardInterrupt, MemoryError)):
            raise
        return None


def _localiser(head: Any) -> str:
    return "a localiser, " if "LOCALIZER" in [str(word).upper() for word in head.get("ImageType", None) or []] else ""


def _check_kind(head: Any) -> None:
    """Raises AnatomyError where a file is no slice of a volume."""
    kind = _NO_VOLUMES.get(str(head.get("SOPClassUID", "")))
    if kind:
        raise AnatomyError(f"{kind}: {_WAY.replace('.nrrd', '.seg.nrrd')}")
    if int(head.get("NumberOfFrames", None) or 1) > 1:
        raise AnatomyError(f"{head.NumberOfFrames} frames in one file: {_WAY}")
    if int(head.get("SamplesPerPixel", None) or 1) != 1:
        raise AnatomyError(f"{head.SamplesPerPixel} numbers a pixel, a picture in colours: an image has one")
    for name, count in (("ImagePositionPatient", 3), ("ImageOrientationPatient", 6), ("PixelSpacing", 2),
                        ("Rows", 1), ("Columns", 1)):
        value = head.get(name, None)
        numbers = np.atleast_1d(np.array(value if value is not None else [], dtype=float))
        if len(numbers) != count or not np.isfinite(numbers).all():
            raise AnatomyError(f"it has no {name}, so nothing says where its pixels lie: the series as the scanner "
                               "wrote it is needed")
    turn = np.array(head.ImageOrientationPatient, dtype=float).reshape(2, 3)
    if np.abs(np.array(head.ImagePositionPatient, dtype=float)).max() > FARTHEST:
        raise AnatomyError(f"its ImagePositionPatient is beyond {FARTHEST:g} mm")
    if min(int(head.Rows), int(head.Columns)) < 1:
        raise AnatomyError(f"{head.Columns} x {head.Rows} pixels")
    if not np.allclose(turn @ turn.T, np.eye(2), atol=1e-2) or min(map(float, head.PixelSpacing)) <= 0.0:
        raise AnatomyError("its ImageOrientationPatient is no two directions at right angles, or its PixelSpacing is "
                           "not above 0")


def _stacks(folder: Path) -> tuple[list[_Stack], list[str]]:
    """Return the stacks of slices in a folder, numbered; and why others are none."""
    found = (Path(place) / name for place, _, names in os.walk(folder) for name in names)
    files = sorted(itertools.islice(found, _MOST_FILES + 1))
    if len(files) > _MOST_FILES:
        raise AnatomyError(f"more than {_MOST_FILES} files: give the folder of one series")
    stacks: dict[tuple, _Stack] = {}
    refused: dict[str, int] = {}
    for file in files:
        head = _head(file)
        if head is None:
            continue
        try:
            _check_kind(head)
        except (AnatomyError, TypeError, ValueError) as error:
            refused[str(error)] = refused.get(str(error), 0) + 1
            continue
        key = (str(head.get("SeriesInstanceUID", "")), head.Rows, head.Columns, *np.round(
            np.r_[np.array(head.ImageOrientationPatient, float) / _SAME, np.array(head.PixelSpacing, float) / _SAME]))
        stacks.setdefault(key, _Stack(head, [])).slices.append(
            _Slice(file, np.array(head.ImagePositionPatient, dtype=float)))
    for stack in stacks.values():
        stack.slices = _without_copies(stack.slices)
    ordered = sorted(stacks.values(), key=lambda stack: (int(stack.head.get("SeriesNumber", None) or 0),
                                                         -len(stack.slices), str(stack)))
    for number, stack in enumerate(ordered, 1):
        stack.number = number
    return ordered, [f"{count} file{'s' if count > 1 else ''}: {why}" for why, count in refused.items()]


def _without_copies(slices: list[_Slice]) -> list[_Slice]:
    """Return the slices without those of the place and the pixels of another one. Instances' numbers may be blank, or
    the same in all of a series, so that they do not tell copies."""
    import pydicom

    places: dict[bytes, list[_Slice]] = {}
    for one in slices:
        places.setdefault((one.position + 0.0).tobytes(), []).append(one)
    kept = []
    for same in places.values():
        pixels = {pydicom.dcmread(str(one.file)).get("PixelData", b""): one for one in same[::-1]} if (
            len(same) > 1) else {b"": same[0]}
        kept += pixels.values()
    return kept


def _chosen(stacks: list[_Stack], others: list[str], series: str | None) -> _Stack:
    """Return the stack that is asked for, or else the only one that is a volume."""
    listed = "; ".join(f"--series {stack.number}: {stack}" for stack in stacks[:_LISTED])
    listed += "; .." if len(stacks) > _LISTED else ""
    if not stacks:
        raise AnatomyError("no DICOM slices here" + (f", but {others[0]}" if others else
                                                     ": a folder with the files of a series is needed"))
    if series is not None:
        named = [stack for stack in stacks if series.strip().lower() in (str(stack.number), stack.description.lower())]
        if len(named) != 1:
            raise AnatomyError(f"--series {series}: {'no such series' if not named else 'several have this name'}; "
                               f"{listed}")
        return named[0]
    volumes = [stack for stack in stacks if len(stack.slices) >= _FEWEST and not _localiser(stack.head)]
    if len(volumes) != 1:
        raise AnatomyError(f"{len(volumes) or 'no'} series of {_FEWEST} or more slices"
                           f"{', choose one' if volumes else ''}: {listed}")
    return volumes[0]


def _in_order(stack: _Stack) -> tuple[list[_Slice], np.ndarray]:
    """Return the slices along their normal, and the step (3,) from one to the next.

    Raises
    ------
    AnatomyError : a slice is missing, is there twice, or lies elsewhere; one line with the place.
    """
    turn = np.array(stack.head.ImageOrientationPatient, dtype=float)
    normal = np.cross(turn[:3], turn[3:])
    slices = sorted(stack.slices, key=lambda one: float(one.position @ normal))
    if len(slices) < 2:
        raise AnatomyError(f"{stack}: {_FEWEST} or more slices make a volume")
    places = np.array([one.position for one in slices])
    steps = np.diff(places, axis=0)
    along = steps @ normal
    usual = float(np.median(along))
    twice = np.flatnonzero(along <= _EVEN * max(usual, 1e-6))
    if len(twice):
        times = f"{slices[twice[0]].file.name} and {slices[twice[0] + 1].file.name}"
        raise AnatomyError(f"{len(twice)} slices lie where another one does, such as {times}, at "
                           f"{_listed(places[twice[0]])}: a series of several times; {_WAY}, one time of it")
    off = np.flatnonzero(np.abs(along - usual) > _EVEN * usual)
    if len(off):
        k = int(off[0])
        missing = along[k] / usual - 1.0
        is_whole = len(off) <= max(1, 0.1 * len(along)) and missing > 0.5 and abs(missing - round(missing)) < 0.1
        what = (f"{round(missing)} slice{'s are' if round(missing) > 1 else ' is'} missing" if is_whole
                else "the spacing changes")
        raise AnatomyError(f"{what} between {slices[k].file.name} at {_listed(places[k])} and "
                           f"{slices[k + 1].file.name}, {along[k]:.4g} mm on; others are {usual:.4g} mm apart; "
                           "3D Slicer can resample the series and save it as .nrrd")
    step = (places[-1] - places[0]) / (len(places) - 1)
    away = np.linalg.norm(places - places[0] - np.arange(len(places))[:, None] * step, axis=1)
    if away.max() > _OFF * float(stack.head.PixelSpacing[0]) + _EVEN * usual:
        k = int(away.argmax())
        raise AnatomyError(f"{slices[k].file.name} lies {away[k]:.3g} mm beside the line of the others, at "
                           f"{_listed(places[k])}: the slices are no volume")
    return slices, step


def _values(pydicom: Any, stack: _Stack, slices: list[_Slice]) -> tuple[np.ndarray, str]:
    """Return (i, j, k): rescaled by slope and intercept; and a sum of the files' bytes."""
    sizes = [int(stack.head.Columns), int(stack.head.Rows), len(slices)]
    check_count(sizes)
    values, total = None, hashlib.sha256()
    for k, one in enumerate(slices):
        total.update(one.file.read_bytes())
        data = pydicom.dcmread(str(one.file))
        pixels = _pixels(data, one.file)
        if pixels.shape != (sizes[1], sizes[0]):
            raise AnatomyError(f"{one.file.name}: {' x '.join(map(str, pixels.shape))} pixels: {sizes[1]} x {sizes[0]} "
                               "are needed")
        slope, intercept = (float(data.get(name, None) if data.get(name, None) is not None else default)
                            for name, default in (("RescaleSlope", 1.0), ("RescaleIntercept", 0.0)))
        if not np.isfinite([slope, intercept]).all() or slope == 0.0:
            raise AnatomyError(f"{one.file.name}: RescaleSlope {slope:g}, RescaleIntercept {intercept:g}")
        if values is None:
            values = np.empty(sizes, dtype=np.float32, order="F")
        values[:, :, k] = pixels.T * slope + intercept
    return values, total.hexdigest()


def _pixels(data: Any, file: Path) -> np.ndarray:
    syntax = getattr(getattr(data, "file_meta", None), "TransferSyntaxUID", None)
    try:
        # gdcm gives pixels for a stream that it cannot decode.
        stream = data.PixelData if syntax is not None and syntax in _STREAMS else _WHOLE
        if not (_SIZED.search(stream) and b"\xff\xd9" in stream[-_TAIL:]):
            raise AnatomyError(f"{file.name}: its compressed voxels break off")
        return data.pixel_array
    except AnatomyError:
        raise
    except Exception as error:    # pydicom raises many kinds where it cannot decode, or the file is damaged
        if isinstance(error, (KeyboardInterrupt, MemoryError)):
            raise
        if syntax is not None and syntax.is_compressed:
            raise AnatomyError(f"{file.name}: its voxels are compressed by '{syntax.name}', " + (
                "and damaged" if importlib.util.find_spec("gdcm") else
                "which needs gdcm: apt-get install python3-gdcm, or pip install python-gdcm")) from error
        reason = re.split(r"[.\n]", str(error), maxsplit=1)[0][:120]
        raise AnatomyError(f"{file.name}: its voxels cannot be read: {reason}") from error


def _listed(point: np.ndarray) -> str:
    return "[" + ", ".join(f"{number:.4g}" for number in point) + "]"
