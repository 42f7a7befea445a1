"""What is run: each study is a scene, one parameter and its values. Running them is experiments/sweep.py.

The longitudinal studies of the thesis (Figures 4.5 to 4.9) start from its Table 4.1 and change one parameter each, and
so do the transversal ones (Figures 4.10 to 4.14), where the first sphere is displaced across the wire instead, and the
collision ones (Figures 4.15 to 4.18), where the wire stands before a wall; all their runs last for the same in-game
time. The other studies are of contact, of drives and of twist.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class Study:
    """A scene and one parameter of it that takes several values.

    Attributes
    ----------
    name : folder of the study in the results, and its name on the command line.
    title : what is varied, for people.
    scene : parameter file, relative to the repository.
    parameter : key that takes the values, or None where the scene is run as it is.
    values : its values, ascending, in the unit of the key.
    common : overrides of every run.
    repeats : number of timed repeats of each run, made with no other run beside them.
    variants : name to further overrides; every value is run once with each. Empty: once, with none.
    duration : in-game time of every run in s; None: the scene's number of steps. The step size must then stand in
        `common`, a variant or the values.
    least_steps : steps that a run of `duration` makes at least, so that runs can be compared step by step too.
    """

    name: str
    title: str
    scene: str
    parameter: str | None = None
    values: tuple[float, ...] = ()
    common: Mapping[str, Any] = field(default_factory=dict)
    repeats: int = 5
    variants: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    duration: float | None = None
    least_steps: int = 0

    def runs(self) -> list[StudyRun]:
        """Every run: first one per value whose log is analysed, then the timed repeats.

        The repeats go through all values before the next repeat, so that a machine that slows down for a while
        slows every value's repeats alike.
        """
        return [
            StudyRun(key, value, self._overrides(variant, value, repeat), repeat)
            for repeat in (None, *range(1, self.repeats + 1))
            for key, variant, value in self._points()
        ]

    def _points(self) -> list[tuple[str, str | None, float | None]]:
        """Key, variant and value of every run."""
        values = [None] if self.parameter is None else list(self.values)
        points = []
        for variant in self.variants or [None]:
            for value in values:
                parts = [variant, None if value is None else f"{self.parameter}={value:g}"]
                points.append((",".join(part for part in parts if part) or "default", variant, value))
        return points

    def _overrides(self, variant: str | None, value: float | None, repeat: int | None) -> dict[str, Any]:
        varied = {} if self.parameter is None else {self.parameter: value}
        chosen = {} if variant is None else self.variants[variant]
        overrides = {**self.common, **chosen, **varied}
        if self.duration is not None:
            steps = max(math.ceil(self.duration / overrides["timeStep"] - _ROUNDING), self.least_steps)
            overrides["maxSimulationSteps"] = steps
        return {**overrides, **({} if repeat is None else _TIMED)}


@dataclass(frozen=True)
class StudyRun:
    """One run of a study.

    Attributes
    ----------
    key : names the value, such as `timeStep=0.01`; folder of the run within the study.
    value : value of the study's parameter, or None where it has none.
    overrides : parameter key to value, laid over the scene.
    repeat : number of the timed repeat, or None for the run whose log is analysed.
    """

    key: str
    value: float | None
    overrides: Mapping[str, Any]
    repeat: int | None

    @property
    def folder(self) -> str:
        """Folder of the run, relative to the study's."""
        return self.key if self.repeat is None else f"{self.key}/repeat-{self.repeat}"


_TABLE_4_1 = "params/default.json"
_ROUNDING = 1e-6  # of a step: 0.3/0.1 is three steps
_TIMED = {"logSpheres": "last"}  # a timed run's log is read for its times only

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
    scene: str, name: str, title: str, parameter: str | None = None, values: tuple[float, ...] = (), **options: Any
) -> Study:
    file, common = _PERTURBATIONS[scene]
    return Study(
        f"{scene}-{name}", f"{scene} perturbation: {title}", file, parameter, values,
        {**common, **options.pop("common", {})}, repeats=0, duration=_DURATION, least_steps=100, **options,
    )


def _perturbations(scene: str) -> tuple[Study, ...]:
    """A scene's reference and the four sweeps that the thesis compares with it."""
    return (
        _perturbation(scene, "reference", "the reference run and two coarser ones", common=_REFERENCE, variants={
            "reference": {},
            "half-solver-steps": {"constraintSolverSteps": 1000},
            "half-elements": {"numberRodElements": 30},
        }),
        _perturbation(scene, "solver-steps", "constraint solver steps m", "constraintSolverSteps", _FINE_SOLVER_STEPS),
        _perturbation(scene, "time-step", "time step size dt", "timeStep", _FINE_TIME_STEPS),
        _perturbation(scene, "rod-elements", "rod elements n", "numberRodElements", tuple(range(5, 61))),
        _perturbation(scene, "total-mass", "total mass M", "totalMass", _FINE_MASSES),
    )


_ELEMENT_CONTACTS = {rule: {"elementContact": rule} for rule in ("none", "barycentric", "seed")}
_GAIN_ELEMENTS = (*range(5, 61, 5), 120)  # the last one is what the others are measured against


# One element, free at both ends and without inertia (damping 1): it reaches 1 unit too deep onto a small fixed sphere.
_ONE_ELEMENT = {
    "drive": "force", "damping": 1, "numberRodElements": 1, "guidewireLength": 60, "guidewireOffset": 0,
    "constraintSolverSteps": 100, "collisionStiffness": 0.01, "deltaThreshold": 0, "maxSimulationSteps": 50,
}
_RESTS = {
    f"{rule},s={k / 10:g}": {
        "elementContact": rule,
        "obstacles": [{"shape": "sphere", "centre": [0, -4.6, 6.0 * k], "radius": 0.6}],  # radius l/100; r = 5
    }
    for rule in ("barycentric", "seed") for k in range(11)
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
        Study("default", "the default run", _TABLE_4_1),
        Study(
            "constraint-solver-steps", "constraint solver steps m", _TABLE_4_1, "constraintSolverSteps",
            tuple(range(100, 1001, 100)),
        ),
        Study("rod-elements", "rod elements n", _TABLE_4_1, "numberRodElements", tuple(range(5, 61, 5))),
        Study(
            "displacement", "displacement of the first sphere", _TABLE_4_1, "displacement",
            (1, *range(10, 101, 10)),
        ),
        Study(
            "time-step", "time step size dt", _TABLE_4_1, "timeStep",
            (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1),
        ),
        Study(
            "total-mass", "total mass M", _TABLE_4_1, "totalMass",
            (1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2, 1e-1, 2e-1, 5e-1, 1.0),
        ),
        *_perturbations("transversal"),
        _perturbation("transversal", "displacement", "displacement of the first sphere", "displacement",
                      (1, 2, 5, *range(10, 101, 10))),
        *_perturbations("collision"),
        Study(
            "wall-gain", "push against the wall: rod elements n and what touches the wall",
            "params/collision-wall.json", "numberRodElements", _GAIN_ELEMENTS,
            {"maxSimulationSteps": 100}, repeats=3, variants=_ELEMENT_CONTACTS,
        ),
        Study(
            "vessel-gain", "insertion into the vessel: rod elements n and what touches the wall",
            "params/insertion.json", "numberRodElements", _GAIN_ELEMENTS, {"maxSimulationSteps": 400}, repeats=3,
            variants=_ELEMENT_CONTACTS,
        ),
        Study("contact-rule", "one element on a small sphere at 11 positions", _TABLE_4_1, common=_ONE_ELEMENT,
              repeats=0, variants=_RESTS),
        Study(
            "drives", "what moves the first sphere in a bent lumen", _TABLE_4_1, repeats=0,
            common={**_SHORT_WIRE, "vessel": _lumen(_BEND), "maxSimulationSteps": 300},
            variants={
                "axis-published": {"drive": "displace", "elementContact": "seed"},
                "axis": {"drive": "displace"},
                "push": {"drive": "push"},
                "force": {"drive": "force", "externalForce": [0, 0, 5]},
            },
        ),
        Study(
            "twist", "twisted while pushed, in a straight and in a bent lumen", _TABLE_4_1, repeats=0,
            common={**_SHORT_WIRE, "drive": "push", "twistPerStep": 0.02, "logOrientations": True,
                    "maxSimulationSteps": 400},
            variants={
                f"{name},constraintSolverSteps={m}": {"vessel": _lumen(knots), "constraintSolverSteps": m}
                for name, knots in (("straight", [_BEND[0], [0, 0, 400]]), ("bent", _BEND)) for m in (20, 100, 500)
            },
        ),
    )
}
