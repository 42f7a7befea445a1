"""Check of the order in time of solvers with small steps, on one mode: with many some are always badly resolved."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes
from analysis.validation.bar import BarChain
from analysis.validation.dynamics import SECTION, rms_error
from analysis.validation.states import read_states, wall_time_per_second
from analysis.validation.wire import Wire
from guidewire.figures.wording import number
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_AXIAL_ELEMENTS = 4
_AXIAL_WIRE = Wire(radius=50e-3)  # so thick that shear, which an axial motion does not know, does not set the step
_AXIAL_STEPS = (20, 40, 80, 160)  # a period
_AXIAL_STRAIN = 1e-5  # extension of the wire


def _axial() -> Plan:
    """The solvers with small steps, on a motion that is slow enough for them: the first axial mode of four springs."""
    n, wire = _AXIAL_ELEMENTS, _AXIAL_WIRE
    chain = BarChain(n, wire.line_density * wire.length / n, wire.stretching * n / wire.length, 0.0)
    omega, mode = chain.first_mode()
    start_places = wire.length * (np.arange(n + 1) / n + _AXIAL_STRAIN * mode)
    start = {"positions": [[0.0, 0.0, float(z)] for z in start_places / scenes.UNIT],
             "orientations": [[0.0, 0.0, 0.0, 1.0]] * n}
    period = 2.0 * math.pi / omega
    methods: dict[str, tuple[dict[str, Any], float]] = {
        "explicit": ({"solver": "explicit"}, 2.0),
        "xpbd, 100 iterations": ({"solver": "xpbd", "constraintSolverSteps": 100}, 1.0),
    }
    cases = {
        (name, steps): Case(f"{name.split(',')[0]}-{steps}", {
            **scenes.wire_parameters(wire), **method, "numberRodElements": n, "massRule": "lumped",
            "timeStep": period / steps, "maxSimulationSteps": steps // 2, "logSpheres": "all",
        }, start=start)
        for name, (method, _) in methods.items() for steps in _AXIAL_STEPS
    }
    runs = yield list(cases.values())
    results, series = [], {}
    for name, (_, claimed) in methods.items():
        errors = []
        for steps in _AXIAL_STEPS:
            states = read_states(runs[cases[name, steps].key])
            moved = np.array([state.positions[-1, 2] - wire.length for state in states])
            exact = wire.length * _AXIAL_STRAIN * mode[-1] * np.cos(omega * np.array([s.time for s in states]))
            errors.append(rms_error(moved, exact))
        measured = -math.log2(errors[-1] / errors[-2])
        results.append(Result(
            "order in time on the first axial mode, 80 to 160 steps a period", name, measured, claimed,
            abs(measured - claimed), 0.1, "", wall_time_per_second(runs[cases[name, _AXIAL_STEPS[-1]].key]),
            "absolute"))
        series[name] = (_AXIAL_STEPS, errors)
    caption = (
        f"Half a period in the first axial mode of {n} springs and lumped masses, r = {1e3 * wire.radius:g} mm: RMS "
        "error of the free end against the exact motion, for the solvers whose steps are too short to show an order on "
        "a bending mode. Orders from 80 to 160 steps: "
        + ", ".join(f"{r.solver} {number(r.value)}" for r in results) + "."
    )
    draw = pictures.orders("steps a period", "relative error of the free end's motion", series,
                           [(-1.0, "order 1"), (-2.0, "order 2")])
    return Finding(tuple(results), draw, caption)


CHECKS = (
    Check("order-in-time-axial", SECTION, "order in time, explicit and xpbd", _axial),
)
