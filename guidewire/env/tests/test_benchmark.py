"""Results that others can check, demonstrations in files of others, and a network."""

import json

import numpy as np
import pytest
from scipy import stats

from guidewire.env import Environment, RecordedDrive, all_tasks, benchmark
from guidewire.env.baselines import TurnAndRetry
from guidewire.env.demonstrations import demonstrate, save_minari, save_npz, trajectory_of
from guidewire.env.network import Network
from guidewire.env.score import play
from guidewire.env.spaces import Error
from guidewire.env.task import find_task
from guidewire.env.tests.environment_cases import tube  # noqa: F401

SEEDS = range(benchmark.FIRST_SEED, benchmark.FIRST_SEED + 3)


@pytest.fixture(scope="module")
def played(tube):
    with Environment(tube) as own:
        return [play(own, TurnAndRetry(own), seed) for seed in SEEDS]


def test_intervals_are_those_of_wilson_and_of_means_drawn_anew():
    for count, reached in ((10, 0), (10, 7), (40, 40)):
        values = [1.0] * reached + [0.0] * (count - reached)
        expected = stats.binomtest(reached, count).proportion_ci(0.95, "wilson")
        np.testing.assert_allclose(benchmark.interval(values, True), [reached / count, *expected], atol=1e-6)
    values = np.random.default_rng(1).normal(3.0, 2.0, 200)
    mean, low, high = benchmark.interval(values, False)
    half = 1.96 * values.std() / 200**0.5
    assert mean == pytest.approx(values.mean()) and [low, high] == pytest.approx([mean - half, mean + half], abs=0.1)
    assert benchmark.interval([], False) is None


def test_a_results_file_is_whole_or_refused(played, tmp_path):
    file = tmp_path / "results.json"
    results = benchmark.results_of("dev", "retry", {"tube": played})
    benchmark.save(results, file)
    read = benchmark.load(file)
    assert read == json.loads(json.dumps(results)) and read["guidewire"] and len(read["sha256"]) == 64
    head, _, row = benchmark.table([read]).splitlines()
    cells = dict(zip((one.strip() for one in head.split("|")), (one.strip() for one in row.split("|"))))
    reached = [one.report for one in played if one.report["success"]]
    assert cells["success"].startswith(f"{100 * len(reached) / 3:.0f} % [") and cells["episodes"] == "3"
    ratio = np.mean([one["path"] / one["way"] for one in reached])
    assert float(cells["path ratio"].split()[0]) == pytest.approx(ratio, rel=0.01)
    assert cells["exposures"] == "0" and cells["contrast ml"] == "0"

    def changed(change):
        other = json.loads(json.dumps(read))
        change(other)
        rest = {key: value for key, value in other.items() if key != "sha256"}
        return other, {**rest, "sha256": benchmark._sum_of(rest)}

    def better(other):
        other["tasks"]["tube"]["metrics"]["time"][0] = 0.1

    def other_seeds(other):
        other["tasks"]["tube"]["episodes"][0]["seed"] = 7

    for change, said in ((better, "do not follow from its episodes"), (other_seeds, "seeds of tube are not")):
        for wrong, why in zip(changed(change), ("it was changed", said)):
            file.write_text(json.dumps(wrong))
            with pytest.raises(Error, match=why):
                benchmark.load(file)
    for text in ("{}", "[", "[1]"):
        file.write_text(text)
        with pytest.raises(Error, match="no results file") as refused:
            benchmark.load(file)
        assert "\n" not in str(refused.value)


def test_vessels_to_test_on_are_none_of_those_to_train_on():
    for kind in ("siphon", "arch", "coronary"):
        train, test = (find_task(f"{kind}-{tier}") for tier in ("train", "test"))
        assert (len(train.anatomies), len(test.anatomies)) == (20, 10)
        files = {one["from"] for one in train.anatomies} & {one["from"] for one in test.anatomies}
        assert not files or kind == "coronary"    # of one tree there are other shapes
        assert not {one["warp"] for one in train.anatomies} & {one["warp"] for one in test.anatomies}
        assert (train.targets, train.random, train.time) == (test.targets, test.random, test.time)
    assert set(all_tasks("test")) == {"siphon-test", "arch-test", "coronary-test"} and "siphon-train" not in all_tasks()
    with Environment("siphon-test") as own:
        shapes = []
        for anatomy in range(3):
            own.reset(options={"nominal": True, "anatomy": anatomy})
            shapes.append(own.session.walls()[0].vertices)
        assert np.abs(shapes[0] - shapes[1]).max() > 1.0 and np.abs(shapes[1] - shapes[2]).max() > 1.0


def test_a_demonstration_holds_what_the_episode_had_and_goes_into_files_of_others(tube, tmp_path):
    with Environment(tube) as own:
        drives = demonstrate(own, TurnAndRetry(own), range(3), "by a test")
        RecordedDrive.save_all(drives, tmp_path / "drives.json")
        read = RecordedDrive.load_all(tmp_path / "drives.json")
        assert len(read) == len(drives) > 1 and RecordedDrive.load(tmp_path / "drives.json").digest == drives[0].digest
        made = [trajectory_of(own, drive) for drive in read]
        policy, observation = TurnAndRetry(own), own.reset(options=drives[1].options)[0]
        policy.reset(observation)
        total = 0.0
        for k, action in enumerate(made[1].actions):
            for part, value in observation.items():
                np.testing.assert_array_equal(made[1].observations[part][k], value)
            expected = policy.act(observation)
            assert np.abs(action - expected).max() < 1e-6
            observation, reward, _, _, _ = own.step(expected)
            total += reward
        assert made[1].terminations.tolist() == [False] * k + [True] and made[1].report["success"]
        assert made[1].rewards.sum() == pytest.approx(total, rel=1e-9) and made[1].source == "by a test"
        save_npz(made, tmp_path / "steps.npz")
        with np.load(tmp_path / "steps.npz") as steps:
            start = steps["starts"][1]
            assert len(steps["actions"]) == sum(len(one.rewards) for one in made)
            np.testing.assert_array_equal(steps["tip"][start:start + k + 1], made[1].observations["tip"][:-1])
            np.testing.assert_array_equal(steps["next_tip"][start:start + k], steps["tip"][start + 1:start + k + 1])
        h5py = pytest.importorskip("h5py", reason="Minari's files are written with h5py")
        save_minari(own, made, tmp_path / "tube", "tube/retry-v0")
        with pytest.raises(Error, match="there is a data set already"):
            save_minari(own, made, tmp_path / "tube", "tube/retry-v0")
        about = json.loads((tmp_path / "tube" / "data" / "metadata.json").read_text())
        assert about["total_episodes"] == len(made) and about["data_format"] == "hdf5"
        space = json.loads(about["observation_space"])
        with h5py.File(tmp_path / "tube" / "data" / "main_data.hdf5") as file:
            assert sum(one.attrs["total_steps"] for one in file.values()) == about["total_steps"]
            episode = file["episode_1"]
            np.testing.assert_array_equal(episode["actions"][()], made[1].actions)
            assert set(space["subspaces"]) == set(episode["observations"])
            for part, one in space["subspaces"].items():
                values = episode["observations"][part]
                assert values.shape == (k + 2, *one["shape"]) and values.dtype == one["dtype"]


def test_a_network_has_the_gradients_of_its_error_and_is_the_same_in_a_file(tmp_path):
    random = np.random.default_rng(2)
    network = Network([random.normal(size=(4, 5)), random.normal(size=(6, 2))])
    inputs, outputs = random.normal(size=(7, 3)), random.uniform(-1.0, 1.0, (7, 2))

    def error():
        return 0.5 * np.sum((network.of(inputs) - outputs)**2) / len(inputs)

    for weights, gradient in zip(network.weights, network.gradients(inputs, outputs)):
        for index in ((0, 0), (2, 1), (len(weights) - 1, 0)):
            before = weights[index]
            weights[index] = before + 1e-5
            above = error()
            weights[index] = before - 1e-5
            slope = (above - error()) / 2e-5
            weights[index] = before
            assert gradient[index] == pytest.approx(slope, rel=1e-5, abs=1e-9)
    network.save(tmp_path / "network.npz")
    np.testing.assert_allclose(Network.load(tmp_path / "network.npz").of(inputs), network.of(inputs), atol=1e-5)
    fitted = Network.fitted(np.repeat(inputs, 40, axis=0), np.repeat(0.5 * outputs, 40, axis=0), seed=1)
    assert np.abs(fitted.of(inputs) - 0.5 * outputs).max() < 0.2
