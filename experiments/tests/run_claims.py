"""What a run of a random parameter file is held to: its files are whole, and its outcome is true by its own numbers."""

from __future__ import annotations

import json
import math
import re
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from experiments.campaigns.push_claims import contradictions
from guidewire.runs.runner import Answer, Request, Runner

RUN_LIMIT = 20.0  # s of wall time; the costliest scenes drawn take some 0.1 s alone
ENDINGS = {"converged": 0, "finished": 0, "diverged": 4, "failed": 5}
GAINS = "pbd"
SUMMARY_KEYS = {
    "outcome", "reason", "reliable", "steps", "inGameTime", "computationTime", "setUpTime", "wallTime",
    "averageStepTime", "medianStepTime", "predictionError", "steadyStateStep", "stiffness", "passages",
    "maxPenetration", "driveAsked",
    "driveShortfall", "hub", "largestContactForce", "largestWallForce",
    "wallForces", "extremes", "timed", "repeat", "warnings", "ignored", "notes", "log", "versions", "parameterHash",
    "complete", "reliable",
}
# What need not apply: null there is no number that got lost.
MAY_BE_NULL = {
    "coreShare", "coreStrain", "coreStrainInstrument", "coreStrainPlace", "coreStrainTime", "keptCurvature",
    "keptPlace", "materialLoss", "forceError", "slippedFrom", "axialForceTime", "axialForceDrag", "drag",
    "axialTorqueTime", "elementForceTime", "driveAsked", "hub", "lengthInBody", "spheresInBody", "repeat",
    "largestError", "timeStepError", "stableSubstep", "energy", "equilibriumResidual", "smallestEigenvalue",
    "proximalForce", "proximalMoment", "distalForce", "distalMoment", "wallIterations", "halvedSteps",
    "contactDistance", "contactStiffness", "extremes", "axialForce", "axialTorque", "elementForce", "wallPressure",
    "strandForce", "strandForceTime", "wallDisplacement", "wallWork", "frictionPower", "frictionWork",
}
FORCES = {"largestContactForce", "largestWallForce"}    # impulses over timeStep
WALL_TIMES = ("computationTime", "setUpTime", "wallTime", "averageStepTime", "medianStepTime", "elapsedMilliseconds")


class Campaign:
    """Runs scenes one after another in one process, each within a limit; results last until the next run there."""

    def __init__(self, command: Sequence[str], folder: Path, limit: float = RUN_LIMIT) -> None:
        self._limit = limit
        self._folder = folder
        self._runner = Runner(command)

    def run(self, scene: Mapping[str, Any] | str, overrides: Mapping[str, Any] | None = None) -> tuple[Answer, Path]:
        """The answer to a scene, or to a text that stands for one, and the folder of the run."""
        path = self._folder / "scene.json"
        if isinstance(scene, str):
            path.write_text(scene, encoding="utf-8")
        else:
            path.write_text(json.dumps(self._with_start_file(scene)), encoding="utf-8")
        return self._make(path, "run", dict(overrides or {}))

    def repeat(self, out: Path) -> tuple[Answer, Path]:
        """The run that another run's parameters.json asks for."""
        return self._make(out / "parameters.json", "again", {})

    def close(self) -> None:
        self._runner.close()

    def _with_start_file(self, scene: Mapping[str, Any]) -> dict:
        start = scene.get("startFile")
        if not isinstance(start, dict):
            return dict(scene)
        path = self._folder / "start.json"
        path.write_text(json.dumps(start), encoding="utf-8")
        return {**scene, "startFile": str(path)}

    def _make(self, parameters: Path, name: str, overrides: dict[str, Any]) -> tuple[Answer, Path]:
        out = self._folder / name
        shutil.rmtree(out, ignore_errors=True)
        answer = self._runner.run(Request(name, parameters, out, overrides), self._limit)
        if "time limit" in answer.message:
            raise AssertionError(answer.message)
        return answer, out


def refuse_constant(word: str) -> None:
    raise ValueError(f"{word} is no JSON")


def read_strictly(path: Path) -> dict:
    return json.loads(path.read_text(encoding="utf-8"), parse_constant=refuse_constant)


def assert_refused(answer: Answer, out: Path, *words: str) -> None:
    """Exit code 2, one line that holds these words, and nothing written."""
    assert (answer.exit_code, answer.outcome) == (2, None), answer
    assert "\n" not in answer.message and "\r" not in answer.message
    for word in words:
        assert word in answer.message
    assert not out.exists()


def assert_true_outcome(answer: Answer, out: Path, own_keys: set[str]) -> dict:
    """Raise AssertionError unless the run's files are whole and agree with its outcome; returns its summary.

    Parameters
    ----------
    own_keys : all keys that the run's method takes.
    """
    assert answer.exit_code == ENDINGS.get(answer.outcome), answer
    assert answer.message.strip() and "\n" not in answer.message
    summary, parameters = read_strictly(out / "summary.json"), read_strictly(out / "parameters.json")
    has_material = parameters["solver"] != GAINS
    coaxial = {"catheters", "hubs"} if parameters.get("catheters") else set()
    assert summary.keys() == SUMMARY_KEYS | ({"solver"} if has_material else set()) | coaxial
    assert parameters.keys() == own_keys | {"formatVersion"}
    assert (summary["outcome"], summary["reason"]) == (answer.outcome, answer.message)
    assert contradictions(summary) == []
    assert summary["complete"] is True and summary["stiffness"] == ("material" if has_material else "gains")
    assert 0 <= summary["steps"] <= parameters["maxSimulationSteps"]
    time = summary["steps"] * parameters["timeStep"]
    if math.isinf(time):
        assert summary["inGameTime"] is None
    else:
        assert math.isclose(summary["inGameTime"], time, rel_tol=1e-9)
    assert sorted(path.name for path in out.iterdir()) == ["parameters.json", "positions.json", "summary.json"]
    log = read_strictly(out / "positions.json")
    if answer.outcome == "failed":
        assert has_material
    elif answer.outcome == "diverged":
        assert summary["steps"] > 0
        if not has_material:
            assert_lost(log, summary, parameters)
    else:
        beyond = FORCES if parameters["timeStep"] < 1e-100 else set()
        if abs(parameters["displacement"]) > 1e150:    # whose square overflows
            beyond = beyond | {"driveShortfall"}
        assert_numbers_are_finite(log, summary, beyond)
        assert_motion(log, summary, parameters)
        if has_material and parameters["initialState"] == "equilibrium":
            assert_rest_shape(summary, parameters)
    return summary


def assert_numbers_are_finite(log: dict, summary: dict, beyond: set[str]) -> None:
    """beyond : what may be larger than a double holds."""
    assert not list(_not_finite("log", log)), "a value of the log is not finite"
    assert {path.rsplit(".", 1)[-1] for path in _not_finite("summary", summary)} <= MAY_BE_NULL | beyond
    if "solver" in summary and summary["solver"]["keptSolutions"] + summary["solver"]["factorisations"] > 0:
        assert all(summary["solver"][name] >= 0 for name in ("searches", "equilibriumIterations"))


def _not_finite(path: str, value: Any):
    if isinstance(value, (dict, list)):
        for name, item in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _not_finite(f"{path}.{name}", item)
    elif value in (None, "NaN", "Infinity", "-Infinity") or (isinstance(value, float) and not math.isfinite(value)):
        yield path


def assert_motion(log: dict, summary: dict, parameters: dict) -> None:
    """A run that came to an end: its steps, its steady state, its held end."""
    steps, outcome = summary["steps"], summary["outcome"]
    logged = [int(step) for step in log]
    assert logged[0] == 0 and logged[-1] == steps, "the log does not hold the run's first and last step"
    assert all(step % parameters["logEvery"] == 0 for step in logged[:-1])
    is_rest_shape = parameters.get("initialState") == "equilibrium" and parameters["maxSimulationSteps"] == 0
    if outcome == "finished":
        assert steps == parameters["maxSimulationSteps"] and not is_rest_shape
    elif not is_rest_shape:
        assert_rest(log, summary, parameters)
    assert summary["predictionError"] == log[str(steps)]["delta"]
    if parameters["logOrientations"]:
        turns = np.array([[list(q.values()) for q in log[str(k)]["orientation"].values()] for k in (0, steps)])
        assert np.allclose(np.linalg.norm(turns, axis=-1), 1.0, rtol=0.0, atol=1e-9)
    if parameters["logSpheres"] == "last":
        return
    positions = positions_of(log)
    assert positions.shape[1] == parameters["numberRodElements"] + 1
    # Between walls a material's first sphere goes to its place in the first step, with direct on a stiff spring.
    is_placed = parameters["solver"] == GAINS or not (parameters.get("vessel") or parameters.get("obstacles"))
    if parameters["drive"] == "hold" and parameters["proximalEnd"] != "free" and is_placed:
        assert np.all(positions[:, 0] == positions[0, 0]), "a held end moved"
    if outcome == "converged" and parameters["solver"] == GAINS:
        assert strains_of(positions[-1], parameters).max() <= 0.2, "at rest with elements of the wrong length"


def assert_rest(log: dict, summary: dict, parameters: dict) -> None:
    """A steady state: the last steps of gains were small ones; a material is near its rest shape and hardly swings."""
    if parameters["solver"] == GAINS:
        first = summary["steadyStateStep"]
        assert 0 < first == summary["steps"] - parameters["steadyStateHold"] + 1
        assert all(log[step]["delta"] < parameters["deltaThreshold"] for step in log if int(step) >= first)
        return
    measured = re.fullmatch(r"the wire is at rest: (\S+) units from its rest shape, swinging by (\S+); "
                            r"deltaThreshold = (\S+) units(, but .*)?", summary["reason"])
    assert measured, summary["reason"]
    distance, swing, threshold = map(float, measured.groups()[:3])
    assert math.isclose(threshold, parameters["deltaThreshold"], rel_tol=1e-2)
    assert max(distance, swing) <= threshold


def assert_rest_shape(summary: dict, parameters: dict) -> None:
    """A rest shape that was found: stable, and balanced."""
    solver = summary["solver"]
    assert solver["equilibriumIterations"] > 0 and solver["equilibriumResidual"] is not None
    assert solver["smallestEigenvalue"] is not None
    if (parameters["solver"] != "direct" or parameters["maxSimulationSteps"] > 0 or parameters["wireSections"]
            or parameters["loadTables"] or any(parameters["tipFollowerForce"]) or parameters["catheters"]):
        return
    # The supports carry the whole wire's weight and all loads.
    metres = parameters["metresPerUnit"]
    length = parameters["guidewireLength"] * metres
    mass = parameters["density"] * math.pi * (parameters["wireRadius"]**2 - parameters["innerRadius"]**2) * length
    loads = [mass * np.array(parameters["gravity"]), length * np.array(parameters["distributedForce"]),
             *(_vector(load["force"]) for load in parameters["pointLoads"] or ())]
    if parameters["tipForceReleaseTime"] >= 0.0:
        loads.append(np.array(parameters["tipForce"]))
    if parameters["drive"] == "force":
        loads.append(np.array(parameters["externalForce"]))
    supports = [np.array(solver["proximalForce"]), np.array(solver["distalForce"])]
    scale = sum(np.linalg.norm(force) for force in loads + supports) + bend_force(parameters)
    free_axis = parameters["distalEnd"] == "sliding"
    if not free_axis:
        assert np.linalg.norm(sum(loads + supports)) <= 1e-5 * scale, "a rest shape out of balance"


def _vector(given: list | dict) -> np.ndarray:
    """A vector of a parameter file, which may be an object of x, y and z."""
    return np.array([given[axis] for axis in "xyz"] if isinstance(given, dict) else given, float)


def bend_force(parameters: dict) -> float:
    """EI/L^2, N."""
    length = parameters["guidewireLength"] * parameters["metresPerUnit"]
    return parameters["youngsModulus"] * 0.25 * math.pi * parameters["wireRadius"]**4 / length**2


def assert_lost(log: dict, summary: dict, parameters: dict) -> None:
    """What the word diverged means of pbd; what the log does not hold is taken as true."""
    if str(summary["steps"]) not in log:    # a state that is not finite is not logged
        assert "finite" in summary["reason"], summary["reason"]
        return
    assert not list(_not_finite("log", log)), "a value of the log is not finite"
    positions = positions_of(log)
    with np.errstate(over="ignore"):
        distances = np.linalg.norm(positions - positions[0, 0], axis=-1)
    if (distances.max() > 10.0 * parameters["guidewireLength"] or parameters["logSpheres"] == "last"
            or parameters["logEvery"] > 1):
        return
    assert len(log) > 200 and strains_of(positions[-200:], parameters).max() > 0.2


def positions_of(log: dict) -> np.ndarray:
    """Positions in units, shape (entries, spheres, 3)."""
    return np.array([[[s["x"], s["y"], s["z"]] for s in entry["sphere"].values()] for entry in log.values()])


def strains_of(positions: np.ndarray, parameters: dict) -> np.ndarray:
    """|element length/l - 1| of every element; positions have shape (..., n + 1, 3)."""
    with np.errstate(over="ignore"):  # of a wire that was lost
        lengths = np.linalg.norm(np.diff(positions, axis=-2), axis=-1)
    return np.abs(lengths * parameters["numberRodElements"] / parameters["guidewireLength"] - 1.0)


def without_wall_times(value: Any) -> Any:
    """A log or summary without what the clock says."""
    if isinstance(value, dict):
        return {name: without_wall_times(item) for name, item in value.items() if name not in WALL_TIMES}
    return value
