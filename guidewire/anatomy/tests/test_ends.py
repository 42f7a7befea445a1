"""Ends of vessels that are cut open."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.distance_grid import cut_open  # noqa: E402
from guidewire.anatomy.mesh import Edges, Mesh, find_rims  # noqa: E402


def test_an_end_is_cut_straight_where_triangles_are_much_longer_than_the_lumen_is_wide() -> None:
    """A closed cylinder of radius 5 between z = 0 and 200, whose wall has no vertex between its ends."""
    around = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    ring = np.stack([5.0 * np.cos(around), 5.0 * np.sin(around), np.zeros(24)], axis=1)
    vertices = np.concatenate([ring, ring + [0.0, 0.0, 200.0], [[0.0, 0.0, 0.0], [0.0, 0.0, 200.0]]])
    triangles = []
    for k in range(24):
        after = (k + 1) % 24
        triangles += [[k, after, 24 + after], [k, 24 + after, 24 + k], [after, k, 48], [24 + k, 24 + after, 49]]
    cut = cut_open(Mesh(vertices, np.array(triangles)), np.array([0.0, 0.0, 6.0]), np.array([0.0, 0.0, 1.0]), 7.5)
    (rim,) = find_rims(cut, Edges.of(cut))
    assert rim.centre == pytest.approx([0.0, 0.0, 6.0], abs=1e-6) and cut.vertices[:, 2].min() == pytest.approx(6.0)
