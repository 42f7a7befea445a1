"""Fluoroscopic pictures as observations: the core draws them, of every instrument, in one plane or several."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from guidewire.env.options import need_count, need_number
from guidewire.env.spaces import Box, Error
from guidewire.sessions.session import State

_MOST_PIXELS = 2048
_VESSELS = ("roadmap", "contrast", "none")


@dataclass(frozen=True)
class Picture:
    """What a C-arm of one plane or several sees; (planes * frames, pixels, pixels) of uint8, the newest frame last.

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
        return Box(0, 255, (len(self.views) * self.frames, self.pixels, self.pixels), np.uint8)


class PictureState:
    """The frames of an episode.

    Parameters
    ----------
    picture : which.
    seed : of the noise.
    """

    def __init__(self, picture: Picture, seed: int) -> None:
        self._picture, self._seed, self._step = picture, seed, 0
        self._frames: deque[list[np.ndarray]] = deque(maxlen=picture.frames)

    def of(self, state: State) -> np.ndarray:
        """Return the pictures after a step; before the first frames there are copies of the first one."""
        picture = self._picture
        if self._step % picture.every == 0:
            shared = {"pixels": picture.pixels, "vessel": picture.vessel, "noise": picture.noise, "blur": picture.blur}
            where = (("field_of_view", picture.field_of_view), ("centre", picture.centre))
            shared |= {key: value for key, value in where if value is not None}
            planes = []
            for lao, cranial in picture.views:
                planes.append(state.picture(lao=lao, cranial=cranial, seed=self._seed, **shared))
                self._seed = (self._seed + 1) % 2**32
            self._frames.extend([planes] * (1 if self._frames else picture.frames))
        self._step += 1
        return self.last()

    def last(self) -> np.ndarray:
        """Return the pictures as they were given last."""
        return np.stack([plane for planes in self._frames for plane in planes])

    @property
    def taken(self) -> tuple[int, int]:
        """Return how often `of` was called so far, and the seed of the next frame's noise."""
        return self._step, self._seed

    @property
    def frames(self) -> list[np.ndarray]:
        """Those of the last moments, plane by plane."""
        return [plane for planes in self._frames for plane in planes]

    def restore(self, taken: Sequence[int], frames: list[np.ndarray]) -> None:
        """Go on from what `taken` and `frames` said."""
        self._step, self._seed = taken
        planes = len(self._picture.views)
        self._frames.extend(frames[k:k + planes] for k in range(0, len(frames), planes))
