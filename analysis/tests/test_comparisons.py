"""Distances to a reference run, and what Figures 4.10 to 4.14 draw and say of them."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.comparisons import ComparisonTable, read_comparison, read_reference
from analysis.figures import FIGURES
from analysis.figures.perturbation_captions import maxima, perturbation_caption
from analysis.figures.perturbations import VIEWS, draw_reference
from analysis.tests.chain import write_study
from analysis.tests.conftest import REFERENCE, WAVES
from analysis.tests.waves import Wave
from guidewire.logs.logs import LogError

TRANSVERSAL = ("4.11", "4.12", "4.13", "4.14", "4.14b")


@pytest.fixture(scope="module")
def tables(studies: dict[str, Path]) -> dict[str, ComparisonTable]:
    made = {}
    for name in TRANSVERSAL:
        reference, study = FIGURES[name].studies
        made[name] = read_comparison(studies[study], studies[reference], VIEWS[name].key, VIEWS[name].proportional)
    return made


def mean_distance(wave: Wave, reference: Wave, by_step: bool) -> float:
    """In closed form: size/2 times the mean difference of the phases; the reference's is linear between its steps."""
    steps = np.arange(101) if by_step else np.arange(round(1.0 / wave.time_step) + 1)
    there = steps if by_step else steps * wave.time_step / reference.time_step
    known = np.arange(reference.steps + 1)
    return float(5.0 * np.mean(np.abs(wave.cosine(steps) - np.interp(there, known, reference.cosine(known)))))


@pytest.mark.parametrize("name", TRANSVERSAL[:4])
@pytest.mark.few(1)
def test_mean_distances_are_those_in_closed_form(tables: dict[str, ComparisonTable], name: str) -> None:
    table, waves = tables[name], WAVES[FIGURES[name].studies[1]][1]
    waves = sorted(waves, key=lambda wave: wave.parameters[table.key])
    assert [row.value for row in table.rows] == [wave.parameters[table.key] for wave in waves]
    assert table.common_steps == 100
    other = WAVES["transversal-reference"][1][1]
    for row, wave in zip(table.rows, waves):
        assert row.mean_distance == pytest.approx(mean_distance(wave, REFERENCE, by_step=False), rel=1e-9)
        assert row.other_distances == (pytest.approx(mean_distance(wave, other, by_step=False), rel=1e-9),)
        assert row.step_distance == pytest.approx(mean_distance(wave, REFERENCE, by_step=True), rel=1e-12)


def test_the_end_is_the_references_end_at_the_same_arc_length(tables: dict[str, ComparisonTable]) -> None:
    for row in tables["4.13"].rows:
        wave = Wave(elements=int(row.value))
        off = abs(wave.cosine(100) - REFERENCE.cosine(500))
        np.testing.assert_allclose(row.end_distance, 10.0 * wave.arc_length / 300.0 * off, atol=1e-9)
        np.testing.assert_allclose(row.end_positions, wave.positions[100], atol=1e-12)
    longest = tables["4.12"].rows[-1]  # 20 of its 100 steps fill the second
    np.testing.assert_allclose(longest.end_positions, Wave(time_step=0.05).positions[20], atol=1e-12)


def test_swing_is_that_of_the_last_sphere(tables: dict[str, ComparisonTable]) -> None:
    for row in tables["4.11"].rows:
        y = Wave(constraint_solver_steps=int(row.value)).positions[:, -1, 1]
        assert row.swing == pytest.approx(y.max() - y.min(), abs=1e-12)


def test_runs_of_any_displacement_lie_on_each_other_when_scaled(tables: dict[str, ComparisonTable]) -> None:
    first, *rest = tables["4.14b"].rows
    for row in rest:
        np.testing.assert_allclose(row.end_positions, first.end_positions, atol=1e-9)
        assert row.mean_distance == pytest.approx(first.mean_distance, rel=1e-9)


def test_a_run_that_ends_early_is_left_out_and_reported(tmp_path: Path, studies: dict[str, Path]) -> None:
    folder = write_study(tmp_path / "a", "a", "totalMass", [Wave(), Wave(steps=40, total_mass=0.5)], repeats=0)
    table = read_comparison(folder, studies["transversal-reference"], "totalMass")
    assert [row.value for row in table.rows] == [0.01]
    assert "Not shown: totalMass=0.5: finished at t = 0.4 s." in perturbation_caption("4.14", table)
    folder = write_study(tmp_path / "b", "b", "totalMass", [Wave(steps=40)], repeats=0)
    with pytest.raises(LogError, match="lasts as long"):
        read_comparison(folder, studies["transversal-reference"], "totalMass")


def test_the_reference_is_drawn_with_the_other_runs_and_with_a_doubled_time_step(studies: dict[str, Path]) -> None:
    figure, caption = draw_reference(read_reference(studies["transversal-reference"]))
    panels = [axes for axes in figure.axes if axes.axison]
    assert [axes.get_ylabel()[10] for axes in panels] == ["x", "y", "z", "y", "z"]
    other, doubled, reference = panels[1].lines
    np.testing.assert_array_equal(reference.get_ydata(), REFERENCE.positions[:, -1, 1])
    np.testing.assert_allclose(doubled.get_xdata(), np.arange(251) * 0.004)
    np.testing.assert_array_equal(doubled.get_ydata(), REFERENCE.positions[:251, -1, 1])
    assert len(other.get_xdata()) == 501
    assert "No sphere leaves x = 0" in caption and "still moves between" in caption  # this wave does not die out


@pytest.mark.parametrize("name", TRANSVERSAL)
@pytest.mark.few(1)
def test_every_run_is_in_the_lower_panels_and_at_most_ten_wires_in_the_upper_ones(
    drawn: dict[str, tuple[Figure, str]], tables: dict[str, ComparisonTable], name: str
) -> None:
    figure, _ = drawn[name]
    shape, along, by_time, by_step = figure.axes[:4]
    table = tables[name]
    wires = min(10, len(table.rows))
    assert len(along.lines) <= wires and len(shape.lines) == len(along.lines) + 1
    for axes, column in ((by_time, "mean_distance"), (by_step, "step_distance")):
        np.testing.assert_array_equal(axes.lines[-1].get_xdata(), table.column("value"))
        np.testing.assert_array_equal(axes.lines[-1].get_ydata(), table.column(column))
    assert len(by_time.lines) == 2 and len(by_step.lines) == 1
    assert by_time.get_ylim() == by_step.get_ylim() and by_time.get_ylim()[0] == 0.0


def test_maxima_stand_out() -> None:
    x = np.linspace(0.0, 1.0, 101)
    np.testing.assert_allclose(maxima(x, np.sin(6.0 * np.pi * x) + 3.0 * x), [0.11, 0.44, 0.78], atol=0.02)
    assert maxima(x, x + 1e-3 * np.sin(40.0 * np.pi * x)).size == 0
    assert maxima(x, np.full(101, 2.0)).size == 0


def changed(table: ComparisonTable, **columns: np.ndarray) -> ComparisonTable:
    rows = [
        dataclasses.replace(row, **{name: float(values[k]) for name, values in columns.items()})
        for k, row in enumerate(table.rows)
    ]
    return dataclasses.replace(table, rows=tuple(rows))


def test_a_resonance_at_700_is_reported_where_there_is_one(tables: dict[str, ComparisonTable]) -> None:
    table = tables["4.11"]
    m = table.column("value")
    smooth = changed(table, mean_distance=3.0 - m / 1000.0, swing=3.0 - m / 1000.0)
    caption = perturbation_caption("4.11", smooth)
    assert "no local maximum at all" in caption and "swing has no local maximum" in caption
    assert "As the thesis says, more solver steps come closer" in caption
    peaked = changed(smooth, mean_distance=3.0 - m / 1000.0 + np.exp(-(((m - 700.0) / 60.0) ** 2)))
    caption = perturbation_caption("4.11", peaked)
    assert "local maxima stand at m = 700." in caption
    swinging = changed(smooth, swing=1.0 + np.exp(-(((m - 700.0) / 60.0) ** 2)))
    assert "is largest near m = 700" in perturbation_caption("4.11", swinging)


def test_equal_positions_at_equal_steps_are_reported_only_where_they_are(tables: dict[str, ComparisonTable]) -> None:
    table = tables["4.12"]
    assert "one and the same" in perturbation_caption("4.12", table)
    steps = table.column("step_distance")
    steps[1] *= 1.001
    assert "one and the same" not in perturbation_caption("4.12", changed(table, step_distance=steps))


def test_the_figure_of_a_study_draws_on_its_reference(drawn: dict[str, tuple[Figure, str]]) -> None:
    figure, _ = drawn["4.11"]
    assert isinstance(figure, Figure)
    np.testing.assert_allclose(figure.axes[0].lines[-1].get_ydata(), REFERENCE.positions[-1, :, 1])


@pytest.mark.parametrize("name, claim", [("4.11", "As the thesis says, more solver steps come closer")])
@pytest.mark.parametrize("back, is_said", [(0.0, True), (0.08, True), (0.2, False)])
def test_a_distance_is_said_to_fall_where_it_falls_back_by_a_tenth_of_its_range_at_most(
    tables: dict[str, ComparisonTable], name: str, claim: str, back: float, is_said: bool
) -> None:
    table = tables[name]
    mean = np.linspace(3.0, 2.0, len(table.rows))
    middle = len(mean) // 2
    mean[middle] = mean[middle - 1] + back
    assert (claim in perturbation_caption(name, changed(table, mean_distance=mean))) == is_said
    assert claim not in perturbation_caption(name, changed(table, mean_distance=mean[::-1]))
