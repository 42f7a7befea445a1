"""A vessel in the page: what its bytes hold, and in a browser the click that makes an end the inlet."""

import json

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="no VTK: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.tests.solids import tube, write_stl  # noqa: E402
from guidewire.prepare import PreparationError  # noqa: E402
from guidewire.viewer.anatomy import read_vessel  # noqa: E402
from guidewire.viewer.tests.browsing import DRAWN  # noqa: E402
from guidewire.viewer.tests.test_view import serving  # noqa: E402


@pytest.fixture
def with_a_hole(tmp_path):
    """A tube of 3 mm radius with two ends, and a triangle missing in its side."""
    mesh = tube()
    kept = np.ones(len(mesh.triangles), dtype=bool)
    kept[len(kept) // 4] = False
    return write_stl(tmp_path / "tube.stl", mesh.part(kept))


def test_a_vessel_in_bytes_has_wall_ends_and_bad_places(with_a_hole):
    data = read_vessel(with_a_hole).to_bytes()
    length = int(np.frombuffer(data, "<u4", 1)[0])
    header = json.loads(data[4:4 + length])
    vertices = np.frombuffer(data, "<f4", header["vertices"], 4 + length).reshape(-1, 3)
    triangles = np.frombuffer(data, "<u4", offset=4 + length + vertices.nbytes).reshape(-1, 3)
    expected = tube().vertices
    assert len(triangles) == len(tube().triangles) - 1 and triangles.max() < len(vertices)
    assert np.allclose(np.sort(vertices[np.unique(triangles)], axis=0), np.sort(expected, axis=0), atol=1e-4)
    centres = np.array([end["centre"] for end in header["ends"]])
    middles = expected.reshape(-1, 24, 3).mean(axis=1)
    assert np.abs(centres[:, None] - middles[[0, -1]]).sum(axis=2).min(axis=1).max() < 0.3
    assert [(kind["name"], len(kind["points"])) for kind in header["places"]] == [("holes in the side", 3)]
    hole = tube().corners[len(tube().triangles) // 4].mean(axis=0)
    assert np.linalg.norm(header["places"][0]["points"] - hole) < 0.5


def test_an_end_that_is_not_there_writes_nothing(with_a_hole, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert read_vessel(with_a_hole).choose(7) == "there is no end 7"
    assert not (tmp_path / "results").exists()
    (tmp_path / "text.stl").write_text("no mesh")
    with pytest.raises(PreparationError, match="text.stl"):
        read_vessel(tmp_path / "text.stl")


@pytest.mark.long("an inlet by its number stands in the tests of the command")
def test_a_click_on_an_end_makes_it_the_inlet(browse, with_a_hole, tmp_path):
    click = """(() => {
      const [clientX, clientY] = viewer.placeOf(2);
      const canvas = document.getElementById("picture");
      for (const kind of ["pointerdown", "pointerup"]) {
        canvas.dispatchEvent(new PointerEvent(kind, { clientX, clientY, bubbles: true, pointerId: 1 }));
      }
    })()"""
    with serving(tmp_path, str(with_a_hole), with_three=True) as (address, _):
        seen = browse(["open", address], DRAWN, ["see", "document.getElementById('ends').childElementCount"],
                      ["see", click], ["until", "document.getElementById('said').textContent !== ''"],
                      ["see", "document.getElementById('said').textContent"],
                      ["see", "document.querySelector('#ends [aria-pressed=true]').textContent"],
                      ["see", "document.getElementById('places').textContent"])["seen"]
    assert seen[0] == 2 and seen[2].startswith("inlet: end 2 'rim 2', target: end 1") and seen[3] == "2 rim 2"
    assert seen[4] == "holes in the side1"
    scene = json.loads((tmp_path / "results" / "anatomy" / "tube" / "scene.json").read_text())
    assert scene["inlet"] == 2 and scene["target"] == 1
