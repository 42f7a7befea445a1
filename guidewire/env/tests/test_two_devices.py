"""Two instruments at once in an environment: a wire in a catheter, in a bent tube that costs little."""

import itertools
import json
import re
from dataclasses import replace

import numpy as np
import pytest

from guidewire.env import Drive, Environment, Observation, Picture, RecordedDrive, Reward, VectorEnvironment
from guidewire.env.baselines import Chance, Follow, Lead, baseline_of
from guidewire.env.observation import DEFAULT, PARTS, RANGES
from guidewire.env.randomisation import drawn_from, middle_of
from guidewire.env.score import play
from guidewire.env.spaces import ClosedEnvironmentError, Error, InvalidAction, ResetNeeded
from guidewire.env.task import find_task
from guidewire.env.tests.environment_cases import same, tube  # noqa: F401
from guidewire.sessions.session import Session

CATHETER = {"start": 4.0, "length": 50.0, "elements": 10, "wireRadius": 8e-4, "lumenRadius": 6e-4, "youngsModulus": 1e9,
            "shearModulus": 4e8}
WITH_OVERLAP = Observation(parts=(*DEFAULT, "overlap"))


@pytest.fixture
def pair(tube):
    return replace(tube, overrides={"catheters": [CATHETER]}, follow=8.0, time=5.6, tip_turns=1)


def test_actions_move_each_hub_and_parts_of_an_observation_are_of_each_instrument(pair):
    parts = tuple(part for part in PARTS if part != "image")
    with Environment(pair, observation=Observation(parts=parts)) as own, \
            Environment(pair, observation=Observation(parts=parts, flat=True)) as flat:
        assert own.action_space.shape == (4,) and own.hubs == 2
        own.reset(options={"nominal": True}), flat.reset(options={"nominal": True})
        actions = [[1.0, 0.5, 0.5, -1.0], [0.5, 0.0, 1.0, 0.25]]
        for action in actions:
            seen, numbers = own.step(action)[0], flat.step(action)[0]
        assert own.observation_space.contains(seen) and flat.observation_space.contains(numbers)
        np.testing.assert_array_equal(numbers, np.concatenate([seen[part].ravel() for part in parts]))
        with Session(None, hand=True, **own.scene) as session:
            for push, turn, push_1, turn_1 in actions:
                for _ in range(2):
                    state = session.step([1.4 * push, 1.4 * push_1], [np.pi * 0.07 * turn, np.pi * 0.07 * turn_1])
        (catheter,) = state.catheters
        np.testing.assert_allclose(seen["tip"], [state.positions[-1], catheter.positions[-1]], atol=1e-4)
        np.testing.assert_allclose(seen["hub"], [[4.2, 0.07 * np.pi], [4.2, -0.105 * np.pi]], rtol=1e-5)
        np.testing.assert_allclose(seen["loads"][1], [catheter.force, 1e3 * catheter.torque], rtol=1e-4, atol=1e-7)
        np.testing.assert_allclose(seen["overlap"], [[1e3 * catheter.extension, 1e3 * catheter.overlap]], rtol=1e-5)
        walls = [np.linalg.norm(one.contact_forces, axis=1) for one in (state, catheter)]
        np.testing.assert_allclose(seen["wall"], [[one.max(), one.sum()] for one in walls], rtol=1e-3, atol=1e-6)
        assert seen["distance"].shape == (2,) and seen["distance"][1] > seen["distance"][0]
        np.testing.assert_allclose(seen["action"], actions[-1])
        for wrong in ([1.0, 0.0], [1.0, 0.0, 0.0, 1.1], 5):
            with pytest.raises(InvalidAction):
                own.step(wrong)


def test_rewards_and_infos_are_of_each_instrument(pair):
    weights = {"progress": (1.0, 0.25), "force": (-2.0, -3.0)}
    with Environment(pair, reward=Reward(**weights)) as own, Environment(pair) as plain:
        own.reset(seed=2), plain.reset(seed=2)
        first = None
        for _ in range(4):
            left = [own._places[0][1], max(own._places[1][1] - pair.follow, 0.0)]
            first = first or sum(left)
            _, earned, _, _, info = own.step([1.0, 0.3, 0.8, -0.2])
            each = [info["instruments"][name] for name in ("wire", "catheter 1")]
            now = [each[0]["left"], max(each[1]["left"] - pair.follow, 0.0)]
            expected = sum(w * (a - b) / first for w, a, b in zip(weights["progress"], left, now)) + 0.14 * (
                -0.02 + sum(w * one["force"] for w, one in zip(weights["force"], each)))
            assert earned == pytest.approx(expected, abs=1e-12)
            _, alike, _, _, _ = plain.step([1.0, 0.3, 0.8, -0.2])
            assert alike == pytest.approx((sum(left) - sum(now)) / first - 0.14 * 0.02, abs=1e-12)
            assert info["force"] == max(one["force"] for one in each)
    with pytest.raises(Error, match="2 instruments"):
        Environment(pair, reward=Reward(force=(-1.0, -1.0, -1.0)))
    with pytest.raises(Error, match="reward progress"):
        Reward(progress=(1.0, float("nan")))


def test_numbers_stand_for_each_pair_of_directions_once(pair):
    drive = Drive(actions="discrete")
    assert drive.space(2).n == 81
    commands = {tuple(drive.command(number, 2)) for number in range(81)}
    one = [drive.command(number)[0] for number in range(9)]
    assert commands == set(itertools.product(one, one)) and drive.command(3, 2) == [(1.0, 0.0), (0.0, 0.0)]
    for wrong in (81, -1, True):
        with pytest.raises(InvalidAction):
            drive.command(wrong, 2)
    with pytest.raises(Error, match="2 hubs"):
        Environment(pair, drive=Drive(speed=[0.01, 0.02, 0.03]))
    with Environment(pair, drive=Drive(speed=[0.01, 0.02], rotation=[1.0, 2.0])) as own:
        own.reset(options={"nominal": True})
        assert own.step(np.ones(4))[0]["hub"] == pytest.approx(np.array([[1.4, 0.14], [2.8, 0.28]]), rel=1e-5)


def test_the_target_is_reached_where_the_catheter_has_followed(pair):
    with Environment(pair, observation=WITH_OVERLAP) as own:
        own.reset(options={"nominal": True})
        while "report" not in (info := own.step([1.0, 0.0, 0.0, 0.0])[4]):
            pass
        assert not info["report"]["success"], "the wire was there alone"
        played = play(own, Follow(own), 1)
        report = played.report
        assert played.faults == [] and report["success"] and report["instruments"]["catheter 1"]["left"] <= 8.0
        assert report["largest_force"] == max(one["largest_force"] for one in report["instruments"].values())
        assert report["impulse"] == pytest.approx(sum(one["impulse"] for one in report["instruments"].values()))
        assert 0.0 < report["instruments"]["catheter 1"]["inserted"] <= report["inserted"]


def test_what_two_hubs_did_is_kept_and_done_again_to_the_same_bits(pair, tmp_path):
    with Environment(pair) as own:
        own.reset(seed=8)
        random = np.random.default_rng(1)
        for _ in range(5):
            own.step(random.uniform(-0.5, 1.0, 4))
        report = own.report
        own.recorded("a test").save(tmp_path / "drive.json")
        drive = RecordedDrive.load(tmp_path / "drive.json")
        again = own.replay(drive)
        assert again.parts == report.parts and again.forces == report.forces
        pushes, turns, steps = drive.calls[1]
        drive.calls[1] = ([pushes[0], pushes[1] + 1e-12], turns, steps)
        with pytest.raises(Error, match="bit for bit"):
            own.replay(drive)
        drive.calls[1] = (1.0, 0.0, 2)
        with pytest.raises(Error, match="of 1 hubs, not of 2"):
            own.replay(drive)


def test_several_environments_of_two_instruments_have_the_bits_of_one(pair):
    actions = np.random.default_rng(2).uniform(-0.5, 1.0, (4, 2, 4)).astype(np.float32)
    with VectorEnvironment(pair, 2) as vector:
        vector.reset(seed=3)
        for action in actions:
            seen = vector.step(action)[0]
    for k in range(2):
        with Environment(pair) as own:
            own.reset(seed=3 + k)
            for action in actions:
                alone = own.step(action[k])[0]
        same(alone, {part: values[k] for part, values in seen.items()})


def test_normalised_observations_are_within_one_and_have_a_history(pair):
    observation = Observation(parts=("tip", "hub", "wall", "distance", "overlap", "action"), normalised=True, history=3,
                              ranges={"distance": 50.0})
    plain = Observation(parts=observation.parts)
    with Environment(pair, observation=observation) as own, Environment(pair, observation=plain) as other:
        first = own.reset(options={"nominal": True})[0]
        before = other.reset(options={"nominal": True})[0]
        np.testing.assert_array_equal(first["hub"][0], first["hub"][2])
        seen, raw = own.step([1.0, 1.0, 0.0, 0.0])[0], other.step([1.0, 1.0, 0.0, 0.0])[0]
        assert own.observation_space.contains(seen)
        assert all(np.isfinite(space.low).all() and np.isfinite(space.high).all()
                   for space in own.observation_space.spaces.values())
        np.testing.assert_array_equal(seen["hub"][1], first["hub"][2])
        np.testing.assert_allclose(seen["hub"][2], raw["hub"] / RANGES["hub"], rtol=1e-5)
        np.testing.assert_allclose(seen["distance"][1:], [before["distance"] / 50.0, raw["distance"] / 50.0], rtol=1e-5)
        np.testing.assert_allclose(seen["tip"][2], (raw["tip"] - own.target_position) / RANGES["tip"], atol=1e-6)
    with pytest.raises(Error, match="ranges"):
        Observation(ranges={"tip": -1.0})
    with pytest.raises(Error, match="needs a task with catheters"):
        Environment("artery", observation=Observation(parts=("overlap",)))


def test_pictures_show_each_plane_and_the_last_frames_with_noise_of_their_own(pair):
    picture = Picture(pixels=32, views=((0.0, 0.0), (90.0, 0.0)), frames=2, every=2, noise=0.05)
    with Environment(pair, observation=Observation(parts=("tip",), image=picture)) as own, Environment(pair) as plain:
        assert own.observation_space["image"].shape == (4, 32, 32)
        frames = [own.reset(seed=2)[0]["image"]]
        for _ in range(4):
            frames.append(own.step([1.0, 0.0, 0.5, 0.0])[0]["image"])
        assert frames[0].dtype == np.uint8 and not np.array_equal(frames[0][2], frames[0][3])
        np.testing.assert_array_equal(frames[1], frames[0])    # a frame every second step
        np.testing.assert_array_equal(frames[2][:2], frames[0][2:])
        assert not np.array_equal(frames[2][2], frames[0][2])
        own.reset(seed=2)
        for _ in range(4):
            again = own.step([1.0, 0.0, 0.5, 0.0])[0]["image"]
        np.testing.assert_array_equal(again, frames[4])
        plain.reset(seed=2)
        alone = plain.session.state.picture(pixels=32, lao=90.0)
    with Environment(pair, observation=Observation(image=Picture(pixels=32, views=((90.0, 0.0),)))) as own:
        np.testing.assert_array_equal(own.reset(seed=2)[0]["image"][0], alone)
    for wrong in ({"pixels": 0}, {"views": ()}, {"views": ((0.0,),)}, {"views": ((0.0, 91.0),)}, {"vessel": "bright"},
                  {"noise": 1.5}, {"centre": (0.0, 1.0)}, {"frames": 0}, {"field_of_view": 0.0}):
        with pytest.raises(Error, match="is not allowed"):
            Picture(**wrong)


def test_a_rendered_frame_has_the_picture_and_the_view_beside_it(pair):
    with Environment(pair, render_mode="rgb_array") as own:
        own.reset(seed=1)
        first = own.render()
        own.step([1.0, 0.0, 1.0, 0.0])
        second = own.render()
        assert first.shape == (360, 720, 3) and first.dtype == np.uint8
        for half in (slice(0, 360), slice(360, 720)):
            assert (first[:, half] != second[:, half]).any(), "what moves is seen in both"
        assert (first[:, 360:] == (255, 214, 64)).all(axis=2).sum() > 50
    with pytest.raises(Error, match="render_mode"):
        Environment(pair, render_mode="ansi")


def test_what_is_random_is_drawn_within_its_range_and_options_fix_it(pair):
    given = {"friction": [0.0, 0.2], "tip_turn": {"normal": [0.0, 1.0], "within": [-0.5, 0.5]}, "noise": [0.0, 0.1],
             "stiffness": {"logUniform": [0.5, 2.0]}, "vessel.radius": {"choice": [2.5, 3.0]},
             "insertion": [0.0, 0.004]}
    own_task = replace(pair, random=given)
    with Environment(own_task) as own:
        draws = [own.reset(seed=seed)[1]["draw"] for seed in range(5)]
        assert draws[2] == own.reset(seed=2)[1]["draw"] and len({draw["friction"] for draw in draws}) == 5
        assert all(0.0 <= draw["friction"] <= 0.2 and abs(draw["tip_turn"]) <= 0.5 and 0.5 <= draw["stiffness"] <= 2.0
                   for draw in draws)
        assert own.scene["youngsModulus"] == pytest.approx(5e9 * draws[2]["stiffness"])
        assert own.session.parameters["vessel"]["radius"] == draws[2]["vessel.radius"]
        assert own.session.parameters["vessel"]["frictionCoefficient"] == draws[2]["friction"]
        draw = own.reset(seed=2, options={"friction": 0.125, "stiffness": 1.5})[1]["draw"]
        assert draw == {**draws[2], "friction": 0.125, "stiffness": 1.5}
        middle = own.reset(options={"nominal": True})[1]["draw"]
        assert middle["friction"] == pytest.approx(0.1) and middle["stiffness"] == pytest.approx(1.0)
        for wrong in ({"stiffness": "soft"}, {"noise": np.nan}, {"vessel.radius": True}):
            with pytest.raises(Error, match="is not allowed"):
                own.reset(options=wrong)


def test_distributions_have_the_means_that_they_say():
    random = np.random.default_rng(5)
    for given, mean in (([1.0, 3.0], 2.0), ({"uniform": [1, 3]}, 2.0), ({"normal": [2.0, 0.1]}, 2.0),
                        ({"integers": [1, 3]}, 2.0), ({"choice": [1.0, 3.0]}, 2.0),
                        ({"logUniform": [1.0, np.e**2]}, (np.e**2 - 1.0) / 2.0)):
        drawn = [drawn_from(given, random) for _ in range(4000)]
        assert np.mean(drawn) == pytest.approx(mean, abs=5.0 * np.std(drawn) / 4000**0.5)
    assert middle_of({"logUniform": [1.0, 4.0]}) == 2.0
    assert middle_of({"vector": [[0.0, 2.0], [1.0, 3.0]]}) == [1.0, 2.0]


def test_random_episodes_of_two_hubs_end_as_they_say(pair):
    with Environment(pair) as own:
        for seed in range(3):
            assert play(own, Chance(own, seed), seed).faults == []


def test_the_tasks_of_two_devices_begin_and_their_baselines_act():
    for name, baseline in (("carotid", Lead), ("microcatheter", Follow)):
        task = find_task(name)
        assert task.hubs == 2
        with Environment(name, observation=WITH_OVERLAP) as own:
            observation, info = own.reset(seed=4)
            assert 0.9 <= info["draw"]["scale"] <= 1.1 and own.session_state.place.is_inside
            assert own.session.parameters["scale"] == [info["draw"]["scale"]] * 3
            policy = baseline_of(own)
            assert type(policy) is baseline
            policy.reset(observation)
            for _ in range(2):
                observation, _, terminated, _, _ = own.step(policy.act(observation))
                assert not terminated and own.observation_space.contains(observation)


def test_a_tip_thrown_off_a_wall_loses_no_turn():
    with Environment("microcatheter") as environment:
        observation, _ = environment.reset(seed=3_000_027)
        policy = Chance(environment, 3_000_027)
        policy.reset(observation)
        for _ in range(32):    # an element of the tip turned by a whole turn in the 31st, under 0.01 N
            observation, _, _, is_over, _ = environment.step(policy.act(observation))
            assert not is_over
            q = environment.session_state.orientations
            assert (np.einsum("ij,ij->i", q[1:], q[:-1]) > np.cos(0.5)).all()    # half the angle between neighbours


def test_what_is_drawn_from_a_list_of_any_kind_is_an_option_and_is_recorded(tube):
    task = replace(tube, random={"proximalEnd": {"choice": ["clamped", "hinged"]}, "logContacts": {"choice": [False]}})
    with Environment(task) as own:
        _, info = own.reset(options={"proximalEnd": "clamped", "logContacts": False})
        own.step([1.0, 0.0])
        assert own.replay(own.recorded()).time == own.report.time == pytest.approx(0.14)
        assert own.reset(options=info["draw"])[1]["draw"] == info["draw"]
        for wrong in ("glued", True):
            with pytest.raises(Error, match="\"proximalEnd\" = .* is not allowed"):
                own.reset(options={"proximalEnd": wrong})


def test_an_instrument_is_a_name_or_names(tube):
    with Environment(tube) as own:
        for wrong in (3, [], [3], {"name": "x"}):
            with pytest.raises(Error, match="\"instrument\" = .*: needs a name, or a list of names"):
                own.reset(options={"instrument": wrong})


def test_speeds_may_be_an_array(pair):
    with Environment(pair, drive=Drive(speed=np.array([0.01, 0.02]), rotation=np.array([1.0, 2.0]))) as own:
        own.reset(options={"nominal": True})
        assert own.step(np.ones(4))[0]["hub"] == pytest.approx(np.array([[1.4, 0.14], [2.8, 0.28]]), rel=1e-5)
        assert Follow(own, hub=1)._turn_of_step == pytest.approx(0.28)


def test_before_the_first_reset_there_is_nothing_to_be_saved_or_recorded(tube):
    with Environment(tube) as own:
        for ask in (own.save, own.recorded, *(lambda name=name: getattr(own, name) for name in (
                "session", "session_state", "scene", "report", "target_position", "widest"))):
            with pytest.raises(ResetNeeded):
                ask()
        own.reset(options={"nominal": True})
        saved = own.save()
        head, _, bits = saved.partition(b"\n")
        for text, problem in ((head.replace(b'"task"', b'"tusk"'), "not what save"),
                              (head.replace(b'"anatomy": 0', b'"anatomy": 9'), "\"anatomy\" = 9 is not allowed")):
            with pytest.raises(Error, match=problem):
                own.reset(options={"snapshot": text + b"\n" + bits})
        assert own.reset(options={"snapshot": saved})[1]["draw"]["target"] == 0
    with pytest.raises(ClosedEnvironmentError):
        own.save()


def test_a_report_says_what_the_hubs_did_and_not_what_was_asked_for(pair):
    with Environment(pair) as own:
        own.reset(options={"nominal": True})
        seen = [(0.0, 0.0)]
        for action in ([1.0, 1.0, 0.0, -0.5], [-1.0, -1.0, 0.0, 0.0]):
            for _ in range(9):
                _, _, _, _, info = own.step(action)
                seen.append((own.session_state.hub.insertion, own.session_state.catheters[0].insertion))
        moved = np.diff(seen, axis=0)
        assert moved[:9, 0].sum() == pytest.approx(9 * 0.0028)
        assert moved[:9, 1].sum() > 0.1 * 9 * 0.0028, "the wire's hub came to the catheter's and carried it along"
        for part, own_moves in zip(own.report.parts, moved.T):
            assert part.inserted == pytest.approx(own_moves[own_moves > 0.0].sum(), abs=1e-15)
            assert part.retracted == pytest.approx(-own_moves[own_moves < 0.0].sum(), abs=1e-15)
        turn = 0.14 * np.pi
        assert [part.turned for part in own.report.parts] == pytest.approx([18 * turn, 4.5 * turn])


@pytest.mark.parametrize("key, value, problem", (
    ("frictions", [], "frictions = [] is not allowed"), ("frictions", ["x"], 'frictions = "x" is not allowed'),
    ("frictions", [-0.1], "frictions = -0.1 is not allowed"),
    ("overrides", {"catheters": {"start": 4.0}}, 'catheters = {"start": 4.0} is not allowed: needs a list of objects'),
    ("overrides", {"catheters": [3]}, "catheters = [3] is not allowed: needs a list of objects"),
    ("anatomies", [5], "anatomies has 5: needs files, or vessels to be made"),
    ("instruments", [[]], "instruments: [] is not allowed: needs a name"),
    ("instruments", ["workhorse-0.014", 5], "instruments: 5 is not allowed: needs a name"),
    ("tipTurns", 1.5, "tipTurns = 1.5 is not allowed: needs a whole number"),
    ("frictions", [11], "frictions = 11 is not allowed: needs a number from 0 to 10"),
    ("insertion", 11.0, "insertion = 11.0 is not allowed: needs a number from 0 to 10"),
    ("random", {"friction": [-0.1, 0.1]}, 'random "friction" = [-0.1, 0.1] is not allowed: needs numbers from 0'),
    ("random", {"noise": {"normal": [0.1, 0.1]}}, "needs numbers from 0 to 10"),
    ("random", {"stiffness": {"choice": ["soft"]}}, "needs numbers from 0.001 to 1000"),
    ("random", {"target": [0, 1]}, 'random "target" is not allowed: the task\'s lists say'),
))
def test_wrong_lists_of_a_tasks_file_are_one_line_that_names_the_file(key, value, problem, tmp_path):
    file = tmp_path / "own.json"
    file.write_text(json.dumps({"anatomies": ["anatomy.json"], "targets": [2], key: value}))
    with pytest.raises(Error, match=re.escape(problem)) as caught:
        find_task(file)
    assert str(caught.value).startswith(f"{file}: ") and "\n" not in str(caught.value)
