"""A vessel in the browser: its wall as it is in the file, its ends, its defects; a click makes an end the inlet."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from guidewire.prepare import DOOR, PreparationError

if TYPE_CHECKING:
    from guidewire.anatomy.centreline import Centreline
    from guidewire.anatomy.inspection import Inspection
    from guidewire.anatomy.mesh import Mesh
    from guidewire.anatomy.reading import Source

_MOST = 400_000  # triangles that are drawn; of a larger mesh one vertex a cell
_WIRE = 0.36  # mm, diameter of the wire that a scene is written for


def read_vessel(file: Path) -> VesselPicture:
    """Inspect and repair a file.

    Raises
    ------
    PreparationError : one line, for a file that holds no vessel.
    """
    from guidewire.anatomy import reading
    from guidewire.anatomy.centreline import find_centreline
    from guidewire.anatomy.inspection import inspect, weld_exactly
    from guidewire.anatomy.mesh import AnatomyError
    from guidewire.anatomy.output import describe
    from guidewire.anatomy.repair import repair
    from guidewire.anatomy.summary import summarise

    try:
        source = reading.read(file)
        found = inspect(source.mesh, source.unit, source.unit_said_by)
        mesh = weld_exactly(source.mesh)
    except AnatomyError as error:
        text = str(error)
        raise PreparationError(text if text.startswith(str(file)) else f"{file}: {text}") from error
    found.notes += [*source.notes, *source.left_out]
    try:
        repaired = repair(mesh)
        line = find_centreline(repaired.mesh, repaired.rims)
    except AnatomyError as error:
        lines = [*summarise(source, found), *describe(found, None, None, _WIRE), f"not repaired: {error}"]
        return VesselPicture(source, mesh, found, None, None, lines)
    lines = [*summarise(source, found, repaired, line), *describe(found, repaired, line, _WIRE)]
    return VesselPicture(source, mesh, found, repaired.mesh, line, lines)


class VesselPicture:
    """What the page shows of a vessel, in mm, and what a click on an end writes.

    Parameters
    ----------
    wall : repaired; None where it could not be, and then there is no end to choose.
    lines : of the report.
    """

    def __init__(self, source: Source, mesh: Mesh, found: Inspection, wall: Mesh | None, line: Centreline | None,
                 lines: list[str]) -> None:
        self._source, self._mesh, self._found, self._wall, self._line = source, mesh, found, wall, line
        self._lines = lines

    def to_bytes(self) -> bytes:
        """Return the length of the header (4 bytes, lowest first), the header (JSON), vertices (float32), triangles
        (uint32).
        """
        mesh, mm = self._mesh, 1e3 * self._found.unit.metres
        if len(mesh.triangles) > _MOST:
            from guidewire.anatomy.sampling import thinned

            mesh = thinned(mesh, float(np.sqrt(2.3 * np.linalg.norm(mesh.area_vectors(), axis=1).sum() / _MOST)))
        found = self._found
        kinds = (("edges of more than two triangles", found.crowded), ("crossings", found.crossings),
                 ("triangles without area", found.slivers), ("turned triangles", found.turned),
                 ("holes in the side", [rim.centre for rim in found.rims if rim.is_hole]))
        header = json.dumps({
            "title": self._source.name, "lines": self._lines, "vertices": mesh.vertices.size,
            "ends": [self._end(end, mm) for end in (self._line.ends if self._line else ())],
            "places": [{"name": name, "points": (mm * np.asarray(places)).ravel().tolist()}
                       for name, places in kinds if len(places)],
        }).encode()
        header += b" " * (-len(header) % 4)
        return b"".join((np.uint32(len(header)).tobytes(), header, (mm * mesh.vertices).astype("<f4").tobytes(),
                         mesh.triangles.astype("<u4").tobytes()))

    def choose(self, number: int) -> str:
        """Write the vessel with a scene whose wire starts at an end, as `guidewire.py anatomy --inlet` does; returns
        what to tell."""
        from guidewire.anatomy import command, output
        from guidewire.anatomy.mesh import AnatomyError

        end = next((end for end in self._line.ends if end.number == number), None) if self._line else None
        if end is None or self._wall is None:
            return f"there is no end {number}"
        unit = self._found.unit
        folder = command.default_folder(self._source.stem)
        if not unit.is_sure:
            return f"unit: {unit.reason}"
        try:
            output.check_source(folder, self._source)
        except AnatomyError as error:
            return str(error)
        target = output.default_target(self._line, end, unit, _WIRE)
        output.write_vessel(folder, self._wall, self._line, unit, self._source)
        output.write_scene(folder, output.scene(self._line, unit, end, target, _WIRE, self._source.axes))
        return (f"inlet: end {end.number} '{end.name}', target: end {target.number} '{target.name}'\n"
                f"next: {DOOR} run {os.path.relpath(folder / output.SCENE)} --check")

    @staticmethod
    def _end(end: Any, mm: float) -> dict[str, Any]:
        return {"number": end.number, "name": end.name, "isOpen": end.is_open, "radius": mm * end.radius,
                "centre": (mm * end.centre).tolist(), "direction": end.direction.tolist()}
