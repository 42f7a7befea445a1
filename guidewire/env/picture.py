"""Fluoroscopic pictures as observations: the core draws them, of every instrument, in one plane or several."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from guidewire.env.options import need_count, need_number
from guidewire.env.spaces import Box, Error
from guidewire.sessions.session import State

_MOST_PIXELS = 2048
_VESSELS = ("roadmap", "contrast", "none")
_MARGIN = 1.05  # of a side, around a vessel: as the core's
_FILLED = 1e3  # 1/mm, of contrast agent, with which a vessel is black
# What a pixel of labels shows; of catheters 4 and, of a second one, 5.
BACKGROUND, VESSEL, TARGET, WIRE = 0, 1, 2, 3


@dataclass(frozen=True)
class Picture:
    """What a C-arm of one plane or several sees; (planes * frames, pixels, pixels) of uint8, the newest frame last.
    With labels each frame has those of its planes behind them, twice as many in all.

    Attributes
    ----------
    pixels : of a side.
    views : of each plane LAO and cranial angle, degrees.
    field_of_view : side, mm; None: so that the vessel is seen.
    centre : what is in the middle, units; None: the vessel's.
    vessel : "roadmap", "contrast" or "none", as of Session.picture.
    noise, blur : as of Session.picture; each frame has noise of its own.
    frames : of the last moments.
    every : steps between two frames: a frame rate of 1/(every * step_time).
    target : whether a white ring shows where the target is.
    labels : whether to show beside each picture what is seen: 0 nothing, 1 the vessel, 2 the target, 3 the wire, 4 and
        5 catheters; what is named later covers what is named before, but the wire the catheters.

    Raises
    ------
    Error : one of them is not allowed.
    """

    pixels: int = 128
    views: Sequence[Sequence[float]] = ((0.0, 0.0),)
    field_of_view: float | None = None
    centre: Sequence[float] | None = None
    vessel: str = "roadmap"
    noise: float = 0.0
    blur: float = 0.0
    frames: int = 1
    every: int = 1
    target: bool = False
    labels: bool = False

    def __post_init__(self) -> None:
        for name in ("pixels", "frames", "every"):
            need_count(name, getattr(self, name), 1)
        if self.pixels > _MOST_PIXELS:
            raise Error(f"pixels = {self.pixels} is not allowed: needs a whole number up to {_MOST_PIXELS}")
        views = np.asarray(self.views, dtype=float)
        if views.ndim != 2 or views.shape[1] != 2 or not np.isfinite(views).all() or not len(views):
            raise Error(f"views = {self.views!r} is not allowed: needs pairs of LAO and cranial angle, degrees")
        if (np.abs(views) > [360.0, 90.0]).any():
            raise Error(f"views = {self.views!r} is not allowed: needs LAO from -360 to 360, cranial from -90 to 90")
        if self.field_of_view is not None:
            need_number("field_of_view", self.field_of_view, 0.0, above=True)
        if self.centre is not None and (np.shape(self.centre) != (3,) or not np.isfinite(self.centre).all()):
            raise Error(f"centre = {self.centre!r} is not allowed: needs three finite numbers")
        if self.vessel not in _VESSELS:
            raise Error(f"vessel = {self.vessel!r} is not allowed: needs one of {', '.join(_VESSELS)}")
        for name in ("noise", "blur"):
            need_number(name, getattr(self, name), 0.0)
        if self.noise > 1.0:
            raise Error(f"noise = {self.noise!r} is not allowed: needs a number from 0 to 1")

    def space(self) -> Box:
        """Return the space of the pictures."""
        return Box(0, 255, (len(self.views) * (1 + self.labels) * self.frames, self.pixels, self.pixels), np.uint8)


class PictureState:
    """The frames of an episode.

    Parameters
    ----------
    picture : which.
    seed : of the noise.
    """

    def __init__(self, picture: Picture, seed: int) -> None:
        self._picture, self._seed, self._step = picture, seed, 0
        self._arms: list[CArm] = []
        self._vessels: list[np.ndarray] = []    # of each plane, where the vessel is seen
        self._radii: list[float] = []    # of each instrument, units
        self._frames: deque[list[np.ndarray]] = deque(maxlen=picture.frames)

    def of(self, state: State, target: np.ndarray) -> np.ndarray:
        """Return the pictures after a step; before the first frames there are copies of the first one.

        target : (3,), units.
        """
        picture = self._picture
        if self._step % picture.every == 0:
            shared = {"pixels": picture.pixels, "vessel": picture.vessel, "noise": picture.noise, "blur": picture.blur}
            where = (("field_of_view", picture.field_of_view), ("centre", picture.centre))
            shared |= {key: value for key, value in where if value is not None}
            planes, labels = [], []
            if (picture.target or picture.labels) and not self._arms:
                self._look(state)
            vessel = state.session.parameters["vessel"] or {}
            if picture.labels and (not self._vessels or vessel.keys() & {"motion", "beam"}):
                self._vessels = [self._vessel(state, arm, view, shared) for arm, view in zip(self._arms, picture.views)]
            for k, (lao, cranial) in enumerate(picture.views):
                shared |= self._arms[k].place if self._arms else {}
                planes.append(state.picture(lao=lao, cranial=cranial, seed=self._seed, **shared))
                self._seed = (self._seed + 1) % 2**32
            for arm, plane in zip(self._arms, planes):
                if picture.labels:
                    labels.append(self._labels(state, arm, self._vessels[len(labels)], target))
                if picture.target:
                    plane[np.abs(arm.distances(target) - max(2.0, picture.pixels / 32.0)) < 0.75] = 255
            self._frames.extend([planes + labels] * (1 if self._frames else picture.frames))
        self._step += 1
        return self.last()

    def _look(self, state: State) -> None:
        """Find how each plane is seen."""
        session = state.session
        known = session.describe()
        self._radii = [max(one["radii"]) for one in known["instruments"]]
        axes = known["patient"]
        corners = [wall.vertices for wall in session.walls()] or [state.positions]
        box = np.array([np.concatenate(corners).min(axis=0), np.concatenate(corners).max(axis=0)])
        picture, unit = self._picture, 1e3 * float(session.parameters["metresPerUnit"])
        self._arms = [CArm(picture, lao, cranial, axes, box, unit) for lao, cranial in picture.views]

    def _vessel(self, state: State, arm: CArm, view: tuple[float, float], shared: dict[str, Any]) -> np.ndarray:
        shown = {**shared, "noise": 0.0, "blur": 0.0, "lao": view[0], "cranial": view[1], **arm.place}
        filled, empty = (state.picture(**{**shown, "vessel": vessel}, contrast=_FILLED)
                         for vessel in ("contrast", "none"))
        return filled < empty

    def _labels(self, state: State, arm: CArm, vessel: np.ndarray, target: np.ndarray) -> np.ndarray:
        labels = np.where(vessel, VESSEL, BACKGROUND).astype(np.uint8)
        labels[arm.distances(target) <= 2.0] = TARGET
        for k, one in [*enumerate(state.catheters, 1), (0, state)]:
            arm.draw(labels, one.positions, self._radii[k] * arm.scale, WIRE + k)
        return labels

    def last(self) -> np.ndarray:
        """Return the pictures as they were given last."""
        return np.stack(self.frames)

    @property
    def taken(self) -> tuple[int, int]:
        """Return how often `of` was called so far, and the seed of the next frame's noise."""
        return self._step, self._seed

    @property
    def exposures(self) -> int:
        """Return how many pictures were taken so far, each plane for itself."""
        return len(self._picture.views) * -(-self._step // self._picture.every)

    @property
    def frames(self) -> list[np.ndarray]:
        """Those of the last moments, plane by plane."""
        return [plane for planes in self._frames for plane in planes]

    def restore(self, taken: Sequence[int], frames: list[np.ndarray]) -> None:
        """Go on from what `taken` and `frames` said."""
        self._step, self._seed = taken
        planes = len(self._picture.views) * (1 + self._picture.labels)
        self._frames.extend(frames[k:k + planes] for k in range(0, len(frames), planes))


class CArm:
    """How a plane sees points: parallel rays, as Session.picture says.

    Parameters
    ----------
    picture : which.
    lao, cranial : degrees.
    axes : the patient's "left", "chest" and "head", or None.
    box : (2, 3), corners around the vessel, units.
    unit : mm.

    Attributes
    ----------
    scale : pixels per unit.
    place : "centre" and "field_of_view" of Session.picture.
    """

    def __init__(self, picture: Picture, lao: float, cranial: float, axes: Any, box: np.ndarray, unit: float) -> None:
        axes = axes or {"left": [0.0, 1.0, 0.0], "chest": [1.0, 0.0, 0.0], "head": [0.0, 0.0, 1.0]}
        left, chest, head = (np.array(axes[name], dtype=float) for name in ("left", "chest", "head"))
        a, b = math.radians(lao), math.radians(cranial)
        level = math.cos(a) * chest + math.sin(a) * left
        up = math.cos(b) * head - math.sin(b) * level
        self._axes = np.array([math.cos(a) * left - math.sin(a) * chest, -up])    # to the right, and down
        middle = box.mean(axis=0)
        self._centre = middle if picture.centre is None else np.array(picture.centre, dtype=float)
        corners = np.array([[box[i & 1, 0], box[i >> 1 & 1, 1], box[i >> 2, 2]] for i in range(8)])
        side = 2.0 * _MARGIN * float(np.abs((corners - middle) @ self._axes.T).max())
        side = side if picture.field_of_view is None else picture.field_of_view / unit
        self._pixels, self.scale = picture.pixels, picture.pixels / side
        self.place = {"centre": self._centre.tolist(), "field_of_view": side * unit}

    def pixels_of(self, points: np.ndarray) -> np.ndarray:
        """Return columns and rows (n, 2) of points (n, 3), from the upper left corner of the picture."""
        return 0.5 * self._pixels + self.scale * (points - self._centre) @ self._axes.T

    def distances(self, point: np.ndarray) -> np.ndarray:
        """Return of each pixel (rows, columns) how far its middle is from a point (3,), pixels."""
        (column, row), at = self.pixels_of(point[None])[0], np.arange(self._pixels) + 0.5
        return np.hypot((at - row)[:, None], (at - column)[None])

    def draw(self, labels: np.ndarray, points: np.ndarray, radius: float, label: int) -> None:
        """Put a label on all pixels within a radius of a line through points (n, 3), at least on those it crosses."""
        corners = self.pixels_of(points)
        count = 2 + int(2.0 * np.hypot(*np.diff(corners, axis=0).T).max())
        parts = np.linspace(0.0, 1.0, count)[:, None, None]
        line = ((1.0 - parts) * corners[:-1] + parts * corners[1:]).reshape(-1, 2)
        reach = int(math.ceil(radius))
        for dx in range(-reach, reach + 1):
            for dy in range(-reach, reach + 1):
                near = np.floor(line).astype(int) + (dx, dy)
                is_near = (np.hypot(*(near + 0.5 - line).T) <= radius) | (dx == dy == 0)
                within = is_near & (near >= 0).all(axis=1) & (near < self._pixels).all(axis=1)
                labels[near[within, 1], near[within, 0]] = label
