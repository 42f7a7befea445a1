"""The wire of ``params/sheath.json`` fed into the artery with its tip bent in any direction, at any of many speeds, and
what each run's log and summary say, compared with an independent search."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from analysis.logs import read_log
from analysis.passages import Wall, inside
from analysis.surfaces import read_obj
from experiments.campaigns.vessel import ARTERY, ARTERY_RADIUS, Lumen, artery_lumens
from experiments.prepare import ROOT

SCENE = ROOT / "params" / "sheath.json"
WAY = 240.0  # of the hub, mm, as in the scene
SLOWEST, FASTEST = 10.0, 60.0  # mm/s
_LOGGED = 12  # entries of a log
_SAME = 1e-6  # mm, what a way may differ from the one asked for
_ELASTIC = 1e-2  # mm, by which a wire of 1.8 m may be shorter under its push


@dataclass(frozen=True)
class Fed:
    """A run of the campaign.

    Attributes
    ----------
    seed : of the draw.
    angle : of the bend of the tip about the wire's axis, rad.
    speed : of the hub, mm/s.
    branch : in which the tip ended: 0 the first arm, 1 the second, None where it is in neither.
    claims : what is not as it should be, one line each.
    """

    seed: int
    angle: float
    speed: float
    branch: int | None
    claims: list[str]


def draw(seed: int) -> tuple[float, float]:
    """Angle, rad, and speed, mm/s, of a run."""
    random = np.random.default_rng(seed)
    return random.uniform(0.0, 2.0 * np.pi), float(np.exp(random.uniform(np.log(SLOWEST), np.log(FASTEST))))


def scene_of(angle: float, speed: float) -> dict[str, Any]:
    """The parameter file of a run."""
    scene = json.loads(SCENE.read_text())
    section, = scene["wireSections"]
    bend = np.hypot(*section["restCurvature"][:2])
    steps = round(WAY / (speed * scene["timeStep"]))
    return scene | {
        "wireSections": [section | {"restCurvature": [-bend * np.cos(angle), -bend * np.sin(angle), 0.0]}],
        "insertionSpeed": 1e-3 * speed,
        "maxSimulationSteps": steps,
        "logEvery": max(1, steps // _LOGGED),
        "logFormat": "npz",
        "vessel": scene["vessel"] | {"file": str(ARTERY)},
    }


def campaign(command: Sequence[str], seeds: Iterable[int], folder: Path) -> Iterator[Fed]:
    """Makes the runs, one folder for each below this one.

    Parameters
    ----------
    command : starts the runner.
    """
    mesh = read_obj(ARTERY)
    wall = Wall.of(mesh.vertices, mesh.triangles)
    for seed in seeds:
        angle, speed = draw(seed)
        scene = scene_of(angle, speed)
        file = folder / f"{seed}.json"
        file.write_text(json.dumps(scene))
        out = folder / str(seed)
        done = subprocess.run([*command, "-parameters", str(file), "-out", str(out)], capture_output=True, text=True)
        if done.returncode != 0:
            yield Fed(seed, angle, speed, None, [f"exit code {done.returncode}: {done.stdout}{done.stderr}".strip()])
            continue
        summary = json.loads((out / "summary.json").read_text())
        positions = read_log(out, spheres="all").positions
        yield Fed(seed, angle, speed, branch_of(positions[-1, -1]), judge(scene, summary, positions, wall))


def judge(scene: dict[str, Any], summary: dict[str, Any], positions: np.ndarray, wall: Wall) -> list[str]:
    """What a run's summary says that is not so, and what should not have happened.

    Parameters
    ----------
    positions : (k, n + 1, 3), of the spheres in each entry of the log, units.
    """
    claims = []
    if summary["outcome"] != "finished" or summary["steps"] != scene["maxSimulationSteps"]:
        claims.append(f"{summary['outcome']} after {summary['steps']} steps: {summary['reason']}")
    exit_at = scene["sheath"]["exit"][2]
    body = positions[:, (positions[:, :, 2] > exit_at).any(axis=0)]
    lumen = inside(wall, body)  # a wire that is fed in goes in, and stays
    left = int(np.count_nonzero(lumen[:-1] & ~lumen[1:]))
    if summary["passages"] or left or not lumen[-1].all():
        claims.append(f"{summary['passages']} passages; by winding numbers {left} points have left the artery and"
                      f" {np.count_nonzero(~lumen[-1])} are outside at the end")
    asked = 1e3 * scene["insertionSpeed"] * scene["timeStep"] * summary["steps"]
    hub = summary["hub"]
    gone = 1e3 * hub["insertion"]
    if abs(summary["driveAsked"] - asked) > _SAME:
        claims.append(f"asked {summary['driveAsked']}, true is {asked}")
    if abs(gone + summary["driveShortfall"] - asked) > _SAME:
        claims.append(f"asked {asked}, gone {gone}, missing {summary['driveShortfall']}")
    if abs(gone - np.ptp(positions[:, 0, 2])) > _SAME:
        claims.append(f"the hub went {gone}, sphere 0 {np.ptp(positions[:, 0, 2])}")
    start = scene["guidewireOffset"] + scene["guidewireLength"] - exit_at
    if abs(1e3 * hub["lengthInBody"] - start - gone) > _ELASTIC:
        claims.append(f"{hub['lengthInBody']} m in the body, fed in by {gone} mm after {start}")
    outside = int(np.count_nonzero(np.linalg.norm(positions[-1, :, :2], axis=1) + positions[-1, :, 2] > exit_at))
    if hub["spheresInBody"] != outside:
        claims.append(f"{hub['spheresInBody']} spheres in the body, counted {outside}")
    if branch_of(positions[-1, -1]) is None:
        claims.append(f"the tip is in neither branch: {positions[-1, -1].tolist()}")
    return claims


def branch_of(tip: np.ndarray) -> int | None:
    """The arm beyond the fork in which a point (3,) in mm is: 0, 1 or None."""
    whole, second = artery_lumens()
    fork = second.centres[0]
    after = int(np.argmin(np.linalg.norm(whole.centres - fork, axis=1)))
    first = Lumen(whole.centres[after:], whole.radii[after:])
    depths = [lumen.depth(tip[None])[0] for lumen in (first, second)]
    if np.linalg.norm(tip - fork) < 2.0 * ARTERY_RADIUS or max(depths) < 0.0:
        return None
    return int(np.argmax(depths))
