"""Data of a run for the page: numbers by frame, and walls; from a run's folder, or from a session in progress.

A recording goes to the page as one block of bytes: the length of the header (4 bytes, lowest first), the header (JSON),
then the arrays, lowest byte first. `guidewire/viewer/page/recording.js` reads it.
"""

from __future__ import annotations

import json
import re
import struct
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from guidewire.logs.hub import HubCurve
from guidewire.logs.logs import LogError, read_columns, read_log
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import Surface
from guidewire.logs.walls import given_walls, name_walls, soft_walls
from guidewire.quantities import WIRE, catheter_name
from guidewire.sessions.session import LumenPlace, State
from guidewire.sessions.session_state import snake

_STEPS = 65535  # of a quantised number, from its lowest value to its highest
_ALIGNED = 8
_ROWS = {row.name: row for row in WIRE}
ENERGIES = {"kineticEnergy": "energy of motion", "elasticEnergy": "elastic energy",
             "potentialEnergy": "potential energy"}
CORE = {"coreStrain": "strain of the core", "coreShare": "share of the core beyond its elastic line"}
_HUB = {"hubForce": ("force at the hub", True), "hubTorque": ("torque at the hub", True),
        "hubInsertion": ("insertion", True), "hubTurn": ("rotation of the hub", True),
        "twist": ("twist from hub to tip", True), "largestCurvature": ("largest curvature", False),
        "lengthInBody": ("length in the body", False)}
# What is read off at the hub, by its key in the object "hub" of a log: label, unit, whether it may be negative.
HUB = {_ROWS[name].key: (label, _ROWS[name].unit, is_signed) for name, (label, is_signed) in _HUB.items()}
_OF_CATHETER = ("insertion", "turn", "force", "torque")


@dataclass(frozen=True)
class Channel:
    """Numbers of one kind.

    Attributes
    ----------
    name, label, unit : for the program and for people; what has no label is not offered as a curve.
    place : where they stand: "frame" (one a frame), "sphere", "element", "vector" (three a sphere or an element).
    values : (frames, width).
    is_signed : whether values below zero mean another direction.
    """

    name: str
    label: str
    unit: str
    place: str
    values: np.ndarray
    is_signed: bool = False


@dataclass(frozen=True)
class Recording:
    """A run as the page takes it.

    Attributes
    ----------
    title, outcome : lines.
    warnings, facts : what a user has to know of it; names and values, for people.
    radius : of the wire, units.
    channels : "time", "step" and "positions" are always among them.
    walls : triangles with "vessel" or "obstacle".
    sheath : (2, 3), units: where it ends, and the farthest back that the wire begins in it; None without one.
    largest : as of `largest_shown`, where more was seen than these frames; None: of these.
    described : as of `Session.describe`; empty where it is not known: then there is no fluoroscopy.
    soft : the numbers of walls that give way.
    """

    title: str
    outcome: str
    warnings: Sequence[str]
    facts: Sequence[tuple[str, str]]
    radius: float
    channels: Sequence[Channel]
    walls: Sequence[tuple[str, Surface]]
    sheath: np.ndarray | None = None
    largest: np.ndarray | None = None
    described: Mapping[str, Any] = field(default_factory=dict)
    soft: Sequence[int] = ()

    def to_bytes(self, exact: bool = True) -> bytes:
        """Return the block for the page; where it need not be exact, of 16 bits a number between the lowest and the
        highest of its kind (time: 32 bits)."""
        arrays = _Arrays()
        largest = largest_shown(self.channels) if self.largest is None else self.largest
        channels = [{
            "name": channel.name, "label": channel.label, "unit": channel.unit, "place": channel.place,
            "isSigned": channel.is_signed, "width": channel.values.shape[1], "largest": float(size),
            **(arrays.add(channel.values, "f8") if exact else
               arrays.add(channel.values, "f4") if channel.place == "frame" else
               arrays.quantise(channel.values, 3 if channel.place == "vector" else 1)),
        } for channel, size in zip(self.channels, largest)]
        walls = [{
            "kind": kind, "isSoft": k in self.soft,
            "vertices": arrays.add(wall.vertices, "f4") if exact else arrays.quantise(wall.vertices, 3),
            "triangles": arrays.add(wall.triangles, "u2" if len(wall.vertices) <= _STEPS else "u4"),
        } for k, (kind, wall) in enumerate(self.walls)]
        header = json.dumps({
            "title": self.title, "outcome": self.outcome, "warnings": list(self.warnings), "facts": list(self.facts),
            "radius": self.radius, "channels": channels, "walls": walls,
            "sheath": None if self.sheath is None else self.sheath.tolist(), "described": self.described or None,
        }, allow_nan=False).encode()
        header += b" " * (-(len(header) + 4) % _ALIGNED)
        return struct.pack("<I", len(header)) + header + arrays.bytes()


def largest_shown(channels: Sequence[Channel]) -> np.ndarray:
    """Largest size of each channel's finite numbers, 0 where there are none: what scales go by. What is in a sheath is
    not shown and does not count."""
    in_body = next((channel.values[:, 0] for channel in channels if channel.name == "inBody"), None)
    return np.array([_largest(channel, in_body) for channel in channels])


def _largest(channel: Channel, in_body: np.ndarray | None) -> float:
    values = np.abs(channel.values)
    seen = np.isfinite(values)
    if in_body is not None and channel.place != "frame":
        per_node = 3 if channel.place == "vector" else 1
        nodes = values.shape[1] // per_node + (1 if channel.place == "element" else 0)
        first = np.maximum(nodes - 1 - in_body, 0)  # the last sphere that is in the sheath
        seen &= np.arange(values.shape[1]) // per_node >= first[:, None]
    return float(values.max(where=seen, initial=0.0))


class _Arrays:
    """Arrays one behind the other, each where its numbers may stand."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._length = 0

    def add(self, values: np.ndarray, kind: str) -> dict[str, Any]:
        part = np.ascontiguousarray(values, dtype="<" + kind).tobytes()
        place = {"type": kind, "offset": self._length, "count": int(np.size(values))}
        part += b"\0" * (-len(part) % _ALIGNED)
        self._parts.append(part)
        self._length += len(part)
        return place

    def quantise(self, values: np.ndarray, width: int) -> dict[str, Any]:
        rows = np.nan_to_num(np.asarray(values, dtype=float)).reshape(-1, width)
        low, high = rows.min(axis=0, initial=np.inf), rows.max(axis=0, initial=-np.inf)
        if len(rows) == 0:
            low, high = np.zeros(width), np.zeros(width)
        span = np.where(high > low, high - low, 1.0)
        return {**self.add(np.rint((rows - low) / span * _STEPS), "u2"), "low": low.tolist(), "high": high.tolist()}

    def bytes(self) -> bytes:
        return b"".join(self._parts)


@dataclass(frozen=True)
class Units:
    """How numbers of a run are named. metres : of a unit, or None with gains."""

    metres: float | None

    @property
    def force(self) -> str:
        """With gains a force has no unit that one can buy a scale for."""
        return "mass unit·unit/s²" if self.metres is None else "N"

    @property
    def bend(self) -> str:
        """Return the unit of curvature, and of twist with "rad" before it."""
        return "/unit" if self.metres is None else "/m"


def units_of(parameters: Mapping[str, Any]) -> Units:
    """Return the units of a run with these effective values."""
    return Units(parameters["metresPerUnit"] if "wireRadius" in parameters else None)


def radius_of(parameters: Mapping[str, Any]) -> float:
    """Return the wire's radius in units: with gains what meets walls, with a material its own."""
    if "wireRadius" in parameters:
        return parameters["wireRadius"] / parameters["metresPerUnit"]
    return parameters["sphereRadius"]


def make_channels(units: Units, numbers: Mapping[str, np.ndarray | None]) -> list[Channel]:
    """Return what can be shown of k frames of a wire of n elements.

    Parameters
    ----------
    units : of the run.
    numbers : "step", "time" (k,), s; "positions" (k, n+1, 3), units; and where they are known "orientations" (k, n, 4),
        x, y, z, w; "positions1" (k, m+1, 3) of the first catheter, and so on, and what was read off at its hub with
        "hub1." before its key; "curvature" (k, n+1, 3), rad/m; "force" (k, n, 3), N; "contact_forces" (k, n+1, 3), and
        of the first catheter "contact_forces1"; "strand_forces" (k, n+1, 3), N; "wall_displacements" (k, n, 3), m, the
        same; "reaction" (k, 3); "couple" (k, n+1, 3), N m; "coreStrain" and "coreShare" (k, n+1); "kineticEnergy",
        "elasticEnergy" and "potentialEnergy" (k,), J; what a log has of the hub, (k,), with "hub." before its key;
        "lumen" (k, 3), as of `lumen_of`; "vessel_phase" (k,), 0 to 1; "inBody" (k,), spheres out of a sheath;
        "step_time" (k,), ms; "real_time" (k,), times faster.
    """
    known = {name: values for name, values in numbers.items() if values is not None}
    positions = known["positions"]
    elements = np.diff(positions, axis=1)
    lengths = np.linalg.norm(elements, axis=2)
    along = elements / np.where(lengths > 0.0, lengths, 1.0)[..., None]
    per_unit = 1.0 if units.metres is None else 1.0 / units.metres
    channels = [
        Channel("time", "", "s", "frame", known["time"]), Channel("step", "", "", "frame", known["step"]),
        Channel("positions", "", "units", "vector", _flat(positions)),
        *(Channel(name, "", "units", "vector", _flat(known[name])) for name in known
          if re.fullmatch(r"positions\d+", name)),
    ]
    if "curvature" in known:
        bend = np.hypot(known["curvature"][..., 0], known["curvature"][..., 1])
    else:
        bend = per_unit * _bend(along, lengths)
    channels.append(Channel("curvature", "curvature", f"rad{units.bend}", "sphere", bend))
    if "curvature" in known or "orientations" in known:
        twist = (known["curvature"][..., 2] if "curvature" in known
                 else per_unit * _twist(known["orientations"], lengths))
        channels.append(Channel("twist", "twist", f"rad{units.bend}", "sphere", twist, True))
    for name, label in CORE.items():
        if name in known:
            channels.append(Channel(name, label, "1", "sphere", known[name].reshape(len(positions), -1)))
    if "force" in known:
        axial = np.einsum("kij,kij->ki", known["force"], along)
        channels.append(Channel("axialForce", "axial force", "N", "element", axial, True))
    if "contact_forces" in known:
        forces = known["contact_forces"]
        of_catheters = {name[14:]: known[name] for name in known if re.fullmatch(r"contact_forces\d+", name)}
        channels += [
            Channel("contactForces", "", units.force, "vector", _flat(forces)),
            Channel("contactForce", "contact force", units.force, "sphere", np.linalg.norm(forces, axis=2)),
            *(Channel(f"contactForces{k}", "", units.force, "vector", _flat(own)) for k, own in of_catheters.items()),
            Channel("wallForce", "all wall forces added up", units.force, "frame",
                    sum(np.linalg.norm(own, axis=2).sum(axis=1) for own in (forces, *of_catheters.values()))),
        ]
    if "strand_forces" in known:
        channels.append(Channel("strandForce", "force between strands", units.force, "sphere",
                                np.linalg.norm(known["strand_forces"], axis=2)))
    channels += [Channel(name.replace("wall_d", "wallD"), "", "units", "vector", _flat(per_unit * known[name]))
                 for name in known if name.startswith("wall_displacements")]
    if "vessel_phase" in known:
        channels.append(Channel("vesselPhase", "phase of the vessel's cycle", "1", "frame", known["vessel_phase"]))
    if "vessel_centreline" in known:
        channels.append(Channel("vesselCentreline", "", "units", "vector", _flat(known["vessel_centreline"])))
    if "lumen" in known:
        channels.append(Channel("lumen", "", "", "frame", known["lumen"]))
    channels += _at_the_hub(known, units, along)
    energies = {key: known[key] for key in ENERGIES if key in known}
    if energies:
        channels.append(Channel("energy", "energy", "J", "frame", np.sum(list(energies.values()), axis=0)))
    channels += [Channel(key, ENERGIES[key], "J", "frame", values) for key, values in energies.items()]
    if "inBody" in known:
        channels.append(Channel("inBody", "", "spheres", "frame", known["inBody"]))
    channels += [Channel(f"tip{axis}", f"tip, {axis}", "units", "frame", positions[:, -1, k], True)
                 for k, axis in enumerate("xyz")]
    for name, key, label, unit in (("stepTime", "step_time", "wall time of a step", "ms"),
                                   ("realTime", "real_time", "times faster than real time", "1")):
        if key in known:
            channels.append(Channel(name, label, unit, "frame", known[key]))
    return [_two_dimensional(channel) for channel in channels]


def _at_the_hub(known: Mapping[str, np.ndarray], units: Units, along: np.ndarray) -> list[Channel]:
    """As it was read off; else force and couple of the support, as far as they are known."""
    channels = [Channel("hub" + key[0].upper() + key[1:], label, unit, "frame", known[f"hub.{key}"], is_signed)
                for key, (label, unit, is_signed) in HUB.items() if f"hub.{key}" in known]
    for name in known:
        of_catheter = re.fullmatch(r"hub(\d+)\.(\w+)", name)
        if of_catheter and of_catheter[2] in HUB:
            label, unit, is_signed = HUB[of_catheter[2]]
            channels.append(Channel(f"hub{of_catheter[1]}{of_catheter[2][0].upper()}{of_catheter[2][1:]}",
                                    f"{label}, catheter {of_catheter[1]}", unit, "frame", known[name], is_signed))
    names = [channel.name for channel in channels]
    if "hubForce" not in names and "reaction" in known:
        channels.append(Channel("hubForce", "force at the hub", units.force, "frame",
                                np.einsum("kj,kj->k", known["reaction"], along[:, 0]), True))
    if "hubTorque" not in names and "couple" in known:
        channels.append(Channel("hubTorque", "torque at the hub", "N m", "frame",
                                np.einsum("kj,kj->k", known["couple"][:, 0], along[:, 0]), True))
    return channels


def read_off(state: State) -> dict[str, np.ndarray]:
    """Return what a state says of energies and of the hub, by the names of a log."""
    numbers: dict[str, float | None] = {}
    if state.energy is not None:
        energy = state.energy
        numbers |= {"kineticEnergy": energy.kinetic, "elasticEnergy": energy.elastic,
                    "potentialEnergy": energy.potential}
    if state.hub is not None:
        numbers |= {f"hub.{key}": getattr(state.hub, snake(key)) for key in HUB}
        numbers["inBody"] = state.hub.spheres_in_body
    for k, one in enumerate(state.catheters):
        numbers |= {f"hub{k + 1}.{name}": getattr(one, name) for name in _OF_CATHETER}
    return {name: np.array([value]) for name, value in numbers.items() if value is not None}


def sheath_of(parameters: Mapping[str, Any], numbers: Mapping[str, np.ndarray | None]) -> np.ndarray | None:
    """Say where a run's sheath is, as in `Recording`.

    Parameters
    ----------
    parameters : effective values.
    numbers : as of `make_channels`; the first frame is of the start, where the wire is straight.
    """
    if parameters.get("sheath") is None:
        return None
    positions = numbers["positions"]
    start, tip = positions[0, 0], positions[0, -1]
    direction = (positions[0, 1] - start) / np.linalg.norm(positions[0, 1] - start)
    exit_at = parameters["sheath"].get("exit")
    if exit_at is None and numbers.get("hub.lengthInBody") is not None:
        exit_at = tip - direction * numbers["hub.lengthInBody"][0] / parameters["metresPerUnit"]
    elif exit_at is None:
        exit_at = positions[0, -1 - int(numbers["inBody"][0])]
    exit_at = np.asarray(exit_at, dtype=float)
    back = min(0.0, *((positions[:, 0] - exit_at) @ direction))
    return np.array([exit_at, exit_at + back * direction])


def _two_dimensional(channel: Channel) -> Channel:
    values = np.asarray(channel.values, dtype=float)
    if values.ndim == 2:
        return channel
    return Channel(channel.name, channel.label, channel.unit, channel.place, values[:, None], channel.is_signed)


def _flat(vectors: np.ndarray) -> np.ndarray:
    return vectors.reshape(len(vectors), -1)


def _bend(along: np.ndarray, lengths: np.ndarray) -> np.ndarray:
    """Angle between neighbouring elements over their mean length, (k, n+1); 0 at the ends."""
    cosine = np.clip(np.einsum("kij,kij->ki", along[:, :-1], along[:, 1:]), -1.0, 1.0)
    means = 0.5 * (lengths[:, :-1] + lengths[:, 1:])
    return np.pad(np.arccos(cosine) / np.where(means > 0.0, means, 1.0), ((0, 0), (1, 1)))


def _twist(orientations: np.ndarray, lengths: np.ndarray) -> np.ndarray:
    """Turn about the wire between neighbouring elements over their mean length, (k, n+1); 0 at the ends."""
    a, b = orientations[:, :-1], orientations[:, 1:]
    w = np.einsum("kij,kij->ki", a, b)
    z = a[..., 3] * b[..., 2] - a[..., 2] * b[..., 3] - (a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])
    turn = 2.0 * np.arctan2(np.where(w < 0.0, -z, z), np.abs(w))
    means = 0.5 * (lengths[:, :-1] + lengths[:, 1:])
    return np.pad(turn / np.where(means > 0.0, means, 1.0), ((0, 0), (1, 1)))


def read_recording(run: Run, walls: Sequence[Surface], frames: int, described: Mapping[str, Any],
                   places: Callable[[np.ndarray], Sequence[LumenPlace]], curve: HubCurve | None = None) -> Recording:
    """Return a run from its folder.

    Parameters
    ----------
    run : the run.
    walls : the vessel first, where the run has one, and the obstacles.
    frames : how many at most; of more entries they are taken at even distances, the first and the last among them.
    described : as of `Session.describe`.
    places : as `Session.places`; empty where that is not known.
    curve : the run with others that tell how sure its forces at the hub are; None: there are none.

    Raises
    ------
    LogError : the log cannot be read, or does not have every sphere.
    """
    log = read_log(run.folder, "all")
    if len(log.spheres) < 2:
        raise LogError(f"{log.source}: holds one sphere only; the page needs a run with logSpheres = \"all\"")
    finite = np.flatnonzero(np.isfinite(log.positions).all(axis=(1, 2)))
    if len(finite) == 0:
        raise LogError(f"{log.source}: holds no finite position")
    kept = finite[np.unique(np.linspace(0, len(finite) - 1, frames).round().astype(int))]
    numbers: dict[str, np.ndarray | None] = {
        "step": log.steps[kept], "time": log.time[kept], "positions": log.positions[kept],
        **{f"positions{k + 1}": positions[kept] for k, positions in enumerate(log.catheters)},
        **_wall_times(log.steps, log.elapsed, log.time, kept),
    }
    numbers["lumen"] = lumen_of(places(log.positions[kept]))
    if (any(run.parameters.get(key) for key in ("logOrientations", "logContacts", "logStrains", "logHub"))
            or run.parameters.get("sheath") is not None or any(described.get("motions", ()))
            or given_walls(run.parameters)):
        numbers.update(_read_more(run, log.steps[kept], len(log.catheters)))
    warnings = [line for line in (log.warning,) if line] + list((run.summary or {}).get("warnings", []))
    if len(finite) < len(log.steps):
        warnings.append(f"{len(log.steps) - len(finite)} entries with positions that are not finite are left out")
    summary = run.summary or {}
    return Recording(
        run.folder.resolve().name, ending_of(run.outcome, summary.get("reliable"), summary.get("reason", "")), warnings,
        facts_of(run.parameters, run.summary), radius_of(run.parameters),
        [*make_channels(units_of(run.parameters), numbers), *_bands(curve, log.time[kept])],
        name_walls(run.parameters, walls),
        sheath_of(run.parameters, numbers), described=described, soft=soft_walls(run.parameters),
    )


def _bands(curve: HubCurve | None, times: np.ndarray) -> list[Channel]:
    """Lowest and highest force and torque at the hub at these times, (k, 2)."""
    return [] if curve is None else [
        Channel(f"hub{name.title()}Band", "", unit, "frame", np.stack(
            [np.interp(times, curve.log.time, side) for side in curve.band(name)], axis=1))
        for name, unit in (("force", "N"), ("torque", "N m"))]


def ending_of(outcome: str | None, reliable: bool | None, reason: str) -> str:
    """Return how a run ended, in one line; empty where it goes on. Runs of older versions do not say whether they are
    reliable."""
    words = [outcome or "", *([] if reliable is None else ["reliable" if reliable else "not reliable"])]
    return ", ".join(words) + (f": {reason}" if reason else "") if outcome else ""


def lumen_of(places: Sequence[LumenPlace | None]) -> np.ndarray | None:
    """(k, 3) of k states: units to the target along the vessel (not a number without one), whether it is reached, and
    whether the wire is in the vessel; None where that is not known."""
    known = [place for place in places if place is not None]
    if not places or len(known) < len(places):
        return None
    return np.array([[place.left, float(place.is_at_target), float(place.is_inside)] for place in known])


def facts_of(parameters: Mapping[str, Any], summary: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """Return what is shown of a run beside its picture."""
    facts = [("method", parameters.get("solver", "")), ("elements", str(parameters.get("numberRodElements", ""))),
             ("time step", f"{parameters.get('timeStep')} s")]
    if summary:
        median = summary.get("medianStepTime") or 0.0
        facts.append(("step time", f"{median:.4g} ms, median"))
        if median > 0.0:
            facts.append(("against real time", f"{1e3 * parameters['timeStep'] / median:.3g} times faster"))
    return facts


def _wall_times(steps: np.ndarray, elapsed: np.ndarray, time: np.ndarray, kept: np.ndarray) -> dict[str, np.ndarray]:
    """Wall time of a step between entries, logging included, and what it is against real time."""
    if len(steps) < 2:
        return {}
    wall = np.diff(elapsed) / np.diff(steps)
    wall = np.concatenate([wall[:1], wall])
    rate = np.diff(time) / np.maximum(np.diff(elapsed), 1e-9)
    return {"step_time": 1e3 * wall[kept], "real_time": np.concatenate([rate[:1], rate])[kept]}


def _read_more(run: Run, steps: np.ndarray, catheters: int) -> dict[str, np.ndarray | None]:
    """Return what entries of a log hold beside positions, for the steps that are shown."""
    shown = {"contactForces": "contact_forces", "wallDisplacements": "wall_displacements"}    # also of catheters
    names = {name: shown.get(name, name) for name in (
        "orientations", "reaction", "curvature", "force", "couple", "inBody", *ENERGIES, *CORE, *shown)}
    names |= {"strandForces": "strand_forces", "vesselPhase": "vessel_phase",
              "vesselCentreline": "vessel_centreline"}
    names |= {name: f"hub.{_ROWS[name].key}" for name in _HUB}
    for number in range(catheters):
        names |= {catheter_name(name, number): f"{to}{number + 1}" for name, to in shown.items()}
        names |= {catheter_name(name, number): f"hub{number + 1}.{name}" for name in _OF_CATHETER}
    return {names[name]: np.asarray(values, dtype=float)
            for name, values in read_columns(run.folder, names, steps).items()}
