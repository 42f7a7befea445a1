"""A measurement beside the run with the values that were found, and what is left between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from guidewire.figures.style import add_caption, letter, new_figure, styled
from guidewire.identification.identified import Identified

_SHAPES = 5    # drawn at most


@styled
def draw_identified(found: Identified, names: Sequence[str]) -> Figure:
    """Return two panels a measurement: both curves, or values, and the residuals in their order.

    Parameters
    ----------
    names : of the measurements.
    """
    figure = new_figure(9.6, 3.6 * len(names))
    rows = figure.subplots(len(names), 2, squeeze=False)
    for k, (name, part, (both, left)) in enumerate(zip(names, found.residuals, rows)):
        sizes = np.linalg.norm(part.offsets, axis=1) if part.offsets.shape[1] > 1 else part.offsets[:, 0]
        if part.curves:
            for color, (points, curve) in enumerate(zip(part.points[:_SHAPES], part.curves)):
                across = _widest(points)
                both.plot(*curve[:, across].T, f"C{color}-", label="computed" if color == 0 else None)
                both.plot(*points[:, across].T, f"C{color}o", fillstyle="none", markersize=4,
                          label="measured" if color == 0 else None)
                both.set(xlabel=f"{'xyz'[across[0]]} (units)", ylabel=f"{'xyz'[across[1]]} (units)")
            both.set_aspect("equal", adjustable="datalim")
            both.legend()
            left.set(xlabel="measured point, from the proximal end", ylabel="distance from the curve")
        else:
            both.plot(sizes, ".-")
            both.set(xlabel="measured value", ylabel="measurement less run")
            left.set(xlabel="measured value", ylabel="measurement less run")
        left.plot(sizes, ".-", markersize=4)
        left.axhline(0.0, color="0.3", linewidth=0.9)
        letter(both, "abcdefgh"[2 * k % 8], name)
        letter(left, "abcdefgh"[(2 * k + 1) % 8], "residual")
    told = "; ".join(f"{one.key} = {one.value:.4g} ± {one.error:.2g} {one.unit}".rstrip() if one.value is not None
                     else f"{one.key}: not told" for one in found.values)
    add_caption(figure, f"Found in {found.runs} runs: {told}. RMS residuals: "
                        f"{', '.join(f'{rms:.3g}' for rms in found.rms)}.")
    return figure


def _widest(points: np.ndarray) -> list[int]:
    """Return the two axes along which points extend most."""
    return sorted(np.argsort(np.ptp(points, axis=0))[-2:].tolist())
