"""Several environments of one task at once, over threads or processes; the bits do not depend on their number."""

from __future__ import annotations

import multiprocessing
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from guidewire.env.environment import Environment
from guidewire.env.options import need_count
from guidewire.env.spaces import AutoresetMode, ClosedEnvironmentError, Error, ResetNeeded, VectorEnv, batch_space
from guidewire.env.workers import Processes, Threads

_MODES = {one: one for one in (AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP)}
_MODES |= {one.value: one for one in _MODES}


class VectorEnvironment(VectorEnv):
    """Gymnasium's vector environment.

    Parameters
    ----------
    task : of all of them, as Environment has it.
    num_envs : how many environments.
    workers : threads or processes that step them; None: one each, up to the processors.
    backend : "threads": the native library, or a runner process for each session, simulates beside Python; or
        "processes", where what Python does counts as well.
    autoreset_mode : when an episode follows the one that has ended, as Gymnasium's AutoresetMode: "NextStep" or
        "SameStep".
    options : of each Environment.

    Raises
    ------
    Error : a value is not allowed, or cannot be sent to a process.

    Notes
    -----
    Environment i draws its episodes from seed + i, and an episode depends on its draw and its actions alone. With
    NextStep the call after one with terminated or truncated begins another episode there: its action is not looked at,
    its reward is 0. With SameStep the observation is that of the new episode, and `info` has "final_obs" and
    "final_info" of the old one. Values of `info` are arrays, or dicts of arrays, with "_name" for those that are there,
    as Gymnasium's are. Actions are looked at before anything moves: where one is not allowed, nothing has changed.
    """

    def __init__(self, task: Any = "artery", num_envs: int = 2, workers: int | None = None, backend: str = "threads",
                 autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP, **options: Any) -> None:
        if backend not in ("threads", "processes"):
            raise Error(f"backend = {backend!r} is not allowed: needs \"threads\" or \"processes\"")
        if autoreset_mode not in _MODES:
            raise Error(f"autoreset_mode = {autoreset_mode!r} is not allowed: needs \"NextStep\" or \"SameStep\"")
        need_count("num_envs", num_envs, 1)
        if workers is not None:
            need_count("workers", workers, 1)
        workers = min(num_envs, workers or multiprocessing.cpu_count())
        self.num_envs = num_envs
        self._one = Environment(task, **options)    # opens no session
        self._one.close()
        self.single_action_space = self._one.action_space
        self.single_observation_space = self._one.observation_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.metadata = {**Environment.metadata, "autoreset_mode": _MODES[autoreset_mode]}
        self.render_mode, self.spec, self.closed = options.get("render_mode"), None, False
        self._begins_anew = _MODES[autoreset_mode] == AutoresetMode.SAME_STEP
        kind = Threads if backend == "threads" else Processes
        self._group = kind([list(range(k, num_envs, workers)) for k in range(workers)], task, options)
        self._ends = np.zeros(num_envs, dtype=bool)
        self._is_reset = False

    def reset(self, *, seed: int | Sequence[int | None] | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode in each; seeds are seed + i, or those of a list. What has ended is started anew."""
        if seed is None:
            seeds = [None] * self.num_envs
        else:
            seeds = list(seed) if isinstance(seed, (Sequence, np.ndarray)) else [seed + i for i in range(self.num_envs)]
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds for {self.num_envs} environments")
        self._check_open()
        self._group.revive()
        answers = self._ask([("reset", (one, options)) for one in seeds])
        self._ends[:] = False
        self._is_reset = True
        return self._stacked([seen for seen, _ in answers]), self._gathered([info for _, info in answers])

    def step(self, actions: Any) -> tuple[Any, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """Return one step in each, or a new episode where the last one had ended.

        Raises
        ------
        InvalidAction : one of them is not allowed; nothing has changed.
        ResetNeeded, ClosedEnvironmentError : no episodes go on; a process has ended, and reset() starts it anew.
        """
        self._check_open()
        if not self._is_reset:
            raise ResetNeeded("no episodes go on: call reset() first")
        if len(actions) != self.num_envs:
            raise ValueError(f"{len(actions)} actions for {self.num_envs} environments")
        for ended, action in zip(self._ends, actions):
            if not ended:
                self._one.check_action(action)
        answers = self._ask([("reset", (None, None)) if ended else ("step", (action, self._begins_anew))
                             for ended, action in zip(self._ends, actions)])
        answers = [(seen[0], 0.0, False, False, seen[1]) if len(seen) == 2 else seen for seen in answers]
        seen, rewards, terminated, truncated, infos = zip(*answers)
        terminated, truncated = np.array(terminated), np.array(truncated)
        self._ends = (terminated | truncated) & (not self._begins_anew)
        return self._stacked(seen), np.array(rewards, dtype=np.float64), terminated, truncated, self._gathered(infos)

    def call(self, name: str, *arguments: Any, **named: Any) -> tuple[Any, ...]:
        """Return what a method of each environment returns, or the value of an attribute."""
        self._check_open()
        return tuple(self._ask([("call", (name, arguments, named))] * self.num_envs))

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """Return an attribute of each environment."""
        return self.call(name)

    def set_attr(self, name: str, values: Any) -> None:
        """Set an attribute of each to one value, or to those of a list or tuple."""
        values = values if isinstance(values, (list, tuple)) else [values] * self.num_envs
        if len(values) != self.num_envs:
            raise ValueError(f"{len(values)} values for {self.num_envs} environments")
        self._check_open()
        self._ask([("set", (name, one)) for one in values])

    def render(self) -> tuple[Any, ...]:
        """Return a picture of each environment."""
        return self.call("render")

    def close(self, **_: Any) -> None:
        """End all; may be called again."""
        if not self.closed:
            self.closed = True
            self._group.close()

    def __enter__(self) -> VectorEnvironment:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def _ask(self, requests: Sequence[tuple[str, tuple[Any, ...]]]) -> list[Any]:
        try:
            return self._group.ask(requests)
        except BaseException:    # some have gone on, others have not
            self._is_reset = False
            raise

    def _stacked(self, seen: Sequence[Any]) -> Any:
        if isinstance(seen[0], dict):
            return {name: np.stack([one[name] for one in seen]) for name in seen[0]}
        return np.stack(seen)

    def _gathered(self, infos: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
        """Values by name as arrays, dicts as dicts of these, and which environments have them."""
        gathered: dict[str, Any] = {}
        for name in dict.fromkeys(name for info in infos for name in info):
            there = np.array([name in info for info in infos])
            values = [info.get(name) for info in infos]
            first = values[int(np.argmax(there))]
            if isinstance(first, dict) and name != "final_obs":
                gathered[name] = self._gathered([value or {} for value in values])
            elif isinstance(first, (bool, int, float, np.number)) and name != "final_obs":
                gathered[name] = np.array([value if has else 0 for value, has in zip(values, there)], dtype=type(first))
            else:
                gathered[name] = np.empty(len(infos), dtype=object)
                for k, value in enumerate(values):
                    gathered[name][k] = value
            gathered[f"_{name}"] = there
        return gathered

    def _check_open(self) -> None:
        if self.closed:
            raise ClosedEnvironmentError("this environment is closed")
