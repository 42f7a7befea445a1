"""A bench test of a whole instrument: pushed through a bent tube, then turned by three turns at the hub.

The tube is straight for 30 mm, bends by 90 degrees at a radius of 40 mm and is straight again; the tip stops behind the
bend. How far the tip follows three turns of the hub is the test of torque response that makers show; the force at the
hub with the instrument's friction beside that without shows what friction costs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.benches.benches import require_end
from guidewire.benches.wire import Wire
from guidewire.logs.hub import HubLog, read_hub

TURNS = 3.0
_INSERTION = 0.1  # m
_STRAIGHT, _RADIUS, _LUMEN = 30.0, 40.0, 2.0  # mm; the lumen's radius is at least twice the wire's
_PUSHED, _RESTED, _TURNED = 5.0, 5.5, 15.0  # s
_STEP = 0.05  # s
_LENGTH = 300.0  # mm of the instrument, from its tip


@dataclass(frozen=True)
class TubeTest:
    """What a run through the tube gives.

    Attributes
    ----------
    hub : the log.
    force : at the hub at the end of the push, N.
    response : turn of the tip over turn of the hub after three turns.
    largest_lag : largest difference of the two before the end, rad.
    torque : largest at the hub, N m.
    passages : of the wall; 0 in a run that is right.
    """

    hub: HubLog
    force: float
    response: float
    largest_lag: float
    torque: float
    passages: int


def write_drive(file: Path) -> None:
    """The motion of the hub as a drive table: time, s, insertion, m, rotation, rad."""
    rows = [(0.0, 0.0, 0.0), (_PUSHED, _INSERTION, 0.0), (_RESTED, _INSERTION, 0.0),
            (_TURNED, _INSERTION, 2.0 * math.pi * TURNS)]
    file.write_text("".join(f"{time!r},{moved!r},{turn!r}\n" for time, moved, turn in rows), encoding="utf-8")


def bent_tube(wire: Wire, drive: Path, friction: float | None) -> dict[str, Any]:
    """Parameters of the test.

    Parameters
    ----------
    wire : of a run that names an instrument.
    drive : the file that `write_drive` wrote.
    friction : coefficient; None: the instrument's.
    """
    angles = np.linspace(0.0, 0.5 * math.pi, 19)
    arc = [[0.0, _RADIUS * (1.0 - math.cos(a)), _STRAIGHT + _RADIUS * math.sin(a)] for a in angles]
    end = [0.0, _RADIUS + _STRAIGHT + 10.0, _STRAIGHT + _RADIUS]
    tube = {"shape": "tube", "knots": [[0.0, 0.0, -10.0], *arc, end], "radius": max(_LUMEN, 2e3 * wire.radius),
            "openStart": True, "openEnd": True, "smooth": True}
    if friction is not None:
        tube["frictionCoefficient"] = friction
    return {"solver": "direct", "instrument": wire.parameters["instrument"], "guidewireLength": _LENGTH,
            "guidewireOffset": 10.0 - _LENGTH, "proximalEnd": "clamped", "drive": "displace", "driveFile": str(drive),
            "vessel": tube, "sheath": {"exit": [0.0, 0.0, 0.0]}, "massDamping": 20.0, "timeStep": _STEP,
            "deltaThreshold": 0.0, "maxSimulationSteps": round(_TURNED / _STEP), "logHub": True,
            "logContacts": True}


def read_tube(folder: Path) -> TubeTest:
    """Return the test of a run."""
    run = require_end(folder)
    hub = read_hub(folder)
    pushed = int(np.searchsorted(hub.time, _PUSHED + 1e-6)) - 1
    rested = int(np.searchsorted(hub.time, _RESTED + 1e-6)) - 1
    turned, before = slice(rested, None), hub.twist[rested]
    return TubeTest(hub, float(hub.force[pushed]), 1.0 + float(hub.twist[-1] - before) / (2.0 * math.pi * TURNS),
                    float(np.abs(hub.twist[turned] - before).max()), float(np.abs(hub.torque[turned]).max()),
                    int(run.measured("passages")))
