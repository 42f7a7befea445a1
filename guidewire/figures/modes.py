"""The lowest modes of a wire about its rest shape."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from guidewire.figures.style import add_caption, new_figure, styled

_REACH = 0.15  # of the wire's extent: how far the largest shift is drawn


@styled
def draw_modes(frequencies: Sequence[float], positions: np.ndarray, shapes: np.ndarray) -> Figure:
    """Return one panel a mode: the rest shape and the mode to both sides, in the plane in which they reach farthest.

    Parameters
    ----------
    frequencies : m of them, Hz.
    positions : (n+1, 3), the rest shape, units.
    shapes : (m, n+1, 3), shift of each sphere, the largest of length 1.
    """
    columns = min(3, len(frequencies))
    rows = -(-len(frequencies) // columns)
    figure = new_figure(3.4 * columns, 2.4 * rows)
    panels = list(figure.subplots(rows, columns, squeeze=False).flat)
    reach = _REACH * float(np.ptp(positions, axis=0).max())
    along = int(np.argmax(np.ptp(positions, axis=0)))
    for number, (axes, frequency, shape) in enumerate(zip(panels, frequencies, shapes, strict=False), 1):
        spread = np.ptp(shape, axis=0)
        spread[along] = -1.0
        across = int(np.argmax(spread))
        for sign in (1.0, -1.0):
            moved = positions + sign * reach * shape
            axes.plot(moved[:, along], moved[:, across], color="C0")
        axes.plot(positions[:, along], positions[:, across], "k--", linewidth=0.8)
        axes.set(title=f"{number}: {frequency:.4g} Hz", xlabel=f"${'xyz'[along]}$ (units)",
                 ylabel=f"${'xyz'[across]}$ (units)")
    for axes in panels[len(frequencies):]:
        axes.remove()
    add_caption(figure, "Lowest frequencies and shapes about the rest shape (dashed); the amplitudes are "
                "arbitrary. A round wire has each bending mode twice, in two directions.")
    return figure
