"""The studies that the command line knows by name.

The longitudinal studies of the thesis (Figures 4.5 to 4.9) start from its Table 4.1 and change one parameter each, and
so do the transversal ones (Figures 4.10 to 4.14), where the first sphere is displaced across the wire instead, and the
collision ones (Figures 4.15 to 4.18), where the wire stands before a wall; all their runs last for the same in-game
time. The other studies are of contact, of drives, of twist, and of where methods fail (guidewire/studies/frontiers.py).
"""

from __future__ import annotations

import math
from typing import Any

from guidewire.studies.frontiers import FRONTIERS
from guidewire.studies.keys import Value
from guidewire.studies.maps import MAPS
from guidewire.studies.table import Axis, Grid, Study
from guidewire.studies.wire_maps import WIRE_MAPS

_TABLE_4_1 = "params/default.json"
_REPEATS = 5

_DURATION = 1.0  # s, in-game, of every run of these; 100 steps of Table 4.1
_REFERENCE = {"constraintSolverSteps": 2000, "numberRodElements": 60, "timeStep": 2e-4}

# The wall scene has two plates along the wire's first two thirds: without them the wire turns away from the wall about
# its held end, whose frame is free, and goes round for ever; between them it comes to rest against the wall.
_PERTURBATIONS: dict[str, tuple[str, dict[str, Any]]] = {
    "transversal": (_TABLE_4_1, {"displacementDirection": [0, 1, 0], "deltaThreshold": 0, "timeStep": 0.01}),
    "collision": ("params/collision-wall.json", {
        "drive": "hold", "displacement": 10, "guidewireOffset": -306, "timeStep": 0.01, "collisionStiffness": 1e-4,
    }),
}


def _decades(first: int, last: int, per_decade: int) -> list[int]:
    """Whole numbers from 10^first to 10^last, spaced as evenly as they can be on a logarithmic axis."""
    count = (last - first) * per_decade
    return sorted({round(10.0 ** (first + k / per_decade)) for k in range(count + 1)})


# Fine enough to tell a peak from a resonance. A time step is a whole part of a second, so that all runs end together.
_FINE_SOLVER_STEPS = tuple(range(100, 1001, 10))
_FINE_TIME_STEPS = tuple(sorted({1.0 / k for k in (*_decades(1, 3, 40), *_decades(3, 4, 5))}))
_FINE_MASSES = tuple(float(f"{10.0 ** (k / 40 - 3):.4g}") for k in range(121))


def _perturbation(
    scene: str, name: str, title: str, axis: Axis | None = None, common: dict[str, Any] | None = None,
    variants: dict[str, dict[str, Any]] | None = None,
) -> Study:
    file, push = _PERTURBATIONS[scene]
    axes = () if axis is None else (axis,)
    return Study(f"{scene}-{name}", f"{scene} perturbation: {title}", file, Grid(
        axes, {**push, **(common or {})}, variants or {}, duration=_DURATION, least_steps=100,
    ))


def _longitudinal(name: str, title: str, key: str, values: tuple[Value, ...]) -> Study:
    return Study(name, title, _TABLE_4_1, Grid((Axis(key, values),), repeats=_REPEATS))


def _perturbations(scene: str) -> tuple[Study, ...]:
    """Return a scene's reference and the four sweeps that the thesis compares with it."""
    return (
        _perturbation(scene, "reference", "the reference run and two coarser ones", common=_REFERENCE, variants={
            "reference": {},
            "half-solver-steps": {"constraintSolverSteps": 1000},
            "half-elements": {"numberRodElements": 30},
        }),
        _perturbation(scene, "solver-steps", "constraint solver steps m",
                      Axis("constraintSolverSteps", _FINE_SOLVER_STEPS)),
        _perturbation(scene, "time-step", "time step size dt", Axis("timeStep", _FINE_TIME_STEPS)),
        _perturbation(scene, "rod-elements", "rod elements n", Axis("numberRodElements", tuple(range(5, 61)))),
        _perturbation(scene, "total-mass", "total mass M", Axis("totalMass", _FINE_MASSES)),
    )


_ELEMENT_CONTACTS = {rule: {"elementContact": rule} for rule in ("none", "barycentric", "thesis")}
_GAIN_ELEMENTS = Axis("numberRodElements", (*range(5, 61, 5), 120))  # the others are measured against the last


# One element, free at both ends and without inertia (damping 1): it reaches 1 unit too deep onto a small fixed sphere.
_ONE_ELEMENT = {
    "drive": "force", "damping": 1, "numberRodElements": 1, "guidewireLength": 60, "guidewireOffset": 0,
    "constraintSolverSteps": 100, "collisionStiffness": 0.01, "deltaThreshold": 0, "maxSimulationSteps": 50,
}
_RESTS = {
    f"{rule},s={k / 10!r}": {
        "elementContact": rule,
        "obstacles": [{"shape": "sphere", "centre": [0, -4.6, 6.0 * k], "radius": 0.6}],  # radius l/100; r = 5
    }
    for rule in ("barycentric", "thesis") for k in range(11)
}

# A lumen that is straight up to z = 0 and then half a circle of radius 60, for a wire of a third of the usual length.
_BEND = [
    [0, 0, -200],
    *([0, round(60 - 60 * math.cos(a), 6), round(60 * math.sin(a), 6)] for a in (k * math.pi / 18 for k in range(19))),
    [0, 120, -150],
]
_SHORT_WIRE = {
    "guidewireLength": 100, "numberRodElements": 20, "guidewireOffset": -105, "constraintSolverSteps": 100,
    "collisionStiffness": 0.1, "damping": 0.1, "deltaThreshold": 0, "displacementPerStep": 0.5,
}


def _lumen(knots: list[list[float]]) -> dict[str, Any]:
    return {"shape": "tube", "knots": knots, "radius": 8, "openStart": True, "openEnd": True}


STUDIES: dict[str, Study] = {
    study.name: study
    for study in (
        Study("default", "the default run", _TABLE_4_1, Grid(repeats=_REPEATS)),
        _longitudinal("constraint-solver-steps", "constraint solver steps m", "constraintSolverSteps",
                      tuple(range(100, 1001, 100))),
        _longitudinal("rod-elements", "rod elements n", "numberRodElements", tuple(range(5, 61, 5))),
        _longitudinal("displacement", "displacement of the first sphere", "displacement", (1, *range(10, 101, 10))),
        _longitudinal("time-step", "time step size dt", "timeStep",
                      (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1)),
        _longitudinal("total-mass", "total mass M", "totalMass",
                      (1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1, 2e-1, 5e-1, 1.0)),
        *_perturbations("transversal"),
        _perturbation("transversal", "displacement", "displacement of the first sphere",
                      Axis("displacement", (1, 2, 5, *range(10, 101, 10)))),
        *_perturbations("collision"),
        Study(
            "wall-gain", "push against the wall: rod elements n and what touches the wall",
            "params/collision-wall.json",
            Grid((_GAIN_ELEMENTS,), {"maxSimulationSteps": 100}, _ELEMENT_CONTACTS, repeats=3),
        ),
        Study(
            "vessel-gain", "insertion into the vessel: rod elements n and what touches the wall",
            "params/insertion.json",
            Grid((_GAIN_ELEMENTS,), {"maxSimulationSteps": 400}, _ELEMENT_CONTACTS, repeats=3),
        ),
        Study("contact-rule", "one element on a small sphere at 11 positions", _TABLE_4_1,
              Grid(common=_ONE_ELEMENT, variants=_RESTS)),
        Study("drives", "what moves the first sphere in a bent lumen", _TABLE_4_1, Grid(
            common={**_SHORT_WIRE, "vessel": _lumen(_BEND), "maxSimulationSteps": 300},
            variants={
                "axis-published": {"drive": "displace", "elementContact": "thesis"},
                "axis": {"drive": "displace"},
                "push": {"drive": "push"},
                "force": {"drive": "force", "externalForce": [0, 0, 5]},
            },
        )),
        Study("twist", "twisted while pushed, in a straight and in a bent lumen", _TABLE_4_1, Grid(
            (Axis("constraintSolverSteps", (20, 100, 500)),),
            {**_SHORT_WIRE, "drive": "push", "twistPerStep": 0.02, "logOrientations": True, "maxSimulationSteps": 400},
            {"straight": {"vessel": _lumen([_BEND[0], [0, 0, 400]])}, "bent": {"vessel": _lumen(_BEND)}},
        )),
        *FRONTIERS,
        *MAPS,
        *WIRE_MAPS,
    )
}
