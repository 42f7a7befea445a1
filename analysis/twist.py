"""Twist along a wire from logged orientations: the fraction of the rotation at the base that reaches the tip."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from guidewire.logs.logs import LogError, find_log, read_columns
from guidewire.logs.runs import Run


@dataclass(frozen=True)
class Twist:
    """Angles over a run, shape (k,) each.

    Attributes
    ----------
    steps : ndarray of int64
    base : turn of element 0 about its own axis since the start, as the drive asked, in radians.
    tip : the same of the last element: the base's and what each joint is twisted, in radians.
    bend : sum of the joints' bending angles, in radians.
    """

    steps: np.ndarray
    base: np.ndarray
    tip: np.ndarray
    bend: np.ndarray


def joint_angles(orientations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Twist and bending of each joint, from conj(q_j) q_{j+1} = swing times twist about the element.

    Parameters
    ----------
    orientations : (..., n, 4), unit quaternions x, y, z, w; the element lies along the third axis of its frame.

    Returns
    -------
    twist, bend : ndarray, shape (..., n - 1)
        In radians; twist from -pi to pi, bend from 0 to pi.
    """
    ax, ay, az, aw = np.moveaxis(orientations[..., :-1, :] * [-1.0, -1.0, -1.0, 1.0], -1, 0)
    bx, by, bz, bw = np.moveaxis(orientations[..., 1:, :], -1, 0)
    x = aw * bx + ax * bw + ay * bz - az * by
    y = aw * by - ax * bz + ay * bw + az * bx
    z = aw * bz + ax * by - ay * bx + az * bw
    w = aw * bw - ax * bx - ay * by - az * bz
    twist = 2.0 * np.arctan2(z, w)
    return (twist + np.pi) % (2.0 * np.pi) - np.pi, 2.0 * np.arctan2(np.hypot(x, y), np.hypot(z, w))


def read_twist(run: Run) -> Twist:
    """Return the angles of a run that logged its orientations.

    Raises
    ------
    LogError : the log cannot be read or holds no orientations.
    """
    columns = read_columns(run.folder, ("step", "orientations"))
    if "orientations" not in columns:
        raise LogError(f"{find_log(run.folder)}: no orientations can be read from it")
    steps = columns["step"]
    twist, bend = joint_angles(columns["orientations"])
    base = steps * run.number("twistPerStep")
    return Twist(steps, base, base + twist.sum(axis=-1), bend.sum(axis=-1))
