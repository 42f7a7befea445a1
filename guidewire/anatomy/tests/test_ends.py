"""Ends of vessels that are cut open."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.distance_grid import cut_open  # noqa: E402
from guidewire.anatomy.ends import open_ends, without_caps  # noqa: E402
from guidewire.anatomy.mesh import Edges, Mesh, close_rims, find_rims  # noqa: E402
from guidewire.anatomy.reading import read  # noqa: E402
from guidewire.anatomy.repair import repair  # noqa: E402
from guidewire.anatomy.surfaces import to_vtk  # noqa: E402
from guidewire.anatomy.tests.solids import SLANT, tube  # noqa: E402


def test_an_end_is_cut_straight_where_triangles_are_much_longer_than_the_lumen_is_wide() -> None:
    """A closed cylinder of radius 5 between z = 0 and 200, whose wall has no vertex between its ends."""
    around = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    ring = np.stack([5.0 * np.cos(around), 5.0 * np.sin(around), np.zeros(24)], axis=1)
    vertices = np.concatenate([ring, ring + [0.0, 0.0, 200.0], [[0.0, 0.0, 0.0], [0.0, 0.0, 200.0]]])
    triangles = []
    for k in range(24):
        after = (k + 1) % 24
        triangles += [[k, after, 24 + after], [k, 24 + after, 24 + k], [after, k, 48], [24 + k, 24 + after, 49]]
    cut = cut_open(Mesh(vertices, np.array(triangles)), np.array([0.0, 0.0, 6.0]), np.array([0.0, 0.0, 1.0]), 7.5)
    (rim,) = find_rims(cut, Edges.of(cut))
    assert rim.centre == pytest.approx([0.0, 0.0, 6.0], abs=1e-6) and cut.vertices[:, 2].min() == pytest.approx(6.0)


def capped(sides: int = 24, rings: int = 40, rise: float = 0.0) -> tuple[Mesh, np.ndarray]:
    """A tube of radius 3 and length 40 with caps, flat or raised in the middle; and the number of each triangle's face:
    1 the wall, 2 and 3 the caps."""
    wall = tube(sides=sides, rings=rings)
    closed = close_rims(wall, find_rims(wall, Edges.of(wall)))
    n = len(wall.vertices)
    place = closed.vertices @ SLANT
    closed.vertices[n:] += np.where(place[n:] > 20.0, rise, -rise)[:, None] * SLANT
    ends = np.where(closed.corners.mean(axis=1) @ SLANT > 20.0, 3, 2)
    return closed, np.where((closed.triangles >= n).any(axis=1), ends, 1)


def test_flat_caps_are_taken_off_and_nothing_else() -> None:
    mesh, _ = capped()
    wall = tube(rings=40)
    opened = open_ends(repair(mesh))
    assert ("caps taken off", 2) in [(change.name, change.count) for change in opened.changes]
    assert len(opened.rims) == 2 and len(opened.mesh.triangles) == len(wall.triangles)
    assert np.ptp(opened.mesh.vertices @ SLANT) == pytest.approx(40.0, abs=1e-9)


@pytest.mark.parametrize("rise", [0.0, 1.5])
@pytest.mark.long("flat caps are taken off by their faces alone, too")
def test_caps_are_the_faces_that_a_file_numbers_flat_or_not(tmp_path: Path, rise: float) -> None:
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    mesh, faces = capped(rise=rise)
    data = to_vtk(mesh)
    numbers = numpy_to_vtk(faces.astype(np.int32), deep=1)
    numbers.SetName("ModelFaceID")
    data.GetCellData().AddArray(numbers)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(tmp_path / "a.vtp"))
    writer.SetInputData(data)
    writer.Write()
    source = read(tmp_path / "a.vtp")
    opened = without_caps(repair(source.mesh), source.faces)
    assert ("caps taken off, faces of the file", 2) in [(change.name, change.count) for change in opened.changes]
    assert np.ptp(opened.mesh.vertices @ SLANT) == pytest.approx(40.0, abs=1e-5)
    # Without the numbers a raised cap is cut off with a piece of the vessel.
    plain = open_ends(repair(source.mesh))
    assert (np.ptp(plain.mesh.vertices @ SLANT) > 39.9) == (rise == 0.0)
