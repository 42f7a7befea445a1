"""A wire to be steered to a target: Gymnasium's environment over a Session."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.env.drive import Drive, DriveState
from guidewire.env.episode import SAFE_FORCE, Report
from guidewire.env.loaded import Draw, LoadedScene, LoadedScenes
from guidewire.env.observation import Observation
from guidewire.env.options import need_number
from guidewire.env.recorded import RecordedDrive, digest_of
from guidewire.env.spaces import ClosedEnvironmentError, Env, Error, ResetNeeded
from guidewire.env.task import Task, find_task
from guidewire.sessions.session import Session

_OPTIONS = ("nominal", "anatomy", "target", "instrument", "friction", "tip_turn", "insertion", "snapshot")


@dataclass(frozen=True)
class Reward:
    """Sum of these, each step.

    Attributes
    ----------
    progress : for the whole distance along the centreline that an episode begins with.
    target : once, where it is reached.
    time : a second of simulated time.
    force : each N s of the largest force of a wall.

    Raises
    ------
    Error : one of them is not a finite number.
    """

    progress: float = 1.0
    target: float = 1.0
    time: float = -0.02
    force: float = 0.0

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            need_number(f"reward {name}", value)


class Environment(Env):
    """One wire and one target; Gymnasium 1.x's reset and step, whether or not it is installed.

    Parameters
    ----------
    task : name of a task, file of one or of a scene with anatomy and target, or a Task.
    drive, observation, reward : options, with what each means.
    safe_force : limit of a safe success, N.
    ends_unsafe : whether a larger force ends the episode.
    native : as of Session.
    render_mode : None; there are no others.

    Raises
    ------
    NameNotFound, Error : as find_task; safe_force or render_mode is not allowed.

    Notes
    -----
    terminated: the target is reached, or with `ends_unsafe` a force was too large. truncated: the task's time is over,
    or the simulation has ended the run. `info` of every step holds "force", N, and "left", units; that of the last one
    also "report", see Report. Episodes are drawn by `np_random` alone, so the same seeds give the same bits.
    """

    metadata = {"render_modes": [], "render_fps": 7}

    def __init__(self, task: str | Path | Task = "artery", drive: Drive = Drive(),
                 observation: Observation = Observation(), reward: Reward = Reward(),
                 safe_force: float = SAFE_FORCE, ends_unsafe: bool = False, native: bool | None = None,
                 render_mode: str | None = None) -> None:
        if render_mode is not None:
            raise Error(f"render_mode {render_mode!r} is not allowed: there is none")
        need_number("safe_force", safe_force, 0.0, above=True)
        self.task = find_task(task)
        self.render_mode = None
        self.drive, self.observation, self.reward = drive, observation, reward
        self.safe_force, self.ends_unsafe = safe_force, ends_unsafe
        self.action_space, self.observation_space = drive.space(), observation.space()
        self._scenes = LoadedScenes(self.task, native)
        self._is_closed = self._is_running = False
        self._scene: LoadedScene | None = None
        self._calls: list[tuple[float, float, int]] = []

    @property
    def session(self) -> Session:
        """Of this episode; who steps it past the environment has to reset."""
        return self._scene.session

    @property
    def scene(self) -> Mapping[str, Any]:
        """Parameters of this episode's scene, with absolute paths."""
        return self._scene.scene

    @property
    def report(self) -> Report:
        """Of this episode so far."""
        return self._report

    @property
    def target_position(self) -> np.ndarray:
        """(3,), units."""
        return self._route.points[self._route.target]

    @property
    def widest(self) -> float:
        """Largest radius of the vessel, units."""
        return self._route.widest

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
              ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode.

        Parameters
        ----------
        seed : of this and all later episodes.
        options : in place of what is drawn: "anatomy", "target" (their numbers), "instrument", "friction", "tip_turn"
            (rad), "insertion" (m); "nominal": the first of each and no turn; "snapshot": what `save` gave.

        Returns
        -------
        The observation; and info: "draw", "loaded" (whether the scene was open; reading one takes about a second).

        Raises
        ------
        ClosedEnvironmentError, Error : it is closed; an option is not allowed.
        """
        self._check_open()
        super().reset(seed=seed)
        options = dict(options or {})
        for key in options:
            if key not in _OPTIONS:
                raise Error(f"option \"{key}\" is not allowed: there are {', '.join(_OPTIONS)}")
        drawn = self._drawn()    # always, so that options do not change what later episodes draw
        saved = options.pop("snapshot", None)
        self._is_running = False
        if saved is not None:
            if options:
                raise Error("option \"snapshot\" stands alone")
            draw, bits = _unpacked(saved, self.task.name)
            self._scene, loaded = self._scenes.find(draw)
            self._state = self.session.restore(bits)
        else:
            draw = self._with_options(drawn, options)
            self._scene, loaded = self._scenes.find(draw)
            self._state = self._scene.start(draw.tip_turn, draw.insertion)
        self._draw = draw
        self._route = self._scene.route(self.task.targets[draw.target])
        self._place = self._route.place(self._front())
        self._first = self._place[1]
        steps = self.drive.step_time / self._scene.time_step
        self._steps = round(steps)
        if self._steps < 1 or abs(steps - self._steps) > 1e-6:
            raise Error(f"step_time = {self.drive.step_time:g} is not allowed: needs a multiple of the scene's time "
                        f"step of {self._scene.time_step:g} s")
        self._hub = DriveState(self.drive, self.drive.speed or self.task.speed,
                               self.drive.rotation or self.task.rotation)
        self._report = Report(self.safe_force, left=self._place[1])
        self._calls = []
        self._origin = None if saved is not None else asdict(draw)
        self._is_running = True
        return self._seen(), {"draw": asdict(draw), "loaded": loaded}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Move the hub for a step of time.

        Raises
        ------
        ClosedEnvironmentError, ResetNeeded, InvalidAction : it is closed; no episode goes on; not an action.
        """
        self._check_open()
        if not self._is_running:
            raise ResetNeeded("no episode goes on: call reset() first")
        command = self.drive.command(action)
        insertion, turn = self._hub.motion(command, self.np_random)
        return self._move(insertion, turn, self._steps)

    def save(self) -> bytes:
        """This episode's wire, for reset(options={"snapshot": ...}) here or in another environment of the task."""
        head = {"task": self.task.name, "draw": asdict(self._draw)}
        return json.dumps(head).encode() + b"\n" + self.session.save()

    def recorded(self, source: str = "") -> RecordedDrive:
        """What was done in this episode; not of one that began from a snapshot."""
        if self._origin is None:
            raise Error("an episode from a snapshot is not recorded: its beginning is not known")
        options = dict(self._origin)
        return RecordedDrive(self.task.name, options, list(self._calls), digest_of(self._state), source)

    def replay(self, drive: RecordedDrive) -> Report:
        """Do again what was recorded, as far as the episode's end; its report.

        Raises
        ------
        Error : it is of another task, or the wire at the end has other bits.
        """
        if drive.task != self.task.name:
            raise Error(f"this drive is of task '{drive.task}', not of '{self.task.name}'")
        self.reset(options=drive.options)
        for push, turn, steps in drive.calls:
            if self._report.end:    # what came after it only decides the bits
                self._state = self.session.step(push, turn, steps)
            else:
                self._move(push * self._scene.unit, turn, steps, push)
        if digest_of(self._state) != drive.digest:
            raise Error("the wire at the end is not bit for bit the recorded one")
        return self._report

    def close(self) -> None:
        """End its sessions; may be called again."""
        self._is_closed, self._is_running = True, False
        self._scenes.close()

    def _move(self, insertion: float, turn: float, steps: int, push: float | None = None
              ) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """push : units, where the motion is given so and not to be limited."""
        now = self._state.hub.insertion
        if push is None:
            insertion = min(max(insertion, -max(now, 0.0)), max(self._scene.longest - now, 0.0))
            push = insertion / self._scene.unit
        report, before, force = self._report, self._place[1], 0.0
        self._calls.append((push, turn, steps))
        for _ in range(steps):
            if self._state.outcome is not None:
                break
            last = self._state
            self._state = self.session.step(push / steps, turn / steps)
            force = max(force, report.add(last, self._state, insertion / steps, turn / steps))
        self._place = self._route.place(self._front())
        report.left = self._place[1]
        end = self._end(force)
        reward = self.reward
        earned = (reward.progress * (before - report.left) / max(self._first, 1e-9)
                  + self.drive.step_time * (reward.time + reward.force * force))
        info: dict[str, Any] = {"force": force, "left": report.left}
        if end:
            report.end, report.reason, report.success = end, self._state.reason, end == "target"
            earned += reward.target * report.success
            info["report"] = report.as_info()
            self._is_running = False
        terminated = end in ("target", "force")
        return self._seen(), float(earned), terminated, bool(end) and not terminated, info

    def _end(self, force: float) -> str:
        if self._state.outcome is not None:
            return "simulation"
        if self.ends_unsafe and force > self.safe_force:
            return "force"
        if self._report.left <= self.task.tolerance:
            return "target"
        return "time" if self._report.time > self.task.time - 1e-9 else ""

    def _front(self) -> np.ndarray:
        """The last point of the wire up to which it has not left the vessel, (3,), units: the tip, as long as it is
        inside."""
        place = self._state.place
        return self._state.positions[-1] if place is None else place.point

    def _seen(self) -> Any:
        return self.observation.of(self._state, self._route, self._place, self._scene.unit)

    def _drawn(self) -> Draw:
        task, random = self.task, self.np_random
        anatomy, target, instrument, friction, turn = (int(random.integers(max(n, 1))) for n in (
            len(task.anatomies), len(task.targets), len(task.instruments), len(task.frictions), task.tip_turns))
        return Draw(anatomy, target, task.instruments[instrument] if task.instruments else None,
                    float(task.frictions[friction]), _turn(turn, task.tip_turns), task.insertion)

    def _with_options(self, drawn: Draw, options: dict[str, Any]) -> Draw:
        task = self.task
        if options.pop("nominal", False):
            drawn = Draw(0, 0, task.instruments[0] if task.instruments else None, float(task.frictions[0]), 0.0,
                         task.insertion)
        for key, count in (("anatomy", len(task.anatomies)), ("target", len(task.targets))):
            if key in options and options[key] not in range(count):
                raise Error(f"option \"{key}\" = {options[key]!r} is not allowed: needs a whole number below {count}")
        for key, least, most in (("friction", 0.0, 10.0), ("tip_turn", -100.0, 100.0), ("insertion", 0.0, 10.0)):
            if key in options:
                value = options[key]
                is_number = isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
                if not is_number or not least <= value <= most:
                    raise Error(f"option \"{key}\" = {value!r} is not allowed: needs a number from {least:g} to "
                                f"{most:g}")
                options[key] = float(value)
        return replace(drawn, **options)

    def _check_open(self) -> None:
        if self._is_closed:
            raise ClosedEnvironmentError("this environment is closed")


def _turn(index: int, count: int) -> float:
    """Even turns from 0, the shorter way round."""
    return 2.0 * np.pi * (index if 2 * index <= count else index - count) / count


def _unpacked(saved: bytes, task: str) -> tuple[Draw, bytes]:
    try:
        line, _, bits = saved.partition(b"\n")
        head = json.loads(line)
        draw = Draw(**head["draw"])
    except (AttributeError, ValueError, KeyError, TypeError) as error:
        raise Error("option \"snapshot\" is not what save() gave") from error
    if head["task"] != task:
        raise Error(f"this snapshot is of task '{head['task']}', not of '{task}'")
    return draw, bits
