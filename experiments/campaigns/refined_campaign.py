"""Random runs of several instruments, each beside itself with half the time step and with twice the elements.

``python3 -m experiments.campaigns.refined_campaign --runs 300 --keep DIR`` draws pushes of `material_pushes`. Of a run
that says reliable it tells by how much the hubs' forces and the tip differ in its repeats. A difference beyond the
limits is told as a claim, and the files stay.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from experiments.campaigns import push_campaign
from experiments.campaigns.material_pushes import CATHETERS
from experiments.campaigns.results import Record
from experiments.campaigns.runs import close, fill, folder_of, parser_of, played
from guidewire.advice.trials import finer
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner

FORCE = 0.05  # of the largest force of any hub, by which one may differ
TIP = 0.02  # of the way of the tip, by which its end may
_QUIET = 1e-3  # N, of a hub force below which there is none to compare
_RUN_LIMIT = 900.0  # s of wall time of one run


@dataclass(frozen=True)
class Refined:
    """What the repeats of one run say.

    Attributes
    ----------
    seed, kind : which it was.
    outcome : "reliable", "not reliable", "jumps" where its end is another one, or how it ended.
    claims : what differs by more than it may, of a run that says reliable.
    force, tip : the largest differences at the end, of the largest hub force and of the tip's way.
    """

    seed: int
    kind: str
    outcome: str
    claims: list[str]
    reason: str = ""
    force: float = 0.0
    tip: float = 0.0


def make(runner: Runner, seed: int, folder: Path, method: str) -> Refined:
    """Draw and run a push and its repeats."""
    kind, path = push_campaign.write(seed, method, folder)
    out = folder / f"run-{seed}"
    answer = runner.run(Request(str(seed), path, out), _RUN_LIMIT)
    if answer.outcome != "finished":
        return Refined(seed, kind, answer.outcome or "refused", [], str(answer.message))
    if not json.loads((out / "summary.json").read_text())["reliable"]:
        return Refined(seed, kind, "not reliable", [])
    scene = json.loads((out / "parameters.json").read_text())
    tips, forces = _end(out)
    largest, way = float(np.abs(forces).max()), float(np.linalg.norm(np.diff(tips, axis=0), axis=1).sum())
    force, tip, claims = 0.0, 0.0, []
    for number, trial in enumerate(finer(scene, elements=True)):
        again = folder / f"run-{seed}-{number}"
        answer = runner.run(Request(f"{seed}-{number}", path, again, trial.changed), _RUN_LIMIT)
        if answer.outcome != "finished":
            claims.append(f"with {trial.name} it ends {answer.outcome}: {answer.message}")
            continue
        others, other_forces = _end(again)
        moved = float(np.linalg.norm(others[-1] - tips[-1])) / max(way, 1e-12)
        differs = float(np.abs(other_forces[-1] - forces[-1]).max()) / max(largest, _QUIET)
        force, tip = max(force, differs), max(tip, moved)
        claims += [f"with {trial.name} a hub's force differs by {differs:.1%}"] if differs > FORCE else []
        claims += [f"with {trial.name} the tip ends {moved:.1%} of its way elsewhere"] if moved > TIP else []
    return Refined(seed, kind, "reliable", claims, "", force, tip)


def _end(out: Path) -> tuple[np.ndarray, np.ndarray]:
    """Positions of the tip (steps, 3), units, and forces of the hubs (steps, hubs), N."""
    with np.load(out / "positions.npz") as log:
        forces = [log[name] for name in ("hubForce", "catheterForce", "catheter2Force") if name in log]
        return log["positions"][:, -1], np.stack(forces, axis=1)


def main(arguments: Sequence[str]) -> int:
    """Returns 1 where a run that says reliable differs from its repeats."""
    parser = parser_of("refined_campaign", __doc__, runs=300)
    parser.add_argument("--method", choices=tuple(CATHETERS), default="catheter", help="of the runs (default catheter)")
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that differ")
    given = parser.parse_args(arguments)
    command = building.build(building.RUNNER, print)
    with folder_of(given) as folder:
        lines = fill(Record(given.record), given, lambda seeds: played(
            command, seeds, partial(make, method=given.method), folder, "push"))
    sure = [one for one in lines if one["outcome"] == "reliable"]
    return close(f"refined {given.method}", f"refined_campaign --method {given.method}", lines, given,
                 force=sum(one["force"] > FORCE for one in sure), tip=sum(one["tip"] > TIP for one in sure))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
