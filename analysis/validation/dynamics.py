"""Checks of motion against exact solutions: a released cantilever, a struck bar."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes
from analysis.validation.bar import BarChain
from analysis.validation.release import Release, tip_motion
from analysis.validation.states import tip_at, wall_time_per_second
from analysis.validation.states import tip_motion as logged_tip
from analysis.validation.wire import BASE
from guidewire.figures.wording import beside, number, percent
from guidewire.logs.runs import Run, read_repeats
from guidewire.studies.table import Case
from guidewire.sweeps.check import TUNED, Check, Finding, Plan, Result, not_run

SECTION = "Dynamics"

SCHEMES = {"implicitEuler": 1, "bdf2": 2, "trbdf2": 2, "esdirk3": 3, "esdirk4": 4}  # the direct solver's; their order

RELEASE_LOAD = 0.1  # F L^2/EI
RELEASE_TIME = 0.2  # s
RELEASE_GATE = 3e-3
COST_GATE = 220.0  # element-iterations of the sweep at n = 30 that a simulated millisecond may cost
_SAMPLES = 2001
_REPEATS = 3
_TIMED_STEPS = 5000


@lru_cache(maxsize=None)
def release_reference() -> tuple[Release, float]:
    """Return the reference motion, and how far it is from one with fewer modes (RMS, relative): its own error or
    more."""
    fine = tip_motion(BASE, RELEASE_LOAD, RELEASE_TIME, _SAMPLES, modes=14)
    coarse = tip_motion(BASE, RELEASE_LOAD, RELEASE_TIME, _SAMPLES, modes=10)
    return fine, rms_error(coarse.across, fine.across)


def rms_error(values: np.ndarray, reference: np.ndarray) -> float:
    """RMS of the difference over RMS of the reference."""
    return float(np.sqrt(np.mean((values - reference) ** 2) / np.mean(reference**2)))


def release_error(run: Run) -> float:
    """Error of a run that was let go, over 2001 samples of 0.2 s."""
    reference, _ = release_reference()
    if run.outcome in ("diverged", "failed"):
        return math.inf
    return rms_error(-tip_at(run, reference.time)[:, 1], reference.across)


def release(elements: int, time_step: float, method: Mapping[str, Any]) -> dict[str, Any]:
    """Return a cantilever released from its rest shape under a tip load."""
    force = RELEASE_LOAD * BASE.bending / BASE.length**2
    return {
        "numberRodElements": elements, "timeStep": time_step, "initialState": "equilibrium",
        "tipForce": [0.0, -force, 0.0], "tipForceReleaseTime": 0.0,
        "maxSimulationSteps": round(RELEASE_TIME / time_step), "logSpheres": "last", **method,
    }


def timed_release(key: str, elements: int, time_step: float, method: Mapping[str, Any]) -> Case:
    """Return the same motion for so many steps that the runner's first ones, still being compiled, do not count."""
    steps = max(_TIMED_STEPS, round(RELEASE_TIME / time_step))
    parameters = {**release(elements, time_step, method), "maxSimulationSteps": steps, "logEvery": 1_000_000_000}
    return Case(f"{key}-timed", parameters, repeats=_REPEATS)


_RELEASES = {
    "esdirk3, n = 10, 1 ms": (10, 1e-3, {"integrator": "esdirk3"}),
    "esdirk3, n = 10, 2 ms": (10, 2e-3, {"integrator": "esdirk3"}),
    "esdirk4, n = 40, 0.1 ms": (40, 1e-4, {"integrator": "esdirk4"}),
    "esdirk3, n = 12, 2 ms": (12, 2e-3, {"integrator": "esdirk3"}),
    "esdirk4, n = 10, 4 ms": (10, 4e-3, {"integrator": "esdirk4"}),
    "esdirk4, n = 12, 2 ms": (12, 2e-3, {"integrator": "esdirk4"}),
    "bdf2, n = 12, 0.25 ms": (12, 2.5e-4, {"integrator": "bdf2"}),
    "trbdf2, n = 12, 0.5 ms": (12, 5e-4, {"integrator": "trbdf2"}),
    "implicitEuler, n = 30, 0.1 ms": (30, 1e-4, {"integrator": "implicitEuler"}),
    "lumped, half-element clamp, esdirk3, n = 30, 0.25 ms": (
        30, 2.5e-4, {"integrator": "esdirk3", "massRule": "lumped", "clampRule": "halfElement"}),
}
_COSTED = ("esdirk3, n = 10, 2 ms",)  # the cheapest of them with an error below 0.3 %
_RELEASE_GATED = ("esdirk3, n = 10, 1 ms", "esdirk4, n = 12, 2 ms", "bdf2, n = 12, 0.25 ms")


def _release() -> Plan:
    cases = [Case(_slug(name), release(*setting)) for name, setting in _RELEASES.items()]
    timed = [timed_release(_slug(name), *setting) for name, setting in _RELEASES.items()]
    step = 2e-4
    small = []
    for solver in ("explicit", "xpbd"):
        method = yield from scenes.small_steps(solver, BASE, step, {})
        small.append(Case(solver, release(30, step, {"solver": solver, **method})))
    costs_in_turns = [Case(f"{_slug(name)}-in-turns", release(*_RELEASES[name]), in_turns=True) for name in _COSTED]
    runs = yield [*cases, *timed, *small, *costs_in_turns]
    costs = {case.key: wall_time_per_second(runs[one.key], one.repeats) for case, one in zip(cases, timed)}
    costs |= {case.key: wall_time_per_second(runs[case.key]) for case in small}
    loads = [repeat.others_busy for one in timed for repeat in read_repeats(runs[one.key], one.repeats)]
    reference, own = release_reference()
    results = []
    names = {case.key: f"direct, {name}" for case, name in zip(cases, _RELEASES)}
    names |= {case.key: f"{case.key}, n = 30" for case in small}
    for case in (*cases, *small):
        run = runs[case.key]
        gated = any(case.key == _slug(name) for name in _RELEASE_GATED)
        cost = costs[case.key]
        error = release_error(run)
        tip = -float(tip_at(run, np.array([RELEASE_TIME]))[0, 1])
        results.append(Result("released cantilever, 0.2 s: tip at the end", names[case.key], tip,
                              float(reference.across[-1]), error, RELEASE_GATE if gated else None, "m", cost, "RMS"))
    shown = list(results)
    errors = {r.solver: r.error for r in results}
    for name, case in zip(_COSTED, costs_in_turns):
        ratio, error = runs[case.key].measured("elementIterationsPerMillisecond"), errors[f"direct, {name}"]
        results.append(Result(
            "released cantilever: cost of a simulated ms with an error below 0.3 %, in element-iterations of the sweep "
            "at n = 30, both timed in turns", f"direct, {name}", ratio, COST_GATE,
            ratio if error <= RELEASE_GATE else math.inf, COST_GATE, "", None, "element-iterations a ms"))

    def draw(figure) -> None:
        motion, cost = figure.subplots(1, 2)
        motion.plot(reference.time, 1e3 * reference.across, color="0.6", linewidth=2.5, label="reference")
        for name in ("esdirk3-n10-1ms", "implicitEuler-n30-01ms"):
            key = next((case.key for case in cases if case.key == name), cases[0].key)
            time, tip = logged_tip(runs[key])
            motion.plot(time, -1e3 * tip[:, 1], linewidth=0.9, label=names[key])
        motion.set_xlabel("time (s)")
        motion.set_ylabel("deflection of the tip (mm)")
        motion.legend(loc="lower left", fontsize=6)
        for k, r in enumerate(shown):
            cost.plot(r.cost, r.error, pictures.MARKERS[k % 8], color=f"C{k % 7}", fillstyle="none", label=r.solver)
        cost.axhline(RELEASE_GATE, linestyle="--", color="0.3", linewidth=1.0)
        cost.set_xscale("log")
        cost.set_yscale("log")
        cost.set_xlabel("wall time per simulated second (1)")
        cost.set_ylabel("RMS error of the tip's motion (1)")
        cost.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=6)

    caption = (
        "A cantilever released from its rest shape under F L²/EI = 0.1. Left: motion of the tip. Right: error over "
        "0.2 s (RMS of 2001 samples, space and time together) against wall time per simulated second, of direct the "
        f"median of {_REPEATS} runs made one at a time, {beside(loads)}, of explicit and xpbd of one run beside "
        "others; dashed: 0.3 %. Reference: "
        f"geometrically exact, modes of the slope, 14 and 10 of them differ by {number(own, 1)}. "
        + "; ".join(f"{r.solver}: {percent(r.error)} at {number(r.cost, 2)}" for r in shown) + ". A "
        "simulated millisecond costs as much as "
        + ", ".join(f"{number(r.value, 3)} element-iterations of the sweep ({r.solver})" for r in results[len(shown):])
        + ", timed in turns in one process."
    )
    lines = (*results, not_run("released cantilever, 0.2 s", "pbd", TUNED))
    return Finding(lines, draw, caption, width=12.0)


def _slug(name: str) -> str:
    return "".join(c for c in name.replace(", ", "-").replace(" ", "") if c.isalnum() or c == "-")


_BAR_TIME = 2e-3  # s
BAR_ELEMENTS = 30
BAR_MASS = BASE.line_density * BASE.length / (BAR_ELEMENTS + 1)  # kg, of a sphere
BAR_SPRING = BASE.stretching * BAR_ELEMENTS / BASE.length  # N/m


def bar_gain(step: float) -> float:
    """k_A of one sweep a step that pulls as the springs do.

    A sweep moves a sphere of mass m by k e/(m D) for an extension e, D = 2/m + 4 w_q l^2 (w_q = 1, l in units): over
    dt^2 that is the acceleration s e/m of a spring s where k = s D dt^2.
    """
    length = BASE.length / BAR_ELEMENTS / scenes.UNIT
    return BAR_SPRING * (2.0 / BAR_MASS + 4.0 * length * length) * step * step


_BAR_METHODS = {
    "direct, esdirk4, 0.25 µs": ({"solver": "direct", "integrator": "esdirk4", "timeStep": 2.5e-7}, 1e-3),
    "direct, esdirk3, 0.25 µs": ({"solver": "direct", "integrator": "esdirk3", "timeStep": 2.5e-7}, None),
    "direct, bdf2, 0.25 µs": ({"solver": "direct", "integrator": "bdf2", "timeStep": 2.5e-7}, None),
    "direct, implicitEuler, 0.25 µs": ({"solver": "direct", "integrator": "implicitEuler", "timeStep": 2.5e-7}, None),
    "explicit, 0.05 µs": ({"solver": "explicit", "timeStep": 2.5e-7, "substeps": 5}, 1e-3),
    "explicit, 0.25 µs": ({"solver": "explicit", "timeStep": 2.5e-7}, None),
    "xpbd, 10 iterations, 0.25 µs": ({"solver": "xpbd", "timeStep": 2.5e-7, "constraintSolverSteps": 10}, None),
    "pbd, one iteration with the springs' stiffness, 0.25 µs": ({
        "solver": "pbd", "timeStep": 2.5e-7, "constraintSolverSteps": 1, "stretchStiffness": bar_gain(2.5e-7),
        "bendStiffness": 0.0, "totalMass": (BAR_ELEMENTS + 1) * BAR_MASS}, None),
}


def _bar() -> Plan:
    n, shift = BAR_ELEMENTS, 1e-3
    common = {
        "numberRodElements": n, "displacement": shift / scenes.UNIT, "logSpheres": "last",
        "displacementDirection": [0.0, 0.0, 1.0],
    }
    material = {"massRule": "uniform"}  # as a wire of gains has it
    cases = [
        Case(f"method-{k}", {**common, **({} if method["solver"] == "pbd" else material), **method,
                             "maxSimulationSteps": round(_BAR_TIME / method["timeStep"])})
        for k, (method, _) in enumerate(_BAR_METHODS.values())
    ]
    runs = yield cases
    chain = BarChain(n, BAR_MASS, BAR_SPRING, shift)
    results, motions = [], {}
    for case, (name, (_, gate)) in zip(cases, _BAR_METHODS.items()):
        run = runs[case.key]
        time, tip = logged_tip(run)
        moved = tip[:, 2] - BASE.length
        exact = chain.motion(time, n)
        results.append(Result(f"bar struck by 1 mm, n = {n}, 2 ms: tip at the end", name, moved[-1], exact[-1],
                              rms_error(moved, exact), gate, "m", wall_time_per_second(run), "RMS"))
        motions[name] = (time, moved)

    def draw(figure) -> None:
        axes = figure.add_subplot()
        time = np.linspace(0.0, _BAR_TIME, 2001)
        axes.plot(1e3 * time, 1e3 * chain.motion(time, n), color="0.6", linewidth=2.5, label="exact chain")
        for name in ("direct, esdirk4, 0.25 µs", "direct, implicitEuler, 0.25 µs"):
            t, moved = motions[name]
            axes.plot(1e3 * t, 1e3 * moved, linewidth=0.8, label=name)
        pictures.label(axes, "time (ms)", "displacement of the free end (mm)")

    caption = (
        "The base of a bar, 30 springs and equal masses, is displaced by 1 mm at once: motion of the free end over 2 "
        "ms against the chain's exact motion (all 30 modes). RMS error: "
        + "; ".join(f"{r.solver}: {percent(r.error)}" for r in results) + "."
    )
    return Finding(tuple(results), draw, caption)


CHECKS = (
    Check("release", SECTION, "released cantilever", _release),
    Check("bar", SECTION, "bar struck at its base", _bar),
)
