"""What is read off at the hub and at the tip: way and turn, force and torque, tip and curvature over time."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from analysis.figures.style import add_caption, letter, new_figure, styled
from analysis.hub import HubLog


@styled
def draw_hub(log: HubLog) -> Figure:
    """The six panels of one run."""
    figure = new_figure(12.0, 7.0)
    way, turn, tip, force, torque, bend = figure.subplots(2, 3).flat
    way.plot(log.time, 1e3 * log.insertion)
    way.set(ylabel="insertion (mm)")
    turn.plot(log.time, np.degrees(log.turn), label="hub")
    turn.plot(log.time, np.degrees(log.turn + log.twist), "--", label="tip: hub and twist of the wire")
    turn.set(ylabel="turn (degrees)")
    turn.legend()
    for values, axis in zip((log.tip - log.tip[0]).T, "xyz", strict=True):
        tip.plot(log.time, values, label=f"${axis}$")
    tip.set(ylabel="way of the tip (units)")
    tip.legend()
    force.plot(log.time, log.force)
    force.set(ylabel="force of the hub (N)")
    torque.plot(log.time, 1e3 * log.torque)
    torque.set(ylabel="torque of the hub (mN m)")
    bend.plot(log.time, log.largest_curvature)
    bend.set(ylabel="largest curvature (1/m)")
    titles = ("how far the hub has gone", "how far it has turned", "where the tip is", "push", "torque", "bending")
    for axes, name, title in zip(figure.axes, "abcdef", titles, strict=True):
        axes.set(xlabel="time $t$ (s)")
        letter(axes, name, title)
    add_caption(figure, f"The hub and the tip in {log.time.size} entries up to t = {log.time[-1]:g} s: (a) way of the"
                " hub along its axis; (b) its turn, and that of the tip, the twist of all joints added; (c) way of the"
                " last sphere; (d, e) force and torque of the hub on the wire, a push and a turn to the right positive;"
                " (f) largest curvature of any joint.")
    return figure
