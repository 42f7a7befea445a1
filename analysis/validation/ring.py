"""Check of the closed ring that leaves its plane when it is twisted enough (Michell, Zajac)."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from analysis.validation import scenes, twisted
from analysis.validation.stability import (
    GATE, MOVING, PUSH, SECTION, branches, limit, limit_line, motion, passed_through_itself, pushed, pushed_line,
)
from analysis.validation.states import State, last_state
from analysis.validation.wire import BASE, STURDY, Wire
from guidewire.figures.wording import number
from guidewire.logs.runs import Run
from guidewire.studies.keys import value_text
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan

_RATIOS = (0.5, 1.0, 2.0)  # EI/GJ
_ELEMENTS = {"direct": 96, "explicit": 48, "xpbd": 32}
_RATE = 200.0  # 1/s, of the motion near the limit
_DURATION = 0.05  # s
_RAMP = 5e-3  # s: turned at once, the last joint would take the shorter way
_LOST = 0.1  # fraction of its twist; a ring that passes through itself loses two turns


def _ring(pushing: Sequence[str] = tuple(MOVING)) -> Plan:
    results, drawn = [], {}
    for ratio in _RATIOS:
        exact = twisted.ring_twist(ratio, 1.0)
        found = yield from limit(
            f"direct-{value_text(ratio)}-twist=", exact,
            lambda twist, ratio=ratio: scenes.at_rest(_keys(_wire(BASE, ratio), _ELEMENTS["direct"], twist)),
            partial(_left, BASE),
        )
        drawn["direct", f"EI/GJ = {ratio:g}"] = found
        results.append(limit_line(f"closed ring, EI/GJ = {ratio:g}, n = {_ELEMENTS['direct']}: critical twist", exact,
                                  found, GATE, "rad"))
    for solver in pushing:
        for ratio in _RATIOS:
            exact = twisted.ring_twist(ratio, 1.0)
            name = f"{solver}-{value_text(ratio)}-"
            wire, n = _wire(STURDY, ratio), _ELEMENTS[solver]
            damped = yield from motion(solver, wire, {"numberRodElements": n, **_SUPPORTS}, _RATE, _DURATION,
                                       f"{name}limit")
            bracket = yield from pushed(name, exact, partial(_moving, damped, _start(n)), partial(_left, STURDY),
                                        push=_GROWN)
            drawn[solver, f"EI/GJ = {ratio:g}"] = bracket
            results.append(pushed_line(
                f"closed ring, EI/GJ = {ratio:g}, r = {1e3 * STURDY.radius:g} mm, n = {_ELEMENTS[solver]}: critical "
                "twist", solver, exact, bracket, GATE, "rad"))
    caption = (
        "A wire that is straight at rest, closed to a ring and twisted: its distance from its plane (root mean "
        "square), or the fraction of its twist that it lost by passing through itself. Both ends are clamped to one "
        "frame by a half-element joint each, so every element is free to move with respect to it. The direct solver's "
        "rest shapes stay plane up to " + ", ".join(f"{number(r.value, 4)}" for r in results[:3])
        + " rad (dashed); Michell and Zajac: " + ", ".join(f"{number(r.reference, 4)}" for r in results[:3])
        + f" rad. explicit and xpbd are displaced by {PUSH:g} L, twisted, and move, damped, for "
        f"{1e3 * _DURATION:g} ms."
    )
    draw = branches("twist (rad)", "distance from the plane (L), or fraction of twist lost", drawn)
    return Finding(tuple(results), draw, caption)


_GROWN = 1e-3  # of L: a twisted ring that is stable is off its plane by less, as its clamps turn


def _wire(wire: Wire, ratio: float) -> Wire:
    """Return the wire with this EI/GJ."""
    return dataclasses.replace(wire, shear_modulus=0.5 * wire.youngs_modulus / ratio)


_SUPPORTS = {"startShape": "ring", "distalEnd": "clamped", "clampRule": "halfElement"}


def _keys(wire: Wire, n: int, twist: float) -> dict[str, Any]:
    return {**scenes.wire_parameters(wire), "numberRodElements": n, **_SUPPORTS, "distalRotation": twist}


def _moving(damped: Mapping[str, Any], start: Mapping[str, Any], key: str, twist: float) -> Case:
    """Return a ring with this twist, and the motion after it."""
    return Case(key, {**damped, "distalRotation": twist, "distalRampTime": _RAMP}, start=start)


def _start(n: int) -> dict[str, Any]:
    """Return a regular polygon in the y-z plane, pushed a little out of it between its clamps."""
    middles = 2.0 * np.pi * (np.arange(n) + 0.5) / n
    sides = np.stack([np.sin(middles), np.cos(middles)], axis=1) * BASE.length / n
    places = np.concatenate([np.zeros((1, 2)), np.cumsum(sides, axis=0)]) / scenes.UNIT
    around = 2.0 * np.pi * np.arange(n + 1) / n
    out = PUSH * BASE.length / scenes.UNIT * np.sin(around) ** 2 * np.sin(2.0 * around)
    return {
        "positions": [[float(x), float(y), float(z)] for x, (y, z) in zip(out, places)],
        "orientations": [[-math.sin(0.5 * a), 0.0, 0.0, math.cos(0.5 * a)] for a in middles],
        **scenes.CLAMPS_ALONG_Z,
    }


def _left(wire: Wire, run: Run) -> float:
    """Root mean square distance of the nodes from their plane over L, or the fraction of twist lost if large."""
    if passed_through_itself(run):
        return math.inf
    if run.outcome == "failed":
        return math.nan
    if run.outcome == "diverged":
        return math.inf
    state = last_state(run)
    out = np.linalg.svd(state.positions - state.positions.mean(axis=0), compute_uv=False)[2]
    away = float(out) / math.sqrt(len(state.positions)) / wire.length
    lost = abs(1.0 - link(state) / run.number("distalRotation"))
    return lost if lost > _LOST else away


def link(state: State) -> float:
    """Twist between neighbouring elements, summed over the chain, rad."""
    a, b = state.orientations[:-1], state.orientations[1:]
    along = a[:, 3] * b[:, 2] - b[:, 3] * a[:, 2] - a[:, 0] * b[:, 1] + a[:, 1] * b[:, 0]
    same = np.einsum("ij,ij->i", a, b)
    inner = np.sum(2.0 * np.arctan2(along * np.sign(same), np.abs(same)))
    return float(inner) * len(state.orientations) / len(a)  # the two half joints at the clamp twist as much as one


CHECKS = (Check("ring", SECTION, "twisted ring", _ring),)
FAST = (Check("ring", SECTION, "twisted ring", partial(_ring, ())),)  # the direct solver's only
