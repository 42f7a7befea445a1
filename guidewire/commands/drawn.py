"""Catheters and the sheath in the pictures of `guidewire.py render`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from guidewire.figures.render import Instrument, instruments_of
from guidewire.logs.logs import PositionLog
from guidewire.logs.runs import PARAMETERS_NAME, Run
from guidewire.logs.surfaces import Surface
from guidewire.prepare import PreparationError
from guidewire.sessions.session import SessionError, session_of
from guidewire.viewer import drawn_walls
from guidewire.viewer.recording import read_recording


@contextmanager
def walls_of(run: Run, log: PositionLog, middle: np.ndarray, reach: float
             ) -> Iterator[tuple[list[Surface], Callable[[int], list[Surface]] | None]]:
    """Return the walls of a run as `drawn_walls.walls_of` does. Of a run without walls no session is asked.

    Raises
    ------
    PreparationError : the run's parameters cannot be used any more; one line.
    """
    if not run.parameters.get("vessel") and not run.parameters.get("obstacles"):
        yield [], None
        return
    try:
        with session_of(run.folder / PARAMETERS_NAME) as session:
            yield drawn_walls.walls_of(session, run, log, middle, reach)
    except SessionError as error:
        raise PreparationError(str(error)) from error


def instruments_and_sheath(run: Run, log: PositionLog) -> tuple[tuple[Instrument, ...], np.ndarray | None]:
    """Return the wire and the catheters over it, none for a wire alone; and the ends of the sheath, (2, 3), units, or
    None.

    Raises
    ------
    PreparationError : the run's parameters cannot be used any more; one line.
    LogError : the log cannot be read, or does not have every sphere.
    """
    if not log.catheters and run.parameters.get("sheath") is None:
        return (), None
    recording = read_recording(run, [], len(log.steps), {}, lambda _: [])
    if not log.catheters:
        return (), recording.sheath
    values = {channel.name: channel.values[:, 0] for channel in recording.channels if channel.place == "frame"}
    hubs = [np.stack([values[f"{hub}Insertion"], values[f"{hub}Turn"]], axis=1)
            if f"{hub}Insertion" in values and len(values["time"]) == len(log.steps) else None
            for hub in ("hub", *(f"hub{k + 1}" for k in range(len(log.catheters))))]
    try:
        with session_of(run.folder / PARAMETERS_NAME) as session:
            return instruments_of(session.describe()["instruments"], hubs), recording.sheath
    except SessionError as error:
        raise PreparationError(str(error)) from error
