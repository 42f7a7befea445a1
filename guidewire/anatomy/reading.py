"""Reads a mesh, a mask or a centreline from a file with VTK, and reports errors of the file."""

from __future__ import annotations

import csv
import json
import re
import struct
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from guidewire.anatomy.formats import CENTRELINES, MASKS, MESHES
from guidewire.anatomy.mesh import AnatomyError, Mesh

_LARGEST = 1 << 30  # bytes of a mesh file
_MOST_VOXELS = 1 << 30
_MM = {1: 1e3, 3: 1e-3}  # of a length in a NIfTI file, by its code of units: m, um; others are mm
_TO_LPS = {"l": 1.0, "p": 1.0, "s": 1.0, "r": -1.0, "a": -1.0, "i": -1.0}


@dataclass(frozen=True)
class Image:
    """values : ndarray (i, j, k); to_space : ndarray (4, 4), from indices of voxels to mm; note : what was done to its
    axes, or empty."""

    values: np.ndarray
    to_space: np.ndarray
    note: str = ""


@dataclass(frozen=True)
class Line:
    """points : ndarray (k, 3); radii : ndarray (k,); unit : its name where the file says it, else empty; others : how
    many further lines the file has."""

    points: np.ndarray
    radii: np.ndarray
    unit: str = ""
    others: int = 0


def kind_of(file: Path) -> str:
    """The ending of a name that is read here, such as ".nii.gz".

    Raises
    ------
    AnatomyError : the name has another ending, or there is no such file.
    """
    name = file.name.lower()
    for ending in (*MESHES, *MASKS, *CENTRELINES):
        if name.endswith(ending):
            if not file.is_file():
                raise AnatomyError(f"{file}: {'is a folder' if file.is_dir() else 'no such file'}")
            return ending
    raise AnatomyError(f"{file}: the name has to end in one of {', '.join((*MESHES, *MASKS, *CENTRELINES))}")


def read_mesh(file: Path) -> Mesh:
    """The triangles of a file, polygons cut into triangles, not welded.

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
    with file.open("rb") as stream:
        head = stream.read(4096)
    _CHECKS[kind](file, head, size)
    from vtkmodules.util.numpy_support import vtk_to_numpy

    data, lines = _poly_data(file, kind)
    if data.GetNumberOfPolys() + data.GetNumberOfStrips() == 0:
        raise AnatomyError(f"{file}: {_said(lines) or 'the file holds no triangles'}")
    if lines:
        raise AnatomyError(f"{file}: {_said(lines)}")
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter

    cut = vtkTriangleFilter()
    cut.PassLinesOff()
    cut.PassVertsOff()
    cut.SetInputData(data)
    cut.Update()
    cells = vtk_to_numpy(cut.GetOutput().GetPolys().GetConnectivityArray())
    vertices = vtk_to_numpy(cut.GetOutput().GetPoints().GetData()).astype(float)
    mesh = Mesh(vertices, cells.reshape(-1, 3).astype(np.int64))
    bad = np.flatnonzero(~np.isfinite(vertices).all(axis=1))
    if len(bad):
        raise AnatomyError(f"{file}: {len(bad)} of {len(vertices)} vertices have a coordinate that is not finite; the "
                           f"first is vertex {bad[0] + 1}")
    if np.abs(vertices).max() > 1e9 or not mesh.diagonal > 0.0:
        raise AnatomyError(f"{file}: all vertices lie in one point" if not mesh.diagonal > 0.0
                           else f"{file}: a coordinate is beyond 1e9")
    return mesh


def read_image(file: Path) -> Image:
    """A mask or an image.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    kind = kind_of(file)
    _check_image(file, kind)
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if kind == ".nrrd":
        from vtkmodules.vtkIOImage import vtkNrrdReader as Reader
    else:
        from vtkmodules.vtkIOImage import vtkNIFTIImageReader as Reader
    reader = Reader()
    reader.SetFileName(str(file))
    lines = _update(reader)
    data = reader.GetOutput()
    if lines or data.GetPointData().GetScalars() is None:
        raise AnatomyError(f"{file}: {_said(lines) or 'the file holds no voxels'}")
    values = vtk_to_numpy(data.GetPointData().GetScalars())
    if values.ndim > 1:
        raise AnatomyError(f"{file}: {values.shape[1]} numbers a voxel: a mask has one")
    values = values.reshape(data.GetDimensions()[::-1]).transpose(2, 1, 0)
    to_space = np.diag([*data.GetSpacing(), 1.0])
    to_space[:3, 3] = data.GetOrigin()
    turn = None if kind == ".nrrd" else reader.GetSFormMatrix() or reader.GetQFormMatrix()
    if turn is not None:
        # VTK's matrix takes positions, spacing included, to the patient's axes.
        to_space = np.array([[turn.GetElement(i, j) for j in range(4)] for i in range(4)]) @ to_space
    note = ""
    if kind == ".nrrd":
        to_space, note = _nrrd_axes(file, to_space)
    else:
        to_space[:3] *= _MM.get(reader.GetNIFTIHeader().GetXYZTUnits() & 7, 1.0)
    if np.asarray(values).dtype.kind == "f" and not np.isfinite(values).all():
        raise AnatomyError(f"{file}: {int((~np.isfinite(values)).sum())} voxels are not finite")
    return Image(values, to_space, note)


def read_line(file: Path) -> Line:
    """A centreline with radii: columns x, y, z, radius of a .csv, or a curve of 3D Slicer with the measurement Radius.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    return _checked(file, _read_csv(file) if kind_of(file) == ".csv" else _read_markups(file))


def _checked(file: Path, line: Line) -> Line:
    """The line without points that are there twice.

    Raises
    ------
    AnatomyError : fewer than two places, or a number or a radius that is none.
    """
    if len(line.points) < 2:
        raise AnatomyError(f"{file}: {len(line.points)} points: a centreline has two or more")
    if not (np.isfinite(line.points).all() and np.isfinite(line.radii).all() and (line.radii > 0.0).all()):
        bad = int(np.flatnonzero(~(np.isfinite(line.points).all(axis=1) & (line.radii > 0.0)))[0])
        raise AnatomyError(f"{file}: point {bad + 1}: three numbers and a radius above 0 are needed")
    steps = np.linalg.norm(np.diff(line.points, axis=0), axis=1)
    kept = np.r_[True, steps > 1e-9 * steps.sum()]
    if kept.sum() < 2:
        raise AnatomyError(f"{file}: {len(kept)} points in one place: a centreline has two places or more")
    return replace(line, points=line.points[kept], radii=line.radii[kept])


def line_of_poly_data(file: Path) -> Line | None:
    """The centreline of a .vtp that has lines and a radius at each point and no triangles, else None."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    data, _ = _poly_data(file, ".vtp")
    if data.GetNumberOfPolys() or not data.GetNumberOfLines():
        return None
    names = [data.GetPointData().GetArrayName(k) or "" for k in range(data.GetPointData().GetNumberOfArrays())]
    radius = next((name for name in names if "radius" in name.lower()), None)
    if radius is None:
        raise AnatomyError(f"{file}: lines without a radius: an array named Radius at the points is needed")
    cells = data.GetLines()
    ends = vtk_to_numpy(cells.GetOffsetsArray())
    longest = int(np.argmax(np.diff(ends)))
    index = vtk_to_numpy(cells.GetConnectivityArray())[ends[longest]:ends[longest + 1]]
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)[index]
    radii = vtk_to_numpy(data.GetPointData().GetArray(radius)).astype(float)[index]
    return _checked(file, Line(points, radii, others=len(ends) - 2))


def _read_csv(file: Path) -> Line:
    try:
        lines = file.read_text(encoding="utf-8-sig").splitlines()
        separator = next((mark for mark in ";\t" if lines and mark in lines[0]), ",")
        rows = [row for row in csv.reader(lines, delimiter=separator) if row]
    except (UnicodeDecodeError, csv.Error) as error:
        raise AnatomyError(f"{file}: not a text of x, y, z, radius in columns") from error
    head = rows[:1] if rows and any(re.search("[a-df-zA-DF-Z]", word) for word in rows[0]) else []
    columns, unit = _columns_of(file, head[0]) if head else ([0, 1, 2, 3], "")
    numbers = []
    for number, row in enumerate(rows[len(head):], len(head) + 1):
        try:
            numbers.append([float(row[k]) for k in columns])
        except (ValueError, IndexError) as error:
            has_commas = any(re.fullmatch(r"\s*[-+]?\d+,\d+\s*", word) for word in row) or len(row) > 4 and not head
            hint = "; numbers have a decimal point, not a comma" if has_commas else ""
            raise AnatomyError(f"{file}: line {number} is not x, y, z, radius: {separator.join(row)[:60]}{hint}") from error
    table = np.array(numbers).reshape(-1, 4)
    return Line(table[:, :3], table[:, 3], unit)


def _columns_of(file: Path, head: list[str]) -> tuple[list[int], str]:
    """Where x, y, z and radius are by a first line of names, such as x_mm, and the unit that these state."""
    parted = [re.fullmatch(r"\s*(\w+?)(?:[ _(\[]+(mm|cm|m)[)\]]?)?\s*", word) for word in head]
    names = [("radius" if found[1].lower() == "r" else found[1].lower()) if found else "" for found in parted]
    needed = ("x", "y", "z", "radius")
    columns = [next((k for k, name in enumerate(names) if name == word or word == "radius" and name.endswith(word)), -1)
               for word in needed]
    if -1 in columns:
        raise AnatomyError(f"{file}: line 1 has no column {needed[columns.index(-1)]}: needed are {', '.join(needed)}")
    units = {parted[k][2] or "" for k in columns}
    if len(units) > 1:
        raise AnatomyError(f"{file}: line 1: x, y, z and radius need to be in one unit")
    return columns, units.pop()


def _read_markups(file: Path) -> Line:
    try:
        curve = json.loads(file.read_text(encoding="utf-8"))["markups"][0]
        points = np.array([point["position"] for point in curve["controlPoints"]], dtype=float).reshape(-1, 3)
        found = [m for m in curve.get("measurements", []) if m.get("name", "").lower() == "radius"]
        if not found:
            raise AnatomyError(f"{file}: the curve has no measurement Radius")
        radii = np.array(found[0]["controlPointValues"], dtype=float)
    except (ValueError, KeyError, IndexError, TypeError, AttributeError) as error:
        raise AnatomyError(f"{file}: not a curve of 3D Slicer (.mrk.json) with control points and radii") from error
    if radii.shape != (len(points),):
        raise AnatomyError(f"{file}: {len(points)} control points and {radii.size} radii: one each is needed")
    return Line(points, radii, curve.get("coordinateUnits", ""))


def _poly_data(file: Path, kind: str):
    if kind == ".vtp":
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader as Reader
    elif kind == ".ply":
        from vtkmodules.vtkIOPLY import vtkPLYReader as Reader
    else:
        from vtkmodules.vtkIOGeometry import vtkOBJReader, vtkSTLReader
        Reader = vtkSTLReader if kind == ".stl" else vtkOBJReader
    reader = Reader()
    reader.SetFileName(str(file))
    if kind == ".stl":
        reader.MergingOff()
    lines = _update(reader)
    return reader.GetOutput(), lines


def _update(reader) -> list[str]:
    """Run a reader; returns what it complained of, instead of printing it."""
    import vtkmodules.vtkCommonCore as core

    lines: list[str] = []
    window = core.vtkStringOutputWindow()
    before = core.vtkOutputWindow.GetInstance()
    core.vtkOutputWindow.SetInstance(window)
    try:
        reader.AddObserver("ErrorEvent", lambda *_: lines.append("VTK cannot read it"))
        reader.Update()
    finally:
        core.vtkOutputWindow.SetInstance(before)
    said = [line for line in window.GetOutput().splitlines() if line.strip() and not line.startswith("ERROR")]
    return ([re.sub(r"^vtk\w+ \(0x\w+\): ", "", said[0])] if said and lines else []) + lines


def _said(lines: list[str]) -> str:
    return lines[0].strip() if lines else ""


def _check_stl(file: Path, head: bytes, size: int) -> None:
    is_text = head.lstrip().startswith(b"solid") and b"facet" in head and b"\0" not in head[:200]
    if is_text:
        with file.open("rb") as stream:
            stream.seek(max(0, size - 512))
            if b"endsolid" not in stream.read():
                raise AnatomyError(f"{file}: the text breaks off: its last line is no 'endsolid'")
        _check_numbers(file, b"vertex", 3)
        return
    if size < 84:
        raise AnatomyError(f"{file}: {size} bytes: neither a text that begins with 'solid' nor a binary STL")
    count = struct.unpack_from("<I", head, 80)[0]
    if 84 + 50 * count > size:
        is_plain = all(byte in b"\t\n\r" or 32 <= byte < 127 for byte in head[:200])
        raise AnatomyError(f"{file}: " + ("a text, but not an STL: there is no 'facet' after 'solid'" if is_plain else
                                          f"the file breaks off: {count} triangles need {84 + 50 * count} bytes, there "
                                          f"are {size}"))


def _check_obj(file: Path, head: bytes, size: int) -> None:
    if b"\0" in head:
        raise AnatomyError(f"{file}: not a text: an OBJ file is one")
    count = _check_numbers(file, b"v", 3)
    for number, words in _lines_of(file, b"f"):
        try:
            indices = [int(word.split(b"/")[0]) for word in words]
        except ValueError as error:
            raise AnatomyError(f"{file}: line {number}: a face of '{_shown(words)}': whole numbers are needed"
                               ) from error
        if len(indices) < 3 or any(i == 0 or abs(i) > count for i in indices):
            raise AnatomyError(f"{file}: line {number}: a face of '{_shown(words)}': three or more numbers of vertices "
                               f"from 1 to {count} are needed")


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


_CHECKS = {".stl": _check_stl, ".obj": _check_obj, ".ply": _check_ply, ".vtp": _check_vtp}


def _check_numbers(file: Path, word: bytes, count: int) -> int:
    """How many lines begin with a word and so many finite numbers, as all that begin with it must."""
    found = 0
    for number, words in _lines_of(file, word):
        try:
            is_good = len(words) >= count and all(np.isfinite(float(w)) for w in words[:count])
        except ValueError:
            is_good = False
        if not is_good:
            raise AnatomyError(f"{file}: line {number}: '{word.decode()} {_shown(words)}': {count} finite numbers are "
                               "needed")
        found += 1
    return found


def _lines_of(file: Path, word: bytes):
    with file.open("rb") as stream:
        for number, line in enumerate(stream, 1):
            if line.lstrip().startswith(word):
                words = line.split()
                if words[0] == word:
                    yield number, words[1:]


def _shown(words: list[bytes]) -> str:
    return b" ".join(words)[:40].decode("ascii", "replace")


def _check_image(file: Path, kind: str) -> None:
    """Raises where the header asks for more voxels than the file can hold."""
    import gzip

    size = file.stat().st_size
    try:
        opened = gzip.open(file, "rb") if kind == ".nii.gz" else file.open("rb")
        with opened as stream:
            head = stream.read(4096)
    except (OSError, EOFError) as error:
        raise AnatomyError(f"{file}: not packed by gzip, or broken off") from error
    if kind == ".nrrd":
        if not head.startswith(b"NRRD"):
            raise AnatomyError(f"{file}: not a NRRD: it does not begin with 'NRRD'")
        found = re.search(rb"^sizes:([\d ]+)\r?$", head, re.M)
        sizes = [int(word) for word in found[1].split()] if found else []
        is_packed = b"encoding: raw" not in head
        bytes_each = 1
    else:
        if len(head) < 348:
            raise AnatomyError(f"{file}: {len(head)} bytes: a NIfTI header has 348")
        order = "<" if struct.unpack_from("<i", head)[0] == 348 else ">"
        if struct.unpack_from(order + "i", head)[0] != 348:
            raise AnatomyError(f"{file}: not a NIfTI-1 file: its first number is not 348")
        dim = struct.unpack_from(order + "8h", head, 40)
        sizes = [max(n, 0) for n in dim[1:1 + max(min(dim[0], 7), 0)]]
        bytes_each = max(struct.unpack_from(order + "h", head, 72)[0] // 8, 1)
        is_packed = kind == ".nii.gz"
    sizes = [n for n in sizes if n != 1]
    voxels = int(np.prod([float(n) for n in sizes])) if sizes else 0
    if len(sizes) != 3 or voxels == 0:
        raise AnatomyError(f"{file}: an image of {' x '.join(map(str, sizes)) or 'no'} voxels: three sizes are needed")
    if voxels > _MOST_VOXELS:
        raise AnatomyError(f"{file}: the header tells of {voxels:.3g} voxels: {_MOST_VOXELS:.3g} at most are read")
    if not is_packed and voxels * bytes_each > size:
        raise AnatomyError(f"{file}: the file breaks off: {voxels} voxels need {voxels * bytes_each} bytes, there are "
                           f"{size}")
    if kind == ".nii.gz":
        _check_packed(file, voxels * bytes_each)


def _check_packed(file: Path, needed: int) -> None:
    import gzip
    import zlib

    read = 0
    try:
        with gzip.open(file, "rb") as stream:
            while read < needed and (block := stream.read(1 << 22)):
                read += len(block)
    except (OSError, EOFError, zlib.error) as error:
        raise AnatomyError(f"{file}: the file breaks off") from error
    if read < needed:
        raise AnatomyError(f"{file}: the file breaks off: the voxels need {needed} bytes, there are {read}")


def _nrrd_axes(file: Path, fallback: np.ndarray) -> tuple[np.ndarray, str]:
    """From voxels to mm, and what was done to axes that are mirrored."""
    with file.open("rb") as stream:
        head = stream.read(4096).replace(b"\r\n", b"\n").split(b"\n\n")[0].decode("ascii", "replace")
    found = re.search(r"^space directions:(.*)$", head, re.M)
    rows = re.findall(r"\(([^()]*)\)", found[1]) if found else []
    if len(rows) != 3:
        return fallback, ""
    to_space = np.eye(4)
    to_space[:3, :3] = np.array([[float(word) for word in row.split(",")] for row in rows]).T
    origin = re.search(r"^space origin:\s*\(([^()]*)\)", head, re.M)
    if origin:
        to_space[:3, 3] = [float(word) for word in origin[1].split(",")]
    space = re.search(r"^space:\s*([\w-]+)", head, re.M)
    letters = [word[0] for word in space[1].lower().split("-")] if space and "-" in space[1] else list(
        space[1].lower()) if space else []
    signs = [_TO_LPS.get(letter, 0.0) for letter in letters]
    if len(signs) == 3 and np.prod(signs) < 0.0:
        to_space[:3] *= np.array(signs)[:, None]
        return to_space, f"space {space[1]}, which is left-handed, turned to left-posterior-superior"
    return to_space, ""
