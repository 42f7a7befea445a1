"""Contrast in X-ray films of a run: an injection, what is subtracted, and a road map of what was seen."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from guidewire.sessions.session import Session

_AGENT = 0.23  # 1/mm: undiluted, iodine of 300 mg/ml at 60 keV
_GREY = 191.25  # of the background
_MAPPED = 0.3  # how much brighter than the background a road map is where the vessel was opaque


class Angiography:
    """What `render` shows of contrast, picture after picture, in the order of their times.

    Parameters
    ----------
    session : of the run.
    arguments : of `render`: `inject` (s, ml and ml/s, or None), `subtract`, `road_map`.
    """

    def __init__(self, session: Session, arguments: argparse.Namespace) -> None:
        self._session = session
        self._inject, self._maps = arguments.inject, arguments.road_map
        self._subtracts = arguments.subtract
        self._time = 0.0
        self._is_injected = False
        self._mask: np.ndarray | None = None
        self._least: np.ndarray | None = None    # the darkest that agent alone has made each pixel

    @property
    def is_asked(self) -> bool:
        """Whether there is anything but a vessel that is drawn."""
        return bool(self._inject or self._subtracts or self._maps)

    def picture(self, drawn: tuple[list[np.ndarray], list[np.ndarray]], time: float, view: dict[str, Any]
                ) -> np.ndarray:
        """Grey levels of a moment (s), as of `Session.picture_of`; `drawn` is as of `State.drawn`."""
        if not self.is_asked:
            return self._session.picture_of(*drawn, **view)
        self._go_to(time)
        shown = {**view, "vessel": "injected", "contrast": _AGENT}
        grey = self._session.picture_of(*drawn, **shown)
        bare = {**shown, "noise": 0.0, "blur": 0.0}
        if self._mask is None:
            self._mask = self._session.picture_of(*drawn, **{**bare, "vessel": "none"}).astype(float)
        if self._maps:
            agent = self._session.picture_of(*drawn, **{**bare, "attenuation": 0.0}).astype(float)
            self._least = agent if self._least is None else np.minimum(self._least, agent)
            if self._is_passed:
                grey = self._session.picture_of(*drawn, **{**shown, "vessel": "none"}) * (
                    1.0 + _MAPPED * (1.0 - self._least / _GREY))
        elif self._subtracts:
            grey = _GREY * grey / np.maximum(self._mask, 1.0)
        return np.clip(np.rint(grey), 0, 255).astype(np.uint8)

    def _go_to(self, time: float) -> None:
        start = self._inject[0] if self._inject else np.inf
        if not self._is_injected and time >= start:
            self._session.agent(max(0.0, start - self._time))
            self._session.inject(self._inject[1], self._inject[2], None)
            self._time, self._is_injected = start, True
        if self._is_injected:
            self._session.agent(max(0.0, time - self._time))
        self._time = time

    @property
    def _is_passed(self) -> bool:
        """Whether what was injected is on its way out: from then on the road map takes its place."""
        if not self._is_injected:
            return False
        agent = self._session.agent()
        return not agent.is_injecting and agent.held < 0.5 * agent.injected
