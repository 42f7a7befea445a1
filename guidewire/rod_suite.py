"""The direct solver as a solver of cosseratbench (github.com/jakeryderv/cosseratbench), a suite of tests of rods.

The suite finds it by an entry point of an installed package, here in TOML:

    [project.entry-points."cosseratbench.solvers"]
    guidewire = "guidewire.rod_suite:GuidewireSolver"
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from cosseratbench.solver import Capability, Diverged
from cosseratbench.trajectory import Trajectory

from guidewire.sessions.session import Session, SessionError

_UNIT = 1e-3  # m
_STEP = 5e-3  # s, at most
_CAPABILITIES = ("STRETCH", "SHEAR", "CYLINDER_CONTACT", "PLANE_CONTACT")
_START = {"free": "free", "pinned": "held", "clamped": "clamped"}


class GuidewireSolver:
    """One rod at a time, without contact of rods with each other or with themselves; cylinders have no end.

    Parameters
    ----------
    time_step_scale : factor on the longest time step.
    """

    name = "guidewire"
    capabilities = frozenset(Capability[name] for name in _CAPABILITIES if name in Capability.__members__)

    def __init__(self, time_step_scale: float = 1.0) -> None:
        self._step = _STEP * time_step_scale

    def settings(self, scenario: Any, *, n_elements: int, n_frames: int) -> dict[str, Any]:
        """Return the numerical settings of a run, as JSON values."""
        steps, step = self._steps(scenario, n_frames)
        walls = bool(getattr(scenario, "obstacles", ()))
        return {"integrator": "implicitEuler" if walls else "esdirk3", "timeStep": step, "stepsPerFrame": steps,
                "massDamping": 2.0 * scenario.slowest_frequency() if scenario.quasi_static else 0.0}

    def run(self, scenario: Any, *, n_elements: int, n_frames: int) -> Trajectory:
        """Simulate a scenario of the suite; its frames are evenly spaced from 0 to its duration.

        Raises
        ------
        NotImplementedError : the scenario asks for what this program does not have.
        cosseratbench.solver.Diverged : the run did not come to its end.
        """
        if len(scenario.rods) != 1:
            raise NotImplementedError("more than one rod")
        rod, numerics = scenario.rods[0], self.settings(scenario, n_elements=n_elements, n_frames=n_frames)
        steps = numerics.pop("stepsPerFrame")
        nodes = np.asarray(rod.nodes(n_elements), dtype=float)
        with tempfile.TemporaryDirectory() as folder:
            parameters = {
                "solver": "direct", "metresPerUnit": _UNIT, "guidewireLength": rod.length / _UNIT,
                "numberRodElements": n_elements, "wireRadius": rod.radius, "gravity": list(scenario.gravity),
                "youngsModulus": rod.material.youngs_modulus, "shearModulus": rod.material.shear_modulus,
                "density": rod.material.density, "start": {"positions": nodes / _UNIT}, "deltaThreshold": 0.0,
                "proximalEnd": _START[rod.start.value], "pointLoads": _loads(rod), **numerics,
                "obstacles": [_obstacle(wall, rod) for wall in getattr(scenario, "obstacles", ())],
                "maxSimulationSteps": steps * (n_frames - 1), **_ends(rod, nodes, Path(folder)),
            }
            try:
                with Session(**parameters) as session:
                    frames = session.record(n_frames - 1, steps)
            except SessionError as error:
                raise NotImplementedError(str(error)) from error
        if len(frames.times) < n_frames:
            raise Diverged(frames.reason, time=float(frames.times[-1]))
        across, side = frames.directors[0, 0, :2], np.asarray(rod.normal, dtype=float)
        # The suite's line on the surface begins at the rod's normal: by this angle from d1, for all elements alike.
        angle = math.atan2(float(across[1] @ side), float(across[0] @ side))
        line = math.cos(angle) * frames.directors[:, :, 0] + math.sin(angle) * frames.directors[:, :, 1]
        return Trajectory(np.linspace(0.0, scenario.duration, n_frames), (_UNIT * frames.positions,), (line,))

    def _steps(self, scenario: Any, n_frames: int) -> tuple[int, float]:
        interval = scenario.duration / (n_frames - 1)
        steps = math.ceil(interval / self._step)
        return steps, interval / steps


def _loads(rod: Any) -> list[dict[str, Any]]:
    ends = {"start": 0.0, "end": rod.length / _UNIT}
    return [{"at": ends[load.at.value], "force": list(load.force)} for load in rod.loads]


def _ends(rod: Any, nodes: np.ndarray, folder: Path) -> dict[str, Any]:
    keys: dict[str, Any] = {"distalEnd": _START[rod.end.value]}
    first, last = (getattr(rod, name, None) for name in ("start_motion", "end_motion"))
    if first is not None:
        if first.slides_along is not None:
            raise NotImplementedError("a first end that slides")
        keys["proximalMotionFile"] = _table(folder / "first.csv", first)
    if last is not None:
        keys["distalMotionFile"] = _table(folder / "last.csv", last)
        if last.slides_along is not None:
            along = (nodes[-1] - nodes[-2]) / np.linalg.norm(nodes[-1] - nodes[-2])
            if abs(along @ np.asarray(last.slides_along)) < (1.0 - 1e-5) * np.linalg.norm(last.slides_along):
                raise NotImplementedError("an end that slides aside")
            keys["distalEnd"] = "sliding"
    return keys


def _table(file: Path, motion: Any) -> str:
    np.savetxt(file, np.column_stack([motion.times, motion.displacement, motion.rotation]), delimiter=",", fmt="%.17g")
    return str(file)


def _obstacle(wall: Any, rod: Any) -> dict[str, Any]:
    friction = max(getattr(wall, "friction", 0.0), getattr(rod, "friction", 0.0))
    kind = type(wall).__name__
    if kind == "Cylinder":
        return {"shape": "cylinder", "point": _units(wall.center), "axis": list(wall.axis),
                "radius": wall.radius / _UNIT, "frictionCoefficient": friction}
    if kind == "Plane":
        return {"shape": "plane", "point": _units(wall.point), "normal": list(wall.normal),
                "frictionCoefficient": friction}
    raise NotImplementedError(f"an obstacle that is a {kind}")


def _units(point: Iterable[float]) -> list[float]:
    return [x / _UNIT for x in point]
