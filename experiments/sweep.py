"""Runs a study into its folder: `<out>/<study>/<run key>/`, timed repeats in `repeat-K` below it, and study.json."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from experiments.prepare import ROOT
from experiments.runner import Answer, Request, run_all
from experiments.studies import Study, StudyRun

TABLE = "study.json"


@dataclass(frozen=True)
class SweepResult:
    """A study's folder and what became of its runs, by folder of the run relative to the study's.

    `results` are the outcomes that count as a result: a diverged run has one.
    """

    folder: Path
    answers: dict[str, Answer]
    results: tuple[str, ...] = ("converged", "finished", "diverged")

    @property
    def failures(self) -> list[Answer]:
        """Runs that have no result."""
        return [answer for answer in self.answers.values() if answer.outcome not in self.results]


def run_study(
    study: Study,
    command: Sequence[str],
    out: Path,
    jobs: int,
    progress: Callable[[int, int, Answer], None],
) -> SweepResult:
    """Make what is missing of a study: untimed runs several at once, then the timed ones one by one.

    Parameters
    ----------
    study : what to run.
    command : the runner.
    out : folder above the study's own.
    jobs : number of untimed runs at once.
    progress : called after each run with the number of runs that ended, of all runs, and the answer.

    Raises
    ------
    KeyboardInterrupt : after Ctrl-C, when the runs under way have ended; study.json then says what was done.
    """
    folder = (out / study.name).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    runs = {run.folder: run for run in study.runs()}
    answers: dict[str, Answer] = {}

    def note(_: Request, answer: Answer) -> None:
        answers[answer.name] = answer
        progress(len(answers), len(runs), answer)

    untimed = [_request(study, run, folder) for run in runs.values() if run.repeat is None]
    timed = [_request(study, run, folder) for run in runs.values() if run.repeat is not None]
    try:
        run_all(command, untimed, jobs, note)
        if timed:
            run_all(command, timed, 1, note)
    finally:
        _write_table(folder / TABLE, study, runs, answers)
    return SweepResult(folder, answers)


def _request(study: Study, run: StudyRun, folder: Path) -> Request:
    return Request(run.folder, ROOT / study.scene, folder / run.folder, dict(run.overrides), run.repeat)


def _write_table(path: Path, study: Study, runs: dict[str, StudyRun], answers: dict[str, Answer]) -> None:
    """Write study.json at once: a reader finds the old table or the new one, never a part."""
    rows: list[dict[str, Any]] = []
    for run in runs.values():
        answer = answers.get(run.folder)
        rows.append({
            "key": run.key,
            "value": run.value,
            "parameters": study.scene,
            "overrides": dict(run.overrides),
            "folder": run.folder,
            "repeat": run.repeat,
            "outcome": answer.outcome if answer else None,
            "exitCode": answer.exit_code if answer else None,
            "message": answer.message if answer else "not run yet",
        })
    table = {"study": study.name, "title": study.title, "parameter": study.parameter, "runs": rows}
    partial = path.with_name(path.name + ".partial")
    partial.write_text(json.dumps(table, indent=2) + "\n", encoding="utf-8")
    os.replace(partial, path)
