"""Names of the tasks for `gymnasium.make` and `make_vec`: guidewire/artery-v0 and so on."""

from __future__ import annotations

from guidewire.env.task import all_tasks

VERSION = 0


def register() -> None:
    """Name them; may be called again."""
    from gymnasium.envs import registration

    for name in all_tasks():
        known = f"guidewire/{name}-v{VERSION}"
        if known not in registration.registry:
            registration.register(id=known, entry_point="guidewire.env.environment:Environment",
                                  vector_entry_point="guidewire.env.registration:make_vector", kwargs={"task": name})


def make_vector(num_envs: int = 2, **options: object) -> object:
    """Return a VectorEnvironment, as `gymnasium.make_vec` asks for one."""
    from guidewire.env.vector import VectorEnvironment

    return VectorEnvironment(num_envs=num_envs, **options)
