"""Check of the localised helix: a long rod, wound up, whose ends have come closer (Coyne 1990)."""

from __future__ import annotations

import math

import numpy as np

from analysis.validation import pictures, scenes, twisted
from analysis.validation.stability import SECTION
from analysis.validation.states import last_state, solver_report, wall_time
from analysis.validation.wire import Wire
from guidewire.figures.wording import number, percent
from guidewire.studies.table import Axis, Grid
from guidewire.sweeps.check import Check, Finding, Plan, Result, by_point, not_run

_HELIX = {"bending": 1.345, "torsion": 0.789, "length": 100.0, "shortening": 3.0, "turn": 54.0 * math.pi}
_WIRE = Wire.of_stiffness(_HELIX["length"], 0.01, _HELIX["bending"], _HELIX["torsion"], 1.0)
_COUNTS = (100, 200, 400)
_GATED = 200  # n from which the gate holds
_GATE = 5e-2


def _helix() -> Plan:
    exact = twisted.localised_helix(**_HELIX)
    wire = _WIRE
    held = {**scenes.wire_parameters(wire), "distalEnd": "clamped"}
    wound = scenes.at_rest({
        **held, "distalRotation": _HELIX["turn"], "distalDisplacement": -_HELIX["shortening"] / scenes.UNIT})
    runs = by_point((yield Grid((Axis("numberRodElements", _COUNTS),), wound).cases()))
    wanted = math.degrees(exact.largest_angle)
    results, drawn = [], {}
    for n in _COUNTS:
        run = runs[(n,)]
        gate = _GATE if n >= _GATED else None
        what = f"localised helix, 27 turns, n = {n}"
        if run.outcome != "converged":
            results.append(Result(f"{what}: {run.summary['reason']}", "direct", math.nan, exact.load, math.nan, gate))
            continue
        angles = np.arccos(np.clip(last_state(run).directors[:, 2], -1.0, 1.0))
        moment = abs(float(solver_report(run, "distalMoment")[2]))
        tension = abs(float(solver_report(run, "distalForce")[2]))
        load = moment / (2.0 * math.sqrt(wire.bending * tension))
        largest = math.degrees(float(np.max(angles)))
        results.append(Result(f"{what}: M/(2 sqrt(B T))", "direct", load, exact.load, abs(load / exact.load - 1.0),
                              gate, "", wall_time(run)))
        results.append(Result(f"{what}: largest angle", "direct", largest, wanted, abs(largest / wanted - 1.0), gate,
                              "°", wall_time(run)))
        middle = (np.arange(n) + 0.5) * wire.length / n
        drawn[f"n = {n}"] = (middle - np.average(middle, weights=1.0 - np.cos(angles)), np.degrees(angles))
    for solver in ("explicit", "xpbd"):
        small = yield from scenes.small_steps(solver, wire, _SWING, {**held, "numberRodElements": _GATED})
        results.append(not_run("localised helix, 27 turns", solver, _too_slow(small["substeps"])))

    def draw(figure) -> None:
        axes = figure.add_subplot()
        s = np.linspace(-30.0, 30.0, 601)
        axes.plot(s, np.degrees(exact.angle(s)), color="0.6", linewidth=2.5, label="endless rod")
        for marker, (name, (place, angle)) in zip(pictures.MARKERS, drawn.items()):
            axes.plot(place, angle, marker, fillstyle="none", markersize=3.5, label=name)
        axes.set_xlim(-30.0, 30.0)
        pictures.label(axes, "distance along the rod from the middle of the helix (units)",
                       "angle against the axis (°)")

    caption = (
        "A rod between clamps, brought closer by 3 of 100 and wound up by 27 turns, in parts of half a radian, each "
        "brought to rest (direct solver): angle of the elements against the axis, over the closed form of an endless "
        f"rod (largest angle {number(wanted, 4)}°). "
        + " ".join(f"{r.what.split(', ')[-1]}: {number(r.value, 4)}{r.unit} ({percent(r.error)} off)."
                   for r in results if not r.reason)
    )
    return Finding(tuple(results), draw, caption)


_SWING = 2.0 * math.pi * _WIRE.time_unit / 22.373  # s, of a clamped-clamped beam: omega L^2 sqrt(rho A/B) = 22.373


def _too_slow(substeps: int) -> str:
    """Why the helix is not wound up by small steps, of which one swing of the rod takes so many."""
    return (f"so thin a rod (L/r = {number(_WIRE.length / _WIRE.radius, 2)}) takes {number(substeps, 2)} substeps of "
            f"{_GATED} elements for one swing, and is to be wound up over many")


CHECKS = (Check("localised-helix", SECTION, "localised helix", _helix),)
