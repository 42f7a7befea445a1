"""Evolution strategies over environments: what was learned, and that a seed gives the same bits."""

import json
from dataclasses import replace

import numpy as np
import pytest

from experiments.evolution import Linear, draw, learn, score
from guidewire.env import Environment
from guidewire.env.baselines import TurnAndRetry
from guidewire.env.score import play
from guidewire.env.task import FOLDER, find_task
from guidewire.env.tests.environment_cases import tube  # noqa: F401


@pytest.mark.long("4 s; learning, and an episode of turn and retry, have tests of their own")
def test_what_was_learned_reaches_the_target_sooner_and_with_less_force_than_turn_and_retry():
    seeds = range(1_000_000, 1_000_006)    # not among those of the training
    learned = json.loads((FOLDER / "learned.json").read_text())
    task = replace(find_task("artery"), frictions=(0.05,))    # one vessel to be read
    mine = score(task, np.array(learned["parameters"]), list(seeds))
    with Environment(task) as own:
        theirs = [play(own, TurnAndRetry(own), seed) for seed in seeds]
    assert all(one.report["safe_success"] for one in mine)
    for key in ("time", "impulse"):
        assert sum(one.report[key] for one in mine) < 0.9 * sum(one.report[key] for one in theirs)
    assert sum(one.total for one in mine) > sum(one.total for one in theirs)


@pytest.mark.long("the same seed gives the same bits")
def test_evolution_learns_the_same_from_the_same_seed(tube, tmp_path):
    one, curve = learn(tube, generations=1, seed=3, pairs=2, episodes=1)
    other, _ = learn(tube, generations=1, seed=3, pairs=2, episodes=1)
    np.testing.assert_array_equal(one, other)
    draw({"curve": curve}, tmp_path / "curve.png")
    assert (tmp_path / "curve.png").stat().st_size > 5000
    assert len(curve) == 1 and np.abs(one).max() > 0.0 and Linear(one).act(
        {"ahead": np.zeros(3), "distance": np.zeros(1), "wall": np.zeros(2)}).shape == (2,)
