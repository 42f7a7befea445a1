"""Checks of motion: a cantilever let go, a bar struck, energy over a long time, forces, order in time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from analysis.figures.wording import number, percent
from analysis.runs import Run
from analysis.validation import beam, pictures, scenes
from analysis.validation.bar import BarChain
from analysis.validation.check import Case, Check, Finding, Plan, Result
from analysis.validation.release import Release, tip_motion
from analysis.validation.states import (
    last_state, read_states, solver_report, tip_at, wall_time, wall_time_per_second,
)
from analysis.validation.states import tip_motion as logged_tip
from analysis.validation.wire import BASE, Wire

SECTION = "Dynamics"

RELEASE_LOAD = 0.1  # F L^2/EI
RELEASE_TIME = 0.2  # s
RELEASE_GATE = 3e-3
COST_GATE = 0.010  # s of wall time per simulated second
_SAMPLES = 2001
_REPEATS = 3
_TIMED_STEPS = 5000


@lru_cache(maxsize=None)
def release_reference() -> tuple[Release, float]:
    """The reference motion, and how far it is from one with fewer modes (RMS, relative): its own error or more."""
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
    """A cantilever let go from its rest shape under a tip load."""
    force = RELEASE_LOAD * BASE.bending / BASE.length**2
    return {
        "numberRodElements": elements, "timeStep": time_step, "initialState": "equilibrium",
        "tipForce": [0.0, -force, 0.0], "tipForceReleaseTime": 0.0,
        "maxSimulationSteps": round(RELEASE_TIME / time_step), "logSpheres": "last", **method,
    }


def timed_release(key: str, elements: int, time_step: float, method: Mapping[str, Any]) -> Case:
    """The same motion for so many steps that the runner's first ones, still being compiled, do not count."""
    steps = max(_TIMED_STEPS, round(RELEASE_TIME / time_step))
    parameters = {**release(elements, time_step, method), "maxSimulationSteps": steps, "logEvery": 1_000_000_000}
    return Case(f"{key}-timed", parameters, repeats=_REPEATS)


_RELEASES = {
    "sdirk3, n = 10, 1 ms": (10, 1e-3, {"integrator": "sdirk3"}),
    "sdirk4, n = 40, 0.1 ms": (40, 1e-4, {"integrator": "sdirk4"}),
    "sdirk3, n = 12, 2 ms": (12, 2e-3, {"integrator": "sdirk3"}),
    "sdirk4, n = 10, 4 ms": (10, 4e-3, {"integrator": "sdirk4"}),
    "sdirk4, n = 12, 2 ms": (12, 2e-3, {"integrator": "sdirk4"}),
    "bdf2, n = 12, 0.25 ms": (12, 2.5e-4, {"integrator": "bdf2"}),
    "sdirk2, n = 12, 0.5 ms": (12, 5e-4, {"integrator": "sdirk2"}),
    "implicitEuler, n = 30, 0.1 ms": (30, 1e-4, {"integrator": "implicitEuler"}),
    "lumped, half-element clamp, sdirk3, n = 30, 0.25 ms": (
        30, 2.5e-4, {"integrator": "sdirk3", "massRule": "lumped", "clampRule": "halfElement"}),
}
_RELEASE_GATED = ("sdirk3, n = 10, 1 ms", "sdirk4, n = 12, 2 ms", "bdf2, n = 12, 0.25 ms")


def _release() -> Plan:
    cases = [Case(_slug(name), release(*setting)) for name, setting in _RELEASES.items()]
    timed = [timed_release(_slug(name), *setting) for name, setting in _RELEASES.items()]
    step = 2e-4
    small = [
        Case(solver, release(30, step, {"solver": solver, **scenes.small_steps(solver, BASE, step)}))
        for solver in ("explicit", "xpbd")
    ]
    runs = yield [*cases, *timed, *small]
    costs = {case.key: wall_time_per_second(runs[one.key], one.repeats) for case, one in zip(cases, timed)}
    costs |= {case.key: wall_time_per_second(runs[case.key]) for case in small}
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
        results.append(Result("cantilever let go, 0.2 s: tip at the end", names[case.key], tip,
                              float(reference.across[-1]), error, RELEASE_GATE if gated else None, "m", cost, "RMS"))
    best = min((r for r in results if r.error <= RELEASE_GATE), key=lambda r: r.cost, default=None)
    results.append(Result(
        "cantilever let go: wall time per simulated second at an error below 0.3 %",
        "none" if best is None else best.solver, math.nan if best is None else best.cost, COST_GATE,
        math.inf if best is None else best.cost, COST_GATE, "s/s", None, "s/s",
    ))

    def draw(figure) -> None:
        motion, cost = figure.subplots(1, 2)
        motion.plot(reference.time, 1e3 * reference.across, color="0.6", linewidth=2.5, label="reference")
        for name in ("sdirk3-n10-1ms", "implicitEuler-n30-01ms"):
            key = next((case.key for case in cases if case.key == name), cases[0].key)
            time, tip = logged_tip(runs[key])
            motion.plot(time, -1e3 * tip[:, 1], linewidth=0.9, label=names[key])
        motion.set_xlabel("time (s)")
        motion.set_ylabel("deflection of the tip (mm)")
        motion.legend(loc="lower left", fontsize=6)
        for k, r in enumerate(results[:-1]):
            cost.plot(r.cost, r.error, pictures.MARKERS[k % 8], color=f"C{k % 7}", fillstyle="none", label=r.solver)
        cost.axhline(RELEASE_GATE, linestyle="--", color="0.3", linewidth=1.0)
        cost.axvline(COST_GATE, linestyle="--", color="0.3", linewidth=1.0)
        cost.set_xscale("log")
        cost.set_yscale("log")
        cost.set_xlabel("wall time per simulated second (1)")
        cost.set_ylabel("RMS error of the tip's motion (1)")
        cost.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=6)

    caption = (
        "A cantilever let go from its rest shape under F L²/EI = 0.1. Left: motion of the tip. Right: error over 0.2 s "
        "(RMS of 2001 samples, space and time together) against wall time; dashed: 0.3 % and 0.010. Reference: "
        f"geometrically exact, modes of the slope, 14 and 10 of them differ by {number(own, 1)}. "
        + "; ".join(f"{r.solver}: {percent(r.error)} at {number(r.cost, 2)}" for r in results[:-1]) + "."
    )
    return Finding(tuple(results), draw, caption, width=12.0)


def _slug(name: str) -> str:
    return "".join(c for c in name.replace(", ", "-").replace(" ", "") if c.isalnum() or c == "-")


_BAR_TIME = 2e-3  # s
_BAR_METHODS = {
    "direct, sdirk4, 0.25 µs": ({"solver": "direct", "integrator": "sdirk4", "timeStep": 2.5e-7}, 1e-3),
    "direct, sdirk3, 0.25 µs": ({"solver": "direct", "integrator": "sdirk3", "timeStep": 2.5e-7}, None),
    "direct, bdf2, 0.25 µs": ({"solver": "direct", "integrator": "bdf2", "timeStep": 2.5e-7}, None),
    "direct, implicitEuler, 0.25 µs": ({"solver": "direct", "integrator": "implicitEuler", "timeStep": 2.5e-7}, None),
    "explicit, 0.05 µs": ({"solver": "explicit", "timeStep": 2.5e-7, "substeps": 5}, 1e-3),
    "explicit, 0.25 µs": ({"solver": "explicit", "timeStep": 2.5e-7}, None),
    "xpbd, 10 sweeps, 0.25 µs": ({"solver": "xpbd", "timeStep": 2.5e-7, "constraintSolverSteps": 10}, None),
}


def _bar() -> Plan:
    n, shift = 30, 1e-3
    common = {
        "numberRodElements": n, "massRule": "uniform", "displacement": shift / scenes.UNIT, "logSpheres": "last",
        "displacementDirection": [0.0, 0.0, 1.0],
    }
    cases = [
        Case(f"method-{k}", {**common, **method, "maxSimulationSteps": round(_BAR_TIME / method["timeStep"])})
        for k, (method, _) in enumerate(_BAR_METHODS.values())
    ]
    runs = yield cases
    chain = BarChain(n, BASE.line_density * BASE.length / (n + 1), BASE.stretching * n / BASE.length, shift)
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
        for name in ("direct, sdirk4, 0.25 µs", "direct, implicitEuler, 0.25 µs"):
            t, moved = motions[name]
            axes.plot(1e3 * t, 1e3 * moved, linewidth=0.8, label=name)
        axes.set_xlabel("time (ms)")
        axes.set_ylabel("displacement of the free end (mm)")
        pictures.outside_legend(axes)

    caption = (
        "The base of a bar, 30 springs and equal masses, is displaced by 1 mm at once: motion of the free end over 2 ms "
        "against the chain's exact motion (all 30 modes). RMS error: "
        + "; ".join(f"{r.solver}: {percent(r.error)}" for r in results) + "."
    )
    return Finding(tuple(results), draw, caption)


_STURDY = Wire(radius=5e-3)  # its explicit step is ten times longer and its period ten times shorter
_PERIODS = 100
_STEPS = 100  # a period, for the implicit schemes
SCHEMES = {"implicitEuler": 1, "bdf2": 2, "sdirk2": 2, "sdirk3": 3, "sdirk4": 4}  # and their order


def _energy() -> Plan:
    n = 10
    first = float(beam.mode_numbers(1)[0])
    frequency = beam.thick_frequencies(_STURDY, 1)[0]
    step = 1.0 / frequency / _STEPS
    common = {
        **scenes.wire_parameters(_STURDY), "numberRodElements": n, "timeStep": step, "logEvery": _STEPS,
        "maxSimulationSteps": _PERIODS * _STEPS,
    }
    methods: dict[str, dict[str, Any]] = {f"direct, {scheme}": {"integrator": scheme, "solverTolerance": 1e-11}
                                          for scheme in SCHEMES}
    methods |= {solver: {"solver": solver, **scenes.small_steps(solver, _STURDY, step, n)}
                for solver in ("explicit", "xpbd")}
    start = scenes.mode_start(_STURDY, n, first, 1e-2)
    cases = [Case(_slug(name), {**common, **method}, start=start) for name, method in methods.items()]
    runs = yield cases
    shape = beam.mode_shape(first, np.linspace(0.0, 1.0, n + 1))
    omega = 2.0 * math.pi * frequency
    results, series = [], {}
    for name, case in zip(methods, cases):
        states = read_states(runs[case.key])
        place = np.array([state.positions[:, 1] @ shape for state in states])
        speed = np.array([state.velocities[:, 1] @ shape for state in states])
        energy = place**2 + (speed / omega) ** 2
        share = energy / energy[0]
        series[name] = share
        results.append(Result(f"energy of the first mode after {_PERIODS} periods, n = {n}", name, share[-1], 1.0,
                              abs(share[-1] - 1.0), None, "of the start", wall_time_per_second(runs[case.key])))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        for k, (name, share) in enumerate(series.items()):
            shown = np.maximum(share, 1e-12)
            axes.plot(np.arange(len(share)), shown, pictures.MARKERS[k] + "-", markevery=10, fillstyle="none", label=name)
        axes.set_yscale("log")
        axes.set_ylim(1e-4, 3.0)
        axes.set_xlabel("periods (1)")
        axes.set_ylabel("energy of the mode (of the start)")
        pictures.outside_legend(axes)

    caption = (
        f"Free, undamped motion in the first mode, amplitude 1e-2 L, over {_PERIODS} periods, {_STEPS} steps a period; "
        "explicit and xpbd with the substeps that they need. Energy left, from the nodes' places and velocities: "
        + "; ".join(f"{r.solver}: {number(r.value)}" for r in results) + "."
    )
    return Finding(tuple(results), draw, caption)


def _force_balance() -> Plan:
    n, step, count, g = 16, 1e-3, 20, 9.81
    cases = [
        Case(f"steps={k}", {
            "numberRodElements": n, "timeStep": step, "integrator": "implicitEuler", "gravity": [0.0, -g, 0.0],
            "maxSimulationSteps": k, "solverTolerance": 1e-12,
        })
        for k in range(1, count + 1)
    ]
    runs = yield cases
    momentum, reactions = [np.zeros(3)], []
    for case in cases:
        v = last_state(runs[case.key]).velocities
        momentum.append(BASE.line_density * BASE.length / n * np.sum(0.5 * (v[1:] + v[:-1]), axis=0))
        reactions.append(solver_report(runs[case.key], "proximalForce"))
    rates = np.diff(momentum, axis=0) / step
    weight = BASE.line_density * BASE.length * np.array([0.0, -g, 0.0])
    left = np.linalg.norm(np.array(reactions) + weight - rates, axis=1)
    peak = float(np.max(np.linalg.norm(reactions, axis=1)))
    worst = float(np.max(left)) / peak
    result = Result(f"clamp's force + weight = change of momentum, {count} steps of implicit Euler, n = {n}", "direct",
                    float(np.max(left)), 0.0, worst, 1e-6, "N", None, "of the peak")

    def draw(figure) -> None:
        axes = figure.add_subplot()
        time = 1e3 * step * np.arange(1, count + 1)
        axes.plot(time, rates[:, 1] - weight[1], color="0.6", linewidth=2.5, label="change of momentum - weight")
        axes.plot(time, np.array(reactions)[:, 1], "o", fillstyle="none", label="clamp's force on the wire")
        axes.set_xlabel("time (ms)")
        axes.set_ylabel("force along y (N)")
        pictures.outside_legend(axes)

    caption = (
        "A straight clamped wire begins to fall: force of the clamp, taken from the wire's stress, and what the change of "
        f"momentum asks for. They differ by at most {number(worst, 1)} of the peak."
    )
    return Finding((result,), draw, caption)


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
    start = {"positions": (pure.positions / scenes.UNIT).tolist(), "orientations": pure.orientations.tolist()}

    def case(name: str, steps: int, method: Mapping[str, Any]) -> Case:
        return Case(f"{name}-{steps}", {
            "numberRodElements": n, "timeStep": period / steps, "maxSimulationSteps": steps // 2,
            "logEvery": steps // min(_ORDER_STEPS), "solverTolerance": 1e-13, **method,
        }, start=start)

    def swing(run: Run) -> np.ndarray:
        """The motion in the first mode."""
        return np.array([state.positions[:, 1] @ shape for state in read_states(run)])

    finest = case("finest", _FINEST, {"integrator": "sdirk4"})
    cases = {(s, k): case(s, k, {"integrator": s}) for s in SCHEMES for k in _ORDER_STEPS}
    runs = yield [finest, *cases.values()]
    exact = swing(runs[finest.key])
    results, series = [], {}
    for scheme, claimed in SCHEMES.items():
        errors = []
        for steps in _ORDER_STEPS:
            errors.append(rms_error(swing(runs[cases[scheme, steps].key]), exact))
        measured = -math.log2(errors[-1] / errors[-2])
        results.append(Result("order in time on the first mode, 80 to 160 steps a period", f"direct, {scheme}", measured,
                              claimed, abs(measured - claimed), 0.1, "", None, "absolute"))
        series[scheme] = (_ORDER_STEPS, errors)
    caption = (
        f"Half a period in the first mode, amplitude near 1e-4 L, n = {n}: RMS error of the mode against {_FINEST} steps of sdirk4 "
        "a period. Orders from 80 to 160 steps: " + ", ".join(f"{r.solver[8:]} {number(r.value)}" for r in results)
        + ". explicit and xpbd need thousands of steps a period to be stable or to converge, and have no order here."
    )
    draw = pictures.orders("steps a period", "relative error of the mode's motion", series,
                           [(-1.0, "order 1"), (-2.0, "order 2"), (-3.0, "order 3"), (-4.0, "order 4")])
    return Finding(tuple(results), draw, caption)


CHECKS = (
    Check("release", SECTION, "cantilever let go", _release),
    Check("bar", SECTION, "bar struck at its base", _bar),
    Check("energy", SECTION, "energy over 100 periods", _energy),
    Check("force-balance", SECTION, "force balance", _force_balance),
    Check("order-in-time", SECTION, "order in time", _order),
)
