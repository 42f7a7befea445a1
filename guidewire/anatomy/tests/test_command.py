"""The command, from a file to what it writes; the example of docs/anatomy.md among them."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.tests.solids import tube, write_stl  # noqa: E402
from guidewire.commands.commands import parse, run  # noqa: E402
from guidewire.prepare import ROOT, PreparationError  # noqa: E402
from tools.testing import FULL_CAMPAIGNS  # noqa: E402

PAGE = (ROOT / "docs" / "anatomy.md").read_text(encoding="utf-8")


def anatomy(words: str) -> int:
    return run(parse(["anatomy", *shlex.split(words)]))


def test_the_example_of_the_page_gives_a_fork_with_three_ends(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    script = re.search(r"```python\n(.*?)```", PAGE, re.DOTALL)[1]
    if FULL_CAMPAIGNS not in os.environ:    # half of each branch: fewer points among which the centreline is found
        for whole, half in (("0, 0, 5]", "0, 0, 14]"), ("11, 0, 60", "5.5, 0, 46"), ("-10, 4, 58", "-5, 2, 45")):
            assert whole in script
            script = script.replace(whole, half)
    subprocess.run([sys.executable, "-c", script], check=True)
    voxels = (tmp_path / "fork.nrrd").read_bytes().split(b"\n\n", 1)[1].count(1)
    line = re.search(r"guidewire.py (anatomy fork.*)", PAGE)[1]
    assert run(parse(shlex.split(line))) == 0
    folder = tmp_path / "results" / "anatomy" / "fork"
    found = json.loads((folder / "anatomy.json").read_text())
    assert found["unit"] == "mm" and [end["open"] for end in found["ends"]] == [True] * 3
    # The script's radii; voxels of 0.6 mm.
    assert [end["radius"] for end in found["ends"]] == pytest.approx([2.5, 2.1, 1.8], rel=0.03)
    points = np.array(found["centreline"]["points"])
    trunk = points[(points[:, 2] > 8.0) & (points[:, 2] < 25.0)]
    # The inscribed sphere meets the deepest place of a wall that is rough by a third of a voxel at most.
    assert np.hypot(trunk[:, 0], trunk[:, 1]).max() < 0.2 and np.abs(trunk[:, 3] - 2.5).max() < 0.2
    scene = json.loads((folder / "scene.json").read_text())
    assert scene["inlet"] == 1 and scene["target"] == 2
    assert (folder / "picture.png").stat().st_size > 10_000
    report = (folder / "report.md").read_text()
    assert f"{voxels} voxels" in report and "end 3 'rim 3': open" in report and "closed ends cut open" in report


def test_look_writes_no_vessel(tmp_path: Path) -> None:
    file = write_stl(tmp_path / "a.stl", tube())
    assert anatomy(f"{file} --look --out {tmp_path / 'out'}") == 0
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["picture.png", "report.md"]


@pytest.mark.parametrize("words, expected", [
    ("{file} --unit mm --inlet 9", "there is no end '9': there are 1 'rim 1', 2 'rim 2'"),
    ("none.stl", "none.stl: no such file"),
    ("--make arch --type 5", "arches are of type 1, 2 or 3"),
])
def test_wrong_words_are_one_line_and_nothing_is_written(tmp_path: Path, words: str, expected: str) -> None:
    file = write_stl(tmp_path / "a.stl", tube())
    with pytest.raises(PreparationError, match=expected) as error:
        anatomy(f"{words.format(file=file)} --out {tmp_path / 'out'}")
    assert "\n" not in str(error.value)
    assert not (tmp_path / "out").exists()


@pytest.mark.long("lines become tubes in the tests of lines")
def test_a_centreline_alone_becomes_a_tube(tmp_path: Path) -> None:
    z = np.linspace(0.0, 30.0, 7)
    rows = [f"{5.0 * np.sin(a / 20.0)},{a},{0.1 * a},{2.0 + 0.01 * a}" for a in z]
    (tmp_path / "a.csv").write_text("x,y,z,radius\n" + "\n".join(rows) + "\n")
    assert anatomy(f"{tmp_path / 'a.csv'} --unit mm --out {tmp_path / 'out'}") == 0
    found = json.loads((tmp_path / "out" / "anatomy.json").read_text())
    assert [end["radius"] for end in found["ends"]] == pytest.approx([2.3, 2.0], rel=0.02)


def test_a_name_ends_at_its_known_ending_and_a_folder_keeps_its_own_vessel(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, radius in (("p1", 3.0), ("p2", 2.5)):
        (tmp_path / name).mkdir()
        write_stl(tmp_path / name / "a.b.stl", tube(radius))
    assert anatomy("p1/a.b.stl --unit mm") == 0
    written = (tmp_path / "results" / "anatomy" / "a.b" / "vessel.obj").read_bytes()
    with pytest.raises(PreparationError, match="holds the vessel of another a.b.stl: --force replaces it"):
        anatomy("p2/a.b.stl --unit mm")
    assert (tmp_path / "results" / "anatomy" / "a.b" / "vessel.obj").read_bytes() == written
    assert anatomy("p2/a.b.stl --unit mm --force") == 0
    assert (tmp_path / "results" / "anatomy" / "a.b" / "vessel.obj").read_bytes() != written


@pytest.mark.long("all orientations stand in the tests of readers")
def test_axes_that_are_given_turn_the_vessel_and_lead_back(tmp_path: Path) -> None:
    file = write_stl(tmp_path / "a.stl", tube())
    for axes in ("LPS", "RAS", "SLA"):
        assert anatomy(f"{file} --unit mm --axes {axes} --out {tmp_path / axes}") == 0
    found = {axes: json.loads((tmp_path / axes / "anatomy.json").read_text()) for axes in ("LPS", "RAS", "SLA")}
    for axes, one in found.items():
        assert one["patientAxes"] == "LPS" and one["sourceAxes"] == axes
        assert json.loads((tmp_path / axes / "scene.json").read_text())["patientAxes"] == "LPS"
        back = np.array([end["centre"] for end in one["ends"]]) @ np.array(one["toSource"]).T
        np.testing.assert_allclose(np.sort(back, axis=0),
                                   np.sort([end["centre"] for end in found["LPS"]["ends"]], axis=0), atol=2e-3)
    with pytest.raises(PreparationError, match="three letters that say where x, y and z point"):
        anatomy(f"{file} --unit mm --axes LRS --out {tmp_path / 'no'}")


@pytest.mark.long("units are asked for in the tests of repair")
def test_a_unit_that_is_not_certain_is_asked_for(tmp_path: Path) -> None:
    file = write_stl(tmp_path / "a.stl", tube(1.2, 20.0, rings=60))
    with pytest.raises(PreparationError, match="not certain from the sizes: give --unit mm, .* or --unit cm"):
        anatomy(f"{file} --out {tmp_path / 'out'}")
    assert not (tmp_path / "out").exists()
    assert anatomy(f"{file} --unit mm --out {tmp_path / 'out'}") == 0


def test_a_catheter_begins_behind_its_wire(tmp_path: Path) -> None:
    file = write_stl(tmp_path / "a.stl", tube())
    names = "--instrument radifocus-angled-0.035 --catheter catheter-angled-5f"
    assert anatomy(f"{file} --unit mm {names} --out {tmp_path / 'out'}") == 0
    scene = json.loads((tmp_path / "out" / "scene.json").read_text())
    catheter = scene["catheters"][0]
    assert scene["guidewireLength"] - catheter["start"] - catheter["length"] == 30.0
    with pytest.raises(PreparationError, match="there is no instrument 'none': there are amplatz-0.035"):
        anatomy(f"{file} --unit mm --instrument none --out {tmp_path / 'no'}")
