"""Crossings of a mesh with itself, against every pair by brute force."""

from __future__ import annotations

import numpy as np
import pytest

from guidewire.anatomy.intersections import self_intersections
from guidewire.anatomy.mesh import Mesh
from guidewire.anatomy.tests.solids import tube


def crossings_by_pairs(mesh: Mesh) -> set[tuple[int, int]]:
    """Pairs (edge's triangle, pierced one): barycentric coordinates of the point where the edge's line meets it."""
    found = set()
    for a, one in enumerate(mesh.triangles):
        for b, other in enumerate(mesh.triangles):
            if a == b or set(one) & set(other):
                continue
            p, q, r = mesh.vertices[other]
            for k in range(3):
                start, end = mesh.vertices[one[k]], mesh.vertices[one[(k + 1) % 3]]
                matrix = np.stack([q - p, r - p, start - end], axis=1)
                if abs(np.linalg.det(matrix)) > 1e-12:
                    u, v, t = np.linalg.solve(matrix, start - p)
                    if u > 0.0 and v > 0.0 and u + v < 1.0 and 0.0 < t < 1.0:
                        found.add((a, b))
    return found


@pytest.mark.parametrize("seed", range(4))
def test_crossings_are_those_of_all_pairs(seed: int) -> None:
    rng = np.random.default_rng(seed)
    size = 10.0 ** rng.uniform(-1.0, 0.3, (40, 1, 1))  # large triangles among small ones
    vertices = (rng.uniform(0.0, 3.0, (40, 1, 3)) + size * rng.standard_normal((40, 3, 3))).reshape(-1, 3)
    mesh = Mesh(vertices, np.arange(120).reshape(-1, 3))
    points, pairs = self_intersections(mesh)
    assert set(map(tuple, pairs)) == crossings_by_pairs(mesh)
    assert len(points) == len(pairs) > 0


def test_a_tube_does_not_cross_itself() -> None:
    assert len(self_intersections(tube())[0]) == 0
