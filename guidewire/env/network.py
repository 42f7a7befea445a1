"""A small network in numpy, and the policies of networks that were learned; `experiments/learn_network.py` learns them.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.baselines import parts_of
from guidewire.env.environment import Environment
from guidewire.env.observation import Observation
from guidewire.env.spaces import Error
from guidewire.env.task import FOLDER, Task
from guidewire.runs.whole_files import whole_file

HIDDEN, EPOCHS, BATCH, RATE = (64, 64), 60, 128, 2e-3
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
