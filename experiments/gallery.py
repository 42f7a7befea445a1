"""Puts figures into a folder: one picture and one caption file each, and an index.md that shows them together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from pathlib import Path

import matplotlib.pyplot as pyplot
from matplotlib.figure import Figure

from analysis.figures import FIGURES, FigureSpec
from analysis.figures.wording import number
from analysis.logs import LogError, read_log
from analysis.relaxation import RelaxationError
from analysis.runs import read_runs
from analysis.tables import measure_relaxation
from analysis.validation.chart import CHART
from analysis.validation.check import Check, Finding, Result, replay
from analysis.validation.integrators import INTEGRATORS
from analysis.validation.report import ROWS, Report, draw_finding, draw_overview, read_report, write_report

INDEX = "index.md"
VALIDATION = "validation"


@lru_cache(maxsize=1)
def _validation(folder: Path) -> Report:
    """The report is drawn as one figure and written with its tables; its references are computed once for both."""
    return read_report(folder)


def _draw_validation(folders: Mapping[str, Path]) -> tuple[Figure, str]:
    return draw_overview(_validation(folders[VALIDATION]))


@lru_cache(maxsize=None)
def _finding(check: Check, folder: Path) -> Finding:
    return replay(check, folder)


def _draw_check(check: Check, folders: Mapping[str, Path]) -> tuple[Figure, str]:
    finding = _finding(check, folders[check.name])
    return draw_finding(finding), finding.caption


CHECKED: dict[str, tuple[Check, ...]] = {VALIDATION: ROWS, **{check.name: (check,) for check in (CHART, INTEGRATORS)}}

SPECS: dict[str, FigureSpec] = {
    **FIGURES,
    VALIDATION: FigureSpec(VALIDATION, "validation of the material rod", (VALIDATION,), _draw_validation),
    **{
        check.name: FigureSpec(check.name, check.title, (check.name,), partial(_draw_check, check))
        for check in (CHART, INTEGRATORS)
    },
}


@dataclass(frozen=True)
class Gallery:
    """What was drawn: the index of the folder, one line for each figure that could not be drawn, and one for each line
    of a check that is beyond its gate."""

    index: Path
    problems: tuple[str, ...]
    failed_gates: tuple[str, ...] = ()


def draw(ids: Sequence[str], folders: Mapping[str, Path], out: Path) -> Gallery:
    """Draw figures from studies that were run, as many as can be drawn.

    Parameters
    ----------
    ids : keys of `SPECS`.
    folders : study name to its folder, for every study that these figures need.
    out : folder for `figure-<id>.png`, `figure-<id>.txt` (the caption) and index.md.

    Returns
    -------
    Gallery : its index lists every figure of the folder, also those drawn earlier.
    """
    pyplot.switch_backend("Agg")  # pictures go to files; no screen is needed
    out.mkdir(parents=True, exist_ok=True)
    problems, gates = [], []
    for name in ids:
        try:
            figure, caption = SPECS[name].draw({study: folders[study] for study in SPECS[name].studies})
        except (LogError, RelaxationError) as error:
            problems.append(f"figure {name} cannot be drawn: {error}")
            continue
        figure.savefig(out / f"figure-{name}.png")
        pyplot.close(figure)
        (out / f"figure-{name}.txt").write_text(caption + "\n", encoding="utf-8")
        gates += failed_gates(_results(name, folders))
    if VALIDATION in ids and not any(f"figure {VALIDATION} " in problem for problem in problems):
        write_report(_validation(folders[VALIDATION]), out / VALIDATION)
    index = out / INDEX
    index.write_text(_index(out), encoding="utf-8")
    return Gallery(index, tuple(problems), tuple(gates))


def failed_gates(results: Sequence[tuple[Check, Result]]) -> list[str]:
    """One line for each result that is beyond its gate."""
    return [f"{check.title}: {r.solver}, {r.what}: error {number(r.error, 2)} is above its gate {number(r.gate, 2)}"
            for check, r in results if r.passed is False]


def _results(name: str, folders: Mapping[str, Path]) -> list[tuple[Check, Result]]:
    """What a figure's checks found; nothing for a figure of a study."""
    if name == VALIDATION:
        return _validation(folders[VALIDATION]).results
    return [(check, result) for check in CHECKED.get(name, ()) for result in _finding(check, folders[name]).results]


def describe_default_run(study: Path) -> list[str]:
    """What the default study's run measured, one line each: relaxation time and period with the fit's error."""
    run = read_runs(study)["default"]
    log = read_log(run.folder)
    relaxation = measure_relaxation(run, log.time, log.positions[:, 0])
    return [
        f"run: {run.outcome} after {log.final_step} steps ({log.final_step * run.number('timeStep'):.2f} s in-game)",
        f"relaxation time tau = {relaxation.time:.4f} s (standard error of the fit {relaxation.time_error:.1g} s, "
        f"{len(relaxation.peak_times)} peaks)",
        f"period = {relaxation.period:.3f} s",
        *([log.warning] if log.warning else []),
    ]


def _index(out: Path) -> str:
    parts = ["# Figures\n"]
    for name, spec in SPECS.items():
        caption = out / f"figure-{name}.txt"
        if caption.exists():
            text = caption.read_text(encoding="utf-8").strip()
            parts.append(f"## Figure {name}: {spec.title}\n\n![{spec.title}](figure-{name}.png)\n\n{text}\n")
    return "\n".join(parts)
