"""Checks of a few elements: couples and forces against the energy, and rigid rotations.

What a run states of itself before its first step (summary.json: energy, force and couple of the clamps) belongs to the
shape that its start file holds, at rest or not. So a joint's couple is read at any angle, and the energy's derivatives
are differences between runs whose start files differ by a small shift or turn.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from analysis.validation import pictures, scenes
from analysis.validation.states import last_state, solver_report, wall_time, wall_time_per_second
from analysis.validation.wire import BASE
from guidewire.figures.wording import number
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result, not_run

SECTION = "Statics"
EXACT = 1e-6
LAWS = {"rotationVector": "rotation vector", "darboux": "Darboux"}
_NO_COUPLE = "its summary states no couple and no energy"

# The whole wire is one element behind one joint of K = EI/L and GJ/L.
_ONE = {"numberRodElements": 1, "clampRule": "wholeElement", "maxSimulationSteps": 0}
_TURN = np.array([0.5, -0.9, 0.8])  # rad, about an axis that is none of the joint's own


def _chain(turns: Sequence[Rotation], length: float, shifts: np.ndarray | None = None) -> dict[str, Any]:
    """Return a start file: elements with these frames end to end from the origin, nodes shifted by shape (n+1, 3),
    m."""
    sides = np.stack([turn.apply([0.0, 0.0, length]) for turn in turns])
    nodes = np.concatenate([np.zeros((1, 3)), np.cumsum(sides, axis=0)])
    return _start(nodes if shifts is None else nodes + shifts, turns)


def _start(nodes: np.ndarray, turns: Sequence[Rotation]) -> dict[str, Any]:
    """Return a start file of these places, m, shape (n+1, 3), and frames."""
    return {"positions": (nodes / scenes.UNIT).tolist(), "orientations": [turn.as_quat().tolist() for turn in turns],
            **scenes.CLAMPS_ALONG_Z}


_NODES = 4
_STRAIN = 1e-3  # of an element's length: the stretch and shear of the bent shape
_TURN_STEP = 1e-4  # rad, half of a central difference's
_SIDES = tuple((axis, sign) for axis in range(3) for sign in (-1, 1))


def _bent() -> tuple[list[Rotation], np.ndarray]:
    """Return a bent, twisted and strained chain of three elements: frames, and shifts of the nodes from end to end,
    m."""
    turns = [Rotation.from_rotvec([0.3, -0.2, 0.4]), Rotation.from_rotvec([-0.4, 0.5, 0.9]),
             Rotation.from_rotvec([0.2, 0.7, -0.3])]
    wave = np.sin(1.0 + np.arange(3 * _NODES)).reshape(_NODES, 3)
    return turns, _STRAIN * BASE.length / (_NODES - 1) * (wave - wave[0])


def _gradients() -> Plan:
    """Central differences of the energy of runs against the forces and couples that one run states."""
    turns, shifts = _bent()
    length = BASE.length / len(turns)
    common = {"numberRodElements": len(turns), "maxSimulationSteps": 0, "distalEnd": "clamped"}
    shift = 1e-4 * _STRAIN * length  # m; the axial strain is what changes most quickly
    base = Rotation.from_rotvec(_TURN)
    middle = {"chain": Case("chain", common, start=_chain(turns, length, shifts))}
    sides: dict[tuple[str, int, int], Case] = {}
    for name, node in (("proximal", 0), ("distal", _NODES - 1)):
        for axis, sign in _SIDES:
            moved = shifts.copy()
            moved[node, axis] += sign * shift
            sides[name, axis, sign] = Case(f"{name}-{'xyz'[axis]}{sign:+d}", common,
                                           start=_chain(turns, length, moved))
    for law in LAWS:
        keys = {**_ONE, "bendLaw": law}
        middle[law] = Case(f"{law}-joint", keys, start=_chain([base], BASE.length))
        for axis, sign in _SIDES:
            turned = Rotation.from_rotvec(sign * _TURN_STEP * np.eye(3)[axis]) * base
            sides[law, axis, sign] = Case(f"{law}-joint-{'xyz'[axis]}{sign:+d}", keys,
                                          start=_chain([turned], BASE.length))
    runs = yield [*middle.values(), *sides.values()]
    # A clamp that moves the wire does the work by which the energy grows; a joint's energy grows as its element turns
    # against the clamp's couple.
    derived = [
        *(("chain", name, f"{name}Force", 2.0 * shift, f"strained chain: force of the {name} clamp", "N")
          for name in ("proximal", "distal")),
        *((law, law, "proximalMoment", -2.0 * _TURN_STEP,
           f"joint bent and twisted at once, {label}: couple of the clamp", "N m") for law, label in LAWS.items()),
    ]
    results, components = [], {}
    for at, name, key, width, what, unit in derived:
        stated = solver_report(runs[middle[at].key], key)
        energies = {side: float(solver_report(runs[sides[(name, *side)].key], "energy")) for side in _SIDES}
        derivative = np.array([energies[axis, 1] - energies[axis, -1] for axis in range(3)]) / width
        size = float(np.linalg.norm(derivative))
        results.append(Result(f"{what} as gradient of the energy", "direct", float(np.linalg.norm(stated)), size,
                              float(np.linalg.norm(stated - derivative)) / size, EXACT, unit,
                              wall_time(runs[middle[at].key])))
        components[what.replace(": ", ",\n")] = (derivative / size, stated / size)
    results += [not_run("gradient of the energy", solver, _NO_COUPLE) for solver in ("explicit", "xpbd")]

    def draw(figure) -> None:
        panel = figure.add_subplot()
        panel.plot([-1.0, 1.0], [-1.0, 1.0], color="0.6", linewidth=2.5, label="equal")
        pictures.marks(panel, components, "component of the energy's gradient (of its size)",
                       "component that the run states")

    caption = (
        "Forces and couples that runs state, by components, against central differences of the energy that other runs "
        "state, whose start is shifted or turned a little. Three elements, bent, twisted, stretched and sheared "
        f"between two clamps; and one joint, bent and twisted by {number(float(np.linalg.norm(_TURN)), 3)} rad at "
        f"once. Largest difference {number(max(r.error for r in results if not r.reason), 1)}."
    )
    return Finding(tuple(results), draw, caption)


_WHOLE_TURN = Rotation.from_rotvec([0.7, -1.1, 0.4])
_MOTION = 2e-3  # s
_SOLVERS: Mapping[str, Mapping[str, Any]] = {
    "direct, rotation vector": {"solver": "direct", "timeStep": 1e-4},
    "direct, Darboux": {"solver": "direct", "timeStep": 1e-4, "bendLaw": "darboux"},
    "explicit": {"solver": "explicit", "timeStep": 1e-4},
    "xpbd": {"solver": "xpbd", "timeStep": 1e-4},
}


def _rotated() -> Plan:
    """The same free flight twice, the second time with everything turned."""
    n = 8
    turns = [Rotation.from_rotvec(0.15 * np.array([math.sin(j), math.cos(2.0 * j), 0.5 * j])) for j in range(n)]
    nodes = np.array(_chain(turns, BASE.length / n)["positions"]) * scenes.UNIT
    loads = {"gravity": np.array([1.0, -9.81, 3.0]), "tipForce": np.array([0.02, 0.05, -0.03])}
    runs_of: dict[str, list[Case]] = {}
    for k, (name, method) in enumerate(_SOLVERS.items()):
        held = {"numberRodElements": n, "proximalEnd": "free"}
        small = {}
        if method["solver"] != "direct":
            small = yield from scenes.small_steps(method["solver"], BASE, 1e-4, held)
        base = {**method, **small, **held, "solverTolerance": 1e-10,
                "maxSimulationSteps": round(_MOTION / 1e-4), "logEvery": 1_000_000}
        runs_of[name] = [
            Case(f"{k}-{word}", {**base, **{key: turn.apply(load).tolist() for key, load in loads.items()}},
                 start=_start(turn.apply(nodes), [turn * one for one in turns]))
            for word, turn in (("straight", Rotation.identity()), ("turned", _WHOLE_TURN))
        ]
    runs = yield [case for pair in runs_of.values() for case in pair]
    results, drawn = [], {}
    for name, (first, second) in runs_of.items():
        a, b = (last_state(runs[case.key]).positions for case in (first, second))
        moved = float(np.max(np.linalg.norm(a - nodes, axis=1)))
        error = float(np.max(np.linalg.norm(_WHOLE_TURN.apply(a) - b, axis=1)))
        results.append(Result(
            f"everything turned by {number(_WHOLE_TURN.magnitude(), 3)} rad: free flight of a bent wire for 2 ms, "
            "displacement", name, float(np.max(np.linalg.norm(b - _WHOLE_TURN.apply(nodes), axis=1))), moved,
            error / moved, EXACT, "m", wall_time_per_second(runs[second.key]), "of the displacement, worst node"))
        if name.startswith("direct"):
            before, after = (solver_report(runs[case.key], "energy") for case in (first, second))
            results.append(Result("everything turned: energy after the flight", name, after, before,
                                  abs(after / before - 1.0), EXACT, "J", wall_time_per_second(runs[second.key])))
        drawn[name] = _WHOLE_TURN.inv().apply(b)[:, [2, 1]] / BASE.length
        start = nodes[:, [2, 1]] / BASE.length
    caption = (
        "A bent wire, free at both ends, let go under gravity and a force on its last node: once as it is, once with "
        "its start, gravity and force turned about one axis. Points: the second flight's end, turned back; line: the "
        "start. The two flights end apart by at most "
        f"{number(max(r.error for r in results if r.unit == 'm'), 1)} of the displacement."
    )
    return Finding(tuple(results), pictures.shapes({"start": start}, drawn, ("z/L", "y/L")), caption)


CHECKS = (
    Check("gradient", SECTION, "few elements: force and couple as gradient of the energy", _gradients),
    Check("rotated", SECTION, "few elements: everything rotated", _rotated),
)
