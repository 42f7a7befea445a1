"""The commands of guidewire.py: their execution and output."""

from __future__ import annotations

import argparse
import importlib
import json
import math
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from guidewire import installed
from guidewire.commands import command_line, ending
from guidewire.commands.arguments import value_of
from guidewire.commands.making import build_runner, make, means_of, runner_of, tell_failures
from guidewire.commands.progress import tell_frames
from guidewire.prepare import INSTALLED, ROOT, PreparationError
from guidewire.runs import building, checking
from guidewire.runs.process import code_for_shell, hand_to
from guidewire.runs.runner import FAILED
from guidewire.runs.whole_files import whole_file, write_whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from PIL.Image import Image

    from guidewire.logs.logs import PositionLog


def parse(argv: list[str]) -> argparse.Namespace:
    """Read the command line. `packages` of the result names what the command imports, `action` runs it.

    Exits with 2 and one line on stderr where it cannot be read. Raises PreparationError for a command that only the
    repository has, in the package.
    """
    arguments = command_line.parse(argv)
    if INSTALLED and arguments.command in command_line.OF_THE_REPOSITORY:
        installed.refuse(f"'{arguments.command}'")
    arguments.action = _ACTIONS.get(arguments.command, _execute_elsewhere)
    if getattr(arguments, "check", False):
        arguments.packages = ("numpy",)
    return arguments


def run(arguments: argparse.Namespace) -> int:
    """Run a parsed command and return the exit code.

    Raises PreparationError for what a user has to mend. Any other error is the program's own: its trace goes into a
    file, and one line says where.
    """
    return ending.code_of(arguments.action, arguments, _LEFT.get(arguments.command, ""))


def _execute_elsewhere(arguments: argparse.Namespace) -> int:
    module, function = _ELSEWHERE[arguments.command]
    return getattr(importlib.import_module(module), function)(arguments)


def _run(arguments: argparse.Namespace) -> int:
    out = arguments.out or Path("results") / arguments.file.stem
    checking.check_file(arguments.file)
    checking.check_overrides(arguments.overrides)
    checking.check_out(out)
    command = [*runner_of(arguments), "-parameters", str(arguments.file), "-out", str(out)]
    for key, value in arguments.overrides:
        command += [f"--{key}", value]
    if arguments.force:
        command.append("-force")
    code = hand_to(command)
    if not arguments.check or code != 0:
        return code
    from guidewire.commands import repeating

    return repeating.check(runner_of(arguments), out, arguments.elements)


def _sweep(arguments: argparse.Namespace) -> int:
    from guidewire import library
    from guidewire.studies.keys import RESULTS
    from guidewire.studies.study_file import LIMIT

    checking.check_out(arguments.out)
    study = library.find_study(arguments.study, None if arguments.yes else LIMIT)
    study = replace(study, logs=study.logs or arguments.logs)
    means = means_of(arguments, runner_of(arguments), study.name, study.file and study.file.parent)
    result = make([(study, arguments.out)], arguments.out, means)
    print(f"{result.made} runs made, {result.found} there already: "
          f"{os.path.relpath(arguments.out / study.name / RESULTS)}")
    return FAILED if result.failures else 0


def _advise(arguments: argparse.Namespace) -> int:
    from guidewire import library
    from guidewire.advice import chart, plan, report
    from guidewire.advice.quantity import Quantity

    checking.check_file(arguments.file)
    checking.check_overrides(arguments.overrides)
    checking.check_out(arguments.out)
    wish = plan.AdviceRequest(arguments.error, arguments.budget, Quantity(arguments.of, arguments.at))
    overrides = {key: value_of(text) for key, text in arguments.overrides}
    means = means_of(arguments, build_runner(), arguments.file.stem)
    result, advice = library.find_advice(arguments.file, wish, overrides, arguments.out, means)
    if advice is None:
        tell_failures(result)
        return FAILED
    place = (plan.folder_of(arguments.out) / arguments.file.stem).resolve()
    write_whole(place / "advice.md", report.as_markdown(arguments.file.name, wish, advice))
    print(report.verdict(wish, advice))
    print(f"evidence: {os.path.relpath(place / 'advice.md')}")
    if arguments.chart:
        chart.draw_advice(arguments.file.name, wish, advice).savefig(place / "chart.png")
        print(f"picture: {os.path.relpath(place / 'chart.png')}")
    if advice.taken is None:
        return FAILED
    scene = {**json.loads(arguments.file.read_text(encoding="utf-8-sig")), **overrides}
    file = place / arguments.file.with_suffix(".json").name
    write_whole(file, report.parameters(advice, scene, place))
    print(f"parameter file: {os.path.relpath(file)}")
    return 0


def _render(arguments: argparse.Namespace) -> int:
    from guidewire.commands import drawn, fluoroscopy
    from guidewire.figures import render
    from guidewire.logs.logs import LogError, read_log
    from guidewire.logs.runs import read_run

    out = arguments.out or arguments.folder / "render.png"
    if out.suffix not in (".png", ".gif"):
        raise PreparationError(f"--out {out}: a picture's name ends with .png, a film's with .gif")
    if arguments.times and out.suffix == ".gif":
        raise PreparationError(f"--times is for a picture, and {out.name} is a film: leave one of the two out")
    fluoroscopy.check(arguments)
    try:
        run = read_run(arguments.folder)
        log = read_log(arguments.folder, "all")
        if arguments.fluoroscopy:
            checking.check_out(out.parent)
            images = fluoroscopy.draw(run, log, arguments, out.suffix == ".gif", tell_frames)
            return _save_render(images, log, out)
        middle, diagonal = render.out_of_sheath(run, log)
        checking.check_out(out.parent)
        yaw, pitch = render.VIEWS[arguments.view] if arguments.view else (-90.0, 15.0)
        others = drawn.instruments_and_sheath(run, log)
        view = render.View(tuple(arguments.target) if arguments.target else None, arguments.distance,
                           yaw if arguments.yaw is None else arguments.yaw,
                           pitch if arguments.pitch is None else arguments.pitch, arguments.radius, arguments.zoom,
                           arguments.follow == "tip")
        with drawn.walls_of(run, log, middle, max(diagonal, 1.0)) as (surfaces, moved):
            if out.suffix == ".gif":
                images = render.draw_film(run, log, surfaces, view, arguments.frames, tell_frames, *others, moved)
            else:
                images = [render.draw_picture(run, log, surfaces, view, arguments.times, *others, moved)]
    except LogError as error:
        raise PreparationError(str(error)) from error
    return _save_render(images, log, out)


def _save_render(images: Sequence[Image], log: PositionLog, out: Path) -> int:
    from guidewire.figures.render import save_images

    out.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(out) as partial:
        save_images(images, partial)
    if log.warning:
        print(f"guidewire: warning: {log.warning}", file=sys.stderr)
    print(f"{'film' if out.suffix == '.gif' else 'picture'}: {os.path.relpath(out)}")
    return 0


def _plot(arguments: argparse.Namespace) -> int:
    from guidewire.figures.result_table import draw_curves
    from guidewire.logs.logs import LogError
    from guidewire.logs.result_table import label_of, read_curves

    try:
        curves = read_curves(arguments.table, arguments.x, arguments.y, arguments.by)
    except LogError as error:
        raise PreparationError(str(error)) from error
    folder = arguments.table if arguments.table.is_dir() else arguments.table.parent
    picture = arguments.out or folder / f"{curves.y}-over-{curves.x}.png"
    if picture.suffix != ".png":
        raise PreparationError(f"--out {picture}: a picture's name ends with .png")
    checking.check_out(picture.parent)
    return _save(draw_curves(curves, label_of(curves.x, checking.unit_of(curves.x)), arguments.log), picture)


def _keys(arguments: argparse.Namespace) -> int:
    from guidewire.commands.key_search import describe, find_keys

    # A contributor's own key shows at once; without a runner nobody has one, and nothing is built.
    runner = build_runner() if building.built(building.RUNNER) else None
    for key in find_keys(checking.read_built_table(runner), arguments.word, arguments.solver):
        print(describe(key))
    print("Parts of a key may be used wherever a key is: vessel.radius, obstacles[0].radius, "
          "wireSections[-1].youngsModulus (-1: the last).", file=sys.stderr)
    return 0


def _view(arguments: argparse.Namespace) -> int:
    from guidewire.viewer.command import view

    return view(arguments.what, arguments.html, arguments.frames, arguments.open, build_runner)


def _site(arguments: argparse.Namespace) -> int:
    from guidewire.viewer.site import write_site

    return write_site(arguments.out, arguments.scenes, arguments.compiled_ahead, build_runner)


def _tasks(arguments: argparse.Namespace) -> int:
    from guidewire.env import command

    return command.run(arguments, build_runner, lambda done, count: tell_frames(done, count, "episode"))


def _anatomy(arguments: argparse.Namespace) -> int:
    from guidewire.anatomy import command

    return command.run(arguments)


def _steer(arguments: argparse.Namespace) -> int:
    from guidewire import navigation

    return navigation.run(arguments, build_runner, hand_to)


def _export(arguments: argparse.Namespace) -> int:
    from guidewire.export import command

    return command.run(arguments)


def _stress(arguments: argparse.Namespace) -> int:
    from guidewire.figures.stress import draw_stress
    from guidewire.logs.stress import read_stress

    return _draw_log(arguments.folder, lambda folder: draw_stress(read_stress(folder)), "stress.png")


def _hub(arguments: argparse.Namespace) -> int:
    from guidewire.figures.hub import draw_hub, draw_hubs
    from guidewire.logs.hub import read_hub, read_hub_curve

    first, *others = arguments.folders
    if arguments.over is None and not others:
        return _draw_log(first, lambda folder: draw_hub(read_hub(folder)), "hub.png")
    over = arguments.over or "time"
    return _draw_log(first, lambda _: draw_hubs([read_hub_curve(one) for one in arguments.folders], over),
                     f"hub-over-{over}.png")


def _compare(arguments: argparse.Namespace) -> int:
    from guidewire.figures.measured import draw_comparison
    from guidewire.logs.measured import compare
    from guidewire.logs.runs import read_run

    def draw(folder: Path) -> Figure:
        found = compare(folder, arguments.measured)
        run = read_run(folder)
        if not run.is_reliable:
            print(f"guidewire: {folder}: the run ended {run.outcome}, and by its summary it is not reliable",
                  file=sys.stderr)
        print(found.summary())
        return draw_comparison(found)

    return _draw_log(arguments.folder, draw, "compare.png")


def _identify(arguments: argparse.Namespace) -> int:
    from guidewire.commands import identify

    return identify.run(arguments)


def _draw_log(folder: Path, draw: Callable[[Path], Figure], name: str) -> int:
    """Draw the log of a run into its folder."""
    from guidewire.logs.logs import LogError

    try:
        figure = draw(folder)
    except LogError as error:
        raise PreparationError(str(error)) from error
    return _save(figure, folder / name)


def _save(figure: Figure, picture: Path) -> int:
    """Write a figure, whole or not at all, and say where it is."""
    picture.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(picture) as partial:
        figure.savefig(partial)
    print(f"picture: {os.path.relpath(picture)}")
    return 0


def _modes(arguments: argparse.Namespace) -> int:
    import numpy as np

    from guidewire.figures.modes import draw_modes

    checking.check_file(arguments.file)
    checking.check_out(arguments.out)
    command = [*build_runner(), "--modes", str(arguments.file), str(arguments.count)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        return code_for_shell(done.returncode)
    modes = json.loads(done.stdout)
    for number, frequency in enumerate(modes["frequencies"], 1):
        print(f"mode {number}: {frequency:.6g} Hz")
    figure = draw_modes(modes["frequencies"], np.asarray(modes["positions"]), np.asarray(modes["shapes"]))
    return _save(figure, arguments.out / f"{arguments.file.stem}-modes.png")


def _mandrel(arguments: argparse.Namespace) -> int:
    checking.check_file(arguments.file)
    places = [repr(place) for place in (arguments.start, arguments.end) if place is not None]
    command = [*build_runner(), "--mandrel", str(arguments.file), repr(math.radians(arguments.angle)), *places]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        return done.returncode
    found = json.loads(done.stdout)
    print(f"mandrel of radius {found['radius']:.4g} units, bent by {math.degrees(found['bent']):.4g} degrees from "
          f"{found['from']:g} to {found['to']:g}: {arguments.angle:g} degrees remain; the core is strained by "
          f"{100.0 * found['strain']:.3g} %")
    print(f'key: "shaped": {{"from": {found["from"]:g}, "to": {found["to"]:g}, "radius": {found["radius"]:.6g}}}')
    return 0


def _instrument(arguments: argparse.Namespace) -> int:
    from guidewire.benches.library import check_name
    from guidewire.commands import instruments, sheet

    checking.check_out(arguments.out)
    made = arguments.like is not None or bool(arguments.members)
    if arguments.name is not None and not made:
        check_name(arguments.name)
    with instruments.opened(build_runner()) as bench:
        if made:
            sheet.write(bench.wire, arguments.name, arguments.like, arguments.members)
        return instruments.show(bench, arguments.name, arguments.out)


def _python(arguments: argparse.Namespace) -> int:
    if not arguments.script.is_file():
        raise PreparationError(f"{arguments.script}: no such file: give a Python script")
    if INSTALLED:
        return hand_to([sys.executable, str(arguments.script), *arguments.words])
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    return hand_to([sys.executable, str(arguments.script), *arguments.words], environment={"PYTHONPATH": path})


def _native(arguments: argparse.Namespace) -> int:
    library = building.build_native(print)
    print(f"native library: {os.path.relpath(library)} ({library.stat().st_size / 1e6:.0f} MB)")
    return 0


def _scenes(arguments: argparse.Namespace) -> int:
    from guidewire.commands import scenes

    if arguments.copy is None:
        print("\n".join(scenes.names()))
        return 0
    checking.check_out(arguments.copy)
    print(f"scenes: {os.path.relpath(scenes.copy(arguments.copy))}")
    return 0


def _unity_check(arguments: argparse.Namespace) -> int:
    options = ["--write-metas"] if arguments.write_metas else []
    return hand_to([sys.executable, "-m", "tools.unitycheck", *options], cwd=ROOT)


_ACTIONS = {
    "run": _run, "sweep": _sweep, "advise": _advise, "plot": _plot, "anatomy": _anatomy, "steer": _steer,
    "keys": _keys, "render": _render, "export": _export, "view": _view, "site": _site, "stress": _stress, "hub": _hub,
    "compare": _compare, "identify": _identify, "modes": _modes, "mandrel": _mandrel,
    "instrument": _instrument, "tasks": _tasks,
    "python": _python, "native": _native,
    "scenes": _scenes, "unity-check": _unity_check,
}
# Commands of the repository alone: the module that executes each, and its function.
_ELSEWHERE = {
    "demo": ("analysis.command", "demo"), "figures": ("analysis.command", "figures"), "test": ("tools.testing", "test"),
    "lint": ("tools.lint", "lint"), "package": ("tools.package", "package"), "bench": ("experiments.overhead", "bench"),
}
_LEFT = {  # of a command that was interrupted
    **dict.fromkeys(("demo", "run", "sweep", "figures", "advise"),
                    "; completed runs are kept, the same command continues from here"),
    **dict.fromkeys(("render", "plot", "stress", "hub", "compare", "modes", "instrument", "package"),
                    "; nothing was written"),
}
