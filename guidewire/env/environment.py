"""Instruments to be steered to a target: Gymnasium's environment over a Session."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.draws import Draw, draw_of, with_options
from guidewire.env.drive import Drive, DriveState
from guidewire.env.episode import SAFE_FORCE, Part, Report
from guidewire.env.instruments import Instrument, instruments_of, names_of, of_each
from guidewire.env.loaded import LoadedScene, LoadedScenes
from guidewire.env.observation import Observation, Observer
from guidewire.env.options import need_number
from guidewire.env.picture import Picture
from guidewire.env.recorded import RecordedDrive, digest_of
from guidewire.env.rendering import Scenery, Window
from guidewire.env.route import Route
from guidewire.env.spaces import ClosedEnvironmentError, Env, Error, ResetNeeded
from guidewire.env.task import Task, find_task
from guidewire.sessions.session import Session, SessionError, State

LEFT = "left the vessel"
HUB = "a hub needs more than its hubForceLimit"
_OVER_LIMIT = 0.01  # of a hubForceLimit, by which a hub may be above it
_NO_EPISODE = "there was no episode yet: call reset() first"


@dataclass(frozen=True)
class Reward:
    """Sum of these, each step.

    Attributes
    ----------
    progress : for the whole distance along the centreline that an episode begins with, of the wire's tip and of those
        catheters that are to follow; of all, or of each instrument, the wire first.
    target : once, where it is reached.
    time : a second of simulated time.
    force : each N s of the largest force of a wall; or of that on each instrument, the wire first.

    Raises
    ------
    Error : one of them is not a finite number.
    """

    progress: float | Sequence[float] = 1.0
    target: float = 1.0
    time: float = -0.02
    force: float | Sequence[float] = 0.0

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            for one in value if name in ("progress", "force") and isinstance(value, (list, tuple)) else [value]:
                need_number(f"reward {name}", one)

    def check(self, hubs: int) -> None:
        """Raises Error where lists are not for so many instruments."""
        for name, value in (("progress", self.progress), ("force", self.force)):
            if len(of_each(value, hubs)) != hubs:
                raise Error(f"reward {name} = {value!r} is not allowed: needs a number, or one for each of the {hubs} "
                            "instruments")

    def of(self, gone: Sequence[float], forces: Sequence[float], duration: float, is_reached: bool) -> float:
        """Return what a step returns.

        Parameters
        ----------
        gone : of each instrument, as a fraction of what was before all of them at first.
        forces : largest on each, N.
        duration : s.
        """
        progress = sum(weight * one for weight, one in zip(of_each(self.progress, len(gone)), gone))
        force = (sum(weight * one for weight, one in zip(self.force, forces)) if isinstance(self.force, (list, tuple))
                 else self.force * max(forces))
        return progress + duration * (self.time + force) + self.target * is_reached


class Environment(Env):
    """Instruments and one target; Gymnasium 1.x's reset and step, whether or not it is installed.

    Parameters
    ----------
    task : name of a task, file of one or of a scene with anatomy and target, or a Task.
    drive, observation, reward : options, with what each means.
    safe_force : limit of a safe success, N.
    ends_unsafe : whether a larger force ends the episode.
    native : as of Session.
    render_mode : None; "rgb_array": `render` gives an X-ray picture with vessel and instruments in three dimensions
        beside it, (360, 720, 3) of uint8; "human": each reset and step shows it in a window.

    Raises
    ------
    NameNotFound, Error : as find_task; safe_force or render_mode is not allowed.

    Notes
    -----
    terminated: the target is reached, an instrument has left the vessel by an open end, or with `ends_unsafe` a force
    was too large, or a hub needed more than its hubForceLimit. truncated: the task's time is over, or the simulation has ended the run. `info` of every step holds
    "force", N, and "left", units, with catheters "instruments" with these of each; that of the last one also "report",
    see Report. Episodes are drawn by `np_random` alone, so the same seeds give the same bits.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 7}

    def __init__(self, task: str | Path | Task = "artery", drive: Drive = Drive(),
                 observation: Observation = Observation(), reward: Reward = Reward(),
                 safe_force: float = SAFE_FORCE, ends_unsafe: bool = False, native: bool | None = None,
                 render_mode: str | None = None) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise Error(f"render_mode = {render_mode!r} is not allowed: needs None, \"human\" or \"rgb_array\"")
        need_number("safe_force", safe_force, 0.0, above=True)
        self.task = find_task(task)
        self.render_mode = render_mode
        self._scenery: tuple[Route, Scenery] | None = None
        self._window: Window | None = None
        self.drive, self.observation, self.reward = drive, observation, reward
        self.safe_force, self.ends_unsafe = safe_force, ends_unsafe
        self.hubs = self.task.hubs
        drive.check(self.hubs)
        if drive.step_time > self.task.time + 1e-9:
            raise Error(f"step_time = {drive.step_time:g} is not allowed: an episode takes {self.task.time:g} s")
        reward.check(self.hubs)
        self.action_space, self.observation_space = drive.space(self.hubs), observation.space(self.hubs)
        self._scenes = LoadedScenes(self.task, native)
        self._is_closed = self._is_running = False
        self._scene: LoadedScene | None = None
        self._draw: Draw | None = None    # of the episode, once there is one
        self._calls: list[tuple[Any, Any, int]] = []

    @property
    def session(self) -> Session:
        """Return the session of this episode; who steps it past the environment has to reset."""
        return self._opened.session

    @property
    def session_state(self) -> State:
        """The instruments as they are now."""
        return self.session.state

    @property
    def scene(self) -> Mapping[str, Any]:
        """Parameters of this episode's scene, with absolute paths."""
        return self._opened.scene

    @property
    def report(self) -> Report:
        """Return the report of this episode so far."""
        self._check_begun()
        return self._report

    @property
    def target_position(self) -> np.ndarray:
        """(3,), units."""
        self._check_begun()
        return self._route.points[self._route.target]

    @property
    def widest(self) -> float:
        """Largest radius of the vessel, units."""
        self._check_begun()
        return self._route.widest

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode.

        Parameters
        ----------
        seed : of this and all later episodes.
        options : in place of what is drawn: "anatomy", "target" (their numbers), "instrument", "friction", "tip_turn"
            (rad), "insertion" (m), and what the task's `random` names; "nominal": the first of each, no turn and the
            middle of what is random; "snapshot": what `save` gave.

        Returns
        -------
        The observation; and info: "draw", "loaded" (whether the scene was open; reading one takes about a second).

        Raises
        ------
        ClosedEnvironmentError, Error : it is closed; an option is not allowed.
        """
        self._check_open()
        super().reset(seed=seed)
        drawn = draw_of(self.task, self.np_random)    # always, so that options do not change what later episodes draw
        is_noisy = isinstance(self.observation.image, Picture) and self.observation.image.noise > 0.0
        noise = int(self.np_random.integers(2**32)) if is_noisy else 0
        draw = with_options(self.task, drawn, options or {})
        saved = (options or {}).get("snapshot")
        self._is_running = False
        if saved is not None:
            own, bits = _unpacked(saved, self.task.name)
            draw = with_options(self.task, drawn, own)
            loaded = self._begin(draw, lambda scene: scene.session.restore(bits))
        else:
            loaded = self._begin(draw, lambda scene: scene.start(draw.tip_turn, draw.insertion))
        if self._scene.hubs != self.hubs:
            raise Error(f"the scene of {self.task.anatomies[draw.anatomy]} has {self._scene.hubs} instruments, the "
                        f"task's first one {self.hubs}")
        self._route = self._scene.route(self.task.targets[draw.target])
        self._instruments = instruments_of(self.session_state)
        self._places = self._found()
        self._first = max(sum(self._remaining()), 1e-9)
        steps = self.drive.step_time / self._scene.time_step
        self._steps = round(steps)
        if self._steps < 1 or abs(steps - self._steps) > 1e-6:
            raise Error(f"step_time = {self.drive.step_time:g} is not allowed: needs a multiple of the scene's time "
                        f"step of {self._scene.time_step:g} s")
        self._drive = DriveState(self.drive, *self.drive.limits(self.task), draw.random.get("noise"))
        self._report = Report(self.safe_force, way=self._places[0][1], parts=[Part(left) for _, left in self._places])
        self._observer = Observer(self.observation, self._route, self._scene.unit, self.hubs, noise)
        self._calls, self._draw = [], draw
        self._origin = None if saved is not None else draw.as_options()
        self._is_running = True
        if self.render_mode == "human":
            self.render()
        return self._seen(), {"draw": draw.as_options(), "loaded": loaded}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Move the hubs for a step of time.

        Raises
        ------
        ClosedEnvironmentError, ResetNeeded, InvalidAction : it is closed; no episode goes on; not an action.
        """
        self._check_open()
        if not self._is_running:
            raise ResetNeeded("no episode goes on: call reset() first")
        command = self.drive.command(action, self.hubs)
        self._observer.action[:] = [number for pair in command for number in pair]
        pushes, turns = [], []
        for (insertion, turn), one in zip(self._drive.motion(command, self.np_random), self._instruments):
            now = one.hub.insertion
            within = min(max(insertion, -max(now, 0.0)), max(self._scene.longest - now, 0.0))
            pushes.append(within / self._scene.unit)
            turns.append(turn)
        return self._move(pushes, turns, self._steps)

    def check_action(self, action: Any) -> None:
        """Raises InvalidAction where a step would refuse it."""
        self.drive.command(action, self.hubs)

    def save(self) -> bytes:
        """This episode's instruments, for reset(options={"snapshot": ...}) here or in another environment of the
        task.

        Raises
        ------
        ClosedEnvironmentError, ResetNeeded : it is closed; there was no episode yet.
        """
        self._check_open()
        self._check_begun()
        head = {"task": self.task.name, "draw": vars(self._draw)}
        with self._asking():
            return json.dumps(head).encode() + b"\n" + self.session.save()

    def recorded(self, source: str = "") -> RecordedDrive:
        """What was done in this episode; not of one that began from a snapshot."""
        self._check_begun()
        if self._origin is None:
            raise Error("an episode from a snapshot is not recorded: its beginning is not known")
        options = dict(self._origin)
        return RecordedDrive(self.task.name, options, list(self._calls), digest_of(self.session_state), source)

    def replay(self, drive: RecordedDrive) -> Report:
        """Do again what was recorded, as far as the episode's end; its report.

        Raises
        ------
        Error : it is of another task, or the instruments at the end have other bits.
        """
        if drive.task != self.task.name:
            raise Error(f"this drive is of task '{drive.task}', not of '{self.task.name}'")
        self.reset(options=drive.options)
        for push, turn, steps in drive.calls:
            if self._report.end:    # what came after it only decides the bits
                self.session.step(push, turn, steps)
            else:
                pushes, turns = of_each(push, 1), of_each(turn, 1)
                if len(pushes) != self.hubs or len(turns) != self.hubs:
                    raise Error(f"this drive is of {len(pushes)} hubs, not of {self.hubs}")
                self._move(pushes, turns, steps)
        if digest_of(self.session_state) != drive.digest:
            raise Error("the wire at the end is not bit for bit the recorded one")
        return self._report

    def render(self) -> np.ndarray | None:
        """What `render_mode` says; None for a window, or without one.

        Raises
        ------
        ClosedEnvironmentError, ResetNeeded : it is closed; there was no episode yet.
        """
        self._check_open()
        self._check_begun()
        if self.render_mode is None:
            return None
        if self._scenery is None or self._scenery[0] is not self._route:
            self._scenery = self._route, Scenery(self.session, self.target_position)
        picture = self._scenery[1].picture(self.session_state)
        if self.render_mode == "rgb_array":
            return picture
        self._window = self._window or Window(f"guidewire: {self.task.name}")
        self._window.show(picture)
        return None

    def close(self) -> None:
        """End its sessions; may be called again."""
        if self._window is not None:
            self._window.close()
            self._window = None
        self._is_closed, self._is_running = True, False
        self._scenes.close()

    def _move(self, pushes: list[float], turns: list[float], steps: int
              ) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """pushes, turns : of each hub in all steps, units and rad."""
        report, before, forces = self._report, self._remaining(), [0.0] * self.hubs
        self._calls.append((pushes[0], turns[0], steps) if self.hubs == 1 else (pushes, turns, steps))
        motion = [one / steps for one in pushes], [one / steps for one in turns]
        with self._asking():
            for _ in range(steps):
                if self.session_state.outcome is not None:
                    break
                stepped = self._stepped(*motion)
                if self._is_beyond_hubs():    # such forces are nobody's: none is rewarded or reported
                    break
                forces = list(map(max, forces, report.add(*stepped)))
        self._places = self._found()
        has_left = self._has_left()
        if not has_left:
            for part, (_, left) in zip(report.parts, self._places):
                part.left = left
        end = self._end(max(forces), has_left)
        after = before if has_left else self._remaining()
        earned = self.reward.of([(one - other) / self._first for one, other in zip(before, after)], forces,
                                self.drive.step_time, end == "target")
        info: dict[str, Any] = {"force": max(forces), "left": report.left}
        if self.hubs > 1:
            info["instruments"] = {name: {"force": force, "left": part.left} for name, force, part in
                                   zip(names_of(self.hubs), forces, report.parts)}
        if end:
            report.end, report.reason, report.success = end, self.session_state.reason, end == "target"
            info["report"] = report.as_info()
            self._is_running = False
        if self.render_mode == "human":
            self.render()
        terminated = end in ("target", "force", LEFT, HUB)
        return self._seen(), float(earned), terminated, bool(end) and not terminated, info

    def _begin(self, draw: Draw, start: Callable[[LoadedScene], State]) -> bool:
        """Bring the instruments to their start, and return whether the scene was open."""
        self._scene, loaded = self._scenes.find(draw)
        try:
            start(self._scene)
        except SessionError:
            if self.session.is_open or not loaded:
                raise
            return self._begin(draw, start)    # its runner had ended since
        return loaded

    @contextmanager
    def _asking(self) -> Iterator[None]:
        """Name it as Gymnasium does where the session has ended."""
        try:
            yield
        except SessionError as error:
            self._is_running = False
            if self.session.is_open:
                raise
            raise ClosedEnvironmentError(f"{error}: reset() starts it anew") from error

    def _stepped(self, pushes: list[float], turns: list[float]
                 ) -> tuple[float, list[Instrument], list[Instrument]]:
        """Make a time step; returns its duration, s, and the instruments before and after it. No state is kept: all
        of one that is would be read off."""
        before, began = self._instruments, self.session_state.time
        self._instruments = instruments_of(self.session.step(pushes, turns))
        return self.session_state.time - began, before, self._instruments

    def _end(self, force: float, has_left: bool) -> str:
        if self.session_state.outcome is not None:
            return "simulation"
        if self._is_beyond_hubs():
            return HUB
        if self.ends_unsafe and force > self.safe_force:
            return "force"
        if has_left:
            return LEFT
        if self._places[0][1] <= self.task.tolerance and not any(self._remaining()[1:]):
            return "target"
        return "time" if self._report.time > self.task.time - 1e-9 else ""

    def _found(self) -> list[tuple[int, float]]:
        """Find of each instrument the centreline's point that it has come to within the vessel, and the distance
        left."""
        return [self._route.place(one.positions[-1] if one.place is None else one.place.point)
                for one in self._instruments]

    def _is_beyond_hubs(self) -> bool:
        """Whether a hub pushes or pulls with more than a hubForceLimit that the task names."""
        parameters = self.session.parameters
        limits = [one.get("hubForceLimit") for one in (parameters, *(parameters.get("catheters") or []))]
        return any(isinstance(limit, (int, float)) and abs(one.hub.force) > (1.0 + _OVER_LIMIT) * limit > 0.0
                   for limit, one in zip(limits, self._instruments))

    def _has_left(self) -> bool:
        """Whether a tip is out of the vessel beyond an end that is not its inlet."""
        # What is behind the inlet, in a sheath, has no way behind it.
        return any(self._route.has_left(one.positions[-1]) if one.place is None
                   else not one.place.is_inside and one.place.distance > 0.0 for one in self._instruments)

    def _remaining(self) -> list[float]:
        """Return of the wire the distance to the target, of the catheters by how much they are not near enough,
        units."""
        follow = of_each(self.task.follow, self.hubs - 1)
        return [self._places[0][1], *(0.0 if within is None else max(left - within, 0.0)
                                      for within, (_, left) in zip(follow, self._places[1:]))]

    def _seen(self) -> Any:
        return self._observer.of(self.session_state, self._instruments, self._places)

    @property
    def _opened(self) -> LoadedScene:
        if self._scene is None:
            raise ResetNeeded(_NO_EPISODE)
        return self._scene

    def _check_open(self) -> None:
        if self._is_closed:
            raise ClosedEnvironmentError("this environment is closed")

    def _check_begun(self) -> None:
        if self._draw is None:
            raise ResetNeeded(_NO_EPISODE)


def _unpacked(saved: bytes, task: str) -> tuple[dict[str, Any], bytes]:
    """Options of a reset, and what a session restores."""
    try:
        line, _, bits = saved.partition(b"\n")
        head = json.loads(line)
        name, options = head["task"], Draw(**head["draw"]).as_options()
    except (AttributeError, ValueError, KeyError, TypeError) as error:
        raise Error("option \"snapshot\" is not what save() gave") from error
    if name != task:
        raise Error(f"this snapshot is of task '{name}', not of '{task}'")
    return options, bits
