"""Vessels of a drawn shape, by their own meshes: what moved, and what the wire meets."""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from guidewire.env import Environment
from guidewire.env.reshaping import STRAIN, Field, reshaped
from guidewire.env.spaces import Error
from guidewire.env.task import FOLDER
from guidewire.env.tests.environment_cases import tube  # noqa: F401
from guidewire.env.vessels import made_vessel
from guidewire.sessions.session import Session

ARCH = FOLDER / "vessels" / "arch-2"
WARP = [0.9, -1.0, 0.8, -0.7, 1.0, -0.9, 1.0, 0.6, -1.0]


def vertices_of(file):
    return np.array([line.split()[1:] for line in Path(file).read_text().splitlines() if line[:2] == "v "], float)


@pytest.fixture(scope="module")
def moved(tmp_path_factory):
    """The arch, warped, its entry tilted: its scene and anatomy, and those before."""
    anatomy = json.loads((ARCH / "anatomy.json").read_text())
    scene = {"vessel": {"file": str(ARCH / "vessel.obj"), "anatomy": str(ARCH / "anatomy.json")}, "inlet": 2}
    return *reshaped(scene, anatomy, WARP, [3.0, -4.0], tmp_path_factory.mktemp("arch")), anatomy


def test_a_field_has_the_gradient_of_its_points_and_joins_no_two():
    random = np.random.default_rng(1)
    points = random.uniform(-50.0, 150.0, (200, 3))
    field = Field(np.array([points.min(axis=0), points.max(axis=0)]), WARP)
    step = 1e-4 * np.eye(3)
    numeric = np.stack([(field.moved(points + one) - field.moved(points - one)) / 2e-4 for one in step], axis=2)
    np.testing.assert_allclose(field.gradients(points), numeric, atol=1e-9)
    strain = np.linalg.norm(field.gradients(points) - np.eye(3), axis=(1, 2))
    assert 0.5 * STRAIN < strain.max() <= 3.0 * STRAIN + 1e-12
    for _ in range(20):    # a strain below 1 leaves a part of every distance
        other = random.permutation(points)
        before, after = points - other, field.moved(points) - field.moved(other)
        assert (np.linalg.norm(after, axis=1) >= (1.0 - 3.0 * STRAIN) * np.linalg.norm(before, axis=1)).all()


def test_spheres_of_a_moved_centreline_fit_its_moved_wall(moved):
    pytest.importorskip("vtkmodules", reason="distances from triangles by vtk")
    from guidewire.anatomy.mesh import Mesh
    from guidewire.anatomy.surfaces import distances

    scene, anatomy, before = moved
    rest = json.loads((ARCH / "scene.json").read_text())
    with Session(None, hand=True, **{**rest, "vessel": {**rest["vessel"], **scene["vessel"]}}) as session:
        (wall,) = session.walls()
    vertices = vertices_of(ARCH / "vessel.obj")
    expected = Field(np.array([vertices.min(axis=0), vertices.max(axis=0)]), WARP).moved(vertices)
    assert len(wall.vertices) == len(vertices)
    assert cKDTree(wall.vertices).query(expected)[0].max() < 1e-9, "the core moves the mesh by the same field"
    spheres, plain = (np.array(one["centreline"]["points"])[::5] for one in (anatomy, before))
    inner = np.all([np.linalg.norm(plain[:, :3] - end["centre"], axis=1) > 1.5 * end["radius"]
                    for end in before["ends"]], axis=0)
    away = distances(spheres[inner, :3], Mesh(wall.vertices, wall.triangles))
    error = np.abs(spheres[inner, 3] / away - 1.0)
    # Where a branch leaves, its first spheres touch both walls, and not across the branch's own beginning.
    assert np.median(error) < 0.005 and np.quantile(error, 0.8) < 0.03 and error.max() < 0.12
    assert np.abs(spheres[:, 3] / plain[:, 3] - 1.0).max() > 0.05, "it has changed"
    assert anatomy["centreline"]["parents"] == before["centreline"]["parents"]


def test_the_wire_enters_by_the_angle_that_was_drawn(moved):
    scene, anatomy, before = moved
    plain = reshaped(scene, before, None, [0.0, 0.0], Path(scene["vessel"]["anatomy"]).parent)[1]
    tilted = reshaped(scene, before, None, [3.0, -4.0], Path(scene["vessel"]["anatomy"]).parent)[1]
    was, now = (np.array(one["ends"][1]["direction"]) for one in (plain, tilted))
    assert np.degrees(np.arccos(was @ now)) == pytest.approx(5.0, abs=1e-4)
    assert plain["ends"] == before["ends"] and tilted["ends"][0] == before["ends"][0]


def test_a_task_draws_shapes_that_options_repeat_and_refuses_wrong_ones():
    with Environment("carotid") as own, Environment("carotid") as other:
        own.reset(seed=1)
        drawn = own.recorded().options
        assert len(drawn["warp"]) == 9 and len(drawn["entry"]) == 2
        first = own.session_state.positions
        np.testing.assert_array_equal(other.reset(options=drawn)[0]["tip"], own._seen()["tip"])
        np.testing.assert_array_equal(other.session_state.positions, first)
        folder = Path(own.scene["vessel"]["anatomy"]).parent
        assert folder.is_dir()
        for wrong, said in (({"warp": [0.5] * 8}, "9 numbers"), ({"warp": [2.0] * 9}, "-1 to 1"),
                            ({"entry": [40.0, 0.0]}, "-30 to 30")):
            with pytest.raises(Error, match=said) as refused:
                other.reset(options={**drawn, **wrong})
            assert "\n" not in str(refused.value)
    assert not folder.exists()


def test_a_vessel_that_is_no_mesh_or_has_no_inlet_is_refused_in_one_line(tube, tmp_path):
    anatomy = json.loads(Path(tube.anatomies[0]).read_text())
    for warp, entry, said in (([0.5] * 9, None, "mesh in a file .obj"), (None, [1.0, 0.0], "needs an inlet")):
        with pytest.raises(Error, match=said):
            reshaped({"vessel": {"shape": "tube"}}, anatomy, warp, entry, tmp_path)


@pytest.mark.parametrize("which, said", [({"make": "arch", "type": 7}, "arches are of type 1, 2 or 3"),
                                         ({"make": "hand"}, "there are arch, iliac, siphon, coronary")])
def test_a_vessel_that_cannot_be_made_is_one_line(which, said, tmp_path, monkeypatch):
    pytest.importorskip("vtkmodules", reason="vessels are made with vtk")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    with pytest.raises(Error, match=said) as refused:
        made_vessel({**which, "seed": 1, "inlet": 1, "target": 2})
    assert "\n" not in str(refused.value) and not list((tmp_path / "guidewire" / "vessels").iterdir())
