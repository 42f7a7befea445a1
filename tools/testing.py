"""`test`: builds, runs pytest and `dotnet test` side by side, and adds up what each wrote about its results.

Counts come from result files (JUnit XML, TRX), never from exit codes alone: a runner that left no such file or an empty
one counts as one failure.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from guidewire.installed import has_avx2
from guidewire.prepare import ROOT, PreparationError
from guidewire.runs import building

RESULTS = ROOT / "results" / "tests"
FULL_CAMPAIGNS = "GUIDEWIRE_ALL"
DAY = "GUIDEWIRE_DAY"  # a number that stands for a day: the same one gives the same seeds of random tests
READY = "GUIDEWIRE_READY"  # a file that is there once the runner is built that the tests in Python start
# In this order, so that what needs nothing built runs beside the build, and no long file is left over at the end.
PYTHON = ("guidewire/anatomy", "guidewire/figures", "guidewire/logs", "tools/unitycheck", "guidewire/viewer",
          "guidewire/sessions", "experiments", "analysis", "guidewire", "tools")
# What is [Category("Long")] runs where campaigns run in full. The build that Unity compiles has the same sources and
# runs here on the same runtime as the other. Elsewhere it makes the tests of what the two do in different ways: how
# sweeps are made and numbers are written.
_QUICK = "TestCategory!=Long"
_SECONDS = {False: 1800, True: 2 * 3600}  # for each runner
_LAST_LINES = 60
_TESTED = ("Assets/Guidewire/Tests/Core", "headless/Guidewire.Unity.Tests")    # sources of building.DOTNET_TESTS
PYTEST = (sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-o", "faulthandler_timeout=300")


@dataclass(frozen=True)
class Count:
    """How many tests passed, failed and were skipped."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Count) -> Count:
        return Count(self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped)

    def __str__(self) -> str:
        return f"{self.passed} passed, {self.failed} failed" + (f", {self.skipped} skipped" if self.skipped else "")


def test(arguments: argparse.Namespace) -> int:
    """`test`: prints a line for each runner and the sum last. Returns the exit code."""
    shutil.rmtree(RESULTS, ignore_errors=True)
    RESULTS.mkdir(parents=True)
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)    # tests start the program some hundred times
    os.environ.pop(FULL_CAMPAIGNS, None)
    os.environ[READY] = str(RESULTS / "ready")
    if arguments.all:
        os.environ[FULL_CAMPAIGNS] = "1"
        os.environ.setdefault(DAY, str(date.today().toordinal()))    # one day for all workers, also at midnight
        _say(f"random tests with {DAY}={os.environ[DAY]}")
    if arguments.what:
        del os.environ[READY]    # nothing is built beside them: who needs the runner builds it
        return _part(arguments.what, arguments.all)
    seconds = _SECONDS[arguments.all]
    workers = (os.cpu_count() or 1) + 1    # one more than processors: a part of their time tests wait
    not_built = threading.Event()
    with ThreadPoolExecutor() as threads:
        python = threads.submit(_python, workers, seconds, not_built)
        total = _dotnet(arguments.all, seconds, not_built) + python.result()
    print(total, flush=True)
    return 0 if total.failed == 0 and total.passed > 0 else 1


def _part(words: Sequence[str], full: bool) -> int:
    """Run the tests of some files of Python, and of some classes of C#. Returns the exit code.

    Raises PreparationError for a word that is neither.
    """
    paths = [word for word in words if (ROOT / word.split("::")[0]).exists() and not word.endswith(".cs")]
    classes = [Path(word).stem for word in words if word not in paths]
    sources = {project: folder for project, folder in zip(building.DOTNET_TESTS, _TESTED)}
    found = {project: [name for name in classes if any((ROOT / folder).rglob(f"*{name}*.cs"))]
             for project, folder in sources.items()}
    for name in classes:
        if not any(name in names for names in found.values()):
            raise PreparationError(f"{name}: no file or folder, and no class of tests in {' or '.join(_TESTED)}")
    total = Count()
    if classes:
        try:
            building.build_tested(_say)
        finally:
            building.end_compiler()
    for project, names in found.items():
        if names:
            chosen = "|".join(f"FullyQualifiedName~{name}" for name in names)
            total += run(project, [building.dotnet()[0], "test", str(_library(project)), "--nologo", "--filter",
                                   chosen if full else f"({chosen})&{_QUICK}"], _SECONDS[full])
    if paths:
        total += run("pytest", [*PYTEST, *paths], _SECONDS[full])
    print(total, flush=True)
    return 0 if total.failed == 0 and total.passed > 0 else 1


def _library(project: str, target: str = "net10.0") -> Path:
    return building.HEADLESS / project / "bin" / "Release" / target / f"{project}.dll"


def _python(workers: int, seconds: float, not_built: threading.Event) -> Count:
    """Run pytest. In a new clone one process compiles all that every worker would compile for itself, in 8 s each."""
    if not (ROOT / "__pycache__").is_dir():
        subprocess.run([*PYTEST, "--collect-only", *PYTHON], cwd=ROOT, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
    seed = [f"--hypothesis-seed={os.environ[DAY]}"] if FULL_CAMPAIGNS in os.environ else []
    return run("pytest", [*PYTEST, "-n", str(workers), "--dist", "loadfile", *seed, *PYTHON], seconds, not_built)


def _dotnet(full: bool, seconds: float, not_built: threading.Event) -> Count:
    """Build and run the tests of the solution; a build that fails is one failure."""
    started = time.monotonic()
    try:
        building.build_tested(_say)
    except BaseException as error:
        not_built.set()
        if not isinstance(error, PreparationError):
            raise
        _say(f"build: FAILED: {error}")
        return Count(failed=1)
    finally:
        building.end_compiler()
    _say(f"build: ok ({time.monotonic() - started:.0f} s)")
    native = threading.Thread(target=_build_native)
    native.start()
    total = Count()
    tests = [(name, "net10.0", _QUICK) for name in building.DOTNET_TESTS]
    for name, target, chosen in [*tests, (building.DOTNET_TESTS[0], "netstandard2.1", f"TestCategory=Target&{_QUICK}")]:
        words = [] if full else ["--filter", chosen]
        if target != "net10.0":
            os.environ.pop(FULL_CAMPAIGNS, None)    # once is enough
        total += run(f"{name}-{target}",
                     [building.dotnet()[0], "test", str(_library(name, target)), "--nologo", *words],
                     seconds)
    native.join()
    return total


def _build_native() -> None:
    """Build the runner of machine code where that is possible: tests start a runner some thousand times."""
    try:
        if sys.platform == "linux" and has_avx2():
            building.build_native(_say)
    except PreparationError as error:
        _say(f"the runner compiles while it runs: {error}")
    finally:
        Path(os.environ[READY]).touch()


def run(name: str, command: Sequence[str], seconds: float, stop: threading.Event | None = None) -> Count:
    """Run pytest or `dotnet test`; at least one failure if it did not end well, or reports no test.

    Prints a line, and the last lines of what it wrote where something failed.

    Parameters
    ----------
    name : part of the names of its log and of its report.
    command : what starts it, but for the report.
    seconds : how long it may take.
    stop : set where it has to end at once.
    """
    log, junit, trx = (RESULTS / f"{name}{ending}" for ending in (".log", ".xml", ".trx"))
    read, report, words = (read_junit, junit, [f"--junitxml={junit}"]) if "pytest" in command else (
        read_trx, trx, ["--logger", f"trx;LogFileName={trx.name}", "--results-directory", str(RESULTS)])
    started = time.monotonic()
    with log.open("wb") as output:
        process = subprocess.Popen([*command, *words], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=output, stderr=output)
        while process.poll() is None and time.monotonic() < started + seconds and not (stop and stop.is_set()):
            time.sleep(0.1)
        process.kill()
    try:
        count = read(report)
        problem = "" if count.passed + count.failed > 0 else "it reports no test"
    except (OSError, ValueError, ElementTree.ParseError) as error:
        count, problem = Count(), f"it left no result ({error})"
    if process.wait() != 0 and count.failed == 0:
        problem = problem or f"it ended with exit code {process.returncode}"
    if problem:
        count += Count(failed=1)
    _say(f"{name}: {count} ({time.monotonic() - started:.0f} s)" + (f": {problem}" if problem else ""))
    if count.failed:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
        _say("\n".join([f"--- the last lines of {os.path.relpath(log)}", *lines[-_LAST_LINES:], "---"]))
    return count


def read_trx(path: Path) -> Count:
    """Counts of a TRX file, what `dotnet test` writes."""
    counters = next((e for e in ElementTree.parse(path).iter() if e.tag.endswith("}Counters")), None)
    if counters is None:
        raise ValueError("it has no counters")
    # Whatever ran and did not pass failed: errors, time-outs, aborted and inconclusive tests too.
    total, executed, passed = (int(counters.get(name, "0")) for name in ("total", "executed", "passed"))
    return Count(passed, executed - passed, total - executed)


def read_junit(path: Path) -> Count:
    """Counts of a JUnit XML file, what pytest writes."""
    count = Count()
    for suite in ElementTree.parse(path).iter("testsuite"):
        tests, failures, errors, skipped = (
            int(suite.get(name, "0")) for name in ("tests", "failures", "errors", "skipped"))
        count += Count(tests - failures - errors - skipped, failures + errors, skipped)
    return count


def _say(text: str) -> None:
    print(text, flush=True)
