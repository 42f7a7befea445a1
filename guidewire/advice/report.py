"""The report of an advice: parts of the model, settings tried, and the file to run."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from guidewire.advice.plan import Advice, Tried, AdviceRequest
from guidewire.figures.wording import beside, number, percent

_PATHS = ("startFile", "logFilePath")


def as_markdown(name: str, wish: AdviceRequest, advice: Advice) -> str:
    """Return the evidence: what each part costs and moves, and every setting that was searched."""
    said = wish.quantity.said
    asked = f"an error of at most {percent(wish.error)} in {said}" if wish.budget is None else \
        f"the least error in {said} within {number(wish.budget)} ms a step"
    lines = [
        f"# Advice for {name}", "", f"Asked: {asked}.", "", verdict(wish, advice), "",
        wish.quantity.defined,
        f"Reference: {advice.reference.trial.name.removeprefix('reference, ')}; it and {_coarser(wish)} "
        f"{_known(advice)} apart. The file as it is: "
        f"{_error(advice.scene)} at {_step(advice.scene)} ms a step. {_timed(advice)}", "",
        "## Parts of the model", "",
        "Each part of the scene's model, omitted or halved: the change of the result from that of the file, and "
        "the cost. Work is counted, relative to that of the file, and does not depend on the machine.", "",
        "| part | change of the result | error | ms a step | work |", "|---|---|---|---|---|",
        f"| the file as it is | - | {_error(advice.scene)} | {_step(advice.scene)} | 1 |",
        *(f"| {one.trial.name} | {_moved(one)} | {_error(one)} | {_step(one)} | "
          f"{number(one.work / advice.scene.work, 2)} |" for one in advice.parts),
        "", f"Writing the log of this comparison took {_log(advice.scene)} ms per step more; it can be "
        "reduced or left out (`logSpheres`, `logEvery`).", "",
        "## Settings tried", "",
        "In order of work; settings without a time were not timed, because they miss the error or because others that "
        "meet it need less work." if wish.budget is None else
        "In order of work; those that no other setting beats in both error and work per step were timed.", "",
        "| settings | error | work | ms a step | s in all |", "|---|---|---|---|---|",
        *(_row(one, advice) for one in sorted(advice.searched, key=lambda one: one.work)),
    ]
    return "\n".join(lines) + "\n"


def verdict(wish: AdviceRequest, advice: Advice) -> str:
    """Return one line: what to take."""
    taken = advice.taken
    if not wish.has_converged(advice.reference_error):
        return (f"Not advised: {wish.quantity.said} has not converged. The finest run made "
                f"({advice.reference.trial.name.removeprefix('reference, ')}) and {_coarser(wish)} {_known(advice)} "
                f"apart, more than the {percent(wish.error)} asked for: a finer file, or a mean over longer times, is "
                "needed to find settings that meet it.")
    if taken is None:
        finite = [one for one in advice.searched if math.isfinite(one.error)]
        best = min(finite, key=lambda one: one.error, default=None)
        least = "every setting fails" if best is None else f"the best has {percent(best.error)} ({best.trial.name})"
        missed = "has so small an error" if wish.budget is None else "is within the budget"
        return f"None of the {len(advice.searched)} settings tried {missed}; {least}."
    choice = f"Take: {taken.trial.name}. Error {percent(taken.error)}, {_step(taken)} ms a step, {_all(taken)} s in all"
    note = "" if advice.reference_error <= 0.5 * max(taken.error, wish.error or 0.0) else \
        f" The uncertainty of the reference itself is {percent(advice.reference_error)}."
    return f"{choice}; the file as it is: {_error(advice.scene)}, {_step(advice.scene)} ms a step, " \
           f"{_all(advice.scene)} s in all.{note}{advice.holds and f' Of these settings {advice.holds}.'}"


def parameters(advice: Advice, scene: Mapping[str, Any], folder: Path) -> str:
    """Return the parameter file of the settings to take, to stand in `folder`: effective values, with the scene's own
    log and end. Files that it names count from there."""
    own = ("deltaThreshold", "logSpheres", "logEvery", "logOrientations")
    values = {**advice.taken.parameters, **{key: scene[key] for key in own if key in scene}}
    for key in _PATHS:
        if values.get(key):
            values[key] = _relative(values[key], folder)
    vessel = values.get("vessel")
    if vessel and "file" in vessel:
        values["vessel"] = {**vessel, "file": _relative(vessel["file"], folder)}
    if values.get("loadTables"):
        values["loadTables"] = {load: _relative(file, folder) for load, file in values["loadTables"].items()}
    return json.dumps(values, indent=2) + "\n"


def _timed(advice: Advice) -> str:
    if advice.scene.total is None:
        return "No run was timed."
    return f"Times are medians of three runs, {beside(_busy(advice))}."


def _coarser(wish: AdviceRequest) -> str:
    return "those with half and three quarters of its resolution" if wish.quantity.is_one_number else \
        "one with half of its resolution"


def _known(advice: Advice) -> str:
    """Return what lies between the reference and coarser ones."""
    known = advice.reference_error
    return f"are up to {percent(known)}" if math.isfinite(known) else "are, as one run failed, an unknown distance"


def _relative(file: str, folder: Path) -> str:
    return os.path.relpath(file, folder).replace(os.sep, "/")


def _row(one: Tried, advice: Advice) -> str:
    name = f"**{one.trial.name}**" if one is advice.taken else one.trial.name
    return f"| {name} | {_error(one)} | {number(one.work / advice.scene.work, 2)} | {_step(one)} | {_all(one)} |"


def _moved(one: Tried) -> str:
    return percent(one.moved) if math.isfinite(one.moved) else one.outcome


def _error(one: Tried) -> str:
    return percent(one.error) if math.isfinite(one.error) else one.outcome


def _step(one: Tried) -> str:
    return "-" if one.step is None else number(one.step, 2)


def _log(one: Tried) -> str:
    return "-" if one.log is None else number(one.log, 2)


def _all(one: Tried) -> str:
    return "-" if one.total is None else number(one.total, 2)


def _busy(advice: Advice) -> Sequence[float | None]:
    return [one.others_busy for one in (advice.scene, *advice.parts, *advice.searched)]
