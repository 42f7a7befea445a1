"""Generated vessels, cached on disk."""

from __future__ import annotations

import hashlib
import importlib.util
import json
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from guidewire.env.spaces import Error

_MADE_BY = ("shapes", "tubes", "surfaces", "distance_grid", "repair", "centreline", "sampling", "loops", "output",
            "mesh", "intersections")
_ABANDONED = 3 * 3600.0  # s since something was written there
_COARSER = 0.03  # mm, by which the wall moves at most where triangles are taken out
_TAKEN_OUT = (0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2)  # of them, the first that goes


def made_vessel(which: Mapping[str, Any]) -> Path:
    """Folder of a generated vessel with vessel.obj, anatomy.json and scene.json.

    Parameters
    ----------
    which : "make", "type" and "seed" as of `guidewire.py anatomy`; "inlet" and "target", numbers of ends.

    Notes
    -----
    Made in the user's cache folder, under a name that holds a sum over the generator's sources: other sources, another
    vessel. Needs vtk, and a minute, when it is made; then lines on stderr say what is being done. A folder is written
    whole or not at all.

    Raises
    ------
    Error : vtk is missing, or there is no such kind, type or end; one line.
    """
    from guidewire.anatomy.mesh import AnatomyError

    generator = Path(__file__).parents[1] / "anatomy"
    sources = b"".join((generator / f"{name}.py").read_bytes() for name in _MADE_BY)
    sum_of = hashlib.sha256(sources + json.dumps(which, sort_keys=True).encode()).hexdigest()[:16]
    name = f"{which['make']}-{which.get('type', 1)}-{which['seed']}-{sum_of}"
    folder = _cache() / name
    if not (folder / "scene.json").is_file():
        folder.parent.mkdir(parents=True, exist_ok=True)
        for left in folder.parent.glob(f"{name}.*"):    # by a process that was killed
            if time.time() - left.stat().st_mtime > _ABANDONED:
                shutil.rmtree(left, ignore_errors=True)
        partial = Path(tempfile.mkdtemp(prefix=f"{name}.", dir=folder.parent))
        try:
            _make(which, partial)
            os.rename(partial, folder)
        except AnatomyError as error:
            raise Error(f"anatomies: {json.dumps(which)}: {error}") from error
        except OSError:
            if not (folder / "scene.json").is_file():    # nobody else has made it meanwhile
                raise
        finally:
            shutil.rmtree(partial, ignore_errors=True)
    return folder


def _make(which: Mapping[str, Any], folder: Path) -> None:
    if importlib.util.find_spec("vtkmodules") is None:
        raise Error(f"a vessel of kind {which['make']} is made with vtk: pip install vtk, or apt-get install "
                    "python3-vtk9")
    from guidewire.anatomy import output, shapes
    from guidewire.anatomy.centreline import find_centreline
    from guidewire.anatomy.inspection import inspect
    from guidewire.anatomy.intersections import relaxed
    from guidewire.anatomy.patient import Axes
    from guidewire.anatomy.reading import Source
    from guidewire.anatomy.repair import repair
    from guidewire.anatomy.surfaces import decimate

    began = time.monotonic()

    def tell(what: str) -> None:
        print(f"{which['make']}, type {which.get('type', 1)}, seed {which['seed']}, made once for all episodes: {what} "
              f"({time.monotonic() - began:.0f} s)", file=sys.stderr, flush=True)

    tell("surface")
    kind, number = which["make"], which.get("type", 1)
    mesh, unit, notes = shapes.make(kind, number, which["seed"], None, None)
    # A step between walls takes a third less time with the triangles that are left, and so does all that follows here.
    mesh = relaxed(decimate(mesh, _COARSER, _TAKEN_OUT))
    source = Source(mesh, unit, "as made", Axes(), notes, str(which))
    tell("check and repair")
    found = inspect(mesh, unit)
    repaired = repair(mesh)
    tell("centreline")
    line = find_centreline(repaired.mesh, repaired.rims)
    tubes, _ = shapes.tubes_of(kind, number, which["seed"])
    line = replace(line, ends=tuple(replace(end, name=shapes.name_of(kind, tubes, end.centre) or end.name)
                                    for end in line.ends))
    inlet, target = (output.find_end(line, str(which[key])) for key in ("inlet", "target"))
    output.write_vessel(folder, repaired.mesh, line, found.unit, source)
    scene = output.scene(line, found.unit, inlet, target, which.get("diameter", 0.36), source.axes)
    (folder / output.SCENE).write_text(json.dumps(scene, indent=2) + "\n", encoding="utf-8")
    tell("done")


def _cache() -> Path:
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "guidewire" / "vessels"
