"""What `plot` takes from a table of runs, and how it draws it."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from guidewire.figures.result_table import draw_curves
from guidewire.figures.style import CAPTION_ID
from guidewire.logs.logs import LogError
from guidewire.logs.result_table import label_of, read_curves

HEAD = ("key,variant,vessel.frictionCoefficient,vessel.radius,bendingStiffness,repeat,outcome,stiffness,hub.force,"
        "hub.tipPosition,extremes.axialForce,largestContactForce,wallTime")


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """Two frictions, two radii, two stiffnesses, in no order; force = 10 friction radius + 1e5 stiffness; one
    diverged."""
    lines, runs = [HEAD], []
    for friction in (0.2, 0.1):
        for radius in ("narrow", "wide"):
            for stiffness in (1e-5, 2e-5):
                force = 10 * friction * (1 if radius == "narrow" else 2) + 1e5 * stiffness
                lost = friction == 0.2 and radius == "wide" and stiffness == 2e-5
                cells = ",," if lost else f'{force},"[0.0, 1.0, {force}]",{2 * force}'
                outcome = "diverged" if lost else "finished"
                lines.append(f"a,,{friction},{radius},{stiffness},,{outcome},material,{cells},0.5,1.0")
                runs.append({"values": {"vessel.frictionCoefficient": friction, "vessel.radius": radius,
                                        "bendingStiffness": stiffness}})
    lines.append("a,,0.1,narrow,1e-05,1,finished,material,99.0,,99.0,0.5,1.0")  # a timed repeat is no point
    (tmp_path / "runs.csv").write_text("\n".join(lines) + "\n")
    (tmp_path / "study.json").write_text(json.dumps({"study": "s", "question": "How hard?", "runs": runs}))
    return tmp_path / "runs.csv"


def test_lines_are_of_what_else_varies_and_points_ascend(table: Path) -> None:
    curves = read_curves(table, "frictionCoefficient", "hub.force", "bendingStiffness")
    found = {(line.by, line.rest): (line.x, line.y) for line in curves.lines}
    assert found == {
        ("1e-05", "vessel.radius = narrow"): ((0.1, 0.2), (2.0, 3.0)),
        ("1e-05", "vessel.radius = wide"): ((0.1, 0.2), (3.0, 5.0)),
        ("2e-05", "vessel.radius = narrow"): ((0.1, 0.2), (3.0, 4.0)),
        ("2e-05", "vessel.radius = wide"): ((0.1,), (4.0,)),
    }
    assert (curves.runs, curves.lost, curves.x) == (7, 1, "vessel.frictionCoefficient")


def test_items_of_lists_names_of_values_and_folders_are_taken(table: Path) -> None:
    tip = read_curves(table.parent, "vessel.radius", "hub.tipPosition[-1]")
    assert {line.x for line in tip.lines} == {("narrow", "wide"), ("narrow",)}
    assert tip.lines[0].y[0] == 3.0 and tip.y == "hub.tipPosition[-1]"


def test_the_figure_names_both_axes_with_units_each_line_and_what_is_missing(table: Path) -> None:
    curves = read_curves(table, "vessel.frictionCoefficient", "extremes.axialForce", "bendingStiffness")
    figure = draw_curves(curves, label_of(curves.x, ""), "y")
    axes = figure.axes[0]
    assert axes.get_xlabel() == "vessel.frictionCoefficient"
    assert axes.get_ylabel() == "largest force of the hub (N)" and axes.get_yscale() == "log"
    assert [text.get_text() for text in axes.get_legend().get_texts()][:2] == [
        "bendingStiffness = 1e-05, vessel.radius = narrow", "bendingStiffness = 2e-05, vessel.radius = narrow"]
    colours = {line.get_label().split(",")[0]: line.get_color() for line in axes.get_lines()}
    assert len(axes.get_lines()) == 4 and len(set(map(tuple, colours.values()))) == 2
    caption = " ".join(next(text for text in figure.texts if text.get_gid() == CAPTION_ID).get_text().split())
    assert caption.startswith("How hard?") and "7 runs. 1 more have no number there." in caption


def test_forces_with_gains_have_the_units_of_gains(table: Path) -> None:
    assert read_curves(table, "bendingStiffness", "largestContactForce").y_label == "largest contact force (N)"
    table.write_text(table.read_text().replace("material", "gains"))
    assert "mass unit" in read_curves(table, "bendingStiffness", "largestContactForce").y_label


@pytest.mark.parametrize("x, y, said", [
    ("friction", "hub.force", r"--x friction: no such column: .*there are .*vessel.frictionCoefficient"),
    ("bendingStifness", "hub.force", r"--x bendingStifness: .*did you mean 'bendingStiffness'\?"),
    ("bendingStiffness", "hub.forc", r"--y hub.forc: .*did you mean 'hub.force'\?"),
    ("bendingStiffness", "outcome", r"outcome is a number in none of 8 runs; there are .*hub.force"),
    ("bendingStiffness", "hub.tipPosition[3]", "is a number in none of"),
    ("bendingStiffness", "hub.force[0]", "is a number in none of"),
])
def test_what_is_not_there_is_reported_in_one_line_with_what_is(table: Path, x: str, y: str, said: str) -> None:
    with pytest.raises(LogError) as refused:
        read_curves(table, x, y)
    assert re.search(said, str(refused.value)) and "\n" not in str(refused.value)


@pytest.mark.parametrize("text", ["", "a,b\n1,2\n", "key,outcome\n", None])
def test_what_is_no_table_of_runs_is_reported_in_one_line(tmp_path: Path, text: str | None) -> None:
    if text is not None:
        (tmp_path / "runs.csv").write_text(text)
    with pytest.raises(LogError, match=r"runs\.csv: .*"):
        read_curves(tmp_path / "runs.csv", "a", "b")
