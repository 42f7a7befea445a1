"""Figures 4.5 to 4.9 of the thesis: relaxation and cost of the longitudinal run against one parameter."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from analysis.figures.sweep_captions import sweep_caption
from analysis.slowest_mode import SlowestMode
from analysis.tables import Spread, StudyRow, StudyTable
from guidewire.figures.style import captioned, letter, new_figure, styled

_FEW_DECADES = 30.0  # ratio up to which powers of ten alone are too few ticks


@dataclass(frozen=True)
class SweepView:
    """How a study's parameter is drawn.

    Attributes
    ----------
    figure : number of the figure in the thesis.
    key : the parameter.
    label : label of the horizontal axis, with the unit.
    logarithmic : whether the horizontal axis and the times on the vertical ones are.
    marked : a value to mark by a dashed line.
    """

    figure: str
    key: str
    label: str
    logarithmic: bool = False
    marked: float | None = None


VIEWS = {
    view.figure: view
    for view in (
        SweepView("4.5", "constraintSolverSteps", "constraint solver steps $m$"),
        SweepView("4.6", "numberRodElements", "number of rod elements $n$", marked=30),
        SweepView("4.7", "displacement", r"displacement $\Delta z_0$ (units)"),
        SweepView("4.8", "timeStep", r"time step size $\Delta t$ (s)", logarithmic=True),
        SweepView("4.9", "totalMass", "total mass $M$ (units of mass)", logarithmic=True),
    )
}


@styled
def draw_sweep(view: SweepView, table: StudyTable) -> tuple[Figure, str]:
    """Five panels: tau, step time, in-game time and computation time to the steady state, total error at the end."""
    figure = new_figure(10.0, 5.0)
    panels = figure.subplot_mosaic([["a", "b", "c"], ["d", "e", "legend"]])
    values = table.column("value")

    for name, title, column, unit in (
        ("a", "relaxation time", "relaxation.time", r"relaxation time $\tau$ (s)"),
        ("c", "in-game time to steady state", "steady_state_time", "in-game time (s)"),
        ("e", "total error at the end", "total_error", r"total error $\Delta_x$ (units)"),
    ):
        letter(panels[name], name, title)
        panels[name].plot(values, table.column(column), "o-")
        panels[name].set_ylabel(unit)
    panels["e"].set_yscale("log")
    for name, title, timed, unit in (
        ("b", "average step time", lambda row: row.step_time, "real time per step (ms)"),
        ("d", "computation time to steady state", lambda row: row.computation_time, "real time (s)"),
    ):
        letter(panels[name], name, title)
        _draw_spread(panels[name], table, timed)
        panels[name].set_ylabel(unit)

    modes = [SlowestMode.of(row.run) for row in table.rows]
    for axes, times in (
        (panels["a"], [mode.relaxation_time for mode in modes]),
        (panels["c"], [mode.steady_state_time for mode in modes]),
    ):
        axes.plot(values, times, "-", color="0.6", linewidth=3.0, zorder=1, label="slowest mode in closed form")

    for name in "abcde":
        _dress(panels[name], view, on_log=name in "ac")
    _draw_legend(panels["legend"], panels)
    return captioned(figure, sweep_caption(view.figure, table))


def _draw_spread(axes: Axes, table: StudyTable, choose: Callable[[StudyRow], Spread | None]) -> None:
    """Medians as points and the range over the repeats as bars; an empty panel says why it is empty."""
    timed = [(row.value, choose(row)) for row in table.rows]
    timed = [(value, spread) for value, spread in timed if spread is not None]
    if not timed:
        axes.text(0.5, 0.5, "no timed repeats", transform=axes.transAxes, ha="center", color="0.4")
        return
    values, spreads = zip(*timed)
    medians = np.array([spread.median for spread in spreads])
    bars = [[s.median - s.lowest for s in spreads], [s.highest - s.median for s in spreads]]
    repeats = sorted({spread.count for spread in spreads})
    counted = f"{repeats[0]}" if len(repeats) == 1 else f"{repeats[0]} to {repeats[-1]}"
    axes.errorbar(
        values, medians, yerr=bars, fmt="o-", color="C1", ecolor="0.3", capsize=2.5, elinewidth=0.9,
        label=f"median and range of {counted} timed runs",
    )


def _dress(axes: Axes, view: SweepView, on_log: bool) -> None:
    """Labels and scales: logarithmic where the sweep spreads the values over decades, else from 0."""
    axes.set_xlabel(view.label)
    if view.logarithmic:
        axes.set_xscale("log")
    if view.logarithmic and on_log:
        axes.set_yscale("log")
    low, high = axes.dataLim.intervaly
    if axes.get_yscale() == "linear":
        axes.set_ylim(0.0, 1.1 * high if high > 0.0 else 1.0)
    elif low < high < _FEW_DECADES * low:
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axes.yaxis.set_minor_formatter(NullFormatter())
    if view.marked is not None:
        axes.axvline(
            view.marked, linestyle="--", color="0.3", linewidth=1.0, label=f"$n$ = {view.marked:g}, sphere on sphere"
        )


def _draw_legend(axes: Axes, panels: dict[str, Axes]) -> None:
    """One legend for all panels, in the place that no panel takes."""
    axes.axis("off")
    entries: dict[str, object] = {}
    for name in "abcde":
        for handle, label in zip(*panels[name].get_legend_handles_labels()):
            entries.setdefault(label, handle)
    if entries:
        axes.legend(entries.values(), entries.keys(), loc="center left")
