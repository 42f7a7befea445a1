"""Checks of rods under their own weight: how far a cantilever hangs, and where curved rods, strips and arches give
way."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from analysis.validation import elastica, pictures, scenes
from analysis.validation.planar_stability import PlaneRest, snap
from analysis.validation.stability import LEFT, SECTION, Search, branches, limit, limit_line
from analysis.validation.states import last_state, wall_time
from analysis.validation.wire import BASE
from guidewire.figures.wording import number, percent
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_HANGING = (1.0, 3.0, 10.0, 30.0, 100.0, 500.0, 1000.0)  # w L^3/EI
_POINTS = np.linspace(0.0, 1.0, 201)


def _weight(load: float, bending: float = BASE.bending) -> float:
    """Acceleration at which the base wire's weight w is `load` EI/L^3, m/s^2."""
    return load * bending / (BASE.length**3 * BASE.line_density)


def _aspect(n: int, loads: tuple[float, ...]) -> Plan:
    cases = {load: Case(f"load={load:g}", scenes.at_rest({
        "numberRodElements": n, "gravity": [0.0, -_weight(load), 0.0]})) for load in loads}
    runs = yield list(cases.values())
    results, curves, drawn = [], [], {}
    for load, case in cases.items():
        exact = elastica.heavy(load, _POINTS)
        nodes = last_state(runs[case.key]).in_plane / BASE.length
        ratio, wanted = float(nodes[-1, 1] / nodes[-1, 0]), exact.tip[1] / exact.tip[0]
        what = f"cantilever hanging under w L³/EI = {load:g}, n = {n}: height over width"
        results.append(Result(what, "direct", ratio, wanted, abs(ratio / wanted - 1.0), 2e-3, "",
                              wall_time(runs[case.key])))
        curves.append(np.array([[np.nan, np.nan], *np.stack([exact.along, exact.across], axis=1)]))
        drawn[f"{load:g}"] = nodes[::n // 20]
    caption = (
        "Cantilevers under growing weight w L³/EI: height of the hanging shape over its width. Worst: "
        f"{percent(max(r.error for r in results))} off the boundary value problem."
    )
    return Finding(tuple(results), pictures.shapes({"elastica": np.concatenate(curves)}, drawn), caption)


@dataclass(frozen=True)
class _Sought:
    """A limit of a scene: the load about which it is sought, the scene under a load, the number of elements, and
    whether the shape in the plane is unstable below the limit instead of above it."""

    name: str
    expected: float
    scene: Mapping[str, Any]
    weight: list[float]  # acceleration that makes a unit of load, m/s^2
    reverse: bool = False


def _leaves_plane(sought: _Sought) -> Search:
    """Find where rest shapes leave the y-z plane, or come back to it."""

    def case(load: float) -> dict[str, Any]:
        return scenes.at_rest({**sought.scene, "gravity": [load * g for g in sought.weight]})

    def off(run: Run) -> float:
        if run.outcome == "failed":
            return math.nan
        distance = float(np.max(np.abs(last_state(run).positions[:, 0]))) / BASE.length
        return _turned(distance) if sought.reverse else distance

    found = yield from limit(f"{sought.name}-", sought.expected, case, off)
    return replace(found, seen={load: _turned(d) for load, d in found.seen.items()}) if sought.reverse else found


def _turned(distance: float) -> float:
    """Return a distance on the other side of `LEFT`, by the same factor."""
    return LEFT**2 / max(distance, 1e-12)


_CURVED = 80  # elements
_GATE = 1e-2


def bend_twist(turns: float) -> dict[str, float]:
    """Loads w L^3/EI at which a rod of curvature kappa L at rest, hung from a clamp, leaves its plane ("leaves") and
    is in it again ("returns", only up to kappa L = 8); torsion and bending of the base wire."""
    rod = PlaneRest(turns, 0.0, 1.0, BASE.torsion / BASE.bending)
    found = dict(zip(("leaves", "returns"), rod.limits(np.linspace(0.5, 40.0, 80))))
    if turns == 8.0:  # it unrolls at once between the two
        loads = np.linspace(150.0, 60.0, 181)
        found["returns"] = rod.limits(loads, rod.unrolled(loads[0]))[0]
    return found


def _bend_twist(curvatures: tuple[float, ...]) -> Plan:
    results, drawn = [], {}
    for turns in curvatures:
        for what, exact in bend_twist(turns).items():
            scene = {"numberRodElements": _CURVED, "restCurvature": [turns / BASE.length, 0.0, 0.0]}
            sought = _Sought(f"{turns:g}-{what}", exact, scene, [0.0, 0.0, _weight(1.0)], what == "returns")
            found = yield from _leaves_plane(sought)
            results.append(limit_line(
                f"rod of rest curvature kappa L = {turns:g} hung from a clamp, n = {_CURVED}: w L³/EI at which it "
                f"{what} {'its plane' if what == 'leaves' else 'to it'}", exact, found, _GATE, "EI/L³"))
            drawn["direct", f"kappa L = {turns:g}, {what}"] = found
    caption = (
        "A rod, a circular arc at rest, hangs from a clamp that looks down: the weight at which it leaves its plane, "
        f"and at which it returns. GJ/EI = {number(BASE.torsion / BASE.bending, 4)}; reference: where the linearised "
        f"equations out of the plane have a solution. Worst: {percent(max(r.error for r in results))}."
    )
    return Finding(tuple(results), branches("weight w L³/EI (1)", "distance from the plane (L)", drawn), caption)


_RATIOS = (3.0, 10.0, 30.0, 100.0)
_SLENDER = 100.0  # length over width of the strips


def strip_stiffness(ratio: float) -> tuple[float, float]:
    """Bending across its width and torsion, over bending across its thickness, of a strip of width over thickness
    `ratio` and the base wire's moduli; torsion by the membrane's series (Timoshenko and Goodier)."""
    odd = np.arange(1, 40, 2)
    series = 1.0 - 192.0 / (math.pi**5 * ratio) * float(np.sum(np.tanh(0.5 * math.pi * odd * ratio) / odd**5.0))
    return ratio**2, 4.0 * BASE.shear_modulus / BASE.youngs_modulus * series


def strip_limit(ratio: float) -> float:
    """Weight w L^3/B2 at which a cantilever strip, its width upright, leaves its plane; B2 bends its thickness."""
    across, torsion = strip_stiffness(ratio)
    return PlaneRest(0.0, 0.5 * math.pi, 1.0 / across, torsion / across).limits(
        np.linspace(0.1, 24.0, 25) / across)[0] * across


def strip_scene(ratio: float, slender: float, soft: float) -> dict[str, Any]:
    """Keys of a strip of the base wire's length, length over width `slender`, with B2 = `soft` (N m^2), upright."""
    across, torsion = strip_stiffness(ratio)
    width = BASE.length / slender
    # B2 = E W h^3/12 and EA = E W h; GA = 5/6 G W h.
    axial = soft * 12.0 * (ratio / width) ** 2
    return {"wireSections": [{
        "from": 0.0, "to": BASE.length / scenes.UNIT, "bendingStiffness1": across * soft, "bendingStiffness2": soft,
        "torsionalStiffness": torsion * soft, "axialStiffness": axial,
        "shearStiffness": 5.0 / 6.0 * BASE.shear_modulus / BASE.youngs_modulus * axial,
    }]}


def _strips(ratios: tuple[float, ...]) -> Plan:
    results, drawn, n = [], {}, 60
    for ratio in ratios:
        exact = strip_limit(ratio)
        soft = BASE.bending
        scene = {"numberRodElements": n, **strip_scene(ratio, _SLENDER, soft)}
        sought = _Sought(f"ratio={ratio:g}", exact, scene, [0.0, -_weight(1.0, soft), 0.0])
        found = yield from _leaves_plane(sought)
        results.append(limit_line(f"cantilever strip, width over thickness {ratio:g}, length over width {_SLENDER:g}, "
                                  f"n = {n}: w L³/B2 at which it leaves its plane", exact, found, _GATE, "B2/L³"))
        drawn["direct", f"{ratio:g}"] = found
    caption = (
        "Lateral buckling of a strip clamped with its width upright, under its own weight: distance from its plane. "
        "Reference: the linearised equations about the bent shape in the plane. Worst: "
        f"{percent(max(r.error for r in results))}."
    )
    return Finding(tuple(results), branches("weight w L³/B2 (1)", "distance from the plane (L)", drawn), caption)


_SLACKS = (0.02, 0.1)
_BROAD = 100.0  # the arch's stiffness out of its plane over that in it, so that it cannot roll over


def _arch(slacks: tuple[float, ...]) -> Plan:
    results, drawn, n = [], {}, 60
    for slack in slacks:
        exact = snap(slack)
        found = yield from _snaps(slack, exact, n)
        results.append(limit_line(f"arch between clamps, slack {percent(slack)}, n = {n}: w L³/EI at which it snaps",
                                  exact, found, _GATE, "EI/L³"))
        drawn["direct", f"slack {percent(slack)}"] = found
    caption = (
        "An arch, bent between two clamps on one axis by their approach (slack, over its length), under its own weight "
        "against its height: how far its middle has left the side on which it stood. Reference: the largest weight of "
        f"its symmetrical shapes in the plane. Worst: {percent(max(r.error for r in results))}."
    )
    return Finding(tuple(results), branches("weight w L³/EI (1)", "middle below the chord (L)", drawn), caption)


def _snaps(slack: float, expected: float, n: int) -> Search:
    s = np.linspace(0.0, 1.0, n + 1)
    angle = 2.0 * math.sqrt(slack) * np.sin(2.0 * math.pi * 0.5 * (s[1:] + s[:-1]))
    chords = np.stack([np.append(0.0, np.cos(angle)), np.append(0.0, np.sin(angle))])
    nodes = BASE.length / n * np.cumsum(chords, axis=1)
    nodes[0] *= BASE.length * (1.0 - slack) / nodes[0, -1]
    start = scenes.plane_start(nodes[0], -nodes[1])
    section = {"from": 0.0, "to": BASE.length / scenes.UNIT, "bendingStiffness2": _BROAD * BASE.bending,
               "torsionalStiffness": _BROAD * BASE.bending}

    def case(load: float) -> dict[str, Any]:
        return scenes.at_rest({"numberRodElements": n, "distalEnd": "clamped", "wireSections": [section],
                               "gravity": [0.0, -_weight(load), 0.0]})

    def below(run: Run) -> float:
        return math.nan if run.outcome == "failed" else max(
            0.0, -float(last_state(run).positions[n // 2, 1]) / BASE.length)

    return (yield from limit(f"slack={slack:g}-", expected, case, below, start))



def _hanging(n: int, loads: tuple[float, ...]) -> Check:
    return Check("heavy-cantilever", "Statics", "sag of a heavy cantilever", partial(_aspect, n, loads))


def _buckled(ratios: tuple[float, ...]) -> Check:
    return Check("strips", SECTION, "lateral buckling of strips", partial(_strips, ratios))


CHECKS = (
    _hanging(200, _HANGING),
    Check("bend-twist", SECTION, "a curved rod that hangs", partial(_bend_twist, (6.0, 8.0, 10.0))),
    _buckled(_RATIOS),
    Check("arch", SECTION, "snap of a clamped arch", partial(_arch, _SLACKS)),
)
FAST = (_hanging(60, (1.0, 30.0)), _buckled((30.0,)))
