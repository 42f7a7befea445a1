"""Random pushes, pulls and turns of wires in anatomies, checked from their logs by an independent search.

``python3 -m experiments.campaigns.anatomy_campaign FOLDER ... --runs 100 --keep DIR`` takes folders that
``guidewire.py anatomy`` wrote; each has so many runs. A seed draws the end that the wire starts at, its thickness (0.36
or 0.89 mm) and stiffness, the bend of its tip, friction, and a drive of pushes, pulls and turns. With ``--instrument``
the wire is that instrument. A start that the program refuses is skipped and does not count as a run.
"""

from __future__ import annotations

import argparse
import itertools
import json
import shutil
import sys
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analysis.passages import SAMPLES, Wall, sample_wire
from analysis.wall_search import MeshSearch
from experiments.campaigns import material_pushes
from experiments.campaigns.push_campaign import CODES
from experiments.campaigns.push_claims import contradictions, null_claims
from experiments.campaigns.results import Record
from experiments.campaigns.runs import close, fill, folder_of, parser_of
from guidewire.logs.logs import read_log
from guidewire.logs.surfaces import read_obj
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner

DIAMETERS = (0.36, 0.89)  # mm
RUN_LIMIT = 120.0  # s of wall time of one run
STEP = 0.05  # s
MOST_STEPS = 260
_WIRE = ("wireRadius", "youngsModulus", "shearModulus", "density", "wireSections", "guidewireLength",
         "numberRodElements")
_SAME = 1e-9  # of the radius
_ELASTIC = 1e-5  # of the wire's length, by which its proximal node may be behind the hub
_SAME_LENGTH = 1e-3  # mm
_DEPTH_EVERY = 5  # entries of the log of which the depth is searched
REFUSED = "refused"
_REFUSED = 2  # exit code


@dataclass(frozen=True)
class Walk:
    """One run: `vessel`, the folder's name; `claims`, what it broke, one line each; `outcome` and `reason` of its end;
    `distance`, the farthest of the tip along the centreline, mm; `instrument`, where the wire is one."""

    vessel: str
    seed: int
    claims: list[str]
    outcome: str
    reason: str = ""
    distance: float = 0.0
    seconds: float = 0.0
    instrument: str = ""


class Vessel:
    """A folder of ``guidewire.py anatomy``: its ends, and its wall in mm, with and without its open rims closed."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.scene = json.loads((folder / "scene.json").read_text())
        found = json.loads((folder / "anatomy.json").read_text())
        self.scale = 1e3 * found["metresPerUnit"]
        self.ends = found["ends"]
        mesh = read_obj(folder / "vessel.obj")
        wall = Wall.of(mesh.vertices * self.scale, mesh.triangles)
        self.open = MeshSearch(wall.triangles)
        self.closed = MeshSearch(np.concatenate([wall.triangles, wall.fans]))
        self.rims = MeshSearch(wall.fans) if len(wall.fans) else None

    def exit_of(self, number: int) -> tuple[np.ndarray, np.ndarray]:
        """The exit of a sheath at an end, mm, and its direction: one radius inside."""
        end, = (end for end in self.ends if end["number"] == number)
        direction = np.array(end["direction"])
        return self.scale * (np.array(end["centre"]) + end["radius"] * direction), direction


def draw(vessel: Vessel, seed: int, folder: Path, instrument: str | None = None) -> Path:
    """The parameter file of a run, and its drive beside it."""
    random = np.random.default_rng([28, seed])
    diameter = float(random.choice(DIAMETERS))
    scene = dict(vessel.scene)
    wide = [end["number"] for end in vessel.ends if 2.0 * vessel.scale * end["radius"] > 3.0 * max(DIAMETERS)]
    scene |= {"inlet": int(random.choice(wide)), "logFormat": "npz", "logEvery": 1, "logHub": False,
              "timeStep": STEP, "vessel": scene["vessel"] | {"file": str(vessel.folder / "vessel.obj"),
                                                            "anatomy": str(vessel.folder / "anatomy.json")}}
    for key in ("target", "insertionSpeed"):
        del scene[key]
    stiffness = float(np.exp(random.uniform(np.log(9.5e9), np.log(158e9))))
    tip = float(np.exp(random.uniform(np.log(0.05), np.log(0.5)))) * stiffness
    bend = random.uniform(0.0, 40.0)
    angle = random.uniform(0.0, 2.0 * np.pi)
    *behind, last = scene["wireSections"]
    if instrument is None:
        soft = {"youngsModulus": tip, "shearModulus": 0.38 * tip}
        scene |= {"wireRadius": 0.5e-3 * diameter, "youngsModulus": stiffness, "shearModulus": 0.38 * stiffness,
                  "wireSections": [*(section | soft for section in behind), last | soft | {
                      "restCurvature": [bend * np.cos(angle), bend * np.sin(angle), 0.0]}]}
    else:
        scene = {key: value for key, value in scene.items() if key not in _WIRE} | {"instrument": instrument}
    if random.uniform() < 0.6:
        scene["vessel"]["frictionCoefficient"] = random.uniform(0.02, 0.3)
    rows = drive(random, 0.9 * float(vessel.scene["guidewireLength"]))
    # Of one run in five the hub never slips: what jams has to fail then, with the force in its reason.
    scene["hubForceLimit"] = (float(np.exp(random.uniform(np.log(0.5), np.log(10.0))))
                              if random.uniform() < 0.8 else 0.0)
    scene["maxSimulationSteps"] = min(MOST_STEPS, int(rows[-1][0] / STEP))
    path = folder / f"{vessel.folder.name}-{seed}.json"
    path.with_suffix(".csv").write_text("time,insertion,rotation\n" + "".join(
        f"{time:.4f},{1e-3 * insertion:.6f},{turn:.5f}\n" for time, insertion, turn in rows))
    path.write_text(json.dumps(scene | {"driveFile": str(path.with_suffix(".csv"))}, indent=1))
    return path


def drive(random: np.random.Generator, most: float) -> list[tuple[float, float, float]]:
    """Time s, insertion mm and rotation rad, piece by piece: pushes, pulls and turns, and some at once."""
    at, rows = np.zeros(3), [(0.0, 0.0, 0.0)]
    while at[0] < STEP * MOST_STEPS:
        speed = float(np.exp(random.uniform(np.log(8.0), np.log(60.0))))
        kind = random.choice(["push", "pull", "turn", "both"], p=[0.55, 0.2, 0.1, 0.15])
        insertion = {"push": 1.0, "pull": -0.5, "turn": 0.0, "both": 1.0}[kind] * random.uniform(5.0, 120.0)
        insertion = float(np.clip(at[1] + insertion, 0.0, most)) - at[1]
        turn = random.uniform(-2.0 * np.pi, 2.0 * np.pi) if kind in ("turn", "both") else 0.0
        duration = max(abs(insertion) / speed, abs(turn) / random.uniform(1.0, 6.0), STEP)
        at += [duration, insertion, turn]
        rows.append(tuple(at))
    return rows


def violations(vessel: Vessel, scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray) -> list[str]:
    """The claims that a run breaks, one line each.

    Parameters
    ----------
    scene : the effective parameters of the run.
    positions : (k, n + 1, 3), of all nodes after every step, mm.
    """
    if not np.isfinite(positions).all():
        return ["a position is not a finite number"]
    claims = contradictions(summary)
    if summary["passages"] != 0:
        claims.append(f"passages = {summary['passages']}")
    exit_at, along = vessel.exit_of(scene["inlet"])
    n = positions.shape[1] - 1
    is_out = (positions - exit_at) @ along > 0.0
    first = np.where(is_out.any(axis=1), is_out.argmax(axis=1), n + 1)  # node out of the sheath; n + 1: there is none
    body = np.arange(n) >= first[:, None]
    a, b = positions[:, :-1][body], positions[:, 1:][body]
    crossing = vessel.open.crosses(a, b)
    if crossing.any():
        claims.append(f"an element crosses the wall {np.count_nonzero(crossing)} times, the first in entry "
                      f"{np.argwhere(body)[np.flatnonzero(crossing)[0], 0]}")
    points = sample_wire(positions)
    chosen = np.arange(points.shape[1]) >= SAMPLES * first[:, None]
    lumen = np.zeros(points.shape[:2], bool)
    lumen[chosen] = vessel.closed.inside(points[chosen])
    # The wire is one piece: what of it is outside, with no element through the wall, went out by an open rim.
    outside = chosen & ~lumen
    by_rim = np.zeros(len(positions), bool)
    if vessel.rims is not None and outside.any():
        by_rim[np.argwhere(body)[vessel.rims.crosses(a, b), 0]] = True
    lost = outside.any(axis=1) & ~by_rim
    if lost.any():
        claims.append(f"points are outside in {np.count_nonzero(lost)} entries, the first {lost.argmax()}, and the "
                      "wire goes through no rim")
    after = np.minimum(SAMPLES * (first + 1), lumen.shape[1] - 1)
    if not (lumen[np.arange(len(lumen)), after] | (first > n)).all():
        claims.append("the wire is outside where it leaves its sheath")
    return [*claims, *_depth(vessel, scene, summary, positions, body, bool(crossing.any())),
            *_drive_claims(scene, summary, positions),
            *_body_claims(summary["hub"], positions, int(first[-1]),
                          (positions[-1] - exit_at) @ along / np.linalg.norm(along))]


def _depth(vessel: Vessel, scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray, body: np.ndarray,
           is_crossed: bool) -> list[str]:
    """How deep the surface of an element is in the wall, of every few entries."""
    radii = np.asarray(material_pushes.radii_of(scene))
    claims = []
    for radius in () if is_crossed else np.unique(radii):
        of_radius = (body & (radii == radius))[::-_DEPTH_EVERY]
        a, b = positions[::-_DEPTH_EVERY, :-1][of_radius], positions[::-_DEPTH_EVERY, 1:][of_radius]
        depth = radius - vessel.open.least_distance(a, b, radius) if len(a) else 0.0
        if depth > _SAME * radius:
            claims.append(f"the surface is in the wall by {depth / radius:.3g} radii")
    if summary["maxPenetration"] > _SAME * radii.max():
        claims.append(f"maxPenetration = {summary['maxPenetration']}")
    return claims


def _drive_claims(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray) -> list[str]:
    """The hub against the drive's table and against the log: what is missing must be said."""
    rows = np.loadtxt(scene["driveFile"], delimiter=",", skiprows=1)
    # Parts of a step without a solution may be done: the hub is then between its places before and after that step.
    last = scene["timeStep"] * summary["steps"]
    times = np.array([last, last if summary["outcome"] == "finished" else last + scene["timeStep"]])
    (least_insertion, most_insertion), (least_turn, most_turn) = (
        np.sort(np.interp(times, rows[:, 0], rows[:, k])) for k in (1, 2))
    hub, claims = summary["hub"], []
    insertion, turn = hub["insertion"], hub["turn"]
    is_whole = summary["outcome"] == "finished"
    if is_whole and summary["steps"] != scene["maxSimulationSteps"]:
        claims.append(f"finished after {summary['steps']} steps of {scene['maxSimulationSteps']}")
    slips = scene["hubForceLimit"] > 0.0
    along = positions[0, 1] - positions[0, 0]
    gone = float((positions[-1, 0] - positions[0, 0]) @ along / np.linalg.norm(along))
    if is_whole and slips:
        steps = scene["timeStep"] * np.arange(summary["steps"] + 1)  # a step asks for the difference of its two ends
        done = np.interp(steps, rows[:, 0], rows[:, 1])
        asked, missing = 1e3 * np.abs(np.diff(done)).sum(), summary["driveShortfall"]
        if abs(summary["driveAsked"] - asked) > 1e-6 * max(asked, 1.0):
            claims.append(f"driveAsked = {summary['driveAsked']}, the drive's table asks for {asked}")
        # Pulls count with the other sign, so what a shortfall is of the insertion is known for pushes alone.
        if (np.diff(done) >= 0.0).all() and abs(gone + missing - asked) > 1e-6 * max(asked, 1.0):
            claims.append(f"node 0 went {gone} mm and {missing} are missing, of {asked}")
    elif not slips and not least_insertion - 1e-9 <= insertion <= most_insertion + 1e-9:
        claims.append(f"the hub went {insertion} m, asked for {least_insertion} to {most_insertion}")
    if not least_turn - 1e-6 <= turn <= most_turn + 1e-6:
        claims.append(f"the hub went {turn} rad, asked for {least_turn} to {most_turn}")
    claims += null_claims(summary)
    behind = _ELASTIC * scene["guidewireLength"] + (0.0 if slips else abs(summary["driveShortfall"] or 0.0))
    if is_whole and abs(gone - 1e3 * insertion) > behind:
        claims.append(f"node 0 went {gone} mm, the hub {1e3 * insertion}, driveShortfall = {summary['driveShortfall']}")
    return claims


def _body_claims(hub: dict[str, Any], positions: np.ndarray, first: int, beyond: np.ndarray) -> list[str]:
    """What the summary says is in the body, against the last entry of the log.

    Parameters
    ----------
    first : the first node out of the sheath at the end; the number of nodes where there is none.
    beyond : (n + 1,), distance of each node from the exit along the sheath's axis at the end, mm.
    """
    at_rest = np.linalg.norm(np.diff(positions[0], axis=0), axis=1)  # a wire begins without strain
    length = at_rest[first:].sum() + beyond[first] if first < len(beyond) else 0.0
    claims = []
    if abs(1e3 * hub["lengthInBody"] - length) > _SAME_LENGTH:
        claims.append(f"{hub['lengthInBody']} m in the body, counted {1e-3 * length}")
    # A tip that has been withdrawn is at the exit, some nm in front of it or behind: nodes so near count as either.
    least, most = (len(beyond) - int(np.argmax([*(beyond > side), True])) for side in (_SAME_LENGTH, -_SAME_LENGTH))
    if not least <= hub["spheresInBody"] <= most:
        claims.append(f"{hub['spheresInBody']} spheres in the body, counted {least} to {most}")
    return claims


def make(runner: Runner, vessel: Vessel, seed: int, folder: Path, instrument: str | None = None) -> Walk:
    """Draw, run and check; its files stay in the folder where it breaks a claim."""
    path = draw(vessel, seed, folder, instrument)
    out = folder / f"run-{path.stem}"
    start = time.monotonic()
    answer = runner.run(Request(path.stem, path, out), RUN_LIMIT)
    seconds = time.monotonic() - start
    name = vessel.folder.name
    if answer.exit_code == _REFUSED:
        walk = Walk(name, seed, [], REFUSED, str(answer.message), instrument=instrument or "")
    elif CODES.get(answer.outcome) != answer.exit_code:
        walk = Walk(name, seed, [f"{answer.outcome}: {answer.message}"], str(answer.outcome), seconds=seconds,
                    instrument=instrument or "")
    else:
        summary = json.loads((out / "summary.json").read_text())
        scene = json.loads((out / "parameters.json").read_text())
        claims = violations(vessel, scene | {"driveFile": str(path.with_suffix(".csv"))}, summary,
                       read_log(out, spheres="all").positions)
        walk = Walk(name, seed, claims, answer.outcome, summary["reason"], summary["centreline"]["farthest"], seconds,
                    instrument or "")
    shutil.rmtree(out, ignore_errors=True)
    if not walk.claims:
        path.unlink()
        path.with_suffix(".csv").unlink()
    return walk


def campaign(command: Sequence[str], vessel: Vessel, seeds: Iterable[int], folder: Path,
             instrument: str | None = None) -> Iterator[Walk]:
    """The runs of these seeds in one vessel, one after another in one process."""
    with closing(Runner(command)) as runner:
        for seed in seeds:
            yield make(runner, vessel, seed, folder, instrument)


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("anatomy_campaign", __doc__)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER",
                        help="of guidewire.py anatomy; each has so many runs")
    parser.add_argument("--instrument", action="append", help="in place of drawn wires; may be given several times")
    parser.add_argument("--keep", type=Path, help="folder for the scenes of runs that break a claim")
    given = parser.parse_args(arguments)
    command, lines = building.build(building.RUNNER, print), []
    record = Record(given.record, "vessel", "instrument", "seed")
    with folder_of(given) as folder:
        for place, instrument in itertools.product(given.folders, given.instrument or [None]):
            vessel = Vessel(place)
            lines += fill(record, given, lambda seeds: campaign(command, vessel, seeds, folder, instrument),
                          skipped=REFUSED, vessel=place.resolve().name, instrument=instrument or "")
    return close_walks("anatomy" + (" instruments" if given.instrument else ""),
                       "anatomy_campaign FOLDER ..." + " --instrument NAME" * bool(given.instrument), lines, given)


def close_walks(name: str, command: str, lines: list[dict[str, Any]], given: argparse.Namespace) -> int:
    """As `close`, with the runs of each vessel, and how far a tip came, mm."""
    return close(name, command, lines, given, vessels=dict(Counter(one["vessel"] for one in lines)),
                 farthest=round(max((one["distance"] for one in lines), default=0.0)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
