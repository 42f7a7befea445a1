"""A small policy that learns: evolution strategies in numpy, in parallel over processes of its own.

    python3 guidewire.py python experiments/evolution.py [SECONDS] [WORKERS]

writes learned.json and learned.png into the current folder.

The policy is linear in a few numbers of the observation, with a tanh: action = tanh(W f + b). Each generation tries
pairs of opposite changes of (W, b) on the same episodes, ranks them, and moves along the mean of the changes weighted
by rank (Salimans et al. 2017, arXiv:1703.03864, with the ranks of Wierstra et al. 2014). An episode ends in training
where a wall is pressed with more than 0.3 N, and every N s of force costs.
"""

from __future__ import annotations

import json
import multiprocessing
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.environment import Environment, Reward
from guidewire.env.observation import Observation
from guidewire.env.score import Played, play
from guidewire.env.task import Task
from guidewire.runs.whole_files import whole_file, write_whole

SEED = 1
PAIRS, EPISODES = 8, 8  # opposite changes a generation, episodes of each
SIGMA, RATE = 0.4, 0.5  # of a change; of the step along the weighted changes
FEATURES = 5
FIRST_TRIAL = 1_000_000  # seeds of episodes that are only scored
PARTS = Observation(parts=("ahead", "distance", "wall"))
TRAINING = {"observation": PARTS, "reward": Reward(force=-1.0), "safe_force": 0.3, "ends_unsafe": True}


class Linear:
    """tanh of a linear function. parameters : (2 * FEATURES + 2,)."""

    def __init__(self, parameters: np.ndarray) -> None:
        self._weights = parameters[:2 * FEATURES].reshape(2, FEATURES)
        self._bias = parameters[2 * FEATURES:]

    def reset(self, observation: Any) -> None:
        """It keeps nothing."""

    def act(self, observation: Any) -> np.ndarray:
        """Return the next action."""
        features = np.r_[2.0 * observation["ahead"], 0.02 * observation["distance"][0],
                         min(10.0 * observation["wall"][0], 2.0)]
        return np.tanh(self._weights @ features + self._bias).astype(np.float32)


def score(task: str | Task, parameters: np.ndarray, seeds: list[int]) -> list[Played]:
    """Episodes as they are scored, on the task as it ships."""
    with Environment(task, observation=PARTS) as environment:
        return [play(environment, Linear(parameters), seed) for seed in seeds]


_environment: Environment | None = None  # of a worker process, kept open between generations


def _return_of(job: tuple[str | Task, np.ndarray, list[int]]) -> float:
    global _environment
    task, parameters, seeds = job
    _environment = _environment or Environment(task, **TRAINING)
    return float(np.mean([play(_environment, Linear(parameters), seed).total for seed in seeds]))


def learn(task: str | Task = "artery", seconds: float = 600.0, workers: int = 1, generations: int = 1000,
          seed: int = SEED,
          pairs: int = PAIRS, episodes: int = EPISODES) -> tuple[np.ndarray, list[list[float]]]:
    """Parameters and the curve: of each generation seconds, mean and best of its returns.

    Parameters
    ----------
    seconds, generations : after which it ends.
    workers : processes; the parameters do not depend on how many.
    pairs, episodes : opposite changes of a generation, and episodes of each.
    """
    random = np.random.default_rng(seed)
    parameters = np.zeros(2 * FEATURES + 2)
    ranks = np.arange(2 * pairs)
    worth = np.maximum(0.0, np.log(pairs + 1.0) - np.log(ranks + 1.0))
    worth = worth / worth.sum() - 1.0 / len(ranks)
    curve: list[list[float]] = []
    began = time.monotonic()
    pool = multiprocessing.get_context("spawn").Pool(workers) if workers > 1 else None
    try:
        for generation in range(generations):
            changes = random.normal(size=(pairs, len(parameters)))
            changes = np.concatenate([changes, -changes])
            seeds = [int(one) for one in random.integers(FIRST_TRIAL, size=episodes)]
            jobs = [(task, parameters + SIGMA * change, seeds) for change in changes]
            returns = np.array(pool.map(_return_of, jobs, 1) if pool else [_return_of(job) for job in jobs])
            weights = np.empty(len(ranks))
            weights[np.argsort(-returns, kind="stable")] = worth
            parameters = parameters + RATE * SIGMA * len(parameters)**0.5 * (weights @ changes)
            curve.append([time.monotonic() - began, float(returns.mean()), float(returns.max())])
            print(f"{generation}: {curve[-1][0]:.0f} s, return {curve[-1][1]:.3f}, best {curve[-1][2]:.3f}", flush=True)
            if curve[-1][0] > seconds:
                break
    finally:
        if pool is not None:
            pool.terminate()
    return parameters, curve


def draw(learned: Mapping[str, Any], file: Path) -> None:
    """The curve of what was learned: returns over generations and seconds."""
    from matplotlib import pyplot

    from guidewire.figures.style import STYLE

    seconds, mean, best = np.array(learned["curve"]).T
    with pyplot.style.context(STYLE):
        figure, axes = pyplot.subplots(figsize=(6.0, 3.2), layout="constrained")
        axes.plot(seconds, mean, "o-", label="mean of a generation")
        axes.plot(seconds, best, "s-", label="best of a generation")
        axes.set(xlabel="time of learning, s", ylabel="return of an episode", ylim=(min(-0.5, mean.min()), 2.0))
        axes.legend()
        with whole_file(file) as partial:
            figure.savefig(partial, dpi=130)
        pyplot.close(figure)


def main() -> None:
    """Learn, and write the policy with its curve."""
    seconds, workers = float(sys.argv[1]) if len(sys.argv) > 1 else 1000.0, int(sys.argv[2]) if len(sys.argv) > 2 else 2
    parameters, curve = learn(seconds=seconds, workers=workers)
    learned = {"task": "artery", "seed": SEED, "parameters": parameters.tolist(), "curve": curve}
    write_whole(Path("learned.json"), json.dumps(learned) + "\n")
    draw(learned, Path("learned.png"))


if __name__ == "__main__":
    main()
