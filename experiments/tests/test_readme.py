"""What the README shows is there, and its table of keys is the runner's own."""

import re
import subprocess

from experiments.commands import parse
from experiments.prepare import ROOT

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_readme_opens_with_the_two_commands():
    opening = TEXT[:500]
    assert "python3 guidewire.py demo" in opening and "python3 guidewire.py test" in opening


def test_the_table_of_keys_is_the_runners_own(runner_command):
    keys = subprocess.run([*runner_command, "--keys"], capture_output=True, text=True, check=True).stdout
    block = re.search(r"<!-- keys -->\n(.*)<!-- /keys -->", TEXT, re.DOTALL)
    assert block.group(1) == keys, "put the output of the runner's --keys between the two marks of README.md"


def test_every_file_that_the_readme_shows_is_there():
    shown = re.findall(r"\]\((?!http)([^)]+)\)", TEXT) + re.findall(r"`((?:params|Assets|experiments)/[\w./-]+)`", TEXT)
    assert len(shown) > 3
    for path in shown:
        assert (ROOT / path).exists(), path


def test_every_command_that_the_readme_shows_can_be_typed():
    examples = {"demo": [], "test": ["--all"], "run": ["FILE", "--set", "a=1", "--out", "DIR"],
                "sweep": ["default", "--jobs", "2", "--out", "DIR"], "figures": ["4.5", "--out", "DIR"], "bench": [],
                "unity-check": ["--write-metas"]}
    assert set(re.findall(r"python3 guidewire.py ([\w-]+)", TEXT)) == set(examples)
    for command, arguments in examples.items():
        parse([command, *arguments])
