"""How far the tip of a wire in an anatomy moves where mesh, time step, elements or contact distance are finer.

``python3 -m experiments.campaigns.anatomy_independence FOLDER ... --runs 10`` takes folders that ``guidewire.py
anatomy`` wrote. A seed draws thickness (0.36 or 0.89 mm), stiffness and the bend of the tip of a wire that is pushed in
from the scene's inlet; it is run as the scene has it and with each setting finer. Tips are compared where both runs
finish in the same branches; others are counted. Runs whose tip moves by more than a limit are printed.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from analysis.surfaces import read_obj
from anatomy.centreline import cut_edges
from anatomy.mesh import Edges, Mesh
from experiments import building
from experiments.campaigns.anatomy_campaign import DIAMETERS
from experiments.campaigns.push_campaign import parser_of
from experiments.campaigns.vessel import write_obj
from experiments.runner import Request, Runner

DISTANCE = 300.0  # mm pushed, at most
LIMITS = {"timeStep/4": 0.2, "elements x 2": 0.2, "contactDistance/4": 0.2, "triangles x 4": 0.1,
          "triangles x 16": 0.1}  # mm, by which the tip may move
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
        "logEvery": 1_000_000, "logHub": False}


def finer(scene: dict[str, Any], meshes: dict[str, Path]) -> dict[str, dict[str, Any]]:
    """The same run by the name of what is finer in it."""
    elements = {"numberRodElements": 2 * scene["numberRodElements"], "wireSections": [
        section | {"numberRodElements": 2 * section["numberRodElements"]} for section in scene["wireSections"]]}
    return {
        "timeStep/4": scene | {"timeStep": 0.25 * scene["timeStep"],
                               "maxSimulationSteps": 4 * scene["maxSimulationSteps"]},
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


def _tip(runner: Runner, scene: dict[str, Any], folder: Path) -> tuple[np.ndarray, list[str]] | None:
    """Where a run's tip ends, mm, and the branches on its path; None where it does not finish."""
    (folder / "scene.json").write_text(json.dumps(scene))
    answer = runner.run(Request("run", folder / "scene.json", folder / "out"))
    if answer.outcome != "finished":
        return None
    summary = json.loads((folder / "out" / "summary.json").read_text())
    return np.array(summary["hub"]["tipPosition"]), summary["centreline"]["path"]


def main(arguments: Sequence[str]) -> int:
    parser = parser_of("anatomy_independence", __doc__, runs=10)
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER",
                        help="of guidewire.py anatomy; each has so many runs")
    given = parser.parse_args(arguments)
    runner = Runner(building.build(building.RUNNER, print))
    moved: dict[str, dict[str, list[float]]] = {name: {} for name in LIMITS}
    other: Counter[tuple[str, str]] = Counter()
    with tempfile.TemporaryDirectory() as scratch:
        for folder in given.folders:
            meshes = refined(folder, Path(scratch))
            for seed in range(given.first, given.first + given.runs):
                scene = draw(folder, seed)
                base = _tip(runner, scene, Path(scratch))
                for name, changed in finer(scene, meshes).items() if base else ():
                    found = _tip(runner, changed, Path(scratch))
                    if not found or found[1] != base[1]:
                        other[name, folder.name] += 1
                        continue
                    distance = float(np.linalg.norm(found[0] - base[0]))
                    moved[name].setdefault(folder.name, []).append(distance)
                    if distance > LIMITS[name]:
                        print(f"{folder.name} {seed}, {name}: {distance:.3g} mm", flush=True)
            for name in LIMITS:
                _tell(folder.name, name, moved[name].get(folder.name, []), other[name, folder.name])
    for name, found in moved.items():
        _tell("all", name, [distance for distances in found.values() for distance in distances],
              sum(other[name, folder.name] for folder in given.folders))
    runner.close()
    return 0


def _tell(where: str, name: str, distances: list[float], others: int) -> None:
    """One line on the runs with one setting finer; distances of their tips in mm."""
    if distances:
        print(f"{where}, {name}: {np.count_nonzero(np.array(distances) <= LIMITS[name])} of {len(distances)} within "
              f"{LIMITS[name]} mm; median {np.median(distances):.3g}, 95 of 100 {np.quantile(distances, 0.95):.3g}, "
              f"largest {max(distances):.3g}; {others} in other branches or without an end", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
