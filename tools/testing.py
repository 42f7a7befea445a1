"""Runs every test of the project and adds up what each test runner itself wrote about its results.

Counts come from result files (TRX, JUnit XML), never from exit codes alone; a runner that left no such file, or an
empty one, did not run and counts as one failure.

Suites run side by side, each as soon as the part of the build that it needs is there. Tests that measure or sleep (the
marker `timed`) are a suite of their own, which runs last and alone.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from guidewire.prepare import ROOT
from guidewire.runs.building import HEADLESS, PARTS, dotnet, end_compiler
from guidewire.runs.process import Process, file_name

RESULTS = ROOT / "results" / "tests"
FULL_CAMPAIGNS = "GUIDEWIRE_ALL"
# The build that Unity compiles has the same sources and runs here on the same runtime as the other. Where campaigns do
# not run in full it makes the tests of what the two do in different ways: how sweeps are made and numbers are written.
BY_TARGET = ("Guidewire.Core.Tests, netstandard2.1",)
# Tests of the solution by the folder that they and their libraries were built into.
_DOTNET = {
    "Guidewire.Core.Tests": "Guidewire.Core.Tests/bin/Release/net10.0/Guidewire.Core.Tests.dll",
    "Guidewire.Unity.Tests": "Guidewire.Unity.Tests/bin/Release/net10.0/Guidewire.Unity.Tests.dll",
    BY_TARGET[0]: "Guidewire.Core.Tests/bin/Release/netstandard2.1/Guidewire.Core.Tests.dll",
}
TESTED = ("guidewire", "analysis", "experiments", "tools")  # folders with tests in Python
# Tests that are suites of their own, so that the rest runs beside them: those of random and checked runs, those that
# mostly wait for processes, pages and workers, and those that need nothing built.
RUNS = ("analysis/tests/test_validation.py", "guidewire/runs/tests/test_random_parameters.py",
        "experiments/tests/test_core_against_reference.py", "experiments/tests/test_random_pushes.py",
        "experiments/tests/test_contact_cases.py", "experiments/tests/test_wide_material.py")
WAITING = ("guidewire/viewer/tests/test_view.py", "guidewire/viewer/tests/test_view_browser.py",
           "guidewire/viewer/tests/test_view_vessel.py", "guidewire/commands/tests/test_endings.py",
           "guidewire/sweeps/tests", "guidewire/runs/tests/test_whole_files.py", "tools/tests/test_testing.py",
           "guidewire/runs/tests/test_building.py", "guidewire/sessions/tests/test_session.py",
           "guidewire/sessions/tests/test_native.py")
NOT_BUILT = ("analysis/tests", "guidewire/anatomy/tests", "guidewire/logs/tests", "guidewire/figures/tests")
_BUILT = ("analysis/tests/test_coaxial_chart.py", "analysis/tests/test_failing_states.py",
          "analysis/tests/test_gallery.py", "analysis/tests/test_rest_states.py", "analysis/tests/test_reversal.py",
          "analysis/tests/test_thesis_numbers.py", "guidewire/logs/tests/test_array_logs.py")    # of those, still
_SUITE_SECONDS = {False: 900, True: 6 * 3600}
_STUCK_SECONDS = 300    # after which a Python test prints the stack of each of its threads
_POLL_SECONDS = 0.05
_NICENESS = 15    # suites give way to builds, for which others wait


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


@dataclass(frozen=True)
class Suite:
    """One test runner.

    Attributes
    ----------
    name : what it is called in the output.
    command : what starts it.
    report : the file in RESULTS that it writes.
    read : how that file is read.
    needs : the part of the build after which it starts; empty where it needs none.
    alone : runs with nothing beside it.
    """

    name: str
    command: Sequence[str]
    report: str
    read: Callable[[Path], Count]
    needs: str = "Tests"
    alone: bool = False


def test(arguments: argparse.Namespace) -> int:
    """`test`."""
    return run_tests(full=arguments.all)


def run_tests(full: bool) -> int:
    """Build, run every suite, print one line for each and the sum last. Returns the exit code.

    Parameters
    ----------
    full : random campaigns in full instead of a seeded fraction.
    """
    RESULTS.mkdir(parents=True, exist_ok=True)
    # Tests start the program some hundred times: its modules are compiled once, whatever the shell says.
    environment = {name: value for name, value in os.environ.items()
                   if name not in (FULL_CAMPAIGNS, "PYTHONDONTWRITEBYTECODE")}
    if full:
        environment[FULL_CAMPAIGNS] = "1"
    program, _ = dotnet()
    builds = {part: [sys.executable, "-m", "guidewire.runs.building", part] for part in PARTS}
    places = (os.cpu_count() or 1) + 1    # one more than processors: a fifth of their time suites wait
    try:
        total = run_suites(builds, suites(program, full), environment, _SUITE_SECONDS[full], places)
    finally:
        end_compiler()
    print(total, flush=True)
    return 0 if total.failed == 0 and total.passed > 0 else 1


def suites(program: str, full: bool) -> list[Suite]:
    """Every suite of the project, in the order in which they start; long ones first, so that none is left over.

    Parameters
    ----------
    program : dotnet.
    full : each with all of its tests.
    """
    not_timed = ["-m", "not timed"]
    timed = [str(path.relative_to(ROOT)) for folder in TESTED for path in sorted((ROOT / folder).rglob("test_*.py"))
             if "pytest.mark.timed" in path.read_text(encoding="utf-8")]
    core, *shorter = (_dotnet_suite(program, name, full) for name in _DOTNET)
    unity = "tools/unitycheck/tests"
    others = [f"--ignore={path}" for path in (*RUNS, *WAITING, *NOT_BUILT, unity)]
    return [
        _pytest_suite("Python, the rest", [*not_timed, *TESTED, *others]),
        _pytest_suite("Python, with logs and figures", [*not_timed, *_BUILT]),
        _pytest_suite("Python, waiting", [*not_timed, *WAITING]),
        core,
        _pytest_suite("Python, nothing built", [*NOT_BUILT, *(f"--ignore={path}" for path in (*RUNS, *_BUILT))], needs=""),
        _pytest_suite("Python, runs", [*not_timed, *RUNS]),
        _pytest_suite(unity, [unity]),
        *shorter,
        _pytest_suite("Python, timed", ["-m", "timed", *timed], alone=True),
    ]


def run_suites(
    builds: Mapping[str, Sequence[str]], suites: Sequence[Suite], environment: Mapping[str, str], seconds: float,
    places: int,
) -> Count:
    """Build and run suites, `places` processes at once, and return the sum of their counts.

    Each has its line in the output, and what it wrote where it failed, when it has ended. A build that fails counts as
    one failure, and so does each suite that needs it or a later part: they do not run.

    Parameters
    ----------
    builds : part of the build to the command that makes it, one after the other in this order.
    suites : started in this order, as far as they may start.
    environment : of every process.
    seconds : how long each may take; then it is killed with the processes that it started.
    places : how many run at once.
    """
    total = Count()
    waiting = list(suites)
    parts = list(builds)    # still to be built, the first one under way
    running: dict[Process, Suite | None] = {}

    def build_next() -> None:
        if parts:
            running[Process(f"build {parts[0]}", builds[parts[0]], environment, RESULTS, seconds)] = None

    build_next()
    try:
        while running:
            for process, suite in [(p, s) for p, s in running.items() if p.has_ended()]:
                del running[process]
                if suite is not None:
                    total += _count(suite, process)
                    continue
                _say(f"build {parts[0]}: {'ok' if process.code == 0 else 'FAILED'} "
                     f"({process.wall:.0f} s, processor {process.processor:.0f} s)")
                if process.code == 0:
                    parts.pop(0)
                    build_next()
                    continue
                _say(process.last_lines())
                missing = [other for other in waiting if other.needs in parts]
                waiting = [other for other in waiting if other.needs not in parts]
                _say("\n".join(f"{other.name}: not run" for other in missing))
                total += Count(failed=1 + len(missing))
            while (suite := _next(waiting, parts, list(running.values()), places)) is not None:
                waiting.remove(suite)
                (RESULTS / suite.report).unlink(missing_ok=True)
                running[Process(suite.name, suite.command, environment, RESULTS, seconds, _NICENESS)] = suite
            time.sleep(_POLL_SECONDS)
    finally:
        for process in running:
            process.kill()
    return total


def _next(
    waiting: Sequence[Suite], parts: Sequence[str], running: Sequence[Suite | None], places: int
) -> Suite | None:
    """The suite that may start now, or None. parts : what is not built."""
    if len(running) >= places or any(suite is not None and suite.alone for suite in running):
        return None
    for suite in waiting:
        if suite.alone:
            if not running and len(waiting) == sum(other.alone for other in waiting):
                return suite
        elif suite.needs not in parts:
            return suite
    return None


def _count(suite: Suite, process: Process) -> Count:
    """The count of a suite that has ended; at least one failure if it did not end well or reports no test."""
    try:
        count = suite.read(RESULTS / suite.report)
        problem = "" if count.passed + count.failed > 0 else "it reports no test"
    except (OSError, ValueError, ElementTree.ParseError) as error:
        count, problem = Count(), f"it left no result ({error})"
    if process.code != 0 and count.failed == 0:
        problem = problem or f"it ended with exit code {process.code}"
    if problem:
        count += Count(failed=1)
    _say(f"{suite.name}: {count} ({process.wall:.0f} s, processor {process.processor:.0f} s)"
         + (f": {problem}" if problem else ""))
    if count.failed:
        _say(process.last_lines())
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
            int(suite.get(name, "0")) for name in ("tests", "failures", "errors", "skipped")
        )
        count += Count(tests - failures - errors - skipped, failures + errors, skipped)
    return count


def _dotnet_suite(program: str, name: str, full: bool) -> Suite:
    report = f"{file_name(name)}.trx"
    command = [program, "test", str(HEADLESS / _DOTNET[name]), "--nologo", "--logger", f"trx;LogFileName={report}",
               "--results-directory", str(RESULTS)]
    if not full and name in BY_TARGET:
        command += ["--filter", "TestCategory=Target&TestCategory!=Long"]
    return Suite(name, command, report, read_trx)


def _pytest_suite(name: str, arguments: Sequence[str], needs: str = "Runner", alone: bool = False) -> Suite:
    report = file_name(name) + ".xml"
    command = [
        sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-o", f"faulthandler_timeout={_STUCK_SECONDS}",
        f"--junitxml={RESULTS / report}", *arguments,
    ]
    return Suite(name, command, report, read_junit, needs, alone)


def _say(text: str) -> None:
    print(text, flush=True)
