"""Files that VTK reads: no input ends the process, and what VTK complains of is one line."""

from __future__ import annotations

import locale
import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from guidewire.anatomy.mesh import AnatomyError

_KINDS = {".vtp": "PolyData", ".vti": "ImageData", ".vtu": "UnstructuredGrid"}


def read_by_vtk(file: Path, kind: str):
    """vtkPolyData of a .ply, .vtp, .vtk or .vtu, of the last the outer surface, or vtkImageData of a .vti.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    size = file.stat().st_size
    with file.open("rb") as stream:
        head = stream.read(4096)
    if kind == ".ply":
        _check_ply(file, head, size)
    elif kind == ".vtk":
        _check_legacy(file, head)
    else:
        _check_xml(file, head, size, _KINDS[kind])
    if _crashes(file, kind):
        raise AnatomyError(f"{file}: VTK ends when it reads this file: it is damaged")
    lines: list[str] = []
    reader = _reader(file, kind)
    _update(reader, lines)
    if lines:
        raise AnatomyError(f"{file}: {lines[0].strip()}")
    data = _surface(reader.GetOutput()) if kind == ".vtu" else reader.GetOutput()
    if kind != ".vti":
        _check_points(file, data)
    return data


def _surface(grid):
    """vtkPolyData of the outer faces of cells."""
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

    faces = vtkGeometryFilter()
    faces.SetInputData(grid)
    faces.Update()
    return faces.GetOutput()


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
    elif kind == ".vti":
        from vtkmodules.vtkIOXML import vtkXMLImageDataReader as Reader
    elif kind == ".vtu":
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader as Reader
    elif kind == ".vtk":
        from vtkmodules.vtkIOLegacy import vtkPolyDataReader as Reader
    else:
        from vtkmodules.vtkIOPLY import vtkPLYReader as Reader
    reader = Reader()
    reader.SetFileName(str(file))
    return reader


def _crashes(file: Path, kind: str) -> bool:
    """Return whether VTK's reader ends the process, tried in another one."""
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


@contextmanager
def kept_locale() -> Iterator[None]:
    """Keep the locale of this process: VTK's legacy files set it to C, and text files would be ASCII from then on."""
    before = locale.setlocale(locale.LC_ALL)
    try:
        yield
    finally:
        locale.setlocale(locale.LC_ALL, before)


def _update(reader, lines: list[str]) -> None:
    """Run a reader; what it complains of is appended to lines, instead of printed."""
    import vtkmodules.vtkCommonCore as core

    window = core.vtkStringOutputWindow()
    before = core.vtkOutputWindow.GetInstance()
    core.vtkOutputWindow.SetInstance(window)
    try:
        reader.AddObserver("ErrorEvent", lambda *_: lines.append("VTK cannot read it"))
        with kept_locale():
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


def _check_legacy(file: Path, head: bytes) -> None:
    found = re.search(rb"^DATASET\s+(\w+)", head, re.MULTILINE)
    if not head.startswith(b"# vtk") or found is None:
        raise AnatomyError(f"{file}: not a VTK file: its first line is not '# vtk DataFile', or it has no DATASET")
    if found[1] != b"POLYDATA":
        raise AnatomyError(f"{file}: {found[1].decode()} instead of POLYDATA: 3D Slicer or ParaView opens it and saves "
                           "an image as .nrrd, a mesh as .stl")


def _check_xml(file: Path, head: bytes, size: int, what: str) -> None:
    if what.encode() not in head:
        raise AnatomyError(f"{file}: not a VTK file of {what} in XML")
    with file.open("rb") as stream:
        stream.seek(max(0, size - 256))
        if b"</VTKFile>" not in stream.read():
            raise AnatomyError(f"{file}: the file breaks off: its last line is no '</VTKFile>'")
