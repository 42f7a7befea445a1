"""Vessels that cannot be, or are hardly meant: one line and exit code 2, or a warning with the place and the sizes."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest

from guidewire.prepare import ROOT
from guidewire.runs.runner import Request

LIMIT = 30.0  # s of wall time for a refusal; a file without end takes for ever


def run(live, folder, scene):
    """The runner's answer to a scene: (exit code, lines of its message, folder of the run)."""
    path = folder / "scene.json"
    settings = {"maxSimulationSteps": 1, "constraintSolverSteps": 5, "guidewireOffset": -300.0}
    path.write_text(json.dumps({**settings, **scene}))
    shutil.rmtree(folder / "out", ignore_errors=True)
    answer = live.run(Request("walls", path, folder / "out"), LIMIT)
    return answer.exit_code, answer.message.splitlines(), folder / "out"


def assert_refused(live, folder, scene, *words):
    code, lines, out = run(live, folder, scene)
    assert (code, len(lines)) == (2, 1), lines
    assert all(word in lines[0] for word in words), lines[0]
    assert not out.exists()


@pytest.mark.parametrize("scale", [[2, 1, 1], [1, 2, 1], [1, 1, 2]])
def test_a_tube_that_would_not_stay_circular_is_refused(live, tmp_path, scale):
    tube = {"shape": "tube", "knots": [[0, 0, -400], [0, 0, 400]], "radius": 20}
    assert_refused(live, tmp_path, {"vessel": tube, "scale": scale}, "three equal factors")


def warnings_of(live, folder, scene):
    code, lines, out = run(live, folder, scene)
    assert code == 0, lines
    warnings = json.loads((out / "summary.json").read_text())["warnings"]
    # These runs end while the first displacement still presses the wire together.
    return [line for line in warnings if not line.startswith("the wire is ")]


def mesh(file, **more):
    return {"vessel": {"shape": "mesh", "file": str(file), **more}}


def cylinder(radii, sides=16, length=400.0):
    """A tube along z from -350 on, closed at both ends: vertices (v, 3) and quads and fans as index lists."""
    heights = np.linspace(0.0, length, len(radii)) - 350.0
    angles = 2.0 * np.pi * np.arange(sides) / sides
    rings = [np.column_stack([r * np.cos(angles), r * np.sin(angles), np.full(sides, z)])
             for r, z in zip(radii, heights)]
    faces = [[i * sides + k, i * sides + (k + 1) % sides, (i + 1) * sides + (k + 1) % sides, (i + 1) * sides + k]
             for i in range(len(radii) - 1) for k in range(sides)]
    first, last = list(range(sides)), list(range((len(radii) - 1) * sides, len(radii) * sides))
    return np.concatenate(rings), [*faces, first[::-1], last]


def write_obj(path, vertices, faces):
    path.write_text("".join(f"v {x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in vertices)
                    + "".join("f " + " ".join(str(i + 1) for i in face) + "\n" for face in faces))
    return path


# 256 MiB are read before they are too many.
ONE_READER = pytest.mark.long("every file of a run is read up to the same limit by the same lines")


def test_a_folder_as_mesh_is_named_as_one(live, tmp_path):
    (tmp_path / "vessel.obj").mkdir()
    assert_refused(live, tmp_path, mesh("vessel.obj"), "vessel.obj: is a folder, a mesh file is needed")


@pytest.mark.parametrize("name", ["/dev/zero", "endless.obj", pytest.param("endless.stl", marks=ONE_READER)])
def test_a_mesh_without_end_is_refused(live, tmp_path, name):
    for link in ("endless.obj", "endless.stl"):
        (tmp_path / link).symlink_to("/dev/zero")
    words = ["ends in .obj or .stl"] if name == "/dev/zero" else ["endless", "holds more than 256 MiB"]
    assert_refused(live, tmp_path, mesh(name), *words)


@pytest.mark.parametrize("key", [pytest.param("parameters", marks=ONE_READER), "startFile",
                                 pytest.param("loadTables", marks=ONE_READER)])
def test_another_file_without_end_is_refused(runner_command, live, tmp_path, key):
    scene = {"startFile": "/dev/zero"} if key == "startFile" else {
        "solver": "direct", "loadTables": {"gravity": "/dev/zero"}}
    if key != "parameters":
        assert_refused(live, tmp_path, scene, key, "/dev/zero: holds more than 256 MiB")
        return
    done = subprocess.run([*runner_command, "-parameters", "/dev/zero", "-out", str(tmp_path / "out")],
                          capture_output=True, text=True, timeout=LIMIT)
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert "/dev/zero: holds more than 256 MiB, which no file of a run may" in done.stderr


def test_coordinates_of_1e300_are_refused_where_they_stand(live, tmp_path):
    vertices, faces = cylinder([20.0, 20.0])
    vertices[3, 1] = 1e300
    file = write_obj(tmp_path / "far.obj", vertices, faces)
    assert_refused(live, tmp_path, mesh(file), "far.obj", "vertex 4 of 32", "1E+300", "up to 1e9 units")
    tube = {"shape": "tube", "knots": [[0, 0, -400], [0, 0, 1e300]], "radius": 10}
    assert_refused(live, tmp_path, {"vessel": tube}, "vessel.knots[1]", "1E+300", "1e9 at most")
    plane = {"shape": "plane", "point": [0, -1e300, 0], "normal": [0, 1, 0]}
    assert_refused(live, tmp_path, {"vessel": plane}, "vessel.point", "1E+300", "1e9 at most")
    ball = {"shape": "sphere", "centre": [0, 0, 0], "radius": 1e300}
    assert_refused(live, tmp_path, {"obstacles": [ball]}, "obstacles[0].radius", "1E+300", "1e9 at most")


def test_a_wire_outside_is_reported_where_it_and_the_vessel_are(live, tmp_path):
    file = write_obj(tmp_path / "tube.obj", *cylinder([20.0, 20.0]))
    assert_refused(live, tmp_path, {**mesh(file), "position": [100, 0, 0]}, "starts outside",
                   "the wire reaches from (0, 0, -300) to (0, 0, 0)",
                   "the vessel from (80, -20, -350) to (120, 20, 50)")


def test_corners_that_differ_by_rounding_are_one(live, tmp_path):
    vertices, faces = cylinder([20.0, 20.0, 20.0])
    soup = np.concatenate([vertices[face] for face in faces])
    counts = np.cumsum([0] + [len(face) for face in faces])
    apart = [list(range(a, b)) for a, b in zip(counts[:-1], counts[1:])]
    shifts = np.random.default_rng(5).uniform(-0.5, 0.5, soup.shape)
    size = 400.0
    file = write_obj(tmp_path / "soup.obj", soup + 1e-9 * size * shifts, apart)
    assert warnings_of(live, tmp_path, mesh(file)) == []
    file = write_obj(tmp_path / "soup.obj", soup + 1e-6 * size * shifts, apart)
    assert_refused(live, tmp_path, mesh(file), "soup.obj", "separate surfaces")


def test_a_mesh_that_goes_through_itself_is_warned_of_with_the_place(live, tmp_path):
    vertices, faces = cylinder([20.0, 20.0, 20.0, 20.0])
    vertices[16] = [-60.0, 5.0, vertices[16, 2]]  # a corner of the second ring, at (20, 0), pulled through the far side
    file = write_obj(tmp_path / "through.obj", vertices, faces)
    scene = {**mesh(file), "guidewireOffset": 20.0, "guidewireLength": 20.0, "sphereRadius": 1.0}
    (warning,) = [line for line in warnings_of(live, tmp_path, scene) if "through.obj" in line]
    assert "through.obj: the mesh intersects itself" in warning
    place = [float(text) for text in warning.split("the first at (")[1].split(")")[0].split(",")]
    assert np.hypot(place[0], place[1]) == pytest.approx(20.0, rel=0.05)


@pytest.mark.parametrize("factor, word", [(1000.0, "4E+05 units long"), (1.0, None)])
def test_a_vessel_of_another_unit_is_warned_of_with_both_sizes(live, tmp_path, factor, word):
    file = write_obj(tmp_path / "tube.obj", *cylinder([20.0, 20.0]))
    warnings = warnings_of(live, tmp_path, mesh(file, metresPerUnit=1e-3 * factor))
    assert len(warnings) == (word is not None)
    if word:
        assert word in warnings[0] and "the wire 300 units long with a radius of 5" in warnings[0]


def test_a_vessel_a_thousandth_as_large_is_refused_with_both_extents(live, tmp_path):
    file = write_obj(tmp_path / "tube.obj", *cylinder([20.0, 20.0]))
    assert_refused(live, tmp_path, mesh(file, metresPerUnit=1e-6), "starts outside", "(0, 0, -300)",
                   "from (-0.02, -0.02, -0.35) to (0.02, 0.02, 0.05)")


def test_a_wire_wider_than_a_narrow_place_ahead_of_it_is_refused_with_the_place(live, tmp_path):
    radii = np.full(81, 20.0)
    radii[73:78] = [14.0, 8.0, 4.0, 8.0, 14.0]  # narrowest at z = 25
    file = write_obj(tmp_path / "narrow.obj", *cylinder(radii, sides=32))
    scene = {**mesh(file), "drive": "push", "displacementPerStep": 1.0, "maxSimulationSteps": 60}
    code, (line,), out = run(live, tmp_path, scene)
    found = re.search(r"sphereRadius = 5 is larger than the lumen along the wire's path: (\S+) units at \((.*)\)", line)
    assert code == 2 and not out.exists() and found, line
    assert 3.9 < float(found[1]) <= 4.0  # the 32-sided ring's apothem is 3.98
    assert [float(text) for text in found[2].split(",")] == pytest.approx([0.0, 0.0, 25.0], abs=1.0)
    assert warnings_of(live, tmp_path, {**scene, "sphereRadius": 3.5, "maxSimulationSteps": 1}) == []
    tube = {"shape": "tube", "knots": [[0, 0, -400], [0, 0, 10], [0, 0, 20], [0, 0, 30]], "radius": [9, 9, 3, 9]}
    assert_refused(live, tmp_path, {**scene, "vessel": tube}, "sphereRadius = 5", "3 units at (0, 0, 20)")


def test_the_scenes_of_the_repository_are_free_of_warnings(live, tmp_path):
    for name in ("insertion", "collision-vessel", "collision-wall"):
        scene = ROOT / "params" / f"{name}.json"
        answer = live.run(Request(name, scene, tmp_path / name, {"maxSimulationSteps": 0}))
        assert answer.exit_code == 0, answer.message
        assert json.loads((tmp_path / name / "summary.json").read_text())["warnings"] == []
