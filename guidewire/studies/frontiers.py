"""Studies of stability limits: bisections of pbd's stiffness or a step, for which there are limits in closed form, and
the direct solver's schemes at steps of up to 0.1 s, for which there is none.

Runs are displaced by 10 units and may rest, but do not end there: a gain just beyond its limit needs time to be seen.
"""

from __future__ import annotations

from typing import Any

from guidewire.studies.bisection import Bisection
from guidewire.studies.sampling import Range
from guidewire.studies.table import Axis, Grid, Study

LENGTH = 300.0  # units
MASS = 0.01  # mass units
BEND = STRETCH = 0.1  # the gain that is not bisected
RADII = (0.0005, 0.005)  # m
STEPS = (0.001, 0.003, 0.01, 0.03, 0.1)  # s
SCHEMES = ("implicitEuler", "bdf2", "trbdf2", "esdirk3", "esdirk4")
_ALL = ("converged", "finished", "diverged", "failed")
ALONG: dict[str, Any] = {
    "guidewireLength": LENGTH, "totalMass": MASS, "bendStiffness": BEND, "stretchStiffness": STRETCH,
    "deltaThreshold": 0, "maxSimulationSteps": 600, "displacement": 10, "displacementDirection": [0, 0, 1],
}
_ACROSS = {**ALONG, "displacementDirection": [0, 1, 0]}
_METHODS: dict[str, dict[str, Any]] = {
    "verlet": {},
    "euler": {"integrator": "euler"},
    "orientationVerlet": {"integrator": "orientationVerlet"},
    "eulerOrientationVerlet": {"integrator": "eulerOrientationVerlet"},
    "bilateral": {"sweepOrder": "bilateral"},
}
_SWEEPS = Axis("constraintSolverSteps", (20, 100, 500))
_ELEMENTS = Axis("numberRodElements", (10, 30, 60))
_LET_GO = {"initialState": "equilibrium", "tipForce": [0, -0.3, 0], "tipForceReleaseTime": 0.0}  # F L^2/EI = 9


def _gain(name: str, title: str, grid: Grid, range_: Range, width: float) -> Study:
    return Study(name, title, "params/default.json", Bisection(grid, range_, width), _ALL, logs=False)


FRONTIERS: tuple[Study, ...] = (
    _gain("limit-stretch-across", "up to which stretch stiffness is a wire stable that is displaced across itself?",
          Grid((_SWEEPS, _ELEMENTS), _ACROSS, _METHODS), Range("stretchStiffness", 1.0, 4.0), 0.01),
    _gain("limit-stretch-along", "up to which stretch stiffness is a wire stable that is displaced along itself?",
          Grid((_SWEEPS, Axis("numberRodElements", (5, 10, 20, 30, 60))), ALONG),
          Range("stretchStiffness", 1.0, 60.0, logarithmic=True), 0.002),
    _gain("limit-bend", "up to which bend stiffness is a wire stable that is displaced across itself?",
          Grid((_SWEEPS, _ELEMENTS), _ACROSS, _METHODS), Range("bendStiffness", 0.5, 100.0, logarithmic=True), 0.01),
    Study(
        "limit-explicit", "up to which step does the explicit solver hold?", "params/cantilever.json",
        Bisection(Grid((Axis("numberRodElements", (4, 8, 16, 32)), Axis("wireRadius", RADII)), {
            "solver": "explicit", "proximalEnd": "free", "maxSimulationSteps": 3000, "tipForce": [0, -1e-3, -1e-3],
        }), Range("timeStep", 1e-9, 1e-4, logarithmic=True), 0.01), _ALL, logs=False,
    ),
    Study(
        "long-steps", "does the direct solver hold with steps of up to 0.1 s?", "params/cantilever.json",
        Grid((Axis("integrator", SCHEMES), Axis("timeStep", STEPS)), {"maxSimulationSteps": 200}, {
            "sags": {"gravity": [0, -9.81, 0]},
            "let-go": _LET_GO,
            "pendulum": {"gravity": [0, -9.81, 0], "proximalEnd": "held"},
            "flies": {"tipForce": [0, -1e-3, -1e-3], "proximalEnd": "free"},
        }), _ALL, logs=False,
    ),
)
