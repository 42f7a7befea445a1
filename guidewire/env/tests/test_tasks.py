"""Several environments at once, the tasks that ship, and what plays and learns them."""

import json
import os
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from guidewire.env import Drive, Environment, RecordedDrive, VectorEnvironment, all_tasks
from guidewire.env.baselines import Chance, TurnAndRetry
from guidewire.env.recorded import digest_of
from guidewire.env.score import digest, play
from guidewire.env.spaces import ClosedEnvironmentError, Error
from guidewire.env.task import find_task
from guidewire.env.tests.environment_cases import same, tube  # noqa: F401
from guidewire.prepare import ROOT
from guidewire.sessions.session import Session

FULL = bool(os.environ.get("GUIDEWIRE_ALL"))
DATA = ROOT / "guidewire" / "env" / "data"


@pytest.mark.parametrize("backend", ["threads", pytest.param("processes", marks=pytest.mark.skipif(
    not FULL, reason="a second for each process"))])
def test_several_at_once_have_the_bits_of_each_alone_whatever_the_number_of_workers(tube, backend):
    tube = replace(tube, time=0.7)    # five steps of an episode
    seeds, actions = [11, 12], np.random.default_rng(1).uniform(-1.0, 1.0, (8, 2, 2)).astype("f")

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

    expected = np.stack([alone(k) for k in range(2)], axis=1)
    for workers in (1, 2) if FULL and backend == "threads" else (2,):
        with VectorEnvironment(tube, 2, workers, backend) as vector:
            observation, _ = vector.reset(seed=seeds)
            assert vector.observation_space.contains(observation) and vector.num_envs == 2
            seen, reports = [observation["tip"]], 0
            for action in actions:
                observation, rewards, terminated, truncated, info = vector.step(action)
                assert rewards.shape == terminated.shape == truncated.shape == (2,)
                reports += int(np.sum(info.get("_report", 0)))
                seen.append(observation["tip"])
            assert reports >= 2    # every one of them has ended and begun again: 8 steps are more than one episode
        np.testing.assert_array_equal(np.array(seen), expected)
        with pytest.raises(ClosedEnvironmentError):
            vector.reset()


def test_environment_i_of_several_has_the_seed_plus_i(tube):
    with VectorEnvironment(tube, 2) as vector:
        one, info = vector.reset(seed=7)
        other, listed = vector.reset(seed=[7, 8])
        same(one, other)
        for key, values in info["draw"].items():
            assert values.tolist() == listed["draw"][key].tolist()
        assert len({(one, other) for one, other in zip(info["draw"]["target"].tolist(),
                                                       info["draw"]["tip_turn"].tolist())}) == 2


def test_after_an_end_the_next_step_begins_anew_without_looking_at_its_action(tube):
    with VectorEnvironment(tube, 1) as vector:
        vector.reset(seed=1)
        for _ in range(20):
            _, _, _, truncated, info = vector.step(np.zeros((1, 2), np.float32))
        assert truncated[0] and info["report"]["end"].tolist() == ["time"] and info["_report"].tolist() == [True]
        assert info["report"]["left"].dtype == float and info["report"]["_left"].tolist() == [True]
        _, rewards, terminated, truncated, info = vector.step(np.full((1, 2), np.nan))
        assert (rewards[0], terminated[0], truncated[0]) == (0.0, False, False) and "draw" in info


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
    read = json.loads(Path(tube.scene).read_text())
    (narrow / "scene.json").write_text(json.dumps({**read, "vessel": {**read["vessel"], "radius": 2.0}}))
    wide = Path(tube.anatomies[0]).read_text()
    (narrow / "anatomy.json").write_text(wide.replace(", 3.0]", ", 2.0]"))
    both = replace(tube, scene="", anatomies=(*tube.anatomies, str(narrow / "anatomy.json")), frictions=(0.0,))
    with Environment(both) as own:
        drawn = [(own.reset(seed=seed)[1], own.widest) for seed in range(8)]
        assert {info["draw"]["anatomy"] for info, _ in drawn} == {0, 1}
        assert all(widest == (3.0, 2.0)[info["draw"]["anatomy"]] for info, widest in drawn)
        met = [info["draw"]["anatomy"] for info, _ in drawn]
        assert [info["loaded"] for info, _ in drawn] == [k > 0 and one == met[k - 1] for k, one in enumerate(met)]


def test_gymnasiums_own_check_passes_on_every_task(tube):
    pytest.importorskip("gymnasium", reason="gymnasium is not installed; its protocol is tested above")
    from gymnasium.utils.env_checker import check_env

    for task in [tube, *(all_tasks() if FULL else ["artery"])]:
        for drive in (Drive(), Drive(actions="discrete")):
            check_env(Environment(task, drive=drive), skip_render_check=True)


def test_tasks_that_ship_name_their_files_and_turn_and_retry_reaches_a_branch():
    tasks = all_tasks()
    assert {"artery", "arch", "siphon", "carotid", "microcatheter", "coronary"} == set(tasks)
    assert all(task.summary and Path(file).is_file() for task in tasks.values() for file in task.anatomies)
    with Environment("artery") as own:
        played = play(own, TurnAndRetry(own), 1)
        assert played.faults == [] and played.report["success"] and 0.0 < played.report["largest_force"] < 1.5


RECORDED = sorted(file.name.removesuffix("-demonstration.json") for file in DATA.glob("*-demonstration.json"))


@pytest.mark.parametrize("task", RECORDED if FULL else ["artery"])
def test_demonstrations_reach_their_targets_to_the_same_bits(task):
    drives = RecordedDrive.load_all(DATA / f"{task}-demonstration.json")
    assert len(drives) >= (6 if task == "carotid" else 10)
    with Environment(task) as own:
        for drive in drives if FULL else drives[:2]:
            assert drive.source.startswith(("by keys", "by the policy retry")) and len(drive.calls) > 10
            assert own.replay(drive).success


@pytest.mark.parametrize("task", ["tube", *(all_tasks() if FULL else [])])
def test_random_episodes_end_as_they_say_without_a_number_that_is_none(tube, task):
    count = 50 if FULL else 2

    def bits():
        with Environment(tube if task == "tube" else task) as own:
            played = [play(own, Chance(own, seed), seed) for seed in range(count)]
        assert [fault for one in played for fault in one.faults] == []
        return digest(played)

    first = bits()
    assert FULL or bits() == first


@pytest.mark.parametrize("task", ["siphon", "arch"])
def test_a_session_of_an_oblique_sheath_is_reset_and_restored_to_the_same_bits(task):
    with Environment(task) as own:
        own.reset(options={"nominal": True})
        scene = dict(own.scene)
    with Session(None, hand=True, **scene) as session:
        run = [digest_of(session.step(push=1.0, turn=0.1, steps=3)) for _ in range(3)]
        for _ in range(2):    # once more from what was restored
            session.reset()
            assert digest_of(session.step(push=1.0, turn=0.1, steps=3)) == run[0]
            saved = session.save()
            assert digest_of(session.step(push=1.0, turn=0.1, steps=3)) == run[1]
            session.restore(saved)
            session.restore(session.save())
            assert [digest_of(session.step(push=1.0, turn=0.1, steps=3)) for _ in range(2)] == run[1:]


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


@pytest.mark.long("2 s; a network learns the same from the same seed by the same calls")
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
    monkeypatch.setattr("sys.argv", ["train.py", str(tmp_path / "scene.json"), "1"])
    exec(compile(script, "train.py", "exec"), {"__name__": "__main__"})
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 4 and all(" N" in line and "after" in line for line in said[-3:])
