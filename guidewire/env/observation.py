"""Observations of the wire for a policy, part by part."""

from __future__ import annotations

import inspect
import math
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from guidewire.env.instruments import Instrument
from guidewire.env.options import made_of, need_count, need_number
from guidewire.env.picture import Picture, PictureState
from guidewire.env.route import Route
from guidewire.env.spaces import Box, Dict, Error, Space
from guidewire.sessions.session import State

PARTS = ("tip", "direction", "points", "screen", "hub", "loads", "wall", "overlap", "distance", "target", "ahead",
         "beat", "action", "image")
DEFAULT = ("tip", "direction", "hub", "loads", "wall", "distance", "ahead")
_OF_EACH = {"tip": (3,), "direction": (3,), "hub": (2,), "loads": (2,), "wall": (2,), "distance": ()}  # instrument
_UNIT = ("direction", "ahead", "beat", "action")  # from -1 to 1 as they are
_FROM_TARGET = ("tip", "points")  # where normalised
# What stands for 1 where they are normalised: mm in the tasks that ship, rad, N, N mm.
RANGES: Mapping[str, Any] = {"tip": 300.0, "points": 300.0, "screen": 300.0, "hub": (300.0, 8.0 * math.pi),
                             "loads": (5.0, 20.0), "wall": (1.5, 5.0), "overlap": 600.0, "distance": 300.0,
                             "target": 300.0}


@dataclass(frozen=True)
class Observation:
    """Parts of an observation, in this order; lengths in units of the scene (mm), in the vessel's frame.

    With k instruments, k > 1, those of each instrument have a first axis of k, the wire first.

    Attributes
    ----------
    parts : of each instrument "tip": position (3,); "direction": of the tip, a unit vector (3,); "points": positions of
        its last points, from the tip, (points, 3); "screen": the same projected, (points, 2); "hub": insertion, units,
        and turn, rad, since the start of the scene; "loads": force of the hub along its axis, N, and torque about it,
        N mm; "wall": largest force of a wall on a sphere, and sum of all, N; "distance": to the target along the
        centreline, units (1,). Of the catheters "overlap": length beyond its tip of what is inside, and over which that
        is inside, units (k - 1, 2). Of the wire "target": from the tip to it (3,); "ahead": unit vector (3,) from the
        tip to the point of the centreline that is `lookahead` nearer to the target, in the frame d1, d2, d3 of the last
        element. "beat": cosine and sine of the phase of a vessel that moves (2,), 0 of others. "action": the last
        one, as fractions (2 k,); "image": what `image` gives.
    points : how many.
    spacing : elements between two of them.
    screen : (2, 3), directions of the picture's axes to the right and upwards; the projection is parallel.
    lookahead : units.
    image, image_space : a Picture, which needs no space; or from the state of the session, and where two things are
        taken the target (3,), units, to an array of this space.
    flat : all parts as one array of float32 instead of a dict; not with an image.
    history : observations, the newest last: a first axis of each part, or one behind the other where flat; a Picture
        has frames of its own.
    normalised : all numbers from -1 to 1: divided by `ranges`, and limited; positions are then from the target.
    ranges : in place of RANGES, by part.

    Raises
    ------
    Error : one of them is not allowed.
    """

    parts: Sequence[str] = DEFAULT
    points: int = 4
    spacing: int = 2
    screen: Sequence[Sequence[float]] = ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    lookahead: float = 15.0
    image: Picture | Callable[[State], np.ndarray] | None = None
    image_space: Space | None = None
    flat: bool = False
    history: int = 1
    normalised: bool = False
    ranges: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if isinstance(self.image, Mapping):
            object.__setattr__(self, "image", made_of(Picture, "image", self.image))
        if isinstance(self.image, Picture):
            if self.image_space is not None:
                raise Error("image_space is not allowed with a Picture, which has its own")
            object.__setattr__(self, "image_space", self.image.space())
            if "image" not in self.parts:
                object.__setattr__(self, "parts", (*self.parts, "image"))
        unknown = [part for part in self.parts if part not in PARTS]
        if unknown or not self.parts:
            raise Error(f"observation part {unknown[:1] or ''} is not allowed: there are {', '.join(PARTS)}")
        if ("image" in self.parts) != (self.image is not None and self.image_space is not None):
            raise Error("the part \"image\" needs image and image_space, and they need it")
        if self.flat and "image" in self.parts:
            raise Error("an observation with an image is not flat")
        need_count("points", self.points, 1)
        need_count("spacing", self.spacing, 1)
        need_count("history", self.history, 1)
        need_number("lookahead", self.lookahead, 0.0, above=True)
        for part, value in self.ranges.items():
            if part not in RANGES or np.shape(value) not in ((), np.shape(RANGES[part])) or not np.all(
                    np.asarray(value, dtype=float) > 0.0) or not np.isfinite(np.asarray(value, dtype=float)).all():
                raise Error(f"ranges[{part!r}] = {value!r} is not allowed: needs numbers above 0 of "
                            f"{', '.join(RANGES)}")
        if np.shape(self.screen) != (2, 3) or not np.isfinite(np.asarray(self.screen, dtype=float)).all():
            raise Error(f"screen = {self.screen!r} is not allowed: needs finite numbers of shape (2, 3)")

    def shape_of(self, part: str, hubs: int) -> tuple[int, ...]:
        """Return the shape of a part, with so many instruments, without its history."""
        own = {**_OF_EACH, "points": (self.points, 3), "screen": (self.points, 2)}.get(part)
        if own is not None:
            return (hubs, *own) if hubs > 1 else own or (1,)
        return {"overlap": (hubs - 1, 2), "action": (2 * hubs,), "beat": (2,)}.get(part, (3,))

    def space(self, hubs: int = 1) -> Space:
        """Return the space of the observations of so many instruments."""
        if hubs == 1 and "overlap" in self.parts:
            raise Error("observation part \"overlap\" needs a task with catheters")
        bounds = {**dict.fromkeys(_UNIT, (-1.0, 1.0)), "wall": (0.0, np.inf), "distance": (0.0, np.inf)}
        past = (self.history,) if self.history > 1 else ()
        limit = 1.0 if self.normalised else np.inf
        if self.flat:
            size = sum(math.prod(self.shape_of(part, hubs)) for part in self.parts)
            return Box(-limit, limit, (size * self.history,), np.float32)
        spaces = {}
        for part in self.parts:
            if part == "image":
                spaces[part] = self.image_space
                continue
            low, high = bounds.get(part, (-limit, limit))
            spaces[part] = Box(max(low, -limit), min(high, limit), (*past, *self.shape_of(part, hubs)), np.float32)
        return Dict(spaces)


class Observer:
    """The observations of an episode.

    Parameters
    ----------
    observation : which.
    route : to the target.
    unit : of length, m.
    hubs : instruments.
    seed : of a Picture's noise.
    """

    def __init__(self, observation: Observation, route: Route, unit: float, hubs: int, seed: int) -> None:
        self._observation, self._route, self._unit = observation, route, unit
        self._past: deque[dict[str, np.ndarray]] = deque(maxlen=observation.history)
        self._screen = np.array(observation.screen, dtype=float).T
        self._ranges = {part: np.asarray(observation.ranges.get(part, value), dtype=float)
                        for part, value in RANGES.items()}
        self.action = np.zeros(2 * hubs)
        self._pictures = (PictureState(observation.image, seed) if isinstance(observation.image, Picture)
                          else observation.image)
        self._takes_target = callable(observation.image) and _count_of_arguments(observation.image) > 1
        own = {name: value for name, value in vars(observation).items() if not name.startswith("image")}
        self._options = repr((own, observation.image if isinstance(observation.image, Picture) else None))

    @property
    def exposures(self) -> int:
        """X-ray pictures so far."""
        return self._pictures.exposures if isinstance(self._pictures, PictureState) else 0

    def save(self) -> tuple[dict[str, Any], list[np.ndarray]]:
        """What the next observations depend on: what JSON can hold, and arrays."""
        pictures = self._pictures if isinstance(self._pictures, PictureState) else None
        arrays = [one for then in self._past for one in then.values()]
        frames = [] if pictures is None else pictures.frames
        head = {"of": self._options, "action": self.action.tolist(), "past": len(self._past),
                "taken": None if pictures is None else pictures.taken}
        return head, [*arrays, *frames]

    def restore(self, head: Mapping[str, Any], arrays: list[np.ndarray]) -> bool:
        """Go on from what was saved; of other options only the last action is, and False is returned."""
        self.action[:] = head["action"]
        if head["of"] != self._options:
            return False
        parts = [part for part in self._observation.parts if part != "image"]
        for k in range(head["past"]):
            self._past.append(dict(zip(parts, arrays[k * len(parts):])))
        if isinstance(self._pictures, PictureState):
            self._pictures.restore(head["taken"], arrays[head["past"] * len(parts):])
        return True

    def of(self, state: State, instruments: Sequence[Instrument], places: Sequence[tuple[int, float]],
           is_known: bool = False) -> Any:
        """The observation of a state.

        Parameters
        ----------
        instruments : of this state.
        places : of the tips, as Route.place gives them.
        is_known : whether it was asked for before, and saved.
        """
        if not is_known:
            self._take(instruments, places)
        if self._observation.flat:
            return np.concatenate([np.ravel(one) for then in self._past for one in then.values()]).astype(np.float32)
        seen = self._past[-1]
        if self._observation.history > 1:
            seen = {part: np.stack([then[part] for then in self._past]) for part in seen}
        return {part: self._picture(state, is_known) if part == "image" else seen[part].astype(np.float32)
                for part in self._observation.parts}

    def _picture(self, state: State, is_known: bool) -> np.ndarray:
        if isinstance(self._pictures, PictureState):
            return self._pictures.last() if is_known else self._pictures.of(state, self._route.target_position)
        return self._pictures(state, self._route.target_position) if self._takes_target else self._pictures(state)

    def _take(self, instruments: Sequence[Instrument], places: Sequence[tuple[int, float]]) -> None:
        seen = {}
        for part in self._observation.parts:
            if part == "image":
                continue
            value = np.asarray(self._part(part, instruments, places), dtype=float)
            seen[part] = self._normalised(part, value) if self._observation.normalised else value
        self._past.extend([seen] * (1 if self._past else self._observation.history))

    def _normalised(self, part: str, value: np.ndarray) -> np.ndarray:
        if part in _UNIT:
            return value
        if part in _FROM_TARGET:
            value = value - self._route.target_position
        elif part == "screen":
            value = value - self._route.target_position @ self._screen
        return np.clip(value / self._ranges[part], -1.0, 1.0)

    def _part(self, part: str, instruments: Sequence[Instrument], places: Sequence[tuple[int, float]]) -> Any:
        wire, *catheters = instruments
        tip = wire.positions[-1]
        if part == "target":
            return self._route.target_position - tip
        if part == "ahead":
            heading = _in_frame(wire.orientations[-1],
                                self._route.ahead(places[0][0], self._observation.lookahead) - tip)
            return _within_one(heading / max(math.hypot(*heading.tolist()), 1e-12))
        if part == "beat":
            return (0.0, 0.0) if self._route.motion is None else self._route.motion.beat
        if part == "overlap":
            return [(one.hub.extension / self._unit, one.hub.overlap / self._unit) for one in catheters]
        if part == "action":
            return self.action.copy()    # what is past keeps its own
        if part == "distance":
            return [left for _, left in places]
        each = [self._of_one(part, one) for one in instruments]
        return each if len(each) > 1 else each[0]

    def _of_one(self, part: str, one: Instrument) -> Any:
        if part == "tip":
            return one.positions[-1]
        if part == "direction":
            return _within_one(one.hub.tip_direction)
        if part in ("points", "screen"):
            observation, last = self._observation, len(one.positions) - 1
            points = one.positions[np.maximum(last - observation.spacing * np.arange(observation.points), 0)]
            return points if part == "points" else points @ self._screen
        if part == "hub":
            return (one.hub.insertion / self._unit, one.hub.turn)
        if part == "loads":
            return (one.hub.force, 1e3 * one.hub.torque)
        forces = np.sqrt(np.einsum("ij,ij->i", one.contact_forces, one.contact_forces))
        return (forces.max(), forces.sum())


def _count_of_arguments(function: Callable[..., Any]) -> int:
    try:
        taken = inspect.signature(function).parameters.values()
    except ValueError:    # of a function that says nothing of itself
        return 1
    return sum(one.default is one.empty and one.kind in (one.POSITIONAL_ONLY, one.POSITIONAL_OR_KEYWORD)
               for one in taken)


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
