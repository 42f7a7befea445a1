"""Quantities at the hub and the tip over time: insertion and turn, force and torque, tip and curvature."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from guidewire.figures.style import add_caption, letter, new_figure, styled
from guidewire.logs.hub import HubCurve, HubLog


@styled
def draw_hub(log: HubLog) -> Figure:
    """Return the six panels of one run."""
    figure = new_figure(12.0, 7.0)
    insertion, turn, tip, force, torque, bend = figure.subplots(2, 3).flat
    insertion.plot(log.time, 1e3 * log.insertion)
    insertion.set(ylabel="insertion (mm)")
    turn.plot(log.time, np.degrees(log.turn), label="hub")
    turn.plot(log.time, np.degrees(log.turn + log.twist), "--", label="tip (hub plus twist of the wire)")
    turn.set(ylabel="rotation (degrees)")
    turn.legend()
    for values, axis in zip((log.tip - log.tip[0]).T, "xyz", strict=True):
        tip.plot(log.time, values, label=f"${axis}$")
    tip.set(ylabel="displacement of the tip (units)")
    tip.legend()
    force.plot(log.time, log.force)
    force.set(ylabel="force at the hub (N)")
    torque.plot(log.time, 1e3 * log.torque)
    torque.set(ylabel="torque at the hub (mN m)")
    bend.plot(log.time, log.largest_curvature)
    bend.set(ylabel="largest curvature (rad/m)")
    titles = ("insertion", "rotation", "tip", "force", "torque", "curvature")
    for axes, name, title in zip(figure.axes, "abcdef", titles, strict=True):
        axes.set(xlabel="time $t$ (s)")
        letter(axes, name, title)
    add_caption(figure, f"Hub and tip in {log.time.size} log entries up to t = {log.time[-1]:g} s: (a) insertion of the"
                " hub; (b) rotation of the hub, and of the tip, which is that of the hub plus the twist of all "
                "joints; (c) displacement of the last sphere; (d, e) force and torque of the hub on the wire, "
                "positive where it pushes and turns to the right; (f) largest curvature of any joint.")
    return figure


OVER = {"time": ("time $t$ (s)", 1.0), "insertion": ("insertion (mm)", 1e3), "turn": ("rotation of the hub (degrees)",
                                                                                     180.0 / np.pi)}
_QUANTITIES = (("force", "force at the hub (N)", 1.0), ("torque", "torque at the hub (mN m)", 1e3))


@styled
def draw_hubs(curves: Sequence[HubCurve], over: str) -> Figure:
    """Return force and torque of several runs in one picture, each with the band of its other runs.

    Parameters
    ----------
    curves : the runs.
    over : "time", "insertion" or "turn".
    """
    figure = new_figure(9.0, 7.0)
    label, factor = OVER[over]
    sudden = False
    panels = zip(figure.subplots(2, 1, sharex=True), _QUANTITIES, "ab", strict=True)
    for axes, (quantity, y_label, unit), name in panels:
        for curve in curves:
            along, values = factor * getattr(curve.log, over), unit * getattr(curve.log, quantity)
            (line,) = axes.plot(along, values, label=curve.name)
            if curve.others:
                axes.fill_between(along, *(unit * curve.band(quantity)), color=line.get_color(), alpha=0.25,
                                  linewidth=0.0)
            largest = int(np.argmax(np.abs(values)))
            if largest <= 1 < len(values):
                sudden = True
                axes.plot(along[largest], values[largest], "x", color=line.get_color())
        axes.set(ylabel=y_label, xlabel=label)
        letter(axes, name, quantity)
    figure.axes[0].legend()
    bands = [f"{curve.name}: {len(curve.others) + 1} runs" for curve in curves if curve.others]
    add_caption(figure, f"Hub of {len(curves)} runs over the {over} of each: (a) force, positive where the hub pushes; "
                "(b) torque." + (f" Bands go from the lowest to the highest at each time ({', '.join(bands)})."
                                 if bands else "")
                + (" A cross is a largest value in the first step, where a start is sudden." if sudden else ""))
    return figure
