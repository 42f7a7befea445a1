"""Checks of the experiments of a published suite for rod solvers, with its metrics and references, beside its figures.

The suite is cosseratbench (github.com/jakeryderv/cosseratbench, its findings at 6e1a81b, results-0.2 at c44ae82 and
dc6c424). Lengths in m, rods of 1 m; the references are computed here from the definitions of its experiments.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_bvp
from scipy.optimize import brentq, minimize_scalar

from analysis.validation import pictures, scenes, twisted
from analysis.validation.states import last_state, tip_motion, wall_time
from analysis.validation.wire import Wire
from guidewire.figures.wording import number
from guidewire.logs.logs import read_log
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

SECTION = "A published suite"
SOURCE = "cosseratbench, results-0.2, another machine"


@dataclass(frozen=True)
class Published:
    """The suite's results: error and wall time (s) of PyElastica 1.0.0 and of MuJoCo 3.13.0; not a number where
    a solver has no error."""

    pyelastica: tuple[float, float]
    mujoco: tuple[float, float]


PUBLISHED = {
    "cantilever, 20": Published((7.3128e-2, 0.2522), (7.4060e-2, 0.2763)),
    "cantilever, 40": Published((3.6655e-2, 0.8298), (3.7584e-2, 4.9795)),
    "catenary, 50": Published((1.3711e-4, 0.6117), (1.2258e-2, 4.8840)),
    "pendulum, 50": Published((1.3682e-4, 4.5454), (2.0885e-5, 4.9919)),
    "twist, 50": Published((1.0982e-2, 39.284), (math.nan, math.nan)),
    "capstan, 100": Published((0.14214, 2.1888), (2.4566e-3, 24.816)),
}
_GATES = {"cantilever, 20": 1e-3, "cantilever, 40": 1e-3, "catenary, 50": 1e-3, "pendulum, 50": 5e-5, "twist, 50": 1e-2,
          "capstan, 100": 5e-5}

_FINE = 200  # elements of the catenary that is compared with a stiff cable
_GRAVITY = 9.81
_BEAM = Wire(1.0, 0.02, 1e6, 1e6 / 3.0, 1000.0)
_CABLE = Wire(1.0, 0.005, 1e6, 1e6 / 3.0, 1000.0)
_CORD = Wire(1.0, 0.002, 1e7, 1e7 / 3.0, 1000.0)
_ROD = Wire(1.0, 0.01, 1e6, 1e6 / 3.0, 1000.0)

_LOAD = 7.5e-3  # N, at the cantilever's tip


def _cantilever(n: int) -> Case:
    return Case(f"cantilever-{n}", {**scenes.wire_parameters(_BEAM), **scenes.at_rest({
        "numberRodElements": n, "tipForce": [0.0, -_LOAD, 0.0]})}, repeats=3)


def _cantilever_error(run: Run) -> float:
    """Return the error of the deflection, against F L^3/(3 EI)."""
    exact = _LOAD * _BEAM.length**3 / (3.0 * _BEAM.bending)
    return abs(-float(last_state(run).positions[-1, 1]) / exact - 1.0)


_SPAN = 0.8


def catenary_sag(wire: Wire, span: float) -> float:
    """Return the sag of an elastic cable without bending stiffness between two pins at one height, m (Irvine)."""
    weight = wire.line_density * _GRAVITY
    half = 0.5 * weight * wire.length

    def width(tension: float) -> float:
        return tension * wire.length / wire.stretching + 2.0 * tension / weight * math.asinh(half / tension)

    tension = brentq(lambda h: width(h) - span, 1e-9 * half, 1e6 * half, xtol=1e-15)
    return 0.25 * half * wire.length / wire.stretching + (math.hypot(tension, half) - tension) / weight


def stiff_cable_sag(wire: Wire, span: float) -> float:
    """Return the same with its bending stiffness, m: half of it as a boundary value problem.

    EI t'' = -(1 + e) (V cos t - H sin t) with V = -w (L/2 - s) and e = (H cos t + V sin t)/EA; t' = 0 at the pin.
    """
    weight, half = wire.line_density * _GRAVITY, 0.5 * wire.length

    def rates(s: np.ndarray, y: np.ndarray, unknown: np.ndarray) -> np.ndarray:
        along, down, cos, sin = unknown[0], -weight * (half - s), np.cos(y[0]), np.sin(y[0])
        stretch = 1.0 + (along * cos + down * sin) / wire.stretching
        return np.stack([y[1], -stretch * (down * cos - along * sin) / wire.bending, stretch * cos, stretch * sin])

    def ends(a: np.ndarray, b: np.ndarray, _: np.ndarray) -> np.ndarray:
        return np.array([a[1], a[2], a[3], b[0], b[2] - 0.5 * span])

    s = np.linspace(0.0, half, 201)
    along = 0.5 * weight * wire.length
    angle = -np.arctan2(weight * (half - s), along)
    guess = np.stack([angle, np.gradient(angle, s), span / wire.length * s, 0.6 * (s - half) - 0.3 * wire.length])
    found = solve_bvp(rates, ends, s, guess, p=np.array([along]), tol=1e-8, max_nodes=100_000)
    if not found.success:
        raise ArithmeticError(f"cable between pins: {found.message}")
    return -float(found.y[3, -1])


def _catenary(n: int) -> Case:
    """Start from a circular arc."""
    angle = brentq(lambda a: math.sin(a) / a - _SPAN / _CABLE.length, 1e-3, math.pi)
    turn = np.linspace(-angle, angle, n + 1)
    radius = 0.5 * _CABLE.length / angle
    start = scenes.plane_start(radius * (np.sin(turn) + math.sin(angle)), radius * (np.cos(turn) - math.cos(angle)))
    return Case(f"catenary-{n}", {**scenes.wire_parameters(_CABLE), **scenes.at_rest({
        "numberRodElements": n, "proximalEnd": "held", "distalEnd": "held",
        "gravity": [0.0, -_GRAVITY, 0.0]})}, start=start, repeats=3)


def _sag(run: Run) -> float:
    """Depth of the lowest node, m."""
    return -float(np.min(last_state(run).positions[:, 1]))


def _catenary_error(run: Run) -> float:
    return abs(_sag(run) / catenary_sag(_CABLE, _SPAN) - 1.0)


_SWING, _SECONDS, _STEP = 0.02, 5.0, 5e-3  # m, s, s


def first_mode(wire: Wire) -> tuple[float, Any]:
    """Frequency (rad/s) and shape u(s) of the slowest small swing of a rod that hangs from a pin at s = 0; u(L) = 1.

    EI u'''' - (T u')' = rho A w^2 u with the weight below as T, over 1 + T/EA as it acts along the stretched rod.
    """
    weight, length = wire.line_density * _GRAVITY, wire.length

    def slope(s: np.ndarray, y: np.ndarray, unknown: np.ndarray) -> np.ndarray:
        tension, rise = weight * (length - s), -weight
        stretch = 1.0 + tension / wire.stretching
        pull = tension / stretch * y[2] + rise / stretch**2 * y[1]
        return np.stack([y[1], y[2], y[3], (pull + wire.line_density * unknown[0] * y[0]) / wire.bending])

    def ends(a: np.ndarray, b: np.ndarray, _: np.ndarray) -> np.ndarray:
        return np.array([a[0], a[2], b[2], b[3], b[0] - 1.0])

    mesh = np.linspace(0.0, length, 201)
    chain = 1.2024**2 * _GRAVITY / length  # Bernoulli's hanging chain
    found = solve_bvp(slope, ends, mesh, np.stack([mesh / length, np.full_like(mesh, 1.0 / length), 0.0 * mesh,
                                                   0.0 * mesh]), p=np.array([chain]), tol=1e-9, max_nodes=100_000)
    if not found.success:
        raise ArithmeticError(f"swing of a hanging rod: {found.message}")
    return math.sqrt(float(found.p[0])), found.sol


def _pendulum(n: int) -> Case:
    _, mode = first_mode(_CORD)
    s = np.linspace(0.0, _CORD.length, n + 1)
    across = _SWING * mode(s)[0]
    middle = 0.5 * (s[1:] + s[:-1])
    chords = _CORD.length / n * (1.0 + _CORD.line_density * _GRAVITY * (_CORD.length - middle) / _CORD.stretching)
    along = np.concatenate([[0.0], np.cumsum(np.sqrt(chords**2 - np.diff(across) ** 2))])
    start = {key: value for key, value in scenes.plane_start(along, across).items() if not key.endswith("Frame")}
    return Case(f"pendulum-{n}", {
        **scenes.wire_parameters(_CORD), "numberRodElements": n, "proximalEnd": "held", "integrator": "esdirk4",
        "gravity": [0.0, 0.0, _GRAVITY], "timeStep": _STEP, "maxSimulationSteps": round(_SECONDS / _STEP),
        "logSpheres": "last", "deltaThreshold": 0.0}, start=start)


def _pendulum_error(run: Run) -> float:
    """Return the error of the period of the one sinusoid that is nearest to the tip's motion across."""
    time, tip = tip_motion(run)
    exact, _ = first_mode(_CORD)

    def left(frequency: float) -> float:
        basis = np.stack([np.cos(frequency * time), np.sin(frequency * time), np.ones_like(time)], axis=1)
        return float(np.linalg.norm(tip[:, 1] - basis @ np.linalg.lstsq(basis, tip[:, 1], rcond=None)[0]))

    found = minimize_scalar(left, bounds=(0.97 * exact, 1.03 * exact), method="bounded", options={"xatol": 1e-10})
    return abs(exact / float(found.x) - 1.0)


_LEVELS = (0.96, 0.98, 1.00, 1.02, 1.04, 1.06)  # of the critical twist
_TENSION, _BUMP = 10.0, 1e-4  # EI/L^2, L
_RAMP, _HELD, _END, _FRAME = 6.0, 8.0, 16.0, 0.05  # s: twisted, growth is exponential from, end, between frames
_DRAG = 2.0  # 1/s


def _twist(n: int, level: float) -> Case:
    twist = level * twisted.clamped_moment(_TENSION) * _ROD.bending / _ROD.torsion
    arc = np.linspace(0.0, 1.0, n + 1)
    start = scenes.plane_start(_ROD.length * arc, 0.5 * _BUMP * _ROD.length * (1.0 - np.cos(2.0 * np.pi * arc)))
    return Case(f"twist-{n}-{level:g}", {
        **scenes.wire_parameters(_ROD), "numberRodElements": n, "distalEnd": "sliding", "distalRotation": twist,
        "distalRampTime": _RAMP, "axialForce": _TENSION * _ROD.bending / _ROD.length**2, "massDamping": _DRAG,
        "timeStep": _FRAME, "maxSimulationSteps": round(_END / _FRAME), "deltaThreshold": 0.0}, start=start)


def _growth(run: Run) -> float:
    """Return the growth of the largest distance from the axis while the twist is held and that is small, 1/s."""
    log = read_log(run.folder, spheres="all")
    aside = scenes.UNIT * np.max(np.linalg.norm(log.positions[:, :, :2], axis=2), axis=1)
    use = (log.time >= _HELD) & (aside > 0.0) & (aside < 1e-2)
    return float(np.polyfit(log.time[use], np.log(aside[use]), 1)[0]) if np.count_nonzero(use) >= 5 else math.nan


def critical_level(rates: Mapping[float, float]) -> float:
    """Level at which growth begins: s^2 + c s = a (level - critical) through the lowest three that grow."""
    growing = [(level, s) for level, s in rates.items() if s > 0.05][:3]
    if len(growing) < 3:
        return math.nan
    level, s = np.array(growing).T
    c, a, b = np.linalg.solve(np.stack([-s, level, np.ones(3)], axis=1), s**2)
    return float(-b / a)


_DRUM, _ROPE, _FRICTION, _LIGHT = 0.05, Wire(1.0, 1e-3, 3e5, 1e5, 1000.0), 0.3, 0.15  # m; and the light side, m
_OFF = 0.1  # m: it slides
_WAITED, _PAUSE = 2.0, 1e-2  # s: how long the rope may move, in steps of


def holding_overhang() -> float:
    """Length of the heavy side up to which the rope holds, m: T' = mu T + w a (cos phi + mu sin phi) on the drum."""
    grows, around = math.exp(_FRICTION * math.pi), _DRUM + _ROPE.radius
    return grows * _LIGHT + around * 2.0 * _FRICTION / (1.0 + _FRICTION**2) * (grows + 1.0)


def _capstan(n: int, overhang: float) -> Case:
    """Return the rope starts as it hangs in balance, its tension on the drum by a part m of the friction's
    coefficient."""
    weight, heavy = _ROPE.line_density * _GRAVITY, overhang * holding_overhang()
    radii = _DRUM + _ROPE.radius
    # The chord of any element, stretched, clears the drum.
    piece = 1.05 * (_LIGHT + math.pi * radii + heavy) / n
    around = radii / math.cos(0.5 * piece / radii)
    phi = np.linspace(0.0, math.pi, 2001)

    def tension(m: float) -> np.ndarray:
        inside = np.exp(-m * phi) * weight * around * (np.cos(phi) + m * np.sin(phi))
        step = 0.5 * (inside[1:] + inside[:-1]) * np.diff(phi)
        return np.exp(m * phi) * (weight * _LIGHT + np.concatenate([[0.0], np.cumsum(step)]))

    used = brentq(lambda m: tension(m)[-1] - weight * heavy, -1.0, 2.0)
    on = tension(used)
    # Of points along the path: the angle or the way beyond the drum, and the unstretched length between them.
    stretch = 1.0 + 0.5 * (on[1:] + on[:-1]) / _ROPE.stretching
    wrapped = np.concatenate([[0.0], np.cumsum(around * np.diff(phi) / stretch)])
    length = _LIGHT + float(wrapped[-1]) + heavy
    s = length * np.linspace(0.0, 1.0, n + 1)
    angle = np.interp(s - _LIGHT, wrapped, phi)

    def hung(rest: np.ndarray, side: float) -> np.ndarray:
        """Stretched length between the drum and a point that is `rest` above the free end of a side."""
        return (side - rest) + 0.5 * weight / _ROPE.stretching * (side**2 - rest**2)

    below = np.where(s < _LIGHT, hung(np.minimum(s, _LIGHT), _LIGHT), hung(np.minimum(length - s, heavy), heavy))
    start = scenes.plane_start(-around * np.cos(angle), below - around * np.sin(angle))
    rope = Wire(length, _ROPE.radius, _ROPE.youngs_modulus, _ROPE.shear_modulus, _ROPE.density)
    return Case(f"capstan-{overhang:g}", {
        **scenes.wire_parameters(rope), "numberRodElements": n, "integrator": "implicitEuler", "proximalEnd": "free",
        "gravity": [0.0, -_GRAVITY, 0.0], "massDamping": 5.0, "timeStep": _PAUSE, "deltaThreshold": 0.0,
        "maxSimulationSteps": round(_WAITED / _PAUSE),
        "obstacles": [{"shape": "capsule", "from": [-50.0, 0.0, 0.0], "to": [50.0, 0.0, 0.0],
                       "radius": _DRUM / scenes.UNIT, "frictionCoefficient": _FRICTION}],
    }, start={key: value for key, value in start.items() if not key.endswith("Frame")})


def _slide(run: Run) -> float:
    """Return how far the light end rose, m."""
    height = scenes.UNIT * read_log(run.folder, spheres=(0,)).positions[:, 0, 1]
    return float(np.max(height) - height[0])


def _plan() -> Plan:
    cases = {"cantilever, 20": [_cantilever(20)], "cantilever, 40": [_cantilever(40)], "catenary, 50": [_catenary(50)],
             "pendulum, 50": [_pendulum(50)], "twist, 50": [_twist(50, level) for level in _LEVELS],
             "capstan, 100": [_capstan(100, 0.8)]}
    fine, others = _catenary(_FINE), {overhang: _capstan(100, overhang) for overhang in (0.95, 1.1)}
    runs = yield [*(case for made in cases.values() for case in made), fine, *others.values()]
    measures = {"cantilever": _cantilever_error, "catenary": _catenary_error, "pendulum": _pendulum_error,
                "capstan": _slide}
    units = {"cantilever": "error of the tip's deflection", "catenary": "error of the sag",
             "pendulum": "error of the period", "twist": "error of the critical twist",
             "capstan": "slide of the light end in 2 s at 0.8 of the overhang that holds, m"}
    results, ours = [], {}
    for name, made in cases.items():
        kind = name.split(",")[0]
        if kind == "twist":
            error = abs(critical_level({level: _growth(runs[case.key]) for level, case in zip(_LEVELS, made)}) - 1.0)
        else:
            error = measures[kind](runs[made[0].key])
        cost = sum(wall_time(runs[case.key], case.repeats) for case in made)
        ours[name] = (error, cost)
        results.append(Result(f"{name} elements: {units[kind]}", "direct", error, 0.0, error, _GATES[name], "", cost,
                              "of the suite's reference"))
        for solver, figures in (("PyElastica 1.0.0", PUBLISHED[name].pyelastica),
                                ("MuJoCo 3.13.0", PUBLISHED[name].mujoco)):
            if math.isfinite(figures[0]):
                results.append(Result(f"{name} elements: {units[kind]}; {SOURCE}", solver, figures[0], 0.0, figures[0],
                                      None, "", figures[1], "of the suite's reference"))

    sag, exact = _sag(runs[fine.key]), stiff_cable_sag(_CABLE, _SPAN)
    results.append(Result(f"catenary, {_FINE} elements: sag, against a cable with bending stiffness, "
                          f"{number(exact / catenary_sag(_CABLE, _SPAN) - 1.0, 2)} off the suite's reference", "direct",
                          sag, exact, abs(sag / exact - 1.0), 1e-4, "m", wall_time(runs[fine.key], fine.repeats)))

    for overhang, case in others.items():
        slide, cost = _slide(runs[case.key]), wall_time(runs[case.key])
        what = f"capstan, 100 elements, {overhang:g} of the overhang that holds: slide of the light end in 2 s"
        results.append(
            Result(f"{what}, none", "direct", slide, 0.0, slide, _GATES["capstan, 100"], "m", cost, "m")
            if overhang < 1.0 else
            Result(f"{what}, at least {_OFF:g} m", "direct", slide, _OFF, max(0.0, _OFF - slide), 0.0, "m", cost,
                   "m short of it"))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for color, name in enumerate(cases):
            series = (("o", "direct", ours[name]), ("s", "PyElastica", PUBLISHED[name].pyelastica),
                      ("^", "MuJoCo", PUBLISHED[name].mujoco))
            for marker, solver, (error, cost) in series:
                if math.isfinite(error):
                    axes.plot(cost, error, marker, color=f"C{color}", label=f"{name}: {solver}",
                              fillstyle="full" if solver == "direct" else "none")
        axes.set_xscale("log")
        axes.set_yscale("log")
        pictures.label(axes, "wall time (s; of others: another machine)", "error (1; capstan: slide in m)")

    return Finding(tuple(results), draw, (
        "Experiments of cosseratbench with its metrics and references: ours (full; steps and search alone) beside its "
        "published figures (results-0.2, another machine). "
        + " ".join(f"{name} elements: {number(error, 2)} in {number(cost, 2)} s."
                   for name, (error, cost) in ours.items())
        + " MuJoCo has no result of the twist: it diverges."), width=10.0)


CHECKS = (Check("suite", SECTION, "experiments of a published suite", _plan),)
