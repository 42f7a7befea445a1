"""Checks of a smooth wire between walls: the force of a passage, and that it does not leave."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes, tubes
from analysis.validation.states import wall_time_per_second
from guidewire.figures.wording import number, percent
from guidewire.logs.hub import read_hub
from guidewire.logs.logs import read_log
from guidewire.logs.runs import Run
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_STENOSIS_RADIUS = 1.2  # of the wire's
_OFF_AXIS = (0.0, 0.1, 0.3, 1.0)  # units
_STENOSIS_GATE = 1e-2  # of the buckling load


def _stenosis() -> Plan:
    """Straight wires, level with the throat or beside it, are pushed through it at 50 mm/s."""
    narrow, wide = _STENOSIS_RADIUS * tubes.WIRE.radius / scenes.UNIT, 3.0
    along = (-100.0, 300.0, 320.0, 340.0, 350.0, 370.0, 500.0)
    radii = [wide, wide, wide, narrow, narrow, wide, wide]
    cases = {off: Case(f"off={off:g}", tubes.in_vessel(
        tubes.WIRE, tubes.tube([[0.0, off, z] for z in along], radii), 1e-2, 220, numberRodElements=60,
        drive="displace", insertionSpeed=0.05, logHub=True, logSpheres="last")) for off in _OFF_AXIS}
    runs = yield list(cases.values())
    buckling = 0.25 * math.pi**2 * tubes.WIRE.bending / tubes.WIRE.length**2
    results, curves = [], {}
    for off, case in cases.items():
        run = runs[case.key]
        log = read_hub(run.folder)
        ahead = log.tip[:, 2] > 316.0  # where the start, a jump to the full speed, is over
        largest = float(np.max(np.abs(log.force[ahead])))
        curves[f"{off:g} mm"] = (log.tip[:, 2] - 300.0, log.force / buckling)
        results.append(Result(
            f"largest force of the hub through a stenosis of {_STENOSIS_RADIUS:g} wire radii, axis off by {off:g} mm; "
            "reference: Euler's load of the free wire", "direct", largest, buckling, largest / buckling,
            _STENOSIS_GATE, "N", wall_time_per_second(run), "of the buckling load"))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for name, (inserted, force) in curves.items():
            axes.plot(inserted[inserted > 16.0], 100.0 * force[inserted > 16.0], label=f"off axis by {name}")
        pictures.label(axes, "displacement of the tip (mm)", "force of the hub (% of the buckling load)")

    return Finding(tuple(results), draw, (
        f"A straight wire is pushed through a frictionless stenosis of {_STENOSIS_RADIUS:g} of its radii: force at the "
        f"hub, at most {percent(max(r.error for r in results))} of the load at which the wire buckles, pi^2 EI/(4 L^2) "
        f"= {number(buckling, 3)} N."))


_BEND, _ARCH_LUMEN, _COIL_LUMEN = 30.0, 3.0, 0.6  # units
_SPEEDS = (0.05, 0.2, 1.0)  # m/s
_SAMPLES = 20  # an element


def _containment() -> Plan:
    """Pushes and turns in tubes of one radius: what is farther from the centreline than the clearance, sampled."""
    arch = tubes.bend(_BEND, math.pi, 40, 320.0, 200.0)
    # Away from z by 0.6 rad over 40 mm, and round it once in 160 mm.
    arc = np.arange(0.0, 161.0)
    lean, around = 0.6 * np.clip(arc / 40.0, 0.0, 1.0), 2.0 * math.pi * arc / 160.0
    steps = np.stack([np.sin(lean) * np.cos(around), np.sin(lean) * np.sin(around), np.cos(lean)], axis=1)
    coil = np.concatenate([[[0.0, 0.0, -330.0]], np.cumsum(steps, axis=0)])
    vessels = {"arch": (arch, _ARCH_LUMEN), "coil": (coil, _COIL_LUMEN)}
    cases = {}
    for name, (knots, lumen) in vessels.items():
        for speed in _SPEEDS:
            step = min(1e-2, 5e-3 / speed)
            cases[name, speed] = Case(f"{name},speed={speed:g}", tubes.in_vessel(
                tubes.WIRE, tubes.tube(knots, lumen, 0.1), step, round(0.12 / speed / step), numberRodElements=60,
                guidewireOffset=-305.0, drive="displace", insertionSpeed=speed, rotationSpeed=20.0 * speed,
                restCurvature=[5.0, 0.0, 0.0] if name == "arch" else [0.0, 0.0, 0.0], logFormat="npz"))
    runs = yield list(cases.values())
    results, curves = [], {}
    for (name, speed), case in cases.items():
        run: Run = runs[case.key]
        knots, lumen = vessels[name]
        log = read_log(run.folder, spheres="all")
        nearest = np.array([_clearance(nodes, knots, lumen) for nodes in log.positions])
        curves[f"{name}, {speed:g} m/s"] = (log.time * speed / scenes.UNIT, np.min(nearest, axis=1))
        outside = int(np.count_nonzero(nearest < 0.0))
        results.append(Result(
            f"{name} of {lumen:g} mm, {speed:g} m/s, turned, friction 0.1 ({run.outcome} after {len(log.time) - 1} "
            "steps): points outside", "direct", outside, 0.0, float(outside), 0.0, "", wall_time_per_second(run),
            "points"))
        counted = float(run.measured("passages")) + float(run.measured("maxPenetration"))
        results.append(Result("the same, passages and depth by the run's own count", "direct", counted, 0.0, counted,
                              0.0, "", error_in="points and units"))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for name, (inserted, gap) in curves.items():
            axes.plot(inserted, gap, label=name)
        axes.set_yscale("log")
        pictures.label(axes, "displacement of the hub (mm)", "least gap between wire and wall (mm)")

    return Finding(tuple(results), draw, (
        "A wire is pushed by 120 mm and rotated in an arch and in a coil, at up to 1 m/s: least gap, from the log "
        f"alone, over {_SAMPLES} points of each element after every step. Points outside: "
        f"{sum(int(r.value) for r in results[::2])}."))


def _clearance(nodes: np.ndarray, knots: np.ndarray, lumen: float) -> np.ndarray:
    """Gap of points along the wire to the wall of a tube about a line of knots, units.

    Parameters
    ----------
    nodes : ndarray, shape (n + 1, 3)
    knots : ndarray, shape (k, 3)
    lumen : the tube's radius.
    """
    fraction = (np.arange(_SAMPLES) / _SAMPLES)[None, :, None]
    inner = nodes[:-1, None] * (1.0 - fraction) + nodes[1:, None] * fraction
    points = np.concatenate([inner.reshape(-1, 3), nodes[-1:]])
    least = np.full(len(points), np.inf)
    for start, end in zip(knots[:-1], knots[1:]):
        axis = end - start
        at = np.clip((points - start) @ axis / (axis @ axis), 0.0, 1.0)
        least = np.minimum(least, np.linalg.norm(points - start - at[:, None] * axis, axis=1))
    return lumen - tubes.WIRE.radius / scenes.UNIT - least


_STENOSIS = Check("stenosis", tubes.SECTION, "a straight wire through a stenosis", _stenosis)
CHECKS = (_STENOSIS, Check("containment", tubes.SECTION, "no point leaves the lumen", _containment))
FAST = (_STENOSIS,)
