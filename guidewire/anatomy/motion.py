"""How a vessel moves: the `motion` of a parameter file, its tables, and the map of points at rest to where they are.

A point x of space is at X = psi(x) of the vessel at rest, the mean of maps of the points of the centreline,

    p_k(x) = c_k + A_k v + b_k (t'_k . v)^2,   v = x - c'_k,   weights exp(-|v|^2/(2 s^2)),

with c, t, kappa position, tangent and curvature at rest, the same with ' now, s the points' spacing,
A_k = R_k^T (1/scale across t', 1/stretch along t'), R_k the shortest turn from t to t' after what the table adds, and
2 b_k = kappa_k/stretch^2 - A_k kappa'_k. The runner evaluates the same map for contact.
"""

from __future__ import annotations

import csv
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation

from guidewire.anatomy.centreline_files import branches_of
from guidewire.anatomy.triangles import read_stl

SIZES = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "deg": np.pi / 180.0, "rad": 1.0}
_STEPS = 30  # of Newton's method
_SPACING = 2e-3  # m
_CHUNK = 4000  # points at once
_NEAREST = 48  # points of the centreline, beyond which weights are below rounding
_BEAT = ((0.0, 0.0), (0.08, 0.12), (0.2, 0.7), (0.32, 1.0), (0.4, 0.98), (0.5, 0.45), (0.6, 0.12), (0.7, 0.08),
         (0.8, 0.08), (0.9, 0.04), (1.0, 0.0))  # phase of a cycle, share of the contraction


def write_centreline(file: Path, rest: list[np.ndarray], displaced: np.ndarray | list[np.ndarray],
                     phases: np.ndarray, scales: list[np.ndarray] | None = None) -> None:
    """Write the table of a `centreline`, in mm.

    rest : (k, 3) of each branch; displaced : (phases, k, 3) of each branch, displacements; phases : from 0 to below 1;
    scales : (phases, k) of the sections of each branch, 1 where missing.
    """
    with open(file, "w", encoding="utf-8", newline="\n") as out:
        out.write("branch,station_mm,phase,x_mm,y_mm,z_mm,dx_mm,dy_mm,dz_mm" + (",scale\n" if scales else "\n"))
        for branch, (points, moved) in enumerate(zip(rest, displaced)):
            stations = _arc(points)
            wide = scales[branch][..., None] if scales else np.empty((*moved.shape[:2], 0))
            for phase, rows, sizes in zip(phases, moved, wide):
                for station, x, d, size in zip(stations, points, rows, sizes):
                    numbers = [station, phase, *x, *d, *size]
                    out.write(f"{branch}," + ",".join(f"{number:.6g}" for number in numbers) + "\n")


@dataclass(frozen=True)
class _Cycle:
    """period (s), phase at time 0; values : phase -> (6,) of a rigid cycle, or (points, 7)."""

    period: float
    phase: float
    about: np.ndarray | None
    values: Any


class VesselMotion:
    """Where a vessel is in time. Lengths in units of the scene.

    motion : the object of the parameters of a run, whose files have whole names
    metres_per_unit : m
    place : the vessel's placement, of points (n, 3); None: none
    vessel : the object of the parameters, where `frames` move it
    """

    def __init__(self, motion: dict[str, Any], metres_per_unit: float, place: Any = None,
                 vessel: Mapping[str, Any] | None = None) -> None:
        self._metres, self._vessel = metres_per_unit, vessel
        self._place = place if place is not None else lambda points: points
        self._spacing = float(motion.get("spacing", _SPACING)) / metres_per_unit
        self._branches: list[np.ndarray] = []
        own = [motion] + ([motion["breathing"]] if "breathing" in motion else [])
        self._cycles = [self._cycle(one) for one in own]
        self._rest = np.concatenate(self._branches) if self._branches else np.zeros((1, 3))
        self._near_rest = cKDTree(self._rest)
        self._counts = [len(branch) for branch in self._branches]
        self._curve = _Curve(self._rest, self._counts)
        self.set_pace(motion)

    def set_pace(self, motion: Mapping[str, Any]) -> None:
        """Take over periods and phases of a motion that is the same but for them, and go to time 0."""
        paces = map(_pace_of, [motion] + ([motion["breathing"]] if "breathing" in motion else []))
        self._cycles = [replace(cycle, period=period, phase=phase)
                        for cycle, (period, phase) in zip(self._cycles, paces)]
        self.ramp = float(motion.get("rampTime", 0.25 * self.period))
        self.set_time(0.0)

    @property
    def beat(self) -> tuple[float, float]:
        """Cosine and sine of the phase of the first cycle."""
        angle = 2.0 * np.pi * (self._cycles[0].phase + self._time / self.period)
        return float(np.cos(angle)), float(np.sin(angle))

    @property
    def period(self) -> float:
        """Of the first cycle, s."""
        return self._cycles[0].period

    def set_time(self, time: float) -> None:
        """Go to a time, s."""
        self._time = time
        u = min(1.0, max(0.0, time / self.ramp)) if self.ramp > 0.0 else 1.0
        ramp = u**3 * (10.0 - u * (15.0 - 6.0 * u))
        values = [ramp * cycle.values((cycle.phase + time / cycle.period) % 1.0) for cycle in self._cycles]
        now = self._rest.copy()
        turn = Rotation.identity(len(now))
        scale = np.ones(len(now))
        for cycle, value in zip(self._cycles, values):
            if cycle.about is None:
                now = now + value[:, :3]
                turn = Rotation.from_rotvec(value[:, 3:6]) * turn
                scale = scale * (1.0 + value[:, 6])
        before, after = self._curve, _Curve(now, self._counts)
        stretch = np.where(before.length > 0.0, after.length / np.maximum(before.length, 1e-300), 1.0)
        turn = turn * _shortest(before.tangent, after.tangent)
        tangent = after.tangent
        maps = _maps(turn, tangent, scale, stretch)
        self._bend = 0.5 * (before.curvature / stretch[:, None]**2 - np.einsum("kij,kj->ki", maps, after.curvature))
        for cycle, value in zip(self._cycles, values):
            if cycle.about is not None:
                one = Rotation.from_rotvec(value[3:])
                now = cycle.about + one.apply(now - cycle.about) + value[:3]
                tangent = one.apply(tangent)
                turn = one * turn
        self._now, self._tangent, self._maps = now, tangent, _maps(turn, tangent, scale, stretch)
        self._near = cKDTree(now)

    def at_rest(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Where points (n, 3) are on the vessel at rest, and the derivatives (n, 3, 3)."""
        parts = [self._at_rest(points[k:k + _CHUNK]) for k in range(0, len(points), _CHUNK)]
        return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])

    def moved(self, points: np.ndarray) -> np.ndarray:
        """Where points (n, 3) of the vessel at rest are now."""
        if len(points) > _CHUNK:
            return np.concatenate([self.moved(points[k:k + _CHUNK]) for k in range(0, len(points), _CHUNK)])
        near = self._near_rest.query(points)[1]
        x = self._now[near] + np.linalg.solve(self._maps[near], (points - self._rest[near])[..., None])[..., 0]
        for _ in range(_STEPS):
            rest, slope = self.at_rest(x)
            step = np.linalg.solve(slope, (points - rest)[..., None])[..., 0]
            x = x + step
            if np.abs(step).max() < 1e-11 * (1.0 + np.abs(x).max()):
                break
        return x

    def _at_rest(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        near = self._near.query(x, np.arange(1, 1 + min(_NEAREST, len(self._now))))[1]
        tangent, bend, maps = self._tangent[near], self._bend[near], self._maps[near]
        v = x[:, None] - self._now[near]
        exponent = 0.5 * (v**2).sum(axis=2) / self._spacing**2
        weights = np.exp(exponent.min(axis=1, keepdims=True) - exponent)
        weights /= weights.sum(axis=1, keepdims=True)
        along = (v * tangent).sum(axis=2)
        images = self._rest[near] + (maps @ v[..., None])[..., 0] + along[..., None]**2 * bend
        rest = (weights[..., None] * images).sum(axis=1)
        slope = np.einsum("nk,nkij->nij", weights, maps) \
            + 2.0 * np.swapaxes((weights * along)[..., None] * bend, 1, 2) @ tangent
        rate = -weights[..., None] * v / self._spacing**2
        rate -= weights[..., None] * rate.sum(axis=1, keepdims=True)
        return rest, slope + np.swapaxes(images - rest[:, None], 1, 2) @ rate

    def _cycle(self, own: dict[str, Any]) -> _Cycle:
        period, phase = _pace_of(own)
        if "centreline" in own:
            return _Cycle(period, phase, None, self._centreline(Path(own["centreline"])))
        if "frames" in own:
            return _Cycle(period, phase, None, self._frames(own["frames"]))
        rigid = own["rigid"]
        if isinstance(rigid, str):
            table = _read(Path(rigid), {})
            size = np.array([1.0 / self._metres] * 3 + [1.0] * 3)
            rows = np.stack([table.get(name, 0.0 * table["phase"]) for name in "x y z rx ry rz".split()], axis=1)
            return _Cycle(period, phase, np.zeros(3), _periodic(table["phase"], rows * size))
        amplitude = np.r_[rigid.get("translation", [0, 0, 0]), np.deg2rad(rigid.get("rotation", [0, 0, 0]))]
        return _Cycle(period, phase, np.array(rigid.get("about", [0, 0, 0]), dtype=float),
                      lambda at: np.sin(2.0 * np.pi * at) * amplitude)

    def _centreline(self, file: Path) -> Any:
        table = _read(file, {"branch": 0.0, "dx": 0.0, "dy": 0.0, "dz": 0.0, "rx": 0.0, "ry": 0.0, "rz": 0.0,
                             "scale": 1.0})
        phases = np.unique(table["phase"])
        moved = []
        for branch in np.unique(table["branch"]):
            rows = table["branch"] == branch
            stations = np.unique(table["station"][rows])
            order = np.lexsort((table["station"][rows], table["phase"][rows]))

            def grid(*names: str) -> np.ndarray:
                columns = np.stack([table[name][rows][order] for name in names], axis=1)
                return columns.reshape(len(phases), len(stations), len(names))

            at = self._add_branch(stations / self._metres,
                                  self._place(grid("x", "y", "z")[0] / self._metres)) * self._metres
            origin, *axes = self._place(np.concatenate([np.zeros((1, 3)), np.eye(3)]))
            linear = np.array(axes) - origin    # of a row
            turned = linear * np.sign(np.linalg.det(linear)) / np.linalg.norm(linear[0])
            values = np.concatenate([grid("dx", "dy", "dz") @ linear / self._metres, grid("rx", "ry", "rz") @ turned,
                                     grid("scale") - 1.0], axis=2)
            moved.append(CubicSpline(stations, values, axis=1, bc_type="natural")(at))
        return _periodic(phases, np.concatenate(moved, axis=1))

    def _add_branch(self, stations: np.ndarray, rest: np.ndarray) -> np.ndarray:
        """Add points of a branch about a spacing apart, and return where they are among its stations, units."""
        count = max(2, round((stations[-1] - stations[0]) / self._spacing) + 1)
        at = stations[0] + (stations[-1] - stations[0]) * np.arange(count) / (count - 1)
        self._branches.append(CubicSpline(stations, rest, bc_type="natural")(at))
        return at

    def _frames(self, files: list[str]) -> Any:
        """Fit the points of the anatomy's centreline to meshes of one topology, of which the first is at rest."""
        size = float(self._vessel.get("metresPerUnit", self._metres)) / self._metres
        line = json.loads(Path(self._vessel["anatomy"]).read_text(encoding="utf-8"))["centreline"]
        points = self._place(size * np.array(line["points"], dtype=float)[:, :3])
        tree = SimpleNamespace(parents=np.array(line["parents"]), branches=np.array(line["branches"]), loops=())
        for own in branches_of(tree):
            self._add_branch(_arc(points[own]), points[own])
        frames = np.array([self._place(size * _vertices(Path(file).read_bytes(), file)) for file in files])
        rows = np.concatenate([_fitted(branch, self._spacing, frames) for branch in self._branches], axis=1)
        return _periodic(np.arange(len(frames)) / len(frames), rows)


def _vertices(mesh: bytes, name: str) -> np.ndarray:
    """Return the vertices (n, 3) of a mesh that the runner has read."""
    if name.lower().endswith(".stl"):
        return read_stl(mesh).vertices
    lines = (line.split() for line in mesh.splitlines())
    return np.array([words[1:4] for words in lines if words[:1] == [b"v"]], dtype=float)


def _fitted(branch: np.ndarray, spacing: float, frames: np.ndarray) -> np.ndarray:
    """Return (phases, k, 7) of points of a branch, displacement, rotation vector and change of scale, that fit vertices
    (phases, n, 3): those near a point are displaced by d + B v + b (t.v)^2."""
    rows = np.zeros((len(frames), len(branch), 7))
    along = np.concatenate([branch[1:], branch[-1:]]) - np.concatenate([branch[:1], branch[:-1]])
    ways = np.moveaxis(frames - frames[0], 0, 1).reshape(frames.shape[1], -1)
    for k, (centre, t) in enumerate(zip(branch, _units(along))):
        arms = frames[0] - centre
        squares = (arms**2).sum(axis=1)
        over = 0.5 * (squares - squares.min()) / max(spacing**2, squares.min())
        near = over < 36.0
        terms = np.c_[np.ones(near.sum()), arms[near], (arms[near] @ t)**2]
        weighed = (np.exp(-over[near])[:, None] * terms).T
        found = np.linalg.solve(weighed @ terms, weighed @ ways[near]).reshape(5, len(frames), 3)
        slopes = np.eye(3) + np.moveaxis(found[1:4], 0, 2)    # of each frame: rows are components
        after = _units(slopes @ t)
        back = _shortest(np.tile(t, (len(frames), 1)), after).inv().as_matrix() @ slopes
        across = np.eye(3) - np.outer(t, t)
        sine = np.einsum("pij,ij->p", across @ back @ across, np.cross(np.eye(3), t))
        cosine = np.trace(across @ back @ across, axis1=1, axis2=2)
        rows[:, k] = np.c_[found[0], np.arctan2(sine, cosine)[:, None] * after, 0.5 * np.hypot(sine, cosine) - 1.0]
    return rows


def _arc(points: np.ndarray) -> np.ndarray:
    return np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]


def _pace_of(cycle: Mapping[str, Any]) -> tuple[float, float]:
    """Return the period, s, and the phase at time 0."""
    period = float(cycle["period"]) if "period" in cycle else 60.0 / float(cycle["heartRate"])
    return period, float(cycle.get("phase", 0.0))


class _Curve:
    """Tangents, curvatures and lengths of the pieces beside each point, branch by branch, by parabolas.

    counts : points of each branch, one branch behind the other.
    """

    def __init__(self, points: np.ndarray, counts: list[int]) -> None:
        self.tangent, self.curvature = np.zeros_like(points), np.zeros_like(points)
        self.length = np.zeros(len(points))
        if not counts:
            return
        last = np.cumsum(counts) - 1
        first = last - np.array(counts) + 1
        steps = points[1:] - points[:-1]
        steps[last[:-1]] = 1.0    # from one branch to the next: of no account
        size = np.linalg.norm(steps, axis=1)
        along = steps / size[:, None]
        both = size[:-1] + size[1:]
        self.length[1:-1], self.curvature[1:-1] = both, 2.0 * (along[1:] - along[:-1]) / both[:, None]
        self.tangent[1:-1] = along[:-1] * size[1:, None] + along[1:] * size[:-1, None]
        is_long = np.array(counts) > 2
        for end, beside, piece, sign in ((first, first + 1, first, -0.5), (last, last - 1, last - 1, 0.5)):
            self.length[end] = np.where(is_long, self.length[beside], size[piece])
            self.curvature[end] = np.where(is_long[:, None], self.curvature[beside], 0.0)
            self.tangent[end] = along[piece] + sign * size[piece, None] * self.curvature[end]
        self.tangent /= np.linalg.norm(self.tangent, axis=1)[:, None]


def _shortest(one: np.ndarray, two: np.ndarray) -> Rotation:
    real = 1.0 + np.einsum("ki,ki->k", one, two)
    real = np.where((one**2).sum(axis=1) > 0.0, real, 1.0)
    return Rotation.from_quat(np.concatenate([np.cross(one, two), real[:, None]], axis=1))


def _maps(turn: Rotation, tangent: np.ndarray, scale: np.ndarray, stretch: np.ndarray) -> np.ndarray:
    back = turn.inv().as_matrix()
    across = (1.0 / scale)[:, None, None]
    along = (1.0 / stretch)[:, None, None] - across
    return across * back + along * np.einsum("kij,kj,kl->kil", back, tangent, tangent)


def _periodic(phases: np.ndarray, rows: np.ndarray) -> Any:
    spline = CubicSpline(np.r_[phases, phases[0] + 1.0], np.concatenate([rows, rows[:1]]), bc_type="periodic")
    return lambda at: spline(phases[0] + (at - phases[0]) % 1.0)


def _read(file: Path, missing: dict[str, float]) -> dict[str, np.ndarray]:
    with open(file, encoding="utf-8-sig", newline="") as text:
        lines = [row for row in csv.reader(text) if row and not row[0].lstrip().startswith("#")]
    table: dict[str, np.ndarray] = {}
    for head, column in zip(lines[0], zip(*lines[1:])):
        name, _, unit = head.strip().partition("_")
        table[name] = SIZES.get(unit, 1.0) * np.array(column, dtype=float)
    count = len(lines) - 1
    return {**{name: np.full(count, value) for name, value in missing.items()}, **table}


def beat_of_heart(points: list[np.ndarray], ostium: np.ndarray, base: np.ndarray, apex: np.ndarray,
                  phases: np.ndarray) -> list[np.ndarray]:
    """Return displacements (phases, k, 3) of points on the surface of a left ventricle that is taken for an ellipsoid.

    Between end diastole, phase 0, and end systole the ventricle becomes shorter along its axis from base to apex by
    0.14, narrower by 0.12, and turns by 8 degrees from base to apex. It rests around end systole and in mid diastole
    (Shechter, Resar and McVeigh, Med Phys 32 (2005) 255). Displacements are those against the ostium, where a guiding
    catheter sits and goes along.
    """
    axis = (apex - base) / np.linalg.norm(apex - base)
    extent = np.linalg.norm(apex - base)
    curve = CubicSpline(*np.array(_BEAT).T, bc_type="periodic")

    def contracted(x: np.ndarray, share: float) -> np.ndarray:
        along = (x - base) @ axis
        across = x - base - along[:, None] * axis
        turned = Rotation.from_rotvec((np.radians(8.0) * share * along / extent)[:, None] * axis).apply(across)
        return base + (1.0 - 0.14 * share) * along[:, None] * axis + (1.0 - 0.12 * share) * turned

    moved = []
    for own in points:
        moved.append(np.array([contracted(own, share) - own - (contracted(ostium[None], share) - ostium)
                               for share in curve(phases) - curve(0.0)]))
    return moved


class GivenVessel:
    """A vessel that gave way as a beam, as pictures draw it: its sections go and turn with the centreline.

    rest : (m, 3) points of the centreline at rest, units, evenly spaced as logs have them (`vesselCentreline`)
    """

    def __init__(self, rest: np.ndarray) -> None:
        self._stations = _arc(rest)
        self._rest = CubicSpline(self._stations, rest)
        self._fine = np.linspace(0.0, self._stations[-1], 20 * len(rest))
        self._near = cKDTree(self._rest(self._fine))

    def moved(self, points: np.ndarray, displaced: np.ndarray) -> np.ndarray:
        """Return where points (k, 3) at rest are with the centreline displaced by (m, 3)."""
        return self._turned(points, self._near, CubicSpline(self._stations, np.zeros_like(displaced)),
                            CubicSpline(self._stations, displaced))

    def at_rest(self, points: np.ndarray, displaced: np.ndarray) -> np.ndarray:
        """Return where points (k, 3) that are there with the centreline displaced by (m, 3) are at rest."""
        shift = CubicSpline(self._stations, displaced)
        return self._turned(points, cKDTree(self._rest(self._fine) + shift(self._fine)), shift,
                            CubicSpline(self._stations, np.zeros_like(displaced)))

    def _turned(self, points: np.ndarray, near: cKDTree, one: CubicSpline, other: CubicSpline) -> np.ndarray:
        at = self._fine[near.query(points)[1]]
        before, after = _units(self._rest(at, 1) + one(at, 1)), _units(self._rest(at, 1) + other(at, 1))
        return self._rest(at) + other(at) + _shortest(before, after).apply(points - self._rest(at) - one(at))


def _units(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def motion_of(parameters: Mapping[str, Any]) -> VesselMotion | None:
    """Return how the vessel of a run moves; None where it stands still. Files have whole names."""
    motion = (parameters.get("vessel") or {}).get("motion")
    return None if motion is None else _motion(motion, parameters)


def motions_of(parameters: Mapping[str, Any]) -> dict[int, VesselMotion]:
    """Return by the number of a wall that moves, the vessel first where there is one, how it moves."""
    return {k: _motion(motion, parameters) for k, motion in _moving(parameters)}


def _motion(motion: dict[str, Any], parameters: Mapping[str, Any]) -> VesselMotion:
    return VesselMotion(motion, float(parameters["metresPerUnit"]), _place_of(parameters), parameters.get("vessel"))


def _moving(parameters: Mapping[str, Any]) -> Iterator[tuple[int, dict[str, Any]]]:
    own = [one for one in (parameters.get("vessel"), *(parameters.get("obstacles") or ())) if one]
    for k, wall in enumerate(own):
        motion = own[0].get("motion") if wall.get("motion") == "vessel" else wall.get("motion")
        if motion is not None:
            yield k, motion


def _place_of(parameters: Mapping[str, Any]) -> Any:
    """The vessel's placement: scaled, turned about z, x and y, and moved."""
    turn = Rotation.from_euler("zxy", np.array(parameters.get("rotation", (0, 0, 0)), dtype=float)[[2, 0, 1]],
                               degrees=True)
    scale, position = (np.array(parameters.get(key, missing), dtype=float)
                       for key, missing in (("scale", (1, 1, 1)), ("position", (0, 0, 0))))
    return lambda points: turn.apply(scale * points) + position
