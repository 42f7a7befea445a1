"""A network that learns from a task's baseline, in numpy.

    python3 guidewire.py python experiments/learn_network.py TASK [SEEDS] [EPISODES] [ROUNDS]

writes TASK.npz, the weights that earn the most, and TASK.json, the curve of each seed, into the current folder. In each
round the network plays episodes, the baseline says at every step what it would do there, and the network is fitted to
all that was said so far (DAgger; Ross et al. 2011, arXiv:1011.0686). In the first round the baseline plays.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np

from guidewire.env.baselines import baseline_of
from guidewire.env.environment import Environment
from guidewire.env.network import Network, NetworkPolicy, options_of
from guidewire.env.score import play
from guidewire.env.task import Task, find_task
from guidewire.runs.whole_files import write_whole

FIRST_TRIAL = 1_000_000  # seeds of episodes that are only scored


def learn(task: str | Task, seed: int, episodes: int = 16, rounds: int = 3, scored: int = 8
          ) -> tuple[Network, list[list[float]]]:
    """Return a network, the best of the rounds, and the curve: of each round the steps that were seen so far, the
    success and the mean return of some episodes of other seeds.

    Parameters
    ----------
    episodes : of a round.
    scored : how many episodes judge a round.
    """
    random = np.random.default_rng(seed)
    inputs: list[np.ndarray] = []
    said: list[np.ndarray] = []
    curve: list[list[float]] = []
    best: Network | None = None
    task = find_task(task)
    with Environment(task, **options_of(task)) as environment:
        expert, network = baseline_of(environment), None
        for number in range(rounds):
            for one in random.integers(FIRST_TRIAL, size=episodes):
                observation, _ = environment.reset(seed=int(one))
                policy = NetworkPolicy(network or Network([]))
                policy.reset(observation)
                expert.reset(observation)
                ended = False
                while not ended:
                    inputs.append(policy.inputs(observation))
                    said.append(expert.act(observation))
                    action = said[-1] if network is None else network.of(inputs[-1][None])[0]
                    observation, _, terminated, truncated, _ = environment.step(np.clip(action, -1.0, 1.0))
                    ended = terminated or truncated
            network = Network.fitted(np.array(inputs), np.array(said), seed)
            played = [play(environment, NetworkPolicy(network), FIRST_TRIAL // 2 + k) for k in range(scored)]
            curve.append([len(inputs), float(np.mean([one.report["success"] for one in played])),
                          float(np.mean([one.total for one in played]))])
            if best is None or curve[-1][2] >= max(one[2] for one in curve[:-1]):
                best = network
            print(f"{task.name}, seed {seed}, round {number}: {len(inputs)} steps, success {curve[-1][1]:.0%}, return "
                  f"{curve[-1][2]:.3f}", flush=True)
    assert best is not None
    return best, curve


def main() -> None:
    """Learn, and write the weights and the curves."""
    name = sys.argv[1]
    seeds, episodes, rounds = (int(sys.argv[k]) if len(sys.argv) > k else value
                               for k, value in ((2, 3), (3, 16), (4, 3)))
    began, found = time.process_time(), [learn(name, seed, episodes, rounds) for seed in range(seeds)]
    best = max(found, key=lambda one: max(row[2] for row in one[1]))[0]
    best.save(Path(f"{name}.npz"))
    write_whole(Path(f"{name}.json"), json.dumps({
        "task": name, "episodes": episodes, "processor seconds": round(time.process_time() - began),
        "curves": [curve for _, curve in found]}) + "\n")


if __name__ == "__main__":
    main()
