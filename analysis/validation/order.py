"""Check of the order in time of every scheme, on one mode: with many modes some are always badly resolved."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from analysis.validation import beam, pictures, scenes
from analysis.validation.bar import BarChain
from analysis.validation.dynamics import SCHEMES, SECTION, rms_error
from analysis.validation.states import last_state, read_states, wall_time_per_second
from analysis.validation.wire import BASE, Wire
from guidewire.figures.wording import number
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_ORDER_STEPS = (10, 20, 40, 80, 160)  # a period
_FINEST = 1280


def _order() -> Plan:
    n = 20
    first = float(beam.mode_numbers(1)[0])
    shape = beam.mode_shape(first, np.linspace(0.0, 1.0, n + 1))
    period = 1.0 / beam.thick_frequencies(BASE, 1)[0]
    # The chain's own first mode: implicit Euler takes the higher ones out of the beam's within two periods.
    steps = 40
    filtered = Case("first-mode", {
        "numberRodElements": n, "integrator": "implicitEuler", "timeStep": period / steps, "solverTolerance": 1e-13,
        "maxSimulationSteps": 2 * steps, "logEvery": 2 * steps, "logOrientations": True,
    }, start=scenes.mode_start(BASE, n, first, 2e-4))
    runs = yield [filtered]
    pure = last_state(runs[filtered.key])
    start = {"positions": (pure.positions / scenes.UNIT).tolist(), "orientations": pure.orientations.tolist(),
             **scenes.CLAMPS_ALONG_Z}

    def case(name: str, steps: int, method: Mapping[str, Any]) -> Case:
        return Case(f"{name}-{steps}", {
            "numberRodElements": n, "timeStep": period / steps, "maxSimulationSteps": steps // 2,
            "logEvery": steps // min(_ORDER_STEPS), "solverTolerance": 1e-13, **method,
        }, start=start)

    def swing(run: Run) -> np.ndarray:
        """Return the motion in the first mode."""
        return np.array([state.positions[:, 1] @ shape for state in read_states(run)])

    finest = case("finest", _FINEST, {"integrator": "esdirk4"})
    cases = {(s, k): case(s, k, {"integrator": s}) for s in SCHEMES for k in _ORDER_STEPS}
    runs = yield [finest, *cases.values()]
    exact = swing(runs[finest.key])
    results, series = [], {}
    for scheme, claimed in SCHEMES.items():
        errors = []
        for steps in _ORDER_STEPS:
            errors.append(rms_error(swing(runs[cases[scheme, steps].key]), exact))
        measured = -math.log2(errors[-1] / errors[-2])
        results.append(Result(
            "order in time on the first mode, 80 to 160 steps a period", f"direct, {scheme}", measured, claimed,
            abs(measured - claimed), 0.1, "", wall_time_per_second(runs[cases[scheme, _ORDER_STEPS[-1]].key]),
            "absolute",
        ))
        series[scheme] = (_ORDER_STEPS, errors)
    caption = (
        f"Half a period in the first mode, amplitude near 1e-4 L, n = {n}: RMS error of the mode against {_FINEST} "
        "steps of esdirk4 a period. Orders from 80 to 160 steps: "
        + ", ".join(f"{r.solver[8:]} {number(r.value)}" for r in results) + "."
    )
    draw = pictures.orders("steps a period", "relative error of the mode's motion", series,
                           [(-1.0, "order 1"), (-2.0, "order 2"), (-3.0, "order 3"), (-4.0, "order 4")])
    return Finding(tuple(results), draw, caption)


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
    Check("order-in-time", SECTION, "order in time, direct", _order),
    Check("order-in-time-axial", SECTION, "order in time, explicit and xpbd", _axial),
)
