"""Episodes that cannot be fooled: ends within a step, limits of hubs, whole snapshots, and what does not pay."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from guidewire.env import Drive, Environment, Observation, Picture, Reward, all_tasks
from guidewire.env.baselines import Chance, baseline_of, parts_of
from guidewire.env.draws import draw_of, eased_draw, with_options
from guidewire.env.instruments import Instrument
from guidewire.env.observation import Observer
from guidewire.env.picture import WIRE, CArm, PictureState
from guidewire.env.route import Placement, Route
from guidewire.env.score import play
from guidewire.env.spaces import Error
from guidewire.env.task import find_task
from guidewire.env.tests.environment_cases import anatomy_of, environment, same, tube  # noqa: F401

NOMINAL = {"nominal": True}


def pushed(task, **options):
    with Environment(task, **options) as own:
        own.reset(options=NOMINAL)
        total, ended = 0.0, False
        while not ended:
            _, reward, terminated, truncated, info = own.step([1.0, 0.0])
            total, ended = total + reward, terminated or truncated
        return total, info


def test_the_target_is_seen_in_every_time_step_whatever_the_duration_of_a_call(tube):
    found = [pushed(tube, drive=Drive(step_time=step_time)) for step_time in (0.07, 0.14, 0.42, 1.4, 2.8)]
    totals, reports = [total for total, _ in found], [info["report"] for _, info in found]
    assert {one["end"] for one in reports} == {"target"} and all(info["is_success"] for _, info in found)
    # The same steps of 0.07 s in calls of one to forty; the push of a call is divided among them, to rounding.
    for key in ("time", "left", "path", "inserted"):
        np.testing.assert_allclose([one[key] for one in reports], reports[0][key], rtol=1e-9)
    np.testing.assert_allclose(totals, totals[0], rtol=1e-9)


def test_a_target_that_is_passed_within_a_time_step_counts_but_where_it_is_to_be_held(tube):
    fast = Drive(speed=0.2)    # 14 mm in a time step, and the target is within 2
    assert pushed(tube, drive=fast)[1]["report"]["end"] == "target"
    held = replace(tube, hold=0.14)
    assert pushed(held, drive=fast)[1]["report"]["end"] == "left the vessel"
    with Environment(held) as own:    # at rest within the tolerance of 2 mm, for two time steps
        own.reset(options=NOMINAL)
        info = {"left": 99.0}
        while "report" not in info:
            info = own.step([1.0 if info["left"] > 1.9 else 0.0, 0.0])[4]
        assert info["report"]["end"] == "target"


def test_no_episode_lasts_longer_than_its_time(tube):
    for time, step_time in ((0.75, 0.14), (0.7, 0.42), (0.07, 0.07), (2.79, 1.4)):
        _, info = pushed(replace(tube, time=time), drive=Drive(step_time=step_time, speed=1e-3))
        report = info["report"]
        assert report["end"] == "time" and time - 0.07 < report["time"] <= time + 1e-9
        assert len(report["forces"]) == round(report["time"] / 0.07)


def test_what_lies_downstream_of_a_target_is_beyond_it_and_ends_are_met_along_the_way():
    #     3 - 4
    # 0 - 1 - 2
    points = [[0, 0, 0], [0, 0, 10], [0, 0, 20], [0, 5, 15], [0, 5, 25]]
    route = Route(anatomy_of(points, 1.0, [1, 1, 2, 3, 3], [-1, 0, 1, 1, 3], [0, 2, 4]), ["branch 3", 0.0])
    assert route.is_beyond.tolist() == [False, False, False, False, True]
    assert route.until_end.tolist() == pytest.approx([20.0, 10.0, 0.0, 10.0, 0.0])
    assert route.until_outlet(np.array([0.0, 0.0, 4.0])) == pytest.approx(16.0)


def test_a_hub_stops_where_the_tip_meets_an_open_end(tube):
    task = replace(tube, targets=(("branch 1", 126.0),), tolerance=0.01, hold=0.14, time=28.0)
    with Environment(task, drive=Drive(stops_at_ends=True)) as own:
        own.reset(options=NOMINAL)
        info = {}
        while "report" not in info:
            info = own.step([1.0, 0.3])[4]
        assert info["report"]["end"] == "time" and own.report.left < 9.0
        # A push of the hub, 1.4 mm a time step, is kept from the end.
        assert 0.5 < own._route.until_outlet(own.session_state.positions[-1]) < 3.0
        drive = own.recorded()
    with Environment(task) as own:    # of what was made, whatever would be asked for
        assert own.replay(drive).end == "time"


def test_forces_beyond_the_limit_of_a_hub_end_the_episode_and_are_not_taken_in(tube):
    with Environment(tube, reward=Reward(force=-1e6)) as own:
        own.reset(options=NOMINAL)
        _, reward, _, _, info = own.step([1.0, 0.0])
        before = own.report.time
        own._scene.limits = [1e-9]    # as if the core had let the hub push with more
        _, reward, terminated, truncated, info = own.step([1.0, 0.0])
        report = info["report"]
        assert truncated and not terminated and report["end"] == "simulation"
        assert report["reason"].startswith("the hub of the wire has a force of") and "limit of 1e-09 N" in (
            report["reason"])
        assert report["time"] == before and info["force"] == 0.0 and abs(reward) < 1.0


@pytest.mark.parametrize("options", [
    {}, {"drive": Drive(delay=2, noise=0.2)},
    {"observation": Observation(parts=("distance", "action", "tip"), history=3)},
    {"observation": Observation(parts=("tip", "action"), history=2, flat=True, normalised=True)},
    {"observation": Observation(parts=("tip",), image=Picture(pixels=16, frames=2, every=2, noise=0.2, target=True))},
])
def test_a_snapshot_goes_on_as_the_episode_did_to_the_bit(tube, options):
    random = np.random.default_rng(3)
    actions = random.uniform(-1.0, 1.0, (60, 2)).astype("f")

    def go_on(own, k):
        seen, ended = [], False
        while not ended:
            observation, reward, terminated, truncated, info = own.step(actions[k])
            seen.append((observation, reward, info["left"]))
            ended, k = terminated or truncated, k + 1
        return seen, info["report"], own.recorded().calls

    with Environment(tube, **options) as one, Environment(tube, **options) as other:
        one.reset(seed=4)
        for k in range(7):
            last = one.step(actions[k])[0]
        saved = one.save()
        other.reset(seed=9)
        other.step(actions[0])
        first = other.reset(options={"snapshot": saved})[0]
        np.testing.assert_equal(first, last)
        (rest, report, calls), (again, report_again, calls_again) = go_on(one, 7), go_on(other, 7)
        np.testing.assert_equal(again, rest)
        assert report_again == report and calls_again == calls and len(rest) == 13
        assert report["time"] == pytest.approx(2.8)


def test_a_snapshot_of_another_drive_or_of_an_episode_that_has_ended_is_refused(tube):
    short = replace(tube, time=0.14)
    with Environment(short, drive=Drive(delay=1)) as one, Environment(short) as other:
        one.reset(seed=1)
        saved = one.save()
        with pytest.raises(Error, match="delay of 1 steps, not of 0"):
            other.reset(options={"snapshot": saved})
        one.step([0.0, 0.0])
        with pytest.raises(Error, match="has ended"):
            one.reset(options={"snapshot": one.save()})


class _Fixed:
    def __init__(self, action):
        self._action = action

    def reset(self, observation):
        self._step = 0

    def act(self, observation):
        self._step += 1
        return self._action(self._step)


def adversaries(hubs, environment):
    """Five policies that look at nothing."""
    return {"push": _Fixed(lambda k: [1.0, 0.0] * hubs), "spin": _Fixed(lambda k: [0.0, 1.0] * hubs),
            "alternate": _Fixed(lambda k: [(-1.0)**(k // 6), 1.0] * hubs), "still": _Fixed(lambda k: [0.0] * 2 * hubs),
            "random": Chance(environment, 1)}


@pytest.mark.long("a minute for each task; that leaving costs is a test above")
@pytest.mark.parametrize("name", all_tasks())
def test_policies_that_look_at_nothing_earn_less_than_the_worst_episode_of_the_baseline(name):
    task, seeds = find_task(name), range(1_000_000, 1_000_006)
    with Environment(task, observation=Observation(parts=parts_of(task))) as own:
        worst = min(play(own, baseline_of(own), seed).total for seed in seeds if name != "carotid" or seed % 2)
        for label, policy in adversaries(task.hubs, own).items():
            mean = np.mean([play(own, policy, seed).total for seed in seeds])
            assert mean < worst, label


def test_options_may_be_dicts_of_plain_values_as_files_have_them(tube):
    options = {"drive": {"actions": "discrete", "delay": 1}, "reward": {"force": -1.0, "left": -5.0},
               "observation": {"parts": ["tip", "hub"], "flat": True, "normalised": True}}
    read = json.loads(json.dumps(options))
    with Environment(tube, **read) as own:
        assert (own.drive.delay, own.reward.left, own.observation_space.shape) == (1, -5.0, (5,))
        assert own.reset(seed=1)[0].shape == (5,)
    with Environment(tube, observation={"image": {"pixels": 8, "views": [[0, 0], [90, 0]]}}) as own:
        assert own.reset(seed=1)[0]["image"].shape == (2, 8, 8)
    for wrong in ({"drive": {"speeds": 1.0}}, {"reward": 3}, {"observation": {"image": {"pixel": 8}}}):
        with pytest.raises(Error, match="or a dict with some of"):
            Environment(tube, **wrong)
    with Environment(tube) as own, pytest.raises(Error, match="instrument"):
        own.reset(options={"instrument": "no-such-wire"})
    with Environment("siphon") as own:
        with pytest.raises(Error, match="no-such-wire"):
            own.reset(options={"instrument": "no-such-wire"})
        own.reset(seed=1)    # and the next episode begins
        for _ in range(2):    # at a start that is kept
            own.session.inject(1.0, 5.0)
            own.step([0.0, 0.0])
            assert own.session.agent().injected > 0.0
            own.reset(options=own.recorded().options)
            assert own.session.agent().injected == 0.0, "nothing is left of the last episode's contrast agent"


def test_pictures_show_where_the_target_is_and_what_each_pixel_is(tube):
    image = Picture(pixels=64, views=((20.0, -10.0),), target=True, labels=True, vessel="none")
    with Environment(tube, observation=Observation(parts=("tip",), image=image)) as own:
        seen = own.reset(options={"nominal": True, "insertion": 0.02})[0]["image"]
        assert seen.shape == (2, 64, 64) and own.observation_space["image"].shape == (2, 64, 64)
        state, target = own.session_state, own.target_position
        corners = own.session.walls()[0].vertices
        arm = CArm(image, 20.0, -10.0, own.session.describe()["patient"],
                   np.array([corners.min(axis=0), corners.max(axis=0)]), 1.0)
        view = {"pixels": 64, "lao": 20.0, "cranial": -10.0, "vessel": "none", "attenuation": 50.0, **arm.place}
        # The core's picture of a wire that lies at one point: where it is dark, rays meet that point.
        for point in (target, state.positions[-1]):
            nodes = np.tile(point, (len(state.positions), 1)) + np.linspace(-0.5, 0.5, len(state.positions))[:, None]
            grey = own.session.picture_of(nodes, **view)
            rows, columns = np.nonzero(grey < grey.max())
            np.testing.assert_allclose(arm.pixels_of(point[None])[0], [columns.mean() + 0.5, rows.mean() + 0.5],
                                       atol=1.0)
        ring = arm.distances(target)
        assert (seen[0][np.abs(ring - 2.0) < 0.5] == 255).all() and (seen[1][ring <= 1.0] > 1).all()
        grey = state.picture(**view)
        wire = seen[1] == WIRE
        assert wire.sum() > 10 and (grey[wire] < grey.max()).mean() > 0.9

    def target_alone(state, target):
        return np.array(target)

    space = own.observation_space["tip"]
    with Environment(tube, observation=Observation(parts=("image",), image=target_alone, image_space=space)) as own:
        np.testing.assert_array_equal(own.reset(seed=2)[0]["image"], own.target_position)


def test_one_session_takes_one_scene_after_another_with_the_bits_of_a_new_one(tube):
    """Also through meshes that are placed elsewhere, and back."""
    draws = [{"target": 0, "friction": friction, "tip_turn": turn, "insertion": 0.005} for friction, turn in
             ((0.0, 0.0), (0.1, 1.0), (0.0, 1.0), (0.1, 1.0), (0.0, 0.0))]

    def alone(task, draw):
        with Environment(task) as own:
            own.reset(seed=5, options=draw)
            return own.step([1.0] * 2 * own.hubs)[0]

    with Environment(tube) as own:
        for draw in draws:
            own.reset(seed=5, options=draw)
            same(own.step([1.0, 1.0])[0], alone(tube, draw))
            session = own.session
        assert own.session is session
    task = find_task("siphon-train")
    placed = [{**NOMINAL, "anatomy": anatomy, "scale": scale, "rotation": [turn, 0.0, 2.0 * turn]}
              for anatomy, scale, turn in ((0, 1.0, 0.0), (0, 1.1, 9.0), (12, 0.9, -5.0), (0, 1.1, 9.0))]
    with Environment(task) as own:
        for draw in placed:
            own.reset(seed=5, options=draw)
            same(own.step([1.0, 1.0])[0], alone(task, draw))


@pytest.mark.parametrize("name", ["siphon-train", "carotid", "artery"])
def test_a_difficulty_orders_targets_and_draws(name):
    task = find_task(name)
    drawn = {}
    for difficulty in (0.0, 0.5, 1.0):
        random = np.random.default_rng(5)
        draws = [draw_of(task, random) for _ in range(12)]
        drawn[difficulty] = [eased_draw(task, one, difficulty) for one in draws]
    assert [vars(one) for one in drawn[1.0]] == [vars(one) for one in draws], "as the task has them"
    nominal = with_options(task, draws[0], {**NOMINAL, "target": task.by_way[0]})
    assert all(vars(one) == vars(nominal) for one in drawn[0.0])
    for half, whole in zip(drawn[0.5], drawn[1.0]):
        assert half.tip_turn == 0.5 * whole.tip_turn and half.anatomy == whole.anatomy // 2
        if "scale" in whole.random:
            assert half.random["scale"] == pytest.approx(0.5 * (1.0 + whole.random["scale"]))
    with Environment(task, difficulty=0.0) as own:
        assert own.reset(seed=3)[1]["draw"]["anatomy"] == 0
        own.difficulty = 1.5
        with pytest.raises(Error, match="from 0 to 1"):
            own.reset()


def test_ways_of_a_vessel_that_is_scaled_are_scaled():
    points = [[0.0, 0.0, 2.0 * k] for k in range(21)]
    route = Route(anatomy_of(points, 2.0, [1] * 21, [k - 1 for k in range(21)], [0, 20]), ("branch 1", 30.0))
    twice = route.placed(Placement.of({"scale": [2.0, 2.0, 2.0], "position": [1.0, 2.0, 3.0]}))
    for point in route.points[[4, 9]] + [0.3, 0.0, 0.4]:
        there = 2.0 * point + [1.0, 2.0, 3.0]
        assert twice.until_outlet(there) == pytest.approx(2.0 * route.until_outlet(point))
        assert twice.place(there)[1] == pytest.approx(2.0 * route.place(point)[1])


def test_every_picture_that_was_begun_is_an_exposure_of_each_plane():
    state = PictureState(Picture(views=((0.0, 0.0), (90.0, 0.0)), every=3), 0)
    counts = []
    for step in range(7):
        state.restore((step, 0), [])
        counts.append(state.exposures)
    assert counts == [0, 2, 2, 2, 4, 4, 4]


def test_loads_and_insertions_are_in_the_units_of_observations():
    points = [[0.0, 0.0, 2.0 * k] for k in range(5)]
    route = Route(anatomy_of(points, 2.0, [1] * 5, [k - 1 for k in range(5)], [0, 4]), 2)
    hub = SimpleNamespace(insertion=0.03, turn=1.5, force=0.2, torque=4e-3, tip_direction=np.array([0.0, 0.0, 1.0]))
    forces = np.array([[0.0, 3.0, 4.0], [0.0, 0.0, 1.0]])
    wire = Instrument(np.zeros((2, 3)), np.array([[0.0, 0.0, 0.0, 1.0]]), forces, None, None, hub)
    seen = Observer(Observation(("hub", "loads", "wall")), route, 1e-3, 1, 0).of(None, [wire], [(0, 8.0)])
    assert seen["hub"] == pytest.approx([30.0, 1.5]), "mm"
    assert seen["loads"] == pytest.approx([0.2, 4.0]), "N, N mm"
    assert seen["wall"] == pytest.approx([5.0, 6.0])
