"""Checks of a wire that lies in a straight tube under a thrust: it begins to snake, and winds itself into a helix.

Without friction, with the angle phi about the tube's axis from its lowest line and the clearance c, the energy per
length of a wire of weight w that keeps to the wall is EI c^2/2 (phi''^2 + phi'^4) - F c^2/2 phi'^2 - w c cos(phi). In
the length (EI c/w)^(1/4) and the force sqrt(EI w/c) it has one number, f: 1/2 (phi''^2 + phi'^4) - f/2 phi'^2 -
cos(phi).

Small phi is a column on an elastic foundation: phi'''' + f phi'' + phi = 0, which an endless wire leaves at f = 2
(Dawson and Paslay 1984), one between clamps a little later. A helix of even pitch has the energy of the straight wire
at f = 2 sqrt(2) = 2.83 (Chen, Lin and Cheatham 1990). That is no limit of either shape: a straight wire may snake on
above it, a helix hold below it. A helix is pushed onto the wall by 4 phi' phi''' + 3 phi''^2 - phi'^4 + f phi'^2 +
cos(phi) (over w); where that is no push any more at the top it leaves the wall there, and then unwinds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
from scipy.integrate import solve_bvp
from scipy.optimize import brentq

from analysis.validation import pictures, scenes, tubes
from analysis.validation.states import wall_time_per_second
from analysis.validation.wire import Wire
from guidewire.figures.wording import number, percent
from guidewire.logs.logs import read_log
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

SCENE = "params/buckling.json"
EVEN_HELIX = 2.0 * math.sqrt(2.0)  # f

# What the scene has.
_WIRE = Wire(1.0, tubes.THIN.radius)
_CLEARANCE = 0.5e-3  # m
_AXIS = 0.495  # of the tube above the clamps, units: the wall begins to push the wire there
_LARGEST = 5.0  # f
_DURATION = 40.0  # s
_STEP = 1e-2  # s
_WEIGHT = _WIRE.line_density * tubes.GRAVITY  # N/m
_LENGTH = (_WIRE.bending * _CLEARANCE / _WEIGHT) ** 0.25  # m
_FORCE = math.sqrt(_WIRE.bending * _WEIGHT / _CLEARANCE)  # N

_ONSET_GATE = 0.1
_CLAMPED_GATE = 0.02
_SNAKES = (0.2, 0.5)  # amplitudes over c from which the onset is found
_WOUND = 0.95  # height of a node over 2 c that only a helix has


def clamped_onset(length: float) -> float:
    """f at which a wire between two clamps begins to snake.

    Parameters
    ----------
    length : over (EI c/w)^(1/4).
    """
    half = 0.5 * length

    def conditions(f: float) -> tuple[float, float]:
        root = math.sqrt(0.25 * f * f - 1.0)
        a, b = math.sqrt(0.5 * f - root), math.sqrt(0.5 * f + root)
        return (math.cos(a * half) * b * math.sin(b * half) - math.cos(b * half) * a * math.sin(a * half),
                math.sin(a * half) * b * math.cos(b * half) - math.sin(b * half) * a * math.cos(a * half))

    grid = np.linspace(2.0 + 1e-6, 4.0, 4000)
    values = np.array([conditions(f) for f in grid])
    roots = [brentq(lambda f, k=k: conditions(f)[k], grid[i], grid[i + 1]) for k in (0, 1)
             for i in np.nonzero(values[1:, k] * values[:-1, k] < 0.0)[0][:1]]
    return min(roots)


def helix_lifts_off() -> float:
    """f at which a helix whose number of turns is free leaves the wall at the top.

    Half a turn from the bottom to the top is solved for, with its length and f: y is phi, its three derivatives, and
    the energy so far. As turns are free, the energy per length is the least: with the Hamiltonian H, which does not
    change along the wire, the energy is - H times the length.
    """

    def rates(x: np.ndarray, y: np.ndarray, unknown: np.ndarray) -> np.ndarray:
        length, f = unknown
        bend = 6.0 * y[1] ** 2 * y[2] - f * y[2] - np.sin(y[0])
        return length * np.array([y[1], y[2], y[3], bend, _energy(y, f)])

    def ends(a: np.ndarray, b: np.ndarray, unknown: np.ndarray) -> np.ndarray:
        length, f = unknown
        hamiltonian = b[1] * (2.0 * b[1] ** 3 - f * b[1] - b[3]) + b[2] ** 2 - _energy(b, f)
        push = 4.0 * b[1] * b[3] + 3.0 * b[2] ** 2 - b[1] ** 4 + f * b[1] ** 2 + np.cos(b[0])
        return np.array([a[0], a[2], a[4], b[0] - np.pi, b[2], b[4] + hamiltonian * length, push])

    x = np.linspace(0.0, 1.0, 41)
    slope = math.sqrt(0.5 * EVEN_HELIX)
    even = np.array([np.pi * x, np.full_like(x, slope), 0.0 * x, 0.0 * x, -np.pi / slope * x])
    solution = solve_bvp(rates, ends, x, even, p=np.array([np.pi / slope, EVEN_HELIX]), tol=1e-6)
    if solution.status != 0:
        raise ArithmeticError(f"helix in a tube: {solution.message}")
    return float(solution.p[1])


def _energy(y: np.ndarray, f: float) -> np.ndarray:
    return 0.5 * (y[2] ** 2 + y[1] ** 4) - 0.5 * f * y[1] ** 2 - np.cos(y[0])


def _loading(fraction: float) -> Plan:
    """Load for this fraction of the run."""
    steps = round(fraction * _DURATION / _STEP)
    case = Case("direct", {"maxSimulationSteps": steps, "logEvery": 10, "logFormat": "npz"})
    runs = yield [case]
    run: Run = runs[case.key]
    log = read_log(run.folder, spheres="all")
    load = _LARGEST * (1.0 - np.abs(2.0 * log.time / _DURATION - 1.0))
    across = np.max(np.abs(log.positions[:, :, 0]), axis=1) * scenes.UNIT / _CLEARANCE
    above = 0.5 * np.max(log.positions[:, :, 1], axis=1) * scenes.UNIT / _CLEARANCE
    rising = log.time <= 0.5 * _DURATION
    clamped = clamped_onset(_WIRE.length / _LENGTH)
    up = _onset(load[rising], across[rising])
    imperfection = float(np.max(across[rising & (load < 1.5)]))
    clearance = f"clearance {1e3 * _CLEARANCE:g} mm, off its lowest line by {percent(imperfection)} of that before"
    cost = wall_time_per_second(run)

    def line(what: str, value: float, reference: float, gate: float | None) -> Result:
        return Result(what, "direct", value, reference, abs(value / reference - 1.0), gate, "sqrt(EI w/c)", cost)

    results = [
        line(f"snaking begins as the thrust grows, {clearance}; endless wire", up, 2.0, _ONSET_GATE),
        line("the same, wire between clamps", up, clamped, _CLAMPED_GATE),
    ]
    if fraction == 1.0:
        down = _onset(load[~rising], across[~rising])
        comes = _first(load[rising], above[rising] > _WOUND)
        goes = _first(load[~rising], above[~rising] < _WOUND)
        results += [
            line("snaking ends as the thrust falls; wire between clamps", down, clamped, _CLAMPED_GATE),
            line("helix comes as the thrust grows; equal energies", comes, EVEN_HELIX, None),
            line("helix goes as the thrust falls; it leaves the wall at the top", goes, helix_lifts_off(), None),
        ]

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for name, style, part in (("thrust grows", "C0-", rising), ("thrust falls", "C1--", ~rising)):
            axes.plot(load[part], across[part], style, label=f"across, {name}")
            axes.plot(load[part], above[part], style, linewidth=2.5, alpha=0.4, label=f"height/2, {name}")
        for f, name in ((2.0, "2"), (EVEN_HELIX, "2.83")):
            axes.axvline(f, color="0.3", linewidth=0.9, linestyle=":", label=name)
        pictures.label(axes, "thrust (sqrt(EI w/c))", "largest distance of a node (c)")

    return Finding(tuple(results), draw, (
        f"A wire of {2e3 * _WIRE.radius:g} mm in a straight tube with {1e3 * _CLEARANCE:g} mm of clearance, between "
        f"clamps, one of which slides under a thrust that grows and falls. It snakes from {number(up, 4)} sqrt(EI w/c) "
        f"on, {number(clamped, 4)} in theory; a uniform helix has the energy of the straight wire at "
        f"{number(EVEN_HELIX, 3)}."))


def _onset(load: np.ndarray, across: np.ndarray) -> float:
    """Find where the square of the amplitude, which grows in proportion to the excess, was 0."""
    snakes = (across > _SNAKES[0]) & (across < _SNAKES[1])
    if np.count_nonzero(snakes) < 3:
        return math.nan
    slope, at_none = np.polyfit(load[snakes], across[snakes] ** 2, 1)
    return float(-at_none / slope)


def _first(load: np.ndarray, reached: np.ndarray) -> float:
    return float(load[np.argmax(reached)]) if np.any(reached) else math.nan


def _prepared(f: float) -> Case:
    """A helix of whole turns, of the even pitch of this load, between the clamps."""
    radius = _AXIS
    turns = int(_WIRE.length / _LENGTH * math.sqrt(0.5 * f) / (2.0 * math.pi))
    steep = 2.0 * math.pi * turns * radius * scenes.UNIT / _WIRE.length
    arc = np.linspace(0.0, 1.0, 101)
    angle = 2.0 * math.pi * turns * arc
    along = math.sqrt(1.0 - steep * steep) * _WIRE.length / scenes.UNIT * arc
    nodes = np.stack([radius * np.sin(angle), radius - radius * np.cos(angle), along], axis=1)
    start = {"positions": nodes.tolist(), "orientations": tubes.untwisted_frames(nodes),
             **scenes.CLAMPS_ALONG_Z}
    return Case(f"load={f:g}", {"loadTables": None, "axialForce": -f * _FORCE, "gravity": [0.0, -tubes.GRAVITY, 0.0],
                                "timeStep": 5e-3, "maxSimulationSteps": 600, "logFormat": "npz"}, start=start)


def _held(loads: Sequence[float]) -> Plan:
    cases = {f: _prepared(f) for f in loads}
    runs = yield list(cases.values())
    left: dict[float, float] = {}
    results: list[Result] = []
    curves: dict[float, tuple[np.ndarray, np.ndarray]] = {}
    for f, case in cases.items():
        run: Run = runs[case.key]
        log = read_log(run.folder, spheres="all")
        x, y = log.positions[:, :, 0], log.positions[:, :, 1]
        turns = np.unwrap(np.arctan2(x, _AXIS - y), axis=1)[:, -1] / (2.0 * np.pi)
        curves[f] = (log.time, turns)
        left[f] = abs(turns[-1] / turns[0])
        if f > EVEN_HELIX or f < _FAR_BELOW * EVEN_HELIX:
            holds = f > EVEN_HELIX
            results.append(Result(
                f"prepared helix of {turns[0]:.0f} turns at {f:g} sqrt(EI w/c), after 3 s: fraction of its turns",
                "direct", left[f], 1.0 if holds else 0.0, abs(left[f] - holds), 0.05, "", wall_time_per_second(run),
                "of its turns"))
    holding, losing = [f for f in left if left[f] > 0.95], [f for f in left if left[f] <= 0.95]
    if len(loads) > 2 and holding and losing:
        limit = 0.5 * (min(holding) + max(losing))
        results.append(Result(
            f"prepared helix loses turns below, found between {max(losing):g} and {min(holding):g}; it leaves the wall "
            "at the top", "direct", limit, helix_lifts_off(), abs(limit / helix_lifts_off() - 1.0), None,
            "sqrt(EI w/c)"))
    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for f, (time, turns) in curves.items():
            axes.plot(time, turns, "-" if f in holding else "--", label=f"{f:g}")
        pictures.label(axes, "time (s)", "turns about the tube's axis")

    return Finding(tuple(results), draw, (
        "A helix prepared in the same tube, under a steady thrust in sqrt(EI w/c): its turns (broken: it loses some). "
        f"It has the energy of the straight wire at {number(EVEN_HELIX, 3)}, and leaves the wall at the top at "
        f"{number(helix_lifts_off(), 3)}."))


_FAR_BELOW = 0.91  # of the even helix's load: there it unwinds
_ENDS = (0.9 * EVEN_HELIX, 1.01 * EVEN_HELIX)


def _loading_check(fraction: float) -> Check:
    return Check("tube-buckling", tubes.SECTION, "a wire in a straight tube: sinusoidal and helical buckling",
                 partial(_loading, fraction), SCENE)


def _helix_check(loads: Sequence[float]) -> Check:
    return Check("tube-helix", tubes.SECTION, "a prepared helix in a straight tube", partial(_held, loads), SCENE)


CHECKS = (_loading_check(1.0), _helix_check((_ENDS[0], 2.58, 2.6, 2.63, 2.65, 2.7, 2.75, 2.8, _ENDS[1], 3.2)))
FAST = (_loading_check(0.3), _helix_check(_ENDS))
