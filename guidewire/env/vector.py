"""Several environments of one task at once, over threads or processes; the bits do not depend on their number."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np

from guidewire.env.environment import Environment
from guidewire.env.spaces import NEXT_STEP, ClosedEnvironmentError, Error, ResetNeeded, VectorEnv, batch_space

_WITHOUT_GUARD = 68  # exit code of a process that would start others while it imports the script
_GUARD = ('VectorEnvironment(backend="processes") starts processes that import this script: what it does belongs below '
          'if __name__ == "__main__":')


class VectorEnvironment(VectorEnv):
    """Gymnasium's vector environment with autoreset at the next step.

    Parameters
    ----------
    task : of all of them, as Environment has it.
    num_envs : how many environments.
    workers : threads or processes that step them; None: one each, up to the processors.
    backend : "threads": the native library, or a runner process for each session, simulates beside Python; or
        "processes", where what Python does counts as well.
    options : of each Environment.

    Notes
    -----
    Environment i draws its episodes from seed + i, and an episode depends on its draw and its actions alone. After a
    step with terminated or truncated the next call begins another episode there: its action is not looked at, its
    reward is 0. Values of `info` are arrays, with "_name" for those that are there, as Gymnasium's are.
    """

    metadata = {"render_modes": [], "autoreset_mode": NEXT_STEP}

    def __init__(self, task: Any = "artery", num_envs: int = 2, workers: int | None = None, backend: str = "threads",
                 **options: Any) -> None:
        if backend not in ("threads", "processes"):
            raise Error(f"backend = {backend!r} is not allowed: needs \"threads\" or \"processes\"")
        if num_envs < 1 or workers is not None and workers < 1:
            raise Error("num_envs and workers are at least 1")
        workers = min(num_envs, workers or multiprocessing.cpu_count())
        self.num_envs = num_envs
        with Environment(task, **options) as one:    # opens no session
            self.single_action_space, self.single_observation_space = one.action_space, one.observation_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.render_mode, self.spec = None, None
        chosen = [list(range(k, num_envs, workers)) for k in range(workers)]
        kind = _Threads if backend == "threads" else _Processes
        self._group = kind(chosen, task, options)
        self._ends = np.zeros(num_envs, dtype=bool)
        self._is_closed = self._is_reset = False

    def reset(self, *, seed: int | Sequence[int | None] | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode in each; seeds are seed + i, or those of a list."""
        self._check_open()
        if seed is None:
            seeds = [None] * self.num_envs
        else:
            seeds = list(seed) if isinstance(seed, (Sequence, np.ndarray)) else [seed + i for i in range(self.num_envs)]
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds for {self.num_envs} environments")
        answers = self._group.ask([("reset", (one, options)) for one in seeds])
        self._ends[:] = False
        self._is_reset = True
        return self._stacked([seen for seen, _ in answers]), _gathered([info for _, info in answers])

    def step(self, actions: Any) -> tuple[Any, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """One step in each, or a new episode where the last one had ended."""
        self._check_open()
        if not self._is_reset:
            raise ResetNeeded("call reset() first")
        if len(actions) != self.num_envs:
            raise ValueError(f"{len(actions)} actions for {self.num_envs} environments")
        answers = self._group.ask([("reset", (None, None)) if ended else ("step", (action,))
                                   for ended, action in zip(self._ends, actions)])
        answers = [(seen[0], 0.0, False, False, seen[1]) if len(seen) == 2 else seen for seen in answers]
        seen, rewards, terminated, truncated, infos = zip(*answers)
        terminated, truncated = np.array(terminated), np.array(truncated)
        self._ends = terminated | truncated
        return self._stacked(seen), np.array(rewards, dtype=np.float64), terminated, truncated, _gathered(infos)

    def close(self, **_: Any) -> None:
        """End all; may be called again."""
        if not self._is_closed:
            self._is_closed = True
            self._group.close()

    def __enter__(self) -> VectorEnvironment:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def _stacked(self, seen: Sequence[Any]) -> Any:
        if isinstance(seen[0], dict):
            return {name: np.stack([one[name] for one in seen]) for name in seen[0]}
        return np.stack(seen)

    def _check_open(self) -> None:
        if self._is_closed:
            raise ClosedEnvironmentError("this environment is closed")


class _Threads:
    """A thread for each list of environments."""

    def __init__(self, chosen: Sequence[Sequence[int]], task: Any, options: Mapping[str, Any]) -> None:
        self._chosen = chosen
        self._environments = {k: Environment(task, **options) for own in chosen for k in own}
        self._pool = ThreadPoolExecutor(len(chosen), "environment")

    def ask(self, requests: Sequence[tuple[str, tuple[Any, ...]]]) -> list[Any]:
        """Answers in the order of the environments."""
        waiting = [self._pool.submit(_answers, self._environments, [(k, requests[k]) for k in own])
                   for own in self._chosen]
        done = [one.exception() or one.result() for one in waiting]    # all, before the first error is raised
        return _in_order(done)

    def close(self) -> None:
        """End the sessions."""
        self._pool.shutdown()
        for environment in self._environments.values():
            environment.close()


class _Processes:
    """A process for each list of environments."""

    def __init__(self, chosen: Sequence[Sequence[int]], task: Any, options: Mapping[str, Any]) -> None:
        if getattr(multiprocessing.current_process(), "_inheriting", False):    # the script, imported by such a process
            os._exit(_WITHOUT_GUARD)
        context = multiprocessing.get_context("spawn")    # a forked one could not load the native library
        self._chosen, self._pipes, self._processes = chosen, [], []
        for own in chosen:
            here, there = context.Pipe()
            process = context.Process(target=_serve, args=(there, own, task, dict(options)), daemon=True)
            process.start()
            there.close()
            self._pipes.append(here)
            self._processes.append(process)

    def ask(self, requests: Sequence[tuple[str, tuple[Any, ...]]]) -> list[Any]:
        """Answers in the order of the environments."""
        for pipe, own in zip(self._pipes, self._chosen):
            try:
                pipe.send([(k, requests[k]) for k in own])
            except OSError:
                pass    # it has ended, as its answer will say
        done = []
        for pipe, process in zip(self._pipes, self._processes):
            try:
                done.append(pipe.recv())
            except (EOFError, OSError):
                process.join(timeout=10.0)
                done.append(Error(_GUARD) if process.exitcode == _WITHOUT_GUARD
                            else ClosedEnvironmentError("a process of this environment has ended"))
        return _in_order(done)

    def close(self) -> None:
        """End the processes."""
        for pipe in self._pipes:
            try:
                pipe.send(None)
            except OSError:
                pass
        for process in self._processes:
            process.join(timeout=10.0)
            if process.is_alive():
                process.kill()


def _serve(pipe: Any, own: Sequence[int], task: Any, options: Mapping[str, Any]) -> None:
    environments: dict[int, Environment] = {}
    try:
        while (requests := pipe.recv()) is not None:
            try:
                environments = environments or {k: Environment(task, **options) for k in own}
                answer: Any = _answers(environments, requests)
            except Exception as error:    # for whoever asked
                answer = error
            pipe.send(answer)
    except (EOFError, KeyboardInterrupt):
        pass
    finally:
        for environment in environments.values():
            environment.close()


def _answers(environments: Mapping[int, Environment], requests: Sequence[tuple[int, tuple[str, tuple[Any, ...]]]]
             ) -> list[tuple[int, Any]]:
    answers = []
    for k, (what, words) in requests:
        if what == "reset":
            answers.append((k, environments[k].reset(seed=words[0], options=words[1])))
        else:
            answers.append((k, environments[k].step(*words)))
    return answers


def _in_order(done: Sequence[Any]) -> list[Any]:
    for answer in done:
        if isinstance(answer, BaseException):
            raise answer
    return [answer for _, answer in sorted((pair for answers in done for pair in answers), key=lambda pair: pair[0])]


def _gathered(infos: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Values by name as arrays, and which environments have them."""
    gathered: dict[str, Any] = {}
    for name in dict.fromkeys(name for info in infos for name in info):
        there = np.array([name in info for info in infos])
        values = [info.get(name) for info in infos]
        if all(isinstance(value, (bool, int, float)) for value, has in zip(values, there) if has):
            gathered[name] = np.array([value if has else 0 for value, has in zip(values, there)])
        else:
            gathered[name] = np.empty(len(infos), dtype=object)
            gathered[name][:] = values
        gathered[f"_{name}"] = there
    return gathered
