"""The command line of guidewire.py: its commands, their arguments and help."""

from __future__ import annotations

import argparse
import os
import re
from pathlib import Path

from guidewire.anatomy.formats import is_anatomy, is_dicom
from guidewire.commands.arguments import (
    Commands, above_zero, assignment, box, ends, error_part, finite, is_list_of_ends, path, positive, seed,
)
from guidewire.installed import version
from guidewire.prepare import ANATOMY, DICOM, DRAWING, INSTALLED, PACKAGING, SWEEPING, TESTING, VIEWING

# Commands by task, as --help lists them.
GROUPS = {
    "start": ("demo", "scenes", "keys", "run", "view"),
    "study": ("sweep", "figures", "advise", "compare", "identify"),
    "look": ("render", "export", "site", "plot", "hub", "stress", "modes", "mandrel"),
    "vessel": ("anatomy", "steer"),
    "instruments": ("instrument",),
    "train": ("tasks",),
    "develop": ("python", "test", "lint", "bench", "native", "package", "unity-check"),
}
# refused in the package
OF_THE_REPOSITORY = ("demo", "figures", "test", "lint", "bench", "native", "package", "site", "unity-check")


def parse(argv: list[str]) -> argparse.Namespace:
    """Read the command line. `command` of the result is the command's name, `packages` what it imports.

    Exits with 2 and one line on stderr where it cannot be read.
    """
    commands = Commands(prog="guidewire" if INSTALLED else "guidewire.py", version=f"guidewire {version()}",
                        groups=GROUPS, hidden=OF_THE_REPOSITORY if INSTALLED else ())

    demo = commands.add_parser("demo", help="the thesis's default run with Figures 4.1 to 4.4, and the film of a "
                                            "wire that enters a branch")
    demo.add_argument("--out", type=path, default=Path("results/demo"), help="folder for the run and the pictures")
    demo.set_defaults(packages=DRAWING + SWEEPING)

    test = commands.add_parser("test", help="all tests, or those named; the last line says 'N passed, N failed'")
    test.add_argument("what", metavar="PATH", nargs="*", help="file or folder of tests in Python, or a class or file "
                                                              "of tests in C#, such as guidewire/logs SheathTests")
    test.add_argument("--all", action="store_true", help="random campaigns in full instead of a seeded fraction")
    test.set_defaults(packages=TESTING)

    lint = commands.add_parser("lint", help="what ruff, the C# compiler and eslint find in the code")
    lint.set_defaults(packages=())

    run = commands.add_parser("run", help="one run of one parameter file")
    run.add_argument("file", metavar="FILE", type=Path, help="parameter file, such as params/default.json")
    _add_overrides(run)
    run.add_argument("--out", type=path, help="folder of the run (results/<name of FILE>); a complete run there is not "
                                               "repeated, nor replaced by one with other parameters")
    run.add_argument("--force", action="store_true",
                     help="replace a complete run that the folder holds, once this one is complete")
    run.add_argument("--check", action="store_true",
                     help="repeat the run with half the time step; the differences go into check.md, and the exit "
                          "code is 6 where the result does not hold")
    run.add_argument("--elements", action="store_true", help="with --check: also with twice the elements")
    _add_runner(run)
    run.set_defaults(packages=())

    sweep = commands.add_parser("sweep", help="the runs of a study; completed runs are not repeated")
    sweep.add_argument("study", metavar="STUDY", help=f"{_studies() if 'sweep' in argv else ''}; or a study of your "
                                                      "own, a JSON file")
    sweep.add_argument("--out", type=path, default=Path("results"), help="parent of the study's folder (results)")
    sweep.add_argument("--logs", action="store_true", help="write the log of every run, whatever the study's file says")
    sweep.add_argument("--yes", action="store_true", help="make the runs even if there are more than 100,000")
    _add_workers(sweep)
    _add_runner(sweep)
    sweep.set_defaults(packages=SWEEPING)

    figures = commands.add_parser("figures", help="draw the figures of the thesis and of this project, making "
                                                  "missing runs; exit code 1 if a check exceeds its limit")
    figures.add_argument("ids", metavar="ID", nargs="*", help="such as 4.5; default: all")
    figures.add_argument("--out", type=path, default=Path("results"),
                         help="parent of the studies' folders (results); pictures are written to its 'figures'")
    figures.add_argument("--quick", action="store_true",
                         help="few values of each study and few checks, into its subfolder 'quick', as a smoke test")
    _add_workers(figures)
    figures.set_defaults(packages=DRAWING + SWEEPING)

    advise = commands.add_parser("advise", help="find the cheapest settings of a scene for a given error")
    advise.add_argument("file", metavar="SCENE", type=Path, help="parameter file, such as params/insertion.json")
    _add_overrides(advise)
    asked = advise.add_mutually_exclusive_group(required=True)
    asked.add_argument("--error", type=error_part, metavar="E",
                       help="largest error against a finer run, such as 1%% or 0.01: RMS distance over the wire's "
                            "displacement, or relative error of the quantity given by --of")
    asked.add_argument("--budget", type=above_zero, metavar="MS_PER_STEP",
                       help="largest wall time of a step, ms: find the most accurate settings within it")
    advise.add_argument("--of", metavar="QUANTITY", default="position",
                        help="quantity of the error: position, tip, hubForce, hubTorque, twist, largestCurvature, "
                             "contactForce, or a number of summary.json such as extremes.axialForce (position)")
    advise.add_argument("--at", choices=("run", "end"), default="run",
                        help="over the whole run, or at the end only (run)")
    advise.add_argument("--chart", action="store_true", help="draw error against cost of the settings: chart.png")
    advise.add_argument("--out", type=path, default=Path("results"),
                        help="parent of the runs' folders (results); the file and advice.md go to advice/SCENE")
    _add_workers(advise)
    advise.set_defaults(packages=DRAWING + SWEEPING)

    render = commands.add_parser("render", help="picture or film of a run, with its vessel and obstacles")
    render.add_argument("folder", type=Path, metavar="RUN", help="folder of a run")
    render.add_argument("--out", type=path, metavar="FILE", help="FILE.png or FILE.gif (RUN/render.png)")
    render.add_argument("--times", type=finite, nargs="+", metavar="T", default=[],
                        help="of a .png: times in s, drawn in one picture, one colour each (default: the end, coloured "
                             "by curvature)")
    render.add_argument("--frames", type=positive, default=40, metavar="K", help="of a .gif: largest number of "
                                                                                 "frames (40)")
    middle = render.add_mutually_exclusive_group()
    middle.add_argument("--target", type=finite, nargs=3, metavar=("X", "Y", "Z"), help="point at the centre, units")
    middle.add_argument("--follow", choices=("tip",), help="keep the tip at the centre, at four times the zoom")
    render.add_argument("--zoom", type=above_zero, metavar="F", help="zoom factor")
    render.add_argument("--view", choices=("side", "front", "top", "back"),
                        help="instead of --yaw and --pitch: along -x, along z, along -y, or along x")
    render.add_argument("--distance", type=above_zero, metavar="D", help="of the camera from the target, units")
    render.add_argument("--yaw", type=finite, metavar="DEGREES", help="0 looks along z, -90 along -x (-90)")
    render.add_argument("--pitch", type=finite, metavar="DEGREES", help="90 looks down, along -y (15)")
    render.add_argument("--radius", type=above_zero, metavar="R",
                        help="radius of the drawn wire, units (the true one, or larger where it would not be visible)")
    fluoroscopy = render.add_argument_group("fluoroscopy", "an X-ray picture, or film, in place of the drawn one")
    fluoroscopy.add_argument("--fluoroscopy", action="store_true", help="as a C-arm sees it")
    fluoroscopy.add_argument("--lao", type=finite, metavar="DEGREES", help="left anterior oblique, RAO is negative (0)")
    fluoroscopy.add_argument("--cranial", type=finite, metavar="DEGREES", help="caudal is negative (0)")
    fluoroscopy.add_argument("--field", type=above_zero, metavar="MM", help="side of the picture (the whole vessel)")
    fluoroscopy.add_argument("--vessel", choices=("roadmap", "contrast", "none"), help="how the vessel is shown "
                                                                                       "(roadmap)")
    fluoroscopy.add_argument("--inject", type=finite, nargs=3, metavar=("S", "ML", "ML/S"),
                             help="contrast agent where the "
                             "blood comes in, from a time on; the vessel needs a centreline (vessel.anatomy)")
    fluoroscopy.add_argument("--subtract", action="store_true", help="what has changed since the first picture")
    fluoroscopy.add_argument("--road-map", action="store_true", help="of the injection, when half of it is gone")
    fluoroscopy.add_argument("--pixels", type=positive, metavar="N", help="of a side (512)")
    fluoroscopy.add_argument("--noise", type=finite, metavar="F", help="standard deviation of the noise over "
                                                                       "brightness (0.03)")
    fluoroscopy.add_argument("--blur", type=finite, metavar="MM", help="standard deviation of the focal spot (0.15)")
    render.set_defaults(packages=DRAWING)

    export = commands.add_parser("export", help="a run for ParaView, 3D Slicer, tables, Omniverse and Blender")
    export.add_argument("folder", type=Path, metavar="RUN", help="folder of a run")
    export.add_argument("--out", type=path, metavar="DIR", help="folder of the files (RUN/export)")
    export.add_argument("--axes", metavar="XYZ", help="where x, y and z point in the patient, such as RAS (LPS)")
    export.add_argument("--frames", type=positive, metavar="K", help="largest number of moments (all that were logged)")
    export.set_defaults(packages=("numpy", "scipy"))

    _add_anatomy(commands)

    steer = commands.add_parser("steer", help="find a drive that brings a wire to its target in a vessel, and run it")
    steer.add_argument("file", metavar="SCENE", type=Path, help="scene.json that 'anatomy' wrote")
    steer.add_argument("--out", type=path, metavar="DIR", help="folder of the run (results/<folder of SCENE>-steered)")
    steer.add_argument("--attempts", type=positive, default=200, metavar="N",
                       help="largest number of failed attempts with each tip (200)")
    steer.add_argument("--any-inlet", action="store_true",
                       help="try the other ends of the vessel as inlets as well, the widest first")
    steer.add_argument("--minutes", type=above_zero, default=30.0, metavar="M",
                       help="time after which it gives up at the next failed attempt (30)")
    steer.set_defaults(packages=("numpy", "scipy"))

    view = commands.add_parser("view", help="in the browser: open a scene interactively, replay one or two runs, or "
                                              "look at a vessel")
    view.add_argument("what", metavar="FILE|RUN", nargs="+", type=Path,
                      help="a parameter file: interactive; folder of a run: replay; two folders: side by side or "
                           "superimposed; a mesh, mask or centreline: its ends and defects, a click on an end makes "
                           "it the inlet")
    view.add_argument("--html", type=path, metavar="FILE", help="write the replay into a self-contained file")
    view.add_argument("--frames", type=positive, metavar="K", help="largest number of frames (5000; 300 with --html)")
    view.add_argument("--open", action="store_true", help="open the page in a browser")
    view.set_defaults(packages=("numpy", *VIEWING))

    site = commands.add_parser("site", help="the page with the simulation in it, as a folder for any web server: "
                                            "scenes "
                                              "are steered in a browser, with nothing to install")
    site.add_argument("out", metavar="OUT", type=path, help="folder: a new one, or that of an earlier site")
    site.add_argument("scenes", metavar="SCENE", nargs="*", type=Path,
                      help="parameter files (without them those scenes of params that have a vessel and are steered)")
    site.add_argument("--compiled-ahead", action="store_true",
                      help="compile the simulation ahead, for speed (needs the .NET workload wasm-tools)")
    site.set_defaults(packages=(*DRAWING, *VIEWING))

    plot = commands.add_parser("plot", help="plot a quantity of a study's runs against one of its parameters")
    plot.add_argument("table", metavar="TABLE", type=Path, help="runs.csv of a study, or the study's folder")
    plot.add_argument("--x", required=True, metavar="KEY", help="parameter, or any column of the table")
    plot.add_argument("--y", required=True, metavar="QUANTITY",
                      help="any column, such as hub.force, extremes.axialForce (the peak of the run), "
                           "largestContactForce, hub.tipPosition[2]; the last part of the name will do if unique")
    plot.add_argument("--by", metavar="KEY", help="parameter shown by colour")
    plot.add_argument("--log", choices=("x", "y", "xy"), default="", help="logarithmic axes")
    plot.add_argument("--out", type=path, metavar="FILE", help="FILE.png (QUANTITY-over-KEY.png beside the table)")
    plot.set_defaults(packages=DRAWING)

    keys = commands.add_parser("keys", help="list the keys of parameter files, --set and axes of studies")
    keys.add_argument("word", metavar="WORD", nargs="?", default="",
                      help="only keys related to it, such as friction")
    keys.add_argument("--solver", choices=("pbd", "xpbd", "direct", "explicit"), default="",
                      help="only keys that this solver takes")
    keys.set_defaults(packages=())

    stress = commands.add_parser("stress", help="plot stresses and strains along the wire of a run (logStrains)")
    stress.add_argument("folder", type=Path, metavar="DIR", help="folder of a run with logStrains, for stress.png too")
    stress.set_defaults(packages=DRAWING)

    hub = commands.add_parser("hub", help="plot insertion, rotation, force and torque at the hub (logHub), or those of "
                                          "several runs in one picture")
    hub.add_argument("folders", type=Path, metavar="DIR", nargs="+",
                     help="folder of a run with logHub, for hub.png too; several, or a study's: one picture, with a "
                          "band where a run has a check, or a study several runs")
    hub.add_argument("--over", choices=("time", "insertion", "turn"), help="what the forces are drawn over (time)")
    hub.set_defaults(packages=DRAWING)

    compare = commands.add_parser("compare", help="draw a run beside a measured force of the hub or shape of the wire")
    compare.add_argument("folder", type=Path, metavar="RUN", help="folder of a run, for compare.png too")
    compare.add_argument("measured", type=Path, metavar="MEASURED",
                         help="CSV file with the first line time,force (s, N; the run needs logHub) or time,x,y,z (s, "
                              "units: points of the centreline, those of one shape with the same time)")
    compare.set_defaults(packages=DRAWING)

    identify = commands.add_parser("identify", help="find values of a scene, such as EI, from measured shapes, "
                                                    "pictures or forces")
    identify.add_argument("file", type=Path, metavar="SCENE", help="parameter file; the search starts from its values")
    identify.add_argument("--measured", type=Path, metavar="FILE", nargs="+", required=True,
                          help="CSV files whose first line is x,y,z or x,y (units, or x_mm ...), view,u,v (pixels), "
                               "insertion,force or turn,torque (m, rad, N, N m), each of them with time before it, or "
                               "critical KEY")
    identify.add_argument("--fit", metavar="KEY", action="append", required=True,
                          help="key, or part of a key, that is sought; may be given several times")
    identify.add_argument("--align", choices=("none", "plane", "rigid"), default="none",
                          help="frame of the measured points: the scene's (none), shifted and turned within its plane, "
                               "or in space")
    identify.add_argument("--camera", type=Path, metavar="FILE", help="JSON object of views, each a matrix of 3 x "
                                                                      "4 that takes units to pixels")
    identify.add_argument("--bounds", metavar="KEY=LOW,HIGH", action="append", default=[],
                          help="range of a value (that of the key)")
    identify.add_argument("--out", type=path, metavar="DIR", help="folder of the results (results/SCENE-identified)")
    identify.add_argument("--jobs", type=positive, metavar="N", help="runs at once (one a processor)")
    _add_overrides(identify)
    identify.set_defaults(packages=DRAWING)

    mandrel = commands.add_parser("mandrel", help="the mandrel over which a wire's core keeps a bend of an angle")
    mandrel.add_argument("file", type=Path, metavar="FILE", help="parameter file of a wire whose core yields")
    mandrel.add_argument("--angle", type=above_zero, default=45.0, metavar="A", help="that remains, degrees (45)")
    mandrel.add_argument("--from", dest="start", type=float, metavar="X", help="where the bend begins, units from the "
                         "hub, with --to (the last 7 to 2 units)")
    mandrel.add_argument("--to", dest="end", type=float, metavar="X", help="where it ends")

    modes = commands.add_parser("modes", help="lowest natural frequencies and mode shapes of a wire with a material")
    modes.add_argument("file", type=Path, metavar="FILE",
                       help="parameter file; the modes are about its rest shape")
    modes.add_argument("--count", type=positive, default=6, metavar="K", help="number of modes (6)")
    modes.add_argument("--out", type=path, default=Path("results"), metavar="DIR",
                       help="folder for NAME-modes.png (results)")
    modes.set_defaults(packages=DRAWING)

    instrument = commands.add_parser("instrument", help="all instruments, or one: sources of its numbers, bench tests, "
                                                        "picture; exit code 1 if an error exceeds its limit")
    instrument.add_argument("name", metavar="NAME", nargs="?", help="such as amplatz-super-stiff-0.035")
    instrument.add_argument("--like", metavar="OTHER", help="make instruments/NAME.json here, of another one and what "
                                                            "--set states")
    instrument.add_argument("--set", dest="members", action="append", default=[], type=assignment,
                            metavar="MEMBER=VALUE", help="with --like: of its data sheet, such as tipLoad=2 (g), "
                                                         "\"tipLength=3 cm\" or \"coreDiameter=0.4 mm\"; repeatable")
    instrument.add_argument("--out", type=path, default=Path("results/instruments"), metavar="DIR",
                            help="folder for NAME.png (results/instruments)")
    instrument.set_defaults(packages=DRAWING)

    tasks = commands.add_parser("tasks", help="tasks to train on: list them, score a policy, steer one by hand")
    tasks.add_argument("task", metavar="TASK", nargs="?", help="name, or a scene.json with anatomy and target")
    tasks.add_argument("--policy", metavar="NAME",
                       help="policy that steers: retry, random, or MODULE:NAME, a callable of the environment (retry)")
    tasks.add_argument("--benchmark", action="store_true", help="the table of a tier's tasks, with seeds that stay the "
                                                                "same and intervals of 95 %%")
    tasks.add_argument("--tier", choices=("dev", "train", "test"), default="dev",
                       help="tasks of the benchmark; those of test have vessels that nothing is trained on (dev)")
    tasks.add_argument("--results", type=path, metavar="FILE", help="results of the benchmark, for others to check")
    tasks.add_argument("--submitted", type=Path, nargs="+", metavar="FILE",
                       help="check results files, and print their table")
    tasks.add_argument("--episodes", type=positive, default=50, metavar="N", help="number of episodes (50)")
    tasks.add_argument("--seed", type=positive, metavar="S", help="seed of the first episode; the next has S + 1 (1); "
                                                                  "without it --record by hand has the nominal one")
    tasks.add_argument("--jobs", type=positive, default=1, metavar="N", help="number of parallel environments (1)")
    by_hand = tasks.add_mutually_exclusive_group()
    by_hand.add_argument("--record", type=path, metavar="FILE",
                         help="open the page of the task, and save the steering when the command ends (Ctrl-C); with "
                              "--policy save the episodes in which that reaches the target safely")
    by_hand.add_argument("--replay", type=Path, metavar="FILE", help="repeat recorded episodes")
    tasks.add_argument("--export", type=path, metavar="PATH",
                       help="with --replay: write observations, actions and rewards, to a file .npz or to a folder as "
                            "Minari has it")
    tasks.add_argument("--open", action="store_true", help="open the page in a browser")
    tasks.set_defaults(packages=(*DRAWING, *VIEWING))

    python = commands.add_parser("python", help="run a script that imports guidewire, with a Python that has the "
                                                "packages it needs")
    python.add_argument("script", metavar="SCRIPT", type=Path, help="Python file: 'from guidewire import Session'")
    python.add_argument("words", metavar="...", nargs=argparse.REMAINDER, help="the script's own arguments")
    python.set_defaults(packages=DRAWING)

    native = commands.add_parser("native", help="build the native library and runner (needs gcc), which compile "
                                                "nothing while they run")
    native.set_defaults(packages=())

    package = commands.add_parser("package", help="build the Python wheel and the NuGet packages (needs gcc)")
    package.add_argument("kinds", metavar="KIND", nargs="*", choices=("wheel", "nuget", []),
                         help="wheel or nuget; default: both")
    package.add_argument("--out", type=path, default=Path("dist"), metavar="DIR", help="folder of the files (dist)")
    package.set_defaults(packages=PACKAGING)

    scenes = commands.add_parser("scenes", help="list the scenes that come with the program, or copy them")
    scenes.add_argument("--copy", type=path, metavar="DIR", help="copy them into DIR/params")
    scenes.set_defaults(packages=())

    bench = commands.add_parser("bench", help="cost of a step, part by part, or overhead of short runs")
    bench.add_argument("--runs", type=positive, metavar="N",
                       help="overhead of N short runs of a sweep, beyond their steps")
    bench.add_argument("--jobs", type=positive, default=os.cpu_count() or 1, metavar="N", help="simultaneous runs")
    bench.set_defaults(packages=SWEEPING)

    check = commands.add_parser("unity-check", help="check the Unity project's files without Unity")
    check.add_argument("--write-metas", action="store_true", help="create missing .meta files")
    check.set_defaults(packages=())
    arguments = commands.parse(_with_points(_with_all_ends(argv)))
    if arguments.command == "view" and is_anatomy(arguments.what[0]):
        arguments.packages = (*arguments.packages, *ANATOMY, *_for_slices(arguments.what[0]))
    if arguments.command == "anatomy" and arguments.file is not None:
        arguments.packages = (*arguments.packages, *_for_slices(arguments.file))
    if arguments.command == "test" and arguments.all:    # elsewhere what needs more than most users have is skipped
        arguments.packages = (*arguments.packages, *ANATOMY, *DICOM)
    return arguments


def _for_slices(file: Path) -> tuple[str, ...]:
    return DICOM if is_dicom(file) else ()


def _studies() -> str:
    from guidewire.studies.builtin import STUDIES

    return ", ".join(STUDIES)


def _with_all_ends(argv: list[str]) -> list[str]:
    """Words in which --open of 'anatomy' without numbers says "all", so that the word behind it may be a file."""
    return ["--open=all" if argv[0] == "anatomy" and word == "--open"
            and not is_list_of_ends("".join(argv[k + 1:k + 2]))
            else word for k, word in enumerate(argv)]


def _with_points(argv: list[str]) -> list[str]:
    """Words in which a point that begins with a minus stands behind an equals sign, so that it is no option."""
    words: list[str] = []
    for word in argv:
        if argv[0] == "anatomy" and words[-1:] in (["--box"], ["--seed"]) and re.match(r"-[\d.]", word):
            words[-1] += f"={word}"
        else:
            words.append(word)
    return words


def _add_overrides(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], type=assignment, dest="overrides",
                        help="override a parameter of the file; may be given several times")


def _add_anatomy(commands: Commands) -> None:
    anatomy = commands.add_parser("anatomy", help="a vessel from a mesh, a segmentation or a centreline, or one "
                                                  "generated: inspected, repaired, with its centreline and a scene")
    source = anatomy.add_mutually_exclusive_group(required=True)
    source.add_argument("file", metavar="FILE", type=Path, nargs="?",
                        help=".stl, .obj, .ply, .vtp; voxels .nii, .nii.gz, .nrrd, .mha, .vti, or a folder of DICOM "
                             "slices; centrelines .csv, .vtp, .mrk.json")
    source.add_argument("--make", choices=("arch", "iliac", "siphon", "coronary"), help="make a vessel instead")
    anatomy.add_argument("--type", type=positive, default=1, metavar="K", help="of the arch: 1, 2 or 3 (1)")
    anatomy.add_argument("--seed", type=seed, metavar="N", help="of what is made (1); of voxels X,Y,Z, a point in the "
                                                                 "region that is taken, in the vessel's axes, mm")
    anatomy.add_argument("--stenosis", type=above_zero, metavar="F", help="made with a stenosis that leaves F of the "
                                                                          "diameter, such as 0.4")
    anatomy.add_argument("--aneurysm", type=above_zero, metavar="F", help="made with an aneurysm of F diameters")
    anatomy.add_argument("--out", type=path, help="folder of the results (results/anatomy/<name of FILE>)")
    anatomy.add_argument("--look", action="store_true", help="report and picture only")
    anatomy.add_argument("--open", nargs="?", const="all", metavar="ENDS", type=ends,
                         help="open closed ends: all, or those with these numbers, such as 1,3")
    anatomy.add_argument("--force", action="store_true", help="write into a folder that has another file's vessel")
    anatomy.add_argument("--unit", choices=("mm", "cm", "m"), help="unit of the coordinates (guessed from the sizes)")
    anatomy.add_argument("--axes", metavar="XYZ", help="where x, y and z of the file point in the patient, such as RAS "
                                                       "(as the file says)")
    anatomy.add_argument("--series", metavar="N", help="of a folder of DICOM slices: number in the list, or "
                                                       "description")
    taken = anatomy.add_mutually_exclusive_group()
    taken.add_argument("--label", metavar="N", help="of a mask: values of the vessel's voxels, or their names, such as "
                                                    "1,2")
    anatomy.add_argument("--label-names", type=path, metavar="FILE", help="names of labels: .json, or .csv with the "
                                                                          "columns value and name")
    taken.add_argument("--segment", metavar="NAME", help="of a .seg.nrrd: segments of 3D Slicer, such as "
                                                         "Aorta,Iliacs")
    taken.add_argument("--threshold", type=finite, metavar="T", help="of an image: the vessel is above T")
    anatomy.add_argument("--region", type=positive, metavar="K",
                         help="among the voxels of --label or --threshold: the K-th largest connected region "
                              "(default 1)")
    anatomy.add_argument("--box", type=box, metavar="X,Y,Z,X,Y,Z", help="two corners: voxels outside are left out, in "
                                                                         "the vessel's axes, mm")
    anatomy.add_argument("--error", type=above_zero, metavar="MM", help="of a mask: largest displacement by decimation "
                                                                        "(a tenth of a voxel)")
    anatomy.add_argument("--cycle", nargs="+", type=path, metavar="FILE",
                         help="the vessel at later phases, evenly spaced over a cycle of which FILE is the first: it "
                              "moves")
    anatomy.add_argument("--inlet", metavar="END", help="number or name of the end that the wire starts at (1)")
    anatomy.add_argument("--target", metavar="END",
                         help="number or name of the end that it is pushed to (of those about as far as the "
                              "farthest, the "
                         "one with the widest path)")
    anatomy.add_argument("--wire", type=above_zero, default=0.36, metavar="MM", help="diameter of the wire (0.36)")
    anatomy.add_argument("--instrument", metavar="NAME", help="wire of the library (one of 0.36 mm with a bent tip)")
    anatomy.add_argument("--catheter", metavar="NAME", help="catheter of the library over it")
    anatomy.set_defaults(packages=ANATOMY)


def _add_workers(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--jobs", type=positive, default=os.cpu_count() or 1, metavar="N",
                        help="simultaneous untimed runs (one per processor); timed runs are made one at a time")
    parser.add_argument("--cluster", metavar="ADDRESS",
                        help="dask scheduler, such as tcp://host:8786, whose workers make the runs")


def _add_runner(parser: argparse.ArgumentParser) -> None:
    def of_the_repository(text: str) -> str:
        return argparse.SUPPRESS if INSTALLED else text

    parser.add_argument("--runner", choices=("headless", "unity"), default="headless", help=of_the_repository(
        "program that makes the runs: the console program (default), or Unity in batch mode"))
    parser.add_argument("--unity", metavar="PATH", help=of_the_repository(
        "Unity editor or player (or the environment's GUIDEWIRE_UNITY)"))
