"""Runs of the maps of outcomes, made up: their tips go 10 units, a little farther in each, and do not turn."""

from __future__ import annotations

import json
from pathlib import Path

from guidewire.studies.bisection import FRONTIER
from guidewire.studies.keys import TABLE
from guidewire.studies.maps import MAPS
from guidewire.studies.table import Case, Grid
from guidewire.studies.wire_maps import WIRE_MAPS

SUMMARY = {"outcome": "finished", "passages": 0, "maxPenetration": 0.0, "solver": {}}
DEFAULTS = {"guidewireLength": 100.0, "numberRodElements": 20, "timeStep": 0.001, "contactDistance": 0.0,
            "wireRadius": 0.0005, "metresPerUnit": 0.001}
_UNTURNED = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}


def _write(folder: Path, cases: list[Case], lost: str) -> Path:
    """Those with `lost` in their names diverge."""
    rows = []
    for k, case in enumerate(cases):
        place = folder / str(k)
        place.mkdir(parents=True)
        (place / "parameters.json").write_text(json.dumps({**DEFAULTS, **case.overrides}))
        outcome = "diverged" if lost and lost in case.key else "finished"
        (place / "summary.json").write_text(json.dumps({**SUMMARY, "outcome": outcome}))
        spheres = [{"0": {"x": 0.0, "y": y, "z": 0.0, "vx": 0, "vy": 0, "vz": 0}} for y in (0.0, 10.0 + 0.001 * k)]
        (place / "positions.json").write_text(json.dumps({
            str(step): {"totalTime": 0.1 * step, "elapsedMilliseconds": 0.0, "delta": 0.0, "sphere": sphere,
                        "orientation": {"0": _UNTURNED, "1": _UNTURNED}}
            for step, sphere in enumerate(spheres)}))
        rows.append({"key": case.key, "variant": case.variant, "values": dict(case.values), "parameters": "",
                     "overrides": dict(case.overrides), "folder": str(k), "repeat": None})
    (folder / TABLE).write_text(json.dumps({"study": folder.name, "question": "", "runs": rows}))
    return folder


def write_outcomes(folder: Path) -> dict[str, Path]:
    """Folders of all maps by their names."""
    lost = {"map-xpbd": "substeps=25,", "map-joints": "darboux,1.0", "map-twist": "distalRotation=170.0",
            "map-twisting": "distalRotation=30.0"}
    folders = {study.name: _write(folder / study.name, study.grid.cases(), lost.get(study.name, ""))
               for study in (*MAPS, *WIRE_MAPS) if isinstance(study.grid, Grid)}
    damped = folder / "limit-damped"
    damped.mkdir()
    (damped / FRONTIER).write_text("variant,constraintSolverSteps,damping,key,low,high,fails,note\n"
                                   ",1,0.5,stretchStiffness,4.30,4.31,diverged,holds below\n")
    return {**folders, damped.name: damped}
