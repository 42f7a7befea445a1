"""What the figures draw and their captions say; not their pixels."""

from __future__ import annotations

import dataclasses
import os
import re
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, QuadMesh
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties

from analysis.figures import FIGURES
from analysis.figures.sweep_captions import sweep_caption
from analysis.figures.default_run import draw_time_evolution, read_default_run
from analysis.figures.sweeps import VIEWS, draw_sweep
from analysis.tables import StudyTable, read_table
from analysis.tests.chain import EPSILON, Chain
from guidewire.figures import style
from guidewire.figures.style import CAPTION_ID
from guidewire.figures.wording import number, span
from guidewire.studies.builtin import STUDIES

SWEEPS = {name: FIGURES[name].studies[0] for name in ("4.5", "4.6", "4.7", "4.8", "4.9")}


@pytest.fixture(scope="module")
def tables(studies: dict[str, Path]) -> dict[str, StudyTable]:
    return {name: read_table(studies[study], VIEWS[name].key) for name, study in SWEEPS.items()}


def panels(figure: Figure) -> list[Axes]:
    return [axes for axes in figure.axes if axes.axison and axes.get_label() != "<colorbar>"]


def marked(axes: Axes, style: str) -> list:
    return [line for line in axes.lines if line.get_linestyle() == style]


def test_every_figure_of_the_longitudinal_study_is_there() -> None:
    assert list(FIGURES)[:9] == [f"4.{k}" for k in range(1, 10)]
    for name, spec in FIGURES.items():
        assert spec.id == name and spec.title and set(spec.studies) <= set(STUDIES)
    for name, study in SWEEPS.items():
        assert [axis.key for axis in STUDIES[study].grid.axes] == [VIEWS[name].key]


def drawn_by(name: str) -> object:
    """What draws a figure: those of one make have panels of one kind."""
    draw = FIGURES[name].draw
    if not isinstance(draw, partial):
        return draw
    return draw.args[0] if callable(draw.args[0]) else draw.func


# Where campaigns do not run in full, the first of every third make: one engine and one style lay them all out.
LAID_OUT = list(FIGURES) if os.environ.get("GUIDEWIRE_ALL") else list(
    {drawn_by(name): name for name in reversed(FIGURES)}.values())[::3]


@pytest.mark.parametrize("name", LAID_OUT)
@pytest.mark.few(1)
def test_axes_are_labelled_with_units(drawn: dict[str, tuple[Figure, str]], name: str) -> None:
    for axes in panels(drawn[name][0]):
        for label in (axes.get_xlabel(), axes.get_ylabel()):
            assert label
            assert label.endswith(")") or label.startswith(("number of", "constraint solver", "sphere index")), label


@pytest.mark.parametrize("name", LAID_OUT)
@pytest.mark.few(1)
def test_caption_stands_under_the_panels_and_inside_the_picture(
    drawn: dict[str, tuple[Figure, str]], name: str
) -> None:
    figure, caption = drawn[name]
    figure.get_layout_engine().execute(figure)    # where everything stands, without drawing what the panels show
    renderer = figure.canvas.get_renderer()
    text = next(text for text in figure.texts if text.get_gid() == CAPTION_ID)
    shown = " ".join(text.get_text().split())
    assert shown == style.opening(caption) and caption.startswith(f"Figure {name}. ")
    assert not re.search(r"\bnan\b|not finite|\bNone\b", caption)
    box = text.get_window_extent(renderer)
    assert 0.0 <= box.x0 and box.x1 <= figure.bbox.x1 and 0.0 <= box.y0
    for axes in figure.axes:
        assert axes.get_tightbbox(renderer).y0 >= box.y1
    for one, other in zip(figure.axes, figure.axes[1:]):
        assert not one.get_window_extent(renderer).overlaps(other.get_window_extent(renderer))


def test_drawing_and_saving_leave_the_settings_of_matplotlib_alone(studies: dict[str, Path], tmp_path: Path) -> None:
    before = dict(matplotlib.rcParams)
    figure, _ = FIGURES["4.4"].draw(studies)
    figure.savefig(tmp_path / "figure.png")
    assert dict(matplotlib.rcParams) == before
    assert (tmp_path / "figure.png").stat().st_size > 10_000


def test_time_evolution_shows_the_run(drawn: dict[str, tuple[Figure, str]], default_chain: Chain) -> None:
    real, position, prediction = panels(drawn["4.1"][0])
    np.testing.assert_allclose(real.lines[0].get_ydata(), 0.003 * np.arange(297))  # the median of 2, 3, 4 ms a step
    np.testing.assert_array_equal(position.lines[0].get_ydata(), default_chain.z[:, -1])
    assert prediction.get_yscale() == "log"
    np.testing.assert_array_equal(prediction.lines[0].get_ydata(), default_chain.prediction_error[1:])
    (threshold,) = marked(prediction, "--")
    assert set(threshold.get_ydata()) == {EPSILON}
    (steady,) = marked(prediction, ":")
    np.testing.assert_allclose(steady.get_xdata(), 1.97)
    assert "from step 197 (t = 1.97 s)" in drawn["4.1"][1]


def test_longest_dip_is_counted_before_the_steady_state(
    drawn: dict[str, tuple[Figure, str]], default_chain: Chain
) -> None:
    below = "".join("b" if error < EPSILON else "a" for error in default_chain.prediction_error[:197])
    longest = max(len(dip) for dip in below.strip("b").split("a"))
    assert f"for up to {longest} steps at a time" in drawn["4.1"][1]


def test_heat_map_has_a_cell_for_each_sphere_and_step(
    drawn: dict[str, tuple[Figure, str]], default_chain: Chain
) -> None:
    (axes,) = panels(drawn["4.2"][0])
    (mesh,) = [item for item in axes.collections if isinstance(item, QuadMesh)]
    values = np.asarray(mesh.get_array()).reshape(31, 297)
    np.testing.assert_allclose(values, (default_chain.z - default_chain.rest).T, atol=1e-12)
    assert mesh.norm.vcenter == 10.0


def test_long_runs_are_thinned_for_the_heat_map(studies: dict[str, Path]) -> None:
    table = read_default_run(studies["default"], spheres="all", most_entries=50)
    np.testing.assert_array_equal(table.log.steps, np.arange(0, 297, 5))


def test_relaxation_shows_every_peak_and_the_fit(drawn: dict[str, tuple[Figure, str]]) -> None:
    figure, caption = drawn["4.3"]
    for axes in panels(figure):
        error, peaks, envelope = axes.lines
        assert len(peaks.get_xdata()) == 24
        assert np.all(np.isin(peaks.get_ydata(), error.get_ydata()))
        decay = np.diff(np.log(envelope.get_ydata())) / np.diff(envelope.get_xdata())
        np.testing.assert_allclose(-1.0 / decay, 0.297, rtol=0.01)
    assert "all 24 peaks" in caption and "τ = 0.297" in caption


def test_final_error_states_its_steps(drawn: dict[str, tuple[Figure, str]], default_chain: Chain) -> None:
    figure, caption = drawn["4.4"]
    end, peak = panels(figure)[0].lines
    for line, step in ((end, 296), (peak, 219)):
        np.testing.assert_allclose(
            line.get_ydata(), np.abs(default_chain.z[step] - default_chain.rest - 10.0), atol=1e-12
        )
        assert f"step {step}" in line.get_label() and f"step {step}" in caption
    assert "the mean is 0.0049 units; the thesis prints 0.0049" in caption


@pytest.mark.parametrize("name", SWEEPS)
@pytest.mark.few(1)
def test_sweep_draws_every_row_in_every_panel(
    drawn: dict[str, tuple[Figure, str]], tables: dict[str, StudyTable], name: str
) -> None:
    table = tables[name]
    tau, step, steady, wall, error = panels(drawn[name][0])
    for axes, column in (
        (tau, "relaxation.time"), (step, "step_time.median"), (steady, "steady_state_time"),
        (wall, "computation_time.median"), (error, "total_error"),
    ):
        points = [line for line in axes.lines if line.get_marker() == "o"]
        np.testing.assert_array_equal(points[0].get_xdata(), table.column("value"))
        np.testing.assert_array_equal(points[0].get_ydata(), table.column(column))
        assert axes.get_xscale() == ("log" if name in ("4.8", "4.9") else "linear")
    for axes, chosen in ((step, "step_time"), (wall, "computation_time")):
        (bars,) = [item for item in axes.collections if isinstance(item, LineCollection)]
        ends = np.array([segment[:, 1] for segment in bars.get_segments()])
        np.testing.assert_allclose(ends[:, 0], table.column(f"{chosen}.lowest"))
        np.testing.assert_allclose(ends[:, 1], table.column(f"{chosen}.highest"))
        assert axes.get_ylim()[0] == 0.0 and axes.get_ylim()[1] > ends.max()


@pytest.mark.parametrize("name", SWEEPS)
def test_only_the_rod_elements_have_a_dashed_line_at_30(drawn: dict[str, tuple[Figure, str]], name: str) -> None:
    for axes in panels(drawn[name][0]):
        assert [set(line.get_xdata()) for line in marked(axes, "--")] == ([{30}] if name == "4.6" else [])


def test_sweep_that_was_not_timed_says_so(tables: dict[str, StudyTable]) -> None:
    rows = tuple(dataclasses.replace(row, step_time=None, computation_time=None) for row in tables["4.5"].rows)
    figure, caption = draw_sweep(VIEWS["4.5"], dataclasses.replace(tables["4.5"], rows=rows))
    texts = [[text.get_text() for text in axes.texts] for axes in panels(figure)]
    assert texts == [[], ["no timed repeats"], [], ["no timed repeats"], []]
    assert "No run of this study was timed." in caption and "nan" not in caption


def test_sweep_without_any_result_is_still_a_figure(tables: dict[str, StudyTable]) -> None:
    for name, table in tables.items():
        rows = tuple(
            dataclasses.replace(
                row, relaxation=None, no_relaxation="the motion is not finite", steady_state_step=None,
                total_error=None, step_time=None, computation_time=None,
            )
            for row in table.rows
        )
        _, caption = draw_sweep(VIEWS[name], dataclasses.replace(table, rows=rows))
        assert "No run of this study relaxed." in caption and "no steady state" in caption


def changed(table: StudyTable, row: int, **values: object) -> StudyTable:
    rows = list(table.rows)
    rows[row] = dataclasses.replace(rows[row], **values)
    return dataclasses.replace(table, rows=tuple(rows))


def slower(table: StudyTable, row: int, factor: float) -> StudyTable:
    relaxation = table.rows[row].relaxation
    assert relaxation is not None
    return changed(table, row, relaxation=dataclasses.replace(relaxation, time=factor * relaxation.time))


@pytest.mark.parametrize(
    ("name", "claim"),
    [
        ("4.5", "m τ/Δt is nearly constant"),
        ("4.7", "does not depend on the displacement"),
        ("4.8", "does not contain Δt at all"),
        ("4.9", "The thesis explains this by inertia"),
    ],
)
def test_claims_are_made_only_of_tables_that_show_them(tables: dict[str, StudyTable], name: str, claim: str) -> None:
    assert claim in sweep_caption(name, tables[name])
    assert claim not in sweep_caption(name, slower(tables[name], 1, 3.0))


def test_another_motion_at_one_time_step_is_noticed(tables: dict[str, StudyTable]) -> None:
    other = changed(tables["4.8"], 2, total_error=2.0 * (tables["4.8"].rows[2].total_error or 0.0))
    assert "does not contain Δt" not in sweep_caption("4.8", other)


def test_caption_says_what_is_left_out(tables: dict[str, StudyTable]) -> None:
    table = changed(tables["4.9"], 2, steady_state_step=None, computation_time=None, warning="cut short")
    table = dataclasses.replace(table, missing=("totalMass=7",))
    caption = sweep_caption("4.9", table)
    assert "Not shown: totalMass=0.05: no steady state" in caption
    assert f"totalMass=0.05: log cut short at step {table.rows[2].steps}" in caption
    assert "totalMass=7: not run" in caption


def test_default_run_without_timed_repeats_says_whose_clock_it_shows(studies: dict[str, Path]) -> None:
    table = dataclasses.replace(read_default_run(studies["default"]), timed=None)
    _, caption = draw_time_evolution(table)
    assert "a run made possibly beside others" in caption


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.29698, 3, "0.297"), (1547.7, 4, "1,548"), (107000.0, 3, "107,000"), (2.1e-5, 2, "2.1e-5"), (0.0, 3, "0"),
        (0.9996, 3, "1.00"), (10.0, 2, "10"), (9.99e-5, 2, "0.00010"), (-0.5, 1, "-0.5"), (3.2e7, 2, "3.2e7"),
        (float("nan"), 3, "not finite"),
    ],
)
def test_numbers_are_written_with_significant_digits(value: float, digits: int, text: str) -> None:
    assert number(value, digits) == text


def test_spans_join_what_reads_the_same() -> None:
    assert span([1.0, 3.0, np.nan]) == "1.00 to 3.00"
    assert span([0.5, 0.5000001]) == "0.500"
    assert span([np.nan]) == "no value"


@pytest.mark.parametrize("name", LAID_OUT)
def test_a_picture_shows_the_first_sentences_of_its_caption_in_sixty_words(
    drawn: dict[str, tuple[Figure, str]], name: str
) -> None:
    caption = drawn[name][1]
    shown = style.opening(caption)
    assert 12 < len(shown.split()) <= 60 and caption.startswith(shown) and shown[-1] in ".?"
    rest = caption[len(shown):].strip()
    assert not rest or len(f"{shown} {re.split(r'(?<=[.?]) ', rest)[0]}".split()) > 60 or rest[0].islower()


def test_a_caption_is_broken_where_the_next_word_would_leave_the_line() -> None:
    figure = style.new_figure(6.0, 2.0)
    font = FontProperties(size=8.5)
    text = " ".join(f"{'word' * (k % 4)}{k}" for k in range(200))
    lines = style._wrap(figure, text, font, 500.0)

    def wide(part: str) -> float:
        return figure.canvas.get_renderer().get_text_width_height_descent(part, font, False)[0]

    assert " ".join(lines) == text and max(map(wide, lines)) <= 500.0
    for line, after in zip(lines, lines[1:]):
        assert wide(f"{line} {after.split(' ')[0]}") > 500.0
