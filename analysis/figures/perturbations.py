"""Figures 4.10 to 4.18 of the thesis: runs without a closed form, compared with a reference run.

Figure 4.10 is the reference of the transversal displacement. In the others a study varies one parameter; panels (a) to
(c) are the thesis's, (d) compares at equal step number instead of equal in-game time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure

from analysis.comparisons import ComparedRun, ComparisonTable, WireRun
from analysis.figures.perturbation_captions import perturbation_caption, reference_caption
from guidewire.figures.style import captioned, letter, new_figure, styled

_MOST_WIRES = 10  # drawn in one panel: more could not be distinguished
_COLOURS = "viridis"
_EARLY = 0.1  # part of the reference run that is drawn enlarged


@dataclass(frozen=True)
class PerturbationView:
    """How a study's parameter is drawn.

    Attributes
    ----------
    figure : number of the figure.
    key : the parameter.
    label : label of its axis, with the unit.
    logarithmic : whether its axis is.
    proportional : whether motions are scaled to the reference's displacement.
    """

    figure: str
    key: str
    label: str
    logarithmic: bool = False
    proportional: bool = False


VIEWS = {
    view.figure: view
    for first in (11, 15)
    for view in (
        PerturbationView(f"4.{first}", "constraintSolverSteps", "constraint solver steps $m$"),
        PerturbationView(f"4.{first + 1}", "timeStep", r"time step size $\Delta t$ (s)", logarithmic=True),
        PerturbationView(f"4.{first + 2}", "numberRodElements", "number of rod elements $n$"),
        PerturbationView(f"4.{first + 3}", "totalMass", "total mass $M$ (units of mass)", logarithmic=True),
    )
}
VIEWS["4.14b"] = PerturbationView(
    "4.14b", "displacement", r"displacement $\Delta y_0$ (units)", logarithmic=True, proportional=True
)


@styled
def draw_reference(runs: tuple[WireRun, ...]) -> tuple[Figure, str]:
    """Fig. 4.10: x, y and z of the reference's last sphere, and of the other runs of its study."""
    reference, *others = runs
    figure = new_figure(10.0, 5.0)
    panels = figure.subplot_mosaic([["x", "y", "z"], ["legend", "early y", "early z"]])
    for name, title in (("x", "x"), ("y", "y"), ("z", "z"), ("early y", "y"), ("early z", "z")):
        axes, early = panels[name], name.startswith("early")
        shown = f"the first {_EARLY:.0%} of the time" if early else "last sphere"
        letter(axes, "abcde"[list(panels).index(name) - early], f"{shown}, ${title}$")
        for wire, factor, style in reversed(_curves(reference, others)):
            span = (wire.motion.time * factor <= (_EARLY if early else 1.0) * reference.end)
            axes.plot(factor * wire.motion.time[span], _last_sphere(wire, "xyz".index(title))[span], **style,
                      label=parameters_label(wire, factor))
        axes.set(xlabel="in-game time $t$ (s)", ylabel=f"position ${title}_n$ (units)")
    panels["x"].set_ylim(-1.0, 1.0)
    panels["legend"].axis("off")
    handles, labels = panels["y"].get_legend_handles_labels()
    panels["legend"].legend(handles[::-1], labels[::-1], loc="center left")
    return captioned(figure, reference_caption(runs))


def _curves(reference: WireRun, others: Sequence[WireRun]) -> list[tuple[WireRun, float, dict]]:
    """Runs with a factor on their clock and the style of their line. The reference stands twice: without forces twice
    the time step makes the same positions at every step."""
    thin = {"linewidth": 0.8}
    return [
        (reference, 1.0, {"color": "C0"}),
        (reference, 2.0, {"color": "C3", "linestyle": "--", **thin}),
        *[(other, 1.0, {"color": f"C{k + 1}", **thin}) for k, other in enumerate(others)],
    ]


def parameters_label(wire: WireRun, time_step_factor: float = 1.0) -> str:
    """m, n and dt of a run."""
    run = wire.run
    return (
        f"$m$ = {run.number('constraintSolverSteps'):g}, $n$ = {run.number('numberRodElements'):g}, "
        rf"$\Delta t$ = {time_step_factor * run.number('timeStep'):g} s"
    )


def _last_sphere(wire: WireRun, axis: int) -> np.ndarray:
    return wire.motion.positions[:, -1, axis]


@styled
def draw_perturbation(view: PerturbationView, table: ComparisonTable) -> tuple[Figure, str]:
    """Four panels: shapes and distances along the wire at the end, mean distance at equal time and at equal step."""
    figure = new_figure(10.0, 5.6)
    panels = figure.subplot_mosaic([["a", "b"], ["c", "d"]])
    values = table.column("value")
    norm = (LogNorm if view.logarithmic else Normalize)(values.min(), values.max() if values.size > 1 else None)
    chosen = _spread_rows(table.rows, view.logarithmic)

    letter(panels["a"], "a", f"wire at $t$ = {table.reference.end:g} s")
    letter(panels["b"], "b", f"distance to the reference at $t$ = {table.reference.end:g} s")
    for row in chosen:
        colour = colormaps[_COLOURS](norm(row.value))
        panels["a"].plot(row.end_positions[:, 2], row.end_positions[:, 1], color=colour, linewidth=1.0)
        panels["b"].plot(row.arc_length, row.end_distance, color=colour, linewidth=1.0)
    end = table.reference.motion.positions[-1]
    panels["a"].plot(end[:, 2], end[:, 1], "--", color="0.1", label="reference")
    panels["a"].set(xlabel="$z$ (units)", ylabel="$y$ (units)")
    panels["a"].legend(loc="best")
    panels["b"].set(xlabel="arc length $s$ (units)", ylabel="distance (units)")
    figure.colorbar(ScalarMappable(norm, _COLOURS), ax=[panels["a"], panels["b"]], label=view.label, pad=0.01)

    letter(panels["c"], "c", "mean distance over the run, equal in-game time")
    for index, other in enumerate(table.others):
        distances = [row.other_distances[index] for row in table.rows]
        panels["c"].plot(values, distances, ("-", ":")[index % 2], color="0.6", linewidth=0.9,
                         label=f"reference: {parameters_label(other)}")
    letter(panels["d"], "d", f"mean distance over the first {table.common_steps} steps, equal step number")
    for name, column in (("c", "mean_distance"), ("d", "step_distance")):
        panels[name].plot(values, table.column(column), "-", marker=".", markersize=3.0,
                          label=f"reference: {parameters_label(table.reference)}")
        panels[name].scatter([row.value for row in chosen], [getattr(row, column) for row in chosen], s=26.0, zorder=3,
                             c=[colormaps[_COLOURS](norm(row.value)) for row in chosen], edgecolors="0.2",
                             linewidths=0.5, label="drawn in (a) and (b)")
        panels[name].set(xlabel=view.label, ylabel="mean distance (units)")
        if view.logarithmic:
            panels[name].set_xscale("log")
    top = 1.08 * max(panels[name].dataLim.y1 for name in "cd")
    for name in "cd":
        panels[name].set_ylim(0.0, top)
    _legend_above(panels["c"])
    return captioned(figure, perturbation_caption(view.figure, table))


def _legend_above(axes: Axes) -> None:
    """A legend in small print that takes the place where least is drawn."""
    axes.legend(loc="best", fontsize=7)


def _spread_rows(rows: tuple[ComparedRun, ...], logarithmic: bool) -> list[ComparedRun]:
    """Choose at most ten rows, as evenly spread over the parameter's axis as the study allows."""
    values = np.array([row.value for row in rows])
    places = np.log(values) if logarithmic else values
    wanted = np.linspace(places[0], places[-1], _MOST_WIRES)
    return [rows[index] for index in sorted({int(np.argmin(np.abs(places - place))) for place in wanted})]
