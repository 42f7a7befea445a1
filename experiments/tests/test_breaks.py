"""The breaks of experiments/breaks fit the code, and each names tests that there are."""

from __future__ import annotations

import runpy

from guidewire.prepare import ROOT


def test_each_break_stands_once_in_the_code_and_names_what_finds_it():
    rows = runpy.run_path(str(ROOT / "experiments" / "breaks" / "breaks.py"))["load"]()
    classes = {path.stem for path in (ROOT / "Assets" / "Guidewire" / "Tests").rglob("*Tests.cs")}
    for row in rows:
        is_compiled = row["file"].endswith(".cs")
        assert row["tests"] and row["old"] != row["new"] and ("Breaks.Is(@)" in row["new"]) == is_compiled, row["what"]
        assert all(name in classes if is_compiled else (ROOT / name).exists() for name in row["tests"]), row["what"]
