"""Makes runs with a Unity editor or player instead of the headless runner.

It is started like the headless runner, for one run (``-parameters FILE -out DIR -KEY VALUE ...``) or with ``-lines``
(one JSON request a line, one JSON answer a line), and starts Unity in batch mode once a run. Unity's exit code alone
says little: an editor whose scripts do not compile, or whose licence is missing, may end with 0. A run counts only if
Unity ended with 0 and its summary is whole.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import signal
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from guidewire.prepare import ROOT, PreparationError

VARIABLE = "GUIDEWIRE_UNITY"
ENTRY = "Guidewire.Editor.BatchEntry.Run"
PLAYERS = ("Build/Linux/Guidewire.x86_64", "Build/Windows/Guidewire.exe")
ON_PATH = ("Unity", "unity-editor")
OUTCOMES = {"converged": 0, "finished": 0, "diverged": 4, "failed": 5, "interrupted": 130}
INTERNAL = 70
INTERRUPTED = 130
_SECONDS = 3600.0
_TRACE = "unity.log"
_ALREADY_THERE = "already there: "  # what a run says that takes over an earlier one


@dataclass(frozen=True)
class Unity:
    """A program that makes runs. path: the editor or the player; is_editor: which of the two; seconds: what a run may
    take before it is ended."""

    path: Path
    is_editor: bool
    seconds: float = _SECONDS

    def command(self, log: Path, own: list[str]) -> list[str]:
        """Return the command line of one run; what follows -guidewire is ours."""
        command = [str(self.path), "-batchmode", "-nographics", "-logFile", str(log)]
        if self.is_editor:
            command += ["-projectPath", str(ROOT), "-executeMethod", ENTRY]
        return [*command, "-guidewire", *own]


@dataclass(frozen=True)
class Ending:
    """What became of a run: exit code, the outcome's word or None, one line."""

    code: int
    outcome: str | None
    message: str


def find(given: str | None, seconds: float = _SECONDS) -> Unity:
    """Return the Unity to use: the one given, that of the environment, a player built here, or one on the PATH.

    Raises PreparationError, which names every place where it looked, if there is none.
    """
    named = given or os.environ.get(VARIABLE)
    if named:
        path = Path(named).expanduser()
        if not path.is_file() or not os.access(path, os.X_OK):
            source = "--unity" if given else VARIABLE
            raise PreparationError(f"{source} {named}: no program; give the path of a Unity editor or of a player")
        return Unity(path.resolve(), path.stem.lower() in ("unity", "unity-editor"), seconds)
    for player in PLAYERS:
        if (ROOT / player).is_file():
            return Unity(ROOT / player, False, seconds)
    for name in ON_PATH:
        found = shutil.which(name)
        if found:
            return Unity(Path(found), True, seconds)
    raise PreparationError(f"no Unity: looked at --unity, {VARIABLE}, {', '.join(PLAYERS)}, and for "
                           f"{' and '.join(ON_PATH)} on the PATH")


def adapter(unity: Unity) -> list[str]:
    """Return the command that takes the headless runner's place."""
    # Whatever folder it is started in, it finds this package.
    start = (f"import sys; sys.path.insert(0, {str(ROOT)!r}); "
             "from guidewire.runs import unity_runner; sys.exit(unity_runner.main())")
    return [sys.executable, "-c", start, "--unity", str(unity.path)]


def make_run(unity: Unity, own: list[str], out: Path) -> Ending:
    """Make one run.

    Parameters
    ----------
    unity : the program.
    own : arguments of the run, as the headless runner takes them, paths absolute.
    out : folder of the results; Unity's own log goes there too.
    """
    log = out.with_name(f"{out.name}.{_TRACE}")
    log.parent.mkdir(parents=True, exist_ok=True)
    log.unlink(missing_ok=True)
    summary = out / "summary.json"
    before = summary.stat().st_mtime_ns if summary.is_file() else None
    try:
        process = subprocess.Popen(unity.command(log, own), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, start_new_session=True)
    except OSError as error:
        return Ending(INTERNAL, None, f"{unity.path} does not start: {error.strerror}")
    try:
        code = process.wait(timeout=unity.seconds)
    except subprocess.TimeoutExpired:
        _end(process)
        return Ending(INTERNAL, None, f"Unity did not end within {unity.seconds:g} s and was ended (log: {log})")
    except KeyboardInterrupt:
        _end(process)
        return Ending(INTERRUPTED, "interrupted", "stopped from outside")
    said = _last_word(log)
    after = summary.stat().st_mtime_ns if summary.is_file() else None
    is_taken_over = said.startswith(_ALREADY_THERE)
    outcome = _outcome(summary) if after != before or is_taken_over else None
    if outcome is not None and OUTCOMES.get(outcome) == code:
        if log.is_file():
            log.replace(out / _TRACE)
        return Ending(code, outcome, said or outcome)
    if code in (2, INTERNAL) and said:
        return Ending(code, None, said)
    return Ending(INTERNAL, None, f"Unity ended with {code} and left no whole result that says so (log: {log})")


def _end(process: subprocess.Popen[bytes]) -> None:
    for stop in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, stop)
            process.wait(timeout=20.0)
            return
        except (ProcessLookupError, subprocess.TimeoutExpired):
            continue


def _outcome(summary: Path) -> str | None:
    try:
        found = json.loads(summary.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return str(found.get("outcome")) if isinstance(found, dict) and found.get("complete") is True else None


def _last_word(log: Path) -> str:
    try:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    own = [line.removeprefix("guidewire: ") for line in lines if line.startswith("guidewire: ")]
    return own[-1] if own else ""


def _digest(unity: Unity, request: dict[str, Any]) -> str:
    """Return what a run depends on, as far as can be said without Unity: two texts that mean the same have two
    addresses."""
    parts = [unity.path.resolve(), unity.path.stat().st_mtime_ns,
             Path(request["parameters"]).read_text(encoding="utf-8") if "parameters" in request else "",
             json.dumps(request.get("set", {}), sort_keys=True)]
    if unity.is_editor:
        sources = sorted((ROOT / "Assets/Guidewire").rglob("*.cs"))
        parts += [hashlib.sha256(source.read_bytes()).hexdigest() for source in sources]
    return hashlib.sha256("\n".join(map(str, parts)).encode("utf-8")).hexdigest()


def answer(unity: Unity, line: str) -> dict[str, Any]:
    """Return the answer to one request line; never raises for what the request says."""
    reply: dict[str, Any] = {"id": None, "exitCode": 2, "outcome": None, "message": "", "out": None}
    try:
        request = json.loads(line)
        reply["id"] = request["id"]
        if request.get("check"):
            return {**reply, "exitCode": 0, "address": _digest(unity, request)[:32], "version": f"Unity {unity.path}"}
        out = Path(request["out"]).resolve()
        reply["out"] = str(out)
        own = ["-parameters", str(Path(request["parameters"]).resolve()), "-out", str(out)]
        for key, value in request.get("set", {}).items():
            own += [f"-{key}", value if isinstance(value, str) else json.dumps(value)]
        if request.get("repeat") is not None:
            own += ["-repeat", str(request["repeat"])]
        own.append("-force")    # the folder is this run's own: what is asked for again is replaced
    except (ValueError, KeyError, TypeError, AttributeError, OSError) as error:
        reply["message"] = f"the request cannot be read: {type(error).__name__}: {error}"
        return reply
    ending = make_run(unity, own, out)
    reply.update(exitCode=ending.code, outcome=ending.outcome, message=ending.message)
    return reply


def _one_run(unity: Unity, own: list[str]) -> int:
    absolute = list(own)
    for key in ("-parameters", "-out"):
        if key in absolute[:-1]:
            place = absolute.index(key) + 1
            absolute[place] = str(Path(absolute[place]).resolve())
    if "-out" not in absolute[:-1]:
        print("guidewire: no folder for the results: give -out DIR", file=sys.stderr)
        return 2
    out = Path(absolute[absolute.index("-out") + 1])
    ending = make_run(unity, absolute, out)
    print(ending.message if ending.code == 0 else f"guidewire: {ending.message}",
          file=sys.stdout if ending.code == 0 else sys.stderr)
    return ending.code


def main(arguments: list[str] | None = None) -> int:
    """Return the command line of the module."""
    parser = argparse.ArgumentParser(prog="guidewire.runs.unity_runner", allow_abbrev=False)
    parser.add_argument("--unity", help=f"path of a Unity editor or player (or {VARIABLE})")
    parser.add_argument("--seconds", type=float, default=_SECONDS, help="the time limit of a run")
    options, own = parser.parse_known_args(arguments)
    try:
        unity = find(options.unity, options.seconds)
    except PreparationError as error:
        print(f"guidewire: {error}", file=sys.stderr)
        return 2
    if own != ["-lines", "-attached"]:
        return _one_run(unity, own)
    try:
        for line in sys.stdin:
            if line.strip():
                print(json.dumps(answer(unity, line)), flush=True)
    except KeyboardInterrupt:
        return INTERRUPTED
    return 0


if __name__ == "__main__":
    sys.exit(main())
