"""The wall and the vessel as a picture, with the wire at several times."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.comparisons import WireRun
from analysis.figures.outlines import draw_surroundings
from analysis.gain import ElementTable
from guidewire.figures.style import captioned, letter, new_figure, styled
from guidewire.figures.wording import number

_ELEMENTS = 30
_MOMENTS = 4
_LAST_IN_VESSEL = 300  # steps: before the wire buckles


@styled
def draw_scenes(wall: ElementTable, vessel: ElementTable) -> tuple[Figure, str]:
    """Return the push against the wall and the insertion into the vessel, with element contact."""
    figure = new_figure(10.0, 5.4)
    panels = figure.subplots(2, 1)
    wires = [_wire(table) for table in (wall, vessel)]
    lasts = [len(wires[0].motion.steps) - 1, min(len(wires[1].motion.steps) - 1, _LAST_IN_VESSEL)]
    for axes, name, title, wire, last in zip(panels, "ab", ("push against a wall", "insertion"), wires, lasts):
        letter(axes, name, title)
        _draw(axes, wire, last)
    return captioned(figure, (
        f"Figure scenes. A wire of {wires[0].run.number('numberRodElements'):g} rod elements, cut by the plane x = 0. "
        f"(a) Its first sphere is pushed by {wires[0].run.number('displacement'):g} units and held; the tip slides up "
        "the wall. (b) It is pushed along its first element by "
        f"{lasts[1] * wires[1].run.number('displacementPerStep'):g} units into an arch with a branch. The deepest that "
        "the wire's surface reaches into the wall in these runs is "
        f"{number(wires[0].run.measured('maxPenetration'), 2)} and "
        f"{number(wires[1].run.measured('maxPenetration'), 2)} units of r = {wires[0].run.number('sphereRadius'):g}."
    ))


def _wire(table: ElementTable) -> WireRun:
    """Return the run with element contact whose n is nearest to the thesis's default."""
    return min(table.of("barycentric"), key=lambda row: abs(row.elements - _ELEMENTS)).wire


def _draw(axes: Axes, wire: WireRun, last: int) -> None:
    draw_surroundings(axes, wire.run)
    entries = np.linspace(0, last, _MOMENTS).astype(int)
    for entry, shade in zip(entries, np.linspace(0.85, 0.1, _MOMENTS)):
        points = wire.motion.positions[entry]
        axes.plot(points[:, 2], points[:, 1], "-", marker=".", markersize=3.0, color=colormaps["viridis"](shade),
                  label=f"step {wire.motion.steps[entry]}")
    z, y = wire.motion.positions[entries][..., 2], wire.motion.positions[entries][..., 1]
    axes.set_xlim(z.min() - 20.0, z.max() + 30.0)
    axes.set_ylim(y.min() - 30.0, y.max() + 30.0)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="$z$ (units)", ylabel="$y$ (units)")
    axes.legend(loc="upper left", fontsize=7)
