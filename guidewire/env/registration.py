"""Names of the tasks for `gymnasium.make` and `make_vec`: guidewire/artery-v0 and so on."""

from __future__ import annotations

import math

from guidewire.env.drive import Drive
from guidewire.env.environment import Reward
from guidewire.env.task import all_tasks

VERSION = 0


def register() -> None:
    """Name them; may be called again."""
    from gymnasium.envs import registration

    step_time, time = Drive().step_time, Reward().time
    for name, task in all_tasks(None).items():
        known = f"guidewire/{name}-v{VERSION}"
        if known not in registration.registry:
            registration.register(id=known, entry_point="guidewire.env.environment:Environment",
                                  vector_entry_point="guidewire.env.registration:make_vector", kwargs={"task": name},
                                  max_episode_steps=math.ceil(task.time / step_time - 1e-9),
                                  # Of an episode that reaches the target at the last moment.
                                  reward_threshold=2.0 + time * task.time)


def make_vector(num_envs: int = 2, **options: object) -> object:
    """Return a VectorEnvironment, as `gymnasium.make_vec` asks for one."""
    from guidewire.env.vector import VectorEnvironment

    return VectorEnvironment(num_envs=num_envs, **options)
