"""Check of motion against an exact solution: a released cantilever."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes
from analysis.validation.release import Release
from analysis.validation.release import tip_motion as exact_motion
from analysis.validation.states import tip_at, tip_motion, wall_time_per_second
from analysis.validation.wire import BASE
from guidewire.figures.wording import number, percent
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

SECTION = "Dynamics"

RELEASE_LOAD = 0.1  # F L^2/EI
RELEASE_TIME = 0.2  # s
RELEASE_GATE = 3e-3
COST_GATE = 220.0  # element-iterations of the sweep at n = 30 that a simulated millisecond may cost
_SAMPLES = 2001


@lru_cache(maxsize=None)
def release_reference() -> tuple[Release, float]:
    """Return the reference motion, and how far it is from one with fewer modes (RMS, relative): its own error or
    more."""
    fine = exact_motion(BASE, RELEASE_LOAD, RELEASE_TIME, _SAMPLES, modes=14)
    coarse = exact_motion(BASE, RELEASE_LOAD, RELEASE_TIME, _SAMPLES, modes=10)
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


_RELEASES = {  # n, time step, method, and limit
    "direct, esdirk3, n = 10, 1 ms": (10, 1e-3, {"integrator": "esdirk3"}, RELEASE_GATE),
    "direct, esdirk3, n = 10, 2 ms": (10, 2e-3, {"integrator": "esdirk3"}, None),
    "direct, esdirk4, n = 12, 2 ms": (12, 2e-3, {"integrator": "esdirk4"}, RELEASE_GATE),
    "direct, bdf2, n = 12, 0.25 ms": (12, 2.5e-4, {"integrator": "bdf2"}, RELEASE_GATE),
}
_COSTED = "direct, esdirk3, n = 10, 2 ms"  # the cheapest with an error below 0.3 %


def _release() -> Plan:
    settings = dict(_RELEASES)
    for solver in ("explicit", "xpbd"):
        method = yield from scenes.small_steps(solver, BASE, 2e-4, {})
        settings[f"{solver}, n = 30"] = (30, 2e-4, {"solver": solver, **method}, None)
    cases = {name: Case(f"motion-{k}", release(*setting[:3])) for k, (name, setting) in enumerate(settings.items())}
    timed = Case("in-turns", release(*settings[_COSTED][:3]), in_turns=True)
    runs = yield [*cases.values(), timed]
    reference, own = release_reference()
    errors = {name: release_error(runs[case.key]) for name, case in cases.items()}
    results = [
        Result("released cantilever, 0.2 s: tip at the end", name,
               -float(tip_at(runs[case.key], reference.time[-1:])[0, 1]), float(reference.across[-1]), errors[name],
               settings[name][3], "m", wall_time_per_second(runs[case.key]), "RMS")
        for name, case in cases.items()
    ]
    ratio = runs[timed.key].measured("elementIterationsPerMillisecond")
    results.append(Result(
        "released cantilever: cost of a simulated ms with an error below 0.3 %, in element-iterations of the sweep "
        "at n = 30, both timed in turns", _COSTED, ratio, COST_GATE,
        ratio if errors[_COSTED] <= RELEASE_GATE else math.inf, COST_GATE, "", None, "element-iterations a ms"))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        axes.plot(reference.time, 1e3 * reference.across, color="0.6", linewidth=2.5, label="reference")
        for name in (next(iter(cases)), "explicit, n = 30"):
            time, tip = tip_motion(runs[cases[name].key])
            axes.plot(time, -1e3 * tip[:, 1], linewidth=0.9, label=name)
        pictures.label(axes, "time (s)", "deflection of the tip (mm)")

    caption = (
        "A cantilever released from its rest shape under F L²/EI = 0.1: error over 0.2 s (RMS of 2001 samples, space "
        f"and time together). Reference: geometrically exact; 14 and 10 modes of the slope differ by {number(own, 1)}. "
        + "; ".join(f"{name}: {percent(error)}" for name, error in errors.items())
        + f". {_COSTED}: {number(ratio, 3)} element-iterations of the sweep a simulated ms."
    )
    return Finding(tuple(results), draw, caption)


CHECKS = (Check("release", SECTION, "released cantilever", _release),)
