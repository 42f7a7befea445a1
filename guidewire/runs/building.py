"""Builds programs of the headless solution if their sources have changed.

After a build a stamp says what each program came from and what it is: the content of every file that a build can read,
the .NET SDKs, and size and time of the files written. Where all three are as stamped, nothing is built.

Contents are compared, not times: 600 files take 8 ms. The stamp goes before a build and comes back after it, and only
if no source changed meanwhile, so a build that failed, was killed, or was overtaken by an edit leaves none. What
another builder writes (an editor, `dotnet build`) has another time. MSBuild itself compares times: it overlooks a file
replaced by an older one, and takes an assembly that a killed build left half-written for a whole one. So it may build
upon what is there only if there is a stamp, by the same SDKs, and every changed file is younger; else it compiles all.

One build at a time holds a lock of the operating system's, which ends with the processes that hold it. (Windows has no
such lock in Python; builds at once are not kept apart there.)
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from guidewire import installed
from guidewire.prepare import INSTALLED, ROOT, PreparationError

try:
    import fcntl
except ImportError:
    fcntl = None

HEADLESS = ROOT / "headless"
SDK_MAJOR = 10
RUNNER = "Guidewire.Cli"
CHECKER = "Guidewire.UnityCheck"
BENCHMARKS = "Guidewire.Benchmarks"
NATIVE = "Guidewire.Native"
BROWSER = "Guidewire.Browser"
DOTNET_TESTS = ("Guidewire.Core.Tests", "Guidewire.Unity.Tests")
# What tests need, in the order in which it is built: programs by the part of the solution that makes them.
PARTS = {"Runner": (RUNNER, CHECKER), "Tests": DOTNET_TESTS}

_WRITTEN = ("**/*.dll", "*.so", "*/*.deps.json", "*/*.runtimeconfig.json")
# What dotnet and MSBuild look for in every folder above a project.
_ABOVE = ("global.json", "nuget.config", "NuGet.config", "NuGet.Config", ".editorconfig", ".globalconfig",
          "Directory.Build.props", "Directory.Build.targets", "Directory.Build.rsp", "Directory.Packages.props",
          "Directory.Solution.props", "Directory.Solution.targets")


@dataclass(frozen=True)
class Stamp:
    """What a program was built from and what was written.

    Attributes
    ----------
    sdks : the dotnet program and the SDKs that it lists; with global.json, a source, they settle which one builds.
    sources : path to SHA-256 of its content, for every file that a build can read.
    written : path to size in bytes and time of change in ns, for the program's files.
    finished : when the build had ended, s since 1970.
    """

    sdks: str
    sources: dict[str, str]
    written: dict[str, list[int]]
    finished: float


def build(project: str, tell: Callable[[str], None]) -> list[str]:
    """Build one program of the solution (Release) if need be, and return the command that starts it.

    Parameters
    ----------
    project : its folder below headless.
    tell : called with a line when something is built or waited for.

    Raises
    ------
    PreparationError : with the first compiler error where it does not build; all output is in results/build.log.
    """
    if INSTALLED:
        if project != RUNNER:
            installed.refuse(project)
        return installed.runner()
    program, sdks = dotnet()
    _bring_up_to_date(program, sdks, HEADLESS / project / f"{project}.csproj", (project,), tell)
    return [program, str(_output(project) / f"net{SDK_MAJOR}.0" / f"{project}.dll")]


def build_part(part: str, tell: Callable[[str], None]) -> None:
    """Build the programs of one of PARTS if need be; `tell` and errors as of `build`."""
    program, sdks = dotnet()
    _bring_up_to_date(program, sdks, HEADLESS / f"{part}.slnf", PARTS[part], tell)


def end_compiler() -> None:
    """End the compiler process that `build_part` leaves for further builds, if there is one."""
    program, _ = dotnet()
    subprocess.run([program, "build-server", "shutdown", "--vbcscompiler"], capture_output=True, check=False)


def build_native(tell: Callable[[str], None]) -> Path:
    """Build the native library if need be, with the C compiler's linker; `tell` and errors as of `build`."""
    if shutil.which("gcc") is None and shutil.which("clang") is None:
        raise PreparationError("the native library needs a linker: install gcc and zlib1g-dev")
    program, sdks = dotnet()
    _bring_up_to_date(program, sdks, HEADLESS / NATIVE / f"{NATIVE}.csproj", (NATIVE,), tell, "publish")
    return _output(NATIVE) / f"{NATIVE}.so"


def build_browser(is_compiled_ahead: bool, tell: Callable[[str], None]) -> Path:
    """Build the simulation for browsers if need be; `tell` and errors as of `build`. Compiled ahead, which needs the
    workload wasm-tools, it is built each time.

    Returns
    -------
    The folder of its files.
    """
    program, sdks = dotnet()
    if is_compiled_ahead:
        _stamp_path(BROWSER).unlink(missing_ok=True)
    _bring_up_to_date(program, sdks, HEADLESS / BROWSER / f"{BROWSER}.csproj", (BROWSER,), tell, "publish",
                      *(["-p:CompiledAhead=true"] if is_compiled_ahead else []))
    if is_compiled_ahead:
        _stamp_path(BROWSER).unlink(missing_ok=True)
    return _output(BROWSER) / f"net{SDK_MAJOR}.0" / "publish" / "wwwroot" / "_framework"


def native_library() -> Path | None:
    """The native library where it was built from what is there now; None elsewhere. The package always has one."""
    if INSTALLED:
        return installed.library()
    if not _stamp_path(NATIVE).is_file():
        return None
    return _output(NATIVE) / f"{NATIVE}.so" if _all_hold((NATIVE,), dotnet()[1], _sources()) else None


def dotnet() -> tuple[str, str]:
    """The dotnet program, and a text that tells its SDKs from others.

    Raises PreparationError, one line, where it or a new enough SDK is missing.
    """
    program = shutil.which("dotnet")
    need = f"install the .NET SDK {SDK_MAJOR}.0 or newer so that 'dotnet' is on the PATH"
    if program is None:
        raise PreparationError(f"the .NET SDK is missing: {need}")
    # The host answers this itself, without starting the runtime: 3 ms. `--version` would take 100 ms.
    listed = subprocess.run([program, "--list-sdks"], capture_output=True, text=True, check=False).stdout
    majors = [int(line.split(".")[0]) for line in listed.splitlines() if line.split(".")[0].isdigit()]
    if max(majors, default=0) < SDK_MAJOR:
        found = f"only {max(majors)}.x" if majors else "no SDK, only the runtime or nothing"
        raise PreparationError(f"the .NET SDK is too old ({found} found): {need}")
    return program, f"{os.path.realpath(program)}\n{listed}"


def _bring_up_to_date(
    program: str, sdks: str, target: Path, projects: Sequence[str], tell: Callable[[str], None], verb: str = "build",
    *options: str,
) -> None:
    """Build a project or solution file unless the stamps of all its projects hold."""
    if _all_hold(projects, sdks, _sources()):
        return
    with _lock(tell) as lock:
        sources = _sources()
        if _all_hold(projects, sdks, sources):    # built by whom we waited for
            return
        anew = not all(_may_build_upon(project, sdks, sources) for project in projects)
        for project in projects:
            _stamp_path(project).unlink(missing_ok=True)
        tell(f"building {target.stem}")
        # Analysers judge sources and change no program: `test --all` and a developer's own build run them. One compiler
        # process for many projects is machine code made once.
        command = [program, verb, "-c", "Release", "--nologo", str(target), "-p:RunAnalyzers=false", *options,
                   *(["-p:UseSharedCompilation=true"] if target.suffix == ".slnf" else []),
                   *(["--no-incremental"] if anew and verb == "build" else [])]
        _compile(command, lock, target.stem)
        finished = time.time()
        if _sources() == sources:
            for project in projects:
                _write_stamp(project, Stamp(sdks, sources, _written(project), finished))


def _all_hold(projects: Sequence[str], sdks: str, sources: dict[str, str]) -> bool:
    for project in projects:
        stamp = _read_stamp(project)
        if stamp is None or (stamp.sdks, stamp.sources, stamp.written) != (sdks, sources, _written(project)):
            return False
    return True


def _may_build_upon(project: str, sdks: str, sources: dict[str, str]) -> bool:
    """Whether MSBuild, which goes by times, can see all that changed since the project's stamp; so it can where nothing
    of the project was ever built. (To compile all would replace programs of an earlier part that run already.)"""
    if not any((HEADLESS / project / folder).exists() for folder in ("bin", "obj")):
        return True
    stamp = _read_stamp(project)
    if stamp is None or stamp.sdks != sdks or not stamp.sources.keys() <= sources.keys():
        return False
    changed = [path for path, content in sources.items() if stamp.sources.get(path) != content]
    return all((ROOT / path).stat().st_mtime > stamp.finished for path in changed)


def _sources() -> dict[str, str]:
    """Every file that a build can read, relative to the repository, and the SHA-256 of its content."""
    roots = (HEADLESS, ROOT / "Assets" / "Guidewire")
    above = {folder for root in roots for folder in root.parents}
    paths = [path for root in roots for path in _files_below(root)]
    paths += [str(folder / name) for folder in above for name in _ABOVE]
    digests = {}
    for path in paths:
        try:
            with open(path, "rb") as file:
                digests[os.path.relpath(path, ROOT)] = hashlib.sha256(file.read()).hexdigest()
        except (FileNotFoundError, IsADirectoryError):    # most of those above; a link to nowhere
            continue
    return digests


def _files_below(root: Path) -> Iterator[str]:
    for folder, folders, names in os.walk(root, followlinks=True):
        folders[:] = [name for name in folders if name not in ("bin", "obj")]
        yield from (os.path.join(folder, name) for name in names)


def _output(project: str) -> Path:
    return HEADLESS / project / "bin" / "Release"


def _written(project: str) -> dict[str, list[int]]:
    output = _output(project)
    files = ((path, path.stat()) for pattern in _WRITTEN for path in output.glob(pattern))
    return {str(path.relative_to(output)): [status.st_size, status.st_mtime_ns] for path, status in files}


def _stamp_path(project: str) -> Path:
    return HEADLESS / "obj" / f"{project}.json"


def _read_stamp(project: str) -> Stamp | None:
    try:
        return Stamp(**json.loads(_stamp_path(project).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):    # none, or one of another version of this program
        return None


def _write_stamp(project: str, stamp: Stamp) -> None:
    path = _stamp_path(project)
    partial = path.with_name(path.name + ".partial")
    partial.write_text(json.dumps(asdict(stamp)), encoding="utf-8")
    os.replace(partial, path)


@contextmanager
def _lock(tell: Callable[[str], None]) -> Iterator[int]:
    """Hold the right to build; yields the descriptor of the lock."""
    (HEADLESS / "obj").mkdir(exist_ok=True)
    with (HEADLESS / "obj" / "build.lock").open("w") as file:
        if fcntl is not None:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                tell("waiting for another build to finish")
                fcntl.flock(file, fcntl.LOCK_EX)
        yield file.fileno()


def _compile(command: list[str], lock: int, name: str) -> None:
    """Run the compiler, its output in results/build.log.

    Where we are killed and it goes on, a shell that waits for it goes on holding the lock, as its standard input. The
    compiler itself must not: it leaves servers behind, which would hold it for minutes.

    A compiler that starts anew for each project is machine code made on the run. Counting how often what is called
    where, to compile it better once more, costs a process of some seconds more than it gains.
    """
    log = _log()
    log.parent.mkdir(parents=True, exist_ok=True)
    if os.name != "nt":
        # Without the second command a shell may replace itself by the first, and drop the lock.
        command = ["sh", "-c", '"$@" </dev/null; exit $?', "sh", *command]
    with log.open("wb") as output:
        code = subprocess.run(
            command, cwd=HEADLESS, env={"DOTNET_TieredPGO": "0", **os.environ}, stdin=lock, stdout=output,
            stderr=subprocess.STDOUT, check=False,
        ).returncode
    if code != 0:
        errors = [line.strip() for line in log.read_text("utf-8", "replace").splitlines() if "error" in line]
        first = errors[0] if errors else f"dotnet build ended with {code}"
        raise PreparationError(f"{name} does not build: {first} (log: {os.path.relpath(log)})")


def _log() -> Path:
    return ROOT / "results" / "build.log"


def main() -> int:
    """Build a part, as `python -m guidewire.runs.building PART`; the compiler's output is shown where it fails."""
    try:
        build_part(sys.argv[1], print)
    except PreparationError as error:
        if _log().exists():
            print(_log().read_text("utf-8", "replace"))
        print(error)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
