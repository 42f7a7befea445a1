"""The route along a vessel's centreline to a target: remaining distance, and the next point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from guidewire.env.spaces import Error


class Route:
    """From every point of a vessel to one target along the centreline.

    Parameters
    ----------
    anatomy : what `guidewire.py anatomy` writes into anatomy.json.
    target : name or number of an end; or name of a branch and the distance from its beginning.
    unit : the anatomy's numbers times this are units of the scene.

    Raises
    ------
    Error : the vessel has no such end or branch; the line lists those that there are.

    Notes
    -----
    A point p belongs to the sphere of the centreline with the least |p - c|^2 - r^2, as in the runner's summary.
    """

    def __init__(self, anatomy: Mapping[str, Any], target: str | int | Sequence[Any], unit: float = 1.0) -> None:
        try:
            line = anatomy["centreline"]
            numbers = unit * np.array(line["points"], dtype=float).reshape(-1, 4)
            parents = np.array(line["parents"], dtype=int)
        except (KeyError, TypeError, ValueError) as error:
            raise Error("an anatomy needs a centreline of points and parents, as the command anatomy writes it"
                        ) from error
        self.points, self._radii = np.ascontiguousarray(numbers[:, :3]), numbers[:, 3]
        self.widest = float(self._radii.max())
        self.target = _index_of(anatomy, target, self.points)
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
        for k in chain[1:]:
            self.left[k] = self.left[self.next[k]] + self._lengths[k]
        for k in np.flatnonzero(~on_chain):    # parents come before their children
            self.left[k] = self.left[self.next[k]] + self._lengths[k]

    def place(self, point: np.ndarray) -> tuple[int, float]:
        """The centreline's point that a point (3,) belongs to, and the distance that is left from there, units."""
        index = int(np.argmin(self._power - 2.0 * (self.points @ point)))
        along, length = float((point - self.points[index]) @ self._steps[index]), float(self._lengths[index])
        return index, float(self.left[index]) - min(max(along, -length), length)

    def ahead(self, index: int, distance: float) -> np.ndarray:
        """The centreline's point (3,) that is so much nearer to the target, units, or the target."""
        goal = self.left[index] - distance
        while index != self.target and self.left[index] > goal:
            index = int(self.next[index])
        return self.points[index]


def _index_of(anatomy: Mapping[str, Any], target: str | int | Sequence[Any], points: np.ndarray) -> int:
    if isinstance(target, (str, int)):
        wanted = str(target).strip().lower()
        for end in anatomy["ends"]:
            if wanted in (str(end["number"]), end["name"].lower()):
                return end["point"]
        listed = ", ".join(f"{end['number']} '{end['name']}'" for end in anatomy["ends"])
        raise Error(f"target = {target!r} is not allowed: the vessel has the ends {listed}")
    name, depth = target
    names = anatomy["centreline"]["names"]
    if name not in names:
        raise Error(f"target = {target!r} is not allowed: the vessel has the branches {', '.join(names)}")
    of_branch = np.flatnonzero(np.array(anatomy["centreline"]["branches"]) == names.index(name) + 1)
    arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points[of_branch], axis=0), axis=1))]
    if not 0.0 <= depth <= arc[-1]:
        raise Error(f"target = {target!r} is not allowed: {name} is {arc[-1]:.4g} units long")
    return int(of_branch[np.argmin(np.abs(arc - depth))])
