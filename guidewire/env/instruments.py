"""The instruments of a state, the wire first, with what each of them has."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from guidewire.sessions.session import State


class Instrument(NamedTuple):
    """One of them.

    Attributes
    ----------
    positions, orientations, contact_forces, strand_forces, place : as of State.
    hub : has insertion, turn, force, torque, tip_direction, as of Hub.
    """

    positions: np.ndarray
    orientations: np.ndarray
    contact_forces: np.ndarray
    strand_forces: np.ndarray | None
    place: Any
    hub: Any


def instruments_of(state: State) -> list[Instrument]:
    """Return the wire, and the catheters over it, outermost first."""
    return [Instrument(one.positions, one.orientations, one.contact_forces, one.strand_forces, one.place, hub)
            for one, hub in ((state, state.hub), *((catheter, catheter) for catheter in state.catheters))]


def names_of(hubs: int) -> list[str]:
    """Return what they are called in reports: "wire", "catheter 1"."""
    return ["wire", *(f"catheter {k}" for k in range(1, hubs))]


def of_each(value: float | Sequence[float], hubs: int) -> list[float]:
    """Return one number for each, where all may have the same."""
    return list(value) if isinstance(value, (list, tuple, np.ndarray)) else [value] * hubs
