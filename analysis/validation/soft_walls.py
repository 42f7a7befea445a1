"""Checks of soft walls: what a wall of stiffness K (force per length and displacement) does to a wire on it.

A contact of stiffness k = K l and limit U has the force f(u) = k u + 0.3 k U phi(1 - u/U), phi(x) = (x - 1) (2 ln x +
(x - 1)/x), whose second part is the barrier before the limit. Where U is large only k u is left: Winkler's foundation,
which pushes and does not pull. On it a weightless beam under a point load P touches over the length pi lambda with
lambda = (4 EI/K)^(1/4). As long a beam with free ends has the deflection coth(pi/2)/8 P lambda^3/EI under the load, and
none at its ends (Hetenyi 1946), where the rest lifts off.

A straight rod under a thrust F in a channel that it just fills leans on one wall or the other: EI w'''' + F w'' + K w =
0. An endless one buckles at F = 2 sqrt(EI K), and at 2 sqrt(2 EI K) where both walls press on it from the start.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.integrate import simpson
from scipy.optimize import brentq

from analysis.validation import pictures, planes, scenes, stability, tube_buckling, tubes
from analysis.validation.states import last_state, wall_time_per_second
from analysis.validation.tubes import GRAVITY, SECTION
from analysis.validation.wire import Wire
from guidewire.figures.wording import exponent, number, percent
from guidewire.logs.logs import read_entries
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_WIRE = Wire()
_THIN = Wire(radius=0.2e-3)
_CLEARANCE = 1.5e-3  # m, of the column in a tube
_WIDE = 10.0  # m, a limit so far away that the wall is a plain spring
_TIP = 5e-3  # m
_DEEP = 0.125 / math.tanh(0.5 * math.pi)  # P lambda^3/EI, the deflection under the load


def force(displacement: float, stiffness: float, limit: float) -> float:
    """Return the force of a contact of this stiffness (N/m) and limit (m), N."""
    x = 1.0 - displacement / limit
    return stiffness * displacement + 0.3 * stiffness * limit * (x - 1.0) * (2.0 * math.log(x) + (x - 1.0) / x)


def displacement(load: float, stiffness: float, limit: float, in_series: float = 0.0) -> float:
    """Of such a contact under a load, or whose share of it is less by `in_series` (N/m) times the displacement."""
    most = min(load / (stiffness + in_series), limit * (1.0 - 1e-12))
    return float(brentq(lambda u: force(u, stiffness, limit) + in_series * u - load, 0.0, most, xtol=1e-18,
                        rtol=1e-14))


def chain_deflection(element: float) -> float:
    """The deflection under the load again, of a chain of straight elements, so many lambda long, on springs at its
    joints: curvatures are differences, and a spring that would pull is left out.

    With a foundation that pulls too, the sum over all waves is 1/2 Re[(1 - i)/sqrt(1 - i element^2/2)] lambda, which is
    element^2/4 more than the beam's, to leading order.
    """
    half = round(6.0 / element)
    bend = np.diff(np.eye(2 * half + 1), 2, axis=0)
    bend = 0.25 / element**3 * bend.T @ bend
    load = np.eye(2 * half + 1)[half]
    touches = np.ones(2 * half + 1, bool)
    while True:
        w = np.linalg.solve(bend + element * np.diag(touches.astype(float)), load)
        if np.array_equal(touches, w > 0.0):
            return 0.25 * float(w[half])
        touches = w > 0.0


def _on_plane(stiffness: float, height: float, limit: float = 0.0, tip: float = _TIP) -> dict[str, Any]:
    """Return a soft plane below the wire, at this height, m."""
    return {"shape": "plane", "point": [0.0, height / scenes.UNIT, 0.0], "normal": [0.0, 1.0, 0.0],
            "wallStiffness": stiffness, "softLimit": limit, "tipLength": tip}


def _still(n: int, vessel: Mapping[str, Any], rate: float, steps: int, step: float, **more: Any) -> dict[str, Any]:
    """Return a damped motion that comes to rest on a wall."""
    return {**scenes.wire_parameters(_WIRE), "numberRodElements": n, "integrator": "implicitEuler", "timeStep": step,
            "maxSimulationSteps": steps, "logEvery": steps, "massDamping": rate, "deltaThreshold": 0.0,
            "vessel": vessel, "logContacts": True, "solverTolerance": 1e-9, **more}


def _floor(stiffnesses: Sequence[float]) -> Plan:
    """A wire that lies on a floor; the second of each pair with a limit that its weight comes near."""
    weight = _WIRE.line_density * GRAVITY
    cases = {(k, limit): Case(f"K={k:g}-limit={limit:g}", _still(
        30, _on_plane(k, -_WIRE.radius, limit, 1e-9), 50.0, 400, 0.01, gravity=[0.0, -GRAVITY, 0.0],
        proximalEnd="free"))
        for k in stiffnesses for limit in (_WIDE, 1.2 * weight / k)}
    runs = yield list(cases.values())
    results = []
    for (k, limit), case in cases.items():
        run = runs[case.key]
        exact = weight / k if limit == _WIDE else displacement(weight, k, limit)
        sunk = -last_state(run).positions[:, 1]
        wide = "" if limit == _WIDE else ", softLimit 1.2 w/K"
        results.append(Result(f"wire on a soft floor, K = {k:g} Pa{wide}: displacement", "direct", float(sunk.mean()),
                              exact, float(np.abs(sunk / exact - 1.0).max()), 1e-6, "m", wall_time_per_second(run)))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        u = np.linspace(0.0, 0.97, 300)
        axes.plot(u, [force(x, 1.0, 1.0) for x in u], color="0.6", linewidth=2.5, label="law")
        axes.plot(u, u, color="0.3", linestyle=":", label="K u")
        for (k, limit), case in cases.items():
            sunk = float(-last_state(runs[case.key]).positions[:, 1].mean())
            axes.plot([sunk / limit], [weight / (k * limit)], "o", fillstyle="none", color="C0")
        pictures.label(axes, "displacement of the wall over its limit", "force per length (K u_max)")

    return Finding(tuple(results), draw, (
        "A wire under its weight on a soft floor: force per length against the displacement, and the law of a contact. "
        f"Worst: {percent(max(r.error for r in results), 5)}."))


def _tip(counts: Sequence[int]) -> Plan:
    """A wire that is pushed head on against a wall: the wall under its tip and the wire are two springs in series."""
    stiffness, push = 1e4, 1e-3
    wall = {"shape": "plane", "point": [0.0, 0.0, (_WIRE.length + _WIRE.radius) / scenes.UNIT],
            "normal": [0.0, 0.0, -1.0], "wallStiffness": stiffness, "softLimit": _WIDE, "tipLength": _TIP}
    cases = {n: Case(f"n={n}", _still(n, wall, 20.0, 100, 0.01, drive="displace",
                                      displacementPerStep=push / 100 / scenes.UNIT))
             for n in counts}
    runs = yield list(cases.values())
    series = _WIRE.stretching / _WIRE.length
    exact = displacement(series * push, _TIP * stiffness, _WIDE, series)
    results = []
    for n, case in cases.items():
        run = runs[case.key]
        sunk = float(last_state(run).positions[-1, 2]) - _WIRE.length
        results.append(Result(f"tip head on, K = {stiffness:g} Pa, tipLength {number(1e3 * _TIP)} mm, n = {n}: "
                              "displacement", "direct", sunk, exact, abs(sunk / exact - 1.0), 1e-4, "m",
                              wall_time_per_second(run)))
    return Finding(tuple(results), pictures_of(results, "displacement of the wall (m)"), (
        "A tip that is pushed against a soft wall by 1 mm at the hub. Worst: "
        f"{percent(max(r.error for r in results), 4)}."))


def pictures_of(results: Sequence[Result], unit: str) -> Any:
    """Return a drawing of values beside their references."""
    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot([r.reference for r in results], "_", markersize=18, color="0.6", label="reference")
        axes.plot([r.value for r in results], "o", fillstyle="none", label="direct")
        pictures.label(axes, "row of the table", unit)

    return draw


def _beam(elements: Sequence[float]) -> Plan:
    """A weightless wire on a soft floor under a load in its middle, by the length of its elements over lambda."""
    stiffness, load = 1e5, 0.05
    length = (4.0 * _WIRE.bending / stiffness) ** 0.25
    counts = {one: 2 * round(0.5 * _WIRE.length / (one * length)) for one in elements}
    cases = {one: Case(f"element={one:g}", _still(
        n, _on_plane(stiffness, -_WIRE.radius, _WIDE, 1e-9), 300.0, 800, 0.002, proximalEnd="free",
        pointLoads=[{"at": 0.5 * _WIRE.length / scenes.UNIT, "force": [0.0, -load, 0.0]}]))
        for one, n in counts.items()}
    runs = yield list(cases.values())
    results, shapes = [], {}
    for one, case in cases.items():
        run = runs[case.key]
        x = last_state(run).positions
        middle = counts[one] // 2
        sunk = -x[:, 1]
        shapes[one] = ((x[:, 2] - x[middle, 2]) / length, sunk / (load * length**3 / _WIRE.bending))
        what = f"beam on a soft floor, load in the middle, elements of {one:.2f} (4 EI/K)^(1/4)"
        gate = 1e-2 if one <= 0.2 else None
        deflection = float(shapes[one][1][middle])
        chain = chain_deflection(one)
        results.append(Result(f"{what}: deflection against a chain of such elements", "direct", deflection, chain,
                              abs(deflection / chain - 1.0), 2e-3, "P lambda³/EI", wall_time_per_second(run)))
        for name, value, exact, unit in (
                ("deflection", deflection, _DEEP, "P lambda³/EI"),
                ("length of contact", _length_above(*shapes[one]), math.pi, "lambda")):
            results.append(Result(f"{what}: {name}", "direct", value, exact, abs(value / exact - 1.0), gate, unit,
                                  wall_time_per_second(run)))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for one, (place, sunk) in shapes.items():
            axes.plot(place, sunk, ".-", label=f"elements of {one:g} lambda")
        axes.set_xlim(-4.0, 4.0)
        axes.set_ylim(1.1 * _DEEP, -0.3 * _DEEP)
        pictures.label(axes, "place along the wire (lambda)", "deflection (P lambda³/EI)")

    fine = [r.error for r in results if r.gate == 1e-2]
    return Finding(tuple(results), draw, (
        "A weightless wire on a soft floor under a load in its middle: it lifts off beyond half of pi lambda. Worst of "
        f"elements up to a fifth of lambda: {percent(max(fine))}."))


def _length_above(place: np.ndarray, sunk: np.ndarray) -> float:
    """Between the zeros of a deflection on both sides of its middle, by straight lines through the last points before
    and after."""
    ends = np.nonzero(np.diff(np.sign(sunk)) != 0)[0]
    middle = len(sunk) // 2
    zeros = [place[k] - sunk[k] * (place[k + 1] - place[k]) / (sunk[k + 1] - sunk[k])
             for k in (ends[ends < middle].max(), ends[ends >= middle].min())]
    return float(zeros[1] - zeros[0])


def _channel(preloads: Sequence[float]) -> Plan:
    """A rod that fills its channel, pushed out of its axis a little: the push dies out or grows."""
    stiffness, n, push = 1e5, 120, 1e-5
    lines, found, mode = [], {}, _channel_mode(stiffness, n)
    for preload in preloads:
        both = 2.0 if preload else 1.0
        unit = math.sqrt(both * _WIRE.bending * stiffness)  # N
        endless = tube_buckling.clamped_onset(_WIRE.length * math.sqrt(unit / _WIRE.bending))
        expected = endless * unit
        height = _WIRE.radius - preload
        wall = {**_on_plane(stiffness, height, _WIDE, 1e-9), "normal": [0.0, -1.0, 0.0]}
        start = scenes.plane_start(_WIRE.length * np.linspace(0.0, 1.0, n + 1), push * mode[both])

        def case(name: str, load: float, wall: Any = wall, height: float = height, start: Any = start) -> Case:
            return Case(name, _still(
                n, _on_plane(stiffness, -height, _WIDE, 1e-9), 4e3, 60, 1e-3, obstacles=[wall], distalEnd="sliding",
                axialForce=-load), start=start)

        one = yield from stability.pushed(
            f"preload={preload:g}-thrust=", expected, case,
            lambda run: float(np.abs(last_state(run).positions[:, 1]).max()) / _WIRE.length,
            push / _WIRE.length, (0.96, 0.985, 1.015, 1.04))
        found["direct", "both walls press" if preload else "the walls just touch"] = one
        lines.append(stability.pushed_line(
            f"rod in a soft channel, {'both walls press' if preload else 'the walls just touch'}: thrust at which it "
            f"buckles, {number(endless, 4)} sqrt(EI K{' 2' if preload else ''}) between clamps", "direct", expected,
            one, 2e-2, "N"))
    return Finding(tuple(lines), stability.branches("thrust (N)", "distance from the axis (L)", found), (
        "A straight rod that fills a soft channel is pushed off its axis: below the critical thrust the push dies out, "
        "above it grows. An endless rod buckles at 2 sqrt(EI K), K that of the wall it leans on, and of both where "
        "both press on it."))


def _channel_mode(stiffness: float, n: int) -> dict[float, np.ndarray]:
    """Half waves of an endless rod that fade to the clamps, by the number of walls that act; largest value 1."""
    s = np.linspace(0.0, 1.0, n + 1)
    waves = {both: (both * stiffness / _WIRE.bending) ** 0.25 * _WIRE.length for both in (1.0, 2.0)}
    return {both: np.sin(math.pi * s) ** 2 * np.cos(wave * (s - 0.5)) for both, wave in waves.items()}


def column(thrust: float, foundation: float) -> tuple[float, float]:
    """Of a column of length 1 between clamps whose wall, at height 1, gives way: force of the wall, and end shortening
    by the slope.

    From a clamp to where it touches, at a, it is w = A (1 - cos k s) + B (k s - sin k s). From there to the middle it
    is an even solution of the equation of a rod on a foundation, k^2 = F.

    Parameters
    ----------
    thrust : in EI/L^2.
    foundation : K L^4/EI.
    """
    k = math.sqrt(thrust)
    root = np.sqrt(complex(thrust**2 - 4.0 * foundation))
    roots = np.sqrt((-thrust + np.array([root, -root])) / 2.0)

    def solved(a: float) -> tuple[np.ndarray, float]:
        x, t = k * a, a - 0.5
        free = np.array([[1.0 - math.cos(x), x - math.sin(x)], [k * math.sin(x), k * (1.0 - math.cos(x))],
                         [k**2 * math.cos(x), k**2 * math.sin(x)], [-k**3 * math.sin(x), k**3 * math.cos(x)]])
        pressed = np.array([np.cosh(roots * t), roots * np.sinh(roots * t), roots**2 * np.cosh(roots * t),
                            roots**3 * np.sinh(roots * t)])
        matrix = np.block([[free, -pressed], [free[:1], np.zeros((1, 2))]])
        found = np.linalg.solve(matrix[[0, 1, 2, 4]], np.array([1.0, 0.0, 0.0, 1.0], dtype=complex))
        return found, float((matrix[3] @ found).real)

    grid = np.linspace(0.2, 0.5 - 1e-6, 2000)
    miss = np.array([solved(a)[1] for a in grid])
    for low in np.nonzero(miss[1:] * miss[:-1] < 0.0)[0]:
        a = float(brentq(lambda a: solved(a)[1], grid[low], grid[low + 1], xtol=1e-15))
        found, _ = solved(a)
        s, t = np.linspace(0.0, a, 4001), np.linspace(a - 0.5, 0.0, 4001)
        one, two = found[:2].real
        slopes = (k * (one * np.sin(k * s) + two * (1.0 - np.cos(k * s))),
                  sum((c * r * np.sinh(r * t)).real for c, r in zip(found[2:], roots)))
        sunk = sum((c * np.cosh(r * t)).real for c, r in zip(found[2:], roots))
        if sunk.min() > -1e-9 and np.all(one * (1.0 - np.cos(k * s)) + two * (k * s - np.sin(k * s)) < 1.0 + 1e-9):
            return (2.0 * foundation * float(simpson(sunk, x=t)),
                    sum(float(simpson(slope**2, x=along)) for slope, along in zip(slopes, (s, t))))
    raise ArithmeticError(f"a column under {thrust} in a wall of {foundation} does not touch in one piece")


def _column_case(name: str, thrust: float, n: int, **wall: float) -> Case:
    """Return a column in a tube, in the plane in which it starts; pi^2 EI/L^2."""
    wire = _THIN
    slow = 22.4 / wire.time_unit
    s = np.linspace(0.0, 1.0, n + 1)
    k, free, one, two = planes.column(thrust * math.pi**2)
    x = k * np.minimum(free, np.minimum(s, 1.0 - s))
    bow = 0.99 * _CLEARANCE * (one * (1.0 - np.cos(x)) + two * (x - np.sin(x)))
    along = np.concatenate([[0.0], np.cumsum(np.sqrt((wire.length / n) ** 2 - np.diff(bow) ** 2))])
    size = wire.length / scenes.UNIT
    vessel = {**tubes.tube([[0.0, 0.0, -size], [0.0, 0.0, 2.0 * size]], (_CLEARANCE + wire.radius) / scenes.UNIT),
              **({"tipLength": 1e-9} if wall else {}), **wall}
    return Case(name, {
        **_still(n, vessel, slow, 600, 0.2 / slow), **scenes.wire_parameters(wire), "distalEnd": "sliding",
        "axialForce": -thrust * math.pi**2 * wire.bending / wire.length**2, "contactDistance": 1e-8,
    }, start=scenes.plane_start(along, -bow))


def _wall_push(run: Run) -> float:
    """Force of the wall, EI c/L^3."""
    *_, (_, entry) = read_entries(run.folder)
    return abs(float(entry["contact"]["total"]["y"])) * _THIN.length**3 / (_THIN.bending * _CLEARANCE)


def _column(loads: Sequence[tuple[float, float]]) -> Plan:
    """A fibre between clamps in a soft tube under a thrust."""
    n = 80
    cases = {(k, t): _column_case(f"K={k:g}-thrust={t:g}", t, n, wallStiffness=k, softLimit=_WIDE)
             for k, t in loads}
    runs = yield list(cases.values())
    results, curves = [], {}
    for (k, t), case in cases.items():
        run = runs[case.key]
        push, short = column(t * math.pi**2, k * _THIN.length**4 / _THIN.bending)
        load = t * math.pi**2 * _THIN.bending / _THIN.length**2
        exact = (_CLEARANCE / _THIN.length) ** 2 * short + load / _THIN.stretching
        moved = 1.0 - float(last_state(run).positions[-1, 2]) / _THIN.length
        curves.setdefault(k, []).append((t, moved, exact))
        what = f"fibre between clamps in a soft tube, K = {k:g} Pa, thrust {t:g} pi² EI/L², n = {n}"
        for name, value, reference, unit in (("force of the wall", _wall_push(run), push, "EI c/L³"),
                                             ("end shortening", moved, exact, "L")):
            results.append(Result(f"{what}: {name}", "direct", value, reference, abs(value / reference - 1.0), 2e-2,
                                  unit, wall_time_per_second(run)))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for index, (k, points) in enumerate(curves.items()):
            t, moved, exact = np.transpose(points)
            axes.plot(1e3 * exact, t, "-", color=f"C{index}", label=f"boundary value problem, K = {k:g} Pa")
            axes.plot(1e3 * moved, t, "o", fillstyle="none", color=f"C{index}", label="direct")
        pictures.label(axes, "end shortening (L/1000)", "thrust (pi² EI/L²)")

    return Finding(tuple(results), draw, (
        "A fibre between clamps on the axis of a soft tube: thrust against end shortening. It leans on the wall, which "
        f"gives way. Worst: {percent(max(r.error for r in results))}."))


def _limits() -> Plan:
    """A column in a tube: towards a rigid wall with K and with u_max; and a wire on a wall that is hardly there."""
    n, thrust = 80, 10.0
    stiffnesses, limits, faint = (1e2, 1e3, 1e4), (1e-4, 1e-5, 1e-6), (1e-1, 1e-2, 0.0)
    hard = _column_case("rigid", thrust, n)
    stiff = [_column_case(f"K={k:g}", thrust, n, wallStiffness=k, softLimit=_WIDE) for k in stiffnesses]
    narrow = [_column_case(f"limit={limit:g}", thrust, n, wallStiffness=1e2, softLimit=limit) for limit in limits]
    low = {"shape": "plane", "point": [0.0, -1e4, 0.0], "normal": [0.0, 1.0, 0.0]}
    heavy = [Case(f"faint={k:g}", _still(30, _on_plane(k, -_WIRE.radius, _WIDE) if k else low, 5.0, 300, 0.01,
                                         gravity=[0.0, -GRAVITY, 0.0])) for k in faint]
    runs = yield [hard, *stiff, *narrow, *heavy]
    rigid = _wall_push(runs[hard.key])
    exact = [column(thrust * math.pi**2, k * _THIN.length**4 / _THIN.bending)[0] / planes.push(thrust * math.pi**2)
             - 1.0 for k in stiffnesses]
    away = [abs(_wall_push(runs[case.key]) / rigid - 1.0) for case in stiff]
    near = [abs(_wall_push(runs[case.key]) / rigid - 1.0) for case in narrow]
    sag = [float(last_state(runs[case.key]).positions[-1, 1]) for case in heavy]
    lifted = [sag[0] / sag[-1] - 1.0, sag[1] / sag[-1] - 1.0]
    orders = ((f"K from {stiffnesses[0]:g} to {stiffnesses[-1]:g} Pa, force against a rigid wall's: order in 1/K",
               exponent([1.0 / k for k in stiffnesses], away), exponent([1.0 / k for k in stiffnesses], exact)),
              (f"softLimit from {1e3 * limits[0]:g} to {1e3 * limits[-1]:g} mm, the same: order in u_max",
               exponent(limits, near), 1.0),
              ("K from 0.1 to 0.01 Pa, sag of a wire against that without a wall: order in K",
               exponent(faint[:2], np.abs(lifted)), 1.0))
    results = tuple(Result(f"soft wall, {what}", "direct", value, wanted, abs(value - wanted), 0.1, "",
                           error_in="absolute") for what, value, wanted in orders)

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.loglog([1.0 / k for k in stiffnesses], away, "o-", fillstyle="none", label="1/K (1/Pa)")
        axes.loglog(limits, near, "s-", fillstyle="none", label="u_max (m)")
        axes.loglog(faint[:2], np.abs(lifted), "^-", fillstyle="none", label="K (Pa), against no wall")
        pictures.label(axes, "", "relative difference")

    return Finding(results, draw, (
        "A soft wall becomes the rigid one as K grows and as u_max goes to 0, and none as K goes to 0."))


CHECKS = (
    Check("soft-floor", SECTION, "a wire on a soft floor", lambda: _floor((1e4, 1e5))),
    Check("soft-tip", SECTION, "a tip head on against a soft wall", lambda: _tip((30, 60, 120))),
    Check("soft-beam", SECTION, "a wire on a soft floor under a load", lambda: _beam((1.0, 1.0 / 3.0, 0.2, 0.1))),
    Check("soft-channel", SECTION, "a rod that fills a soft channel", lambda: _channel((0.0, 2e-4))),
    Check("soft-column", SECTION, "a fibre between clamps in a soft tube",
          lambda: _column(((1e2, 6.0), (1e2, 8.0), (1e2, 10.0), (1e3, 6.0), (1e3, 10.0), (1e3, 14.0)))),
    Check("soft-limits", SECTION, "soft walls near rigid ones and near none", _limits),
)
