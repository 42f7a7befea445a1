"""An instrument and its bench tests in a bent tube."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from guidewire.benches.bent_tube import TubeTest
from guidewire.benches.elastica import rest_shape
from guidewire.benches.wire import Wire
from guidewire.figures.style import add_caption, new_figure, styled

_TIP = 0.12  # m of the tip that is drawn


@styled
def draw_instrument(name: str, wire: Wire, tube: TubeTest, smooth: TubeTest) -> Figure:
    """Return the tip at rest, stiffness along the wire, and the test in a bent tube with friction and without.

    Parameters
    ----------
    name : of the instrument.
    wire : as it is simulated.
    tube, smooth : with and without friction.
    """
    figure = new_figure(7.2, 5.4)
    (tip, stiffness), (push, turn) = figure.subplots(2, 2)
    shape = 1e3 * rest_shape(wire, min(_TIP, wire.length))
    tip.plot(shape[1], shape[0], linewidth=max(1.0, 1.5e3 * wire.radius))
    tip.set(title=f"{name}: tip at rest", xlabel="$z$ (mm)", ylabel="$y$ (mm)", aspect="equal")
    tip.set_ylim(min(shape[0].min(), -5.0) - 2.0, max(shape[0].max(), 5.0) + 2.0)
    from_tip = 1e3 * (wire.length - np.repeat(wire.ends, 2)[1:-1])
    shown = from_tip <= 1e3 * (wire.length - wire.shaft) + 50.0
    shown[np.flatnonzero(shown)[0] - 1 if not shown.all() else 0] = True
    for values, label in ((wire.bending, "$EI$"), (wire.torsional, "$GJ$")):
        stiffness.semilogy(from_tip[shown], np.repeat(values, 2)[shown], label=label)
    stiffness.set(title="stiffness", xlabel="distance from the tip (mm)", ylabel="N m$^2$",
                  xlim=(1e3 * (wire.length - wire.shaft) + 50.0, 0.0))
    stiffness.legend()
    for test, label in ((tube, "with its friction"), (smooth, "without friction")):
        pushed = test.hub.turn == 0.0
        push.plot(1e3 * test.hub.insertion[pushed], test.hub.force[pushed], label=label)
        turned = np.degrees(test.hub.turn[~pushed])
        turn.plot(turned, turned + np.degrees(test.hub.twist[~pushed] - test.hub.twist[pushed][-1]), label=label)
    push.set(title="force through the bent tube", xlabel="insertion (mm)", ylabel="force at the hub (N)")
    push.legend()
    turn.set(title="torque response", xlabel="turn of the hub (degrees)", ylabel="turn of the tip (degrees)")
    add_caption(figure, "Tip without loads; bending and torsional stiffness as simulated. The tube bends by 90 degrees"
                        " at a radius of 40 mm; after the push the hub makes three turns.")
    return figure
