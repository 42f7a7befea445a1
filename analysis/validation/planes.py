"""Check of a column between two planes: clamps on the line halfway, one of which slides under a thrust.

Small deflections, EI = 1, w'''' + k^2 w'' = 0, k^2 the thrust, clearance c to either plane. Half of the column, from
a clamp to where it touches, is w = A (1 - cos k s) + B (k s - sin k s) with w = c and w' = 0 at its end a. While its
middle touches in a point, a = L/2, and the plane pushes with twice the shear force there, 2 k^3 B. That takes the
moment at the middle away at k a = 2 pi, where A = 0 (thrust 16 pi^2 EI/L^2): beyond, the middle lies flat, the free
pieces keep k a = 2 pi, and each of their ends is pushed by k^3 c/(2 pi). The flat middle is a column too, and does
not stay under any thrust: at 26 pi^2 EI/L^2 it was seen to snap to the other plane.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes
from analysis.validation.states import wall_time_per_second
from analysis.validation.tubes import SECTION
from analysis.validation.wire import Wire
from guidewire.figures.wording import percent
from guidewire.logs.logs import read_entries
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_WIRE = Wire(radius=0.2e-3)
_CLEARANCE = 1.5e-3  # m, a two-hundredth of L: the column's slope stays below 3 %
_GAP = 1e-6  # m, over which the barrier acts
_THRUSTS = (6.0, 8.0, 10.0, 12.0, 14.0, 18.0, 20.0, 22.0)  # pi^2 EI/L^2
_GATE = 5e-3


def column(thrust: float) -> tuple[float, float, float, float]:
    """k, a, A and B of a column of length 1 that touches at height 1, under a thrust in EI/L^2 from 4 pi^2 to 36
    pi^2."""
    k = math.sqrt(thrust)
    free = min(0.5 * k, 2.0 * math.pi)
    matrix = np.array([[1.0 - math.cos(free), free - math.sin(free)], [math.sin(free), 1.0 - math.cos(free)]])
    a, b = np.linalg.solve(matrix, [1.0, 0.0])
    return k, free / k, float(a), float(b)


def push(thrust: float) -> float:
    """Force of the plane on it, EI c/L^3: twice k^3 (B cos k a - A sin k a), the shear force where it begins to
    touch."""
    k, free, a, b = column(thrust)
    return 2.0 * k**3 * (b * math.cos(k * free) - a * math.sin(k * free))


def _shape(thrust: float, arc: np.ndarray) -> np.ndarray:
    """Return its deflection over the clearance at s/L."""
    k, free, a, b = column(thrust)
    s = k * np.minimum(free, np.minimum(arc, 1.0 - arc))
    return a * (1.0 - np.cos(s)) + b * (s - np.sin(s))


def _between(thrusts: Sequence[float]) -> Plan:
    """Each column starts near the linear shape, a hundredth off the plane, and comes to rest, damped."""
    n, wire = 80, _WIRE
    half = (_CLEARANCE + wire.radius) / scenes.UNIT  # of the distance between the planes, units
    size = 1e3 * wire.length
    boxes = [{"shape": "box", "centre": [0.0, side * (half + 10.0), 0.5 * size], "halfSize": [20.0, 10.0, size],
              "rotation": [0.0, 0.0, 0.0]} for side in (-1.0, 1.0)]
    arc = np.linspace(0.0, 1.0, n + 1)
    high = 0.99 * (_CLEARANCE - _GAP)
    slow = 22.4 / wire.time_unit  # 1/s, of a clamped beam
    step = 0.2 / slow

    def start(thrust: float) -> dict[str, Any]:
        bow = high * _shape(thrust * math.pi**2, arc)
        along = np.concatenate([[0.0], np.cumsum(np.sqrt((wire.length / n) ** 2 - np.diff(bow) ** 2))])
        return scenes.plane_start(along, -bow)

    cases = {thrust: Case(f"thrust={thrust:g}", {
        **scenes.wire_parameters(wire), "numberRodElements": n, "integrator": "implicitEuler", "timeStep": step,
        "maxSimulationSteps": 600, "deltaThreshold": 0.0, "distalEnd": "sliding", "massDamping": slow,
        "axialForce": -thrust * math.pi**2 * wire.bending / wire.length**2, "obstacles": boxes, "logContacts": True,
        "contactDistance": _GAP, "logEvery": 600,
    }, start=start(thrust)) for thrust in thrusts}
    runs = yield list(cases.values())
    unit = wire.bending * _CLEARANCE / wire.length**3  # N
    results, found = [], {}
    for thrust, case in cases.items():
        run = runs[case.key]
        found[thrust] = _pushed(run) / unit
        exact = push(thrust * math.pi**2)
        what = f"column between planes, c = L/{wire.length / _CLEARANCE:g}, thrust {thrust:g} pi² EI/L², n = {n}"
        results.append(Result(f"{what}: force of the plane", "direct", found[thrust], exact,
                              abs(found[thrust] / exact - 1.0), _GATE, "EI c/L³", wall_time_per_second(run)))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        grid = np.linspace(4.01, 24.0, 300)
        axes.plot(grid, [push(t * math.pi**2) for t in grid], color="0.6", linewidth=2.5, label="linear beam")
        axes.plot(list(found), list(found.values()), "o", fillstyle="none", label="direct")
        axes.axvline(16.0, color="0.3", linestyle=":", label="a point becomes a line")
        pictures.label(axes, "thrust (pi² EI/L²)", "force of the plane (EI c/L³)")

    return Finding(tuple(results), draw, (
        "A column between two planes, clamped on the line halfway, touches one of them: the force of the plane against "
        "the thrust. It touches in a point up to 16 pi² EI/L², and lies flat in the middle beyond. Worst: "
        f"{percent(max(r.error for r in results))}."))


def _pushed(run: Run) -> float:
    *_, (_, entry) = read_entries(run.folder)
    return abs(float(entry["contact"]["total"]["y"]))


CHECKS = (Check("planes", SECTION, "a column between two planes", lambda: _between(_THRUSTS)),)
