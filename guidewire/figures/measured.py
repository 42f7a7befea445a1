"""A run beside a measurement: force of the hub, or shapes of the centreline."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from guidewire.figures.style import add_caption, letter, new_figure, styled
from guidewire.logs.measured import ComparedForce, ComparedShapes

_SHAPES = 4  # drawn at most, evenly over all


@styled
def draw_comparison(found: ComparedForce | ComparedShapes) -> Figure:
    """Return two panels for a force, three for shapes."""
    return _force(found) if isinstance(found, ComparedForce) else _shapes(found)


def _force(found: ComparedForce) -> Figure:
    figure = new_figure(10.0, 4.2)
    both, errors = figure.subplots(1, 2)
    both.plot(found.time, found.measured, ".", color="0.4", label="measured")
    both.plot(found.time, found.run, label="run")
    both.set(ylabel="force of the hub (N)")
    both.legend()
    errors.plot(found.time, found.errors, ".-")
    errors.axhline(0.0, color="0.3", linewidth=0.9)
    errors.set(ylabel="run less measurement (N)")
    for axes, name, title in zip((both, errors), "ab", ("force", "error"), strict=True):
        axes.set(xlabel="time $t$ (s)")
        letter(axes, name, title)
    add_caption(figure, f"A run beside a measurement, {found.summary()}.")
    return figure


def _shapes(found: ComparedShapes) -> Figure:
    figure = new_figure(12.0, 4.4)
    side, top, errors = figure.subplots(1, 3)
    shown = np.unique(np.linspace(0, len(found.time) - 1, min(_SHAPES, len(found.time))).round().astype(int))
    for color, k in enumerate(shown):
        for axes, across in ((side, 1), (top, 0)):
            axes.plot(found.run[k][:, 2], found.run[k][:, across], f"C{color}-", label=f"run, t = {found.time[k]:g} s")
            axes.plot(found.measured[k][:, 2], found.measured[k][:, across], f"C{color}o", fillstyle="none",
                      markersize=4, label="measured")
    for axes, name in ((side, "y"), (top, "x")):
        axes.set(xlabel="z (units)", ylabel=f"{name} (units)")
        axes.set_aspect("equal", adjustable="datalim")
    side.legend(fontsize="x-small")
    errors.plot(found.time, [np.max(d) for d in found.distances], "o-", fillstyle="none", label="largest")
    errors.plot(found.time, [np.sqrt(np.mean(d**2)) for d in found.distances], "s-", fillstyle="none", label="RMS")
    errors.set(xlabel="time $t$ (s)", ylabel="distance of points from the run (units)", ylim=(0.0, None))
    errors.legend()
    for axes, name, title in zip((side, top, errors), "abc", ("from the side", "from above", "distance"), strict=True):
        letter(axes, name, title)
    add_caption(figure, f"A run beside a measurement, {found.summary()}. Distances are those of measured points from "
                        "the line through the run's nodes at their time.")
    return figure
