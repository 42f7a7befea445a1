"""Check of the hub's force on a wire that is pushed through a bend: that it converges, and to what."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes, tubes
from analysis.validation.states import wall_time_per_second
from guidewire.figures.wording import percent, span
from guidewire.logs.hub import HubLog, read_hub
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_BEND, _LUMEN, _PIECES, _SPEED = 40.0, 2.0, 8, 0.05  # units, units, of 90 degrees, m/s
_ELEMENTS, _STEPS, _LUMENS = (50, 100, 200), (0.02, 0.01, 0.005), (0.8, 1.0)  # dt in s, lumens in units
_GATE = 1e-2  # of the peak of the finest run
_WIRE = tubes.WIRE
_START, _END = 0.005, 0.1  # m, displacement of the hub: the start at full speed is over, the tip is out of the bend


def _pushed(n: int, step: float, smooth: bool, mu: float, lumen: float = _LUMEN, angle: float = 90.0) -> dict[str, Any]:
    pieces = round(_PIECES * angle / 90.0)
    knots = tubes.bend(_BEND, math.radians(angle), pieces, 1.2 * _WIRE.length / scenes.UNIT, 400.0)
    vessel = {**tubes.tube(knots, lumen, mu), "smooth": smooth}
    return tubes.in_vessel(_WIRE, vessel, step, round(2.0 / step), numberRodElements=n, drive="displace",
                           insertionSpeed=_SPEED, massDamping=20.0, logHub=True, logSpheres="last",
                           guidewireOffset=-_WIRE.length / scenes.UNIT - 10.0)


def _plan() -> Plan:
    """Peak over n and dt with corners and without them, and the plateau of a long bend against its energy."""
    kinds = {"corners": (False, 0.0), "smooth": (True, 0.0), "smooth, friction 0.2": (True, 0.2)}
    finest = (2 * _ELEMENTS[-1], _STEPS[-1])
    points = list(dict.fromkeys([*((n, _STEPS[1]) for n in _ELEMENTS), *((_ELEMENTS[1], step) for step in _STEPS),
                                 finest]))
    cases = {(kind, n, step): Case(f"{kind.replace(', ', '-').replace(' ', '-')},n={n},dt={step:g}",
                                   _pushed(n, step, smooth, mu))
             for kind, (smooth, mu) in kinds.items() for n, step in points}
    cases |= {("long", lumen, n): Case(f"long,lumen={lumen:g},n={n}", _pushed(n, _STEPS[1], True, 0.0, lumen, 180.0))
              for lumen in _LUMENS for n in _ELEMENTS[1:]}
    runs = yield list(cases.values())
    logs = {key: read_hub(runs[case.key].folder) for key, case in cases.items()}
    plateaus = _plateaus(cases, runs, logs)
    results = [*_peaks(kinds, points, finest, cases, runs, logs), *plateaus]
    spread = {kind: [_peak(logs[kind, *point]) for point in points] for kind in kinds}

    def draw(figure: Any) -> None:
        left, right = figure.subplots(1, 2)
        for kind in ("corners", "smooth"):
            for n in (*_ELEMENTS, finest[0]):
                log = logs[(kind, *finest) if n == finest[0] else (kind, n, _STEPS[1])]
                shown = (log.insertion > 0.02) & (log.insertion < _END)
                left.plot(1e3 * log.insertion[shown], log.force[shown], "-" if kind == "smooth" else ":",
                          linewidth=1.0, label=f"{kind}, n = {n}")
        left.set(xlabel="displacement of the hub (mm)", ylabel="force of the hub (N)")
        left.legend(fontsize="x-small")
        for marker, (kind, (_, mu)) in zip(pictures.MARKERS, kinds.items()):
            limit = _peak(logs[kind, *finest])
            right.plot(_ELEMENTS, [100.0 * (_peak(logs[kind, n, _STEPS[1]]) / limit - 1.0) for n in _ELEMENTS],
                       marker + "-", fillstyle="none", label=kind)
        right.axhspan(-100.0 * _GATE, 100.0 * _GATE, color="0.9", zorder=0, label="gate")
        right.set(xlabel="number of elements n", ylabel=f"peak, from that of n = {finest[0]} (%)")
        right.legend(fontsize="x-small")

    return Finding(tuple(results), draw, (
        "A wire is pushed through a bend of 90°. Between straight pieces the peak force is "
        f"{span(spread['corners'], 3)} N over n and dt. With rounded corners (smooth) it converges: "
        f"{span(spread['smooth'], 3)} N, with friction 0.2 {span(spread['smooth, friction 0.2'], 4)} N. In a bend of "
        f"180° the mean is EI/(2 R²) to {percent(max(r.error for r in plateaus))}, R that of the centreline."),
        width=10.0)


def _peaks(kinds: Mapping[str, Any], points: list, finest: tuple, cases: Mapping, runs: Mapping,
           logs: Mapping) -> list[Result]:
    results = []
    for kind in kinds:
        limit = _peak(logs[kind, *finest])
        for n, step in points[:-1]:
            peak = _peak(logs[kind, n, step])
            results.append(Result(
                f"wire pushed through a bend of 90°, {kind}, n = {n}, dt = {1e3 * step:g} ms: peak force of the hub; "
                f"reference: n = {finest[0]}, dt = {1e3 * finest[1]:g} ms", "direct", peak, limit,
                abs(peak / limit - 1.0), None if kind == "corners" else _GATE, "N",
                wall_time_per_second(runs[cases[kind, n, step].key])))
    return results


def _plateaus(cases: Mapping, runs: Mapping, logs: Mapping) -> list[Result]:
    """Against EI/(2 R^2): a wire on the inner or the outer wall has R -+ c with the clearance c, and a force that is
    2 c/R away."""
    results = []
    circle = _BEND * math.cos(0.25 * math.pi / _PIECES) * scenes.UNIT
    for lumen in _LUMENS:
        clearance = lumen * scenes.UNIT - _WIRE.radius
        for n in _ELEMENTS[1:]:
            log = logs["long", lumen, n]
            begin, end = (0.01 + circle * math.radians(angle) for angle in (60.0, 120.0))
            inside = (log.insertion > begin) & (log.insertion < end)
            force, exact = float(np.mean(log.force[inside])), 0.5 * _WIRE.bending / circle**2
            results.append(Result(
                f"wire in a smooth bend of 180°, lumen {lumen:g} mm, n = {n}: mean force of the hub; reference "
                "EI/(2 R²) on the centreline, gate 2 c/R of the clearance c", "direct", force, exact,
                abs(force / exact - 1.0), 2.0 * clearance / circle, "N",
                wall_time_per_second(runs[cases["long", lumen, n].key])))
    return results


def _peak(log: HubLog) -> float:
    """Largest force while the tip goes through the bend, N."""
    inside = (log.insertion > _START) & (log.insertion < _END)
    return float(np.max(log.force[inside]))


CHECKS = (Check("hub-force", tubes.SECTION, "the force of the hub in a bend converges", _plan),)
