"""Scans of known contents, in every format of voxels: a fork of vessels with contrast agent, in a body, by a bone."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

AIR, TISSUE, CONTRAST, BONE = -1000.0, 40.0, 350.0, 900.0  # HU
INSIDE = 180.0  # HU, just below half-way from tissue to contrast
BRANCHES = (((0, 0, 5), (0, 0, 32), 2.5), ((0, 0, 32), (11, 0, 60), 2.1), ((0, 0, 32), (-10, 4, 58), 1.8))  # mm, LPS
_BONE = ((9, 14, -5), (9, 14, 70), 4.0)
_FINE = 2  # samples of a voxel along each axis


@dataclass(frozen=True)
class Scan:
    """values : ndarray (i, j, k), HU, whole numbers; to_lps : ndarray (4, 4), from indices to mm."""

    values: np.ndarray
    to_lps: np.ndarray

    @property
    def spacing(self) -> np.ndarray:
        return np.linalg.norm(self.to_lps[:3, :3], axis=0)


def fork_scan(sizes=(60, 64, 60), spacing=(0.62, 0.55, 1.2), turned=(0.12, -0.1, 0.25)) -> Scan:
    """The fork in voxels that are neither cubes nor along the patient's axes; each has the mean of its parts."""
    axes = Rotation.from_rotvec(turned).as_matrix() * np.array(spacing)
    to_lps = np.eye(4)
    to_lps[:3, :3] = axes
    to_lps[:3, 3] = [0.0, 2.0, 32.0] - axes @ (0.5 * (np.array(sizes) - 1.0))
    total = np.zeros(sizes)
    for shift in np.ndindex(_FINE, _FINE, _FINE):
        index = np.indices(sizes).transpose(1, 2, 3, 0) + (np.array(shift) + 0.5) / _FINE - 0.5
        total += _hounsfield(index @ axes.T + to_lps[:3, 3])
    return Scan(np.rint(total / _FINE**3), to_lps)


def _hounsfield(points: np.ndarray) -> np.ndarray:
    values = np.where(np.hypot(points[..., 0] / 17.0, (points[..., 1] - 3.0) / 17.0) < 1.0, TISSUE, AIR)
    values[in_capsule(points, *_BONE)] = BONE
    for branch in BRANCHES:
        values[in_capsule(points, *branch)] = CONTRAST
    return values


def in_capsule(points: np.ndarray, start, end, radius: float) -> np.ndarray:
    """Whether points (..., 3) are within a radius of a line."""
    start, end = np.array(start, float), np.array(end, float)
    part = np.clip((points - start) @ (end - start) / np.sum((end - start) ** 2), 0.0, 1.0)
    return np.linalg.norm(points - start - part[..., None] * (end - start), axis=-1) < radius


def write_nrrd(file: Path, scan: Scan, header: str = "") -> Path:
    """In RAS, as big-endian numbers."""
    ras = np.diag([-1.0, -1.0, 1.0]) @ scan.to_lps[:3]
    rows = " ".join("(" + ",".join(f"{v:.17g}" for v in ras[:, k]) + ")" for k in range(3))
    file.write_bytes((f"NRRD0005\ntype: short\ndimension: 3\nspace: right-anterior-superior\n"
                      f"sizes: {' '.join(map(str, scan.values.shape))}\nspace directions: {rows}\nendian: big\n"
                      f"encoding: raw\nspace origin: ({','.join(f'{v:.17g}' for v in ras[:, 3])})\n{header}\n").encode()
                     + scan.values.astype(">i2").ravel(order="F").tobytes())
    return file


def write_nifti(file: Path, scan: Scan) -> Path:
    """Stored as (HU + 1024) / 2, with slope and intercept."""
    head = bytearray(352)
    struct.pack_into("<i", head, 0, 348)
    struct.pack_into("<8h", head, 40, 3, *scan.values.shape, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 16, 32)
    struct.pack_into("<8f", head, 76, 1.0, *scan.spacing, 0.0, 0.0, 0.0, 0.0)
    struct.pack_into("<3f", head, 108, 352.0, 2.0, -1024.0)
    head[123] = 2
    struct.pack_into("<2h", head, 252, 0, 1)
    struct.pack_into("<12f", head, 280, *(np.diag([-1.0, -1.0, 1.0]) @ scan.to_lps[:3]).ravel())
    head[344:348] = b"n+1\0"
    file.write_bytes(bytes(head) + (0.5 * (scan.values + 1024.0)).astype("<f4").ravel(order="F").tobytes())
    return file


def write_metaimage(file: Path, scan: Scan, packed: bool = True) -> Path:
    """As ITK does."""
    turn = scan.to_lps[:3, :3] / scan.spacing
    data = scan.values.astype("<i2").ravel(order="F").tobytes()
    data = zlib.compress(data) if packed else data
    size = f"CompressedDataSize = {len(data)}\n" if packed else ""
    file.write_bytes((
        f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = {packed}\n"
        f"{size}TransformMatrix = {' '.join(f'{v:.17g}' for v in turn.T.ravel())}\n"
        f"Offset = {' '.join(f'{v:.17g}' for v in scan.to_lps[:3, 3])}\nCenterOfRotation = 0 0 0\n"
        f"AnatomicalOrientation = RAI\nElementSpacing = {' '.join(f'{v:.17g}' for v in scan.spacing)}\n"
        f"DimSize = {' '.join(map(str, scan.values.shape))}\nElementType = MET_SHORT\n"
        "ElementDataFile = LOCAL\n").encode() + data)
    return file


def write_vti(file: Path, scan: Scan) -> Path:
    """By VTK, in LPS, which the file does not say."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

    image = vtkImageData()
    image.SetDimensions(*scan.values.shape)
    image.SetSpacing(*scan.spacing)
    image.SetOrigin(*scan.to_lps[:3, 3])
    image.SetDirectionMatrix(*(scan.to_lps[:3, :3] / scan.spacing).ravel())
    numbers = numpy_to_vtk(scan.values.astype(np.int16).ravel(order="F"), deep=True)
    numbers.SetName("HU")
    image.GetPointData().SetScalars(numbers)
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(image)
    writer.Write()
    return file


def write_dicom(folder: Path, scan: Scan, series: str = "1.2.3", slices: Iterable[int] | None = None,
                changed: Mapping[str, Any] = {}, first: int = 0) -> Path:
    """A file a slice, stored as HU + 1024, in an order of names that is not theirs in space.

    changed : values of tags, or None to leave one out; first : number of the first file.
    """
    import pydicom
    from pydicom.dataset import FileDataset, FileMetaDataset
    from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian

    folder.mkdir(parents=True, exist_ok=True)
    turn = scan.to_lps[:3, :3] / scan.spacing
    for k in range(scan.values.shape[2]) if slices is None else slices:
        number = first + (k * 7) % 1000
        meta = FileMetaDataset()
        meta.MediaStorageSOPClassUID = CTImageStorage
        meta.MediaStorageSOPInstanceUID = f"{series}.{number + 1}"
        meta.TransferSyntaxUID = ExplicitVRLittleEndian
        data = FileDataset(str(folder / f"IM{number:04d}"), {}, file_meta=meta, preamble=b"\0" * 128)
        data.is_little_endian, data.is_implicit_VR = True, False
        place = scan.to_lps @ [0.0, 0.0, k, 1.0]
        tags = {
            "SOPClassUID": CTImageStorage, "SOPInstanceUID": meta.MediaStorageSOPInstanceUID,
            "SeriesInstanceUID": series, "SeriesNumber": 4, "SeriesDescription": "Becken arteriell", "Modality": "CT",
            "ImageType": ["ORIGINAL", "PRIMARY", "AXIAL"], "SpecificCharacterSet": "ISO_IR 192",
            "ImageOrientationPatient": [f"{v:.10f}" for v in turn[:, :2].T.ravel()],
            "ImagePositionPatient": [f"{v:.8f}" for v in place[:3]],
            "PixelSpacing": [f"{scan.spacing[1]:.8f}", f"{scan.spacing[0]:.8f}"],
            "Rows": scan.values.shape[1], "Columns": scan.values.shape[0], "SamplesPerPixel": 1,
            "PhotometricInterpretation": "MONOCHROME2", "BitsAllocated": 16, "BitsStored": 16, "HighBit": 15,
            "PixelRepresentation": 0, "RescaleSlope": "1", "RescaleIntercept": "-1024",
            "PixelData": (scan.values[:, :, k].T + 1024.0).astype("<u2").tobytes(), **changed}
        for name, value in tags.items():
            if value is not None:
                setattr(data, name, value)
        pydicom.dcmwrite(data.filename, data)
    return folder


WRITERS = {"scan.nrrd": write_nrrd, "scan.nii": write_nifti, "scan.mha": write_metaimage, "scan.vti": write_vti,
           "slices": write_dicom}
