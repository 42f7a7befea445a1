"""A run's curves as text of USD (.usda), for Omniverse and Blender: BasisCurves with samples over time.

https://openusd.org/release/api/class_usd_geom_basis_curves.html
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from guidewire.export.curves import Curve
from guidewire.export.frame import Frame
from guidewire.runs.whole_files import write_whole

CODES = 24.0  # time codes a second, a film's pictures
_COLOURS = ((0.29, 0.66, 1.0), (1.0, 0.62, 0.18), (0.71, 0.55, 1.0), (0.37, 0.83, 0.55))
_WALL = (0.72, 0.6, 0.58)


@dataclass(frozen=True)
class Wall:
    """places : vertices (v, 3), once or at each moment; triangles (t, 3)."""

    name: str
    places: list[np.ndarray]
    triangles: np.ndarray

    @property
    def moves(self) -> bool:
        """Whether there are several moments of it."""
        return len(self.places) > 1


def write_usd(path: Path, curves: Sequence[Curve], times: np.ndarray, walls: Sequence[Wall], frame: Frame,
              title: str) -> None:
    """Write curves, and walls as meshes.

    Parameters
    ----------
    times : ndarray (k,), s.
    """
    codes = CODES * times
    metres = 1e-3 if frame.unit == "mm" else 1.0
    head = [
        "#usda 1.0", "(", f"    doc = {_text(f'{title}; {frame.describe()}')}", '    defaultPrim = "Run"',
        f"    metersPerUnit = {metres:g}", '    upAxis = "Z"', f"    startTimeCode = {codes[0]:.9g}",
        f"    endTimeCode = {codes[-1]:.9g}", f"    timeCodesPerSecond = {CODES:g}", f"    framesPerSecond = {CODES:g}",
        ")", "", 'def Xform "Run"', "{"]
    body = [line for k, curve in enumerate(curves) for line in _curve(curve, codes, _COLOURS[k % len(_COLOURS)])]
    body += [line for wall in walls for line in _mesh(wall, codes)]
    write_whole(path, "\n".join([*head, *(f"    {line}" for line in body), "}"]) + "\n")


def _curve(curve: Curve, codes: np.ndarray, colour: tuple[float, ...]) -> Iterator[str]:
    is_same = len({len(points) for points in curve.points}) == 1
    radii = curve.radii[:1] if is_same else curve.radii
    yield f'def BasisCurves "{_name(curve.name)}" ('
    yield f"    doc = {_text(curve.title)}"
    yield ")"
    yield "{"
    yield '    uniform token type = "linear"'
    yield '    uniform token wrap = "nonperiodic"'
    counts = [f"[{len(points)}]" for points in curve.points]
    yield from _sampled("int[] curveVertexCounts", counts[:1] if is_same else counts, codes)
    yield from _sampled("point3f[] points", [_rows(points) for points in curve.points], codes)
    yield from _sampled("float[] widths", [_numbers(2.0 * one) for one in radii], codes, ('interpolation = "vertex"',))
    extents = [_extent(points, own) for points, own in zip(curve.points, curve.radii)]
    yield from _sampled("float3[] extent", extents, codes)
    yield f"    color3f[] primvars:displayColor = [({', '.join(f'{part:g}' for part in colour)})]"
    yield "}"


def _mesh(wall: Wall, codes: np.ndarray) -> Iterator[str]:
    yield f'def Mesh "{_name(wall.name)}"'
    yield "{"
    extents = [_rows(np.array([place.min(axis=0), place.max(axis=0)])) for place in wall.places]
    yield from _sampled("float3[] extent", extents, codes)
    yield "    uniform bool doubleSided = 1"
    yield '    uniform token subdivisionScheme = "none"'
    yield f"    int[] faceVertexCounts = [{', '.join(['3'] * len(wall.triangles))}]"
    yield f"    int[] faceVertexIndices = [{', '.join(map(str, wall.triangles.ravel().tolist()))}]"
    yield from _sampled("point3f[] points", [_rows(place) for place in wall.places], codes)
    yield f"    color3f[] primvars:displayColor = [({', '.join(f'{part:g}' for part in _WALL)})]"
    yield "    float[] primvars:displayOpacity = [0.3]"
    yield "}"


def _sampled(what: str, values: Sequence[str], codes: np.ndarray, about: Sequence[str] = ()) -> Iterator[str]:
    """One value, or one a time code; and what is said about it."""
    more = [" (", *(f"        {line}" for line in about), "    )"] if about else [""]
    if len(values) == 1 and len(codes) > 1:
        yield f"    {what} = {values[0]}{more[0]}"
        yield from more[1:]
        return
    if about:    # metadata stand behind a value, of which samples have none
        yield f"    {what} = {values[0]}{more[0]}"
        yield from more[1:]
    yield f"    {what}.timeSamples = {{"
    for code, value in zip(codes, values):
        yield f"        {code:.9g}: {value},"
    yield "    }"


def _extent(points: np.ndarray, radii: np.ndarray) -> str:
    return _rows(np.array([(points - radii[:, None]).min(axis=0), (points + radii[:, None]).max(axis=0)]))


def _rows(points: np.ndarray) -> str:
    return "[" + ", ".join("({:.9g}, {:.9g}, {:.9g})".format(*point) for point in points.tolist()) + "]"


def _numbers(values: np.ndarray) -> str:
    return "[" + ", ".join(f"{value:.9g}" for value in values.tolist()) + "]"


def _name(text: str) -> str:
    """Return a name of a prim: letters, digits and _."""
    return "".join(part.capitalize() for part in text.split("-"))


def _text(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ") + '"'
