"""Problems of a wire that meets walls, for the methods that do: pbd, xpbd and direct."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from analysis.chart import settings
from analysis.chart.points import Asked, Measure, Problem, Setting, case
from analysis.validation import beam, elastica, scenes
from analysis.validation.dynamics import rms_error
from analysis.validation.states import last_state, tip_at
from analysis.validation.wire import Wire
from guidewire.figures.wording import percent
from guidewire.logs.hub import read_hub
from guidewire.logs.runs import Run
from guidewire.studies.table import Case

PLANE_WIRE = Wire(radius=0.3e-3)
PLANE_DROP = 20e-3  # m
ABSENT = {"explicit": "does not support walls"}
_FIRST = 2.0 * math.pi * beam.frequencies(PLANE_WIRE, 1)[0]  # rad/s
_REST_TIME = 15.0 / _FIRST  # s
_RATE = 2.0 * _FIRST  # 1/s, critical
_LOAD = PLANE_WIRE.line_density * settings.GRAVITY * PLANE_WIRE.length**3 / PLANE_WIRE.bending
_ARC = np.linspace(0.0, 1.0, 601)  # s/L, at which shapes are compared
_PBD_CHANGES = [changed for changed in settings.PBD_CHANGES if changed.get("constraintSolverSteps") != 2000]
_XPBD = ((8, 250, 1), (8, 100, 3), (15, 400, 1), (15, 150, 3), (30, 800, 1), (30, 1600, 1))  # n, substeps of 1 ms, m


def _gain() -> scenes.Asking[float]:
    """pbd's gain for the sag of the thin wire without walls."""
    sag = elastica.heavy(_LOAD, np.linspace(0.0, 1.0, 11)).tip[1]
    return (yield from settings.tuned_gain(PLANE_WIRE, _RATE, _REST_TIME, sag))


def _thin(wall: Mapping[str, Any], duration: float, gain: float) -> tuple[Any, list[Setting]]:
    """Of a thin wire that falls on a wall: what makes the keys of direct from scheme, n, dt and contactDistance; and
    the settings of xpbd and of pbd with its gain."""

    def direct(scheme: str, n: int, step: float, gap: float | None) -> dict[str, Any]:
        method = {"integrator": scheme, "numberRodElements": n, **_contact(gap)}
        return {**scenes.wire_parameters(PLANE_WIRE), **settings.settled(method, step, _RATE, duration), **wall}

    def pbd(method: dict[str, Any]) -> dict[str, Any]:
        method |= {"collisionStiffness": 0.1, "sphereRadius": PLANE_WIRE.radius / scenes.UNIT}
        return {**settings.settled(method, method["timeStep"], _RATE, duration), **wall}

    def xpbd(n: int, substeps: int, sweeps: int) -> dict[str, Any]:
        method = {"solver": "xpbd", "numberRodElements": n, "substeps": substeps, "constraintSolverSteps": sweeps}
        return {**scenes.wire_parameters(PLANE_WIRE), **settings.settled(method, 1e-3, _RATE, duration), **wall}

    compliant = [Setting("xpbd", *settings.small_steps(n, 1e-3 / k, m),
                         case(f"xpbd-{n}-{k}-{m}", "xpbd", xpbd(n, k, m)))
                 for n, k, m in _XPBD]
    return direct, compliant + settings.changed_pbd(gain, _PBD_CHANGES, pbd)


def _plane() -> scenes.Asking[Asked]:
    gain = yield from _gain()
    height = -(PLANE_DROP + PLANE_WIRE.radius) / scenes.UNIT  # the axis comes to rest a radius above it
    wall = {"vessel": {"shape": "plane", "point": [0.0, height, 0.0], "normal": [0.0, 1.0, 0.0]}}
    direct, others = _thin(wall, _REST_TIME, gain)
    made = _direct(direct, [("implicitEuler", *values) for values in (
        (8, 2e-2, None), (8, 5e-3, None), (15, 2e-2, None), (15, 5e-3, None), (15, 5e-3, 3e-6), (30, 2e-2, None),
        (30, 5e-3, 3e-6), (30, 2e-3, 3e-6))])
    made += others
    shape, _ = elastica.heavy_on_plane(_LOAD, PLANE_DROP / PLANE_WIRE.length, _ARC)

    def error(run: Run) -> float:
        nodes = last_state(run).in_plane
        arc = np.linspace(0.0, 1.0, len(nodes))
        exact = PLANE_WIRE.length * np.stack([np.interp(arc, _ARC, x) for x in (shape.along, shape.across)], axis=1)
        return float(np.max(np.linalg.norm(nodes - exact, axis=1))) / PLANE_DROP

    return Asked(made, lambda _: (error, "the elastica with its tip on the plane"), gain=gain)


def _contact(gap: float | None) -> dict[str, float]:
    """contactDistance (m) where it is not left to the program."""
    return {} if gap is None else {"contactDistance": gap}


def _direct(keys: Callable[[str, int, float, float | None], dict[str, Any]],
            values: Iterable[tuple[str, int, float, float | None]]) -> list[Setting]:
    """Return the settings of direct by scheme, n, dt and contactDistance, from what makes the keys of each."""
    made = []
    for scheme, n, step, gap in values:
        words, label = settings.direct(scheme, n, step)
        if gap is not None:
            words, label = f"{words}, contactDistance {1e6 * gap:g} µm", f"{label} {1e6 * gap:g} µm"
        key = f"direct-{scheme}-{n}-{step}-{gap}"
        made.append(Setting("direct", words, label, case(key, "direct", keys(scheme, n, step, gap))))
    return made


_FALL_TIME = 0.3  # s
_FALL_SAMPLES = np.linspace(0.0, _FALL_TIME, 601)
_BAR_RADIUS = 3.0  # units
_BAR_BELOW = 5.0  # units, of the wire's surface


def _fall() -> scenes.Asking[Asked]:
    gain = yield from _gain()
    middle = 0.5 * PLANE_WIRE.length / scenes.UNIT
    height = -(_BAR_RADIUS + PLANE_WIRE.radius / scenes.UNIT + _BAR_BELOW)
    wall = {"obstacles": [{"shape": "capsule", "from": [-50.0, height, middle], "to": [50.0, height, middle],
                           "radius": _BAR_RADIUS}], "logSpheres": "last", "logEvery": 1}
    direct, others = _thin(wall, _FALL_TIME, gain)
    made = _direct(direct, (
        ("implicitEuler", 8, 1e-2, None), ("implicitEuler", 8, 2e-3, None), ("implicitEuler", 16, 1e-2, None),
        ("implicitEuler", 16, 2e-3, None), ("implicitEuler", 16, 1e-3, None), ("implicitEuler", 16, 5e-4, 3e-6),
        ("implicitEuler", 30, 1e-3, 3e-6), ("implicitEuler", 30, 2e-4, 3e-6), ("bdf2", 16, 1e-2, None),
        ("bdf2", 16, 5e-3, None), ("bdf2", 16, 2e-3, None), ("bdf2", 30, 1e-3, 3e-6), ("bdf2", 30, 2e-4, 3e-6),
        ("trbdf2", 16, 5e-3, None), ("trbdf2", 30, 1e-3, 3e-6), ("esdirk3", 16, 5e-3, None),
        ("esdirk3", 30, 1e-3, 3e-6)))
    made += others
    fine = Case("fine", direct("trbdf2", 80, 5e-6, 3e-6))  # a bounce lasts some 10 µs: steps that resolve it
    coarse = Case("coarse", direct("trbdf2", 40, 1e-5, 3e-6))

    def measure(runs: Mapping[str, Run]) -> tuple[Measure, str]:
        exact = tip_at(runs[fine.key], _FALL_SAMPLES)
        start = exact[0]

        def error(run: Run) -> float:
            return rms_error(tip_at(run, _FALL_SAMPLES) - start, exact - start)

        return error, (f"direct with trbdf2, n = 80, dt = 5 µs; twice as coarse in both it is "
                       f"{percent(error(runs[coarse.key]), 1)} off")

    return Asked(made, measure, (fine, coarse), gain)


_WAY = 150.0  # units that the wire is pushed
_SPEED = 100.0  # units/s
_LUMEN = 3.0  # units
_BEND = 30.0  # units, radius of the arch
_PIECES = 40
_ARCH_WIRE = Wire(radius=0.4e-3)
_ARCH_DAMPING = 20.0  # 1/s; without it the wire still swings at the end of the push
_ARCH = {
    "shape": "tube", "radius": _LUMEN, "openStart": True, "openEnd": True,
    "knots": [[0.0, 0.0, -320.0], *([0.0, _BEND * (1.0 - math.cos(a)), _BEND * math.sin(a)] for a in
                                    (math.pi * k / _PIECES for k in range(_PIECES + 1))), [0.0, 2.0 * _BEND, -200.0]],
}


_SOFT = 3e5  # Pa: the wall gives way by up to 0.84 of what it does at most


def _pushed(n: int, step: float, more: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "guidewireLength": _ARCH_WIRE.length / scenes.UNIT, "numberRodElements": n, "timeStep": step,
        "guidewireOffset": -300.0,
        "drive": "displace", "displacement": 0.0, "displacementPerStep": _SPEED * step, "vessel": _ARCH,
        "maxSimulationSteps": round(_WAY / _SPEED / step), "logEvery": 1_000_000, **more,
    }


def _pushed_direct(scheme: str, n: int, step: float, gap: float | None) -> dict[str, Any]:
    material = {**scenes.wire_parameters(_ARCH_WIRE), "massDamping": _ARCH_DAMPING}
    return _pushed(n, step, {**material, "integrator": scheme, **_contact(gap)})


def _measured_finely(fine: Case, coarse: Case, words: str) -> Callable[[Mapping[str, Run]], tuple[Measure, str]]:
    """Measure shapes at the end against a finer run, of which `words` say how fine; a coarser one shows how exact."""
    clearance = scenes.UNIT * _LUMEN - _ARCH_WIRE.radius  # m

    def measure(runs: Mapping[str, Run]) -> tuple[Measure, str]:
        exact = _points(runs[fine.key])

        def error(run: Run) -> float:
            return float(np.max(np.linalg.norm(_points(run) - exact, axis=1))) / clearance

        return error, f"direct with {words} it is {percent(error(runs[coarse.key]), 2)} off"

    return measure


def _soft_insertion() -> scenes.Asking[Asked]:
    yield []

    def direct(scheme: str, n: int, step: float, gap: float | None) -> dict[str, Any]:
        return {**_pushed_direct(scheme, n, step, gap), "vessel": {**_ARCH, "wallStiffness": _SOFT}}

    made = _direct(direct, [("implicitEuler", n, step, None) for n, step in (
        (20, 2e-2), (30, 2e-2), (30, 1e-2), (60, 2e-2), (60, 1e-2), (90, 1e-2), (120, 2e-2), (150, 2e-2), (200, 2e-2))])
    fine = Case("fine", direct("implicitEuler", 600, 2.5e-3, None))
    coarse = Case("coarse", direct("implicitEuler", 300, 5e-3, None))
    return Asked(made, _measured_finely(fine, coarse, "n = 600, dt = 2.5 ms; twice as coarse in both"), (fine, coarse))


def _insertion() -> scenes.Asking[Asked]:
    yield []
    compliant = {**scenes.wire_parameters(_ARCH_WIRE), "solver": "xpbd", "massDamping": _ARCH_DAMPING}
    made = _direct(_pushed_direct, (
        ("implicitEuler", 20, 2e-2, None), ("implicitEuler", 30, 2e-2, None), ("implicitEuler", 30, 1e-2, None),
        ("implicitEuler", 60, 2e-2, None), ("implicitEuler", 60, 1e-2, None), ("implicitEuler", 60, 1e-2, 1e-5),
        ("implicitEuler", 90, 1e-2, 1e-5), ("implicitEuler", 120, 2e-2, 5e-6), ("implicitEuler", 150, 2e-2, 5e-6),
        ("implicitEuler", 200, 2e-2, 2.5e-6), ("bdf2", 60, 1e-2, None), ("bdf2", 150, 2e-2, 5e-6)))
    for n, substeps, m in ((20, 5000, 1), (20, 2000, 3), (30, 7500, 1), (60, 15000, 1)):
        changed = {"substeps": substeps, "constraintSolverSteps": m}
        made.append(Setting("xpbd", *settings.small_steps(n, 1e-2 / substeps, m), case(
            f"xpbd-{n}-{substeps}-{m}", "xpbd", _pushed(n, 1e-2, {**compliant, **changed}))))
    gains = {"stretchStiffness": 1.0, "bendStiffness": 0.1, "totalMass": 0.01, "damping": 0.1,
             "collisionStiffness": 0.5, "sphereRadius": _ARCH_WIRE.radius / scenes.UNIT}
    for m, n, step, stiffness in (
        (20, 30, 1e-2, 0.1), (100, 30, 1e-2, 0.1), (500, 30, 1e-2, 0.1), (500, 30, 1e-2, 0.02), (500, 60, 1e-2, 0.1),
        (500, 60, 1e-2, 0.02), (500, 60, 1e-2, 1.0), (100, 60, 2e-3, 0.1),
    ):
        changed = {"constraintSolverSteps": m, "numberRodElements": n, "timeStep": step}
        words, label = settings.pbd(changed)
        made.append(Setting("pbd", f"{words}, k_B = {stiffness:g}", f"{label} kB{stiffness:g}", case(
            f"pbd-{m}-{n}-{step}-{stiffness}", "pbd",
            _pushed(n, step, {"solver": "pbd", **gains, **changed, "bendStiffness": stiffness}))))
    fine = Case("fine", _pushed_direct("implicitEuler", 600, 2.5e-3, 1.25e-6))
    coarse = Case("coarse", _pushed_direct("implicitEuler", 300, 5e-3, 2.5e-6))
    measure = _measured_finely(fine, coarse,
                               "n = 600, dt = 2.5 ms, contactDistance 1.25 µm; twice as coarse in all three")
    return Asked(made, measure, (fine, coarse))


def _points(run: Run) -> np.ndarray:
    """Places along the wire at its end, m, shape (k, 3)."""
    nodes = last_state(run).positions
    arc = np.linspace(0.0, 1.0, len(nodes))
    return np.stack([np.interp(_ARC, arc, x) for x in nodes.T], axis=1)


_WOUND_SCALE = 0.01  # m, sqrt(B/T)
_WOUND_LENGTH = 24.0  # of these
_WOUND_RADIUS = 0.2
# Couples at angles between the ends, rad, in sqrt(BT): of a boundary-value problem with forces between pairs of nodes.
_WOUND_COUPLES = ((7.5, 0.9918), (8.5, 0.8637), (9.5, 0.7405), (10.5, 0.7271))
_WOUND_BENDING = 0.7854e-3  # N m^2


def _wound(n: int, turn: float) -> dict[str, Any]:
    """The keys of direct for a wire under tension whose ends are turned against each other by so much a step."""
    radius = _WOUND_RADIUS * _WOUND_SCALE
    modulus = _WOUND_BENDING / (0.25 * math.pi * radius**4)
    tension = _WOUND_BENDING / _WOUND_SCALE**2
    return {
        "solver": "direct", "integrator": "implicitEuler",
        "guidewireLength": _WOUND_LENGTH * _WOUND_SCALE / scenes.UNIT,
        "numberRodElements": n, "guidewireOffset": 0.0, "wireRadius": radius, "youngsModulus": modulus,
        "shearModulus": 24.0 * modulus, "density": 0.02 / (math.pi * radius**2), "axialStiffness": 400.0 * tension,
        "proximalEnd": "clamped", "distalEnd": "sliding", "axialForce": tension, "gravity": [0.0, 1.0, 0.0],
        "drive": "displace", "displacement": 0.0, "twistPerStep": turn, "selfContact": True, "timeStep": 0.05,
        "deltaThreshold": 0.0, "maxSimulationSteps": round(_WOUND_COUPLES[-1][0] / turn), "logHub": True,
    }


def _plectoneme() -> scenes.Asking[Asked]:
    yield []

    def error(run: Run) -> float:
        hub = read_hub(run.folder)
        couples = np.interp([angle for angle, _ in _WOUND_COUPLES], hub.turn, np.abs(hub.torque))
        unit = _WOUND_BENDING / _WOUND_SCALE  # sqrt(BT)
        return max(abs(couple / unit / exact - 1.0) for couple, (_, exact) in zip(couples, _WOUND_COUPLES))

    made = [Setting("direct", f"n = {n}, {turn:g} rad a step", f"n{n} {turn:g}", case(
        f"direct-{n}-{turn}", "direct", _wound(n, turn))) for n, turn in (
            (60, 0.25), (60, 0.1), (90, 0.1), (120, 0.25), (120, 0.1), (120, 0.05), (180, 0.1), (240, 0.1),
            (240, 0.05))]
    return Asked(made, lambda _: (error, "a boundary-value problem with contact between pairs of nodes"))


PROBLEMS = (
    Problem("on-plane", "cantilever that rests on a plane", "worst node's distance, of the drop", _plane, ABSENT),
    Problem("collision", "fall onto a bar, 0.3 s", "RMS of the tip, relative", _fall, ABSENT),
    Problem("soft-insertion", "pushed into a soft arch, 1.5 s", "worst distance along the wire, of the clearance",
            _soft_insertion, {method: "has rigid walls alone" for method in ("pbd", "xpbd")} | ABSENT),
    Problem("insertion", "pushed into an arch, 1.5 s", "worst distance along the wire, of the clearance", _insertion,
            ABSENT),
    Problem("plectoneme", "twisted until it winds up, 10.5 rad", "worst couple, relative", _plectoneme,
            {method: "has no contact of a wire with itself" for method in ("pbd", "xpbd", "explicit")}),
)
