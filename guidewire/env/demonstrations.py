"""Demonstrations: recorded drives with observations, actions and rewards, for learning from them elsewhere.

A drive is what was asked of the hubs; to replay it gives all else, with the same bits. `save_npz` writes plain arrays,
`save_minari` the layout of Minari's HDF5 storage, which needs h5py.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.environment import Environment
from guidewire.env.recorded import RecordedDrive
from guidewire.env.registration import spec_of
from guidewire.env.score import Policy
from guidewire.env.spaces import Error
from guidewire.installed import version
from guidewire.runs.whole_files import whole_file, write_whole


@dataclass(frozen=True)
class Trajectory:
    """An episode of n steps.

    Attributes
    ----------
    observations : by part, or under "" where they are flat, (n + 1, ...) each.
    actions : (n, 2 k) of k hubs, fractions of the largest rates.
    rewards, terminations, truncations : (n,).
    infos : of each step, less the report of the last one.
    report : of the episode.
    source : by whom.
    """

    observations: dict[str, np.ndarray]
    actions: np.ndarray
    rewards: np.ndarray
    terminations: np.ndarray
    truncations: np.ndarray
    infos: list[dict[str, Any]]
    report: dict[str, Any]
    source: str


def trajectory_of(environment: Environment, drive: RecordedDrive) -> Trajectory:
    """Replay a drive; errors as of `Environment.replay`."""
    steps = list(environment.replayed(drive))
    seen = [one.observation if isinstance(one.observation, dict) else {"": one.observation} for one in steps]
    made = steps[1:]
    report = environment.report.as_info()
    return Trajectory({part: np.stack([one[part] for one in seen]) for part in seen[0]},
                      np.array([one.action for one in made], dtype=np.float32).reshape(len(made), -1),
                      np.array([one.reward for one in made]), np.array([one.terminated for one in made]),
                      np.array([one.truncated for one in made]),
                      [{key: value for key, value in one.info.items() if key != "report"} for one in made],
                      report, drive.source)


def demonstrate(environment: Environment, policy: Policy, seeds: Iterable[int], source: str) -> list[RecordedDrive]:
    """Drives of the episodes of these seeds in which a policy reaches the target safely."""
    drives = []
    for seed in seeds:
        observation, _ = environment.reset(seed=seed)
        policy.reset(observation)
        ended = False
        while not ended:
            observation, _, terminated, truncated, _ = environment.step(policy.act(observation))
            ended = terminated or truncated
        if environment.report.safe_success:
            drives.append(environment.recorded(source))
    return drives


def save_npz(trajectories: Sequence[Trajectory], file: Path) -> None:
    """Write all steps one behind the other: "actions", "rewards", "terminations", "truncations" (n, ...), "starts" of
    the episodes in these, and each part of the observations, and of those after a step under "next_" and its name."""
    counts = [len(one.rewards) for one in trajectories]
    arrays = {name: np.concatenate([getattr(one, name) for one in trajectories])
              for name in ("actions", "rewards", "terminations", "truncations")}
    arrays["starts"] = np.cumsum([0, *counts[:-1]])
    for part in trajectories[0].observations:
        name = part or "observations"
        arrays[name] = np.concatenate([one.observations[part][:-1] for one in trajectories])
        arrays[f"next_{name}"] = np.concatenate([one.observations[part][1:] for one in trajectories])
    with whole_file(file) as partial, partial.open("wb") as output:
        np.savez_compressed(output, **arrays)


def save_minari(environment: Environment, trajectories: Sequence[Trajectory], folder: Path, name: str) -> None:
    """Write a data set as Minari stores it: `folder`/data/main_data.hdf5 and metadata.json. A folder of that name below
    its own one of data sets is loaded by `minari.load_dataset`.

    Raises
    ------
    Error : h5py is missing, or there is a data set already.
    """
    try:
        import h5py
    except ImportError as error:
        raise Error("Minari's files are written with h5py: pip install h5py, or apt-get install python3-h5py"
                    ) from error
    data = folder / "data"
    if (data / "metadata.json").exists():
        raise Error(f"{data}: there is a data set already")
    data.mkdir(parents=True, exist_ok=True)
    with whole_file(data / "main_data.hdf5") as partial, h5py.File(partial, "w", track_order=True) as file:
        for k, one in enumerate(trajectories):
            group = file.create_group(f"episode_{k}")
            group.attrs["id"], group.attrs["total_steps"] = k, len(one.rewards)
            if "" in one.observations:
                group["observations"] = one.observations[""]
            else:
                for part, values in one.observations.items():
                    group[f"observations/{part}"] = values
            for key in ("actions", "rewards", "terminations", "truncations"):
                group[key] = getattr(one, key)
            for key in ("force", "left"):
                group[f"infos/{key}"] = np.array([info[key] for info in one.infos])
    size = (data / "main_data.hdf5").stat().st_size / 1e6
    write_whole(data / "metadata.json", json.dumps({
        "total_episodes": len(trajectories), "total_steps": sum(len(one.rewards) for one in trajectories),
        "data_format": "hdf5", "dataset_id": name, "dataset_size": round(size, 1),
        "observation_space": json.dumps(_space(environment.observation_space)),
        "action_space": json.dumps(_space(environment.action_space)), "env_spec": json.dumps({
            **spec_of(environment.task), "nondeterministic": False, "order_enforce": True,
            "disable_env_checker": False, "additional_wrappers": []}),
        "algorithm_name": ", ".join(dict.fromkeys(one.source for one in trajectories)), "code_permalink": "",
        "author": "", "author_email": "", "requirements": [f"guidewire=={version()}"], "minari_version": ">=0.5.0"}))


def _space(space: Any) -> dict[str, Any]:
    if hasattr(space, "spaces"):
        return {"type": "Dict", "subspaces": {key: _space(one) for key, one in space.spaces.items()}}
    if hasattr(space, "n"):
        return {"type": "Discrete", "dtype": "int64", "start": int(space.start), "n": int(space.n)}
    return {"type": "Box", "dtype": str(space.dtype), "shape": list(space.shape), "low": space.low.tolist(),
            "high": space.high.tolist()}
