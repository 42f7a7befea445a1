"""Reads a vessel from a mesh, a mask or a centreline: its wall, what its unit is, and how its axes lie in the patient.
"""

from __future__ import annotations

import hashlib
import os
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from guidewire.anatomy.formats import CENTRELINES, ENDINGS, MASKS
from guidewire.anatomy.images import read_image
from guidewire.anatomy.mesh import FARTHEST, AnatomyError, Mesh
from guidewire.anatomy.patient import Axes, axes_named
from guidewire.anatomy.triangles import read_obj, read_stl

_LARGEST = 1 << 30  # bytes of a mesh file
_SPACE = re.compile(rb"SPACE\s*=\s*(LPS|RAS)")  # as 3D Slicer writes it into headers and comments of meshes


@dataclass(frozen=True)
class Faces:
    """Faces of a wall, such as its caps, by number, as SimVascular writes them. middles : ndarray (t, 3) of triangles;
    numbers : ndarray of int (t,)."""

    middles: np.ndarray
    numbers: np.ndarray

    def of(self, mesh: Mesh) -> np.ndarray:
        """(t,): the face of each triangle of a mesh, by the nearest middle."""
        return self.numbers[cKDTree(self.middles).query(mesh.corners.mean(axis=1))[1]]


@dataclass(frozen=True)
class Source:
    """mesh : in LPS where the axes are known, else in the file's own; unit : where it is known; unit_said_by : who says
    the unit; axes : of the file; notes : what was done; name : of the file, or what was made; sha256 : of the file's
    bytes; faces : of the wall, where the file numbers them; begin : (3,), where all lines of a file begin, or None."""

    mesh: Mesh
    unit: str | None
    unit_said_by: str
    axes: Axes = Axes()
    notes: list[str] = field(default_factory=list)
    name: str = ""
    sha256: str = ""
    faces: Faces | None = None
    begin: np.ndarray | None = None

    @property
    def stem(self) -> str:
        """The name without the ending that is known here: of "a.b.nii.gz" "a.b"."""
        return stem_of(self.name)


def stem_of(name: str) -> str:
    """A file's name without the ending that is known here."""
    ending = next((one for one in ENDINGS if name.lower().endswith(one)), "")
    return name[:len(name) - len(ending)] or name


def kind_of(file: Path) -> str:
    """The ending of a name that is read here, such as ".nii.gz".

    Raises
    ------
    AnatomyError : the name has another ending, or there is no such file.
    """
    name = file.name.lower()
    for ending in ENDINGS:
        if name.endswith(ending):
            if not file.is_file():
                raise AnatomyError(f"{file}: {'is a folder' if file.is_dir() else 'no such file'}")
            return ending
    raise AnatomyError(f"{file}: the name has to end in one of {', '.join(ENDINGS)}")


def read(file: Path, unit: str | None = None, label: float | None = None, threshold: float | None = None,
         error: float | None = None, region: int | None = None, axes: Axes | None = None) -> Source:
    """The wall in a file, or one made of its mask or centreline.

    Parameters
    ----------
    unit, axes : of the file, in place of what it says.
    label, threshold, error, region : as of `masks.mesh_of_image`.

    Raises
    ------
    AnatomyError : one line, for a file that holds no vessel.
    """
    kind = kind_of(file)
    size = file.stat().st_size
    if size == 0:
        raise AnatomyError(f"{file}: the file is empty")
    sha256 = hashlib.sha256(file.read_bytes()).hexdigest()
    if kind in MASKS:
        from guidewire.anatomy.masks import mesh_of_image

        image = read_image(file, kind, axes)
        mesh, notes = mesh_of_image(image, label, threshold, error, region)
        return Source(mesh, "mm", "as the file says", image.axes, notes, file.name, sha256)
    from guidewire.anatomy import lines

    data = _poly_data(file, kind) if kind in (".ply", ".vtp") else None
    found = (lines.read_lines(file, kind) if kind in CENTRELINES
             else lines.lines_of_poly_data(file, data) if kind == ".vtp" else None)
    if found is not None:
        mesh, done = lines.mesh_of_lines(found.lines)
        said = unit or found.unit or None
        by = "as given" if unit else "as the file says"
        axes = axes or found.axes
        begin = lines.begin_of(found.lines)
        return Source(axes.take(mesh), said, by, axes, [done], file.name, sha256,
                      begin=None if begin is None else axes.to_lps @ begin)
    mesh = read_mesh(file, data)
    axes = axes or _stated_axes(file)
    numbers = _face_numbers(data) if data is not None else None
    taken = axes.take(mesh)
    faces = Faces(taken.corners.mean(axis=1), numbers) if numbers is not None else None
    return Source(taken, unit, "as given", axes, [], file.name, sha256, faces)


def read_mesh(file: Path, data=None) -> Mesh:
    """The triangles of a file in its own axes, polygons cut into triangles, not welded.

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
                else _triangles(data or _poly_data(file, kind)))
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


def _stated_axes(file: Path) -> Axes:
    """Axes that a mesh's header or comments state, as those of 3D Slicer do; else unknown ones."""
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
    """(t,): ModelFaceID of each triangle, or None."""
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


def _poly_data(file: Path, kind: str):
    """vtkPolyData of a .ply or .vtp.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    size = file.stat().st_size
    with file.open("rb") as stream:
        head = stream.read(4096)
    (_check_ply if kind == ".ply" else _check_vtp)(file, head, size)
    if _crashes(file, kind):
        raise AnatomyError(f"{file}: VTK ends when it reads this file: it is damaged")
    lines: list[str] = []
    reader = _reader(file, kind)
    _update(reader, lines)
    if lines:
        raise AnatomyError(f"{file}: {lines[0].strip()}")
    data = reader.GetOutput()
    _check_points(file, data)
    return data


def _check_points(file: Path, data) -> None:
    """VTK takes the numbers of points as they are, and filters read beyond the last one."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    count = data.GetNumberOfPoints()
    for cells in (data.GetVerts(), data.GetLines(), data.GetPolys(), data.GetStrips()):
        index = vtk_to_numpy(cells.GetConnectivityArray())
        bad = index[(index < 0) | (index >= count)]
        if len(bad):
            raise AnatomyError(f"{file}: a cell has point {bad[0]}: there are {count} points, numbered from 0")


def _reader(file: Path, kind: str):
    if kind == ".vtp":
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader as Reader
    else:
        from vtkmodules.vtkIOPLY import vtkPLYReader as Reader
    reader = Reader()
    reader.SetFileName(str(file))
    return reader


def _crashes(file: Path, kind: str) -> bool:
    """Whether VTK's reader ends the process, tried in another one."""
    if not hasattr(os, "fork"):
        return False
    reader = _reader(file, kind)
    child = os.fork()
    if child == 0:
        try:
            _update(reader, [])
        finally:
            os._exit(0)
    return os.WIFSIGNALED(os.waitpid(child, 0)[1])


def _update(reader, lines: list[str]) -> None:
    """Run a reader; what it complains of is appended to lines, instead of printed."""
    import vtkmodules.vtkCommonCore as core

    window = core.vtkStringOutputWindow()
    before = core.vtkOutputWindow.GetInstance()
    core.vtkOutputWindow.SetInstance(window)
    try:
        reader.AddObserver("ErrorEvent", lambda *_: lines.append("VTK cannot read it"))
        reader.Update()
    finally:
        core.vtkOutputWindow.SetInstance(before)
    said = [line for line in window.GetOutput().splitlines() if line.strip() and not line.startswith("ERROR")]
    if said and lines:
        lines.insert(0, re.sub(r"^vtk\w+ \(0x\w+\): ", "", said[0]))


def _check_ply(file: Path, head: bytes, size: int) -> None:
    if not head.startswith(b"ply"):
        raise AnatomyError(f"{file}: not a PLY: its first line is not 'ply'")
    if b"end_header" not in head:
        raise AnatomyError(f"{file}: the file breaks off, or its header has more than 4096 bytes")
    text, _, _ = head.partition(b"end_header")
    counts = {name: int(number) for name, number in re.findall(rb"element (\w+) (\d+)", text)}
    body = size - len(text) - len(b"end_header\n")
    least = 2 if b"format ascii" in text else 12
    if counts.get(b"vertex", 0) * least + counts.get(b"face", 0) * 2 > body:
        raise AnatomyError(f"{file}: the file breaks off: the header tells of {counts.get(b'vertex', 0)} vertices and "
                           f"{counts.get(b'face', 0)} faces, behind it are {max(body, 0)} bytes")


def _check_vtp(file: Path, head: bytes, size: int) -> None:
    if b"PolyData" not in head:
        raise AnatomyError(f"{file}: not a VTK file of PolyData in XML")
    with file.open("rb") as stream:
        stream.seek(max(0, size - 256))
        if b"</VTKFile>" not in stream.read():
            raise AnatomyError(f"{file}: the file breaks off: its last line is no '</VTKFile>'")
