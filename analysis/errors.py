"""Displacement errors against rest + displacement (thesis, eqs. 4.1, 4.2, 4.4) and the steady state."""

from __future__ import annotations

import numpy as np


def displacement_errors(positions: np.ndarray, rest: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    """Delta_x,i = |x_i - (x_i,rest + displacement)| for each sphere (eqs. 4.1 and 4.2).

    Parameters
    ----------
    positions : (..., s, 3), in units.
    rest : (s, 3), positions before the first sphere was displaced, in units.
    displacement : (3,), in units.

    Returns
    -------
    ndarray, shape (..., s)
        In units.
    """
    return np.linalg.norm(positions - (rest + displacement), axis=-1)


def total_error(errors: np.ndarray) -> np.ndarray:
    """Delta_x, the sum of the spheres' displacement errors (eq. 4.4), in units; shape (..., s) to (...)."""
    return np.sum(errors, axis=-1)


def mean_error(errors: np.ndarray) -> np.ndarray:
    """Delta_x/(n+1), the mean of the spheres' displacement errors, in units; shape (..., s) to (...)."""
    return np.mean(errors, axis=-1)


def steady_state_entry(prediction_error: np.ndarray, threshold: float, hold: int) -> int | None:
    """Return the first of ``hold`` successive entries below the threshold, after one that was not below it.

    The error oscillates and is small before the motion reaches the last sphere, so neither the first entry below the
    threshold nor one before the first entry above it counts.

    Parameters
    ----------
    prediction_error : (k,), Delta_p of every step, in units. This cannot be found from a thinned log.
    threshold : epsilon, in units.
    hold : number of successive entries.

    Returns
    -------
    int or None
        Its index; None where there is none.
    """
    above = ~(np.asarray(prediction_error) < threshold)  # a value that is not a number is not below
    edges = np.append(np.flatnonzero(above), above.size)
    lengths = np.diff(edges) - 1
    long_enough = np.flatnonzero(lengths >= hold)
    return int(edges[long_enough[0]] + 1) if hold > 0 and long_enough.size else None
