"""Surfaces for tests, made of numbers alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import Mesh

SLANT = np.array([0.3, -0.5, 0.81]) / np.linalg.norm([0.3, -0.5, 0.81])


def frame(axis: np.ndarray) -> np.ndarray:
    """Rows u, w, axis, orthonormal."""
    u = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    u /= np.linalg.norm(u)
    return np.stack([u, np.cross(axis, u), axis])


def tube(radius: float = 3.0, length: float = 40.0, axis: np.ndarray = SLANT, sides: int = 24, rings: int = 20) -> Mesh:
    """A round tube from the origin along an axis, open at both ends, normals outward."""
    angles = 2.0 * np.pi * np.arange(sides) / sides
    z = np.linspace(0.0, length, rings + 1)
    local = np.stack([np.tile(radius * np.cos(angles), rings + 1), np.tile(radius * np.sin(angles), rings + 1),
                      np.repeat(z, sides)], axis=1)
    i, k = np.meshgrid(np.arange(sides), np.arange(rings))
    a, b = k * sides + i, k * sides + (i + 1) % sides
    c, d = a + sides, b + sides
    triangles = np.concatenate([np.stack([a, b, d], 2).reshape(-1, 3), np.stack([a, d, c], 2).reshape(-1, 3)])
    return Mesh(local @ frame(axis), triangles)


def double_walled(inner: float = 3.0, outer: float = 4.0) -> Mesh:
    """A tube with a thick wall, closed by rings at its ends: what a phantom's file holds."""
    out, into = tube(outer, rings=16), tube(inner, rings=16).turned()
    n = len(out.vertices)
    rims = []
    for first, turned in ((0, True), (n - 24, False)):
        i = first + np.arange(24)
        j = first + (np.arange(24) + 1) % 24
        quads = np.concatenate([np.stack([i, j, n + j], 1), np.stack([i, n + j, n + i], 1)])
        rims.append(quads[:, ::-1] if turned else quads)
    return joined(out, into, np.concatenate(rims))


def joined(first: Mesh, second: Mesh, more: np.ndarray | None = None) -> Mesh:
    """Two meshes in one, and triangles between them."""
    triangles = [first.triangles, second.triangles + len(first.vertices)] + ([] if more is None else [more])
    return Mesh(np.concatenate([first.vertices, second.vertices]), np.concatenate(triangles))


def write_stl(file: Path, mesh: Mesh) -> Path:
    """A binary STL: three vertices a triangle, 32 bits."""
    rows = np.zeros(len(mesh.triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("end", "<u2")])
    rows["corners"] = mesh.corners
    file.write_bytes(b"\0" * 80 + np.uint32(len(rows)).tobytes() + rows.tobytes())
    return file
