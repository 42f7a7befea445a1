"""A drive that brings a wire to its target: pushes, and at a wrong branch a new attempt with the hub turned.

The wire is pushed along the vessel's centreline from the inlet, and a snapshot is kept of every few millimetres on the
path to the target. Where the tip enters a branch that does not lead there, or comes no farther, another attempt begins
from one of the snapshots: how far behind the farthest one is drawn, most often little, as are the turn of the hub, and
whether the hub goes on turning while it is pushed. So no progress is lost, and a branch that can be entered only after
a turn far before it is found as well. What is left at the end is one drive without the
failed attempts: a table of time, insertion and rotation for each hub, which any run repeats with the same bits. So that
this holds, a drive that was found is made once more from the start, without a snapshot; where it does not reach the
target then, the search goes on from there. The draws have a fixed seed: the same scene has the same drive.

A catheter follows the wire: its tip is pushed on whenever it is farther behind the wire's than 30 mm.
"""

from __future__ import annotations

import argparse
import itertools
import json
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from guidewire.prepare import DOOR, PreparationError
from guidewire.runs import checking
from guidewire.runs.whole_files import write_whole
from guidewire.sessions.session import LumenPlace, Session, SessionError

DRIVES, SCENE = ("drive.csv", "drive-catheter.csv", "drive-catheter-2.csv"), "steered.json"
_CHUNK = 4.0  # mm pushed between two looks at the tip
_TURN = 0.2  # rad a step, while the wire is not pushed
_ASIDE = 2.0  # of a branch's radii that a tip is in it, from which on the branch is a wrong one
_STALLED = (20.0, 80.0)  # mm pushed without progress, from which on an attempt has failed; drawn for each
_BACK = (4.0, 250.0)  # mm behind the farthest place, where an attempt begins
_ALIKE = 8.0  # mm of the path within which snapshots are as good a start
_IN_VAIN = 120  # attempts without progress, after which the search gives up
_ELEMENT = 5.0  # mm of a wire's body, by which it is made longer
_SPIN = 0.15  # rad a mm at most, while the wire is pushed
_SEED = 28
_BEHIND = 30.0  # mm that a catheter's tip is behind the wire's
_LAST, _SLIVER = 6.0, 0.4  # radii before the target in which its branch is looked at; of its radius: no end of it
_SHOWN = 10.0  # s between two lines on what is tried


@dataclass(frozen=True)
class Tip:
    """A bend at rest at the end of a wire, as one shapes it by hand: angle, degrees, and length, mm, at most that of
    the wire's last section."""

    angle: float
    length: float

    def __str__(self) -> str:
        return f"{self.angle:g} degrees over {self.length:g} mm"


_TIPS = (None, Tip(45.0, 5.0), Tip(105.0, 30.0), Tip(70.0, 10.0), Tip(120.0, 10.0))  # None: the scene's own


@dataclass(frozen=True)
class Found:
    """Whether the target was reached, the attempts at wrong branches, the tip's farthest place on the path to the
    target and that path's length, mm; the scene's parameters with the tip; a drive table for each hub, and their steps;
    lines on the catheters; why the target is likely not to be reached; parameters in place of the scene's."""

    is_reached: bool
    attempts: int
    farthest: float
    length: float
    asked: dict[str, Any]
    tables: list[str]
    steps: int
    tip: Tip | None = None
    catheters: tuple[str, ...] = ()
    reason: str = ""
    changes: Mapping[str, Any] = field(default_factory=dict)


class Route:
    """The centreline's path from an inlet to a target, mm.

    Parameters
    ----------
    target : as of `Session.describe`.
    anatomy : of the vessel, with its parents, as anatomy.json has it.
    unit : length of the session's unit, mm.
    """

    def __init__(self, target: Mapping[str, Any], anatomy: Mapping[str, Any], unit: float) -> None:
        self._unit = unit
        self.length = unit * target["distances"][-1]
        path = target["indices"]
        self._on_path = set(path)
        line = 1e3 * anatomy["metresPerUnit"] * np.array(anatomy["centreline"]["points"])
        self._radii, self._path = line[:, 3], line[path]
        self._beside = self._distances(line, anatomy["centreline"]["parents"], path)

    @staticmethod
    def _distances(line: np.ndarray, parents: list[int], path: list[int]) -> np.ndarray:
        """Return of each point of the centreline its distance from the wall of the path's lumen along the tree, mm;
        negative within it."""
        # A branch begins at the wall of the path's lumen, a radius from the path.
        away = np.full(len(parents), np.inf)
        away[path] = -line[path, 3]
        steps = [np.linalg.norm(line[k, :3] - line[p, :3]) if p >= 0 else 0.0 for k, p in enumerate(parents)]
        is_beside = np.ones(len(parents), bool)
        is_beside[path] = False
        for k in range(len(parents) - 1, 0, -1):  # parents come first
            if is_beside[parents[k]]:
                away[parents[k]] = min(away[parents[k]], away[k] + steps[k])
        for k, parent in enumerate(parents):
            if parent >= 0 and is_beside[k]:
                away[k] = min(away[k], away[parent] + steps[k])
        return away

    def reason(self, farthest: float, wire: float) -> str:
        """Return what is likely at fault where a wire of a radius, mm, came so far along the path and no farther."""
        arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(self._path[:, :3], axis=0), axis=1))]
        radii = self._path[:, 3]
        widest = radii[arc > arc[-1] - _LAST * radii.max()].max()
        is_inner = (arc > widest) & (arc < arc[-1] - widest)    # at a closed end the sphere has no radius
        if is_inner.any() and radii[is_inner].min() < wire:
            at = int(np.flatnonzero(is_inner)[radii[is_inner].argmin()])
            return (f"the lumen is too narrow: {arc[at]:.0f} mm from the inlet its radius is {radii[at]:.2g} mm, the "
                    f"wire's {wire:.2g} mm")
        last = radii[arc > arc[-1] - 0.5 * widest].max()
        if last < _SLIVER * widest:
            return (f"the target lies in a sliver of radius {last:.2g} mm of a branch of {widest:.2g} mm: another "
                    "--target of 'anatomy'")
        if farthest < min(0.1 * self.length, _LAST * radii.max()):
            return "the wire did not come away from its inlet: another --inlet of 'anatomy', or --any-inlet"
        if farthest > self.length - 2.0 * widest:
            return "the tip came within two radii of the target: its end is where the lumen closes"
        return "more --attempts, another --target of 'anatomy', --any-inlet, or a catheter may do"

    def locate(self, place: LumenPlace) -> tuple[float | None, bool]:
        """Distance of a place along the path, None beside it; and whether it is in a wrong branch."""
        along = self._unit * place.distance if place.near in self._on_path else None
        return along, bool(self._beside[place.near] > _ASIDE * self._radii[place.near])


def with_tip(asked: dict[str, Any], tip: Tip | None) -> dict[str, Any]:
    """Return a scene's parameters with the end of its last section bent so, and the rest of that section straight."""
    if tip is None:
        return asked
    *others, last = asked["wireSections"]
    length = last["to"] - last["from"]
    bent = min(tip.length, length)
    count = last["numberRodElements"]
    own = min(count, max(1, round(count * bent / length)))
    curved = last | {"from": last["to"] - bent, "numberRodElements": own, "restCurvature": [
        -np.radians(tip.angle) / (1e-3 * bent), 0.0, 0.0]}
    straight = {key: value for key, value in last.items() if key != "restCurvature"} | {
        "to": last["to"] - bent, "numberRodElements": count - own}
    return asked | {"wireSections": [*others, *([straight] if own < count else []), curved]}


@dataclass(frozen=True)
class _Call:
    """Steps of a session: whose hub, push (units) and turn (rad) in each, and how many."""

    hub: int
    push: float
    turn: float
    steps: int


@dataclass(frozen=True)
class _Start:
    """A snapshot that attempts begin from: the tip's distance along the path and the farthest that the attempt had
    reached, mm; the insertion where it had, and now, mm; the call that led there, and what was before it."""

    snapshot: bytes
    along: float
    best: float
    since: float
    moved: float
    call: _Call | None
    before: _Start | None

    def calls(self) -> list[_Call]:
        """Return the drive from the inlet, in time's order."""
        found: list[_Call] = []
        start: _Start | None = self
        while start is not None:
            if start.call is not None:
                found.append(start.call)
            start = start.before
        return found[::-1]


class _Search:
    """Attempts in one session."""

    def __init__(self, session: Session, asked: Mapping[str, Any], tell: Callable[[str], None], until: float) -> None:
        self._session, self._tell, self._until = session, tell, until
        described = session.describe()
        self._unit = described["millimetresPerUnit"]
        if described["target"] is None or session.state.place is None:
            raise SessionError(f"the scene has no target: needs the scene.json that '{DOOR} anatomy' wrote")
        anatomy = json.loads(Path(session.parameters["vessel"]["anatomy"]).read_text(encoding="utf-8"))
        self.route = Route(described["target"], anatomy, self._unit)
        dt = asked["timeStep"]
        self._steps = max(1, round(_CHUNK / (1e3 * asked["insertionSpeed"] * dt)))
        self._push = _CHUNK / self._unit / self._steps
        self._longest = self._unit * asked["guidewireLength"] - 40.0
        self._random = np.random.default_rng(_SEED)
        self._first = _Start(session.save(), 0.0, 0.0, 0.0, 0.0, None, None)
        self.attempts, self.farthest = 0, 0.0
        self._began, self._shown = time.monotonic(), time.monotonic()

    def find(self, most_attempts: int) -> _Start | None:
        """Return a start at the target whose calls lead there from the inlet; None where the search gave up."""
        starts, at = [self._first], self._first
        stalled, spin = _STALLED[0], 0.0
        reached, in_vain = 0.0, 0
        while True:
            at, why = self._pushed(at, spin, stalled)
            self.farthest = max(at.best, max(one.best for one in starts))
            if why == "reached":
                again = self._again(at.calls())
                if again[-1] is None:
                    return again[-2]
                starts = [one for one in again if one is not None]
                at, why = starts[-1], "missed when it was made once more"
            elif not why:
                starts.append(at)
                continue
            self.attempts += 1
            in_vain = in_vain + 1 if self.farthest <= reached else 0
            reached = self.farthest
            self._say(f"attempt {self.attempts}: {why} after {at.moved:.0f} mm", is_due=True)
            if self.attempts >= most_attempts or in_vain >= _IN_VAIN or time.monotonic() > self._until:
                return None
            back = np.exp(self._random.uniform(*np.log(_BACK)))
            place = np.array([one.along for one in starts])
            off = np.abs(place - max(0.0, place.max() - back))
            at = starts[int(self._random.choice(np.flatnonzero(off <= off.min() + _ALIKE)))]
            stalled = self._random.uniform(*_STALLED)
            spin = self._random.uniform(-_SPIN, _SPIN) if self._random.uniform() < 0.5 else 0.0
            self._session.restore(at.snapshot)
            at = self._turned(at, self._random.uniform(-np.pi, np.pi))

    def _pushed(self, at: _Start, spin: float, stalled: float) -> tuple[_Start, str]:
        """After a push by a few millimetres, and why the attempt ends there: "reached", or a failure, or nothing."""
        along, is_wrong, is_outside, is_reached = None, False, False, False
        if self._session.state.outcome is None:  # a turn may have ended the run
            at = self._made(at, _Call(0, self._push, _CHUNK * spin / self._steps, self._steps))
            while self._session.state.outcome is None and self._gap() > _BEHIND + _CHUNK:
                at = self._made(at, _Call(1, self._push, 0.0, self._steps))
            place = self._session.state.place
            along, is_wrong = self.route.locate(place)
            is_outside, is_reached = not place.is_inside, place.is_at_target
        is_ahead = along is not None and along > at.best
        ended = self._session.state.outcome
        best, since = (along, at.moved) if is_ahead else (at.best, at.since)
        at = replace(at, snapshot=b"" if ended else self._session.save(), along=at.along if along is None else along,
                     best=best, since=since)
        self._say(f"at {best:.0f} mm")
        return at, ("reached" if is_reached else "wrong branch" if is_wrong else ended or (
            "left the vessel" if is_outside and at.moved > 2.0 * _CHUNK else
            "no farther" if at.moved >= self._longest or at.moved - since > stalled else ""))

    def _gap(self) -> float:
        """Return how far a catheter's tip is behind the wire's, mm; nothing where there is none."""
        catheters = self._session.state.catheters
        return 1e3 * catheters[0].extension if catheters else 0.0

    def _made(self, at: _Start, call: _Call) -> _Start:
        self._session.step(push=call.push * call.steps, turn=call.turn * call.steps, steps=call.steps, hub=call.hub)
        moved = at.moved + (self._unit * call.push * call.steps if call.hub == 0 else 0.0)
        return _Start(b"", at.along, at.best, at.since, moved, call, at)

    def _turned(self, at: _Start, angle: float) -> _Start:
        """Return the same place with the hub turned; the attempt's progress is counted anew."""
        steps = max(1, round(abs(angle) / _TURN))
        at = self._made(at, _Call(0, 0.0, angle / steps, steps))
        return replace(at, best=at.along, since=at.moved)

    def _again(self, calls: list[_Call]) -> list[_Start | None]:
        """Return a drive made from the start: what it came to after each call, and None behind it where that is the
        target."""
        self._session.reset()
        made: list[_Start | None] = [self._first]
        for call in calls:
            at = self._made(made[-1], call)
            if self._session.state.outcome is not None:
                break
            place = self._session.state.place
            along, is_wrong = self.route.locate(place)
            if is_wrong:
                break
            best = at.best if along is None else max(at.best, along)
            made.append(replace(at, snapshot=self._session.save(), along=at.along if along is None else along,
                                best=best, since=at.moved if best > at.best else at.since))
            if place.is_at_target:
                return [*made, None]
        return made

    def _say(self, line: str, is_due: bool = False) -> None:
        now = time.monotonic()
        if is_due or now - self._shown > _SHOWN:
            self._shown = now
            self._tell(f"{(now - self._began) / 60.0:.1f} min: {line}, {self.farthest:.0f} of "
                       f"{self.route.length:.0f} mm")


def steer(scene: Path, most_attempts: int = 200, tell: Callable[[str], None] = lambda line: None,
          tip: Tip | None = None, minutes: float = np.inf, changes: Mapping[str, Any] = {}) -> Found:
    """Find a drive from a scene's inlet to its target.

    Parameters
    ----------
    scene : ``scene.json`` of ``guidewire.py anatomy``.
    most_attempts : after which the search gives up, as it does after 120 in a row that come no farther.
    tell : hears one line for each attempt, and every ten seconds.
    tip : in place of the scene's own.
    minutes : of wall time, after which the search gives up at the next failed attempt.
    changes : parameters in place of the scene's.

    Raises
    ------
    SessionError : the scene cannot be used, or has no hub to steer.
    """
    asked = with_tip(json.loads(scene.read_text(encoding="utf-8")) | changes, tip)
    bent = {} if tip is None else {"wireSections": asked["wireSections"]}
    with Session(scene, hand=True, records_steering=True, **(changes | bent)) as session:
        asked = session.parameters | {"insertionSpeed": asked["insertionSpeed"]}
        search = _Search(session, asked, tell, time.monotonic() + 60.0 * minutes)
        found = search.find(most_attempts)
        tables: list[str] = []
        steps, lines = 0, ()
        if found is not None:
            session.reset()
            for call in found.calls():
                session.step(push=call.push * call.steps, turn=call.turn * call.steps, steps=call.steps, hub=call.hub)
            tables, steps = session.drive_tables(), session.state.step
            lines = tuple(f"catheter {k}: tip {'in the lumen' if one.place.is_inside else 'outside'}, "
                          f"{search._unit * one.place.left:.0f} mm before the target"
                          + (", reached" if one.place.is_at_target else "")
                          for k, one in enumerate(session.state.catheters, 1) if one.place is not None)
        wire = search._unit * asked["wireRadius"]
        return Found(found is not None, search.attempts, search.farthest, search.route.length, asked, tables, steps,
                     tip, lines, search.route.reason(search.farthest, wire), changes)


def other_inlets(asked: Mapping[str, Any], anatomy: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the parameters of the same wire at each other end of a vessel, the widest first, longer where its way to
    the target is.

    anatomy : of the vessel, as anatomy.json has it.
    """
    line = 1e3 * anatomy["metresPerUnit"] * np.array(anatomy["centreline"]["points"])
    pairs = np.array([*((k, p) for k, p in enumerate(anatomy["centreline"]["parents"]) if p >= 0),
                      *anatomy["centreline"].get("links", [])])
    steps = np.maximum(np.linalg.norm(line[pairs[:, 0], :3] - line[pairs[:, 1], :3], axis=1), 1e-9)
    ends = {str(end["number"]): end for end in anatomy["ends"]} | {end["name"]: end for end in anatomy["ends"]}
    inlet, target = (ends.get(str(asked[name])) for name in ("inlet", "target"))
    if inlet is None or target is None:
        return []
    away = dijkstra(coo_matrix((steps, pairs.T), shape=(len(line), len(line))), directed=False, indices=target["point"])
    found = []
    for end in sorted(anatomy["ends"], key=lambda one: -one["radius"]):
        if end in (inlet, target):
            continue
        count = max(0, int(np.ceil(1.15 * (away[end["point"]] - away[inlet["point"]]) / _ELEMENT)))
        more = count * _ELEMENT
        sections = [one | {"from": one["from"] + more, "to": one["to"] + more} for one in asked.get("wireSections", [])]
        found.append({"inlet": end["number"], "guidewireLength": asked["guidewireLength"] + more,
                      "numberRodElements": asked["numberRodElements"] + count,
                      **({"wireSections": sections} if sections else {})})
    return found


def write(scene: Path, found: Found) -> Path:
    """Return the drives and a scene that follows them, beside the scene given; returns the new scene's file."""
    folder = scene.parent
    for name, table in zip(DRIVES, found.tables):
        write_whole(folder / name, table)
    asked = with_tip(json.loads(scene.read_text(encoding="utf-8")) | found.changes, found.tip)
    asked.pop("insertionSpeed", None)
    catheters = [{key: value for key, value in one.items() if key not in ("insertionSpeed", "rotationSpeed")}
                 | {"driveFile": name} for one, name in zip(asked.get("catheters") or [], DRIVES[1:])]
    asked |= {"driveFile": DRIVES[0], "maxSimulationSteps": found.steps}
    write_whole(folder / SCENE, json.dumps(asked | ({"catheters": catheters} if catheters else {}), indent=2) + "\n")
    return folder / SCENE


def run(arguments: argparse.Namespace, build: Callable[[], list[str]], hand_to: Callable[[list[str]], int]) -> int:
    """`guidewire.py steer`: find the drive, write it, run it; returns the exit code, 1 where the target is not reached.

    Parameters
    ----------
    build : builds the runner and returns its command.
    hand_to : runs a command on the terminal and returns its exit code.

    Raises
    ------
    PreparationError : one line, for a scene that cannot be steered.
    """
    scene = arguments.file
    checking.check_file(scene)
    out = arguments.out or Path("results") / f"{scene.resolve().parent.name}-steered"
    checking.check_out(out)
    command = build()
    try:
        asked = json.loads(scene.read_text(encoding="utf-8"))
    except ValueError as error:
        raise PreparationError(f"{scene}: is no JSON: {error}") from error
    missing = [key for key in ("inlet", "target", "insertionSpeed", "timeStep", "guidewireLength") if key not in asked]
    if missing:
        raise PreparationError(f"{scene}: has no {missing[0]}: needs the scene.json that '{DOOR} anatomy' wrote")
    try:
        found, until = None, time.monotonic() + 60.0 * arguments.minutes
        tips = _TIPS if asked.get("wireSections") else (None,)  # an instrument keeps its own tip
        inlets: list[dict[str, Any]] = [{}]
        if arguments.any_inlet:
            if asked.get("catheters"):
                raise PreparationError("--any-inlet is of a wire alone: the scene has a catheter")
            anatomy = json.loads((scene.parent / asked["vessel"]["anatomy"]).read_text(encoding="utf-8"))
            inlets += other_inlets(asked, anatomy)
        for changes, tip in itertools.product(inlets, tips):
            if found is not None:
                print(f"at {found.farthest:.0f} of {found.length:.0f} mm; now "
                      + (f"from end {changes['inlet']} " if changes else "")
                      + (f"with a tip bent by {tip}" if tip else "with the scene's tip"))
            left = (until - time.monotonic()) / 60.0
            if left <= 0.0 and found is not None:
                break
            more = steer(scene, arguments.attempts, lambda line: print(line, flush=True), tip, left, changes)
            found = max(filter(None, (found, more)), key=lambda one: (one.is_reached, one.farthest / one.length))
            if found.is_reached:
                break
    except SessionError as error:
        raise PreparationError(str(error)) from error
    place = (f"{found.attempts} attempts failed; " + (f"from end {found.changes['inlet']}; " if found.changes else "")
             + f"tip bent {f'by {found.tip}' if found.tip else 'as in the scene'}, at "
             f"most at {found.farthest:.0f} of {found.length:.0f} mm")
    if not found.is_reached:
        print(f"target not reached, no drive written: {place}; {found.reason}")
        return 1
    steered = write(scene, found)
    for line in found.catheters:
        print(line)
    print(f"target reached: {place}; drive: {os.path.relpath(steered)}")
    code = hand_to([*command, "-parameters", str(steered), "-out", str(out), "-force"])
    if code:
        return code
    is_reached = bool(json.loads((out / "summary.json").read_text(encoding="utf-8"))["centreline"]["reached"])
    print(f"in the run of this drive the target is {'' if is_reached else 'not '}reached")
    return 0 if is_reached else 1
