"""The table of all checks, as Markdown and CSV, and an overview of them in one figure."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from matplotlib.figure import Figure

from analysis.figures.style import add_caption, new_figure, styled
from analysis.figures.wording import number
from analysis.logs import LogError
from analysis.validation import clamp, dynamics, independence, stability, statics
from analysis.validation.check import Check, Finding, Result, replay

ROWS: tuple[Check, ...] = (
    *clamp.CHECKS, *statics.CHECKS, *stability.CHECKS, *dynamics.CHECKS, *independence.CHECKS,
)
_QUICK = ("clamp-compliance", "couple-tension-0", "couple-tension-10", "localised-helix", "force-balance",
          "order-in-time", "elements-and-tolerance", "time-step")
FAST = (*statics.FAST, *(check for check in ROWS if check.id in _QUICK))  # what the tests run
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
    """One line for each result, numbers to full precision."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for check, r in report.results:
        writer.writerow([
            check.section, check.id, r.what, r.solver, repr(float(r.value)), repr(float(r.reference)), r.unit,
            repr(float(r.error)), r.error_in, "" if r.gate is None else repr(float(r.gate)), _verdict(r),
            "" if r.cost is None else repr(float(r.cost)),
        ])
    return text.getvalue()


def as_markdown(report: Report) -> str:
    """The same for people, with the pictures between the tables."""
    passed, failed, shown = report.counts
    lines = [
        "# Validation of the material rod", "",
        f"{passed} lines passed, {failed} failed, {shown} have no gate and are only shown. Errors are relative unless "
        "stated; cost is wall time in s, or per simulated second where the check is of a motion, on the machine that "
        "made the runs and beside whatever else ran there.", "",
        *(f"Not made: {check.title} ({reason})." for check, reason in report.missing.items()), "",
    ]
    section = ""
    for check, finding in report.findings.items():
        if check.section != section:
            section = check.section
            lines += [f"## {section}", ""]
        lines += [f"### {check.title[0].upper()}{check.title[1:]}", "", f"![{check.title}]({picture_name(check)})", "",
                  finding.caption, "",
                  "| what | solver | value | reference | error | gate | | cost |", "|---|---|---|---|---|---|---|---|"]
        for r in finding.results:
            unit = f" {r.unit}" if r.unit else ""
            error = number(r.error, 2) + ("" if r.error_in == "relative" else f" ({r.error_in})")
            lines.append(
                f"| {r.what} | {r.solver} | {number(r.value, 6)}{unit} | {number(r.reference, 6)}{unit} | {error} | "
                f"{'-' if r.gate is None else number(r.gate, 2)} | {_verdict(r)} | "
                f"{'-' if r.cost is None else number(r.cost, 2)} |"
            )
        lines.append("")
    return "\n".join(lines)


def write_report(report: Report, folder: Path) -> Path:
    """Writes validation.md, validation.csv and a picture of every check; returns the first."""
    folder.mkdir(parents=True, exist_ok=True)
    for check, finding in report.findings.items():
        draw_finding(finding).savefig(folder / picture_name(check))
    (folder / "validation.csv").write_text(as_csv(report), encoding="utf-8")
    table = folder / "validation.md"
    table.write_text(as_markdown(report), encoding="utf-8")
    return table


def picture_name(check: Check) -> str:
    """File of a check's picture beside the report."""
    return f"{check.id}.png"


@styled
def draw_finding(finding: Finding) -> Figure:
    """A check's picture with its caption."""
    figure = new_figure(finding.width, 4.2)
    finding.draw(figure)
    add_caption(figure, finding.caption)
    return figure


@styled
def draw_overview(report: Report) -> tuple[Figure, str]:
    """Error over gate of every line that has a gate, one row for each check."""
    checks = [check for check, finding in report.findings.items() if any(r.gate is not None for r in finding.results)]
    figure = new_figure(9.0, 0.24 * len(checks) + 1.2)
    axes = figure.add_subplot()
    low, high = _LIMITS
    markers = {"direct": "o", "explicit": "s", "xpbd": "^", "pbd": "D"}
    for y, check in enumerate(checks):
        for r in report.findings[check].results:
            if r.gate is None:
                continue
            ratio = r.error / r.gate if r.gate > 0.0 else (0.0 if r.error == 0.0 else math.inf)
            kind = r.solver.split(",")[0]
            axes.plot(min(max(ratio, low), high) if math.isfinite(ratio) else high, y, markers.get(kind, "o"),
                      color="C0" if r.passed else "C1", fillstyle="full" if r.passed is False else "none")
    axes.axvline(1.0, color="0.3", linestyle="--", linewidth=1.0)
    axes.set_xscale("log")
    axes.set_xlim(0.5 * low, 2.0 * high)
    axes.set_yticks(range(len(checks)), [check.title for check in checks])
    axes.invert_yaxis()
    axes.set_xlabel("error over gate (1); filled: failed; at the ends: beyond")
    for kind, marker in markers.items():
        axes.plot([], [], marker, color="0.4", fillstyle="none", label=kind)
    axes.legend(loc="lower left", ncols=2)
    passed, failed, shown = report.counts
    wrong = "; ".join(f"{check.title}, {r.solver}: {r.what} ({number(r.error, 2)} > {number(r.gate, 2)})"
                      for check, r in report.results if r.passed is False)
    caption = (
        f"Every line of the validation that has a gate: {passed} passed, {failed} failed; {shown} more have none. "
        + (f"Failed: {wrong}. " if wrong else "")
        + (f"Not made: {', '.join(check.title for check in report.missing)}." if report.missing else "")
    )
    add_caption(figure, caption)
    return figure, caption


def _verdict(result: Result) -> str:
    return {True: "passed", False: "FAILED", None: "-"}[result.passed]
