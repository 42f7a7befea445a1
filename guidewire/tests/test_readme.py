"""README.md is short, opens with what one types first, shows every command, and its examples work."""

import json
import os
import re
import subprocess
import sys

import pytest

from guidewire.commands.commands import parse
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
SHOWN_FILE = ROOT / "params" / "insertion.json"


def test_the_readme_has_at_most_150_lines():
    assert len(TEXT.splitlines()) <= 150


def test_the_two_commands_stand_on_the_first_screen():
    opening = TEXT[:2500]
    assert "python3 guidewire.py demo" in opening and "python3 guidewire.py test" in opening


def test_the_readme_shows_every_command_and_no_other(capsys):
    with pytest.raises(SystemExit):
        parse(["--help"])
    known = re.findall(r"^ {4}([\w-]+)(?: |$)", capsys.readouterr().out, re.MULTILINE)
    assert "sweep" in known
    assert set(re.findall(r"python3 guidewire.py ([\w-]+)", TEXT)) == set(known)


def test_the_annotated_file_is_the_real_one(live, tmp_path):
    lines = re.findall(r'^\| `(".*)` \| \S.* \|$', TEXT, re.MULTILINE)
    shown = json.loads("{" + "".join(lines) + "}")
    assert list(shown.items()) == list(json.loads(SHOWN_FILE.read_text(encoding="utf-8")).items())
    answer = live.run(Request("shown", SHOWN_FILE, tmp_path, {"maxSimulationSteps": 0}))
    assert answer.exit_code == 0, answer.message


def test_the_lines_of_python_draw_a_run(runner_command, tmp_path):
    (code,) = re.findall(r"^```python\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
    assert len(code.splitlines()) == 5
    run = tmp_path / "results" / "insertion"
    subprocess.run([*runner_command, "-parameters", str(SHOWN_FILE), "-out", str(run), "-constraintSolverSteps", "5"],
                   check=True, capture_output=True)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "MPLBACKEND": "Agg"}
    subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, check=True)
    from matplotlib import image

    picture = image.imread(tmp_path / "results" / "insertion.png")
    assert picture.shape[2] == 4 and picture[..., :3].std() > 0.01  # something is drawn
