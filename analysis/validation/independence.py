"""Checks that results with a material are independent of iterations, steps and elements, and that those of pbd are
not."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from analysis.validation import beam, elastica, pictures, scenes, spatial
from analysis.validation.dynamics import RELEASE_TIME, release, release_error, release_reference, rms_error
from analysis.validation.states import last_state, solver_report, tip_at, wall_time, wall_time_per_second
from analysis.validation.wire import BASE, STURDY, Wire
from guidewire.figures.wording import number, percent, span
from guidewire.logs.logs import read_log
from guidewire.studies.keys import run_key, value_text
from guidewire.studies.table import Axis, Case, Grid
from guidewire.sweeps.check import Check, Finding, Plan, Result, by_point

SECTION = "Independence"
GATE = 2e-2
_LOAD = 2.0  # F L^2/EI
_FORCE = _LOAD * BASE.bending / BASE.length**2
_GRAVITY = 9.81  # m/s^2
_COUNTS = (20, 40, 80, 160)
_THIN = Wire(radius=0.2e-3)


@dataclass(frozen=True)
class _Static:
    """A rest shape and where its tip belongs, m, shape (3,)."""

    title: str
    parameters: Mapping[str, Any]
    tip: np.ndarray


def _in_plane(tip: tuple[float, float]) -> np.ndarray:
    """Return a tip along z and against y, over L, as a place in m."""
    return BASE.length * np.array([0.0, -tip[1], tip[0]])


def _statics() -> list[_Static]:
    points = np.linspace(0.0, 1.0, 11)
    shapes = [
        _Static(f"tip load F L²/EI = {k:g}", {"tipForce": [0.0, -k * BASE.bending / BASE.length**2, 0.0]},
                _in_plane(elastica.tip_loaded(k, points).tip))
        for k in (0.1, 1.0, 2.0, 10.0, 100.0)
    ]
    shapes += [
        _Static(f"own weight, r = {1e3 * wire.radius:g} mm",
                {**scenes.wire_parameters(wire), "gravity": [0.0, -_GRAVITY, 0.0]},
                _in_plane(elastica.heavy(wire.line_density * _GRAVITY * wire.length**3 / wire.bending, points).tip))
        for wire in (BASE, _THIN)
    ]
    # A half circle: the ring's tip is back at the root, so that its place has no relative error.
    shapes.append(_Static("couple M L/EI = π", {
        "tipMoment": [math.pi * BASE.bending / BASE.length, 0.0, 0.0], "clampRule": "halfElement",
    }, _in_plane(elastica.arc(math.pi, points).tip)))
    bend = spatial.bathe_bolourchi()
    shapes.append(_Static("45° bend", scenes.bend_parameters(bend), bend.rod.tip(bend.force)))
    return shapes


def _elements() -> Plan:
    statics = _statics()
    shapes = {f"shape-{k}": scenes.at_rest(static.parameters) for k, static in enumerate(statics)}
    runs = by_point((yield Grid((Axis("numberRodElements", _COUNTS),), variants=shapes).cases()))
    results, series = [], {}
    for name, static in zip(shapes, statics):
        size = float(np.linalg.norm(static.tip))
        errors = []
        for n in _COUNTS:
            run = runs[name, n]
            tip = last_state(run).positions[-1]
            errors.append(float(np.linalg.norm(tip - static.tip)) / size)
            results.append(Result(f"{static.title}, n = {n}: distance of the tip from the root", "direct",
                                  float(np.linalg.norm(tip)), size, errors[-1], GATE, "m", wall_time(run),
                                  "of it, position of the tip"))
        series[static.title] = (_COUNTS, errors)
    caption = (
        "Position of the tip in nine rest shapes over the number of elements, n = 20 to 160, against the elastica (and "
        f"the rod in space for the 45° bend): off by at most {percent(max(r.error for r in results))}. The error "
        "that remains with many elements is due to stretch and shear, which the elastica does not have."
    )
    draw = pictures.orders("number of elements n", "error of the tip's position (of its distance)", series,
                           [(-2.0, "order 2")], (GATE, "gate"))
    return Finding(tuple(results), draw, caption)


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
    omega = 2.0 * math.pi * beam.frequencies(BASE, 1)[0]
    settled = {
        dt: Case(run_key("settled", {"dt": dt}), {
            "tipForce": [0.0, -_FORCE, 0.0], "timeStep": dt, "massDamping": 2.0 * omega, "logEvery": 1_000_000,
            "maxSimulationSteps": math.ceil(15.0 / omega / dt),
        })
        for dt in _TIME_STEPS
    }
    schemes = ("esdirk3", "esdirk4")
    moving = {(scheme, dt): Case(run_key(scheme, {"dt": dt}), release(12, dt, {"integrator": scheme}))
              for scheme in schemes for dt in _TIME_STEPS}
    runs = yield [*settled.values(), *moving.values()]
    exact = elastica.tip_loaded(_LOAD, np.linspace(0.0, 1.0, 11)).tip[1]
    results = []
    for dt, case in settled.items():
        tip = -float(last_state(runs[case.key]).positions[-1, 1]) / BASE.length
        results.append(Result(f"tip load F L²/EI = {_LOAD:g} at rest after a damped motion, dt = {1e3 * dt:g} ms",
                              "direct, esdirk3", tip, exact, abs(tip / exact - 1.0), GATE, "L",
                              wall_time_per_second(runs[case.key])))
    series = {"at rest": (_TIME_STEPS, [r.error for r in results])}
    time = np.array([RELEASE_TIME])
    for scheme in schemes:
        errors = []
        for dt in _TIME_STEPS:
            run = runs[moving[scheme, dt].key]
            errors.append(release_error(run))
            results.append(Result(
                f"released cantilever, n = 12, dt = {1e3 * dt:g} ms: tip at the end", f"direct, {scheme}",
                -float(tip_at(run, time)[0, 1]), float(release_reference()[0].across[-1]), errors[-1], GATE, "m",
                wall_time_per_second(run), "RMS of the motion"))
        series[f"let go, {scheme}"] = (_TIME_STEPS, errors)
    caption = (
        "What the time step changes from 0.1 to 4 ms: the rest shape under a load after a damped motion, "
        f"{span([r.value for r in results[:6]], 6)} L, and the "
        f"released cantilever, off by at most {percent(max(r.error for r in results[6:]))} over 0.2 s. The error of "
        "the second goes down to that of 12 elements."
    )
    draw = pictures.orders("time step (s)", "error (relative)", series, (), (GATE, "gate"))
    return Finding(tuple(results), draw, caption)


_SWEEPS = (2, 4, 8, 16, 32, 64)


def _sweeps() -> Plan:
    force = _LOAD * STURDY.bending / STURDY.length**2
    base = yield from scenes.settled("xpbd", STURDY, {
        **scenes.wire_parameters(STURDY), "tipForce": [0.0, -force, 0.0]})
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
            tip = -float(last_state(run).positions[-1, 1]) / STURDY.length
            lost = run.outcome == "diverged"
            error = math.nan if lost else abs(tip / exact - 1.0)
            errors.append(error)
            unconverged = solver_report(run, "stepsNotConverged") / run.measured("steps")
            says = "diverged" if lost else (
                "reports convergence" if unconverged == 0.0
                else f"reports no convergence in {percent(unconverged)} of steps")
            results.append(Result(
                f"tip load F L²/EI = {_LOAD:g}, r = 5 mm, {factor} times the default substep, m = {m}; {says}", "xpbd",
                tip, exact, error, GATE if unconverged == 0.0 and not lost else None, "L", wall_time(run),
            ))
        series[f"substep x {factor}"] = (_SWEEPS, errors)
    caption = (
        "xpbd: error of the tip's deflection after a damped motion against the number of sweeps m, at two lengths of "
        "the substep. The gate holds where the run says that it has converged; runs that diverged are not drawn."
    )
    draw = pictures.orders("iterations m of a substep", "relative error of the deflection", series, (), (GATE, "gate"))
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
    Check("elements", SECTION, "direct: number of elements", _elements),
    Check("tolerance", SECTION, "direct: solverTolerance", _tolerance),
    Check("time-step", SECTION, "direct: time step", _time_step),
    Check("sweeps", SECTION, "xpbd: iterations", _sweeps),
    Check("gains", SECTION, "pbd: stiffness per iteration", _gains),
)
