"""Sessions that stay open between episodes: reading a vessel takes most of a second, restoring a start a few ms."""

from __future__ import annotations

import json
import tempfile
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.draws import Draw
from guidewire.env.instruments import instruments_of, names_of, of_each
from guidewire.env.reshaping import reshaped
from guidewire.env.route import Placement, Route
from guidewire.env.spaces import Error
from guidewire.env.task import Task
from guidewire.sessions.session import Session, State

_SESSIONS, _STARTS = 6, 64  # kept open, and snapshots kept of each
_LARGEST_TURN = np.radians(20.0)  # a step of what turns the tip before an episode
_LARGEST_PUSH = 2.0e-3  # m, a step of what inserts before an episode
_SHORT = 1e-3  # m, by which a hub may come less far before an episode than was asked
_TRIED = (1, 2, 4, 8)  # parts of such a step
ENDLESS = {"maxSimulationSteps": 1_000_000_000, "deltaThreshold": 0}


class LoadedScene:
    """A session with its vessel, and starts of episodes as snapshots.

    Parameters
    ----------
    scene : parameters.
    anatomy : of its vessel.
    native : as of Session.
    shape : "warp" and "entry", as of `reshaped`, where one was drawn.
    """

    def __init__(self, scene: Mapping[str, Any], anatomy: Mapping[str, Any], native: bool | None,
                 shape: Mapping[str, Any]) -> None:
        self._folder = None
        try:
            if any(any(np.ravel(one)) for one in shape.values()):
                self._folder = tempfile.TemporaryDirectory(prefix="guidewire-")
                scene, anatomy = reshaped(scene, anatomy, shape.get("warp"), shape.get("entry"),
                                          Path(self._folder.name))
            self.scene, self.anatomy = {**scene, **ENDLESS}, anatomy
            self.session = Session(None, hand=True, native=native, **self.scene)
        except BaseException:
            self._remove()
            raise
        self.unit = float(self.session.parameters["metresPerUnit"])    # m
        self.time_step = float(self.session.parameters["timeStep"])
        if self.session.state.hub is None:
            self.close()
            raise Error("an environment needs a wire of solver \"direct\"")
        self.hubs = self.session.hubs
        inside = self.session.state.hub.length_in_body
        length = float(self.session.parameters["guidewireLength"]) * self.unit
        # A sheathed wire can be fed until its proximal end is two of its elements from the sheath's exit. Hubs of
        # several instruments are stopped by one another and by the exit.
        step = length / len(self.session.state.orientations)
        self.longest = float("inf") if inside is None or self.hubs > 1 else length - inside - 2.0 * step
        self._starts: OrderedDict[tuple[Any, ...], bytes] = OrderedDict()
        self._routes: dict[str, Route] = {}

    def close(self) -> None:
        """End its session; a vessel that was drawn is gone."""
        self.session.close()
        self._remove()

    def start(self, tip_turn: float, insertion: Any) -> State:
        """The instruments at the start of an episode: each by so much in its vessel, m, and all turned, rad."""
        insertions = of_each(insertion, self.hubs)
        key = (tip_turn, *insertions)
        if not any(key):
            return self.session.reset()
        if max(insertions) > self.longest:
            raise Error(f"insertion = {max(insertions):g} is not allowed: this wire can be inserted by at most "
                        f"{self.longest:.4g} m")
        if key in self._starts:
            self._starts.move_to_end(key)
            return self.session.restore(self._starts[key])
        for parts in _TRIED:    # a wire whose tip catches may come there in shorter steps
            state = self._moved(tip_turn, insertions, parts)
            if state.outcome is None:
                break
        else:
            raise Error(f"the wire does not come to its start: {state.outcome}: {state.reason}")
        for name, one, asked in zip(names_of(self.hubs), instruments_of(state), insertions):
            if abs(one.hub.insertion - asked) > _SHORT:
                raise Error(f"insertion = {insertions} is not allowed: the hub of the {name} stops at "
                            f"{one.hub.insertion:.4g} m")
        self._starts[key] = self.session.save()
        if len(self._starts) > _STARTS:
            self._starts.popitem(last=False)
        return state

    def _remove(self) -> None:
        if self._folder is not None:
            self._folder.cleanup()

    def _moved(self, tip_turn: float, insertions: Sequence[float], parts: int) -> State:
        state = self.session.reset()
        if tip_turn:
            state = self.session.step(turn=[tip_turn] * self.hubs,
                                      steps=parts * int(np.ceil(abs(tip_turn) / _LARGEST_TURN)))
        if any(insertions) and state.outcome is None:
            state = self.session.step([one / self.unit for one in insertions],
                                      steps=parts * int(np.ceil(max(insertions) / _LARGEST_PUSH)))
        return state

    def route(self, target: Any) -> Route:
        """Find the way to a target of its vessel."""
        key = json.dumps(target)
        if key not in self._routes:
            self._routes[key] = Route(self.anatomy, target, self.anatomy["metresPerUnit"] / self.unit,
                                      Placement.of(self.session.parameters))
        return self._routes[key]


class LoadedScenes:
    """The newest scenes of a task.

    Parameters
    ----------
    task : whose.
    native : as of Session.
    """

    def __init__(self, task: Task, native: bool | None) -> None:
        self._task, self._native = task, native
        self._scenes: OrderedDict[str, LoadedScene] = OrderedDict()

    def find(self, draw: Draw) -> tuple[LoadedScene, bool]:
        """The scene of an episode, and whether it was open."""
        key = json.dumps((draw.anatomy, draw.instrument, draw.friction, draw.random), default=list)
        scene = self._scenes.get(key)
        if scene is not None and scene.session.is_open:
            self._scenes.move_to_end(key)
            return scene, True
        if scene is not None:
            scene.close()
        shape = {name: draw.random[name] for name in ("warp", "entry") if name in draw.random}
        self._scenes[key] = scene = LoadedScene(*self._task.scene_of(draw), self._native, shape)
        if len(self._scenes) > _SESSIONS:
            _, oldest = self._scenes.popitem(last=False)
            oldest.close()
        return scene, False

    def close(self) -> None:
        """End all sessions."""
        for scene in self._scenes.values():
            scene.close()
        self._scenes.clear()
