"""Check of a rope pulled over a drum and released: the capstan with bending stiffness, the loop of a reversal.

A rope without weight lies over half a drum of radius R, its axis R + r from the drum's. Where it lies on the drum its
couple EI/(R + r) is constant, its tension grows by exp(m phi), m = mu R/(R + r) as friction acts at the drum's
surface. It lifts off at an angle g from the direction of the force F at its end: on the free elastica F (1 - cos g) =
b, b = EI/(2 (R + r)^2), so that its tension there is F - b; and its shear force F sin g there, which it has not on
the drum, is a point contact's. With s = 1 where the rope is drawn and -1 where it is let back,

    F2 - b = (F1 - b + s m F1 sin g1) exp(s m (pi + d - g1 - g2)) + s m F2 sin g2,

to first order in b/F the textbook's (F2 - b) = (F1 - b) exp(s m pi). F1 keeps its direction; the line of F2 passes the
drum's axis at (R + r) (1 + b/F2), as the couple at the lift-off asks for, and through the held end, which makes d.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.optimize import brentq

from analysis.validation import pictures, scenes, tubes
from analysis.validation.states import reactions, wall_time_per_second
from analysis.validation.wire import Wire
from guidewire.figures.wording import number, percent
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_DRUM, _HANGING, _APART = 50.0, 100.0, 0.12  # mm; the last what chords take, and the contact distance
_ROPE = 0.3e-3  # m
_PULL = 0.02  # N, F1
_SPEED, _STEP = 5.0, 2e-2  # mm/s, s
_COEFFICIENTS = (0.1, 0.3, 0.5)
_STIFF = (1e7, 3e8)  # Pa: b is 0.0006 and 0.019 of the pull
_SLIDES = (2.0, 4.0)  # s: all of it slides from the first on, the run ends at the second
_GATE = 1e-2
_AROUND = _DRUM + _ROPE / scenes.UNIT + _APART
_LENGTH = 2.0 * _HANGING + math.pi * _AROUND


def force(mu: float, young: float, drawn: bool) -> float:
    """Force of the held end against the pull F1 along the latter's line, N, half-way through the time shown."""
    around = 1e-3 * _DRUM + _ROPE
    b = 0.5 * Wire(radius=_ROPE, youngs_modulus=young).bending / around**2
    m = (1.0 if drawn else -1.0) * mu * 1e-3 * _DRUM / around

    def lift(f: float) -> float:
        return math.acos(1.0 - b / f)

    far = scenes.UNIT * (_HANGING + (1.0 if drawn else -1.0) * _SPEED * 0.5 * sum(_SLIDES))

    def aside(f: float) -> float:
        return (around * (1.0 + b / f) - scenes.UNIT * _AROUND) / far

    def excess(f: float) -> float:
        on = (_PULL - b + m * _PULL * math.sin(lift(_PULL))) * math.exp(
            m * (math.pi + aside(f) - lift(_PULL) - lift(f)))
        return f - b - on - m * f * math.sin(lift(f))

    found = float(brentq(excess, b, 100.0 * _PULL, xtol=1e-12))
    return found * math.cos(aside(found))


def _case(mu: float, young: float, sense: float, n: int = 140) -> Case:
    s = _LENGTH * np.linspace(0.0, 1.0, n + 1) - _HANGING
    turn = np.clip(s / _AROUND, 0.0, math.pi)
    beyond = s - _AROUND * turn
    nodes = np.stack([0.0 * s, -_AROUND * np.cos(turn) + beyond * np.sin(turn),
                      _AROUND * np.sin(turn) + beyond * np.cos(turn)], axis=1)
    wire = Wire(_LENGTH * scenes.UNIT, _ROPE, young, 0.4 * young, 1000.0)
    frames = [tubes.frame_about_x(a) for a in np.arctan2(np.diff(nodes[:, 1]), np.diff(nodes[:, 2]))]
    return Case(f"mu={mu:g},E={young:g},{'drawn' if sense < 0.0 else 'back'}", {
        **scenes.wire_parameters(wire), "numberRodElements": n, "integrator": "implicitEuler", "deltaThreshold": 0.0,
        "timeStep": _STEP, "maxSimulationSteps": round(_SLIDES[1] / _STEP), "massDamping": 7.0, "proximalEnd": "held",
        "drive": "displace", "displacementPerStep": sense * _SPEED * _STEP, "tipForce": [0.0, 0.0, -_PULL],
        "obstacles": [{"shape": "capsule", "from": [-50.0, 0.0, 0.0], "to": [50.0, 0.0, 0.0], "radius": _DRUM,
                       "frictionCoefficient": mu}],
        "logContacts": True, "logSpheres": "last",
    }, start={"positions": nodes.tolist(), "orientations": frames})


def _plan() -> Plan:
    cases = {(mu, young, sense): _case(mu, young, sense)
             for young in _STIFF for mu in _COEFFICIENTS for sense in (-1.0, 1.0)}
    runs = yield list(cases.values())
    found = {key: -float(np.mean(reactions(runs[case.key])[round(_SLIDES[0] / _STEP):, 2]))
             for key, case in cases.items()}
    results = []
    for mu, young in dict.fromkeys(key[:2] for key in cases):
        exact = (force(mu, young, True), force(mu, young, False))
        cost = wall_time_per_second(runs[cases[mu, young, -1.0].key])
        measured = (found[mu, young, -1.0], found[mu, young, 1.0])
        what = f"rope over half a drum, friction {mu:g}, E = {number(1e-6 * young, 3)} MPa"
        lines = {"drawn: force": (measured[0], exact[0]), "let back: force": (measured[1], exact[1]),
                 "width of the loop of its reversal": (measured[0] - measured[1], exact[0] - exact[1])}
        results += [Result(f"{what}, {name}", "direct", value, wanted, abs(value / wanted - 1.0), _GATE, "N", cost)
                    for name, (value, wanted) in lines.items()]

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        grid = np.linspace(0.0, _COEFFICIENTS[-1], 60)
        for color, young in enumerate(_STIFF):
            for side, sense in enumerate((-1.0, 1.0)):
                exact = [force(mu, young, sense < 0.0) for mu in grid]
                axes.plot(grid, exact, color=f"C{color}", alpha=0.4, linewidth=2.5)
                axes.plot(_COEFFICIENTS, [found[mu, young, sense] for mu in _COEFFICIENTS], "ov"[side],
                          fillstyle="none", color=f"C{color}",
                          label=f"E = {number(1e-6 * young, 3)} MPa, {('drawn', 'let back')[side]}")
        pictures.label(axes, "coefficient of friction (1)", "force of the held end (N)")

    return Finding(tuple(results), draw, (
        f"A rope over half a drum, with {_PULL:g} N at its other end, is pulled over it and released: the force "
        "at its held end against the capstan with bending stiffness (lines). Where the two differ a reversal is a "
        f"loop. Worst: {percent(max(r.error for r in results))}."))


CHECKS = (Check("drum", tubes.SECTION, "a rope is pulled over a drum and released", _plan),)
