"""Problems of a wire without walls: own weight, a released cantilever, a pendulum, a bar that is struck, twist."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from analysis.chart import settings
from analysis.chart.points import Asked, Measure, Problem, Setting, case
from analysis.validation import beam, elastica, scenes, swing
from analysis.validation.bar import BAR_ELEMENTS, BAR_MASS, BAR_SPRING, BarChain, bar_gain
from analysis.validation.dynamics import (
    RELEASE_LOAD, RELEASE_TIME, release, release_error, release_reference, rms_error,
)
from analysis.validation.states import last_state, tip_at, tip_motion
from analysis.validation.wire import BASE
from guidewire.figures.wording import number, percent
from guidewire.logs.runs import Run

FIRST = 2.0 * math.pi * beam.frequencies(BASE, 1)[0]  # rad/s
REST_TIME = 15.0 / FIRST  # s; a critically damped motion is over
_RATE = 2.0 * FIRST  # 1/s, critical
_WEIGHT = BASE.line_density * settings.GRAVITY * BASE.length**3 / BASE.bending
_COUNTS = (8, 15, 30)


def own_sag() -> float:
    """Deflection of the base wire's tip under its own weight over L."""
    return elastica.heavy(_WEIGHT, np.linspace(0.0, 1.0, 11)).tip[1]


def base_gain() -> scenes.Asking[float]:
    """pbd's gain for that sag."""
    return (yield from settings.tuned_gain(BASE, _RATE, REST_TIME, own_sag()))


def _limits(counts: Sequence[int], more: Mapping[str, Any] | None = None) -> scenes.Asking[dict[int, float]]:
    """Stable substeps of the explicit method by n."""
    named = {f"limit-{n}": {"numberRodElements": n, **(more or {})} for n in counts}
    stable = yield from scenes.stable_substeps(named)
    return dict(zip(counts, stable.values()))


Scene = Callable[[int, float, Mapping[str, Any]], dict[str, Any]]  # of n, time step and the solver's keys


def _direct(scene: Scene, values: Sequence[tuple[str, int, float]]) -> list[Setting]:
    """Return a scene with the direct method, by scheme, n and time step."""
    return [Setting("direct", *settings.direct(scheme, n, dt),
                    case(f"{scheme}-{n}-{dt}", "direct", scene(n, dt, {"integrator": scheme})))
            for scheme, n, dt in values]


def _small_steps(scene: Scene, step: float, stable: Mapping[int, float],
                 sweeps: Sequence[tuple[int, int, int]]) -> list[Setting]:
    """Return a scene with the methods of small steps: explicit at each n that
    `stable` has a substep for, xpbd with each (n, substeps, iterations)."""
    made = []
    for n, limit in stable.items():
        small = scenes.explicit_steps(step, limit)
        made.append(Setting("explicit", *settings.small_steps(n, step / small["substeps"]), case(
            f"explicit-{n}", "explicit", scene(n, step, {"solver": "explicit", **small}))))
    return made + [
        Setting("xpbd", *settings.small_steps(n, step / k, m), case(
            f"xpbd-{n}-{k}-{m}", "xpbd", scene(n, step, {
                "solver": "xpbd", "substeps": k, "constraintSolverSteps": m})))
        for n, k, m in sweeps
    ]


def _at_rest() -> scenes.Asking[Asked]:
    gain = yield from base_gain()
    stable = yield from _limits(_COUNTS)
    made = [
        Setting("direct", f"rest shape at once, n = {n}", f"at once n{n}", case(f"at-once-{n}", "direct", {
            "numberRodElements": n, "initialState": "equilibrium", "maxSimulationSteps": 0, "timeStep": REST_TIME,
            "gravity": [0.0, -settings.GRAVITY, 0.0]}))
        for n in (5, 10, 30)
    ]

    def hanging(n: int, step: float, method: Mapping[str, Any]) -> dict[str, Any]:
        return {**settings.settled(method, step, _RATE, REST_TIME), "numberRodElements": n}

    made += [
        Setting("direct", *settings.direct("implicitEuler", n, step), case(
            f"direct-{n}-{step}", "direct", hanging(n, step, {"integrator": "implicitEuler"})))
        for n, step in ((8, 2e-2), (8, 4e-3), (15, 4e-3), (30, 4e-3), (60, 2e-3))
    ]
    made += _small_steps(hanging, 2e-4, stable, ()) + _small_steps(hanging, 1e-3, {}, (
        (8, 180, 1), (15, 320, 1), (30, 400, 1), (30, 600, 1), (30, 1000, 1), (30, 300, 3)))
    made += settings.changed_pbd(gain, settings.PBD_CHANGES, lambda method: settings.settled(
        method, method["timeStep"], _RATE, REST_TIME))
    wanted = own_sag()

    def measure(_: Mapping[str, Run]) -> tuple[Measure, str]:
        return lambda run: abs(settings.tip_sag(run, BASE) / wanted - 1.0), "the elastica under its own weight"

    return Asked(made, measure, gain=gain)


def _let_go() -> scenes.Asking[Asked]:
    gain = yield from base_gain()
    stable = yield from _limits((10, 20, 30))
    made = _direct(release, (
        ("implicitEuler", 12, 1e-3), ("implicitEuler", 12, 1e-4), ("bdf2", 12, 5e-4), ("bdf2", 12, 2.5e-4),
        ("trbdf2", 10, 2e-3), ("trbdf2", 12, 5e-4), ("esdirk3", 5, 8e-3), ("esdirk3", 8, 4e-3),
        ("esdirk3", 10, 4e-3), ("esdirk3", 10, 2e-3), ("esdirk3", 12, 1e-3), ("esdirk4", 10, 4e-3),
        ("esdirk4", 12, 2e-3), ("esdirk4", 16, 1e-3), ("esdirk4", 30, 5e-4)))
    made += _small_steps(release, 2e-4, stable, (
        (10, 45, 1), (20, 80, 1), (30, 80, 1), (30, 120, 1), (30, 200, 1), (30, 60, 3), (30, 20, 30)))

    def bent(n: int) -> dict[str, Any]:
        shape = elastica.tip_loaded(RELEASE_LOAD, np.linspace(0.0, 1.0, n + 1))
        return scenes.plane_start(BASE.length * shape.along, BASE.length * shape.across)

    made += settings.changed_pbd(gain, settings.PBD_CHANGES, lambda method: {
        **method, "maxSimulationSteps": round(RELEASE_TIME / method["timeStep"]), "logSpheres": "last"}, bent)

    def measure(_: Mapping[str, Run]) -> tuple[Measure, str]:
        return release_error, ("modes of the slope, geometrically exact; 14 and 10 of them are "
                               f"{percent(release_reference()[1], 1)} apart")

    return Asked(made, measure, gain=gain)


_SWING_TIME = 1.0  # s


@lru_cache(maxsize=1)
def _swing_reference() -> tuple[np.ndarray, np.ndarray, float]:
    """Times in s, shape (k,), places of the tip (along, down) in m, shape (k, 2), and the error of a shorter series."""
    fine, coarse = (swing.tip_motion(BASE, settings.GRAVITY, _SWING_TIME, 501, modes) for modes in (5, 4))
    return fine.time, np.stack([fine.along, fine.across], axis=1), rms_error(
        np.stack([coarse.along, coarse.across]), np.stack([fine.along, fine.across]))


def _swing_error(run: Run) -> float:
    time, tip, _ = _swing_reference()
    found = tip_at(run, time)
    return rms_error(np.stack([found[:, 2], -found[:, 1]], axis=1), tip)


def _pendulum() -> scenes.Asking[Asked]:
    gain = yield from base_gain()
    stable = yield from _limits((4, 8, 15), {"proximalEnd": "held"})

    def motion(n: int, step: float, more: Mapping[str, Any]) -> dict[str, Any]:
        return {"numberRodElements": n, "proximalEnd": "held", "gravity": [0.0, -settings.GRAVITY, 0.0],
                "timeStep": step, "maxSimulationSteps": round(_SWING_TIME / step), "logSpheres": "last", **more}

    made = _direct(motion, (
        ("implicitEuler", 4, 1e-3), ("implicitEuler", 8, 1e-4), ("bdf2", 4, 4e-3), ("bdf2", 8, 1e-3),
        ("trbdf2", 4, 1e-2), ("trbdf2", 8, 2e-3), ("esdirk3", 2, 2e-2), ("esdirk3", 4, 1e-2), ("esdirk3", 8, 4e-3),
        ("esdirk4", 2, 4e-2), ("esdirk4", 4, 2e-2), ("esdirk4", 8, 4e-3), ("esdirk4", 16, 2e-3)))
    made += _small_steps(motion, 1e-3, stable, ((4, 100, 1), (4, 400, 1), (10, 225, 1), (20, 400, 1), (10, 100, 3)))
    weight = [0.0, -settings.GRAVITY / scenes.UNIT, 0.0]
    changes = (*settings.PBD_CHANGES, {"constraintSolverSteps": 50, "numberRodElements": 8})
    made += settings.changed_pbd(gain, changes, lambda method: motion(
        method["numberRodElements"], method["timeStep"], {**method, "gravity": weight}))

    def measure(_: Mapping[str, Run]) -> tuple[Measure, str]:
        return _swing_error, ("cosines of the slope, geometrically exact; 5 and 4 of them are "
                              f"{percent(_swing_reference()[2], 1)} apart")

    return Asked(made, measure, gain=gain)


_BAR_TIME = 2e-3  # s
_BAR_SHIFT = 1e-3  # m


def _bar() -> scenes.Asking[Asked]:
    yield []
    wave = {"numberRodElements": BAR_ELEMENTS, "displacement": _BAR_SHIFT / scenes.UNIT, "logSpheres": "last",
            "displacementDirection": [0.0, 0.0, 1.0]}

    def motion(step: float, more: Mapping[str, Any]) -> dict[str, Any]:
        return {**wave, "timeStep": step, "maxSimulationSteps": round(_BAR_TIME / step), **more}

    uniform = {"massRule": "uniform"}  # as a wire of gains has it
    made = [
        Setting("direct", *settings.direct(scheme, BAR_ELEMENTS, dt), case(
            f"{scheme}-{dt}", "direct", motion(dt, {**uniform, "integrator": scheme})))
        for scheme, dt in (
            ("implicitEuler", 2e-6), ("implicitEuler", 2.5e-7), ("bdf2", 2e-6), ("bdf2", 2.5e-7), ("trbdf2", 2e-6),
            ("trbdf2", 2.5e-7), ("esdirk3", 4e-6), ("esdirk3", 1e-6), ("esdirk3", 2.5e-7), ("esdirk4", 4e-6),
            ("esdirk4", 1e-6), ("esdirk4", 2.5e-7),
        )
    ]
    made += [
        Setting("explicit", *settings.small_steps(BAR_ELEMENTS, 2.5e-7 / k), case(
            f"explicit-{k}", "explicit", motion(2.5e-7, {**uniform, "solver": "explicit", "substeps": k})))
        for k in (1, 2, 5)
    ]
    made += [
        Setting("xpbd", *settings.small_steps(BAR_ELEMENTS, dt, m), case(
            f"xpbd-{dt}-{m}", "xpbd", motion(dt, {**uniform, "solver": "xpbd", "constraintSolverSteps": m})))
        for dt, m in ((2.5e-7, 1), (2.5e-7, 10), (1e-6, 10))
    ]
    for step in (1e-6, 2.5e-7, 5e-8):
        made.append(Setting("pbd", f"m = 1, stiffness of the springs, dt = {settings.time_text(step)}",
                            f"m1 {settings.time_text(step)}", case(f"pbd-{step}", "pbd", motion(step, {
                                "solver": "pbd", "constraintSolverSteps": 1, "stretchStiffness": bar_gain(step),
                                "bendStiffness": 0.0, "totalMass": (BAR_ELEMENTS + 1) * BAR_MASS}))))
    chain = BarChain(BAR_ELEMENTS, BAR_MASS, BAR_SPRING, _BAR_SHIFT)

    def error(run: Run) -> float:
        time, tip = tip_motion(run)
        return rms_error(tip[:, 2] - BASE.length, chain.motion(time, BAR_ELEMENTS))

    return Asked(made, lambda _: (error, "the exact motion of the chain of 30 springs"))


_TURN = 0.5 * math.pi
_TWIST_FREQUENCY = 0.5 / BASE.length * math.sqrt(BASE.shear_modulus / BASE.density)  # Hz
_TWIST_TIME = 2e-3  # s, six periods of the slowest wave of twist
_PBD_TWIST_TIME = 0.4  # s; with gains twist has no damping but that of the sweeps themselves


def twist_error(run: Run) -> float:
    """Worst difference of an inner element's turn from the linear profile, over the turn."""
    twists = last_state(run).twists / _TURN
    return float(np.max(np.abs(twists - _linear(len(twists)))[2:-2]))


def _linear(n: int) -> np.ndarray:
    """Turn of the elements' middles between two clamps over the whole turn, shape (n,)."""
    return (np.arange(n) + 0.5) / n


def pbd_twist_error(n: int) -> float:
    """Return the same for sweeps with gains at rest: inner joints share the turn, the first and the last have
    half of it."""
    found = (np.arange(n) - 0.5) / (n - 2)
    return float(np.max(np.abs(found - _linear(n))[2:-2]))


def _twist() -> scenes.Asking[Asked]:
    gain = yield from base_gain()
    stable = yield from _limits(_COUNTS, {"distalEnd": "clamped"})
    return twist_asked(gain, stable)


def twist_asked(gain: float, stable: Mapping[int, float]) -> Asked:
    """Settings of the twist problem with pbd's gain and the explicit method's stable substeps by n."""
    omega = 2.0 * math.pi * _TWIST_FREQUENCY

    def turned(n: int, step: float, method: Mapping[str, Any]) -> dict[str, Any]:
        return {
            "numberRodElements": n, "distalEnd": "clamped", "distalRotation": _TURN, "timeStep": step,
            **scenes.damping(method.get("solver", "direct"), 2.0 * omega, step),
            "maxSimulationSteps": math.ceil(_TWIST_TIME / step), "logEvery": 1_000_000, "logOrientations": True,
            "distalRampTime": 0.05 / _TWIST_FREQUENCY, **method,
        }

    made = [
        Setting("direct", *settings.direct("implicitEuler", n, dt), case(
            f"direct-{n}-{dt}", "direct", turned(n, dt, {"integrator": "implicitEuler"})))
        for n, dt in ((8, 1e-4), (8, 2e-5), (15, 2e-5), (30, 2e-5))
    ]
    made += _small_steps(turned, 4e-6, stable, (
        (8, 1, 1), (15, 1, 1), (30, 1, 1), (30, 2, 1), (30, 4, 1), (30, 1, 3), (30, 1, 10)))
    made += settings.changed_pbd(gain, settings.PBD_CHANGES, lambda method: turned(
        method["numberRodElements"], method["timeStep"], {
            **method, "damping": 0.0, "maxSimulationSteps": round(_PBD_TWIST_TIME / method["timeStep"])}))
    clamps = number(100.0 * pbd_twist_error(settings.TUNED["numberRodElements"]), 2)
    reference = (f"the linear profile; pbd holds the frames of the outer elements, which alone is {clamps} % off at "
                 "n = 30")
    return Asked(made, lambda _: (twist_error, reference), gain=gain)


PROBLEMS = (
    Problem("static", "sag under own weight", "sag of the tip, relative", _at_rest),
    Problem("release", "released cantilever, 0.2 s", "RMS of the tip, relative", _let_go),
    Problem("pendulum", "pendulum released from the horizontal, 1 s", "RMS of the tip, of L", _pendulum),
    Problem("bar", "bar struck at its base, 2 ms", "RMS of the tip, relative", _bar),
    Problem("turned", "one end turned by 90°", "worst element's turn, of 90°", _twist),
)
