"""A drive that brings a wire to its target: pushes, and at a wrong branch a new attempt with the hub turned.

The wire is pushed along the vessel's centreline from the inlet. Where the tip enters a branch that does not lead to the
target, or comes no farther, the run goes back to a snapshot before that place, farther with every few attempts; the hub
is turned by the next multiple of the golden angle, which never repeats, and the wire is pushed again. What is left at
the end is one drive without the failed attempts: a table of time, insertion and rotation that any run can repeat.
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

from experiments import checking
from experiments.prepare import PreparationError
from experiments.session import Session, SessionError
from experiments.whole_files import write_whole

DRIVE, SCENE = "drive.csv", "steered.json"
_CHUNK = 4.0  # mm pushed between two looks at the tip
_TURN = 0.2  # rad a step
_GOLDEN = np.pi * (3.0 - np.sqrt(5.0))
_ASIDE = 2.0  # of a branch's radii that a tip is in it, from which on the branch is a wrong one
_STALLED = 30.0  # mm pushed without progress, from which on an attempt has failed
_BACK = (12.0, 30.0, 60.0, 110.0, 180.0)  # mm of insertion that attempts go back, four attempts each
_ATTEMPTS_EACH = 4
_BENT_MORE = 2.3  # curvature of the second tip, over the scene's: 105 degrees in place of 45


@dataclass(frozen=True)
class Steered:
    """Whether the target was reached, the attempts at wrong branches, the tip's farthest place on the path to the
    target and that path's length, mm; rows of the drive: time s, insertion m, rotation rad."""

    is_reached: bool
    attempts: int
    farthest: float
    length: float
    rows: list[tuple[float, float, float]]
    tip: float = 1.0


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


def with_tip(asked: dict[str, Any], tip: float) -> dict[str, Any]:
    """A scene's parameters with so many times the curvature of its sections at rest."""
    sections = [section | {"restCurvature": [tip * value for value in section["restCurvature"]]}
                if "restCurvature" in section else section for section in asked.get("wireSections", [])]
    return asked | {"wireSections": sections}


def steer(scene: Path, most_attempts: int = 80, tell: Callable[[str], None] = lambda line: None, tip: float = 1.0
          ) -> Steered:
    """Find a drive from a scene's inlet to its target.

    Parameters
    ----------
    scene : ``scene.json`` of ``guidewire.py anatomy``.
    most_attempts : after which the search gives up.
    tell : hears one line for each attempt.
    tip : curvature of the tip at rest over that of the scene.

    Raises
    ------
    experiments.session.SessionError : the scene cannot be used, or has no hub to steer.
    """
    asked = with_tip(json.loads(scene.read_text()), tip)
    route = Route(scene.parent, asked["inlet"], asked["target"])
    step = 1e3 * asked["insertionSpeed"] * asked["timeStep"]  # mm
    longest = asked["guidewireLength"] - 40.0
    with Session(scene, hand=True, wireSections=asked["wireSections"]) as session:
        rows = [(0.0, 0.0, 0.0)]
        kept = [(session.save(), tuple(rows[0]))]  # snapshots and the row of the drive at each
        attempts, farthest, tried, stuck_at = 0, 0.0, 0, 0.0
        best, since = 0.0, 0.0  # of this attempt: farthest place, mm, and the insertion at which it was reached
        while True:
            state = session.state
            if state.outcome is None:  # a turn may have ended the run
                steps = max(1, round(_CHUNK / step))
                state = session.step(push=_CHUNK, steps=steps)
                time, way, turn = rows[-1]
                rows.append((time + steps * asked["timeStep"], way + _CHUNK, turn))
            along, is_wrong = route.locate(state.positions[-1])
            if along is not None and along > best:
                best, since = along, rows[-1][1]
                farthest = max(farthest, best)
            if route.is_reached(along):
                return Steered(True, attempts, farthest, route.length, rows, tip)
            has_failed = (is_wrong or state.outcome is not None or rows[-1][1] >= longest
                          or rows[-1][1] - since > _STALLED)
            if not has_failed:
                kept.append((session.save(), rows[-1]))
                continue
            attempts += 1
            why = "wrong branch" if is_wrong else state.outcome or "no farther"
            tell(f"attempt {attempts}: {why} after {rows[-1][1]:.0f} mm, {farthest:.0f} of {route.length:.0f} mm")
            if attempts >= most_attempts:
                return Steered(False, attempts, farthest, route.length, rows, tip)
            if farthest > stuck_at + 10.0:
                stuck_at, tried = farthest, 0
            back = _BACK[min(tried // _ATTEMPTS_EACH, len(_BACK) - 1)]
            tried += 1
            limit = max(0.0, since - back)
            while len(kept) > 1 and kept[-1][1][1] > limit:
                kept.pop()
            saved, row = kept[-1]
            session.restore(saved)
            rows = [one for one in rows if one[0] <= row[0]]
            angle = (_GOLDEN * attempts + np.pi) % (2.0 * np.pi) - np.pi
            steps = max(1, round(abs(angle) / _TURN))
            session.step(turn=angle, steps=steps)
            rows.append((row[0] + steps * asked["timeStep"], row[1], row[2] + angle))
            best, since = route.locate(session.state.positions[-1])[0] or 0.0, rows[-1][1]


def write(scene: Path, found: Steered) -> Path:
    """The drive and a scene that follows it, beside the scene given; returns the new scene's file."""
    folder = scene.parent
    write_whole(folder / DRIVE, "time,insertion,rotation\n" + "".join(
        f"{time:.9g},{1e-3 * way:.9g},{turn:.12g}\n" for time, way, turn in found.rows))
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
        raise PreparationError(f"{scene}: has no {missing[0]}: needs the scene.json that 'guidewire.py anatomy' wrote")
    if not all(isinstance(asked[key], int) for key in ("inlet", "target")):
        raise PreparationError(f"{scene}: inlet and target need to be numbers of ends, as 'anatomy' wrote them")
    try:
        found = steer(scene, arguments.attempts, print)
        if not found.is_reached:
            print(f"with this tip at {found.farthest:.0f} of {found.length:.0f} mm; now with a tip that is bent more")
            more = steer(scene, arguments.attempts, print, _BENT_MORE)
            found = max(found, more, key=lambda one: (one.is_reached, one.farthest))
    except SessionError as error:
        raise PreparationError(str(error)) from error
    place = (f"{found.attempts} attempts failed; tip, {found.tip:g} times as bent as in the scene, at most at "
             f"{found.farthest:.0f} of {found.length:.0f} mm")
    if not found.is_reached:
        print(f"target not reached, no drive written: {place}")
        return 1
    steered = write(scene, found)
    print(f"target reached: {place}; drive: {os.path.relpath(steered)}")
    code = hand_to([*command, "-parameters", str(steered), "-out", str(out), "-force"])
    if code:
        return code
    is_reached = bool(json.loads((out / "summary.json").read_text(encoding="utf-8"))["centreline"]["reached"])
    print(f"in the run of this drive the target is {'' if is_reached else 'not '}reached")
    return 0 if is_reached else 1
