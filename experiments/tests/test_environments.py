"""Environments against Gymnasium's protocol, against themselves and against a session; and how they refuse."""

import importlib.util
import json
import os
import re
from dataclasses import replace

import numpy as np
import pytest

from environments import Drive, Environment, Observation, RecordedDrive, Reward, VectorEnvironment, all_tasks
from environments import own_spaces
from environments.baselines import Chance, TurnAndRetry
from environments.evolution import Linear, draw, learn, score
from environments.observation import _in_frame
from environments.own_spaces import Box, Dict, Discrete, MultiDiscrete
from environments.route import Route
from environments.score import digest, play
from environments.spaces import ClosedEnvironmentError, Error, InvalidAction, NameNotFound, ResetNeeded
from environments.task import Task, find_task
from experiments.prepare import ROOT
from experiments.session import Session

FULL = bool(os.environ.get("GUIDEWIRE_ALL"))
NOMINAL = {"nominal": True}
DATA = ROOT / "environments" / "data"

# A bent tube, whose centreline is known, with a wire that costs little.
TUBE = {"solver": "direct", "guidewireLength": 60.0, "numberRodElements": 12, "guidewireOffset": -62.0,
        "wireRadius": 0.0003, "youngsModulus": 5e9, "shearModulus": 2e9, "density": 6450.0, "massDamping": 20.0,
        "wireSections": [{"from": 40.0, "to": 60.0, "numberRodElements": 6, "restCurvature": [-20.0, 0.0, 0.0]}],
        "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": 0.02, "timeStep": 0.07,
        "maxSimulationSteps": 100, "target": 2,
        "vessel": {"shape": "tube", "knots": [[0, 0, -70], [0, 0, 20], [0, 20, 60]], "radius": 3.0,
                   "openStart": True, "anatomy": "anatomy.json"}}


def anatomy_of(points, radius, branches, parents, ends):
    return {"metresPerUnit": 0.001, "ends": [{"number": k + 1, "name": f"end {k + 1}", "point": point}
                                             for k, point in enumerate(ends)],
            "centreline": {"points": [[*map(float, p), radius] for p in points], "parents": parents,
                           "branches": branches, "names": [f"branch {k}" for k in range(1, max(branches) + 1)]}}


@pytest.fixture(scope="module")
def tube(tmp_path_factory):
    """A task in a tube: its centreline has a point every 2 units."""
    folder = tmp_path_factory.mktemp("tube")
    straight = [[0.0, 0.0, z] for z in np.arange(-70.0, 20.0, 2.0)]
    along = np.array([0.0, 20.0, 40.0]) / np.hypot(20.0, 40.0)
    bent = [list(np.array([0.0, 0.0, 20.0]) + s * along) for s in np.arange(0.0, 44.0, 2.0)]
    points = straight + bent
    count = len(points)
    (folder / "anatomy.json").write_text(json.dumps(
        anatomy_of(points, 3.0, [1] * count, [-1, *range(count - 1)], [0, count - 1])))
    vessel = {key: value for key, value in TUBE["vessel"].items() if key != "anatomy"}
    scene = {**TUBE, "vessel": vessel}
    scene.pop("target")
    (folder / "scene.json").write_text(json.dumps(scene))
    return Task("tube", scene=str(folder / "scene.json"), anatomies=(str(folder / "anatomy.json"),),
                targets=(("branch 1", 92.0), ("branch 1", 100.0)), frictions=(0.0, 0.1), tip_turns=4, time=2.8,
                tolerance=2.0)


@pytest.fixture
def environment(tube):
    with Environment(tube) as made:
        yield made


def same(a, b):
    assert a.keys() == b.keys()
    for name in a:
        np.testing.assert_array_equal(a[name], b[name], err_msg=name)


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
    assert len(report["forces"]) == 40 and report["largest_force"] == report["forces"].max()    # 20 steps of 2 each
    with pytest.raises(ResetNeeded):
        environment.step(np.zeros(2))


def test_the_same_seed_gives_the_same_bits_and_another_one_another_episode(tube):
    def episode(seed):
        with Environment(tube, drive=Drive(noise=0.1, delay=1)) as own:
            random = np.random.default_rng(0)
            seen = [own.reset(seed=seed)[0]]
            seen += [own.step(random.uniform(-1.0, 1.0, 2))[0] for _ in range(6)]
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


def test_a_start_in_the_vessel_is_the_bits_of_the_way_there_and_a_snapshot_goes_on_from_them(tube):
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
        assert other.report.inserted == pytest.approx(0.0014)    # from the snapshot on
        with pytest.raises(Error, match="stands alone"):
            other.reset(options={"snapshot": saved, "target": 0})


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
    with pytest.raises(Error, match="other bits"):
        environment.replay(drive)


@pytest.mark.parametrize("backend", ["threads", pytest.param("processes", marks=pytest.mark.skipif(
    not FULL, reason="a second for each process"))])
def test_several_at_once_have_the_bits_of_each_alone_whatever_the_number_of_workers(tube, backend):
    tube = replace(tube, time=0.7)    # five steps of an episode
    seeds, actions = [11, 12, 13], np.random.default_rng(1).uniform(-1.0, 1.0, (8, 3, 2)).astype("f")

    def alone(k):
        with Environment(tube) as own:
            seen, ended = [own.reset(seed=seeds[k])[0]["tip"]], False
            for action in actions[:, k]:
                if ended:
                    observation, ended = own.reset()[0], False
                else:
                    observation, _, terminated, truncated, _ = own.step(action)
                    ended = terminated or truncated
                seen.append(observation["tip"])
            return np.array(seen)

    expected = np.stack([alone(k) for k in range(3)], axis=1)
    for workers in (1, 2) if backend == "threads" else (2,):
        with VectorEnvironment(tube, 3, workers, backend) as vector:
            observation, _ = vector.reset(seed=seeds)
            assert vector.observation_space.contains(observation) and vector.num_envs == 3
            seen, reports = [observation["tip"]], 0
            for action in actions:
                observation, rewards, terminated, truncated, info = vector.step(action)
                assert rewards.shape == terminated.shape == truncated.shape == (3,)
                reports += int(np.sum(info.get("_report", 0)))
                seen.append(observation["tip"])
            assert reports >= 3    # every one of them has ended and begun again: 8 steps are more than one episode
        np.testing.assert_array_equal(np.array(seen), expected)
        with pytest.raises(ClosedEnvironmentError):
            vector.reset()


def test_an_episode_has_one_of_the_vessels_of_a_list_and_says_whether_it_was_open(tube, tmp_path):
    entry = {"anatomies": [{"make": "siphon", "seeds": [4, 7], "inlet": 1, "target": 2}], "targets": [1]}
    (tmp_path / "task.json").write_text(json.dumps(entry))
    assert [one["seed"] for one in find_task(tmp_path / "task.json").anatomies] == [4, 7]
    for wrong in ({"seeds": []}, {"seeds": [1.5]}, {"seeds": 3}, {"seed": 1, "seeds": [1]}, {"seed": -1}, {}):
        anatomy = {"make": "siphon", "inlet": 1, "target": 2, **wrong}
        (tmp_path / "task.json").write_text(json.dumps({**entry, "anatomies": [anatomy]}))
        with pytest.raises(Error, match="seeds"):
            find_task(tmp_path / "task.json")
    narrow = tmp_path / "narrow"
    narrow.mkdir()
    read = json.loads((ROOT / tube.scene).read_text())
    (narrow / "scene.json").write_text(json.dumps({**read, "vessel": {**read["vessel"], "radius": 2.0}}))
    wide = (ROOT / tube.anatomies[0]).read_text()
    (narrow / "anatomy.json").write_text(wide.replace(", 3.0]", ", 2.0]"))
    both = replace(tube, scene="", anatomies=(*tube.anatomies, str(narrow / "anatomy.json")), frictions=(0.0,))
    with Environment(both) as own:
        told = [(own.reset(seed=seed)[1], own.widest) for seed in range(8)]
        assert {info["draw"]["anatomy"] for info, _ in told} == {0, 1}
        assert all(widest == (3.0, 2.0)[info["draw"]["anatomy"]] for info, widest in told)
        met = [info["draw"]["anatomy"] for info, _ in told]
        assert [info["loaded"] for info, _ in told] == [one in met[:k] for k, one in enumerate(met)]


def test_environment_i_of_several_has_the_seed_plus_i(tube):
    with VectorEnvironment(tube, 2) as vector:
        one, info = vector.reset(seed=7)
        other, listed = vector.reset(seed=[7, 8])
        same(one, other)
        assert info["draw"].tolist() == listed["draw"].tolist() and info["draw"][0] != info["draw"][1]


def test_after_an_end_the_next_step_begins_anew_without_looking_at_its_action(tube):
    with VectorEnvironment(tube, 1) as vector:
        vector.reset(seed=1)
        for _ in range(20):
            _, _, _, truncated, info = vector.step(np.zeros((1, 2), np.float32))
        assert truncated[0] and info["report"][0]["end"] == "time" and info["_report"].tolist() == [True]
        _, rewards, terminated, truncated, info = vector.step(np.full((1, 2), np.nan))
        assert (rewards[0], terminated[0], truncated[0]) == (0.0, False, False) and "draw" in info


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
    for options in ({"nonsense": 1}, {"target": 2}, {"friction": -0.1}, {"friction": np.nan}, {"tip_turn": "half"},
                    {"snapshot": b"nothing"}, {"insertion": -1e-3}):
        with pytest.raises(Error) as refused:
            environment.reset(options=options)
        assert "\n" not in str(refused.value)
    with pytest.raises((Error, ValueError)):
        environment.reset(seed=-1)
    with pytest.raises(Error, match="multiple"), Environment(tube, drive=Drive(step_time=0.1)) as wrong:
        wrong.reset()
    with pytest.raises(Error, match="one hub"), Environment(replace(tube, overrides={"catheters": [{}]})) as wrong:
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
                  '{"anatomies": ["nowhere.json"], "targets": [1], "scene": "params/sheath.json"}', '{'):
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


def test_the_way_ahead_is_told_in_the_frame_of_the_tip():
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
        while "report" not in (info := (told := own.step([1.0, 0.0]))[4]):
            pass
        assert info["report"]["end"] == "force" and told[2] and not told[3] and not info["report"]["success"]


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


def test_gymnasiums_own_check_passes_on_every_task(tube):
    pytest.importorskip("gymnasium", reason="gymnasium is not installed; its protocol is tested above")
    from gymnasium.utils.env_checker import check_env

    for task in [tube, *(all_tasks() if FULL else ["artery"])]:
        for drive in (Drive(), Drive(actions="discrete")):
            check_env(Environment(task, drive=drive), skip_render_check=True)


def test_tasks_that_ship_name_their_files_and_turn_and_retry_reaches_a_branch():
    tasks = all_tasks()
    assert {"artery", "arch", "siphon"} <= set(tasks) and all(task.summary for task in tasks.values())
    with Environment("artery") as own:
        played = play(own, TurnAndRetry(own), 1)
        assert played.faults == [] and played.report["success"] and 0.0 < played.report["largest_force"] < 1.5


@pytest.mark.parametrize("task", all_tasks() if FULL else ["artery"])    # the others' vessels take minutes to make
def test_the_demonstration_recorded_by_keys_reaches_its_target_to_the_same_bits(task):
    drive = RecordedDrive.load(DATA / f"{task}-demonstration.json")
    assert drive.source.startswith("by keys") and len(drive.calls) > 15
    with Environment(task) as own:
        assert own.replay(drive).success


def test_what_was_learned_reaches_the_target_sooner_and_with_less_force_than_turn_and_retry():
    seeds = range(1_000_000, 1_000_006 if FULL else 1_000_003)    # not among those of the training
    learned = json.loads((DATA / "learned.json").read_text())
    task = replace(find_task("artery"), frictions=(0.05,))    # one vessel to be read
    mine = score(task, np.array(learned["parameters"]), list(seeds))
    with Environment(task) as own:
        theirs = [play(own, TurnAndRetry(own), seed) for seed in seeds]
    assert all(one.report["safe_success"] for one in mine)
    for key in ("time", "impulse"):
        assert sum(one.report[key] for one in mine) < 0.9 * sum(one.report[key] for one in theirs)
    assert sum(one.total for one in mine) > sum(one.total for one in theirs)


def test_evolution_learns_the_same_from_the_same_seed(tube, tmp_path):
    one, curve = learn(tube, generations=1, seed=3, pairs=2, episodes=1)
    other, _ = learn(tube, generations=1, seed=3, pairs=2, episodes=1)
    np.testing.assert_array_equal(one, other)
    draw({"curve": curve}, tmp_path / "curve.png")
    assert (tmp_path / "curve.png").stat().st_size > 5000
    assert len(curve) == 1 and np.abs(one).max() > 0.0 and Linear(one).act(
        {"ahead": np.zeros(3), "distance": np.zeros(1), "wall": np.zeros(2)}).shape == (2,)


@pytest.mark.parametrize("task", ["tube", *(all_tasks() if FULL else [])])
def test_random_episodes_end_as_they_say_without_a_number_that_is_none(tube, task):
    count = 1000 if FULL else 4

    def bits():
        with Environment(tube if task == "tube" else task) as own:
            played = [play(own, Chance(own, seed), seed) for seed in range(count)]
        assert [fault for one in played for fault in one.faults] == []
        return digest(played)

    first = bits()
    assert FULL or bits() == first


def resident():
    return int(re.search(r"VmRSS:\s+(\d+)", open("/proc/self/status").read()).group(1)) / 1024.0    # MB


@pytest.mark.skipif(not FULL, reason="ten thousand resets take a minute")
def test_memory_stays_level_over_ten_thousand_resets(tube):
    with Environment(tube) as own:
        for _ in range(2000):
            own.reset()
        before = resident()
        for _ in range(8000):
            own.reset()
        assert resident() - before < 20.0


def test_the_tutorials_thirty_lines_train_on_a_mesh_with_its_scene(tmp_path, monkeypatch, capsys):
    page = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    (script,) = re.findall(r"as `train.py`:\n\n```python\n(.*?)^```$", page, re.M | re.S)
    assert len(script.splitlines()) <= 30
    scene = json.loads((ROOT / "params" / "sheath.json").read_text()) | {
        "vessel": {"shape": "mesh", "file": str(ROOT / "params" / "meshes" / "artery.obj"),
                   "anatomy": str(DATA / "artery.json")}, "sheath": {}, "inlet": 1, "target": 2,
        "guidewireLength": 330.0, "numberRodElements": 60, "contactDistance": 2e-4,
        "wireSections": [{"from": 300.0, "to": 330.0, "numberRodElements": 12, "youngsModulus": 6e9,
                          "shearModulus": 2.3e9, "restCurvature": [-26.18, 0.0, 0.0]}]}
    scene.pop("guidewireOffset")
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    monkeypatch.setattr("sys.argv", ["train.py", str(tmp_path / "scene.json"), "1" if FULL else "0"])
    exec(compile(script, "train.py", "exec"), {"__name__": "__main__"})
    said = capsys.readouterr().out.splitlines()
    assert len(said) == (4 if FULL else 3) and all(" N" in line and "after" in line for line in said[-3:])
