"""Checks of time integration schemes under large rotations: conservation of energy and momenta, and the order attained.

Energies and momenta are summed up here from logged places, velocities and orientations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from analysis.validation import pictures, scenes
from analysis.validation.dynamics import SECTION, release, release_error
from analysis.validation.states import State, last_state, read_states, tip_motion
from analysis.validation.wire import BASE, Wire
from guidewire.figures.wording import number, percent
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_GRAVITY = 9.81  # m/s^2
_RATE = 40.0  # rad/s
_STAGES = {"implicitEuler": 1, "bdf2": 1, "trbdf2": 2, "esdirk3": 3, "esdirk4": 5}  # solved in a step
_THIN = Wire(radius=0.1e-3)


@dataclass(frozen=True)
class _Balance:
    """Energy in J (kinetic and elastic), weight's moment in kg m, and momenta, of a wire without clamps."""

    energy: float
    mass_moment: np.ndarray
    momentum: np.ndarray
    angular_momentum: np.ndarray


def _balance(wire: Wire, state: State) -> _Balance:
    """Return the balance of a state with orientations.

    Elements turn as their chords do, whose difference to their directors is the shear: rotary inertia is 1e-5 of the
    whole, and the part that is left out of it is the shear's.
    """
    x, v = state.positions, state.velocities
    n = len(x) - 1
    length = wire.length / n
    mass = wire.line_density * length
    chord = (x[1:] - x[:-1]) / length
    director = state.directors
    turning = np.cross(chord, (v[1:] - v[:-1]) / length) / np.sum(chord**2, axis=1)[:, None]
    rotary = wire.density * wire.second_moment * length
    a, b = v[:-1], v[1:]
    kinetic = mass / 6.0 * np.sum(a * a + a * b + b * b) + 0.5 * rotary * np.sum(turning**2)
    along = np.sum(chord * director, axis=1)
    across = chord - along[:, None] * director
    angles = 2.0 * np.arcsin(0.5 * np.linalg.norm(director[1:] - director[:-1], axis=1))
    elastic = (0.5 * length * wire.area * (wire.shear_modulus * np.sum(across**2)
                                           + wire.youngs_modulus * np.sum((along - 1.0) ** 2))
               + 0.5 * wire.bending / length * np.sum(angles**2))
    angular = mass / 6.0 * (np.cross(x[:-1], 2.0 * a + b) + np.cross(x[1:], a + 2.0 * b)) + rotary * turning
    return _Balance(kinetic + elastic, 0.5 * mass * np.sum(x[:-1] + x[1:], axis=0),
                    mass * state.momentum_per_mass, np.sum(angular, axis=0))


def _pendulum(wire: Wire, step: float, method: Mapping[str, Any]) -> dict[str, Any]:
    """Return a wire on a ball joint, let go level, for 2 s."""
    return {
        **scenes.wire_parameters(wire), "proximalEnd": "held", "gravity": [0.0, -_GRAVITY, 0.0], "timeStep": step,
        "maxSimulationSteps": round(2.0 / step), "logEvery": round(2.0 / step), "logOrientations": True, **method,
    }


def _spin(n: int, step: float, method: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return a free wire that turns about its middle for 1 s, and its start."""
    places = np.linspace(0.0, BASE.length, n + 1)
    speeds = _RATE * (0.5 * BASE.length - places) / scenes.UNIT
    start = {
        "positions": [[0.0, 0.0, float(z)] for z in places / scenes.UNIT], "orientations": [[0, 0, 0, 1]] * n,
        "velocities": [[0.0, float(v), 0.0] for v in speeds], "angularVelocities": [[_RATE, 0.0, 0.0]] * n,
    }
    return {
        "numberRodElements": n, "proximalEnd": "free", "timeStep": step, "maxSimulationSteps": round(1.0 / step),
        "logEvery": round(1.0 / step), "logOrientations": True, **method,
    }, start


_ENERGY_GATES = {"trbdf2": 5e-5, "esdirk3": 5e-5, "esdirk4": 5e-5, "bdf2": 3e-4, "implicitEuler": None}
_SPIN_GATES = {"trbdf2": (3e-4, 1e-4), "esdirk3": (3e-4, 1e-4), "esdirk4": (3e-4, 1e-4), "bdf2": (1.5e-3, 8e-4),
               "implicitEuler": (None, None)}
_MOMENTUM_GATE = 1e-9


def _pendulum_energy(wire: Wire, run: Run) -> float:
    """Change of a pendulum's energy over m g L/2, with its sign."""
    states = read_states(run)
    first, last = (_balance(wire, state) for state in (states[0], states[-1]))
    change = last.energy - first.energy + _GRAVITY * (last.mass_moment - first.mass_moment)[1]
    return change / (0.5 * wire.line_density * wire.length**2 * _GRAVITY)


def _errors(names: Sequence[str], errors: Mapping[tuple[str, str], float]) -> Callable[[Figure], None]:
    """Return a row for each name with the errors of all schemes, by (name, scheme)."""

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        for k, scheme in enumerate(_STAGES):
            axes.plot([max(errors[name, scheme], 1e-16) for name in names], range(len(names)),
                      pictures.MARKERS[k % 8], color=f"C{k}", fillstyle="none", label=scheme)
        axes.set_yticks(range(len(names)), names, fontsize=6)
        axes.set_xscale("log")
        pictures.label(axes, "error (1)", "")

    return draw


def _large_turns() -> Plan:
    wires = {"": BASE, ", r = 0.1 mm": _THIN}
    pendulums = {(scheme, name): Case(f"pendulum-{scheme}{'-thin' if name else ''}",
                                      _pendulum(wire, 1e-3, {"integrator": scheme}))
                 for scheme in _STAGES for name, wire in wires.items()}
    spins = {scheme: Case(f"spin-{scheme}", *_with_start(_spin(20, 0.5e-3, {"integrator": scheme})))
             for scheme in _STAGES}
    runs = yield [*pendulums.values(), *spins.values()]
    results = []
    for (scheme, name), case in pendulums.items():
        fraction = _pendulum_energy(wires[name], runs[case.key])
        results.append(Result(f"pendulum released from the horizontal{name}, 2 s at 1 ms: energy",
                              f"direct, {scheme}", fraction, 0.0, abs(fraction), _ENERGY_GATES[scheme], "m g L/2",
                              None, "m g L/2"))
    for scheme, case in spins.items():
        states = read_states(runs[case.key])
        first, last = (_balance(BASE, state) for state in (states[0], states[-1]))
        energy, turning = _SPIN_GATES[scheme]
        change = last.energy / first.energy - 1.0
        results.append(Result("free wire spun at 40 rad/s, 1 s at 0.5 ms: energy", f"direct, {scheme}", change, 0.0,
                              abs(change), energy))
        lost = float(np.linalg.norm(last.angular_momentum - first.angular_momentum)
                     / np.linalg.norm(first.angular_momentum))
        results.append(Result("free wire spun at 40 rad/s, 1 s at 0.5 ms: angular momentum", f"direct, {scheme}",
                              lost, 0.0, lost, turning))
        pushed = float(np.linalg.norm(last.momentum)) / (BASE.line_density * BASE.length
                                                        * 0.5 * _RATE * BASE.length)
        results.append(Result("free wire spun at 40 rad/s, 1 s at 0.5 ms: momentum over m w L/2", f"direct, {scheme}",
                              pushed, 0.0, pushed, _MOMENTUM_GATE))

    caption = (
        "Wires that turn far, so that their stiff stretch is driven all the time. " + "; ".join(
            f"{r.what}, {r.solver[8:]}: {percent(r.value)}" for r in results if "momentum over" not in r.what) + "."
    )
    names = list(dict.fromkeys(r.what for r in results))
    errors = {(r.what, r.solver[8:]): r.error for r in results}
    return Finding(tuple(results), _errors(names, errors), caption, width=11.0)


def _with_start(scene: tuple[dict[str, Any], dict[str, Any]]) -> tuple[dict[str, Any], int, dict[str, Any]]:
    parameters, start = scene
    return parameters, 0, start


_SOFT = Wire(radius=20e-3, youngs_modulus=25.0 * BASE.density, shear_modulus=9.6 * BASE.density)
_TUMBLE = 12.0  # rad/s
_TUMBLE_TIME = 0.3  # s
_TUMBLE_STEPS = {"bdf2": (600, 1200), "trbdf2": (300, 600), "esdirk3": (300, 600), "esdirk4": (200, 400)}
_TUMBLE_REFERENCE = 2400
_ORDERS = {"bdf2": 2, "trbdf2": 2, "esdirk3": 3, "esdirk4": 4}
_STIFF_STEPS = (150, 300, 600, 1200)


def _tumble(wire: Wire, steps: int, scheme: str) -> tuple[dict[str, Any], int, dict[str, Any]]:
    """Return a free wire that tumbles in space while it bends and twists."""
    n = 6
    fraction = np.linspace(-0.5, 0.5, n + 1)
    middle = 0.5 * (fraction[1:] + fraction[:-1])
    rate = np.array([_TUMBLE, 0.3 * _TUMBLE, 0.0])
    places = np.stack([0.0 * fraction, 0.0 * fraction, wire.length * (fraction + 0.5)], axis=1)
    velocities = np.cross(rate, places - [0.0, 0.0, 0.5 * wire.length])
    velocities[:, 0] += 0.5 * fraction**2
    spins = rate + np.stack([0.0 * middle, middle / wire.length, 10.0 * middle], axis=1)
    start = {"positions": (places / scenes.UNIT).tolist(), "orientations": [[0, 0, 0, 1]] * n,
             "velocities": (velocities / scenes.UNIT).tolist(), "angularVelocities": spins.tolist()}
    return {
        **scenes.wire_parameters(wire), "numberRodElements": n, "proximalEnd": "free", "integrator": scheme,
        "timeStep": _TUMBLE_TIME / steps, "maxSimulationSteps": steps, "logEvery": steps, "solverTolerance": 1e-13,
    }, 0, start


def _tumble_error(run: Run, exact: Run) -> float:
    """Largest distance of a node from where it should be at the end, over L."""
    gap = last_state(run).positions - last_state(exact).positions
    return float(np.max(np.linalg.norm(gap, axis=1))) / BASE.length


def _turning_order() -> Plan:
    wires = {"soft": _SOFT, "nitinol": BASE}
    steps = {"soft": _TUMBLE_STEPS, "nitinol": dict.fromkeys(_ORDERS, _STIFF_STEPS)}
    fine = {"soft": _TUMBLE_REFERENCE, "nitinol": 8 * _TUMBLE_REFERENCE}
    exact = {name: Case(f"{name}-exact", *_tumble(wire, fine[name], "esdirk4")) for name, wire in wires.items()}
    cases = {(name, scheme, k): Case(f"{name}-{scheme}-{k}", *_tumble(wire, k, scheme))
             for name, wire in wires.items() for scheme in _ORDERS for k in steps[name][scheme]}
    runs = yield [*exact.values(), *cases.values()]
    results, series, left = [], {}, []
    for name in wires:
        for scheme, order in _ORDERS.items():
            counts = steps[name][scheme]
            errors = [_tumble_error(runs[cases[name, scheme, k].key], runs[exact[name].key]) for k in counts]
            orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
            series[f"{scheme}, {name}"] = (counts, errors)
            if name == "soft":
                results.append(Result(
                    f"wire tumbling by 3.6 rad, order in time, {counts[0]} to {counts[1]} steps", f"direct, {scheme}",
                    orders[-1], order, abs(orders[-1] - order), 0.2, "", None, "absolute"))
            else:
                left.append(f"{scheme} " + ", ".join(number(o, 2) for o in orders))
                results += [Result(f"the same at nitinol's EA, {a} to {b} steps", f"direct, {scheme}", o, math.nan,
                                   error, None, "", None, "L")
                            for a, b, o, error in zip(counts, counts[1:], orders, errors[1:])]
    caption = (
        "A free wire that tumbles in space by 3.6 rad in 0.3 s, bends and twists. On a wire so soft and thick that the "
        "steps resolve its axial waves and the turning of elements against shear (omega dt at most 0.35) each scheme "
        "has its order. At nitinol's EA no step resolves them; orders from "
        + " to ".join(str(k) for k in _STIFF_STEPS) + f" steps: {'; '.join(left)}."
    )
    draw = pictures.orders("steps in 0.3 s", "error of the positions (L)", series,
                           [(-2.0, "order 2"), (-3.0, "order 3"), (-4.0, "order 4")])
    return Finding(tuple(results), draw, caption)


_SHORT = 0.1  # s


@dataclass(frozen=True)
class _Problem:
    """A motion by which schemes are compared, all with the same number of solved stages.

    Attributes
    ----------
    name : for the table.
    unit : time in s for each stage that is solved: a scheme of k stages takes steps of k units.
    time : how long it lasts, s.
    scene : keys of the run.
    fine : unit of the run with `esdirk4` that is the reference, s.
    speed : of the first sphere, m/s.
    """

    name: str
    unit: float
    time: float
    scene: Mapping[str, Any]
    fine: float
    speed: float = 0.0

    def case(self, key: str, scheme: str, unit: float) -> Case:
        """Return its run with a scheme."""
        step = unit * _STAGES[scheme]
        driven = {"displacementPerStep": self.speed * step / scenes.UNIT} if self.speed else {}
        return Case(key, {**self.scene, **driven, "integrator": scheme, "timeStep": step, "logSpheres": "last",
                          "maxSimulationSteps": math.ceil(self.time / step * (1.0 - 1e-9))})

    def error(self, run: Run, exact: Run) -> float:
        """RMS of the tip's distance from the reference over RMS of the reference about its mean, at the run's times."""
        time, tip = tip_motion(run)
        fine_time, fine = tip_motion(exact)
        at = time <= fine_time[-1]
        wanted = np.stack([np.interp(time[at], fine_time, fine[:, k]) for k in range(3)], axis=1)
        if run.outcome in ("diverged", "failed"):
            return math.inf
        gone = np.sqrt(np.mean(np.sum((wanted - wanted.mean(axis=0)) ** 2, axis=1)))
        return float(np.sqrt(np.mean(np.sum((tip[at] - wanted) ** 2, axis=1))) / gone)


_PULL = 50.0  # N
_PROBLEMS = (
    _Problem("stretch pulse: pulled with 50 N, released", 0.5e-6, 4e-4, {
        "numberRodElements": 20, "initialState": "equilibrium", "tipForce": [0.0, 0.0, _PULL],
        "tipForceReleaseTime": 0.0}, 5e-8),
    _Problem("sudden release: k = 1, released after 20.4 ms of weight", 0.5e-3, _SHORT, {
        "numberRodElements": 12, "initialState": "equilibrium", "gravity": [0.0, -_GRAVITY, 0.0],
        "tipForce": [BASE.bending / BASE.length**2, 0.0, 0.0], "tipForceReleaseTime": 0.0204}, 2e-5),
    _Problem("stepped drive: base displaced across by 0.1 mm at once", 0.5e-3, _SHORT, {
        "numberRodElements": 12, "displacement": 0.1, "displacementDirection": [0.0, 1.0, 0.0]}, 2e-5),
    _Problem("base driven across with 0.1 m/s at once", 0.5e-3, _SHORT, {
        "numberRodElements": 12, "drive": "displace", "displacementDirection": [0.0, 1.0, 0.0]}, 2e-5, 0.1),
)


def _schemes() -> Plan:
    cases: dict[tuple[str, str], Case] = {}
    for scheme, stages in _STAGES.items():
        cases["released cantilever, 0.2 s", scheme] = Case(
            f"release-{scheme}", release(10, 2e-3 / 3 * stages, {"integrator": scheme}))
        cases["pendulum, 2 s", scheme] = Case(
            f"pendulum-{scheme}", _pendulum(BASE, 1e-3 / 3 * stages, {"integrator": scheme}))
        cases["spin, 1 s", scheme] = Case(
            f"spin-{scheme}", *_with_start(_spin(20, 0.5e-3 / 3 * stages, {"integrator": scheme})))
        for k, problem in enumerate(_PROBLEMS):
            cases[problem.name, scheme] = problem.case(f"problem-{k}-{scheme}", scheme, problem.unit)
    exact = {problem.name: problem.case(f"problem-{k}-exact", "esdirk4", problem.fine)
             for k, problem in enumerate(_PROBLEMS)}
    runs = yield [*cases.values(), *exact.values()]
    problems = {problem.name: problem for problem in _PROBLEMS}
    results = []
    for (name, scheme), case in cases.items():
        run = runs[case.key]
        if name in problems:
            error, unit = problems[name].error(run, runs[exact[name].key]), "RMS"
        elif name.startswith("pendulum"):
            error, unit = abs(_pendulum_energy(BASE, run)), "m g L/2"
        elif name.startswith("spin"):
            states = read_states(run)
            error = abs(_balance(BASE, states[-1]).energy / _balance(BASE, states[0]).energy - 1.0)
            unit = "relative"
        else:
            error, unit = release_error(run), "RMS"
        results.append(Result(f"{name}, as many solved stages", f"direct, {scheme}, {_step_text(run)}", error,
                              math.nan, error, None, unit, None, unit))
    names = list(dict.fromkeys(name for name, _ in cases))
    by = {key: r.error for key, r in zip(cases, results)}
    means = {scheme: float(np.exp(np.mean([math.log(by[name, scheme]) for name in names]))) for scheme in _STAGES}

    caption = (
        f"The schemes on {len(names)} motions, with the same number of solved stages, which is what a motion costs: a "
        "scheme of k stages takes steps k times as long. Errors: " + "; ".join(
            f"{name}: " + ", ".join(f"{scheme} {percent(by[name, scheme])}" for scheme in _STAGES) for name in names)
        + ". Geometric means: " + ", ".join(f"{scheme} {percent(mean)}" for scheme, mean in means.items()) + "."
    )
    return Finding(tuple(results), _errors(names, by), caption, width=11.0)


def _step_text(run: Run) -> str:
    return f"{number(1e3 * run.number('timeStep'), 3)} ms"


CHECKS = (
    Check("large-turns", SECTION, "energy and momenta of turning wires", _large_turns),
    Check("turning-order", SECTION, "order in time of a turning wire", _turning_order),
    Check("schemes", SECTION, "which scheme for which motion", _schemes),
)
