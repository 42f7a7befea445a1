"""The curve through the nodes of a wire, and the distances of points from it."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

_PIECES = 8  # straight pieces an element: of an arc they are 64 times nearer than its chord
_SAME = 1e-12    # of the chain's length: points no farther apart coincide
_NEWTON = 4    # iterations from the nearest point of a chain to that of its spline


def smooth(nodes: np.ndarray) -> np.ndarray:
    """Return points of a cubic spline through nodes.

    Parameters
    ----------
    nodes : (n + 1, d), in any unit.

    Returns
    -------
    ndarray
        (8 n + 1, d): the nodes, and seven points between each two. Of two nodes, or of nodes that coincide, the chords.
    """
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(nodes, axis=0), axis=1))))
    at = np.interp(np.arange(_PIECES * (len(nodes) - 1) + 1) / _PIECES, np.arange(len(nodes)), along)
    if len(nodes) < 3 or np.any(np.diff(along) <= 0.0):
        return np.stack([np.interp(np.arange(len(at)) / _PIECES, np.arange(len(nodes)), column) for column in nodes.T],
                        1)
    return CubicSpline(along, nodes)(at)


def fractions(line: np.ndarray) -> np.ndarray:
    """Return the fractions of a chain's length up to each of its points (m, d): from 0 to 1."""
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))))
    return along / max(along[-1], np.finfo(float).tiny)


def by_arc(line: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return points of a chain (m, d) at fractions of its length (p,), shape (p, d)."""
    own = fractions(line)
    return np.stack([np.interp(at, own, column) for column in line.T], axis=1)


def offsets(points: np.ndarray, line: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Offsets of points from the nearest points of the cubic spline through a chain.

    The offset from the chain itself would jump where the nearest point passes from one piece to the next.

    Parameters
    ----------
    points : (p, d).
    line : (m, d), at least two.

    Returns
    -------
    tuple of ndarray
        (p, d), from the curve to each point; (p,), where along the line the nearest point lies, in pieces.
    """
    # Points that coincide, as those of a wire seen end on, are one.
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    kept = np.concatenate(([0], 1 + np.flatnonzero(steps > _SAME * np.sum(steps))))
    if len(kept) < 2:
        return points - line[0], np.zeros(len(points))
    line = line[kept]
    chords = np.diff(line, axis=0)
    squares = np.sum(chords**2, axis=1)
    off = points[:, None, :] - line[None, :-1, :]
    share = np.clip(np.sum(off * chords, axis=2) / squares, 0.0, 1.0)
    nearest = np.argmin(np.sum((off - share[:, :, None] * chords)**2, axis=2), axis=1)
    along = np.concatenate(([0.0], np.cumsum(np.sqrt(squares))))
    piece = np.sqrt(squares[nearest])
    at = along[nearest] + share[np.arange(len(points)), nearest] * piece
    curve = CubicSpline(along, line)
    for _ in range(_NEWTON):
        vectors, tangents = points - curve(at), curve(at, 1)
        speed = np.sum(tangents**2, axis=1)
        # Beyond the centre of curvature the nearest point is not the stationary one: there without its curvature.
        slope = speed - np.sum(vectors * curve(at, 2), axis=1)
        step = np.sum(vectors * tangents, axis=1) / np.where(slope > 0.1 * speed, slope, speed)
        at = np.clip(at + np.clip(step, -piece, piece), 0.0, along[-1])
    return points - curve(at), np.interp(at, along, kept)
