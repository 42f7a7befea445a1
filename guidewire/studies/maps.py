"""Studies of outcomes over two parameters: where methods are stable, inaccurate, or fail. Runs log the last sphere
alone, at their end.

Pushes go the same way in fewer, longer steps; joints are turned by a couple at the tip or by the distal clamp; a tip is
made heavier; xpbd has more substeps or more sweeps; a drag is made stronger than a step can follow.
"""

from __future__ import annotations

import math
from typing import Any

from guidewire.studies.table import Axis, Grid, Rows, Study

RADIUS = 5.0  # units, of the wire that is pushed
JOINT_ELEMENTS = 6
ANGLES = (0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.25)  # rad a joint
RATIOS = (1.0, 10.0, 100.0, 1000.0)  # of the tip's density to the wire's
_WAY = 100.0  # units
_ENDS = {"logSpheres": "last", "logEvery": 1_000_000}
_LUMEN = {
    "shape": "tube", "radius": 8, "openStart": True, "openEnd": True,
    "knots": [[0, 0, -200], *([0, round(60 - 60 * math.cos(a), 6), round(60 * math.sin(a), 6)] for a in (
        k * math.pi / 18 for k in range(19))), [0, 120, -150]],
}
_PUSH: dict[str, Any] = {
    "guidewireLength": 100, "numberRodElements": 20, "guidewireOffset": -105, "constraintSolverSteps": 100,
    "sphereRadius": RADIUS, "collisionStiffness": 0.1, "damping": 0.1, "deltaThreshold": 0, "drive": "push",
    "vessel": _LUMEN, **_ENDS,
}
_FALL: dict[str, Any] = {
    "integrator": "implicitEuler", "numberRodElements": 16, "wireRadius": 0.0003, "gravity": [0, -9.81, 0],
    "massDamping": 35, "vessel": {"shape": "plane", "point": [0, -20.3, 0], "normal": [0, 1, 0]}, **_ENDS,
}
_STIFFNESS = 60e9 * 0.25 * math.pi * 0.0005**4 * JOINT_ELEMENTS / 0.3  # K = EI/l, N m
_SWAYING = {"numberRodElements": 20, "gravity": [0, -9.81, 0], "timeStep": 1e-3, "maxSimulationSteps": 20, **_ENDS}
_HEAVY = {f"ratio-{ratio:g}": {"wireSections": [{"from": 285, "to": 300, "density": 6450.0 * ratio}]}
          for ratio in RATIOS}
_RESULTS = ("converged", "finished", "diverged", "failed")


def _study(name: str, title: str, scene: str, grid: Grid) -> Study:
    return Study(name, title, f"params/{scene}.json", grid, _RESULTS)


def _bent(angle: float, law: str) -> dict[str, Any]:
    """Return a couple at the tip that turns each joint by so much, in rad, where K times the angle is its couple."""
    return {"tipMoment": [angle * _STIFFNESS, 0.0, 0.0], "bendLaw": law, "initialState": "equilibrium",
            "maxSimulationSteps": 0, "maxNewtonIterations": 200}


def _twisted(angle: float) -> dict[str, Any]:
    """Return a distal clamp that turns each joint by so much, in rad; those at the clamps count for 3/8 and 7/6,
    23/24."""
    return {"distalEnd": "clamped", "distalRotation": angle * JOINT_ELEMENTS, "initialState": "equilibrium",
            "maxSimulationSteps": 0, "maxNewtonIterations": 200}


MAPS: tuple[Study, ...] = (
    _study("map-push", "how large a displacement is allowed in one step?", "default", Grid(
        (Rows("push", ("displacementPerStep", "maxSimulationSteps"), tuple(
            (d, round(_WAY / d)) for d in (0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0))),),
        _PUSH, {rule: {"elementContact": rule} for rule in ("barycentric", "thesis", "none")},
    )),
    _study("map-slender", "how long may elements be, over the radius?", "default", Grid(
        (Axis("numberRodElements", (4, 5, 7, 10, 20, 40)),),
        {**_PUSH, "displacementPerStep": 1.0, "maxSimulationSteps": 100},
        {rule: {"elementContact": rule} for rule in ("barycentric", "thesis", "none")},
    )),
    _study("map-gap", "which contact distance at which step?", "cantilever", Grid(
        (Rows("step", ("timeStep", "maxSimulationSteps"), ((1e-3, 200), (5e-3, 40), (2e-2, 10), (5e-2, 4))),
         Axis("contactDistance", (1e-7, 1e-6, 1e-5, 1e-4, 1e-3))), _FALL,
    )),
    _study("map-joints", "by how much may a joint be rotated?", "cantilever", Grid(
        common={"numberRodElements": JOINT_ELEMENTS, **_ENDS}, variants={
            **{f"{law},{angle}": _bent(angle, law) for law in ("rotationVector", "darboux") for angle in ANGLES},
            **{f"twist,{angle}": _twisted(angle) for angle in ANGLES},
        },
    )),
    _study("map-heavy-tip", "how heavy may the tip be?", "cantilever", Grid(
        common=_SWAYING, variants={
            f"{method},{name}": {**keys, **heavy} for name, heavy in _HEAVY.items() for method, keys in {
                "direct": {}, "xpbd": {"solver": "xpbd", "substeps": 400},
                "xpbd with 10 sweeps": {"solver": "xpbd", "substeps": 100, "constraintSolverSteps": 10},
                "explicit": {"solver": "explicit", "substeps": 6000}}.items()
        },
    )),
    _study("map-xpbd", "how many substeps, and how many iterations?", "cantilever", Grid(
        (Axis("substeps", (25, 50, 100, 200, 400, 800)), Axis("constraintSolverSteps", (1, 3, 10, 30))),
        {**_SWAYING, "solver": "xpbd"}, {"xpbd": {}},
    )),
    _study("map-drag", "how strong may a drag be?", "cantilever", Grid(
        (Axis("massDamping", (1.0, 1e2, 1e4, 1e6, 1e7, 1e8)),), {**_SWAYING, "maxSimulationSteps": 10}, {
            "direct": {}, "xpbd": {"solver": "xpbd", "substeps": 400},
            "explicit": {"solver": "explicit", "substeps": 6000},
        },
    )),
)
