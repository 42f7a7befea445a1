"""One row for each value of a study: the results of the runs with that value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analysis.errors import displacement_errors, steady_state_entry, total_error
from guidewire.logs.relaxation import Relaxation, RelaxationError, fit_relaxation, relaxation_error
from guidewire.logs.logs import PositionLog, read_log
from guidewire.logs.runs import Run, busiest, read_study

NO_STEADY_STATE = -1  # summary.json's steadyStateStep where the run never held still


@dataclass(frozen=True)
class Spread:
    """Median and range of a quantity over timed repeats."""

    median: float
    lowest: float
    highest: float
    count: int

    @classmethod
    def of(cls, values: Sequence[float]) -> Spread | None:
        """None where nothing was timed."""
        if not values:
            return None
        return cls(float(np.median(values)), float(min(values)), float(max(values)), len(values))


@dataclass(frozen=True)
class StudyRow:
    """What one value of a study's parameter led to.

    Attributes
    ----------
    value : of the parameter that the study varies, in its unit.
    run : the run whose positions were measured.
    relaxation : None where the motion has no relaxation time; ``no_relaxation`` then says why.
    steps : steps of the run in all.
    steady_state_step : None where the run never held still.
    time_step : in s.
    total_error : Delta_x at the last step, eq. 4.4, in units; None where the log does not state all spheres.
    step_time : average wall time of a step of each timed repeat, in ms.
    computation_time : wall time up to the steady state of each timed repeat, in s; None also without a steady state.
    others_busy : processors that other programs kept busy beside the repeat that they disturbed most; None where nobody
        looked.
    warning : what the log's reader had to say.
    """

    value: float
    run: Run
    relaxation: Relaxation | None
    no_relaxation: str | None
    steps: int
    steady_state_step: int | None
    time_step: float
    total_error: float | None
    step_time: Spread | None
    computation_time: Spread | None
    others_busy: float | None
    warning: str | None

    @property
    def steady_state_time(self) -> float | None:
        """In-game time to the steady state, in s."""
        return None if self.steady_state_step is None else self.steady_state_step * self.time_step


@dataclass(frozen=True)
class StudyTable:
    """A study's rows in ascending order of the parameter ``key``."""

    study: str
    key: str
    rows: tuple[StudyRow, ...]
    missing: tuple[str, ...]  # names of the runs that left nothing to read

    def column(self, name: str) -> np.ndarray:
        """Return a quantity of all rows as float64, shape (rows,); not a number where a row has none.

        ``name`` is an attribute of StudyRow, or of its relaxation as "relaxation.time".
        """
        values = []
        for row in self.rows:
            value = row
            for part in name.split("."):
                value = None if value is None else getattr(value, part)
            values.append(np.nan if value is None else value)
        return np.array(values, dtype=float)


def read_table(folder: Path, key: str) -> StudyTable:
    """Measures every run of a study that varies ``key`` alone.

    Parameters
    ----------
    folder : the study's folder.
    key : the parameter that it varies.

    Raises
    ------
    LogError : the study, or a file of one of its runs, cannot be read, it varies more than ``key``, or nothing of it
        was run.
    """
    study = read_study(folder)
    study.required()
    rows = [_measure(run, study.timed(run.key), run.number(key)) for run in study.along(key)]
    return StudyTable(study.name, key, tuple(sorted(rows, key=lambda row: row.value)), study.missing)


def measure_relaxation(run: Run, time: np.ndarray, last_sphere: np.ndarray) -> Relaxation:
    """Relaxation of a run's last sphere as the thesis has it; ``last_sphere`` has shape (k, 3), in units."""
    error = relaxation_error(last_sphere, run.rest_positions[-1], run.displacement)
    return fit_relaxation(time, error, as_published=True)


def _measure(run: Run, repeats: Sequence[Run], value: float) -> StudyRow:
    log = read_log(run.folder)
    relaxation, reason = None, None
    try:
        relaxation = measure_relaxation(run, log.time, log.positions[:, 0])
    except RelaxationError as error:
        reason = str(error)
    steady = steady_state_step(run, log)
    return StudyRow(
        value=value,
        run=run,
        relaxation=relaxation,
        no_relaxation=reason,
        steps=log.final_step,
        steady_state_step=steady,
        time_step=run.number("timeStep"),
        total_error=_total_error(run, log),
        step_time=Spread.of([repeat.measured("averageStepTime") for repeat in repeats]),
        computation_time=None if steady is None else Spread.of([_elapsed(repeat, steady) for repeat in repeats]),
        others_busy=busiest(repeats),
        warning=log.warning,
    )


def steady_state_step(run: Run, log: PositionLog) -> int | None:
    """Return the first step of the steady state, as the run found it; of a killed run from its log, if that has every
    step."""
    if run.summary is not None:
        step = int(run.measured("steadyStateStep"))
        return None if step == NO_STEADY_STATE else step
    # Only with gains do prediction errors make a steady state.
    if log.steps.size != log.final_step + 1 or run.parameters.get("solver", "pbd") != "pbd":
        return None
    return steady_state_entry(log.prediction_error, run.number("deltaThreshold"), int(run.number("steadyStateHold")))


def _total_error(run: Run, log: PositionLog) -> float | None:
    rest = run.rest_positions
    if log.final_spheres.size != len(rest):
        return None
    return float(total_error(displacement_errors(log.final_positions, rest, run.displacement)))


def _elapsed(repeat: Run, step: int) -> float:
    """Wall time at a step, in s; between two logged steps in proportion."""
    log = read_log(repeat.folder)
    return float(np.interp(step, log.steps, log.elapsed))
