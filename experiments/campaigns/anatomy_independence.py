"""How far the tip of a wire in an anatomy moves where mesh, time step, elements or contact distance are finer.

``python3 -m experiments.campaigns.anatomy_independence FOLDER ... --runs 10`` takes folders that ``guidewire.py
anatomy`` wrote. A seed draws thickness (0.36 or 0.89 mm), stiffness and the bend of the tip of a wire that is pushed in
from the scene's inlet; it is run as the scene has it and with each setting finer. Tips are compared where both runs
finish in the same branches of the vessel and on the same branch of equilibria; others are counted. Runs whose tip moves
by more than a limit are printed.

A wire that is pushed slowly is in equilibrium. Where that loses stability the tip jumps to another equilibrium, and
which one is decided by less than any setting. Two runs end on other branches of equilibria where their tips end as far
apart as a jump, and part, that is, come farther apart than the limit and stay so, within 10 mm of push of a jump of
either. A jump is more than 5 mm of the tip's displacement for 1 mm of push.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from experiments.campaigns.anatomy_campaign import DIAMETERS
from experiments.campaigns.push_campaign import parser_of
from guidewire.anatomy.sampling import cut_edges
from guidewire.anatomy.lumens import write_obj
from guidewire.anatomy.mesh import Edges, Mesh
from guidewire.logs.logs import read_log
from guidewire.logs.surfaces import read_obj
from guidewire.runs import building
from guidewire.runs.runner import Request, Runner

DISTANCE = 300.0  # mm pushed, at most
LIMITS = {"timeStep/4": 0.2, "elements x 2": 0.2, "contactDistance/4": 0.2, "triangles x 4": 0.1,
          "triangles x 16": 0.1}  # mm, by which the tip may move
_JUMP = 5.0  # mm, the displacement of a tip between two records, 1 mm of push apart, from which on it is a jump
_BESIDE = 10  # records between a jump and where tips part, at most
_DIGITS = 9  # of a mesh's coordinates: corners between two others are on their edge to that


def draw(folder: Path, seed: int) -> dict[str, Any]:
    """The parameters of a run in a folder's vessel."""
    random = np.random.default_rng([29, seed])
    scene = json.loads((folder / "scene.json").read_text())
    stiffness = float(np.exp(random.uniform(np.log(20e9), np.log(80e9))))
    bend, angle = random.uniform(0.0, 30.0), random.uniform(0.0, 2.0 * np.pi)
    *behind, last = scene["wireSections"]
    steps = int(min(DISTANCE, 0.9 * scene["guidewireLength"]) / (1e3 * scene["insertionSpeed"] * scene["timeStep"]))
    return scene | {
        "wireRadius": 0.5e-3 * float(random.choice(DIAMETERS)), "youngsModulus": stiffness,
        "shearModulus": 0.38 * stiffness, "maxSimulationSteps": min(scene["maxSimulationSteps"], steps),
        "wireSections": [*behind, last | {"restCurvature": [bend * np.cos(angle), bend * np.sin(angle), 0.0]}],
        "vessel": scene["vessel"] | {"file": str(folder.resolve() / "vessel.obj"),
                                     "anatomy": str(folder.resolve() / "anatomy.json")},
        "logEvery": _records(scene), "logSpheres": "last", "logFormat": "npz", "logHub": False}


def _records(scene: dict[str, Any]) -> int:
    """Steps for 1 mm of push."""
    return max(1, round(1.0 / (1e3 * scene["insertionSpeed"] * scene["timeStep"])))


def finer(scene: dict[str, Any], meshes: dict[str, Path]) -> dict[str, dict[str, Any]]:
    """The same run by the name of what is finer in it."""
    elements = {"numberRodElements": 2 * scene["numberRodElements"], "wireSections": [
        section | {"numberRodElements": 2 * section["numberRodElements"]} for section in scene["wireSections"]]}
    return {
        "timeStep/4": scene | {"timeStep": 0.25 * scene["timeStep"],
                               "maxSimulationSteps": 4 * scene["maxSimulationSteps"],
                               "logEvery": 4 * scene["logEvery"]},
        "elements x 2": scene | elements,
        "contactDistance/4": scene | {"contactDistance": 0.25 * scene["contactDistance"]},
        **{name: scene | {"vessel": scene["vessel"] | {"file": str(file)}} for name, file in meshes.items()}}


def refined(folder: Path, out: Path) -> dict[str, Path]:
    """The same surface in 4 and 16 times the triangles, by name."""
    found = read_obj(folder / "vessel.obj")
    mesh, files = Mesh(found.vertices, found.triangles), {}
    for factor in (4, 16):
        edges = Edges.of(mesh)
        mesh = cut_edges(mesh, edges, np.ones(len(edges.ends), bool))
        files[f"triangles x {factor}"] = out / f"{folder.name}-{factor}.obj"
        write_obj(files[f"triangles x {factor}"], mesh.vertices, mesh.triangles, _DIGITS)
    return files


@dataclass(frozen=True)
class Push:
    """Of a run that finished: the tip's places 1 mm of push apart, mm, (k, 3); branches of the vessel on its path;
    energy of the wire at the end, J."""

    tips: np.ndarray
    path: list[str]
    energy: float


def is_other_equilibrium(one: np.ndarray, other: np.ndarray, limit: float) -> bool:
    """Whether two tips, (k, 3) in mm, 1 mm of push apart, end on other branches of equilibria."""
    apart = np.linalg.norm(one - other, axis=1) > limit
    parting = len(apart) - int(np.argmin(apart[::-1]))  # the first record from which on they are apart
    if apart.all() or np.linalg.norm(one[-1] - other[-1]) <= _JUMP:
        return False
    moved = np.stack([np.linalg.norm(np.diff(tips, axis=0), axis=1) for tips in (one, other)]).max(axis=0)
    jumps = 1 + np.flatnonzero(moved > _JUMP)
    return bool((np.abs(jumps - parting) <= _BESIDE).any())


def _push(runner: Runner, scene: dict[str, Any], folder: Path) -> Push | None:
    """One run; None where it does not finish."""
    (folder / "scene.json").write_text(json.dumps(scene))
    answer = runner.run(Request("run", folder / "scene.json", folder / "out"))
    if answer.outcome != "finished":
        return None
    summary = json.loads((folder / "out" / "summary.json").read_text())
    tips = read_log(folder / "out").positions[:, 0]
    return Push(tips, summary["centreline"]["path"], summary["solver"]["energy"])


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("anatomy_independence", __doc__, runs=10)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER",
                        help="of guidewire.py anatomy; each has so many runs")
    given = parser.parse_args(arguments)
    runner = Runner(building.build(building.RUNNER, print))
    moved: dict[str, dict[str, list[float]]] = {name: {} for name in LIMITS}
    other: Counter[tuple[str, str]] = Counter()
    equilibria: Counter[tuple[str, str]] = Counter()
    with tempfile.TemporaryDirectory() as scratch:
        for folder in given.folders:
            meshes = refined(folder, Path(scratch))
            for seed in range(given.first, given.first + given.runs):
                scene = draw(folder, seed)
                base = _push(runner, scene, Path(scratch))
                for name, changed in finer(scene, meshes).items() if base else ():
                    found = _push(runner, changed, Path(scratch))
                    if not found or found.path != base.path:
                        other[name, folder.name] += 1
                        continue
                    distance = float(np.linalg.norm(found.tips[-1] - base.tips[-1]))
                    is_other = is_other_equilibrium(base.tips, found.tips, LIMITS[name])
                    if distance > LIMITS[name]:
                        print(f"{folder.name} {seed}, {name}: {distance:.3g} mm{', another equilibrium' * is_other}; "
                              f"energy {base.energy:.6g} and {found.energy:.6g} J", flush=True)
                    if is_other:
                        equilibria[name, folder.name] += 1
                    else:
                        moved[name].setdefault(folder.name, []).append(distance)
            for name in LIMITS:
                _tell(folder.name, name, moved[name].get(folder.name, []), other[name, folder.name],
                      equilibria[name, folder.name])
    for name, found in moved.items():
        _tell("all", name, [distance for distances in found.values() for distance in distances],
              *(sum(count[name, folder.name] for folder in given.folders) for count in (other, equilibria)))
    runner.close()
    return 0


def _tell(where: str, name: str, distances: list[float], others: int, equilibria: int) -> None:
    """One line on the runs with one setting finer; distances of their tips in mm."""
    found = "none to compare" if not distances else (
        f"{np.count_nonzero(np.array(distances) <= LIMITS[name])} of {len(distances)} within {LIMITS[name]} mm; median "
        f"{np.median(distances):.3g}, 95 of 100 {np.quantile(distances, 0.95):.3g}, largest {max(distances):.3g}")
    print(f"{where}, {name}: {found}; {others} in other branches or without an end, {equilibria} in another "
          "equilibrium", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
