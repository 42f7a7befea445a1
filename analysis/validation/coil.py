"""Check of a straight wire that is pushed into a helical tube without friction: the hub's force and the wall's.

The tube's axis has the curvature kappa and the torsion tau. A wire that may turn about its axis does not twist: its
couple is EI kappa along the binormal. From M' + t x n = 0 and n' + f = 0 with f across the tangent follow the shear
force -EI kappa tau along the binormal and T + EI kappa^2/2 = constant for the tension T, so that the hub pushes by EI
kappa^2/2, the thrust inside is EI kappa^2, and the wall pushes the wire by EI kappa (kappa^2 - tau^2) per length.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from analysis.validation import pictures, scenes, tubes
from analysis.validation.states import wall_time_per_second
from guidewire.figures.wording import percent
from guidewire.logs.hub import read_hub
from guidewire.logs.logs import read_entries
from guidewire.studies.table import Case
from guidewire.sweeps.check import Check, Finding, Plan, Result

_WIRE = tubes.WIRE
_RADIUS, _LUMEN = 30.0, 0.5  # mm; the clearance is 0.1 mm
_PITCHES = (0.25, 0.5, 0.75)  # rise per length around: tau/kappa
_SPEED, _STEP, _TIME = 0.05, 1e-2, 5.0  # m/s, s, s
_STRAIGHT = 1.3 * _WIRE.length / scenes.UNIT  # of tube before the helix, units
_KNOTS = 32  # a turn
_ELEMENTS = 150
_SHOWN = (0.06, 0.25)  # m of the hub's displacement over which its force is averaged
_DEEP = 0.2  # m from which on the wall's is,
_ENDS = 0.06  # m at either end of the helical part left out: its shape there differs over 1/kappa
_GATE = 2e-2


def _knots(pitch: float) -> np.ndarray:
    """Return a straight piece along z, then two turns of a helix that begins along it; units."""
    angle = np.linspace(0.0, 4.0 * math.pi, 2 * _KNOTS + 1)
    helix = np.stack([_RADIUS * (np.cos(angle) - 1.0), _RADIUS * np.sin(angle), pitch * _RADIUS * angle], axis=1)
    # The helix's first tangent, (0, 1, pitch), is turned to z about x.
    scale = 1.0 / math.hypot(1.0, pitch)
    turn = np.array([[1.0, 0.0, 0.0], [0.0, pitch * scale, -scale], [0.0, scale, pitch * scale]])
    return np.concatenate([[[0.0, 0.0, -_STRAIGHT]], helix @ turn.T])


def _plan() -> Plan:
    cases = {}
    for pitch in _PITCHES:
        vessel = {**tubes.tube(_knots(pitch), _LUMEN), "smooth": True}
        cases[pitch] = Case(f"pitch={pitch:g}", tubes.in_vessel(
            _WIRE, vessel, _STEP, round(_TIME / _STEP), numberRodElements=_ELEMENTS, drive="displace",
            insertionSpeed=_SPEED, massDamping=20.0, logHub=True, logContacts=True,
            guidewireOffset=-_WIRE.length / scenes.UNIT - 2.0))
    runs = yield list(cases.values())
    results, curves = [], {}
    for pitch, case in cases.items():
        run = runs[case.key]
        radius = _RADIUS * scenes.UNIT * (1.0 + pitch**2)
        kappa, tau = 1.0 / radius, pitch / radius
        hub, exact = read_hub(run.folder), 0.5 * _WIRE.bending * kappa**2
        shown = (hub.insertion > _SHOWN[0]) & (hub.insertion < _SHOWN[1])
        force = float(np.mean(hub.force[shown]))
        curves[pitch] = (hub.insertion, hub.force / exact)
        what = f"wire in a helical tube, tau/kappa = {pitch:g}, n = {_ELEMENTS}"
        cost = wall_time_per_second(run)
        results.append(Result(f"{what}: mean force of the hub", "direct", force, exact, abs(force / exact - 1.0), _GATE,
                              "N", cost))
        wanted = _WIRE.bending * kappa * (kappa**2 - tau**2)
        wall = _wall_per_length([entry for _, entry in read_entries(run.folder)][1:], (hub.insertion > _DEEP)[1:])
        results.append(Result(f"{what}: force of the wall per length", "direct", wall, wanted, abs(wall / wanted - 1.0),
                              _GATE, "N/m", cost))

    def draw(figure: Any) -> None:
        axes = figure.add_subplot()
        for pitch, (inserted, force) in curves.items():
            axes.plot(1e3 * inserted, force, label=f"tau/kappa = {pitch:g}")
        axes.axhline(1.0, color="0.3", linestyle=":", label="closed form")
        pictures.label(axes, "displacement of the hub (mm)", "force of the hub over EI kappa²/2 (1)")

    return Finding(tuple(results), draw, (
        "A straight wire is pushed into a helical tube without friction: the force of the hub over EI kappa²/2. "
        f"Worst: hub {percent(max(r.error for r in results[::2]))}, wall per length "
        f"{percent(max(r.error for r in results[1::2]))}."))


def _wall_per_length(entries: list[dict[str, Any]], shown: np.ndarray) -> float:
    """Mean of the walls' force per length, N/m, over the shown steps and the helical part but for its ends."""
    values, piece = [], _WIRE.length / _ELEMENTS
    for entry, use in zip(entries, shown):
        if not use:
            continue
        forces = entry["contact"]["sphere"]
        # The first node beyond the straight tube, which ends at z = 0; those that follow are in the helix.
        first = next(i for i in range(_ELEMENTS + 1) if entry["sphere"][str(i)]["z"] > 0.0)
        inside = range(first, _ELEMENTS + 1)
        ends = round(_ENDS / piece)
        kept = inside[ends:-ends]
        total = sum(math.hypot(*(forces[str(i)][axis] for axis in "xyz")) for i in kept if str(i) in forces)
        values.append(total / (len(kept) * piece))
    return float(np.mean(values))


CHECKS = (Check("coil", tubes.SECTION, "a wire is pushed into a helical tube", _plan),)
