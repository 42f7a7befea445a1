"""A drive that brings a wire to its target: pushes, and at a wrong branch a new attempt with the hub turned.

The wire is pushed along the vessel's centreline from the inlet, and a snapshot is kept of every few millimetres on the
path to the target. Where the tip enters a branch that does not lead there, or comes no farther, another attempt begins
from one of the snapshots: how far behind the farthest one is drawn, most often little, as are the turn of the hub, and
whether the hub goes on turning while it is pushed. So no progress is lost, and a branch that can be entered only after a
turn far before it is found as well. What is left at the end is one drive without the
failed attempts: a table of time, insertion and rotation that any run can repeat. The draws have a fixed seed: the same
scene has the same drive.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.prepare import DOOR, PreparationError
from guidewire.runs import checking
from guidewire.runs.whole_files import write_whole
from guidewire.sessions.session import Session, SessionError

DRIVE, SCENE = "drive.csv", "steered.json"
_CHUNK = 4.0  # mm pushed between two looks at the tip
_TURN = 0.2  # rad a step, while the wire is not pushed
_ASIDE = 2.0  # of a branch's radii that a tip is in it, from which on the branch is a wrong one
_STALLED = (20.0, 80.0)  # mm pushed without progress, from which on an attempt has failed; drawn for each
_BACK = (4.0, 250.0)  # mm behind the farthest place, where an attempt begins
_ALIKE = 8.0  # mm of the path within which snapshots are as good a start
_IN_VAIN = 120  # attempts without progress, after which the search gives up
_SPIN = 0.15  # rad a mm at most, while the wire is pushed
_SEED = 28


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
class Steered:
    """Whether the target was reached, the attempts at wrong branches, the tip's farthest place on the path to the
    target and that path's length, mm; rows of the drive: time s, insertion m, rotation rad."""

    is_reached: bool
    attempts: int
    farthest: float
    length: float
    rows: list[tuple[float, float, float]]
    tip: Tip | None = None


class Route:
    """The centreline's path from an inlet to a target, mm."""

    def __init__(self, folder: Path, inlet: int, target: int) -> None:
        found = json.loads((folder / "anatomy.json").read_text())
        scale = 1e3 * found["metresPerUnit"]
        line = scale * np.array(found["centreline"]["points"])
        self._points, self._radii = line[:, :3], line[:, 3]
        parents = found["centreline"]["parents"]
        ends = {end["number"]: end["point"] for end in found["ends"]}
        chains = []
        for point in (ends[inlet], ends[target]):
            chain = [point]
            while parents[chain[-1]] >= 0:
                chain.append(parents[chain[-1]])
            chains.append(chain)
        shared = next(k for k in chains[0] if k in set(chains[1]))
        path = chains[0][:chains[0].index(shared) + 1] + chains[1][:chains[1].index(shared)][::-1]
        arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(self._points[path], axis=0), axis=1))]
        self._arc = dict(zip(path, arc))
        self._beside = self._distances(parents, path)
        self.length = float(arc[-1])
        self._near_target = float(self._radii[path[-1]])

    def _distances(self, parents: list[int], path: list[int]) -> np.ndarray:
        """Of each point of the centreline, its distance from the wall of the path's lumen along the tree, mm; negative
        within it."""
        # A branch begins at the wall of the path's lumen, a radius from the path.
        away = np.full(len(parents), np.inf)
        away[path] = -self._radii[path]
        steps = [np.linalg.norm(self._points[k] - self._points[p]) if p >= 0 else 0.0 for k, p in enumerate(parents)]
        is_beside = np.ones(len(parents), bool)
        is_beside[path] = False
        for k in range(len(parents) - 1, 0, -1):  # parents come first
            if is_beside[parents[k]]:
                away[parents[k]] = min(away[parents[k]], away[k] + steps[k])
        for k, parent in enumerate(parents):
            if parent >= 0 and is_beside[k]:
                away[k] = min(away[k], away[parent] + steps[k])
        return away

    def locate(self, tip: np.ndarray) -> tuple[float | None, bool]:
        """Distance of a tip (3,) along the path, None beside it; and whether it is in a wrong branch."""
        near = int(np.argmin(((self._points - tip)**2).sum(axis=1) - self._radii**2))
        return self._arc.get(near), bool(self._beside[near] > _ASIDE * self._radii[near])

    def is_reached(self, along: float | None) -> bool:
        """Whether a distance is within a radius of the target, as the summary counts it."""
        return along is not None and along >= self.length - self._near_target


def with_tip(asked: dict[str, Any], tip: Tip | None) -> dict[str, Any]:
    """A scene's parameters with the end of its last section bent so, and the rest of that section straight."""
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
class _Start:
    """A snapshot that attempts begin from: the tip's distance along the path and the farthest that the attempt had
    reached, mm; the insertion where it had; rows of the drive up to it, the last first."""

    snapshot: bytes
    along: float
    best: float
    since: float
    row: tuple[float, float, float]
    before: _Start | None

    def rows(self) -> list[tuple[float, float, float]]:
        """The drive from the inlet, in time's order."""
        found: list[tuple[float, float, float]] = []
        start: _Start | None = self
        while start is not None:
            found.append(start.row)
            start = start.before
        return found[::-1]


def steer(scene: Path, most_attempts: int = 200, tell: Callable[[str], None] = lambda line: None, tip: Tip | None = None
          ) -> Steered:
    """Find a drive from a scene's inlet to its target.

    Parameters
    ----------
    scene : ``scene.json`` of ``guidewire.py anatomy``.
    most_attempts : after which the search gives up, as it does after 120 in a row that come no farther.
    tell : hears one line for each attempt.
    tip : in place of the scene's own.

    Raises
    ------
    guidewire.sessions.session.SessionError : the scene cannot be used, or has no hub to steer.
    """
    asked = with_tip(json.loads(scene.read_text()), tip)
    route = Route(scene.parent, asked["inlet"], asked["target"])
    dt = asked["timeStep"]
    steps = max(1, round(_CHUNK / (1e3 * asked["insertionSpeed"] * dt)))
    longest = asked["guidewireLength"] - 40.0
    random = np.random.default_rng(_SEED)
    bent = {} if tip is None else {"wireSections": asked["wireSections"]}
    with Session(scene, hand=True, **bent) as session:
        start = _Start(session.save(), 0.0, 0.0, 0.0, (0.0, 0.0, 0.0), None)
        starts, at, attempts = [start], start, 0
        stalled, spin = _STALLED[0], 0.0
        reached, in_vain = 0.0, 0
        while True:
            along, is_wrong = None, False
            if session.state.outcome is None:  # a turn may have ended the run
                session.step(push=_CHUNK, turn=_CHUNK * spin, steps=steps)
                along, is_wrong = route.locate(session.state.positions[-1])
            time, moved, turn = at.row
            row = (time + steps * dt, moved + _CHUNK, turn + _CHUNK * spin)
            is_ahead = along is not None and along > at.best
            best, since = (along, row[1]) if is_ahead else (at.best, at.since)
            ended = session.state.outcome
            at = _Start(b"" if ended else session.save(), at.along if along is None else along, best, since, row, at)
            farthest = max(best, max(one.best for one in starts))
            if route.is_reached(along):
                return Steered(True, attempts, farthest, route.length, at.rows(), tip)
            if not (is_wrong or ended or row[1] >= longest or row[1] - since > stalled):
                starts.append(at)
                continue
            attempts += 1
            in_vain = in_vain + 1 if farthest <= reached else 0
            reached = farthest
            why = "wrong branch" if is_wrong else ended or "no farther"
            tell(f"attempt {attempts}: {why} after {row[1]:.0f} mm, {farthest:.0f} of {route.length:.0f} mm")
            if attempts >= most_attempts or in_vain >= _IN_VAIN:
                return Steered(False, attempts, farthest, route.length, at.rows(), tip)
            back = np.exp(random.uniform(*np.log(_BACK)))
            place = np.array([one.along for one in starts])
            off = np.abs(place - max(0.0, place.max() - back))
            at = starts[int(random.choice(np.flatnonzero(off <= off.min() + _ALIKE)))]
            stalled = random.uniform(*_STALLED)
            spin = random.uniform(-_SPIN, _SPIN) if random.uniform() < 0.5 else 0.0
            session.restore(at.snapshot)
            at = _turned(session, at, random.uniform(-np.pi, np.pi), dt)


def _turned(session: Session, at: _Start, angle: float, dt: float) -> _Start:
    """The same place with the hub turned; the attempt's progress is counted anew."""
    steps = max(1, round(abs(angle) / _TURN))
    session.step(turn=angle, steps=steps)
    time, moved, turn = at.row
    return _Start(b"", at.along, at.along, moved, (time + steps * dt, moved, turn + angle), at)


def write(scene: Path, found: Steered) -> Path:
    """The drive and a scene that follows it, beside the scene given; returns the new scene's file."""
    folder = scene.parent
    write_whole(folder / DRIVE, "time,insertion,rotation\n" + "".join(
        f"{time:.9g},{1e-3 * moved:.9g},{turn:.12g}\n" for time, moved, turn in found.rows))
    asked = with_tip(json.loads(scene.read_text()), found.tip)
    del asked["insertionSpeed"]
    steps = round(found.rows[-1][0] / asked["timeStep"])
    write_whole(folder / SCENE, json.dumps(asked | {"driveFile": DRIVE, "maxSimulationSteps": steps}, indent=2) + "\n")
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
    if not all(isinstance(asked[key], int) for key in ("inlet", "target")):
        raise PreparationError(f"{scene}: inlet and target need to be numbers of ends, as 'anatomy' wrote them")
    try:
        found = None
        for tip in _TIPS if asked.get("wireSections") else (None,):  # an instrument keeps its own tip
            if found is not None:
                print(f"at {found.farthest:.0f} of {found.length:.0f} mm; now with a tip bent by {tip}")
            more = steer(scene, arguments.attempts, print, tip)
            found = max(filter(None, (found, more)), key=lambda one: (one.is_reached, one.farthest))
            if found.is_reached:
                break
    except SessionError as error:
        raise PreparationError(str(error)) from error
    place = (f"{found.attempts} attempts failed; tip bent {f'by {found.tip}' if found.tip else 'as in the scene'}, at "
             f"most at {found.farthest:.0f} of {found.length:.0f} mm")
    if not found.is_reached:
        print(f"target not reached, no drive written: {place}; more --attempts, another --target of 'anatomy', or a "
              "catheter may do")
        return 1
    steered = write(scene, found)
    print(f"target reached: {place}; drive: {os.path.relpath(steered)}")
    code = hand_to([*command, "-parameters", str(steered), "-out", str(out), "-force"])
    if code:
        return code
    is_reached = bool(json.loads((out / "summary.json").read_text(encoding="utf-8"))["centreline"]["reached"])
    print(f"in the run of this drive the target is {'' if is_reached else 'not '}reached")
    return 0 if is_reached else 1
