"""A wire in a catheter pushed, pulled and turned at random at both hubs in anatomies, judged from logs by an
independent search.

``python3 -m experiments.campaigns.coaxial_campaign FOLDER ... --runs 20 --keep DIR`` takes folders that
``guidewire.py anatomy`` wrote; each has so many runs. A seed draws the instruments, the inlet, friction, and a drive
for each hub.
"""

from __future__ import annotations

import json
import shutil
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from experiments.campaigns import material_pushes
from experiments.campaigns.anatomy_campaign import REFUSED, STEP, Vessel, Walk, close_walks, drive
from experiments.campaigns.push_campaign import CODES
from experiments.campaigns.push_claims import contradictions
from experiments.campaigns.results import Record
from experiments.campaigns.runs import fill, folder_of, parser_of
from guidewire.logs.logs import PositionLog, read_log
from guidewire.logs.paths import lengths_of, through_tips
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner

PAIRS = (("radifocus-angled-0.035", "catheter-angled-5f", 1.67), ("workhorse-0.014", "microcatheter-2.4f", 0.97))
MOST_STEPS = 160
RUN_LIMIT = 1200.0  # s of wall time of one run
_BODY, _BEHIND = 5.0, 60.0  # mm: of a catheter's elements, and of its hub before the wire's, at least
_POINTS = 10  # looked at on each piece
_TARGET = 3.0  # radii of a target, at which a tip that reached it has been at least


def draw(vessel: Vessel, seed: int, folder: Path) -> Path:
    """The parameter file of a run, and the drives beside it."""
    random = np.random.default_rng([60, seed])
    wire, catheter, diameter = PAIRS[int(random.integers(len(PAIRS)))]
    wide = [end["number"] for end in vessel.ends if 2.0 * vessel.scale * end["radius"] > 1.5 * diameter]
    own = vessel.scene
    most = 0.9 * float(own["guidewireLength"])
    names = [str(folder / f"{vessel.folder.name}-{seed}-{hub}.csv") for hub in ("wire", "catheter")]
    drives = [drive(random, most) for _ in names]
    for name, rows in zip(names, drives):
        Path(name).write_text("time,insertion,rotation\n" + "".join(
            f"{at:.4f},{1e-3 * insertion:.6f},{turn:.5f}\n" for at, insertion, turn in rows))
    start = max(_BEHIND, _BODY * np.ceil(_most_ahead(*map(np.array, drives)) / _BODY))
    length = _BODY * np.ceil((own["guidewireLength"] + 100.0 + start - _BEHIND) / _BODY)
    count = int((length - start - _BEHIND) / _BODY)
    scene = {
        "solver": "direct", "instrument": wire, "guidewireLength": float(length),
        "numberRodElements": int(length / _BODY),
        "catheters": [{"instrument": catheter, "start": float(start), "length": _BODY * count, "elements": count,
                       "driveFile": names[1]}],
        "massDamping": 20.0, "proximalEnd": "clamped", "drive": "displace", "driveFile": names[0],
        "hubForceLimit": float(np.exp(random.uniform(np.log(0.5), np.log(10.0)))),
        "vessel": own["vessel"] | {"file": str(vessel.folder / "vessel.obj"),
                                   "anatomy": str(vessel.folder / "anatomy.json")},
        "sheath": {}, "inlet": int(random.choice(wide or [own["inlet"]])), "target": own["target"],
        "contactDistance": own["contactDistance"], "timeStep": STEP, "deltaThreshold": 0.0,
        "maxSimulationSteps": MOST_STEPS, "logEvery": 1, "logFormat": "npz",
    }
    if random.uniform() < 0.6:
        scene["vessel"]["frictionCoefficient"] = random.uniform(0.02, 0.3)
    path = folder / f"{vessel.folder.name}-{seed}.json"
    path.write_text(json.dumps(scene, indent=1))
    return path


def _most_ahead(wire: np.ndarray, catheter: np.ndarray) -> float:
    """Say by how much the wire's hub has gone farther than the catheter's, at most in a run, mm. Rows are of
    `drive`."""
    end = STEP * MOST_STEPS
    times = np.union1d(wire[:, 0], catheter[:, 0])
    times = np.append(times[times < end], end)
    return float((np.interp(times, wire[:, 0], wire[:, 1]) - np.interp(times, catheter[:, 0], catheter[:, 1])).max())


def violations(vessel: Vessel, scene: dict[str, Any], summary: dict[str, Any], log: PositionLog) -> list[str]:
    """The claims that a run breaks, one line each."""
    claims = contradictions(summary)
    if summary["passages"]:
        claims.append(f"passages = {summary['passages']}")
    if not np.isfinite(log.positions).all():
        return [*claims, "a position is not a finite number"]
    exit_at, along = vessel.exit_of(scene["inlet"])
    lengths, (catheter,) = lengths_of(log.positions), log.catheters
    has_left = False
    for k, nodes in enumerate(log.positions):
        path, _ = through_tips(nodes, [catheter[k]], lengths)
        tip = np.flatnonzero((path == catheter[k][-1]).all(axis=1))
        # In the catheter the wire lies on its centreline: the catheter's nodes are looked at there.
        chain = np.concatenate([catheter[k], path[tip[0] + 1:]]) if len(tip) else catheter[k]
        first = int(np.argmax((chain - exit_at) @ along > 0.0))
        if not ((chain[first] - exit_at) @ along > 0.0):
            continue
        a, b = chain[first:-1], chain[first + 1:]
        if len(a) and vessel.open.crosses(a, b).any():
            claims.append(f"an element crosses the wall, entry {k}")
            break
        fractions = (np.arange(_POINTS) + 0.5) / _POINTS
        points = (a[:, None] + fractions[:, None] * (b - a)[:, None]).reshape(-1, 3)
        has_left |= bool(len(a) and vessel.rims is not None and vessel.rims.crosses(a, b).any())
        if len(points) and not has_left and not vessel.closed.inside(points).all():
            claims.append(f"points are outside and went through no rim, entry {k}")
            break
    return [*claims, *_success(vessel, scene, summary, log.positions[:, -1])]


def _success(vessel: Vessel, scene: dict[str, Any], summary: dict[str, Any], tips: np.ndarray) -> list[str]:
    """A target that is reached by the summary alone."""
    if not summary["centreline"]["reached"]:
        return []
    target, = (end for end in vessel.ends if end["number"] == scene["target"])
    away = np.linalg.norm(tips - vessel.scale * np.array(target["centre"]), axis=1)
    inside = vessel.closed.inside(tips)
    least = float(away[inside].min(initial=np.inf))
    return [] if least < _TARGET * vessel.scale * target["radius"] + 1.0 else [
        f"'reached', but the tip in the lumen came to {least:.3g} mm from the target"]


def make(runner: Runner, vessel: Vessel, seed: int, folder: Path, is_soft: bool = False) -> Walk:
    """Draw, run and check, between soft walls if asked for; its files stay in the folder where it breaks a claim."""
    path = draw(vessel, seed, folder)
    if is_soft:
        own = json.loads(path.read_text())
        material_pushes.soften(own, seed)
        path.write_text(json.dumps(own, indent=1))
    out = folder / f"run-{path.stem}"
    start = time.monotonic()
    answer = runner.run(Request(path.stem, path, out), RUN_LIMIT)
    seconds, name = time.monotonic() - start, vessel.folder.name
    if answer.exit_code == 2:
        walk = Walk(name, seed, [], REFUSED, str(answer.message))
    elif CODES.get(answer.outcome) != answer.exit_code:
        walk = Walk(name, seed, [f"{answer.outcome}: {answer.message}"], str(answer.outcome), seconds=seconds)
    else:
        summary = json.loads((out / "summary.json").read_text())
        scene = json.loads(path.read_text())
        walk = Walk(name, seed, violations(vessel, scene, summary, read_log(out, spheres="all")), answer.outcome,
                    summary["reason"], summary["centreline"]["farthest"], seconds)
    shutil.rmtree(out, ignore_errors=True)
    if not walk.claims:
        for file in folder.glob(f"{path.stem}*"):
            file.unlink()
    return walk


def campaign(command: Sequence[str], vessel: Vessel, seeds: Iterable[int], folder: Path, is_soft: bool = False
             ) -> Iterator[Walk]:
    """The runs of these seeds in one vessel, one after another in one process."""
    with closing(Runner(command)) as runner:
        for seed in seeds:
            yield make(runner, vessel, seed, folder, is_soft)


def main(arguments: Sequence[str]) -> int:
    """Returns 1 where a run breaks a claim."""
    parser = parser_of("coaxial_campaign", __doc__)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER")
    parser.add_argument("--soft", action="store_true", help="walls that give way")
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that break a claim")
    given = parser.parse_args(arguments)
    command, lines = building.build(building.RUNNER, print), []
    record = Record(given.record, "vessel", "seed")
    with folder_of(given) as folder:
        for place in given.folders:
            vessel = Vessel(place)
            lines += fill(record, given, lambda seeds: campaign(command, vessel, seeds, folder, given.soft),
                          skipped=REFUSED, vessel=place.resolve().name)
    return close_walks("coaxial" + (" soft" if given.soft else ""),
                       "coaxial_campaign FOLDER ..." + (" --soft" if given.soft else ""), lines, given)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
