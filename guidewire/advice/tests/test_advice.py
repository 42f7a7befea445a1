"""Advice: its file meets the error that was asked for, against a finer run of another kind, and nothing cheaper does.

Costs are counts here, which are the same on every machine.
"""

from __future__ import annotations

import json
import math
import os
from pathlib import Path

import numpy as np
import pytest

from guidewire.advice import plan, report, trials
from guidewire.advice.plan import Advice, Tried, AdviceRequest, choose
from guidewire.advice.trials import Trial
from guidewire.commands.commands import parse
from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import read_runs
from guidewire.studies.table import Grid, Study
from guidewire.sweeps.check import replay
from guidewire.sweeps.sweep import Means, sweep
from tools.testing import FULL_CAMPAIGNS

CANTILEVER = {
    "solver": "direct", "guidewireLength": 300.0, "numberRodElements": 16, "wireRadius": 0.0005,
    "proximalEnd": "clamped", "gravity": [0, -9.81, 0], "timeStep": 0.002, "deltaThreshold": 0,
    "maxSimulationSteps": 48,
}
ON_PLANE = {
    **CANTILEVER, "integrator": "implicitEuler", "wireRadius": 0.0003, "massDamping": 35, "timeStep": 0.004,
    "vessel": {"shape": "plane", "point": [0, -20.3, 0], "normal": [0, 1, 0], "frictionCoefficient": 0.2},
}
IN_VESSEL = {
    "drive": "push", "displacementPerStep": 2.0, "guidewireLength": 100.0, "numberRodElements": 16, "timeStep": 0.01,
    "guidewireOffset": -105, "constraintSolverSteps": 64, "bendStiffness": 0.1, "stretchStiffness": 0.1,
    "sphereRadius": 5.0, "collisionStiffness": 0.1, "damping": 0.1, "deltaThreshold": 0, "maxSimulationSteps": 40,
    "vessel": {"shape": "tube", "radius": 8, "openStart": True, "openEnd": True,
               "knots": [[0, 0, -200], [0, 0, 0], [0, 20, 40], [0, 60, 60], [0, 200, 60]]},
}
FINER = {  # than advice's own reference, and of another kind
    "cantilever": {"integrator": "esdirk3", "timeStep": 0.00025, "maxSimulationSteps": 384, "numberRodElements": 64},
    "on-plane": {"timeStep": 0.000125, "maxSimulationSteps": 1536, "numberRodElements": 48},
    "in-vessel": {"constraintSolverSteps": 1024, "stretchStiffness": 0.00625, "bendStiffness": 0.00625,
                  "collisionStiffness": 0.00625},
}
SCENES = {"cantilever": (CANTILEVER, 0.01), "on-plane": (ON_PLANE, 0.03), "in-vessel": (IN_VESSEL, 0.035)}
MADE = SCENES if FULL_CAMPAIGNS in os.environ else ("in-vessel",)


class Advised:
    """What was advised for a scene, and runs of it."""

    def __init__(self, folder: Path, command: list[str], name: str) -> None:
        scene, self.error = SCENES[name]
        self.file = folder / f"{name}.json"
        self.file.write_text(json.dumps(scene), encoding="utf-8")
        self._out, self._command = folder, command
        self.wish = AdviceRequest(self.error)
        check = plan.check_of(self.file, self.wish, plan.by_work, repeats=0)
        assert sweep([(check, folder)], folder / "runs", Means(command)).failures == []
        self.advice: Advice = replay(check, folder)
        self.runs = read_runs(folder / name)

    def wire(self, name: str, overrides: dict) -> np.ndarray:
        """Places of a run of a file of ours, laid over with some values."""
        study = Study(f"own-{name}", "", str(self._out / f"{name}.json"), Grid(common=overrides))
        assert sweep([(study, self._out)], self._out / "runs", Means(self._command)).failures == []
        return places(read_runs(self._out / study.name)["default"].folder)


def places(folder: Path) -> np.ndarray:
    """Nine points along a wire at seven times from start to end, steps of which the longest trial has too."""
    log = read_log(folder, spheres="all")
    times = np.linspace(0.0, log.time[-1], 7)
    arc, nodes = np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, log.positions.shape[1])
    along = np.array([[np.interp(arc, nodes, x) for x in entry.T] for entry in log.positions])  # (steps, 3, 9)
    return np.array([[np.interp(times, log.time, along[:, axis, k]) for k in range(9)] for axis in range(3)])


@pytest.fixture(scope="module", params=MADE)
def advised(request, tmp_path_factory, runner_command) -> Advised:
    return Advised(tmp_path_factory.mktemp(request.param), runner_command, request.param)


def distance(wire: np.ndarray, exact: np.ndarray) -> float:
    return float(np.sqrt(np.mean((wire - exact) ** 2) / np.mean((exact - exact[:, :, :1]) ** 2)))


def test_what_is_advised_meets_the_error_against_a_finer_run(advised: Advised) -> None:
    """The reference has converged (the finer run is near it), and the file that is written runs and is as near."""
    exact = advised.wire(advised.file.stem, FINER[advised.file.stem])
    own = places(advised.runs["reference"].folder)
    assert distance(own, exact) < 0.25 * advised.error
    assert advised.advice.reference_error < 0.5 * advised.error
    folder = advised.file.parent
    text = report.parameters(advised.advice, json.loads(advised.file.read_text()), folder)
    (folder / f"taken-{advised.file.stem}.json").write_text(text)
    assert distance(advised.wire(f"taken-{advised.file.stem}", {}), exact) < 1.3 * advised.error
    markdown = report.as_markdown(advised.file.name, advised.wish, advised.advice)
    assert f"**{advised.advice.taken.trial.name}**" in markdown
    assert all(part.trial.name in markdown for part in advised.advice.parts)


def test_no_setting_that_needs_less_work_meets_the_error(advised: Advised) -> None:
    """By the runs themselves, measured anew."""
    exact = places(advised.runs["reference"].folder)
    taken = advised.advice.taken
    found = {one.trial.name: one for one in advised.advice.searched}
    assert taken.work < advised.advice.scene.work
    cheaper = [key for key, run in advised.runs.items() if key.startswith("candidate-")
               and trials.work(run.parameters, run.summary) < taken.work]
    assert len(cheaper) >= 3
    for key in cheaper:
        run = advised.runs[key]
        if run.outcome != "diverged" and run.measured("passages") == 0:
            assert distance(places(run.folder), exact) > 0.8 * advised.error, key
    assert len(found) == len(advised.advice.searched)


def tried(error: float, total: float, step: float = 1.0) -> Tried:
    return Tried(Trial("", {}), error, 0.0, "finished", total, step, total, 0.0, {})


def test_the_choice_is_the_cheapest_that_meets_the_error_or_the_best_within_the_budget() -> None:
    random = np.random.default_rng(3)
    for _ in range(200):
        searched = [tried(*values) for values in random.uniform(0.0, 1.0, (6, 3))]
        searched.append(tried(math.nan, 0.0, 0.0))  # was lost
        met = [one for one in searched if one.error <= 0.4]
        assert choose(searched, AdviceRequest(0.4)) is (min(met, key=lambda one: one.total) if met else None)
        within = [one for one in searched[:-1] if one.step <= 0.3]
        assert choose(searched, AdviceRequest(budget=0.3)) is (min(within, key=lambda one: one.error) if within
                                                               else None)


def test_longer_steps_make_the_same_motion_of_the_drive() -> None:
    scene = {"timeStep": 0.01, "maxSimulationSteps": 40, "displacementPerStep": 0.5, "twistPerStep": 0.02,
             "damping": 0.1}
    changed = trials._stepped(scene, 4.0)
    assert changed == {"timeStep": 0.04, "maxSimulationSteps": 10, "displacementPerStep": 2.0, "twistPerStep": 0.08,
                       "damping": pytest.approx(1.0 - 0.9**4)}
    assert trials._stepped(scene, 3.0) is None and trials._stepped(scene, 16.0) is None


def test_parts_are_those_that_the_scene_has() -> None:
    bare = {"solver": "direct", "numberRodElements": 8, "timeStep": 0.1, "maxSimulationSteps": 10, "shearModulus": 2.0,
            "shearFactor": 0.9, "massDamping": 0.0, "gravity": [0.0, 0.0, 0.0], "massRule": "consistent"}
    names = {trial.name for trial in trials.parts(bare)}
    assert names == {"rod elements n, halved", "time step, doubled", "twist and shear stiffness, halved",
                     "shear, left out", "consistent mass, left out"}
    rough = {"shape": "plane", "frictionCoefficient": 0.3}
    more = {**bare, "massDamping": 1.0, "vessel": rough, "wireSections": [{"from": 0, "to": 1, "numberRodElements": 4}]}
    changed = {trial.name: trial.changed for trial in trials.parts(more)}
    assert changed["friction, left out"] == {"vessel": {"shape": "plane", "frictionCoefficient": 0.0}}
    assert "walls that give way, as rigid ones" not in changed
    assert changed["local element size, left out"] == {"wireSections": []}
    assert "rod elements n, halved" not in changed and changed["drag, left out"] == {"massDamping": 0.0}


def test_soft_walls_are_tried_as_rigid_ones() -> None:
    soft = {"shape": "mesh", "wallStiffness": 1e5, "softLimit": 1e-4, "relaxationTime": 0.1,
            "regions": [{"branch": "a", "wallStiffness": 1e4}]}
    scene = {"solver": "direct", "numberRodElements": 8, "timeStep": 0.1, "maxSimulationSteps": 10, "shearModulus": 2.0,
             "shearFactor": 0.9, "massDamping": 0.0, "gravity": [0.0, 0.0, 0.0], "vessel": soft,
             "obstacles": [{"shape": "sphere", "wallStiffness": 1e5, "frictionCoefficient": 0.1}]}
    changed = {trial.name: trial.changed for trial in trials.parts(scene)}
    assert changed["walls that give way, as rigid ones"] == {
        "vessel": {"shape": "mesh"}, "obstacles": [{"shape": "sphere", "frictionCoefficient": 0.1}]}
    delay = changed["delay of walls that give way, left out"]["vessel"]
    assert delay == {**soft, "relaxationTime": 0.0}


def test_elements_of_a_catheter_change_with_those_of_the_wire() -> None:
    """Its elements carry the overlap: a reference that has as many as the file says nothing of their error."""
    scene = {"solver": "direct", "integrator": "esdirk3", "numberRodElements": 28, "timeStep": 0.01,
             "shearModulus": 2.0, "shearFactor": 0.9, "maxSimulationSteps": 96,
             "catheters": [{"start": 1.0, "elements": 25, "lumenFriction": 0.1}]}
    for trial, n, m in zip(trials.references(scene), (56, 28, 42), (50, 25, 37)):
        assert trial.changed["numberRodElements"] == n
        assert trial.changed["catheters"] == [{"start": 1.0, "elements": m, "lumenFriction": 0.1}]
        assert f"n = {n}, of the catheter {m}, dt" in trial.name
    tried = {(one["numberRodElements"], one["catheters"][0]["elements"])
             for one in ({**scene, **trial.changed} for trial in trials.candidates(scene))}
    assert tried == {(7, 6), (14, 12), (28, 25), (56, 50)}
    changed = {trial.name: trial.changed for trial in trials.parts(scene)}
    assert changed["catheters, left out"] == {"catheters": []}
    assert changed["friction, left out"] == {"catheters": [{"start": 1.0, "elements": 25, "lumenFriction": 0.0}]}
    few = {**scene, "catheters": [{"elements": 7}]}
    assert all(trial.changed.get("catheters", few["catheters"])[0]["elements"] >= 4 for trial in trials.candidates(few))
    own = {**scene, "catheters": [{"elements": 25, "wireSections": [{"numberRodElements": 5}]}]}
    assert all("numberRodElements" not in trial.changed for trial in (*trials.candidates(own), *trials.references(own)))


@pytest.mark.parametrize("words, said", [
    (["advise", "scene.json"], "one of the arguments --error --budget is required"),
    (["advise", "scene.json", "--error", "0.1", "--budget", "1"], "not allowed with argument"),
    (["advise", "scene.json", "--error", "-1"], "is not a number above 0"),
])
def test_a_wish_that_cannot_be_met_is_one_line(words, said, capsys) -> None:
    with pytest.raises(SystemExit) as ended:
        parse(words)
    line = capsys.readouterr().err
    assert ended.value.code == 2 and said in line and line.count("\n") == 1


def test_a_scene_where_nothing_moves_is_reported(tmp_path: Path, runner_command: list[str]) -> None:
    file = tmp_path / "still.json"
    file.write_text(json.dumps({**CANTILEVER, "gravity": [0, 0, 0], "maxSimulationSteps": 8}), encoding="utf-8")
    check = plan.check_of(file, AdviceRequest(0.1), plan.by_work, repeats=0)
    with pytest.raises(LogError, match="nothing moves in the scene"):
        sweep([(check, tmp_path)], tmp_path / "runs", Means(runner_command))
