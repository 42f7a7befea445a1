"""A quantity of a study's runs over one of its parameters."""

from __future__ import annotations

from matplotlib import colormaps
from matplotlib.figure import Figure

from guidewire.figures.style import add_caption, new_figure, styled
from guidewire.logs.result_table import Curves

_DASHES = ("-", "--", ":", "-.")
_MARKERS = ("o", "s", "^", "D", "v")


@styled
def draw_curves(curves: Curves, x_label: str, logarithmic: str = "") -> Figure:
    """Return one panel: a colour for each value of the parameter that makes colours, dashes for what else varies.

    Parameters
    ----------
    curves : what is drawn.
    x_label : of the axis, with the unit.
    logarithmic : the axes that are: "", "x", "y" or "xy".
    """
    figure = new_figure(7.5, 4.8)
    axes = figure.subplots()
    colours = list(dict.fromkeys(line.by for line in curves.lines))
    others = list(dict.fromkeys(line.rest for line in curves.lines))
    for line in curves.lines:
        colour, other = colours.index(line.by), others.index(line.rest)
        name = ", ".join(filter(None, [f"{curves.by} = {line.by}" if curves.by else "", line.rest]))
        axes.plot(line.x, line.y, color=colormaps["viridis"](0.9 * colour / max(1, len(colours) - 1)),
                  linestyle=_DASHES[other % len(_DASHES)], marker=_MARKERS[other % len(_MARKERS)], markersize=4,
                  label=name or None)
        if any(line.error):
            axes.errorbar(line.x, line.y, line.error, fmt="none", ecolor="0.3", elinewidth=1.0, capsize=2.0)
    axes.set(xlabel=x_label, ylabel=curves.y_label)
    if "x" in logarithmic:
        axes.set_xscale("log")
    if "y" in logarithmic:
        axes.set_yscale("log")
    if len(curves.lines) > 1:
        axes.legend(fontsize="small", ncols=1 + len(curves.lines) // 10)
    lost = f" {curves.lost} more have no number there." if curves.lost else ""
    add_caption(figure, f"{curves.question + ' ' if curves.question else ''}{curves.y} over {curves.x}: one "
                        f"point a run, {curves.runs} runs.{lost}")
    return figure
