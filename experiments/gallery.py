"""Puts figures into a folder: one picture and one caption file each, and an index.md that shows them together."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import matplotlib.pyplot as pyplot
from matplotlib.figure import Figure

from analysis.chart import figure as chart
from analysis.chart import material, page, tables, walls
from analysis.chart.points import Charted, check_of
from analysis.figures import FIGURES, FigureSpec
from analysis.figures.wording import number
from analysis.logs import LogError, read_log
from analysis.relaxation import RelaxationError
from analysis.runs import read_runs
from analysis.tables import measure_relaxation
from analysis.validation.check import Check, Finding, Result, replay
from analysis.validation.integrators import INTEGRATORS
from analysis.validation.report import (
    ROWS, Report, as_csv, as_markdown, draw_finding, draw_overview, picture_name, read_report,
)
from studies.bisection import FRONTIER
from studies.keys import RESULTS

INDEX = "index.md"
VALIDATION = "validation"
CHART = "chart"


_Beside = Callable[[Mapping[str, Path], Path], None]  # writes one file from the runs of a figure's studies


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


CHECKED: dict[str, tuple[Check, ...]] = {
    VALIDATION: ROWS,
    CHART: tuple(check_of(problem) for problem in (*material.PROBLEMS, *walls.PROBLEMS)),
    INTEGRATORS.name: (INTEGRATORS,),
}


def _charted(folders: Mapping[str, Path]) -> list[Charted]:
    return [_finding(check, folders[CHART]) for check in CHECKED[CHART]]


def _text_of(make: Callable[[Any], str], read: Callable[[Mapping[str, Path]], Any]) -> _Beside:
    """Writes what `make` says of what is read."""
    return lambda folders, path: _write(path, make(read(folders)))


def _picture_of(draw: Callable[[Any], Figure], read: Callable[[Mapping[str, Path]], Any]) -> _Beside:
    """Draws what is read."""
    return lambda folders, path: _save(draw(read(folders)), path)


def _report_of(folders: Mapping[str, Path]) -> Report:
    return _validation(folders[VALIDATION])


def _row_picture(check: Check) -> _Beside:
    """Draws a row of the validation, where it has its runs."""
    def save(folders: Mapping[str, Path], path: Path) -> None:
        findings = _report_of(folders).findings
        if check in findings:
            _save(draw_finding(findings[check]), path)

    return save


SPECS: dict[str, FigureSpec] = {
    **FIGURES,
    VALIDATION: FigureSpec(VALIDATION, "validation of the material rod", (VALIDATION,), _draw_validation, {
        f"{VALIDATION}/validation.md": _text_of(as_markdown, _report_of),
        f"{VALIDATION}/validation.csv": _text_of(as_csv, _report_of),
        **{f"{VALIDATION}/{picture_name(check)}": _row_picture(check) for check in ROWS},
    }),
    CHART: FigureSpec(CHART, "error against cost", (CHART,), lambda folders: chart.draw_costs(_charted(folders)), {
        "figure-chart-steps.png": _picture_of(lambda found: chart.draw_steps(found)[0], _charted),
        "figure-chart-summary.png": _picture_of(chart.draw_summary, _charted),
        "chart.html": _text_of(page.as_page, _charted),
        "chart.csv": _text_of(tables.as_csv, _charted),
        "chart.md": _text_of(tables.as_markdown, _charted),
        "chart-best.md": _text_of(tables.best_as_markdown, _charted),
    }),
    INTEGRATORS.name: FigureSpec(INTEGRATORS.name, INTEGRATORS.title, (INTEGRATORS.name,),
                                 partial(_draw_check, INTEGRATORS)),
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
        _save(figure, out / f"figure-{name}.png")
        (out / f"figure-{name}.txt").write_text(caption + "\n", encoding="utf-8")
        for file, write in SPECS[name].beside.items():
            write(folders, out / file)
        gates += failed_gates(_results(name, folders))
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


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _save(figure: Figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
    pyplot.close(figure)


def _index(out: Path) -> str:
    """Every picture with its caption, and links to what stands beside it and to the tables of its runs."""
    parts = ["# Figures\n"]
    for name, spec in SPECS.items():
        caption = out / f"figure-{name}.txt"
        if caption.exists():
            text = caption.read_text(encoding="utf-8").strip()
            parts.append(f"## Figure {name}: {spec.title}\n\n![{spec.title}](figure-{name}.png)\n\n{text}\n")
            links = [file for file in (*spec.beside, *_tables_of(spec)) if (out / file).exists()]
            if links:
                parts.append("".join(f"- [{file.removeprefix('../')}]({file})\n" for file in links))
    return "\n".join(parts)


def _tables_of(spec: FigureSpec) -> list[str]:
    """Where the tables of its runs are, from the folder of the pictures."""
    checks = [f"{study}/{check.name}" for study in spec.studies for check in CHECKED.get(study, ())]
    return [f"../{folder}/{table}" for folder in (*spec.studies, *checks) for table in (RESULTS, FRONTIER)]
