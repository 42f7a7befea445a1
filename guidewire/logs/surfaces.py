"""Triangles of a wire and of a vessel's wall, from logged positions and parameter files.

The wire's curve is the one that the Unity scene draws: a cubic through all spheres whose slope at sphere i is
(x_{i+1} - x_{i-1})/2, with rings around it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.logs.logs import LogError


@dataclass(frozen=True)
class Surface:
    """v vertices and t triangles.

    vertices : ndarray (v, 3), units.
    triangles : ndarray of int (t, 3); seen from the side that they face they run counter-clockwise.
    values : ndarray (v,), what a vertex's colour shows; 0 where it shows nothing.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    values: np.ndarray


def curvature(positions: np.ndarray) -> np.ndarray:
    """Curvature at each sphere in 1/unit, shape (n+1,): the angle between neighbouring elements over their mean length.

    positions : ndarray (n+1, 3), units. The two end spheres have none: 0, and so has one that another coincides with.
    """
    elements = np.diff(positions, axis=0)
    lengths = np.linalg.norm(elements, axis=1)
    product = lengths[:-1] * lengths[1:]
    cosine = np.einsum("ij,ij->i", elements[:-1], elements[1:]) / np.where(product > 0.0, product, 1.0)
    angle = np.where(product > 0.0, np.arccos(np.clip(cosine, -1.0, 1.0)), 0.0)
    return np.concatenate([[0.0], angle / (0.5 * (lengths[:-1] + lengths[1:])), [0.0]])


def tube(positions: np.ndarray, radius: float, per_element: int = 4, sides: int = 16) -> Surface:
    """The surface of a wire with round ends, coloured by curvature.

    Parameters
    ----------
    positions : ndarray (n+1, 3), units.
    radius : units.
    per_element : rings an element.
    sides : corners of a ring.
    """
    slopes = np.gradient(positions, axis=0)
    bend = curvature(positions)
    last = len(positions) - 1
    at = np.arange(last * per_element + 1) / per_element
    j = np.minimum(at.astype(int), last - 1)
    t = (at - j)[:, None]
    s = 1.0 - t
    a, b, ma, mb = positions[j], positions[j + 1], slopes[j], slopes[j + 1]
    centres = s * s * (1 + 2 * t) * a + t * t * (3 - 2 * t) * b + t * s * s * ma - t * t * s * mb
    tangents = 6 * t * s * (b - a) + s * (1 - 3 * t) * ma + t * (3 * t - 2) * mb
    lengths = np.linalg.norm(tangents, axis=1, keepdims=True)
    has_one = lengths[:, 0] > 0.0  # not where spheres coincide: such a place takes the direction before it
    before = np.maximum.accumulate(np.where(has_one, np.arange(len(tangents)), has_one.argmax()))
    tangents = (tangents / np.where(lengths > 0.0, lengths, 1.0))[before]
    values = np.interp(at, np.arange(last + 1), bend)
    radii = np.full(len(at), radius)

    angles = np.linspace(0.0, 0.5 * np.pi, 5)[1:]
    first = centres[0] - radius * np.sin(angles[::-1])[:, None] * tangents[0]
    end = centres[-1] + radius * np.sin(angles)[:, None] * tangents[-1]
    caps = len(angles)
    centres = np.concatenate([first, centres, end])
    tangents = np.concatenate([np.repeat(tangents[:1], caps, 0), tangents, np.repeat(tangents[-1:], caps, 0)])
    radii = np.concatenate([radius * np.cos(angles[::-1]), radii, radius * np.cos(angles)])
    values = np.concatenate([np.zeros(caps), values, np.zeros(caps)])

    normal = np.cross(tangents[0], [1.0, 0.0, 0.0] if abs(tangents[0][0]) < 0.9 else [0.0, 1.0, 0.0])
    vertices = np.empty((len(centres), sides, 3))
    turn = 2 * np.pi * np.arange(sides) / sides
    for ring, (centre, tangent) in enumerate(zip(centres, tangents)):
        normal = normal - (normal @ tangent) * tangent
        normal /= np.linalg.norm(normal)
        around = np.outer(np.cos(turn), normal) + np.outer(np.sin(turn), np.cross(tangent, normal))
        vertices[ring] = centre + radii[ring] * around
    return Surface(vertices.reshape(-1, 3), _strips(len(centres), sides), np.repeat(values, sides))


def refine(surface: Surface, longest: float) -> Surface:
    """Return the same surface of triangles that have no side longer than ``longest``, units; those that had none
    stay."""
    corners = surface.vertices[surface.triangles]
    done = []
    while len(corners):
        sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
        small = sides.max(axis=1) <= longest
        done.append(corners[small])
        # The longest side is halved: that ends, and leaves no triangle flatter than half of what it was.
        large, side = corners[~small], sides[~small].argmax(axis=1)
        order = (side[:, None] + np.arange(3)) % 3
        a, b, c = np.moveaxis(np.take_along_axis(large, order[:, :, None], axis=1), 1, 0)
        middle = 0.5 * (a + b)
        corners = np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
    if len(done) == 1:
        return surface
    vertices, triangles = np.unique(np.concatenate(done).reshape(-1, 3), axis=0, return_inverse=True)
    return Surface(vertices, triangles.reshape(-1, 3), np.zeros(len(vertices)))


def read_obj(path: Path) -> Surface:
    """Return the triangles of an OBJ file, turned so that they face inwards (their signed volume is negative).

    Raises LogError where it cannot be read.
    """
    vertices, triangles = [], []
    try:
        for line in path.read_text(encoding="utf-8").splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
                triangles += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    except (OSError, ValueError) as error:
        raise LogError(f"{path}: cannot be read: {error}") from error
    points, faces = np.array(vertices), np.array(triangles)
    a, b, c = (points[faces[:, k]] - points.mean(axis=0) for k in range(3))
    if np.einsum("ij,ij->", a, np.cross(b, c)) > 0.0:
        faces = faces[:, ::-1]
    return Surface(points, faces, np.zeros(len(points)))


def _strips(rings: int, sides: int) -> np.ndarray:
    a = np.arange((rings - 1) * sides)
    b = np.where(a % sides == sides - 1, a + 1 - sides, a + 1)
    return np.concatenate([np.stack([a, b, a + sides], 1), np.stack([b, b + sides, a + sides], 1)])
