"""A campaign of random pushes: each is run, and its log checked by an independent search.

``python3 -m experiments.campaigns.push_campaign --method direct --runs 300 --keep DIR`` prints one line for each run
that breaks a claim, and keeps its scene there; METHOD is pbd (`pushes`) or one of `material_pushes`. Meshes that cross
themselves have no inside, and a wire may start in a wall: a seed that draws either is skipped and does not count as a
run. With ``--record FILE`` a campaign that was ended goes on, with ``--result`` it writes its row of `results`. Seeds
that broke a claim the last time go first.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analysis.wall_search import Walls, crosses_itself, triangles_of
from experiments.campaigns import material_claims, material_pushes, push_claims, pushes
from experiments.campaigns.results import Record
from experiments.campaigns.runs import close, fill, folder_of, parser_of, played
from guidewire.logs.logs import read_log
from guidewire.logs.surfaces import read_obj
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner
from tools.seeds import red

RUN_LIMIT = 600.0  # s of wall time of one run
MOST_BEYOND = 0.02  # of its hubForceLimit, by which the force of a hub may be above it where nothing says so
TOUCH = 1e-3  # N of a wall, from which on it is touched
# What pbd and walls may do to a wire and its drive; whether they did is checked from the log.
OF_ENDS = ("points of the wire passed a wall", " goes through itself", "the wire penetrated a wall", "the wire is ",
           material_claims.KINKED, "the drive fell short: ", "over which the wire spreads a load on the wall",
           "of its softLimit: there it was almost rigid", "leave their elastic line",
           "which is not simulated: at the tip their axes may differ", "beyond the range of its material's law")
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
    beyond : part of its hubForceLimit by which the force of a hub was above it, at most.
    is_touching : whether a wall pressed on it in any step.
    overtakings : how often one tip went beyond the next one around, or back.
    """

    seed: int
    kind: str
    claims: list[str]
    seconds: float
    outcome: str | None = None
    reason: str = ""
    is_reliable: bool = False
    beyond: float = 0.0
    is_touching: bool = False
    overtakings: int = 0


def write(seed: int, method: str, folder: Path) -> tuple[str, Path]:
    """Draw a push of a method and write its parameter file; returns the kind of its vessel and the file."""
    drawn = pushes.draw(seed, folder) if method == "pbd" else material_pushes.draw(seed, method, folder)
    path = folder / f"push-{seed}.json"
    path.write_text(json.dumps(drawn[1], indent=1))
    return drawn[0], path


def make(runner: Runner, seed: int, method: str, folder: Path, is_soft: bool = False, gives_way: bool = False
         ) -> Push | None:
    """Draw, run and check one push, between soft walls or of a core that gives way if asked for; its files are left in
    the folder. None where there is nothing to check."""
    kind, path = write(seed, method, folder)
    scene = json.loads(path.read_text())
    if is_soft:
        material_pushes.soften(scene, seed)
    if gives_way:
        material_pushes.give_way(scene, seed)
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
    log = read_log(out, spheres="all")
    beyond, overtakings = 0.0, 0
    if method == "pbd":
        claims = push_claims.violations(scene, summary, log.positions, walls)
    else:
        nodes, cores = log.positions, material_pushes.core_radii_of(scene)
        radii = cores[0]
        if log.catheters:
            nodes, radii = material_claims.chain(nodes, log.catheters, cores)
        claims = material_claims.violations(scene, summary, nodes, radii, walls)
        if scene.get("logHub"):
            with np.load(out / "positions.npz") as arrays:
                forces, insertions = ([arrays[name + of] for name in ("hub", "catheter", "catheter2")
                                       if name + of in arrays] for of in ("Force", "Insertion"))
                claims += material_claims.force_sums(
                    [arrays[name] for name in arrays if name.lower().endswith("contactforces")], arrays["contactTotal"])
                overtakings = sum(int((arrays[name][1:] * arrays[name][:-1] < 0.0).sum())
                                  for name in ("catheterExtension", "catheter2Extension") if name in arrays)
            beyond = material_claims.beyond(scene, forces)
            claims += material_claims.order(scene, insertions)
            claims += material_claims.speeds(scene, insertions)
        said = (*summary["warnings"], summary["reason"])
        if beyond > MOST_BEYOND and not any("hubForceLimit" in one for one in said):
            claims.append(f"a hub is above its hubForceLimit by {beyond:.1%}, and nothing says so")
    # A mesh of a push is closed; a tube goes on beyond its last knot, where the tip has left it.
    known = OF_ENDS if scene["vessel"]["shape"] == "mesh" else (*OF_ENDS, push_claims.RIM)
    claims += [f"warning: {warning}" for warning in summary["warnings"]
               if not any(words in warning for words in known)]
    return Push(seed, kind, claims, seconds, answer.outcome, summary["reason"], summary["reliable"], beyond,
                (summary["largestContactForce"] or 0.0) > TOUCH, overtakings)


def starts_in_a_wall(scene: dict[str, Any], walls: Walls) -> bool:
    """Whether the straight wire along z of the start, as far as it is out of a sheath, is nearer to a wall than its
    radius."""
    first, last = scene["guidewireOffset"], scene["guidewireOffset"] + scene["guidewireLength"]
    first += scene["catheters"][0]["start"] if "catheters" in scene else 0.0    # the hub behind which nothing is
    if "sheath" in scene:
        first = min(last, scene["sheath"]["exit"][2])
    ends = np.array([[[0.0, 0.0, first]], [[0.0, 0.0, last]]])
    radius = float(material_pushes.radii_of(scene).max())
    least = [wall.least_along(*ends, radius) for wall in walls.others]
    if walls.mesh:
        least.append(walls.mesh.least_distance(*ends, radius))
    return min(least) < radius


def campaign(command: Sequence[str], seeds: Iterable[int], folder: Path, method: str = "pbd", is_soft: bool = False,
             gives_way: bool = False) -> Iterator[Push]:
    """The pushes of these seeds, one after another in one process; files of those that break nothing are removed."""
    return played(command, seeds, lambda runner, seed, out: make(runner, seed, method, out, is_soft, gives_way), folder,
                  "push")


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("push_campaign", __doc__)
    parser.add_argument("--method", choices=("pbd", *material_pushes.METHODS), default="pbd",
                        help="of the runs (default pbd)")
    parser.add_argument("--soft", action="store_true", help="walls that give way, not with pbd and xpbd")
    parser.add_argument("--core", action="store_true", help="a core that gives way or yields, not with pbd and xpbd")
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that break a claim")
    given = parser.parse_args(arguments)
    if (given.soft or given.core) and given.method in ("pbd", "xpbd"):
        parser.error(f"--soft or --core with {given.method}, which has no soft walls and linear wires")
    more = (" soft" if given.soft else "") + (" core" if given.core else "")
    name = f"push {given.method}{more}"
    command, record = building.build(building.RUNNER, print), Record(given.record)
    with folder_of(given) as folder:
        lines = fill(record, given, lambda seeds: campaign(command, seeds, folder, given.method, given.soft,
                                                           given.core), red(name))
    return close(name, f"push_campaign --method {given.method}{more.replace(' ', ' --')}", lines, given,
                 beyond=sum(one["beyond"] > MOST_BEYOND for one in lines),
                 touching=sum(one.get("is_touching", False) for one in lines),
                 overtakings=sum(one.get("overtakings", 0) for one in lines))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
