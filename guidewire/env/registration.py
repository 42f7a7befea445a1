"""Names of the tasks for `gymnasium.make` and `make_vec`: guidewire/artery-v0 and so on."""

from __future__ import annotations

import math
from typing import Any

from guidewire.env.drive import Drive
from guidewire.env.environment import Reward
from guidewire.env.spaces import Error
from guidewire.env.task import Task, all_tasks, find_task

def spec_of(task: Task) -> dict[str, Any]:
    """Return what `gymnasium.register` and a spec in JSON take of a task."""
    return {"id": f"guidewire/{task.name}-v0", "entry_point": "guidewire.env.environment:Environment",
            "vector_entry_point": "guidewire.env.registration:make_vector", "kwargs": {"task": task.name},
            "max_episode_steps": math.ceil(task.time / Drive().step_time - 1e-9),
            # Of an episode that reaches the target at the last moment.
            "reward_threshold": 2.0 + Reward().time * task.time}


def register() -> None:
    """Name them; may be called again."""
    from gymnasium.envs import registration

    for known in map(spec_of, all_tasks(None).values()):
        if known["id"] not in registration.registry:
            registration.register(**known)


def make_vector(num_envs: int = 2, max_episode_steps: int | None = None, **options: Any) -> object:
    """Return a VectorEnvironment, as `gymnasium.make_vec` asks for one, with the steps of its spec.

    Raises
    ------
    Error : other steps are asked for: an episode ends after the task's time.
    """
    from guidewire.env.vector import VectorEnvironment

    if max_episode_steps not in (None, spec_of(find_task(options["task"]))["max_episode_steps"]):
        raise Error(f"max_episode_steps = {max_episode_steps} is not allowed here: an episode ends after the task's "
                    "time")
    return VectorEnvironment(num_envs=num_envs, **options)
