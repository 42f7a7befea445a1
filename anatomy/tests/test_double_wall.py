"""The border between the two surfaces of a double wall."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from anatomy.double_wall import _least_border, inner_wall  # noqa: E402
from anatomy.tests.solids import SLANT, double_walled, tube  # noqa: E402


@pytest.mark.parametrize("seed", range(3))
def test_the_border_is_at_the_lips_where_a_fifth_of_the_triangles_speak_for_the_wrong_side(seed: int) -> None:
    mesh = double_walled()
    count = len(tube(rings=16).triangles)
    is_inner = np.zeros(len(mesh.triangles), dtype=bool)
    is_inner[count:2 * count] = True
    is_lip = np.arange(len(is_inner)) >= 2 * count
    wrong = np.random.default_rng(seed).uniform(size=len(is_inner)) < 0.2
    areas = np.linalg.norm(mesh.area_vectors(), axis=1)
    chosen = _least_border(mesh, np.where(is_lip, 0.0, areas * np.where(is_inner ^ wrong, 1.0, -1.0)), cost=1.0)
    assert (chosen[~is_lip] == is_inner[~is_lip]).all()
    alone = _least_border(mesh, np.where(is_inner ^ wrong, areas, -areas), cost=0.0)
    assert (alone != is_inner)[~is_lip].mean() == pytest.approx(wrong[~is_lip].mean())  # without a cost none is mended


def test_the_inner_wall_has_the_lumens_radius_and_the_thickness_is_the_walls() -> None:
    part, thickness = inner_wall(double_walled(3.0, 4.0))
    middle = (part.vertices @ SLANT > 2.0) & (part.vertices @ SLANT < 38.0)
    radii = np.linalg.norm(part.vertices - (part.vertices @ SLANT)[:, None] * SLANT, axis=1)
    assert np.allclose(radii[middle], 3.0) and np.ptp(part.vertices @ SLANT) > 35.0
    assert thickness == pytest.approx(1.0, rel=0.02)
