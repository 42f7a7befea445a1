"""The vessels of the scenes, as triangle meshes: an arch with one branch behind a straight sheath, and an artery of 4
mm that bends and forks.

A lumen is the union of spheres that run along two centrelines with a radius from a table. Its wall is cut out of a grid
by surface nets (Gibson 1998): one vertex in every cell that the wall passes, moved onto the wall, one quad across every
edge of the grid that the wall cuts. The grid ends at the entrance, so the wall is open there and closed everywhere
else. ``python3 -m experiments.scene_meshes`` writes ``params/meshes`` anew, the same to the last digit.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from guidewire.anatomy.lumens import Lumen, near_lines, write_obj
from guidewire.prepare import ROOT

MESHES = ROOT / "params" / "meshes"
MESH = MESHES / "arch.obj"
ARTERY = MESHES / "artery.obj"
ENTRANCE = -320.0  # z of the open rim, units; the wire (300) lies in the sheath behind it
SPACING = 3.0  # edge of a cell, units
BLEND = 4.0  # how far around their seam the two lumens are rounded into each other, units
ARCH_RADIUS = 60.0  # of the arch's centreline, units
ARCH_START = 80.0  # z where the arch begins, units

# Radius of the main lumen against the arc length of its centreline from the sheath's end: sheath, aorta, arch.
MAIN_RADII = ((-400.0, 8.0), (0.0, 8.0), (25.0, 14.0), (110.0, 13.0), (180.0, 12.0), (340.0, 11.0))
# Radius of the branch against the distance from the main centreline.
BRANCH_RADII = ((0.0, 9.0), (30.0, 8.0), (110.0, 7.0))

# The artery, mm: a straight piece, a bend towards x, a straight piece, and a fork across that plane.
ARTERY_ENTRANCE = -20.0
ARTERY_SPACING = 0.62
ARTERY_BLEND = 0.6
ARTERY_RADIUS = 2.0
ARTERY_BEND = (80.0, 50.0, np.radians(40.0))  # where it begins along z, its radius, its angle
ARTERY_FORK = 30.0  # behind the bend
ARTERY_ARMS = ((30.0, np.radians(-25.0), 215.0), (30.0, np.radians(40.0), 120.0))  # radius, angle, straight piece


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
    """Return a side branch that leaves the arch 60 degrees after its start and goes on up, to a closed end."""
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


def artery_lumens() -> tuple[Lumen, Lumen]:
    """Return the artery with its first arm and the second arm alone."""
    start, radius, angle = ARTERY_BEND
    stem = [np.array([0.0, 0.0, z]) for z in (ARTERY_ENTRANCE - 10.0, start)]
    stem += [np.array([radius * (1.0 - np.cos(a)), 0.0, start + radius * np.sin(a)])
             for a in np.linspace(0.0, angle, 13)[1:]]
    along, across = np.array([np.sin(angle), 0.0, np.cos(angle)]), np.array([0.0, 1.0, 0.0])
    fork = stem[-1] + ARTERY_FORK * along
    arms = []
    for bend, turn, straight in ARTERY_ARMS:
        arm = [fork + bend * (np.sin(a) * along + (1.0 - np.cos(a)) * across)
               for a in np.linspace(0.0, abs(turn), 13)]
        arm.append(arm[-1] + straight * (np.cos(turn) * along + np.sin(abs(turn)) * across))
        # The first arm turns away from y.
        arms.append([fork + (p - fork) * np.array([1.0, np.sign(turn), 1.0]) for p in arm])
    whole, branch = np.array([*stem, *arms[0]]), np.array(arms[1])
    return tuple(Lumen(c, np.full(len(c), ARTERY_RADIUS)) for c in (whole, branch))


def artery_depth(points: np.ndarray) -> np.ndarray:
    """Depth (n,) in mm of points (n, 3) in the artery, rounded where its arms part."""
    a, b = (lumen.depth(points) for lumen in artery_lumens())
    overlap = np.maximum(ARTERY_BLEND - np.abs(a - b), 0.0) / ARTERY_BLEND
    return np.maximum(a, b) + 0.25 * ARTERY_BLEND * overlap**2


def surface_nets(origin: np.ndarray, spacing: float, inside: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Wall within a grid from ``origin`` whose nodes are inside or not: vertices (v, 3), triangles (t, 3).

    Seen from inside the lumen the triangles run counter-clockwise.
    """
    shape = inside.shape
    corners = sum(
        inside[i : shape[0] - 1 + i, j : shape[1] - 1 + j, k : shape[2] - 1 + k].astype(int)
        for i in (0, 1)
        for j in (0, 1)
        for k in (0, 1)
    )
    cells = np.argwhere((corners > 0) & (corners < 8))
    number = np.full(corners.shape, -1)
    number[tuple(cells.T)] = np.arange(len(cells))
    return origin + spacing * (cells + 0.5), _triangles(inside, number)


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


def onto_wall(vertices: np.ndarray, origin: np.ndarray, spacing: float, depth: Callable[[np.ndarray], np.ndarray]
              ) -> np.ndarray:
    """Vertices (v, 3) moved onto the wall by Newton's method, those of the open rim within the rim's plane."""
    rim = vertices[:, 2] < origin[2] + spacing
    step = 1e-4
    for _ in range(8):
        gradient = np.stack(
            [(depth(vertices + step * e) - depth(vertices - step * e)) / (2.0 * step) for e in np.eye(3)], axis=1
        )
        gradient[rim, 2] = 0.0
        squared = np.maximum(np.sum(gradient**2, axis=1), 1e-3)
        vertices = vertices - np.clip(depth(vertices) / squared, -spacing, spacing)[:, None] * gradient
    return vertices


def arch() -> tuple[np.ndarray, np.ndarray]:
    """Return the vessel: vertices (v, 3) in units and triangles (t, 3)."""
    low = np.array([-21.0, -21.0, ENTRANCE - 0.5 * SPACING])
    high = np.array([21.0, 160.0, 275.0])
    shape = tuple(int(n) for n in np.ceil((high - low) / SPACING) + 1)
    steps = np.stack(np.meshgrid(*[np.arange(n) for n in shape], indexing="ij"), axis=-1).reshape(-1, 3)
    return _wall(low, SPACING, (depth(low + SPACING * steps) > 0.0).reshape(shape), depth)


def artery() -> tuple[np.ndarray, np.ndarray]:
    """Return the artery: vertices (v, 3) in mm and triangles (t, 3)."""
    lumens = artery_lumens()
    centres = np.concatenate([lumen.centres for lumen in lumens])
    low = centres.min(axis=0) - 2.0 * ARTERY_RADIUS
    low[2] = ARTERY_ENTRANCE - 0.5 * ARTERY_SPACING
    high = centres.max(axis=0) + 2.0 * ARTERY_RADIUS
    shape = tuple(int(n) for n in np.ceil((high - low) / ARTERY_SPACING) + 1)
    inside = near_lines(lumens, low, ARTERY_SPACING, shape)
    inside[inside] = artery_depth(low + ARTERY_SPACING * np.argwhere(inside)) > 0.0
    return _wall(low, ARTERY_SPACING, inside, artery_depth)


def _wall(origin: np.ndarray, spacing: float, inside: np.ndarray, depth: Callable[[np.ndarray], np.ndarray]
          ) -> tuple[np.ndarray, np.ndarray]:
    vertices, triangles = surface_nets(origin, spacing, inside)
    used, triangles = np.unique(triangles, return_inverse=True)
    return onto_wall(vertices[used], origin, spacing, depth), triangles.reshape(-1, 3)


def main() -> None:
    """Writes the meshes of the scenes."""
    write_obj(MESH, *arch(), digits=4)
    write_obj(ARTERY, *artery(), digits=3)


if __name__ == "__main__":
    main()
