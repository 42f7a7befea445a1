"""Voxels of any file that is read: values as the file means them, and where they lie in the patient."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from guidewire.anatomy.formats import DICOM
from guidewire.anatomy.mesh import FARTHEST, AnatomyError
from guidewire.anatomy.patient import Axes, axes_named
from guidewire.anatomy.voxels import Segment, Voxels


@dataclass(frozen=True)
class Image:
    """values : ndarray (i, j, k), or (i, j, k, layers) of a segmentation whose segments overlap; to_space : ndarray
    (4, 4), from indices of voxels to mm, in LPS where the axes are known, else in the file's own; axes : those of the
    file; unit : "mm", or empty where the file has none; segments : with names; left_out, notes : lines of a report;
    sha256 : of the bytes where they are of several files."""

    values: np.ndarray
    to_space: np.ndarray
    axes: Axes = Axes()
    unit: str = "mm"
    segments: tuple[Segment, ...] = ()
    left_out: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    sha256: str = ""

    def with_names(self, segments: tuple[Segment, ...]) -> Image:
        """Return the image with segments of a table, in place of those of its file."""
        return replace(self, segments=segments)

    @property
    def spacing(self) -> np.ndarray:
        """(3,): sizes of a voxel."""
        return np.linalg.norm(self.to_space[:3, :3], axis=0)

    def place(self, index: np.ndarray) -> np.ndarray:
        """Return (3,): where an index (3,) of voxels lies."""
        return (self.to_space @ np.r_[index, 1.0])[:3]


def read_image(file: Path, kind: str, axes: Axes | None = None, series: str | None = None) -> Image:
    """Return a mask or an image.

    Parameters
    ----------
    kind : of `formats.MASKS`, or `formats.DICOM`, whose file may be a folder.
    axes : of the file, in place of those that it states.
    series : of a folder of slices, by its number in the list or by its description.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    try:
        read = _read(file, kind, series)
        if axes is None and read.said == "3D-left-handed":
            raise AnatomyError(f"space '{read.said}' is mirrored and names no axes of the patient: give --axes")
        axes = axes or (axes_named(read.said) if read.said and "handed" not in read.said else Axes())
    except AnatomyError as error:
        text = str(error)
        raise AnatomyError(text if text.startswith(str(file)) else f"{file}: {text}") from error
    to_space = read.to_file.copy()
    to_space[:3] = axes.to_lps @ read.to_file[:3]
    is_finite = bool(np.isfinite(to_space).all())
    if is_finite and (np.abs(to_space[:3]) @ [*read.values.shape[:3], 1.0]).max() > FARTHEST:
        raise AnatomyError(f"{file}: a voxel may lie beyond {FARTHEST:g} mm")
    if not is_finite or not abs(np.linalg.det(to_space)) > 0.0:
        raise AnatomyError(f"{file}: its directions of voxels are no three directions in space")
    if read.values.dtype.kind == "f" and not np.isfinite(read.values).all():
        raise AnatomyError(f"{file}: {int((~np.isfinite(read.values)).sum())} voxels are not finite")
    return Image(read.values, to_space, axes, read.unit, read.segments, read.left_out, read.notes, read.sha256)


def _read(file: Path, kind: str, series: str | None) -> Voxels:
    if kind == DICOM:
        from guidewire.anatomy.dicom import read_dicom

        return read_dicom(file, series)
    if series is not None:
        raise AnatomyError("--series is of a folder of DICOM slices")
    if kind in (".nrrd", ".nhdr"):
        from guidewire.anatomy.nrrd import read_nrrd

        return read_nrrd(file)
    if kind in (".mha", ".mhd"):
        from guidewire.anatomy.metaimage import read_metaimage

        return read_metaimage(file)
    if kind == ".vti":
        from guidewire.anatomy.vti import read_vti

        return read_vti(file)
    from guidewire.anatomy.nifti import read_nifti

    return read_nifti(file, is_packed=kind == ".nii.gz")
