"""Pictures, captions and the index beside them; and that every figure's study can be run."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from analysis import command, gallery
from analysis.figures import FIGURES, FigureSpec
from analysis.gallery import Catalogue
from guidewire.logs.logs import LogError
from guidewire.studies.builtin import STUDIES
from guidewire.studies.keys import RESULTS
from guidewire.sweeps.check import Check, Finding, Result


def spec(name, studies=("default",)):
    def draw(folders):
        assert set(folders) == set(studies)
        return Figure(figsize=(1, 1)), f"Caption of {name}."

    return FigureSpec(name, f"title of {name}", studies, draw)


TWO = Catalogue({"1.1": spec("1.1"), "1.2": spec("1.2")}, {})


def test_every_study_that_a_figure_needs_can_be_run():
    assert {study for figure in FIGURES.values() for study in figure.studies} <= set(STUDIES)


def test_a_figure_is_a_picture_a_caption_and_a_place_in_the_index(tmp_path):
    drawn = gallery.draw(["1.2"], {"default": Path("a"), "other": Path("b")}, tmp_path / "out", TWO)
    index = drawn.index
    assert drawn.problems == () and index == tmp_path / "out" / "index.md"
    assert (tmp_path / "out" / "figure-1.2.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "out" / "figure-1.2.txt").read_text() == "Caption of 1.2.\n"
    assert "figure-1.2.png" in index.read_text() and "Caption of 1.2." in index.read_text()
    assert "1.1" not in index.read_text()


def test_the_index_keeps_figures_drawn_earlier_in_the_order_of_their_numbers(tmp_path):
    for name in ("1.2", "1.1"):
        drawn = gallery.draw([name], {"default": Path("a")}, tmp_path, TWO)
    text = drawn.index.read_text()
    assert text.index("figure-1.1.png") < text.index("figure-1.2.png")


def test_figures_at_once_are_those_one_by_one_and_one_that_cannot_be_drawn_is_reported(tmp_path):
    def broken(folders):
        raise LogError("study.json: no such file")

    gated = replace(spec("1.3"), gates=lambda _: ["1.3 is beyond its gate"])
    three = Catalogue({**TWO.specs, "1.2": FigureSpec("1.2", "broken", ("default",), broken), "1.3": gated}, {})
    drawn = [gallery.draw(list(three.specs), {"default": Path("a")}, tmp_path / str(jobs), three, jobs)
             for jobs in (1, 2)]
    assert [(one.problems, one.failed_gates) for one in drawn] == [
        (("figure 1.2 cannot be drawn: study.json: no such file",), ("1.3 is beyond its gate",))] * 2
    files = [{path.name: path.read_bytes() for path in (tmp_path / jobs).iterdir()} for jobs in "12"]
    assert files[0] == files[1] and len(files[0]) == 5
    assert "figure-1.2.png" not in files[0] and {"figure-1.1.png", "figure-1.3.png"} < files[0].keys()


def finds(*errors):
    """A check of lines with these errors, each with a gate of 0.01."""
    def plan():
        yield []
        lines = tuple(Result("tip", f"direct {k}", 1.0, 1.0, error, 0.01) for k, error in enumerate(errors))
        return Finding(lines, lambda figure: None, "A check.")

    return Check("bars", "statics", "bars", plan)


@pytest.mark.parametrize("errors, code, lines", [
    ((0.001, 0.01), 0, []), ((0.02, 0.001), 1, ["bars: direct 0, tip: error 0.020 is above its limit 0.010"]),
    ((float("nan"),), 1, ["bars: direct 0, tip: error not finite is above its limit 0.010"]),
])
def test_a_gate_that_fails_is_printed_at_the_end_with_exit_code_1(tmp_path, capsys, errors, code, lines):
    check = finds(*errors)
    bars = Catalogue({"bars": gallery._check_spec(check)}, {"bars": (check,)})
    drawn = gallery.draw(["bars"], {"bars": tmp_path}, tmp_path / "out", bars)
    assert drawn.problems == () and list(drawn.failed_gates) == lines
    assert command._tell(drawn) == code
    assert capsys.readouterr().err.splitlines() == [f"guidewire: beyond its limit: {line}" for line in lines]


def test_the_index_links_what_stands_beside_a_picture_and_the_tables_of_its_runs(tmp_path):
    def table(folders, path):
        path.write_text(f"made from {folders['default'].name}")

    made = replace(spec("1.1"), beside={"table.csv": table})
    (tmp_path / "default").mkdir()
    (tmp_path / "default" / RESULTS).write_text("")
    out = tmp_path / "figures"
    text = gallery.draw(["1.1"], {"default": tmp_path / "default"}, out, Catalogue({"1.1": made}, {})).index.read_text()
    links = re.findall(r"\]\(([^)]+)\)", text)
    assert links == ["figure-1.1.png", "table.csv", "../default/runs.csv"]
    assert all((out / link).exists() for link in links) and (out / "table.csv").read_text() == "made from default"


def test_the_quick_catalogue_has_every_figure_and_fewer_runs():
    assert list(gallery.QUICK.specs) == list(gallery.FULL.specs)
    for name, study in STUDIES.items():
        short = gallery.QUICK.studies[name].grid
        assert short.count <= study.grid.count
        if study.grid.count > 40:
            assert short.count < study.grid.count
