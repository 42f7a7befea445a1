"""The quantity whose error is measured: positions of the wire, quantities at the hub over time, wall forces, or a
number of the summary.

A quantity is sampled at the same times in every run, as an array of shape (times, values). An error is the RMS of its
difference from the reference's over the RMS of the reference's own values, for positions over their RMS
displacement; or the same at the last of these times alone.
"""

from __future__ import annotations

import difflib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from guidewire.logs.hub import HubLog, read_hub, snap_turns
from guidewire.logs.logs import LogError, read_columns, read_log
from guidewire.logs.runs import Run

POSITION, TIP, CONTACT_FORCE, SNAP = "position", "tip", "contactForce", "snapAngle"
_OF_HUB = {"hubForce": "force", "hubTorque": "torque", "twist": "twist", "largestCurvature": "largest_curvature"}
NAMED = (POSITION, TIP, *_OF_HUB, CONTACT_FORCE, SNAP)
RUN, END = "run", "end"
_POINTS = 21  # along the wire
_SAID = {POSITION: "the wire's position", TIP: "the tip's position", "hubForce": "the hub's force",
         "hubTorque": "the hub's torque", "twist": "the twist from hub to tip", "largestCurvature":
         "the largest curvature", CONTACT_FORCE: "the walls' total force", SNAP: "the hub's turn at the first snap"}


@dataclass(frozen=True)
class Quantity:
    """What is asked for.

    Attributes
    ----------
    of : one of `NAMED`, or a number of summary.json, with points where it stands within something.
    at : "run" or "end": from start to end, or at the end alone.
    """

    of: str = POSITION
    at: str = RUN

    @property
    def is_place(self) -> bool:
        """Whether its errors are fractions of a displacement."""
        return self.of in (POSITION, TIP)

    @property
    def is_one_number(self) -> bool:
        """Whether a run has one value of it: two runs that are wrong may agree in it by chance."""
        return self.at == END or self._is_of_all

    @property
    def _is_of_all(self) -> bool:
        """Whether it is of the run as a whole, not of times within it."""
        return self.of == SNAP or self.of not in NAMED

    @property
    def logged(self) -> dict[str, Any]:
        """Parameters with which a run leaves it."""
        if self.of == SNAP:
            return {"logHub": True, "logFormat": "json", "logEvery": 1}
        if self.of in _OF_HUB:
            return {"logHub": True, "logFormat": "json"}
        return {"logContacts": True, "logFormat": "json"} if self.of == CONTACT_FORCE else {}

    @property
    def said(self) -> str:
        """Say it for people."""
        when = "" if self._is_of_all else " at the end" if self.at == END else " from start to end"
        return _SAID.get(self.of, self.of) + when

    @property
    def defined(self) -> str:
        """What an error of it is, in a sentence."""
        if self == Quantity():
            return ("An error is the RMS distance of the wire from the reference, over points along it and times from "
                    "start to end, relative to the RMS displacement of the reference.")
        base = "displacement of the reference" if self.is_place else "value of the reference"
        kind = "" if self.is_one_number and self.of != POSITION else "RMS "
        return f"An error is the {kind}difference of {self.said} from the reference's, over the {kind}{base}."

    def refuse(self, scene: Mapping[str, Any], summary: Mapping[str, Any]) -> None:
        """Raises LogError where runs of a scene of these effective values, such as that of a summary, do not have
        it."""
        if self.of not in NAMED:
            number_of(summary, self.of)
        if self.of in (*_OF_HUB, SNAP) and scene["solver"] != "direct":
            raise LogError(f"--of {self.of} needs solver direct, this is {scene['solver']}")
        if self.of == SNAP and not scene.get("catheters"):
            raise LogError("--of snapAngle needs catheters, and the scene has none")
        if self.of == CONTACT_FORCE and not (scene.get("vessel") or scene.get("obstacles")):
            raise LogError(f"--of {self.of} needs walls, and the scene has none")

    def scale(self, values: np.ndarray) -> float:
        """Return what errors are a part of, of the reference's values."""
        base = values - values[0] if self.is_place else values
        return float(np.sqrt(np.mean(self._counted(base) ** 2)))

    def distance(self, one: np.ndarray, other: np.ndarray) -> float:
        """RMS difference of two runs' values."""
        return float(np.sqrt(np.mean(self._counted(one - other) ** 2)))

    def _counted(self, values: np.ndarray) -> np.ndarray:
        return values[-1:] if self.at == END else values

    def read(self, run: Run, times: np.ndarray) -> np.ndarray:
        """Values at these times, s; a run that ended early stays as it is from then on. Shape (times, values)."""
        if self.is_place:
            return self._places(run, times)
        if self.of in _OF_HUB:
            log: HubLog = read_hub(run.folder)
            return np.interp(times, log.time, getattr(log, _OF_HUB[self.of]))[:, None]
        if self.of == SNAP:
            log = read_hub(run.folder)
            before, after = snap_turns(log.turn, log.torque)
            first = 0.5 * (before[0] + after[0]) if len(after) and run.parameters["catheters"] else np.nan
            return np.full((len(times), 1), first)
        if self.of == CONTACT_FORCE:
            columns = read_columns(run.folder, ("totalTime", "contactTotal"))
            time = columns["totalTime"]
            found = columns.get("contactTotal", np.zeros((len(time), 3)))
            return np.stack([np.interp(times, time, values) for values in found.T], axis=1)
        return np.full((len(times), 1), number_of(run.summary or {}, self.of))

    def _places(self, run: Run, times: np.ndarray) -> np.ndarray:
        """Return places in units, by cubics in time, straight along elements."""
        log = read_log(run.folder, spheres="all", velocities=True)
        places = CubicHermiteSpline(log.time, log.positions, log.velocities)(np.minimum(times, log.time[-1]))
        if self.of == TIP:
            return places[:, -1]
        arc = np.linspace(0.0, places.shape[1] - 1.0, _POINTS)
        low = np.minimum(arc.astype(int), places.shape[1] - 2)
        fraction = (arc - low)[None, :, None]
        return ((1.0 - fraction) * places[:, low] + fraction * places[:, low + 1]).reshape(len(times), -1)


def number_of(summary: Mapping[str, Any], name: str) -> float:
    """Return a number of a summary by its name, with points between.

    Raises
    ------
    LogError : there is none of this name; says which is nearest.
    """
    numbers = _numbers(summary)
    if name not in numbers:
        near = difflib.get_close_matches(name, [*NAMED, *numbers], 1)
        hint = f"did you mean {near[0]}?" if near else f"{', '.join(NAMED)}, or a number of summary.json"
        raise LogError(f"--of {name}: the run has no number of that name: {hint}")
    return numbers[name]


def _numbers(summary: Mapping[str, Any], before: str = "") -> dict[str, float]:
    found: dict[str, float] = {}
    for key, value in summary.items():
        if isinstance(value, Mapping):
            found |= _numbers(value, f"{before}{key}.")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            found[before + key] = float(value)
    return found
