"""Wires pressed on as hard as can be: none passes a wall, none freezes, and what is said of it is true."""

import functools
import json
import os
from pathlib import Path

import numpy as np
import pytest

from analysis.passages import Wall, count_passages, inside
from analysis.wall_search import Walls, triangles_of
from experiments.campaigns.push_claims import crossings, drive_claims, penetration_claims
from guidewire.logs.logs import read_log
from guidewire.runs.runner import Request

CASES = Path(__file__).with_name("contact_cases")
QUICK = (
    "drive_of_many_parts", "driven_sphere_alone", "four_elements_at_a_ridge", "plate_without_stiffness",
    "spheres_at_a_sharp_edge",
)
SLOW = (
    "base_driven_into_a_branch", "fast_into_a_prism", "jammed_in_a_fine_mesh", "jammed_in_a_helix",
    "jammed_in_a_narrow_tube", "long_elements_among_obstacles", "long_elements_in_a_bent_tube",
    "thrown_at_a_fine_mesh", "tip_stopped_in_a_fine_mesh", "twenty_elements_at_a_ridge",
)
CHOSEN = QUICK + SLOW if os.environ.get("GUIDEWIRE_ALL") else QUICK
ALONE = ("driven_sphere_alone", "spheres_at_a_sharp_edge")  # spheres without element contact
FROZEN = 20  # steps in which a sphere keeps every bit while the wire moves


@pytest.fixture(scope="module")
def make(live, tmp_path_factory):
    """A function that makes a run of a case once: (summary, positions (entries, n + 1, 3) in units)."""
    @functools.cache
    def made(name, **changes):
        folder = tmp_path_factory.mktemp(name)
        answer = live.run(Request(name, CASES / f"{name}.json", folder, changes))
        assert answer.exit_code == 0, answer.message
        return json.loads((folder / "summary.json").read_text()), read_log(folder, spheres="all").positions

    return made


def read_scene(name):
    return {"elementContact": "barycentric", **json.loads((CASES / f"{name}.json").read_text())}


def test_every_case_is_named():
    assert sorted(QUICK + SLOW) == sorted(path.stem for path in CASES.glob("*.json"))


@pytest.mark.parametrize("name", CHOSEN)
@pytest.mark.few(2)
def test_figures_are_those_of_the_log(make, name):
    summary, positions = make(name)
    scene = read_scene(name)
    walls = Walls.of(scene, triangles_of(scene, CASES))
    assert summary["outcome"] == "finished"
    assert [*drive_claims(scene, summary, positions), *penetration_claims(scene, summary, positions, walls)] == []
    if name not in ALONE:
        assert len(crossings(positions, walls)) == 0
        # Others than points through walls are pairs of elements that crossed, for which the run says so.
        assert (summary["passages"] > 0) == any("passed through itself" in line for line in summary["warnings"])


@pytest.mark.parametrize("name", ALONE)
def test_spheres_alone_pass_no_wall_and_what_elements_do_is_counted(make, name):
    summary, positions = make(name)
    vertices, faces = np.unique(triangles_of(read_scene(name), CASES).reshape(-1, 3), axis=0, return_inverse=True)
    wall = Wall.of(vertices, faces.reshape(-1, 3))
    assert inside(wall, positions)[:, ::10].all()
    assert summary["passages"] == count_passages(wall, positions)


@pytest.mark.parametrize("name", ("four_elements_at_a_ridge", "long_elements_among_obstacles"))
@pytest.mark.few(1)
def test_no_sphere_freezes_while_the_wire_moves(make, name):
    _, positions = make(name, maxSimulationSteps=3 * FROZEN)
    stays = np.all(np.diff(positions, axis=0) == 0.0, axis=-1)
    for first in range(len(stays) - FROZEN + 1):
        frozen = stays[first:first + FROZEN].all(axis=0)
        assert frozen.all() or not frozen[1:].any()


def test_a_drive_against_a_wall_is_said_to_be_stuck(make):
    summary, _ = make("driven_sphere_alone")
    assert "but the drive is stuck" in summary["reason"]
