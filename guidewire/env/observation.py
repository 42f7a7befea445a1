"""Observations of the wire for a policy, part by part."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from guidewire.env.options import need_count, need_number
from guidewire.env.route import Route
from guidewire.env.spaces import Box, Dict, Error, Space
from guidewire.sessions.session import State

PARTS = ("tip", "direction", "points", "screen", "hub", "loads", "wall", "distance", "target", "ahead", "image")
DEFAULT = ("tip", "direction", "hub", "loads", "wall", "distance", "ahead")


@dataclass(frozen=True)
class Observation:
    """Parts of an observation, in this order; lengths in units of the scene (mm), in the vessel's frame.

    Attributes
    ----------
    parts : "tip": position (3,); "direction": of the tip, a unit vector (3,); "points": positions of the last points of
        the wire, from the tip, (points, 3); "screen": the same projected, (points, 2); "hub": insertion, units, and
        turn, rad, since the start of the scene; "loads": force of the hub on the wire along its axis, N, and torque
        about it, N mm; "wall": largest force of a wall on a sphere, and sum of all, N; "distance": to the target along
        the centreline, units (1,); "target": from the tip to it (3,); "ahead": unit vector (3,) from the tip to the
        point of the centreline that is `lookahead` nearer to the target, in the frame d1, d2, d3 of the last element;
        "image": what `image` gives.
    points : how many.
    spacing : elements between two of them.
    screen : (2, 3), directions of the picture's axes to the right and upwards; the projection is parallel.
    lookahead : units.
    image, image_space : from the state of the session to an array of this space.
    flat : all parts as one array of float32 instead of a dict; not with an image.
    """

    parts: Sequence[str] = DEFAULT
    points: int = 4
    spacing: int = 2
    screen: Sequence[Sequence[float]] = ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    lookahead: float = 15.0
    image: Callable[[State], np.ndarray] | None = None
    image_space: Space | None = None
    flat: bool = False

    def __post_init__(self) -> None:
        unknown = [part for part in self.parts if part not in PARTS]
        if unknown or not self.parts:
            raise Error(f"observation part {unknown[:1] or ''} is not allowed: there are {', '.join(PARTS)}")
        if ("image" in self.parts) != (self.image is not None and self.image_space is not None):
            raise Error("the part \"image\" needs image and image_space, and they need it")
        if self.flat and "image" in self.parts:
            raise Error("an observation with an image is not flat")
        need_count("points", self.points, 1)
        need_count("spacing", self.spacing, 1)
        need_number("lookahead", self.lookahead, 0.0, above=True)
        if np.shape(self.screen) != (2, 3) or not np.isfinite(np.asarray(self.screen, dtype=float)).all():
            raise Error(f"screen = {self.screen!r} is not allowed: needs finite numbers of shape (2, 3)")

    def space(self) -> Space:
        """Of the observations."""
        shapes = {"points": (self.points, 3), "screen": (self.points, 2), "hub": (2,), "loads": (2,), "wall": (2,),
                  "distance": (1,)}
        bounds = {"direction": (-1.0, 1.0), "ahead": (-1.0, 1.0), "wall": (0.0, np.inf), "distance": (0.0, np.inf)}
        if self.flat:
            size = sum(int(np.prod(shapes.get(part, (3,)))) for part in self.parts)
            return Box(-np.inf, np.inf, (size,), np.float32)
        return Dict({part: self.image_space if part == "image" else
                     Box(*bounds.get(part, (-np.inf, np.inf)), shapes.get(part, (3,)), np.float32)
                     for part in self.parts})

    def of(self, state: State, route: Route, place: tuple[int, float], unit: float) -> Any:
        """The observation of a state.

        Parameters
        ----------
        place : of the tip, as Route.place gives it.
        unit : of length, m.
        """
        seen = {part: self._part(part, state, route, place, unit) for part in self.parts}
        if self.flat:
            return np.concatenate([np.ravel(value) for value in seen.values()]).astype(np.float32)
        return {part: value if part == "image" else np.asarray(value, dtype=np.float32)
                for part, value in seen.items()}

    def _part(self, part: str, state: State, route: Route, place: tuple[int, float], unit: float) -> Any:
        tip, hub = state.positions[-1], state.hub
        if part == "tip":
            return tip
        if part == "direction":
            return _within_one(hub.tip_direction)
        if part in ("points", "screen"):
            last = len(state.positions) - 1
            points = state.positions[np.maximum(last - self.spacing * np.arange(self.points), 0)]
            return points if part == "points" else points @ np.array(self.screen, dtype=float).T
        if part == "hub":
            return (hub.insertion / unit, hub.turn)
        if part == "loads":
            return (hub.force, 1e3 * hub.torque)
        if part == "wall":
            forces = np.sqrt(np.einsum("ij,ij->i", state.contact_forces, state.contact_forces))
            return (forces.max(), forces.sum())
        if part == "distance":
            return (place[1],)
        if part == "target":
            return route.points[route.target] - tip
        if part == "ahead":
            heading = _in_frame(state.orientations[-1], route.ahead(place[0], self.lookahead) - tip)
            return _within_one(heading / max(math.hypot(*heading.tolist()), 1e-12))
        return self.image(state)


def _in_frame(q: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Components of a vector along the directors of an element with orientation q (x, y, z, w)."""
    x, y, z, w = q.tolist()
    a, b, c = vector.tolist()
    # With the axis -(x, y, z): v + 2 w axis x v + 2 axis x (axis x v), in numbers: np.cross takes ten times as long.
    u, v, t = 2.0 * (z * b - y * c), 2.0 * (x * c - z * a), 2.0 * (y * a - x * b)
    return np.array([a + w * u + z * v - y * t, b + w * v + x * t - z * u, c + w * t + y * u - x * v])


def _within_one(direction: np.ndarray) -> np.ndarray:
    """A unit vector (3,) whose rounding does not leave the bounds of its space."""
    return np.minimum(np.maximum(direction, -1.0), 1.0)
