"""Quantities at the hub and the tip over time: insertion and turn, force and torque, tip and curvature."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from guidewire.figures.style import add_caption, letter, new_figure, styled
from guidewire.logs.hub import HubLog


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
    bend.set(ylabel="largest curvature (1/m)")
    titles = ("insertion", "rotation", "tip", "force", "torque", "curvature")
    for axes, name, title in zip(figure.axes, "abcdef", titles, strict=True):
        axes.set(xlabel="time $t$ (s)")
        letter(axes, name, title)
    add_caption(figure, f"Hub and tip in {log.time.size} log entries up to t = {log.time[-1]:g} s: (a) insertion of the"
                " hub; (b) rotation of the hub, and of the tip, which is that of the hub plus the twist of all "
                "joints; (c) displacement of the last sphere; (d, e) force and torque of the hub on the wire, "
                "positive where it pushes and turns to the right; (f) largest curvature of any joint.")
    return figure
