"""Passages through a vessel's wall, counted from logs by `wall_search`: independent of the simulation's own count.

Open rims are closed by fans first. A passage is a point of the wire, ten an element and the last sphere, that is inside
after one entry of the log and outside after the next one, and did not leave through a rim.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from analysis.wall_search import MeshSearch

SAMPLES = 10  # points an element


class MeshError(Exception):
    """A mesh that cannot be closed. The message is one line."""


@dataclass(frozen=True)
class Wall:
    """A vessel's wall.

    Attributes
    ----------
    triangles : (t, 3, 3), corners, in units; all seen from the same side in the same sense.
    fans : (f, 3, 3), triangles that close the open rims.
    """

    triangles: np.ndarray
    fans: np.ndarray

    @classmethod
    def of(cls, vertices: np.ndarray, faces: np.ndarray) -> Wall:
        """Return a wall from vertices (v, 3) in units and triangles (t, 3) of their indices.

        Raises
        ------
        MeshError : an edge belongs to two triangles in the same sense, or its rims are no simple loops.
        """
        edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
        known = {(int(a), int(b)) for a, b in edges}
        if len(known) != len(edges):
            raise MeshError("two triangles share an edge in the same sense")
        following = {b: a for a, b in known if (b, a) not in known}  # the closing fan runs against the rim's edges
        fans = []
        while following:
            start, loop = next(iter(following)), []
            at = start
            while at in following:
                loop.append(at)
                at = following.pop(at)
            if at != start:
                raise MeshError("a rim is not a simple loop")
            ring = vertices[loop]
            centre = np.broadcast_to(ring.mean(axis=0), ring.shape)
            fans.append(np.stack([ring, np.roll(ring, -1, axis=0), centre], axis=1))
        return cls(vertices[faces], np.concatenate(fans) if fans else np.empty((0, 3, 3)))

    @cached_property
    def closed(self) -> MeshSearch:
        """The search on the wall with its rims closed."""
        return MeshSearch(np.concatenate([self.triangles, self.fans]))


def sample_wire(positions: np.ndarray) -> np.ndarray:
    """Return points at s = 0, 0.1, ... 0.9 of each element and the last sphere: (..., n + 1, 3) to (..., 10 n + 1,
    3)."""
    fraction = np.arange(SAMPLES)[:, None] / SAMPLES
    first, second = positions[..., :-1, None, :], positions[..., 1:, None, :]
    points = (1.0 - fraction) * first + fraction * second
    points = points.reshape(*positions.shape[:-2], -1, 3)
    return np.concatenate([points, positions[..., -1:, :]], axis=-2)


def inside(wall: Wall, positions: np.ndarray) -> np.ndarray:
    """Return whether each sample of a wire is in the lumen: positions (k, n + 1, 3) in units to bool (k, 10 n + 1)."""
    points = sample_wire(positions)
    return wall.closed.inside(points.reshape(-1, 3)).reshape(points.shape[:-1])


def count_passages(wall: Wall, positions: np.ndarray) -> int:
    """Passages of a wire's samples through the wall.

    Parameters
    ----------
    wall : the vessel.
    positions : (k, n + 1, 3), of all spheres after successive steps, in units.
    """
    lumen = inside(wall, positions)
    points = sample_wire(positions)
    left = lumen[:-1] & ~lumen[1:]
    through_rims = 0
    if left.any() and len(wall.fans):
        through_rims = np.count_nonzero(MeshSearch(wall.fans).crosses(points[:-1][left], points[1:][left]))
    return int(np.count_nonzero(left) - through_rims)
