"""Output for a vessel: the mesh, its ends and centreline, a scene with a wire at an inlet, the report."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from guidewire.anatomy.centreline import Centreline, End
from guidewire.anatomy.inspection import Inspection, Unit
from guidewire.anatomy.loops import Neck, count_loops
from guidewire.anatomy.lumens import write_obj
from guidewire.anatomy.mesh import AnatomyError, Mesh, close_rims, signed_volume
from guidewire.anatomy.patient import Axes
from guidewire.anatomy.reading import Source
from guidewire.anatomy.repair import Repaired
from guidewire.runs.whole_files import write_whole

MESH, ANATOMY, SCENE, REPORT, PICTURE = "vessel.obj", "anatomy.json", "scene.json", "report.md", "picture.png"
TAKEN, MOTION = "voxels.png", "motion.csv"
_HEART_RATE = 60.0  # per minute, where nobody says it
_SPEED, _TIME_STEP = 0.02, 0.05  # m/s, s: 1 mm a step
_TIP, _BODY = 30.0, 5.0  # mm: length of the soft tip, with elements of 1 mm; length of the other elements
_FLEXIBLE = 2.5  # mm: length of the elements of a longer flexible section
_OVER, _TIGHT, _NARROW = 20.0, 75.0, 5.0  # mm, degrees, mm: a lumen of less radius that turns more over that length
_AHEAD, _BEHIND = 30.0, 60.0  # mm: of a wire's tip ahead of a catheter's, and of its hub behind the catheter's
_LONGEST = 300.0  # mm of flexible wire, the tip included
_HUB_FORCE = 5.0  # N, at which a grip slides along the wire
_CONTACT_DISTANCE = 2.5e-5  # m: with a quarter of it a tip 300 mm in moves by less than 0.2 mm
_CLEARANCE = 3.0  # radius of a lumen over the wire's, from which on an end may be a target by default
_ALIKE = 0.95  # of the longest path, from which on a path is as long: the widest of these leads to the default target
_SLIVER = 0.5  # of the median radius of its branch: a narrower end is no target by default
_PLACES = 10  # of a kind that a report lists
_COMPARED = 0.01  # of a volume: a smaller one before is that of a surface that did not enclose the lumen
_BENT = 0.25  # of a rim's radius, by which it is out of a plane


def write_vessel(folder: Path, mesh: Mesh, line: Centreline, unit: Unit, source: Source) -> None:
    """The mesh and the file of its ends and centreline, both in the mesh's own units."""
    folder.mkdir(parents=True, exist_ok=True)
    digits = max(0, 7 - math.floor(math.log10(mesh.diagonal)))
    write_obj(folder / MESH, mesh.vertices, mesh.triangles, digits)
    ends = [{"number": end.number, "name": end.name, "centre": _numbers(end.centre, digits),
             "radius": round(max(end.radius, 10.0**-digits), digits), "direction": _numbers(end.direction, 6),
             "open": end.is_open, "point": end.point} for end in line.ends]
    # At the wall of a closed end the sphere has no radius; none is rounded to 0.
    points = np.column_stack([line.points, np.maximum(line.radii, 10.0**-digits)])
    axes = source.axes
    write_whole(folder / ANATOMY, json.dumps({
        "source": source.name, "sourceHash": source.sha256, "unit": unit.name, "metresPerUnit": unit.metres,
        "patientAxes": axes.of_vessel(), "sourceAxes": axes.letters,
        "toSource": (axes.to_lps.T * (1e-3 / unit.metres)).tolist(), "mesh": MESH, "ends": ends,
        "centreline": {"points": [_numbers(row, digits) for row in points], "parents": line.parents.tolist(),
                       "branches": line.branches.tolist(),
                       "links": [list(loop.points) for loop in line.loops],
                       "names": [f"branch {k}" for k in range(1, int(line.branches.max()) + 1)]}}) + "\n")


def check_source(folder: Path, source: Source) -> None:
    """Raises AnatomyError where a folder holds the vessel of another file, or of one whose contents have changed."""
    try:
        before = json.loads((folder / ANATOMY).read_text(encoding="utf-8"))
        name, known = str(before["source"]), before.get("sourceHash", source.sha256)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return
    if (name, known) != (source.name, source.sha256):
        other = f"another {name}" if name == source.name else name
        raise AnatomyError(f"{folder} holds the vessel of {other}: --force replaces it, --out takes another folder")


def find_inlet(line: Centreline, asked: str | None, begin: np.ndarray | None = None) -> End:
    """Return the end with a number or a name, or else that at which the file's lines begin, or else the widest one.

    Raises
    ------
    AnatomyError : there is none, or it is the dome of a sac.
    """
    inlet = (find_end(line, asked) if asked is not None else line.ends[0] if begin is None
             else min(line.ends, key=lambda end: float(np.linalg.norm(end.centre - begin))))
    if inlet.is_sac:
        raise AnatomyError(f"end {inlet.number} '{inlet.name}' is the dome of a sac: no wire enters there, unless "
                           f"--open {inlet.number} opens it")
    return inlet


def find_end(line: Centreline, asked: str) -> End:
    """Return the end with a number or a name.

    Raises
    ------
    AnatomyError : there is none; the line lists them.
    """
    for end in line.ends:
        if asked.strip().lower() in (str(end.number), end.name.lower()):
            return end
    names = ", ".join(f"{end.number} '{end.name}'" for end in line.ends[:12])
    raise AnatomyError(f"there is no end '{asked}': there are {names}{', ..' if len(line.ends) > 12 else ''}")


def default_target(line: Centreline, inlet: End, unit: Unit, diameter: float) -> End:
    """Return the end with the longest path from an inlet, of those that a wire of a diameter in mm comes to; of all
    ends where it comes to none. Of paths within a twentieth of the longest that whose narrowest place is the widest:
    where two branches leave side by side, a wire goes into the wider one. A sliver, much narrower than the branch that
    ends there, is no target."""
    inner, least = line.inner(), _CLEARANCE * 0.5e-3 * diameter / unit.metres
    others = ([end for end in line.ends if end is not inlet and not end.is_sac]
              or [end for end in line.ends if end is not inlet] or line.ends)
    paths = {end.number: line.path(inlet.point, end.point) for end in others}
    lengths = {number: line.length(path) for number, path in paths.items()}
    narrowest = {number: float(line.radii[path][inner[path]].min(initial=np.inf)) for number, path in paths.items()}
    own = {end.number: float(np.median(line.radii[line.branches == line.branches[end.point]])) for end in others}
    others = [end for end in others if end.radius > _SLIVER * own[end.number]] or others
    wide = [end for end in others if end.radius > least and narrowest[end.number] > least] or others
    longest = max(lengths[end.number] for end in wide)
    return max((end for end in wide if lengths[end.number] >= _ALIKE * longest),
               key=lambda end: (narrowest[end.number], lengths[end.number]))


def scene(line: Centreline, unit: Unit, inlet: End, target: End, diameter: float,
          axes: Axes = Axes(), instrument: str | None = None, catheter: str | None = None,
          motion: str | None = None) -> Mapping[str, Any]:
    """Parameters of a wire that is pushed from an inlet as far as a target; lengths in mm, the vessel's own axes.

    diameter : of the wire, mm.
    axes : of the vessel's file.
    instrument, catheter : names of those that there are, in place of a wire of that diameter, and over it. The
    catheter's
        tip begins 30 mm behind the wire's.
    motion : file of how the vessel moves.
    """
    path = line.path(inlet.point, target.point)
    way = 1e3 * unit.metres * line.length(path)
    flexible = _flexible_length(1e3 * unit.metres * line.points[path], 1e3 * unit.metres * line.radii[path])
    body = _BODY * math.ceil((1.15 * way + 60.0) / _BODY) - flexible
    length = body + flexible + _TIP
    soft = {"youngsModulus": 6e9, "shearModulus": 2.3e9}
    sections: list[dict[str, Any]] = [{"from": length - _TIP, "to": length, "numberRodElements": round(_TIP), **soft,
                                       "restCurvature": [-26.18, 0.0, 0.0]}]
    if flexible:
        sections.insert(0, {"from": body, "to": length - _TIP, "numberRodElements": round(flexible / _FLEXIBLE),
                            **soft})
    over: dict[str, Any] = {}
    if catheter:
        # The wire's hub is so far behind the catheter's, and its tip ahead.
        length = _BODY * math.ceil((length + _AHEAD + _BEHIND) / _BODY)
        count = round((length - _AHEAD - _BEHIND) / _BODY)
        over = {"catheters": [{"instrument": catheter, "start": _BEHIND, "length": _BODY * count, "elements": count,
                               "insertionSpeed": _SPEED}]}
    wire = {"instrument": instrument, "guidewireLength": length, "numberRodElements": round(length / _BODY)} if (
        instrument) else {
        "guidewireLength": length, "numberRodElements": round(body / _BODY), "wireRadius": 0.5e-3 * diameter,
        "youngsModulus": 60e9, "shearModulus": 23e9, "density": 6450.0, "wireSections": sections}
    return {
        "solver": "direct", **wire, **over,
        "massDamping": 20.0, "proximalEnd": "clamped", "drive": "displace", "insertionSpeed": _SPEED,
        "hubForceLimit": _HUB_FORCE,
        "vessel": {"shape": "mesh", "file": MESH, "metresPerUnit": unit.metres, "anatomy": ANATOMY,
                   **({"motion": {"heartRate": _HEART_RATE, "centreline": motion}} if motion else {})},
        **({"patientAxes": axes.of_vessel()} if axes.is_known else {}),
        "sheath": {}, "inlet": inlet.number, "target": target.number, "contactDistance": _CONTACT_DISTANCE,
        "timeStep": _TIME_STEP, "deltaThreshold": 0.0,
        "maxSimulationSteps": math.ceil(way / (1e3 * _SPEED * _TIME_STEP)), "logEvery": 2, "logHub": True,
    }


def _flexible_length(points: np.ndarray, radii: np.ndarray) -> float:
    """Return the length of the wire behind its tip that has to be as flexible as the tip, mm, a multiple of the body's
    elements: from the first narrow and tight bend of a path on, as a carotid siphon is. Points and radii in mm, from
    the inlet."""
    arc = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    at = np.arange(0.0, arc[-1], 1.0)
    fine = np.stack([np.interp(at, arc, points[:, k]) for k in range(3)], axis=1)
    half = round(0.5 * _OVER)
    if len(fine) <= 2 * half + 2:
        return 0.0
    tangents = fine[2:] - fine[:-2]
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1), 1e-300)[:, None]
    turned = np.degrees(np.arccos(np.clip(np.einsum("ij,ij->i", tangents[2 * half:], tangents[:-2 * half]), -1.0, 1.0)))
    middle = at[half + 1:half + 1 + len(turned)]
    is_tight = (turned > _TIGHT) & (np.interp(middle, arc, radii) < _NARROW) & (middle > arc[-1] - _LONGEST + _TIP)
    if not is_tight.any():
        return 0.0
    return _BODY * math.ceil((arc[-1] - middle[is_tight.argmax()]) / _BODY)


def write_scene(folder: Path, parameters: Mapping[str, Any]) -> None:
    """The parameter file beside a vessel."""
    write_whole(folder / SCENE, json.dumps(parameters, indent=2) + "\n")


def describe(found: Inspection, repaired: Repaired | None, line: Centreline | None, diameter: float) -> list[str]:
    """Return the report: one line a finding."""
    mm = 1e3 * found.unit.metres
    lines = [f"{found.triangles} triangles, {found.vertices} vertices",
             f"orientation: normals {'outward' if found.volume > 0.0 else 'into the lumen'}, volume "
             f"{abs(found.volume) * mm**3 / 1e3:.4g} ml"]
    lines += [f"{rim.name}: {'hole in the side' if rim.is_hole else 'end'} at {_place(rim.centre)}, radius "
              f"{mm * rim.radius:.3g} mm, normal {_place(rim.normal)}" for rim in found.rims]
    if len(found.body_sizes) > 1:
        lines.append(f"{len(found.body_sizes)} bodies, of " + ", ".join(
            f"{count} triangles around {_place(place)}" for count, place in
            zip(found.body_sizes[:_PLACES], found.body_centres)))
    if found.near_vertices:
        lines.append(f"{found.near_vertices} vertices nearer than {found.weld_length:.3g} {found.unit.name} to another "
                     "one")
    for name, places in (("triangles without area, or duplicates", found.slivers),
                         ("edges of more than two triangles", found.crowded),
                         ("edges whose triangles are oriented inconsistently", found.turned),
                         ("self-intersections", found.crossings)):
        if len(places):
            listed = ", ".join(_place(place) for place in places[:_PLACES])
            lines.append(f"{len(places)} {name}: {listed}{', ..' if len(places) > _PLACES else ''}")
    if found.has_double_wall:
        lines.append(f"double wall: of rays out of the surface {found.double_wall:.0%} meet it again, so the lumen is "
                     "outside of the surface")
    lines += found.notes
    if repaired is not None:
        lines += [f"done: {change.name}: {change.count}" + (f", wall moved by {mm * change.moved:.2g} mm at most"
                                                             if change.moved else "")
                  + (f", the first at {_place(change.place)}" if change.place is not None else "")
                  for change in repaired.changes]
        closed = abs(signed_volume(repaired.mesh, repaired.rims)) * mm**3
        before = abs(found.volume) * mm**3
        change = f" ({closed / before - 1.0:+.1%} of that before)" if before > _COMPARED * closed else ""
        lines.append(f"wall moved by {mm * repaired.moved:.2g} mm at most; {len(repaired.mesh.triangles)} triangles, "
                     f"volume {closed / 1e3:.4g} ml{change}")
    if line is not None:
        lines += [f"end {end.number} '{end.name}': {'open' if end.is_open else 'closed'}, at {_place(end.centre)}, "
                  f"radius {mm * end.radius:.3g} mm" + (", the dome of a sac: no inlet" if end.is_sac else "")
                  for end in line.ends]
        lines += [f"loop: two ways through the vessel meet at {_place(loop.place)}, where the lumen's radius is about "
                  f"{mm * loop.radius:.2g} mm, or two vessels touch there; paths and targets take the shorter way"
                  for loop in line.loops]
        lines += [neck_line(neck, mm) for neck in line.necks]
        missing = count_loops(close_rims(repaired.mesh, repaired.rims)) - len(line.loops) if repaired else 0
        if missing > 0:
            lines.append(f"{missing} small handle{'s' if missing > 1 else ''} of the wall whose ways do not part: the "
                         "centreline passes them on one side")
        lines += [f"the rim of '{name}' is out of a plane by {mm * off:.2g} mm: a wire may find no straight start "
                  "there; another end, or a sheath.exit farther inside, may do"
                  for name, off in _bent_rims(repaired).items()] if repaired is not None else []
        least = line.narrowest
        lines.append(f"narrowest place: radius {mm * line.radii[least]:.3g} mm at {_place(line.points[least])}, in "
                     f"branch {line.branches[least]}")
        narrow = sorted({int(b) for b in line.branches[(2.0 * mm * line.radii < diameter) & line.inner()]})
        lines.append(f"a wire of {diameter:g} mm " + ("passes everywhere" if not narrow else
                     f"does not pass all of branch {', '.join(map(str, narrow))}"))
    return lines


def neck_line(neck: Neck, mm: float) -> str:
    """Return a line on where two vessels may touch; mm : the file's unit."""
    return (f"two vessels may touch at {_place(neck.place)}, where the way between them has a radius of "
            f"{mm * neck.radius:.2g} mm")


def _bent_rims(repaired: Repaired) -> dict[str, float]:
    """Say by name how far rims are out of their planes, in the file's units, where that is a quarter of their
    radius."""
    off = {rim.name: float(np.abs((repaired.mesh.vertices[rim.vertices] - rim.centre) @ rim.normal).max())
           for rim in repaired.rims}
    return {rim.name: off[rim.name] for rim in repaired.rims if off[rim.name] > _BENT * rim.radius}


def _place(point: np.ndarray) -> str:
    return "[" + ", ".join(f"{number:.5g}" for number in point) + "]"


def _numbers(values: np.ndarray, digits: int) -> list[float]:
    return [round(float(value), digits) for value in values]
