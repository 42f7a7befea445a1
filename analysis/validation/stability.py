"""Checks of the loads at which a rod leaves its shape: couple, twisted ring, localised helix, column."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Generator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.optimize import brentq

from analysis.figures.wording import number, percent
from analysis.runs import Run
from analysis.validation import beam, elastica, pictures, scenes, twisted
from analysis.validation.check import Case, Check, Finding, Plan, Result
from analysis.validation.states import State, last_state, solver_report, wall_time
from analysis.validation.wire import BASE, Wire

SECTION = "Stability limits"
GATE = 3e-2
_WIDE = (0.7, 1.4)  # of the expected load: where the search begins
_PARTS = 6  # into which a round divides the interval
_ROUNDS = 5
_LEFT = 1e-3  # of L: farther off the straight line is another shape

Branch = Generator[Sequence[Case], Mapping[str, Run], tuple[float, dict[float, float]]]


def limit(
    name: str,
    expected: float,
    case: Callable[[float], Mapping[str, Any]],
    left: Callable[[Run], float],
    start: Mapping[str, Any] | None = None,
) -> Branch:
    """Where a rest shape loses its stability, by dividing an interval of loads again and again.

    Parameters
    ----------
    name : prefix of the cases.
    expected : the load about which the search begins; the result does not depend on it as long as it lies in `_WIDE`.
    case : from a load to a run's parameters.
    left : from a run to the distance, over L, that the rod is away from its first shape.
    start : of every run.

    Returns
    -------
    (load, {load: distance}) : the middle of the last interval, and all that was seen.
    """
    low, high = _WIDE[0] * expected, _WIDE[1] * expected
    seen: dict[float, float] = {}
    for _ in range(_ROUNDS):
        loads = [float(load) for load in np.linspace(low, high, _PARTS + 1)]
        cases = {load: Case(f"{name}{load:.10g}", case(load), start=start) for load in loads if load not in seen}
        runs = yield list(cases.values())
        seen |= {load: left(runs[one.key]) for load, one in cases.items()}
        stable = [load for load in loads if seen[load] < _LEFT]
        unstable = [load for load in loads if not seen[load] < _LEFT]
        if not stable or not unstable or max(stable) > min(unstable):
            return math.nan, seen
        low, high = max(stable), min(unstable)
    return 0.5 * (low + high), seen


def _branches(
    x_label: str, y_label: str, found: Mapping[str, tuple[float, dict[float, float]]], scale: float = 1.0
) -> Callable:
    """Distance from the first shape over the load, one series a case, a line at each limit."""

    def draw(figure) -> None:
        axes = figure.add_subplot()
        for k, (name, (load, seen)) in enumerate(found.items()):
            loads = np.array(sorted(seen))
            color = f"C{k}"
            axes.plot(loads * scale, [seen[x] for x in loads], pictures.MARKERS[k], fillstyle="none", color=color,
                      label=name)
            axes.axvline(load * scale, color=color, linewidth=0.9, linestyle="--")
        axes.set_xlabel(x_label)
        axes.set_ylabel(y_label)
        pictures.outside_legend(axes)

    return draw


def _off_axis(run: Run) -> float:
    """Largest distance of a node from the z axis, over L."""
    return float(np.max(np.linalg.norm(last_state(run).positions[:, :2], axis=1))) / BASE.length


def _lost_turn(run: Run) -> float:
    """Share of its turn that a rod has lost: one that leaves its shape may pass through itself and come back to it with
    fewer turns, which only the torque shows."""
    turn = run.number("distalRotation")
    torsion = 2.0 * run.number("shearModulus") * BASE.second_moment
    return abs(1.0 - float(solver_report(run, "distalMoment")[2]) * BASE.length / (torsion * turn))


def _couple(tension: float) -> Plan:
    exact = twisted.clamped_moment(tension)
    per_turn = BASE.torsion / BASE.bending  # M L/EI of a straight rod turned by 1 rad
    n = 60

    def case(moment: float) -> dict[str, Any]:
        return scenes.at_rest({
            "numberRodElements": n, "distalEnd": "sliding", "distalRotation": moment / per_turn,
            "axialForce": tension * BASE.bending / BASE.length**2,
        })

    found, seen = yield from limit("moment=", exact, case, lambda run: max(_off_axis(run), _lost_turn(run)))
    result = Result(f"straight rod between clamps, T L²/EI = {tension:g}, n = {n}: critical couple", "direct", found,
                    exact, abs(found / exact - 1.0), GATE, "EI/L")
    caption = (
        f"A straight rod between clamps, one turned, one sliding, under the tension T L²/EI = {tension:g}: how far its "
        "rest "
        f"shape is off the axis. It stays straight up to M L/EI = {number(found, 5)}; Greenhill: {number(exact, 5)}."
    )
    draw = _branches("couple of the straight rod M L/EI (1)", "distance from the axis (L), or share of turns lost",
                     {"rest shape": (found, seen)})
    return Finding((result,), draw, caption)


_RING_ELEMENTS = {"direct": 96, "explicit": 48, "xpbd": 48}
_RING_RATIO = {"direct": (0.5, 1.0, 2.0), "explicit": (1.0,), "xpbd": (1.0,)}  # EI/GJ
_RING_BRACKET = (0.98, 1.02)  # of the closed form; the solvers with small steps are only run at these two
_RING_METHOD = {
    "direct": {"timeStep": 1e-3, "damping": 0.1, "maxSimulationSteps": 2000, "integrator": "implicitEuler"},
    # Turned at once, the last joint would take the shorter way.
    "explicit": {"timeStep": 1e-4, "damping": 2e-3, "maxSimulationSteps": 3000, "distalRampTime": 0.05},
    "xpbd": {"timeStep": 1e-4, "damping": 2e-3, "maxSimulationSteps": 3000, "distalRampTime": 0.05},
}
_PUSH = 1e-4  # of L, out of the plane at the start
_LOST = 0.1  # share of its twist; a ring that passes through itself loses two turns


def _ring() -> Plan:
    results, found = [], {}
    for ratio in _RING_RATIO["direct"]:
        exact = twisted.ring_twist(ratio, 1.0)
        load, seen = yield from limit(
            f"direct-{ratio:g}-twist=", exact, partial(_ring_run, "direct", ratio), _ring_left,
            _ring_start(_RING_ELEMENTS["direct"]),
        )
        found[f"EI/GJ = {ratio:g}"] = (load, seen)
        results.append(Result(
            f"closed ring, EI/GJ = {ratio:g}, n = {_RING_ELEMENTS['direct']}: critical twist", "direct", load, exact,
            abs(load / exact - 1.0), GATE, "rad",
        ))
    for solver in ("explicit", "xpbd"):
        for ratio in _RING_RATIO[solver]:
            exact = twisted.ring_twist(ratio, 1.0)
            start = _ring_start(_RING_ELEMENTS[solver])
            cases = [Case(f"{solver}-{share:g}", _ring_run(solver, ratio, share * exact), start=start)
                     for share in _RING_BRACKET]
            runs = yield cases
            below, above = (_ring_left(runs[case.key]) for case in cases)
            right = below < _LEFT <= above
            results.append(Result(
                f"closed ring, EI/GJ = {ratio:g}, n = {_RING_ELEMENTS[solver]}: plane at {_RING_BRACKET[0]:g}, left at "
                f"{_RING_BRACKET[1]:g} of the critical twist", solver, exact if right else math.nan, exact,
                0.5 * (_RING_BRACKET[1] - _RING_BRACKET[0]) if right else math.nan, GATE, "rad",
                sum(wall_time(runs[case.key]) for case in cases),
            ))
    caption = (
        "A wire that is straight at rest, closed to a ring, twisted and pushed out of its plane by 1e-4 L, after a "
        "damped "
        "motion: how far it is out of the plane, or what share of its twist it lost by passing through itself. Both "
        "ends "
        "are clamped to one frame by a half-element joint each, so every element is free to move with respect to it. "
        "It "
        "stays plane up to " + ", ".join(f"{number(r.value, 4)}" for r in results[:3])
        + " rad; Michell and Zajac: " + ", ".join(f"{number(r.reference, 4)}" for r in results[:3]) + " rad."
    )
    draw = _branches("twist (rad)", "distance from the plane (L), or share of twist lost", found)
    return Finding(tuple(results), draw, caption)


def _ring_run(solver: str, ratio: float, twist: float) -> dict[str, Any]:
    """A ring with this twist, and the motion after it, damped."""
    wire = dataclasses.replace(BASE, shear_modulus=0.5 * BASE.youngs_modulus / ratio)
    method = dict(_RING_METHOD[solver])
    if solver != "direct":
        method |= scenes.small_steps(solver, wire, method["timeStep"], _RING_ELEMENTS[solver])
    return {
        "solver": solver, "numberRodElements": _RING_ELEMENTS[solver], "startShape": "ring", "distalEnd": "clamped",
        "distalRotation": twist, "shearModulus": wire.shear_modulus, "clampRule": "halfElement",
        "logEvery": 1_000_000, "logOrientations": True, **method,
    }


def _ring_start(n: int) -> dict[str, Any]:
    """A regular polygon in the y-z plane, pushed a little out of it between its clamps."""
    middles = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    sides = np.stack([np.sin(middles), np.cos(middles)], axis=1) * BASE.length / n
    places = np.concatenate([np.zeros((1, 2)), np.cumsum(sides, axis=0)]) / scenes.UNIT
    around = 2.0 * np.pi * np.arange(n + 1) / n
    out = _PUSH * BASE.length / scenes.UNIT * np.sin(around) ** 2 * np.sin(2.0 * around)
    return {
        "positions": [[float(x), float(y), float(z)] for x, (y, z) in zip(out, places)],
        "orientations": [[-math.sin(0.5 * a), 0.0, 0.0, math.cos(0.5 * a)] for a in middles],
    }


def _ring_left(run: Run) -> float:
    """Root mean square distance of the nodes from their plane over L, or the share of twist lost where it is large."""
    state = last_state(run)
    if run.outcome == "diverged":
        return math.inf
    out = np.linalg.svd(state.positions - state.positions.mean(axis=0), compute_uv=False)[2]
    away = float(out) / math.sqrt(len(state.positions)) / BASE.length
    lost = abs(1.0 - _link(state) / run.number("distalRotation"))
    return lost if lost > _LOST else away


def _link(state: State) -> float:
    """Twist between neighbouring elements, summed over the chain, rad."""
    a, b = state.orientations[:-1], state.orientations[1:]
    along = a[:, 3] * b[:, 2] - b[:, 3] * a[:, 2] - a[:, 0] * b[:, 1] + a[:, 1] * b[:, 0]
    same = np.einsum("ij,ij->i", a, b)
    inner = np.sum(2.0 * np.arctan2(along * np.sign(same), np.abs(same)))
    return float(inner) * len(state.orientations) / len(a)  # the two half joints at the clamp twist as much as one


_COLUMN_GATE = 1e-2
_THRUST = 0.5  # of Euler's load
_SIDE = 1e-3  # F L^2/EI


def _column() -> Plan:
    exact = elastica.column_load()
    n = 30

    def case(load: float) -> dict[str, Any]:
        return scenes.at_rest({
            "numberRodElements": n, "tipForce": [0.0, 0.0, -load * BASE.bending / BASE.length**2],
        })

    found, seen = yield from limit("load=", exact, case, _off_axis)
    results = [Result(f"column, clamped below, free above, n = {n}: critical load", "direct", found, exact,
                      abs(found / exact - 1.0), _COLUMN_GATE, "EI/L²")]
    unit = BASE.bending / BASE.length**2
    cases = [
        Case(solver, scenes.settled(solver, BASE, {
            "numberRodElements": n, "tipForce": [0.0, -_SIDE * unit, -_THRUST * exact * unit],
        }, math.sqrt(1.0 - _THRUST) * beam.frequencies(BASE, 1)[0]))
        for solver in ("explicit", "xpbd")
    ]
    runs = yield cases
    for case in cases:
        tip = -float(last_state(runs[case.key]).positions[-1, 1]) / BASE.length
        load = _implied_load(_THRUST * exact, _SIDE, tip)
        results.append(Result(
            f"column, n = {n}: critical load implied by the deflection at half of it", case.key, load, exact,
            abs(load / exact - 1.0), _COLUMN_GATE, "EI/L²", wall_time(runs[case.key]),
        ))
    caption = (
        f"A column under a thrust: how far its rest shape is off the axis. It stays straight up to P L²/EI = "
        f"{number(found, 5)}; Euler: {number(exact, 5)}. explicit and xpbd, whose motion has no end near the limit, "
        "are "
        f"judged by the deflection under a small force across and half of Euler's load."
    )
    draw = _branches("thrust P L²/EI (1)", "largest distance from the axis (L)", {"rest shape": (found, seen)})
    return Finding(tuple(results), draw, caption)


def _implied_load(thrust: float, side: float, tip: float) -> float:
    """Critical load of a column that a force across deflects so far under a thrust: forces over EI/L^2, the tip over L.

    A stiffness of f EI gives tip = side/thrust (tan(u)/u - 1), u^2 = thrust/f; the critical load is f pi^2/4.
    """
    u = brentq(lambda u: side / thrust * (math.tan(u) / u - 1.0) - tip, 1e-3, 0.5 * math.pi - 1e-9, xtol=1e-14)
    return thrust / u**2 * elastica.column_load()


_HELIX = {"bending": 1.345, "torsion": 0.789, "length": 100.0, "shortening": 3.0, "turn": 54.0 * math.pi}
_HELIX_WIRE = Wire.of_stiffness(_HELIX["length"], 0.01, _HELIX["bending"], _HELIX["torsion"], 1.0)
_HELIX_GATE = 5e-2  # at n = 200
_HELIX_STEP = 5.0  # s; the slowest swing between the clamps takes 43 s
_HELIX_RAMP, _HELIX_REST = 2000.0, 2000.0  # s


def _helix() -> Plan:
    exact = twisted.localised_helix(**_HELIX)
    counts = (100, 200)
    wire = _HELIX_WIRE
    cases = [
        Case(f"n={n}", {
            **scenes.wire_parameters(wire), "numberRodElements": n, "distalEnd": "clamped",
            "distalRotation": _HELIX["turn"], "distalRampTime": _HELIX_RAMP, "timeStep": _HELIX_STEP,
            "maxSimulationSteps": int((_HELIX_RAMP + _HELIX_REST) / _HELIX_STEP), "integrator": "implicitEuler",
            "damping": 0.05, "logEvery": 1_000_000, "logOrientations": True,
        }, start=_hump(n))
        for n in counts
    ]
    runs = yield cases
    results, drawn = [], {}
    for n, case in zip(counts, cases):
        run = runs[case.key]
        if run.outcome != "finished":
            results.append(Result(f"localised helix, n = {n}: {run.summary['reason']}", "direct", math.nan, exact.load,
                                  math.nan, _HELIX_GATE if n == 200 else None))
            continue
        angles = np.arccos(np.clip(last_state(run).directors[:, 2], -1.0, 1.0))
        moment = abs(float(solver_report(run, "distalMoment")[2]))
        tension = abs(float(solver_report(run, "distalForce")[2]))
        load = moment / (2.0 * math.sqrt(wire.bending * tension))
        largest = math.degrees(float(np.max(angles)))
        gate = _HELIX_GATE if n == 200 else None
        results.append(Result(f"localised helix, 27 turns, n = {n}: M/(2 sqrt(B T))", "direct", load, exact.load,
                              abs(load / exact.load - 1.0), gate))
        wanted = math.degrees(exact.largest_angle)
        results.append(Result(f"localised helix, 27 turns, n = {n}: largest angle", "direct", largest, wanted,
                              abs(largest / wanted - 1.0), gate, "°"))
        middle = (np.arange(n) + 0.5) * wire.length / n
        drawn[f"n = {n}"] = (middle - np.average(middle, weights=1.0 - np.cos(angles)), np.degrees(angles))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        s = np.linspace(-30.0, 30.0, 601)
        axes.plot(s, np.degrees(exact.angle(s)), color="0.6", linewidth=2.5, label="endless rod")
        for marker, (name, (place, angle)) in zip(pictures.MARKERS, drawn.items()):
            axes.plot(place, angle, marker, fillstyle="none", label=name)
        axes.set_xlim(-30.0, 30.0)
        axes.set_xlabel("distance along the rod from the middle of the helix (units)")
        axes.set_ylabel("angle against the axis (°)")
        pictures.outside_legend(axes)

    caption = (
        "A rod between clamps, brought closer by 3 of 100 and then slowly turned by 27 turns (implicit Euler): angle "
        "of the elements against the axis, "
        f"over the closed form of an endless rod (largest angle {number(math.degrees(exact.largest_angle), 4)}°). "
        + " ".join(f"{r.what.split(', ')[-1]}: {number(r.value, 4)} ({percent(r.error)} off)." for r in results)
    )
    return Finding(tuple(results), draw, caption)


def _hump(elements: int) -> dict[str, Any]:
    """The plane curve a (1 - cos)/2 whose length is that of the rod and whose ends are its distance apart."""
    reach = _HELIX["length"] - _HELIX["shortening"]
    z = np.linspace(0.0, reach, 20_001)

    def curve(height: float) -> tuple[np.ndarray, np.ndarray]:
        y = 0.5 * height * (1.0 - np.cos(2.0 * np.pi * z / reach))
        return y, np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(z), np.diff(y)))])

    height = brentq(lambda a: curve(a)[1][-1] - _HELIX["length"], 0.0, 0.5 * reach)
    y, arc = curve(height)
    nodes = np.linspace(0.0, arc[-1], elements + 1)
    return scenes.plane_start(np.interp(nodes, arc, z), np.interp(nodes, arc, y))


CHECKS = (
    *(Check(f"couple-tension-{tension:g}", SECTION, f"twisted straight rod, tension {tension:g} EI/L²",
            partial(_couple, tension)) for tension in (0.0, 1.0, 10.0)),
    Check("ring", SECTION, "twisted ring", _ring),
    Check("localised-helix", SECTION, "localised helix", _helix),
    Check("column", SECTION, "Euler's column", _column),
)
