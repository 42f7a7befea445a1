"""Relaxation of the last sphere: peaks, envelope and period of a damped oscillation.

The thesis takes the local maxima zeta(t) of the last sphere's displacement error and fits eq. 4.3,
zeta(t) = zeta0 exp(-t/tau), to all of them. The largest sample of a
half period lies below its peak, by up to 1 - cos(pi/s) where a period has s samples: 10 % at seven. So the damped
oscillation |A exp(-t/tau) cos(w t + p)| is fitted to all samples first, and each peak is interpolated by one of its
decay and frequency through three samples. The thesis takes the largest
samples. Faster modes raise the first peaks, and with them tau: by 4 % at 100 iterations of the default run.
`slowest_time` is the tau of the samples from a period after the first peak on.

`read_relaxation` measures the tip of any run whose wire is let go. Where loads or a shape of its own decide about the
new rest, that is found together with the oscillation.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import curve_fit, least_squares
from scipy.signal import find_peaks

from guidewire.logs.logs import read_log
from guidewire.logs.runs import Run, read_run

_ROUNDING = 1e-10  # of the largest distance: peaks below it are noise of the last digits, not of the oscillation
_FEWEST = 3  # peaks, of a fit
_LATER = 2  # peaks of the absolute error in a period, after which faster modes are gone
_PERIODS = (1.0, 0.8, 0.9, 1.1, 1.25)  # over what the peaks say
_POOR = 0.05  # of the motion: what the fit may leave out without a word
_ROUNDS = 12  # at most, in which the new rest and the oscillation about it are found in turns
_SETTLED = 1e-5  # of the motion: a change of the new rest that ends them
_NEVER = 1e9  # s, the default of tipForceReleaseTime
_DRIVEN = ("vessel", "obstacles", "sheath", "catheters", "loadTables", "proximalMotionFile", "distalMotionFile")
_LOADS = ("gravity", "distributedForce", "tipForce", "tipFollowerForce", "tipMoment", "pointLoads")
_SHAPES = ("startFile", "start", "restCurvature", "wireSections")


class RelaxationError(Exception):
    """A motion that has no relaxation time. The message is one line."""


class RelaxationWarning(UserWarning):
    """A motion that is not one damped oscillation: its standard errors do not tell how far off tau is."""


@dataclass(frozen=True)
class Relaxation:
    """Envelope zeta0 exp(-t/tau) of a damped oscillation, which touches its turning points.

    Attributes
    ----------
    amplitude, amplitude_error : zeta0 and its standard error, in units.
    time, time_error : tau and its standard error, in s. The distance from `slowest_time` is part of the errors.
    slowest_time : tau of the slowest mode, in s.
    period : of the oscillation, in s.
    peak_entries : (p,) of int, index of the largest sample of each peak in the series given.
    peak_times, peak_heights : (p,), of the peaks, in s and units.
    misfit : RMS of what the slowest mode leaves of the samples, over that of the samples, dimensionless.
    """

    amplitude: float
    amplitude_error: float
    time: float
    time_error: float
    slowest_time: float
    period: float
    peak_entries: np.ndarray
    peak_times: np.ndarray
    peak_heights: np.ndarray
    misfit: float

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


def is_released(parameters: Mapping[str, Any]) -> bool:
    """Whether parameters are those of a wire that is let go, and whose tip then moves freely.

    Parameters
    ----------
    parameters : by key; those that are left out have their defaults.
    """
    if parameters.get("drive", "hold") != "hold" or parameters.get("distalEnd", "free") != "free":
        return False
    if any(parameters.get(key) for key in _DRIVEN):
        return False
    if parameters.get("displacement", 10.0 if _is_pbd(parameters) else 0.0) or _release(parameters) > 0.0:
        return True
    return parameters.get("initialState", "straight") == "straight" and (
        parameters.get("startShape", "straight") != "straight"
        or any(_is_set(parameters.get(key)) for key in (*_LOADS, *_SHAPES)))


def read_relaxation(run: Run | str | Path) -> Relaxation:
    """Relaxation of the tip of a wire that is let go, about the rest that it comes to.

    Parameters
    ----------
    run : a run with a log, or its folder. The wire is displaced at the start, its tip force ends, or its start is not
        its rest.

    Raises
    ------
    RelaxationError : the wire is not let go, or its tip does not swing about a rest.
    guidewire.logs.logs.LogError : the run cannot be read, or left no log.

    Warns
    -----
    RelaxationWarning : the slowest mode leaves more than 5 % of the motion.
    """
    run = run if isinstance(run, Run) else read_run(run)
    if not is_released(run.parameters):
        raise RelaxationError("the wire is not let go: it is driven, held at its tip, or touches walls")
    log = read_log(run.folder)
    start = _release(run.parameters)
    # The last step is logged too where logEvery skips it.
    steps = np.diff(log.steps, prepend=log.steps[0])
    taken = (log.time >= start) & ((steps == steps[1:2]) | (steps == 0))
    time, tip = log.time[taken], log.positions[taken, 0]
    if _is_pbd(run.parameters) and not _is_set(run.parameters.get("gravity")):
        found = fit_relaxation(time, relaxation_error(tip, run.rest_positions[-1], run.displacement))
    else:
        found = _about_its_rest(time, tip)
    if not found.time_error < found.time:
        raise RelaxationError(f"the peaks do not decide the relaxation time: {found.time:.3g} s with a standard error "
                              f"of {found.time_error:.1g} s")
    return found


def _is_pbd(parameters: Mapping[str, Any]) -> bool:
    return parameters.get("solver", "pbd") == "pbd"


def _is_set(value: Any) -> bool:
    """Whether a load or shape is there: a vector may be three numbers or an object of them."""
    if isinstance(value, Mapping):
        return any(value.values())
    return any(value) if isinstance(value, list) else bool(value)


def _release(parameters: Mapping[str, Any]) -> float:
    """Time at which the tip force ends, s; 0 where none does."""
    time = parameters.get("tipForceReleaseTime", _NEVER)
    ends = isinstance(time, (int, float)) and time < _NEVER
    return time if ends and _is_set(parameters.get("tipForce")) else 0.0


def _about_its_rest(time: np.ndarray, tip: np.ndarray) -> Relaxation:
    """Fit along the direction in which the tip, (k, 3) in units, moves most. Given decay and frequency, the rest is
    the constant of a linear fit; given the rest, they are those of the distances from it. The first ones are those of
    the differences from step to step, in which no rest appears."""
    moved = tip - tip.mean(axis=0)
    if len(time) <= _FEWEST or not np.all(np.isfinite(tip)):
        return fit_relaxation(time, np.linalg.norm(moved, axis=-1))
    motion = moved @ np.linalg.svd(moved, full_matrices=False)[2][0]
    rest, size = math.nan, float(np.ptp(motion))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RelaxationWarning)
        found = fit_relaxation(0.5 * (time[1:] + time[:-1]), np.abs(np.diff(motion)))
        for _ in range(_ROUNDS):
            later = time >= found.peak_times[min(_LATER, len(found.peak_times) - 1)]
            decay, turn = np.exp(-time[later] / found.slowest_time), 2.0 * math.pi / found.period * time[later]
            basis = np.stack([np.ones(np.sum(later)), decay * np.cos(turn), decay * np.sin(turn)], axis=1)
            before, rest = rest, float(np.linalg.lstsq(basis, motion[later], rcond=None)[0][0])
            found = fit_relaxation(time, np.abs(motion - rest))
            if abs(rest - before) < _SETTLED * size:
                break
    return fit_relaxation(time, np.abs(motion - rest))


@dataclass(frozen=True)
class _Oscillation:
    """|A exp(-t/tau) cos(w t + p)|, fitted to samples.

    Attributes
    ----------
    envelope : of its turning points at time 0, in units.
    time, time_error : tau and its standard error, in s.
    period : in s.
    phase : p, in rad.
    misfit : as of Relaxation.
    """

    envelope: float
    time: float
    period: float
    phase: float
    time_error: float = 0.0
    misfit: float = 0.0


def fit_relaxation(time: np.ndarray, error: np.ndarray, as_published: bool = False) -> Relaxation:
    """Finds all peaks of ``error`` and fits zeta0 exp(-t/tau) to all of them by least squares.

    Parameters
    ----------
    time : (k,), in s, ascending, evenly spaced.
    error : (k,), distance from the new rest, in units, not negative.
    as_published : take the largest sample of each peak, as the thesis does, and not the peak between samples.

    Raises
    ------
    RelaxationError : fewer than three peaks, values that are not finite, or no fit.

    Warns
    -----
    RelaxationWarning : the slowest mode leaves more than 5 % of the motion.

    Notes
    -----
    Below 4 samples a period the absolute values have a longer period too, which is found. Its decay is the same.
    """
    if not np.all(np.isfinite(error)):
        raise RelaxationError("the motion is not finite")
    entries, _ = find_peaks(error, height=_ROUNDING * np.max(error, initial=0.0))
    if entries.size < _FEWEST:
        raise RelaxationError(f"{entries.size} peaks are too few to fit an envelope")
    height, decay, _ = _envelope(time[entries], error[entries])
    # Both turning points of the oscillation are peaks of the absolute error.
    period = float(2.0 * np.mean(np.diff(time[entries])))
    periods = [factor * period for factor in _PERIODS]
    guesses = [_Oscillation(height, decay, one, -2.0 * math.pi * float(time[entries[0]]) / one) for one in periods]
    slowest = _slowest_mode(time, error, entries, guesses)
    if as_published:
        times, heights = time[entries], error[entries]
    else:
        entries, times, heights = _interpolated(time, error, entries, slowest)
    amplitude, tau, errors = _envelope(times, heights)
    time_error = math.hypot(errors[1], slowest.time_error, tau - slowest.time)
    if slowest.misfit > _POOR:
        warnings.warn(f"the motion is not one damped oscillation, which leaves {100.0 * slowest.misfit:.2g} % of it: "
                      f"the relaxation time {tau:.3g} s may be farther off than its standard error "
                      f"{time_error:.1g} s", RelaxationWarning, stacklevel=2)
    return Relaxation(
        amplitude=amplitude,
        amplitude_error=math.hypot(errors[0], amplitude - slowest.envelope),
        time=tau,
        time_error=time_error,
        slowest_time=slowest.time,
        period=slowest.period,
        peak_entries=entries,
        peak_times=times,
        peak_heights=heights,
        misfit=slowest.misfit,
    )


def _envelope(times: np.ndarray, heights: np.ndarray) -> tuple[float, float, np.ndarray]:
    """zeta0 and tau through all peaks, and their standard errors."""
    # The fit starts from the time in which the peaks fall to less than half of the largest one.
    low = np.flatnonzero(heights < 0.5 * heights.max())
    start = times[low[0]] - times[0] if low.size and low[0] > 0 else times[-1] - times[0]
    scale = np.array([heights.max(), start])
    try:
        # In units of the first guess the fit is well scaled for every displacement and time step.
        parameters, covariance = curve_fit(lambda t, amplitude, tau: amplitude * np.exp(-t / tau), times / start,
                                           heights / heights.max(), p0=(1.0, 1.0))
    except RuntimeError as error_of_fit:
        raise RelaxationError("the peaks do not fit an exponential") from error_of_fit
    amplitude, tau = scale * parameters
    return float(amplitude), float(tau), scale * np.sqrt(np.diag(covariance))


def _slowest_mode(time: np.ndarray, error: np.ndarray, entries: np.ndarray, guesses: Sequence[_Oscillation]
                  ) -> _Oscillation:
    """The oscillation from a period after the first peak on, where there are enough peaks. What yet another period
    changes is part of its error: so much of faster modes may be left."""
    after = [entries[k] for k in (0, _LATER, 2 * _LATER) if entries.size >= _FEWEST + k]
    # Where a period has few samples there are more peaks than half periods, or fewer.
    found = min((_fit_of_samples(time, error, after[0], guess) for guess in guesses), key=lambda fit: fit.misfit)
    if len(after) > 1:
        found = _fit_of_samples(time, error, after[1], found)
    if len(after) < 3:
        return found
    later = _fit_of_samples(time, error, after[2], found)
    return replace(found, time_error=math.hypot(found.time_error, later.time - found.time))


def _fit_of_samples(time: np.ndarray, error: np.ndarray, start: int, guess: _Oscillation) -> _Oscillation:
    """Fit of all samples from an entry on, which is near a peak. Unknowns are the logarithm of the envelope at that
    entry over its sample, decay and frequency over those of the guess, and the phase there."""
    t, scale = time[start:] - time[start], error[start]
    samples = error[start:] / scale
    turn = 2.0 * math.pi / guess.period
    begin = math.log(guess.envelope / scale) - time[start] / guess.time, 1.0, 1.0, guess.phase + turn * time[start]

    def residuals(x: np.ndarray) -> np.ndarray:
        return np.abs(np.exp(x[0] - x[1] * t / guess.time) * np.cos(x[2] * turn * t + x[3])) - samples

    found = least_squares(residuals, begin, xtol=1e-13, ftol=1e-13, gtol=1e-13)
    decay, frequency = found.x[1] / guess.time, abs(found.x[2]) * turn
    if not found.success or frequency == 0.0 or decay == 0.0:
        raise RelaxationError("the motion does not fit a damped oscillation")
    # Residuals of a half period go together: a faster mode, or the wrong period, is no independent noise.
    half = (t * frequency / math.pi).astype(int)
    scores = np.zeros((half[-1] + 1, 4))
    np.add.at(scores, half, found.jac * found.fun[:, None])
    spread = np.linalg.pinv(found.jac.T @ found.jac)
    covariance = spread @ (scores.T @ scores) @ spread
    # |cos| turns where tan(w t + p) = -1/(w tau): there it is the cosine of that angle.
    shape = frequency / math.hypot(frequency, decay)
    return _Oscillation(
        envelope=float(scale * shape * math.exp(found.x[0] + decay * time[start])),
        time=float(1.0 / decay),
        time_error=float(math.sqrt(covariance[1, 1]) / abs(found.x[1] * decay)),
        period=2.0 * math.pi / frequency,
        phase=float(found.x[3] * math.copysign(1.0, found.x[2]) - frequency * time[start]),
        misfit=float(np.linalg.norm(found.fun) / np.linalg.norm(samples)),
    )


def _interpolated(time: np.ndarray, error: np.ndarray, entries: np.ndarray, slowest: _Oscillation
                  ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Entries, times and heights of the peaks. An oscillation of the slowest mode's decay and frequency goes through
    the largest sample and its neighbours; of these one may have the other sign, which the absolute error hides."""
    step = float(np.median(np.diff(time)))
    decay, turn = step / slowest.time, 2.0 * math.pi * step / slowest.period
    beside = np.array([-1.0, 0.0, 1.0])
    basis = np.exp(-decay * beside)[:, None] * np.stack([np.cos(turn * beside), np.sin(turn * beside)], axis=1)
    signed = [np.array(signs)[:, None] * np.stack([error[entries - 1], error[entries], error[entries + 1]])
              for signs in ((1, 1, 1), (-1, 1, 1), (1, 1, -1))]
    found = [np.linalg.lstsq(basis, samples, rcond=None)[0] for samples in signed]
    off = [np.sum((basis @ parts - samples) ** 2, axis=0) for parts, samples in zip(found, signed)]
    cosine, sine = np.take_along_axis(np.stack(found), np.argmin(off, axis=0)[None, None], axis=0)[0]
    late = (np.arctan2(sine, cosine) - math.atan2(decay, turn)) / turn    # from the sample to the peak, in steps
    heights = np.hypot(cosine, sine) * np.exp(-decay * late) * turn / math.hypot(turn, decay)
    times = time[entries] + late * step
    # With few samples two of a half period may both be larger than their neighbours.
    first = np.flatnonzero(np.diff(times, prepend=-math.inf) > 0.25 * slowest.period)
    return entries[first], times[first], heights[first]
