"""Checks that results with a material are independent of tolerance and time step, and that those of pbd are not."""

from __future__ import annotations

from typing import Any

import numpy as np

from analysis.validation import pictures, scenes
from analysis.validation.dynamics import RELEASE_TIME, release, release_error, release_reference, rms_error
from analysis.validation.states import last_state, tip_at, wall_time, wall_time_per_second
from analysis.validation.wire import BASE
from guidewire.figures.wording import number, percent
from guidewire.logs.logs import read_log
from guidewire.studies.keys import run_key, value_text
from guidewire.studies.table import Axis, Case, Grid
from guidewire.sweeps.check import Check, Finding, Plan, Result

SECTION = "Independence"
GATE = 2e-2
_LOAD = 2.0  # F L^2/EI
_FORCE = _LOAD * BASE.bending / BASE.length**2

_TOLERANCES = (1e-12, 1e-10, 1e-8, 1e-7)


def _tolerance() -> Plan:
    """From exact to the default; the run that states none reports the one that it took."""
    loads = {"tipForce": [0.0, -_FORCE, 0.0]}
    keys: dict[str, dict[str, Any]] = {value_text(t): {"solverTolerance": t} for t in _TOLERANCES} | {"default": {}}
    kinds = {
        "tip load F L²/EI = 2: deflection": lambda extra: scenes.at_rest({**loads, **extra}),
        "released cantilever, esdirk3, 1 ms": lambda extra: release(12, 1e-3, extra),
        "released cantilever, bdf2, 0.25 ms": lambda extra: release(
            12, 2.5e-4, {"integrator": "bdf2", **extra}),
        "released cantilever, esdirk4, 2 ms": lambda extra: release(12, 2e-3, {"integrator": "esdirk4", **extra}),
    }
    cases = {(kind, name): Case(f"{k}-{name}", make(extra))
             for k, (kind, make) in enumerate(kinds.items()) for name, extra in keys.items()}
    runs = yield list(cases.values())
    time = np.linspace(0.0, 0.2, 201)
    results, series = [], {}
    for kind in kinds:
        static = "released" not in kind
        found = {name: last_state(runs[cases[kind, name].key]).positions[-1, 1:2] if static
                 else tip_at(runs[cases[kind, name].key], time)[:, 1] for name in keys}
        finest = found[value_text(min(_TOLERANCES))]
        errors = []
        for name in list(keys)[1:]:
            run = runs[cases[kind, name].key]
            tolerance = run.number("solverTolerance")
            errors.append((tolerance, rms_error(found[name], finest)))
            said = f"{tolerance:g}" + (" (the default)" if name == "default" else "")
            results.append(Result(
                f"{kind}, solverTolerance {said} against {min(_TOLERANCES):g}: tip at the end", "direct",
                float(found[name][-1]), float(finest[-1]), errors[-1][1], GATE, "m",
                wall_time(run) if static else wall_time_per_second(run), "relative" if static else "RMS of the motion"))
        series[kind] = tuple(zip(*errors))
    default = runs[cases[next(iter(kinds)), "default"].key].number("solverTolerance")
    caption = (
        f"What solverTolerance changes, up to its default of {default:g}: rest shape and motions against those of "
        f"{min(_TOLERANCES):g}. The largest change is {number(max(r.error for r in results), 1)}. A rest shape is "
        "searched to 1e-9 or better whatever the tolerance, so its change is rounding."
    )
    draw = pictures.orders("solverTolerance (1)", "change of the tip's position (relative)", series, (), (GATE, "gate"))
    return Finding(tuple(results), draw, caption)


_TIME_STEPS = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 4e-3)  # s


def _time_step() -> Plan:
    schemes = ("esdirk3", "esdirk4")
    cases = {(scheme, dt): Case(run_key(scheme, {"dt": dt}), release(12, dt, {"integrator": scheme}))
             for scheme in schemes for dt in _TIME_STEPS}
    runs = yield list(cases.values())
    time, wanted = np.array([RELEASE_TIME]), float(release_reference()[0].across[-1])
    results = []
    for (scheme, dt), case in cases.items():
        run = runs[case.key]
        results.append(Result(
            f"released cantilever, n = 12, dt = {1e3 * dt:g} ms: tip at the end", f"direct, {scheme}",
            -float(tip_at(run, time)[0, 1]), wanted, release_error(run), GATE, "m", wall_time_per_second(run),
            "RMS of the motion"))
    series = {scheme: (_TIME_STEPS, [r.error for r in results if r.solver.endswith(scheme)]) for scheme in schemes}
    caption = (
        "What the time step changes from 0.1 to 4 ms: the released cantilever is off by at most "
        f"{percent(max(r.error for r in results))} over 0.2 s. The error goes down to that of 12 elements."
    )
    draw = pictures.orders("time step (s)", "error (relative)", series, (), (GATE, "gate"))
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

    cases = {
        (name, case.values[key]): case for name, (key, values) in varied.items()
        for case in Grid((Axis(key, values),), base, duration=_GAIN_TIME).cases()
    }
    runs = yield list(cases.values())
    default = None
    places: dict[str, list[float]] = {name: [] for name in varied}
    for (name, value), one in cases.items():
        entry = float(read_log(runs[one.key].folder).final_positions[-1, 1])
        places[name].append(entry)
        default = entry if (name, value) == ("m", 500) else default
    results = [
        Result(f"transversal run of the thesis, tip across after {_GAIN_TIME:g} s, {name} = {value:g}", "pbd",
               place, default, abs(place / default - 1.0), None, "units",
               wall_time_per_second(runs[cases[name, value].key]), "of the default run")
        for name, (_, values) in varied.items() for value, place in zip(values, places[name])
    ]

    def draw(figure) -> None:
        axes = figure.add_subplot()
        for marker, (name, (_, values)) in zip(pictures.MARKERS, varied.items()):
            middle = {"m": 500, "n": 30, "dt": 0.01}[name]
            axes.plot(np.array(values) / middle, places[name], marker + "-", fillstyle="none", label=name)
        axes.set_xscale("log", base=2)
        pictures.label(axes, "m, n or dt over its default (1)", "tip across after 0.5 s (units)")

    caption = (
        "With pbd there is no such independence: the tip of the thesis's transversal run after 0.5 s for other m, n "
        "and dt than its own (500, 30, 0.01 s). More sweeps, more elements or smaller steps make another wire."
    )
    return Finding(tuple(results), draw, caption)


CHECKS = (
    Check("tolerance", SECTION, "direct: solverTolerance", _tolerance),
    Check("time-step", SECTION, "direct: time step", _time_step),
    Check("gains", SECTION, "pbd: stiffness per iteration", _gains),
)
