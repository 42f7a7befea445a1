"""Motions made of the surfaces of a cycle are those that moved the surfaces, in closed form."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.mesh import Mesh  # noqa: E402
from guidewire.anatomy.motion import VesselMotion  # noqa: E402
from guidewire.anatomy.shapes import make  # noqa: E402
from guidewire.anatomy.tests.solids import tube, write_stl  # noqa: E402
from guidewire.commands.commands import parse, run  # noqa: E402
from guidewire.prepare import PreparationError  # noqa: E402

AXIS, ACROSS = np.array([0.0, 0.0, 1.0]), np.array([[1.0, 0.5, 0.0], [0.2, -1.0, 0.0]])


def moved(points: np.ndarray, phase: float, length: float) -> np.ndarray:
    """A tube that bends by a tenth of its length, to and fro on two sides, and is stretched by up to 3 %."""
    share = points[:, 2:] / length
    ways = 0.1 * length * (np.sin(2 * np.pi * phase) * ACROSS[0] + (1 - np.cos(2 * np.pi * phase)) * 0.3 * ACROSS[1])
    return points + share**2 * ways + 0.03 * np.sin(2 * np.pi * phase) * points * AXIS


def anatomy(folder: Path, count: int, words: str = "") -> int:
    files = [str(folder / f"p{k}.stl") for k in range(count)]
    return run(parse(["anatomy", files[0], *shlex.split(words), "--unit", "mm", "--out", str(folder / "out"), "--cycle",
                      *files[1:]]))


def errors(folder: Path, points: np.ndarray, count: int, truth) -> np.ndarray:
    """Return (phases, k): how far points are from where the motion of a folder ought to take them."""
    motion = VesselMotion({"period": 1, "rampTime": 0, "centreline": str(folder / "out" / "motion.csv")}, 1e-3)
    found = []
    for k in range(count):
        motion.set_time(k / count)
        found.append(np.linalg.norm(motion.moved(points) - truth(points, k / count), axis=1))
    return np.array(found)


def test_surfaces_without_common_vertices_give_the_motion_that_moved_them(tmp_path: Path, capsys) -> None:
    for k in range(4):
        mesh = tube(3.0, 60.0, AXIS, sides=20 + 2 * k, rings=30 - k)
        write_stl(tmp_path / f"p{k}.stl", Mesh(moved(mesh.vertices, k / 4, 60.0), mesh.triangles))
    assert anatomy(tmp_path, 4) == 0
    told = re.search(r"is (\S+) mm from the surfaces in the mean, (\S+) mm at most", capsys.readouterr().out)
    found = errors(tmp_path, tube(3.0, 60.0, AXIS).vertices, 4, lambda x, phase: moved(x, phase, 60.0))
    # Of up to 6.9 mm. Sections that were sheared are taken for plane ones: 0.2 radians times the radius at the end.
    assert found[0].max() < 0.01 and np.sqrt(np.mean(found**2)) < 0.3 and found.max() < 0.9
    assert 0.0 < float(told[1]) < 0.1 and float(told[2]) < 0.8
    scene = json.loads((tmp_path / "out" / "scene.json").read_text())
    assert scene["vessel"]["motion"] == {"heartRate": 60.0, "centreline": "motion.csv"}


def test_phases_of_other_vessels_are_refused(tmp_path: Path) -> None:
    for k, length in enumerate((24.0, 12.0, 24.0)):
        write_stl(tmp_path / f"p{k}.stl", tube(3.0, length, AXIS, 12, 10))
    with pytest.raises(PreparationError, match="fewer than two ends in common"):
        anatomy(tmp_path, 3)
    with pytest.raises(PreparationError, match="at least two files of later phases"):
        anatomy(tmp_path, 2)


@pytest.mark.long("four centrelines of a vessel with five ends")
def test_branches_go_where_the_branches_went(tmp_path: Path) -> None:
    mesh, _, _ = make("iliac", 1, 1, None, None)
    low = mesh.vertices.min(axis=0)

    def truth(x: np.ndarray, phase: float) -> np.ndarray:
        y = (x - low) / 235.0
        share = np.sin(2 * np.pi * phase) - 0.3 * (1 - np.cos(2 * np.pi * phase))
        return x + 10.0 * share * np.c_[np.sin(2 * y[:, 2]), y[:, 1]**2 - 0.3 * y[:, 2],
                                        0.5 * y[:, 0] - 0.3 * y[:, 2]**2]

    for k in range(4):
        write_stl(tmp_path / f"p{k}.stl", Mesh(truth(mesh.vertices, k / 4), mesh.triangles))
    assert anatomy(tmp_path, 4) == 0
    found = errors(tmp_path, mesh.vertices[::5], 4, truth)    # of up to 13.4 mm
    assert np.sqrt(np.mean(found**2)) < 0.5 and found.max() < 1.7
