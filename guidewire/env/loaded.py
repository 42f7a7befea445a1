"""The scene of an environment: one session, in which a drawn scene takes the place of the last one."""

from __future__ import annotations

import json
import tempfile
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from guidewire.env.instruments import instruments_of, names_of, of_each
from guidewire.env.randomisation import Draw
from guidewire.env.reshaping import reshaped
from guidewire.env.route import Placement, Route
from guidewire.env.spaces import Error
from guidewire.env.task import Task
from guidewire.sessions.session import Session, SessionError, State

if TYPE_CHECKING:
    from guidewire.anatomy.motion import VesselMotion

_STARTS = 128  # snapshots kept of starts, of some 30 kB each
_ROUTES = 12  # kept, of 1,000 points each
# Of a step before an episode. After one step at rest the instruments are within 0.08 mm of where they come to by a
# tenth of both, in all tasks that ship.
_LARGEST_TURN = np.pi
_LARGEST_PUSH = 20.0e-3  # m
_SHORT = 1e-3  # m, by which a hub may come less far before an episode than was asked
_TRIED = (1, 2, 4, 8)  # parts of such a step
ENDLESS = {"maxSimulationSteps": 1_000_000_000, "deltaThreshold": 0}


class LoadedScene:
    """A session, which is opened with the first draw, and starts of episodes as snapshots.

    Parameters
    ----------
    task : whose scenes.
    native : as of Session.

    Attributes
    ----------
    session : its session.
    scene, anatomy : parameters, and what is known of the vessel.
    unit, time_step : of length, m, and of time, s.
    hubs : how many instruments.
    longest : by how much the wire can be inserted, m.
    """

    session: Session
    scene: dict[str, Any]
    anatomy: Mapping[str, Any]

    def __init__(self, task: Task, native: bool | None) -> None:
        self._task, self._native = task, native
        self._is_there = False
        self._key = ""    # of the draw that is loaded
        self._folder: tempfile.TemporaryDirectory[str] | None = None    # of a vessel that was drawn
        self._starts: OrderedDict[tuple[Any, ...], bytes] = OrderedDict()
        self._motion: tuple[str, VesselMotion | None] = ("", None)    # of a vessel as a scene describes it
        self._routes: OrderedDict[tuple[Any, ...], tuple[Any, Route]] = OrderedDict()    # of vessels where they are

    def load(self, draw: Draw) -> bool:
        """Bring the scene of an episode, and return whether it was there.

        Raises
        ------
        Error : it cannot be had; one line.
        """
        key = json.dumps((draw.anatomy, draw.instrument, draw.friction, draw.random), default=list)
        if self._is_there and key == self._key and self.session.is_open:
            return True
        scene, anatomy = self._task.scene_of(draw)
        shape = self._task.shape_of(draw)
        folder = None
        self._key = ""
        try:
            if any(any(np.ravel(one)) for one in shape.values()):
                folder = tempfile.TemporaryDirectory(prefix="guidewire-")
                scene, anatomy = reshaped(scene, anatomy, shape.get("warp"), shape.get("entry"), Path(folder.name))
            self.scene, self.anatomy = {**scene, **ENDLESS}, anatomy
            if self._is_there and self.session.is_open:
                self.session.reopen(None, True, **self.scene)
            else:
                self.session, self._is_there = Session(None, True, self._native, **self.scene), True
        except SessionError as error:
            raise Error(str(error)) from error
        finally:
            if self._folder is not None:
                self._folder.cleanup()
            self._folder = folder
        self.unit = float(self.session.parameters["metresPerUnit"])    # m
        self.time_step = float(self.session.parameters["timeStep"])
        if self.session.state.hub is None:
            raise Error("an environment needs a wire of solver \"direct\"")
        self.hubs = self.session.hubs
        limits = [one.get("hubForceLimit")
                  for one in (self.session.parameters, *(self.session.parameters.get("catheters") or ()))]
        # N; 0: none named
        self.limits = [float(limit) if isinstance(limit, (int, float)) else 0.0 for limit in limits]
        inside = self.session.state.hub.length_in_body
        length = float(self.session.parameters["guidewireLength"]) * self.unit
        # A sheathed wire can be fed until its proximal end is two of its elements from the sheath's exit. Hubs of
        # several instruments are stopped by one another and by the exit.
        step = length / len(self.session.state.orientations)
        self.longest = float("inf") if inside is None or self.hubs > 1 else length - inside - 2.0 * step
        self._key = key
        return False

    def close(self) -> None:
        """End its session; a vessel that was drawn is gone."""
        if self._is_there:
            self.session.close()
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None
        self._starts.clear()

    def start(self, tip_turn: float, insertion: Any) -> State:
        """The instruments at the start of an episode: each by so much in its vessel, m, and all turned, rad."""
        insertions = of_each(insertion, self.hubs)
        if not any((tip_turn, *insertions)):
            return self.session.reset()
        if max(insertions) > self.longest:
            raise Error(f"insertion = {max(insertions):g} is not allowed: this wire can be inserted by at most "
                        f"{self.longest:.4g} m")
        key = (self._key, tip_turn, *insertions)
        if key in self._starts:
            self._starts.move_to_end(key)
            return self.session.restore(self._starts[key])
        for parts in _TRIED:    # a wire whose tip catches may come there in shorter steps
            if self.session.state.step > 0:
                self.session.reset()
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

    def _moved(self, tip_turn: float, insertions: Sequence[float], parts: int) -> State:
        steps = parts * max(int(np.ceil(abs(tip_turn) / _LARGEST_TURN)), int(np.ceil(max(insertions) / _LARGEST_PUSH)))
        state = self.session.step([one / self.unit for one in insertions], [tip_turn] * self.hubs, steps)
        return self.session.step() if state.outcome is None else state

    def route(self, target: Any) -> Route:
        """Find the way to a target of its vessel."""
        key = (id(self.anatomy), self.unit, json.dumps(target))    # an anatomy that is kept has its number alone
        if key not in self._routes:
            self._routes[key] = self.anatomy, Route(self.anatomy, target, self.anatomy["metresPerUnit"] / self.unit)
            if len(self._routes) > _ROUTES:
                self._routes.popitem(last=False)
        return self._routes[key][1].placed(Placement.of(self.session.parameters), self._how_it_moves())

    def _how_it_moves(self) -> VesselMotion | None:
        """Return how the vessel moves, None where it stands still."""
        parameters = self.session.parameters
        if not (parameters["vessel"] or {}).get("motion"):
            return None
        from guidewire.anatomy.motion import motion_of    # needs scipy

        motion = parameters["vessel"]["motion"]
        rest = {key: value for key, value in motion.items() if key not in ("period", "heartRate", "phase", "breathing")}
        key = json.dumps([rest, motion.get("breathing"), *map(parameters.get, ("position", "rotation", "scale"))])
        if self._motion[0] != key:
            self._motion = key, motion_of(parameters)
        else:
            self._motion[1].set_pace(motion)
        return self._motion[1]
