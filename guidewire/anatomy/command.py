"""`guidewire.py anatomy`: its arguments and its output."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

import numpy as np

from guidewire.anatomy import output, reading
from guidewire.anatomy.centreline import Centreline, find_centreline
from guidewire.anatomy.centreline_files import centreline_names, write_centreline
from guidewire.anatomy.ends import open_ends, without_caps
from guidewire.anatomy.inspection import Inspection, Unit, inspect
from guidewire.anatomy.masks import Taking
from guidewire.anatomy.mesh import AnatomyError, Mesh
from guidewire.anatomy.patient import Axes, axes_named
from guidewire.anatomy.repair import Repaired, repair
from guidewire.anatomy.summary import Choice, summarise
from guidewire.prepare import DOOR, ROOT, PreparationError
from guidewire.runs import checking
from guidewire.runs.whole_files import whole_file, write_whole


def run(arguments: argparse.Namespace) -> int:
    """Inspect, repair and write a vessel; returns the exit code.

    Raises
    ------
    PreparationError : one line, for an input that is no vessel.
    """
    try:
        folder = arguments.out or default_folder(
            reading.stem_of(reading.name_of(arguments.file)) if arguments.file
            else f"{arguments.make}-{_number(arguments)}")
        checking.check_out(folder)
        return _run(arguments, folder)
    except AnatomyError as error:
        text = str(error)
        known = arguments.file is None or text.startswith(str(arguments.file))
        raise PreparationError(text if known else f"{arguments.file}: {text}") from error


def default_folder(name: str) -> Path:
    """Return the folder of a vessel that no --out says a folder for."""
    return Path("results") / "anatomy" / name


def _run(arguments: argparse.Namespace, folder: Path) -> int:
    source = _source_of(arguments)
    if not (arguments.look or arguments.force):
        output.check_source(folder, source)
    found = inspect(source.mesh, source.unit, source.unit_said_by)
    found.notes += [*source.notes, *source.left_out]
    if arguments.look:
        return _tell(folder, source, found, source.mesh, None, None, None, arguments)
    if not found.unit.is_sure:
        raise AnatomyError(f"unit: {found.unit.reason}")
    repaired, line = _lumen(source, arguments)
    moving = None
    if arguments.cycle:
        moving = output.MOTION
        found.notes += _write_motion(folder, source, repaired, line, found.unit, arguments)
    narrow = float((line.radii[line.inner()] < 2.0 * source.voxel).mean())
    if narrow:
        found.notes.append(f"along {narrow:.0%} of the centreline the radius is below two voxels: the wall is uncertain"
                           " there by some 4 % of it, below one voxel by more than 8 %")
    if arguments.catheter and not arguments.instrument:
        raise AnatomyError("--catheter needs the wire in it: add --instrument")
    wire = diameter_of(arguments.instrument) if arguments.instrument else arguments.wire
    if arguments.catheter:
        diameter_of(arguments.catheter)
    inlet = output.find_inlet(line, arguments.inlet, source.begin)
    target = (output.find_end(line, arguments.target) if arguments.target
              else output.default_target(line, inlet, found.unit, wire))
    output.write_vessel(folder, repaired.mesh, line, found.unit, source)
    write_centreline(folder, line, found.unit, source.axes)
    output.write_scene(folder, output.scene(line, found.unit, inlet, target, wire, source.axes, arguments.instrument,
                                             arguments.catheter, moving))
    choice = Choice(inlet, target, arguments.inlet is not None, arguments.target is not None)
    return _tell(folder, source, found, repaired.mesh, repaired, line, choice, arguments)


def _lumen(source: reading.Source, arguments: argparse.Namespace,
           root: np.ndarray | None = None) -> tuple[Repaired, Centreline]:
    """Return the repaired wall and its centreline, which begins at the widest end, or near a point."""
    repaired = repair(source.mesh)
    if source.faces is not None:
        repaired = without_caps(repaired, source.faces)
    if arguments.open:
        repaired = open_ends(repaired, None if arguments.open == "all" else list(map(int, arguments.open.split(","))))
    return repaired, find_centreline(repaired.mesh, repaired.rims, root)


def _write_motion(folder: Path, source: reading.Source, repaired: Repaired, line: Centreline, unit: Unit,
                  arguments: argparse.Namespace) -> list[str]:
    """Write the motion from the phases of a cycle; return what there is to say of it."""
    from guidewire.anatomy.cycle import Phase, write_motion

    if arguments.file is None or len(arguments.cycle) < 2:
        raise AnatomyError("--cycle needs FILE, the vessel at rest, and at least two files of later phases")
    phases = [Phase(source.name, repaired.mesh, line)]
    for file in arguments.cycle:
        try:
            other = reading.read(file, arguments.unit, axes_named(arguments.axes) if arguments.axes else None,
                                 _taking(arguments), arguments.series, arguments.label_names)
            wall, tree = _lumen(other, arguments, phases[-1].line.points[0])
        except AnatomyError as error:
            raise AnatomyError(str(error) if str(file) in str(error) else f"{file}: {error}") from error
        phases.append(Phase(other.name, wall.mesh, tree))
    folder.mkdir(parents=True, exist_ok=True)
    return write_motion(folder / output.MOTION, phases, unit)


def diameter_of(instrument: str) -> float:
    """Diameter of an instrument of the library, mm.

    Raises
    ------
    AnatomyError : there is none of this name.
    """
    names = sorted(file.stem for file in (ROOT / "instruments").glob("*.json"))
    if instrument not in names:
        raise AnatomyError(f"there is no instrument '{instrument}': there are {', '.join(names)}")
    said = json.loads((ROOT / "instruments" / f"{instrument}.json").read_text(encoding="utf-8"))["diameter"]["value"]
    number, unit = said.split()
    return float(number) * {"mm": 1.0, "in": 25.4, "F": 1.0 / 3.0}[unit]


def _source_of(arguments: argparse.Namespace) -> reading.Source:
    axes = axes_named(arguments.axes) if arguments.axes else None
    if arguments.make:
        from guidewire.anatomy.shapes import make

        number = _number(arguments)
        mesh, unit, notes = make(arguments.make, arguments.type, number, arguments.stenosis, arguments.aneurysm)
        made = f"{arguments.make}, type {arguments.type}, seed {number}"
        axes = axes or Axes()    # no patient's
        return reading.Source(axes.take(mesh), unit, "as made", axes, notes, made)
    return reading.read(arguments.file, arguments.unit, axes, _taking(arguments), arguments.series,
                        arguments.label_names)


def _taking(arguments: argparse.Namespace) -> Taking:
    box, seed = (None if numbers is None or isinstance(numbers, int) else np.array(numbers).reshape(-1, 3)
                 for numbers in (arguments.box, arguments.seed))
    return Taking(arguments.label, arguments.segment, arguments.threshold, arguments.region, box,
                  None if seed is None else seed[0], arguments.error)


def _number(arguments: argparse.Namespace) -> int:
    """Return the seed of a vessel that is made."""
    if arguments.seed is not None and not isinstance(arguments.seed, int):
        raise AnatomyError("--seed X,Y,Z is a point of a file; of a vessel that is made it is a whole number above 0")
    return arguments.seed or 1


def _tell(folder: Path, source: reading.Source, found: Inspection, mesh: Mesh, repaired: Repaired | None,
          line: Centreline | None, choice: Choice | None, arguments: argparse.Namespace) -> int:
    from guidewire.anatomy.picture import draw

    lines = summarise(source, found, repaired, line, choice)
    more = output.describe(found, repaired, line, arguments.wire)
    title = source.name if arguments.file else arguments.make
    folder.mkdir(parents=True, exist_ok=True)
    listed = ["\n".join(f"- {line}" for line in part) for part in (lines, more)]
    write_whole(folder / output.REPORT, f"# {title}\n\n{listed[0]}\n\n## Findings\n\n{listed[1]}\n")
    pictures = {output.PICTURE: draw(mesh, found, line, title)}
    if source.voxels is not None:
        from guidewire.anatomy.taken_picture import draw_taken

        pictures[output.TAKEN] = draw_taken(*source.voxels, _taking(arguments), title)
    for name, figure in pictures.items():
        with whole_file(folder / name) as partial:
            figure.savefig(partial, dpi=110)
    for text in (*lines, *more):
        print(text)
    written = [output.REPORT, *pictures]
    if line is not None:
        written = [output.MESH, output.ANATOMY, output.SCENE, *centreline_names(source.axes),
                   *([output.MOTION] if arguments.cycle else []), *written]
        print(f"next: {DOOR} run {os.path.relpath(folder / output.SCENE)} --check")
    print(f"written: {', '.join(written)} in {os.path.relpath(folder)}")
    return 0
