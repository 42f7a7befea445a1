"""The store of runs: `runs/` has a folder for each address, and studies refer to it, so that equal runs are shared.

A run is whole where its summary is, and what the summary and whoever asks need beside it. A folder without that is what
a killed or failed run left: it is made again, in the same place.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

SUMMARY = "summary.json"
LOGS = ("positions.json", "positions.npz")  # by the parameter logFormat
LOAD = "load.json"  # of the machine beside a timed run
_NOT_DONE = ("interrupted",)


def folder_of(runs: Path, address: str, repeat: int | None = None, in_turns: bool = False) -> Path:
    """Folder of a run; timed repeats and costs measured in turns have their own, so that none stands in for another.

    Parameters
    ----------
    runs : folder of all runs.
    address : as the runner reports it, hex digits.
    repeat : number of the timed repeat.
    in_turns : whether it is a cost measured in turns with sweeps.
    """
    name = address[2:] + ("-in-turns" if in_turns else f"-repeat-{repeat}" if repeat is not None else "")
    return runs.joinpath(address[:2], name)


def read_whole(folder: Path, log: bool, timed: bool) -> dict[str, Any] | None:
    """Return the summary of a whole run, with the load beside it where that was measured; None where the run is to be
    made.

    Parameters
    ----------
    folder : of the run.
    log : whether its log is needed.
    timed : whether the load beside it is needed.
    """
    try:
        with open(os.path.join(folder, SUMMARY), "rb") as file:
            summary = json.loads(file.read())
    except (OSError, ValueError):
        return None
    if not isinstance(summary, dict) or summary.get("complete") is not True or summary.get("outcome") in _NOT_DONE:
        return None
    named = summary.get("log")  # null without a log, another name where the disk was lost
    if named not in (None, *LOGS) or (log and (named is None or not (folder / named).is_file())):
        return None
    if timed:
        try:
            summary |= json.loads((folder / LOAD).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return None
    return summary
