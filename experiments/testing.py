"""Runs every test of the project and adds up what each test runner itself wrote about its results.

Counts come from result files (TRX, JUnit XML), never from exit codes alone; a runner that left no such file, or an
empty one, did not run and counts as one failure.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from experiments.prepare import ROOT
from experiments.runner import HEADLESS, dotnet

RESULTS = ROOT / "results" / "tests"
FULL_CAMPAIGNS = "GUIDEWIRE_ALL"
DOTNET_SUITES = ("Guidewire.Core.Tests", "Guidewire.Core.Tests.NetStandard", "Guidewire.Unity.Tests")
_SUITE_SECONDS = {False: 900, True: 6 * 3600}


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
    """One test runner: its command, the file in RESULTS that it writes, and how that file is read."""

    name: str
    command: Sequence[str]
    report: str
    read: Callable[[Path], Count]


def run_tests(full: bool) -> int:
    """Build, run every suite, print one line for each and the sum last. Returns the exit code.

    Parameters
    ----------
    full : random campaigns in full instead of a seeded fraction.
    """
    RESULTS.mkdir(parents=True, exist_ok=True)
    environment = dict(os.environ)
    environment.pop(FULL_CAMPAIGNS, None)
    if full:
        environment[FULL_CAMPAIGNS] = "1"
    program = dotnet()
    solution = [program, "build", "-c", "Release", "--nologo", str(HEADLESS / "Guidewire.sln")]
    built, seconds, log = _execute("build", solution, environment, _SUITE_SECONDS[full])
    _say(f"build: {'ok' if built == 0 else 'FAILED'} ({seconds:.0f} s)")
    total = Count() if built == 0 else Count(failed=1)
    if built != 0:
        _show_end(log)
    for suite in suites(program):
        total += run_suite(suite, environment, _SUITE_SECONDS[full])
    total += check_unity_files(ROOT)
    print(total, flush=True)
    return 0 if total.failed == 0 and total.passed > 0 else 1


def suites(program: str) -> list[Suite]:
    """Every suite of the project, in the order in which they run."""
    return [
        *(_dotnet_suite(program, name) for name in DOTNET_SUITES),
        *(_pytest_suite(folder) for folder in ("experiments/tests", "analysis/tests", "unitycheck/tests")),
    ]


def run_suite(suite: Suite, environment: Mapping[str, str], seconds: float) -> Count:
    """Run one suite and return its count; at least one failure if it did not end well or reports no test."""
    report = RESULTS / suite.report
    report.unlink(missing_ok=True)
    code, took, log = _execute(suite.name, suite.command, environment, seconds)
    try:
        count = suite.read(report)
        problem = "" if count.passed + count.failed > 0 else "it reports no test"
    except (OSError, ValueError, ElementTree.ParseError) as error:
        count, problem = Count(), f"it left no result ({error})"
    if code != 0 and count.failed == 0:
        problem = problem or f"it ended with exit code {code}"
    if problem:
        count += Count(failed=1)
    _say(f"{suite.name}: {count} ({took:.0f} s)" + (f": {problem}" if problem else ""))
    if count.failed:
        _show_end(log)
    return count


def check_unity_files(root: Path) -> Count:
    """The Unity project's files under every family of rules; each family is one check."""
    started = time.monotonic()
    count = Count()
    try:
        from unitycheck import checks
        from unitycheck.project import Project

        project = Project(root)
        for family in checks.MODULES:
            violations = sorted(family.check(project))
            count += Count(failed=1) if violations else Count(passed=1)
            for violation in violations:
                _say(str(violation))
    except Exception as error:  # whatever it is, the check did not run to its end, and the sum has to say so
        _say(f"unity check: it broke off ({type(error).__name__}: {error})")
        count += Count(failed=1)
    _say(f"unity check: {count} ({time.monotonic() - started:.0f} s)")
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


def _dotnet_suite(program: str, name: str) -> Suite:
    report = f"{name}.trx"
    command = [
        program, "test", str(HEADLESS / name / f"{name}.csproj"), "-c", "Release", "--no-build", "--nologo",
        "--logger", f"trx;LogFileName={report}", "--results-directory", str(RESULTS),
    ]
    return Suite(name, command, report, read_trx)


def _pytest_suite(folder: str) -> Suite:
    report = folder.replace("/", "-") + ".xml"
    command = [
        sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--junitxml={RESULTS / report}",
        str(ROOT / folder),
    ]
    return Suite(folder, command, report, read_junit)


def _execute(
    name: str, command: Sequence[str], environment: Mapping[str, str], seconds: float
) -> tuple[int, float, Path]:
    """Run with all output in a log of its own; past the time limit the whole process group is killed."""
    log = RESULTS / (re.sub(r"[^A-Za-z0-9.]+", "-", name) + ".log")
    started = time.monotonic()
    with log.open("wb") as output:
        process = subprocess.Popen(
            command, cwd=ROOT, env=dict(environment), stdin=subprocess.DEVNULL, stdout=output, stderr=output,
            start_new_session=True,
        )
        try:
            code = process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            output.write(f"\nstopped after {seconds:.0f} s\n".encode())
            code = -1
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
    return code, time.monotonic() - started, log


def _show_end(log: Path, lines: int = 60) -> None:
    text = log.read_text(encoding="utf-8", errors="replace").splitlines()
    _say("\n".join([f"--- the last lines of {os.path.relpath(log)}", *text[-lines:], "---"]))


def _say(text: str) -> None:
    print(text, flush=True)
