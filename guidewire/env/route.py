"""The route along a vessel's centreline to a target: remaining distance, and the next point."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from guidewire.env.spaces import Error

if TYPE_CHECKING:
    from guidewire.anatomy.motion import GivenVessel, VesselMotion
    from guidewire.sessions.session import State


class Placement(NamedTuple):
    """How a scene places its vessel: units; degrees about z, then x, then y; a factor."""

    position: np.ndarray
    rotation: np.ndarray    # (3, 3)
    scale: float

    @staticmethod
    def of(parameters: Mapping[str, Any]) -> Placement:
        """Make the route of a session's effective parameters.

        Raises
        ------
        Error : the three axes are not scaled alike, and so no sphere in the vessel stays one.
        """
        position, rotation, scale = (np.array(_three(parameters.get(key, default)), dtype=float) for key, default in (
            ("position", [0.0] * 3), ("rotation", [0.0] * 3), ("scale", [1.0] * 3)))
        if not (scale == scale[0]).all() or scale[0] <= 0.0:
            raise Error(f"scale = {scale.tolist()} is not allowed here: needs one factor above 0 for all three axes")
        return Placement(position, _matrix(rotation), float(scale[0]))

    @property
    def is_none(self) -> bool:
        """Whether all stays where it is."""
        return self.scale == 1.0 and not self.position.any() and np.array_equal(self.rotation, np.eye(3))

    def points(self, points: np.ndarray) -> np.ndarray:
        """Return points (n, 3) as they are placed."""
        return self.scale * points @ self.rotation.T + self.position


class Route:
    """It leads from every point of a vessel to one target along the centreline.

    Parameters
    ----------
    anatomy : what `guidewire.py anatomy` writes into anatomy.json.
    target : name or number of an end, or {"end": this, "before": a distance before it}; or name of a branch and the
        distance from its beginning.
    unit : the anatomy's numbers times this are units of the scene.
    placement : of the vessel in the scene; None: as it is.

    Raises
    ------
    Error : the vessel has no such end or branch; the line lists those that there are.

    Attributes
    ----------
    left : (n,), of each point of the centreline the way to the target, units.
    until_end : (n,), the way to the nearest end downstream, units.
    is_beyond : (n,), whether it is downstream of the target.

    Notes
    -----
    A point p belongs to the sphere of the centreline with the least |p - c|^2 - r^2, as in the runner's summary. Of a
    vessel that moves or gives way p and the centreline are those at rest.
    """

    motion: VesselMotion | None = None
    _bent: np.ndarray | None = None    # centreline of a vessel that gives way, as of a state
    _given: GivenVessel | None = None

    def __init__(self, anatomy: Mapping[str, Any], target: str | int | Sequence[Any] | Mapping[str, Any],
                 unit: float = 1.0, placement: Placement | None = None) -> None:
        try:
            line = anatomy["centreline"]
            numbers = unit * np.array(line["points"], dtype=float).reshape(-1, 4)
            parents = np.array(line["parents"], dtype=int)
        except (KeyError, TypeError, ValueError) as error:
            raise Error("an anatomy needs a centreline of points and parents, as the command anatomy writes it"
                        ) from error
        before = 0.0
        if isinstance(target, Mapping):
            if set(target) != {"end", "before"} or not _is_number(target["before"]) or target["before"] < 0.0:
                raise Error(f"target = {target!r} is not allowed: needs \"end\" and \"before\", a number from 0")
            target, before = target["end"], target["before"]
        self.target = _index_of(anatomy, target, numbers[:, :3])
        while before > 0.0 and parents[self.target] >= 0:
            before -= math.dist(numbers[self.target, :3], numbers[parents[self.target], :3])
            self.target = int(parents[self.target])
        if before > 0.0:
            raise Error(f"target = {target!r} is not allowed: the way to this end is {before:.4g} units shorter")
        self.points, self._radii = np.ascontiguousarray(numbers[:, :3]), numbers[:, 3]
        self.widest = float(self._radii.max())
        has_child = np.zeros(len(parents), dtype=bool)
        has_child[parents[parents >= 0]] = True
        self._outlets = {int(k): self.points[k] - self.points[parents[k]] for k in np.flatnonzero(~has_child)
                         if parents[k] >= 0}
        self.until_end = np.full(len(parents), np.inf)    # to the nearest end downstream
        self.is_beyond = np.zeros(len(parents), dtype=bool)    # of the target
        self.until_end[list(self._outlets)] = 0.0
        spans = np.linalg.norm(self.points - self.points[np.maximum(parents, 0)], axis=1)
        self._downstream = self.points - self.points[np.maximum(parents, 0)]
        for root in np.flatnonzero(parents < 0):
            self._downstream[root] = self.points[int(np.argmax(parents == root))] - self.points[root]
        self._downstream /= np.maximum(np.linalg.norm(self._downstream, axis=1), 1e-300)[:, None]
        for k in range(len(parents) - 1, 0, -1):    # children come after their parents
            self.until_end[parents[k]] = min(self.until_end[parents[k]], self.until_end[k] + spans[k])
        for k in range(1, len(parents)):    # which do not go on upstream of a root
            self.is_beyond[k] = parents[k] == self.target or self.is_beyond[parents[k]]
        self._power = np.einsum("ij,ij->i", self.points, self.points) - self._radii**2
        self.next = parents.copy()
        self.next[self.target] = self.target
        chain = [self.target]
        while parents[chain[-1]] >= 0:
            chain.append(int(parents[chain[-1]]))
        for before, after in zip(chain[1:], chain):    # from the root to the target the tree's direction is turned
            self.next[before] = after
        on_chain = np.zeros(len(parents), dtype=bool)
        on_chain[chain] = True
        steps = self.points[self.next] - self.points
        self._lengths = np.linalg.norm(steps, axis=1)
        self._steps = steps / np.maximum(self._lengths, 1e-300)[:, None]
        self.left = np.zeros(len(parents))
        for k in (*chain[1:], *np.flatnonzero(~on_chain)):    # parents come before their children
            self.left[k] = self.left[self.next[k]] + self._lengths[k]

        if placement is not None and not placement.is_none:
            self._move(placement)

    def placed(self, placement: Placement, motion: VesselMotion | None = None) -> Route:
        """Return the way where a scene places the vessel, and as it moves; this one is of the vessel as it is."""
        if placement.is_none and motion is None:
            return self
        moved = copy.copy(self)
        moved.motion = motion
        if not placement.is_none:
            moved._move(placement)
        return moved

    @property
    def target_position(self) -> np.ndarray:
        """(3,), units, where it is now."""
        return self.moved(self.points[self.target][None])[0]

    def follow(self, state: State) -> None:
        """Take the vessel as it is in a state: one that moves, or gives way as a beam."""
        if self.motion is not None:
            self.motion.set_time(state.time)
        line, before = state.vessel_centreline, self._bent
        self._bent = line
        if line is not None and (before is None or not np.array_equal(before[:, :3], line[:, :3])):
            from guidewire.anatomy.motion import GivenVessel    # needs scipy

            self._given = GivenVessel(line[:, :3])

    @property
    def is_moving(self) -> bool:
        """Whether the vessel moves or gives way."""
        return self.motion is not None or self._bent is not None

    def moved(self, points: np.ndarray) -> np.ndarray:
        """Return where points (n, 3) of the vessel at rest are now."""
        if self._bent is not None:
            points = self._given.moved(points, self._bent[:, 3:])
        return points if self.motion is None else self.motion.moved(points)

    def _belongs(self, point: np.ndarray) -> tuple[int, np.ndarray]:
        """Return the centreline's point that a point (3,) belongs to, and where that is at rest."""
        point = point if self.motion is None else self.motion.at_rest(point[None])[0][0]
        point = point if self._bent is None else self._given.at_rest(point[None], self._bent[:, 3:])[0]
        return int(np.argmin(self._power - 2.0 * (self.points @ point))), point

    def _move(self, placement: Placement) -> None:
        scale, turn = placement.scale, placement.rotation.T
        self.points = np.ascontiguousarray(placement.points(self.points))
        self._radii, self._lengths = scale * self._radii, scale * self._lengths
        self.left, self.until_end, self.widest = scale * self.left, scale * self.until_end, scale * self.widest
        self._steps, self._downstream = self._steps @ turn, self._downstream @ turn
        self._outlets = {k: scale * one @ turn for k, one in self._outlets.items()}
        self._power = np.einsum("ij,ij->i", self.points, self.points) - self._radii**2

    def place(self, point: np.ndarray) -> tuple[int, float]:
        """Return the centreline's point that a point (3,) belongs to, and the distance that is left from there,
        units."""
        index, point = self._belongs(point)
        along, length = float((point - self.points[index]) @ self._steps[index]), float(self._lengths[index])
        return index, float(self.left[index]) - min(max(along, -length), length)

    def has_left(self, point: np.ndarray) -> bool:
        """Return whether a point (3,) is beyond one of the ends but the first, in whose sphere its place is."""
        index, point = self._belongs(point)
        return bool(index in self._outlets and (point - self.points[index]) @ self._outlets[index] > 0.0)

    def until_outlet(self, point: np.ndarray) -> float:
        """Return how far it is from a point (3,) along the centreline to the nearest open end downstream, units."""
        index, point = self._belongs(point)
        return float(self.until_end[index] - (point - self.points[index]) @ self._downstream[index])

    def ahead(self, index: int, distance: float) -> np.ndarray:
        """Return the centreline's point (3,) that is so much nearer to the target, units, or the target."""
        goal = self.left[index] - distance
        while index != self.target and self.left[index] > goal:
            index = int(self.next[index])
        return self.moved(self.points[index][None])[0]


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _three(value: Any) -> list[float]:
    return [value[axis] for axis in "xyz"] if isinstance(value, Mapping) else list(value)


def _matrix(degrees: np.ndarray) -> np.ndarray:
    """Return the rotation by Euler angles about z, then x, then y."""
    x, y, z = np.radians(degrees).tolist()
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, math.cos(x), -math.sin(x)], [0.0, math.sin(x), math.cos(x)]])
    about_y = np.array([[math.cos(y), 0.0, math.sin(y)], [0.0, 1.0, 0.0], [-math.sin(y), 0.0, math.cos(y)]])
    about_z = np.array([[math.cos(z), -math.sin(z), 0.0], [math.sin(z), math.cos(z), 0.0], [0.0, 0.0, 1.0]])
    return about_y @ about_x @ about_z


def _index_of(anatomy: Mapping[str, Any], target: str | int | Sequence[Any], points: np.ndarray) -> int:
    if isinstance(target, (str, int)) and not isinstance(target, bool):
        wanted = str(target).strip().lower()
        for end in anatomy["ends"]:
            if wanted in (str(end["number"]), end["name"].lower()):
                return end["point"]
        listed = ", ".join(f"{end['number']} '{end['name']}'" for end in anatomy["ends"])
        raise Error(f"target = {target!r} is not allowed: the vessel has the ends {listed}")
    is_depth = isinstance(target, (list, tuple)) and len(target) == 2 and isinstance(target[0], str)
    if not is_depth or not _is_number(target[1]):
        raise Error(f"target = {target!r} is not allowed: needs a name or number of an end, or a branch and a distance")
    name, depth = target
    names = anatomy["centreline"]["names"]
    if name not in names:
        raise Error(f"target = {target!r} is not allowed: the vessel has the branches {', '.join(names)}")
    of_branch = np.flatnonzero(np.array(anatomy["centreline"]["branches"]) == names.index(name) + 1)
    arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points[of_branch], axis=0), axis=1))]
    if not 0.0 <= depth <= arc[-1]:
        raise Error(f"target = {target!r} is not allowed: {name} is {arc[-1]:.4g} units long")
    return int(of_branch[np.argmin(np.abs(arc - depth))])
