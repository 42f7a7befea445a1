"""Check of a bent wire that is turned in a bent tube: its tip lags behind the hub and then whips round.

A wire of rest curvature k_0 in a frictionless tube of curvature k_t that leaves it no play keeps the tube's curvature,
and only the angle theta between its own bend and the tube's is free: the energy per length B/2 |k - k_0|^2 + C/2
theta'^2 is - B k_0 k_t cos(theta) + C/2 theta'^2 and a constant, so that C theta'' = B k_0 k_t sin(theta) with theta
given at the hub and theta' = 0 at the tip. That is a pendulum: with lambda = L sqrt(B k_0 k_t/C) and phi = pi - theta,
sin(phi/2) = k cd(lambda, k) at the hub for k = sin(phi_tip/2). Up to lambda = pi/2 each angle of the hub has one of
the tip; beyond, the tip snaps where the hub's angle is largest.

A tube with a play of c does not force its curvature on the ends of the wire: over a length of sqrt(2 c/|k_0 - k_t|)
they bend as they like, which takes that fraction from what is held, so the snap comes earlier by a term with sqrt(c).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import ellipj

from analysis.validation import pictures, scenes, tubes
from analysis.validation.states import wall_time_per_second
from analysis.validation.wire import Wire
from guidewire.figures.wording import number, percent
from guidewire.logs.hub import HubLog, read_hub
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_WIRE = tubes.THIN
_OWN = 20.0  # k_0, 1/m
_BEND = 30.0  # units, 1/k_t
_LAMBDA = 2.0
_GATE = 2e-2
_GATE_WITHOUT_PLAY = 1e-2
_STEP, _RATE, _TURN = 1e-2, 1.0, 1.45 * math.pi  # s, rad/s, rad


def hub_angle(tip: float, stretch: float) -> float:
    """Angle of the hub, rad, at which the tip has this one, for lambda = `stretch`."""
    k = math.sin(0.5 * (math.pi - tip))
    _, cn, dn, _ = ellipj(stretch, k * k)
    return math.pi - 2.0 * math.asin(k * cn / dn)


def snap(stretch: float) -> tuple[float, float]:
    """Angles of hub and tip, rad, at which the tip snaps, for lambda = `stretch` above pi/2."""
    found = minimize_scalar(lambda tip: -hub_angle(tip, stretch), bounds=(0.0, math.pi), method="bounded",
                            options={"xatol": 1e-10})
    return -found.fun, found.x


def _case(clearance: float, n: int) -> Case:
    """The wire lies in the bend as its own bend lies; its hub turns slowly."""
    length = _LAMBDA * math.sqrt(_WIRE.torsion / _WIRE.bending / (_OWN / (_BEND * scenes.UNIT))) / scenes.UNIT
    turns = np.linspace(0.0, length / _BEND, n + 1)
    start = {
        "positions": [tubes.at_bend(_BEND, turn).tolist() for turn in turns],
        "orientations": [tubes.frame_about_x(turn) for turn in 0.5 * (turns[1:] + turns[:-1])],
        **scenes.CLAMPS_ALONG_Z,
    }
    knots = tubes.bend(_BEND, 1.15 * turns[-1], 120, 20.0, 1.0)
    return Case(f"clearance={clearance:g}", {
        **scenes.wire_parameters(Wire(length * scenes.UNIT, _WIRE.radius)), "numberRodElements": n,
        "restCurvature": [-_OWN, 0.0, 0.0], "vessel": tubes.tube(knots, _WIRE.radius / scenes.UNIT + clearance),
        "contactDistance": 0.2 * min(clearance, 0.05) * scenes.UNIT, "drive": "displace", "rotationSpeed": _RATE,
        "timeStep": _STEP, "integrator": "implicitEuler", "maxSimulationSteps": round(_TURN / _RATE / _STEP),
        "deltaThreshold": 0.0, "massDamping": 20.0, "logHub": True, "logSpheres": "last",
    }, start=start)


def _snapped(log: HubLog) -> tuple[float, float]:
    """Angles of hub and tip before the largest step of the tip."""
    tip = log.turn + log.twist
    k = int(np.argmax(np.diff(tip)))
    return float(log.turn[k]), float(tip[k])


def _whip(settings: Sequence[tuple[float, int]]) -> Plan:
    """Whip for clearances in units and numbers of elements."""
    cases = {clearance: _case(clearance, n) for clearance, n in settings}
    runs = yield list(cases.values())
    exact, exact_tip = snap(_LAMBDA)
    results: list[Result] = []
    logs: dict[float, HubLog] = {}
    found: dict[float, float] = {}
    for (clearance, n), case in zip(settings, cases.values()):
        run: Run = runs[case.key]
        logs[clearance] = read_hub(run.folder)
        found[clearance], tip = _snapped(logs[clearance])
        what = f"clearance {clearance:g} mm, n = {n}: "
        results.append(Result(
            f"{what}angle of the hub at which the tip snaps", "direct", math.degrees(found[clearance]),
            math.degrees(exact), abs(found[clearance] / exact - 1.0), _GATE if clearance <= 0.05 else None, "°",
            wall_time_per_second(run)))
        results.append(Result(f"{what}angle of the tip before that", "direct", math.degrees(tip),
                              math.degrees(exact_tip), abs(tip / exact_tip - 1.0), None, "°"))
    said = ""
    if len(found) > 2:
        at_none = float(np.polyfit(np.sqrt(list(found)), list(found.values()), 1)[1])
        results.append(Result(
            "snap without clearance, by a line in the square root of the clearance", "direct", math.degrees(at_none),
            math.degrees(exact), abs(at_none / exact - 1.0), _GATE_WITHOUT_PLAY, "°"))
        said = f"; none, by a line in its square root: {math.degrees(at_none):.1f}°, {percent(results[-1].error)} off"
    caption = (
        f"A wire of rest curvature {_OWN:g}/m in a frictionless bend of radius {_BEND:g} mm, lambda = "
        f"L sqrt(B k_0 k_t/C) = {_LAMBDA:g}, turned at its hub by {_RATE:g} rad/s: angle of the tip over that of the "
        "hub, with the solution for a tube without clearance (line; its part that goes back is not stable). The tip "
        f"snaps at {number(math.degrees(exact), 4)}° there; with a clearance of "
        + ", ".join(f"{c:g} mm at {math.degrees(angle):.1f}°" for c, angle in found.items())
        + said + ". With clearance the ends bend freely over a length proportional to its square root."
    )

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        tips = np.linspace(0.0, 2.0 * math.pi, 401)
        hubs = [hub_angle(tip, _LAMBDA) if tip <= math.pi else 2.0 * math.pi - hub_angle(2.0 * math.pi - tip, _LAMBDA)
                for tip in tips]
        axes.plot(np.degrees(hubs), np.degrees(tips), color="0.6", linewidth=2.5, label="no clearance, theory")
        for clearance, log in logs.items():
            axes.plot(np.degrees(log.turn), np.degrees(log.turn + log.twist), linewidth=1.0,
                      label=f"direct, {clearance:g} mm")
        pictures.label(axes, "angle of the hub (°)", "angle of the tip (°)")

    return Finding(tuple(results), draw, caption)


def _check(settings: Sequence[tuple[float, int]]) -> Check:
    return Check("whip", tubes.SECTION, "a bent wire whips round in a bent tube", partial(_whip, settings))


CHECKS = (_check(((0.02, 120), (0.05, 120), (0.1, 60), (0.2, 60))),)
FAST = (_check(((0.05, 60),)),)
