"""Outcomes of a wire that is twisted, pushed between walls, and damped, over two parameters each, with the limits that
theory has for them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.maps import (
    BENT, INACCURATE, JOINT_LIMIT, LARGEST_JOINT, LOST_TURN, Cell, View, draw_classes, draw_map, kind_of, kinds_of,
    read_map,
)
from analysis.stability import Frontier, limit_along, lost_turns, read_frontiers
from analysis.twist import Twist, read_twist
from analysis.validation.wire import Wire
from guidewire.figures.style import captioned, letter, new_figure, styled
from guidewire.figures.wording import number, percent
from guidewire.logs.logs import read_log
from guidewire.logs.runs import Run
from guidewire.studies.wire_maps import (
    BEND_GAIN, FALL, LENGTH, LONG_STEP, MOVED_ELEMENTS, PUSHED_ELEMENT, TURNED_ELEMENTS, TURNED_LENGTH, TURNED_STEPS,
    WIRE_MAPS, pushes,
)

STUDIES = tuple(study.name for study in WIRE_MAPS)
_WIRE = Wire()
GREENHILL = 8.987  # M L/EI at which a wire between clamps without tension bends (Greenhill)
CRITICAL_RATE = GREENHILL * _WIRE.bending / _WIRE.torsion / LENGTH  # rad/m of twist
FREQUENCY = 1.8751**2 * math.sqrt(_WIRE.bending / _WIRE.line_density) / LENGTH**2  # rad/s, the lowest of a cantilever
_BENT_FROM = 0.1  # of the radius, aside
_PUSHED_STIFFNESS = 60e9 * 0.25 * math.pi * 0.0004**4 / PUSHED_ELEMENT**3  # EI/l^3, N/m
_TURNS = np.geomspace(0.1, 4.0, 40)  # rad a step, for which the chain is worked out
_TURNED_SWEEPS = (10, 30, 100)
_COLOURS = ("C0", "C1", "C2", "C4")


def _is_bent(run: Run, error: float) -> str:
    """Class of a wire that was twisted between clamps."""
    kind = kind_of(run, error)
    if kind in ("diverged", "failed"):
        return kind
    aside = np.max(np.hypot(*read_log(run.folder).final_positions[:, :2].T))
    return BENT if aside > _BENT_FROM * run.number("wireRadius") / run.number("metresPerUnit") else kind


def _lag(run: Run) -> float:
    """Return how far the tip is behind at the end, of the turn that was asked for."""
    twist = read_twist(run)
    return float(abs(twist.base[-1] - twist.tip[-1]) / twist.base[-1])


def lost_turn(twist: Twist) -> bool:
    """Return whether a joint has gone over half a turn: its angle jumps by a whole one, and that of the wire with
    it."""
    return bool(np.max(np.abs(np.diff(twist.base - twist.tip)), initial=0.0) > math.pi)


def _is_lost(run: Run, error: float) -> str:
    """Class of a wire with gains that was turned."""
    return LOST_TURN if lost_turn(read_twist(run)) else kind_of(run, error)


def _rate(run: Run) -> float:
    return run.number("distalRotation") / LENGTH


def _joint_limit(elements: float) -> float:
    """Rate of twist at which the softest joint, 7/6 of an inner one, is at its limit, rad/m."""
    return JOINT_LIMIT / LARGEST_JOINT * elements / LENGTH


VIEWS = (
    View("map-twist", "direct: twisted between clamps, at rest", _rate, lambda run: run.number("numberRodElements"),
         ("twist (rad/m)", "elements n (1)"), lines=((CRITICAL_RATE, "Greenhill"),), kind=_is_bent),
    View("map-twisting", f"twisted in 80 ms (n = {MOVED_ELEMENTS})", _rate, lambda run: run.variant,
         ("twist (rad/m)", "method (-)"), lines=((_joint_limit(MOVED_ELEMENTS), "joint's limit"),), log_x=False),
    View("map-turning", "pbd: rotated at the base", lambda run: run.number("twistPerStep"),
         lambda run: run.number("constraintSolverSteps"), ("rotation per step (rad)", "iterations m (1)"), error=_lag,
         kind=_is_lost),
    View("map-speed", "direct: pushed into a vessel", lambda run: pushes()[run.variant][0],
         lambda run: 1e3 * pushes()[run.variant][1], ("speed (m/s)", "time step (ms)"),
         lambda run: next(name for name, push in pushes().items() if push[0] == pushes()[run.variant][0])),
    View("map-barrier", "direct: barriers in a vessel", lambda run: run.number("contactStiffness"),
         lambda run: 1e6 * run.number("contactDistance"), ("contact stiffness (N/m)", "contact distance (µm)"),
         lambda _: "contactDistance=1e-06,contactStiffness=100000.0", ((0.1 * _PUSHED_STIFFNESS, "EI/10 l³"),)),
    View("map-strain-damping", f"direct: damped material, {1e3 * LONG_STEP:g} ms",
         lambda run: run.number("materialDamping") * FREQUENCY, lambda run: run.variant,
         ("damping times lowest frequency (1)", "integrator (-)"),
         lambda run: f"reference,materialDamping={run.values['materialDamping']!r}", ((2.0, "critical"),)),
)


def euler_error(damping: float, step: float, time: float) -> float:
    """Say by how much implicit Euler is off for one mode that falls with b K times its rate beside K, of how far it
    falls.

    Parameters
    ----------
    damping : b times the circular frequency w of the mode.
    step : h w.
    time : of the fall, t w.
    """
    slope = np.array([[0.0, 1.0], [-1.0, -damping]])
    roots, modes = np.linalg.eig(slope.astype(complex))
    start = np.linalg.solve(modes, np.array([-1.0, 0.0]))  # of the way from rest
    exact = 1.0 + (modes @ (start * np.exp(roots * time)))[0].real
    euler = 1.0 + (modes @ (start * (1.0 - step * roots) ** -round(time / step)))[0].real
    return float(abs(euler / exact - 1.0))


@lru_cache(maxsize=None)
def turn_limits() -> dict[int, float]:
    """Turn a step from which the chain of `lost_turns` loses a turn, by iterations."""
    part = BEND_GAIN / (TURNED_LENGTH / TURNED_ELEMENTS)
    return {m: float(_TURNS[np.argmax(lost_turns(TURNED_ELEMENTS, m, part, _TURNS, TURNED_STEPS))])
            for m in _TURNED_SWEEPS}


@styled
def draw_wire_maps(folders: Mapping[str, Path]) -> tuple[Figure, str]:
    """Return one panel a map."""
    found = {view.study: read_map(view, folders[view.study]) for view in VIEWS}
    damped = read_frontiers(folders[STUDIES[-1]])
    figure = new_figure(15.0, 6.6)
    panels = figure.subplots(2, 4).ravel()
    for name, axes, view in zip("abcdef", panels, VIEWS):
        letter(axes, name, view.title)
        draw_map(axes, view, found[view.study])
    _draw_limits(panels)
    letter(panels[6], "g", "pbd: stretch stiffness with damping (n = 10)")
    _draw_damped(panels[6], damped)
    draw_classes(panels[7], (BENT, LOST_TURN))
    return captioned(figure, _caption(found, damped))


def _draw_limits(panels: Sequence[Axes]) -> None:
    """Limits that go with both parameters."""
    limits = turn_limits()
    lines = {
        0: (_joint_limit(6.0), 6.0, _joint_limit(48.0), 48.0, "joint's limit"),
        3: (0.2, 1e3 * PUSHED_ELEMENT / 0.2, 50.0, 1e3 * PUSHED_ELEMENT / 50.0, "an element a step"),
    }
    for k, (x, y, end, top, text) in lines.items():
        panels[k].plot([x, end], [y, top], ":", color="0.3", linewidth=0.8)
        panels[k].annotate(text, (end, top), fontsize=6, ha="right", va="bottom")
    panels[2].plot(list(limits.values()), list(limits), "--", color="0.3", linewidth=0.8)
    panels[2].annotate("chain", (limits[10], 12), fontsize=6, ha="right", va="bottom")


def _draw_damped(axes: Axes, found: Sequence[Frontier]) -> None:
    """Frontiers by bisection on the limits of the chain."""
    damping = np.linspace(0.0, 1.0, 21)
    for colour, m in zip(_COLOURS, sorted({int(one.values["constraintSolverSteps"]) for one in found})):
        axes.plot(damping, [limit_along(10, m, d) for d in damping], "--", color=colour, linewidth=0.8)
        own = [one for one in found if one.values["constraintSolverSteps"] == m]
        axes.plot([one.values["damping"] for one in own], [one.middle for one in own], "o", color=colour,
                  fillstyle="none", label=f"m = {m}")
    axes.set(xlabel="damping: fraction of speed lost per step (1)", ylabel="largest stable stretch stiffness (1)")
    axes.legend(fontsize=6)


def _bounds(cells: Sequence[Cell], y: float | str, held: Sequence[str], gone: Sequence[str]) -> str:
    """Return the largest x of some classes and the smallest of others, of one line."""
    low = [cell.x for cell in cells if cell.y == y and cell.kind in held]
    high = [cell.x for cell in cells if cell.y == y and cell.kind in gone]
    return f"{number(max(low), 3) if low else '-'} to {number(min(high), 3) if high else '-'}"


def _caption(found: Mapping[str, Sequence[Cell]], damped: Sequence[Frontier]) -> str:
    twist, twisting, turning, speed, barrier, strain = (found[view.study] for view in VIEWS)
    straight, gone = ("converged", "finished"), ("failed", "diverged")
    lines = sorted({cell.y for cell in twist})
    by_speed = {v: max(cell.error for cell in speed if cell.x == v) for v in sorted({cell.x for cell in speed})}
    off = max((abs(one.middle / limit_along(10, int(one.values["constraintSolverSteps"]), one.values["damping"]) - 1.0)
               for one in damped), default=math.nan)
    euler = [cell for cell in strain if cell.y == "implicitEuler"]
    mode = {cell.x: euler_error(cell.x, LONG_STEP * FREQUENCY, FALL * FREQUENCY) for cell in euler}
    return (
        "Figure maps-wire. Where a wire that is twisted, pushed between walls or damped holds, and where it fails; "
        "classes as in Figure maps. (a) Rest shapes between clamps, a thousandth of gravity aside; bent: more than "
        f"{percent(_BENT_FROM)} of the radius aside. It bends between "
        + ", ".join(f"{_bounds(twist, n, straight, (BENT,))} rad/m with n = {n:g}" for n in lines)
        + f"; Greenhill has {number(CRITICAL_RATE, 3)} (dashed). It is lost from "
        + ", ".join(f"{_bounds(twist, n, (BENT,), gone)} with n = {n:g}" for n in lines)
        + ". With n = 6 that is the joints' limit (dotted: the softest, beside the clamp, at "
        f"{JOINT_LIMIT:g} rad); a longer chain bends first, its twist is then no longer even, and with n = 24 and more "
        "the search ends at a saddle long before: such a run fails and says so. (b) Twisted within 80 ms: held, and "
        "lost, "
        + ", ".join(f"{name} {_bounds(twisting, name, straight, gone)}"
                    for name in dict.fromkeys(cell.y for cell in twisting))
        + f" rad/m; the joints' limit is {number(_joint_limit(MOVED_ELEMENTS), 3)} (dashed), the same for all, and "
        f"bending takes longer than 80 ms. (c) A wire with pbd whose base is rotated for {TURNED_STEPS} steps; "
        f"inaccurate: its tip lags by more than {percent(INACCURATE)} of the rotation. A joint loses a turn between "
        + ", ".join(f"{_bounds(turning, m, (*straight, 'inaccurate'), (LOST_TURN,))} rad a step with m = {m:g}"
                    for m in sorted({cell.y for cell in turning}))
        + "; elements on a line, whose joints correct the sine of their angle, from "
        + ", ".join(f"{number(turn, 2)} with m = {m}" for m, turn in turn_limits().items())
        + " (dashed). Such a run ends as finished, with the joint and the step in its reason. (d) The same 130 mm into "
        f"a vessel: {kinds_of(speed)}; no wire is lost at any step, steps of many elements (dotted: one) are "
        "divided into parts. Against the shortest step of the same speed the tip is off by at most "
        + ", ".join(f"{percent(error)} at {v:g} m/s" for v, error in by_speed.items())
        + " of its displacement; a wire that enters at 100 m/s whips, and one step for all of that is too long. "
        f"(e) Barriers of any stiffness and distance, at 0.2 m/s: {kinds_of(barrier)}, off by at most "
        f"{percent(max(cell.error for cell in barrier))} of the displacement; no limit is found, also below EI/10 l³ "
        "(dashed), where a barrier is softer than an element: it is met closer to the wall, where it is stiff. (f) "
        f"A fall with a damped material, after {FALL:g} s, against esdirk4 with steps of 0.2 ms: "
        + "; ".join(f"{name} {kinds_of(strain, name)}" for name in dict.fromkeys(cell.y for cell in strain)
                    if name != "reference")
        + ". No damping is too strong for a step. The schemes that damp by themselves are off where the lowest mode "
        "swings (left of the dashed line, where it is damped critically): by implicit Euler one mode alone is off by "
        + ", ".join(f"{percent(mode[cell.x])} ({percent(cell.error)} found)"
                    for cell in (euler[0], euler[len(euler) // 2]))
        + f" at {number(euler[0].x, 2)} and {number(euler[len(euler) // 2].x, 2)}. (g) Largest stretch "
        f"stiffness of spheres that lose a fraction of their speed per step: bisections (circles) are within "
        f"{percent(off)} of the chain's limit (dashed). With many iterations damping changes nothing: an error grows "
        "within the iterations of a step."
    )
