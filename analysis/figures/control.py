"""Control of the wire (thesis, 3.1.5, outlook): what moves the first sphere in a bend, a twist that reaches the tip."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.comparisons import WireRun, read_wire
from analysis.figures.outlines import draw_surroundings
from analysis.twist import Twist, read_twist
from guidewire.figures.style import captioned, letter, new_figure, styled
from guidewire.figures.wording import number, percent, span
from guidewire.logs.logs import LogError
from guidewire.logs.runs import read_study

_DRIVES = {
    "axis-published": ("fixed axis, as published", "C3"),
    "axis": ("fixed axis", "C1"),
    "push": ("along the first element", "C0"),
    "force": ("force on the first sphere", "C2"),
}


@dataclass(frozen=True)
class DriveRow:
    """One way to move the first sphere.

    Attributes
    ----------
    key : name of the run.
    wire : its motion.
    first_off, tip_along : (k,), distance of the first sphere from the lumen's middle line, and how far the tip has come
        along that line, in units.
    """

    key: str
    wire: WireRun
    first_off: np.ndarray
    tip_along: np.ndarray


def read_drives(folder: Path) -> list[DriveRow]:
    """Return the runs of the study of drives, all in one lumen.

    Raises
    ------
    LogError : a file cannot be read, or a run is missing.
    """
    study = read_study(folder)
    rows = []
    for run in study.untimed:
        wire = read_wire(run)
        knots = np.array(run.value("vessel")["knots"], float)
        along = along_line(wire.motion.positions[:, -1], knots)[0]
        rows.append(DriveRow(run.key, wire, along_line(wire.motion.positions[:, 0], knots)[1], along - along[0]))
    if {row.key for row in rows} != set(_DRIVES):
        raise LogError(f"{folder}: not all runs of this study have a log")
    return rows


def along_line(points: np.ndarray, knots: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nearest place on a polyline: arc length from its first knot and distance, for points (p, 3), in units."""
    axes = np.diff(knots, axis=0)
    lengths = np.linalg.norm(axes, axis=1)
    starts = np.concatenate([[0.0], np.cumsum(lengths)])[:-1]
    offsets = points[:, None] - knots[:-1]
    fraction = np.clip(np.einsum("pki,ki->pk", offsets, axes) / lengths**2, 0.0, 1.0)
    distances = np.linalg.norm(offsets - fraction[..., None] * axes, axis=-1)
    best = distances.argmin(axis=1)
    rows = np.arange(len(points))
    return starts[best] + fraction[rows, best] * lengths[best], distances[rows, best]


@styled
def draw_drives(rows: list[DriveRow]) -> tuple[Figure, str]:
    """Return the wires at the end, the first sphere's distance from the middle line and the tip's position along it."""
    figure = new_figure(10.0, 6.2)
    panels = figure.subplot_mosaic([["a", "b", "c", "d"], ["e", "e", "f", "f"]])
    by_key = {row.key: row for row in rows}
    for name, (key, (label, colour)) in zip("abcd", _DRIVES.items()):
        letter(panels[name], name, label)
        _draw_wire(panels[name], by_key[key].wire, colour)
    letter(panels["e"], "e", "first sphere's distance from the middle line")
    letter(panels["f"], "f", "tip's displacement along the centreline")
    for key, (label, colour) in _DRIVES.items():
        row = by_key[key]
        steps = row.wire.motion.steps
        panels["e"].plot(steps, row.first_off, color=colour, label=label)
        panels["f"].plot(steps, row.tip_along, color=colour, label=label)
    run = by_key["push"].wire.run
    steps = by_key["push"].wire.motion.steps
    panels["e"].axhline(run.value("vessel")["radius"], color="0.3", linestyle="--", linewidth=1.0, label="wall")
    panels["f"].plot(steps, steps * run.number("displacementPerStep"), color="0.3", linestyle="--", linewidth=1.0,
                     label="motion asked for")
    panels["e"].set(xlabel="number of steps", ylabel="distance (units)")
    panels["f"].set(xlabel="number of steps", ylabel="displacement (units)")
    for name in "ef":
        panels[name].legend(loc="upper left", fontsize=7)
    return captioned(figure, drives_caption(by_key))


def _draw_wire(axes: Axes, wire: WireRun, colour: str) -> None:
    first, last = wire.motion.positions[:, 0], wire.motion.positions[-1]
    draw_surroundings(axes, wire.run)
    axes.plot(first[:, 2], first[:, 1], ":", color="0.2", linewidth=1.0)
    axes.plot(last[:, 2], last[:, 1], "-", color=colour, marker=".", markersize=4.0)
    axes.plot(last[0, 2], last[0, 1], "o", color="0.1", markersize=4.0)
    axes.set_xlim(-90.0, 90.0)
    axes.set_ylim(-25.0, 145.0)
    axes.set_aspect("equal")
    axes.set(xlabel="$z$ (units)", ylabel="$y$ (units)")


def drives_caption(rows: dict[str, DriveRow]) -> str:
    """Return what each drive came to, in numbers."""
    push = rows["push"]
    radius = push.wire.run.value("vessel")["radius"]
    asked = push.wire.run.measured("driveAsked")
    parts = [
        f"Figure pulling. A wire of {push.wire.run.number('guidewireLength'):g} units in a lumen of radius {radius:g} "
        f"that turns round, after {push.wire.motion.steps[-1]} steps of "
        f"{push.wire.run.number('displacementPerStep'):g} units ({asked:g} asked of the first sphere, black; dotted: "
        "its path)."
    ]
    for name, (key, (label, _)) in zip("abcd", _DRIVES.items()):
        parts.append(f"({name}) {label[0].upper()}{label[1:]}: {_result_of(rows[key], radius)}")
    return " ".join(parts)


def _result_of(row: DriveRow, radius: float) -> str:
    run = row.wire.run
    farthest = row.first_off.max()
    passages = int(run.measured("passages"))
    if farthest > radius:
        text = (
            f"contact does not act on the first sphere, which leaves the lumen, up to {number(farthest)} units from "
            f"its middle line, and the wire is pulled after it: {passages} of its points pass the wall; "
        )
    else:
        text = f"the first sphere stays within {number(farthest)} units of the middle line; "
    shortfall, asked = run.measured("driveShortfall"), run.measured("driveAsked")
    if asked > 0.0 and shortfall > 0.01 * asked:
        text += f"the wall takes {number(shortfall)} of the {asked:g} units ({percent(shortfall / asked)}); "
    return text + f"the tip comes {number(row.tip_along[-1])} units along."


@dataclass(frozen=True)
class TwistRow:
    """A twisted run: in which lumen, with how many solver steps, and its angles."""

    lumen: str
    solver_steps: int
    twist: Twist


def read_twists(folder: Path) -> list[TwistRow]:
    """Return the runs of the study of twist, ascending in solver steps.

    Raises
    ------
    LogError : a file cannot be read, or nothing was run.
    """
    rows = [
        TwistRow(run.variant, int(run.number("constraintSolverSteps")), read_twist(run))
        for run in read_study(folder).required()
    ]
    return sorted(rows, key=lambda row: row.solver_steps)


@styled
def draw_twist(rows: list[TwistRow]) -> tuple[Figure, str]:
    """Tip angle against base angle in either lumen, and what the tip lacks."""
    figure = new_figure(10.0, 3.3)
    panels = dict(zip(("straight", "bent", "lag"), figure.subplots(1, 3)))
    for name, lumen in (("a", "straight"), ("b", "bent")):
        axes = panels[lumen]
        letter(axes, name, f"{lumen} lumen")
        own = [row for row in rows if row.lumen == lumen]
        for index, row in enumerate(own):
            label = f"$m$ = {row.solver_steps}"
            axes.plot(row.twist.base, row.twist.tip, color=f"C{index}", label=label)
            panels["lag"].plot(row.twist.base, row.twist.tip - row.twist.base, color=f"C{index}",
                               linestyle="-" if lumen == "straight" else "--", label=f"{label}, {lumen}")
        axes.plot(own[0].twist.base, own[0].twist.base, ":", color="0.3", label="tip = base")
        axes.set(xlabel="base angle (rad)", ylabel="tip angle (rad)")
        axes.legend(loc="upper left")
    letter(panels["lag"], "c", "tip less base")
    panels["lag"].set(xlabel="base angle (rad)", ylabel="difference (rad)")
    panels["lag"].set_ylim(top=2.2 * panels["lag"].dataLim.y1)
    panels["lag"].legend(loc="upper right", fontsize=7, ncols=2)
    return captioned(figure, twist_caption(rows))


def twist_caption(rows: list[TwistRow]) -> str:
    """Return what arrives at the tip, in numbers."""
    parts = [
        "Figure twist. A wire that is pushed and turned at its base, in a straight and in a bent lumen; the bend-twist "
        "constraint carries the rotation to the tip."
    ]
    for lumen in ("straight", "bent"):
        own = [row for row in rows if row.lumen == lumen]
        half = [row.twist.base.size // 2 for row in own]
        lags = ", ".join(
            f"{number(np.max(np.abs((row.twist.tip - row.twist.base)[k:])), 2)} rad at m = {row.solver_steps}"
            for row, k in zip(own, half)
        )
        bend = own[-1].twist.bend
        parts.append(
            f"In the {lumen} lumen (joints bent by {number(bend[-1], 2)} rad in all at the end) tip and base differ in "
            f"the second half of the run by at most {lags}."
        )
    fewest = rows[0]
    parts.append(
        f"With few solver steps the rotation runs back and forth along the wire as a wave (m = {fewest.solver_steps}: "
        "difference "
        f"{span(fewest.twist.tip - fewest.twist.base, 2)} rad); there is no friction, so nothing holds the tip back."
    )
    return " ".join(parts)
