"""Files: formats read alike, and one line for what cannot be read."""

from __future__ import annotations

import gzip
import struct
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy import reading  # noqa: E402
from guidewire.anatomy.formats import CENTRELINES, MASKS  # noqa: E402
from guidewire.anatomy.inspection import weld_exactly  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError, signed_volume  # noqa: E402
from guidewire.anatomy.surfaces import to_vtk  # noqa: E402
from guidewire.anatomy.tests.solids import tube, write_stl  # noqa: E402


def write_with_vtk(file: Path, mesh) -> Path:
    from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
    from vtkmodules.vtkIOPLY import vtkPLYWriter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    writer = {".ply": vtkPLYWriter, ".vtp": vtkXMLPolyDataWriter, ".obj": vtkOBJWriter, ".stl": vtkSTLWriter}[
        file.suffix]()
    writer.SetFileName(str(file))
    writer.SetInputData(to_vtk(mesh))
    writer.Write()
    return file


@pytest.mark.parametrize("name", ["a.stl", "a.obj", "a.ply", "a.vtp"])
def test_formats_hold_the_same_mesh(tmp_path: Path, name: str) -> None:
    mesh = tube()
    read = weld_exactly(reading.read_mesh(write_with_vtk(tmp_path / name, mesh)))
    assert len(read.triangles) == len(mesh.triangles)
    assert len(read.vertices) == len(mesh.vertices)
    assert signed_volume(read) == pytest.approx(signed_volume(mesh), rel=1e-5)


def nifti(shape=(8, 8, 8), voxels: bytes | None = None, first: int = 348) -> bytes:
    head = bytearray(352)
    struct.pack_into("<i", head, 0, first)
    struct.pack_into("<8h", head, 40, 3, *shape, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 2, 8)
    struct.pack_into("<8f", head, 76, 1.0, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0)
    struct.pack_into("<f", head, 108, 352.0)
    head[344:348] = b"n+1\0"
    return bytes(head) + (voxels if voxels is not None else bytes(int(np.prod(shape))))


BINARY = b"\0" * 80 + struct.pack("<I", 4) + b"\0" * 90
BAD = {
    "a.txt": (b"", "the name has to end in one of"),
    "a.stl": (b"", "empty"),
    "b.stl": (BINARY, "breaks off: 4 triangles need 284 bytes, there are 174"),
    "c.stl": (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "breaks off"),
    "d.stl": (b"solid words and nothing else, for a hundred characters or so, that no reader of meshes can use at all",
              "a text, but not an STL"),
    "e.stl": (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
              b"endfacet\nendsolid a\n", "line 4"),
    "a.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4: a face of '1 2 9'"),
    "b.obj": (b"v 0 0\n", "line 1"),
    "c.obj": (b"hello\n", "no triangles"),
    "d.obj": (b"v 0 0 0\0", "not a text"),
    "a.ply": (b"solid", "not a PLY"),
    "b.ply": (b"ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\n"
              b"property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n", "breaks off"),
    "a.vtp": (b"<html>", "not a VTK file"),
    "b.vtp": (b"<VTKFile type=\"PolyData\"><PolyData>", "breaks off"),
    "a.nii": (b"short", "NIfTI header"),
    "b.nii": (nifti(first=540), "not a NIfTI-1"),
    "c.nii": (nifti((4096, 4096, 4096), b""), "voxels: 1.07e+09 at most"),
    "d.nii": (nifti((64, 64, 64), b"\0" * 10), "breaks off"),
    "a.nii.gz": (b"not packed", "not packed by gzip"),
    "b.nii.gz": (gzip.compress(nifti((64, 64, 64), b"\0" * 10)), "breaks off"),
    "a.nrrd": (b"NIFTI", "not a NRRD"),
    "a.csv": (b"x,y,z,radius\n0,0,0,1\n0,0,one,1\n", "line 3"),
    "b.csv": (b"0,0,0,1\n", "1 points"),
    "c.csv": (b"0,0,0,1\n0,0,1,-1\n", "point 2"),
    "d.csv": (b"1,2,3,1\n1,2,3,1\n1,2,3,2\n", "3 points in one place"),
    "a.mrk.json": (b"{}", "not a curve of 3D Slicer"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_file_is_one_line(tmp_path: Path, name: str, capfd: pytest.CaptureFixture) -> None:
    content, expected = BAD[name]
    file = tmp_path / name
    file.write_bytes(content)
    with pytest.raises(AnatomyError) as error:
        kind = reading.kind_of(file)
        read = (reading.read_image if kind in MASKS else reading.read_line if kind in CENTRELINES
                else reading.read_mesh)
        read(file)
    assert expected in str(error.value) and "\n" not in str(error.value) and str(file) in str(error.value)
    assert capfd.readouterr().err == ""


def test_centreline_of_slicer_and_of_columns(tmp_path: Path) -> None:
    points = '{"position": [1, 2, 3]}, {"position": [1, 2, 5]}'
    markup = tmp_path / "a.mrk.json"
    markup.write_text('{"markups": [{"coordinateUnits": "mm", "controlPoints": [' + points + '], "measurements": '
                      '[{"name": "Radius", "controlPointValues": [2.0, 1.5]}]}]}')
    table = tmp_path / "a.csv"
    table.write_text("radius,x,y,z\n2,1,2,3\n1.5,1,2,5\n")
    other = tmp_path / "b.csv"
    other.write_text("X;Y;Z;R\n1;2;3;2\n1;2;5;1.5\n")
    for file in (markup, table, other):
        line = reading.read_line(file)
        np.testing.assert_array_equal(line.points, [[1.0, 2.0, 3.0], [1.0, 2.0, 5.0]])
        np.testing.assert_array_equal(line.radii, [2.0, 1.5])


def lines_of_vtp(file: Path, points: str, radii: str) -> Path:
    count = len(radii.split())
    file.write_text(f"""<VTKFile type="PolyData" version="0.1"><PolyData>
<Piece NumberOfPoints="{count}" NumberOfLines="1">
<PointData><DataArray type="Float64" Name="Radius" format="ascii">{radii}</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>
<Lines><DataArray type="Int64" Name="connectivity" format="ascii">{" ".join(map(str, range(count)))}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">{count}</DataArray></Lines>
</Piece></PolyData></VTKFile>""")
    return file


@pytest.mark.parametrize(("points", "radii", "expected"), [
    ("0 0 0 0 0 1", "1 0", "point 2"),
    ("0 0 0 0 0 0", "1 1", "2 points in one place"),
    ("0 0 0", "1", "1 points"),
])
def test_bad_lines_of_a_vtp_are_one_line(tmp_path: Path, points: str, radii: str, expected: str) -> None:
    with pytest.raises(AnatomyError, match=expected):
        reading.line_of_poly_data(lines_of_vtp(tmp_path / "a.vtp", points, radii))


def test_points_there_twice_are_left_out_of_the_lines_of_a_vtp(tmp_path: Path) -> None:
    line = reading.line_of_poly_data(lines_of_vtp(tmp_path / "a.vtp", "0 0 0 0 0 0 0 0 2", "1 1 1.5"))
    np.testing.assert_array_equal(line.points, [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]])
    np.testing.assert_array_equal(line.radii, [1.0, 1.5])


def test_voxels_of_a_nifti_lie_where_its_header_says(tmp_path: Path) -> None:
    voxels = np.zeros((8, 8, 8), dtype=np.uint8)
    voxels[1, 2, 5] = 1
    file = tmp_path / "a.nii"
    file.write_bytes(nifti(voxels=voxels.ravel(order="F").tobytes()))
    image = reading.read_image(file)
    assert image.values.shape == (8, 8, 8) and image.values[1, 2, 5] == 1
    place = image.to_space @ [1.0, 2.0, 5.0, 1.0]
    np.testing.assert_allclose(place[:3], [0.5, 1.0, 2.5], atol=1e-6)


def test_a_nifti_in_metres_is_read_in_mm(tmp_path: Path) -> None:
    content = bytearray(nifti(voxels=bytes(512)))
    (tmp_path / "mm.nii").write_bytes(bytes(content))
    content[123] = 1
    (tmp_path / "m.nii").write_bytes(bytes(content))
    millimetres, metres = (reading.read_image(tmp_path / name).to_space for name in ("mm.nii", "m.nii"))
    np.testing.assert_allclose(metres[:3], 1e3 * millimetres[:3], rtol=1e-12)


@pytest.mark.parametrize("space, signs", [
    ("left-posterior-superior", [1, 1, 1]), ("RAS", [1, 1, 1]), ("left-anterior-superior", [1, -1, 1]),
    ("RPI", [1, 1, 1]), ("RPS", [-1, 1, 1])])
def test_a_left_handed_space_of_an_nrrd_is_turned_and_lines_may_end_as_in_windows(tmp_path: Path, space, signs) -> None:
    head = (f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 12 12 12\nencoding: gzip\nspace: {space}\n"
            "space directions: (0.5,0,0) (0,0.6,0) (0,0,0.7)\nspace origin: (1,2,3)\n\n")
    for name, text in (("a.nrrd", head), ("b.nrrd", head.replace("\n", "\r\n"))):
        (tmp_path / name).write_bytes(text.encode() + gzip.compress(bytes(12**3)))
        image = reading.read_image(tmp_path / name)
        expected = np.c_[np.diag([0.5, 0.6, 0.7]), [1.0, 2.0, 3.0]] * np.array(signs)[:, None]
        np.testing.assert_allclose(image.to_space[:3], expected, atol=1e-12)
        assert ("left-handed" in image.note) == (signs != [1, 1, 1])


def test_binary_stl_is_read(tmp_path: Path) -> None:
    assert len(reading.read_mesh(write_stl(tmp_path / "a.stl", tube())).triangles) == len(tube().triangles)
