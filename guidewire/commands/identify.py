"""`guidewire.py identify`: values of a scene from measurements, as a table, identified.json, a picture and a scene."""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path
from typing import Any

from guidewire.commands.arguments import value_of
from guidewire.commands.progress import seconds_counted
from guidewire.identification import Identified, identify
from guidewire.identification.identified import to_json
from guidewire.prepare import PreparationError
from guidewire.runs import building, checking
from guidewire.runs.runner import INTERRUPTED
from guidewire.runs.whole_files import whole_file, write_whole


def run(arguments: argparse.Namespace) -> int:
    """Find, print and write. An interrupted search leaves the best values so far."""
    from guidewire.identification.figure import draw_identified

    checking.check_file(arguments.file)
    checking.check_overrides(arguments.overrides)
    out = arguments.out or Path("results") / f"{arguments.file.stem}-identified"
    checking.check_out(out)
    with seconds_counted() as tell:
        building.build(building.RUNNER, tell)
    settings = {key: value_of(text) for key, text in arguments.overrides}
    found = identify(arguments.file, arguments.measured, arguments.fit, arguments.align, _cameras(arguments.camera),
                     dict(map(_bounds, arguments.bounds)), settings, arguments.jobs,
                     lambda line: print(line, file=sys.stderr, flush=True))
    out.mkdir(parents=True, exist_ok=True)
    write_whole(out / "identified.json", to_json(found, arguments.file.name, arguments.measured))
    scene = {**json.loads(arguments.file.read_text(encoding="utf-8-sig")), **settings, **found.parameters}
    write_whole(out / arguments.file.name, json.dumps(_beside(scene, arguments.file, out), indent=2) + "\n")
    picture = out / "identified.png"
    with whole_file(picture) as partial:
        draw_identified(found, [file.name for file in arguments.measured]).savefig(partial)
    print("\n".join(lines(found, arguments.measured)))
    print(f"picture: {os.path.relpath(picture)}; parameter file: {os.path.relpath(out / arguments.file.name)}")
    if not found.is_complete:
        print("guidewire: interrupted; the best values so far are written, without errors", file=sys.stderr)
        return INTERRUPTED
    return 0


def lines(found: Identified, measured: list[Path]) -> list[str]:
    """Return the table, a line a value, and what is to be said of it."""
    width = max(len(one.key) for one in found.values)
    made = [f"{'key':{width}}  {'value':>12}  {'std. error':>10}  95 % interval"]
    for one in found.values:
        told = "not told" if one.value is None else f"{one.value:.6g}"
        is_known = found.is_complete and one.value is not None
        errors = f"{one.error:10.2g}  {one.low:.5g} to {one.high:.5g}" if is_known else ""
        made.append(f"{one.key:{width}}  {told:>12}  {errors} {one.unit}".rstrip())
    made += [f"{file.name}: RMS residual {rms:.4g} of {len(part.offsets)} points"
             for file, rms, part in zip(measured, found.rms, found.residuals)]
    made += [f"correlation of {found.values[j].key} and {found.values[k].key}: {found.correlation[j, k]:.2f}"
             for k in range(len(found.values)) for j in range(k) if abs(found.correlation[j, k]) > 0.9]
    if found.failed:
        made.append(f"runs without a result, passed over: {'; '.join(found.failed)}")
    return [*made, *found.notes, f"{found.runs} runs"]


def _cameras(file: Path | None) -> dict[str, Any]:
    if file is None:
        return {}
    try:
        views = json.loads(file.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError) as error:
        raise PreparationError(f"{file}: {getattr(error, 'strerror', None) or f'not JSON: {error}'}") from error
    if not isinstance(views, dict) or not all(isinstance(matrix, list) for matrix in views.values()):
        raise PreparationError(f"{file}: needs an object of views and their matrices, 3 rows of 4 numbers")
    return views


def _bounds(text: str) -> tuple[str, tuple[float, float]]:
    key, _, range_of = text.partition("=")
    try:
        low, high = map(float, range_of.split(","))
    except ValueError:
        raise PreparationError(f"--bounds {text}: needs KEY=LOW,HIGH, such as bendingStiffness=1e-5,1e-3") from None
    return key, (low, high)


def _beside(scene: dict[str, Any], file: Path, out: Path) -> dict[str, Any]:
    """Parts of keys as they belong, and paths as seen from the new folder."""
    from guidewire.identification.unknowns import placed

    made = placed(scene)
    for holder, key in ((made, "driveFile"), (made, "startFile"), (made.get("vessel") or {}, "file"),
                        (made.get("vessel") or {}, "anatomy")):
        if isinstance(holder, dict) and holder.get(key):
            holder[key] = os.path.relpath(file.parent / holder[key], out)
    return made
