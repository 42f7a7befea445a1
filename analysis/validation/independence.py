"""Checks that a material's answer does not depend on iterations, steps and elements, and that a gain's does."""

from __future__ import annotations

import math

import numpy as np

from analysis.figures.wording import number, percent
from analysis.logs import read_log
from analysis.validation import beam, elastica, pictures, scenes
from analysis.validation.check import Case, Check, Finding, Plan, Result
from analysis.validation.dynamics import release, rms_error
from analysis.validation.states import last_state, solver_report, tip_at, wall_time
from analysis.validation.wire import BASE, Wire

SECTION = "Independence"
GATE = 2e-2
_LOAD = 2.0  # F L^2/EI
_FORCE = _LOAD * BASE.bending / BASE.length**2


def _elements_and_tolerance() -> Plan:
    counts, tolerances = (20, 30, 40, 80, 160), (1e-8, 1e-9, 1e-10, 1e-12)
    loads = {"tipForce": [0.0, -_FORCE, 0.0]}
    static = {n: Case(f"n={n}", scenes.at_rest({**loads, "numberRodElements": n})) for n in counts}
    moving = {t: Case(f"tolerance={t:g}", release(12, 1e-3, {"solverTolerance": t})) for t in tolerances}
    runs = yield [*static.values(), *moving.values()]
    exact = elastica.tip_loaded(_LOAD, np.linspace(0.0, 1.0, 11)).tip[1]
    tips = {n: -float(last_state(runs[case.key]).positions[-1, 1]) / BASE.length for n, case in static.items()}
    results = [
        Result(f"tip load F L²/EI = {_LOAD:g}, n = {n}: deflection", "direct", tip, exact, abs(tip / exact - 1.0), GATE,
               "L")
        for n, tip in tips.items()
    ]
    time = np.linspace(0.0, 0.2, 201)
    motions = {t: tip_at(runs[case.key], time)[:, 1] for t, case in moving.items()}
    finest = motions[min(tolerances)]
    results += [
        Result(f"cantilever let go, solverTolerance {t:g} against {min(tolerances):g}", "direct, sdirk3", motion[-1],
               finest[-1], rms_error(motion, finest), GATE, "m", None, "RMS")
        for t, motion in motions.items() if t != min(tolerances)
    ]
    series = {
        "rest shape over n": (counts, [abs(tip / exact - 1.0) for tip in tips.values()]),
    }
    caption = (
        f"Deflection of the tip under F L²/EI = {_LOAD:g} against n, relative to the elastica. The motion of the "
        "cantilever "
        f"let go, n = 12, changes by at most {percent(max(r.error for r in results[len(counts):]))} over "
        "solverTolerance = "
        "1e-8 (the default) to 1e-12."
    )
    draw = pictures.orders("number of elements n", "relative error of the deflection", series, [(-2.0, "order 2")],
                           (GATE, "gate"))
    return Finding(tuple(results), draw, caption)


def _time_step() -> Plan:
    steps = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 4e-3)
    omega = 2.0 * math.pi * beam.frequencies(BASE, 1)[0]
    cases = {
        dt: Case(f"dt={dt:g}", {
            "tipForce": [0.0, -_FORCE, 0.0], "timeStep": dt, "damping": 2.0 * omega * dt, "logEvery": 1_000_000,
            "maxSimulationSteps": math.ceil(15.0 / omega / dt),
        })
        for dt in steps
    }
    runs = yield list(cases.values())
    exact = elastica.tip_loaded(_LOAD, np.linspace(0.0, 1.0, 11)).tip[1]
    results = []
    for dt, case in cases.items():
        tip = -float(last_state(runs[case.key]).positions[-1, 1]) / BASE.length
        results.append(Result(f"tip load F L²/EI = {_LOAD:g} at rest after a damped motion, dt = {1e3 * dt:g} ms",
                              "direct, sdirk3", tip, exact, abs(tip / exact - 1.0), GATE, "L"))
    caption = (
        "Where a damped motion of the direct solver (default scheme) comes to rest under the same load, against the "
        "time "
        f"step: between {number(min(r.value for r in results), 6)} and {number(max(r.value for r in results), 6)} L."
    )
    draw = pictures.orders("time step (s)", "relative error of the deflection",
                           {"direct": (steps, [r.error for r in results])}, (), (GATE, "gate"))
    return Finding(tuple(results), draw, caption)


_STURDY = Wire(radius=5e-3)  # few enough substeps for many sweeps
_SWEEPS = (2, 4, 8, 16, 32, 64)


def _sweeps() -> Plan:
    force = _LOAD * _STURDY.bending / _STURDY.length**2
    base = scenes.settled("xpbd", _STURDY, {
        **scenes.wire_parameters(_STURDY), "tipForce": [0.0, -force, 0.0]})
    cases = {
        (m, factor): Case(f"m={m}-substep={factor}", {
            **base, "constraintSolverSteps": m, "substeps": math.ceil(base["substeps"] / factor)})
        for m in _SWEEPS for factor in (1, 8)
    }
    runs = yield list(cases.values())
    exact = elastica.tip_loaded(_LOAD, np.linspace(0.0, 1.0, 11)).tip[1]
    results, series = [], {}
    for factor in (1, 8):
        errors = []
        for m in _SWEEPS:
            run = runs[cases[m, factor].key]
            tip = -float(last_state(run).positions[-1, 1]) / _STURDY.length
            lost = run.outcome == "diverged"
            error = math.nan if lost else abs(tip / exact - 1.0)
            errors.append(error)
            doubtful = solver_report(run, "stepsNotConverged") / run.measured("steps")
            says = "diverged" if lost else (
                "says converged" if doubtful == 0.0 else f"says not converged in {percent(doubtful)} of steps")
            results.append(Result(
                f"tip load F L²/EI = {_LOAD:g}, r = 5 mm, {factor} times the default substep, m = {m}; {says}", "xpbd",
                tip, exact, error, GATE if doubtful == 0.0 and not lost else None, "L", wall_time(run),
            ))
        series[f"substep x {factor}"] = (_SWEEPS, errors)
    caption = (
        "xpbd: error of the tip's deflection after a damped motion against the number of sweeps m, at two lengths of "
        "the "
        "substep. The gate holds where the run says that it has converged; runs that diverged are not drawn."
    )
    draw = pictures.orders("sweeps m of a substep", "relative error of the deflection", series, (), (GATE, "gate"))
    return Finding(tuple(results), draw, caption)


_GAIN_TIME = 0.5  # s


def _gains() -> Plan:
    """The thesis's transversal run: what its answer depends on. Nothing here is right or wrong, so nothing is gated."""
    base = {
        "solver": "pbd", "guidewireLength": 300.0, "guidewireOffset": -120.0, "displacement": 10.0,
        "displacementDirection": [0.0, 1.0, 0.0], "numberRodElements": 30, "constraintSolverSteps": 500,
        "timeStep": 0.01, "logSpheres": "last", "proximalEnd": "held",
    }
    varied = {
        "m": ("constraintSolverSteps", (250, 500, 1000, 2000)),
        "n": ("numberRodElements", (15, 30, 60, 120)),
        "dt": ("timeStep", (0.02, 0.01, 0.005, 0.0025)),
    }

    def case(name: str, key: str, value: float) -> Case:
        overrides = {**base, key: value}
        return Case(f"{name}={value:g}", {**overrides, "maxSimulationSteps": round(_GAIN_TIME / overrides["timeStep"])})

    cases = {(name, value): case(name, key, value) for name, (key, values) in varied.items() for value in values}
    runs = yield list(cases.values())
    default = None
    places: dict[str, list[float]] = {name: [] for name in varied}
    for (name, value), one in cases.items():
        entry = float(read_log(runs[one.key].folder).final_positions[-1, 1])
        places[name].append(entry)
        default = entry if (name, value) == ("m", 500) else default
    results = [
        Result(f"transversal run of the thesis, tip across after {_GAIN_TIME:g} s, {name} = {value:g}", "pbd",
               place, default, abs(place / default - 1.0), None, "units", None, "of the default run")
        for name, (_, values) in varied.items() for value, place in zip(values, places[name])
    ]

    def draw(figure) -> None:
        axes = figure.add_subplot()
        for marker, (name, (_, values)) in zip(pictures.MARKERS, varied.items()):
            middle = {"m": 500, "n": 30, "dt": 0.01}[name]
            axes.plot(np.array(values) / middle, places[name], marker + "-", fillstyle="none", label=name)
        axes.set_xscale("log", base=2)
        axes.set_xlabel("m, n or dt over its default (1)")
        axes.set_ylabel("tip across after 0.5 s (units)")
        pictures.outside_legend(axes)

    caption = (
        "With gains there is no such independence: the tip of the thesis's transversal run after 0.5 s for other m, n "
        "and "
        "dt than its own (500, 30, 0.01 s). More sweeps, more elements or smaller steps make another wire."
    )
    return Finding(tuple(results), draw, caption)


CHECKS = (
    Check("elements-and-tolerance", SECTION, "direct: n and solverTolerance", _elements_and_tolerance),
    Check("time-step", SECTION, "direct: time step", _time_step),
    Check("sweeps", SECTION, "xpbd: sweeps", _sweeps),
    Check("gains", SECTION, "pbd: gains", _gains),
)
