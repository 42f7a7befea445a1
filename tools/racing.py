"""Repeats the tests that start processes, on a machine that is kept busy: what passes by luck fails here.

    python3 -m tools.racing --times 30
    python3 -m tools.racing guidewire/runs guidewire/sessions --times 30

Beside the tests twice as many programs as there are processors compute without a pause, so that processes start, write
and die in other orders than on an idle machine. The exit code is 1 where a repetition fails.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from guidewire.prepare import ROOT
from tools.testing import PYTEST, PYTHON, read_junit

STARTS = re.compile(r"\b(subprocess|multiprocessing|os\.kill|runner_command|Runner\(|Session\(|serving\(|"
                    r"VectorEnvironment\(|fake\.command)")
_BUSY = "import os; parent = os.getppid()\nwhile os.getppid() == parent: pass"    # not longer than we are there


def racing_files(folders: Sequence[str]) -> list[str]:
    """Files of tests that start processes, relative to the repository."""
    found = [path for folder in folders for path in _tests_in(ROOT / folder)]
    return [str(path.relative_to(ROOT)) for path in dict.fromkeys(found)
            if STARTS.search(path.read_text(encoding="utf-8"))]


def _tests_in(place: Path) -> list[Path]:
    return [place] if place.is_file() else sorted(place.rglob("test_*.py"))


@contextmanager
def busy(count: int) -> Iterator[None]:
    """Keep so many programs computing; they end with us."""
    programs = [subprocess.Popen([sys.executable, "-c", _BUSY]) for _ in range(count)]
    try:
        yield
    finally:
        for program in programs:
            program.kill()
            program.wait()


def repeat(files: Sequence[str], times: int, workers: int) -> int:
    """Run the tests so often, a line each; returns how many repetitions failed."""
    failures = 0
    for number in range(1, times + 1):
        started = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            report = Path(folder) / "report.xml"
            done = subprocess.run([*PYTEST, "-n", str(workers), *files, f"--junitxml={report}"], cwd=ROOT,
                                  stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
            count = str(read_junit(report)) if report.is_file() else "no report"
        is_red = done.returncode != 0
        failures += is_red
        print(f"{number} of {times}: {count} ({time.monotonic() - started:.0f} s)", flush=True)
        if is_red:
            print("\n".join(line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR", "E  "))),
                  flush=True)
    return failures


def main(arguments: Sequence[str]) -> int:
    """Print a line for each repetition and the sum; returns the exit code."""
    parser = argparse.ArgumentParser(prog="racing", description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="*", default=list(PYTHON), help="folders or files of tests (all)")
    parser.add_argument("--times", type=int, default=30, help="repetitions (30)")
    parser.add_argument("--load", type=int, default=2 * (os.cpu_count() or 1), help="programs that compute beside them")
    given = parser.parse_args(arguments)
    files = racing_files(given.folders)
    with busy(given.load):
        failures = repeat(files, given.times, (os.cpu_count() or 1) + 1)
    print(f"{len(files)} files of tests that start processes: {failures} of {given.times} repetitions failed")
    return 1 if failures or not files else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
