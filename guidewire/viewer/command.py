"""`guidewire.py view`: its arguments, and what the page is given."""

from __future__ import annotations

import os
import sys
import webbrowser
from collections.abc import Callable, Sequence
from pathlib import Path

from guidewire.anatomy.formats import is_anatomy
from guidewire.logs.hub import read_hub_curve, runs_in
from guidewire.logs.logs import LogError, extent, read_log
from guidewire.logs.runs import PARAMETERS_NAME, read_run
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import checking
from guidewire.runs.key_table import read_key_table
from guidewire.runs.whole_files import write_whole
from guidewire.sessions.session import SessionError, session_of
from guidewire.viewer.anatomy import read_vessel
from guidewire.viewer.export import to_html
from guidewire.viewer.held import SteeredCalls
from guidewire.viewer.live import LiveRun
from guidewire.viewer.parts import three
from guidewire.viewer.recording import read_recording
from guidewire.viewer.server import Server, page_files

MOST_RUNS = 2
FRAMES_OF_A_FILE = 300
FRAMES_SERVED = 5000


def view(what: Sequence[Path], html: Path | None, frames: int | None, opens: bool,
         build_runner: Callable[[], list[str]]) -> int:
    """Show runs that have ended, a run that goes on, or a vessel; or write runs into one file.

    Parameters
    ----------
    what : a parameter file, or a mesh, mask or centreline, or folders of one run or two.
    html : the file to write in place of serving.
    frames : of a run at most; None: as many as go well.
    opens : whether the page is opened in a browser.
    build_runner : returns the command that starts the runner.

    Raises
    ------
    PreparationError : with one line, where something cannot be shown.
    """
    if is_anatomy(what[0]):
        if len(what) > 1 or html is not None or frames is not None:
            raise PreparationError("view takes one vessel alone: --html and --frames are for folders of runs")
        vessel = read_vessel(what[0])
        files = page_files(three(_say))
        return _serve(Server({**files, "index.html": files["anatomy.html"]}, [vessel.to_bytes()], None, vessel.choose),
                      opens)
    is_live = not what[0].is_dir()
    if len(what) > (1 if is_live else MOST_RUNS):
        raise PreparationError("view takes one parameter file, or the folders of one run or two")
    if is_live:
        checking.check_file(what[0])
        if html is not None or frames is not None:
            raise PreparationError("--html and --frames are for folders of runs: make one with 'run', and give its "
                                   "folder")
    elif html is not None:
        checking.check_out(html.parent)
        if html.suffix != ".html" or html.is_dir():
            raise PreparationError(f"--html {html}: a page's name ends with .html")
    files = page_files(three(_say))
    if is_live:
        return _serve(Server(files, (), _live(what[0], build_runner)), opens)
    try:
        most = frames or (FRAMES_SERVED if html is None else FRAMES_OF_A_FILE)
        recordings = [_read(folder, most, html is None) for folder in what]
    except LogError as error:
        raise PreparationError(str(error)) from error
    if html is None:
        return _serve(Server(files, recordings, None), opens)
    html.parent.mkdir(parents=True, exist_ok=True)
    write_whole(html, to_html(files, recordings))
    print(f"page: {os.path.relpath(html)} ({html.stat().st_size / 1e6:.1f} MB)")
    return 0


def _read(folder: Path, frames: int, exact: bool) -> bytes:
    own, *others = runs_in(folder)    # of a study the first one
    run = read_run(own)
    curve = read_hub_curve(folder) if others and run.parameters.get("logHub") else None
    middle, diagonal = extent(read_log(own, "all"))
    try:
        with session_of(own / PARAMETERS_NAME, native=False) as session:
            described, surfaces = session.describe(), session.walls(middle, max(diagonal, 1.0))
            return read_recording(run, surfaces, frames, described, session.places, curve).to_bytes(exact)
    except SessionError as error:    # its parameters cannot be used any more
        if run.parameters.get("vessel") or run.parameters.get("obstacles"):
            raise PreparationError(str(error)) from error
        _say(f"no fluoroscopy of {folder.name}: {error}")
    return read_recording(run, [], frames, {}, lambda _: [], curve).to_bytes(exact)


def serve_scene(file: Path, build_runner: Callable[[], list[str]], calls: SteeredCalls, opens: bool) -> None:
    """Show one scene, interactively, and take down how it is steered."""
    _serve(Server(page_files(three(_say)), (), _live(file, build_runner, calls)), opens)


def _live(file: Path, build_runner: Callable[[], list[str]], calls: SteeredCalls | None = None) -> LiveRun:
    command = build_runner()
    keys = read_key_table(command)
    own = {} if calls is not None else {path.name: path for path in sorted((ROOT / "params").glob("*.json"))}
    first = file.name if own.get(file.name, file).resolve() == file.resolve() else str(file)
    run = LiveRun({first: file, **own}, first, {name: list(key.words) for name, key in keys.items() if key.words},
                  calls)
    try:
        run.open()
    except SessionError as error:
        raise PreparationError(str(error)) from error
    return run


def _serve(server: Server, opens: bool) -> int:
    def ready(address: str) -> None:
        print(f"open {address} (Ctrl-C ends it)", flush=True)
        if opens:
            webbrowser.open(address)

    server.run(ready)
    return 0


def _say(line: str) -> None:
    print(f"guidewire: {line}", file=sys.stderr, flush=True)
