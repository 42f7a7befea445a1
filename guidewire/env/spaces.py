"""Gymnasium's spaces, base classes and errors where it is installed, else those of own_spaces."""

from __future__ import annotations

try:
    from gymnasium import Env
    from gymnasium.error import ClosedEnvironmentError, Error, InvalidAction, NameNotFound, ResetNeeded
    from gymnasium.spaces import Box, Dict, Discrete, Space
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space

except ImportError:
    from guidewire.env.own_spaces import (
        AutoresetMode, Box, ClosedEnvironmentError, Dict, Discrete, Env, Error, InvalidAction, NameNotFound,
        ResetNeeded, Space, VectorEnv, batch_space,
    )

__all__ = ["AutoresetMode", "Box", "ClosedEnvironmentError", "Dict", "Discrete", "Env", "Error", "InvalidAction",
           "NameNotFound", "ResetNeeded", "Space", "VectorEnv", "batch_space"]
