"""How far a run is from a measurement: offsets of measured points from the computed curve, errors of hub values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from guidewire.logs.curves import by_arc, fractions, offsets, smooth
from guidewire.logs.hub import read_hub
from guidewire.logs.logs import PositionLog, read_log
from guidewire.logs.measured import nodes_at
from guidewire.logs.measurement import Measurement, Shape
from guidewire.prepare import PreparationError

ALIGNMENTS = ("none", "plane", "rigid")
Cameras = Mapping[str, np.ndarray]    # view to its matrix (3, 4): pixels and depth from units
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Residuals:
    """They are those of one measurement.

    Attributes
    ----------
    offsets : (k, d), from the run to each measured point, or value; in the unit of the measurement.
    blocks : first index of each shape, whose points follow one another along the wire.
    independent : how many of the numbers the curve cannot follow: d - 1 a point, 1 a value; less those of the
        alignment.
    points, curves : of shapes, the measured points after alignment, and the computed curve they are compared with.
    """

    offsets: np.ndarray
    blocks: tuple[int, ...]
    independent: int
    points: tuple[np.ndarray, ...] = ()
    curves: tuple[np.ndarray, ...] = ()

    @property
    def rms(self) -> float:
        """Root of the mean squared distance."""
        return float(np.sqrt(np.mean(np.sum(self.offsets**2, axis=1))))

    @property
    def correlation(self) -> float:
        """Return the correlation of neighbouring offsets along the wire: 0 for independent errors, near 1 where
        something systematic is left."""
        inner = np.ones(len(self.offsets) - 1, bool)
        inner[[k - 1 for k in self.blocks if k > 0]] = False
        along = np.sum(self.offsets[1:] * self.offsets[:-1], axis=1)[inner]
        return float(np.sum(along) / max(np.sum(self.offsets**2), np.finfo(float).tiny)) if len(along) else 0.0


def residuals(folder: Path, measured: Measurement, align: str, cameras: Cameras) -> Residuals:
    """Compare a run with a measurement.

    Parameters
    ----------
    folder : of the run, with its log.
    measured : not of a critical value.
    align : "none": measured in the scene's own frame; "plane": shifted, and turned within the picture's plane; "rigid":
        shifted and turned in space. One alignment for all shapes of the measurement.
    cameras : of pictures, by view.

    Raises
    ------
    PreparationError, LogError : they cannot be compared; one line.
    """
    return _of_shapes(folder, measured, align, cameras) if measured.shapes else _of_hub(folder, measured)


def _of_hub(folder: Path, measured: Measurement) -> Residuals:
    over, quantity = measured.columns
    log = read_hub(folder)
    at, values = getattr(log, over), getattr(log, quantity)
    if over != "time":
        if np.any(np.diff(at) * np.sign(at[-1] - at[0]) < -_ROUNDING):
            raise PreparationError(f"{measured.file}: the run's {over} goes back and forth: measure over time")
        order = np.argsort(at, kind="stable")
        at, values = at[order], values[order]
    span = at[-1] - at[0]
    if np.any(measured.over < at[0] - 1e-6 * span) or np.any(measured.over > at[-1] + 1e-6 * span):
        raise PreparationError(f"{measured.file}: {over} from {np.min(measured.over):g} to "
                               f"{np.max(measured.over):g}, the "
                                  f"run's is from {at[0]:g} to {at[-1]:g}")
    errors = measured.values - np.interp(measured.over, at, values)
    return Residuals(errors[:, None], (0,), len(errors))


def _of_shapes(folder: Path, measured: Measurement, align: str, cameras: Cameras) -> Residuals:
    log = read_log(folder, spheres="all")
    curves = [_curve(log, shape, measured, cameras) for shape in measured.shapes]
    points = [shape.points for shape in measured.shapes]
    freedom = 0
    if align != "none":
        points, freedom = aligned(points, curves)
    found = [offsets(given, line)[0] for given, line in zip(points, curves)]
    ends = np.cumsum([0, *map(len, points)])
    independent = int(ends[-1]) * (points[0].shape[1] - 1) - freedom
    return Residuals(np.concatenate(found), tuple(map(int, ends[:-1])), independent, tuple(points), tuple(curves))


def _curve(log: PositionLog, shape: Shape, measured: Measurement, cameras: Cameras) -> np.ndarray:
    if shape.time is not None and not log.time[0] - 1e-9 <= shape.time <= log.time[-1] + 1e-9:
        raise PreparationError(f"{measured.file}: time {shape.time:g} s, the run's are from {log.time[0]:g} to "
                                  f"{log.time[-1]:g} s")
    line = smooth(log.positions[-1] if shape.time is None else nodes_at(log, shape.time))
    if not shape.view and measured.axes:
        return line[:, measured.axes]
    if shape.view not in cameras:
        raise PreparationError(f"{measured.file}: view \"{shape.view}\" has no camera matrix: give --camera "
                               "FILE.json with "
                                  f"{{\"{shape.view}\": [[12 numbers in 3 rows]]}}")
    return project(cameras[shape.view], line)


def project(camera: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Pixels (k, 2) of points (k, 3) by a camera matrix (3, 4)."""
    made = points @ camera[:, :3].T + camera[:, 3]
    return made[:, :2] / made[:, 2:]


def aligned(points: Sequence[np.ndarray], curves: Sequence[np.ndarray]) -> tuple[list[np.ndarray], int]:
    """Return points moved as one rigid body to where their distances from the curves are least, and its degrees of
    freedom.

    Parameters
    ----------
    points, curves : (p, d) and (m, d) of each shape, d = 2 or 3; both run from the proximal end on.
    """
    every = np.concatenate(points)
    middle = every.mean(axis=0)
    matched = np.concatenate([by_arc(line, fractions(given)) for given, line in zip(points, curves)])
    turn, shift = _rigid(every, matched)
    size = max(float(np.max(np.linalg.norm(every - middle, axis=1))), np.finfo(float).tiny)
    planar = every.shape[1] == 2

    def moved(step: np.ndarray) -> list[np.ndarray]:
        more = _plane_turn(step[0]) if planar else Rotation.from_rotvec(step[:3]).as_matrix()
        return [((given - middle) @ turn.T) @ more.T + middle @ turn.T + shift + size * step[1 if planar else 3:]
                for given in points]

    def off(step: np.ndarray) -> np.ndarray:
        return np.concatenate([offsets(given, line)[0] for given, line in zip(moved(step), curves)]).ravel() / size

    freedom = 3 if planar else 6
    best = least_squares(off, np.zeros(freedom), xtol=1e-10, ftol=1e-12, gtol=1e-12)
    return moved(best.x), freedom


def _rigid(points: np.ndarray, targets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Turn (d, d) and shift (d,) that bring points nearest to targets in the least-squares sense (Kabsch 1976)."""
    a, b = points.mean(axis=0), targets.mean(axis=0)
    left, _, right = np.linalg.svd((points - a).T @ (targets - b))
    flip = np.ones(points.shape[1])
    flip[-1] = np.sign(np.linalg.det(right.T @ left.T))
    turn = right.T @ np.diag(flip) @ left.T
    return turn, b - turn @ a


def _plane_turn(angle: float) -> np.ndarray:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
