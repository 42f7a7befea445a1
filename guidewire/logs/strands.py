"""Whether a wire passed through itself, judged from its logged positions alone.

Nothing of the simulation is used. The writhe of a curve changes smoothly while it moves, and jumps by 2 where one of
its strands passes through another. The signed passages of a motion on straight lines from one entry of the log to the
next are counted by themselves. A passage is what both agree in: the writhe alone also changes where the tip slides over
a strand, and a straight line may cut a strand round which the wire went.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_JUMP = 1.4  # change of the writhe between two entries, 2 less what a motion of some diameters may take away
_ROOTS = 1e-9  # how far a root may be complex, or outside [0, 1]


@dataclass(frozen=True)
class Passage:
    """A strand went through another.

    Attributes
    ----------
    entry : index of the log's entry at whose end it is past.
    elements : the two elements that crossed.
    writhe : change of the writhe since the entry before.
    may_be_round_the_tip : whether strands may have moved farther against each other between the entries than the wire
        is long from the crossing to its tip. Then a strand may as well have gone round the tip, and only a finer log
        can tell.
    """

    entry: int
    elements: tuple[int, int]
    writhe: float
    may_be_round_the_tip: bool


def writhe(points: np.ndarray, extension: float = 0.0) -> float:
    """Writhe of an open polyline: the double integral of Gauss over it, exact for its straight pieces.

    Parameters
    ----------
    points : (n+1, 3).
    extension : length of a straight piece added at each end, in the direction of the first and of the last element, in
        lengths of the polyline. With long ones the writhe and the turn of the elements sum up to a link that no motion
        changes which leaves the ends where they are.
    """
    if extension > 0.0:
        reach = extension * np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        first = points[0] - points[1]
        last = points[-1] - points[-2]
        points = np.vstack([points[0] + reach * first / np.linalg.norm(first), points,
                            points[-1] + reach * last / np.linalg.norm(last)])
    i, j = np.triu_indices(len(points) - 1, 2)
    ends = ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))
    corners = [points[other] - points[one] for one, other in ends]
    lengths = [np.linalg.norm(corner, axis=1) for corner in corners]
    a, b, c, d = (corner / np.where(length > 0.0, length, 1.0)[:, None]
                  for corner, length in zip(corners, lengths, strict=True))
    return -float((_half_angle(a, b, c) + _half_angle(a, c, d)).sum()) / np.pi


def _half_angle(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Half the signed solid angle of triangles of unit vectors (Van Oosterom and Strackee 1983)."""
    dots = [np.einsum("kx,kx->k", u, v) for u, v in ((a, b), (b, c), (c, a))]
    return np.arctan2(np.einsum("kx,kx->k", a, np.cross(b, c)), 1.0 + dots[0] + dots[1] + dots[2])


def crossings(before: np.ndarray, after: np.ndarray) -> list[tuple[int, int, int]]:
    """Pairs of elements that cross while every point moves on a straight line.

    Parameters
    ----------
    before, after : (n+1, 3).

    Returns
    -------
    (lower element, higher element, sign of the change of the writhe) of each.
    """
    low = np.minimum(np.minimum(before[:-1], before[1:]), np.minimum(after[:-1], after[1:]))
    high = np.maximum(np.maximum(before[:-1], before[1:]), np.maximum(after[:-1], after[1:]))
    i, j = np.triu_indices(len(before) - 1, 2)
    near = np.all((low[i] <= high[j]) & (low[j] <= high[i]), axis=1)
    found = []
    for a, b in zip(i[near], j[near], strict=True):
        apart = np.array([before[a] - before[b], after[a] - after[b]])
        u = np.array([before[a + 1] - before[a], after[a + 1] - after[a]])
        v = np.array([before[b + 1] - before[b], after[b + 1] - after[b]])
        apart[1] -= apart[0]
        u[1] -= u[0]
        v[1] -= v[0]
        normal = [np.cross(u[0], v[0]), np.cross(u[0], v[1]) + np.cross(u[1], v[0]), np.cross(u[1], v[1])]
        cubic = np.array([apart[1] @ normal[2], apart[0] @ normal[2] + apart[1] @ normal[1],
                          apart[0] @ normal[1] + apart[1] @ normal[0], apart[0] @ normal[0]])
        for root in np.roots(cubic) if np.any(cubic[:-1]) else ():
            time = root.real
            if abs(root.imag) > _ROOTS or not 0.0 <= time < 1.0:
                continue
            plane = np.column_stack([u[0] + time * u[1], -(v[0] + time * v[1])])
            place = np.linalg.lstsq(plane, -(apart[0] + time * apart[1]), rcond=None)[0]
            if np.all((place >= 0.0) & (place < 1.0)):
                found.append((int(a), int(b), int(np.sign(np.polyval(np.polyder(cubic), time)))))
    return found


def passages(positions: np.ndarray) -> list[Passage]:
    """Passages of a wire through itself between successive entries of a log.

    Parameters
    ----------
    positions : (k, n+1, 3). The finer the log, the surer: between two entries a strand should move less than some
        diameters.
    """
    found = []
    last = writhe(positions[0])
    for k in range(1, len(positions)):
        now = writhe(positions[k])
        crossed = crossings(positions[k - 1], positions[k]) if abs(now - last) > _JUMP else []
        if crossed and np.sum([sign for _, _, sign in crossed]) * (now - last) != 0:
            moved = np.linalg.norm(positions[k] - positions[k - 1], axis=1).max()
            left = np.linalg.norm(np.diff(positions[k], axis=0), axis=1)[max(one for _, one, _ in crossed):].sum()
            found.append(Passage(k, crossed[0][:2], now - last, bool(2.0 * moved > left)))
        last = now
    return found


def link(points: np.ndarray, orientations: np.ndarray, extension: float = 1e4) -> float:
    """Turns of the end of a rod against its start, as its elements lie: the writhe of the polyline, extended at both
    ends, and its twist. No motion changes it that leaves the ends where they are and lets no strand pass another.

    Parameters
    ----------
    points : (n+1, 3).
    orientations : (n, 4), quaternions x, y, z, w of the elements.
    extension : as of `writhe`.
    """
    along = np.diff(points, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    x, y, z, w = orientations.T
    across = np.column_stack([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)])
    across -= np.einsum("ij,ij->i", across, along)[:, None] * along
    a, b, first, second = along[:-1], along[1:], across[:-1], across[1:]
    # The first element's direction across, moved on to the next one the shortest way.
    axis = np.cross(a, b)
    moved = (np.einsum("ij,ij->i", a, b)[:, None] * first + np.cross(axis, first)
             + axis * (np.einsum("ij,ij->i", axis, first) / (1.0 + np.einsum("ij,ij->i", a, b)))[:, None])
    twist = np.arctan2(np.einsum("ij,ij->i", np.cross(moved, second), b), np.einsum("ij,ij->i", moved, second))
    return float(twist.sum()) / (2.0 * np.pi) + writhe(points, extension)
