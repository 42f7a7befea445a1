"""What pages are shown of a session: its recording, and each new state as a frame."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from guidewire.logs.walls import name_walls, soft_walls
from guidewire.sessions.session import Session, State
from guidewire.viewer.recording import (
    Channel, Recording, facts_of, largest_shown, lumen_of, make_channels, radius_of, read_off, sheath_of, units_of,
)


class LiveFrames:
    """Recording and frames of a session, from its state of now on.

    Attributes
    ----------
    described : as of `Session.describe`.
    """

    def __init__(self, session: Session, title: str, warnings: Sequence[str] = ()) -> None:
        self._session = session
        self._title = title
        self._warnings = list(warnings)
        self._walls = session.walls()
        self.described = session.describe()
        self._sheath = sheath_of(session.parameters, self._numbers(session.state, 0.0))
        self.begin()

    def begin(self) -> None:
        """The state of now is the first one that is shown."""
        self._begun = self._session.state
        self._largest = largest_shown(self._channels(0.0, self._begun))

    def exchange(self) -> None:
        """The same, of other instruments in a run that goes on."""
        before = self._largest
        self.described = self._session.describe()
        self.begin()
        self._largest = np.maximum(before, self._largest)

    def record(self, cost: float) -> Recording:
        """Return the session as it is now and as it began, with its walls.

        Parameters
        ----------
        cost : wall time of a step, s; 0 where it is not known.
        """
        session, state = self._session, self._session.state
        states = [state] if self._begun.step == state.step else [self._begun, state]
        return Recording(
            self._title, "", self._warnings, facts_of(session.parameters, None), radius_of(session.parameters),
            self._channels(cost, *states), name_walls(session.parameters, self._walls), self._sheath, self._largest,
            self.described, soft_walls(session.parameters),
        )

    def frame(self, state: State, cost: float, *head: float) -> bytes:
        """Return a state as doubles: a head, the largest size of each channel so far, and all channels."""
        channels = self._channels(cost, state)
        self._largest = np.maximum(self._largest, largest_shown(channels))
        numbers = np.concatenate([head, self._largest, *(channel.values.ravel() for channel in channels)])
        return numbers.astype("<f8").tobytes()

    def _channels(self, cost: float, *states: State) -> list[Channel]:
        numbers = [self._numbers(state, cost) for state in states]
        together = {name: None if values is None else np.concatenate([one[name] for one in numbers])
                    for name, values in numbers[0].items()}
        return make_channels(units_of(self._session.parameters), together)

    def _numbers(self, state: State, cost: float) -> dict[str, Any]:
        walls = bool(self._walls)
        real_time = float(self._session.parameters["timeStep"]) / cost if cost > 0.0 else math.nan
        return {
            "step": np.array([state.step]), "time": np.array([state.time]), "positions": state.positions[None],
            "orientations": state.orientations[None], "contact_forces": state.contact_forces[None] if walls else None,
            **{f"positions{k + 1}": one.positions[None] for k, one in enumerate(state.catheters)},
            **{f"contact_forces{k + 1}": one.contact_forces[None] for k, one in enumerate(state.catheters) if walls},
            **{f"wall_displacements{k or ''}": own[None] for k, own in enumerate(state.drawn[1])},
            "step_time": np.array([1e3 * cost]), "real_time": np.array([real_time]),
            **{name: None if values is None else values[None]
               for name, values in (("curvature", state.curvature), ("force", state.force), ("couple", state.couple),
                                    ("reaction", state.reaction))},
            "lumen": lumen_of([state.place]), **read_off(state),
        }
