"""Parameters of the runs of checks, which override those of the base wire's scene."""

from __future__ import annotations

import math
from collections.abc import Generator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from analysis.validation.states import solver_report
from analysis.validation.wire import Wire
from guidewire.logs.runs import Run
from guidewire.studies.table import Case

UNIT = 1e-3  # m; one unit of length of the files
ELEMENTS = 30  # n of the scene
# Of a start file: clamps that look along z, whatever the first and the last element do.
CLAMPS_ALONG_Z: dict[str, Any] = {"proximalFrame": [0.0, 0.0, 0.0, 1.0], "distalFrame": [0.0, 0.0, 0.0, 1.0]}
SCENE = "params/cantilever.json"  # the base wire, clamped

_EXPLICIT_FRACTION = 0.75  # of the explicit solver's stable substep
_SWEEPS = 3  # of xpbd in a substep; they nearly converge where it is at most
_XPBD_SHEAR = 4.0  # of the time in which an element turns against its shear, and
_XPBD_AXIAL = 1.0 / 3.0  # of the time that sound takes along an element

_Found = TypeVar("_Found")
Asking = Generator[Sequence[Case], Mapping[str, Run], _Found]  # asks for runs before it knows what it returns


def wire_parameters(wire: Wire) -> dict[str, Any]:
    """Return the keys of a wire."""
    return {
        "guidewireLength": wire.length / UNIT,
        "wireRadius": wire.radius,
        "youngsModulus": wire.youngs_modulus,
        "shearModulus": wire.shear_modulus,
        "shearFactor": wire.shear_factor,
        "density": wire.density,
    }


def damping(solver: str, rate: float, step: float) -> dict[str, float]:
    """Return the key that makes a force -rate M v (rate in 1/s) under a solver with this time step (s)."""
    return {"damping": min(1.0, rate * step)} if solver == "pbd" else {"massDamping": rate}


def at_rest(overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Return the rest shape, and nothing after it, by the direct solver."""
    return {"initialState": "equilibrium", "maxSimulationSteps": 0, "logOrientations": True, **overrides}


def small_steps(
    solver: str, wire: Wire, step: float, overrides: Mapping[str, Any], name: str = ""
) -> Asking[dict[str, Any]]:
    """Substeps of a time step in s, and sweeps of each, of the explicit solver or of xpbd; `name` is of the run that
    states the limit of explicit steps, that of the solver where it is not given."""
    if solver == "xpbd":
        return xpbd_steps(wire, step, overrides.get("numberRodElements", ELEMENTS))
    return explicit_steps(step, (yield from stable_substep(overrides, name or f"{solver}-limit")))


def explicit_steps(step: float, stable: float) -> dict[str, Any]:
    """Substeps of the explicit solver, which is stable up to a substep of `stable`, s."""
    return {"substeps": math.ceil(step / (_EXPLICIT_FRACTION * stable))}


def xpbd_steps(wire: Wire, step: float, elements: int) -> dict[str, Any]:
    """Substeps of xpbd, and sweeps of each."""
    substep = min(_XPBD_SHEAR * shear_substep(wire), _XPBD_AXIAL * axial_substep(wire, elements))
    return {"substeps": math.ceil(step / substep), "constraintSolverSteps": _SWEEPS}


def stable_substep(overrides: Mapping[str, Any], name: str) -> Asking[float]:
    """Longest substep with which explicit steps of a wire and its supports are stable, s, as the runner states it."""
    return (yield from stable_substeps({name: overrides}))[name]


def stable_substeps(wires: Mapping[str, Mapping[str, Any]]) -> Asking[dict[str, float]]:
    """The same for several wires, by name of the run that states it."""
    runs = yield [Case(name, {**overrides, "solver": "explicit", "maxSimulationSteps": 0})
                  for name, overrides in wires.items()]
    return {name: float(solver_report(runs[name], "stableSubstep")) for name in wires}


def shear_substep(wire: Wire) -> float:
    """2/omega of an element turning against its shear, omega = sqrt(GA/(rho I)), s."""
    return wire.radius / math.sqrt(wire.shear_factor * wire.shear_modulus / wire.density)


def axial_substep(wire: Wire, elements: int) -> float:
    """2/omega of neighbours moving, or turning, against each other, omega = 2 sqrt(E/rho)/l: sound's time along an
    element, s."""
    return wire.length / elements / math.sqrt(wire.youngs_modulus / wire.density)


def plane_start(along: np.ndarray, across: np.ndarray) -> dict[str, Any]:
    """Return a start at rest on a curve in the y-z plane, frames along the elements, clamps along z.

    Parameters
    ----------
    along, across : (n+1,), along z and against y, m.
    """
    angle = np.arctan2(np.diff(across), np.diff(along))
    return {
        "positions": [[0.0, -y / UNIT, z / UNIT] for z, y in zip(along, across)],
        "orientations": [[math.sin(0.5 * a), 0.0, 0.0, math.cos(0.5 * a)] for a in angle],
        **CLAMPS_ALONG_Z,
    }
