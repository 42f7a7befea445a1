"""The program's version stands in one place; what other formats have to repeat agrees with it."""

import json
import re
from datetime import date

from guidewire.installed import version
from guidewire.prepare import ROOT


def test_every_statement_of_the_version_agrees():
    text = {name: (ROOT / name).read_text(encoding="utf-8") for name in (
        "CITATION.cff", "README.md", "CHANGELOG.md", "Assets/Guidewire/package.json", "Assets/Guidewire/CHANGELOG.md")}
    assert re.fullmatch(r"\d+\.\d+\.\d+", version())
    assert re.search(r"^version: (.+)$", text["CITATION.cff"], re.M)[1] == version()
    assert re.search(r"version (\d+\.\d+\.\d+)", text["README.md"])[1] == version()
    assert json.loads(text["Assets/Guidewire/package.json"])["version"] == version()
    for name in ("CHANGELOG.md", "Assets/Guidewire/CHANGELOG.md"):
        newest = re.search(r"^## \[(\S+)\] - (\S+)$", text[name], re.M)
        assert newest[1] == version() and date.fromisoformat(newest[2])


def test_no_project_states_a_version_of_its_own():
    for file in (ROOT / "headless").rglob("*.csproj"):
        assert "<Version>" not in file.read_text(encoding="utf-8"), file
