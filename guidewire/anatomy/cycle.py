"""The motion of a vessel from its surfaces at phases of a cycle, which need no vertices in common: points of the
centreline go to the same abscissa between the same ends and junctions."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree

from guidewire.anatomy.centreline import Centreline
from guidewire.anatomy.centreline_files import branches_of
from guidewire.anatomy.inspection import Unit
from guidewire.anatomy.mesh import AnatomyError, Mesh
from guidewire.anatomy.motion import VesselMotion, write_centreline
from guidewire.anatomy.surfaces import distances

_APART = 3.0  # radii of the lumen between junctions, at least, that count
_SMOOTHED = 2.0  # radii of the lumen, along a branch
_STATIONS = 1e-3  # m, about, between rows of the table
_LENGTHS = 1.5  # of a path at one phase over the same one at rest, at most
_SAMPLES = 2000  # vertices of a surface


@dataclass(frozen=True)
class Phase:
    """A surface, its centreline, and what it was read from."""

    name: str
    mesh: Mesh
    line: Centreline


def write_motion(file: Path, phases: list[Phase], unit: Unit) -> list[str]:
    """Write the table of the motion of a vessel between phases, evenly spaced, the first of which is that at rest;
    return what there is to say of it.

    Raises
    ------
    AnatomyError : the phases do not belong together, or the motion folds the vessel.
    """
    rest = phases[0].line
    centres = np.array([end.centre for end in rest.ends])
    found = []
    for phase in phases:
        others = np.array([end.centre for end in phase.line.ends])
        ends = np.full(len(centres), -1)
        own, matched = linear_sum_assignment(np.linalg.norm(centres[:, None] - others, axis=2))
        ends[own] = matched
        centres[own] = others[matched]
        root = next(k for k, end in enumerate(rest.ends) if end.point == 0)
        if ends[root] < 0 or phase.line.ends[ends[root]].point != 0:
            raise AnatomyError(f"{phase.name}: its end near {rest.ends[root].name} of the first phase is not found")
        found.append(_Paths(rest, phase.line, ends))
    shared = [k for k in range(len(rest.ends)) if all(paths.has(k) for paths in found)]
    if len(shared) < 2:
        raise AnatomyError("the phases of the cycle have fewer than two ends in common")
    lines = [f"{rest.ends[k].name}: not found at each phase; it goes with what is near"
             for k in range(len(rest.ends)) if k not in shared]
    mm = 1e3 * unit.metres
    points, displaced, scales = [], [], []
    for own in branches_of(rest):
        end = next((k for k in shared if own[-1] in rest.chain(rest.ends[k].point)), None)
        if end is not None:
            radius = float(np.median(rest.radii[own]))
            places, radii = map(np.array, zip(*(paths.at(end, own, shared) for paths in found)))
            step = float(np.linalg.norm(np.diff(rest.points[own], axis=0), axis=1).mean())
            smooth = [gaussian_filter1d(values, _SMOOTHED * radius / step, axis=1, mode="nearest")
                      for values in (places - places[0], radii)]
            kept = np.r_[0:len(own) - 1:max(1, round(_STATIONS / unit.metres / step)), len(own) - 1]
            points.append(mm * rest.points[own][kept])
            displaced.append(mm * smooth[0][:, kept])
            scales.append((smooth[1] / smooth[1][0])[:, kept])
    write_centreline(file, points, displaced, np.arange(len(phases)) / len(phases), scales)
    farthest = max(float(np.linalg.norm(one, axis=2).max()) for one in displaced)
    return [f"motion: {len(phases)} phases, the centreline moves by {farthest:.3g} mm at most; heartRate of the scene "
            "is a guess", _error(file, phases, unit), *lines]


class _Paths:
    """Paths of a tree from its root to ends, of which ends[k] is the end k at rest, -1 where there is none."""

    def __init__(self, rest: Centreline, line: Centreline, ends: np.ndarray) -> None:
        self._rest, self._line, self._ends = rest, line, ends

    def has(self, end: int) -> bool:
        """Return whether there is the end, about as far from the root as at rest."""
        if self._ends[end] < 0:
            return False
        now, before = _path(self._line, self._ends[end])[1][-1], _path(self._rest, end)[1][-1]
        return bool(max(now, before) <= _LENGTHS * min(now, before))

    def at(self, end: int, own: np.ndarray, shared: list[int]) -> tuple[np.ndarray, np.ndarray]:
        """Return places and radii of points at rest that lead to an end."""
        chain, before = _path(self._rest, end)
        other, now = _path(self._line, self._ends[end])
        marks = [(0.0, 0.0), (before[-1], now[-1])]
        for k in shared:
            last = _parting(self._rest, chain, _path(self._rest, k)[0])
            mark = before[last], now[_parting(self._line, other, _path(self._line, self._ends[k])[0])]
            if all(min((mark[0] - one) * side, (mark[1] - two) * side) > _APART * self._rest.radii[chain[last]]
                   for one, two in marks for side in [1.0 if mark[0] > one else -1.0]):
                marks.append(mark)
        at = np.interp(before[np.searchsorted(chain, own)], *np.array(sorted(marks)).T)
        return PchipInterpolator(now, self._line.points[other])(at), np.interp(at, now, self._line.radii[other])


def _path(line: Centreline, end: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the points from the root to an end, and how far each is along the way."""
    chain = line.chain(line.ends[end].point)[::-1]
    return chain, np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(line.points[chain], axis=0), axis=1))]


def _parting(line: Centreline, own: np.ndarray, other: np.ndarray) -> int:
    """Return the last point of a path from the root that is no farther than the lumen's radius from another one: where
    they part in the tree itself is less certain."""
    away = cKDTree(line.points[other]).query(line.points[own])[0]
    return int(np.flatnonzero(away <= line.radii[own])[-1])


def _error(file: Path, phases: list[Phase], unit: Unit) -> str:
    motion = VesselMotion({"period": 1.0, "rampTime": 0.0, "centreline": str(file)}, unit.metres)
    vertices = phases[0].mesh.vertices
    vertices = vertices[::1 + len(vertices) // _SAMPLES]
    misses = []
    for k, phase in enumerate(phases):
        motion.set_time(k / len(phases))
        moved = motion.moved(vertices)
        if not (np.linalg.det(motion.at_rest(moved)[1]) > 0.0).all():
            raise AnatomyError(f"{phase.name}: the motion from the first phase to this one folds the vessel: its ends "
                               "or branches may not be the same")
        misses.append(1e3 * unit.metres * distances(moved, phase.mesh))
    worst = int(np.argmax([miss.max() for miss in misses]))
    return (f"motion: the moved wall is {np.sqrt(np.mean(np.square(misses))):.2g} mm from the surfaces in the mean, "
            f"{misses[worst].max():.2g} mm at most, at {phases[worst].name}")
