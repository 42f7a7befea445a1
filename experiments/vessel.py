"""The vessel of the scenes: an arch with one branch behind a straight sheath, as a triangle mesh.

The lumen is the union of spheres that run along two centrelines with a radius from a table. Its wall is cut out of a
grid by surface nets (Gibson 1998): one vertex in every cell that the wall passes, moved onto the wall, one quad across
every edge of the grid that the wall cuts. The grid ends at the sheath's entrance, so the wall is open there and closed
everywhere else. ``python3 -m experiments.vessel`` writes ``params/meshes/arch.obj`` anew, the same to the last digit.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

MESH = Path(__file__).resolve().parent.parent / "params" / "meshes" / "arch.obj"
ENTRANCE = -320.0  # z of the open rim, units; the wire (300) lies in the sheath behind it
SPACING = 3.0  # edge of a cell, units
BLEND = 4.0  # how far around their seam the two lumens are rounded into each other, units
ARCH_RADIUS = 60.0  # of the arch's centreline, units
ARCH_START = 80.0  # z where the arch begins, units

# Radius of the main lumen against the arc length of its centreline from the sheath's end: sheath, aorta, arch.
MAIN_RADII = ((-400.0, 8.0), (0.0, 8.0), (25.0, 14.0), (110.0, 13.0), (180.0, 12.0), (340.0, 11.0))
# Radius of the branch against the distance from the main centreline.
BRANCH_RADII = ((0.0, 9.0), (30.0, 8.0), (110.0, 7.0))


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


def main_lumen() -> Lumen:
    """Sheath along z, aorta, half an arch in the y-z plane, and the way down to its closed end."""
    straight = [np.array([0.0, 0.0, z]) for z in (-400.0, 0.0, 25.0, ARCH_START)]
    angles = np.linspace(0.0, np.pi, 37)[1:]
    arch = [np.array([0.0, ARCH_RADIUS * (1.0 - np.cos(a)), ARCH_START + ARCH_RADIUS * np.sin(a)]) for a in angles]
    centres = np.array([*straight, *arch, arch[-1] - np.array([0.0, 0.0, 60.0])])
    steps = np.linalg.norm(np.diff(centres, axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(steps)]) + straight[0][2]
    table = np.array(MAIN_RADII)
    return Lumen(centres, np.interp(arc, table[:, 0], table[:, 1]))


def branch_lumen() -> Lumen:
    """A side branch that leaves the arch 60 degrees after its start and goes on up, to a closed end."""
    angle = np.pi / 3.0
    root = np.array([0.0, ARCH_RADIUS * (1.0 - np.cos(angle)), ARCH_START + ARCH_RADIUS * np.sin(angle)])
    direction = np.array([0.0, 0.25, 1.0]) / np.hypot(0.25, 1.0)
    table = np.array(BRANCH_RADII)
    return Lumen(root + table[:, :1] * direction, table[:, 1])


def depth(points: np.ndarray) -> np.ndarray:
    """Depth (n,) in units of points (n, 3) in both lumens, rounded where they meet."""
    a = main_lumen().depth(points)
    b = branch_lumen().depth(points)
    overlap = np.maximum(BLEND - np.abs(a - b), 0.0) / BLEND
    return np.maximum(a, b) + 0.25 * BLEND * overlap**2


def surface_nets(origin: np.ndarray, shape: tuple[int, int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Wall inside a grid of ``shape`` nodes from ``origin``: vertices (v, 3) in units, triangles (t, 3).

    Seen from inside the lumen the triangles run counter-clockwise.
    """
    steps = np.stack(np.meshgrid(*[np.arange(n) for n in shape], indexing="ij"), axis=-1).reshape(-1, 3)
    inside = (depth(origin + SPACING * steps) > 0.0).reshape(shape)
    corners = sum(
        inside[i : shape[0] - 1 + i, j : shape[1] - 1 + j, k : shape[2] - 1 + k].astype(int)
        for i in (0, 1)
        for j in (0, 1)
        for k in (0, 1)
    )
    cells = np.argwhere((corners > 0) & (corners < 8))
    number = np.full(corners.shape, -1)
    number[tuple(cells.T)] = np.arange(len(cells))
    return origin + SPACING * (cells + 0.5), _triangles(inside, number)


def _triangles(inside: np.ndarray, number: np.ndarray) -> np.ndarray:
    quads = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        low = np.take(inside, range(inside.shape[axis] - 1), axis)
        high = np.take(inside, range(1, inside.shape[axis]), axis)
        cuts = np.argwhere(low != high)
        # Around an edge on the border of the grid there are not four cells: there the wall stays open.
        limit = np.array(number.shape)
        cuts = cuts[(cuts[:, u] > 0) & (cuts[:, v] > 0) & (cuts[:, u] < limit[u]) & (cuts[:, v] < limit[v])]
        du, dv = np.eye(3, dtype=int)[u], np.eye(3, dtype=int)[v]
        ring = [number[tuple((cuts - a * du - b * dv).T)] for a, b in ((1, 1), (0, 1), (0, 0), (1, 0))]
        quad = np.stack(ring, axis=1)
        # The ring runs counter-clockwise seen from above; from inside that is right where the inside is above.
        turned = low[tuple(cuts.T)]
        quad[turned] = quad[turned][:, ::-1]
        quads.append(quad)
    quad = np.concatenate(quads)
    return np.concatenate([quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]])


def onto_wall(vertices: np.ndarray, origin: np.ndarray) -> np.ndarray:
    """Vertices (v, 3) moved onto the wall by Newton's method, those of the open rim within the rim's plane."""
    rim = vertices[:, 2] < origin[2] + SPACING
    step = 1e-4
    for _ in range(8):
        gradient = np.stack(
            [(depth(vertices + step * e) - depth(vertices - step * e)) / (2.0 * step) for e in np.eye(3)], axis=1
        )
        gradient[rim, 2] = 0.0
        squared = np.maximum(np.sum(gradient**2, axis=1), 1e-3)
        vertices = vertices - np.clip(depth(vertices) / squared, -SPACING, SPACING)[:, None] * gradient
    return vertices


def arch() -> tuple[np.ndarray, np.ndarray]:
    """The vessel: vertices (v, 3) in units and triangles (t, 3)."""
    low = np.array([-21.0, -21.0, ENTRANCE - 0.5 * SPACING])
    high = np.array([21.0, 160.0, 275.0])
    shape = tuple(int(n) for n in np.ceil((high - low) / SPACING) + 1)
    vertices, triangles = surface_nets(low, shape)
    used, triangles = np.unique(triangles, return_inverse=True)
    return onto_wall(vertices[used], low), triangles.reshape(-1, 3)


def write_obj(path: Path, vertices: np.ndarray, triangles: np.ndarray) -> None:
    """Writes an OBJ file with coordinates to 1e-4 units."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [f"v {x:.4f} {y:.4f} {z:.4f}" for x, y, z in vertices]
    lines += [f"f {i} {j} {k}" for i, j, k in triangles + 1]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def main() -> None:
    """Writes the mesh of the scenes."""
    write_obj(MESH, *arch())


if __name__ == "__main__":
    main()
