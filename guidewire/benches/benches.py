"""Bench tests of a wire: each as the parameters of a run, and its evaluation.

Three-point bending after ASTM F2606, a guide for stents: cylinders of radius 6.35 mm (so in the fixture of
instron.us for it), none of them with friction. In the frame of the two fixed anvils the proximal support moves: that is
the same test, as the deflection is measured from the chord between the supports.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from guidewire.benches.wire import Wire
from guidewire.logs.logs import LogError, read_columns
from guidewire.logs.runs import Run, read_run

ANVIL = 6.35e-3  # radius, m
SPAN_DIAMETERS = 60.0  # shear then adds less than 0.3 % to the deflection, also of a thin-walled tube
LEAST_SPAN = 50e-3  # m
_DEFLECTION = 1.0 / 400.0  # of the span: the supports turn by 0.02 rad at most
_ELEMENTS = 72
_STEPS = 10
_STEP = 1.0  # s: rests but for a drag of less than 1e-4 of the load
_TWIST = math.pi  # rad, of the torque test: below 9 EI/(GJ) rad, where a clamped wire coils up


@dataclass(frozen=True)
class Bending:
    """What three-point bending gives.

    Attributes
    ----------
    force : of the middle anvil, N.
    deflection : of the wire under it, from the chord between the supports, m.
    arms : distances of the middle contact from both supports, m.
    """

    force: float
    deflection: float
    arms: tuple[float, float]

    @property
    def stiffness(self) -> float:
        """EI of a uniform beam with this force and deflection: F a^2 b^2/(3 (a + b) deflection), N m^2."""
        a, b = self.arms
        return self.force * a**2 * b**2 / (3.0 * (a + b) * self.deflection)


def span_of(wire: Wire) -> float:
    """Distance between the supports of three-point bending, m."""
    return max(LEAST_SPAN, SPAN_DIAMETERS * 2.0 * wire.radius)


def expected_stiffness(wire: Wire, start: float, arms: tuple[float, float]) -> float:
    """Return what three-point bending of a piece gives by the method of unit loads: the integral of m^2/EI, m the
    moment of a unit force, in place of the compliance of a uniform beam."""
    a, b = arms
    edges = np.unique(np.concatenate([[0.0, a, a + b], np.clip(wire.ends - start, 0.0, a + b)]))
    stiffness = wire.stiffness(start + 0.5 * (edges[1:] + edges[:-1]))
    moment = np.minimum(edges * b, (a + b - edges) * a) / (a + b)
    left, right = moment[:-1], moment[1:]
    compliance = np.sum(np.diff(edges) * (left**2 + left * right + right**2) / 3.0 / stiffness)
    return float(a**2 * b**2 / (3.0 * (a + b) * compliance))


def three_point(wire: Wire, start: float) -> dict[str, Any]:
    """Parameters of a bending test of the piece that begins at start, m."""
    span = span_of(wire)
    length = 1.2 * span  # the rest lies over the distal support
    gap = min(2e-5, 0.05 * wire.radius)
    height = 1e3 * (wire.radius + ANVIL + gap)
    anvils = [{"shape": "capsule", "from": [-20.0, side * height, z], "to": [20.0, side * height, z],
               "radius": 1e3 * ANVIL, "frictionCoefficient": 0.0}
              for side, z in ((1.0, 500.0 * span), (-1.0, 1e3 * span))]
    return {**wire.piece(start, start + length, _ELEMENTS), "obstacles": anvils, "contactDistance": gap,
            "proximalEnd": "held", "drive": "displace", "displacementDirection": [0, 1, 0],
            "displacementPerStep": 2e3 * _DEFLECTION * span / _STEPS, "massDamping": 10.0, "timeStep": _STEP,
            "maxSimulationSteps": _STEPS, "logContacts": True, "logEvery": _STEPS}


def read_three_point(folder: Path) -> Bending:
    """Return the bending test of a run."""
    require_end(folder)
    columns = read_columns(folder, ("positions", "contactForces"))
    nodes = columns["positions"][-1][:, 1:] * 1e-3
    across = columns["contactForces"][-1][:, 1]
    shape = CubicSpline(nodes[:, 1], nodes[:, 0])
    contacts = []
    for side in (-1.0, 1.0):
        loads = [(nodes[node, 1], force) for node, force in enumerate(across.tolist()) if side * force > 0.0]
        total = sum(force for _, force in loads)
        contacts.append((sum(z * force for z, force in loads) / total, abs(total)))
    (middle, force), (support, _) = contacts
    first = nodes[0, 1]
    chord = nodes[0, 0] + (shape(support) - nodes[0, 0]) * (middle - first) / (support - first)
    return Bending(force, float(chord - shape(middle)), (middle - first, support - middle))


def torque(wire: Wire) -> dict[str, Any]:
    """Parameters of a torque test of a piece of the shaft: one end held, the other turned, both on the axis."""
    length = min(0.1, wire.shaft)
    return {**wire.piece(0.0, length, 20), "proximalEnd": "clamped", "distalEnd": "sliding", "distalRotation": _TWIST,
            "initialState": "equilibrium", "maxSimulationSteps": 0, "logStrains": True}


def read_torque(folder: Path) -> float:
    """Return GJ of a torque test: torque times length over rotation, N m^2."""
    run = require_end(folder)
    moment = run.measured("solver")["distalMoment"][2]
    return abs(moment) * 1e-3 * run.number("guidewireLength") / _TWIST


def tip_load(wire: Wire, gauge: float, force: float) -> dict[str, Any]:
    """Parameters of a tip that is clamped gauge (m) from its end and loaded across by a force (N) at its end."""
    elements = max(40, math.ceil(gauge * np.abs(wire.curvature).max() / 0.1))
    return {**wire.piece(wire.length - gauge, wire.length, elements), "proximalEnd": "clamped",
            "initialState": "equilibrium", "tipForce": [0.0, force, 0.0], "maxSimulationSteps": 0}


def read_tip(folder: Path) -> np.ndarray:
    """Read where the tip stands, (y, z) in m."""
    require_end(folder)
    return read_columns(folder, ("positions",))["positions"][-1, -1, 1:] * 1e-3


def require_end(folder: Path) -> Run:
    """Return the run of a folder; raises LogError where it has not ended well: nothing is read from such a run."""
    run = read_run(folder)
    if run.outcome not in ("finished", "converged") or not run.is_reliable:
        reason = run.summary["reason"] if isinstance(run.summary, Mapping) else ""
        reliability = "" if run.is_reliable else ", not reliable"
        raise LogError(f"{folder}: the bench test is {run.outcome}{reliability}: {reason}")
    return run
