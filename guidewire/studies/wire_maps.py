"""Studies of outcomes over two parameters: how far a wire may be twisted, how it is pushed between walls, and damping.
Runs log the last sphere alone, at their end, where nothing else is said.

A wire is twisted between clamps, at rest and while it moves, and with gains by its drive; it is pushed into a vessel at
speeds of up to 100 m/s, and with barriers of any stiffness; a damping is made as strong as one likes.
"""

from __future__ import annotations

from typing import Any

from guidewire.studies.bisection import Bisection
from guidewire.studies.frontiers import ALONG
from guidewire.studies.sampling import Range
from guidewire.studies.table import Axis, Grid, Study

LENGTH = 0.3  # m, of the wire that is twisted
MOVED_ELEMENTS = 6
TURNED_ELEMENTS = 20  # with gains
TURNED_STEPS = 60
BEND_GAIN = 0.1  # units
TURNED_LENGTH = 100.0  # units
PUSHED_ELEMENT = 0.005  # m
SPEEDS = (0.05, 0.2, 1.0, 5.0, 20.0, 100.0)  # m/s
LONG_STEP = 0.01  # s, of the scheme that has to follow a damping
FALL = 0.16  # s, three quarters of a swing
_WAY = 0.13  # m, into the vessel
_MOST_STEPS = 1500
_RESULTS = ("converged", "finished", "diverged", "failed")
_ENDS = {"logSpheres": "last", "logEvery": 1_000_000}
_ASIDE = [0, -0.01, 0]  # a thousandth of gravity: a wire that may bend finds a way to
_TWISTED: dict[str, Any] = {"distalEnd": "clamped", "gravity": _ASIDE}
_METHODS: dict[str, dict[str, Any]] = {
    "direct": {}, "xpbd": {"solver": "xpbd", "substeps": 200, "constraintSolverSteps": 4},
    "explicit": {"solver": "explicit", "substeps": 6000},
}


def _pushed(speed: float, step: float) -> dict[str, Any]:
    """So far in whole steps of about this speed."""
    steps = max(1, round(_WAY / (speed * step)))
    return {"timeStep": step, "maxSimulationSteps": steps, "insertionSpeed": _WAY / (steps * step)}


def pushes() -> dict[str, tuple[float, float]]:
    """Speed and step of each push by its name, of those that are neither one step nor too many."""
    return {f"{speed:g},{step:g}": (speed, step) for speed in SPEEDS for step in (1e-4, 1e-3, 2e-3, 1e-2, 2e-2)
            if 1.0 < _WAY / (speed * step) < _MOST_STEPS}


def _study(name: str, title: str, scene: str, grid: Grid) -> Study:
    return Study(name, title, f"params/{scene}.json", grid, _RESULTS)


WIRE_MAPS: tuple[Study, ...] = (
    _study("map-twist", "up to which twist is a wire straight, bent, and lost?", "cantilever", Grid(
        (Axis("numberRodElements", (6, 12, 24, 48)),
         Axis("distalRotation", (3.0, 6.0, 9.0, 11.0, 11.5, 12.0, 12.5, 15.0, 18.0, 22.0, 30.0, 45.0, 70.0, 110.0,
                                 170.0))),
        {**_TWISTED, "initialState": "equilibrium", "maxSimulationSteps": 0, "maxNewtonIterations": 200},
    )),
    _study("map-twisting", "up to which twist does a wire follow that is being twisted?", "cantilever", Grid(
        (Axis("distalRotation", (6.0, 10.5, 13.5, 15.0, 16.5, 18.0, 21.0, 30.0)),),
        {**_TWISTED, "numberRodElements": MOVED_ELEMENTS, "distalRampTime": 0.08, "massDamping": 100.0,
         "maxSimulationSteps": 100, **_ENDS}, _METHODS,
    )),
    _study("map-turning", "by how much may a wire with pbd be rotated in one step?", "default", Grid(
        (Axis("constraintSolverSteps", (10, 30, 100, 300)),
         Axis("twistPerStep", (0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0))),
        {"guidewireLength": TURNED_LENGTH, "numberRodElements": TURNED_ELEMENTS, "bendStiffness": BEND_GAIN,
         "drive": "push", "displacementPerStep": 0, "deltaThreshold": 0, "maxSimulationSteps": TURNED_STEPS,
         "logOrientations": True, "logSpheres": "last"},
    )),
    _study("map-speed", "how fast, and in how few steps, may a wire be pushed into a vessel?", "insertion-accurate",
           Grid(
        common={"logHub": False, **_ENDS}, variants={name: _pushed(*push) for name, push in pushes().items()},
    )),
    _study("map-barrier", "how stiff, and how thin, may a barrier be?", "insertion-accurate", Grid(
        (Axis("contactDistance", (1e-6, 1e-5, 1e-4, 1e-3)),
         Axis("contactStiffness", (1e-1, 1e1, 1e3, 1e5, 1e7, 1e9))),
        {"logHub": False, **_pushed(0.2, 0.01), **_ENDS},
    )),
    _study("map-strain-damping", "how strong may the damping of a material be?", "cantilever", Grid(
        (Axis("materialDamping", (1e-6, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 100.0)),),
        {"numberRodElements": 20, "gravity": [0, -9.81, 0], **_ENDS}, {
            "reference": {"integrator": "esdirk4", "timeStep": 2e-4, "maxSimulationSteps": round(FALL / 2e-4)},
            **{scheme: {"integrator": scheme, "timeStep": LONG_STEP, "maxSimulationSteps": round(FALL / LONG_STEP)}
               for scheme in ("implicitEuler", "bdf2", "trbdf2", "esdirk3", "esdirk4")},
        },
    )),
    Study(
        "limit-damped", "up to which stretch stiffness is a wire stable whose spheres lose a fraction of their speed?",
        "params/default.json", Bisection(
            Grid((Axis("constraintSolverSteps", (1, 2, 3, 20)), Axis("damping", (0.0, 0.25, 0.5, 0.75, 1.0))),
                 {**ALONG, "numberRodElements": 10}),
            Range("stretchStiffness", 0.5, 20.0, logarithmic=True), 0.002), _RESULTS, logs=False,
    ),
)
