"""A run steered by one page, while others watch. The runner simulates; this module passes requests and states.

A page says what it wants in short JSON messages, `_DO` below lists them, and receives the run's status as JSON where
that has changed, and each new state as doubles: the number of the page's last message of its hand, the largest size
that each channel has had (so that the scales of all pages agree), then all channels.
"""

from __future__ import annotations

import asyncio
import base64
import json
import math
import os
import re
import time
import warnings
from collections.abc import Awaitable, Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from aiohttp import WSCloseCode, WSMsgType, web

from guidewire.logs.walls import name_walls, soft_walls
from guidewire.sessions.agent import Agent
from guidewire.sessions.session import Session, SessionError, State
from guidewire.viewer.cases import title_of
from guidewire.viewer.held import HeldInstruments, Motion, SteeredCalls
from guidewire.viewer.recording import (
    ENERGIES, HUB, Channel, Recording, ending_of, facts_of, largest_shown, lumen_of, make_channels, radius_of,
    read_off, sheath_of, units_of,
)

PUSH_SPEED = 40.0              # units a second of in-game time, as in the Unity scene
TURN_SPEED = math.radians(180.0)  # rad a second of in-game time
PACES = (0.01, 0.1, 0.5, 1, 2, 5, 10)  # of in-game time against the clock, where the machine is fast enough
ENDLESS = {"maxSimulationSteps": 1_000_000_000, "deltaThreshold": 0}
REST = (0.0, 0.0)
MOST_IN_FLIGHT = 2    # pictures that a page has not shown yet; of further ones it gets the last
MOST_INJECTED = 200.0         # ml, and ml/s
_FRAME = 1.0 / 60.0            # s of in-game time that a picture shows, where the machine is fast enough
_LONGEST = 0.025               # s of wall time that one request may take, so that keys are answered
_BEHIND = 0.1                  # s; what is lost beyond that is not made up for
_LONGEST_WAIT = 1.0            # s of wall time between two steps, however long a step is
_PATIENCE = 3.0                # s that a start anew waits for a step under way, before the runner is ended
_SMOOTHING = 0.1               # weight of the newest request in the step time shown
_CHANGED = ("solver", "integrator", "sweepOrder", "elementContact", "constraintSolverSteps", "stretchStiffness",
            "bendStiffness", "collisionStiffness", "damping", "timeStep",  # as in the Unity scene
            "vessel.motion.heartRate", "vessel.motion.period")
_NOT_ALLOWED = re.compile(r"(?:.*: )?(\w+) = .* is not allowed: (needs .*)", re.DOTALL)


def rules(choices: Mapping[str, list[str]]) -> dict[str, Any]:
    """What a page that simulates by itself (page/run.js) takes from here.

    choices : name to words, of the parameters that are words.
    """
    return {
        "pushSpeed": PUSH_SPEED, "turnSpeed": TURN_SPEED, "paces": PACES, "frame": _FRAME, "longest": _LONGEST,
        "behind": _BEHIND, "longestWait": _LONGEST_WAIT, "patience": _PATIENCE, "mostInFlight": MOST_IN_FLIGHT,
        "smoothing": _SMOOTHING, "endless": ENDLESS, "changed": _CHANGED, "choices": choices, "hub": HUB,
        "energies": ENERGIES,
    }


def start(scene: Path, by_hand: bool, named: Mapping[str, str], records_steering: bool = True) -> Session:
    """Return a session that is steered without end, or the file's own run where that cannot be or is not asked for."""
    if by_hand:
        try:
            return Session(scene, hand=True, native=False, records_steering=records_steering, **ENDLESS, **named)
        except SessionError:
            pass  # what is wrong with the file itself is said below
    return Session(scene, hand=False, native=False, records_steering=records_steering, **named)


def step(session: Session, moves: Motion, steps: int, hub: int) -> State:
    """Make steps with this push (units) and turn (rad) of each hub in each; where one hand rests, of the held one."""
    if all(move == REST for k, move in enumerate(moves) if k != hub):
        push, turn = moves[hub]
        return session.step(push * steps, turn * steps, steps, hub)
    return session.step([push * steps for push, _ in moves], [turn * steps for _, turn in moves], steps)


def refusal(key: str, value: Any, message: str) -> str:
    """Say why a field's new value is refused, for who typed it: which value, and what is allowed.

    Parameters
    ----------
    key, value : of the field.
    message : the runner's line. Where the value does not go with another key, it names that key with its file.
    """
    said = _NOT_ALLOWED.fullmatch(message)
    if said is None:
        return message.removeprefix("set: ")
    named, needs = said.groups()
    asked = f"{key} = {json.dumps(value)}"
    return f"{asked} is not allowed: {needs}" if named == key else f"{asked} does not go with {named}, which {needs}"


def value_at(parameters: Mapping[str, Any], key: str) -> Any:
    """Return the value of a key, or of a member of one such as "vessel.motion.period"; None where there is none."""
    for name in key.split("."):
        parameters = parameters.get(name) if isinstance(parameters, Mapping) else None
    return parameters


class Page:
    """A page that is open."""

    def __init__(self, socket: web.WebSocketResponse) -> None:
        self.socket = socket
        self.on_the_way = 0
        self.waiting: bytes | None = None    # the newest frame, where too many are on the way

    async def tell(self, text: str) -> None:
        """Send a message."""
        await _send(self.socket.send_str(text))

    async def show(self, frame: bytes) -> None:
        """Send a frame, or the newest of several when the page has shown others."""
        if self.on_the_way < MOST_IN_FLIGHT:
            self.on_the_way += 1
            await _send(self.socket.send_bytes(frame))
        else:
            self.waiting = frame

    async def has_shown(self) -> None:
        """The page is ready for one more."""
        self.on_the_way = max(0, self.on_the_way - 1)
        frame, self.waiting = self.waiting, None
        if frame is not None:
            await self.show(frame)

    async def say_goodbye(self) -> None:
        """Close it, as the server ends."""
        await self.socket.close(code=WSCloseCode.GOING_AWAY, message=b"the server has ended")


async def _send(sending: Awaitable[None]) -> None:
    try:
        await sending
    except (ConnectionError, RuntimeError):
        pass  # the page has been closed; its own loop reports that


class LiveFrames:
    """Recording and frames of a session, from its state of now on.

    Attributes
    ----------
    described : as of `Session.describe`.
    """

    def __init__(self, session: Session, title: str, warnings: Sequence[str] = ()) -> None:
        self._session = session
        self._title = title
        self._warnings = list(warnings)
        self._walls = session.walls()
        self.described = session.describe()
        self._sheath = sheath_of(session.parameters, self._numbers(session.state, 0.0))
        self.begin()

    def begin(self) -> None:
        """The state of now is the first one that is shown."""
        self._begun = self._session.state
        self._largest = largest_shown(self._channels(0.0, self._begun))

    def exchange(self) -> None:
        """The same, of other instruments in a run that goes on."""
        before = self._largest
        self.described = self._session.describe()
        self.begin()
        self._largest = np.maximum(before, self._largest)

    def record(self, cost: float) -> Recording:
        """Return the session as it is now and as it began, with its walls.

        Parameters
        ----------
        cost : wall time of a step, s; 0 where it is not known.
        """
        session, state = self._session, self._session.state
        states = [state] if self._begun.step == state.step else [self._begun, state]
        return Recording(
            self._title, "", self._warnings, facts_of(session.parameters, None), radius_of(session.parameters),
            self._channels(cost, *states), name_walls(session.parameters, self._walls), self._sheath, self._largest,
            self.described, soft_walls(session.parameters),
        )

    def frame(self, state: State, cost: float, *head: float) -> bytes:
        """Return a state as doubles: a head, the largest size of each channel so far, and all channels."""
        channels = self._channels(cost, state)
        self._largest = np.maximum(self._largest, largest_shown(channels))
        numbers = np.concatenate([head, self._largest, *(channel.values.ravel() for channel in channels)])
        return numbers.astype("<f8").tobytes()

    def _channels(self, cost: float, *states: State) -> list[Channel]:
        numbers = [self._numbers(state, cost) for state in states]
        together = {name: None if values is None else np.concatenate([one[name] for one in numbers])
                    for name, values in numbers[0].items()}
        return make_channels(units_of(self._session.parameters), together)

    def _numbers(self, state: State, cost: float) -> dict[str, Any]:
        walls = bool(self._walls)
        real_time = float(self._session.parameters["timeStep"]) / cost if cost > 0.0 else math.nan
        return {
            "step": np.array([state.step]), "time": np.array([state.time]), "positions": state.positions[None],
            "orientations": state.orientations[None], "contact_forces": state.contact_forces[None] if walls else None,
            **{f"positions{k + 1}": one.positions[None] for k, one in enumerate(state.catheters)},
            **{f"contact_forces{k + 1}": one.contact_forces[None] for k, one in enumerate(state.catheters) if walls},
            **{f"wall_displacements{k or ''}": own[None] for k, own in enumerate(state.drawn[1])},
            "step_time": np.array([1e3 * cost]), "real_time": np.array([real_time]),
            **{name: None if values is None else values[None]
               for name, values in (("curvature", state.curvature), ("force", state.force), ("couple", state.couple),
                                    ("reaction", state.reaction), ("strand_forces", state.strand_forces))},
            "lumen": lumen_of([state.place]), **read_off(state),
            "vessel_phase": None if state.vessel_phase is None else np.array([state.vessel_phase]),
            "vessel_centreline": None if state.vessel_centreline is None else state.vessel_centreline[None],
        }


class LiveRun:
    """The run that goes on.

    Parameters
    ----------
    scenes : name to parameter file; what a page may open.
    first : name of the one that is opened at first.
    choices : name to words, of the parameters that are words.
    calls : takes down what is steered, in place of the session; it may be read when the run has ended.
    """

    def __init__(self, scenes: Mapping[str, Path], first: str, choices: Mapping[str, list[str]],
                 calls: SteeredCalls | None = None) -> None:
        self._scenes = scenes
        self._scene = first
        self._choices = choices
        self._instruments = HeldInstruments()
        self._calls = calls
        self._pages: list[Page] = []
        self._hand: Page | None = None
        self._session: Session | None = None
        self._frames: LiveFrames | None = None    # of the session
        self._agent: Agent | None = None    # contrast in the vessel, once some was injected
        self._named: dict[str, str] = {}  # instruments by their keys that a page has chosen
        self._exchanges: list[str] = []    # of instruments in this run, in words
        self._exchanges_asked = 0
        self._opened = 0
        self._is_paused = True
        self._is_waiting = False    # paused until somebody steers
        self._steps_asked = 0
        self._hands = [REST, REST]    # push and turn from -1 to 1: of the held instrument, and of the next one
        self._mark = 0
        self._problem = ""
        self._cost = 0.0  # s of wall time a step, smoothed
        self._pace = 1.0
        self._is_over = False
        self._wake: asyncio.Event | None = None
        self._asking = ThreadPoolExecutor(1, "session")

    @property
    def pages(self) -> int:
        """How many are open."""
        return len(self._pages)

    def open(self) -> None:
        """Open the first scene; raises SessionError where it cannot be."""
        self._open(self._scene)

    async def recording(self) -> bytes:
        """The run as it is now and as it began, with its walls."""
        return await self._in_thread(self._record)

    async def go(self) -> None:
        """Step while a page has the hand and does not pause; to be cancelled."""
        self._wake = asyncio.Event()
        due = time.monotonic()
        while True:
            if not self._may_step():
                self._wake.clear()
                await self._wake.wait()
                due = time.monotonic()
                continue
            session = self._session
            dt = float(session.parameters["timeStep"])
            steps = 1 if self._steps_asked else max(1, round(_FRAME / dt))
            if self._cost > 0.0:
                steps = max(1, min(steps, int(_LONGEST / self._cost)))
            steps = 1 << (steps.bit_length() - 1)    # parts of push and turn by a power of two are exact
            self._steps_asked = max(0, self._steps_asked - steps)
            mark = self._mark
            instruments = self._instruments
            hub = instruments.held
            (push, turn), other = [(PUSH_SPEED * push * dt, TURN_SPEED * turn * dt) for push, turn in self._hands]
            turn += instruments.towards_aim(session.state, steps, TURN_SPEED * dt)
            moves = instruments.motion(*(((push, turn), other) if session.hand else (REST, REST)))
            began = time.monotonic()
            try:
                state = await self._in_thread(lambda: step(session, moves, steps, hub))
                if self._agent is not None and self._agent.is_active:
                    agent = await self._in_thread(session.agent)
                    if self._session is session:
                        await self._tell_agent(agent)
                if self._session is session and self._calls is not None:
                    self._calls.add(moves, steps, state)
            except SessionError as error:
                if self._session is session:
                    await self._fail(error)
                continue
            if self._session is not session:    # another scene was opened meanwhile
                continue
            cost = (time.monotonic() - began) / steps
            self._cost = cost if self._cost == 0.0 else self._cost + _SMOOTHING * (cost - self._cost)
            await self._show(mark, state)
            if state.outcome is not None:
                self._is_paused = True
                await self._tell()
            now = time.monotonic()
            due = min(max(due + steps * dt / self._pace, now - _BEHIND), now + _LONGEST_WAIT)
            await self._wait_until(due)

    async def steered_csv(self, number: int) -> str:
        """What was steered of an instrument since the start, as a drive table; raises HTTPConflict, with the reason,
        where none says it, and HTTPNotFound where there is no such instrument."""
        try:
            return (await self._in_thread(self._require_session().drive_tables))[number]
        except SessionError as error:
            raise web.HTTPConflict(text=str(error)) from error
        except IndexError as error:
            raise web.HTTPNotFound() from error

    async def _wait_until(self, due: float) -> None:
        """Until the next step is due, or a page has asked for something that need not wait for it."""
        self._wake.clear()
        with suppress(asyncio.TimeoutError):
            await asyncio.wait_for(self._wake.wait(), max(0.0, due - time.monotonic()))

    async def serve(self, socket: web.WebSocketResponse) -> None:
        """Talk with a page until it goes away. The first has the hand; a page that has it and goes pauses the run."""
        page = Page(socket)
        self._pages.append(page)
        if self._hand is None:
            self._hand = page
        try:
            await self._tell()
            async for message in socket:
                if message.type != WSMsgType.TEXT or not await self._do(page, message.data):
                    await socket.close(code=WSCloseCode.POLICY_VIOLATION, message=b"this page said what no page says")
        finally:
            if self._is_over:
                await page.say_goodbye()  # before this answer ends, which would close it without a word
            self._pages.remove(page)
            if self._hand is page:
                self._hand = None
                self._is_paused = True
                self._hands = [REST, REST]
                self._instruments.aim = None
            await self._tell()

    async def close(self) -> None:
        """End the runner and let go of the pages."""
        self._is_over = True
        for page in list(self._pages):
            await page.say_goodbye()
        await self._in_thread(self._close_session)
        self._asking.shutdown()

    async def _do(self, page: Page, text: str) -> bool:
        """Do what a page asks, or say that it is refused; False for what is no message at all."""
        try:
            message = json.loads(text)
            what = message["do"]
        except (ValueError, KeyError, TypeError, RecursionError):
            return False
        try:
            if what == "shown":
                await page.has_shown()
                return True
            if what == "take":
                self._hand = self._hand or page
            elif self._hand is page:
                await _DO[what](self, message)
        except SessionError as error:
            await self._fail(error)
        except (ValueError, KeyError, TypeError, OverflowError):
            self._problem = f"refused: {json.dumps(what)[:40]} does not go with what stands beside it"
        if self._wake is not None:
            self._wake.set()
        await self._tell()
        return True

    async def _do_hand(self, message: Mapping[str, Any]) -> None:
        hands = [(float(message["push"]), float(message["turn"])),
                 (float(message.get("otherPush", 0.0)), float(message.get("otherTurn", 0.0)))]
        if not all(abs(one) <= 1.0 for hand in hands for one in hand):
            raise ValueError("steering takes push and turn from -1 to 1")
        self._mark = int(float(message["mark"]))    # a frame has it as a number of 64 bits
        self._hands = hands
        if any(map(any, hands)):
            self._begin_at_last()
        if hands[0][1]:
            self._instruments.aim = None

    async def _do_aim(self, message: Mapping[str, Any]) -> None:
        turn = float(message["turn"])
        if not math.isfinite(turn):
            raise ValueError("a hub turns to a number")
        self._instruments.aim = turn
        self._begin_at_last()

    def _begin_at_last(self) -> None:
        """The first push: time runs from here on, unless somebody has paused."""
        if self._is_waiting:
            self._is_waiting = self._is_paused = False

    async def _do_hold(self, message: Mapping[str, Any]) -> None:
        self._instruments.hold(message["instrument"])

    async def _do_inject(self, message: Mapping[str, Any]) -> None:
        amount, rate, hub = float(message["amount"]), float(message["rate"]), message["instrument"]
        if not (0.0 <= amount <= MOST_INJECTED and 0.0 < rate <= MOST_INJECTED) or \
                not (hub is None or type(hub) is int):
            raise ValueError("no such injection")
        session = self._session
        if session is None:
            return    # a key of a page that has not heard yet that the runner is gone
        self._begin_at_last()
        await self._tell_agent(await self._in_thread(lambda: session.inject(amount, rate, hub)))

    async def _do_name(self, message: Mapping[str, Any]) -> None:
        number, name = message["instrument"], message["name"]
        self._require_session()
        key = self._instruments.key_of(number, name)
        await self._stop_step()
        self._problem = ""
        named, by_hand = {**self._named, key: name}, self._session.hand
        await self._in_thread(lambda: self._open(self._scene, by_hand, named))

    async def _do_exchange(self, message: Mapping[str, Any]) -> None:
        number, name = message["instrument"], message["name"]
        key = self._instruments.key_of(number, name)
        session, former = self._require_session(), self._instruments.status()["instruments"][number]
        self._problem, self._exchanges_asked = "", self._exchanges_asked + 1
        try:
            state = await self._in_thread(lambda: session.exchange(number, name))
        except SessionError as error:
            if not session.is_open:
                raise
            self._problem = str(error)    # nothing has changed
            return
        await self._in_thread(self._frames.exchange)
        self._named = {**self._named, key: name}
        self._instruments.exchange(self._frames.described)
        self._spoil("an instrument was exchanged within the run")
        self._exchanges.append(f"at {state.time:.1f} s {name} in place of {former}")
        self._opened += 1
        self._cost = 0.0

    async def _do_pause(self, message: Mapping[str, Any]) -> None:
        self._is_paused, self._is_waiting = bool(message["value"]), False

    async def _do_step(self, _: Mapping[str, Any]) -> None:
        self._is_paused, self._is_waiting = True, False
        self._steps_asked = 1

    async def _do_reset(self, _: Mapping[str, Any]) -> None:
        await self._stop_step()
        if self._session is None or not self._session.is_open:  # it is gone: a new one takes its place
            await self._in_thread(lambda: self._open(self._scene, named=self._named))
        else:
            await self._in_thread(self._session.reset)
            await self._in_thread(self._frames.begin)
            self._begin(self._session, self._instruments.held)
        self._problem = ""

    async def _do_pace(self, message: Mapping[str, Any]) -> None:
        if message["value"] not in PACES:
            raise ValueError("no such pace")
        self._pace = message["value"]

    async def _do_open(self, message: Mapping[str, Any]) -> None:
        scene = message["scene"]
        if scene not in self._scenes:
            raise ValueError("no such scene")
        by_hand = bool(message.get("hand", True))
        await self._stop_step()
        self._problem = ""
        await self._in_thread(lambda: self._open(scene, by_hand))

    async def _do_set(self, message: Mapping[str, Any]) -> None:
        key, value = message["key"], message["value"]
        if key not in _CHANGED or not isinstance(value, (int, float, str)):
            raise ValueError("no parameter that may be changed")
        session = self._require_session()
        self._problem = ""
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        try:
            await self._in_thread(lambda: session.change(**{key: value}))
        except SessionError as error:
            if not session.is_open:
                raise
            self._problem = refusal(key, value, str(error))  # nothing has changed, and the wire goes on
            return
        self._spoil(f"{key} was changed within the run")
        self._cost = 0.0

    def _open(self, scene: str, by_hand: bool = True, named: Mapping[str, str] | None = None) -> None:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            session = start(self._scenes[scene], by_hand, named or {}, self._calls is None)
        self._close_session()
        self._session, self._scene, self._named = session, scene, dict(named or {})
        self._frames = LiveFrames(session, title_of(self._scenes[scene]),
                                  dict.fromkeys(str(one.message) for one in said))
        self._cost = 0.0
        self._begin(session, 0)

    def _begin(self, session: Session, held: int) -> None:
        """The run is at its start, with this hub in the hand."""
        self._is_paused, self._is_waiting = True, session.hand  # nothing is lost while somebody reads
        self._agent = None
        self._exchanges = []
        self._opened += 1
        self._instruments = HeldInstruments(self._frames.described, held)
        if self._calls is not None:
            self._calls.begin()

    def _spoil(self, why: str) -> None:
        if self._calls is not None:
            self._calls.problem = self._calls.problem or why

    def _require_session(self) -> Session:
        if self._session is None:
            raise SessionError("nothing is simulated any more: start anew")
        return self._session

    def _close_session(self) -> None:
        session, self._session = self._session, None
        if session is not None:
            session.close()

    def _record(self) -> bytes:
        if self._session is None:
            raise web.HTTPNotFound()
        return self._frames.record(self._cost).to_bytes()

    def _may_step(self) -> bool:
        return (self._session is not None and self._hand is not None and not self._ended()
                and (not self._is_paused or self._steps_asked > 0))

    def _ended(self) -> bool:
        return self._session is None or self._session.state.outcome is not None

    async def _show(self, mark: int, state: State) -> None:
        block = self._frames.frame(state, self._cost, float(mark), float(self._opened))
        for page in list(self._pages):
            await page.show(block)

    async def _tell_agent(self, agent: Agent) -> None:
        """Tell all pages where contrast agent is."""
        self._agent = agent
        told = {"agent": {
            "parts": base64.b64encode(agent.parts.astype("<f8").tobytes()).decode("ascii"), "injected": agent.injected,
            "held": agent.held, "isActive": agent.is_active, "isInjecting": agent.is_injecting}}
        for page in list(self._pages):
            await page.tell(json.dumps(told))

    async def _tell(self) -> None:
        for page in list(self._pages):
            await page.tell(json.dumps(self._status(page)))

    def _status(self, page: Page) -> dict[str, Any]:
        session = self._session
        values = {} if session is None else {key: value for key in _CHANGED
                                             if (value := value_at(session.parameters, key)) is not None}
        state = None if session is None else session.state
        return {
            "hand": self._hand is page, "isFree": self._hand is None, "isPaused": self._is_paused,
            "isWaiting": self._is_waiting,
            "isSteered": session is not None and session.hand, "opened": self._opened, "scene": self._scene,
            "scenes": list(self._scenes), "titles": [title_of(path) for path in self._scenes.values()],
            "file": os.path.relpath(self._scenes[self._scene]), "problem": self._problem, "values": values,
            "choices": {key: words for key, words in self._choices.items() if key in values},
            "pace": self._pace, "paces": PACES,
            "exchanges": self._exchanges, "exchangesAsked": self._exchanges_asked,
            "steered": self._why_unsaved(), **self._instruments.status(),
            "outcome": "" if state is None else ending_of(state.outcome, state.reliable, state.reason),
        }

    def _why_unsaved(self) -> str:
        if self._session is None:
            return "no run is open"
        return self._session.unrecorded if self._calls is None else "it is recorded as an episode"

    async def _fail(self, error: SessionError) -> None:
        """Say what the runner could not do. One that is gone is let go of."""
        self._problem = str(error)
        self._is_paused = True
        if self._session is not None and not self._session.is_open:
            self._session = None
        await self._tell()

    async def _stop_step(self) -> None:
        """Wait for a step under way; one that takes too long ends with its runner."""
        idle = asyncio.ensure_future(self._in_thread(lambda: None))
        session = self._session
        try:
            await asyncio.wait_for(asyncio.shield(idle), _PATIENCE)
        except asyncio.TimeoutError:
            if session is not None:
                session.kill()
            await idle

    async def _in_thread(self, work: Callable[[], Any]) -> Any:
        """One thing at a time is asked of the runner."""
        return await asyncio.get_running_loop().run_in_executor(self._asking, work)


_DO: Mapping[str, Callable[[LiveRun, Mapping[str, Any]], Awaitable[None]]] = {
    "hand": LiveRun._do_hand, "aim": LiveRun._do_aim, "pause": LiveRun._do_pause, "step": LiveRun._do_step,
    "reset": LiveRun._do_reset,
    "hold": LiveRun._do_hold, "inject": LiveRun._do_inject, "name": LiveRun._do_name,
    "exchange": LiveRun._do_exchange, "pace": LiveRun._do_pace, "open": LiveRun._do_open, "set": LiveRun._do_set,
}
