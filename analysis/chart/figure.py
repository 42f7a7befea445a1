"""The chart as pictures: one panel per problem, and a small version for the README."""

from __future__ import annotations

import math
import re
import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox

from analysis.chart.points import (
    FRAME, METHODS, TICK, Charted, Cost, milliseconds, repeats_in_words, seconds,
)
from analysis.chart.published import PUBLISHED
from analysis.validation.pictures import SOLVER_MARKERS
from guidewire.figures.style import captioned, letter, new_figure, styled
from guidewire.figures.wording import beside, number

COLOURS = dict(zip(METHODS, ("C0", "C1", "C2", "C3")))
_COLUMNS = 4
_LETTERS = "abcdefghijklmnopqrstuvwxyz"
_TITLE_WIDTH = 34  # characters of a small panel's title
_NO_BREAK = re.compile(r"(?<=\bk) | (?==)|(?<==) ")  # in k L = 1
_FRAME_FACTOR = 2.5  # factor between the outermost points and the frame
_OFFSETS = ((4, 3), (4, -8), (-4, 3), (-4, -8), (4, 10), (-4, 10), (4, -15), (-4, -15))  # points, of a label
_PADDING = 2.0  # pixels around a label
_COST = "wall time per simulated second (s per s)"
_STEP = "wall time of one time step (ms)"


@styled
def draw_costs(found: Sequence[Charted]) -> tuple[Figure, str]:
    """Error against wall time per simulated second."""
    lines = ((1.0, "real time"),)
    figure = _panels(found, seconds, _COST, lines)
    return captioned(figure, (
        "Figure chart. Error against cost of every method. Cost: wall time of the steps per "
        f"simulated second, one thread, median of timed runs made one at a time ({repeats_in_words()}), "
        f"{_load(found)}. Markers: "
        "pbd diamonds, xpbd triangles, explicit squares, direct circles. Thick grey line: the Pareto front, which no "
        "other setting beats in both error and cost; its settings are labelled where they fit (n elements, time "
        "step or substep, m iterations), and all of them in the table and on the page beside this picture. Vertical "
        "line: real time, 1 s per s. Crosses at the "
        f"upper edge: settings that gave no result, at their cost. {_lost(found)}{_references(found)} pbd has no "
        f"material: {_gains(found)} On the bar its stretch stiffness is that of the springs; in the arch neither "
        f"stiffness nor mass affects the shape. {_absent(found)}"
    ))


@styled
def draw_steps(found: Sequence[Charted]) -> tuple[Figure, str]:
    """Error against the wall time of a step."""
    lines = ((1e3 * FRAME, "90 Hz"), (1e3 * TICK, "1 kHz"))
    figure = _panels(found, milliseconds, _STEP, lines)
    for axes, charted in zip(figure.axes, found):
        _draw_published(axes, charted)
    return captioned(figure, (
        "Figure chart, error against latency: wall time of one time step, of the same runs. A display of 90 Hz has "
        f"{number(1e3 * FRAME, 3)} ms for a step, a haptic loop of 1 kHz one ms (vertical lines). A step below the "
        "line is fast enough for its loop; whether the simulation then runs in real time is shown by the chart of "
        f"cost.{_published(found)}"
    ))


@styled
def draw_summary(found: Sequence[Charted]) -> Figure:
    """Return the front of each method and that of all."""
    rows = math.ceil(len(found) / _COLUMNS)
    figure = new_figure(10.0, 2.3 * rows)
    panels = figure.subplots(rows, _COLUMNS, squeeze=False).ravel()
    for axes in panels[len(found):]:
        axes.axis("off")
    for axes, charted in zip(panels, found):
        _draw_front(axes, charted, seconds)
        for method in METHODS:
            front = charted.front(method=method)
            if front:
                axes.plot([p.cost for p in front], [p.drawn for p in front], SOLVER_MARKERS[method] + "-",
                          color=COLOURS[method], fillstyle="none", markersize=4, linewidth=0.9, label=method)
        axes.axvline(1.0, color="0.3", linestyle="--", linewidth=0.8)
        axes.set(xscale="log", yscale="log")
        axes.set_title(textwrap.fill(_NO_BREAK.sub("\N{NO-BREAK SPACE}", charted.problem.title), _TITLE_WIDTH),
                       fontsize=8)
        axes.tick_params(labelsize=6)
    figure.supxlabel(f"{_COST}; dashed: real time", fontsize=8)
    figure.supylabel("error (1)", fontsize=8)
    figure.axes[0].legend(fontsize=6)
    return figure


def _panels(found: Sequence[Charted], cost: Cost, label: str,
            lines: Sequence[tuple[float, str]]) -> Figure:
    rows = math.ceil(len(found) / _COLUMNS)
    figure = new_figure(16.0, 4.4 * rows)
    panels = figure.subplots(rows, _COLUMNS, squeeze=False).ravel()
    for k, (axes, charted) in enumerate(zip(panels, found)):
        letter(axes, _LETTERS[k], charted.problem.title)
        _draw_panel(axes, charted, cost, lines)
        axes.set(xlabel=label, ylabel=f"error: {charted.problem.error}")
    for axes in panels[len(found):]:
        axes.axis("off")
    named = {name: handle for axes in panels for handle, name in zip(*axes.get_legend_handles_labels())}
    panels[0].legend(named.values(), named.keys(), fontsize=7)
    figure.draw_without_rendering()
    for axes, charted in zip(panels, found):
        _write_labels(axes, [(cost(p), p.drawn, p.setting.label) for p in charted.front(cost)],
                      [(cost(p), p.drawn) for p in charted.points if p.held])
    return figure


def _draw_panel(axes: Axes, charted: Charted, cost: Cost,
                lines: Sequence[tuple[float, str]]) -> None:
    _draw_front(axes, charted, cost)
    for method in METHODS:
        held = [(cost(p), p.drawn) for p in charted.points if p.held and p.setting.method == method]
        if held:
            axes.plot(*np.transpose(held), SOLVER_MARKERS[method], color=COLOURS[method], fillstyle="none",
                      label=method)
    axes.set(xscale="log", yscale="log")
    costs, errors = [cost(p) for p in charted.points], [p.drawn for p in charted.points if p.held]
    axes.set_xlim(min(*costs, *(x for x, _ in lines)) / _FRAME_FACTOR,
                  max(*costs, *(x for x, _ in lines)) * _FRAME_FACTOR)
    axes.set_ylim(min(errors) / _FRAME_FACTOR, max(errors) * _FRAME_FACTOR**2)
    for x, name in lines:
        axes.axvline(x, color="0.3", linestyle="--", linewidth=0.8)
        axes.annotate(name, (x, 0.01), xycoords=("data", "axes fraction"), rotation=90, fontsize=6, ha="right")
    for method in METHODS:
        lost = [cost(p) for p in charted.points if not p.held and p.setting.method == method]
        axes.plot(lost, [0.97] * len(lost), "x", color=COLOURS[method], transform=axes.get_xaxis_transform(),
                  label=f"{method}, lost" if lost else None)


def _draw_published(axes: Axes, charted: Charted) -> None:
    """Bars at the upper edge, below lost settings: costs that others state, without an error."""
    own = [one for one in PUBLISHED if one.problem == charted.problem.name]
    for k, one in enumerate(own):
        height = 0.9 - 0.06 * k
        axes.plot([1e3 * step for step in one.steps], [height] * 2, "-|", color="0.4", linewidth=2.0,
                  transform=axes.get_xaxis_transform())
        axes.annotate(f"published: {one.label}", (1e3 * one.steps[0], height), (-4, 0), textcoords="offset points",
                      xycoords=axes.get_xaxis_transform(), fontsize=5.5, ha="right", va="center")


def _published(found: Sequence[Charted]) -> str:
    """Say where the bars of others come from."""
    names = [charted.problem.name for charted in found]
    listed = [f"({_LETTERS[names.index(one.problem)]}) {one.label}: {one.says} [{one.source}]"
            for one in PUBLISHED if one.problem in names]
    return f" Grey bars: wall times published by others without an error. {'; '.join(listed)}." if listed else ""


def _draw_front(axes: Axes, charted: Charted, cost: Cost) -> None:
    front = [(cost(p), p.drawn) for p in charted.front(cost)]
    axes.plot(*np.transpose(front), "-", color="0.8", linewidth=4.0, zorder=0, solid_capstyle="round")


def _write_labels(axes: Axes, labels: Sequence[tuple[float, float, str]],
                  points: Sequence[tuple[float, float]]) -> None:
    """Texts beside points, each at the first place where it covers neither a point nor another text, or nowhere."""
    renderer = axes.figure.canvas.get_renderer()
    frame = axes.get_window_extent(renderer)
    dots = axes.transData.transform(points)
    legend = axes.get_legend()
    taken: list[Bbox] = [] if legend is None else [legend.get_window_extent(renderer)]
    for x, y, text in labels:
        for right, up in _OFFSETS:
            written = axes.annotate(text, (x, y), (right, up), textcoords="offset points", fontsize=5.5,
                                    ha="left" if right > 0 else "right", in_layout=False)
            box = written.get_window_extent(renderer).padded(_PADDING)
            inside = frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1
            if inside and not any(box.overlaps(other) for other in taken) and not any(box.contains(*p) for p in dots):
                taken.append(box)
                break
            written.remove()


def _load(found: Sequence[Charted]) -> str:
    return beside([point.others_busy for charted in found for point in charted.points])


def _lost(found: Sequence[Charted]) -> str:
    """Which settings have no answer."""
    lost = [f"{p.setting.method}, {p.setting.words} ({_LETTERS[k]}): {p.outcome}"
            for k, charted in enumerate(found) for p in charted.points if not p.held]
    return f"Without a result: {'; '.join(lost)}. " if lost else ""


def _references(found: Sequence[Charted]) -> str:
    listed = "; ".join(f"({_LETTERS[k]}) {charted.reference}" for k, charted in enumerate(found))
    return f"References: {listed}."


def _gains(found: Sequence[Charted]) -> str:
    gains = sorted({charted.gain for charted in found if charted.gain is not None})
    listed = ", ".join(number(gain, 4) for gain in gains)
    return (f"its bendStiffness ({listed}) is tuned so that each wire sags as the "
            "material does at m = 500, n = 30, dt = 1 ms; other pbd points have the same stiffness.")


def _absent(found: Sequence[Charted]) -> str:
    """Which methods are missing where, and why."""
    places: dict[tuple[str, str], str] = {}
    for k, charted in enumerate(found):
        for method, reason in charted.problem.absent.items():
            places[method, reason] = places.get((method, reason), "") + _LETTERS[k]
    listed = "; ".join(f"{method} {reason} ({', '.join(where)})" for (method, reason), where in places.items())
    return f"Missing: {listed}." if listed else ""
