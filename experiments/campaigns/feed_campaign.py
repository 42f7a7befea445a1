"""Random feeds of a wire that touches itself into sacs and wide arches, judged from their logs.

``python3 -m experiments.campaigns.feed_campaign --runs 300 --keep DIR`` draws for each seed a sac at the end of a tube
or a wide arch with a closed end, and a wire with a bent tip that is fed beyond the end, so that it lays itself in
loops. In a third of all it is then drawn back, and its link is to be that of the start. No strand may pass another, by
`guidewire.logs.strands`, and no point a wall. Where a strand may have gone round the tip between two entries of the log
the count of the run itself decides, which looks at each part of a step. Lengths are millimetres, one unit each.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analysis.wall_search import Walls, triangles_of
from experiments.campaigns import material_claims
from experiments.campaigns.push_campaign import CODES, OF_ENDS
from experiments.campaigns.push_claims import RIM
from experiments.campaigns.results import Record
from experiments.campaigns.runs import close, fill, folder_of, parser_of, played
from guidewire.logs.logs import read_log
from guidewire.logs.strands import Passage, link, passages
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner
from tools.seeds import red

RUN_LIMIT = 900.0  # s of wall time of one run
NODES = 160
WITHDRAWN = 3  # of so many seeds one is drawn back
SAME_LINK = 0.05  # turns: what friction may keep of a twist; a strand that passed another leaves 1 or more
_TIME_STEP = 0.05  # s
_FINER = 10  # steps for one, where a passage is to be told from a snap
_STRAIGHT = 0.9  # cosine of the wire's end, before its bent tip, to its start: one that is folded back has no link


@dataclass(frozen=True)
class Feed:
    """What became of one feed: as `push_campaign.Push`, with the work of the solver, how often a strand may have gone
    round the tip and, where the wire was drawn back, the change of its link in turns."""

    seed: int
    kind: str
    claims: list[str]
    seconds: float
    outcome: str | None = None
    reason: str = ""
    factorisations: int = 0
    round_the_tip: int = 0
    link: float | None = None


def draw(seed: int, folder: Path) -> tuple[str, dict[str, Any]]:
    """A random feed: the kind of its vessel and its parameters; the drive of one that is drawn back is in the folder.
    The same seed gives the same scene."""
    random = np.random.default_rng([81, seed])
    kind = ("sac", "arch")[seed % 2]
    step = float(random.choice([0.5, 1.0, 2.0]))
    if kind == "sac":
        wide, narrow = random.uniform(8.0, 20.0), random.uniform(1.5, 4.0)
        vessel, length, radius = _sac(wide, narrow, 170.0), 160.0, 0.18
        feed = random.uniform(100.0, 150.0)
    else:
        wide, bend = random.uniform(8.0, 15.0), random.uniform(30.0, 45.0)
        vessel, length, radius = _arch(wide, bend, 330.0), 320.0, 0.3
        feed = random.uniform(240.0, 310.0)
        step *= 2.0    # as of the elements
    tip = random.uniform(5.0, 30.0) * length / 160.0
    steps = int(feed / step)
    vessel["frictionCoefficient"] = float(random.choice([0.0, 0.0, 0.1, 0.3]))
    scene = {
        "solver": "direct", "integrator": "implicitEuler", "guidewireLength": length, "numberRodElements": NODES,
        "guidewireOffset": -length - 2.0, "wireRadius": 1e-3 * radius, "youngsModulus": 60e9, "shearModulus": 23e9,
        "density": 6450.0, "massDamping": 20.0, "proximalEnd": "clamped", "drive": "displace",
        "wireSections": [{"from": length - tip, "to": length, "youngsModulus": 6e9, "shearModulus": 2.3e9,
                          "restCurvature": [float(random.uniform(20.0, 200.0)), 0.0, 0.0]}],
        "gravity": [*(9.81 * random.uniform(-1.0, 1.0, 2)).tolist(), 0.0],
        "vessel": vessel, "timeStep": _TIME_STEP, "deltaThreshold": 0.0, "solverTolerance": 1e-5,
        "logFormat": "npz", "logOrientations": True,
    }
    turn = float(random.choice([0.0, 0.0, 2.0, -5.0]))
    if seed % WITHDRAWN == 0:
        there, back = steps * _TIME_STEP, 2 * steps * _TIME_STEP
        drive = folder / f"feed-{seed}.csv"
        drive.write_text(f"time,insertion,rotation\n0,0,0\n{there!r},{1e-3 * steps * step!r},{turn * there!r}\n"
                         f"{back!r},0,0\n")
        scene |= {"driveFile": str(drive), "maxSimulationSteps": 2 * steps + 20}
    else:
        scene |= {"displacementPerStep": step, "rotationSpeed": turn, "maxSimulationSteps": steps}
    return kind, scene


def _sac(radius: float, narrow: float, straight: float) -> dict[str, Any]:
    """A ball at the end of a straight tube along z."""
    side = radius / np.sqrt(2.0)
    rise = (side - narrow) / 0.97
    angles = np.pi * (0.75 - 0.5 * np.arange(1, 12) / 12)
    profile = [(-straight, narrow), (0.0, narrow), (rise, side),
               *zip(rise + side + radius * np.cos(angles), radius * np.sin(angles)),
               (rise + 2.0 * side, side), (rise + 2.0 * side + (side - 1.0) / 0.97, 1.0)]
    return {"shape": "tube", "openStart": True, "openEnd": False,
            "knots": [[0.0, 0.0, float(z)] for z, _ in profile], "radius": [float(own) for _, own in profile]}


def _arch(radius: float, bend: float, straight: float) -> dict[str, Any]:
    """A wide tube that turns round by half a circle of a radius, with a closed end."""
    angles = np.linspace(0.0, np.pi, 25)
    knots = [[0.0, 0.0, -straight], *([bend * (1.0 - np.cos(angle)), 0.0, bend * np.sin(angle)] for angle in angles),
             [2.0 * bend, 0.0, -40.0]]
    return {"shape": "tube", "openStart": True, "openEnd": False,
            "knots": [[float(x) for x in knot] for knot in knots], "radius": [radius] * len(knots)}


def make(runner: Runner, seed: int, folder: Path) -> Feed:
    """Draw, run and check one feed; its files are left in the folder."""
    kind, scene = draw(seed, folder)
    path, out = folder / f"feed-{seed}.json", folder / f"run-{seed}"
    path.write_text(json.dumps(scene, indent=1))
    start = time.monotonic()
    answer = runner.run(Request(str(seed), path, out), RUN_LIMIT)
    seconds = time.monotonic() - start
    if CODES.get(answer.outcome) != answer.exit_code:
        return Feed(seed, kind, [f"{answer.outcome}: {answer.message}"], seconds, answer.outcome)
    summary = json.loads((out / "summary.json").read_text())
    positions = read_log(out, spheres="all").positions
    walls = Walls.of(scene, triangles_of(scene, folder))
    claims = material_claims.violations(scene, summary, positions, np.full(NODES, 1e3 * scene["wireRadius"]), walls)
    passed = passages(positions)
    if not all(one.may_be_round_the_tip for one in passed):
        finer = _finer(runner, seed, scene, folder)
        passed = passed if finer is None else finer
    claims += [f"strand through strand in entry {one.entry}, elements {one.elements}" for one in passed
               if not one.may_be_round_the_tip]
    change = None
    straight = round(NODES * scene["wireSections"][0]["from"] / scene["guidewireLength"])
    end = positions[-1][straight] - positions[-1][straight - 1]
    if "driveFile" in scene and answer.outcome == "finished" and end[2] > _STRAIGHT * np.linalg.norm(end):
        with np.load(out / "positions.npz") as arrays:
            first, last = (link(positions[k][:straight + 1], arrays["orientations"][k][:straight]) for k in (0, -1))
        change = last - first
        if abs(change) > SAME_LINK:
            claims.append(f"drawn back, the wire has {change:.3g} turns")
    claims += [f"warning: {warning}" for warning in summary["warnings"]
               if not any(words in warning for words in (*OF_ENDS, RIM))]
    return Feed(seed, kind, claims, seconds, answer.outcome, summary["reason"], summary["solver"]["factorisations"],
                sum(one.may_be_round_the_tip for one in passed), change)


def _finer(runner: Runner, seed: int, scene: dict[str, Any], folder: Path) -> list[Passage] | None:
    """Passages of the same feed in steps of a tenth: in a snap the wire moves farther than lines can follow. None where
    that run does not finish."""
    path, out = folder / f"feed-{seed}.finer.json", folder / f"run-{seed}-finer"
    finer = {key: scene[key] / _FINER for key in ("timeStep", "displacementPerStep") if key in scene}
    path.write_text(json.dumps(scene | finer | {"maxSimulationSteps": _FINER * scene["maxSimulationSteps"]}))
    answer = runner.run(Request(f"{seed}-finer", path, out), RUN_LIMIT)
    return None if answer.outcome != "finished" else passages(read_log(out, spheres="all").positions)


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("feed_campaign", __doc__)
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that break a claim")
    given = parser.parse_args(arguments)
    command, record = building.build(building.RUNNER, print), Record(given.record)
    with folder_of(given) as folder:
        lines = fill(record, given, lambda seeds: played(command, seeds, make, folder, "feed"), red("feed"))
    return close("feed", "feed_campaign", lines, given, withdrawn=sum(one["link"] is not None for one in lines),
                 round_the_tip=sum(one["round_the_tip"] for one in lines))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
