"""Makes the runs that checks ask for, round by round: what a check asks next may depend on what its runs showed.

Runs stand in `<out>/<name>/<check>/<case>/`, timed repeats in `repeat-K` below. What is done already is not run again.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path

from analysis.validation.check import Case, Check, Plan, read_cases
from analysis.validation.scenes import SCENE
from experiments.prepare import ROOT
from experiments.runner import Answer, Request, run_all
from experiments.sweep import SweepResult

START = "start.json"
_RESULTS = ("converged", "finished", "diverged", "failed")  # a solver that gives up with a reason is a result too


def run_checks(
    name: str,
    checks: Sequence[Check],
    command: Sequence[str],
    out: Path,
    jobs: int,
    progress: Callable[[int, int, Answer], None],
) -> SweepResult:
    """Make all runs of all checks.

    Parameters
    ----------
    name : folder of the checks below `out`.
    checks : what to check.
    command : the runner.
    out : folder above.
    jobs : number of untimed runs at once.
    progress : called after each run with the number of runs that ended, of those asked for so far, and the answer.

    Returns
    -------
    SweepResult : its failures are runs without a result; their check was not carried on.
    """
    folder = (out / name).resolve()
    answers: dict[str, Answer] = {}
    asked = 0
    waiting: list[tuple[Check, Plan, Sequence[Case]]] = []
    for check in checks:
        plan = check.plan()
        waiting.append((check, plan, next(plan)))

    def note(_: Request, answer: Answer) -> None:
        answers[answer.name] = answer
        progress(len(answers), asked, answer)

    while waiting:
        untimed, timed = _requests(waiting, folder, ROOT / SCENE)
        asked += len(untimed) + len(timed)
        run_all(command, untimed, jobs, note)
        if timed:
            run_all(command, timed, 1, note)
        lost = {request.name.split("/")[0] for request in (*untimed, *timed) if not _is_result(answers[request.name])}
        waiting = [
            (check, plan, more)
            for check, plan, cases in waiting if check.id not in lost
            for more in _next(plan, cases, folder / check.id)
        ]
    return SweepResult(folder, answers, _RESULTS)


def _next(plan: Plan, cases: Sequence[Case], folder: Path) -> list[Sequence[Case]]:
    """The cases that a plan asks for next; none when it has ended."""
    try:
        return [plan.send(read_cases(cases, folder))]
    except StopIteration:
        return []


def _is_result(answer: Answer) -> bool:
    return answer.outcome in _RESULTS


def _requests(
    waiting: Sequence[tuple[Check, Plan, Sequence[Case]]], folder: Path, scene: Path
) -> tuple[list[Request], list[Request]]:
    """Untimed and timed runs of one round; writes the files that they start from."""
    untimed, timed = [], []
    for check, _, cases in waiting:
        for case in cases:
            place = folder / check.id / case.key
            overrides = dict(case.overrides)
            if case.start is not None:
                place.mkdir(parents=True, exist_ok=True)
                (place / START).write_text(json.dumps(case.start), encoding="utf-8")
                overrides["startFile"] = str(place / START)
            key = f"{check.id}/{case.key}"
            untimed.append(Request(key, scene, place, overrides))
            for k in range(1, case.repeats + 1):
                last = {**overrides, "logSpheres": "last", "logOrientations": False}
                timed.append(Request(f"{key}/repeat-{k}", scene, case.repeat_folder(place, k), last, k))
    return untimed, timed
