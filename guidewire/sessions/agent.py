"""Contrast agent in the vessel of a session."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Agent:
    """What is where.

    Attributes
    ----------
    parts : (k,), of the blood in each cell of the vessel's tree that is agent, from 0 to 1; cells as of
        `Session.describe`.
    injected, held, washed_out : ml so far, in the vessel now, and gone with the blood.
    is_active : whether there is agent, or will be.
    is_injecting : whether an injection goes on.
    inlet : flow of the blood where it comes in, ml/s.
    """

    parts: np.ndarray
    injected: float
    held: float
    washed_out: float
    is_active: bool
    is_injecting: bool
    inlet: float

    @classmethod
    def of(cls, answer: Mapping[str, Any]) -> Agent:
        """Return what an answer of the runner says."""
        parts = np.frombuffer(base64.b64decode(answer["agent"]), "<f8").copy()
        return cls(parts, answer["injected"], answer["held"], answer["washedOut"], answer["isActive"],
                   answer["isInjecting"], answer["inlet"])
