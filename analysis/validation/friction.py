"""Checks of friction between wire and walls, against closed forms of Coulomb's law."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes, tubes
from analysis.validation.states import reactions, wall_time_per_second
from analysis.validation.wire import Wire
from guidewire.figures.wording import percent
from guidewire.logs.logs import read_entries, read_log
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_MU = 0.3
_SLOPES = (0.1, 0.2, 0.25, 0.35, 0.45)  # tangents


def _incline() -> Plan:
    """A short stiff wire on an inclined plane, gravity turned instead of the plane."""
    wire = Wire(0.05)
    start, end, step = 0.2, 0.4, 1e-3  # s
    vessel = {"shape": "plane", "point": [0.0, -0.54, 0.0], "normal": [0.0, 1.0, 0.0], "frictionCoefficient": _MU}
    cases = {}
    for slope in _SLOPES:
        angle = math.atan(slope)
        gravity = [0.0, -tubes.GRAVITY * math.cos(angle), tubes.GRAVITY * math.sin(angle)]
        cases[slope] = Case(f"slope={slope:g}", tubes.in_vessel(
            wire, vessel, step, round(end / step), numberRodElements=10, proximalEnd="free", gravity=gravity,
            contactDistance=5e-5))
    runs = yield list(cases.values())
    results, curves = [], {}
    for slope, case in cases.items():
        log = read_log(runs[case.key].folder, spheres="all", velocities=True)
        speed = scenes.UNIT * log.velocities[:, 5, 2]
        curves[slope] = (log.time, speed)
        if slope < _MU:
            what, exact = "stays", 0.0
            unit, scale = "m/s", tubes.GRAVITY * slope / math.hypot(1.0, slope) * (end - start)  # without friction
            measured = float(np.abs(speed[round(start / step):]).max())
        else:
            what, exact = "accelerates", tubes.GRAVITY * (slope - _MU) / math.hypot(1.0, slope)
            unit, scale = "m/s²", exact
            measured = float(speed[-1] - speed[round(start / step)]) / (end - start)
        results.append(Result(f"wire on an incline of tangent {slope:g}, friction {_MU:g}: {what}", "direct", measured,
                              exact, abs(measured - exact) / scale, 1e-2 if exact else 1e-6, unit,
                              wall_time_per_second(runs[case.key])))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for slope, (time, speed) in curves.items():
            axes.plot(time, 1e3 * speed, label=f"{slope:g}")
        pictures.label(axes, "time (s)", "speed (mm/s)")

    return Finding(tuple(results), draw, (
        f"A short wire on an inclined plane, friction {_MU:g}, for tangents of its angle below and above that. Below, "
        "it stays at rest (its speed, over what it would gain without friction), above it accelerates by "
        f"g (sin - mu cos). Worst: {percent(max(r.error for r in results))}."))


_TURNING = (0.0, 0.5, 1.0, 2.0, 4.0)  # speed around over speed along


def _turned() -> Plan:
    """A wire is pushed along a level tube, and turned."""
    speed, step = 0.02, 2e-3  # m/s, s
    vessel = tubes.tube([[0.0, 0.59, -50.0], [0.0, 0.59, 400.0]], 1.0, _MU)
    cases = {turning: Case(f"turning={turning:g}", tubes.in_vessel(
        tubes.WIRE, vessel, step, 500, drive="displace", insertionSpeed=speed, contactDistance=1e-5, logContacts=True,
        rotationSpeed=turning * speed / tubes.WIRE.radius, gravity=[0.0, -tubes.GRAVITY, 0.0])) for turning in _TURNING}
    runs = yield list(cases.values())
    results, measured, expected = [], [], []
    for turning, case in cases.items():
        run = runs[case.key]
        force = float(np.mean(reactions(run)[250:, 2]))
        # What the clamp leaves of the weight to the wall; it climbs the wall by the angle that its turning lifts it.
        carried = float(np.mean(_wall_push(run)[250:]))
        beta = math.atan(turning)
        exact = _MU * carried * math.cos(math.atan(_MU * math.sin(beta))) * math.cos(beta)
        measured.append(force)
        expected.append(exact)
        results.append(Result(
            f"axial force of a wire pushed through a level tube, turned {turning:g} times as fast as pushed",
            "direct", force, exact, abs(force / exact - 1.0), 5e-2, "N", wall_time_per_second(run)))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        axes.plot(_TURNING, expected, "-", color="0.6", linewidth=2.5, label="by the direction of slip")
        axes.plot(_TURNING, measured, "o", fillstyle="none", label="direct")
        axes.set_ylim(bottom=0.0)
        pictures.label(axes, "circumferential over axial speed of the surface (1)", "force of the hub (N)")

    return Finding(tuple(results), draw, (
        f"A wire is pushed through a level tube (friction {_MU:g}) and rotated: friction opposes the slip of its "
        "surface, so that rotation reduces the axial force to mu N cos(beta), tan(beta) the ratio of the speeds; "
        "the wire climbs the wall until normal force and friction carry it. Worst: "
        f"{percent(max(r.error for r in results))}."))


def _wall_push(run: Run) -> np.ndarray:
    """Total force of the walls upwards after each step, N."""
    return np.array([entry["contact"]["total"]["y"] for _, entry in read_entries(run.folder)][1:], dtype=float)


_COEFFICIENTS, _ANGLES = (0.05, 0.1, 0.3), (90.0, 180.0)
_TENSION = 0.5  # N, at the tip


def _capstan() -> Plan:
    """A limp wire whose rest shape is the bend's is pulled back through it against a force along its tip."""
    cases = {(mu, angle): _pulled(mu, angle) for angle in _ANGLES for mu in (0.0, *_COEFFICIENTS)}
    runs = yield list(cases.values())
    force = {key: -float(np.mean(reactions(runs[case.key])[100:, 2])) for key, case in cases.items()}
    results = []
    for (mu, angle), case in cases.items():
        ratio, cost = force[mu, angle] / force[0.0, angle], wall_time_per_second(runs[case.key])
        exact = math.exp(mu * math.radians(angle))
        if mu > 0.0:
            results.append(Result(
                f"wire pulled through a bend of {angle:g}°, friction {mu:g}: force at the base over that without "
                "friction", "direct", ratio, exact, abs(ratio / exact - 1.0), 5e-2, "", cost))
        else:
            results.append(Result(
                f"the same, {angle:g}°, without friction: force at the base", "direct", force[mu, angle], _TENSION,
                abs(force[mu, angle] / _TENSION - 1.0), 2e-2, "N", cost))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        exponents = np.linspace(0.0, _COEFFICIENTS[-1] * math.pi, 50)
        axes.plot(exponents, np.exp(exponents), color="0.6", linewidth=2.5, label="exp(mu phi)")
        for marker, angle in zip(pictures.MARKERS, _ANGLES):
            axes.plot([mu * math.radians(angle) for mu in _COEFFICIENTS],
                      [force[mu, angle] / force[0.0, angle] for mu in _COEFFICIENTS], marker, fillstyle="none",
                      label=f"direct, {angle:g}°")
        pictures.label(axes, "mu phi (1)", "force at the base over at the tip (1)")

    return Finding(tuple(results), draw, (
        "A limp wire is pulled back through a bend against a force at its tip: the force grows by exp(mu phi) (the "
        f"capstan). Worst: {percent(max(r.error for r in results))}."))


def _pulled(mu: float, degrees: float) -> Case:
    angle, bend, straight = math.radians(degrees), 30.0, 40.0  # rad, units
    length = 2.0 * straight + bend * angle
    n = round(0.5 * length)
    arc = length * np.linspace(0.0, 1.0, n + 1) - straight

    def place(s: float) -> tuple[np.ndarray, float]:
        turn = min(max(s / bend, 0.0), angle)
        beyond = s if s < 0.0 else max(0.0, s - bend * angle)
        return tubes.at_bend(bend, turn) + beyond * tubes.along_bend(turn), turn

    start = {"positions": [place(s)[0].tolist() for s in arc],
             "orientations": [tubes.frame_about_x(place(s)[1]) for s in 0.5 * (arc[1:] + arc[:-1])],
             **scenes.CLAMPS_ALONG_Z}
    wire = Wire(length * scenes.UNIT, 0.2e-3, 5e9, 2e9)
    vessel = tubes.tube(tubes.bend(bend, angle, 90, straight + 60.0, straight + 60.0), 0.4, mu)
    return Case(f"mu={mu:g},angle={degrees:g}", tubes.in_vessel(
        wire, vessel, 2e-3, 200, numberRodElements=n, tipForce=(_TENSION * tubes.along_bend(angle)).tolist(),
        drive="displace", displacementPerStep=-0.05, logContacts=True, logSpheres="last"), start=start)


CHECKS = (
    Check("incline", tubes.SECTION, "a wire on an incline", _incline),
    Check("turned-wire", tubes.SECTION, "a wire that is turned needs less force", _turned),
    Check("capstan", tubes.SECTION, "a wire is pulled through a bend", _capstan),
)
