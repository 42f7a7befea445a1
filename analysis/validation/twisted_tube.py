"""Check of a rod between clamps on the axis of a narrow tube, one of which turns and slides: where it touches the wall.

Small deflections u = x + i y, lengths in L, the couple M in EI/L: u'''' - i M u''' = the wall's force per length.
Without a wall the rod leaves its axis at Greenhill's couple, tan(M/2) = M/2, and touches in its middle at once. Each
half is a + b s + c s^2 + d exp(i M s) between a clamp and a point at the clearance, u = 1, across which u, u' and u''
go on and u''' jumps along u. By symmetry about the middle u(-s) is the conjugate of u(s): u' is imaginary there and
u'' real. As M grows the deflection beside the point reaches the wall too, where (|u|^2)'' = 2 (|u'|^2 + u'') becomes
0: the contact splits. Two points at +-s1 follow, where |u| = 1 and (|u|^2)' = 0, with a force along u each; between
them the rod is off the wall by a thousandth of the clearance. It touches again in its middle, a third point, at 13.022,
and along a line there from 13.098 on: the values of J. Li, thesis, 2010, too.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq, root

from analysis.validation import pictures, scenes, tubes, twisted
from analysis.validation.states import solver_report, wall_time_per_second
from analysis.validation.wire import Wire
from guidewire.figures.wording import number, percent
from guidewire.logs.logs import read_entries
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result


def middle(moment: float) -> tuple[complex, complex, float]:
    """u' and u'' at the middle of the rod, where u = 1, and the wall's force there, EI/L^3."""
    i, half, e = 1j, 0.5, np.exp(0.5j * moment)
    # Clamp at s = 1/2: u = u' = 0. Unknowns a, b, c, d complex, as 8 real numbers.
    value = [1.0, 0.0, 0.0, 1.0]
    slope = [0.0, 1.0, 0.0, i * moment]
    bend = [0.0, 0.0, 2.0, -(moment**2)]
    rows, right = [], []

    def ask(coefficients: list[complex], part: str, wanted: float) -> None:
        z = np.array(coefficients, dtype=complex)
        rows.append(np.concatenate([z.real, -z.imag]) if part == "real" else np.concatenate([z.imag, z.real]))
        right.append(wanted)

    for part in ("real", "imag"):
        ask([1.0, half, half**2, e], part, 0.0)
        ask([0.0, 1.0, 2.0 * half, i * moment * e], part, 0.0)
    ask(value, "real", 1.0)
    ask(value, "imag", 0.0)
    ask(slope, "real", 0.0)
    ask(bend, "imag", 0.0)
    found = np.linalg.solve(np.array(rows), np.array(right))
    d = complex(found[3], found[7])
    u1 = complex(np.dot(slope, found[:4] + 1j * found[4:]))
    u2 = complex(np.dot(bend, found[:4] + 1j * found[4:]))
    # u''' jumps by twice its real part, being the conjugate's negative on the other side.
    return u1, u2, float(-2.0 * (-1j * moment**3 * d).real)


def _terms(moment: float, s: float, order: int) -> np.ndarray:
    """Return a derivative of 1, s, s^2 and exp(i M s)."""
    i, e = 1j * moment, np.exp(1j * moment * s)
    powers = [[1.0, s, s**2], [0.0, 1.0, 2.0 * s], [0.0, 0.0, 2.0], [0.0, 0.0, 0.0]][order]
    return np.array([*powers, i**order * e], dtype=complex)


@dataclass(frozen=True)
class Pair:
    """Two points of contact at +-s1: where they are and at what angle to the middle; |u| and (|u|^2)''/2 in the middle,
    and the wall's force on both, EI/L^3."""

    place: float
    angle: float
    middle: float
    bulge: float
    force: float


def pair(moment: float, guess: tuple[float, float], touches: bool = False) -> Pair:
    """Return the rod that touches at two points, with `touches` in its middle too.

    Raises ArithmeticError where there is none near the guess of place and angle.
    """

    def halves(place: float, angle: float) -> tuple[np.ndarray, np.ndarray]:
        rows, right, none = [], [], np.zeros(4, dtype=complex)

        def ask(inner: np.ndarray, outer: np.ndarray, part: str, wanted: float = 0.0) -> None:
            z = np.concatenate([inner, outer])
            rows.append(np.concatenate([z.real, -z.imag] if part == "real" else [z.imag, z.real]))
            right.append(wanted)

        for part, wanted in (("real", math.cos(angle)), ("imag", math.sin(angle))):
            for order in (0, 1):
                ask(none, _terms(moment, 0.5, order), part)
            ask(_terms(moment, place, 0), none, part, wanted)
            ask(none, _terms(moment, place, 0), part, wanted)
            for order in (1, 2):
                ask(_terms(moment, place, order), -_terms(moment, place, order), part)
        for order, part in ((0, "imag"), (1, "real"), (2, "imag")):
            ask(_terms(moment, 0.0, order), none, part)
        ask(_terms(moment, 0.0, 0 if touches else 3), none, "real", 1.0 if touches else 0.0)
        found = np.linalg.solve(np.array(rows), np.array(right))
        found = found[:8] + 1j * found[8:]
        return found[:4], found[4:]

    def push(place: float, angle: float) -> tuple[float, complex]:
        """(|u|^2)'/2 at the contact, and the jump of the third derivative there, both along u."""
        inner, outer = halves(place, angle)
        u, third = np.exp(-1j * angle), _terms(moment, place, 3)
        return float((u * (_terms(moment, place, 1) @ inner)).real), complex(u * (third @ outer - third @ inner))

    def misses(x: np.ndarray) -> list[float]:
        slope, jump = push(float(x[0]), float(x[1]))
        return [slope, jump.imag / 100.0]

    solution = root(misses, guess, tol=1e-12)
    if not np.max(np.abs(misses(solution.x))) < 1e-8 or not 0.0 < solution.x[0] < 0.25:
        raise ArithmeticError(f"two contacts at M = {moment}: {solution.message}")
    place, angle = (float(x) for x in solution.x)
    inner, _ = halves(place, angle)
    u, u1, u2 = (complex(_terms(moment, 0.0, order) @ inner) for order in range(3))
    return Pair(place, angle, abs(u), abs(u1) ** 2 + (u.conjugate() * u2).real,
                2.0 * abs(push(place, angle)[1].real))


_PAIR = (0.0737, 0.589)  # of two contacts at M = 12.3
_TRIPLE = (0.0993, 0.873)  # at 13.02


def touches_again() -> float:
    """M L/EI from which the rod touches at three points."""
    return float(brentq(lambda moment: pair(moment, _TRIPLE).middle - 1.0, 12.9, 13.1, xtol=1e-9))


def lies_on() -> float:
    """M L/EI from which the middle one of the three contacts is a line."""
    return float(brentq(lambda moment: pair(moment, _TRIPLE, touches=True).bulge, 13.03, 13.2, xtol=1e-9))


def splits() -> float:
    """M L/EI at which the one contact becomes two."""

    def beside(moment: float) -> float:
        u1, u2, _ = middle(moment)
        return abs(u1) ** 2 + u2.real

    return float(brentq(beside, twisted.clamped_moment() + 0.05, 12.5, xtol=1e-10))


_WIRE = Wire(radius=0.2e-3)
_CLEARANCE = 1.5e-3  # m, a two-hundredth of L
_GAP = 2e-6  # m, over which the barrier acts
_COUPLES = (10.0, 10.3, 10.6, 11.0, 11.3, 12.3)  # EI/L, of a straight rod with the same turn; the last after the split
_ELEMENTS = 80
_GATE = 1e-2


def _plan() -> Plan:
    wire, n = _WIRE, _ELEMENTS
    slow = 22.4 / wire.time_unit  # 1/s, of a clamped beam
    ramp, rest = 40.0 / slow, 120.0 / slow
    step = 0.2 / slow
    arc = np.linspace(0.0, 1.0, n + 1)
    bow = 0.25 * _CLEARANCE * (1.0 - np.cos(2.0 * math.pi * arc))
    along = np.concatenate([[0.0], np.cumsum(np.sqrt((wire.length / n) ** 2 - np.diff(bow) ** 2))])
    size = wire.length / scenes.UNIT
    lumen = (_CLEARANCE + wire.radius) / scenes.UNIT
    cases = {couple: Case(f"couple={couple:g}", tubes.in_vessel(
        wire, tubes.tube([[0.0, 0.0, -0.2 * size], [0.0, 0.0, 1.2 * size]], lumen), step, round((ramp + rest) / step),
        numberRodElements=n, distalEnd="sliding", distalRotation=couple * wire.bending / wire.torsion,
        distalRampTime=ramp, massDamping=slow, logContacts=True, contactDistance=_GAP,
        logEvery=round((ramp + rest) / step),
    ), start=scenes.plane_start(along, bow)) for couple in _COUPLES}
    runs = yield list(cases.values())
    unit = wire.bending * _CLEARANCE / wire.length**3  # N
    results, found = [], {}
    for couple, case in cases.items():
        run = runs[case.key]
        *_, (_, entry) = read_entries(run.folder)
        moment = abs(float(solver_report(run, "distalMoment")[2])) * wire.length / wire.bending
        pushes = {int(node): math.hypot(f["x"], f["y"]) / unit for node, f in entry["contact"]["sphere"].items()}
        what = f"rod twisted in a tube, c = L/{wire.length / _CLEARANCE:g}, n = {n}, M L/EI = {number(moment, 5)}"
        cost = wall_time_per_second(run)
        wanted = 1.0 if moment < splits() else 2.0
        count = float(_contacts(pushes))
        results.append(Result(f"{what}: contacts; they split at {number(splits(), 5)}", "direct", count, wanted,
                              abs(count - wanted), 0.0, "", cost, "contacts"))
        if wanted == 2.0:
            total, exact = sum(pushes.values()), pair(moment, _PAIR).force
            results.append(Result(f"{what}: force of the wall on both contacts", "direct", total, exact,
                                  abs(total / exact - 1.0), _GATE, "EI c/L³", cost))
        else:
            total, exact = sum(pushes.values()), middle(moment)[2]
            found[moment] = total
            results.append(Result(f"{what}: force of the wall", "direct", total, exact, abs(total / exact - 1.0), _GATE,
                                  "EI c/L³", cost))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        grid = np.linspace(twisted.clamped_moment() + 1e-3, splits(), 200)
        axes.plot(grid, [middle(moment)[2] for moment in grid], color="0.6", linewidth=2.5, label="linear rod")
        axes.plot(list(found), list(found.values()), "o", fillstyle="none", label="direct")
        pictures.label(axes, "couple M L/EI (1)", "force of the wall (EI c/L³)")

    return Finding(tuple(results), draw, (
        "A rod between clamps on the axis of a tube, one of which turns and slides, touches the wall in its middle: "
        f"the force there from the couple at which it leaves its axis, {number(twisted.clamped_moment(), 5)} EI/L, to "
        f"that at which the contact splits, {number(splits(), 5)}. Worst: "
        f"{percent(max(r.error for r in results if r.unit))}."))


def _contacts(pushes: Mapping[int, float]) -> int:
    """Groups of neighbouring nodes that the wall pushes by more than a thousandth of the largest."""
    nodes = sorted(node for node, push in pushes.items() if push > 1e-3 * max(pushes.values()))
    return sum(1 for before, node in zip([-9, *nodes], nodes) if node > before + 1)


CHECKS = (Check("twisted-tube", tubes.SECTION, "a rod twisted in a tube", _plan),)
