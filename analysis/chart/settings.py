"""Settings of each method: its keys, labels and descriptions, and the stiffness of pbd."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from analysis.chart.points import Setting, case
from analysis.validation import scenes
from analysis.validation.states import tip_motion
from analysis.validation.wire import Wire
from guidewire.figures.wording import number
from guidewire.logs.runs import Run
from guidewire.studies.keys import run_key
from guidewire.studies.table import Case

GRAVITY = 9.81  # m/s^2
TUNED = {"constraintSolverSteps": 500, "numberRodElements": 30, "timeStep": 1e-3}  # where pbd's gain is tuned
PBD = {"solver": "pbd", "stretchStiffness": 1.0, "totalMass": 0.01, "displacement": 0.0, **TUNED}
PBD_CHANGES: tuple[dict[str, Any], ...] = (
    {}, {"constraintSolverSteps": 125}, {"constraintSolverSteps": 250}, {"constraintSolverSteps": 1000},
    {"constraintSolverSteps": 2000}, {"numberRodElements": 15}, {"timeStep": 5e-4},
    {"constraintSolverSteps": 50, "timeStep": 1e-2},
)
_GAIN_RANGE = (0.005, 1.0)  # units; one sag of the tuned wire lies between them
_TUNING_ROUNDS = 4
_TUNING_PARTS = 4


def time_text(step: float) -> str:
    """Return a time step with its unit, as "4 ms" or "20 µs"."""
    return f"{1e3 * step:.4g} ms" if step >= 1e-3 else f"{1e6 * step:.3g} µs"


def direct(scheme: str, n: int, step: float) -> tuple[str, str]:
    """Words and label of the direct method."""
    return f"{scheme}, n = {n}, dt = {time_text(step)}", f"{scheme} n{n} {time_text(step)}"


def small_steps(n: int, substep: float, sweeps: int | None = None) -> tuple[str, str]:
    """Words and label of methods with substeps; those of xpbd have `sweeps`."""
    swept = "" if sweeps is None else f", m = {sweeps}"
    short = "" if sweeps is None else f" m{sweeps}"
    return f"n = {n}, substep {number(1e6 * substep, 2)} µs{swept}", f"n{n} {number(1e6 * substep, 2)} µs{short}"


def pbd(changed: Mapping[str, Any]) -> tuple[str, str]:
    """Words and label of gains that were tuned elsewhere and run with some values changed."""
    method = {**TUNED, **changed}
    m, n, step = method["constraintSolverSteps"], method["numberRodElements"], time_text(method["timeStep"])
    return f"m = {m}, n = {n}, dt = {step}", f"m{m} n{n} {step}"


def changed_pbd(gain: float, changes: Iterable[Mapping[str, Any]], keys: Callable[[dict[str, Any]], dict[str, Any]],
                start: Callable[[int], dict[str, Any]] = lambda _: {}) -> list[Setting]:
    """Return the settings of a tuned gain with each of these changes: what makes a scene's keys from the method's, and
    where the wire starts, by n."""
    made = []
    for k, changed in enumerate(changes):
        method = {**PBD, **changed, "bendStiffness": gain}
        made.append(Setting("pbd", *pbd(changed), case(f"pbd-{k}", "pbd", keys(method),
                                                       start(method["numberRodElements"]) or None)))
    return made


def settled(method: Mapping[str, Any], step: float, rate: float, duration: float) -> dict[str, Any]:
    """Return a motion under own weight and a drag of `rate` (1/s) for so long (s), of which only the end is logged."""
    solver = method.get("solver", "direct")
    scale = scenes.UNIT if solver == "pbd" else 1.0
    return {
        "timeStep": step, "maxSimulationSteps": math.ceil(duration / step), **scenes.damping(solver, rate, step),
        "logEvery": 1_000_000, "gravity": [0.0, -GRAVITY / scale, 0.0], **method,
    }


def tuned_gain(wire: Wire, rate: float, duration: float, sag: float) -> scenes.Asking[float]:
    """The gain with which pbd sags under its own weight by `sag` (of L), as the material does, at one m, n and dt: the
    interval that holds it is divided again and again, and the last one interpolated. Not a number where the range has
    none."""
    low, high = _GAIN_RANGE
    seen: dict[float, float] = {}
    for _ in range(_TUNING_ROUNDS):
        gains = [float(g) for g in np.geomspace(low, high, _TUNING_PARTS + 1)]
        cases = {g: Case(run_key("tuning", {"gain": g}), settled({**PBD, "bendStiffness": g}, PBD["timeStep"], rate,
                                                                 duration)) for g in gains if g not in seen}
        runs = yield list(cases.values())
        seen |= {g: tip_sag(runs[case.key], wire) for g, case in cases.items()}
        low = max((g for g in gains if seen[g] >= sag), default=math.nan)
        high = min((g for g in gains if seen[g] < sag), default=math.nan)
        if not low < high:
            return math.nan
    fraction = math.log(seen[low] / sag) / math.log(seen[low] / seen[high])
    return low * (high / low) ** fraction


def tip_sag(run: Run, wire: Wire) -> float:
    """Deflection of the tip at the end over L."""
    _, tip = tip_motion(run)
    return -float(tip[-1, 1]) / wire.length
