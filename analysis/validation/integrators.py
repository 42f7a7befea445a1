"""Euler or Verlet for positions and for orientations: differences between the four combinations, and their cost.

Without damping or forces Euler's and Verlet's positions are one formula: x + dt v with v = (x_k - x_(k-1))/dt is
2 x_k - x_(k-1). The same holds for orientations up to the third order of a step's turn.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np

from guidewire.figures.wording import beside, number
from guidewire.logs.logs import read_entries
from guidewire.logs.runs import Run, read_repeats
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_METHODS = {
    "Euler, Euler": "euler", "Verlet, Euler": "verlet", "Euler, Verlet": "eulerOrientationVerlet",
    "Verlet, Verlet": "orientationVerlet",
}
_REFERENCE = "Verlet, Euler"  # what the thesis calls Verlet
_STEPS = 300
_REPEATS = 5
_TURN = 0.5 * math.pi  # of the last element at the start of the twist problem

_BASE: dict[str, Any] = {
    "solver": "pbd", "guidewireLength": 300.0, "numberRodElements": 30, "totalMass": 0.01, "stretchStiffness": 0.1,
    "bendStiffness": 0.1, "logOrientations": True, "maxSimulationSteps": _STEPS,
}


def _twisted_start(elements: int, length: float) -> dict[str, Any]:
    """Return a straight wire at rest whose elements are turned about it, evenly from 0 to a quarter turn."""
    angles = _TURN * np.arange(elements) / (elements - 1)
    return {
        "positions": [[0.0, 0.0, float(z)] for z in np.linspace(0.0, length, elements + 1)],
        "orientations": [[0.0, 0.0, math.sin(0.5 * a), math.cos(0.5 * a)] for a in angles],
    }


_PROBLEMS: dict[str, tuple[dict[str, Any], dict[str, Any] | None]] = {
    "transversal, m = 500": (
        {"displacement": 10.0, "displacementDirection": [0.0, 1.0, 0.0], "constraintSolverSteps": 500,
         "timeStep": 0.01}, None),
    "transversal, m = 20": (
        {"displacement": 10.0, "displacementDirection": [0.0, 1.0, 0.0], "constraintSolverSteps": 20,
         "timeStep": 0.01}, None),
    "transversal, m = 500, damping 0.02": (
        {"displacement": 10.0, "displacementDirection": [0.0, 1.0, 0.0], "constraintSolverSteps": 500,
         "timeStep": 0.01, "damping": 0.02}, None),
    "twist, m = 500": (
        {"displacement": 0.0, "twistPerStep": 1e-12, "constraintSolverSteps": 500, "timeStep": 0.01},
        _twisted_start(30, 300.0)),
    "twist, m = 20": (
        {"displacement": 0.0, "twistPerStep": 1e-12, "constraintSolverSteps": 20, "timeStep": 0.01},
        _twisted_start(30, 300.0)),
}


def _motion(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Places of the last sphere in units, shape (k, 3), and turn of the last element about z in rad, shape (k,)."""
    places, turns = [], []
    for _, entry in read_entries(run.folder):
        last = max(entry["sphere"], key=int)
        places.append([float(entry["sphere"][last][axis]) for axis in "xyz"])
        q = entry["orientation"][str(int(last) - 1)]
        turns.append(2.0 * math.atan2(float(q["z"]), float(q["w"])))
    return np.array(places), np.unwrap(turns)


def _integrators(repeats: int) -> Plan:
    cases = {
        (problem, method): Case(f"{k}-{word}", {**_BASE, **overrides, "guidewireOffset": 0.0, "integrator": word,
                                                "deltaThreshold": 0.0}, repeats, start)
        for k, (problem, (overrides, start)) in enumerate(_PROBLEMS.items()) for method, word in _METHODS.items()
    }
    runs = yield list(cases.values())
    motions = {key: _motion(runs[case.key]) for key, case in cases.items()}
    costs = {key: _step_time(runs[case.key], case.repeats) for key, case in cases.items()}
    results = []
    for problem in _PROBLEMS:
        twist = problem.startswith("twist")
        for method in _METHODS:
            results.append(_difference(problem, method, motions, twist, costs[problem, method]))

    def draw(figure) -> None:
        panels = figure.subplots(2, len(_PROBLEMS), sharex=True)
        for column, problem in enumerate(_PROBLEMS):
            twist = problem.startswith("twist")
            above, below = panels[:, column]
            for k, method in enumerate(_METHODS):
                value = _seen(motions[problem, method], twist)
                above.plot(value, color=f"C{k}", linewidth=1.0, linestyle=("-", "--", "-.", ":")[k], label=method)
                off = np.abs(value - _seen(motions[problem, _REFERENCE], twist))
                if method != _REFERENCE and np.any(off > 0.0):
                    below.plot(np.where(off > 0.0, off, np.nan), color=f"C{k}", linewidth=0.9, label=method)
            above.set_title(problem.replace(", ", ",\n", 1), fontsize=8)
            above.set_ylabel("turn of the last element (rad)" if twist else "tip across (units)", fontsize=7)
            below.set_yscale("log")
            below.set_ylabel(f"difference ({'rad' if twist else 'units'})", fontsize=7)
            below.set_xlabel("step (number)")
        panels[1, 0].legend(
            *panels[0, 0].get_legend_handles_labels(), loc="center", fontsize=6, title="positions, orientations",
            title_fontsize=6,
        )

    loads = [repeat.others_busy for case in cases.values() for repeat in read_repeats(runs[case.key], case.repeats)]
    return Finding(tuple(results), draw, _caption(results, costs, beside(loads)), width=12.0)


def _seen(motion: tuple[np.ndarray, np.ndarray], twist: bool) -> np.ndarray:
    places, turns = motion
    return turns if twist else places[:, 1]


def _difference(problem: str, method: str, motions: Mapping, twist: bool, cost: float) -> Result:
    value, reference = (_seen(motions[problem, name], twist) for name in (method, _REFERENCE))
    return Result(
        f"{problem}: largest difference from {_REFERENCE} over {_STEPS} steps", f"pbd, {method}", float(value[-1]),
        float(reference[-1]), float(np.max(np.abs(value - reference))), None, "rad" if twist else "units", cost,
        "rad" if twist else "units",
    )


def _step_time(run: Run, repeats: int) -> float:
    """Median wall time of a step over the timed repeats, s."""
    return 1e-3 * float(np.median([repeat.measured("medianStepTime") for repeat in read_repeats(run, repeats)]))


def _caption(results: list[Result], costs: Mapping[tuple[str, str], float], load: str) -> str:
    of = {(r.what.split(":")[0], r.solver[5:]): r for r in results}
    first = next(iter(_PROBLEMS))
    return (
        "Four predictors, \"positions, orientations\" each by Euler or Verlet, in the thesis's transversal run and for "
        f"a wire whose elements start rotated by 0 to 90°; {_STEPS} steps. Below: difference from {_REFERENCE}. "
        "Largest of Euler's positions (rounding, where they are one formula), and of Verlet's orientations: "
        + "; ".join(f"{problem}: {number(of[problem, 'Euler, Euler'].error, 2)}, "
                    f"{number(of[problem, 'Verlet, Verlet'].error, 2)} {of[problem, 'Verlet, Verlet'].unit}"
                    for problem in _PROBLEMS)
        + f". Median time of a step, {first}, of runs made one at a time, {load}: "
        + ", ".join(f"{method} {number(1e3 * costs[first, method], 3)} ms" for method in _METHODS)
        + ". No limit of a time step is in sight with pbd; the choice of m changes the motion far more."
    )


INTEGRATORS, INTEGRATORS_ONCE = (
    Check("integrators", "Integrators", "Euler and Verlet, positions and orientations", partial(_integrators, repeats))
    for repeats in (_REPEATS, 1))
CHECKS = (INTEGRATORS,)
