"""The first lines of a report, the picture of what is taken, and the files of a centreline."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.centreline_files import branches_of, centreline_names, write_centreline  # noqa: E402
from guidewire.anatomy.images import Image  # noqa: E402
from guidewire.anatomy.inspection import Unit, inspect  # noqa: E402
from guidewire.anatomy.lines import lines_of_poly_data, read_lines, tree_of  # noqa: E402
from guidewire.anatomy.masks import Taking, mesh_of_image  # noqa: E402
from guidewire.anatomy.mesh import Mesh  # noqa: E402
from guidewire.anatomy.output import describe  # noqa: E402
from guidewire.anatomy.patient import Axes  # noqa: E402
from guidewire.anatomy.reading import Source, stated_axes  # noqa: E402
from guidewire.anatomy.repair import Change, Repaired  # noqa: E402
from guidewire.anatomy.summary import Choice, summarise  # noqa: E402
from guidewire.anatomy.taken_picture import draw_taken  # noqa: E402
from guidewire.anatomy.tests.solids import tube  # noqa: E402
from guidewire.anatomy.tests.test_output import fork  # noqa: E402
from guidewire.anatomy.vtk_files import read_by_vtk  # noqa: E402

MM = Unit("mm", "as given", True)


def test_the_first_lines_say_what_a_reader_has_to_know_and_are_at_most_eighteen() -> None:
    mesh = tube()
    line = fork(*[(50 + k, 2.0) for k in range(11)])
    source = Source(mesh, "mm", "as given", Axes("RAS"), left_out=[f"region {k}" for k in range(5)])
    changes = [*(Change(f"things {k}", k + 1, 0.01) for k in range(6)),
               Change("stray bodies removed", 2, leaves_out=True)]
    lines = summarise(source, inspect(mesh, "mm"), Repaired(mesh, [], changes), line,
                      Choice(line.ends[0], line.ends[3], is_target_given=True))
    assert len(lines) <= 18 and all("\n" not in one for one in lines)
    text = "\n".join(lines)
    for expected in ("axes of the patient: LPS; those of the file are RAS", "unit: mm (as given;",
                     "end 1 'rim 1': open, ", "ends 7 to 12: below", "inlet: end 1 (the widest; --inlet",
                     "target: end 4 (as given; ",
                     "mended: things 0: 1", "mended: 4 more, below; the wall moved by 0.06 mm", "left out: region 1",
                     "left out: 4 more, below"):
        assert expected in text, expected
    clean = summarise(Source(mesh, "mm", "as given"), inspect(mesh, "mm"), Repaired(mesh, [], []), line)
    assert clean[-2:] == ["mended: nothing", "left out: nothing"] and "unknown" in clean[0]


def test_vertices_that_are_nearly_one_are_told() -> None:
    mesh = tube()
    apart = Mesh(mesh.corners.reshape(-1, 3) + 1e-5 * np.arange(3 * len(mesh.triangles))[:, None] % 3e-5,
                 np.arange(3 * len(mesh.triangles)).reshape(-1, 3))
    found = inspect(apart, "mm")
    assert found.near_vertices and any(f"{found.near_vertices} vertices nearer than" in one and " mm to another" in one
                                       for one in describe(found, None, None, 0.36))


def test_the_picture_has_what_is_taken_what_is_left_out_the_box_and_the_seed() -> None:
    values = np.zeros((12, 10, 14))
    values[2:5, 2:5, 2:12], values[7:10, 7:9, 2:12] = 300.0, 900.0
    image = Image(values, np.diag([0.5, 0.6, 0.7, 1.0]), Axes("LPS"))
    taking = Taking(threshold=200.0, seed=np.array([1.5, 1.8, 4.2]), box=np.array([[0.0, 0.0, 0.0], [4.1, 9.0, 9.0]]))
    taken = mesh_of_image(image, taking)
    assert taken.left_out[0] == "20 voxels outside of --box"    # those of x = 4.5 in the second block
    figure = draw_taken(image, taken, taking, "scan")
    panels = figure.axes
    assert len(panels) == 6 and "orange is taken (90 voxels)" in figure._suptitle.get_text()
    assert "[1.5, 1.8, 4.2]" in figure._suptitle.get_text()
    assert panels[2].get_xlabel() == "mm towards the left" and panels[0].get_ylabel() == "mm towards the head"
    seeds = [line for line in panels[3].lines if line.get_marker() == "+"]
    np.testing.assert_allclose(np.ravel(seeds[0].get_data()), [1.8, 4.2])
    assert all(len(panel.lines) == 13 for panel in panels)    # twelve edges and the seed
    drawn = [panel.collections for panel in panels]
    assert all(len(own) >= (2 if k > 2 else 1) for k, own in enumerate(drawn))


@pytest.mark.parametrize("axes", ["LPS", ""])
def test_a_centreline_is_read_back_as_the_tree_that_it_was(tmp_path: Path, axes: str) -> None:
    line = fork((60, 2.0), (40, 1.5))
    (tmp_path / "centreline.mrk.json").write_text("of the vessel before")
    write_centreline(tmp_path, line, Unit("cm", "as given", True), Axes(axes))
    assert sorted(file.name for file in tmp_path.iterdir()) == sorted(centreline_names(Axes(axes)))
    assert [len(branch) for branch in branches_of(line)] == [101, 61, 41]    # each from the point that it leaves
    data = read_by_vtk(tmp_path / "centreline.vtp", ".vtp")
    tubes, same = tree_of(lines_of_poly_data(tmp_path / "centreline.vtp", data).lines)
    assert stated_axes(tmp_path / "centreline.vtp", data).letters == axes and len(tubes) == 3 and same == 0
    if not axes:
        return
    found = read_lines(tmp_path / "centreline.mrk.json", ".mrk.json")
    assert found.axes.letters == "LPS" and found.unit == "mm"
    for seen, branch in zip(found.lines, branches_of(line)):
        np.testing.assert_allclose(seen.points, 10.0 * line.points[branch], atol=1e-6)
        np.testing.assert_allclose(seen.radii, 10.0 * line.radii[branch], atol=1e-6)
    written = json.loads((tmp_path / "centreline.mrk.json").read_text())
    assert written["@schema"].endswith("markups-schema-v1.0.3.json#")
