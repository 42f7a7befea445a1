"""Vessels and tasks of stEVE (Karstensen et al.) here: its meshes and branches, two devices, its names.

`guidewire.py anatomy FILE --open` makes a folder of a mesh of stEVE_bench. `task_of` makes a task of that, with targets
on the branches that files of centrelines (3D Slicer's) say. `SteveEnvironment` has stEVE's actions,
mm/s and rad/s of each device, and its observations "position", "target" and "action".
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.environment import Environment
from guidewire.env.observation import Observation
from guidewire.env.spaces import Box, Dict, Env, Error, InvalidAction
from guidewire.env.task import Task

VELOCITY = (35.0, 3.14)  # largest, mm/s and rad/s, of DualDeviceNav
FRICTION, THRESHOLD = 0.001, 5.0  # of its simulation; of its targets, mm
STEP_TIME = 1.0 / 7.5  # s, of its pictures
_POINTS = 3  # of each device that are seen, 6 mm apart
_WIRE, _CATHETER = "workhorse-0.014", "microcatheter-2.4f"
_APART, _NEAR = 10.0, 6.0  # mm: between targets of a branch; from a branch's point to the centreline


def branch_of(file: Path) -> np.ndarray:
    """Points (n, 3) of a curve of 3D Slicer, mm; those of stEVE_bench are in the axes of its files of meshes.

    Raises
    ------
    Error : the file is none.
    """
    try:
        read = json.loads(file.read_text(encoding="utf-8"))
        points = [point["position"] for one in read["markups"] if one["type"] == "Curve"
                  for point in one["controlPoints"]]
        found = np.array(points, dtype=float).reshape(-1, 3)
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise Error(f"{file}: no curve of 3D Slicer ({error})") from error
    return found


def targets_of(anatomy: Mapping[str, Any], branches: Mapping[str, np.ndarray]) -> list[list[Any]]:
    """Places on a vessel's own centreline, as targets of a task, along the branches: every 10 mm of each where one is
    within 6 mm of the centreline.

    Parameters
    ----------
    branches : by name, points (n, 3) in the vessel's axes and unit.
    """
    line = anatomy["centreline"]
    points, of = np.array(line["points"], dtype=float)[:, :3], np.array(line["branches"])
    depths = np.zeros(len(points))
    for number in range(1, of.max() + 1):
        own = np.flatnonzero(of == number)
        depths[own] = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points[own], axis=0), axis=1))]
    found: dict[tuple[str, float], None] = {}
    for curve in branches.values():
        way = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))]
        for at in np.arange(_APART, way[-1], _APART):
            point = np.array([np.interp(at, way, axis) for axis in curve.T])
            away = np.linalg.norm(points - point, axis=1)
            nearest = int(np.argmin(away))
            if away[nearest] < _NEAR:
                found[line["names"][of[nearest] - 1], round(float(depths[nearest]), 2)] = None
    return [list(one) for one in found]


def task_of(folder: Path, branches: Mapping[str, np.ndarray], name: str = "steve", time: float = 60.0,
            length: float = 900.0) -> Task:
    """A task with two devices in a vessel of a folder with vessel, anatomy.json and scene.json.

    Parameters
    ----------
    branches : whose points may be targets, in the vessel's axes and unit.
    time : of an episode, s.
    length : of the devices, mm.

    Raises
    ------
    Error : none of them lies in the vessel.
    """
    anatomy = json.loads((folder / "anatomy.json").read_text(encoding="utf-8"))
    targets = targets_of(anatomy, branches)
    if not targets:
        raise Error(f"{folder}: none of the branches {', '.join(branches)} lies in the vessel")
    over = length - 90.0
    catheter = {"instrument": _CATHETER, "start": 60.0, "length": over, "elements": round(over / 30.0)}
    return Task(name, "two devices in a vessel of stEVE", overrides={
        "timeStep": STEP_TIME, "contactDistance": 0.0002, "guidewireLength": length,
        "numberRodElements": round(length / 20.0), "wireSections": [], "catheters": [catheter]},
        anatomies=(str(folder / "anatomy.json"),), targets=tuple(targets), instruments=(_WIRE,), frictions=(FRICTION,),
        insertion=(0.03, 0.02), time=time, tolerance=THRESHOLD, speed=1e-3 * VELOCITY[0], rotation=VELOCITY[1])


class SteveEnvironment(Env):
    """An environment with the actions and observations of stEVE's DualDeviceNav.

    Parameters
    ----------
    task : with two devices, as of `task_of`.
    normalised : whether actions are fractions of the largest, as with `normalize_action`.
    options : of Environment.

    Notes
    -----
    "position": (3, 2), the wire's last points from the tip in the plane of the picture, mm; "target": (2,), there;
    "action": (2, 2), the last one. Rewards and ends are those of Environment. A hub stops at an open end, as with
    `stop_device_at_tree_end`.
    """

    def __init__(self, task: Task, normalised: bool = False, **options: Any) -> None:
        self._scale = np.ones(2) if normalised else np.array(VELOCITY)
        seen = Observation(parts=("screen", "target", "tip", "action"), points=_POINTS, spacing=1)
        drive = {"step_time": STEP_TIME, "stops_at_ends": True}
        self._own = Environment(task, drive=drive, observation=seen, **options)
        high = np.broadcast_to(self._scale, (2, 2)).astype(np.float32)
        self.action_space = Box(-high, high, dtype=np.float32)
        self.observation_space = Dict({"position": Box(-np.inf, np.inf, (_POINTS, 2), np.float32),
                                       "target": Box(-np.inf, np.inf, (2,), np.float32), "action": self.action_space})
        self._screen = np.array(seen.screen, dtype=float).T

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin an episode, as Environment does."""
        observation, info = self._own.reset(seed=seed, options=options)
        return self._seen(observation), info

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Move both devices: (2, 2), translation and rotation of the wire and then of the catheter."""
        numbers = np.asarray(action, dtype=float)
        if numbers.shape != (2, 2):
            raise InvalidAction(f"action of shape {numbers.shape}: needs shape (2, 2)")
        observation, *rest = self._own.step((numbers / self._scale).ravel())
        return (self._seen(observation), *rest)

    def close(self) -> None:
        """End its session."""
        self._own.close()

    def _seen(self, observation: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        target = (observation["tip"][0] + observation["target"]) @ self._screen
        return {"position": observation["screen"][0], "target": target.astype(np.float32),
                "action": (observation["action"].reshape(2, 2) * self._scale).astype(np.float32)}


def branches_of(files: Sequence[Path]) -> dict[str, np.ndarray]:
    """Return the curves of files by their names."""
    return {file.name.removesuffix(".mrk.json"): branch_of(file) for file in files}
