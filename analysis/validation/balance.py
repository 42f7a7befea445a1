"""Checks of conservation in motion: energy over a long time, and the force balance of every step."""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np

from analysis.validation import beam, pictures, scenes
from analysis.validation.dynamics import SCHEMES, SECTION
from analysis.validation.states import reactions, read_states, wall_time_per_second
from analysis.validation.wire import BASE, STURDY
from guidewire.figures.wording import number
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result, not_run

_PERIODS = 100
_STEPS = 100  # a period, for the implicit schemes


_GAINS = {
    "solver": "pbd", "stretchStiffness": 1.0, "bendStiffness": 1.0, "totalMass": 0.01, "displacement": 0.0,
    "constraintSolverSteps": 50,
    "twistPerStep": 1e-12,  # a drive that turns the frame of element 0 holds it, as a clamp does
}
_LOOK = 2000  # steps in which the period of that wire is measured


def _modal(run: Run, shape: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, and place and speed in a mode of shape (n+1,) at each; shape (k,) each."""
    states = read_states(run)
    return (np.array([state.time for state in states]), np.array([state.positions[:, 1] @ shape for state in states]),
            np.array([state.velocities[:, 1] @ shape for state in states]))


def _period(time: np.ndarray, place: np.ndarray, _: np.ndarray) -> float:
    """Twice the mean distance of the zeros of a swing, s."""
    before = np.flatnonzero(np.sign(place[1:]) != np.sign(place[:-1]))
    zeros = time[before] + np.diff(time)[before] * place[before] / (place[before] - place[before + 1])
    return 2.0 * float(np.mean(np.diff(zeros)))


def _energy() -> Plan:
    n = 10
    first = float(beam.mode_numbers(1)[0])
    frequency = beam.thick_frequencies(STURDY, 1)[0]
    step = 1.0 / frequency / _STEPS
    common = {
        **scenes.wire_parameters(STURDY), "numberRodElements": n, "timeStep": step, "logEvery": _STEPS,
        "maxSimulationSteps": _PERIODS * _STEPS,
    }
    methods: dict[str, dict[str, Any]] = {f"direct, {scheme}": {"integrator": scheme, "solverTolerance": 1e-11}
                                          for scheme in SCHEMES}
    for solver in ("explicit", "xpbd"):
        methods[solver] = {"solver": solver, **(yield from scenes.small_steps(solver, STURDY, step, common))}
    start = scenes.mode_start(STURDY, n, first, 1e-2)
    cases = {name: Case(name.replace(", ", "-"), {**common, **method}, start=start)
             for name, method in methods.items()}
    gains = {**_GAINS, "numberRodElements": n, "timeStep": step}
    # Element 0 is held as it starts: along the axis about which the wire swings.
    along = {**start, "orientations": [[0.0, 0.0, 0.0, 1.0], *start["orientations"][1:]]}
    short = Case("pbd-short", {**gains, "maxSimulationSteps": _LOOK}, start=along)
    runs = yield [*cases.values(), short]
    shape = beam.mode_shape(first, np.linspace(0.0, 1.0, n + 1))
    period = _period(*_modal(runs[short.key], shape))
    steps = round(period / step)
    cases["pbd"] = Case("pbd", {**gains, "maxSimulationSteps": _PERIODS * steps, "logEvery": steps},
                                    start=along)
    runs = {**runs, **(yield [cases["pbd"]])}
    results, series = [], {}
    for name, case in cases.items():
        _, place, speed = _modal(runs[case.key], shape)
        omega = 2.0 * math.pi * (1.0 / period if name.startswith("pbd") else frequency)
        energy = place**2 + (speed / omega) ** 2
        fraction = energy / energy[0]
        series[name] = fraction
        results.append(Result(f"energy of the first mode after {_PERIODS} periods, n = {n}", name, fraction[-1], 1.0,
                              abs(fraction[-1] - 1.0), None, "of the start", wall_time_per_second(runs[case.key])))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        for k, (name, fraction) in enumerate(series.items()):
            shown = np.maximum(fraction, 1e-12)
            axes.plot(
                np.arange(len(fraction)), shown, pictures.MARKERS[k], markevery=10, fillstyle="none", label=name,
                linestyle="--" if name.startswith("pbd") else "-",
            )
        axes.set_yscale("log")
        axes.set_ylim(1e-4, 3.0)
        pictures.label(axes, "periods (1)", "energy of the mode (of the start)")

    caption = (
        f"Free, undamped motion in the first mode, amplitude 1e-2 L, over {_PERIODS} periods, {_STEPS} steps a period; "
        "explicit and xpbd with the substeps that they need. pbd's wire is one of gains, with a period of its own, "
        f"here {steps} steps. Energy left, from the nodes' places and velocities: "
        + "; ".join(f"{r.solver}: {number(r.value)}" for r in results) + "."
    )
    return Finding(tuple(results), draw, caption)


_BALANCE_GATE = 1e-6  # of the peak
_TIGHT = 1e-14  # solverTolerance


def _force_balance(tight: bool) -> Plan:
    """The balance of each step where stages are solved to rounding, or at the default tolerance."""
    n, step, count, g = 16, 1e-3, 50, 9.81
    common = {"numberRodElements": n, "timeStep": step, "gravity": [0.0, -g, 0.0], "maxSimulationSteps": count,
              "logContacts": True}
    cases = {
        f"direct, {scheme}": Case(scheme, {**common, "integrator": scheme,
                                           **({"solverTolerance": _TIGHT} if tight else {})})
        for scheme in SCHEMES
    }
    if tight:
        cases["explicit"] = Case("explicit", {
            **common, "solver": "explicit", **(yield from scenes.small_steps("explicit", BASE, step, common))})
    runs = yield list(cases.values())
    weight = BASE.line_density * BASE.length * np.array([0.0, -g, 0.0])
    results, drawn = [], {}
    for name, case in cases.items():
        run = runs[case.key]
        mass = BASE.line_density * BASE.length / n
        momentum = np.array([mass * state.momentum_per_mass for state in read_states(run)])
        rates = _rates(momentum, step, two_steps=name == "direct, bdf2")
        force = reactions(run)
        left = np.linalg.norm(force + weight - rates, axis=1)
        peak = float(np.max(np.linalg.norm(force, axis=1)))
        drawn[name] = (rates[:, 1] - weight[1], force[:, 1])
        tol = f", solverTolerance {run.number('solverTolerance'):g}" if run.value("solver") == "direct" else ""
        results.append(Result(
            f"clamp's force + weight = change of momentum in each of {count} steps, n = {n}{tol}: largest rest", name,
            float(np.max(left)), 0.0, float(np.max(left)) / peak, _BALANCE_GATE, "N",
            wall_time_per_second(run), "of the peak"))
    worst = max(results, key=lambda r: r.error)
    if tight:
        results.append(not_run("clamp's force + weight = change of momentum", "xpbd",
                               "it states no force of the clamp"))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        time = 1e3 * step * np.arange(1, count + 1)
        for k, (name, (asked, stated)) in enumerate(drawn.items()):
            axes.plot(time, 1e3 * asked, color=f"C{k}", linewidth=0.8)
            axes.plot(time, 1e3 * stated, pictures.MARKERS[k], color=f"C{k}", fillstyle="none", markersize=3.0,
                      label=name)
        pictures.label(axes, "time (ms)", "force along y (mN)")

    how = "each stage solved to rounding" if tight else "each stage solved to the default solverTolerance"
    caption = (
        f"A straight clamped wire begins to fall, {how}: force of the clamp as the log states it, its mean over each "
        "step by the scheme's weights (points), and what the change of momentum less the weight asks for (lines). For "
        "bdf2 the change is its own difference over two steps. They differ by at most "
        f"{number(worst.error, 1)} of the peak ({worst.solver})."
    )
    return Finding(tuple(results), draw, caption)


def _rates(momentum: np.ndarray, step: float, two_steps: bool) -> np.ndarray:
    """Change of momentum a second in each step, shape (steps, 3); BDF2's own difference (3 p_k - 4 p_(k-1) +
    p_(k-2))/(2 dt), after a first step of implicit Euler."""
    rates = np.diff(momentum, axis=0) / step
    if two_steps:
        rates[1:] = (3.0 * momentum[2:] - 4.0 * momentum[1:-1] + momentum[:-2]) / (2.0 * step)
    return rates


CHECKS = (
    Check("energy", SECTION, "energy over 100 periods", _energy),
    Check("force-balance", SECTION, "force balance, stages solved to rounding", partial(_force_balance, True)),
    Check("force-balance-default", SECTION, "force balance at the default tolerance", partial(_force_balance, False)),
)
