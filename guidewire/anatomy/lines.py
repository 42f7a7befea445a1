"""Centrelines with radii from tables, 3D Slicer's curves and VTK's lines; several of them as the tree that they are."""

from __future__ import annotations

import csv
import json
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from guidewire.anatomy.mesh import FARTHEST, AnatomyError, Mesh
from guidewire.anatomy.patient import Axes, axes_named
from guidewire.anatomy.tubes import Tube, mesh_of_tubes

_LEAP = 5.0  # median steps, farther than both radii together reach: two points so far apart are not neighbours
_CORE = 0.3  # of a radius: a line so near another one is the same there
_CARINA = 0.12  # radius of curvature of edges between branches, of the widest branch's radius

# By heading, in small letters: which column it is, and where positive numbers point. Spaces and units in brackets do
# not count.
_PLACES = {
    "x": (0, ""), "y": (1, ""), "z": (2, ""),
    "points:0": (0, ""), "points:1": (1, ""), "points:2": (2, ""),    # ParaView
    "points_0": (0, ""), "points_1": (1, ""), "points_2": (2, ""),
    "a": (1, "A"), "s": (2, "S"), "l": (0, "L"), "p": (1, "P"),    # 3D Slicer; r is R beside a and s
}
_RADII = {"radius": 1.0, "maximuminscribedsphereradius": 1.0, "inscribedsphereradius": 1.0, "misr": 1.0, "radii": 1.0,
          "r": 1.0, "diameter": 0.5, "diameter(mis)": 0.5}
_KNOWN = ("x, y, z or Points:0, Points:1, Points:2 or R, A, S or L, P, S, and Radius, MaximumInscribedSphereRadius, "
          "MISR or Diameter")


@dataclass(frozen=True)
class Line:
    """points : ndarray (k, 3); radii : ndarray (k,)."""

    points: np.ndarray
    radii: np.ndarray


@dataclass(frozen=True)
class Lines:
    """lines : of one vessel, in the file's axes; unit : its name where the file says it, else empty; axes : of the
    file."""

    lines: list[Line]
    unit: str = ""
    axes: Axes = Axes()


def read_lines(file: Path, kind: str) -> Lines:
    """Return the centreline of a .csv or a .mrk.json.

    Raises
    ------
    AnatomyError : one line that says what is wrong with the file.
    """
    found = _read_csv(file) if kind == ".csv" else _read_markups(file)
    return Lines([_checked(file, line) for line in found.lines], found.unit, found.axes)


def lines_of_poly_data(file: Path, data) -> Lines | None:
    """Return the centrelines of vtkPolyData that has lines with a radius at each point and no triangles, else None.
    Lines that share points, as those of a network do, are cut and joined to one from fork to fork."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if data.GetNumberOfPolys() or data.GetNumberOfStrips() or not data.GetNumberOfLines():
        return None
    at_points = data.GetPointData()
    names = {"".join(name.lower().split()): name for name in (
        at_points.GetArrayName(k) or "" for k in range(at_points.GetNumberOfArrays()))}
    known = [name for name in _RADII if name in names] or [name for name in names if "radius" in name]
    if not known:
        raise AnatomyError(f"{file}: lines without a radius: an array named Radius, MaximumInscribedSphereRadius, MISR "
                           "or Diameter at the points is needed")
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    radii = _RADII.get(known[0], 1.0) * vtk_to_numpy(at_points.GetArray(names[known[0]])).astype(float)
    if radii.ndim > 1:
        raise AnatomyError(f"{file}: {names[known[0]]} has {radii.shape[1]} numbers at a point: a radius is one")
    cells = data.GetLines()
    borders, index = (vtk_to_numpy(one) for one in (cells.GetOffsetsArray(), cells.GetConnectivityArray()))
    of_lines = _chains([index[a:b].tolist() for a, b in zip(borders[:-1], borders[1:])])
    return Lines([_checked(file, Line(points[own], radii[own]), f"line {k}, " if len(of_lines) > 1 else "")
                  for k, own in enumerate(of_lines, 1)])


def _chains(cells: list[list[int]]) -> list[list[int]]:
    """Return lines of points, cut and joined where several cells share points; as they are where none do."""
    if sum(map(len, cells)) == len(set().union(*cells)):
        return cells
    beside: dict[int, set[int]] = {}
    for a, b in (pair for cell in cells for pair in zip(cell, cell[1:]) if pair[0] != pair[1]):
        beside.setdefault(a, set()).add(b)
        beside.setdefault(b, set()).add(a)
    found, done = [], set()
    forks = {node for node, others in beside.items() if len(others) != 2}
    # A ring without a fork begins at its smallest number.
    for first in [*sorted(forks), *sorted(set(beside) - forks)]:
        for after in sorted(beside[first]):
            chain = [first, after]
            while chain[-1] not in forks and chain[-1] != first:
                chain += beside[chain[-1]] - {chain[-2]}
            if first in forks and (chain[-1], chain[-2]) not in done or first not in forks and first not in done:
                found.append(chain)
                done |= {(first, after), *chain}
    return found


def mesh_of_lines(lines: list[Line]) -> tuple[Mesh, str]:
    """Return the wall around centrelines, open where they end; and what was done.

    Raises
    ------
    AnatomyError : a line that does not meet the others.
    """
    tubes, same = tree_of(lines)
    branches = len(tubes)
    done = f"a tube around a centreline of {sum(len(line.points) for line in lines)} points"
    if len(lines) > 1:
        done = (f"{len(lines)} lines joined to a tree of {branches} branches"
                + (f"; {same} lines that others contain" if same else ""))
    return mesh_of_tubes(tubes, _CARINA * max(float(tube.radii.max()) for tube in tubes)), done


def begin_of(lines: list[Line]) -> np.ndarray | None:
    """Return (3,): where all lines begin, as those of VMTK do at their inlet; None where they begin in several
    places."""
    first = np.array([line.points[0] for line in lines])
    apart = np.linalg.norm(first - first[0], axis=1)
    return first[0] if (apart <= [line.radii[0] for line in lines]).all() else None


def tree_of(lines: list[Line]) -> tuple[list[Tube], int]:
    """Lines as branches of one tree, each without what others contain of it, and how many they contain whole.

    A line begins within the lumen of another one, or runs along it first, as those of VMTK do from their inlet.

    Raises
    ------
    AnatomyError : a line that does not meet the others; the line states where it is and how far away.
    """
    left = dict(enumerate(lines))
    first = max(left, key=lambda k: _length(left[k].points))
    tubes, same = [Tube(left[first].points, left[first].radii, -1, (True, True))], 0
    del left[first]
    while left:
        tree = cKDTree(np.concatenate([tube.points for tube in tubes]))
        radii = np.concatenate([tube.radii for tube in tubes])
        owner = np.repeat(np.arange(len(tubes)), [len(tube.points) for tube in tubes])
        gaps = {k: tree.query(line.points) for k, line in left.items()}
        best = min(left, key=lambda k: (gaps[k][0] - radii[gaps[k][1]])[[0, -1]].min())
        away, near = gaps[best]
        line = left.pop(best)
        gap = (away - radii[near])[[0, -1]].min()
        if gap > 0.0:
            place = ", ".join(f"{number:.4g}" for number in line.points[0])
            raise AnatomyError(f"line {best + 1} of {len(lines)}, from [{place}] on, begins {gap:.3g} outside of the "
                               "others: lines of one vessel meet")
        is_core = away < _CORE * radii[near]
        if is_core.all():
            same += 1
            continue
        points, own_radii = line.points, line.radii
        if (away - radii[near])[-1] < (away - radii[near])[0]:
            points, own_radii, near, is_core = points[::-1], own_radii[::-1], near[::-1], is_core[::-1]
        begin = max(int(np.argmin(is_core)) - 1, 0)
        tubes.append(Tube(points[begin:], own_radii[begin:], int(owner[near[begin]]), (False, True)))
    return [_with_open_ends(tube, [other for other in tubes if other is not tube]) for tube in tubes], same


def _with_open_ends(tube: Tube, others: list[Tube]) -> Tube:
    """Return a tube that is open where it ends outside of the others."""
    def is_free(point: np.ndarray) -> bool:
        return all((np.linalg.norm(other.points - point, axis=1) > other.radii).all() for other in others)

    return Tube(tube.points, tube.radii, tube.parent, (is_free(tube.points[0]), is_free(tube.points[-1])))


def _length(points: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _checked(file: Path, line: Line, name: str = "") -> Line:
    """Return the line without points that are there twice.

    Raises
    ------
    AnatomyError : fewer than two places, a number or a radius that is none, or a leap between two points.
    """
    if len(line.points) < 2:
        raise AnatomyError(f"{file}: {name}{len(line.points)} points: a centreline has two or more")
    table = np.column_stack([line.points, line.radii])
    bad = np.flatnonzero(~np.isfinite(table).all(axis=1) | (line.radii <= 0.0))
    if len(bad):
        raise AnatomyError(f"{file}: {name}point {bad[0] + 1}: three numbers and a radius above 0 are needed")
    far = np.flatnonzero(np.abs(table).max(axis=1) > FARTHEST)
    if len(far):
        raise AnatomyError(f"{file}: {name}point {far[0] + 1}: a number is beyond {FARTHEST:g}")
    steps = np.linalg.norm(np.diff(line.points, axis=0), axis=1)
    kept = np.r_[True, steps > 1e-9 * steps.sum()]
    if kept.sum() < 2:
        raise AnatomyError(f"{file}: {name}{len(kept)} points in one place: a centreline has two places or more")
    numbers = np.flatnonzero(kept) + 1
    line = Line(line.points[kept], line.radii[kept])
    steps = np.linalg.norm(np.diff(line.points, axis=0), axis=1)
    reach = np.maximum(_LEAP * np.median(steps), line.radii[1:] + line.radii[:-1])
    leap = int(np.argmax(steps / reach))
    if steps[leap] > reach[leap]:
        raise AnatomyError(f"{file}: {name}from point {numbers[leap]} to {numbers[leap + 1]} it is {steps[leap]:.4g}, "
                           f"{steps[leap] / np.median(steps):.3g} times the median step and beyond the radii there: "
                           "points of a centreline follow each other")
    return line


def _read_csv(file: Path) -> Lines:
    try:
        text = file.read_text(encoding="utf-8-sig").splitlines()
        separator = next((mark for mark in ";\t" if text and mark in text[0]), ",")
        rows = [(number, row) for number, row in enumerate(csv.reader(text, delimiter=separator), 1) if row]
    except (UnicodeDecodeError, csv.Error) as error:
        raise AnatomyError(f"{file}: not a text of x, y, z, radius in columns") from error
    if not rows:
        raise AnatomyError(f"{file}: 0 points: a centreline has two or more")
    columns, factor, axes, unit = list(range(4)), 1.0, Axes(), ""
    has_headings = False
    if any(re.search("[a-df-zA-DF-Z]", word) for word in rows[0][1]):
        columns, factor, axes, unit = _columns(file, rows[0][1])
        rows, has_headings = rows[1:], True
    elif len(rows[0][1]) > 4 and all(_is_number(word) for word in rows[0][1]) and not any(
            re.fullmatch(r"\s*[-+]?\d+,\d+\s*", word) for word in rows[0][1]):
        raise AnatomyError(f"{file}: {len(rows[0][1])} columns without headings: x, y, z, radius are taken by their "
                           f"order, others need headings: {_KNOWN}")
    numbers = []
    for number, row in rows:
        try:
            numbers.append([float(row[k]) for k in columns])
        except (ValueError, IndexError) as error:
            has_commas = any(re.fullmatch(r"\s*[-+]?\d+,\d+\s*", word) for word in row) or (
                len(row) > 4 and not has_headings)
            hint = "; numbers have a decimal point, not a comma" if has_commas else ""
            raise AnatomyError(f"{file}: line {number} is not x, y, z, radius: {separator.join(row)[:60]}"
                               f"{hint}") from error
    table = np.array(numbers).reshape(-1, 4)
    return Lines([Line(table[:, :3], factor * table[:, 3])], unit, axes)


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _columns(file: Path, headings: list[str]) -> tuple[list[int], float, Axes, str]:
    """Find where x, y, z and the radius stand, the factor that makes a radius of it, and the axes and the unit that the
    headings name."""
    parted = [re.fullmatch(r"(.*?)(?:[ _(\[]+(mm|cm|m)[)\]]?)?", word.strip()) for word in headings]
    names = ["".join(found[1].lower().split()) for found in parted]
    places = dict(_PLACES)
    if {"a", "s"} <= set(names):
        places["r"] = (0, "R")
    found: dict[int, tuple[int, str]] = {}
    radius = None
    for k, name in enumerate(names):
        if name in places:
            axis, letter = places[name]
            if axis in found:
                raise AnatomyError(f"{file}: the headings '{headings[found[axis][0]]}' and '{headings[k]}' are "
                                   "the same coordinate")
            found[axis] = (k, letter)
        elif name in _RADII and radius is None:
            radius = (k, _RADII[name])
    missing = [name for axis, name in enumerate("xyz") if axis not in found] + (["radius"] if radius is None else [])
    if missing:
        raise AnatomyError(f"{file}: line 1 has no column {missing[0]}: needed are x, y, z, radius, under one of the "
                           f"headings {_KNOWN}")
    letters = "".join(found[axis][1] for axis in sorted(found))
    if len(letters) not in (0, 3):
        raise AnatomyError(f"{file}: the headings '{', '.join(headings)[:80]}' name axes of the patient and "
                           f"others: known are {_KNOWN}")
    own = [found[0][0], found[1][0], found[2][0], radius[0]]
    units = {parted[k][2] or "" for k in own} - {""}
    if len(units) > 1:
        raise AnatomyError(f"{file}: line 1: x, y, z and radius need to be in one unit")
    return own, radius[1], axes_named(letters) if letters else Axes(), "".join(units)


def _read_markups(file: Path) -> Lines:
    try:
        curves = json.loads(file.read_text(encoding="utf-8"))["markups"]
        read = [_curve(file, curve) for curve in curves]
        systems = {curve.get("coordinateSystem", "LPS").upper() for curve in curves}
        units = {curve.get("coordinateUnits", "") for curve in curves}
    except (ValueError, KeyError, IndexError, TypeError, AttributeError, OverflowError, RecursionError) as error:
        raise AnatomyError(f"{file}: not a curve of 3D Slicer (.mrk.json) with control points and radii") from error
    if len(systems) != 1 or len(units) != 1 or not systems < {"LPS", "RAS"}:
        raise AnatomyError(f"{file}: coordinateSystem {', '.join(sorted(systems))}, coordinateUnits "
                           f"{', '.join(sorted(units))}: one of LPS and RAS, and one unit, are needed")
    return Lines(read, units.pop(), axes_named(systems.pop()))


def _curve(file: Path, curve: dict) -> Line:
    points = np.array([point["position"] for point in curve["controlPoints"]], dtype=float).reshape(-1, 3)
    found = [m for m in curve.get("measurements", []) if m.get("name", "").lower() == "radius"]
    if not found:
        raise AnatomyError(f"{file}: the curve has no measurement Radius")
    radii = np.array(found[0]["controlPointValues"], dtype=float)
    if radii.shape != (len(points),):
        raise AnatomyError(f"{file}: {len(points)} control points and {radii.size} radii: one each is needed")
    return Line(points, radii)
