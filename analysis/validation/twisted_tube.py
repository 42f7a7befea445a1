"""Check of a rod between clamps on the axis of a narrow tube, one of which turns and slides: where it touches the wall.

Small deflections u = x + i y, lengths in L, the couple M in EI/L: u'''' - i M u''' = the wall's force per length.
Without a wall the rod leaves its axis at Greenhill's couple, tan(M/2) = M/2, and touches in its middle at once. Each
half is a + b s + c s^2 + d exp(i M s) between a clamp and a point at the clearance, u = 1, across which u, u' and u''
go on and u''' jumps along u. By symmetry about the middle u(-s) is the conjugate of u(s): u' is imaginary there and
u'' real. As M grows the deflection beside the point reaches the wall too, where (|u|^2)'' = 2 (|u'|^2 + u'') becomes
0: the contact splits.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy.optimize import brentq

from analysis.figures.wording import number, percent
from analysis.logs import read_entries
from analysis.validation import pictures, scenes, tubes, twisted
from analysis.validation.check import Check, Finding, Plan, Result
from analysis.validation.states import solver_report, wall_time_per_second
from analysis.validation.wire import Wire
from studies.table import Case


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
        if wanted == 1.0:
            total, exact = sum(pushes.values()), middle(moment)[2]
            found[moment] = total
            results.append(Result(f"{what}: force of the wall", "direct", total, exact, abs(total / exact - 1.0), _GATE,
                                  "EI c/L³", cost))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        grid = np.linspace(twisted.clamped_moment() + 1e-3, splits(), 200)
        axes.plot(grid, [middle(moment)[2] for moment in grid], color="0.6", linewidth=2.5, label="linear rod")
        axes.plot(list(found), list(found.values()), "o", fillstyle="none", label="direct")
        axes.set_xlabel("couple M L/EI (1)")
        axes.set_ylabel("force of the wall (EI c/L³)")
        pictures.outside_legend(axes)

    return Finding(tuple(results), draw, (
        "A rod between clamps on the axis of a tube, one of which turns and slides, touches the wall "
        "in its middle: the "
        f"force there from the couple at which it leaves its axis, "
        f"{number(twisted.clamped_moment(), 5)} EI/L, to that at "
        f"which the contact splits, {number(splits(), 5)}. Worst: "
        f"{percent(max(r.error for r in results if r.unit))}."))


def _contacts(pushes: Mapping[int, float]) -> int:
    """Groups of neighbouring nodes that the wall pushes by more than a thousandth of the largest."""
    nodes = sorted(node for node, push in pushes.items() if push > 1e-3 * max(pushes.values()))
    return sum(1 for before, node in zip([-9, *nodes], nodes) if node > before + 1)


CHECKS = (Check("twisted-tube", tubes.SECTION, "a rod twisted in a tube", _plan),)
