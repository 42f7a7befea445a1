"""A campaign of random pushes: each is run, and its log judged by a search of its own.

``python3 -m experiments.push_campaign --runs 1000 --keep DIR`` prints one line for each run that breaks a claim, and
keeps its scene there.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analysis.logs import read_log
from analysis.push_claims import Walls, judge
from analysis.surfaces import read_obj
from experiments import building, pushes
from experiments.runner import Request, Runner

RUN_LIMIT = 60.0  # s of wall time of one run
# What gains and walls may do to a wire and its drive; whether they did is judged from the log.
OF_ENDS = ("points of the wire passed a wall", "a wall reached", "the wire is ", "the drive fell short: ")
CODES = {"finished": 0, "diverged": 4}  # a wire that jams may be lost, for which it says so


@dataclass(frozen=True)
class Push:
    """What became of one push.

    Attributes
    ----------
    seed, kind : which it was.
    claims : what it broke, one line each.
    seconds : wall time of the run.
    """

    seed: int
    kind: str
    claims: list[str]
    seconds: float


def triangles_of(scene: dict[str, Any]) -> np.ndarray:
    """Corners (t, 3, 3) in units of a scene's mesh at its place."""
    if scene["vessel"]["shape"] != "mesh":
        return np.empty((0, 3, 3))
    mesh = read_obj(Path(scene["vessel"]["file"]))
    vertices = mesh.vertices
    if "position" in scene:
        turn = pushes.rotation_of(np.array(scene["rotation"]))
        vertices = (vertices * scene["scale"]) @ turn.T + scene["position"]
    return vertices[mesh.triangles]


def make(runner: Runner, seed: int, folder: Path) -> Push:
    """Draw, run and judge one push; its files are left in the folder."""
    kind, path = pushes.write(seed, folder)
    out = folder / f"run-{seed}"
    watchdog = threading.Timer(RUN_LIMIT, runner.interrupt)
    watchdog.start()
    start = time.monotonic()
    answer = runner.run(Request(str(seed), path, out))
    seconds = time.monotonic() - start
    watchdog.cancel()
    if CODES.get(answer.outcome) != answer.exit_code:
        slow = f"took more than {RUN_LIMIT} s: " if seconds >= RUN_LIMIT else ""
        return Push(seed, kind, [f"{slow}{answer.outcome}: {answer.message}"], seconds)
    scene, summary = json.loads(path.read_text()), json.loads((out / "summary.json").read_text())
    positions = read_log(out, spheres="all").positions
    claims = judge(scene, summary, positions, Walls.of(scene, triangles_of(scene), pushes.rotation_of))
    claims += [f"warning: {warning}" for warning in summary["warnings"]
               if not any(words in warning for words in OF_ENDS)]
    return Push(seed, kind, claims, seconds)


def campaign(command: Sequence[str], seeds: Iterable[int], folder: Path) -> Iterator[Push]:
    """The pushes of these seeds, one after another in one process; files of those that break nothing are removed."""
    runner = Runner(command)
    try:
        for seed in seeds:
            push = make(runner, seed, folder)
            if push.seconds >= RUN_LIMIT:
                runner.close()
                runner = Runner(command)
            shutil.rmtree(folder / f"run-{seed}", ignore_errors=True)
            if not push.claims:
                for path in folder.glob(f"push-{seed}.*"):
                    path.unlink()
            yield push
    finally:
        runner.close()


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="python3 -m experiments.push_campaign", description=__doc__.split("\n")[0])
    parser.add_argument("--runs", type=int, default=100, help="how many (default 100)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (default 0)")
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that break a claim")
    given = parser.parse_args(arguments)
    failed = 0
    slowest = 0.0
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for push in campaign(building.build(building.RUNNER, print), range(given.first, given.first + given.runs),
                             folder):
            slowest = max(slowest, push.seconds)
            failed += bool(push.claims)
            if push.claims:
                print(f"{push.seed} {push.kind}: {'; '.join(push.claims)}", flush=True)
    print(f"{given.runs} runs, {failed} break a claim, slowest {slowest:.1f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
