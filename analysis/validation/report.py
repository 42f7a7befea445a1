"""The table of all checks, as Markdown and CSV, and an overview of them in one figure."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from matplotlib.figure import Figure

from analysis.validation import (
    coil, drum, dynamics, heavy_rods, hub_force, independence, planes, soft_walls, suite, tested, tube_buckling,
    twisted_tube, vessel, whip,
)
from analysis.validation.pictures import SOLVER_MARKERS
from guidewire.figures.style import captioned, new_figure, styled
from guidewire.figures.wording import number
from guidewire.logs.logs import LogError
from guidewire.sweeps.check import Check, Finding, Result, replay

ROWS: tuple[Check, ...] = (
    *tested.CHECKS, *heavy_rods.CHECKS, *dynamics.CHECKS, *vessel.CHECKS, *hub_force.CHECKS, *coil.CHECKS,
    *drum.CHECKS, *planes.CHECKS, *soft_walls.CHECKS, *twisted_tube.CHECKS, *whip.CHECKS, *tube_buckling.CHECKS,
    *independence.CHECKS, *suite.CHECKS,
)
_QUICK = ("tolerance", "twisted-tube")
FAST = (  # what tests run
    *heavy_rods.FAST, *vessel.FAST, *whip.FAST, *tube_buckling.FAST,
    *(check for check in ROWS if check.name in _QUICK),
)
COLUMNS = ("section", "check", "what", "solver", "value", "reference", "unit", "error", "error in", "gate", "passed",
           "cost")
_LIMITS = (1e-9, 1e2)  # of the overview's axis, error over gate


@dataclass(frozen=True)
class Report:
    """What all checks found, in their order, and why some found nothing."""

    findings: Mapping[Check, Finding]
    missing: Mapping[Check, str] = field(default_factory=dict)

    @property
    def results(self) -> list[tuple[Check, Result]]:
        """Every line with its check."""
        return [(check, result) for check, finding in self.findings.items() for result in finding.results]

    @property
    def counts(self) -> tuple[int, int, int]:
        """Lines that passed, failed, and have no gate."""
        verdicts = [result.passed for _, result in self.results]
        return verdicts.count(True), verdicts.count(False), verdicts.count(None)


def read_report(folder: Path, checks: Sequence[Check] = ROWS) -> Report:
    """Drive all checks over their runs; one that lacks a run is named with the reason."""
    findings, missing = {}, {}
    for check in checks:
        try:
            findings[check] = replay(check, folder)
        except LogError as error:
            missing[check] = str(error)
    if not findings:
        raise LogError(f"{folder}: no check has its runs")
    return Report(findings, missing)


def as_csv(report: Report) -> str:
    """Return one line for each result, numbers to full precision."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for check, r in report.results:
        writer.writerow([
            check.section, check.name, r.what, r.solver, repr(float(r.value)), repr(float(r.reference)), r.unit,
            repr(float(r.error)), r.error_in, "" if r.gate is None else repr(float(r.gate)), _verdict(r),
            "" if r.cost is None else repr(float(r.cost)),
        ])
    return text.getvalue()


def as_markdown(report: Report) -> str:
    """Return the same for people, with the pictures between the tables."""
    lines = [
        "# Validation of the material rod", "",
        f"{_counted(report)}. Errors are relative unless stated; cost is wall time in s, or per simulated second where "
        "the check is of a motion, on the machine that made the runs and beside whatever else ran there; of a rest "
        "shape it is the search alone. pbd, which has gains instead of a material, stands in the chart of error "
        "against wall time, where its gain is tuned to the wire's sag.", "",
        *(f"Not made: {check.title} ({reason})." for check, reason in report.missing.items()),
        *([""] if report.missing else []),
    ]
    section = ""
    for check, finding in report.findings.items():
        if check.section != section:
            section = check.section
            lines += [f"## {section}", ""]
        lines += [f"### {check.title[0].upper()}{check.title[1:]}", "", f"![{check.title}]({picture_name(check)})", "",
                  finding.caption, "",
                  "| what | solver | value | reference | error | limit | | cost |", "|---|---|---|---|---|---|---|---|"]
        lines += [_line(r) for r in finding.results]
        lines.append("")
    return "\n".join(lines)


def _counted(report: Report) -> str:
    """Return how many lines there are of each kind."""
    passed, failed, shown = report.counts
    return f"{passed} lines passed, {failed} failed, {shown} have no gate and are only shown"


def _line(r: Result) -> str:
    """Return a result as a row of a Markdown table; without unit or figure where it has none."""

    def figure(value: float, digits: int, after: str = "") -> str:
        return f"{number(value, digits)}{after}" if math.isfinite(value) else "-"

    unit = f" {r.unit}" if r.unit else ""
    error = figure(r.error, 2) if math.isfinite(r.error) else "not finite"
    cells = (
        r.what, r.solver, figure(r.value, 6, unit), figure(r.reference, 6, unit),
        error if r.error_in == "relative" else f"{error} ({r.error_in})",
        "-" if r.gate is None else number(r.gate, 2), _verdict(r), "-" if r.cost is None else number(r.cost, 2),
    )
    return "| " + " | ".join(cells) + " |"


def picture_name(check: Check) -> str:
    """File of a check's picture beside the report."""
    return f"{check.name}.png"


@styled
def draw_finding(finding: Finding) -> Figure:
    """Return a check's picture with the opening of its caption."""
    figure = new_figure(finding.width, 4.2)
    finding.draw(figure)
    return captioned(figure, finding.caption)[0]


@styled
def draw_overview(report: Report) -> tuple[Figure, str]:
    """Error over gate of every line that has a gate, one row for each check."""
    checks = [check for check, finding in report.findings.items() if any(r.gate is not None for r in finding.results)]
    figure = new_figure(9.0, 0.24 * len(checks) + 1.2)
    axes = figure.add_subplot()
    low, high = _LIMITS
    for y, check in enumerate(checks):
        for r in report.findings[check].results:
            if r.gate is None:
                continue
            ratio = r.error / r.gate if r.gate > 0.0 else (0.0 if r.error == 0.0 else math.inf)
            kind = r.solver.split(",")[0]
            axes.plot(min(max(ratio, low), high) if math.isfinite(ratio) else high, y, SOLVER_MARKERS.get(kind, "o"),
                      color="C0" if r.passed else "C1", fillstyle="full" if r.passed is False else "none")
    axes.axvline(1.0, color="0.3", linestyle="--", linewidth=1.0)
    axes.set_xscale("log")
    axes.set_xlim(0.5 * low, 2.0 * high)
    axes.set_yticks(range(len(checks)), [check.title for check in checks])
    axes.invert_yaxis()
    axes.set_xlabel("error over limit (1); filled: failed; at the ends: beyond")
    gated = {r.solver.split(",")[0] for _, r in report.results if r.gate is not None}
    for kind, marker in SOLVER_MARKERS.items():
        if kind in gated:
            axes.plot([], [], marker, color="0.4", fillstyle="none", label=kind)
    axes.legend(loc="lower left", ncols=2)
    wrong = [(check, [r for r in finding.results if r.passed is False]) for check, finding in report.findings.items()]
    failures = "; ".join(f"{check.title}: {_worst(lines)}" for check, lines in wrong if lines)
    return captioned(figure, (
        f"Error over limit of every line of the validation that has one. {_counted(report)}. "
        + (f"Failed: {failures}. " if failures else "")
        + (f"Not made: {', '.join(check.title for check in report.missing)}." if report.missing else "")
    ))


def _worst(lines: Sequence[Result]) -> str:
    """Say how many lines of one check failed, and which was the worst."""
    worst = max(lines, key=lambda r: math.inf if math.isnan(r.error) else r.error / r.gate if r.gate else math.inf)
    many = f"{len(lines)} lines, worst " if len(lines) > 1 else ""
    return f"{many}{worst.solver}, {worst.what} ({number(worst.error, 2)} > {number(worst.gate, 2)})"


def _verdict(result: Result) -> str:
    return {True: "passed", False: "FAILED", None: "-"}[result.passed]
