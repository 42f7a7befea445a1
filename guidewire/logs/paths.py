"""The true path of a wire in catheters: an element that crosses a catheter's tip is bent there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

_STRETCH = 1e-3  # of an element's length, by which it may be longer or shorter


def lengths_of(positions: np.ndarray) -> np.ndarray:
    """Return (n,): lengths of the elements of a wire, from its nodes (k, n+1, 3) at several moments: the longest
    chords."""
    return np.linalg.norm(np.diff(positions, axis=1), axis=2).max(axis=0)


def through_tips(nodes: np.ndarray, catheters: Sequence[np.ndarray], lengths: np.ndarray
                 ) -> tuple[np.ndarray, np.ndarray]:
    """Return a wire's nodes, and the catheters' tips that it comes out of; and the element that each piece between is
    of.

    The chord of an element that comes out of a tip cuts the corner there. The two pieces by the tip are together as
    long as the element, or shorter where the catheter is bent behind its tip.

    Parameters
    ----------
    nodes : (n+1, 3), of the wire.
    catheters : nodes (m+1, 3) of each catheter around it, in any order.
    lengths : (n,), of the wire's elements.
    """
    of_pieces = np.arange(len(lengths))
    for tip in (catheter[-1] for catheter in catheters):
        away = np.linalg.norm(nodes - tip, axis=1)
        by_tip = away[:-1] + away[1:]
        # Of those that are long enough the one whose chord is nearly as long: a compressed one beside it is not.
        excess = by_tip - np.linalg.norm(np.diff(nodes, axis=0), axis=1)
        k = int(np.argmin(np.where(by_tip <= (1.0 + _STRETCH) * lengths[of_pieces], excess, np.inf)))
        if by_tip[k] <= (1.0 + _STRETCH) * lengths[of_pieces[k]] and away[[k, k + 1]].min() > 0.0:
            nodes = np.insert(nodes, k + 1, tip, axis=0)
            of_pieces = np.insert(of_pieces, k, of_pieces[k])
    return nodes, of_pieces
