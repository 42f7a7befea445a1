"""Check of the clamp: the order in n of the error of frequencies; that of deflections is held by tests of Core."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import least_squares

from analysis.validation import beam, pictures, scenes
from analysis.validation.states import tip_motion, wall_time_per_second
from analysis.validation.wire import BASE
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

SECTION = "The clamp"
_GATE = 0.1  # on the order
_PERIODS = 12
_STEPS = 400  # a period
_AMPLITUDE = 1e-4  # of L
_MODES = 3
_LEAST = 3.7  # order of the frequencies


def _frequencies() -> Plan:
    numbers = beam.mode_numbers(_MODES)
    exact = beam.thick_frequencies(BASE, _MODES)
    rules = {
        "fourth order": {"clampRule": "fourthOrder", "massRule": "consistent"},
        "second order": {"clampRule": "halfElement", "massRule": "lumped"},
    }
    counts = (10, 20)
    cases = [
        Case(f"{rule.replace(' ', '-')}-n={n}-mode={k + 1}", {
            **keys, "numberRodElements": n, "integrator": "esdirk4", "solverTolerance": 1e-13,
            "timeStep": 1.0 / (exact[k] * _STEPS), "maxSimulationSteps": _PERIODS * _STEPS, "logSpheres": "last",
        }, start=scenes.mode_start(BASE, n, float(numbers[k]), _AMPLITUDE))
        for rule, keys in rules.items() for n in counts for k in range(_MODES)
    ]
    runs = yield cases
    results, series = [], {}
    for rule in rules:
        errors = np.empty((len(counts), _MODES))
        for i, n in enumerate(counts):
            for k in range(_MODES):
                run = runs[f"{rule.replace(' ', '-')}-n={n}-mode={k + 1}"]
                time, tip = tip_motion(run)
                measured = fit_frequency(time, tip[:, 1], exact[k])
                errors[i, k] = measured / exact[k] - 1.0
                results.append(Result(f"frequency {k + 1}, {rule}, n = {n}", "direct, esdirk4", measured, exact[k],
                                      abs(errors[i, k]), None, "Hz", wall_time_per_second(run)))
        for k in range(_MODES):
            order = -math.log2(abs(errors[1, k] / errors[0, k]))
            if rule == "fourth order":
                results.append(Result(
                    f"frequency {k + 1}, {rule}: order in n, at least {_LEAST:g}", "direct, esdirk4", order, _LEAST,
                    max(0.0, _LEAST - order), 0.0, "", None, "short of it",
                ))
            else:
                results.append(Result(f"frequency {k + 1}, {rule}: order in n", "direct, esdirk4", order, 2.0,
                                      abs(order - 2.0), _GATE, "", None, "absolute"))
            series[f"mode {k + 1}, {rule}"] = (counts, np.abs(errors[:, k]))
    caption = (
        "Error of the first three frequencies of the clamped wire against n: Gregory's weights with the consistent "
        "mass (fourth order and more), the half-element clamp with lumped masses (second order). Each from a run that "
        f"starts in the mode, amplitude {_AMPLITUDE:g} L, {_PERIODS} periods, {_STEPS} steps of esdirk4 a period; "
        "reference: Timoshenko's beam, whose shear and rotary inertia the chain has too."
    )
    draw = pictures.orders("number of elements n", "relative error of the frequency", series,
                           [(-2.0, "order 2"), (-4.0, "order 4")])
    return Finding(tuple(results), draw, caption)


def fit_frequency(time: np.ndarray, motion: np.ndarray, guess: float) -> float:
    """Frequency of a nearly harmonic motion, Hz, by least squares of a cos + b sin + c under a window that takes out
    what other modes do.

    Parameters
    ----------
    time, motion : (k,), s, and any unit.
    guess : Hz, right to a few percent.
    """
    window = np.sin(np.pi * (time - time[0]) / (time[-1] - time[0])) ** 2
    scale = np.max(np.abs(motion))

    def residual(p: np.ndarray) -> np.ndarray:
        phase = 2.0 * np.pi * p[0] * guess * time
        basis = np.stack([np.cos(phase), np.sin(phase), np.ones_like(time)], axis=1)
        weights, *_ = np.linalg.lstsq(window[:, None] * basis, window * motion / scale, rcond=None)
        return window * (basis @ weights - motion / scale)

    fit = least_squares(residual, [1.0], xtol=1e-15, ftol=1e-15, gtol=1e-15, x_scale=1e-3)
    return float(fit.x[0]) * guess


CHECKS = (Check("clamp-frequencies", SECTION, "order of the frequencies", _frequencies),)
