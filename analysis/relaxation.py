"""Relaxation of the last sphere: peaks, envelope and period of a damped oscillation.

The thesis takes the local maxima zeta(t) of the last sphere's displacement error and fits eq. 4.3,
zeta(t) = zeta0 exp(-t/tau), to all of them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import curve_fit
from scipy.signal import find_peaks


_ROUNDING = 1e-10  # of the largest distance: peaks below it are noise of the last digits, not of the oscillation


class RelaxationError(Exception):
    """A motion that has no relaxation time. The message is one line."""


@dataclass(frozen=True)
class Relaxation:
    """Envelope zeta0 exp(-t/tau) of a damped oscillation, and the peaks that it was fitted to.

    Attributes
    ----------
    amplitude, amplitude_error : zeta0 and its standard error from the fit, in units.
    time, time_error : tau and its standard error from the fit, in s.
    period : mean period of the oscillation, in s.
    peak_entries : (p,) of int, indices of the peaks in the series given.
    peak_times, peak_heights : (p,), in s and units.
    """

    amplitude: float
    amplitude_error: float
    time: float
    time_error: float
    period: float
    peak_entries: np.ndarray
    peak_times: np.ndarray
    peak_heights: np.ndarray

    def envelope(self, time: np.ndarray) -> np.ndarray:
        """zeta0 exp(-t/tau) at the given times (s), in units."""
        return self.amplitude * np.exp(-time / self.time)

    @property
    def largest_misfit(self) -> float:
        """Largest |peak/envelope - 1| over the peaks, dimensionless."""
        return float(np.max(np.abs(self.peak_heights / self.envelope(self.peak_times) - 1.0)))


def relaxation_error(positions: np.ndarray, rest: np.ndarray, displacement: np.ndarray) -> np.ndarray:
    """Distance along the displacement from the new rest, |(x(t) - x_rest - displacement) . d|.

    Parameters
    ----------
    positions : (k, 3), one sphere over time, in units.
    rest : (3,), its position before the first sphere was displaced, in units.
    displacement : (3,), in units.

    Returns
    -------
    ndarray, shape (k,)
        In units.
    """
    length = np.linalg.norm(displacement)
    if length == 0.0:
        raise RelaxationError("without a displacement there is nothing to relax")
    return np.abs((positions - rest - displacement) @ (displacement / length))


def fit_relaxation(time: np.ndarray, error: np.ndarray) -> Relaxation:
    """Finds all peaks of ``error`` and fits zeta0 exp(-t/tau) to all of them by least squares.

    Both turning points of the oscillation are peaks of the absolute error, so the period is twice their mean
    distance.

    Parameters
    ----------
    time : (k,), in s, ascending.
    error : (k,), distance from the new rest, in units, not negative.

    Raises
    ------
    RelaxationError : fewer than three peaks, values that are not finite, or no fit.
    """
    if not np.all(np.isfinite(error)):
        raise RelaxationError("the motion is not finite")
    entries, _ = find_peaks(error, height=_ROUNDING * np.max(error, initial=0.0))
    if entries.size < 3:
        raise RelaxationError(f"{entries.size} peaks are too few to fit an envelope")
    times, heights = time[entries], error[entries]
    try:
        # The fit starts from the time in which the peaks fall to less than half of the largest one.
        low = np.flatnonzero(heights < 0.5 * heights.max())
        start = times[low[0]] - times[0] if low.size and low[0] > 0 else times[-1] - times[0]
        # In units of the first guess the fit is well scaled for every displacement and time step.
        parameters, covariance = curve_fit(
            lambda t, amplitude, tau: amplitude * np.exp(-t / tau),
            times / start,
            heights / heights.max(),
            p0=(1.0, 1.0),
        )
    except RuntimeError as error_of_fit:
        raise RelaxationError("the peaks do not fit an exponential") from error_of_fit
    errors = np.sqrt(np.diag(covariance))
    return Relaxation(
        amplitude=float(parameters[0] * heights.max()),
        amplitude_error=float(errors[0] * heights.max()),
        time=float(parameters[1] * start),
        time_error=float(errors[1] * start),
        period=float(2.0 * np.mean(np.diff(times))),
        peak_entries=entries,
        peak_times=times,
        peak_heights=heights,
    )
