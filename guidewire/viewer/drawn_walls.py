"""The walls of a run as pictures and other programs have them: where they are, and how soft ones give way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from guidewire.anatomy.motion import GivenVessel, motions_of
from guidewire.logs.logs import PositionLog, read_columns
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import Surface
from guidewire.logs.walls import drawn_of, given_walls, soft_walls
from guidewire.sessions.session import Session


def walls_of(session: Session, run: Run, log: PositionLog, middle: np.ndarray, reach: float
             ) -> tuple[list[Surface], Callable[[int], list[Surface]] | None]:
    """Return the walls of a run, as of `Session.walls`, and as they are at an entry of the log, the same objects where
    they are rigid and stand still; None where all do.

    session : with the parameters of the run.
    """
    drawn, motions, rest = drawn_of(run, log), motions_of(run.parameters), session.walls(middle, reach)
    given = given_walls(run.parameters)
    bent = read_columns(run.folder, ["vesselCentreline"], log.steps)["vesselCentreline"] if given else []
    vessel = GivenVessel(np.asarray(bent[0])[:, :3]) if given else None

    def at(k: int) -> list[Surface]:
        walls = session.walls(middle, reach, drawn[k]) if soft_walls(run.parameters) else list(rest)
        for number in given:
            walls[number] = replace(walls[number], vertices=vessel.moved(
                walls[number].vertices, np.asarray(bent[k])[:, 3:]))
        for number, motion in motions.items():
            motion.set_time(float(log.time[k]))
            walls[number] = replace(walls[number], vertices=motion.moved(walls[number].vertices))
        return walls

    return rest, at if motions or given or soft_walls(run.parameters) else None
