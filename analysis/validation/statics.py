"""Checks of rest shapes: dead loads, own weight, torsion, a bend in space, a tip on a plane."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from analysis.validation import elastica, pictures, scenes, spatial, twisted
from analysis.validation.states import last_state, solver_report, wall_time
from analysis.validation.wire import BASE, Wire
from guidewire.figures.wording import number, percent
from guidewire.studies.table import Case
from guidewire.sweeps.check import TUNED, Check, Finding, Plan, Result, not_run

SECTION = "Statics"
ALL = ("direct", "explicit", "xpbd")
SHAPE_GATE = 3e-3  # of L
_REPEATS = 5
_GRAVITY = 9.81  # m/s^2

def _solver_cases(
    wire: Wire, loads: Mapping[str, Any], frequency: float | None = None, solvers: Sequence[str] = ALL,
    moving: Mapping[str, Any] | None = None,
) -> scenes.Asking[list[Case]]:
    """The same rest shape by every solver: at once, and as the end of a damped motion, which takes `moving` too."""
    cases = []
    for solver in solvers:
        common = {**scenes.wire_parameters(wire), **loads}
        if solver == "direct":
            cases.append(Case(solver, scenes.at_rest(common), repeats=_REPEATS))
        else:
            motion = yield from scenes.settled(solver, wire, {**common, **(moving or {})}, frequency)
            cases.append(Case(solver, motion))
    return cases


def _dead_load(
    title: str, wire: Wire, loads: Mapping[str, Any], reference: elastica.PlaneShape, solvers: Sequence[str]
) -> Plan:
    """A shape in a plane, against the elastica at every node."""
    cases = yield from _solver_cases(wire, loads, solvers=solvers)
    runs = yield cases
    exact = np.stack([reference.along, reference.across], axis=1)
    results, drawn = [], {}
    for case in cases:
        run = runs[case.key]
        nodes = last_state(run).in_plane / wire.length
        step = (len(exact) - 1) // (len(nodes) - 1)
        error = float(np.max(np.linalg.norm(nodes - exact[::step], axis=1)))
        results.append(Result(
            f"{title}, n = {len(nodes) - 1}: deflection of the tip", case.key, nodes[-1, 1],
            reference.tip[1], error, SHAPE_GATE, "L", wall_time(run, case.repeats), "L, worst node",
        ))
        drawn[case.key] = nodes
    said = f"{title[0].upper()}{title[1:]}: nodes (points) on the elastica (line). Worst distance of a node: "
    caption = said + ", ".join(
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
    title = f"own weight, r = {1e3 * radius:g} mm"
    finding = yield from _dead_load(
        f"{title} (w L³/EI = {number(load)})", wire, {"gravity": [0.0, -_GRAVITY, 0.0]}, elastica.heavy(load, _POINTS),
        solvers,
    )
    return replace(finding, results=(*finding.results, not_run(title, "pbd", TUNED)))


def _torsion(solvers: Sequence[str] = ALL) -> Plan:
    turn = 0.5 * math.pi
    # The slowest motion: a standing wave of twist between two clamps.
    frequency = 0.5 / BASE.length * math.sqrt(BASE.shear_modulus / BASE.density)
    cases = yield from _solver_cases(BASE, {"distalEnd": "clamped", "distalRotation": turn}, frequency, solvers,
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
            slope = float(np.polyfit((np.arange(n) + 0.5)[inner] * BASE.length / n, twists[inner], 1)[0])
            measured = BASE.torsion * slope
        results.append(Result(what + ": torque", case.key, measured, torque, abs(measured / torque - 1.0), 1e-3, "N m",
                              cost))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        n = len(profiles["direct"])
        arc = (np.arange(n) + 0.5) / n
        axes.plot([0.0, 1.0], [0.0, turn], color="0.6", linewidth=2.5, label="linear profile")
        pictures.marks(axes, {name: (arc, twists) for name, twists in profiles.items()}, "s/L",
                       "turn of the element (rad)")

    caption = (
        "A straight wire between two clamps, one turned by 90°: turn of each element against the linear profile. "
        "Torque: "
        + ", ".join(f"{r.solver} {number(r.value, 5)}" for r in results[1::2])
        + f" N m, GJ φ/L = {number(torque, 5)} N m; direct: as the clamp states it, the others: from the profile's "
          "slope."
    )
    return Finding(tuple(results), draw, caption)


def _spatial_bend(solvers: Sequence[str] = ALL) -> Plan:
    bend = spatial.bathe_bolourchi()
    wire, exact, loads = bend.wire, bend.rod.tip(bend.force), scenes.bend_parameters(bend)
    cases = yield from _solver_cases(wire, loads, solvers=solvers)
    runs = yield cases
    results, drawn = [], {}
    for case in cases:
        run = runs[case.key]
        nodes = last_state(run).positions
        error = float(np.linalg.norm(nodes[-1] - exact) / np.linalg.norm(exact))
        results.append(Result(
            f"45° bend, load 600 across its plane, n = {len(nodes) - 1}: tip across", case.key, nodes[-1, 0], exact[0],
            error, 1e-2, "units", wall_time(run, case.repeats), "of the tip's position",
        ))
        drawn[case.key] = nodes[:, [2, 0]]
    start = bend.rod.curvature * bend.rod.length * _POINTS
    rest = np.stack([np.sin(start) / bend.rod.curvature, np.zeros_like(start)], axis=1)
    tip = results[0]
    caption = (
        "The bend of Bathe and Bolourchi (1979), an arc of 45° and radius 100 of a unit square section, loaded at its "
        "tip across its plane. Tip: "
        f"{', '.join(number(float(v), 5) for v in last_state(runs['direct']).positions[-1])} (direct), "
        f"{', '.join(number(float(v), 5) for v in exact)} (boundary value problem); off by {percent(tip.error)}."
    )
    references = {"without load": rest, "tip, boundary value problem": exact[[2, 0]][None]}
    draw = pictures.shapes(references, drawn, ("z (units)", "x (units)"))
    return Finding(tuple(results), draw, caption)


PLANE_WIRE = Wire(radius=0.3e-3)
PLANE_DROP = 20e-3  # m


_PLANE_ELEMENTS = {"direct": 30, "xpbd": 15}


def _plane_contact(solvers: Sequence[str]) -> Plan:
    """The tip on a plane, as the end of a damped motion; the other solvers' lines say why they have no run."""
    wire = PLANE_WIRE
    gap = 1e-5  # m, the largest that the barrier leaves
    height = -1e3 * (PLANE_DROP + wire.radius)  # of the plane: the axis comes to rest a radius above it
    scene = {
        **scenes.wire_parameters(wire), "gravity": [0.0, -_GRAVITY, 0.0], "timeStep": 5e-3,
        "vessel": {"shape": "plane", "point": [0.0, height, 0.0], "normal": [0.0, 1.0, 0.0]},
    }
    own = {
        "direct": {"massDamping": 10.0, "integrator": "implicitEuler", "contactDistance": gap, "deltaThreshold": 1e-6,
                   "maxSimulationSteps": 3000},
        # Small steps damp nothing by themselves; what the drag leaves after a second is exp(-30).
        "xpbd": {"solver": "xpbd", "massDamping": 60.0, "substeps": 2000, "constraintSolverSteps": 1,
                 "maxSimulationSteps": 200},
    }
    runs = yield [Case(solver, {**scene, "numberRodElements": _PLANE_ELEMENTS[solver], **own[solver]})
                  for solver in solvers]
    load = wire.line_density * _GRAVITY * wire.length**3 / wire.bending
    shape, force = elastica.heavy_on_plane(load, PLANE_DROP / wire.length, _POINTS)
    free = elastica.heavy(load, _POINTS)
    newtons = force * wire.bending / wire.length**2
    drawn = {solver: last_state(runs[solver]).in_plane / wire.length for solver in solvers}
    what = (f"cantilever, r = {1e3 * wire.radius:g} mm, on a frictionless plane {1e3 * PLANE_DROP:g} mm below: force "
            "at the tip")
    reasons = {
        "explicit": "does not support walls",
        "pbd": "supports walls, but its bending stiffness is per iteration and not this material's",
    }
    forces = {solver: float(runs[solver].measured("wallForces")[0][1]) for solver in solvers}
    results = (
        *(Result(f"{what}, n = {_PLANE_ELEMENTS[solver]}", solver, forces[solver], newtons,
                 abs(forces[solver] / newtons - 1.0), 1e-2, "N", wall_time(runs[solver])) for solver in solvers),
        *(replace(not_run(what, solver, reason), reference=newtons, unit="N") for solver, reason in reasons.items()),
    )

    def draw(figure) -> None:
        axes = figure.add_subplot()
        axes.axhline(PLANE_DROP / wire.length, color="0.3", linewidth=1.0, linestyle="--", label="plane")
        for solver, nodes in drawn.items():
            axes.plot(*nodes.T, pictures.SOLVER_MARKERS[solver], fillstyle="none", label=solver)
        axes.plot(shape.along, shape.across, color="0.6", linewidth=2.5, label="tip on the plane")
        axes.plot(free.along, free.across, color="0.6", linewidth=1.0, label="without the plane")
        axes.invert_yaxis()
        pictures.label(axes, "z/L", "-y/L")

    tips = [f"{number(forces[r.solver], 5)} N ({r.solver}, off by {percent(r.error)})" for r in results[:len(solvers)]]
    caption = (
        "A cantilever whose tip rests on a frictionless plane, own weight: nodes (points) on the boundary value "
        f"problem's solution (line). Force at the tip: {', '.join(tips)}, reference {number(newtons, 5)} N."
    )
    return Finding(results, draw, caption)


def _checks(solvers: Sequence[str]) -> tuple[Check, ...]:
    return (
        *(Check(f"tip-load-{k:g}", SECTION, f"tip load F L²/EI = {k:g}", partial(_tip_load, k, solvers))
          for k in (0.1, 1, 2, 10, 100)),
        *(Check(f"own-weight-{1e3 * r:g}", SECTION, f"own weight, r = {1e3 * r:g} mm", partial(_own_weight, r, solvers))
          for r in (0.5e-3, 0.2e-3)),
        Check("torsion", SECTION, "torsion", partial(_torsion, solvers)),
        Check("spatial-bend", SECTION, "45° bend", partial(_spatial_bend, solvers)),
    )


def _on_plane(solvers: Sequence[str]) -> Check:
    return Check("plane", SECTION, "cantilever on a plane", partial(_plane_contact, solvers))


CHECKS = (*_checks(ALL), _on_plane(("direct", "xpbd")))
FAST = (*_checks(("direct",)), _on_plane(("direct",)))  # the direct solver's only, done in seconds
