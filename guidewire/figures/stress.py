"""Stresses along the wire: the last shape coloured by curvature, force and couple over arc length and time."""

from __future__ import annotations

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from guidewire.figures.style import add_caption, letter, new_figure, styled
from guidewire.logs.stress import StressLog

_MOST_TIMES = 1000  # columns of a map: more would not be seen


@styled
def draw_stress(log: StressLog) -> Figure:
    """Return the four panels of one run."""
    figure = new_figure(10.0, 7.0)
    shape, energy, force, couple = figure.subplots(2, 2).flat
    _draw_shape(figure, shape, log)
    for row, name in zip(log.energy.T, ("kinetic", "elastic", "potential"), strict=True):
        energy.plot(log.time, row, label=name)
    energy.plot(log.time, log.energy.sum(axis=1), "k--", label="sum")
    energy.set(xlabel="time $t$ (s)", ylabel="energy (J)")
    energy.legend()
    arc = log.arc_length
    _draw_map(figure, force, log.time, arc, np.linalg.norm(log.force, axis=2), "force (N)")
    borders = np.concatenate(([arc[0]], 0.5 * (arc[1:] + arc[:-1]), [arc[-1]]))
    _draw_map(figure, couple, log.time, borders, np.linalg.norm(log.couple, axis=2), "couple (N m)")
    titles = ("last shape", "energies", "force along the wire", "couple along the wire")
    for axes, name, title in zip((shape, energy, force, couple), "abcd", titles, strict=True):
        letter(axes, name, title)
    add_caption(figure, f"Stresses and strains in {log.time.size} entries up to t = {log.time[-1]:g} s: (a) the last"
                " shape in the two directions in which it reaches farthest, coloured by the size of its curvature; (b)"
                " energies, the potential one that of the loads; (c, d) size of the force in each element and of the"
                " couple at each joint over the arc length at the start.")
    return figure


def _draw_shape(figure: Figure, axes, log: StressLog) -> None:
    last = log.positions[-1]
    across, along = np.argsort(np.ptp(last, axis=0))[1:]
    points = last[:, [along, across]]
    segments = np.stack((points[:-1], points[1:]), axis=1)
    bending = log.bending[-1]
    lines = LineCollection(segments, array=0.5 * (bending[:-1] + bending[1:]), linewidths=3.0)
    axes.add_collection(lines)
    axes.autoscale()
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel=f"${'xyz'[along]}$ (units)", ylabel=f"${'xyz'[across]}$ (units)")
    figure.colorbar(lines, ax=axes, label="curvature (rad/m)")


def _draw_map(figure: Figure, axes, time: np.ndarray, borders: np.ndarray, values: np.ndarray, label: str) -> None:
    step = max(1, -(-time.size // _MOST_TIMES))
    kept = time[::step]
    width = np.diff(kept)[-1] if kept.size > 1 else 1.0
    edges = np.append(kept, kept[-1] + width)
    mesh = axes.pcolormesh(edges, borders, values[::step].T)
    axes.set(xlabel="time $t$ (s)", ylabel="arc length (units)")
    figure.colorbar(mesh, ax=axes, label=label)
