"""Error against wall time per simulated second for every solver, on three problems."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from analysis.figures.wording import number, percent
from analysis.runs import Run
from analysis.validation import beam, elastica, pictures, scenes
from analysis.validation.check import Check, Finding, Plan, Result
from analysis.validation.dynamics import RELEASE_GATE, RELEASE_LOAD, RELEASE_TIME, release, release_error
from analysis.validation.states import last_state, tip_motion, wall_time_per_second
from analysis.validation.wire import BASE
from studies.keys import run_key
from studies.table import Case

_GRAVITY = 9.81  # m/s^2
_REPEATS = 3
_PROBLEMS = ("static", "release", "twist")
_FIRST = 2.0 * math.pi * beam.frequencies(BASE, 1)[0]  # rad/s
_REST_TIME = 15.0 / _FIRST  # s; a critically damped motion is over
_TURN = 0.5 * math.pi
_TWIST_FREQUENCY = 0.5 / BASE.length * math.sqrt(BASE.shear_modulus / BASE.density)  # Hz
_TWIST_TIME = 2e-3  # s, six periods of the slowest wave of twist

_TUNED = {"constraintSolverSteps": 500, "numberRodElements": 30, "timeStep": 1e-3}  # where pbd's gain is tuned
_PBD = {"solver": "pbd", "stretchStiffness": 1.0, "totalMass": 0.01, "displacement": 0.0, **_TUNED}
_PBD_TWIST_TIME = 0.4  # s; with gains twist has no damping but that of the sweeps themselves
_GAIN_RANGE = (0.02, 1.0)  # units; one sag of the tuned wire lies between them
_TUNING_ROUNDS = 4
_TUNING_PARTS = 4


@dataclass(frozen=True)
class _Point:
    """One setting of a solver on one problem."""

    problem: str
    solver: str
    setting: str
    case: Case


def _settled(method: Mapping[str, Any], step: float) -> dict[str, Any]:
    return {
        "timeStep": step, "maxSimulationSteps": math.ceil(_REST_TIME / step),
        **scenes.damping(method.get("solver", "direct"), 2.0 * _FIRST, step),
        "logSpheres": "last", "logEvery": 1_000_000, "gravity": [0.0, -_GRAVITY, 0.0], **method,
    }


def _pbd_settled(gain: float, changed: Mapping[str, Any]) -> dict[str, Any]:
    method = {**_PBD, **changed, "bendStiffness": gain}
    return {**_settled(method, method["timeStep"]), "gravity": [0.0, -_GRAVITY / scenes.UNIT, 0.0]}


def _sag(run: Run) -> float:
    """Deflection of the tip at the end over L."""
    _, tip = tip_motion(run)
    return -float(tip[-1, 1]) / BASE.length


def _tune(wanted: float) -> scenes.Asking[float]:
    """The gain with which pbd sags as the material does, at one m, n and dt: the interval that holds it is divided
    again and again, and the last one interpolated."""
    low, high = _GAIN_RANGE
    seen: dict[float, float] = {}
    for _ in range(_TUNING_ROUNDS):
        gains = [float(g) for g in np.geomspace(low, high, _TUNING_PARTS + 1)]
        cases = {g: Case(run_key("tuning", {"gain": g}), _pbd_settled(g, {})) for g in gains if g not in seen}
        runs = yield list(cases.values())
        seen |= {g: _sag(runs[case.key]) for g, case in cases.items()}
        low = max((g for g in gains if seen[g] >= wanted), default=math.nan)
        high = min((g for g in gains if seen[g] < wanted), default=math.nan)
        if not low < high:
            return math.nan
    share = math.log(seen[low] / wanted) / math.log(seen[low] / seen[high])
    return low * (high / low) ** share


_EXPLICIT_COUNTS = (8, 15, 30)
_RELEASE_COUNTS = (10, 20, 30)
_LIMITS: dict[str, dict[str, Any]] = {
    f"limit-{n}": {"numberRodElements": n} for n in (*_EXPLICIT_COUNTS, *_RELEASE_COUNTS)
} | {f"limit-clamped-{n}": {"numberRodElements": n, "distalEnd": "clamped"} for n in _EXPLICIT_COUNTS}


def _explicit(step: float, stable: float) -> dict[str, Any]:
    return {"solver": "explicit", **scenes.explicit_steps(step, stable)}


def _xpbd(substeps: int, sweeps: int) -> dict[str, Any]:
    return {"solver": "xpbd", "substeps": substeps, "constraintSolverSteps": sweeps}


def _xpbd_name(elements: int, step: float, substeps: int, sweeps: int) -> str:
    return f"n = {elements}, substep {number(1e6 * step / substeps, 2)} µs, m = {sweeps}"


def _static_points(gain: float, stable: Mapping[str, float]) -> list[_Point]:
    points = [
        ("direct", f"n = {n}, dt = {1e3 * dt:g} ms", {**_settled({"integrator": "implicitEuler"}, dt),
                                                    "numberRodElements": n})
        for n, dt in ((8, 4e-3), (15, 4e-3), (30, 4e-3), (60, 2e-3))
    ]
    points += [
        ("explicit", f"n = {n}", _settled({**_explicit(2e-4, stable[f"limit-{n}"]), "numberRodElements": n}, 2e-4))
        for n in _EXPLICIT_COUNTS
    ]
    points += [
        ("xpbd", _xpbd_name(n, 1e-3, k, m), _settled({**_xpbd(k, m), "numberRodElements": n}, 1e-3))
        for n, k, m in ((8, 180, 1), (15, 320, 1), (30, 400, 1), (30, 600, 1), (30, 1000, 1), (30, 4000, 1),
                        (30, 300, 3), (30, 1000, 3), (30, 100, 30))
    ]
    points += [("pbd", _pbd_name(changed), _pbd_settled(gain, changed)) for changed in _PBD_CHANGES]
    return [_Point("static", solver, setting, _case("static", k, overrides))
            for k, (solver, setting, overrides) in enumerate(points)]


_PBD_CHANGES: tuple[dict[str, Any], ...] = (
    {}, {"constraintSolverSteps": 125}, {"constraintSolverSteps": 250}, {"constraintSolverSteps": 1000},
    {"constraintSolverSteps": 2000}, {"numberRodElements": 15}, {"timeStep": 5e-4},
)


def _pbd_name(changed: Mapping[str, Any]) -> str:
    words = {"constraintSolverSteps": "m", "numberRodElements": "n", "timeStep": "dt"}
    return ", ".join(f"{words[key]} = {value:g}" for key, value in changed.items()) or "as tuned"


def _release_points(gain: float, stable: Mapping[str, float]) -> list[_Point]:
    points: list[tuple[str, str, dict[str, Any], Mapping[str, Any] | None]] = [
        ("direct", f"{scheme}, n = {n}, {1e3 * dt:g} ms", release(n, dt, {"integrator": scheme}), None)
        for scheme, n, dt in (
            ("implicitEuler", 12, 1e-3), ("implicitEuler", 12, 1e-4), ("bdf2", 12, 5e-4), ("bdf2", 12, 2.5e-4),
            ("esdirk3", 10, 4e-3), ("esdirk3", 12, 2e-3), ("esdirk3", 12, 1e-3), ("esdirk4", 10, 4e-3),
            ("esdirk4", 12, 2e-3), ("esdirk4", 16, 1e-3), ("esdirk4", 30, 5e-4),
        )
    ]
    points += [
        ("explicit", f"n = {n}", release(n, 2e-4, _explicit(2e-4, stable[f"limit-{n}"])), None) for n in _RELEASE_COUNTS
    ]
    points += [
        ("xpbd", _xpbd_name(n, 2e-4, k, m), release(n, 2e-4, _xpbd(k, m)), None)
        for n, k, m in ((10, 45, 1), (20, 80, 1), (30, 80, 1), (30, 120, 1), (30, 200, 1), (30, 1000, 1), (30, 60, 3),
                        (30, 20, 30))
    ]
    for changed in _PBD_CHANGES:
        method = {**_PBD, **changed, "bendStiffness": gain}
        n, step = method["numberRodElements"], method["timeStep"]
        shape = elastica.tip_loaded(RELEASE_LOAD, np.linspace(0.0, 1.0, n + 1))
        points.append((
            "pbd", _pbd_name(changed),
            {**method, "maxSimulationSteps": round(RELEASE_TIME / step), "logSpheres": "last"},
            scenes.plane_start(BASE.length * shape.along, BASE.length * shape.across),
        ))
    return [_Point("release", solver, setting, _case("release", k, overrides, start))
            for k, (solver, setting, overrides, start) in enumerate(points)]


def _twist_points(gain: float, stable: Mapping[str, float]) -> list[_Point]:
    omega = 2.0 * math.pi * _TWIST_FREQUENCY

    def turned(method: Mapping[str, Any], step: float, n: int = scenes.ELEMENTS) -> dict[str, Any]:
        return {
            "numberRodElements": n, "distalEnd": "clamped", "distalRotation": _TURN, "timeStep": step,
            **scenes.damping(method.get("solver", "direct"), 2.0 * omega, step),
            "maxSimulationSteps": math.ceil(_TWIST_TIME / step),
            "logEvery": 1_000_000, "logOrientations": True, "distalRampTime": 0.05 / _TWIST_FREQUENCY, **method,
        }

    points = [("direct", f"n = {n}, dt = {1e6 * dt:g} µs", turned({"integrator": "implicitEuler"}, dt, n))
              for n, dt in ((8, 2e-5), (15, 2e-5), (30, 2e-5))]
    points += [("explicit", f"n = {n}", turned(_explicit(4e-6, stable[f"limit-clamped-{n}"]), 4e-6, n))
               for n in _EXPLICIT_COUNTS]
    points += [("xpbd", _xpbd_name(n, 4e-6, k, m), turned(_xpbd(k, m), 4e-6, n))
               for n, k, m in ((8, 1, 1), (15, 1, 1), (30, 1, 1), (30, 2, 1), (30, 4, 1), (30, 16, 1), (30, 1, 3),
                               (30, 1, 10))]
    for changed in _PBD_CHANGES:
        method = {**_PBD, **changed, "bendStiffness": gain, "damping": 0.0}
        method["maxSimulationSteps"] = round(_PBD_TWIST_TIME / method["timeStep"])
        points.append(("pbd", _pbd_name(changed), turned(method, method["timeStep"])))
    return [_Point("twist", solver, setting, _case("twist", k, overrides))
            for k, (solver, setting, overrides) in enumerate(points)]


def _case(problem: str, number_: int, overrides: Mapping[str, Any], start: Mapping[str, Any] | None = None) -> Case:
    quick = overrides.get("solver", "direct") in ("direct", "pbd")
    return Case(f"{problem}-{number_}", overrides, _REPEATS if quick else 1, start)


def _twist_error(run: Run) -> float:
    """Worst difference of an inner element's turn from the linear profile, over the turn."""
    twists = last_state(run).twists / _TURN
    return float(np.max(np.abs(twists - _linear(len(twists)))[2:-2]))


def _linear(n: int) -> np.ndarray:
    """Turn of the elements' middles between two clamps over the whole turn, shape (n,)."""
    return (np.arange(n) + 0.5) / n


def _pbd_twist_error(n: int) -> float:
    """The same for sweeps with gains at rest: inner joints share the turn, the first and the last take half a share."""
    found = (np.arange(n) - 0.5) / (n - 2)
    return float(np.max(np.abs(found - _linear(n))[2:-2]))


def _chart() -> Plan:
    load = BASE.line_density * _GRAVITY * BASE.length**3 / BASE.bending
    wanted = elastica.heavy(load, np.linspace(0.0, 1.0, 11)).tip[1]
    gain = yield from _tune(wanted)
    stable = yield from scenes.stable_substeps(_LIMITS)
    points = [*_static_points(gain, stable), *_release_points(gain, stable), *_twist_points(gain, stable)]
    runs = yield [point.case for point in points]
    measure = {"static": lambda run: abs(_sag(run) / wanted - 1.0), "release": release_error, "twist": _twist_error}
    what = {"static": "own weight, damped to rest: deflection of the tip", "release": "cantilever let go, 0.2 s: RMS",
            "twist": "one end turned by 90°, damped to rest: profile"}
    results = [
        Result(what[point.problem], f"{point.solver}, {point.setting}", error, math.nan, error, None, "",
               wall_time_per_second(runs[point.case.key], point.case.repeats))
        for point in points for error in (_finite(measure[point.problem], runs[point.case.key]),)
    ]

    def draw(figure) -> None:
        titles = ("(a) sag under own weight", "(b) cantilever let go", "(c) turned by 90°")
        for axes, problem, title in zip(figure.subplots(1, 3), _PROBLEMS, titles):
            for k, (solver, marker) in enumerate(zip(("pbd", "xpbd", "explicit", "direct"), pictures.MARKERS)):
                at = [(r.cost, r.error) for point, r in zip(points, results)
                      if point.problem == problem and point.solver == solver and np.isfinite(r.error)]
                if at:
                    axes.plot(*np.transpose(at), marker, color=f"C{k}", fillstyle="none", label=solver)
            axes.set_title(title)
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.set_xlabel("wall time per simulated second (1)")
            axes.set_ylabel("relative error (1)")
        figure.axes[0].legend()
        figure.axes[1].axhline(RELEASE_GATE, linestyle="--", color="0.3", linewidth=1.0)

    clamps = percent(_pbd_twist_error(_TUNED["numberRodElements"]))
    caption = (
        "Error against wall time per simulated second, one thread, median of "
        f"{_REPEATS} timed runs (explicit and xpbd: of one). (a) The base wire under its own weight, critically damped "
        "to rest: relative error of the tip's sag. (b) Let go from F L²/EI = 0.1: RMS error of the tip over 0.2 s; "
        "dashed: 0.3 %. (c) One end turned by 90° between two clamps, damped to rest: worst error of the linear "
        "profile. pbd's bendStiffness is tuned so that the wire of (a) sags as the material does at m = 500, n = 30, "
        f"dt = 1 ms (stretchStiffness 1, totalMass 0.01): {number(gain, 4)}. The other pbd points, and those of (b) "
        "and (c), have the same gains; they differ in m, n or dt: " + _pbd_spread(points, results)
        + " pbd's clamps hold the frames of the first and the last element, whose joints take half of an inner one's "
          f"share, so in (c) the turn is spread over n - 2 elements: {clamps} at n = 30. "
        + "The other solvers have the material itself; their points differ in n, time step, scheme, substeps and "
          "sweeps. " + _lost(points, results) + _best(points, results)
    )
    return Finding(tuple(results), draw, caption, width=12.0)


def _finite(measure, run: Run) -> float:
    """An error, or not a number where the run was lost."""
    error = math.nan if run.outcome in ("diverged", "failed") else measure(run)
    return error if math.isfinite(error) else math.nan


def _pbd_spread(points: Sequence[_Point], results: Sequence[Result]) -> str:
    errors = [f"{point.setting}: {percent(r.error)}" for point, r in zip(points, results)
              if point.solver == "pbd" and point.problem == "static"]
    return "errors in (a) " + "; ".join(errors) + "."


def _lost(points: Sequence[_Point], results: Sequence[Result]) -> str:
    """Which runs are not drawn."""
    lost = [f"{point.solver}, {point.setting} ({'abc'[_PROBLEMS.index(point.problem)]})"
            for point, r in zip(points, results) if not math.isfinite(r.error)]
    return f"Not drawn, because they diverged: {'; '.join(lost)}. " if lost else ""


def _best(points: Sequence[_Point], results: Sequence[Result]) -> str:
    """For every solver the cheapest way to an error below 1 % in (b)."""
    sentences = []
    for solver in ("pbd", "xpbd", "explicit", "direct"):
        good = [r for point, r in zip(points, results)
                if point.problem == "release" and point.solver == solver and r.error < 1e-2]
        best = min(good, key=lambda r: r.cost, default=None)
        sentences.append(f"{solver} never" if best is None else f"{solver} {number(best.cost, 2)}")
    return "Wall time per simulated second at an error below 1 % in (b): " + ", ".join(sentences) + "."


CHART = Check("chart", "Chart", "error against wall time", _chart)
CHECKS = (CHART,)
