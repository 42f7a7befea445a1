"""The commands of guidewire.py: what people type, and what is printed."""

from __future__ import annotations

import argparse
import difflib
import json
import os
import subprocess
import sys
import tempfile
import threading
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from experiments import building, checking
from experiments.arguments import Parser, above_zero, assignment, error_part, finite, path, positive
from experiments.prepare import DRAWING, ROOT, SWEEPING, TESTING, VIEWING, PreparationError
from experiments.runner import INTERNAL_ERROR, INTERRUPTED
from experiments.sweep import FAILED, Bar, Means, SweepResult, sweep
from studies.builtin import STUDIES
from studies.keys import RESULTS
from studies.study_file import LIMIT, StudyFileError, read_study_file
from studies.table import Source, Study

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from experiments.gallery import Gallery  # itself imported only where its packages are there

BEYOND_A_GATE = 1  # all that was asked for is there, and a check is not passed
_RUNS = "runs"  # folder of all runs, in that of the results
_DESCRIPTION = "Simulates guidewires as Cosserat rods, without Unity: runs, sweeps, figures, tests."


def parse(argv: list[str]) -> argparse.Namespace:
    """Read the command line. `packages` of the result names what the command imports, `action` runs it.

    Exits with 2 and one line on stderr where it cannot be read.
    """
    parser = Parser(prog="guidewire.py", description=_DESCRIPTION)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True, parser_class=Parser)

    demo = commands.add_parser("demo", help="build, run the default scene, fit tau, draw Figures 4.1 to 4.4")
    demo.add_argument("--out", type=path, default=Path("results/demo"), help="folder for the run and the pictures")
    demo.set_defaults(action=_demo, packages=DRAWING + SWEEPING)

    test = commands.add_parser("test", help="all tests; the last line says 'N passed, N failed'")
    test.add_argument("--all", action="store_true", help="random campaigns in full instead of a seeded fraction")
    test.set_defaults(action=_test, packages=TESTING)

    run = commands.add_parser("run", help="one run of one parameter file")
    run.add_argument("file", metavar="FILE", type=Path, help="parameter file, such as params/default.json")
    run.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], type=assignment, dest="overrides",
                     help="a parameter laid over the file; may be given several times")
    run.add_argument("--out", type=path, help="folder of the run (results/<name of FILE>); the same run is not made "
                                               "again, and one of other parameters is not replaced")
    run.add_argument("--force", action="store_true",
                     help="replace a complete run that the folder holds, once this one is complete")
    _add_runner(run)
    run.set_defaults(action=_run, packages=())

    sweep = commands.add_parser("sweep", help="a study's runs; what is done already is not run again")
    sweep.add_argument("study", metavar="STUDY", help=f"{', '.join(STUDIES)}; or a study of your own, a JSON file")
    sweep.add_argument("--out", type=path, default=Path("results"), help="folder above the study's (results)")
    sweep.add_argument("--logs", action="store_true", help="every run leaves its log, whatever the study's file says")
    sweep.add_argument("--yes", action="store_true", help="make the runs, however many the study's file asks for")
    _add_workers(sweep)
    _add_runner(sweep)
    sweep.set_defaults(action=_sweep, packages=SWEEPING)

    figures = commands.add_parser("figures", help="the thesis's figures and ours, running what is missing; ends with "
                                                  "1 where a check is beyond its gate")
    figures.add_argument("ids", metavar="ID", nargs="*", help="such as 4.5; all where none is given")
    figures.add_argument("--out", type=path, default=Path("results"),
                         help="folder above the studies' (results); the pictures stand in its 'figures'")
    figures.add_argument("--quick", action="store_true",
                         help="few values of each study and few checks, in 'quick' below the folder: does all work?")
    _add_workers(figures)
    figures.set_defaults(action=_figures, packages=DRAWING + SWEEPING)

    advise = commands.add_parser("advise", help="the cheapest settings of a scene that meet an error, found by running")
    advise.add_argument("file", metavar="SCENE", type=Path, help="parameter file, such as params/insertion.json")
    asked = advise.add_mutually_exclusive_group(required=True)
    asked.add_argument("--error", type=error_part, metavar="E",
                       help="from a finer run, such as 1%% or 0.01: RMS distance over the way that the wire goes, or "
                            "what --of names, over its own size")
    asked.add_argument("--budget", type=above_zero, metavar="MS_PER_STEP",
                       help="wall time that a step may take, ms: the most accurate settings within it")
    advise.add_argument("--of", metavar="QUANTITY", default="position",
                        help="what the error is of: position, tip, hubForce, hubTorque, twist, largestCurvature, "
                             "contactForce, or a number of summary.json such as extremes.axialForce (position)")
    advise.add_argument("--at", choices=("run", "end"), default="run",
                        help="from start to end, or at the end alone (run)")
    advise.add_argument("--chart", action="store_true", help="draw error against cost of the settings: chart.png")
    advise.add_argument("--out", type=path, default=Path("results"),
                        help="folder above that of the runs (results); the file and advice.md stand in advice/SCENE")
    _add_workers(advise)
    advise.set_defaults(action=_advise, packages=DRAWING + SWEEPING)

    render = commands.add_parser("render", help="a picture or a film of a run, with its vessel and obstacles")
    render.add_argument("folder", type=Path, metavar="RUN", help="folder of a run")
    render.add_argument("--out", type=path, metavar="FILE", help="FILE.png or FILE.gif (RUN/render.png)")
    render.add_argument("--times", type=finite, nargs="+", metavar="T", default=[],
                        help="of a .png: these moments, in s, in one picture, a colour each (the last moment, coloured "
                             "by curvature)")
    render.add_argument("--frames", type=positive, default=40, metavar="K", help="of a .gif: pictures at most (40)")
    render.add_argument("--target", type=finite, nargs=3, metavar=("X", "Y", "Z"), help="point in the middle, units")
    render.add_argument("--distance", type=above_zero, metavar="D", help="of the camera from it, units")
    render.add_argument("--yaw", type=finite, default=-90.0, metavar="DEGREES",
                        help="0 looks along z, -90 against x (-90)")
    render.add_argument("--pitch", type=finite, default=15.0, metavar="DEGREES", help="90 looks down, against y (15)")
    render.add_argument("--radius", type=above_zero, metavar="R",
                        help="of the wire in the picture, units (its own, or so much that it is seen)")
    render.set_defaults(action=_render, packages=DRAWING)

    view = commands.add_parser("view", help="a page in the browser: a scene under your hand, or what runs left")
    view.add_argument("what", metavar="FILE|RUN", nargs="+", type=Path,
                      help="parameter file: live; folder of a run: a replay; of two: side by side, or one over the "
                           "other")
    view.add_argument("--html", type=path, metavar="FILE", help="write the replay into one file that needs no server")
    view.add_argument("--frames", type=positive, metavar="K", help="of a run at most (5000; 300 with --html)")
    view.add_argument("--open", action="store_true", help="open the page in a browser")
    view.set_defaults(action=_view, packages=("numpy", *VIEWING))

    stress = commands.add_parser("stress", help="draw what a run's material feels along the wire (logStrains)")
    stress.add_argument("folder", type=Path, metavar="DIR", help="folder of a run with logStrains; takes stress.png")
    stress.set_defaults(action=_stress, packages=DRAWING)

    hub = commands.add_parser("hub", help="draw a run's push, turn, force and torque at the hub over time (logHub)")
    hub.add_argument("folder", type=Path, metavar="DIR", help="folder of a run with logHub; takes hub.png")
    hub.set_defaults(action=_hub, packages=DRAWING)

    modes = commands.add_parser("modes", help="lowest frequencies and shapes of a wire with a material")
    modes.add_argument("file", type=Path, metavar="FILE",
                       help="parameter file; the modes are those about its rest shape")
    modes.add_argument("--count", type=positive, default=6, metavar="K", help="how many (6)")
    modes.add_argument("--out", type=path, default=Path("results"), metavar="DIR",
                       help="takes NAME-modes.png (results)")
    modes.set_defaults(action=_modes, packages=DRAWING)

    python = commands.add_parser("python", help="start a script that imports guidewire, with a Python that has what "
                                                "it needs")
    python.add_argument("script", metavar="SCRIPT", type=Path, help="Python file: 'from guidewire import Session'")
    python.add_argument("words", metavar="...", nargs=argparse.REMAINDER, help="the script's own arguments")
    python.set_defaults(action=_python, packages=DRAWING)

    bench = commands.add_parser("bench", help="what a step costs, part by part, or short runs beside their steps")
    bench.add_argument("--runs", type=positive, metavar="N", help="what N short runs of a sweep cost beside their steps")
    bench.add_argument("--jobs", type=positive, default=os.cpu_count() or 1, metavar="N", help="runs at once")
    bench.set_defaults(action=_bench, packages=SWEEPING)

    check = commands.add_parser("unity-check", help="check the Unity project's files without Unity")
    check.add_argument("--write-metas", action="store_true", help="make the .meta files that are missing")
    check.set_defaults(action=_unity_check, packages=())
    return parser.parse_args(argv)


def run(arguments: argparse.Namespace) -> int:
    """Run a parsed command and return the exit code.

    Raises PreparationError for what a user has to mend. Any other error is the program's own: its trace goes into a
    file, and one line says where.
    """
    try:
        return arguments.action(arguments)
    except KeyboardInterrupt:
        print("guidewire: interrupted; what has ended is kept, the same command goes on from here", file=sys.stderr)
        return INTERRUPTED
    except PreparationError:
        raise
    except Exception as error:
        if isinstance(error, OSError) and error.filename is not None:
            raise PreparationError(f"{error.filename}: {error.strerror}") from error
        trace = Path(tempfile.mkdtemp(prefix="guidewire-")) / "error.txt"
        trace.write_text(traceback.format_exc(), encoding="utf-8")
        print(f"guidewire: internal error ({type(error).__name__}: {error}): please report {trace}", file=sys.stderr)
        return INTERNAL_ERROR


def _demo(arguments: argparse.Namespace) -> int:
    from analysis import figures
    from experiments import gallery

    checking.check_out(arguments.out)
    means = Means(_build_runner(), bar=_bar_of("default"))
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
    return _hand_to(command)


def _sweep(arguments: argparse.Namespace) -> int:
    checking.check_out(arguments.out)
    study = _study_of(arguments)
    means = _means_of(arguments, _runner_of(arguments), study.name, study.file and study.file.parent)
    result = _make([(study, arguments.out)], arguments.out, means)
    print(f"{result.made} runs made, {result.found} there already: "
          f"{os.path.relpath(arguments.out / study.name / RESULTS)}")
    return FAILED if result.failures else 0


def _study_of(arguments: argparse.Namespace) -> Study:
    """The study with this name, or in this file."""
    if arguments.study in STUDIES:
        return STUDIES[arguments.study]
    path = Path(arguments.study)
    if path.suffix != ".json" and not path.is_file():
        near = difflib.get_close_matches(arguments.study, STUDIES, 1)
        hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(STUDIES)}, or a JSON file"
        raise PreparationError(f"there is no study '{arguments.study}': {hint}")
    try:
        study = read_study_file(path, None if arguments.yes else LIMIT)
    except StudyFileError as error:
        raise PreparationError(str(error)) from error
    if study.name in (*STUDIES, _RUNS):
        raise PreparationError(f"{path}: study = \"{study.name}\" is not allowed: another name, that one is ours")
    return replace(study, logs=study.logs or arguments.logs)


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
    from analysis.logs import LogError
    from analysis.validation.check import replay

    checking.check_file(arguments.file)
    checking.check_out(arguments.out)
    wish = plan.Wish(arguments.error, arguments.budget, Quantity(arguments.of, arguments.at))
    check, folder = plan.check_of(arguments.file, wish), plan.folder_of(arguments.out)
    means = _means_of(arguments, _build_runner(), check.name)
    try:
        if _make([(check, folder)], arguments.out, means).failures:
            return FAILED
        advice = replay(check, folder)
    except LogError as error:
        raise PreparationError(f"{arguments.file}: {error}") from error
    place = (folder / check.name).resolve()
    (place / "advice.md").write_text(report.as_markdown(arguments.file.name, wish, advice), encoding="utf-8")
    print(report.verdict(wish, advice))
    print(f"evidence: {os.path.relpath(place / 'advice.md')}")
    if arguments.chart:
        chart.draw_advice(arguments.file.name, wish, advice).savefig(place / "chart.png")
        print(f"picture: {os.path.relpath(place / 'chart.png')}")
    if advice.taken is None:
        return FAILED
    scene = json.loads(arguments.file.read_text(encoding="utf-8-sig"))
    file = place / arguments.file.with_suffix(".json").name
    file.write_text(report.parameters(advice, scene, place), encoding="utf-8")
    print(f"parameter file: {os.path.relpath(file)}")
    return 0


def _tell(drawn: Gallery) -> int:
    for problem in drawn.problems:
        print(f"guidewire: {problem}", file=sys.stderr)
    print(f"pictures and captions: {os.path.relpath(drawn.index)}")
    for line in drawn.failed_gates:
        print(f"guidewire: beyond its gate: {line}", file=sys.stderr)
    if drawn.problems:
        return FAILED
    return BEYOND_A_GATE if drawn.failed_gates else 0


def _render(arguments: argparse.Namespace) -> int:
    from analysis import render
    from analysis.logs import LogError, extent, read_log
    from analysis.runs import read_run
    from experiments import walls

    out = arguments.out or arguments.folder / "render.png"
    if out.suffix not in (".png", ".gif"):
        raise PreparationError(f"--out {out}: a picture's name ends with .png, a film's with .gif")
    if arguments.times and out.suffix == ".gif":
        raise PreparationError(f"--times is for a picture, and {out.name} is a film: leave one of the two out")
    try:
        run = read_run(arguments.folder)
        log = read_log(arguments.folder, "all")
        middle, diagonal = extent(log)
        checking.check_out(out.parent)
        surfaces = walls.read_walls(_build_runner, run, middle, max(diagonal, 1.0))
        view = render.View(tuple(arguments.target) if arguments.target else None, arguments.distance, arguments.yaw,
                           arguments.pitch, arguments.radius)
        out.parent.mkdir(parents=True, exist_ok=True)
        if out.suffix == ".gif":
            render.save_film(render.draw_film(run, log, surfaces, view, arguments.frames), out)
        else:
            render.draw_picture(run, log, surfaces, view, arguments.times).save(out, optimize=True)
    except LogError as error:
        raise PreparationError(str(error)) from error
    if log.warning:
        print(f"guidewire: warning: {log.warning}", file=sys.stderr)
    print(f"{'film' if out.suffix == '.gif' else 'picture'}: {os.path.relpath(out)}")
    return 0


def _view(arguments: argparse.Namespace) -> int:
    from viewer.command import view

    return view(arguments.what, arguments.html, arguments.frames, arguments.open, _build_runner)


def _stress(arguments: argparse.Namespace) -> int:
    from analysis.figures.stress import draw_stress
    from analysis.stress import read_stress

    return _draw_log(arguments.folder, lambda folder: draw_stress(read_stress(folder)), "stress.png")


def _hub(arguments: argparse.Namespace) -> int:
    from analysis.figures.hub import draw_hub
    from analysis.hub import read_hub

    return _draw_log(arguments.folder, lambda folder: draw_hub(read_hub(folder)), "hub.png")


def _draw_log(folder: Path, draw: Callable[[Path], Figure], name: str) -> int:
    """Draw the log of a run into its folder."""
    from analysis.logs import LogError

    try:
        figure = draw(folder)
    except LogError as error:
        raise PreparationError(str(error)) from error
    picture = folder / name
    figure.savefig(picture)
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
    arguments.out.mkdir(parents=True, exist_ok=True)
    picture = arguments.out / f"{arguments.file.stem}-modes.png"
    draw_modes(modes["frequencies"], np.asarray(modes["positions"]), np.asarray(modes["shapes"])).savefig(picture)
    print(f"picture: {os.path.relpath(picture)}")
    return 0


def _python(arguments: argparse.Namespace) -> int:
    if not arguments.script.is_file():
        raise PreparationError(f"{arguments.script}: no such file: give a Python script")
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH")]))
    return _hand_to([sys.executable, str(arguments.script), *arguments.words], environment={"PYTHONPATH": path})


def _bench(arguments: argparse.Namespace) -> int:
    if arguments.runs is None:
        return _hand_to([*_build_benchmarks(), str(ROOT / "params" / "sheath.json")])
    from experiments.overhead import measure

    print(measure(_build_runner(), arguments.runs, arguments.jobs))
    return 0


def _unity_check(arguments: argparse.Namespace) -> int:
    options = ["--write-metas"] if arguments.write_metas else []
    return _hand_to([sys.executable, "-m", "unitycheck", *options], cwd=ROOT)


def _add_workers(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--jobs", type=positive, default=os.cpu_count() or 1, metavar="N",
                        help="untimed runs at once (one per processor); timed ones are made one at a time")
    parser.add_argument("--cluster", metavar="ADDRESS",
                        help="scheduler of dask, such as tcp://host:8786, whose workers make the runs")


def _add_runner(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--runner", choices=("headless", "unity"), default="headless",
                        help="what makes the runs: the console program (default), or Unity in batch mode")
    parser.add_argument("--unity", metavar="PATH", help="Unity editor or player (or the environment's GUIDEWIRE_UNITY)")


def _runner_of(arguments: argparse.Namespace) -> list[str]:
    """The command that makes runs, as `--runner` says."""
    if arguments.runner == "headless":
        return _build_runner()
    from experiments import unity_runner

    unity = unity_runner.find(arguments.unity)
    if unity.is_editor:
        arguments.jobs = 1    # one editor a project folder: it locks it
    return unity_runner.adapter(unity)


def _build_benchmarks() -> list[str]:
    with _seconds_counted() as tell:
        return building.build(building.BENCHMARKS, tell)


def _build_runner() -> list[str]:
    with _seconds_counted() as tell:
        return building.build(building.RUNNER, tell)


@contextmanager
def _seconds_counted() -> Iterator[Callable[[str], None]]:
    """A function that prints a line and, on a terminal, counts the seconds behind it to the end of the block."""
    screen, ended, counters = sys.stderr, threading.Event(), []

    def count(line: str, ended: threading.Event) -> None:
        seconds = 0
        while not ended.wait(1.0):
            seconds += 1
            print(f"\r{line}: {seconds} s", end="", file=screen, flush=True)

    def tell(line: str) -> None:
        nonlocal ended
        if counters:
            finish()
        print(line, end="" if screen.isatty() else "\n", file=screen, flush=True)
        if screen.isatty():
            ended = threading.Event()
            counters.append(threading.Thread(target=count, args=(line, ended), daemon=True))
            counters[-1].start()

    def finish() -> None:
        ended.set()
        counters.pop().join()
        print(file=screen)

    try:
        yield tell
    finally:
        if counters:
            finish()


def _means_of(arguments: argparse.Namespace, command: list[str], name: str, folder: Path | None = None) -> Means:
    """What makes runs, as the command line says."""
    return Means(command, arguments.jobs, arguments.cluster, folder, _build_benchmarks, _bar_of(name))


def _make(asked: Sequence[tuple[Source, Path]], out: Path, means: Means) -> SweepResult:
    """Make the runs that studies or checks ask for and say what failed."""
    result = sweep(asked, out / _RUNS, means)
    for answer in result.failures:
        print(f"guidewire: {answer.name}: {answer.message}", file=sys.stderr)
    return result


def _bar_of(name: str) -> Callable[[int, int, int], Bar]:
    """A bar for each round, with a rate and the time that is left; a line now and then where stderr is no terminal."""
    def bar(number: int, total: int, found: int) -> Bar:
        from tqdm import tqdm

        return tqdm(
            desc=name if number == 1 else f"{name}, round {number}", total=total, initial=found, unit="run",
            mininterval=0.2 if sys.stderr.isatty() else 30.0, dynamic_ncols=True,
        )

    return bar


def _hand_to(command: list[str], cwd: Path | None = None, environment: Mapping[str, str] | None = None) -> int:
    """Run a program on our terminal and return its exit code. Ctrl-C reaches it too: it decides how to end.
    `environment` is laid over ours."""
    process = subprocess.Popen(command, cwd=cwd, env={**os.environ, **(environment or {})})
    while True:
        try:
            code = process.wait()
            return code if code >= 0 else 128 - code
        except KeyboardInterrupt:
            continue
