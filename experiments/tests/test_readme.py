"""README.md opens with what one types first, and shows every command."""

import re

import pytest

from experiments.commands import parse
from experiments.prepare import ROOT

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_readme_opens_with_the_two_commands():
    opening = TEXT[:500]
    assert "python3 guidewire.py demo" in opening and "python3 guidewire.py test" in opening


def test_the_readme_shows_every_command_and_no_other(capsys):
    with pytest.raises(SystemExit):
        parse(["--help"])
    known = re.findall(r"^ {4}([\w-]+)(?: |$)", capsys.readouterr().out, re.MULTILINE)
    assert "sweep" in known
    assert set(re.findall(r"python3 guidewire.py ([\w-]+)", TEXT)) == set(known)
