"""Puts figures into a folder: one picture and one caption file each, and an index.md that shows them together."""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import matplotlib.pyplot as pyplot
from matplotlib.figure import Figure

from analysis.chart import figure as chart
from analysis.chart import coaxial, material, page, tables, walls
from analysis.chart.points import Charted, Problem, check_of, in_short
from analysis.figures import FIGURES, FigureSpec
from analysis.measured import figure as measured
from guidewire.logs.relaxation import RelaxationError
from analysis.tables import measure_relaxation
from analysis.validation.integrators import INTEGRATORS, INTEGRATORS_ONCE
from analysis.validation.report import (
    FAST, ROWS, Report, as_csv, as_markdown, draw_finding, draw_overview, picture_name, read_report,
)
from guidewire.figures.wording import number
from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import read_runs
from guidewire.runs.whole_files import whole_file, write_whole
from guidewire.studies.bisection import FRONTIER
from guidewire.studies.builtin import STUDIES
from guidewire.studies.keys import RESULTS
from guidewire.studies.quick import shortened
from guidewire.studies.table import Study
from guidewire.sweeps.check import Check, Finding, Found, Result, replay

INDEX = "index.md"
VALIDATION = "validation"
CHART = "chart"
_Beside = Callable[[Mapping[str, Path], Path], None]  # writes one file from the runs of a figure's studies


@dataclass(frozen=True)
class Catalogue:
    """The figures that can be asked for.

    Attributes
    ----------
    specs : by their numbers.
    checked : of the figures that are drawn from checks, the checks of each.
    studies : that the others are drawn from.
    """

    specs: Mapping[str, FigureSpec]
    checked: Mapping[str, Sequence[Check]]
    studies: Mapping[str, Study] = field(default_factory=lambda: STUDIES)


@lru_cache(maxsize=None)
def _validation(folder: Path, checks: tuple[Check, ...]) -> Report:
    """The report is drawn as one figure and written with its tables; its references are computed once for both."""
    return read_report(folder, checks)


@lru_cache(maxsize=None)
def _finding(check: Check[Found], folder: Path) -> Found:
    return replay(check, folder)


def _draw_check(check: Check, folders: Mapping[str, Path]) -> tuple[Figure, str]:
    finding = _finding(check, folders[check.name])
    return draw_finding(finding), finding.caption


def _text_of(make: Callable[[Any], str], read: Callable[[Mapping[str, Path]], Any]) -> _Beside:
    """Writes what `make` says of what is read."""
    return lambda folders, path: _write(path, make(read(folders)))


def _picture_of(draw: Callable[[Any], Figure], read: Callable[[Mapping[str, Path]], Any]) -> _Beside:
    """Draws what is read."""
    return lambda folders, path: _save(draw(read(folders)), path)


def _validation_spec(checks: tuple[Check, ...]) -> FigureSpec:
    def read(folders: Mapping[str, Path]) -> Report:
        return _validation(folders[VALIDATION], checks)

    def row_picture(check: Check) -> _Beside:
        def save(folders: Mapping[str, Path], path: Path) -> None:
            findings = read(folders).findings
            if check in findings:
                _save(draw_finding(findings[check]), path)

        return save

    return FigureSpec(
        VALIDATION, "validation of the material rod", (VALIDATION,), lambda folders: draw_overview(read(folders)), {
            f"{VALIDATION}/validation.md": _text_of(as_markdown, read),
            f"{VALIDATION}/validation.csv": _text_of(as_csv, read),
            **{f"{VALIDATION}/{picture_name(check)}": row_picture(check) for check in checks},
        }, lambda folders: failed_gates(read(folders).results))


def _chart_spec(checks: tuple[Check[Charted], ...]) -> FigureSpec:
    def read(folders: Mapping[str, Path]) -> list[Charted]:
        return [_finding(check, folders[CHART]) for check in checks]

    return FigureSpec(CHART, "error against cost", (CHART,), lambda folders: chart.draw_costs(read(folders)), {
        "figure-chart-steps.png": _picture_of(lambda found: chart.draw_steps(found)[0], read),
        "figure-chart-summary.png": _picture_of(chart.draw_summary, read),
        "chart.html": _text_of(page.as_page, read),
        "chart.csv": _text_of(tables.as_csv, read),
        "chart.md": _text_of(tables.as_markdown, read),
        "chart-best.md": _text_of(tables.best_as_markdown, read),
    })


def _check_spec(check: Check[Finding]) -> FigureSpec:
    return FigureSpec(check.name, check.title, (check.name,), partial(_draw_check, check), {}, lambda folders: (
        failed_gates([(check, result) for result in _finding(check, folders[check.name]).results])))


MEASURED = FigureSpec("measured", "three real wires, found and predicted", (), lambda _: measured.draw(measured.find()),
                      {"measured.md": lambda _, path: measured.write_table(path)})


def _catalogue(
    rows: Sequence[Check], problems: Sequence[Problem], integrators: Check[Finding], studies: Mapping[str, Study]
) -> Catalogue:
    checked = {VALIDATION: tuple(rows), CHART: tuple(check_of(problem) for problem in problems),
               integrators.name: (integrators,)}
    specs = (_validation_spec(checked[VALIDATION]), _chart_spec(checked[CHART]), _check_spec(integrators), MEASURED)
    return Catalogue({**FIGURES, **{spec.id: spec for spec in specs}}, checked, studies)


_PROBLEMS = (*material.PROBLEMS, *walls.PROBLEMS, *coaxial.PROBLEMS)
FULL = _catalogue(ROWS, _PROBLEMS, INTEGRATORS, STUDIES)
QUICK = _catalogue(FAST, [in_short(problem) for problem in _PROBLEMS], INTEGRATORS_ONCE,
                   {name: shortened(study) for name, study in STUDIES.items()})


@dataclass(frozen=True)
class Gallery:
    """What was drawn: the index of the folder, one line for each figure that could not be drawn, and one for each line
    of a check that is beyond its gate."""

    index: Path
    problems: tuple[str, ...]
    failed_gates: tuple[str, ...] = ()


def draw(
    ids: Sequence[str], folders: Mapping[str, Path], out: Path, catalogue: Catalogue = FULL, jobs: int = 1
) -> Gallery:
    """Draw figures from studies that were run, as many as can be drawn.

    Parameters
    ----------
    ids : keys of the catalogue's specs.
    folders : study name to its folder, for every study that these figures need.
    out : folder for `figure-<id>.png`, `figure-<id>.txt` (the caption) and index.md.
    jobs : figures at once, where this system can copy a process.

    Returns
    -------
    Gallery : its index lists every figure of the folder, also those drawn earlier.
    """
    pyplot.switch_backend("Agg")  # pictures go to files; no screen is needed
    out.mkdir(parents=True, exist_ok=True)
    drawn = _draw_all(ids, _Drawing(folders, out, catalogue), jobs)
    index = out / INDEX
    write_whole(index, _index(out, catalogue))
    return Gallery(index, tuple(problem for problem, _ in drawn if problem),
                   tuple(line for _, gates in drawn for line in gates))


@dataclass(frozen=True)
class _Drawing:
    """Draws figures of a catalogue from studies into a folder."""

    folders: Mapping[str, Path]
    out: Path
    catalogue: Catalogue

    def draw(self, name: str) -> _Drawn:
        """Return one figure and what stands beside it: why it cannot be drawn, and lines beyond their gates."""
        spec = self.catalogue.specs[name]
        own = {study: self.folders[study] for study in spec.studies}
        try:
            figure, caption = spec.draw(own)
        except (LogError, RelaxationError) as error:
            return f"figure {name} cannot be drawn: {error}", []
        _save(figure, self.out / f"figure-{name}.png")
        write_whole(self.out / f"figure-{name}.txt", caption + "\n")
        for file, write in spec.beside.items():
            with whole_file(self.out / file) as partial:
                write(own, partial)
        return "", spec.gates(own)


_Drawn = tuple[str, Sequence[str]]
_copied: list[_Drawing] = []  # what copies of this process draw: figures themselves cannot be sent to one


def _draw_all(ids: Sequence[str], drawing: _Drawing, jobs: int) -> list[_Drawn]:
    """Return all figures, in the order of their names; those with most beside them are begun first."""
    if jobs == 1 or len(ids) == 1 or "fork" not in multiprocessing.get_all_start_methods():
        return [drawing.draw(name) for name in ids]
    first = sorted(ids, key=lambda name: -len(drawing.catalogue.specs[name].beside))
    _copied.append(drawing)
    try:
        with ProcessPoolExecutor(min(jobs, len(ids)), multiprocessing.get_context("fork")) as pool:
            drawn = dict(zip(first, pool.map(_draw_copied, first)))
    finally:
        _copied.pop()
    return [drawn[name] for name in ids]


def _draw_copied(name: str) -> _Drawn:
    return _copied[-1].draw(name)


def failed_gates(results: Sequence[tuple[Check, Result]]) -> list[str]:
    """Return one line for each result that is beyond its gate."""
    return [f"{check.title}: {r.solver}, {r.what}: error {number(r.error, 2)} is above its limit {number(r.gate, 2)}"
            for check, r in results if r.passed is False]


def describe_default_run(study: Path) -> list[str]:
    """Return what the default study's run measured, one line each: relaxation time and period with the fit's error."""
    run = read_runs(study)["default"]
    log = read_log(run.folder)
    relaxation = measure_relaxation(run, log.time, log.positions[:, 0])
    return [
        f"run: {run.outcome} after {log.final_step} steps ({log.final_step * run.number('timeStep'):.2f} s in-game)",
        f"relaxation time tau = {relaxation.time:.4f} s (standard error {relaxation.time_error:.1g} s, "
        f"{len(relaxation.peak_times)} peaks; of the slowest mode alone {relaxation.slowest_time:.4f} s)",
        f"period = {relaxation.period:.3f} s",
        *([log.warning] if log.warning else []),
    ]


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def _save(figure: Figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as partial:
        figure.savefig(partial)
    pyplot.close(figure)


def _index(out: Path, catalogue: Catalogue) -> str:
    """Return every picture with its caption, and links to what stands beside it and to the tables of its runs."""
    parts = ["# Figures\n"]
    for name, spec in catalogue.specs.items():
        caption = out / f"figure-{name}.txt"
        if caption.exists():
            text = caption.read_text(encoding="utf-8").strip()
            parts.append(f"## Figure {name}: {spec.title}\n\n![{spec.title}](figure-{name}.png)\n\n{text}\n")
            links = [file for file in (*spec.beside, *_tables_of(spec, catalogue)) if (out / file).exists()]
            if links:
                parts.append("".join(f"- [{file.removeprefix('../')}]({file})\n" for file in links))
    return "\n".join(parts)


def _tables_of(spec: FigureSpec, catalogue: Catalogue) -> list[str]:
    """Say where the tables of its runs are, from the folder of the pictures."""
    checks = [f"{study}/{check.name}" for study in spec.studies for check in catalogue.checked.get(study, ())]
    return [f"../{folder}/{table}" for folder in (*spec.studies, *checks) for table in (RESULTS, FRONTIER)]
