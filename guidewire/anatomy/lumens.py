"""Lumens that are unions of spheres along lines, and the files of walls that are made of them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Lumen:
    """A chain of spheres: centres (k, 3) and radii (k,), both in units; between two of them both change linearly."""

    centres: np.ndarray
    radii: np.ndarray

    def depth(self, points: np.ndarray) -> np.ndarray:
        """Distance (n,) in units from the wall, positive inside, of points (n, 3)."""
        best = np.full(len(points), -np.inf)
        for start, end, first, last in zip(self.centres[:-1], self.centres[1:], self.radii[:-1], self.radii[1:]):
            axis = end - start
            length = np.linalg.norm(axis)
            along = (points - start) @ axis / length
            across = np.linalg.norm(points - start - np.outer(along / length, axis), axis=1)
            slope = (last - first) / length
            at = np.clip(along + slope * across / np.sqrt(1.0 - slope**2), 0.0, length)
            best = np.maximum(best, first + slope * at - np.hypot(along - at, across))
        return best


def near_lines(lumens: tuple[Lumen, ...], origin: np.ndarray, spacing: float, shape: tuple[int, int, int]
               ) -> np.ndarray:
    """Which nodes of a grid can be inside: those of cubes around points of the centrelines."""
    near = np.zeros(shape, dtype=bool)
    for lumen in lumens:
        reach = int(np.ceil(1.5 * lumen.radii.max() / spacing))
        for start, end in zip(lumen.centres[:-1], lumen.centres[1:]):
            steps = int(np.ceil(np.linalg.norm(end - start) / spacing)) + 1
            for point in np.linspace(start, end, steps):
                low = np.rint((point - origin) / spacing).astype(int) - reach
                near[tuple(slice(max(i, 0), max(i + 2 * reach + 1, 0)) for i in low)] = True
    return near


def write_obj(path: Path, vertices: np.ndarray, triangles: np.ndarray, digits: int) -> None:
    """Writes an OBJ file with coordinates to so many digits behind the point."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [f"v {x:.{digits}f} {y:.{digits}f} {z:.{digits}f}" for x, y, z in vertices]
    lines += [f"f {i} {j} {k}" for i, j, k in triangles + 1]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")
