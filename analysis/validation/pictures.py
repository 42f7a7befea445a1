"""Common parts of the pictures of checks."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

MARKERS = "osD^vPX*"
_SLOPE_STYLES = (":", "--", "-.", (0, (1, 4)))
_TICKS = 8  # as many values are named on the axis one by one
SOLVER_MARKERS = {"direct": "o", "explicit": "s", "xpbd": "^", "pbd": "D"}


def shapes(
    references: Mapping[str, np.ndarray], measured: Mapping[str, np.ndarray], labels: tuple[str, str] = ("z/L", "-y/L")
) -> Callable[[Figure], None]:
    """Curves in a plane: references as lines, one of a single point as a cross, what was measured as points; arrays of
    shape (k, 2)."""

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        for name, curve in references.items():
            if len(curve) == 1:
                axes.plot(*curve.T, "+", color="0.3", markersize=14, zorder=3, label=name)
            else:
                axes.plot(*curve.T, "-", color="0.6", linewidth=2.5, zorder=1, label=name)
        for marker, (name, points) in zip(_cycle(len(measured)), measured.items()):
            axes.plot(*points.T, marker, markersize=3.5, fillstyle="none", label=name)
        axes.set_aspect("equal", adjustable="datalim")
        label(axes, labels[0], labels[1])

    return draw


def orders(
    x_label: str, y_label: str, series: Mapping[str, tuple[Sequence[float], Sequence[float]]],
    slopes: Sequence[tuple[float, str]] = (), marked: tuple[float, str] | None = None,
) -> Callable[[Figure], None]:
    """Errors over what they fall with, on logarithmic axes, with lines of given slope for comparison.

    Parameters
    ----------
    series : name to (x, error); errors that are 0 are left out.
    slopes : (power of x, name) of lines to compare with, through the middle of the picture's first points.
    marked : a level to mark, such as a gate, and its name.
    """

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        at: set[float] = set()
        for marker, (name, (x, y)) in zip(_cycle(len(series)), series.items()):
            shown = np.isfinite(y) & (np.asarray(y, dtype=float) > 0.0)
            if np.any(shown):
                at |= set(np.asarray(x)[shown].tolist())
                axes.plot(np.asarray(x)[shown], np.asarray(y)[shown], marker + "-", fillstyle="none", label=name)
        axes.set_xscale("log")
        axes.set_yscale("log")
        low, high = axes.get_xlim()
        bottom, top = axes.get_ylim()
        if marked is not None:
            bottom, top = min(bottom, 0.5 * marked[0]), max(top, 2.0 * marked[0])
        for style, (power, name) in zip(_SLOPE_STYLES, slopes):
            x = np.array([low, high])
            middle = np.sqrt(bottom * top) * (x / np.sqrt(low * high)) ** power
            axes.plot(x, middle, linestyle=style, color="0.5", linewidth=1.0, label=name)
        axes.set_ylim(bottom, top)
        axes.set_xlim(low, high)
        if marked is not None:
            axes.axhline(marked[0], linestyle="--", color="0.3", linewidth=1.0, label=marked[1])
        if 0 < len(at) <= _TICKS:
            axes.set_xticks(sorted(at), [f"{x:g}" for x in sorted(at)])
            axes.minorticks_off()
        label(axes, x_label, y_label)

    return draw


def marks(
    axes: Axes, series: Mapping[str, tuple[Sequence[float], Sequence[float]]], x_label: str, y_label: str
) -> None:
    """Adds points (x, y) by name, labels and a legend beside the axes."""
    for marker, (name, (x, y)) in zip(_cycle(len(series)), series.items()):
        axes.plot(x, y, marker, fillstyle="none", label=name)
    label(axes, x_label, y_label)


def label(axes: Axes, x_label: str, y_label: str) -> None:
    """What the axes show, and a legend beside them, where it hides nothing."""
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.legend(loc="center left", bbox_to_anchor=(1.02, 0.5))


def _cycle(count: int) -> list[str]:
    return [MARKERS[k % len(MARKERS)] for k in range(count)]
