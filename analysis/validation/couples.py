"""Checks of couples at the tip: they are follower couples, so in space the equilibrium is not a minimum of an energy.
Each run states how the solver treated that (summary.json, "method"), and the captions repeat it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from analysis.validation import elastica, pictures, scenes
from analysis.validation.spatial import CurvedRod
from analysis.validation.states import last_state, solver_method, wall_time
from analysis.validation.wire import BASE, STURDY, Wire
from guidewire.figures.wording import exponent, percent
from guidewire.logs.runs import Run
from guidewire.studies.keys import value_text
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result, not_run

SECTION = "Statics"
ARC_GATE = 1e-3  # of L
EXACT = 1e-9  # rad; what a search to 1e-9 may leave
_NO_COUPLES = "xpbd has no couples (the run would end with that message)"
_POINTS = np.linspace(0.0, 1.0, 301)


def _methods(runs: Sequence[Run]) -> str:
    """Return what the direct solver says, in each of these runs, of how it treated the couple."""
    said = dict.fromkeys(solver_method(run) for run in runs if run.value("solver") == "direct")
    return (f"How the direct solver treated the couple, in its own words: {'; '.join(said)}. explicit: a damped motion "
            "under the couple as it turns, which needs no potential.")


_ANGLES = {"π/2": 0.5 * math.pi, "π": math.pi, "2π": 2.0 * math.pi}


def _couple(wire: Wire, angle: float) -> list[float]:
    """Return a couple that bends the wire by an angle towards -y: about +x along the tip's own axes."""
    return [angle * wire.bending / wire.length, 0.0, 0.0]


def _settled(law: str, angle: float, n: int) -> scenes.Asking[Case]:
    """The explicit solver's run of an end couple. The sturdy wire's arc is the base wire's: a couple neither stretches
    nor shears."""
    key = f"explicit-{law}-{_slug(angle)}"
    return Case(key, (yield from scenes.settled("explicit", STURDY, {
        **scenes.wire_parameters(STURDY), "tipMoment": _couple(STURDY, angle), "clampRule": "halfElement",
        "bendLaw": law, "numberRodElements": n}, name=f"{key}-limit")))


def _slug(angle: float) -> str:
    return value_text(math.degrees(angle))


def _end_moment() -> Plan:
    rules = {"halfElement": "half-element clamp", "fourthOrder": "fourth-order clamp"}
    asked = [
        (f"direct, {words}", rule, name, angle, Case(f"{rule}-{_slug(angle)}", scenes.at_rest(
            {"tipMoment": _couple(BASE, angle), "clampRule": rule})))
        for rule, words in rules.items() for name, angle in _ANGLES.items()
    ]
    for name, angle in _ANGLES.items():
        case = yield from _settled("rotationVector", angle, scenes.ELEMENTS)
        asked.append(("explicit, r = 5 mm", "halfElement", name, angle, case))
    runs = yield [case for *_, case in asked]
    results, drawn, references = [], {}, {}
    for solver, rule, name, angle, case in asked:
        run = runs[case.key]
        state = last_state(run)
        n = len(state.directors)
        nodes = state.in_plane / BASE.length
        arc = elastica.arc(angle, np.linspace(0.0, 1.0, n + 1))
        exact = np.stack([arc.along, arc.across], axis=1)
        tip = float(np.linalg.norm(nodes[-1] - exact[-1]))
        what = f"couple M L/EI = {name}, n = {n}"
        turned = np.unwrap(np.arctan2(-state.directors[:, 1], state.directors[:, 2]))
        middles = angle * (np.arange(n) + 0.5) / n
        # With the fourth-order weights the first two elements stand off by design: 3/8 and 37/24 of a joint's angle.
        checked = slice(0, None) if rule == "halfElement" else slice(2, None)
        wrong = float(np.max(np.abs(turned - middles)[checked]))
        gate = EXACT if solver.startswith("direct") else None
        results.append(Result(what + ": angle of the last element", solver, turned[-1], middles[-1], wrong, gate,
                              "rad", wall_time(run), "rad, worst element"))
        results.append(Result(what + ": tip across", solver, nodes[-1, 1], exact[-1, 1], tip,
                              ARC_GATE, "L", wall_time(run), "L, distance of the tip"))
        if rule == "halfElement":
            drawn[f"{solver.split(',')[0]}, M L/EI = {name}"] = nodes
        fine = elastica.arc(angle, _POINTS)
        references["arc" if not references else f"_{name}"] = np.stack([fine.along, fine.across], axis=1)
    results.append(not_run("couple at the tip", "xpbd", _NO_COUPLES))
    caption = (
        "End couples M L/EI = π/2, π and 2π, n = 30, rotation vector: nodes (points, half-element clamp) on circular "
        "arcs (lines). The direct solver's angles are exact; the nodes are joined by straight elements, which are "
        "shorter than their arcs by (κ l)²/24. With the fourth-order weights at the clamp, made for forces, the first "
        "two elements are offset by design and the tip with them, by l² κ/12. "
        + _methods([runs[case.key] for *_, case in asked])
    )
    return Finding(tuple(results), pictures.shapes(references, drawn), caption)


def _darboux_couple() -> Plan:
    counts = (30, 60, 90, 180)
    law = {"bendLaw": "darboux", "clampRule": "halfElement"}
    cases = {
        (name, n): Case(f"{_slug(angle)}-n={n}", scenes.at_rest({
            **law, "numberRodElements": n, "tipMoment": _couple(BASE, angle)}))
        for name, angle in _ANGLES.items() for n in counts
    }
    explicit = {}
    for name, angle in _ANGLES.items():
        explicit[name] = yield from _settled("darboux", angle, 90)
    beyond = Case("beyond", scenes.at_rest({**law, "numberRodElements": 6, "tipMoment": _couple(BASE, 6.5)}))
    runs = yield [*cases.values(), *explicit.values(), beyond]
    results, series = [], {}

    def line(name: str, solver: str, case: Case) -> Result:
        run = runs[case.key]
        nodes = last_state(run).in_plane / BASE.length
        tip = np.array(elastica.arc(_ANGLES[name], np.array([0.0, 1.0])).tip)
        n = len(nodes) - 1
        return Result(f"couple M L/EI = {name}, Darboux law, n = {n}: tip across", solver, nodes[-1, 1], tip[1],
                      float(np.linalg.norm(nodes[-1] - tip)), ARC_GATE if n >= 90 else None, "L", wall_time(run),
                      "L, distance of the tip")

    for name in _ANGLES:
        lines = [line(name, "direct", cases[name, n]) for n in counts]
        order = -exponent(counts[1:], [r.error for r in lines[1:]])
        results += [*lines, line(name, "explicit, r = 5 mm", explicit[name])]
        results.append(Result(f"couple M L/EI = {name}, Darboux law: order in n", "direct", order, 2.0,
                              abs(order - 2.0), 0.1, "", None, "absolute"))
        series[f"M L/EI = {name}"] = (counts, [r.error for r in lines])
    failed = runs["beyond"].outcome
    results.append(Result(
        "couple 1.08 K = 1.08 EI/l, Darboux law, n = 6: has no rest shape, so the run must end as failed (1)", "direct",
        float(failed == "failed"), 1.0, 0.0 if failed == "failed" else 1.0, 0.0, "", None, "1: ended otherwise",
    ))
    results.append(not_run("couple at the tip, Darboux law", "xpbd", _NO_COUPLES + "; it supports the rotation "
                                                                                   "vector only"))
    caption = (
        "End couples with the Darboux law, torque K sin(angle), direct solver: the tip's distance from that of the arc "
        "falls with the second power of n. A couple above K = EI/l has no rest shape: with n = 6 and 1.08 K the run "
        f"ends as {failed} ({runs['beyond'].summary['reason']}). "
        + _methods([runs[case.key] for case in (*cases.values(), *explicit.values())])
    )
    draw = pictures.orders("number of elements n", "error of the tip (L)", series, [(-2.0, "order 2")],
                           (ARC_GATE, "limit from n = 90 on"))
    return Finding(tuple(results), draw, caption)


_SPACE_GATE = 3e-3  # of L, as of other shapes
_FORCE = np.array([0.5, -1.0, 0.0])  # EI/L^2, fixed axes
_COUPLE = np.array([0.5, 0.3, 0.8])  # EI/L, the tip's axes
_FACTORS = (0.5, 1.0, 2.0)


def _space() -> Plan:
    def keys(wire: Wire, factor: float) -> dict[str, list[float]]:
        return {"tipForce": (factor * wire.bending / wire.length**2 * _FORCE).tolist(),
                "tipMoment": (factor * wire.bending / wire.length * _COUPLE).tolist()}

    cases = {("direct", f): Case(f"direct-{value_text(f)}", scenes.at_rest(keys(BASE, f)), repeats=3) for f in _FACTORS}
    middle = _FACTORS[1]
    cases["explicit", middle] = Case("explicit", (yield from scenes.settled("explicit", BASE, keys(BASE, middle))))
    runs = yield list(cases.values())
    rod = CurvedRod(BASE.length, 0.0, BASE.bending, BASE.torsion, BASE.stretching, BASE.shearing)
    results, drawn, tips = [], {}, {}
    for (solver, factor), case in cases.items():
        run = runs[case.key]
        what = f"force (0.5, -1, 0) EI/L² and couple (0.5, 0.3, 0.8) EI/L, both times {factor:g}: tip along y"
        given = keys(BASE, factor)
        exact = rod.tip(np.array(given["tipForce"]), np.array(given["tipMoment"])) / BASE.length
        if run.outcome == "failed":
            results.append(Result(f"{what} ({run.summary['reason']})", solver, math.nan, exact[1], math.nan,
                                  _SPACE_GATE, "L"))
            continue
        nodes = last_state(run).positions / BASE.length
        results.append(Result(what, solver, nodes[-1, 1], exact[1], float(np.linalg.norm(nodes[-1] - exact)),
                              _SPACE_GATE, "L", wall_time(run, case.repeats), "L, distance of the tip"))
        drawn[f"{solver}, times {factor:g}"] = nodes[:, [2, 1]]
        tips["tip, boundary value problem" if not tips else f"_{factor:g}"] = exact[[2, 1]][None]
    shown = [r for r in results if math.isfinite(r.error)]
    results.append(not_run("force and couple in space", "xpbd", _NO_COUPLES))
    caption = (
        "A force in fixed axes and a couple along the tip's own axes, out of one plane: the couple has no potential. "
        "Nodes seen along x, n = 30; reference: a boundary value problem of the rod in space. Distance of the tip from "
        "its place: " + ", ".join(f"{name} {percent(r.error)}" for name, r in zip(drawn, shown)) + " of L. "
        + _methods([runs[case.key] for case in cases.values()])
    )
    return Finding(tuple(results), pictures.shapes(tips, drawn, ("z/L", "y/L")), caption)


CHECKS = (
    Check("end-moment", SECTION, "end couples, rotation vector", _end_moment),
    Check("end-moment-darboux", SECTION, "end couples, Darboux law", _darboux_couple),
    Check("couple-in-space", SECTION, "couple and force in space", _space),
)
