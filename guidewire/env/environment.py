"""Instruments to be steered to a target: Gymnasium's environment over a Session."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from guidewire.env.draws import draw_of, eased_draw, with_options
from guidewire.env.drive import Drive, DriveState
from guidewire.env.episode import SAFE_FORCE, Part, Report
from guidewire.env.instruments import Instrument, instruments_of, names_of, of_each
from guidewire.env.loaded import LoadedScene
from guidewire.env.observation import Observation, Observer
from guidewire.env.options import made_of, need_number
from guidewire.env.picture import Picture
from guidewire.env.randomisation import Draw
from guidewire.env.recorded import RecordedDrive, digest_of
from guidewire.env.rendering import Scenery, Window
from guidewire.env.route import Route
from guidewire.env.snapshots import packed, unpacked
from guidewire.env.spaces import ClosedEnvironmentError, Env, Error, ResetNeeded
from guidewire.env.task import Task, find_task
from guidewire.sessions.session import Session, SessionError, State

LEFT = "left the vessel"
_BROKEN = 1.05  # of a hub's limit: beyond that a force is none that a hand has
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
    left : once, where an instrument leaves the vessel. An episode gains at most 1 by progress, so to leave by the
        default is worse than to stand still for 50 s.
    force : each N s of the largest force of a wall; or of that on each instrument, the wire first.

    Raises
    ------
    Error : one of them is not a finite number.
    """

    progress: float | Sequence[float] = 1.0
    target: float = 1.0
    time: float = -0.02
    left: float = -2.0
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

    def of(self, gone: Sequence[float], forces: Sequence[float], duration: float, end: str) -> float:
        """Return what a step returns.

        Parameters
        ----------
        gone : of each instrument, as a fraction of what was before all of them at first.
        forces : largest on each, N.
        duration : s.
        end : of the episode, "" while it goes on.
        """
        progress = sum(weight * one for weight, one in zip(of_each(self.progress, len(gone)), gone))
        force = (sum(weight * one for weight, one in zip(self.force, forces)) if isinstance(self.force, (list, tuple))
                 else self.force * max(forces))
        return progress + duration * (self.time + force) + self.target * (end == "target") + self.left * (end == LEFT)


class Replayed(NamedTuple):
    """A step of a replayed drive; of the beginning there is no action."""

    action: np.ndarray | None
    observation: Any
    reward: float
    terminated: bool
    truncated: bool
    info: dict[str, Any]


class Environment(Env):
    """Instruments and one target; Gymnasium 1.x's reset and step, whether or not it is installed.

    Parameters
    ----------
    task : name of a task, file of one or of a scene with anatomy and target, or a Task.
    drive, observation, reward : options, with what each means; or dicts of them.
    safe_force : limit of a safe success, N.
    ends_unsafe : whether a larger force ends the episode.
    difficulty : of the draws, from 0, the easiest, to 1, as the task has them; may be set anew between episodes.
    native : as of Session.
    render_mode : None; "rgb_array": `render` gives an X-ray picture with vessel and instruments in three dimensions
        beside it, (360, 720, 3) of uint8; "human": each reset and step shows it in a window.

    Raises
    ------
    NameNotFound, Error : as find_task; safe_force or render_mode is not allowed.

    Notes
    -----
    terminated: the target is reached, an instrument has left the vessel by an open end, or with `ends_unsafe` a force
    was too large. truncated: the task's time is over, or the simulation has ended the run. All are looked at after each
    time step, and the step of the environment ends there. `info` of every step holds "force", N, and "left", units,
    with catheters "instruments" with these of each; that of the last one also "is_success" and "report", see Report.
    Episodes are drawn by `np_random` alone, so the same seeds give the same bits.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": 7}

    def __init__(self, task: str | Path | Task = "artery", drive: Drive | Mapping[str, Any] = Drive(),
                 observation: Observation | Mapping[str, Any] = Observation(),
                 reward: Reward | Mapping[str, Any] = Reward(),
                 safe_force: float = SAFE_FORCE, ends_unsafe: bool = False, native: bool | None = None,
                 render_mode: str | None = None, difficulty: float = 1.0) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise Error(f"render_mode = {render_mode!r} is not allowed: needs None, \"human\" or \"rgb_array\"")
        need_number("safe_force", safe_force, 0.0, above=True)
        self.task = find_task(task)
        self.render_mode = render_mode
        self._scenery: tuple[Route, Scenery] | None = None
        self._window: Window | None = None
        self.drive = drive = made_of(Drive, "drive", drive)
        self.observation = observation = made_of(Observation, "observation", observation)
        self.reward = reward = made_of(Reward, "reward", reward)
        self.safe_force, self.ends_unsafe, self.difficulty = safe_force, ends_unsafe, difficulty
        self.hubs = self.task.hubs
        drive.check(self.hubs)
        if drive.step_time > self.task.time + 1e-9:
            raise Error(f"step_time = {drive.step_time:g} is not allowed: an episode takes {self.task.time:g} s")
        reward.check(self.hubs)
        self.action_space, self.observation_space = drive.space(self.hubs), observation.space(self.hubs)
        self._scene = LoadedScene(self.task, native)
        self._is_closed = self._is_running = False
        self._draw: Draw | None = None    # of the episode, once there is one
        self._calls: list[tuple[Any, Any, int]] = []

    @property
    def session(self) -> Session:
        """Return the session of this episode; who steps it past the environment has to reset."""
        self._check_begun()
        return self._scene.session

    @property
    def session_state(self) -> State:
        """The instruments as they are now."""
        return self.session.state

    @property
    def scene(self) -> Mapping[str, Any]:
        """Parameters of this episode's scene, with absolute paths."""
        self._check_begun()
        return self._scene.scene

    @property
    def report(self) -> Report:
        """Return the report of this episode so far."""
        self._check_begun()
        return self._report

    @property
    def target_position(self) -> np.ndarray:
        """(3,), units."""
        self._check_begun()
        return self._route.target_position

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
            middle of what is random; "snapshot": what `save` gave, with which the episode goes on as it did.

        Returns
        -------
        The observation; and info: "draw", "loaded" (whether the episode has the scene of the last one).

        Raises
        ------
        ClosedEnvironmentError, Error : it is closed; an option is not allowed.
        """
        self._check_open()
        super().reset(seed=seed)
        drawn = draw_of(self.task, self.np_random)    # always, so that options do not change what later episodes draw
        need_number("difficulty", self.difficulty, 0.0)
        if self.difficulty < 1.0:
            drawn = eased_draw(self.task, drawn, self.difficulty)
        elif self.difficulty > 1.0:
            raise Error(f"difficulty = {self.difficulty!r} is not allowed: needs a number from 0 to 1")
        image = self.observation.image
        is_noisy = isinstance(image, Picture) and image.noise > 0.0 or self.drive.noise > 0.0 or "noise" in drawn.random
        noise = int(self.np_random.integers(2**32)) if is_noisy else 0
        draw = with_options(self.task, drawn, options or {})
        saved = (options or {}).get("snapshot")
        self._is_running = False
        head: dict[str, Any] = {}
        bits, arrays = None, []
        if saved is not None:
            head, arrays, bits = unpacked(saved, self.task.name)
            draw = with_options(self.task, drawn, Draw(**head["draw"]).as_options())
        loaded = self._begin(draw, bits)
        if self._scene.hubs != self.hubs:
            raise Error(f"the scene of {self.task.anatomies[draw.anatomy]} has {self._scene.hubs} instruments, the "
                        f"task's first one {self.hubs}")
        self._draw = draw
        self._route = self._scene.route(self.task.targets[draw.target])
        self._instruments = instruments_of(self.session_state)
        self._route.follow(self.session_state)
        self._places = self._found()
        self._first = max(sum(self._remaining()), 1e-9)
        steps = self.drive.step_time / self._scene.time_step
        self._steps = round(steps)
        if self._steps < 1 or abs(steps - self._steps) > 1e-6:
            raise Error(f"step_time = {self.drive.step_time:g} is not allowed: needs a multiple of the scene's time "
                        f"step of {self._scene.time_step:g} s")
        self._drive = DriveState(self.drive, *self.drive.limits(self.task), draw.random.get("noise"))
        self._random = np.random.default_rng(noise)    # of the drive
        self._report = Report(self.safe_force, way=self._places[0][1], parts=[Part(left) for _, left in self._places])
        self._observer = Observer(self.observation, self._route, self._scene.unit, self.hubs, noise)
        self._calls, self._origin, self._held = [], draw.as_options(), 0.0
        is_seen = saved is not None and self._restore(head, arrays)
        self._is_running = True
        if self.render_mode == "human":
            self.render()
        return self._seen(is_seen), {"draw": draw.as_options(), "loaded": loaded}

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
        for (insertion, turn), one in zip(self._drive.motion(command, self._random), self._instruments):
            now = one.hub.insertion
            within = min(max(insertion, -max(now, 0.0)), max(self._scene.longest - now, 0.0))
            pushes.append(within / self._scene.unit)
            turns.append(turn)
        return self._move(pushes, turns, self._steps)

    def check_action(self, action: Any) -> None:
        """Raises InvalidAction where a step would refuse it."""
        self.drive.command(action, self.hubs)

    def save(self) -> bytes:
        """All of this episode, for reset(options={"snapshot": ...}) here or in another environment of the task: the
        same actions then give the same observations, rewards and end. Pictures with a function of one's own are made
        anew.

        Raises
        ------
        ClosedEnvironmentError, ResetNeeded : it is closed; there was no episode yet.
        """
        self._check_open()
        self._check_begun()
        seen, arrays = self._observer.save()
        head = {"task": self.task.name, "draw": vars(self._draw), "first": self._first, "held": self._held,
                "report": {**vars(self._report), "parts": [vars(part) for part in self._report.parts]},
                "waiting": list(self._drive.waiting), "random": self._random.bit_generator.state, "seen": seen,
                "calls": self._calls, "origin": self._origin}
        with self._asking():
            return packed(head, arrays, self.session.save())

    def _restore(self, head: Mapping[str, Any], arrays: list[np.ndarray]) -> bool:
        """Go on as the episode of a snapshot did; return whether its last observation is known."""
        if len(head["waiting"]) != self.drive.delay:
            raise Error(f"this snapshot is of a drive with a delay of {len(head['waiting'])} steps, not of "
                        f"{self.drive.delay}")
        own = {**head["report"], "safe_force": self.safe_force, "parts": [Part(**one) for one in
                                                                          head["report"]["parts"]]}
        self._report = Report(**own)
        if self._report.end:
            raise Error(f"the episode of this snapshot has ended ({self._report.end})")
        self._first, self._held, self._origin = head["first"], head["held"], head["origin"]
        self._calls = [tuple(call) for call in head["calls"]]
        self._drive.waiting.clear()
        self._drive.waiting.extend([tuple(pair) for pair in command] for command in head["waiting"])
        self._random.bit_generator.state = head["random"]
        return self._observer.restore(head["seen"], arrays)

    def recorded(self, source: str = "") -> RecordedDrive:
        """Return what was done in this episode."""
        self._check_begun()
        options = dict(self._origin)
        return RecordedDrive(self.task.name, options, list(self._calls), digest_of(self.session_state), source)

    def replay(self, drive: RecordedDrive) -> Report:
        """Do again what was recorded, as far as the episode's end; its report.

        Raises
        ------
        Error : it is of another task, or the instruments at the end have other bits.
        """
        for _ in self.replayed(drive):
            pass
        return self._report

    def replayed(self, drive: RecordedDrive) -> Iterator[Replayed]:
        """Do again what was recorded, as `replay`, and give the beginning and then each step."""
        if drive.task != self.task.name:
            raise Error(f"this drive is of task '{drive.task}', not of '{self.task.name}'")
        observation, info = self.reset(options=drive.options)
        yield Replayed(None, observation, 0.0, False, False, info)
        speeds, rotations = self.drive.limits(self.task)
        for push, turn, steps in drive.calls:
            if self._report.end:    # what came after it only decides the bits
                self.session.step(push, turn, steps)
                continue
            pushes, turns = of_each(push, 1), of_each(turn, 1)
            if len(pushes) != self.hubs or len(turns) != self.hubs:
                raise Error(f"this drive is of {len(pushes)} hubs, not of {self.hubs}")
            duration = steps * self._scene.time_step
            action = [part for one, other, speed, rotation in zip(pushes, turns, speeds, rotations)
                      for part in (one * self._scene.unit / (speed * duration), other / (rotation * duration))]
            self._observer.action[:] = action = np.clip(action, -1.0, 1.0)
            yield Replayed(action, *self._move(list(pushes), list(turns), steps))
        if digest_of(self.session_state) != drive.digest:
            raise Error("the wire at the end is not bit for bit the recorded one")

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
            self._scenery = self._route, Scenery(self.session, self._route)
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
        self._scene.close()
        self._scenery = None

    def _move(self, pushes: list[float], turns: list[float], steps: int
              ) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """pushes, turns : of each hub in all steps, units and rad."""
        report, before, began = self._report, self._remaining(), self._report.time
        forces, end, made = [0.0] * self.hubs, "", []
        motion = [one / steps for one in pushes], [one / steps for one in turns]
        with self._asking():
            while not end and len(made) < steps:
                if self.session_state.outcome is not None:
                    end, report.reason = "simulation", self.session_state.reason
                    break
                made.append((self._within_ends(motion[0]), motion[1]))
                duration, earlier, later = self._stepped(*made[-1])
                report.reason = self._broken_limit(later) or self.session_state.reason
                if report.reason:
                    end = "simulation"
                if end and self.session_state.outcome is None:    # forces that no hand has are not taken in
                    break
                own = report.add(duration, earlier, later)
                forces = list(map(max, forces, own))
                end = end or self._end_of_step(duration, max(own))
        if len(made) == steps and all(push == motion[0] for push, _ in made):
            made = [(pushes, turns)]
        else:    # with the bits of each step
            steps = 1
        self._calls += [(push[0], turn[0], steps) if self.hubs == 1 else (push, turn, steps) for push, turn in made]
        gone = [(one - other) / self._first for one, other in zip(before, before if end == LEFT else self._remaining())]
        earned = self.reward.of(gone, forces, report.time - began, end)
        info: dict[str, Any] = {"force": max(forces), "left": report.left}
        if self.hubs > 1:
            info["instruments"] = {name: {"force": force, "left": part.left} for name, force, part in
                                   zip(names_of(self.hubs), forces, report.parts)}
        if end:
            report.end, report.success = end, end == "target"
            report.exposures, report.contrast = self._observer.exposures, self._injected()
            info["report"], info["is_success"] = report.as_info(), report.success
            self._is_running = False
        if self.render_mode == "human":
            self.render()
        terminated = end in ("target", "force", LEFT)
        return self._seen(), float(earned), terminated, bool(end) and not terminated, info

    def _begin(self, draw: Draw, bits: bytes | None) -> bool:
        """Bring the instruments to their start, or to what a session saved, and return whether the scene was open."""
        loaded = self._scene.load(draw)
        try:
            if loaded:
                self._scene.session.reset()    # a state that is restored leaves contrast agent where it is
            if bits is None:
                self._scene.start(draw.tip_turn, draw.insertion)
            else:
                self._scene.session.restore(bits)
        except SessionError:
            if self._scene.session.is_open:
                raise
            self._scene.load(draw)    # its runner had ended since
            return self._begin(draw, bits)
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
        self._route.follow(self.session_state)
        return self.session_state.time - began, before, self._instruments

    def _within_ends(self, pushes: list[float]) -> list[float]:
        """Of each hub the push, units, in a time step, less what would bring a tip out of an open end."""
        if not self.drive.stops_at_ends:
            return pushes
        return [min(push, max(self._route.until_outlet(_tip_of(one)) - abs(push), 0.0)) if push > 0.0 else push
                for push, one in zip(pushes, self._instruments)]

    def _broken_limit(self, instruments: Sequence[Instrument]) -> str:
        """Say which hub pushes or pulls with more than it can, where one does."""
        for name, limit, one in zip(names_of(self.hubs), self._scene.limits, instruments):
            if 0.0 < _BROKEN * limit < abs(one.hub.force):
                return (f"the hub of the {name} has a force of {abs(one.hub.force):.3g} N, beyond its limit of "
                        f"{limit:g} N")
        return ""

    def _end_of_step(self, duration: float, force: float) -> str:
        """Return how the episode ends after a time step, "" where it goes on."""
        was_beyond, self._places = self._route.is_beyond[self._places[0][0]], self._found()
        has_left = self._has_left()
        if not has_left:
            for part, (_, left) in zip(self._report.parts, self._places):
                part.left = left
        if self.session_state.outcome is not None:
            return "simulation"
        if self.ends_unsafe and force > self.safe_force:
            return "force"
        if has_left:
            return LEFT
        index, left = self._places[0]
        is_there = left <= self.task.tolerance or (    # or it has passed within the time step
            self.task.hold == 0.0 and bool(self._route.is_beyond[index]) > bool(was_beyond))
        is_there = is_there and not any(self._remaining()[1:])
        self._held = self._held + duration if is_there else 0.0
        if is_there and self._held > self.task.hold - 1e-9:
            return "target"
        return "time" if self._report.time + self._scene.time_step > self.task.time + 1e-9 else ""

    def _injected(self) -> float:
        """Return how much contrast agent was injected in this episode, ml; 0 where the vessel takes none."""
        try:
            return self.session.agent().injected
        except SessionError:
            return 0.0

    def _found(self) -> list[tuple[int, float]]:
        """Find of each instrument the centreline's point that it has come to within the vessel, and the distance
        left."""
        return [self._route.place(_tip_of(one)) for one in self._instruments]

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

    def _seen(self, is_known: bool = False) -> Any:
        return self._observer.of(self.session_state, self._instruments, self._places, is_known)

    def _check_open(self) -> None:
        if self._is_closed:
            raise ClosedEnvironmentError("this environment is closed")

    def _check_begun(self) -> None:
        if self._draw is None:
            raise ResetNeeded(_NO_EPISODE)


def _tip_of(one: Instrument) -> np.ndarray:
    """Where a tip is, (3,), or is counted in the vessel."""
    return one.positions[-1] if one.place is None else one.place.point
