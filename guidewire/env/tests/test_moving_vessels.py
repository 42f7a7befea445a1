"""The task in a tree that beats: distances, targets and observations of the moved vessel, and sessions that go on."""

from dataclasses import replace

import numpy as np
import pytest

from guidewire.anatomy.motion import motion_of
from guidewire.env import Environment
from guidewire.env.observation import Observation
from guidewire.env.route import Route
from guidewire.env.task import find_task

pytest.importorskip("scipy")
PACE = {"vessel.motion.heartRate": 80.0, "vessel.motion.phase": 0.3}


def test_distances_and_the_beat_are_those_of_the_moved_vessel():
    """As the core has them, whose target is the end itself."""
    task = replace(find_task("coronary"), targets=(4,))
    seen = Observation(parts=("tip", "distance", "target", "beat"))
    moved = []
    with Environment(task, observation=seen, drive={"step_time": 0.07}, render_mode="rgb_array") as own:
        own.reset(options={"nominal": True, "insertion": [0.04, 0.02], **PACE})
        rest, first = own.target_position.copy(), own.render()[:, 360:]
        corners = own.session.walls()[0].vertices
        for k in range(14):
            observation = own.step([1.0, 0.0, 1.0, 0.0])[0]
            state = own.session_state
            places = [state.place, *(one.place for one in state.catheters)]
            np.testing.assert_allclose(observation["distance"], [one.left for one in places], atol=0.6)
            angle = 2.0 * np.pi * (0.3 + state.time * 80.0 / 60.0)
            np.testing.assert_allclose(observation["beat"], [np.cos(angle), np.sin(angle)], atol=1e-6)
            np.testing.assert_allclose(observation["tip"][0] + observation["target"], own.target_position, atol=1e-4)
            moved.append(np.linalg.norm(own.target_position - rest))
        pictures = [first, own.render()[:, 360:]]
        where = [np.argwhere((one == (255, 80, 80)).all(axis=2)).mean(axis=0) for one in pictures]
        x, y, z = own.target_position - rest
        up, pixel = np.cos(np.radians(25.0)) * z - np.sin(np.radians(25.0)) * x, np.linalg.norm(np.ptp(corners, axis=0))
        np.testing.assert_allclose(where[1] - where[0], 0.92 * 360.0 / pixel * np.array([-up, y]), atol=1.5)
        walls = [(one[..., 0].astype(int) - one[..., 1] > 15) & (one[..., 0] < 130) for one in pictures]
        assert (walls[0] ^ walls[1]).sum() > 0.2 * walls[0].sum()
    assert max(moved) > 5.0


def test_a_session_that_takes_another_pace_has_the_bits_of_a_new_one():
    draws = [{**PACE, "friction": 0.05, "insertion": [0.02, 0.0]}, {"vessel.motion.heartRate": 60.0},
             {"anatomy": 3}, PACE]

    def end_of(own, draw):
        own.reset(seed=5, options={"nominal": True, **draw})
        return np.concatenate([np.ravel(part) for part in own.step([1.0, 0.5, 1.0, 0.0])[0].values()])

    task = find_task("coronary-test")
    with Environment(task) as own:
        reused = [end_of(own, draw) for draw in draws]
    for draw, expected in zip(draws, reused):
        with Environment(task) as own:
            np.testing.assert_array_equal(end_of(own, draw), expected)


def test_the_table_of_a_motion_follows_the_shape_of_its_vessel():
    """Its curve is as far from the centreline of anatomy.json as before, 0.3 mm of 2 mm by which that is moved."""
    apart, lines = [], []
    for task, anatomy in (("coronary", 0), ("coronary-test", 5)):
        with Environment(task) as own:
            own.reset(options={"nominal": True, "anatomy": anatomy})
            lines.append(Route(own._scene.anatomy, 4).points)
            rest = motion_of(own.session.parameters)._rest
            apart.append(np.linalg.norm(lines[-1] - rest[:, None], axis=2).min(axis=1))
    assert np.abs(lines[1] - lines[0]).max() > 1.5 and np.abs(apart[1] - apart[0]).max() < 0.3
