"""The commands `demo` and `figures`."""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path

from analysis import gallery
from analysis.figures import FIGURES
from guidewire.commands import commands
from guidewire.commands.making import build_runner, make, means_of
from guidewire.commands.progress import bar_of
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import checking
from guidewire.runs.runner import FAILED
from guidewire.studies.builtin import STUDIES
from guidewire.studies.table import Grid, Source
from guidewire.sweeps.sweep import Means

# Of the arch with its branch, as a C-arm sees them.
_FILM = ["--fluoroscopy", "--frames", "24", "--pixels", "288", "--noise", "0", "--target", "0", "55", "180", "--field",
         "150"]
_NEXT = """what to try next:
  python3 guidewire.py view {run}                   this run in the browser (view params/branch.json: steer it)
  python3 guidewire.py run params/sheath.json       a wire pushed out of a sheath, with forces in summary.json
  python3 guidewire.py sweep drives                 a study of four drives; --help lists all commands"""
BEYOND_A_GATE = 1  # all that was asked for is there, and a check is not passed


def demo(arguments: argparse.Namespace) -> int:
    """`demo`: the thesis's default run with its figures, and the film of a wire that enters a branch."""
    checking.check_out(arguments.out)
    means = Means(build_runner(), bar=bar_of("default"))
    default = replace(STUDIES["default"], grid=Grid())    # once: nobody compares times here
    if make([(default, arguments.out)], arguments.out, means).failures:
        return FAILED
    study = arguments.out / "default"
    ids = [name for name, spec in FIGURES.items() if set(spec.studies) == {"default"}]
    drawn = gallery.draw(ids, {"default": study}, arguments.out)
    for line in gallery.describe_default_run(study):
        print(line)
    run, film = arguments.out / "branch", arguments.out / "branch.gif"
    code = commands.run(commands.parse(["run", str(ROOT / "params" / "branch.json"), "--out", str(run)]))
    if code == 0 and not (film.exists() and film.stat().st_mtime > (run / "summary.json").stat().st_mtime):
        code = commands.run(commands.parse(["render", str(run), "--out", str(film), *_FILM]))
    code = code or _tell(drawn)
    if code == 0:
        print(_NEXT.format(run=os.path.relpath(run)))
    return code


def figures(arguments: argparse.Namespace) -> int:
    """`figures`: the pictures that are asked for, after the runs that they need."""
    catalogue = gallery.QUICK if arguments.quick else gallery.FULL
    out = arguments.out / "quick" if arguments.quick else arguments.out
    known = catalogue.specs
    unknown = [name for name in arguments.ids if name not in known]
    if unknown:
        raise PreparationError(f"there is no figure {unknown[0]}; there are {', '.join(known)}")
    ids = arguments.ids or list(known)
    needed = {name for figure in ids for name in known[figure].studies}
    checking.check_out(arguments.out)
    means = means_of(arguments, build_runner(), "figures")
    asked: list[tuple[Source, Path]] = [(study, out) for name, study in catalogue.studies.items() if name in needed]
    asked += [(check, out / name) for name, checks in catalogue.checked.items() if name in needed for check in checks]
    result = make(asked, out, means)
    folders = {name: (out / name).resolve() for name in needed}
    code = _tell(gallery.draw(ids, folders, out / "figures", catalogue, arguments.jobs))
    return FAILED if result.failures else code


def _tell(drawn: gallery.Gallery) -> int:
    for problem in drawn.problems:
        print(f"guidewire: {problem}", file=sys.stderr)
    print(f"pictures and captions: {os.path.relpath(drawn.index)}")
    for line in drawn.failed_gates:
        print(f"guidewire: beyond its limit: {line}", file=sys.stderr)
    if drawn.problems:
        return FAILED
    return BEYOND_A_GATE if drawn.failed_gates else 0
