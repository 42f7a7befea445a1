"""Problems of two coaxial instruments: tubes that are turned until they snap, and the position of their tip before
that. The model is one shared centreline. A turn of the inner hub is written as a turn of the wire's rest curvature, so
that a rest shape needs no motion."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from analysis.chart import settings
from analysis.chart.concentric import coupling, snap_angle, turned_tip
from analysis.chart.points import Asked, Problem, Setting, case
from analysis.validation import scenes
from analysis.validation.states import tip_motion
from guidewire.logs.hub import read_hub, snap_turns
from guidewire.logs.runs import Run

_ALONE = "takes one instrument"
ABSENT = {"pbd": _ALONE, "xpbd": _ALONE, "explicit": _ALONE}
_LENGTH = 0.1  # m, of the tubes: the unit of length here, and
_BENDING = 1e-3  # N m^2, the outer one's bending stiffness
_RADIUS, _LUMEN, _OUTER = 1e-4, 1.1e-4, 1.3e-4  # m
_BEGIN = 175.0  # degrees, of the inner hub at the start
_SPEED = 10.0  # degrees/s of the inner hub; all motions of the tubes are fast against it
_TURNED = ((5, 5.0), (5, 2.5), (10, 2.5), (10, 1.0), (10, 0.5), (20, 0.5), (20, 0.2), (20, 0.05), (40, 0.05))
_PAST = 1.03  # of the angle of the snap, where a run ends
_SNAPS = {  # B_2/B_1, EI/GJ - 1, k L, L_t/L of the straight length before
    "B_2/B_1 = 1, k L = 1.5": (1.0, 0.3, 1.5, 0.0), "B_2/B_1 = 1, k L = 2": (1.0, 0.3, 2.0, 0.0),
    "B_2/B_1 = 1/2, k L = 1.2, L_t = L": (0.5, 0.35, 1.2, 1.0)}


def _tubes(n: int, ratio: float, nu: float, curvature: float, turn: float, lead: float = 0.0) -> dict[str, Any]:
    """Rest shape of two tubes of one length and curvature (over 1/L), elements n each, the inner one's hub turned by
    `turn` (rad) and `lead` (over L) behind the other; that length is straight."""

    def units(length: float) -> float:
        return length * _LENGTH / scenes.UNIT

    def material(bending: float, fourth_power: float) -> dict[str, float]:
        modulus = bending / (0.25 * math.pi * fourth_power)
        return {"youngsModulus": modulus, "shearModulus": 0.5 * modulus / (1.0 + nu), "density": 6450.0}

    def piece(start: float, length: float, curved: float, angle: float) -> dict[str, Any]:
        k = curved / _LENGTH
        return {"from": units(start), "to": units(start + length),
                "restCurvature": [k * math.cos(angle), k * math.sin(angle), 0.0]}

    before = [piece(0.0, lead, 0.0, turn)] if lead else []
    return {
        **scenes.at_rest({}), "guidewireLength": units(1.0 + lead), "numberRodElements": n,
        "guidewireOffset": -units(lead), "wireRadius": _RADIUS, **material(ratio * _BENDING, _RADIUS**4),
        "drive": "displace", "insertionSpeed": 0.0, "logHub": True, "solverTolerance": 1e-12,
        "wireSections": [*before, piece(lead, 1.0, curvature, turn)],
        "catheters": [{"start": units(lead), "length": units(1.0), "elements": n, "wireRadius": _OUTER,
                       "lumenRadius": _LUMEN, **material(_BENDING, _OUTER**4 - _LUMEN**4),
                       "wireSections": [piece(0.0, 1.0, curvature, 0.0)]}]}


def _snap(name: str) -> scenes.Asking[Asked]:
    """Error of a hub angle known to one step: of the farther end of that in which it snaps."""
    yield []
    ratio, nu, curvature, straight = _SNAPS[name]
    exact = snap_angle(coupling(ratio, nu, curvature), straight)

    def error(run: Run) -> float:
        log = read_hub(run.folder)
        ends = [math.radians(_BEGIN) + turns for turns in snap_turns(log.turn, log.torque)]
        return max(abs(float(end[0]) / exact - 1.0) for end in ends) if len(ends[0]) == 1 else math.nan

    made = []
    for n, degrees in _TURNED:
        # The inner one alone is straight before: its part of the twist is (1/C_2)/(1/C_1 + 1/C_2).
        tubes = _tubes(n, ratio, nu, curvature, math.radians(_BEGIN), straight * (1.0 + ratio))
        steps = math.ceil((_PAST * math.degrees(exact) - _BEGIN) / degrees)
        made.append(_turning(tubes, degrees, steps))
    return Asked(made, lambda _: (error, "theta'' = c sin theta, solved as a differential equation"))


def _setting(words: tuple[str, str], key: str, overrides: dict[str, Any]) -> Setting:
    return Setting("direct", *words, case(key, "direct", overrides))


def _turning(tubes: dict[str, Any], degrees: float, steps: int) -> Setting:
    """Turn from its rest shape a hub that turns by so many degrees a step, at _SPEED."""
    step, n = degrees / _SPEED, tubes["numberRodElements"]
    return _setting(settings.direct("implicitEuler", n, step), f"turned-{n}-{steps}", {
        **tubes, "integrator": "implicitEuler", "timeStep": step, "maxSimulationSteps": steps, "deltaThreshold": 0.0,
        "massDamping": 100.0, "logSpheres": "last", "rotationSpeed": math.radians(degrees) / step})


_RATIO, _NU, _CURVATURE = 1.0, 0.3, 2.0  # B_2/B_1, EI/GJ - 1, k L
_ANGLE = 120.0  # degrees


def _tip() -> scenes.Asking[Asked]:
    """Rest shapes at once, and hubs that turn up to that angle."""
    yield []
    turn = math.radians(_ANGLE)
    exact = turned_tip(_RATIO, _NU, _CURVATURE, turn)

    def error(run: Run) -> float:
        return float(np.linalg.norm(tip_motion(run)[1][-1] / _LENGTH - exact))

    made = [_setting((f"rest shape at once, n = {n}", f"at once n{n}"), f"at-once-{n}",
                     {**_tubes(n, _RATIO, _NU, _CURVATURE, turn), "timeStep": _ANGLE / _SPEED})
            for n in (5, 10, 20, 40)]
    made += [_turning(_tubes(n, _RATIO, _NU, _CURVATURE, 0.0), _ANGLE / steps, steps)
             for n, steps in ((5, 5), (10, 5), (10, 20), (20, 20), (20, 100), (40, 100))]
    return Asked(made, lambda _: (error, "the differential equations of concentric tubes"))


def _snaps() -> Iterator[Problem]:
    for k, name in enumerate(_SNAPS):
        yield Problem(f"snap-{k + 1}", f"snap of two tubes, {name}", "angle of the hub, relative",
                      lambda name=name: _snap(name), ABSENT)


PROBLEMS = (
    *_snaps(),
    Problem("turned-tip", "two tubes turned by 120°", "tip's distance, of L", _tip, ABSENT),
)
