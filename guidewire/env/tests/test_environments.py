"""One environment against Gymnasium's protocol, against itself and against a session; and how it refuses."""

import importlib.util
import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from guidewire.env import Drive, Environment, Observation, RecordedDrive, Reward, VectorEnvironment
from guidewire.env import own_spaces
from guidewire.env.loaded import LoadedScene
from guidewire.env.observation import _in_frame
from guidewire.env.own_spaces import Box, Dict, Discrete, MultiDiscrete
from guidewire.env.route import Placement, Route
from guidewire.env.spaces import ClosedEnvironmentError, Error, InvalidAction, NameNotFound, ResetNeeded
from guidewire.env.task import find_task
from guidewire.env.tests.environment_cases import anatomy_of, environment, same, tube  # noqa: F401
from guidewire.prepare import ROOT
from guidewire.sessions.session import Session

ANATOMY = ROOT / "guidewire" / "env" / "data" / "artery.json"
NOMINAL = {"nominal": True}


def test_reset_and_step_give_what_gymnasium_says_and_end_once(environment):
    observation, info = environment.reset(seed=3)
    assert environment.observation_space.contains(observation) and info["draw"]["friction"] in (0.0, 0.1)
    ended = False
    for k in range(20):
        assert not ended
        observation, reward, terminated, truncated, info = environment.step(environment.action_space.sample())
        assert environment.observation_space.contains(observation)
        assert isinstance(reward, float) and type(terminated) is bool and type(truncated) is bool
        ended = terminated or truncated
        assert ("report" in info) == ended
    report = info["report"]
    assert truncated and report["end"] == "time" and not report["success"] and report["time"] == pytest.approx(2.8)
    assert len(report["forces"]) == 40 and report["largest_force"] == max(report["forces"])    # 20 steps of 2 each
    with pytest.raises(ResetNeeded):
        environment.step(np.zeros(2))


def test_the_same_seed_gives_the_same_bits_and_another_one_another_episode(tube):
    def episode(seed):
        with Environment(tube, drive=Drive(noise=0.1, delay=1)) as own:
            random = np.random.default_rng(0)
            seen = [own.reset(seed=seed)[0]]
            seen += [own.step(random.uniform(-1.0, 1.0, 2))[0] for _ in range(3)]
            return seen, own.reset()[1]["draw"]

    (one, after), (other, after_other) = episode(5), episode(5)
    for a, b in zip(one, other):
        same(a, b)
    assert after == after_other
    assert any(not np.array_equal(a["tip"], b["tip"]) for a, b in zip(one, episode(6)[0]))


def test_an_episode_is_what_a_session_does_with_the_same_motions(environment):
    environment.reset(options=NOMINAL)
    with Session(None, hand=True, **environment.scene) as session:
        for action in ([1.0, 0.5], [-0.25, 1.0], [0.0, -1.0]):
            observation = environment.step(action)[0]
            for _ in range(2):
                state = session.step(push=0.02 * 0.07 * action[0] / 1e-3, turn=np.pi * 0.07 * action[1])
        np.testing.assert_allclose(observation["tip"], state.positions[-1], rtol=0.0, atol=1e-5)
        assert environment.report.inserted == pytest.approx(0.0028)
        assert environment.report.retracted == pytest.approx(0.0007)
        assert observation["hub"][1] == pytest.approx(np.pi * 0.14 * 0.5)


def test_distances_along_the_centreline_are_those_of_the_tube(environment):
    observation, _ = environment.reset(options=NOMINAL)
    # From the tip at z = -2 to the point 92 units along the centreline from z = -70: 92 - 68 = 24, to half a spacing.
    assert observation["distance"][0] == pytest.approx(24.0, abs=1.0)
    # Once the bent tip has found its shape it goes on as the hub does.
    one, other = [environment.step([1.0, 0.0])[0]["distance"][0] for _ in range(3)][1:]
    assert one - other == pytest.approx(2.8, abs=0.3)
    while True:
        _, _, terminated, truncated, info = environment.step([1.0, 0.0])
        if terminated or truncated:
            break
    report = info["report"]
    assert terminated and report["success"] and report["safe_success"] and report["left"] <= 2.0
    # Bent by 20 mm times 20/m = 0.4 rad a straight tip moves 4 mm across, and its end comes back by half a mm.
    assert -0.5 < report["path"] - 1e3 * report["inserted"] < 4.0
    assert np.linalg.norm(environment.session.state.positions[-1] - environment.target_position) < 2.0 + 3.0


def test_a_route_turns_round_at_a_fork():
    #     3 - 4
    # 0 - 1 - 2
    points = [[0, 0, 0], [0, 0, 10], [0, 0, 20], [0, 5, 15], [0, 5, 25]]
    route = Route(anatomy_of(points, 1.0, [1, 1, 2, 3, 3], [-1, 0, 1, 1, 3], [0, 2, 4]), 3)
    assert route.left.tolist() == pytest.approx([20 + 50**0.5, 10 + 50**0.5, 20 + 50**0.5, 10.0, 0.0])
    assert route.place(np.array([0.0, 0.0, 4.0])) == (0, pytest.approx(16 + 50**0.5))
    assert route.ahead(2, 15.0).tolist() == [0, 5, 15]
    for wrong in (4, "end 9", ["branch 9", 0.0], ["branch 1", 99.0]):
        with pytest.raises(Error, match="is not allowed"):
            Route(anatomy_of(points, 1.0, [1, 1, 2, 3, 3], [-1, 0, 1, 1, 3], [0, 2, 4]), wrong)


def test_a_route_lies_where_the_scene_places_its_vessel():
    """Against the centreline that the core has placed: scaled, turned about three axes and moved."""
    mesh = {"shape": "mesh", "file": str(ROOT / "params" / "meshes" / "artery.obj"), "anatomy": str(ANATOMY)}
    scene = json.loads((ROOT / "params" / "sheath.json").read_text()) | {"vessel": mesh, "sheath": {}, "inlet": 1}
    scene.pop("guidewireOffset")
    placed = {"scale": [1.2] * 3, "rotation": [20.0, -35.0, 70.0], "position": [5.0, -6.0, 7.0]}
    anatomy = json.loads(ANATOMY.read_text())
    with Session(None, hand=True, **scene, **placed, target=2) as session:
        target = session.describe()["target"]
        route = Route(anatomy, 2, 1.0, Placement.of(session.parameters))
        np.testing.assert_allclose(route.points[target["indices"]], target["points"], atol=1e-9)
        # The core counts along the chain from the inlet, a route from the tip's place.
        assert route.place(session.state.positions[-1])[1] == pytest.approx(session.state.place.left, abs=1e-6)
    with pytest.raises(Error, match="one factor"):
        Placement.of({"scale": [1.0, 1.0, 1.1]})


def test_a_tip_that_leaves_by_an_open_end_ends_the_episode_without_success(tube):
    task = replace(tube, targets=(("branch 1", 126.0),), tolerance=0.01, hold=0.14, time=28.0)
    with Environment(task) as own:
        own.reset(options=NOMINAL)
        lefts = [own.report.left]
        while True:
            _, reward, terminated, truncated, info = own.step([1.0, 0.0])
            if terminated or truncated:
                break
            lefts.append(info["left"])
        report = info["report"]
        assert terminated and not truncated and report["end"] == "left the vessel" and not report["success"]
        # The tube is 90 + sqrt(2000) long from z = -70, and the wire begins at z = -2.
        assert 1e3 * report["inserted"] == pytest.approx(22.0 + 2000.0**0.5, abs=3.5)
        assert reward == pytest.approx(-2.0, abs=0.003)    # no progress is counted, the penalty is
        assert report["left"] == pytest.approx(lefts[-1], abs=1.5)    # of the last time step within


def test_a_start_in_the_vessel_is_the_bits_of_the_insertion_there_and_a_snapshot_goes_on_from_them(tube):
    options = {"target": 1, "friction": 0.1, "tip_turn": 0.5, "insertion": 0.01}
    with Environment(tube) as one, Environment(tube) as other:
        first = one.reset(options=options)[0]
        assert first["hub"].tolist() == pytest.approx([10.0, 0.5])
        one.step([1.0, 0.0])
        same(one.reset(options=options)[0], first)
        one.step([1.0, 0.3])
        saved = one.save()
        end = one.step([0.5, -1.0])[0]
        other.reset(options={"snapshot": saved})
        same(other.step([0.5, -1.0])[0], end)
        with pytest.raises(Error, match="stands alone"):
            other.reset(options={"snapshot": saved, "target": 0})


def test_a_start_that_fails_is_tried_in_shorter_steps(tube, monkeypatch):
    moved, asked = LoadedScene._moved, []

    def failing(scene, turn, insertions, parts):
        asked.append(parts)
        state = moved(scene, turn, insertions, parts)
        return state if parts >= least else SimpleNamespace(outcome="failed", reason="the tip is caught")

    monkeypatch.setattr(LoadedScene, "_moved", failing)
    with Environment(tube) as own:
        least = 4
        own.reset(options={"nominal": True, "insertion": 0.005})
        assert asked == [1, 2, 4] and own.session_state.step == 4 + 1    # a step of 20 mm in four parts, one at rest
        least = 100
        with pytest.raises(Error, match="does not come to its start: failed: the tip is caught"):
            own.reset(options={"nominal": True, "insertion": 0.006})


def test_what_was_done_is_kept_in_a_file_and_done_again_to_the_same_bits(environment, tmp_path):
    environment.reset(seed=8)
    for action in ([1.0, 1.0], [0.7, -0.3], [1.0, 0.0]):
        environment.step(action)
    report = environment.report
    environment.recorded("a test").save(tmp_path / "drive.json")
    drive = RecordedDrive.load(tmp_path / "drive.json")
    again = environment.replay(drive)
    assert (again.path, again.impulse, again.forces) == (report.path, report.impulse, report.forces)
    push, turn, steps = drive.calls[1]
    drive.calls[1] = (push + 1e-12, turn, steps)
    with pytest.raises(Error, match="bit for bit"):
        environment.replay(drive)


def test_what_is_asked_wrongly_is_refused_as_gymnasium_refuses(environment, tube, tmp_path):
    with pytest.raises(NameNotFound, match="did you mean 'artery'"):
        Environment("arteri")
    with pytest.raises(ResetNeeded):
        environment.step(np.zeros(2))
    environment.reset(options=NOMINAL)
    for action in (np.zeros(3), np.zeros((1, 2)), [np.nan, 0.0], [0.0, 1.01], [np.inf, 0.0], "left", None):
        with pytest.raises(InvalidAction):
            environment.step(action)
    before = environment.session.state.step
    assert before == 0    # refused before anything moved
    for options in ({"nonsense": 1}, {"target": 2}, {"target": 1.0}, {"target": True}, {"anatomy": 0.0},
                    {"friction": -0.1}, {"friction": np.nan}, {"tip_turn": "half"},
                    {"snapshot": b"nothing"}, {"insertion": -1e-3}, {"insertion": 9.0}, {"nominal": "yes"},
                    {"instrument": ""}, [("friction", 0.1)], "friction"):
        with pytest.raises(Error) as refused:
            environment.reset(options=options)
        assert "\n" not in str(refused.value)
    with pytest.raises((Error, ValueError)):
        environment.reset(seed=-1)
    with pytest.raises(Error, match="multiple"), Environment(tube, drive=Drive(step_time=0.1)) as wrong:
        wrong.reset()
    with pytest.raises(Error, match="an episode takes 2.8 s"):
        Environment(tube, drive=Drive(step_time=7.0))
    noisy = replace(tube, random={"noise": {"vector": [[0.0, 0.1]]}})
    with pytest.raises(Error, match="random \"noise\" = .* needs a number from 0 to 10"), Environment(noisy) as wrong:
        wrong.reset()
    with pytest.raises(Error, match="observation part"):
        Observation(parts=("tips",))
    with pytest.raises(ValueError):
        VectorEnvironment(tube, 2).reset(seed=[1])
    (tmp_path / "task.json").write_text('{"time": 3, "nonsense": 1}')
    with pytest.raises(Error, match="no key \"nonsense\""):
        find_task(tmp_path / "task.json")
    for wrong in ('[1]', '{"anatomies": "a", "targets": [1]}', '{"anatomies": ["a"], "targets": [1], "time": "long"}',
                  '{"anatomies": ["a"], "targets": [1], "tipTurns": 0}', '{"vessel": {"anatomy": "a"}, "target": 1}',
                  '{"anatomies": ["nowhere.json"], "targets": [1], "scene": "params/sheath.json"}', '{',
                  '{"anatomies": ["task.json"], "targets": [1], "scene": "task.json"}',
                  '{"anatomies": ["task.json"], "targets": [1], "scene": "guidewire/env/data/artery.json"}',
                  '{"anatomies": ["task.json"], "targets": [1], "scene": "params/sheath.json"}',
                  '{"vessel": {"anatomy": "a", "frictionCoefficient": "a"}, "target": 1, "timeStep": 0.1, '
                  '"maxSimulationSteps": 9}'):
        (tmp_path / "task.json").write_text(wrong)
        with pytest.raises(Error) as refused, Environment(tmp_path / "task.json") as own:
            own.reset()
        assert "\n" not in str(refused.value)
    environment.close()
    environment.close()
    for ask in (environment.reset, lambda: environment.step(np.zeros(2))):
        with pytest.raises(ClosedEnvironmentError):
            ask()


def test_actions_by_number_delays_and_limits_move_the_hub_as_they_say(tube):
    with Environment(tube, drive=Drive(actions="discrete", delay=1)) as own:
        assert own.action_space.n == 9
        own.reset(options=NOMINAL)
        assert own.step(3)[0]["hub"].tolist() == [0.0, 0.0]    # forwards, a step late
        assert own.step(np.int64(2))[0]["hub"][0] == pytest.approx(2.8)
        assert own.step(6)[0]["hub"].tolist() == pytest.approx([2.8, -np.pi * 0.14])
        for wrong in (9, -1, 1.0, True):
            with pytest.raises(InvalidAction):
                own.step(wrong)
    with Environment(tube) as own:
        own.reset(options=NOMINAL)
        assert own.step([-1.0, 0.0])[0]["hub"][0] == pytest.approx(0.0, abs=1e-12)    # not out of its start
        own.reset(options={"nominal": True, "insertion": 0.001})
        assert own.step([-1.0, 0.0])[0]["hub"][0] == pytest.approx(0.0, abs=1e-9)


def test_every_part_of_an_observation_is_there_and_flat_ones_hold_the_same_numbers(tube):
    picture = Observation(parts=("image", "tip"), image=lambda state: np.full((2, 2), state.step % 256, np.uint8),
                          image_space=Box(0, 255, (2, 2), np.uint8) if not importlib.util.find_spec("gymnasium")
                          else __import__("gymnasium").spaces.Box(0, 255, (2, 2), np.uint8))
    with Environment(tube, observation=picture) as own:
        own.reset(options=NOMINAL)
        assert own.step([1.0, 0.0])[0]["image"].tolist() == [[2, 2], [2, 2]]
    parts = ("tip", "direction", "points", "screen", "hub", "loads", "wall", "distance", "target", "ahead")
    with Environment(tube, observation=Observation(parts=parts)) as one, \
            Environment(tube, observation=Observation(parts=parts, flat=True)) as flat:
        one.reset(seed=2), flat.reset(seed=2)
        seen, numbers = one.step([1.0, 0.5])[0], flat.step([1.0, 0.5])[0]
        assert flat.observation_space.contains(numbers) and one.observation_space.contains(seen)
        np.testing.assert_array_equal(numbers, np.concatenate([seen[part].ravel() for part in parts]))
        np.testing.assert_array_equal(seen["screen"], seen["points"][:, [0, 2]])
        np.testing.assert_array_equal(seen["points"][0], seen["tip"])
        assert np.linalg.norm(seen["ahead"]) == pytest.approx(1.0)
        np.testing.assert_allclose(seen["tip"] + seen["target"], one.target_position, atol=1e-4)


def test_the_path_ahead_is_given_in_the_frame_of_the_tip():
    """An element turned by 90 degrees about z has its d1 along y and its d2 along -x."""
    quarter = np.array([0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5)])
    np.testing.assert_allclose(_in_frame(quarter, np.array([1.0, 2.0, 3.0])), [2.0, -1.0, 3.0], atol=1e-12)


def test_a_force_above_the_limit_is_no_safe_success_and_may_end_the_episode(tube):
    with Environment(tube, safe_force=1e-9, reward=Reward(force=-1.0)) as own:
        own.reset(options=NOMINAL)
        while "report" not in (info := own.step([1.0, 0.0])[4]):
            pass
        assert info["report"]["success"] and not info["report"]["safe_success"]
    with Environment(tube, safe_force=1e-9, ends_unsafe=True) as own:
        own.reset(options=NOMINAL)
        while "report" not in (info := (answer := own.step([1.0, 0.0]))[4]):
            pass
        assert info["report"]["end"] == "force" and answer[2] and not answer[3] and not info["report"]["success"]


def test_spaces_of_ours_draw_what_they_contain_and_start_anew_by_seed():
    spaces = [Box(-1.0, [1.0, 2.0]), Box(-np.inf, np.inf, (2, 2)), Discrete(9), MultiDiscrete([3, 4]),
              Dict({"a": Box(0.0, 1.0, (3,)), "b": Discrete(2)})]
    for space in spaces:
        space.seed(4)
        drawn = space.sample()
        assert drawn in space
        space.seed(4)
        np.testing.assert_equal(space.sample(), drawn)
        assert space == space and all(space != other for other in spaces if other is not space)
    for space in (*spaces[:3], spaces[4]):
        batch = own_spaces.batch_space(space, 3)
        assert batch.sample() in batch and batch.sample() not in space
    assert 9 not in Discrete(9) and np.array([2.0, 0.0], np.float32) not in spaces[0]
