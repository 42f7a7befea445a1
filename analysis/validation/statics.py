"""Checks of rest shapes: dead loads, own weight, couples, torsion, a bend in space."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from analysis.figures.wording import number, percent
from analysis.runs import Run
from analysis.validation import elastica, pictures, scenes, twisted
from analysis.validation.check import Case, Check, Finding, Plan, Result
from analysis.validation.spatial import CurvedRod
from analysis.validation.states import last_state, solver_report, wall_time
from analysis.validation.wire import BASE, Wire

SECTION = "Statics"
ALL = ("direct", "explicit", "xpbd")
SHAPE_GATE = 3e-3  # of L
ARC_GATE = 1e-3  # of L
EXACT = 1e-9  # rad; what a search to 1e-9 may leave
_REPEATS = 5
_GRAVITY = 9.81  # m/s^2

def _solver_cases(
    wire: Wire, loads: Mapping[str, Any], frequency: float | None = None, solvers: Sequence[str] = ALL,
    moving: Mapping[str, Any] | None = None,
) -> list[Case]:
    """The same rest shape by every solver: at once, and as the end of a damped motion, which takes `moving` too."""
    cases = []
    for solver in solvers:
        common = {**scenes.wire_parameters(wire), **loads}
        if solver == "direct":
            cases.append(Case(solver, scenes.at_rest(common), repeats=_REPEATS))
        else:
            cases.append(Case(solver, scenes.settled(solver, wire, {**common, **(moving or {})}, frequency)))
    return cases


def _plane(run: Run, wire: Wire) -> np.ndarray:
    """Nodes as (z, -y)/L, shape (n+1, 2)."""
    return last_state(run).positions[:, [2, 1]] * np.array([1.0, -1.0]) / wire.length


def _dead_load(
    title: str, wire: Wire, loads: Mapping[str, Any], reference: elastica.PlaneShape, solvers: Sequence[str]
) -> Plan:
    """A shape in a plane, against the elastica at every node."""
    cases = _solver_cases(wire, loads, solvers=solvers)
    runs = yield cases
    exact = np.stack([reference.along, reference.across], axis=1)
    results, drawn = [], {}
    for case in cases:
        run = runs[case.key]
        nodes = _plane(run, wire)
        step = (len(exact) - 1) // (len(nodes) - 1)
        error = float(np.max(np.linalg.norm(nodes - exact[::step], axis=1)))
        results.append(Result(
            f"{title}, n = {len(nodes) - 1}: deflection of the tip", case.key, nodes[-1, 1],
            reference.tip[1], error, SHAPE_GATE, "L", wall_time(run, case.repeats), "L, worst node",
        ))
        drawn[case.key] = nodes
    caption = f"{title}: nodes (points) on the elastica (line). Worst distance of a node: " + ", ".join(
        f"{r.solver} {percent(r.error)}" for r in results) + " of L. explicit and xpbd: the end of a damped motion."
    return Finding(tuple(results), pictures.shapes({"elastica": exact}, drawn), caption)


_POINTS = np.linspace(0.0, 1.0, 301)


def _tip_load(load: float, solvers: Sequence[str] = ALL) -> Plan:
    force = load * BASE.bending / BASE.length**2
    return (yield from _dead_load(
        f"tip load F L²/EI = {load:g}", BASE, {"tipForce": [0.0, -force, 0.0]}, elastica.tip_loaded(load, _POINTS),
        solvers,
    ))


def _own_weight(radius: float, solvers: Sequence[str] = ALL) -> Plan:
    wire = Wire(radius=radius)
    load = wire.line_density * _GRAVITY * wire.length**3 / wire.bending
    return (yield from _dead_load(
        f"own weight, r = {1e3 * radius:g} mm (w L³/EI = {number(load)})", wire, {"gravity": [0.0, -_GRAVITY, 0.0]},
        elastica.heavy(load, _POINTS), solvers,
    ))


_ANGLES = {"π/2": 0.5 * math.pi, "π": math.pi, "2π": 2.0 * math.pi}


def _couple(wire: Wire, angle: float) -> list[float]:
    """A couple that bends the wire by an angle towards -y: about +x along the tip's own axes."""
    return [angle * wire.bending / wire.length, 0.0, 0.0]


def _end_moment() -> Plan:
    rules = {"halfElement": "half-element clamp", "fourthOrder": "fourth-order clamp"}
    cases = [
        Case(f"{rule}-{name.replace('/', '-')}", scenes.at_rest({"tipMoment": _couple(BASE, angle), "clampRule": rule}))
        for rule in rules for name, angle in _ANGLES.items()
    ]
    settling = [
        Case(f"explicit-{name.replace('/', '-')}", scenes.settled("explicit", BASE, {
            "tipMoment": _couple(BASE, angle), "clampRule": "halfElement"}))
        for name, angle in list(_ANGLES.items())[:2]
    ]
    runs = yield [*cases, *settling]
    results, drawn, references = [], {}, {}
    for case in (*cases, *settling):
        run = runs[case.key]
        rule = case.overrides["clampRule"]
        angle = case.overrides["tipMoment"][0] * BASE.length / BASE.bending
        name = next(text for text, value in _ANGLES.items() if math.isclose(value, angle))
        solver = run.value("solver") + (f", {rules[rule]}" if run.value("solver") == "direct" else "")
        state = last_state(run)
        n = len(state.directors)
        nodes = _plane(run, BASE)
        arc = elastica.arc(angle, np.linspace(0.0, 1.0, n + 1))
        exact = np.stack([arc.along, arc.across], axis=1)
        tip = float(np.linalg.norm(nodes[-1] - exact[-1]))
        what = f"couple M L/EI = {name}, n = {n}"
        turned = np.unwrap(np.arctan2(-state.directors[:, 1], state.directors[:, 2]))
        middles = angle * (np.arange(n) + 0.5) / n
        # With the fourth-order weights the first two elements stand off by design: 3/8 and 37/24 of a joint's angle.
        checked = slice(0, None) if rule == "halfElement" else slice(2, None)
        wrong = float(np.max(np.abs(turned - middles)[checked]))
        gate = EXACT if run.value("solver") == "direct" else None
        results.append(Result(what + ": angle of the last element", solver, turned[-1], middles[-1], wrong, gate,
                              "rad", wall_time(run), "rad, worst element"))
        results.append(Result(what + ": tip", solver, nodes[-1, 1], exact[-1, 1], tip,
                              ARC_GATE, "L", wall_time(run), "L"))
        if run.value("solver") == "direct" and rule == "halfElement":
            drawn[f"M L/EI = {name}"] = nodes
        fine = elastica.arc(angle, _POINTS)
        references["arc" if not references else f"_{name}"] = np.stack([fine.along, fine.across], axis=1)
    caption = (
        "End couples M L/EI = π/2, π and 2π, n = 30, rotation vector: nodes (points) on circular arcs (lines). The angles "
        "are exact; the nodes are joined by straight elements, which are shorter than their arcs by (κ l)²/24. With the "
        "fourth-order weights at the clamp, made for forces, the first two elements stand off by design and the tip with "
        "them, by l² κ/12."
    )
    return Finding(tuple(results), pictures.shapes(references, drawn), caption)


def _darboux_couple() -> Plan:
    counts = (30, 60, 90, 180)
    law = {"bendLaw": "darboux", "clampRule": "halfElement"}
    cases = [
        Case(f"{name.replace('/', '-')}-n={n}", scenes.at_rest({
            **law, "numberRodElements": n, "tipMoment": _couple(BASE, angle)}))
        for name, angle in _ANGLES.items() for n in counts
    ]
    beyond = Case("beyond", scenes.at_rest({**law, "numberRodElements": 6, "tipMoment": _couple(BASE, 6.5)}))
    runs = yield [*cases, beyond]
    results, series = [], {}
    for name, angle in _ANGLES.items():
        tip = np.array(elastica.arc(angle, np.array([0.0, 1.0])).tip)
        errors = []
        for n in counts:
            run = runs[f"{name.replace('/', '-')}-n={n}"]
            nodes = _plane(run, BASE)
            errors.append(float(np.linalg.norm(nodes[-1] - tip)))
            results.append(Result(
                f"couple M L/EI = {name}, Darboux law, n = {n}: tip", "direct", nodes[-1, 1], tip[1], errors[-1],
                ARC_GATE if n >= 90 else None, "L", wall_time(run), "L",
            ))
        order = -pictures.slope(counts[1:], errors[1:])
        results.append(Result(f"couple M L/EI = {name}, Darboux law: order in n", "direct", order, 2.0,
                              abs(order - 2.0), 0.1, "", None, "absolute"))
        series[f"M L/EI = {name}"] = (counts, errors)
    failed = runs["beyond"].outcome
    results.append(Result(
        "couple 1.08 K = 1.08 EI/l, Darboux law, n = 6: has no rest shape, so the run must end as failed", "direct",
        float(failed == "failed"), 1.0, 0.0 if failed == "failed" else 1.0, 0.0, "", None, "1: ended otherwise",
    ))
    caption = (
        "End couples with the Darboux law, torque K sin(angle): the tip's distance from that of the arc falls with the "
        f"second power of n. A couple above K = EI/l has no rest shape: with n = 6 and 1.08 K the run ends as {failed} "
        f"({runs['beyond'].summary['reason']})."
    )
    draw = pictures.orders("number of elements n", "error of the tip (L)", series, [(-2.0, "order 2")],
                           (ARC_GATE, "gate from n = 90 on"))
    return Finding(tuple(results), draw, caption)


def _torsion(solvers: Sequence[str] = ALL) -> Plan:
    turn = 0.5 * math.pi
    # The slowest motion: a standing wave of twist between two clamps.
    frequency = 0.5 / BASE.length * math.sqrt(BASE.shear_modulus / BASE.density)
    cases = _solver_cases(BASE, {"distalEnd": "clamped", "distalRotation": turn}, frequency, solvers,
                          {"distalRampTime": 0.05 / frequency})
    runs = yield cases
    torque = twisted.torsion_torque(BASE.torsion, BASE.length, turn)
    results, profiles = [], {}
    for case in cases:
        run = runs[case.key]
        twists = last_state(run).twists
        n = len(twists)
        exact = turn * (np.arange(n) + 0.5) / n
        profiles[case.key] = twists
        # The weights of the fourth-order clamp put the outer two elements elsewhere.
        inner = slice(2, n - 2)
        error = float(np.max(np.abs(twists - exact)[inner])) / turn
        cost = wall_time(run, case.repeats)
        what = f"one end turned by 90°, n = {n}"
        results.append(Result(what + ": turn of the middle elements", case.key, twists[n // 2], exact[n // 2], error,
                              1e-3, "rad", cost, "of 90°, worst inner element"))
        if case.key == "direct":
            measured = float(solver_report(run, "distalMoment")[2])
        else:
            measured = BASE.torsion * float(np.polyfit((np.arange(n) + 0.5)[inner], twists[inner], 1)[0]) * n / BASE.length
        results.append(Result(what + ": torque", case.key, measured, torque, abs(measured / torque - 1.0), 1e-3, "N m",
                              cost))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        n = len(profiles["direct"])
        arc = (np.arange(n) + 0.5) / n
        axes.plot([0.0, 1.0], [0.0, turn], color="0.6", linewidth=2.5, label="linear profile")
        for marker, (name, twists) in zip(pictures.MARKERS, profiles.items()):
            axes.plot(arc, twists, marker, fillstyle="none", label=name)
        axes.set_xlabel("s/L")
        axes.set_ylabel("turn of the element (rad)")
        pictures.outside_legend(axes)

    caption = (
        "A straight wire between two clamps, one turned by 90°: turn of each element against the linear profile. Torque: "
        + ", ".join(f"{r.solver} {number(r.value, 5)}" for r in results[1::2])
        + f" N m, GJ φ/L = {number(torque, 5)} N m; direct: as the clamp states it, the others: from the profile's slope."
    )
    return Finding(tuple(results), draw, caption)


def _spatial_bend(solvers: Sequence[str] = ALL) -> Plan:
    # A unit square of E = 1e7 and nu = 0: a round wire of r^2 = 1/3 and E = 3e7/pi has its EA, GA, EI and GJ.
    radius, length, curvature, force = math.sqrt(1.0 / 3.0), 25.0 * math.pi, 0.01, 600.0
    young = 3e7 / math.pi
    wire = Wire(length, radius, young, 0.5 * young, 1.0)
    rod = CurvedRod(length, curvature, wire.bending, wire.torsion, wire.stretching, wire.shearing)
    exact = rod.tip(np.array([force, 0.0, 0.0]))
    loads = {"metresPerUnit": 1.0, "guidewireLength": length, "restCurvature": [curvature, 0.0, 0.0],
             "tipForce": [force, 0.0, 0.0]}
    cases = _solver_cases(wire, loads, solvers=solvers)
    runs = yield cases
    results, drawn = [], {}
    for case in cases:
        run = runs[case.key]
        nodes = last_state(run).positions
        error = float(np.linalg.norm(nodes[-1] - exact) / np.linalg.norm(exact))
        results.append(Result(
            f"45° bend, load 600 across its plane, n = {len(nodes) - 1}: tip across", case.key, nodes[-1, 0], exact[0],
            error, 1e-2, "units", wall_time(run, case.repeats), "of the tip's place",
        ))
        drawn[case.key] = nodes[:, [2, 0]]
    start = curvature * length * _POINTS
    rest = np.stack([np.sin(start) / curvature, np.zeros_like(start)], axis=1)
    tip = results[0]
    caption = (
        "The bend of Bathe and Bolourchi (1979), an arc of 45° and radius 100 of a unit square section, loaded at its tip "
        f"across its plane. Tip: {', '.join(number(float(v), 5) for v in last_state(runs['direct']).positions[-1])} "
        f"(direct), {', '.join(number(float(v), 5) for v in exact)} (boundary value problem); off by {percent(tip.error)}."
    )
    draw = pictures.shapes({"without load": rest, "_tip": exact[[2, 0]][None]}, drawn, ("z (units)", "x (units)"))
    return Finding(tuple(results), draw, caption)


def _joint_law() -> Plan:
    """Between the first two elements of a wire under a couple stands one joint of K = EI/l."""
    n = 8
    couples = (0.05, 0.2, 0.5, 0.8)  # of K; above 1 the Darboux law has no rest shape
    stiffness = BASE.bending * n / BASE.length
    laws = {"rotationVector": lambda share: share, "darboux": math.asin}
    cases = [
        Case(f"{law}-{share:g}", scenes.at_rest({
            "bendLaw": law, "clampRule": "halfElement", "numberRodElements": n, "solverTolerance": 1e-12,
            "tipMoment": [share * stiffness, 0.0, 0.0]}))
        for law in laws for share in couples
    ]
    runs = yield cases
    results, series = [], {}
    for law, expected in laws.items():
        angles = []
        for share in couples:
            run = runs[f"{law}-{share:g}"]
            d = last_state(run).directors
            angle = math.atan2(float(np.linalg.norm(np.cross(d[3], d[4]))), float(d[3] @ d[4]))
            angles.append(angle)
            exact = expected(share)
            results.append(Result(f"one joint under the couple {share:g} K: its angle", f"direct, {law}", angle, exact,
                                  abs(angle / exact - 1.0), 1e-6, "rad"))
        series[law] = angles

    def draw(figure) -> None:
        axes = figure.add_subplot()
        fine = np.linspace(0.0, 0.8, 100)
        axes.plot(fine, fine, color="0.6", linewidth=2.5, label="couple = K angle")
        axes.plot(np.arcsin(fine), fine, "--", color="0.6", linewidth=2.5, label="couple = K sin(angle)")
        for marker, (law, angles) in zip(pictures.MARKERS, series.items()):
            axes.plot(angles, couples, marker, fillstyle="none", label=law)
        axes.set_xlabel("angle of the joint (rad)")
        axes.set_ylabel("couple (K)")
        pictures.outside_legend(axes)

    caption = "One joint in the middle of a wire under a couple: its angle by both laws, K = EI/l."
    return Finding(tuple(results), draw, caption)


def _checks(solvers: Sequence[str]) -> tuple[Check, ...]:
    return (
        *(Check(f"tip-load-{k:g}", SECTION, f"tip load F L²/EI = {k:g}", partial(_tip_load, k, solvers))
          for k in (0.1, 1, 2, 10, 100)),
        *(Check(f"own-weight-{1e3 * r:g}", SECTION, f"own weight, r = {1e3 * r:g} mm", partial(_own_weight, r, solvers))
          for r in (0.5e-3, 0.2e-3)),
        Check("torsion", SECTION, "torsion", partial(_torsion, solvers)),
        Check("spatial-bend", SECTION, "45° bend", partial(_spatial_bend, solvers)),
    )


_JOINT = Check("joint-law", SECTION, "one joint", _joint_law)
_DARBOUX = Check("end-moment-darboux", SECTION, "end couples, Darboux law", _darboux_couple)
CHECKS = (
    _JOINT, *_checks(ALL), Check("end-moment", SECTION, "end couples, rotation vector", _end_moment), _DARBOUX,
)
FAST = (_JOINT, *_checks(("direct",)), _DARBOUX)  # the direct solver's only, done in seconds
