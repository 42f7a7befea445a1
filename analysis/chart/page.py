"""The chart as a self-contained page: each point shows its settings under the pointer."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence

from analysis.chart.points import FRAME, METHODS, TICK, Charted, Cost, Point, milliseconds, seconds
from guidewire.figures.wording import number, percent

_WIDTH, _HEIGHT = 560, 400
_LEFT, _RIGHT, _TOP, _BOTTOM = 64, 12, 26, 44
_COLOURS = dict(zip(METHODS, ("#1f77b4", "#ff7f0e", "#2ca02c", "#d62728")))
_STYLE = """body{font:14px sans-serif;max-width:1180px;margin:1em auto}svg{margin:4px;background:#fff}
text{font:11px sans-serif}.title{font-weight:bold}.grid{stroke:#eee}.line{stroke:#555;stroke-dasharray:4 3}
.front{fill:none;stroke:#ccc;stroke-width:5;stroke-linejoin:round}.point{fill:#fff;fill-opacity:.01;stroke-width:1.6}
.point:hover{stroke-width:4}"""


def as_page(found: Sequence[Charted]) -> str:
    """Return the page: every problem against cost, then against the wall time of a step."""
    parts = [
        "<!DOCTYPE html>", '<html lang="en"><head><meta charset="utf-8"><title>Error against cost</title>',
        f"<style>{_STYLE}</style></head><body>", "<h1>Error against cost</h1>",
        "<p>Hover over a mark to read its settings. Grey: the Pareto front. Crosses at the upper edge: settings "
        "without a result.</p><p>",
        *(f'<span style="color:{_COLOURS[method]}">&#9679; {method}</span> ' for method in METHODS),
        "</p>", "<h2>Wall time per simulated second</h2>",
        *(_panel(charted, seconds, "wall time per simulated second (s per s)", ((1.0, "real time"),))
          for charted in found),
        "<h2>Wall time of one time step</h2>",
        *(_panel(charted, milliseconds, "wall time of one time step (ms)",
                 ((1e3 * FRAME, "90 Hz"), (1e3 * TICK, "1 kHz"))) for charted in found),
        "</body></html>",
    ]
    return "\n".join(parts) + "\n"


class _Axis:
    """A logarithmic axis from a value to a place in the picture."""

    def __init__(self, values: Sequence[float], first: float, last: float) -> None:
        self._low = math.floor(math.log10(min(values)) - 0.15)
        self._high = math.ceil(math.log10(max(values)) + 0.15)
        self._first, self._last = first, last

    def at(self, value: float) -> float:
        """Return the place of a value."""
        fraction = (math.log10(value) - self._low) / (self._high - self._low)
        return self._first + fraction * (self._last - self._first)

    @property
    def decades(self) -> list[float]:
        """Whole powers of ten."""
        return [10.0**k for k in range(self._low, self._high + 1)]


def _panel(charted: Charted, cost: Cost, label: str, lines: Sequence[tuple[float, str]]) -> str:
    x = _Axis([*(cost(p) for p in charted.points), *(at for at, _ in lines)], _LEFT, _WIDTH - _RIGHT)
    y = _Axis([p.drawn for p in charted.points if p.held], _HEIGHT - _BOTTOM, _TOP + 16)
    right, low = _WIDTH - _RIGHT, _HEIGHT - _BOTTOM
    parts = [f'<svg width="{_WIDTH}" height="{_HEIGHT}" role="img">',
             f'<text class="title" x="{_LEFT}" y="16">{html.escape(charted.problem.title)}</text>']
    for value in x.decades:
        parts.append(f'<line class="grid" x1="{x.at(value):.1f}" x2="{x.at(value):.1f}" y1="{_TOP}" y2="{low}"/>'
                     f'<text x="{x.at(value):.1f}" y="{low + 14}" text-anchor="middle">{value:g}</text>')
    for value in y.decades:
        parts.append(f'<line class="grid" x1="{_LEFT}" x2="{right}" y1="{y.at(value):.1f}" y2="{y.at(value):.1f}"/>'
                     f'<text x="{_LEFT - 4}" y="{y.at(value) + 4:.1f}" text-anchor="end">{value:g}</text>')
    for value, name in lines:
        parts.append(f'<line class="line" x1="{x.at(value):.1f}" x2="{x.at(value):.1f}" y1="{_TOP}" y2="{low}"/>'
                     f'<text x="{x.at(value) - 3:.1f}" y="{low - 4}" text-anchor="end">{name}</text>')
    front = " ".join(f"{x.at(cost(p)):.1f},{y.at(p.drawn):.1f}"
                     for p in charted.front(cost))
    parts.append(f'<polyline class="front" points="{front}"/>')
    parts += [_mark(p, x.at(cost(p)), y.at(p.drawn) if p.held else _TOP + 6) for p in charted.points]
    parts.append(f'<text x="{0.5 * (_LEFT + right):.0f}" y="{_HEIGHT - 8}" text-anchor="middle">{label}</text>'
                 f'<text transform="translate(14 {0.5 * (_TOP + low):.0f}) rotate(-90)" text-anchor="middle">'
                 f'error: {html.escape(charted.problem.error)}</text></svg>')
    return "\n".join(parts)


def _mark(point: Point, x: float, y: float) -> str:
    said = [f"{point.setting.method}: {point.setting.words}",
            f"error {percent(point.error)}" if point.held else f"{point.outcome}: {point.reason}",
            f"{number(point.cost, 3)} s per simulated second ({number(point.least, 2)} to {number(point.most, 2)})",
            f"{number(1e3 * point.step, 3)} ms a step"]
    shape = (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4.5" ' if point.held else
             f'<path d="M{x - 4:.1f} {y - 4:.1f}l8 8m0 -8l-8 8" ')
    return (f'{shape}class="point" stroke="{_COLOURS[point.setting.method]}"><title>'
            f"{html.escape(chr(10).join(said))}</title></{'circle' if point.held else 'path'}>")
