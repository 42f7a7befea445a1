"""Error and cost of each trial, and the choice among them.

What the error is of, `quantity` says: without a name the RMS distance of the wire from the reference's,
over points along the wire and times from start to end, over the RMS displacement of the reference's points.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from guidewire.advice import trials
from guidewire.advice.quantity import Quantity
from guidewire.advice.repeats import verdict
from guidewire.advice.trials import Trial
from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import Run, busiest, read_repeats
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check

REPEATS = 3  # timed ones
_TIMED = 12  # candidates that are timed, those of least work first
_TIMES = 81
_LOGGED = 400  # entries of a log
_LOST = ("diverged", "failed")
_STILL = 1e-9  # of L; what moves less does so by rounding


@dataclass(frozen=True)
class Tried:
    """What came of a trial.

    Attributes
    ----------
    trial : Trial
    error : not a number where the run was lost or passed a wall.
    moved : distance of its answer from that of the file as it is, measured as an error is.
    outcome : str
    work : as `trials.work` counts it, over the whole run.
    step : wall time of a step in ms, median of the timed repeats; None where it was not timed.
    total : wall time of all steps, s, the same.
    log : wall time that the log took, ms a step, the same.
    parameters : all effective values.
    others_busy : processors that other programs kept busy beside the repeat that they disturbed most.
    """

    trial: Trial
    error: float
    moved: float
    outcome: str
    work: float
    step: float | None
    total: float | None
    log: float | None
    parameters: Mapping[str, Any]
    others_busy: float | None = None


@dataclass(frozen=True)
class Advice:
    """It has what was found.

    Attributes
    ----------
    scene : the file as it is.
    reference : Tried
    reference_error : of coarser runs of the reference's kind, the worst: what the reference is known to, or worse.
    parts, searched : parts left out, and all candidates.
    taken : the cheapest that meets what was asked; None where none does, or where the reference has not converged to
        it.
    holds : whether a run of these settings ends as it does with half the time step, in one line; empty without one.
    results : no lines with gates.
    """

    scene: Tried
    reference: Tried
    reference_error: float
    parts: Sequence[Tried]
    searched: Sequence[Tried]
    taken: Tried | None
    holds: str = ""
    results: tuple[()] = ()


@dataclass(frozen=True)
class AdviceRequest:
    """What is asked for: an error at the least cost, or, with a budget, the least error within ms a step."""

    error: float | None = None
    budget: float | None = None
    quantity: Quantity = Quantity()

    def has_converged(self, reference_error: float) -> bool:
        """Return whether the reference is known well enough to say what meets the error."""
        return self.error is None or reference_error <= self.error


Cost = Callable[[Tried], float]


def by_time(tried: Tried) -> float:
    """Wall time of all steps, s; infinite where it was not timed."""
    return math.inf if tried.total is None else tried.total


def by_work(tried: Tried) -> float:
    """Counts, which are the same on every machine."""
    return tried.work


def choose(searched: Sequence[Tried], wish: AdviceRequest, cost: Cost = by_time) -> Tried | None:
    """Return the cheapest trial that meets an error, or the most accurate one within the budget of a step."""
    if wish.budget is None:
        good = [tried for tried in searched if tried.error <= wish.error and math.isfinite(cost(tried))]
        return min(good, key=cost, default=None)
    good = [tried for tried in searched if math.isfinite(tried.error) and tried.step is not None
            and tried.step <= wish.budget]
    return min(good, key=lambda tried: tried.error, default=None)


def check_of(file: Path, wish: AdviceRequest, cost: Cost = by_time, repeats: int = REPEATS,
             overrides: Mapping[str, Any] = MappingProxyType({})) -> Check[Advice]:
    """Return what makes the runs of a scene's advice and reads them; without repeats the cost can be counts alone.
    Overrides are which override the file's values, dotted keys (`vessel.radius`) too."""
    return Check(file.stem, "Advice", f"advice for {file.name}", partial(_plan, wish, cost, repeats, overrides),
                 str(file.resolve()))


def _plan(wish: AdviceRequest, cost: Cost, repeats: int,
          overrides: Mapping[str, Any]) -> Generator[Sequence[Case], Mapping[str, Run], Advice]:
    first = (yield [Case("scene", {**overrides, "logSpheres": "all"})])["scene"]
    scene = _lasting(first)
    quantity = wish.quantity
    quantity.refuse(scene, first.summary)
    fine, *coarser = trials.references(scene)
    # Two runs may agree in one number by chance, three hardly.
    coarser = {f"coarser-{k}": trial for k, trial in enumerate(coarser[:1 + quantity.is_one_number])}
    asked = {"file": Trial("as the file has it", {}), "reference": fine, **coarser}
    asked |= {f"part-{k}": trial for k, trial in enumerate(trials.parts(scene))}
    asked |= {f"candidate-{k}": trial for k, trial in enumerate(trials.candidates(scene))}
    case = partial(_case, overrides, scene, quantity)
    runs = yield [case(key, trial) for key, trial in asked.items()]
    if runs["reference"].outcome in _LOST:
        raise LogError(f"the reference run failed ({runs['reference'].measured('reason')}): no error can be measured")
    measure = _Measure(scene, runs["reference"], runs["file"], quantity)
    found = {key: _tried(trial, runs[key], measure) for key, trial in asked.items()}
    known = max((found[key].error for key in coarser), key=lambda error: math.inf if math.isnan(error) else error)
    has_converged = wish.has_converged(known)
    shortlist = _shortlist([key for key in found if key.startswith("candidate-")], found, wish)
    timed = ["file", *(key for key in found if key.startswith("part-")), *shortlist]
    if repeats and has_converged:
        again = yield [replace(case(key, asked[key]), key=f"{key}-timed", repeats=repeats) for key in timed]
        for key in timed:
            found[key] = _with_times(found[key], read_repeats(again[f"{key}-timed"], repeats))
    searched = [tried for key, tried in found.items() if key.startswith("candidate-")]
    parts = [tried for key, tried in found.items() if key.startswith("part-")]
    taken = choose(searched, wish, cost) if has_converged else None
    holds = "" if taken is None else (yield from _holds(case, scene, taken, runs[_key_of(taken, found)]))
    return Advice(found["file"], found["reference"], known, parts, searched, taken, holds)


def _key_of(tried: Tried, found: Mapping[str, Tried]) -> str:
    return next(key for key, one in found.items() if one is tried)


def _holds(case: Callable[[str, Trial], Case], scene: Mapping[str, Any], taken: Tried, run: Run
           ) -> Generator[Sequence[Case], Mapping[str, Run], str]:
    """Whether the run of the settings to take ends as it does with finer steps."""
    finer = {f"taken-{k}": replace(trial, changed={**taken.trial.changed, **trial.changed})
             for k, trial in enumerate(trials.finer({**scene, **taken.trial.changed}, elements=False))}
    runs = yield [case(key, trial) for key, trial in finer.items()]
    return verdict(run, {trial.name: runs[key] for key, trial in finer.items()}) if finer else ""


def _lasting(run: Run) -> dict[str, Any]:
    """Effective values of the scene, with the steps after which it rests as their number, such that it divides."""
    if run.summary is None or run.outcome in _LOST:
        raise LogError(f"the run of the scene itself failed: {run.measured('reason')}")
    steps = int(run.measured("steps"))
    if steps == 0:
        raise LogError("the scene makes no step: there is no motion and no cost")
    places = read_log(run.folder, spheres="all").positions
    if np.max(np.abs(places - places[0])) <= _STILL * run.number("guidewireLength"):
        raise LogError("nothing moves in the scene: a relative error is not defined")
    asked = int(run.number("maxSimulationSteps"))
    return {**run.parameters, "maxSimulationSteps": asked if steps == asked else min(asked, -(-steps // 16) * 16)}


def _case(overrides: Mapping[str, Any], scene: Mapping[str, Any], quantity: Quantity, key: str, trial: Trial) -> Case:
    effective = {**scene, **trial.changed}
    # A trial that changes a whole object has the overridden parts of it in what it was made from.
    kept = {name: value for name, value in overrides.items() if re.split(r"[.\[]", name)[0] not in trial.changed}
    return Case(key, {
        **kept,
        "maxSimulationSteps": effective["maxSimulationSteps"], "deltaThreshold": 0.0, "logSpheres": "all",
        "logEvery": trials.log_every(effective, _LOGGED), "logOrientations": False, **quantity.logged,
        **trial.changed,
    })


class _Measure:
    """Distances from a reference run."""

    def __init__(self, scene: Mapping[str, Any], reference: Run, file: Run, quantity: Quantity) -> None:
        self._quantity = quantity
        self._times = np.array(trials.sample_times(scene, _TIMES))
        self._exact = quantity.read(reference, self._times)
        self._file = quantity.read(file, self._times)
        self._size = quantity.scale(self._exact)
        if math.isnan(self._size):
            raise LogError(f"{quantity.said} is not defined in the reference: nothing snaps")
        if not self._size > 0.0:
            raise LogError(f"{quantity.said} is 0 in the reference: a relative error is not defined")

    def errors(self, run: Run) -> tuple[float, float]:
        """Return the errors of a run from the reference and from the file as it is; not numbers where it was lost or
        passed a wall."""
        if run.outcome in _LOST or run.measured("passages") > 0:
            return math.nan, math.nan
        values = self._quantity.read(run, self._times)
        from_exact, from_file = (self._quantity.distance(values, other) / self._size
                                 for other in (self._exact, self._file))
        return from_exact, from_file


def _tried(trial: Trial, run: Run, measure: _Measure) -> Tried:
    return Tried(trial, *measure.errors(run), run.outcome, trials.work(run.parameters, run.summary), None, None, None,
                 run.parameters)


def _with_times(tried: Tried, repeats: Sequence[Run]) -> Tried:
    steps = max(1, int(repeats[0].measured("steps")))
    totals = [repeat.measured("computationTime") for repeat in repeats]
    total = float(np.median(totals))
    log = float(np.median([repeat.measured("wallTime") for repeat in repeats])) - total
    return replace(tried, total=total, step=1e3 * total / steps, log=1e3 * max(log, 0.0) / steps,
                   others_busy=busiest(repeats))


def _shortlist(keys: Sequence[str], found: Mapping[str, Tried], wish: AdviceRequest) -> list[str]:
    """Return what is worth timing: of those that meet the error the ones of least work, or, with a budget, those of
    least error among ever less work."""
    if wish.budget is None:
        good = sorted((key for key in keys if found[key].error <= wish.error), key=lambda key: found[key].work)
        return good[:_TIMED]
    front: list[str] = []
    for key in sorted((key for key in keys if math.isfinite(found[key].error)), key=lambda key: found[key].error):
        if not front or _work_of_a_step(found[key]) < _work_of_a_step(found[front[-1]]):
            front.append(key)
    return front


def _work_of_a_step(tried: Tried) -> float:
    return tried.work / tried.parameters["maxSimulationSteps"]


def folder_of(out: Path) -> Path:
    """Folder above those of advice, within that of the results."""
    return out / "advice"
