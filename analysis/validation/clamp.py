"""Checks of the clamp: the order of the error in n, in statics and in the frequencies, for every rule."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from analysis.validation import beam, pictures, scenes
from analysis.validation.states import last_state, tip_motion, wall_time, wall_time_per_second
from analysis.validation.wire import BASE
from guidewire.figures.wording import number
from guidewire.studies.table import Axis, Case, Grid
from guidewire.sweeps.check import Check, Finding, Plan, Result, by_point

SECTION = "The clamp"
SMALL = 1e-4  # F L^2/EI and w L^3/EI, small enough for the linear beam
ROUNDING = 1e-7  # of the compliance: what is left of 1e-4 L in double precision, and of the load's square
RULES = {"wholeElement": (1, "whole-element joint"), "halfElement": (2, "half-element joint"),
         "fourthOrder": (4, "Gregory's weights")}
_COUNTS = (10, 20, 30, 40, 80)
_GATE = 0.1  # on the order


def _compliance() -> Plan:
    force = SMALL * BASE.bending / BASE.length**2
    gravity = SMALL * BASE.bending / (BASE.length**3 * BASE.line_density)
    loads: dict[str, dict[str, Any]] = {
        "tip-load": {"tipForce": [0.0, -force, 0.0]}, "own-weight": {"gravity": [0.0, -gravity, 0.0]},
    }
    # Shear adds F L/GA and w L^2/(2 GA), which the chain takes into account too.
    shear = BASE.bending / (BASE.shearing * BASE.length**2)
    exact = {"tip-load": beam.tip_load_compliance() + shear, "own-weight": beam.own_weight_compliance() + 0.5 * shear}
    grid = Grid(
        (Axis("clampRule", tuple(RULES)), Axis("numberRodElements", _COUNTS)),
        scenes.at_rest({"solverTolerance": 1e-13}), loads,
    )
    runs = by_point((yield grid.cases()))
    results, series = [], {}
    for load in loads:
        for rule, (order, name) in RULES.items():
            errors = []
            for n in _COUNTS:
                run = runs[load, rule, n]
                tip = -last_state(run).positions[-1, 1] / BASE.length / SMALL
                errors.append(abs(tip / exact[load] - 1.0))
                if n == scenes.ELEMENTS:
                    results.append(Result(f"{load.replace('-', ' ')}, {name}, n = {n}: compliance", "direct", tip,
                                          exact[load], errors[-1], None, "L³/EI", wall_time(run)))
                if load == "tip-load" and rule == "wholeElement":
                    chain = beam.hinged_chain_factor(n) * beam.tip_load_compliance() + shear
                    results.append(Result(
                        f"tip load, {name}, n = {n}: compliance of such a chain", "direct", tip, chain,
                        abs(tip / chain - 1.0), ROUNDING, "L³/EI", wall_time(run),
                    ))
            if load == "tip-load" and rule == "fourthOrder":
                results.append(Result("tip load, Gregory's weights: compliance, worst of n = 10 to 80", "direct",
                                      tip, exact[load], max(errors), ROUNDING, "L³/EI", wall_time(run)))
                continue
            measured = -math.log2(errors[1] / errors[0])
            results.append(Result(
                f"{load.replace('-', ' ')}, {name}: order of the compliance, n = 10 to 20", "direct",
                measured, order, abs(measured - order), _GATE, "", wall_time(run), "absolute",
            ))
            series[f"{load.replace('-', ' ')}, {rule}"] = (_COUNTS, errors)
    caption = (
        "Error of the tip's deflection under small loads against the number of elements, for three rules for the "
        "joints at the clamp. A joint of a whole element has an error of first order, as has a clamp that fixes sphere "
        "0 and the frame of element 0. Gregory's weights are exact for a tip load (not drawn: "
        f"{number(next(r.error for r in results if 'worst' in r.what), 1)}) and of fourth order for the own weight."
    )
    draw = pictures.orders("number of elements n", "relative error of the deflection", series,
                           [(-1.0, "order 1"), (-2.0, "order 2"), (-4.0, "order 4")])
    return Finding(tuple(results), draw, caption)


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


CHECKS = (
    Check("clamp-compliance", SECTION, "order of the static compliance", _compliance),
    Check("clamp-frequencies", SECTION, "order of the frequencies", _frequencies),
)
