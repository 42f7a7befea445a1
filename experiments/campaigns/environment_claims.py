"""What an episode of an environment claims, against the states that were seen, by geometry of its own.

The vessel's wall are the triangles that the session has placed, searched by ray parity; the way to the target is found
in the graph of anatomy.json, placed by scipy.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial.transform import Rotation

from analysis.passages import Wall
from analysis.wall_search import MeshSearch
from guidewire.anatomy.motion import motion_of
from guidewire.env import Environment
from guidewire.env.recorded import digest_of
from guidewire.logs.paths import lengths_of, through_tips
from guidewire.sessions.session import State

_EVERY = 5  # states of which the geometry is searched, beside the last
_SAME = 1e-9  # relative, of sums
_IN_TREE = 1.05  # of a sphere's radius, for tips that count as in it
_BROKEN = 1.05  # of a hub's limit: forces beyond it end an episode and are not taken in
_SURE = 0.5  # of radius and tolerance, for tips that are at the target without doubt


class Way:
    """Which points of a vessel's centreline are how far from a target.

    Parameters
    ----------
    environment : whose episode has begun.
    draw : numbers of its anatomy and its target.
    """

    def __init__(self, environment: Environment, draw: Mapping[str, Any]) -> None:
        task, scene, given = environment.task, environment.scene, environment.session.parameters
        file = scene["vessel"]["anatomy"] if task.random or not task.scene else task.anatomies[draw["anatomy"]]
        self.anatomy = json.loads(Path(file).read_text())
        unit = self.anatomy["metresPerUnit"] / given["metresPerUnit"]
        x, y, z = given["rotation"]
        self.turn, self.scale = Rotation.from_euler("YXZ", [y, x, z], degrees=True), unit * given["scale"][0]
        self.shift = np.array(given["position"])
        line = self.anatomy["centreline"]
        numbers, parents = np.array(line["points"], dtype=float), np.array(line["parents"])
        own = np.flatnonzero(parents >= 0)
        lengths = unit * np.linalg.norm(numbers[own, :3] - numbers[parents[own], :3], axis=1)
        tree = coo_matrix((lengths, (own, parents[own])), shape=(len(parents),) * 2).tocsr()
        target = task.targets[draw["target"]]
        if isinstance(target, Mapping) or not isinstance(target, (list, tuple)):
            name, before = (target["end"], target["before"]) if isinstance(target, Mapping) else (target, 0.0)
            end, = (end for end in self.anatomy["ends"] if name in (end["number"], end["name"]))
            chain = [end["point"]]
            while parents[chain[-1]] >= 0:
                chain.append(int(parents[chain[-1]]))
            along = dijkstra(tree, directed=False, indices=end["point"])[chain]
            self.target = chain[int(np.argmax(along >= before - 1e-9))]
        else:
            of_branch = np.flatnonzero(np.array(line["branches"]) == line["names"].index(target[0]) + 1)
            along = dijkstra(tree, directed=False, indices=of_branch[0])[of_branch]
            self.target = int(of_branch[np.argmin(np.abs(along - target[1]))])
        stretch = given["scale"][0]
        self.left = stretch * dijkstra(tree, directed=False, indices=self.target)
        self.points, self.radii = self.placed(numbers[:, :3]), self.scale * numbers[:, 3]
        self.spacing = stretch * float(lengths.max())
        self.motion = motion_of(given)

    def at_rest(self, state: State) -> list[np.ndarray]:
        """Say where the nodes of the wire and of each catheter are on the vessel at rest."""
        nodes = [one.positions for one in _each(state)]
        if self.motion is None:
            return nodes
        self.motion.set_time(state.time)
        return [self.motion.at_rest(one)[0] for one in nodes]

    def placed(self, points: np.ndarray) -> np.ndarray:
        """Say where points (n, 3) of the anatomy are in the scene."""
        return self.turn.apply(self.scale * points) + self.shift

    def is_within(self, tip: np.ndarray, distance: float, is_sure: bool = False) -> bool:
        """Say whether a tip is in the sphere of a point that is no farther from the target; or without doubt."""
        part, more = (_SURE, 0.0) if is_sure else (_IN_TREE, self.spacing)
        near = np.linalg.norm(self.points - tip, axis=1) <= part * self.radii + more
        return bool((near & (self.left <= (part if is_sure else 1.0) * distance + more)).any())


class Lumen:
    """The wall as it is placed, and where the sheath ends."""

    def __init__(self, environment: Environment, way: Way) -> None:
        surface = environment.session.walls()[0]
        self.open, self.closed, self.rims = _searches(surface.vertices.tobytes(), surface.triangles.tobytes())
        given = environment.session.parameters
        if given["inlet"] is None:
            self.exit, self.along = np.array(given["sheath"]["exit"]), np.array([0.0, 0.0, 1.0])
        else:
            end, = (one for one in way.anatomy["ends"] if given["inlet"] in (one["number"], one["name"]))
            self.along = way.turn.apply(end["direction"])
            self.exit = way.placed(np.array([end["centre"]]))[0] + way.scale * end["radius"] * self.along

    def body(self, nodes: np.ndarray) -> np.ndarray:
        """Return those nodes of an instrument (n, 3) that have come out of the sheath, wherever they went."""
        beyond = (nodes - self.exit) @ self.along > 0.0
        return nodes[int(np.argmax(beyond)):] if beyond.any() else nodes[:0]

    def is_out(self, nodes: list[np.ndarray], is_of_tips: bool = False) -> bool:
        """Say whether a node of one of these instruments, or one's tip, is out of the vessel, and not in the sheath."""
        points = np.concatenate([self.body(one)[-1 if is_of_tips else 0:] for one in nodes])
        return not self.closed.inside(points).all()

    def faults(self, wire: np.ndarray, catheters: list[np.ndarray], lengths: np.ndarray) -> list[str]:
        """Say what of these nodes is through the wall, or outside and not through a rim; lengths (n,) of the wire's
        elements."""
        path, _ = through_tips(wire, catheters, lengths)
        for nodes in catheters[-1:]:    # what is inside lies on its centreline: the wire goes on from its tip
            tips = np.flatnonzero((path == nodes[-1]).all(axis=1))
            path = np.concatenate([nodes, path[tips[0] + 1:] if len(tips) else path[len(path):]])
        wrong = []
        for nodes in (path, *catheters):
            body = self.body(nodes)
            by_rim = self.rims is not None and self.rims.crosses(body[:-1], body[1:]).any()
            if self.open.crosses(body[:-1], body[1:]).any():
                wrong.append("an element crosses the wall")
            elif not by_rim and not self.closed.inside(body).all():
                wrong.append("nodes are outside and went through no rim")
        return wrong


class Judge:
    """One episode, from its reset on.

    Attributes
    ----------
    faults : what is not as it is claimed, one line each.
    """

    def __init__(self, environment: Environment, observation: Any, draw: Mapping[str, Any]) -> None:
        self._environment, self._way = environment, Way(environment, draw)
        self._sum = hashlib.sha256()
        self._states = [environment.session_state]
        self._largest = self._impulse = self._held = 0.0
        self._until = self._states[0].time    # up to which the report counts
        self._is_broken = False
        self._done = np.zeros((environment.hubs, 4))    # path, inserted, retracted, turned
        self.faults: list[str] = []
        self._add(observation)

    def see(self, observation: Any, reward: float, ended: bool, info: Mapping[str, Any]) -> None:
        """Take a step in."""
        state, last = self._environment.session_state, self._states[-1]
        self._states.append(state)
        self._add(observation, reward)
        given = self._environment.session.parameters
        limits = [one.get("hubForceLimit") for one in (given, *(given.get("catheters") or ()))]
        limits = [one if isinstance(one, (int, float)) else 0.0 for one in limits]    # "hand", or none
        if any(0.0 < _BROKEN * limit < abs(hub.force) for limit, hub in zip(limits, _hubs(state))):
            self._is_broken = True
            if not ended:
                self._fault("a hub pushes with more than it can, and the episode goes on")
            return
        self._until = state.time
        most, total = [], 0.0
        for k, (one, other, hub, before) in enumerate(zip(_each(last), _each(state), _hubs(state), _hubs(last))):
            sizes = np.linalg.norm(other.contact_forces, axis=1)
            most.append(float(sizes.max()))
            total += float(sizes.sum())
            pushed = hub.insertion - before.insertion
            self._done[k] += (np.linalg.norm(other.positions[-1] - one.positions[-1]), max(pushed, 0.0),
                              max(-pushed, 0.0), abs(hub.turn - before.turn))
            if not np.isfinite(np.r_[other.positions.ravel(), sizes, hub.force, hub.torque, reward]).all():
                self._fault("a number is not finite")
        self._largest = max(self._largest, *most)
        self._impulse += total * (state.time - last.time)
        if not _same(info["force"], max(most)):
            self._fault(f"force {info['force']:g} N of a step, seen {max(most):g}")
        self._held = self._held + state.time - last.time if self._is_there(is_sure=True) else 0.0
        if not ended and self._held > 0.0 and self._held > self._environment.task.hold - 1e-9:
            self._fault("at the target, and the episode goes on")

    def verdict(self, terminated: bool, truncated: bool, report: Mapping[str, Any]) -> str:
        """Compare with the report at the end; return a digest of all that was seen."""
        task, state = self._environment.task, self._states[-1]
        end, terminal = report["end"], report["end"] in ("target", "force", "left the vessel")
        if terminated == truncated or terminated != terminal or report["success"] != (end == "target"):
            self._fault(f"end {end}, success {report['success']}, terminated {terminated}, truncated {truncated}")
        is_ended, is_simulation = state.outcome is not None or self._is_broken, end == "simulation"
        if is_simulation != is_ended or is_simulation != bool(report["reason"]):
            self._fault(f"end {end}, outcome {state.outcome}, reason {report['reason']!r}")
        if (end == "time") != (end != "simulation" and not terminal and report["time"] > task.time - 1e-6):
            self._fault(f"end {end} after {report['time']:g} s of {task.time:g}")
        named = report.get("instruments") or {"wire": report}
        for done, one in zip(self._done, named.values()):
            for name, own in zip(("path", "inserted", "retracted", "turned"), done):
                if not _same(one[name], own):
                    self._fault(f"{name} {one[name]:g} in the report, seen {own:g}")
        for name, own in (("largest_force", self._largest), ("impulse", self._impulse),
                          ("time", self._until - self._states[0].time)):
            if not _same(report[name], own):
                self._fault(f"{name} {report[name]:g} in the report, seen {own:g}")
        if report["success"] and not self._is_there():
            self._fault("success, and the tips are not at the target")
        lumen, lengths = Lumen(self._environment, self._way), lengths_of(
            np.stack([one.positions for one in self._states]))
        looked_at = {*range(0, len(self._states), _EVERY), len(self._states) - 2, len(self._states) - 1}
        for k in sorted(looked_at):
            wire, *catheters = self._way.at_rest(self._states[k])
            for fault in lumen.faults(wire, catheters, lengths):
                self.faults.append(f"state {k}: {fault}")
        before = [nodes for state in self._states[:-1] for nodes in self._way.at_rest(state)]
        is_out = [lumen.is_out(self._way.at_rest(self._states[k])) for k in sorted(looked_at)]
        if any(is_out[:-1]) or lumen.is_out(before, is_of_tips=True):
            self.faults.append("something is outside, and the episode goes on")
        if end == "left the vessel" and not is_out[-1]:
            self._fault("left the vessel, and all is inside")
        self._sum.update(digest_of(state).encode())
        return self._sum.hexdigest()[:16]

    def _is_there(self, is_sure: bool = False) -> bool:
        task, tips = self._environment.task, [nodes[-1] for nodes in self._way.at_rest(self._states[-1])]
        follow = task.follow if isinstance(task.follow, (list, tuple)) else [task.follow] * (len(tips) - 1)
        return all(within is None or self._way.is_within(tip, within, is_sure)
                   for tip, within in zip(tips, (task.tolerance, *follow)))

    def _add(self, observation: Any, reward: float = 0.0) -> None:
        parts = [np.asarray(part) for part in observation.values()]
        if not all(np.isfinite(part).all() for part in parts) or not math.isfinite(reward):
            self._fault("an observation or a reward is not finite")
        if not self._environment.observation_space.contains(observation):
            self._fault("an observation is not in its space")
        add_bits(self._sum, parts, reward)

    def _fault(self, text: str) -> None:
        self.faults.append(f"state {len(self._states) - 1}: {text}")


def add_bits(into: Any, parts: list[np.ndarray], reward: float) -> None:
    """Add an observation and its reward to a hash."""
    for part in parts:
        into.update(np.ascontiguousarray(part).tobytes())
    into.update(np.float64(reward).tobytes())


@lru_cache(maxsize=6)
def _searches(vertices: bytes, triangles: bytes) -> tuple[MeshSearch, MeshSearch, MeshSearch | None]:
    """Searches of a wall, of the same with its rims closed, and of these."""
    wall = Wall.of(np.frombuffer(vertices).reshape(-1, 3), np.frombuffer(triangles, dtype=int).reshape(-1, 3))
    return MeshSearch(wall.triangles), wall.closed, MeshSearch(wall.fans) if len(wall.fans) else None


def _each(state: State) -> list[Any]:
    return [state, *state.catheters]


def _hubs(state: State) -> list[Any]:
    return [state.hub, *state.catheters]


def _same(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=_SAME, abs_tol=1e-12)
