"""The chart as tables: every setting, and which setting to take for an error."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence

from analysis.chart.points import Charted, Point, best_by_error
from guidewire.figures.wording import number, percent

COLUMNS = ("problem", "method", "settings", "outcome", "error", "error is", "cost (s per simulated s)", "least cost",
           "largest cost", "wall time a step (ms)", "timed repeats", "processors of others", "on the front", "reason")


def as_csv(found: Sequence[Charted]) -> str:
    """Return one line for each setting, numbers to full precision; an error is empty where there is none."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for charted in found:
        front = charted.front()
        for p in charted.points:
            writer.writerow([
                charted.problem.name, p.setting.method, p.setting.words, p.outcome, repr(p.error) if p.held else "",
                charted.problem.error, repr(p.cost), repr(p.least), repr(p.most), repr(1e3 * p.step),
                p.setting.case.repeats, "" if p.others_busy is None else number(p.others_busy, 2),
                "true" if p in front else "false", p.reason,
            ])
    return text.getvalue()


def as_markdown(found: Sequence[Charted]) -> str:
    """Return every setting, a table for each problem, from the cheapest on."""
    lines = ["# Error against cost: every setting", "",
             "Cost is wall time in s per simulated second, one thread; bold: on the Pareto front.", ""]
    for charted in found:
        lines += [f"## {charted.problem.title[0].upper()}{charted.problem.title[1:]}", "",
                  f"Error: {charted.problem.error}. Reference: {charted.reference}.", ""]
        lines += [f"{method}: {reason}." for method, reason in charted.problem.absent.items()]
        lines += [""] * bool(charted.problem.absent)
        lines += ["| method | settings | error | cost | a step (ms) | outcome |", "|---|---|---|---|---|---|"]
        front = charted.front()
        for p in sorted(charted.points, key=lambda p: p.cost):
            error = percent(p.error) if p.held else "-"
            lines.append(f"| {p.setting.method} | {p.setting.words} | {f'**{error}**' if p in front else error} | "
                         f"{number(p.cost, 2)} | {number(1e3 * p.step, 2)} | {p.outcome} |")
        lines.append("")
    return "\n".join(lines)


def best_as_markdown(found: Sequence[Charted]) -> str:
    """Return the cheapest method and its settings for this error, on this problem."""
    lines = ["| problem | error of at most 10 % | 1 % | 0.1 % |", "|---|---|---|---|"]
    for charted in found:
        cells = [_cell(point) for _, point in best_by_error(charted)]
        lines.append(f"| {charted.problem.title} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def _cell(point: Point | None) -> str:
    if point is None or not math.isfinite(point.error):
        return "none of them"
    return f"{point.setting.method}: {point.setting.words} ({number(point.cost, 2)})"
