"""Gymnasium's spaces, base classes and errors where it is installed, else those of own_spaces."""

from __future__ import annotations

try:
    from gymnasium import Env
    from gymnasium.error import ClosedEnvironmentError, Error, InvalidAction, NameNotFound, ResetNeeded
    from gymnasium.spaces import Box, Dict, Discrete, Space
    from gymnasium.vector import AutoresetMode, VectorEnv
    from gymnasium.vector.utils import batch_space

    NEXT_STEP = AutoresetMode.NEXT_STEP
except ImportError:
    from guidewire.env.own_spaces import (
        Box, ClosedEnvironmentError, Dict, Discrete, Env, Error, InvalidAction, NameNotFound, ResetNeeded, Space,
        VectorEnv, batch_space,
    )

    NEXT_STEP = "NextStep"

__all__ = ["Box", "ClosedEnvironmentError", "Dict", "Discrete", "Env", "Error", "InvalidAction", "NEXT_STEP",
           "NameNotFound", "ResetNeeded", "Space", "VectorEnv", "batch_space"]
