"""The state of a session's run at one time, with the hub, the catheters and the energies."""

from __future__ import annotations

import base64
import math
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from guidewire.quantities import CATHETER, LUMEN, WIRE, Quantity

if TYPE_CHECKING:
    from guidewire.sessions.session import Session

# Parts of a state, each read off once something of it is asked for.
MOTION, INSTRUMENTS, STRAINS = PARTS = range(3)
_STRAINS = ("curvature", "couple", "strain", "force", "energy")
_DIGITS = "0123456789"  # of a catheter, behind the name of an array of its own


@cache
def snake(name: str) -> str:
    """Return the name of an attribute for a name of the table of quantities."""
    return "".join("_" + letter.lower() if letter.isupper() else letter for letter in name)


_IN_ANSWERS: dict[str, list[Quantity]] = {}    # the quantities of each array, in their order
for _row in (*WIRE, *(row for row in CATHETER if row.answer == "catheter"), *LUMEN):
    if _row.answer is not None:
        _IN_ANSWERS.setdefault(_row.answer, []).append(_row)
_KINDS = {"whole": int, "flag": bool}
_OPTIONAL = ("length_in_body",)    # beside whole numbers
# How many numbers a row of an array has: of one that is for the run all of them.
_COLUMNS = {name: sum(row.width for row in rows) for name, rows in _IN_ANSWERS.items()}
_PART_OF = {**{snake(name): rows[0].part for name, rows in _IN_ANSWERS.items()},
            "catheters": INSTRUMENTS, "place": INSTRUMENTS}


class SessionError(Exception):
    """A session cannot do what it was asked for. The message is one line."""


def _no_session(_: object = None) -> None:
    """Of a state that has left its session behind."""


@dataclass(frozen=True)
class Hub:
    """What is read off at the hub and at the tip of a wire with a material, in SI units but for tip_position.

    Attributes
    ----------
    insertion, turn : displacement of the hub along its axis and rotation about it since the start, m and rad.
    force, torque : of the hub on the wire along and about its axis, N and N m; a push is positive.
    tip_position, tip_direction : (3,), units, and a unit vector.
    twist : of the wire from hub to tip, rad.
    largest_curvature : of any joint, rad/m.
    length_in_body, spheres_in_body : what is out of the sheath, m and spheres; None without a sheath.
    """

    insertion: float
    turn: float
    force: float
    torque: float
    tip_position: np.ndarray
    tip_direction: np.ndarray
    twist: float
    largest_curvature: float
    length_in_body: float | None
    spheres_in_body: int | None


@dataclass(frozen=True)
class LumenPlace:
    """Where an instrument has come to in its vessel: the last point of it, seen from the hub, up to which it has not
    left the lumen. Of a tip that left by an end that is a point near the end, wherever the tip goes outside.

    Attributes
    ----------
    is_inside : whether the tip is in the lumen, and all of the instrument between the inlet and it.
    is_at_target : whether the place is within a radius of the target along the centreline, or beyond it.
    near : number, from 0, of the centreline's point to whose sphere it belongs, as in anatomy.json.
    branch : the branch there, from 0.
    distance, left : from the inlet and to the target along the centreline, units; nan without a target.
    point : (3,), units.
    """

    is_inside: bool
    is_at_target: bool
    near: int
    branch: int
    distance: float
    left: float
    point: np.ndarray

    @staticmethod
    def of(numbers: np.ndarray) -> LumenPlace:
        """Make it from a row of the array "lumen"."""
        return LumenPlace(**_members("lumen", numbers))


@dataclass(frozen=True)
class CatheterState:
    """A catheter over the wire at one moment; m rod elements. SI units but for positions and tip_position.

    Attributes
    ----------
    positions : (m+1, 3), units.
    orientations : (m, 4), quaternions x, y, z, w of the rod elements.
    insertion, turn, force, torque, tip_position, tip_direction : as of `Hub`, of its own hub and tip.
    extension : how far the tip of what is inside is beyond its own, m; negative inside.
    overlap : length over which that is inside, m.
    place : in the vessel; None where the scene has no inlet.
    contact_forces, velocities, angular_velocities : (m+1, 3), (m+1, 3) and (m, 3), as of `State`.
    strand_forces, wall_displacements : (m+1, 3) and (m, 3), as of `State`.
    """

    positions: np.ndarray
    orientations: np.ndarray
    insertion: float
    turn: float
    force: float
    torque: float
    tip_position: np.ndarray
    tip_direction: np.ndarray
    extension: float
    overlap: float
    place: LumenPlace | None
    contact_forces: np.ndarray
    velocities: np.ndarray
    angular_velocities: np.ndarray
    strand_forces: np.ndarray | None
    wall_displacements: np.ndarray | None


@dataclass(frozen=True)
class Energy:
    """Energies of a wire with a material, J.

    Attributes
    ----------
    kinetic, elastic : of its motion, and stored in it.
    potential : of gravity and of the loads that have one.
    """

    kinetic: float
    elastic: float
    potential: float


@dataclass(frozen=True, repr=False)
class State:
    """The wire at one moment; n rod elements, n + 1 spheres. All arrays are of float64 and the caller's own. With the
    native library they are read when first accessed, or before the next step if the state is still referenced: a state
    always describes its own moment.

    Attributes
    ----------
    step, time : steps done, and in-game time in s.
    outcome, reason, reliable : how the run ended, why, and whether its result can be trusted, as in summary.json; None,
        "" and None while it goes on. Steps after the end change nothing.
    prediction_error : Delta_p of the last step, units; with a material from free flight.
    positions, velocities : (n+1, 3), units and units/s.
    orientations : (n, 4), quaternions x, y, z, w of the rod elements.
    angular_velocities : (n, 3), rad/s, in each element's own frame.
    contact_forces : (n+1, 3), force of the walls on each sphere in the last step, mass unit * unit/s^2, with a material
        N; 0 where there are no walls. Of instruments in one another the outermost one has it.
    reaction : (3,), force of the held first sphere on the wire in the last step; with a material of its support, N.
        None where the method does not state it (xpbd, and gains without walls).
    strand_forces : (n+1, 3), force of the wire's other strands on each sphere, N; None where it does not touch itself.
    wall_displacements : (n, 3), how far soft walls are displaced at each element, m; None where all are rigid.
    curvature, couple : (n+1, 3), of a material: rad/m about d1, d2 and d3 at each joint, and N m; else None.
    strain, force : (n, 3), of a material: shear and stretch of each element, and force in it, N; else None.
    energy : of a material, J: of its motion, stored in it, and of the loads that have a potential; else None.
    hub : of solver direct, what is read off at hub and tip; else None.
    catheters : those over the wire, outermost first.
    place : of the wire in the vessel; None where the scene has no inlet.
    vessel_phase, vessel_displacement : phase of the first cycle of a vessel that moves, 0 to 1, and how far it is
        displaced at the wire's tip, (3,), units; None where it stands still.
    vessel_centreline : (m, 6), points at rest of the centreline of a vessel that gives way as a beam, and their
        displacements, units; None where it does not.
    """

    step: int
    time: float
    outcome: str | None
    reason: str
    reliable: bool | None
    prediction_error: float
    positions: np.ndarray
    velocities: np.ndarray
    orientations: np.ndarray
    angular_velocities: np.ndarray
    contact_forces: np.ndarray
    reaction: np.ndarray | None
    strand_forces: np.ndarray | None
    wall_displacements: np.ndarray | None
    curvature: np.ndarray | None
    couple: np.ndarray | None
    strain: np.ndarray | None
    force: np.ndarray | None
    energy: Energy | None
    hub: Hub | None
    catheters: tuple[CatheterState, ...]
    place: LumenPlace | None
    vessel_phase: float | None
    vessel_displacement: np.ndarray | None
    vessel_centreline: np.ndarray | None
    _session: ClassVar[Callable[..., Session | None]] = _no_session

    def picture(self, **view: Any) -> np.ndarray:
        """Return a fluoroscopic picture of this moment: grey levels from 0 to 255, (pixels, pixels) of uint8. `view` is
        as of `Session.picture`.

        Raises
        ------
        SessionError : as `Session.picture`; or the state has left its session behind (closed, or copied to another
            process).
        """
        return self.session.picture_of(*self.drawn, **view)

    @property
    def session(self) -> Any:
        """Return the session that it is a state of. Raises SessionError where it has left that behind."""
        session = self._session()
        if session is None:
            raise SessionError("this state has no session that could take a picture")
        return session

    @property
    def drawn(self) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Positions of the wire and of each catheter, and their `wall_displacements`, none of rigid walls."""
        displaced = [self.wall_displacements, *(one.wall_displacements for one in self.catheters)]
        return ([self.positions, *(one.positions for one in self.catheters)],
                [one for one in displaced if one is not None])

    def __getattr__(self, name: str) -> Any:
        part = _PART_OF.get(name)
        session = None if part is None else self._session()
        if session is None:
            raise AttributeError(f"a state has no {name}")
        session.read(self, part)
        return vars(self)[name]

    def __repr__(self) -> str:
        end = "" if self.outcome is None else f", {self.outcome}"
        return f"State(step {self.step}, {self.time:g} s, {len(self.orientations)} elements{end})"

    def __getstate__(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @property
    def directors(self) -> np.ndarray:
        """(n, 3, 3): d1, d2 and d3 of each rod element, unit vectors in the world's axes; d3 along the element."""
        return directors_of(self.orientations)

    def start(self) -> dict[str, Any]:
        """Return what the key ``start`` takes and a startFile holds, for a run that begins where this one is."""
        needs_hub = self.hub is not None and (self.catheters or self.hub.length_in_body is not None)
        return _start_of(self, self.hub if needs_hub else None) | (
            {"catheters": [_start_of(one, one) for one in self.catheters]} if self.catheters else {})


@dataclass(frozen=True)
class Frames:
    """A run at several times.

    Attributes
    ----------
    times : (f,), s.
    positions : (f, n+1, 3), units.
    directors : (f, n, 3, 3), as `State.directors` has them.
    outcome, reason : those of the last state; a run that ended early has fewer frames.
    """

    times: np.ndarray
    positions: np.ndarray
    directors: np.ndarray
    outcome: str | None
    reason: str


def _start_of(one: State | CatheterState, hub: Hub | CatheterState | None) -> dict[str, Any]:
    start: dict[str, Any] = {
        "positions": one.positions.tolist(), "orientations": one.orientations.tolist(),
        "velocities": one.velocities.tolist(), "angularVelocities": one.angular_velocities.tolist()}
    return start | ({"hub": {"insertion": hub.insertion, "turn": hub.turn}} if hub else {})


def directors_of(orientations: np.ndarray) -> np.ndarray:
    """Return (n, 3, 3): the images of the three axes under (n, 4) unit quaternions x, y, z, w, one a row."""
    x, y, z, w = np.asarray(orientations, dtype=float).T
    rows = [[1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
            [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
            [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), 2, 0)


def arrays_of(answer: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Return the arrays of an answer of the runner or the library, by their names."""
    columns = {name: _COLUMNS.get(name.rstrip(_DIGITS)) for name in answer}
    return {name: np.frombuffer(base64.b64decode(answer[name]), dtype="<f8").reshape(-1, width).astype(float)
            for name, width in columns.items() if width is not None}


def part_of(array: str) -> int:
    """Which part of a state an array of an answer belongs to."""
    return INSTRUMENTS if array[-1] in _DIGITS else _IN_ANSWERS[array][0].part


def unread_state(step: int, time: float, prediction_error: float, session: Session) -> State:
    """Return the state of a session whose run goes on, of which nothing else has been read off. Until all of it is, it
    keeps its session."""
    state = object.__new__(State)
    vars(state).update(step=step, time=time, outcome=None, reason="", reliable=None, prediction_error=prediction_error,
                       _session=lambda: session)    # not a part of what it says
    return state


def state_of(answer: Mapping[str, Any], arrays: Mapping[str, np.ndarray], session: Session) -> State:
    """Return the state of a session that an answer and its arrays say."""
    state = unread_state(answer["step"], answer["time"], answer["predictionError"], session)
    vars(state).update(outcome=answer["outcome"], reason=answer["message"], reliable=answer.get("reliable"))
    for part in PARTS:
        fill(state, part, arrays)
    return state


def fill(state: State, part: int, arrays: Mapping[str, np.ndarray]) -> None:
    """Give a state a part of it."""
    if part == MOTION:
        positions = arrays["positions"]
        vars(state).update(
            positions=positions, velocities=arrays["velocities"], orientations=arrays["orientations"],
            angular_velocities=arrays["angularVelocities"],
            contact_forces=arrays["contactForces"] if "contactForces" in arrays else np.zeros_like(positions),
            reaction=arrays["reaction"][0] if "reaction" in arrays else None,
            strand_forces=arrays.get("strandForces"), wall_displacements=arrays.get("wallDisplacements"))
    elif part == INSTRUMENTS:
        vars(state).update(hub=Hub(**_members("hub", arrays["hub"][0])) if "hub" in arrays else None,
                           catheters=_catheters(arrays), place=_place(arrays, ""),
                           vessel_phase=float(arrays["vesselPhase"][0, 0]) if "vesselPhase" in arrays else None,
                           vessel_displacement=arrays.get("vesselDisplacement", [None])[0],
                           vessel_centreline=arrays.get("vesselCentreline"))
    else:
        vars(state).update({name: arrays.get(name) for name in _STRAINS},
                           energy=Energy(*arrays["energy"][0].tolist()) if "energy" in arrays else None)
    if not unread(state):
        vars(state)["_session"] = weakref.ref(state._session())


def unread(state: State) -> list[int]:
    """Return the parts of a state that have not been read off."""
    return [part for part, name in ((MOTION, "positions"), (INSTRUMENTS, "hub"), (STRAINS, "strain"))
            if name not in vars(state)]


def _catheters(arrays: Mapping[str, np.ndarray]) -> tuple[CatheterState, ...]:
    catheters = []
    while (positions := arrays.get(f"positions{len(catheters) + 1}")) is not None:
        number = str(len(catheters) + 1)
        own = {snake(row.name): arrays.get(row.name + number) for row in CATHETER if row.answer == row.name}
        if own["contact_forces"] is None:
            own["contact_forces"] = np.zeros_like(positions)
        catheters.append(CatheterState(place=_place(arrays, number), **own,
                                       **_members("catheter", arrays["catheter" + number][0])))
    return tuple(catheters)


def _place(arrays: Mapping[str, np.ndarray], number: str) -> LumenPlace | None:
    numbers = arrays.get(f"lumen{number}")
    return None if numbers is None else LumenPlace.of(numbers[0])


def _members(array: str, numbers: np.ndarray) -> dict[str, Any]:
    """Return the quantities of a row of an array by the names of attributes; None for what a run does not have."""
    members: dict[str, Any] = {}
    for name, where, kind, may_be_none in _members_of(array):
        own = numbers[where]
        members[name] = None if may_be_none and math.isnan(own) else own if kind is None else kind(own)
    return members


@cache
def _members_of(array: str) -> list[tuple[str, Any, type | None, bool]]:
    """Return of each quantity its attribute, its place in a row, its type, None of several numbers, and whether it may
    be None."""
    members, at = [], 0
    for row in _IN_ANSWERS[array]:
        name = snake(row.summary or row.name)
        if row.width > 1:
            members.append((name, slice(at, at + row.width), None, False))
        else:
            members.append((name, at, _KINDS.get(row.type, float), row.type == "whole" or name in _OPTIONAL))
        at += row.width
    return members
