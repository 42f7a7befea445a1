"""Checks of the loads at which a rod leaves its shape: couple and column; what they share with ring and helix.

The direct solver has rest shapes: the load at which the first shape stops being one that a rod stays in is found by
dividing an interval. The others have motions: the rod is pushed a little off its shape and let go, damped; below the
limit the push dies out, above it grows. Near the limit either takes long, so what is found there is an interval.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from analysis.validation import beam, elastica, pictures, scenes, twisted
from analysis.validation.states import last_state, solver_report, wall_time
from analysis.validation.wire import BASE, STURDY, Wire
from guidewire.figures.wording import number
from guidewire.logs.runs import Run
from guidewire.studies.keys import value_text
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

SECTION = "Stability limits"
GATE = 3e-2
LEFT = 1e-3  # of L: a rest shape farther off the first one is another shape
_WIDE = (0.7, 1.4)  # of the expected load: where the search begins
_PARTS = 6  # into which a round divides the interval
_ROUNDS = 5

@dataclass(frozen=True)
class Limit:
    """What a search found.

    Attributes
    ----------
    load : where the first shape is left; not a number where no such load was seen, or only the interval about it.
    seen : from each load to the distance, over L, from the first shape.
    cost : wall time of all runs, s.
    low, high : ends of the interval in which the load lies, fractions of the expected one.
    """

    load: float
    seen: Mapping[float, float]
    cost: float
    low: float = math.nan
    high: float = math.nan


Search = scenes.Asking[Limit]


def limit(
    name: str,
    expected: float,
    case: Callable[[float], Mapping[str, Any]],
    left: Callable[[Run], float],
    start: Mapping[str, Any] | None = None,
) -> Search:
    """Find where a rest shape loses its stability, by dividing an interval of loads again and again.

    Parameters
    ----------
    name : prefix of the cases.
    expected : the load about which the search begins; the result does not depend on it as long as it lies in `_WIDE`.
    case : from a load to a run's parameters.
    left : from a run to the distance, over L, that the rod is away from its first shape; not a number where the run
        says nothing, such as one that found no rest shape.
    start : of every run.

    Returns
    -------
    Limit : its load is the middle of the last interval.
    """
    low, high = _WIDE[0] * expected, _WIDE[1] * expected
    seen: dict[float, float] = {}
    cost = 0.0
    for _ in range(_ROUNDS):
        loads = [float(load) for load in np.linspace(low, high, _PARTS + 1)]
        cases = {load: Case(f"{name}{value_text(load)}", case(load), start=start) for load in loads if load not in seen}
        runs = yield list(cases.values())
        seen |= {load: left(runs[one.key]) for load, one in cases.items()}
        cost += sum(wall_time(runs[one.key]) for one in cases.values())
        stable = [load for load in loads if seen[load] < LEFT]
        unstable = [load for load in loads if seen[load] >= LEFT]
        if not stable or not unstable or max(stable) > min(unstable):
            return Limit(math.nan, seen, cost)
        low, high = max(stable), min(unstable)
    return Limit(0.5 * (low + high), seen, cost)


PUSH = 1e-4  # of L, off the first shape at the start of a motion
_FRACTIONS = (0.90, 0.94, 0.98, 1.02, 1.06, 1.10)  # of the expected limit


def pushed(
    name: str,
    expected: float,
    case: Callable[[str, float], Case],
    left: Callable[[Run], float],
    push: float = PUSH,
    fractions: Sequence[float] = _FRACTIONS,
) -> Search:
    """Find where a push dies out and where it grows, at fractions of the expected limit, those next to 1 first and the
    rest only where those do not show both.

    Parameters
    ----------
    name : prefix of the cases.
    case : from a name and a load to a run.
    left : from a run to the distance, over L, that the rod is away from its first shape.
    push : that distance at the start.
    fractions : ascending, half of them below 1.

    Returns
    -------
    Limit : with its interval; that is not a number where every push does the same.
    """
    inner = len(fractions) // 2
    cost, seen = 0.0, {}
    for asked in ((fractions[inner - 1], fractions[inner]), (*fractions[:inner - 1], *fractions[inner + 1:])):
        cases = {fraction: case(f"{name}{value_text(fraction)}", fraction * expected) for fraction in asked}
        runs = yield list(cases.values())
        seen |= {fraction: left(runs[one.key]) for fraction, one in cases.items()}
        cost += sum(wall_time(runs[one.key]) for one in cases.values())
        if seen[fractions[inner - 1]] < push <= seen[fractions[inner]]:
            break
    below = [fraction for fraction in seen if seen[fraction] < push]
    above = [fraction for fraction in seen if not seen[fraction] < push]
    low, high = max(below, default=math.nan), min(above, default=math.nan)
    loads = {fraction * expected: distance for fraction, distance in seen.items()}
    return Limit(math.nan, loads, cost, low, high) if low < high else Limit(math.nan, loads, cost)


def limit_line(what: str, expected: float, found: Limit, gate: float, unit: str) -> Result:
    """Return the direct solver's line of `limit`; it says how many searches for a rest shape gave up."""
    silent = sum(math.isnan(distance) for distance in found.seen.values())
    if silent:
        what += f" ({silent} of {len(found.seen)} searches found no rest shape)"
    return Result(what, "direct", found.load, expected, abs(found.load / expected - 1.0), gate, unit, found.cost)


def pushed_line(what: str, solver: str, expected: float, found: Limit, gate: float, unit: str) -> Result:
    """Return the line of `pushed`: value in the middle of the interval, error to its farther end."""
    if found.low < found.high:
        ends = f"between {found.low:g} and {found.high:g} of the reference"
    else:
        fractions = [load / expected for load in found.seen]
        ends = f"none found from {number(min(fractions), 2)} to {number(max(fractions), 2)} of the reference"
    return Result(f"{what}, {ends}", solver, 0.5 * (found.low + found.high) * expected, expected,
                  max(abs(found.low - 1.0), abs(found.high - 1.0)), gate, unit, found.cost,
                  "farther end of the interval")


def branches(
    x_label: str, y_label: str, found: Mapping[tuple[str, str], Limit], least: float = 1e-12
) -> Callable[[Figure], None]:
    """Distance from the first shape over the load, a line at each limit that is one.

    Parameters
    ----------
    found : (solver, what else) to what was seen; each solver has its marker, each other word its colour.
    least : the smallest distance drawn; what is less lies at it.
    """

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        words = list(dict.fromkeys(word for _, word in found))
        for (solver, word), one in found.items():
            color = f"C{words.index(word)}"
            loads = sorted(load for load, distance in one.seen.items() if math.isfinite(distance))
            axes.plot(loads, [max(one.seen[load], least) for load in loads], pictures.SOLVER_MARKERS[solver],
                      fillstyle="none", color=color, label=f"{solver}, {word}")
            if math.isfinite(one.load):
                axes.axvline(one.load, color=color, linewidth=0.9, linestyle="--")
        axes.set_yscale("log")
        pictures.label(axes, x_label, y_label)

    return draw


def _off_axis(wire: Wire, run: Run) -> float:
    """Largest distance of a node from the z axis, over L; 1 where the rod left it so far that it passed through
    itself."""
    if passed_through_itself(run):
        return 1.0
    if run.outcome == "failed":
        return math.nan
    return float(np.max(np.linalg.norm(last_state(run).positions[:, :2], axis=1))) / wire.length


def passed_through_itself(run: Run) -> bool:
    """Return whether the run failed because the rod, out of its first shape, came back to it with fewer turns."""
    return run.outcome == "failed" and "passed through itself" in (run.summary or {}).get("reason", "")


def _lost_turn(run: Run) -> float:
    """Fraction of its turn that a rod has lost: one that leaves its shape may pass through itself and come back to it
    with fewer turns, which the torque shows."""
    if passed_through_itself(run):
        return 1.0
    turn = run.number("distalRotation")
    torsion = 2.0 * run.number("shearModulus") * BASE.second_moment
    return abs(1.0 - float(solver_report(run, "distalMoment")[2]) * BASE.length / (torsion * turn))


def motion(
    solver: str, wire: Wire, supports: Mapping[str, Any], rate: float, duration: float, name: str
) -> scenes.Asking[dict[str, Any]]:
    """A damped motion of a solver with small steps, logged at its end; its loads are laid over it.

    Parameters
    ----------
    supports : how the wire is divided, shaped and held.
    rate : of the slow motion near the limit, 1/s; the damping is critical for it.
    duration : s.
    name : of the run that states the limit of explicit steps.
    """
    step = duration / _FRAMES
    held = {**scenes.wire_parameters(wire), **supports}
    method = yield from scenes.small_steps(solver, wire, step, held, name)
    return {
        **held, "solver": solver, "timeStep": step, **scenes.damping(solver, 2.0 * rate, step),
        "maxSimulationSteps": _FRAMES,
        "logEvery": 1_000_000, "logOrientations": True, **method,
    }


_FRAMES = 600
STOUT = Wire(radius=10e-3)  # xpbd converges sooner on it; its shear and stretch are still below 0.2 %
MOVING = {"explicit": STURDY, "xpbd": STOUT}  # the solvers that push, and the wire of each


def _couple(tension: float, pushing: Sequence[str] = tuple(MOVING)) -> Plan:
    exact = twisted.clamped_moment(tension)
    n = 60

    def case(moment: float) -> dict[str, Any]:
        return scenes.at_rest({
            "numberRodElements": n, "distalEnd": "sliding", "distalRotation": moment * BASE.bending / BASE.torsion,
            "axialForce": tension * BASE.bending / BASE.length**2,
        })

    found = yield from limit("moment=", exact, case, lambda run: max(_off_axis(BASE, run), _lost_turn(run)))
    results = [limit_line(f"straight rod between clamps, T L²/EI = {tension:g}, n = {n}: critical couple", exact, found,
                          GATE, "EI/L")]
    drawn = {("direct", "rest shape"): found}
    for solver in pushing:
        wire = MOVING[solver]
        count = n if solver == "explicit" else n // 2
        slow = 0.2 * _CLAMPED / wire.time_unit  # 1/s, of the motion at 2 % from the limit
        pull = tension * wire.bending / (wire.length * wire.stretching)  # extension of the rod under T
        damped = yield from motion(solver, wire, {"numberRodElements": count, "distalEnd": "clamped"}, slow,
                                   12.0 / slow, f"{solver}-limit")
        damped |= {"distalDisplacement": pull / scenes.UNIT, "distalRampTime": 2.0 / slow}

        def moving(key: str, moment: float, wire: Wire = wire, count: int = count,
                   damped: Mapping[str, Any] = damped) -> Case:
            turn = {"distalRotation": moment * wire.bending / wire.torsion}
            return Case(key, {**damped, **turn}, start=_hump(wire, count))

        bracket = yield from pushed(f"{solver}-", exact, moving, partial(_off_axis, wire))
        results.append(pushed_line(
            f"straight rod between clamps that do not slide, T L²/EI = {tension:g}, r = {1e3 * wire.radius:g} mm, "
            f"n = {count}: critical couple", solver, exact, bracket, GATE, "EI/L"))
        drawn[solver, "after a disturbance"] = bracket
    caption = (
        f"A straight rod between clamps, one rotated, under the tension T L²/EI = {tension:g}: its distance from the "
        f"axis. The direct solver's rest shapes stay straight up to M L/EI = {number(found.load, 5)} (dashed; "
        f"Greenhill: {number(exact, 5)}); below it the distance is rounding. explicit and xpbd, whose clamps cannot "
        f"slide, are displaced by {PUSH:g} L, rotated, and move, damped: the disturbance decays or grows. With clamps "
        "held apart the rod leaves its axis at the same couple, since it shortens by the square of the distance only."
    )
    draw = branches("couple of the straight rod M L/EI (1)", "distance from the axis (L), or fraction of turns lost",
                    drawn)
    return Finding(tuple(results), draw, caption)


_CLAMPED = 22.373  # omega L^2 sqrt(rho A/EI) of a clamped-clamped beam: only sets how long a motion lasts


def _hump(wire: Wire, n: int) -> dict[str, Any]:
    """Return a start between two clamps, off the axis by `PUSH` in the middle."""
    arc = np.linspace(0.0, 1.0, n + 1)
    return scenes.plane_start(wire.length * arc, 0.5 * PUSH * wire.length * (1.0 - np.cos(2.0 * np.pi * arc)))


_COLUMN_GATE = 1e-2
_COLUMN_FRACTIONS = (0.97, 0.98, 0.992, 1.008, 1.02, 1.03)


def _column(pushing: Sequence[str] = tuple(MOVING)) -> Plan:
    exact = elastica.column_load()
    n = 30

    def case(load: float, wire: Wire = BASE) -> dict[str, Any]:
        return {"numberRodElements": n, "tipForce": [0.0, 0.0, -load * wire.bending / wire.length**2]}

    found = yield from limit("load=", exact, lambda load: scenes.at_rest(case(load)), partial(_off_axis, BASE))
    results = [limit_line(f"column, clamped below, free above, n = {n}: critical load", exact, found, _COLUMN_GATE,
                          "EI/L²")]
    drawn = {("direct", "rest shape"): found}
    for solver in pushing:
        wire = MOVING[solver]
        slow = 0.09 * 2.0 * math.pi * beam.frequencies(wire, 1)[0]  # at 0.8 % from the limit
        arc = np.linspace(0.0, 1.0, n + 1)
        start = scenes.plane_start(wire.length * arc, PUSH * wire.length * (1.0 - np.cos(0.5 * np.pi * arc)))

        damped = yield from motion(solver, wire, {"numberRodElements": n}, slow, 8.0 / slow, f"{solver}-limit")

        def moving(key: str, load: float, wire: Wire = wire, damped: Mapping[str, Any] = damped,
                   start: Mapping[str, Any] = start) -> Case:
            return Case(key, {**damped, **case(load, wire)}, start=start)

        bracket = yield from pushed(f"{solver}-", exact, moving, partial(_off_axis, wire), fractions=_COLUMN_FRACTIONS)
        results.append(pushed_line(f"column, r = {1e3 * wire.radius:g} mm, n = {n}: critical load", solver, exact,
                                   bracket, _COLUMN_GATE, "EI/L²"))
        drawn[solver, "after a disturbance"] = bracket
    caption = (
        "A column under a thrust: its distance from the axis. The direct solver's rest shapes stay straight up to "
        f"P L²/EI = {number(found.load, 5)} (dashed; Euler: {number(exact, 5)}); below it the distance is rounding. "
        f"explicit and xpbd are displaced by {PUSH:g} L and move, damped: the disturbance decays or grows."
    )
    draw = branches("thrust P L²/EI (1)", "largest distance from the axis (L)", drawn)
    return Finding(tuple(results), draw, caption)


def _checks(pushing: Sequence[str]) -> tuple[Check, ...]:
    return (
        *(Check(f"couple-tension-{tension:g}", SECTION, f"twisted straight rod, tension {tension:g} EI/L²",
                partial(_couple, tension, pushing)) for tension in (0.0, 1.0, 10.0)),
        Check("column", SECTION, "Euler's column", partial(_column, pushing)),
    )


CHECKS = _checks(tuple(MOVING))
FAST = _checks(())  # the direct solver's only, done in seconds
