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
    ("{file} --inlet 9", "there is no end '9': there are 1 'rim 1', 2 'rim 2'"),
    ("none.stl", "none.stl: no such file"),
    ("--make arch --type 5", "arches are of type 1, 2 or 3"),
])
def test_wrong_words_are_one_line_and_nothing_is_written(tmp_path: Path, words: str, expected: str) -> None:
    file = write_stl(tmp_path / "a.stl", tube())
    with pytest.raises(PreparationError, match=expected) as error:
        anatomy(f"{words.format(file=file)} --out {tmp_path / 'out'}")
    assert "\n" not in str(error.value)
    assert not (tmp_path / "out").exists()


def test_a_centreline_alone_becomes_a_tube(tmp_path: Path) -> None:
    z = np.linspace(0.0, 30.0, 7)
    rows = [f"{5.0 * np.sin(a / 20.0)},{a},{0.1 * a},{2.0 + 0.01 * a}" for a in z]
    (tmp_path / "a.csv").write_text("x,y,z,radius\n" + "\n".join(rows) + "\n")
    assert anatomy(f"{tmp_path / 'a.csv'} --unit mm --out {tmp_path / 'out'}") == 0
    found = json.loads((tmp_path / "out" / "anatomy.json").read_text())
    assert [end["radius"] for end in found["ends"]] == pytest.approx([2.3, 2.0], rel=0.02)
