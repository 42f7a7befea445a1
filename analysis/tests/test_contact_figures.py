"""The charts of contact, drives and twist: what they draw and say."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.figures.contact_rule import Rest, contact_rule_caption, read_rests
from analysis.figures.control import along_line, draw_drives, drives_caption, read_drives, read_twists
from analysis.figures.gain import draw_gain, gain_caption
from analysis.figures.outlines import draw_surroundings, section, tube_sides
from analysis.gain import ElementTable, read_gain
from analysis.tests.conftest import BOX, LUMEN, NAMED_WAVES, box_passages, write_box
from analysis.tests.waves import Wave
from analysis.twist import joint_angles
from guidewire.logs.logs import LogError
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import read_obj


@pytest.fixture(scope="module")
def vessel(studies: dict[str, Path]) -> ElementTable:
    return read_gain(studies["vessel-gain"], count_again=4)


def test_the_finest_run_with_element_contact_is_the_reference(vessel: ElementTable) -> None:
    assert (vessel.reference.rule, vessel.reference.elements) == ("barycentric", 16)
    assert [row.elements for row in vessel.of("none")] == [4, 8]
    assert all(row.mean_distance == pytest.approx(0.0, abs=1e-9) for row in vessel.rows)  # the same motion for all n


def test_passages_are_counted_again_where_asked(vessel: ElementTable) -> None:
    counted = {(row.rule, row.elements): row.counted_again for row in vessel.rows if row.counted_again is not None}
    there = box_passages(Wave(elements=4))
    assert counted == {(rule, 4): there for rule in ("none", "barycentric", "thesis")}
    caption = gain_caption("x", "Scene", vessel)
    assert f"{there} instead of 0 with spheres and elements at n = 4" in caption
    right = dataclasses.replace(vessel, rows=tuple(row for row in vessel.rows if row.rule == "none"))
    assert "the passages are the same" in gain_caption("x", "Scene", dataclasses.replace(
        right, rows=(*right.rows, *(dataclasses.replace(row, counted_again=None) for row in vessel.rows
                                    if row.rule != "none"))))


def test_the_chart_shows_every_run_of_every_rule(vessel: ElementTable) -> None:
    figure, _ = draw_gain("gain-vessel", "Scene", vessel)
    error, time, passages = figure.axes[2:5]
    for axes, column in ((error, "mean_distance"), (passages, "passages")):
        for line, rule in zip(axes.lines, ("none", "barycentric", "thesis")):
            np.testing.assert_array_equal(line.get_xdata(), [4, 8])
            np.testing.assert_array_equal(line.get_ydata(), [getattr(row, column) for row in vessel.of(rule)])
    assert len(time.containers) == 3
    np.testing.assert_array_equal(time.containers[0].lines[0].get_ydata(), [3.0, 3.0])  # of 2, 3 and 4 ms


def test_a_limit_of_length_is_claimed_only_where_it_parts_the_runs(vessel: ElementTable) -> None:
    rows = list(vessel.rows)
    caption = gain_caption("x", "Scene", vessel)
    assert "at n = 4, 8" in caption and "units and more" not in caption  # both lengths fail
    held = [dataclasses.replace(row, passages=0) if row.elements == 8 else row for row in rows]
    caption = gain_caption("x", "Scene", dataclasses.replace(vessel, rows=tuple(held)))
    assert "for l = 75.0 units and more, and not for 37.5 and less" in caption
    assert "With element contact no point of any wire passes the wall" in caption


def test_a_plane_is_called_no_trial_of_sphere_contact(studies: dict[str, Path], vessel: ElementTable) -> None:
    assert "A plane is no trial" in gain_caption("x", "Scene", read_gain(studies["wall-gain"]))
    assert "A plane is no trial" not in gain_caption("x", "Scene", vessel)


def test_rests_are_measured_from_the_first_step_and_the_end(studies: dict[str, Path]) -> None:
    rests = read_rests(studies["contact-rule"])
    assert [rest.position for rest in rests] == [0.0, 0.25, 0.5, 0.75, 1.0] * 2
    for rest in rests:
        wave = NAMED_WAVES["contact-rule"][f"{rest.rule},s={rest.position:g}"]
        np.testing.assert_allclose(rest.pushed, np.diff(wave.positions[:2, :, 1], axis=0)[0], atol=1e-12)
        slope = np.diff(wave.positions[-1, :, 1])[0]
        assert rest.shrunk == pytest.approx(60.0 - np.hypot(60.0, slope))
    middle = next(rest for rest in rests if rest.position == 0.5)
    (y0, y1), foot = NAMED_WAVES["contact-rule"]["thesis,s=0.5"].positions[-1, :, 1], 60.0 / np.hypot(60.0, 1.0)
    assert middle.depth == pytest.approx(5.0 - (0.5 * (y0 + y1) + 4.6) * foot + 0.6, abs=0.05)


def rest(rule: str, position: float, first: float, second: float, depth: float) -> Rest:
    return Rest(rule, position, np.array([first, second]), 0.0, depth)


def test_the_caption_tells_which_end_moves() -> None:
    lever = [rest("barycentric", s, 1.0 - s, s, 0.0) for s in (0.0, 0.3, 0.5, 0.8, 1.0)]
    swapped = [rest("thesis", s, s, 1.0 - s, 2.0) for s in (0.0, 0.3, 0.5, 0.8, 1.0)]
    caption = contact_rule_caption(lever + swapped)
    assert "at 4 of 4 positions, as it must be. (b)" in caption and "more than the farther one at 0 of 4" in caption
    assert "at its surface under the lever rule and 2.0 units deep" in caption
    assert "at 0 of 5 positions both ends are drawn towards" in caption


def test_places_along_a_line() -> None:
    knots = np.array(LUMEN["knots"], float)
    points = np.array([[0.0, 3.0, -100.0], [0.0, 50.0, 104.0], [0.0, -5.0, 110.0]])
    along, off = along_line(points, knots)
    np.testing.assert_allclose(along, [100.0, 350.0, 300.0])
    np.testing.assert_allclose(off, [3.0, 4.0, np.hypot(5.0, 10.0)])


def test_drives_show_where_the_first_sphere_is(studies: dict[str, Path]) -> None:
    rows = read_drives(studies["drives"])
    figure, caption = draw_drives(rows)
    axes = figure.axes[4]
    for line, row in zip(axes.lines, rows):
        np.testing.assert_array_equal(line.get_ydata(), row.first_off)
        np.testing.assert_allclose(row.first_off, NAMED_WAVES["drives"][row.key].displacement)  # beside the line
    assert set(axes.lines[-1].get_ydata()) == {8}
    assert "which leaves the lumen, up to 12.0 units" in caption
    assert "(b) Fixed axis: the first sphere stays within 8.00 units" in caption


def test_what_the_wall_takes_is_reported_where_it_takes_something(studies: dict[str, Path]) -> None:
    rows = {row.key: row for row in read_drives(studies["drives"])}
    assert "the wall takes" not in drives_caption(rows)
    run = rows["axis"].wire.run
    blocked = dataclasses.replace(run, summary={**run.summary, "driveShortfall": 10.0})
    rows["axis"] = dataclasses.replace(rows["axis"], wire=dataclasses.replace(rows["axis"].wire, run=blocked))
    assert "the wall takes 10.0 of the 50 units (20 %)" in drives_caption(rows)


def test_twist_and_bend_of_a_joint_are_those_it_was_made_of() -> None:
    def turned(axis: tuple[float, float, float], angle: float) -> np.ndarray:
        return np.array([*(np.sin(angle / 2.0) * np.array(axis)), np.cos(angle / 2.0)])

    def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.append(a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3]), a[3] * b[3] - a[:3] @ b[:3])

    first = product(turned((0, 1, 0), 0.7), turned((0, 0, 1), 2.0))
    for bend, twist in ((0.3, 0.5), (1.2, -2.5), (0.0, 3.0)):
        second = product(product(first, turned((1, 0, 0), bend)), turned((0, 0, 1), twist))
        found = joint_angles(np.array([first, second]))
        np.testing.assert_allclose(np.ravel(found), [twist, bend], atol=1e-12)


def test_the_tip_angle_is_the_base_angle_and_all_twists(
    studies: dict[str, Path], drawn: dict[str, tuple[Figure, str]]
) -> None:
    for row in read_twists(studies["twist"]):
        steps = row.twist.steps
        np.testing.assert_allclose(row.twist.base, 0.01 * steps)
        np.testing.assert_allclose(row.twist.tip, 0.1 * steps, atol=1e-9)  # element 9 turns ten times as fast
        np.testing.assert_allclose(row.twist.bend, 0.0, atol=1e-12)
    figure, _ = drawn["twist"]
    np.testing.assert_allclose(figure.axes[0].lines[0].get_ydata(), 0.1 * np.arange(61), atol=1e-9)


def test_the_section_of_a_box_is_its_outline(tmp_path: Path) -> None:
    write_box(tmp_path / "box.obj")
    ends = section(read_obj(tmp_path / "box.obj")).reshape(-1, 2)
    low, high = BOX[0, [2, 1]], BOX[1, [2, 1]]
    assert np.all(np.isclose(ends, low) | np.isclose(ends, high), axis=1).sum() >= 8
    np.testing.assert_allclose([ends.min(axis=0), ends.max(axis=0)], [low, high])


def test_the_section_of_a_plane_is_a_line_and_a_mesh_that_is_gone_is_reported() -> None:
    axes = Figure().add_subplot()
    plane = {"shape": "plane", "point": [7, 10, 5], "normal": [0, 4, -3]}
    draw_surroundings(axes, Run(Path(), {"vessel": plane}, None))
    (ends,) = axes.collections[0].get_segments()
    np.testing.assert_allclose((ends - [5, 10]) @ [-3, 4], 0.0, atol=1e-9)
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(2000.0)
    with pytest.raises(LogError, match="gone.obj: cannot be read"):
        draw_surroundings(axes, Run(Path(), {"vessel": {"shape": "mesh", "file": "gone.obj"}}, None))


def test_sides_of_a_tube_keep_their_distance() -> None:
    upper, lower = tube_sides(np.array(LUMEN["knots"], float), 8.0)
    np.testing.assert_allclose(upper, [[0, 8, -200], [0, 8, 92], [0, 100, 92]], atol=1e-9)
    np.testing.assert_allclose(lower, [[0, -8, -200], [0, -8, 108], [0, 100, 108]], atol=1e-9)
