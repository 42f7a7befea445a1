"""The values of a scene's unknowns that bring its run nearest to measurements, by least squares.

The residuals r are offsets from the run to measured points or values, each measurement's over the RMS that it ends
with. With J = dr/dp, the covariance of the values is s^2 (J^T J)^-1, s^2 = |r|^2/(N - p), N the independent residuals;
an interval of 95 % is t times the standard error, t of Student's distribution with N - p degrees of freedom.

That holds where |r|^2 grows by s^2 t^2 up to the ends of the interval. With friction it need not: results jump by
some um between near values, and a tip that sticks hardly moves over a range of them, so a Jacobian is that of one
branch or of the jumps. Where |r|^2 grows by anything else, no Jacobian enters the intervals: each reaches to where
|r|^2, with the other unknowns fitted, has grown for good by 2 s^2 F(0.95; 2, N - p) (`_profile`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import OptimizeResult, least_squares
from scipy.stats import f as fisher
from scipy.stats import t as student

from guidewire.identification.critical import find_critical
from guidewire.identification.identified import Identified, Value
from guidewire.identification.residuals import ALIGNMENTS, Cameras, Residuals, residuals
from guidewire.identification.trials import Trials, effective
from guidewire.identification.unknowns import Unknown, overrides, unknowns_of
from guidewire.logs.logs import LogError
from guidewire.logs.measurement import Measurement, read_measurement
from guidewire.prepare import PreparationError
from guidewire.runs import building, checking

MOST_TRIALS = 400    # sets of values
_STEP = 1e-3    # of a difference quotient, in scales
_EXACT = 1e-4   # in scales: of the values at the end
_SINGULAR = 1e-5    # ratio of singular values, below which difference quotients say nothing
_SETTLED = 1e-5    # of the sum of squares: less than that no step gains, a thirtieth of a standard error or so
_TRUSTED = 0.5    # of the decrease that a Jacobian promised: having had so much, it is corrected, not found anew
_RIVAL = 12.0    # of a sum of squares over the variance: values that fit no worse than that are not ruled out
_STRAIGHT = 0.2    # reach of the least certain direction, in scales, within which the valley is taken for straight
_DOWN, _LEVEL = 8, 0.002    # steps down into the valley at most, and a step that is none
_AGAIN = 3    # searches with a Jacobian found anew at their end
_USELESS = 1.0    # standard error, in scales, beyond which a value is none
_SHARE = 0.1    # of a direction, above which an unknown takes part in it
_AS_TOLD = 0.6, 1.6    # growth of |r|^2 at the ends of an interval over what the Jacobian says
_UNLIKE = 0.25    # of a change of residuals: what the Jacobian may be off
_FINEST = 1e-3    # first step of a profile at least, in scales: below it are jumps
_WIDER = 1.5    # ratio of the steps of a profile
_OUTSIDE = 3    # so many values in a row beyond an interval end it
_MOST_STEPS = 24    # of a profile, on either side
_CENTRES = 4    # profiles of all unknowns, each around the best values so far
_TOO_LONG, _TOO_SHORT = 3.0, 0.02    # extent of measured points over the wire's length


def identify(scene: str | Path | Mapping[str, Any], measured: Sequence[str | Path] | str | Path,
             fit: Sequence[str] | str,
             align: str = "none", cameras: Mapping[str, Any] | None = None,
             bounds: Mapping[str, tuple[float, float]] | None = None, settings: Mapping[str, Any] | None = None,
             jobs: int | None = None, tell: Callable[[str], None] = lambda line: None) -> Identified:
    """Find values of a scene from measurements.

    Parameters
    ----------
    scene : parameter file, or its contents; each unknown starts from its value there.
    measured : files of measurements (guidewire.logs.measurement).
    fit : keys, or parts of keys, that are sought.
    align : "none", "plane" or "rigid": whether the measured points lie in a frame of their own.
    cameras : matrices (3, 4) of pictures by view.
    bounds : lowest and highest value by key.
    settings : parameters that override the scene's.
    jobs : runs at once; None: one a processor.
    tell : called with a line for each step of the search.

    Raises
    ------
    PreparationError : the scene, a measurement or a key cannot be used; one line.
    """
    files = [measured] if isinstance(measured, (str, Path)) else list(measured)
    keys = [fit] if isinstance(fit, str) else list(fit)
    if not files or not keys:
        raise PreparationError("needs at least one measurement and one key to fit")
    if align not in ALIGNMENTS:
        raise PreparationError(f"align = {align!r} is not allowed: needs one of {', '.join(ALIGNMENTS)}")
    views = {str(name): _camera(str(name), matrix) for name, matrix in (cameras or {}).items()}
    given = isinstance(scene, Mapping)
    fixed = {**(scene if given else {}), **(settings or {})}
    with Trials(building.build(building.RUNNER, tell), None if given else Path(scene), fixed, jobs) as trials:
        try:
            return _Search(trials, [Path(file) for file in files], keys, align, views, bounds or {}, tell).run()
        except LogError as error:
            raise PreparationError(str(error)) from error


def _camera(view: str, matrix: Any) -> np.ndarray:
    made = np.asarray(matrix, dtype=float)
    if made.shape != (3, 4) or not np.all(np.isfinite(made)):
        raise PreparationError(f"camera \"{view}\": needs 3 rows of 4 finite numbers")
    return made


class _Search:
    """One search."""

    def __init__(self, trials: Trials, files: Sequence[Path], keys: Sequence[str], align: str, cameras: Cameras,
                 bounds: Mapping[str, tuple[float, float]], tell: Callable[[str], None]) -> None:
        self._trials, self._align, self._cameras, self._tell = trials, align, cameras, tell
        self._failed: list[str] = []
        self._tried = 0
        (folder,) = trials.run([{}])
        if isinstance(folder, str):
            raise PreparationError(f"the scene does not run as it is: {folder}")
        self._scene = effective(folder)
        self._measured = [read_measurement(file, float(self._scene.get("metresPerUnit", 1.0))) for file in files]
        self._unknowns = unknowns_of(keys, self._scene, checking.read_table(), bounds)
        self._needs_hub = any(not one.shapes and not one.critical for one in self._measured)
        count = sum(one.count for one in self._measured)
        if count < len(self._unknowns):
            raise PreparationError(f"{count} measured values for {len(self._unknowns)} unknowns: measure more or "
                                   "seek less")
        for one in self._measured:
            _check_size(one, self._scene)
        self._weights = [_first_weight(one) for one in self._measured]
        self._best: tuple[float, np.ndarray, list[Residuals]] | None = None
        self._last: tuple[np.ndarray, np.ndarray] | None = None    # steps and residuals
        self._model: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None    # the same with their Jacobian
        self._rival: np.ndarray | None = None    # steps that fit nearly as well
        self._bend: list[np.ndarray] = []    # steps that bound what is certain
        self._profiles: list[tuple[float, float]] = []    # ends of the interval of each step, without a Jacobian

    def run(self) -> Identified:
        """Search, weigh the measurements by what they end with, and search once more where there are several."""
        low, high = (np.array([one.step(getattr(one, name)) for one in self._unknowns]) for name in ("low", "high"))
        at = np.zeros(len(self._unknowns))
        is_complete = True
        try:
            found = self._search(at, low, high)
            if len(self._measured) > 1:
                self._weights = [1.0 / max(part.rms, 1e-12) for part in self._best[2]]
                found = self._search(found.x, low, high)
            best = self._other_side(found, low, high)
            jacobian = best.jac
            is_as_told = self._is_as_told(best, low, high)
            self._bend = self._valley(best, low, high)
            if not is_as_told:
                self._profiles = self._all_profiles(jacobian, low, high)
        except KeyboardInterrupt:
            if self._best is None:
                raise
            is_complete = False
            jacobian = np.zeros((1, len(self._unknowns)))
        return self._result(self._best[1], self._best[2], jacobian, low, high, is_complete)

    def _search(self, at: np.ndarray, low: np.ndarray, high: np.ndarray) -> OptimizeResult:
        self._best = self._last = self._model = self._rival = None    # what counts as best depends on the weights
        start = self._residual(at)
        self._bad = 1e3 * np.abs(start) + 1e3 * float(np.linalg.norm(start) / math.sqrt(len(start)))
        return self._descend(at, low, high)

    def _other_side(self, found: OptimizeResult, low: np.ndarray, high: np.ndarray) -> OptimizeResult:
        """Return the better one of what was found and of a search from a standard error beyond its mirror image: a
        curvature of either sign, with other stiffnesses, may make nearly the same shape, and each is the end of a
        search that begins on its side. A search whose first step goes back across is given up. The worse one is kept
        where it cannot be ruled out."""
        variance = 2.0 * found.cost / self._free()
        error = np.sqrt(np.diag(_covariance(self._unknowns, found.jac, math.sqrt(variance))[0]))
        # What the measurement does not show at all has no other side.
        signed = np.array([not one.by_ratio for one in self._unknowns]) & np.isfinite(error)
        reach = np.sign(found.x) * np.minimum(error, 2.0 * _USELESS)
        at = np.clip(np.where(signed, -found.x - reach, found.x), low, high)
        if np.allclose(at, found.x, rtol=0.0, atol=_EXACT) or self._residual(at) is self._bad:
            return found
        try:
            step = np.linalg.lstsq(self._jacobian(at), -self._residual(at), rcond=_SINGULAR)[0]
            if not np.any((found.x * (at + step))[signed] < 0.0):
                return found
            other = self._descend(at, low, high)
        except PreparationError:    # no runs there
            return found
        better, worse = (other, found) if other.cost < found.cost else (found, other)
        if 2.0 * (worse.cost - better.cost) < _RIVAL * variance:
            self._rival = worse.x
        return better

    def _free(self) -> int:
        """Independent residuals less unknowns."""
        return max(sum(part.independent for part in self._best[2]) - len(self._unknowns), 1)

    def _valley(self, found: OptimizeResult, low: np.ndarray, high: np.ndarray) -> list[np.ndarray]:
        """Steps at both ends of the 95 % of the least certain direction: the valley of what fits may be bent, so that
        other unknowns change there by far more than a linear model says."""
        free = self._free()
        _, sizes, rows = np.linalg.svd(found.jac, full_matrices=False)
        reach = float(student.ppf(0.975, free)) * math.sqrt(2.0 * found.cost / free) / max(sizes[-1], 1e-300)
        if len(sizes) < 2 or not _STRAIGHT < reach < 2.0 * _USELESS:
            return []
        ends = []
        for sign in (-1.0, 1.0):
            at = np.clip(found.x + sign * reach * rows[-1], low, high)
            shift = np.array([math.inf])
            for _ in range(_DOWN):
                made = self._residual(at)
                if made is self._bad or np.abs(shift).max() < _LEVEL:
                    break
                # Down into the valley, across the direction.
                shift = rows[:-1].T @ np.linalg.lstsq(found.jac @ rows[:-1].T, made, rcond=None)[0]
                at = np.clip(at - shift, low, high)
            if made is not self._bad:
                ends.append(at)
        return ends

    def _quantile(self) -> float:
        """Student's t of an interval of 95 %."""
        return float(student.ppf(0.975, self._free()))

    def _reaches(self) -> float:
        """Standard errors from the middle to the end of an interval of a profile."""
        return math.sqrt(2.0 * float(fisher.ppf(0.95, 2, self._free())))

    def _allowed(self, branches: bool = False) -> float:
        """By how much the sum of squares may grow within an interval. Which of several branches a result is on counts
        as one more unknown: the best of them fits better by chance than one would."""
        return self._best[0] / self._free() * (self._reaches() if branches else self._quantile()) ** 2

    def _is_as_told(self, found: OptimizeResult, low: np.ndarray, high: np.ndarray) -> bool:
        """Return whether a Jacobian tells the intervals. Of one unknown the sum of squares has to grow as it says up to
        either end. Of several, whose valley may be bent in a smooth scene too, the residuals have to change as it says
        between places halfway to the ends, others fixed. An end beyond what tells a value is taken at that."""
        sizes = np.linalg.norm(found.jac, axis=0)
        seen = np.flatnonzero(sizes > _SINGULAR * max(float(sizes.max()), 1e-300))
        part = 1.0 if len(sizes) == 1 else 0.5
        reach = part * np.minimum(math.sqrt(self._allowed()) / np.maximum(sizes, 1e-300), _USELESS)
        ends = [np.clip(found.x + sign * row, low, high) for row in np.diag(reach)[seen] for sign in (-1.0, 1.0)]
        made = [None if parts is None else self._weighted(parts) for parts in self._compared(ends)]
        for first, last, here, there in zip(ends[::2], ends[1::2], made[::2], made[1::2]):
            if here is None or there is None:
                return False
            if len(sizes) > 1:
                told = found.jac @ (last - first)
                if np.linalg.norm(there - here - told) > _UNLIKE * np.linalg.norm(there - here):
                    return False
                continue
            for at, value in ((first, here), (last, there)):
                told = np.sum((found.jac @ (at - found.x)) ** 2)
                grown = value @ value - found.fun @ found.fun
                if told > 0.0 and not _AS_TOLD[0] < grown / told < _AS_TOLD[1]:
                    return False
        return True

    def _all_profiles(self, jacobian: np.ndarray, low: np.ndarray, high: np.ndarray) -> list[tuple[float, float]]:
        """The interval of each unknown, around the best values that any profile finds."""
        self._tried = 0    # of a search that has ended
        for _ in range(_CENTRES):
            before, ends = self._best[0], []
            for k in range(len(low)):
                ends.append(self._profile(k, jacobian, low, high))
            if self._best[0] > before - 0.1 * self._allowed(branches=True):
                break
        more = list(self._bend)
        if self._rival is not None:
            (parts,) = self._compared([self._rival])
            weighted = np.full(1, math.inf) if parts is None else self._weighted(parts)
            more += [self._rival] if weighted @ weighted <= self._best[0] + self._allowed(branches=True) else []
        return [(min([first, *(one[k] for one in more)]), max([last, *(one[k] for one in more)]))
                for k, (first, last) in enumerate(ends)]

    def _profile(self, k: int, jacobian: np.ndarray, low: np.ndarray, high: np.ndarray) -> tuple[float, float]:
        """Return the outermost steps of an unknown between which the sum of squares has not grown for good."""
        middle, others = self._best[1], np.delete(np.arange(len(low)), k)
        along = np.eye(len(low))[k]
        if len(others):    # the other unknowns change with it as the Jacobian says, and are then fitted
            along[others] = -np.linalg.lstsq(jacobian[:, others], jacobian[:, k], rcond=_SINGULAR)[0]
        size = float(np.linalg.norm(jacobian @ along))
        first = min(max(0.25 * math.sqrt(self._allowed(branches=True)) / max(size, 1e-300), _FINEST), 0.1 * _USELESS)
        known = {0.0: self._best[0]}
        for sign in (-1.0, 1.0):
            offsets = sign * first * (_WIDER ** np.arange(_MOST_STEPS) - 1.0) / (_WIDER - 1.0)
            for batch in np.split(offsets[1:], range(_OUTSIDE, _MOST_STEPS - 1, _OUTSIDE)):
                batch = batch[np.abs(batch) <= 2.0 * _USELESS]
                made = self._squares_at([middle + offset * along for offset in batch], others, jacobian, low, high)
                known.update(zip(batch.tolist(), made))
                if len(made) < _OUTSIDE or min(made) > self._best[0] + self._allowed(branches=True):
                    break
        limit = self._best[0] + self._allowed(branches=True)
        for _ in range(3):    # where it leaves the interval more finely
            outer = self._ends_of(known, limit)
            halves = [0.5 * (a + b) for a, b in outer if b is not None]
            known.update(zip(halves, self._squares_at([middle + offset * along for offset in halves], others, jacobian,
                                                      low, high)))
        (first_in, first_out), (last_in, last_out) = self._ends_of(known, limit)
        return (-math.inf if first_out is None else middle[k] + 0.5 * (first_in + first_out),
                math.inf if last_out is None else middle[k] + 0.5 * (last_in + last_out))

    def _ends_of(self, known: Mapping[float, float], limit: float) -> list[tuple[float, float | None]]:
        """The lowest and the highest offset within a limit, each with the next one beyond it, if there is one."""
        places = sorted(known)
        inside = [i for i, offset in enumerate(places) if known[offset] <= limit]
        return [(places[i], places[i + step] if 0 <= i + step < len(places) else None)
                for i, step in ((inside[0], -1), (inside[-1], 1))]

    def _squares_at(self, many: Sequence[np.ndarray], others: np.ndarray, jacobian: np.ndarray, low: np.ndarray,
                    high: np.ndarray) -> list[float]:
        """Sums of squares, the least of those with other unknowns as they are and once fitted; infinite without a
        result or beyond a bound."""
        made = [math.inf] * len(many)
        left = {i: np.array(at) for i, at in enumerate(many) if np.all((at >= low) & (at <= high))}
        for _ in range(_DOWN if len(others) else 1):
            for i, parts in zip(list(left), self._compared(list(left.values()))):
                at = left.pop(i)
                if parts is None:
                    continue
                weighted = self._weighted(parts)
                squares = float(weighted @ weighted)
                if squares < self._best[0]:
                    self._best = squares, np.array(at), parts
                step = np.linalg.lstsq(jacobian[:, others], weighted, rcond=_SINGULAR)[0]
                if squares < made[i] and np.any(np.abs(step) > _LEVEL):
                    left[i] = at
                    left[i][others] = np.clip(at[others] - step, low[others], high[others])
                made[i] = min(made[i], squares)
            if not left:
                break
        return made

    def _descend(self, at: np.ndarray, low: np.ndarray, high: np.ndarray) -> OptimizeResult:
        """Searches until a Jacobian found anew promises no more."""
        for _ in range(_AGAIN):
            found = self._least(at, low, high)
            at, self._model = found.x, None
            found.jac = self._jacobian(at)
            step = np.clip(at - np.linalg.lstsq(found.jac, found.fun, rcond=_SINGULAR)[0], low, high) - at
            left = found.fun + found.jac @ step
            if found.fun @ found.fun - left @ left <= _SETTLED * (found.fun @ found.fun) or np.abs(step).max() < _EXACT:
                break
        return found

    def _least(self, at: np.ndarray, low: np.ndarray, high: np.ndarray) -> OptimizeResult:
        return least_squares(self._residual, at, jac=self._jacobian, bounds=(low, high), method="trf", x_scale=1.0,
                             xtol=_EXACT, ftol=_SETTLED, gtol=1e-12, max_nfev=60)

    def _residual(self, steps: np.ndarray) -> np.ndarray:
        """Weighted residuals; of a run without a result those of the start, times a thousand: never taken for
        better."""
        if self._last is not None and np.array_equal(self._last[0], steps):
            return self._last[1]
        parts = self._compared([steps])[0]
        if parts is None:
            if self._best is None:
                raise PreparationError(f"the scene's own values give no run to compare: {self._failed[-1]}")
            return self._bad
        made = self._weighted(parts)
        self._last = np.array(steps), made
        if self._best is None or made @ made < self._best[0]:
            self._best = float(made @ made), np.array(steps), parts
            self._tell(f"run {self._trials.made}: " + ", ".join(
                f"{one.key} = {one.value(step):.6g}" for one, step in zip(self._unknowns, steps)))
        return made

    def _jacobian(self, steps: np.ndarray) -> np.ndarray:
        """Return the last one, corrected by what the step from there has changed (Broyden), where it promised well;
        else difference quotients."""
        base = self._residual(steps)
        if self._model is not None:
            at, residual, jacobian = self._model
            step = steps - at
            told = residual + jacobian @ step
            gain, promised = residual @ residual - base @ base, residual @ residual - told @ told
            if step @ step == 0.0:
                return jacobian
            if promised > 0.0 and gain > _TRUSTED * promised:
                jacobian = jacobian + np.outer(base - told, step) / (step @ step)
                self._model = np.array(steps), base, jacobian
                return jacobian
        jacobian = self._quotients(steps, base)
        self._model = np.array(steps), base, jacobian
        return jacobian

    def _quotients(self, steps: np.ndarray, base: np.ndarray) -> np.ndarray:
        """Difference quotients, all runs side by side; backwards where the run forwards has no result."""
        columns = []
        ahead = self._compared([steps + _STEP * row for row in np.eye(len(steps))])
        for k, (one, parts) in enumerate(zip(self._unknowns, ahead)):
            sign = 1.0
            if parts is None:
                (parts,), sign = self._compared([steps - _STEP * np.eye(len(steps))[k]]), -1.0
            if parts is None:
                raise PreparationError(f"{one.key}: no run on either side of {one.value(steps[k]):.6g}: "
                                       f"{self._failed[-1]}")
            columns.append(sign * (self._weighted(parts) - base) / _STEP)
        return np.stack(columns, axis=1)

    def _weighted(self, parts: Sequence[Residuals]) -> np.ndarray:
        return np.concatenate([weight * part.offsets.ravel() for weight, part in zip(self._weights, parts)])

    def _compared(self, many: Sequence[np.ndarray]) -> list[list[Residuals] | None]:
        """Return every run's residuals, of each measurement; None where there is no result."""
        self._tried += len(many)
        if self._tried > MOST_TRIALS:
            raise PreparationError(f"no end of the search after {MOST_TRIALS} sets of values: give bounds, or "
                                   "start nearer")
        asked = [self._overrides(steps) for steps in many]
        folders = self._trials.run(asked)
        made = [self._compare(folder, values) for folder, values in zip(folders, asked)]
        for folder in folders:
            self._trials.forget(folder)
        return made

    def _compare(self, folder: Path | str, values: Mapping[str, Any]) -> list[Residuals] | None:
        if isinstance(folder, str):
            self._failed.append(folder)
            self._tell(f"a run without a result, which is passed over: {folder}")
            return None
        parts = []
        for one in self._measured:
            if one.critical:
                value = find_critical(self._trials, values, self._scene, one.critical, float(np.mean(one.values)))
                parts.append(Residuals((one.values - value)[:, None], (0,), len(one.values)))
            else:
                parts.append(residuals(folder, one, self._align, self._cameras))
        if not all(np.all(np.isfinite(part.offsets)) for part in parts):
            self._failed.append("a number of the run is not finite")
            return None
        return parts

    def _overrides(self, steps: np.ndarray) -> dict[str, Any]:
        made = overrides(self._unknowns, [one.value(step) for one, step in zip(self._unknowns, steps)], self._scene)
        return {**made, **({"logHub": True} if self._needs_hub else {})}

    def _result(self, steps: np.ndarray, parts: list[Residuals], jacobian: np.ndarray, low: np.ndarray,
                high: np.ndarray, is_complete: bool) -> Identified:
        weighted = self._weighted(parts)
        free = self._free()
        deviation = math.sqrt((weighted @ weighted) / free)
        covariance, notes = np.full((len(steps), len(steps)), np.inf), []
        if is_complete:
            covariance, notes = _covariance(self._unknowns, jacobian, deviation)
        errors = np.sqrt(np.diag(covariance))
        quantile = self._quantile()
        if self._profiles:
            errors = np.array([last - first for first, last in self._profiles]) / (2.0 * self._reaches())
            notes = [_sentence(self._unknowns, row) for row, error in zip(np.eye(len(steps)), errors)
                     if error >= _USELESS]
            notes.append("the results of this scene jump, or change at unequal rates, as friction makes them: "
                         "intervals reach to where the fit is worse for good")
        values = []
        apart = np.zeros(len(steps), bool)
        if is_complete and self._rival is not None and not self._profiles:
            apart = np.abs(self._rival - steps) > quantile * errors
            others = " and ".join(f"{one.key} = {one.value(self._rival[k]):.4g} or {one.value(steps[k]):.4g}"
                                  for k, one in enumerate(self._unknowns) if apart[k])
            if others:
                notes.append(f"{others}: two sets of values fit nearly equally well: this measurement does not "
                             "tell which")
        for k, one in enumerate(self._unknowns):
            at_bound = not low[k] + 1e-6 < steps[k] < high[k] - 1e-6
            is_told = not is_complete or errors[k] < _USELESS and not apart[k]
            if at_bound:
                notes.append(f"{one.key} ended at its bound {one.value(steps[k]):.6g}: its error says nothing")
            reach = quantile * errors[k]
            first, last = self._profiles[k] if self._profiles else (
                choose(side, *(end[k] for end in self._bend)) if self._bend else side
                for choose, side in ((min, steps[k] - reach), (max, steps[k] + reach)))
            size = one.value(steps[k]) if one.by_ratio else one.scale
            error = errors[k] if self._profiles or not self._bend else (last - first) / (2.0 * quantile)
            values.append(Value(one.key, one.unit, one.start, one.value(steps[k]) if is_told else None,
                                float(size * error), one.value(first) if math.isfinite(first) else -math.inf,
                                one.value(last) if last < 500.0 else math.inf, at_bound))
        for file, part in zip(self._measured, parts):
            if part.correlation > 0.5 and len(part.offsets) > 4:
                notes.append(f"{file.file.name}: neighbouring residuals agree (correlation {part.correlation:.2f}): "
                             "something systematic is left, of the model or of the frame, which the standard errors "
                             "do not count")
        with np.errstate(invalid="ignore"):
            correlation = covariance / np.sqrt(np.outer(np.diag(covariance), np.diag(covariance)))
        told = {one.key: one.value(step) for one, step in zip(self._unknowns, steps)}
        parameters = overrides(self._unknowns, list(told.values()), self._scene)
        return Identified(tuple(values), correlation, tuple(part.rms for part in parts), tuple(parts), tuple(notes),
                          self._trials.made, tuple(dict.fromkeys(self._failed)), parameters, is_complete)


def _covariance(unknowns: Sequence[Unknown], jacobian: np.ndarray, deviation: float) -> tuple[np.ndarray, list[str]]:
    """Covariance of the steps, and sentences on directions in which a change by a scale moves the residuals by less
    than their standard deviation. What takes part in a direction that is not seen at all has an infinite variance."""
    count = len(unknowns)
    covariance, notes, hidden = np.zeros((count, count)), [], np.zeros(count, bool)
    _, sizes, rows = np.linalg.svd(jacobian, full_matrices=False)
    for size, row in zip(sizes, rows):
        if size > _SINGULAR * sizes[0]:
            covariance += (deviation / size) ** 2 * np.outer(row, row)
        else:
            hidden |= np.abs(row) > _SHARE
    covariance[hidden, :] = covariance[:, hidden] = np.inf
    for size, row in zip(sizes, rows):
        if size <= _SINGULAR * sizes[0] or deviation > _USELESS * size:
            notes.append(_sentence(unknowns, row))
    return covariance, notes


def _sentence(unknowns: Sequence[Unknown], row: np.ndarray) -> str:
    taking = [k for k in range(len(unknowns)) if abs(row[k]) > _SHARE]
    names = " and ".join(unknowns[k].key for k in taking)
    if len(taking) == 1:
        return f"{names} hardly changes what was measured: it cannot be told from it"
    if all(unknowns[k].by_ratio for k in taking) and abs(np.sum(row[taking])) > 1.2 * np.linalg.norm(row[taking]):
        return f"{names}: only their ratio changes what was measured: each alone cannot be told"
    return f"{names} act alike on what was measured: they cannot be told apart"


def _first_weight(measured: Measurement) -> float:
    """Return one over a guess of the error, by which measurements are weighed before they are compared."""
    if measured.shapes:
        every = np.concatenate([shape.points for shape in measured.shapes])
        return 100.0 / max(float(np.linalg.norm(np.ptp(every, axis=0))), 1e-12)
    return 20.0 / max(float(np.max(np.abs(measured.values))), 1e-300)


def _check_size(measured: Measurement, scene: Mapping[str, Any]) -> None:
    if not measured.axes:
        return
    length = float(scene["guidewireLength"])
    every = np.concatenate([shape.points for shape in measured.shapes])
    size = float(np.linalg.norm(np.ptp(every, axis=0)))
    if not _TOO_SHORT * length < size < _TOO_LONG * length:
        raise PreparationError(f"{measured.file}: its points span {size:g} units, the wire is {length:g} long: "
                               "state their "
                                  "unit, such as x_mm, or the scene's metresPerUnit")
    if any(len(shape.points) < 3 for shape in measured.shapes):
        raise PreparationError(f"{measured.file}: a shape of fewer than 3 points")
