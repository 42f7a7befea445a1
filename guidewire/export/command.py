"""`guidewire.py export`: a run's files for other programs."""

from __future__ import annotations

import argparse
import csv
import io
import os
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from guidewire.anatomy.mesh import AnatomyError
from guidewire.anatomy.vtp import write_vtp
from guidewire.export.curves import Curve, curves_of
from guidewire.export.frame import Frame, frame_of
from guidewire.export.usd import Wall, write_usd
from guidewire.logs.logs import LogError, extent, read_log
from guidewire.logs.runs import PARAMETERS_NAME, read_run
from guidewire.prepare import PreparationError
from guidewire.runs import checking
from guidewire.runs.whole_files import write_whole
from guidewire.sessions.session import SessionError, session_of
from guidewire.viewer.drawn_walls import walls_of
from guidewire.viewer.recording import Recording, read_recording

SERIES, TABLE, STAGE = "run.pvd", "run.csv", "run.usda"
_FRAME = re.compile(r"(wire|vessel|(catheter|obstacle)-\d+)-\d{5}\.vtp")
_HIDDEN = {"inBody", "time", "step", "stepTime", "realTime", "tipx", "tipy", "tipz", "lumen"}  # of the table


def run(arguments: argparse.Namespace) -> int:
    """Write the files; returns the exit code.

    Raises
    ------
    PreparationError : one line, for a folder that holds no run, or one whose vessel is gone.
    """
    folder = arguments.out or arguments.folder / "export"
    try:
        recording, described, moved = _read(arguments.folder, arguments.frames)
        frame = frame_of(read_run(arguments.folder).parameters, described["patient"], arguments.axes)
    except (LogError, SessionError, AnatomyError) as error:
        raise PreparationError(str(error)) from error
    checking.check_out(folder)
    folder.mkdir(parents=True, exist_ok=True)
    curves = curves_of(recording, described, frame)
    times = next(channel.values[:, 0] for channel in recording.channels if channel.name == "time")
    walls = [Wall(_wall_name(k, recording), [frame.points(one) for one in places], frame.surface(wall)[1])
             for k, ((_, wall), places) in enumerate(zip(recording.walls, moved))]
    names = _write_series(folder, curves, walls, times, frame)
    for wall in walls:
        if not wall.moves:
            write_vtp(folder / f"{wall.name}.vtp", wall.places[0], triangles=wall.triangles, space=frame.space)
    write_usd(folder / STAGE, curves, times, walls, frame, recording.title)
    write_whole(folder / TABLE, _table(recording, frame))
    for file in folder.iterdir():    # of an earlier export with more moments
        if _FRAME.fullmatch(file.name) and file.name not in names:
            file.unlink()
    for warning in recording.warnings:
        print(f"warning: {warning}")
    print(f"frame: {frame.describe()}")
    moments = f"{len(times)} moment{'s' * (len(times) > 1)} of {', '.join(curve.title for curve in curves)}"
    print(f"written: {SERIES} ({moments}), {TABLE}, {STAGE}"
          + "".join(f", {wall.name}{'-*' * wall.moves}.vtp" for wall in walls) + f" in {os.path.relpath(folder)}")
    return 0


def _read(folder: Path, frames: int | None) -> tuple[Recording, dict, list[list[np.ndarray]]]:
    """Return the run, what is described of it, and the vertices of each wall: once, or at each moment."""
    found = read_run(folder)
    log = read_log(folder, "all")
    middle, diagonal = extent(log)
    with session_of(folder / PARAMETERS_NAME) as session:
        walls, at = walls_of(session, found, log, middle, max(diagonal, 1.0))
        described = session.describe()
        recording = read_recording(found, walls, frames or len(log.steps), described, session.places)
        steps = next(channel.values[:, 0] for channel in recording.channels if channel.name == "step")
        moments = [walls] if at is None else [at(k) for k in np.searchsorted(log.steps, steps)]
    moved = [[moment[k].vertices for moment in moments] for k in range(len(walls))]
    return recording, described, [places if any((one != places[0]).any() for one in places) else places[:1]
                                  for places in moved]


def _wall_name(number: int, recording: Recording) -> str:
    """"vessel", or "obstacle-1" and so on."""
    kinds = [kind for kind, _ in recording.walls]
    return "vessel" if kinds[number] == "vessel" else f"obstacle-{kinds[:number + 1].count('obstacle')}"


def _write_series(folder: Path, curves: Sequence[Curve], walls: Sequence[Wall], times: np.ndarray,
                  frame: Frame) -> set[str]:
    names, rows = set(), []
    for moment, time in enumerate(times):
        for part, curve in enumerate(curves):
            name = f"{curve.name}-{moment:05d}.vtp"
            points = curve.points[moment]
            write_vtp(folder / name, points, [np.arange(len(points))],
                      at_points={key: values[moment] for key, values in curve.arrays.items()}, space=frame.space)
            rows.append(f'<DataSet timestep="{time:.9g}" group="" part="{part}" name="{curve.name}" file="{name}"/>')
            names.add(name)
        for part, wall in enumerate((wall for wall in walls if wall.moves), len(curves)):
            name = f"{wall.name}-{moment:05d}.vtp"
            write_vtp(folder / name, wall.places[moment], triangles=wall.triangles, space=frame.space)
            rows.append(f'<DataSet timestep="{time:.9g}" group="" part="{part}" name="{wall.name}" file="{name}"/>')
            names.add(name)
    write_whole(folder / SERIES, "\n".join([
        '<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian"><Collection>',
        *rows, "</Collection></VTKFile>"]) + "\n")
    return names


def _table(recording: Recording, frame: Frame) -> str:
    """Return a row a moment: step, time, tip, and what the log says of hubs, walls and energies."""
    known = {channel.name: channel for channel in recording.channels}
    tips = frame.points(known["positions"].values[:, -3:])
    columns = [("step", known["step"].values[:, 0].astype(int)), ("time (s)", known["time"].values[:, 0]),
               *((f"tip {axis} ({frame.unit})", tips[:, k]) for k, axis in enumerate("xyz"))]
    if "lumen" in known:
        left, is_at_target, is_inside = known["lumen"].values.T
        columns += [(f"left to the target ({frame.unit})", frame.scale * left),
                    ("at the target", is_at_target.astype(int)), ("in the vessel", is_inside.astype(int))]
    columns += [(f"{channel.label or name} ({channel.unit})", channel.values[:, 0])
                for name, channel in known.items() if channel.place == "frame" and name not in _HIDDEN]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([name for name, _ in columns])
    writer.writerows(zip(*([_shown(value) for value in values.tolist()] for _, values in columns)))
    return text.getvalue()


def _shown(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:.10g}"
