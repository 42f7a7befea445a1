"""A small software renderer: shaded triangles with a depth buffer, seen by the camera of the Unity scenes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from guidewire.logs.surfaces import Surface

LIGHT = np.array([0.3, 0.55, -0.8])  # towards the light, in camera axes (right, up, forward)


@dataclass(frozen=True)
class Camera:
    """A camera that looks at a point. target: (3,), units; distance: units; yaw, pitch: degrees, as in the scenes."""

    target: tuple[float, float, float]
    distance: float
    yaw: float = -90.0
    pitch: float = 15.0
    field_of_view: float = 45.0

    def axes(self) -> np.ndarray:
        """Rows right, up, forward, shape (3, 3), as the axes of a camera in Unity."""
        yaw, pitch = np.radians(self.yaw), np.radians(self.pitch)
        forward = np.array([np.sin(yaw) * np.cos(pitch), -np.sin(pitch), np.cos(yaw) * np.cos(pitch)])
        right = np.array([np.cos(yaw), 0.0, -np.sin(yaw)])
        return np.stack([right, np.cross(forward, right), forward])

    def view(self, points: np.ndarray) -> np.ndarray:
        """Return points (k, 3) in camera axes, units."""
        axes = self.axes()
        return (points - (np.asarray(self.target) - self.distance * axes[2])) @ axes.T


@dataclass
class Picture:
    """colour: (height, width, 3) in [0, 1]; depth: (height, width), units in front of the camera."""

    colour: np.ndarray
    depth: np.ndarray

    @staticmethod
    def blank(width: int, height: int, background: tuple[float, float, float] = (0.08, 0.09, 0.12)) -> Picture:
        """Return a picture with nothing in it."""
        colour = np.empty((height, width, 3))
        colour[:] = background
        return Picture(colour, np.full((height, width), np.inf))

    def copy(self) -> Picture:
        """Return a picture of its own with the same content."""
        return Picture(self.colour.copy(), self.depth.copy())


def draw(picture: Picture, camera: Camera, surface: Surface, colours: np.ndarray, alpha: float = 1.0) -> None:
    """Draw the triangles of a surface that face the camera into a picture.

    Parameters
    ----------
    picture : changed in place.
    camera : where it is seen from.
    surface : the triangles.
    colours : ndarray (v, 3) in [0, 1], colour of each vertex.
    alpha : 1 covers what is behind and fills the depth buffer; less tints it.
    """
    height, width = picture.depth.shape
    seen = camera.view(surface.vertices)
    scale = 0.5 * height / np.tan(0.5 * np.radians(camera.field_of_view))
    safe = np.maximum(seen[:, 2], 1e-6)
    x = 0.5 * width + scale * seen[:, 0] / safe
    y = 0.5 * height - scale * seen[:, 1] / safe
    normals = _vertex_normals(surface) @ camera.axes().T
    corners = seen[surface.triangles]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    chosen = np.einsum("ij,ij->i", faces, corners[:, 0]) < 0.0
    chosen &= (corners[:, :, 2] > 1.0).all(axis=1)
    light = LIGHT / np.linalg.norm(LIGHT)
    brightness = 0.45 + 0.55 * np.clip(normals @ light, 0.0, 1.0)
    lit = np.clip(colours * brightness[:, None], 0.0, 1.0)
    for triangle in surface.triangles[chosen]:
        _fill(picture, x[triangle], y[triangle], seen[triangle, 2], lit[triangle], alpha)


def _vertex_normals(surface: Surface) -> np.ndarray:
    a, b, c = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    faces = np.cross(b - a, c - a)
    normals = np.zeros_like(surface.vertices)
    for k in range(3):
        np.add.at(normals, surface.triangles[:, k], faces)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def _fill(picture: Picture, x: np.ndarray, y: np.ndarray, z: np.ndarray, colour: np.ndarray, alpha: float) -> None:
    height, width = picture.depth.shape
    left, right = max(int(np.ceil(x.min() - 0.5)), 0), min(int(np.floor(x.max() - 0.5)), width - 1)
    top, bottom = max(int(np.ceil(y.min() - 0.5)), 0), min(int(np.floor(y.max() - 0.5)), height - 1)
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    if left > right or top > bottom or abs(area) < 1e-12:
        return
    px = np.arange(left, right + 1)[None, :] + 0.5
    py = np.arange(top, bottom + 1)[:, None] + 0.5
    u = ((x[1] - px) * (y[2] - py) - (x[2] - px) * (y[1] - py)) / area
    v = ((x[2] - px) * (y[0] - py) - (x[0] - px) * (y[2] - py)) / area
    w = 1.0 - u - v
    # Pixels on a shared edge would be tinted twice by a translucent surface: one side of each edge is left out.
    inside = (u >= 0.0) & (v > 0.0) & (w > 0.0) if alpha < 1.0 else (u >= 0.0) & (v >= 0.0) & (w >= 0.0)
    depth = 1.0 / (u / z[0] + v / z[1] + w / z[2])
    place = (slice(top, bottom + 1), slice(left, right + 1))
    inside &= depth < picture.depth[place]
    shade = u[..., None] * colour[0] + v[..., None] * colour[1] + w[..., None] * colour[2]
    target = picture.colour[place]
    target[inside] = (1.0 - alpha) * target[inside] + alpha * shade[inside]
    if alpha >= 1.0:
        picture.depth[place][inside] = depth[inside]
