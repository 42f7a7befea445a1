"""Centrelines: columns by their headings, leaps, and several lines as the tree that they are."""

from __future__ import annotations

import locale
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.centreline import find_centreline  # noqa: E402
from guidewire.anatomy.lines import (  # noqa: E402
    Line, begin_of, lines_of_poly_data, mesh_of_lines, read_lines, tree_of,
)
from guidewire.anatomy.mesh import AnatomyError, Edges, find_rims  # noqa: E402
from guidewire.anatomy.output import find_inlet  # noqa: E402

# x, y, z, radius and a number that is none of them, of a straight line.
ROWS = [(10.0 + k, 20.0, 30.0, 2.0, float(k)) for k in range(41)]


@pytest.mark.parametrize(("heading", "order", "letters", "factor"), [
    ("x,y,z,Abscissas,MaximumInscribedSphereRadius", (0, 1, 2, 4, 3), "", 1.0),
    ("MaximumInscribedSphereRadius,Points:0,Points:1,Points:2", (3, 0, 1, 2), "", 1.0),
    ("Distance,Diameter,R,A,S", (4, 3, 0, 1, 2), "RAS", 0.5),
    ("radius,S,P,L", (3, 2, 1, 0), "LPS", 1.0),
    (",X,Y,Z,Radius (mm)", (4, 0, 1, 2, 3), "", 1.0),
    ("x,y,z,r", (0, 1, 2, 3), "", 1.0),
])
@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_columns_are_taken_by_their_headings(tmp_path: Path, heading, order, letters, factor, separator) -> None:
    file = tmp_path / "a.csv"
    file.write_text("\n".join([heading.replace(",", separator),
                               *(separator.join(f"{row[k]:g}" for k in order) for row in ROWS)]) + "\n")
    found = read_lines(file, ".csv")
    np.testing.assert_allclose(found.lines[0].points, np.array(ROWS)[:, :3])
    np.testing.assert_allclose(found.lines[0].radii, factor * 2.0)
    assert found.axes.letters == letters


@pytest.mark.parametrize(("heading", "expected"), [
    ("a,b,c,d", "line 1 has no column x: needed are x, y, z, radius"),
    ("x,y,z,width", "line 1 has no column radius"),
    ("x,y,x,radius", "the headings 'x' and 'x' are the same coordinate"),
    ("l,A,z,radius", "name axes of the patient and others"),
])
def test_other_headings_are_refused(tmp_path: Path, heading, expected) -> None:
    (tmp_path / "a.csv").write_text(heading + "\n1,2,3,1\n1,2,4,1\n")
    with pytest.raises(AnatomyError, match=expected):
        read_lines(tmp_path / "a.csv", ".csv")


def test_more_columns_without_headings_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("1,2,3,0,1\n1,2,4,1,1\n")
    with pytest.raises(AnatomyError, match="5 columns without headings"):
        read_lines(tmp_path / "a.csv", ".csv")


def test_a_leap_is_named(tmp_path: Path) -> None:
    rows = [*ROWS[1:], ROWS[0]]
    (tmp_path / "a.csv").write_text("x,y,z,radius\n" + "\n".join(",".join(map(str, row[:4])) for row in rows) + "\n")
    with pytest.raises(AnatomyError, match="from point 40 to 41 it is 40, 40 times the median step"):
        read_lines(tmp_path / "a.csv", ".csv")


def test_steps_are_uneven_up_to_what_both_radii_reach(tmp_path: Path) -> None:
    z = np.r_[np.arange(0.0, 10.0, 0.05), np.arange(10.0, 60.0, 2.3)]
    for gap, is_leap in ((0.0, False), (11.0, True)):
        rows = [f"0,0,{one + gap * (one > 30.0)},5" for one in z]
        (tmp_path / "a.csv").write_text("x,y,z,radius\n" + "\n".join(rows) + "\n")
        if is_leap:
            with pytest.raises(AnatomyError, match="beyond the radii there"):
                read_lines(tmp_path / "a.csv", ".csv")
        else:
            assert len(read_lines(tmp_path / "a.csv", ".csv").lines[0].points) == len(z)


@pytest.mark.parametrize("name, factor", [("Radius", 1.0), ("MaximumInscribedSphereRadius", 1.0), ("Diameter", 2.0)])
def test_segments_of_a_network_are_lines_from_fork_to_fork(tmp_path: Path, name: str, factor: float) -> None:
    """A Y of three arms of ten segments, every segment a cell, as a network has them, in XML and in VTK's own form."""
    from vtkmodules.vtkIOLegacy import vtkPolyDataWriter

    from guidewire.anatomy.reading import read
    from guidewire.anatomy.vtk_files import kept_locale, read_by_vtk
    from guidewire.anatomy.vtp import write_vtp

    arms = np.array([[0.0, 0.0, -1.0], [0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]])
    points = np.concatenate([[[0.0, 0.0, 0.0]], *(np.arange(1, 11)[:, None] * arm for arm in arms)])
    cells = [np.array([10 * arm + k if k else 0, 10 * arm + k + 1]) for arm in range(3) for k in range(10)]
    write_vtp(tmp_path / "a.vtp", points, cells, at_points={name: np.full(len(points), factor * 1.5)})
    data = read_by_vtk(tmp_path / "a.vtp", ".vtp")
    found = lines_of_poly_data(tmp_path / "a.vtp", data).lines
    assert sorted(len(line.points) for line in found) == [11, 11, 11]
    assert all(line.radii == pytest.approx(1.5) for line in found)
    writer = vtkPolyDataWriter()
    writer.SetFileName(str(tmp_path / "a.vtk"))
    writer.SetInputData(data)
    with kept_locale():
        writer.Write()
    before = locale.setlocale(locale.LC_ALL)
    mesh = read(tmp_path / "a.vtk", "mm").mesh
    assert locale.setlocale(locale.LC_ALL) == before
    assert np.ptp(mesh.vertices[:, 2]) == pytest.approx(19.0, abs=1.0)
    write_vtp(tmp_path / "b.vtp", points, cells, at_points={"MISR": np.ones((len(points), 3))})
    with pytest.raises(AnatomyError, match="MISR has 3 numbers at a point"):
        lines_of_poly_data(tmp_path / "b.vtp", read_by_vtk(tmp_path / "b.vtp", ".vtp"))


def straight(start, end, radius: float = 2.0) -> Line:
    start, end = np.array(start, float), np.array(end, float)
    count = round(np.linalg.norm(end - start)) + 1
    return Line(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start), np.full(count, radius))


def joined(*lines: Line) -> Line:
    return Line(np.concatenate([line.points for line in lines]), np.concatenate([line.radii for line in lines]))


def test_lines_from_one_inlet_are_a_tree_with_the_trunk_once() -> None:
    trunk = straight([0, 0, 0], [0, 0, 20])
    lines = [joined(trunk, straight([1, 0, 21], [20, 0, 40])), joined(trunk, straight([-1, 0, 21], [-15, 0, 35]))]
    tubes, same = tree_of(lines)
    assert [tube.ends for tube in tubes] == [(True, True), (False, True)] and tubes[1].parent == 0 and same == 0
    # The second begins where it parts from the first, within a third of the radius.
    assert tubes[1].points[0][2] > 18.0 and tubes[1].points[-1].tolist() == [-15.0, 0.0, 35.0]


def test_fragments_in_any_order_and_sense_are_a_tree() -> None:
    lines = [straight([12, 0, 40], [0, 0, 21]), straight([0, 0, 0], [0, 0, 20.5]), straight([-12, 0, 40], [0, 0, 21]),
             straight([0, 0, 5], [0, 0, 9])]
    tubes, same = tree_of(lines)
    assert same == 1
    outer = sorted(tuple(point) for tube in tubes for point, is_open in zip(tube.points[[0, -1]], tube.ends) if is_open)
    assert outer == [(-12.0, 0.0, 40.0), (0.0, 0.0, 0.0), (12.0, 0.0, 40.0)]


def test_a_line_apart_from_the_others_is_refused() -> None:
    with pytest.raises(AnatomyError, match=r"line 2 of 2, from \[30, 0, 0\] on, begins 28 outside of the others"):
        tree_of([straight([0, 0, 0], [0, 0, 40]), straight([30, 0, 0], [60, 0, 0])])


def test_lines_from_one_place_have_their_inlet_there_and_fragments_have_none() -> None:
    trunk = np.column_stack([np.zeros(21), np.zeros(21), np.arange(21.0)])
    arms = [np.column_stack([0.5 * s * np.arange(1.0, 21.0), np.zeros(20), 20.0 + np.arange(1.0, 21.0)])
            for s in (1, -1)]
    whole = [Line(np.concatenate([trunk, arm]), np.full(41, 2.0)) for arm in arms]
    np.testing.assert_array_equal(begin_of(whole), [0.0, 0.0, 0.0])
    assert begin_of([whole[0], Line(whole[1].points[::-1], whole[1].radii)]) is None
    mesh, _ = mesh_of_lines(whole)
    line = find_centreline(mesh, find_rims(mesh, Edges.of(mesh)))
    assert find_inlet(line, None, begin_of(whole)).centre[2] < 1.0
