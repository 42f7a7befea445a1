"""Wires pushed fast into the vessel: the runner's own count of passages against a search on its logs."""

import json
import os
import subprocess

import numpy as np
import pytest

from analysis.logs import read_log
from analysis.passages import Wall, count_passages
from analysis.surfaces import read_obj
from experiments.prepare import ROOT

SCENE = ROOT / "params" / "insertion.json"
MESH = ROOT / "params" / "meshes" / "arch.obj"
RADIUS = 5.0  # units, the scene's
FASTEST = 20.0  # radii a step
FULL = os.environ.get("GUIDEWIRE_ALL") == "1"
RUNS = 60 if FULL else 1


def push(command, folder, seed, contact):
    """A run with random gains, size and speed: (summary, positions (entries, n + 1, 3) in units)."""
    random = np.random.default_rng(seed)
    chosen = {
        "elementContact": contact,
        "numberRodElements": int(random.integers(10, 61)),
        "constraintSolverSteps": int(random.integers(20, 200)),
        "stretchStiffness": float(random.uniform(0.1, 1.5)),
        "displacementPerStep": float(random.uniform(0.5, FASTEST) * RADIUS),
        "maxSimulationSteps": 20,
    }
    arguments = [text for key, value in chosen.items() for text in (f"-{key}", str(value))]
    done = subprocess.run(
        [*command, "-parameters", str(SCENE), "-out", str(folder), *arguments], capture_output=True, text=True,
    )
    assert done.returncode in (0, 4), done.stderr
    return json.loads((folder / "summary.json").read_text()), read_log(folder, spheres="all").positions


@pytest.fixture(scope="module")
def wall():
    mesh = read_obj(MESH)
    return Wall.of(mesh.vertices, mesh.triangles)


@pytest.mark.skipif(not FULL, reason="test_random_pushes.py has fast wires and slow ones, and every method")
@pytest.mark.parametrize("seed", range(RUNS))
def test_no_wire_with_element_contact_passes_the_wall(runner_command, tmp_path, wall, seed):
    summary, positions = push(runner_command, tmp_path, seed, "barycentric")
    assert summary["passages"] == 0
    assert count_passages(wall, positions) == 0


@pytest.mark.parametrize("seed", range(RUNS))
def test_the_runner_counts_what_the_search_counts(runner_command, tmp_path, wall, seed):
    summary, positions = push(runner_command, tmp_path, seed, "thesis")  # the rule as published, which lets wires pass
    assert count_passages(wall, positions) == summary["passages"]
