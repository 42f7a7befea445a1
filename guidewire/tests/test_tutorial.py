"""docs/tutorial.md: what a reader is to save and every command, in the page's order."""

import csv
import re
import shlex

import numpy as np
import pytest
from PIL import Image

import guidewire.viewer.command  # noqa: F401 a part of it is replaced by name
from experiments.scene_meshes import artery_lumens
from guidewire.commands import commands
from guidewire.logs.logs import read_log
from guidewire.prepare import ROOT
from guidewire.studies.study_file import read_study_file
from guidewire.viewer.tests.test_view import serving

PAGE = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")


@pytest.mark.long("each command has tests of its own")
def test_every_command_of_the_tutorial_works_in_its_order(runner_command, tmp_path, monkeypatch, capfd):
    monkeypatch.chdir(tmp_path)
    # nothing to install; the page has tests of its own
    monkeypatch.setattr("guidewire.viewer.command.three", lambda tell: {})
    (tmp_path / "params").symlink_to(ROOT / "params")
    saved = re.findall(r"[Ss]ave this as `([\w.]+)`:\n\n```\w*\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    assert [name for name, _ in saved] == ["curves.py", "turns.json", "table.py", "tube.json", "friction.json",
                                           "train.py"]
    for name, text in saved:
        (tmp_path / name).write_text(text, encoding="utf-8")
    lines = re.findall(r"^python3 guidewire\.py (.*)$", PAGE, re.MULTILINE)
    said = {}
    for line in lines:
        words = shlex.split(line)
        if words[:2] == ["python", "train.py"]:
            words[-1] = "1"    # generation: those of the page take minutes
        if words[0] == "view" and "--html" not in words:
            with serving(tmp_path, *words[1:]) as (address, _):
                said[line] = address
        else:
            code = commands.run(commands.parse(words))
            said[line], errors = capfd.readouterr()
            assert code == 0, f"{line}: {errors}"
    assert len(lines) == len(said) == 15
    for line in lines[:2]:
        assert said[line].startswith("finished: all 240 steps are done")
    for name in ("turned.png", "curves.png"):
        with Image.open(tmp_path / "results" / name) as picture:
            assert picture.size[0] > 600
    assert "data-recording" in (tmp_path / "results" / "turns.html").read_text(encoding="utf-8")
    study = read_study_file(tmp_path / "turns.json", None)
    assert study.logs and [len(axis.values) for axis in study.grid.axes] == [3, 2]
    study = read_study_file(tmp_path / "friction.json", None)
    assert [len(axis.values) for axis in study.grid.axes] == [5, 2, 2]
    assert [axis.key for axis in study.grid.axes] == ["vessel.frictionCoefficient", "vessel.radius", "bendingStiffness"]
    tips = [read_log(tmp_path / "results" / name).final_positions[-1] for name in ("one", "other")]
    depths = np.array([lumen.depth(np.array(tips)) for lumen in artery_lumens()])
    assert depths.max(axis=0).min() > 0.0 and sorted(depths.argmax(axis=0)) == [0, 1], "each tip is in another branch"
    with open(tmp_path / "results" / "turns" / "runs.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 6 and {row["outcome"] for row in rows} == {"finished"}
    assert {"twistPerStep", "wireRadius", "largestContactForce", "solver.proximalForce"} <= set(rows[0])
    assert said["python table.py"].count("N\n") == 6
