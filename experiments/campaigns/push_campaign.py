"""A campaign of random pushes: each is run, and its log checked by an independent search.

``python3 -m experiments.campaigns.push_campaign --method direct --runs 300 --keep DIR`` prints one line for each run
that breaks a claim, and keeps its scene there; METHOD is pbd (`pushes`) or one of `material_pushes`. Meshes that cross
themselves have no inside, and a wire may start in a wall: a seed that draws either is skipped and does not count as a
run.
"""

from __future__ import annotations

import argparse
import itertools
import json
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analysis.wall_search import Walls, crosses_itself, triangles_of
from experiments.campaigns import material_claims, material_pushes, push_claims, pushes
from guidewire.logs.logs import read_log
from guidewire.logs.surfaces import read_obj
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner

RUN_LIMIT = 60.0  # s of wall time of one run
# What pbd and walls may do to a wire and its drive; whether they did is checked from the log.
OF_ENDS = ("points of the wire passed a wall", "the wire penetrated a wall", "the wire is ", material_claims.KINKED,
           "the drive fell short: ", "over which the wire spreads a load on the wall",
           "of its softLimit: there it was almost rigid")
# A wire that jams may be lost, or its step have no solution, for which it says so.
CODES = {"finished": 0, "diverged": 4, "failed": 5}


@dataclass(frozen=True)
class Push:
    """What became of one push.

    Attributes
    ----------
    seed, kind : which it was.
    claims : what it broke, one line each.
    seconds : wall time of the run.
    outcome : how it ended; None where it did not.
    reason : its reason.
    is_reliable : whether its summary says that nothing speaks against its result.
    """

    seed: int
    kind: str
    claims: list[str]
    seconds: float
    outcome: str | None = None
    reason: str = ""
    is_reliable: bool = False


def write(seed: int, method: str, folder: Path) -> tuple[str, Path]:
    """Draw a push of a method and write its parameter file; returns the kind of its vessel and the file."""
    drawn = pushes.draw(seed, folder) if method == "pbd" else material_pushes.draw(seed, method, folder)
    path = folder / f"push-{seed}.json"
    path.write_text(json.dumps(drawn[1], indent=1))
    return drawn[0], path


def make(runner: Runner, seed: int, method: str, folder: Path, is_soft: bool = False) -> Push | None:
    """Draw, run and check one push, between soft walls if asked for; its files are left in the folder. None where there
    is nothing to check."""
    kind, path = write(seed, method, folder)
    scene = json.loads(path.read_text())
    if is_soft:
        material_pushes.soften(scene, seed)
        path.write_text(json.dumps(scene, indent=1))
    if method != "pbd" and scene["vessel"]["shape"] == "mesh":
        mesh = read_obj(Path(scene["vessel"]["file"]))
        if crosses_itself(mesh.vertices, mesh.triangles):
            return None
    walls = Walls.of(scene, triangles_of(scene, path.parent))
    if method != "pbd" and starts_in_a_wall(scene, walls):
        return None
    out = folder / f"run-{seed}"
    start = time.monotonic()
    answer = runner.run(Request(str(seed), path, out), RUN_LIMIT)
    seconds = time.monotonic() - start
    if CODES.get(answer.outcome) != answer.exit_code:
        return Push(seed, kind, [f"{answer.outcome}: {answer.message}"], seconds, answer.outcome)
    summary = json.loads((out / "summary.json").read_text())
    positions = read_log(out, spheres="all").positions
    if method == "pbd":
        claims = push_claims.violations(scene, summary, positions, walls)
    else:
        claims = material_claims.violations(scene, summary, positions, material_pushes.core_radii_of(scene), walls)
    # A mesh of a push is closed; a tube goes on beyond its last knot, where the tip has left it.
    known = OF_ENDS if scene["vessel"]["shape"] == "mesh" else (*OF_ENDS, push_claims.RIM)
    claims += [f"warning: {warning}" for warning in summary["warnings"]
               if not any(words in warning for words in known)]
    return Push(seed, kind, claims, seconds, answer.outcome, summary["reason"], summary["reliable"])


def starts_in_a_wall(scene: dict[str, Any], walls: Walls) -> bool:
    """Whether the straight wire along z of the start, as far as it is out of a sheath, is nearer to a wall than its
    radius."""
    first, last = scene["guidewireOffset"], scene["guidewireOffset"] + scene["guidewireLength"]
    if "sheath" in scene:
        first = min(last, scene["sheath"]["exit"][2])
    ends = np.array([[[0.0, 0.0, first]], [[0.0, 0.0, last]]])
    radius = float(material_pushes.radii_of(scene).max())
    least = [wall.least_along(*ends, radius) for wall in walls.others]
    if walls.mesh:
        least.append(walls.mesh.least_distance(*ends, radius))
    return min(least) < radius


def campaign(command: Sequence[str], seeds: Iterable[int], folder: Path, method: str = "pbd", is_soft: bool = False
             ) -> Iterator[Push]:
    """The pushes of these seeds, one after another in one process; files of those that break nothing are removed."""
    with closing(Runner(command)) as runner:
        for seed in seeds:
            push = make(runner, seed, method, folder, is_soft)
            shutil.rmtree(folder / f"run-{seed}", ignore_errors=True)
            if not push or not push.claims:
                for path in folder.glob(f"push-{seed}.*"):
                    path.unlink()
            if push:
                yield push


def parser_of(name: str, description: str, runs: int = 100) -> argparse.ArgumentParser:
    """The arguments that campaigns share: how many runs, and the first seed."""
    parser = argparse.ArgumentParser(prog=f"python3 -m experiments.campaigns.{name}",
                                     description=description.split("\n", 1)[0])
    parser.add_argument("--runs", type=int, default=runs, help=f"how many (default {runs})")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    return parser


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("push_campaign", __doc__)
    parser.add_argument("--method", choices=("pbd", *material_pushes.METHODS), default="pbd",
                        help="of the runs (default pbd)")
    parser.add_argument("--soft", action="store_true", help="walls that give way, with direct and sheath")
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that break a claim")
    given = parser.parse_args(arguments)
    if given.soft and given.method not in ("direct", "sheath"):
        parser.error(f"--soft with {given.method}: only direct and sheath have soft walls")
    broken = 0
    reliable = 0
    slowest = 0.0
    outcomes: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        runs = campaign(building.build(building.RUNNER, print), itertools.count(given.first), folder, given.method,
                        given.soft)
        for push in itertools.islice(runs, given.runs):
            slowest = max(slowest, push.seconds)
            broken += bool(push.claims)
            reliable += push.is_reliable
            outcomes[str(push.outcome)] += 1
            if push.claims:
                print(f"{push.seed} {push.kind}: {'; '.join(push.claims)}", flush=True)
            elif push.outcome != "finished":
                print(f"{push.seed} {push.kind} {push.outcome}: {push.reason}", flush=True)
    ends = ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items()))
    print(f"{given.runs} runs ({ends}; {reliable} reliable), {broken} break a claim, slowest {slowest:.1f} s")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
