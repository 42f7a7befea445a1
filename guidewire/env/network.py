"""A small network that learns from a task's baseline, in numpy, and the policies that were learned so.

    python3 guidewire.py python guidewire/env/network.py TASK [SEEDS] [EPISODES] [ROUNDS]

writes TASK.npz, the weights that earn the most, and TASK.json, the curve of each seed, into the current folder. In each
round the network plays episodes, the baseline says at every step what it would do there, and the network is fitted to
all that was said so far (DAgger; Ross et al. 2011, arXiv:1011.0686). In the first round the baseline plays.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.baselines import baseline_of, parts_of
from guidewire.env.environment import Environment
from guidewire.env.observation import Observation
from guidewire.env.score import play
from guidewire.env.spaces import Error
from guidewire.env.task import FOLDER, Task, find_task
from guidewire.runs.whole_files import whole_file, write_whole

HIDDEN, EPOCHS, BATCH, RATE = (64, 64), 60, 128, 2e-3
FIRST_TRIAL = 1_000_000  # seeds of episodes that are only scored
# Units of what the network sees, by part: mm, rad, N, N mm.
_SCALES = {"ahead": 1.0, "distance": 50.0, "hub": np.array([100.0, 3.0]), "loads": np.array([1.0, 1.0]), "wall": 0.3,
           "overlap": 50.0, "action": 1.0}


class Network:
    """Layers with tanh. weights : matrices (inputs + 1, outputs), the last row the bias."""

    def __init__(self, weights: Sequence[np.ndarray]) -> None:
        self.weights = list(weights)

    def of(self, inputs: np.ndarray) -> np.ndarray:
        """Return outputs (n, outputs) of inputs (n, inputs)."""
        return self._layers(inputs)[-1]

    def save(self, file: Path) -> None:
        """Write the weights as float32."""
        with whole_file(file) as partial, partial.open("wb") as output:
            np.savez_compressed(output, *(one.astype(np.float32) for one in self.weights))

    @staticmethod
    def load(file: Path) -> Network:
        """Read weights."""
        with np.load(file) as read:
            return Network([read[f"arr_{k}"].astype(float) for k in range(len(read.files))])

    @staticmethod
    def fitted(inputs: np.ndarray, outputs: np.ndarray, seed: int) -> Network:
        """Fit a network to outputs (n, m) in [-1, 1] by least squares, with Adam."""
        random = np.random.default_rng(seed)
        sizes = [inputs.shape[1], *HIDDEN, outputs.shape[1]]
        network = Network([random.normal(size=(a + 1, b)) / (a + 1)**0.5 for a, b in zip(sizes, sizes[1:])])
        means, squares = ([np.zeros_like(one) for one in network.weights] for _ in range(2))
        step = 0
        for epoch in range(EPOCHS):
            rate = RATE * (1.0 - epoch / EPOCHS)
            order = random.permutation(len(inputs))
            for k in range(0, len(order), BATCH):
                chosen, step = order[k:k + BATCH], step + 1
                for w, g, mean, square in zip(network.weights, network.gradients(inputs[chosen], outputs[chosen]),
                                              means, squares):
                    mean += 0.1 * (g - mean)
                    square += 0.001 * (g * g - square)
                    w -= rate * (mean / (1.0 - 0.9**step)) / (np.sqrt(square / (1.0 - 0.999**step)) + 1e-8)
        return network

    def gradients(self, inputs: np.ndarray, outputs: np.ndarray) -> list[np.ndarray]:
        """Gradients of the mean over samples of half the squared error."""
        layers = self._layers(inputs)
        back = (layers[-1] - outputs) / len(inputs)
        found: list[np.ndarray] = []
        for k in range(len(self.weights) - 1, -1, -1):
            back = back * (1.0 - layers[k + 1]**2)
            found.append(np.vstack([layers[k].T @ back, back.sum(axis=0)]))
            back = back @ self.weights[k][:-1].T
        return found[::-1]

    def _layers(self, inputs: np.ndarray) -> list[np.ndarray]:
        layers = [inputs]
        for one in self.weights:
            layers.append(np.tanh(layers[-1] @ one[:-1] + one[-1]))
        return layers


class NetworkPolicy:
    """Acts as a network says, which sees the observation and the one before it."""

    def __init__(self, network: Network) -> None:
        self._network = network

    def reset(self, observation: Any) -> None:
        """Begin another episode."""
        self._before = features_of(observation)

    def act(self, observation: Any) -> np.ndarray:
        """Return the next action."""
        return self._network.of(self.inputs(observation)[None])[0].astype(np.float32)

    def inputs(self, observation: Any) -> np.ndarray:
        """What the network sees of this step."""
        now = features_of(observation)
        both, self._before = np.concatenate([now, self._before]), now
        return both


def features_of(observation: Any) -> np.ndarray:
    """Return the parts as numbers of the order of 1."""
    return np.concatenate([np.clip(np.ravel(observation[part] / scale), -3.0, 3.0)
                           for part, scale in _SCALES.items() if part in observation])


def options_of(task: Task) -> dict[str, Any]:
    """Return the options of an environment whose observations a network and the baseline can read."""
    return {"observation": Observation(parts=(*parts_of(task), "action"))}


def trained(environment: Environment) -> NetworkPolicy:
    """The policy that was learned for the environment's task; for `tasks --policy guidewire.env.network:trained`.

    Raises
    ------
    Error : there is none.
    """
    file = FOLDER / "networks" / f"{environment.task.name}.npz"
    if not file.is_file():
        raise Error(f"no network was learned for {environment.task.name}: there are those of "
                    f"{', '.join(sorted(one.stem for one in file.parent.glob('*.npz')))}")
    return NetworkPolicy(Network.load(file))


trained.options = options_of    # type: ignore[attr-defined]


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
