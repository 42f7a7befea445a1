"""A run controlled by a Python script: stepped, saved, restored; any number of them in parallel.

    with Session("params/insertion.json", bendStiffness=0.05) as session:
        state = session.step(push=1.0, turn=0.1, steps=10)
        state.positions[-1]   # the tip, units

The native library simulates where it was built (`guidewire.py native`), else a runner process for each session; either
gives the same bits.
"""

from __future__ import annotations

import base64
import json
import math
import os
import re
import threading
import warnings
import weakref
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, NoReturn

import numpy as np

from guidewire.logs.surfaces import Surface
from guidewire.sessions.agent import Agent
from guidewire.sessions.session_hosts import SECONDS_TO_END, STEPS_AT_ONCE, Ended, Library, Process, host_of
from guidewire.sessions.session_state import (
    Frames, LumenPlace, SessionError, State, arrays_of, fill, state_of, unread, unread_state,
)
from guidewire.sessions.session_values import accepted, in_a_row, number, numbers, plain, text_of, whole

_MOST = 1 << 31  # from here on a number does not fit a request of the library's


class Session:
    """A run that goes on step by step, as `step` says.

    Parameters
    ----------
    file : parameter file, from the folder where the script runs; None: the defaults count.
    hand : whether `push` and `turn` of `step` move the first sphere, in place of the file's drive. None: where the
        wire is gains; a wire with a material has its file's drive.
    native : whether the native library simulates, in this process. None: where it has been built from these sources.
    records_steering : whether `drive_tables` gives what a hand has steered; pushes and turns are then rounded, by less
        than 2e-15 m and 5e-13 rad a step.
    overrides : parameters by key, overriding the file's: numbers, texts, lists, dicts, numpy arrays; parts of them
        as `**{"vessel.radius": 4.0}`.

    Attributes
    ----------
    state : the wire as it is now.
    parameters : every effective value by key.
    hand : whether a hand moves the first sphere.
    hubs : how many there are, the wire's and those of the catheters.
    unrecorded : why no table says what was steered, in one phrase; empty where one does.

    Raises
    ------
    SessionError : the file, a key or a value cannot be used; one line says which and what is allowed.
    guidewire.prepare.PreparationError : the runner cannot be built.

    Warns
    -----
    UserWarning : what is allowed and most likely not meant, such as a key of the file that the solver does not take.
    """

    def __init__(self, file: str | Path | None = None, hand: bool | None = None, native: bool | None = None,
                 records_steering: bool = False, **overrides: Any) -> None:
        self._host: Library | Process | None = host_of(native)
        # Also at the interpreter's exit, before modules go; what holds an unread state holds this session too.
        self._finish = weakref.finalize(self, _end, self._host, os.getpid())
        self._is_closing = False
        self._lock = threading.RLock()    # one asks it at a time; a state may be read off in another thread
        self._state: State | None = None    # the newest, once something has been read off
        self._newest: Callable[[], State | None] = lambda: None    # while somebody has it, the same
        self._head = (0, 0.0, 0.0)    # of the newest: steps, time, prediction error
        self._layout: dict[str, tuple[int, ...]] = {}
        self._records_steering = records_steering
        self.unrecorded = ""
        try:
            self._open(file, hand, overrides)
        except BaseException:
            self.close()
            raise

    @property
    def is_open(self) -> bool:
        """Whether it can still be asked: not closed, and its runner lives."""
        return self._host is not None

    @property
    def state(self) -> State:
        """The wire as it is now."""
        state = self._state
        if state is None:
            with self._lock:
                state = self._state or self._newest() or self._unread()
        return state

    def step(self, push: float | Sequence[float] = 0.0, turn: float | Sequence[float] = 0.0, steps: int = 1,
             hub: int = 0) -> State:
        """Go on by some steps of `timeStep`, fewer where the run ends before.

        Parameters
        ----------
        push : displacement of the first sphere in all of them, units; negative values pull. Along the first element,
            or along displacementDirection where the drive of a wire with a material is "displace".
        turn : turn of the first element about its axis in all of them, rad.
            A list of either has a number for each hub, the wire's first: so all move at once.
        steps : number of steps, from 1; push and turn are made in equal parts.
        hub : whose hub push and turn move, along and about its axis: 0 the wire's, k that of catheter k; the others
            rest. Without a hand it says nothing; with lists it is 0.

        Raises
        ------
        SessionError : a value is not allowed, or the run has ended before (`state.outcome`). What a hand steers is not
            ended by `maxSimulationSteps`.
        """
        steps, hub = whole("steps", steps, "1"), whole("hub", hub, "0, the wire's")
        if not isinstance(push, (list, tuple, np.ndarray)) and not isinstance(turn, (list, tuple, np.ndarray)):
            push, turn = number("push", push), number("turn", turn)
            if not isinstance(self._host, Library) or not (1 <= steps < _MOST and 0 <= hub < self.hubs):
                return self._move("step", push=push, turn=turn, steps=steps, hub=hub)
            motion = [0.0] * (2 * hub) + [push, turn]
        else:
            pushes, turns = numbers("push", push, hub, self.hubs), numbers("turn", turn, hub, self.hubs)
            if not isinstance(self._host, Library) or not 1 <= steps < _MOST:
                return self._move("step", push=pushes, turn=turns, steps=steps)
            motion = [one for pair in zip(pushes, turns) for one in pair]
        with self._lock:
            self._leave(keeps=steps > STEPS_AT_ONCE)
            made = self._guarded(lambda host: host.step(motion, steps))
            if isinstance(made, dict):
                return self._take(accepted(made))
            self._state, self._head = None, made
            return self._unread()

    def record(self, frames: int, steps: int = 1) -> Frames:
        """Go on, and keep the state as it is now and after each of some numbers of steps.

        Parameters
        ----------
        frames : number of states beside the present one, from 1; fewer where the run ends before.
        steps : steps between two of them, from 1.

        Raises
        ------
        SessionError : as `step`.
        """
        if isinstance(frames, (bool, np.bool_)) or not isinstance(frames, (int, np.integer)) or frames < 1:
            raise SessionError(f"frames = {frames!r} is not allowed: needs a whole number from 1")
        state = self.state
        times, positions, directors = [state.time], [state.positions], [state.directors]
        while len(times) <= frames and state.outcome is None:
            state = self.step(steps=steps)
            times.append(state.time)
            positions.append(state.positions)
            directors.append(state.directors)
        return Frames(np.array(times), np.stack(positions), np.stack(directors), state.outcome, state.reason)

    def reopen(self, file: str | Path | None = None, hand: bool | None = None, **overrides: Any) -> State:
        """Begin another run in place of this one, with the bits of a new session; arguments, errors and warnings as of
        that. What it has of the same mesh, wherever that is placed, is not read again."""
        with self._lock:
            self._leave()
            return self._open(file, hand, overrides)

    def _open(self, file: str | Path | None, hand: bool | None, overrides: Mapping[str, Any]) -> State:
        asked: dict[str, Any] = {"set": overrides, "hand": hand, "record": self._records_steering}
        if file is not None:
            asked["parameters"] = str(file)
        answer = self._ask("open", **asked)
        self.parameters: Mapping[str, Any] = answer["effective"]
        self.hand: bool = answer["hand"]
        self.hubs = 1 + sum(re.fullmatch(r"catheter\d+", name) is not None for name in answer)
        state = self._take(answer)
        for line in answer["warnings"]:
            warnings.warn(line, stacklevel=3)
        return state

    def reset(self) -> State:
        """Go back to the start."""
        return self._move("reset")

    def change(self, **parameters: Any) -> State:
        """Change parameters, such as `timeStep`, or parts of them, such as `**{"vessel.frictionCoefficient": 0.1}`; the
        wire continues from its current state. What takes the place of an override counts after a `reset` too."""
        return self._change("change", parameters)

    def exchange(self, hub: int, instrument: str | None = None, **parameters: Any) -> State:
        """Put another instrument in the place of one that is withdrawn into the sheath, or, inside another one, into
        the first element of the outermost catheter. Its tip is where that one's was, and the rest goes on.

        Parameters
        ----------
        hub : 0 the wire's, k that of catheter k.
        instrument : name of the new one.
        parameters : of it, as of a catheter: `length` (units) and `elements`; without them as before.

        Raises
        ------
        SessionError : it is in the vessel (the line says how far), does not fit the others, or a value is not allowed.
        """
        hub = whole("hub", hub, "0, the wire's")
        own = {"length": "guidewireLength", "elements": "numberRodElements"}
        if instrument is not None:
            parameters["instrument"] = instrument
        asked = {own.get(name, name) if hub == 0 else f"catheters[{hub - 1}].{name}": value
                 for name, value in parameters.items()}
        return self._change("exchange", asked, hub=hub)

    def _change(self, what: str, parameters: Mapping[str, Any], **more: Any) -> State:
        with self._lock:
            self._leave()
            answer = self._ask(what, set=parameters, **more)
            self.parameters = answer["effective"]
            return self._take(answer)

    def drive_tables(self) -> list[str]:
        """What was steered since the start, as a table for `driveFile` of each hub, the wire's first. Runs that these
        drive have the same bits.

        Raises
        ------
        SessionError : no table says it; the line is `unrecorded`.
        """
        return self._ask("drive")["tables"]

    def save(self) -> bytes:
        """All that the next steps depend on, for `restore` here or in another session of the same parameters."""
        return base64.b64decode(self._ask("save")["snapshot"])

    def restore(self, saved: bytes) -> State:
        """Go on from what was saved: the same steps then give the same bits, but for rounding between walls that are
        meshes and in a sheath that is not along an axis of the scene."""
        if not isinstance(saved, (bytes, bytearray)):
            raise SessionError("restore takes the bytes that save gave")
        return self._move("restore", snapshot=base64.b64encode(saved).decode("ascii"))

    def describe(self) -> dict[str, Any]:
        """What a picture needs to know: "millimetresPerUnit"; "instruments", a list of objects, the wire first:
        "title", "name" (of its file, or ""), "key" that names it, "choices" of other names, and with a number for each
        element "radii", "innerRadii" (units) and "attenuations" (1/unit), "bands" of markers (element, from and to in
        parts of it, and 1/unit by which it attenuates more), and of a material "tipLoad" and "shaftLoad" (N), at which
        the last 10 mm and 50 mm of the shaft bow out; "cells" of the vessel's tree, through which
        contrast agent goes: "middles" (x, y, z of each) and "radii" (units), None without a centreline; "target", the
        centreline from the inlet to it: "name", "reach" (units before it from which on it is reached), "indices" (of
        the centreline's points in anatomy.json), "points" (units), "radii", "distances"; None where the run has none;
        "motions", of each wall the cycles in which it moves, as page/moving.js has them; and "patient", unit vectors to
        the patient's "left", "chest" and "head" and "origin", where the scene's lies in a generic one, mm to the left,
        the back and the head, None where they are unknown."""
        answer = self._ask("describe")
        return {name: answer[name] for name in (
            "millimetresPerUnit", "instruments", "cells", "target", "motions", "patient")}

    def inject(self, amount: float, rate: float, hub: int | None = 0) -> Agent:
        """Begin to inject contrast agent into the blood; an injection that goes on ends. Steps carry it on, and do not
        depend on it; `reset` takes it away.

        Parameters
        ----------
        amount : ml; 0 ends an injection.
        rate : ml/s.
        hub : from whose tip: 0 the wire's, k that of catheter k; None: where the blood comes in, the widest open end.

        Raises
        ------
        SessionError : a value is not allowed, or the vessel has no centreline (`vessel.anatomy`).
        """
        place = {"inlet": True} if hub is None else {"hub": whole("hub", hub, "0, the wire's")}
        return Agent.of(self._ask("agent", amount=number("amount", amount), rate=number("rate", rate), **place))

    def agent(self, seconds: float = 0.0, **flow: float) -> Agent:
        """What contrast agent is where.

        Parameters
        ----------
        seconds : by which the blood goes on first, without a step.
        flow : how blood flows, to begin anew with: inlet (ml/s; that of a mean velocity of 200 mm/s), dispersion
            (coefficient over mean velocity times radius; 1), pulse (amplitude over mean flow; 0), pulseRate (1/s; 1).
            At forks it divides by radii cubed.
        """
        asked = {"flow": {name: number(name, value) for name, value in flow.items()}} if flow else {}
        return Agent.of(self._ask("agent", seconds=number("seconds", seconds), **asked))

    def places(self, positions: np.ndarray) -> list[LumenPlace]:
        """Say where a wire with nodes elsewhere, (f, n+1, 3), units, is in its vessel, for each of f states; an empty
        list where the scene has no inlet."""
        answer = self._ask("places", positions=text_of(np.ascontiguousarray(positions, dtype="<f8")))
        return [LumenPlace.of(row) for row in arrays_of(answer)["lumen"]]

    def walls(self, middle: Sequence[float] | None = None, reach: float | None = None,
              drawn: tuple[Sequence[np.ndarray], Sequence[np.ndarray]] | None = None) -> list[Surface]:
        """The walls as triangles, the vessel first where there is one.

        Parameters
        ----------
        middle : three numbers, units, and
        reach : units: of a wall without end what is so near; without them, as near to the wire as it is long.
        drawn : as of `State.drawn`: vertices of soft walls near a contact are moved with it; None: walls are at rest.
        """
        asked = {"middle": middle, "reach": reach, "positions": None if drawn is None else text_of(in_a_row(*drawn))}
        answer = self._ask("walls", **{name: one for name, one in asked.items() if one is not None})
        block = base64.b64decode(answer["walls"])
        walls, at = [], 0
        while at < len(block):
            corners, sides = np.frombuffer(block, "<i4", 2, at).tolist()
            vertices = np.frombuffer(block, "<f8", 3 * corners, at + 8).reshape(-1, 3).astype(float)
            triangles = np.frombuffer(block, "<i4", 3 * sides, at + 8 + vertices.nbytes).reshape(-1, 3)
            walls.append(Surface(vertices, triangles.astype(int), np.zeros(corners)))
            at += 8 + vertices.nbytes + triangles.nbytes
        return walls

    def picture(self, **view: Any) -> np.ndarray:
        """A fluoroscopic picture of the wire as it is now: grey levels from 0 to 255, (pixels, pixels) of uint8, the
        first row above. Rays are parallel, and turn about the patient as patientAxes says; where it is unknown, as if
        the head was towards +z, the chest towards +x and the left side towards +y.

        Parameters
        ----------
        pixels : of a side (256).
        lao, cranial : angles of the C-arm, degrees (0, 0); RAO and caudal are negative.
        centre : what is in the middle, units, and
        field_of_view : side of the picture, mm: so that the vessel is seen, or without one the wire.
        vessel : "roadmap" (brighter than the background), "contrast" (darker), "none", or "injected": darker where
            there is agent of `inject`.
        contrast : attenuation coefficient of contrast agent, 1/mm (0.1: iodine of 130 mg/ml at 60 keV).
        attenuation : coefficient of the instruments, 1/mm; by their materials.
        background : brightness beside all, from 0 to 1 (0.75).
        noise, seed : standard deviation over brightness, of the background (0), and which of all noises (0).
        blur : standard deviation of the spot, mm (0).

        Raises
        ------
        SessionError : a value is not allowed, or the session is closed; one line.
        """
        return self.picture_of(None, **view)

    def picture_of(self, positions: np.ndarray | Sequence[np.ndarray] | None,
                   wall_displacements: Sequence[np.ndarray] = (), **view: Any) -> np.ndarray:
        """Take a picture as `picture` does, of a wire with nodes elsewhere, (n+1, 3), units; with catheters of a list
        of the wire's and each catheter's, outermost first. Soft walls are at rest, or as `State.drawn` has them."""
        for name, value in view.items():
            if isinstance(value, (float, np.floating)) and not math.isfinite(value):
                raise SessionError(f"{name} = {value} is not allowed: needs a finite number")
        if "field_of_view" in view:
            view["fieldOfView"] = view.pop("field_of_view")
        several = positions if isinstance(positions, (list, tuple)) else [positions]
        nodes = None if positions is None else in_a_row(several, wall_displacements)
        text = json.dumps(view, default=plain)
        if isinstance(self._host, Library):
            made = self._guarded(lambda host: host.picture(text, nodes))
            if isinstance(made, np.ndarray):
                return made
            raise SessionError(accepted(made)["message"])
        answer = self._ask("picture", view=view, positions="" if nodes is None else text_of(nodes))
        grey = np.frombuffer(base64.b64decode(answer["grey"]), dtype=np.uint8)
        return grey.reshape(answer["pixels"], answer["pixels"]).copy()

    def read(self, state: State, part: int) -> None:
        """Read a part of a state of this session off; states ask for it themselves."""
        with self._lock:
            if part not in unread(state):    # another thread has done so
                return
            arrays = self._guarded(lambda host: host.read(part, self._layout))
            if arrays is not None:
                fill(state, part, arrays)
            else:    # other arrays than before
                arrays = self._laid_out(self._ask("state"))
                for other in unread(state):
                    fill(state, other, arrays)
            self._state = state

    def close(self) -> None:
        """End the runner. Nothing but `state` can be asked for afterwards. Steps under way in another thread have ten
        seconds to end; then they raise SessionError."""
        if not self._lock.acquire(timeout=SECONDS_TO_END):
            self.kill()
            self._lock.acquire()
        try:
            if self._host is not None and not self._is_closing:
                self._is_closing = True
                try:
                    self._leave()
                    if isinstance(self._host, Library):    # a step that was interrupted may have come further
                        answer = self._host.last()
                        if answer["exitCode"] == 0 and (self._state is None or self._state.step != answer["step"]):
                            self._take(answer)
                finally:
                    self._host = None
                    self._finish()
        finally:
            self._lock.release()

    def kill(self) -> None:
        """End the runner at once, whatever it is doing; from any thread. A step under way raises SessionError."""
        host = self._host
        if host is not None:
            host.kill()

    def __enter__(self) -> Session:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
                 ) -> None:
        self.close()

    def __reduce__(self) -> NoReturn:
        raise SessionError("a session cannot be pickled: it belongs to this process; send save() and the "
                           "parameters, and open one there")

    def _leave(self, keeps: bool = False) -> None:
        """Before the run goes on: what somebody has of the newest state is read off, for it no longer can be then; all
        of it where the session `keeps` it, for other threads to see during long steps."""
        if self._state is None or unread(self._state):
            newest = self.state if keeps else None
            self._state = None
            newest = newest or self._newest()
            if newest is not None:
                for part in unread(newest):
                    self.read(newest, part)

    def _unread(self) -> State:
        state = unread_state(*self._head, self)
        self._newest = weakref.ref(state)
        return state

    def _move(self, what: str, **more: Any) -> State:
        with self._lock:
            self._leave()
            return self._take(self._ask(what, **more))

    def _ask(self, what: str, **more: Any) -> dict[str, Any]:
        for name, value in more.get("set", {}).items():
            if isinstance(value, float):
                number(name, value)    # JSON has no other ones
        line = json.dumps({"id": 0, "session": what, **more}, default=plain)
        return accepted(self._guarded(lambda host: host.ask(line)))

    def _guarded(self, ask: Callable[[Library | Process], Any]) -> Any:
        with self._lock:
            if self._host is None:
                raise SessionError("this session is closed")
            try:
                return ask(self._host)
            except Ended as end:
                self.close()
                raise SessionError(str(end)) from None
            except BaseException:    # such as Ctrl-C: how far it had come is not known
                self.close()
                raise

    def _take(self, answer: Mapping[str, Any]) -> State:
        self.unrecorded = answer.get("unrecorded", self.unrecorded)
        state = self._state = state_of(answer, self._laid_out(answer), self)
        self._newest = weakref.ref(state)
        return state

    def _laid_out(self, answer: Mapping[str, Any]) -> dict[str, np.ndarray]:
        arrays = arrays_of(answer)
        self._layout = {name: array.shape for name, array in arrays.items()}
        return arrays


def session_of(file: Path, native: bool | None = None) -> Session:
    """A session with the parameters that a run has written, without the warnings shown when it was made."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return Session(file, hand=False, native=native)


def _end(host: Library | Process, process: int) -> None:
    if os.getpid() == process:    # it is not that of a fork
        host.close()
