"""Sweeps and advice for scripts: what the commands of the same names do, with results instead of lines."""

from __future__ import annotations

import difflib
import os
import warnings
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from guidewire import prepare
from guidewire.prepare import PreparationError
from guidewire.runs import building, checking
from guidewire.studies.builtin import STUDIES
from guidewire.studies.study_file import LIMIT, StudyFileError, read_study_file
from guidewire.studies.table import Source, Study
from guidewire.sweeps.sweep import Means, SweepResult, sweep as make_runs

if TYPE_CHECKING:
    from guidewire.advice.plan import Advice, AdviceRequest
    from guidewire.logs.runs import Run

RUNS = "runs"  # folder of all runs, in that of the results


def sweep(study: str | Path, out: str | Path = "results", jobs: int | None = None) -> dict[str, Run]:
    """Make a study's runs with their logs, those that are not there already.

    Parameters
    ----------
    study : name of a study of the program's, or a study's file.
    out : parent of the study's folder, which then holds runs.csv.
    jobs : runs at once; None: one a processor.

    Returns
    -------
    The runs that are not timed, by key; each has its `parameters`, `summary` and `folder`.

    Raises
    ------
    PreparationError : the study cannot be read or made; one line.

    Warns
    -----
    UserWarning : for each run that has no result.
    """
    from guidewire.logs.runs import read_runs

    _require(prepare.SWEEPING)
    out = Path(out)
    checking.check_out(out)
    found = replace(find_study(study, LIMIT), logs=True)
    means = Means(_runner(), jobs or os.cpu_count() or 1, folder=found.file and found.file.parent)
    _warn_of(make([(found, out)], out, means))
    return read_runs(out / found.name)


def advise(file: str | Path, error: float | None = None, budget: float | None = None, of: str = "position",
           at: str = "run", out: str | Path = "results", jobs: int | None = None, **overrides: Any) -> Advice:
    """Find the cheapest settings of a scene for an error, or the most accurate ones within a budget.

    Parameters
    ----------
    file : parameter file.
    error, budget : one of the two: largest relative error, or wall time of a step in ms.
    of, at : quantity of the error, and whether it counts over the run ("run") or at its end ("end").
    out : parent of the folder of the runs, advice/SCENE.
    jobs : untimed runs at once; None: one a processor.
    overrides : parameters by key, which override the file's.

    Returns
    -------
    What was tried; `taken` is None where no setting meets what is asked for.

    Raises
    ------
    PreparationError : the file or a value cannot be used, or a run that is needed failed; one line.
    """
    from guidewire.advice.plan import AdviceRequest
    from guidewire.advice.quantity import Quantity

    _require(prepare.DRAWING + prepare.SWEEPING)
    if (error is None) == (budget is None):
        raise PreparationError("advise needs error or budget, one of the two")
    if not 0 < (error if budget is None else budget) < float("inf"):
        raise PreparationError(f"{'error' if budget is None else 'budget'} = {error if budget is None else budget} is "
                               "not allowed: needs a number > 0")
    if at not in ("run", "end"):
        raise PreparationError(f"at = {at!r} is not allowed: needs 'run' or 'end'")
    file, out = Path(file), Path(out)
    checking.check_file(file)
    checking.check_out(out)
    result, advice = find_advice(file, AdviceRequest(error, budget, Quantity(of, at)), overrides, out,
                                 Means(_runner(), jobs or os.cpu_count() or 1))
    if advice is None:
        raise PreparationError(result.failures[0].message)
    return advice


def find_study(name: str | Path, most_runs: int | None) -> Study:
    """Return the study with this name, or in this file. Raises PreparationError, one line, where there is none."""
    if str(name) in STUDIES:
        return STUDIES[str(name)]
    path = Path(name)
    if path.suffix != ".json" and not path.is_file():
        near = difflib.get_close_matches(str(name), STUDIES, 1)
        hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(STUDIES)}, or a JSON file"
        raise PreparationError(f"there is no study '{name}': {hint}")
    try:
        study = read_study_file(path, most_runs)
    except StudyFileError as error:
        raise PreparationError(str(error)) from error
    if study.name in (*STUDIES, RUNS):
        raise PreparationError(f"{path}: study = \"{study.name}\" is not allowed: a study of ours has that name")
    return study


def find_advice(file: Path, wish: AdviceRequest, overrides: dict[str, Any], out: Path, means: Means
                ) -> tuple[SweepResult, Advice | None]:
    """Make the runs that advice needs, and read them; no advice where a run failed."""
    from guidewire.advice import plan
    from guidewire.logs.logs import LogError
    from guidewire.sweeps.check import replay

    check, folder = plan.check_of(file, wish, overrides=overrides), plan.folder_of(out)
    result = make([(check, folder)], out, means)
    try:
        return result, None if result.failures else replay(check, folder)
    except LogError as error:
        raise PreparationError(f"{file}: {error}") from error


def make(asked: Sequence[tuple[Source, Path]], out: Path, means: Means) -> SweepResult:
    """Make the runs that studies or checks ask for, in the store below `out`."""
    return make_runs(asked, out / RUNS, means)


def _runner() -> list[str]:
    return building.build(building.RUNNER, lambda line: None)


def _require(packages: Sequence[str]) -> None:
    if prepare.INSTALLED:  # in the repository the command that starts the script has found a Python with all of them
        prepare.require_packages(packages)


def _warn_of(result: SweepResult) -> None:
    for answer in result.failures:
        warnings.warn(f"{answer.name}: {answer.message}", stacklevel=3)
