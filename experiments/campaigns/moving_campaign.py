"""A campaign of random pushes into vessels that move: each is run, and its log checked in space.

``python3 -m experiments.campaigns.moving_campaign --runs 300 --keep DIR`` draws bent tubes whose centreline moves by 5
to 20 mm, by up to 0.3 of its curvature, at 0.5 to 3 Hz; pushes of 5 to 60 mm/s; friction in two of three. The vertices
of the mesh are moved by the second implementation of the motion, and the wire is searched among the moved triangles: no
point of its core line may be outside, and its surface at most 0.02 of its radius in the wall.
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

from analysis.wall_search import MeshSearch
from experiments.campaigns.pushes import bent_line, swept_mesh
from experiments.campaigns.results import Record
from experiments.campaigns.runs import close, fill, folder_of, parser_of, played
from guidewire.anatomy.motion import motion_of, write_centreline
from guidewire.logs.logs import read_log
from guidewire.logs.runs import read_run
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner
from tools.seeds import red

RUN_LIMIT = 900.0  # s of wall time of one run
SURFACE = 0.02  # of the radius, that the wire's surface may be in the moved wall
FRAMES = 10  # of a log that are judged
SHEATH = 40.0  # mm of straight vessel before the bends, which stands still
MOST_STEPS = 500
OF_WIRES = "elastic line"    # what bends do to a wire is no claim on walls
EXIT = -4.0  # z of the sheath's end, mm


@dataclass(frozen=True)
class Moving:
    """What became of one run; claims, outcome and reason as of a `Push`.

    Attributes
    ----------
    deepest : of the wire's surface in the moved wall, over its radius.
    moved : of the vessel, mm, at most.
    iterations : of Newton's method, a step.
    """

    seed: int
    claims: list[str]
    seconds: float
    outcome: str | None
    reason: str = ""
    deepest: float = 0.0
    iterations: float = 0.0
    moved: float = 0.0


def draw(seed: int, folder: Path) -> dict[str, Any]:
    """Write mesh, table and scene of a seed into a folder; return the scene."""
    random = np.random.default_rng([seed, 85])
    radius = float(random.uniform(0.15, 0.3))
    width = float(random.uniform(1.1, 2.5))
    bend = float(random.uniform(10.0, 25.0)) * width
    arc = random.uniform(0.5, 1.4) * bend
    torsion = random.uniform(0.0, 0.5) / bend
    line = bent_line(max(3.0 * arc, 90.0), 0.8, lambda s: 0.0 if s < 5.0 else (1.0 if s < 5.0 + arc else -0.8) / bend,
                     lambda s: torsion)
    back = np.arange(-SHEATH, 0.0, 0.8)[:, None] * np.array([0.0, 0.0, 1.0])
    vertices, faces = swept_mesh(np.concatenate([back, line]), np.full(len(back) + len(line), width),
                                 int(random.integers(14, 22)), random.uniform(0.0, np.pi))
    rows = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in vertices] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
    (folder / f"moving-{seed}.obj").write_text("\n".join(rows))
    # Displacements grow with the square of the station: 2 A/length^2 is the curvature that they add.
    stations = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
    amplitude = min(float(random.uniform(2.5, 10.0)), 0.5 * 0.3 / bend * stations[-1]**2)    # on both sides of rest
    phases = np.arange(16) / 16
    one, two = random.normal(size=(2, 3))
    ways = np.array([one, random.uniform(-0.7, 0.7) * two]) * amplitude / np.linalg.norm(one)
    beat = np.stack([np.sin(2 * np.pi * phases), np.sin(4 * np.pi * phases)], axis=1)
    moved = (beat @ ways)[:, None] * (stations / stations[-1])[:, None]**2
    write_centreline(folder / f"moving-{seed}.csv", [line[::3]], [moved[:, ::3]], phases)
    period = 1.0 / float(random.uniform(0.5, 3.0))
    speed = float(random.uniform(5.0, 60.0))
    step = float(min(random.choice([0.01, 0.02, 0.05]), 0.125 * period))
    insertion = min(0.8 * stations[-1], speed * MOST_STEPS * step)
    # Straight elements stay within 0.01 r of the bent wall.
    element = min(2.0, 0.9 * np.sqrt(8.0 * 0.01 * radius / (0.3 / bend)))
    inside = np.ceil(insertion / element)
    length = 30.0 + insertion + 10.0
    young = float(10.0**random.uniform(9.7, 10.9))
    scene = {"solver": "direct", "integrator": "implicitEuler", "timeStep": step, "deltaThreshold": 0,
             "maxSimulationSteps": int(insertion / (speed * step)), "guidewireLength": length,
             "guidewireOffset": 2.0 - length, "numberRodElements": int(inside * 1.25) + 4, "wireRadius": 1e-3 * radius,
             "youngsModulus": young, "shearModulus": 0.38 * young, "massDamping": 20, "proximalEnd": "clamped",
             "drive": "displace", "insertionSpeed": 1e-3 * speed, "logEvery": 1, "logFormat": "npz",
             "sheath": {"exit": [0, 0, EXIT]},
             "vessel": {"shape": "mesh", "file": f"moving-{seed}.obj",
                        "frictionCoefficient": float(random.choice([0.0, 0.1, 0.3])),
                        "motion": {"period": period, "phase": float(random.uniform()),
                                   "centreline": f"moving-{seed}.csv"}}}
    (folder / f"moving-{seed}.json").write_text(json.dumps(scene, indent=1))
    return scene


def make(runner: Runner, seed: int, folder: Path) -> Moving:
    """Run a seed and judge it."""
    draw(seed, folder)
    out, start = folder / f"run-{seed}", time.monotonic()
    answer = runner.run(Request(str(seed), folder / f"moving-{seed}.json", out), RUN_LIMIT)
    seconds = time.monotonic() - start
    if answer.outcome not in ("finished", "failed"):
        return Moving(seed, [f"{answer.outcome}: {answer.message}"], seconds, answer.outcome)
    run = read_run(out)
    claims, deepest, moved = judge(run, out)
    summary = run.summary
    claims += [f"warning: {one}" for one in summary["warnings"] if OF_WIRES not in one]
    steps = max(1, summary["steps"])
    return Moving(seed, claims, seconds, answer.outcome, summary["reason"], deepest,
                  summary["solver"]["wallIterations"] / steps, moved)


def judge(run: Any, folder: Path) -> tuple[list[str], float, float]:
    """Return what a log breaks, how deep the surface is in the moved wall, over the radius, and how far the vessel
    moved, mm."""
    log, motion = read_log(folder, "all"), motion_of(run.parameters)
    radius = 1e3 * float(run.parameters["wireRadius"])
    rows = [line.split() for line in Path(run.parameters["vessel"]["file"]).read_text().splitlines()]
    vertices = np.array([row[1:] for row in rows if row[0] == "v"], dtype=float)
    faces = np.array([row[1:] for row in rows if row[0] == "f"], dtype=int) - 1
    claims, deepest, farthest = [], 0.0, 0.0
    for k in np.unique(np.linspace(len(log.steps) // 4, len(log.steps) - 1, FRAMES).round().astype(int)):
        motion.set_time(log.time[k])
        moved = motion.moved(vertices)
        farthest = max(farthest, float(np.linalg.norm(moved - vertices, axis=1).max()))
        search = MeshSearch(moved[faces])
        nodes = log.positions[k]
        nodes = nodes[np.argmax(nodes[:, 2] > EXIT):]
        ends = nodes[:-1], nodes[1:]
        points = np.concatenate([nodes, *((1 - s) * ends[0] + s * ends[1] for s in (0.25, 0.5, 0.75))])
        outside = int((~search.inside(points)).sum())
        if outside:
            claims.append(f"{outside} points of the core line are outside at t = {log.time[k]:.4g} s")
        deepest = max(deepest, 1.0 - search.least_distance(*ends, radius) / radius)
    if deepest > SURFACE:
        claims.append(f"the surface is {deepest:.3g} of the radius in the moved wall")
    return claims, float(deepest), farthest


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("moving_campaign", __doc__, 300)
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that break a claim")
    given = parser.parse_args(arguments)
    command, record = building.build(building.RUNNER, print), Record(given.record)
    with folder_of(given) as folder:
        lines = fill(record, given, lambda seeds: played(command, seeds, make, folder, "moving"), red("moving"))
    return close("moving", "moving_campaign", lines, given,
                 deepest=max((one["deepest"] for one in lines), default=0.0))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
