"""Files: formats read alike, and one line for what cannot be read."""

from __future__ import annotations

import bz2
import gzip
import itertools
import struct
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy import reading  # noqa: E402
from guidewire.anatomy.images import read_image  # noqa: E402
from guidewire.anatomy.inspection import weld_exactly  # noqa: E402
from guidewire.anatomy.lines import lines_of_poly_data, read_lines  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError, signed_volume  # noqa: E402
from guidewire.anatomy.patient import axes_named  # noqa: E402
from guidewire.anatomy.surfaces import to_vtk  # noqa: E402
from guidewire.anatomy.tests.solids import tube, write_stl  # noqa: E402
from guidewire.anatomy.vtk_files import read_by_vtk  # noqa: E402


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


def test_of_a_vtu_of_tetrahedra_the_outer_surface_is_read(tmp_path: Path) -> None:
    """A box of 3 x 3 x 8 cubes, each of six tetrahedra."""
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    side, points, grid = np.arange(4), vtkPoints(), vtkUnstructuredGrid()
    for x, y, z in itertools.product(side, side, range(9)):
        points.InsertNextPoint(float(x), float(y), float(z))
    grid.SetPoints(points)
    at = np.arange(16 * 9).reshape(4, 4, 9)
    for x, y, z in itertools.product(range(3), range(3), range(8)):
        for order in itertools.permutations(range(3)):    # six tetrahedra along the diagonal of a cube
            corner, corners = np.array([x, y, z]), [at[x, y, z]]
            for axis in order:
                corner = corner + np.eye(3, dtype=int)[axis]
                corners.append(at[tuple(corner)])
            if np.linalg.det(np.eye(3)[list(order)]) < 0.0:    # VTK's sense of a tetrahedron
                corners[2:] = corners[:1:-1]
            grid.InsertNextCell(VTK_TETRA, 4, [int(one) for one in corners])
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(tmp_path / "a.vtu"))
    writer.SetInputData(grid)
    writer.Write()
    read = weld_exactly(reading.read_mesh(tmp_path / "a.vtu"))
    assert abs(signed_volume(read)) == pytest.approx(3.0 * 3.0 * 8.0)
    assert len(read.triangles) == 2 * (2 * 9 + 4 * 24)


@pytest.mark.parametrize("kind", ["ascii", "little", "big"])
def test_a_ply_of_any_kind_holds_the_same_mesh(tmp_path: Path, kind: str) -> None:
    mesh = tube()
    head = (f"ply\nformat {'ascii' if kind == 'ascii' else f'binary_{kind}_endian'} 1.0\ncomment SPACE=RAS\n"
            f"element vertex {len(mesh.vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
            f"element face {len(mesh.triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    if kind == "ascii":
        body = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in mesh.vertices.tolist()) + "".join(
            f"3 {a} {b} {c}\n" for a, b, c in mesh.triangles)
        (tmp_path / "a.ply").write_text(head + body)
    else:
        order = "<" if kind == "little" else ">"
        rows = np.zeros(len(mesh.triangles), dtype=[("n", "u1"), ("ids", order + "i4", 3)])
        rows["n"], rows["ids"] = 3, mesh.triangles
        (tmp_path / "a.ply").write_bytes(head.encode() + mesh.vertices.astype(order + "f8").tobytes() + rows.tobytes())
    read = reading.read_mesh(tmp_path / "a.ply")
    np.testing.assert_array_equal(read.triangles, mesh.triangles)
    np.testing.assert_allclose(read.vertices, mesh.vertices, atol=1e-5)
    assert reading.read(tmp_path / "a.ply").axes.letters == "RAS"


@pytest.mark.parametrize("mode", [0, 1, 2])  # ASCII, binary, appended
@pytest.mark.parametrize("is_packed", [False, True])
def test_a_vtp_of_any_kind_holds_the_same_mesh_and_strips_are_triangles(tmp_path: Path, mode: int, is_packed) -> None:
    from vtkmodules.vtkFiltersCore import vtkStripper
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    strips = vtkStripper()
    strips.SetInputData(to_vtk(tube()))
    strips.Update()
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(tmp_path / "a.vtp"))
    writer.SetInputData(strips.GetOutput())
    writer.SetDataMode(mode)
    if not is_packed:
        writer.SetCompressorTypeToNone()
    writer.Write()
    read = weld_exactly(reading.read_mesh(tmp_path / "a.vtp"))
    assert len(read.triangles) == len(tube().triangles)
    assert signed_volume(read) == pytest.approx(signed_volume(tube()), rel=1e-5)


POINTS = "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\n"
SOLID = "solid a\n" + "".join(
    "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {corner}\n" for corner in corners) + "endloop\nendfacet\n"
    for corners in (("0 0 0", "0 10 0", "10 0 0"), ("0 0 0", "10 0 0", "0 0 10"), ("0 0 0", "0 0 10", "0 10 0"),
                    ("10 0 0", "0 10 0", "0 0 10"))) + "endsolid a\n"
FACES = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


@pytest.mark.parametrize("name, content", [  # the runner's readers have the same cases in MeshFileTests
    ("slash.obj", POINTS + FACES.replace("f 1 3 2", "f 1/ 3/ 2/")),
    ("slashes.obj", POINTS + "usemtl \n" + FACES.replace("f 1 3 2", "f 1// 3//7 2/5").replace("f 2 3 4", "f -3 -2 -1")),
    ("mark.obj", "\ufeff" + POINTS + FACES.replace("f 1 3 2", "f 1 3 \\\n2")),
    ("ends.obj", POINTS + "lod 3\nvn 0 0 1\n" + FACES.replace("\n", " # a comment\r\n")),
    ("capitals.stl", SOLID.upper()), ("blank.stl", SOLID.replace("endsolid",
                                                                 "end solid").replace("endfacet", "end facet")),
])
def test_a_tetrahedron_is_read_from_every_kind_of_text(tmp_path: Path, name: str, content: str) -> None:
    (tmp_path / name).write_bytes(content.encode())
    mesh = reading.read_mesh(tmp_path / name)
    assert len(mesh.triangles) == 4 and signed_volume(mesh) == pytest.approx(1000.0 / 6.0, rel=1e-9)


def test_bytes_behind_a_binary_stl_are_left_out_up_to_a_triangle(tmp_path: Path) -> None:
    data = write_stl(tmp_path / "a.stl", tube()).read_bytes()
    (tmp_path / "a.stl").write_bytes(data + b"\r\n")
    assert len(reading.read_mesh(tmp_path / "a.stl").triangles) == len(tube().triangles)
    (tmp_path / "a.stl").write_bytes(data + bytes(50))
    with pytest.raises(AnatomyError, match="it needs"):
        reading.read_mesh(tmp_path / "a.stl")


def nrrd(line: bytes, sizes: bytes = b"2 2 2") -> bytes:
    return b"NRRD0004\ntype: uchar\ndimension: 3\nsizes: " + sizes + b"\nencoding: raw\n" + line + b"\n\n" + bytes(8)


def polygon(corner: int) -> bytes:
    return f"""<VTKFile type="PolyData" version="0.1"><PolyData><Piece NumberOfPoints="3" NumberOfPolys="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Polys><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 {corner}</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Polys></Piece></PolyData></VTKFile>""".encode()


def nifti(shape=(8, 8, 8), voxels: bytes | None = None, first: int = 348, offset: float = 352.0) -> bytes:
    head = bytearray(352)
    struct.pack_into("<i", head, 0, first)
    struct.pack_into("<8h", head, 40, 3, *shape, 1, 1, 1, 1)
    struct.pack_into("<2h", head, 70, 2, 8)
    struct.pack_into("<8f", head, 76, 1.0, 0.5, 0.5, 0.5, 0.0, 0.0, 0.0, 0.0)
    struct.pack_into("<f", head, 108, offset)
    head[344:348] = b"n+1\0"
    return bytes(head) + (voxels if voxels is not None else bytes(int(np.prod(shape))))


BINARY = b"\0" * 80 + struct.pack("<I", 4) + b"\0" * 90
BAD = {
    "a.txt": (b"", "the name has to end in one of"),
    "a.stl": (b"", "empty"),
    "b.stl": (BINARY, "of 4 triangles it needs 284 bytes and has 174"),
    "c.stl": (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "ends inside a facet"),
    "d.stl": (b"solid words and nothing else, for a hundred characters or so, that no reader of meshes can use at all",
              "has no triangles"),
    "e.stl": (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
              b"endfacet\nendsolid a\n", "line 4"),
    "a.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4 'f 1 2 9' needs vertices from 1 to 3"),
    "b.obj": (b"v 0 0\n", "line 1"),
    "c.obj": (b"hello\n", "line 1 'hello' needs an OBJ word"),
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
    "e.csv": (b"0,0,0,1\n0,0,1,inf\n", "point 2: three numbers"),
    "f.csv": (b"0,0,0,1\n0,0,1e300,1\n", "point 2: a number is beyond 1e+09"),
    "g.csv": (b"0,0,0,1\n0,0,1,1e300\n", "point 2: a number is beyond 1e+09"),
    "a.mrk.json": (b"{}", "not a curve of 3D Slicer"),
    "b.mrk.json": (b"[" * 100_000, "not a curve of 3D Slicer"),
    "c.mrk.json": (b'{"markups": [{"controlPoints": [{"position": [1' + b"0" * 400 + b', 0, 0]}]}]}', "not a curve"),
    "b.nrrd": (nrrd(b"line skip: x"), "line skip 'x'"),
    "c.nrrd": (nrrd(b"byte skip: y"), "byte skip 'y'"),
    "d.nrrd": (nrrd(b"line skip: 99999999999"), "fewer lines than its line skip"),
    "e.nrrd": (nrrd(b"", b"-2 -2 2"), "-2 x -2 x 2 voxels"),
    "f.nrrd": (nrrd(b"space directions: (1e300,0,0) (0,1,0) (0,0,1)"), "beyond 1e+09 mm"),
    "g.nrrd": (nrrd(b"space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,-1e300,0)"), "beyond 1e+09 mm"),
    "e.nii": (nifti(offset=float("nan")), "byte nan"),
    "f.nii": (nifti(offset=float("inf")), "byte inf"),
    "c.vtp": (polygon(99999), "point 99999: there are 3 points"),
    "d.vtp": (polygon(-7), "point -7: there are 3 points"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_file_is_one_line(tmp_path: Path, name: str, capfd: pytest.CaptureFixture) -> None:
    content, expected = BAD[name]
    file = tmp_path / name
    file.write_bytes(content)
    with pytest.raises(AnatomyError) as error:
        reading.read(file)
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
        line = read_lines(file, reading.kind_of(file)).lines[0]
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
        reading.read(lines_of_vtp(tmp_path / "a.vtp", points, radii))


def test_points_there_twice_are_left_out_of_the_lines_of_a_vtp(tmp_path: Path) -> None:
    file = lines_of_vtp(tmp_path / "a.vtp", "0 0 0 0 0 0 0 0 2", "1 1 1.5")
    line = lines_of_poly_data(file, read_by_vtk(file, ".vtp")).lines[0]
    np.testing.assert_array_equal(line.points, [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]])
    np.testing.assert_array_equal(line.radii, [1.0, 1.5])


def test_voxels_of_a_nifti_lie_where_its_header_says(tmp_path: Path) -> None:
    voxels = np.zeros((8, 8, 8), dtype=np.uint8)
    voxels[1, 2, 5] = 1
    file = tmp_path / "a.nii"
    file.write_bytes(nifti(voxels=voxels.ravel(order="F").tobytes()))
    image = read_image(file, ".nii")
    assert image.values.shape == (8, 8, 8) and image.values[1, 2, 5] == 1
    place = image.to_space @ [1.0, 2.0, 5.0, 1.0]
    np.testing.assert_allclose(place[:3], [0.5, 1.0, 2.5], atol=1e-6)


def test_a_nifti_in_metres_is_read_in_mm(tmp_path: Path) -> None:
    content = bytearray(nifti(voxels=bytes(512)))
    (tmp_path / "mm.nii").write_bytes(bytes(content))
    content[123] = 1
    (tmp_path / "m.nii").write_bytes(bytes(content))
    millimetres, metres = (read_image(tmp_path / name, ".nii").to_space for name in ("mm.nii", "m.nii"))
    np.testing.assert_allclose(metres[:3], 1e3 * millimetres[:3], rtol=1e-12)


@pytest.mark.parametrize("space, signs", [
    ("left-posterior-superior", [1, 1, 1]), ("RAS", [-1, -1, 1]), ("left-anterior-superior", [1, -1, 1]),
    ("RPI", [-1, 1, -1]), ("RPS", [-1, 1, 1]), ("scanner-xyz", [1, 1, 1]), ("3D-right-handed", [1, 1, 1])])
def test_an_nrrd_is_turned_to_lps_and_lines_may_end_as_in_windows(tmp_path: Path, space, signs) -> None:
    head = (f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: 12 12 12\nencoding: gzip\nspace: {space}\n"
            "space directions: (0.5,0,0) (0,0.6,0) (0,0,0.7)\nspace origin: (1,2,3)\n\n")
    for name, text in (("a.nrrd", head), ("b.nrrd", head.replace("\n", "\r\n"))):
        (tmp_path / name).write_bytes(text.encode() + gzip.compress(bytes(12**3)))
        image = read_image(tmp_path / name, ".nrrd")
        expected = np.c_[np.diag([0.5, 0.6, 0.7]), [1.0, 2.0, 3.0]] * np.array(signs)[:, None]
        np.testing.assert_allclose(image.to_space[:3], expected, atol=1e-12)
        assert image.axes.is_known == (space[0] != "s" and space[0] != "3")


def test_a_mirrored_space_without_axes_is_refused_unless_they_are_given(tmp_path: Path) -> None:
    head = ("NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nspace: 3D-left-handed\n"
            "space directions: (1,0,0) (0,1,0) (0,0,1)\n\n")
    (tmp_path / "a.nrrd").write_bytes(head.encode() + bytes(8))
    with pytest.raises(AnatomyError, match="give --axes"):
        read_image(tmp_path / "a.nrrd", ".nrrd")
    assert read_image(tmp_path / "a.nrrd", ".nrrd", axes_named("LAS")).to_space[1, 1] == -1.0


LETTERS = [a + b + c for order in itertools.permutations(("LR", "PA", "SI")) for a in order[0] for b in order[1]
           for c in order[2]]
TOWARDS = {"L": (0, 1.0), "R": (0, -1.0), "P": (1, 1.0), "A": (1, -1.0), "S": (2, 1.0), "I": (2, -1.0)}


@pytest.mark.parametrize("letters", LETTERS)
def test_voxels_of_all_48_orientations_lie_in_one_place_of_the_patient(tmp_path: Path, letters: str) -> None:
    """The same box of numbers stored along other axes, as NRRD in LPS and in axes of its own, and as NIfTI."""
    sizes, steps, origin = (4, 5, 6), np.array([0.5, 0.6, 0.7]), np.array([3.0, -2.0, 1.0])    # along L, P, S
    patient = np.arange(120.0).reshape(sizes).astype(np.uint8)
    axes = [TOWARDS[letter] for letter in letters]
    stored = patient.transpose([axis for axis, _ in axes])[tuple(slice(None, None, int(s)) for _, s in axes)]
    columns = np.zeros((3, 3))
    first = origin.copy()
    for k, (axis, sign) in enumerate(axes):
        columns[axis, k] = sign * steps[axis]
        first[axis] += 0.0 if sign > 0.0 else steps[axis] * (sizes[axis] - 1)
    voxels = stored.ravel(order="F").tobytes()
    words = [{"L": "left", "R": "right", "P": "posterior", "A": "anterior", "S": "superior", "I": "inferior"}[one]
             for one in letters]
    own = np.array([[s * float(axis == row) for row in range(3)] for axis, s in axes])    # from LPS to the letters
    for name, space, matrix, corner in (("lps", "left-posterior-superior", columns, first),
                                        ("own", "-".join(words), own @ columns, own @ first)):
        rows = " ".join("(" + ",".join(f"{v:.17g}" for v in matrix[:, k]) + ")" for k in range(3))
        (tmp_path / f"{name}.nrrd").write_bytes(
            f"NRRD0004\ntype: uchar\ndimension: 3\nsizes: {' '.join(map(str, stored.shape))}\nencoding: raw\n"
            f"space: {space}\nspace directions: {rows}\nspace origin: ({','.join(f'{v:.17g}' for v in corner)})\n\n"
            .encode() + voxels)
    head = bytearray(nifti(stored.shape, voxels))
    struct.pack_into("<2h", head, 252, 0, 1)
    struct.pack_into("<12f", head, 280, *(np.diag([-1.0, -1.0, 1.0]) @ np.c_[columns, first]).ravel())
    (tmp_path / "a.nii").write_bytes(bytes(head))
    for file, kind in (("lps.nrrd", ".nrrd"), ("own.nrrd", ".nrrd"), ("a.nii", ".nii")):
        image = read_image(tmp_path / file, kind)
        assert image.axes.is_known
        for index in np.ndindex(*stored.shape):
            place = image.to_space @ [*index, 1.0]
            of_patient = np.rint((place[:3] - origin) / steps).astype(int)
            assert np.abs(origin + steps * of_patient - place[:3]).max() < 1e-5
            assert image.values[index] == patient[tuple(of_patient)]


def test_a_nifti_with_a_quaternion_lies_where_vtk_has_it(tmp_path: Path) -> None:
    from vtkmodules.vtkIOImage import vtkNIFTIImageReader

    head = bytearray(nifti((4, 5, 6)))
    struct.pack_into("<8f", head, 76, -1.0, 0.5, 0.6, 0.7, 0.0, 0.0, 0.0, 0.0)
    struct.pack_into("<2h", head, 252, 1, 0)
    struct.pack_into("<6f", head, 256, 0.3, -0.4, 0.5, 7.0, 8.0, 9.0)
    (tmp_path / "a.nii").write_bytes(bytes(head))
    reader = vtkNIFTIImageReader()
    reader.SetFileName(str(tmp_path / "a.nii"))
    reader.Update()
    matrix = reader.GetQFormMatrix()
    ras = np.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    spacing = np.diag([*reader.GetOutput().GetSpacing(), 1.0])
    origin = np.eye(4)
    origin[:3, 3] = reader.GetOutput().GetOrigin()
    expected = np.diag([-1.0, -1.0, 1.0, 1.0]) @ ras @ origin @ spacing
    # VTK turns the third axis of a mirrored file by reordering its slices: the box of all voxels is the same.
    ours = read_image(tmp_path / "a.nii", ".nii").to_space
    corners = np.array([[*index, 1.0] for index in itertools.product((0, 3), (0, 4), (0, 5))])
    one, other = (np.sort((corners @ to_space.T)[:, :3].round(4), axis=0) for to_space in (ours, expected))
    np.testing.assert_allclose(one, other, atol=2e-4)


def test_values_are_what_slope_intercept_byte_order_and_encoding_make_of_them(tmp_path: Path) -> None:
    numbers = np.arange(-30, 34, dtype=np.int16).reshape(4, 4, 4)
    for order in "<>":
        head = bytearray(nifti((4, 4, 4), numbers.astype(order + "i2").ravel(order="F").tobytes()))
        if order == ">":
            for at, form in ((0, "i"), (40, "8h"), (76, "8f"), (108, "f")):
                struct.pack_into(">" + form, head, at, *struct.unpack_from("<" + form, head, at))
        struct.pack_into(order + "2h", head, 70, 4, 16)
        struct.pack_into(order + "2f", head, 112, 0.5, -7.0)
        (tmp_path / "a.nii").write_bytes(bytes(head))
        np.testing.assert_array_equal(read_image(tmp_path / "a.nii", ".nii").values, 0.5 * numbers - 7.0)
    base = "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 4 4\nspace: LPS\n" \
           "space directions: (1, 0, 0) (0, 1, 0) (0,0,1)\n"
    flat = numbers.ravel(order="F")
    for endian, order in (("little", "<"), ("big", ">")):
        raw = flat.astype(order + "i2").tobytes()
        for encoding, data in (("raw", raw), ("gzip", gzip.compress(raw)), ("bzip2", bz2.compress(raw)),
                               ("hex", raw.hex().encode()), ("ascii", " ".join(map(str, flat)).encode())):
            (tmp_path / "a.nrrd").write_bytes(f"{base}endian: {endian}\nencoding: {encoding}\n\n".encode() + data)
            np.testing.assert_array_equal(read_image(tmp_path / "a.nrrd", ".nrrd").values, numbers)


def test_binary_stl_is_read(tmp_path: Path) -> None:
    assert len(reading.read_mesh(write_stl(tmp_path / "a.stl", tube())).triangles) == len(tube().triangles)


@pytest.mark.parametrize("system, sign", [("LPS", 1.0), ("RAS", -1.0)])
def test_a_curve_of_slicer_is_in_the_system_that_it_names(tmp_path: Path, system: str, sign: float) -> None:
    points = ", ".join(f'{{"position": [{sign * k}, {sign * 2}, 3]}}' for k in range(4))
    (tmp_path / "a.mrk.json").write_text(
        f'{{"markups": [{{"coordinateSystem": "{system}", "coordinateUnits": "mm", "controlPoints": [{points}], '
        '"measurements": [{"name": "Radius", "controlPointValues": [2, 2, 2, 2]}]}]}')
    source = reading.read(tmp_path / "a.mrk.json")
    assert source.axes.letters == system and source.unit == "mm"
    middle = 0.5 * (source.mesh.vertices.min(axis=0) + source.mesh.vertices.max(axis=0))
    np.testing.assert_allclose(middle[1:], [2.0, 3.0], atol=0.05)
    assert source.mesh.vertices[:, 0].max() > 2.9 and source.mesh.vertices[:, 0].min() > -0.2
