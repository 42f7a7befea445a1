"""Reads a vessel from a mesh, a mask or a centreline: its wall, what its unit is, and how its axes lie in the patient.
"""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from guidewire.anatomy.formats import CENTRELINES, DICOM, ENDINGS, MASKS, OTHERS, is_dicom
from guidewire.anatomy.images import Image, read_image
from guidewire.anatomy.labels import read_names
from guidewire.anatomy.masks import Taken, Taking, mesh_of_image
from guidewire.anatomy.mesh import FARTHEST, AnatomyError, Mesh
from guidewire.anatomy.patient import Axes, axes_named
from guidewire.anatomy.triangles import read_obj, read_stl
from guidewire.anatomy.vtk_files import read_by_vtk

_LARGEST = 1 << 30  # bytes of a mesh file
_SPACE = re.compile(rb"SPACE\s*=\s*(LPS|RAS)")  # as 3D Slicer writes it into headers and comments of meshes


@dataclass(frozen=True)
class Faces:
    """Faces of a wall, such as its caps, by number, as SimVascular writes them. middles : ndarray (t, 3) of triangles;
    numbers : ndarray of int (t,)."""

    middles: np.ndarray
    numbers: np.ndarray

    def of(self, mesh: Mesh) -> np.ndarray:
        """Return (t,): the face of each triangle of a mesh, by the nearest middle."""
        return self.numbers[cKDTree(self.middles).query(mesh.corners.mean(axis=1))[1]]


@dataclass(frozen=True)
class Source:
    """mesh : in LPS where the axes are known, else in the file's own; unit : where it is known; unit_said_by : who says
    the unit; axes : of the file; notes : what was done; name : of the file, or what was made; sha256 : of the file's
    bytes; faces : of the wall, where the file numbers them; begin : (3,), where all lines of a file begin, or None;
    left_out : of the file, a line each; voxels : what a picture of what is taken shows, None where none is needed;
    voxel : largest side of a voxel, 0 of other files."""

    mesh: Mesh
    unit: str | None
    unit_said_by: str
    axes: Axes = Axes()
    notes: list[str] = field(default_factory=list)
    name: str = ""
    sha256: str = ""
    faces: Faces | None = None
    begin: np.ndarray | None = None
    left_out: list[str] = field(default_factory=list)
    voxels: tuple[Image, Taken] | None = None
    voxel: float = 0.0

    @property
    def stem(self) -> str:
        """The name without the ending that is known here: of "a.b.nii.gz" "a.b"."""
        return stem_of(self.name)


def name_of(file: Path) -> str:
    """Return a file's name; of "." the folder's."""
    return file.name or file.resolve().name


def stem_of(name: str) -> str:
    """Return a file's name without the ending that is known here."""
    ending = next((one for one in ENDINGS if name.lower().endswith(one)), "")
    return name[:len(name) - len(ending)] or name


def kind_of(file: Path) -> str:
    """Return the ending of a name that is read here, such as ".nii.gz"; that of slices for a folder too.

    Raises
    ------
    AnatomyError : the name has another ending, or there is no such file.
    """
    if is_dicom(file):
        if not file.exists():
            raise AnatomyError(f"{file}: no such file")
        return DICOM
    name = file.name.lower()
    for ending in ENDINGS:
        if name.endswith(ending):
            if not file.is_file():
                raise AnatomyError(f"{file}: no such file")
            return ending
    way = next((way for ending, way in OTHERS.items() if name.endswith(ending)), "")
    raise AnatomyError(f"{file}: " + (f"{way}; " if way else "")
                       + f"the name has to end in one of {', '.join(ENDINGS)}, or be a folder of DICOM slices")


def read(file: Path, unit: str | None = None, axes: Axes | None = None, taking: Taking = Taking(),
         series: str | None = None, names: Path | None = None) -> Source:
    """Return the wall in a file, or one made of its mask or centreline.

    Parameters
    ----------
    unit, axes : of the file, in place of what it says.
    taking : which voxels of a mask or an image.
    series : of a folder of DICOM slices.
    names : file with names of labels.

    Raises
    ------
    AnatomyError : one line, for a file that holds no vessel.
    """
    kind = kind_of(file)
    if kind != DICOM and file.stat().st_size == 0:
        raise AnatomyError(f"{file}: the file is empty")
    if kind in (DICOM, *MASKS):
        image = read_image(file, kind, axes, series)
        if names is not None:
            image = image.with_names(read_names(names))
        taken = mesh_of_image(image, taking)
        said = "mm" if image.unit else unit
        return Source(taken.mesh, said, "as the file says" if image.unit else "as given", image.axes, taken.notes,
                      name_of(file), image.sha256 or hashlib.sha256(file.read_bytes()).hexdigest(),
                      left_out=taken.left_out, voxels=(image, taken) if taking.needs_picture else None,
                      voxel=float(image.spacing.max()))
    own = {"--series": series, "--label-names": names, "--segment": taking.segments, "--box": taking.box,
           "--seed": taking.seed}
    for option, value in own.items():
        if value is not None:
            raise AnatomyError(f"{file}: {option} is of voxels: this file has none")
    sha256 = hashlib.sha256(file.read_bytes()).hexdigest()
    from guidewire.anatomy import lines

    data = read_by_vtk(file, kind) if kind not in (".stl", ".obj", *CENTRELINES) else None
    found = (lines.read_lines(file, kind) if kind in CENTRELINES
             else lines.lines_of_poly_data(file, data) if data is not None else None)
    if found is not None:
        mesh, done = lines.mesh_of_lines(found.lines)
        said = unit or found.unit or None
        by = "as given" if unit else "as the file says"
        axes = axes or (found.axes if data is None else stated_axes(file, data))
        begin = lines.begin_of(found.lines)
        return Source(axes.take(mesh), said, by, axes, [done], file.name, sha256,
                      begin=None if begin is None else axes.to_lps @ begin)
    mesh = read_mesh(file, data)
    axes = axes or stated_axes(file, data)
    numbers = _face_numbers(data) if data is not None else None
    taken = axes.take(mesh)
    faces = Faces(taken.corners.mean(axis=1), numbers) if numbers is not None else None
    return Source(taken, unit, "as given", axes, [], file.name, sha256, faces)


def read_mesh(file: Path, data=None) -> Mesh:
    """Return the triangles of a file in its own axes, polygons cut into triangles, not welded.

    data : vtkPolyData of a .ply or .vtp that was read already.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    kind = kind_of(file)
    size = file.stat().st_size
    if size == 0:
        raise AnatomyError(f"{file}: the file is empty")
    if size > _LARGEST:
        raise AnatomyError(f"{file}: {size / 1e9:.3g} GB: a mesh file may have {_LARGEST / 1e9:.3g} GB at most")
    try:
        mesh = (read_stl(file.read_bytes()) if kind == ".stl" else read_obj(file.read_bytes()) if kind == ".obj"
                else _triangles(data or read_by_vtk(file, kind)))
    except AnatomyError as error:
        text = str(error)
        raise AnatomyError(text if text.startswith(str(file)) else f"{file}: {text}") from error
    bad = np.flatnonzero(~np.isfinite(mesh.vertices).all(axis=1))
    if len(bad):
        raise AnatomyError(f"{file}: {len(bad)} of {len(mesh.vertices)} vertices have a coordinate that is not finite; "
                           f"the first is vertex {bad[0] + 1}")
    if np.abs(mesh.vertices).max() > FARTHEST or not mesh.diagonal > 0.0:
        raise AnatomyError(f"{file}: all vertices lie in one point" if not mesh.diagonal > 0.0
                           else f"{file}: a coordinate is beyond {FARTHEST:g}")
    return mesh


def stated_axes(file: Path, data=None) -> Axes:
    """Axes that a mesh's header, comments or field data state, as those of 3D Slicer do; else unknown ones."""
    space = data.GetFieldData().GetAbstractArray("SPACE") if data is not None else None
    if space is not None and space.IsA("vtkStringArray") and space.GetNumberOfValues():
        return axes_named(space.GetValue(0))
    with file.open("rb") as stream:
        found = _SPACE.search(stream.read(4096))
    return axes_named(found[1].decode("ascii")) if found else Axes()


def _triangles(data) -> Mesh:
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if data.GetNumberOfPolys() + data.GetNumberOfStrips() == 0:
        raise AnatomyError("the file holds no triangles")
    cut = _cut(data)
    cells = vtk_to_numpy(cut.GetPolys().GetConnectivityArray())
    vertices = vtk_to_numpy(cut.GetPoints().GetData()).astype(float)
    return Mesh(vertices, cells.reshape(-1, 3).astype(np.int64))


def _face_numbers(data) -> np.ndarray | None:
    """Return (t,): ModelFaceID of each triangle, or None."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if data.GetCellData().GetArray("ModelFaceID") is None:
        return None
    return vtk_to_numpy(_cut(data).GetCellData().GetArray("ModelFaceID")).astype(int).ravel()


def _cut(data):
    """vtkPolyData of triangles alone."""
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter

    cut = vtkTriangleFilter()
    cut.PassLinesOff()
    cut.PassVertsOff()
    cut.SetInputData(data)
    cut.Update()
    return cut.GetOutput()
