"""Two commands without an option, from files as scanners have them to a wire at its target, judged by the truth.

``python3 -m experiments.campaigns.patient_campaign --out DIR [--only WORD] [FILE ...]`` writes twenty vessels
(`patient_files`), takes other FILEs as well, and calls ``anatomy FILE`` and ``steer scene.json`` for each, in a folder
of its own. Where ``anatomy`` asks for the unit it is given. Each line of its table says what came of one file: right in
its axes, its unit and its place, and whether the wire is at the target.
"""

from __future__ import annotations

import argparse
import itertools
import json
import re
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analysis.passages import Wall
from analysis.wall_search import MeshSearch
from experiments.campaigns import patient_files
from experiments.campaigns.patient_files import Patient
from guidewire.logs.surfaces import read_obj
from guidewire.prepare import ROOT

_NEAR = 0.15  # of a radius, by which the distance of the wall from the axis may differ, in the median
_INSIDE = 1.0  # of an end's radius: nothing of the truth nearer to it is looked at, an end may be cut off there


@dataclass(frozen=True)
class Row:
    """Of one file: what is wrong with it, one phrase each; whether its unit was asked for; the refusal in one line;
    whether the wire came to the target; failed attempts; seconds."""

    name: str
    wrong: list[str]
    is_asked: bool
    refused: str
    is_reached: bool
    attempts: str
    seconds: float

    @property
    def is_right(self) -> bool:
        """Right in all, the wire at its target."""
        return not self.wrong and not self.refused and self.is_reached

    def __str__(self) -> str:
        return (f"| {self.name} | {'yes' if not self.wrong else '; '.join(self.wrong)} | "
                f"{'asked for' if self.is_asked else 'found'} | "
                f"{self.refused or ('yes' if self.is_reached else 'no')} | {self.attempts} |")


def judge(patient: Patient, folder: Path) -> list[str]:
    """What of a vessel's folder is not as the truth has it."""
    found = json.loads((folder / "anatomy.json").read_text())
    scene = json.loads((folder / "scene.json").read_text())
    wrong = []
    if found["patientAxes"] != patient.axes or scene.get("patientAxes", "") != patient.axes:
        wrong.append(f"axes '{found['patientAxes']}'")
    if not len(patient.truth):
        return wrong
    scale = 1e3 * found["metresPerUnit"]
    mesh = read_obj(folder / "vessel.obj")
    wall = Wall.of(scale * mesh.vertices, mesh.triangles)
    ends = np.array([[*end["centre"], end["radius"]] for end in found["ends"]]) * scale
    points = patient.truth[:, :3]
    away = np.linalg.norm(points[:, None] - ends[None, :, :3], axis=2) - (1.0 + _INSIDE) * ends[:, 3]
    points = points[(away > 0.0).all(axis=1)]
    outside = ~MeshSearch(np.concatenate([wall.triangles, wall.fans])).inside(points)
    if outside.mean() > 0.01:
        wrong.append(f"{outside.mean():.0%} of the axis outside")
    # Of the union of the spheres: at a fork the wall is farther from an axis than its own radius.
    expected = np.array([(patient.truth[:, 3] - np.linalg.norm(patient.truth[:, :3] - point, axis=1)).max()
                         for point in points])
    far = MeshSearch(wall.triangles).distance(points)
    off = float(np.median((np.abs(far - expected) - 0.5 * patient.voxel) / expected))
    if off > _NEAR:
        wrong.append(f"wall off by {off:.2g} radii")
    return wrong


def take(patient: Patient, folder: Path, minutes: float | None = None) -> Row:
    """Both commands, in a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    words, is_asked = ["anatomy", str(patient.file)], False
    done = _call(words, folder)
    if done.returncode == 2 and "--unit" in done.stderr:
        is_asked = True
        done = _call([*words, "--unit", "mm"], folder)
    if done.returncode != 0:
        return Row(patient.file.name, [], is_asked, _last(done.stderr), False, "", time.monotonic() - began)
    vessel, = (folder / "results" / "anatomy").iterdir()
    wrong = judge(patient, vessel)
    done = _call(["steer", str(vessel / "scene.json"), "--out", "run",
                  *(["--minutes", str(minutes)] if minutes else [])], folder)
    attempts = sum(int(number) for number in re.findall(r"(\d+) attempts failed", done.stdout))
    is_reached = done.returncode == 0
    if is_reached:
        wrong += _false_success(vessel, json.loads((folder / "run" / "summary.json").read_text()))
    elif done.returncode != 1:
        wrong.append(f"exit code {done.returncode}: {_last(done.stderr)}")
    return Row(patient.file.name, wrong, is_asked, "", is_reached, str(attempts), time.monotonic() - began)


def _false_success(vessel: Path, summary: dict) -> list[str]:
    """Whether the tip is where the target is, by the wall alone."""
    found, scene = (json.loads((vessel / name).read_text()) for name in ("anatomy.json", "scene.json"))
    scale = 1e3 * found["metresPerUnit"]
    target, = (end for end in found["ends"] if end["number"] == scene["target"])
    tip = np.array(summary["hub"]["tipPosition"])
    away = float(np.linalg.norm(tip - scale * np.array(target["centre"])))
    wrong = [] if away < 3.0 * scale * target["radius"] + 1.0 else [f"tip {away:.3g} mm from the target"]
    if summary["passages"]:
        wrong.append(f"{summary['passages']} passages")
    return wrong


def _call(words: list[str], folder: Path) -> subprocess.CompletedProcess:
    return subprocess.run([sys.executable, str(ROOT / "guidewire.py"), *words], cwd=folder, capture_output=True,
                          text=True)


def _last(text: str) -> str:
    return (text.strip().splitlines() or [""])[-1]


def main() -> int:
    """Returns 1 where a file is neither right nor refused."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--only", help="a word in names of the twenty; empty for none of them")
    parser.add_argument("--minutes", type=float)
    asked = parser.parse_args()
    given = (Patient(file.resolve(), "", np.empty((0, 4))) for file in asked.files)
    made = patient_files.write(asked.out.resolve() / "files", lambda name: asked.only is None or (
        asked.only != "" and asked.only in name))
    rows = []
    for patient in itertools.chain(given, made):
        rows.append(take(patient, asked.out.resolve() / patient.file.name, asked.minutes))
        print(rows[-1], f"{rows[-1].seconds:.0f} s", flush=True)
    print(f"{sum(row.is_right for row in rows)} of {len(rows)} right, {sum(bool(row.refused) for row in rows)} refused")
    return int(not all(row.is_right or row.refused for row in rows))


if __name__ == "__main__":
    sys.exit(main())
