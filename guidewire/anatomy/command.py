"""`guidewire.py anatomy`: its arguments and its output."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from guidewire.anatomy import output, reading
from guidewire.anatomy.centreline import find_centreline
from guidewire.anatomy.formats import CENTRELINES, MASKS
from guidewire.anatomy.inspection import Inspection, inspect
from guidewire.anatomy.mesh import AnatomyError, Mesh
from guidewire.anatomy.repair import Repaired, repair
from guidewire.prepare import DOOR, PreparationError
from guidewire.runs import checking
from guidewire.runs.whole_files import whole_file, write_whole


def run(arguments: argparse.Namespace) -> int:
    """Inspect, repair and write a vessel; returns the exit code.

    Raises
    ------
    PreparationError : one line, for an input that is no vessel.
    """
    name = arguments.file.name.split(".")[0] if arguments.file else f"{arguments.make}-{arguments.seed}"
    folder = arguments.out or Path("results") / "anatomy" / name
    checking.check_out(folder)
    try:
        return _run(arguments, folder)
    except AnatomyError as error:
        text = str(error)
        known = arguments.file is None or text.startswith(str(arguments.file))
        raise PreparationError(text if known else f"{arguments.file}: {text}") from error


def _run(arguments: argparse.Namespace, folder: Path) -> int:
    mesh, unit, notes = _mesh_of(arguments)
    found = inspect(mesh, unit)
    found.notes += notes
    if arguments.look:
        return _tell(folder, mesh, found, None, None, arguments)
    repaired = repair(mesh)
    if arguments.open:
        from guidewire.anatomy.ends import open_ends

        repaired = open_ends(repaired)
    line = find_centreline(repaired.mesh, repaired.rims)
    inlet = output.find_end(line, arguments.inlet) if arguments.inlet else line.ends[0]
    target = (output.find_end(line, arguments.target) if arguments.target
              else output.default_target(line, inlet, found.unit, arguments.wire))
    made = f"{arguments.make}, type {arguments.type}, seed {arguments.seed}"
    source = arguments.file.name if arguments.file else made
    output.write_vessel(folder, repaired.mesh, line, found.unit, source)
    output.write_scene(folder, output.scene(line, found.unit, inlet, target, arguments.wire))
    return _tell(folder, repaired.mesh, found, repaired, line, arguments)


def _mesh_of(arguments: argparse.Namespace) -> tuple[Mesh, str | None, list[str]]:
    """The mesh, its unit where it is known, and what was done to make it."""
    if arguments.make:
        from guidewire.anatomy.shapes import make

        return make(arguments.make, arguments.type, arguments.seed, arguments.stenosis, arguments.aneurysm)
    return read(arguments.file, arguments.unit, arguments.label, arguments.threshold, arguments.error,
                arguments.region)


def read(file: Path, unit: str | None = None, label: float | None = None, threshold: float | None = None,
         error: float | None = None, region: int | None = None) -> tuple[Mesh, str | None, list[str]]:
    """The mesh of a file, or one made of its mask or centreline; its unit where it is known, and what was done.

    Raises
    ------
    AnatomyError : one line, for a file that holds no vessel.
    """
    kind = reading.kind_of(file)
    if kind in MASKS:
        from guidewire.anatomy.masks import mesh_of_image

        return mesh_of_image(reading.read_image(file), label, threshold, error, region)
    line = reading.line_of_poly_data(file) if kind == ".vtp" else None
    if kind in CENTRELINES or line is not None:
        from guidewire.anatomy.shapes import tube_mesh

        line = line or reading.read_line(file)
        left = f"; of {line.others + 1} lines the longest, the others are ignored" if line.others else ""
        return tube_mesh(line.points, line.radii), unit or line.unit or None, [
            f"a tube around a centreline of {len(line.points)} points{left}"]
    return reading.read_mesh(file), unit, []


def _tell(folder: Path, mesh: Mesh, found: Inspection, repaired: Repaired | None, line, arguments) -> int:
    from guidewire.anatomy.picture import draw

    lines = output.describe(found, repaired, line, arguments.wire)
    title = str(arguments.file.name if arguments.file else arguments.make)
    folder.mkdir(parents=True, exist_ok=True)
    write_whole(folder / output.REPORT, f"# {title}\n\n" + "\n".join(f"- {line}" for line in lines) + "\n")
    figure = draw(mesh, found, line, title)
    with whole_file(folder / output.PICTURE) as partial:
        figure.savefig(partial, dpi=110)
    for text in lines:
        print(text)
    written = [output.REPORT, output.PICTURE]
    if line is not None:
        written = [output.MESH, output.ANATOMY, output.SCENE, *written]
        print(f"next: {DOOR} run {os.path.relpath(folder / output.SCENE)} --check")
    print(f"written: {', '.join(written)} in {os.path.relpath(folder)}")
    return 0
