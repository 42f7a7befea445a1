"""`guidewire.py anatomy`: its arguments and its output."""

from __future__ import annotations

import argparse
import json
import os
from pathlib import Path

from guidewire.anatomy import output, reading
from guidewire.anatomy.centreline import find_centreline
from guidewire.anatomy.inspection import Inspection, inspect
from guidewire.anatomy.mesh import AnatomyError, Mesh
from guidewire.anatomy.patient import Axes, axes_named
from guidewire.anatomy.repair import Repaired, repair
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
            reading.stem_of(arguments.file.name) if arguments.file else f"{arguments.make}-{arguments.seed}")
        checking.check_out(folder)
        return _run(arguments, folder)
    except AnatomyError as error:
        text = str(error)
        known = arguments.file is None or text.startswith(str(arguments.file))
        raise PreparationError(text if known else f"{arguments.file}: {text}") from error


def default_folder(name: str) -> Path:
    """Where a vessel is written that no --out says a folder for."""
    return Path("results") / "anatomy" / name


def _run(arguments: argparse.Namespace, folder: Path) -> int:
    source = _source_of(arguments)
    if not (arguments.look or arguments.force):
        output.check_source(folder, source)
    found = inspect(source.mesh, source.unit, source.unit_said_by)
    found.notes += [source.axes.describe(), *source.notes]
    if arguments.look:
        return _tell(folder, source.mesh, found, None, None, arguments)
    if not found.unit.is_sure:
        raise AnatomyError(f"unit: {found.unit.reason}")
    repaired = repair(source.mesh)
    if arguments.open:
        from guidewire.anatomy.ends import open_ends

        repaired = open_ends(repaired, None if arguments.open == "all" else list(map(int, arguments.open.split(","))),
                             source.faces)
    line = find_centreline(repaired.mesh, repaired.rims)
    if arguments.catheter and not arguments.instrument:
        raise AnatomyError("--catheter needs the wire in it: add --instrument")
    wire = diameter_of(arguments.instrument) if arguments.instrument else arguments.wire
    if arguments.catheter:
        diameter_of(arguments.catheter)
    inlet = output.find_inlet(line, arguments.inlet, source.begin)
    target = (output.find_end(line, arguments.target) if arguments.target
              else output.default_target(line, inlet, found.unit, wire))
    output.write_vessel(folder, repaired.mesh, line, found.unit, source)
    output.write_scene(folder, output.scene(line, found.unit, inlet, target, wire, source.axes, arguments.instrument,
                                             arguments.catheter))
    return _tell(folder, repaired.mesh, found, repaired, line, arguments)


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

        mesh, unit, notes = make(arguments.make, arguments.type, arguments.seed, arguments.stenosis, arguments.aneurysm)
        made = f"{arguments.make}, type {arguments.type}, seed {arguments.seed}"
        axes = axes or Axes()    # no patient's
        return reading.Source(axes.take(mesh), unit, "as made", axes, notes, made)
    return reading.read(arguments.file, arguments.unit, arguments.label, arguments.threshold, arguments.error,
                        arguments.region, axes)


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
