"""README.md is short, opens with what one types first, names every command, and its example is a file that can be
relied on."""

import json
import re

from guidewire.commands.command_line import GROUPS
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request

TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
OPENING = TEXT.partition("It needs ")[0]
SHOWN_FILE = ROOT / "params" / "branch.json"


def test_the_readme_has_at_most_900_words_and_its_first_screen_150():
    assert len(TEXT.split()) <= 900 and len(OPENING.split()) <= 150


def test_the_pages_have_at_most_38_000_words_with_their_tables():
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").glob("*.md")]
    words = [word for page in pages for word in page.read_text(encoding="utf-8").split() if word != "|"]
    assert 30_000 < len(words) <= 38_000


def test_the_first_screen_has_the_film_and_two_commands_and_no_placeholder():
    assert OPENING.count("![") == 1 and ".gif" in OPENING
    assert "python3 guidewire.py demo" in OPENING and f"python3 guidewire.py view params/{SHOWN_FILE.name}" in OPENING
    assert "OWNER" not in TEXT


def test_the_readme_names_every_command_by_its_task():
    listed = {task: re.findall(r"`([\w-]+)`", names) for task, names in re.findall(r"^- (\w+): (`.*)$", TEXT, re.M)}
    assert {task: tuple(names) for task, names in listed.items() if task in GROUPS} == GROUPS


def test_the_annotated_file_is_the_real_one_and_its_run_is_reliable(live, tmp_path):
    (block,) = re.findall(r"^```jsonc\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
    shown = json.loads(re.sub(r"//.*", "", block))
    assert list(shown.items()) == list(json.loads(SHOWN_FILE.read_text(encoding="utf-8")).items())
    answer = live.run(Request("shown", SHOWN_FILE, tmp_path, {}))
    assert answer.exit_code == 0, answer.message
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["reliable"] and summary["warnings"] == []
    assert summary["hub"]["tipPosition"][2] > 200 and summary["hub"]["tipPosition"][1] < 60  # in the branch
