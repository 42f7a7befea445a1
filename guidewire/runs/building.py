"""Builds programs of the headless solution if their sources have changed.

After a build a stamp holds one digest of all that it came from and of what it wrote: the content of every file that a
build can read, the .NET SDKs, and size and time of the programs' files. Where it is the same, nothing is built;
contents are compared, not times, because 600 files take 8 ms. It goes before a build and comes back after it, and only
if no source changed meanwhile, so that a build that failed, was killed, or was overtaken by an edit leaves none.

MSBuild goes by times: it takes an assembly that a killed build left half-written for a whole one, and overlooks a file
replaced by an older one. So without a stamp, or with such a file, all is compiled anew.

One build at a time holds a lock of the operating system's. (Windows has no such lock in Python; builds at once are not
kept apart there.)
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
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
BENCHMARKS = "Guidewire.Benchmarks"
NATIVE = "Guidewire.Native"
BROWSER = "Guidewire.Browser"
DOTNET_TESTS = ("Guidewire.Core.Tests", "Guidewire.Unity.Tests")
TESTED = (RUNNER, *DOTNET_TESTS)  # what tests need: Tests.slnf
_WRITTEN = ("**/*.dll", "*.so", "*/*.deps.json", "*/*.runtimeconfig.json")


def build(project: str, tell: Callable[[str], None]) -> list[str]:
    """Build one program of the solution (Release) if need be, and return the command that starts it. The runner is the
    native one where that was built from what is there now: it compiles nothing while it runs.

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
    if project == RUNNER and _native_runner().is_file() and native_library() and installed.has_avx2():
        return [str(_native_runner())]
    program, sdks = dotnet()
    _bring_up_to_date(program, sdks, HEADLESS / project / f"{project}.csproj", (project,), tell)
    return [program, str(_output(project) / f"net{SDK_MAJOR}.0" / f"{project}.dll")]


def built(project: str) -> list[str] | None:
    """Return the command of a program of the repository that was built, be it of what is there now or not, or None."""
    program = _output(project) / f"net{SDK_MAJOR}.0" / f"{project}.dll"
    return ["dotnet", str(program)] if program.is_file() and not INSTALLED else None


def build_tested(tell: Callable[[str], None]) -> None:
    """Build what tests need at once, if need be; `tell` and errors as of `build`."""
    _bring_up_to_date(*dotnet(), HEADLESS / "Tests.slnf", TESTED, tell)


def end_compiler() -> None:
    """End the compiler process that `build_tested` leaves for further builds, if there is one."""
    subprocess.run([dotnet()[0], "build-server", "shutdown", "--vbcscompiler"], capture_output=True, check=False)


def build_native(tell: Callable[[str], None]) -> Path:
    """Build the native library and the runner that starts it if need be, with the C compiler's linker; `tell` and
    errors as of `build`."""
    if shutil.which("gcc") is None and shutil.which("clang") is None:
        raise PreparationError("the native library needs a linker: install gcc and zlib1g-dev")
    _bring_up_to_date(*dotnet(), HEADLESS / NATIVE / f"{NATIVE}.csproj", (NATIVE,), tell, "publish")
    library, runner = _output(NATIVE) / f"{NATIVE}.so", _native_runner()
    if not runner.is_file():
        runner.parent.mkdir(exist_ok=True)
        (runner.parent / installed.LIBRARY[True]).symlink_to(Path("..") / library.name)
        link_runner(runner)
    return library


def link_runner(runner: Path) -> None:
    """Compile the program that hands its arguments to the native library beside it."""
    done = subprocess.run([shutil.which("gcc") or "clang", "-O2", "-Wall", "-Wextra", "-Werror", "-s", "-o",
                           str(runner),
                           str(HEADLESS / NATIVE / "runner.c"), "-ldl"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise PreparationError(f"the native runner is not built: {(done.stderr.splitlines() or ['no message'])[0]}")


def build_browser(is_compiled_ahead: bool, tell: Callable[[str], None]) -> Path:
    """Build the simulation for browsers if need be; `tell` and errors as of `build`. Compiled ahead, which needs the
    workload wasm-tools, it is built each time.

    Returns
    -------
    The folder of its files.
    """
    if is_compiled_ahead:
        _stamp(BROWSER).unlink(missing_ok=True)
    _bring_up_to_date(*dotnet(), HEADLESS / BROWSER / f"{BROWSER}.csproj", (BROWSER,), tell, "publish",
                      *(["-p:CompiledAhead=true"] if is_compiled_ahead else []))
    if is_compiled_ahead:
        _stamp(BROWSER).unlink(missing_ok=True)
    return _output(BROWSER) / f"net{SDK_MAJOR}.0" / "publish" / "wwwroot" / "_framework"


def native_library() -> Path | None:
    """Return the native library where it was built from what is there now; None elsewhere. The package always has
    one."""
    if INSTALLED:
        return installed.library()
    if not _stamp(NATIVE).is_file():
        return None
    return _output(NATIVE) / f"{NATIVE}.so" if _hold((NATIVE,), _sources(dotnet()[1])) else None


def dotnet() -> tuple[str, str]:
    """Return the dotnet program, and a text that tells its SDKs from others.

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
    if _hold(projects, _sources(sdks)):
        return
    with _lock(tell):
        sources = _sources(sdks)
        if _hold(projects, sources):    # built by whom we waited for
            return
        anew = any(_is_beyond_msbuild(project) for project in projects)
        for project in projects:
            _stamp(project).unlink(missing_ok=True)
        tell(f"building {target.stem}")
        # Analysers judge sources and change no program: `test --all` and a developer's own build run them. One compiler
        # process for many projects is machine code made once.
        _compile([program, verb, "-c", "Release", "--nologo", str(target), "-p:RunAnalyzers=false", *options,
                  *(["-p:UseSharedCompilation=true"] if target.suffix == ".slnf" else []),
                  *(["--no-incremental"] if anew and verb == "build" else [])], target.stem)
        if _sources(sdks) == sources:
            for project in projects:
                _stamp(project).write_text(_digest(project, sources), encoding="utf-8")


def _hold(projects: Sequence[str], sources: str) -> bool:
    return all(_stamp(project).is_file() and _stamp(project).read_text(encoding="utf-8") == _digest(project, sources)
               for project in projects)


def _is_beyond_msbuild(project: str) -> bool:
    """Return whether MSBuild may take what is there for current although it is not. Where nothing of the project was
    built it cannot (and to compile all would replace programs of an earlier part that run already)."""
    if not any((HEADLESS / project / folder).exists() for folder in ("bin", "obj")):
        return False
    if not _stamp(project).is_file():
        return True
    stamped = _stamp(project).stat().st_mtime
    return any(status.st_mtime < stamped < status.st_ctime for status in map(os.stat, _files()))


def _sources(sdks: str) -> str:
    """Return a digest of the SDKs and of the content of every file that a build can read."""
    digest = hashlib.sha256(sdks.encode())
    for path in sorted(_files()):
        with open(path, "rb") as file:
            digest.update(f"{os.path.relpath(path, ROOT)}\n".encode() + hashlib.sha256(file.read()).digest())
    return digest.hexdigest()


def _files() -> Iterator[str]:
    yield from (str(path) for path in ROOT.glob("*.*") if path.suffix in (".props", ".targets", ".config", ".rsp")
                or path.name in ("global.json", ".editorconfig", ".globalconfig"))
    for root in (HEADLESS, ROOT / "Assets" / "Guidewire"):
        for folder, folders, names in os.walk(root, followlinks=True):
            folders[:] = [name for name in folders if name not in ("bin", "obj")]
            # Files of Unity's own no build reads, and an editor may have left a link to nowhere.
            paths = (os.path.join(folder, name) for name in names if not name.endswith(".meta"))
            yield from filter(os.path.isfile, paths)


def _digest(project: str, sources: str) -> str:
    """Return what the stamp of a project holds: its sources, and size and time of each file that was written."""
    files = sorted(path for pattern in _WRITTEN for path in _output(project).glob(pattern))
    written = [(str(path), path.stat().st_size, path.stat().st_mtime_ns) for path in files]
    return hashlib.sha256(f"{sources}{written}".encode()).hexdigest()


def _native_runner() -> Path:
    return _output(NATIVE) / "runner" / installed.RUNNER


def _output(project: str) -> Path:
    return HEADLESS / project / "bin" / "Release"


def _stamp(project: str) -> Path:
    return HEADLESS / "obj" / f"{project}.stamp"


@contextmanager
def _lock(tell: Callable[[str], None]) -> Iterator[None]:
    """Hold the right to build."""
    (HEADLESS / "obj").mkdir(exist_ok=True)
    with (HEADLESS / "obj" / "build.lock").open("w") as file:
        if fcntl is not None:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                tell("waiting for another build to finish")
                fcntl.flock(file, fcntl.LOCK_EX)
        yield


def _compile(command: list[str], name: str) -> None:
    """Run the compiler, its output in results/build.log.

    A compiler that starts anew for each project is machine code made on the run. Counting how often what is called
    where, to compile it better once more, costs a process of some seconds more than it gains.
    """
    log = ROOT / "results" / "build.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("wb") as output:
        code = subprocess.run(command, cwd=HEADLESS, env={"DOTNET_TieredPGO": "0", **os.environ},
                              stdin=subprocess.DEVNULL,
                              stdout=output, stderr=subprocess.STDOUT, check=False).returncode
    if code != 0:
        errors = [line.strip() for line in log.read_text("utf-8", "replace").splitlines() if "error" in line]
        first = errors[0] if errors else f"dotnet build ended with {code}"
        raise PreparationError(f"{name} does not build: {first} (log: {os.path.relpath(log)})")
