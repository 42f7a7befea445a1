"""The chart: which settings stand on its front, and what pictures, tables and the page say."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from analysis.chart import coaxial, concentric, figure, material, page, tables, walls
from analysis.chart.points import LOST, METHODS, Charted, Point, Problem, Setting, _point, pareto
from analysis.chart.published import PUBLISHED
from analysis.validation import swing
from analysis.validation.wire import BASE
from guidewire.figures.style import CAPTION_ID, opening
from guidewire.logs.runs import Run
from guidewire.studies.table import Case

STABLE = 2e-7  # s
PROBLEMS = (*material.PROBLEMS, *walls.PROBLEMS, *coaxial.PROBLEMS)


def point(method: str, error: float, cost: float, outcome: str = "finished") -> Point:
    words = f"cost {cost:g}, <{error:g}>"
    return Point(Setting(method, words, f"c{cost:g}", Case(f"{method}-{cost}", {}, 3)), outcome, "because", error, cost,
                 0.9 * cost, 1.2 * cost, 1e-3 * cost, 0.5)


POINTS = (
    point("direct", 1e-3, 0.01), point("direct", 1e-2, 0.001), point("direct", 2e-2, 0.02), point("pbd", 0.2, 0.1),
    point("xpbd", 1e-4, 2.0), point("xpbd", math.nan, 3.0, "diverged"), point("pbd", 1e-6, 0.5, "passed a wall"),
)


def charted(*points: Point) -> Charted:
    return Charted(Problem("bar", "a bar", "of its length", lambda: None, {"explicit": "does not support walls"}),
                   points,
                   "a closed form", 0.1)


def test_the_front_is_what_no_other_setting_beats_in_both() -> None:
    front = charted(*POINTS).front()
    assert [(p.cost, p.error) for p in front] == [(0.001, 1e-2), (0.01, 1e-3), (2.0, 1e-4)]
    for p in POINTS:  # by the definition
        beaten = any(q.held and q.error <= p.error and q.cost <= p.cost and q is not p for q in POINTS)
        assert (p in front) == (p.held and not beaten)


def test_errors_of_rounding_are_alike() -> None:
    assert [p.cost for p in pareto([point("direct", 1e-9, 1.0), point("xpbd", 1e-15, 2.0)])] == [1.0]


@pytest.mark.parametrize("changed, outcome, held", [
    ({"passages": 1}, "passed a wall", False), ({"outcome": "diverged"}, "diverged", False), ({}, "finished", True),
])
def test_a_run_beyond_a_wall_or_lost_has_no_error_but_a_cost(tmp_path: Path, changed, outcome, held) -> None:
    summary = {"outcome": "finished", "reason": "said", "steps": 2, "inGameTime": 0.2, **changed}
    places = []
    for k, seconds in enumerate((0.4, 1.0, 0.2)):
        places.append(tmp_path / str(k))
        places[k].mkdir()
        (places[k] / "parameters.json").write_text('{"timeStep": 0.1}')
        (places[k] / "summary.json").write_text(json.dumps({**summary, "computationTime": seconds}))
        (places[k] / "load.json").write_text(json.dumps({"othersBusy": 0.1 * k}))
    run = Run(tmp_path, {"timeStep": 0.1}, summary, "key", repeat_folders=tuple(places))
    found = _point(Setting("direct", "", "", Case("key", {}, 3)), run, lambda _: 0.5)
    assert (found.outcome, found.held, found.reason) == (outcome, held, "said")
    assert (found.least, found.cost, found.most, found.others_busy) == (1.0, 2.0, 5.0, 0.2)
    assert found.step == pytest.approx(0.2)


def test_the_picture_shows_every_setting_and_names_those_on_the_front() -> None:
    drawn, caption = figure.draw_costs([charted(*POINTS)] * 2)
    axes = drawn.axes[0]
    shown = [x for line in axes.lines if line.get_marker() not in ("None", "x") for x in line.get_xdata()]
    assert sorted(shown) == sorted(p.cost for p in POINTS if p.held)
    crosses = [x for line in axes.lines if line.get_marker() == "x" for x in line.get_xdata()]
    assert sorted(crosses) == [0.5, 3.0]
    labels = {text.get_text() for text in axes.texts}
    assert {"c0.001", "c0.01", "c2", "real time"} <= labels
    assert axes.get_xlabel() == "wall time per simulated second (s per s)"
    assert axes.get_ylabel() == "error: of its length"
    assert "xpbd, cost 3, <nan> (a): diverged" in caption and "pbd, cost 0.5, <1e-06> (a): passed a wall" in caption
    assert "explicit does not support walls" in caption and "kept at most 0.50 processors busy" in caption
    assert next(t for t in drawn.texts if t.get_gid() == CAPTION_ID).get_text().split() == opening(caption).split()


def test_the_picture_of_steps_has_lines_for_loops() -> None:
    drawn, _ = figure.draw_steps([charted(*POINTS)])
    lines = {text.get_text() for text in drawn.axes[0].texts}
    assert {"90 Hz", "1 kHz"} <= lines
    at = [line.get_xdata()[0] for line in drawn.axes[0].lines if line.get_linestyle() == "--"]
    np.testing.assert_allclose(sorted(at), [1.0, 1000.0 / 90.0])


def test_what_others_state_stands_in_the_picture_of_steps_with_its_source_and_without_an_error() -> None:
    (arch,) = (one for one in walls.PROBLEMS if one.name == "insertion")
    pushed = replace(charted(*POINTS), problem=replace(arch, ask=lambda: None))
    drawn, caption = figure.draw_steps([charted(*POINTS), pushed])
    (one,) = PUBLISHED
    bars = [[line for line in axes.lines if line.get_marker() == "|"] for axes in drawn.axes[:2]]
    assert [len(own) for own in bars] == [0, 1]
    assert list(bars[1][0].get_xdata()) == pytest.approx([1.0, 2.0])    # ms: 500 to 1,000 answers a second
    assert f"published: {one.label}" in [text.get_text() for text in drawn.axes[1].texts]
    assert "(b) 2 x 512 elements" in caption and "arXiv:2509.04277" in caption and "no error is stated" in caption
    assert "Grey bars" not in figure.draw_steps([charted(*POINTS)])[1]


def test_tables_have_a_line_for_every_setting_and_say_which_to_take() -> None:
    found = [charted(*POINTS)]
    rows = list(csv.DictReader(io.StringIO(tables.as_csv(found))))
    assert [row["settings"] for row in rows] == [p.setting.words for p in POINTS]
    assert [row["error"] for row in rows if row["outcome"] in LOST] == ["", ""]
    assert sum(row["on the front"] == "true" for row in rows) == 3
    text = tables.as_markdown(found)
    assert len(re.findall(r"^\| (?:pbd|xpbd|direct) \|", text, re.MULTILINE)) == len(POINTS)
    best = tables.best_as_markdown([charted(*POINTS[:3])])
    quick, exact = "direct: cost 0.001, <0.01> (0.0010)", "direct: cost 0.01, <0.001> (0.010)"
    assert best.splitlines()[2] == f"| a bar | {quick} | {quick} | {exact} |"
    assert tables.best_as_markdown([charted(POINTS[3])]).count("none of them") == 3


class _Titles(HTMLParser):
    """What a page says where one points at it, and what it asks a network for."""

    def __init__(self) -> None:
        super().__init__()
        self.titles: list[str] = []
        self.asked: list[str] = []
        self._open = False

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self._open = tag == "title"
        self.asked += [value for name, value in attributes if name in ("src", "href")]

    def handle_data(self, text: str) -> None:
        if self._open:
            self.titles.append(text)
            self._open = False


def test_the_page_says_every_setting_and_needs_no_network() -> None:
    read = _Titles()
    read.feed(page.as_page([charted(*POINTS)]))
    for p in POINTS:
        assert sum(f"{p.setting.method}: {p.setting.words}\n" in title for title in read.titles) == 2  # cost, step
    assert read.asked == []


def test_every_problem_has_all_methods_or_says_why_not() -> None:
    twist = material.twist_asked(0.1, dict.fromkeys((8, 15, 30), STABLE))
    assert {setting.method for setting in twist.settings} == set(METHODS)
    for setting in twist.settings:  # gains stand between the same ends
        assert setting.case.overrides["distalEnd"] == "clamped" and "twistPerStep" not in setting.case.overrides
    assert len({problem.name for problem in PROBLEMS}) == len(PROBLEMS) == 14
    asked = walls._insertion()
    next(asked)
    with pytest.raises(StopIteration) as ended:
        asked.send({})
    assert {setting.method for setting in ended.value.value.settings} | set(walls.ABSENT) == set(METHODS)


def test_twist_of_gains_is_off_by_an_element_at_either_clamp() -> None:
    # Inner element j of n stands at (j - 1/2)/(n - 2) instead of (j + 1/2)/n: (n - 2 j - 1)/(n (n - 2)) apart.
    n = 30
    assert material.pbd_twist_error(n) == pytest.approx((n - 5) / (n * (n - 2)), rel=1e-12)


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.5])
def test_tubes_that_do_not_twist_are_arcs_of_their_mean_curvature(turn: float) -> None:
    curvature = np.array([1.0 + 0.6 * math.cos(turn), 0.6 * math.sin(turn), 0.0]) * 1.2 / 1.6
    size = float(np.linalg.norm(curvature))
    across = np.cross(curvature / size, [0.0, 0.0, 1.0])
    arc = (1.0 - math.cos(size)) / size * across + np.array([0.0, 0.0, math.sin(size) / size])
    np.testing.assert_allclose(concentric.turned_tip(0.6, -1.0 + 1e-9, 1.2, turn), arc, atol=1e-8)


def test_a_pendulum_keeps_its_energy_and_swings_as_a_stiff_rod_does() -> None:
    """Let go level, a stiff rod comes down with w^2 = 3 g/L sin t; its weight's work is what it moves with."""
    system = swing.pendulum(BASE, 9.81, 3)
    weight = BASE.line_density * 9.81 * BASE.length**3 / BASE.bending
    state = np.array([0.4, 0.01, -0.02, 1.0, 0.3, -0.2])
    step = 1e-6
    work = weight * step * _weight_rate(system, state)
    gained = system.energy(state + step * system.slope(0.0, state)) - system.energy(state)
    assert gained == pytest.approx(work, rel=1e-4)
    rigid = swing.pendulum(BASE, 9.81, 1)
    assert rigid.slope(0.0, np.zeros(2))[1] == pytest.approx(1.5 * weight, rel=1e-4)


def _weight_rate(system, state: np.ndarray) -> float:
    """How fast the middle of the weight comes down, by differences."""
    a, rate = np.split(state, 2)
    arc, weights = np.polynomial.legendre.leggauss(20)
    s = 0.5 * (arc + 1.0)
    low, high = (0.5 * weights @ [_depth(a + h * rate, x) for x in s] for h in (-1e-5, 1e-5))
    return float((high - low) / 2e-5)


def _depth(a: np.ndarray, end: float) -> float:
    """y at s/L = end, by a fine sum."""
    s = (np.arange(2000) + 0.5) / 2000 * end
    return float(np.mean(np.sin(np.cos(np.multiply.outer(s, np.pi * np.arange(len(a)))) @ a)) * end)
