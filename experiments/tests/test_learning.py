"""A network that learns from the baseline; stEVE's vessels, actions and observations."""

import json
from dataclasses import replace

import numpy as np
import pytest

from experiments.learn_network import learn
from experiments.steve import VELOCITY, SteveEnvironment, branch_of, targets_of, task_of
from guidewire.env import Environment
from guidewire.env.network import features_of, options_of
from guidewire.env.spaces import Error, InvalidAction
from guidewire.env.task import FOLDER
from guidewire.env.tests.environment_cases import tube  # noqa: F401

SIPHON = FOLDER / "vessels" / "siphon-1"


def test_a_network_learns_from_the_baseline_the_same_from_the_same_seed(tube):
    task = replace(tube, tip_turns=1)
    one, curve = learn(task, seed=1, episodes=2, rounds=2, scored=1)
    other, _ = learn(task, seed=1, episodes=2, rounds=2, scored=1)
    for a, b in zip(one.weights, other.weights):
        np.testing.assert_array_equal(a, b)
    assert len(curve) == 2 and curve[1][0] > curve[0][0] and max(row[1] for row in curve) == 1.0
    with Environment(task, **options_of(task)) as own:
        assert features_of(own.reset(seed=1)[0]).shape == (12,)


@pytest.fixture(scope="module")
def curve(tmp_path_factory):
    """A curve of 3D Slicer along the siphon's first branch, 1 mm beside its centreline, as stEVE has one."""
    line = json.loads((SIPHON / "anatomy.json").read_text())["centreline"]
    own = [point[:3] for point, branch in zip(line["points"], line["branches"]) if branch == 1][::3]
    file = tmp_path_factory.mktemp("steve") / "Centerline curve - RCCA.mrk.json"
    points = [{"position": [x + 1.0, y, z]} for x, y, z in own]
    file.write_text(json.dumps({"markups": [{"type": "Curve", "controlPoints": points}]}))
    return file


def test_targets_lie_along_the_branches_of_a_file_of_slicers(curve, tmp_path):
    points = branch_of(curve)
    anatomy = json.loads((SIPHON / "anatomy.json").read_text())
    targets = targets_of(anatomy, {"RCCA": points})
    assert {name for name, _ in targets} == {"branch 1"} and len(targets) == 10    # of 106 mm
    np.testing.assert_allclose(np.diff([depth for _, depth in targets]), 10.0, atol=2.0)
    assert targets_of(anatomy, {"elsewhere": points + 50.0}) == []
    with pytest.raises(Error, match="none of the branches elsewhere lies in the vessel"):
        task_of(SIPHON, {"elsewhere": points + 50.0})
    for text in ("[", "{}", '{"markups": [{"type": "Curve", "controlPoints": [{"position": [1]}]}]}'):
        (tmp_path / "wrong.json").write_text(text)
        with pytest.raises(Error, match="no curve of 3D Slicer"):
            branch_of(tmp_path / "wrong.json")


def test_two_devices_have_steves_actions_and_observations(curve):
    task = task_of(SIPHON, {"RCCA": branch_of(curve)}, length=300.0, time=10.0)
    made = SteveEnvironment(task)
    try:
        observation, info = made.reset(seed=1)
        assert made.observation_space.contains(observation) and made.action_space.shape == (2, 2)
        assert made.action_space.high[0].tolist() == pytest.approx(VELOCITY)
        assert observation["position"].shape == (3, 2) and observation["target"].shape == (2,)
        tip = observation["position"][0]
        action = np.array([[17.5, 1.57], [0.0, -3.14]])
        observation, reward, terminated, truncated, info = made.step(action)
        np.testing.assert_allclose(observation["action"], action, rtol=1e-5)
        assert 0.0 < np.linalg.norm(observation["position"][0] - tip) < 3.0    # 17.5 mm/s for 1/7.5 s
        with pytest.raises(InvalidAction, match="shape"):
            made.step(action.ravel())
    finally:
        made.close()
    normalised = SteveEnvironment(task, normalised=True)
    assert normalised.action_space.high.max() == 1.0
    normalised.close()
