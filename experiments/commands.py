"""The commands of guidewire.py: their execution and output."""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from experiments import building, checking, command_line, ending, installed, library
from experiments.arguments import value_of
from experiments.prepare import INSTALLED, ROOT, PreparationError
from experiments.process import hand_to
from experiments.progress import bar_of, seconds_counted, tell_frames
from experiments.sweep import FAILED, Means, SweepResult
from experiments.whole_files import whole_file, write_whole
from studies.builtin import STUDIES
from studies.keys import RESULTS
from studies.study_file import LIMIT
from studies.table import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from PIL.Image import Image

    from analysis.logs import PositionLog
    from experiments.gallery import Gallery  # itself imported only where its packages are there

BEYOND_A_GATE = 1  # all that was asked for is there, and a check is not passed


def parse(argv: list[str]) -> argparse.Namespace:
    """Read the command line. `packages` of the result names what the command imports, `action` runs it.

    Exits with 2 and one line on stderr where it cannot be read. Raises PreparationError for a command that only the
    repository has, in the package.
    """
    arguments = command_line.parse(argv)
    if arguments.command in _OF_THE_REPOSITORY:
        installed.refuse(f"'{arguments.command}'")
    arguments.action = _ACTIONS[arguments.command]
    return arguments


def run(arguments: argparse.Namespace) -> int:
    """Run a parsed command and return the exit code.

    Raises PreparationError for what a user has to mend. Any other error is the program's own: its trace goes into a
    file, and one line says where.
    """
    return ending.code_of(arguments.action, arguments, _LEFT.get(arguments.command, ""))


def _demo(arguments: argparse.Namespace) -> int:
    from analysis import figures
    from experiments import gallery

    checking.check_out(arguments.out)
    means = Means(_build_runner(), bar=bar_of("default"))
    if _make([(STUDIES["default"], arguments.out)], arguments.out, means).failures:
        return FAILED
    study = arguments.out / "default"
    ids = [name for name, spec in figures.FIGURES.items() if set(spec.studies) == {"default"}]
    drawn = gallery.draw(ids, {"default": study}, arguments.out)
    for line in gallery.describe_default_run(study):
        print(line)
    return _tell(drawn)


def _test(arguments: argparse.Namespace) -> int:
    from experiments import testing

    return testing.run_tests(full=arguments.all)


def _run(arguments: argparse.Namespace) -> int:
    out = arguments.out or Path("results") / arguments.file.stem
    checking.check_file(arguments.file)
    checking.check_overrides(arguments.overrides)
    checking.check_out(out)
    command = [*_runner_of(arguments), "-parameters", str(arguments.file), "-out", str(out)]
    for key, value in arguments.overrides:
        command += [f"-{key}", value]
    if arguments.force:
        command.append("-force")
    return hand_to(command)


def _sweep(arguments: argparse.Namespace) -> int:
    checking.check_out(arguments.out)
    study = library.find_study(arguments.study, None if arguments.yes else LIMIT)
    study = replace(study, logs=study.logs or arguments.logs)
    means = _means_of(arguments, _runner_of(arguments), study.name, study.file and study.file.parent)
    result = _make([(study, arguments.out)], arguments.out, means)
    print(f"{result.made} runs made, {result.found} there already: "
          f"{os.path.relpath(arguments.out / study.name / RESULTS)}")
    return FAILED if result.failures else 0


def _figures(arguments: argparse.Namespace) -> int:
    from experiments import gallery

    catalogue = gallery.QUICK if arguments.quick else gallery.FULL
    out = arguments.out / "quick" if arguments.quick else arguments.out
    known = catalogue.specs
    unknown = [name for name in arguments.ids if name not in known]
    if unknown:
        raise PreparationError(f"there is no figure {unknown[0]}; there are {', '.join(known)}")
    ids = arguments.ids or list(known)
    needed = {name for figure in ids for name in known[figure].studies}
    checking.check_out(arguments.out)
    means = _means_of(arguments, _build_runner(), "figures")
    asked: list[tuple[Source, Path]] = [(study, out) for name, study in catalogue.studies.items() if name in needed]
    asked += [(check, out / name) for name, checks in catalogue.checked.items() if name in needed for check in checks]
    result = _make(asked, out, means)
    folders = {name: (out / name).resolve() for name in needed}
    code = _tell(gallery.draw(ids, folders, out / "figures", catalogue, arguments.jobs))
    return FAILED if result.failures else code


def _advise(arguments: argparse.Namespace) -> int:
    from analysis.advice import chart, plan, report
    from analysis.advice.quantity import Quantity

    checking.check_file(arguments.file)
    checking.check_overrides(arguments.overrides)
    checking.check_out(arguments.out)
    wish = plan.AdviceRequest(arguments.error, arguments.budget, Quantity(arguments.of, arguments.at))
    overrides = {key: value_of(text) for key, text in arguments.overrides}
    means = _means_of(arguments, _build_runner(), arguments.file.stem)
    result, advice = library.find_advice(arguments.file, wish, overrides, arguments.out, means)
    if advice is None:
        _tell_failures(result)
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


def _tell(drawn: Gallery) -> int:
    for problem in drawn.problems:
        print(f"guidewire: {problem}", file=sys.stderr)
    print(f"pictures and captions: {os.path.relpath(drawn.index)}")
    for line in drawn.failed_gates:
        print(f"guidewire: beyond its limit: {line}", file=sys.stderr)
    if drawn.problems:
        return FAILED
    return BEYOND_A_GATE if drawn.failed_gates else 0


def _render(arguments: argparse.Namespace) -> int:
    from analysis import render
    from analysis.logs import LogError, read_log
    from analysis.runs import read_run
    from experiments import drawn, fluoroscopy, walls

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
        surfaces = walls.read_walls(_build_runner, run, middle, max(diagonal, 1.0))
        yaw, pitch = render.VIEWS[arguments.view] if arguments.view else (-90.0, 15.0)
        others = drawn.instruments_and_sheath(run, log)
        view = render.View(tuple(arguments.target) if arguments.target else None, arguments.distance,
                           yaw if arguments.yaw is None else arguments.yaw,
                           pitch if arguments.pitch is None else arguments.pitch, arguments.radius, arguments.zoom,
                           arguments.follow == "tip")
        if out.suffix == ".gif":
            images = render.draw_film(run, log, surfaces, view, arguments.frames, tell_frames, *others)
        else:
            images = [render.draw_picture(run, log, surfaces, view, arguments.times, *others)]
    except LogError as error:
        raise PreparationError(str(error)) from error
    return _save_render(images, log, out)


def _save_render(images: Sequence[Image], log: PositionLog, out: Path) -> int:
    from analysis.render import save_images

    out.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(out) as partial:
        save_images(images, partial)
    if log.warning:
        print(f"guidewire: warning: {log.warning}", file=sys.stderr)
    print(f"{'film' if out.suffix == '.gif' else 'picture'}: {os.path.relpath(out)}")
    return 0


def _plot(arguments: argparse.Namespace) -> int:
    from analysis.figures.result_table import draw_curves
    from analysis.logs import LogError
    from analysis.result_table import label_of, read_curves

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
    from experiments.key_search import describe, find_keys

    for key in find_keys(checking.read_table(), arguments.word, arguments.solver):
        print(describe(key))
    print("Parts of a key may be used wherever a key is: vessel.radius, obstacles[0].radius, "
          "wireSections[-1].youngsModulus (-1: the last).", file=sys.stderr)
    return 0


def _view(arguments: argparse.Namespace) -> int:
    from viewer.command import view

    return view(arguments.what, arguments.html, arguments.frames, arguments.open, _build_runner)


def _tasks(arguments: argparse.Namespace) -> int:
    from environments import command

    return command.run(arguments, _build_runner)


def _anatomy(arguments: argparse.Namespace) -> int:
    from anatomy import command

    return command.run(arguments)


def _steer(arguments: argparse.Namespace) -> int:
    from experiments import navigation

    return navigation.run(arguments, _build_runner, hand_to)


def _stress(arguments: argparse.Namespace) -> int:
    from analysis.figures.stress import draw_stress
    from analysis.stress import read_stress

    return _draw_log(arguments.folder, lambda folder: draw_stress(read_stress(folder)), "stress.png")


def _hub(arguments: argparse.Namespace) -> int:
    from analysis.figures.hub import draw_hub
    from analysis.hub import read_hub

    return _draw_log(arguments.folder, lambda folder: draw_hub(read_hub(folder)), "hub.png")


def _compare(arguments: argparse.Namespace) -> int:
    from analysis.figures.measured import draw_comparison
    from analysis.measured import compare
    from analysis.runs import read_run

    def draw(folder: Path) -> Figure:
        found = compare(folder, arguments.measured)
        run = read_run(folder)
        if not run.is_reliable:
            print(f"guidewire: {folder}: the run ended {run.outcome}, and by its summary it is not reliable",
                  file=sys.stderr)
        print(found.summary())
        return draw_comparison(found)

    return _draw_log(arguments.folder, draw, "compare.png")


def _draw_log(folder: Path, draw: Callable[[Path], Figure], name: str) -> int:
    """Draw the log of a run into its folder."""
    from analysis.logs import LogError

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

    from analysis.figures.modes import draw_modes

    checking.check_file(arguments.file)
    checking.check_out(arguments.out)
    command = [*_build_runner(), "--modes", str(arguments.file), str(arguments.count)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        return done.returncode
    modes = json.loads(done.stdout)
    for number, frequency in enumerate(modes["frequencies"], 1):
        print(f"mode {number}: {frequency:.6g} Hz")
    figure = draw_modes(modes["frequencies"], np.asarray(modes["positions"]), np.asarray(modes["shapes"]))
    return _save(figure, arguments.out / f"{arguments.file.stem}-modes.png")


def _instrument(arguments: argparse.Namespace) -> int:
    from experiments import instruments

    checking.check_out(arguments.out)
    if arguments.name is not None:
        instruments.check_name(arguments.name)
    with instruments.opened(_build_runner()) as bench:
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


def _package(arguments: argparse.Namespace) -> int:
    from experiments.packaging.command import package

    checking.check_out(arguments.out)
    return package(arguments.kinds, arguments.out)


def _scenes(arguments: argparse.Namespace) -> int:
    from experiments import scenes

    if arguments.copy is None:
        print("\n".join(scenes.names()))
        return 0
    checking.check_out(arguments.copy)
    print(f"scenes: {os.path.relpath(scenes.copy(arguments.copy))}")
    return 0


def _bench(arguments: argparse.Namespace) -> int:
    if arguments.runs is None:
        return hand_to([*_build_benchmarks(), str(ROOT / "params" / "sheath.json")])
    from experiments.overhead import measure

    print(measure(_build_runner(), arguments.runs, arguments.jobs))
    return 0


def _unity_check(arguments: argparse.Namespace) -> int:
    options = ["--write-metas"] if arguments.write_metas else []
    return hand_to([sys.executable, "-m", "unitycheck", *options], cwd=ROOT)


def _runner_of(arguments: argparse.Namespace) -> list[str]:
    """The command that makes runs, as `--runner` says."""
    if arguments.runner == "headless":
        return _build_runner()
    installed.refuse("--runner unity")
    from experiments import unity_runner

    unity = unity_runner.find(arguments.unity)
    if unity.is_editor:
        arguments.jobs = 1    # one editor a project folder: it locks it
    return unity_runner.adapter(unity)


def _build_benchmarks() -> list[str]:
    with seconds_counted() as tell:
        return building.build(building.BENCHMARKS, tell)


def _build_runner() -> list[str]:
    with seconds_counted() as tell:
        return building.build(building.RUNNER, tell)


def _means_of(arguments: argparse.Namespace, command: list[str], name: str, folder: Path | None = None) -> Means:
    """What makes runs, as the command line says."""
    return Means(command, arguments.jobs, arguments.cluster, folder, _build_benchmarks, bar_of(name))


def _make(asked: Sequence[tuple[Source, Path]], out: Path, means: Means) -> SweepResult:
    """Make the runs that studies or checks ask for and say what failed."""
    result = library.make(asked, out, means)
    _tell_failures(result)
    return result


def _tell_failures(result: SweepResult) -> None:
    for answer in result.failures:
        print(f"guidewire: {answer.name}: {answer.message}", file=sys.stderr)


_ACTIONS = {
    "demo": _demo, "test": _test, "run": _run, "sweep": _sweep, "figures": _figures, "advise": _advise,
    "plot": _plot, "anatomy": _anatomy, "steer": _steer, "keys": _keys, "render": _render, "view": _view,
    "stress": _stress, "hub": _hub, "compare": _compare, "modes": _modes, "instrument": _instrument, "tasks": _tasks,
    "python": _python, "native": _native, "package": _package, "scenes": _scenes, "bench": _bench,
    "unity-check": _unity_check,
}
_OF_THE_REPOSITORY = ("test", "native", "package", "bench", "unity-check")
_LEFT = {  # of a command that was interrupted
    **dict.fromkeys(("demo", "run", "sweep", "figures", "advise"),
                    "; completed runs are kept, the same command continues from here"),
    **dict.fromkeys(("render", "plot", "stress", "hub", "compare", "modes", "instrument", "package"), "; nothing was written"),
}
