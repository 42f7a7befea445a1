"""Rows that tests of Core hold against the same references: their figures are what the tests write of themselves."""

from __future__ import annotations

import functools
import os
import re
import subprocess
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from matplotlib.figure import Figure

from guidewire.prepare import PreparationError
from guidewire.runs import building
from guidewire.sweeps.check import Check, Finding, Plan, Result

_ROW = re.compile(r"^row: (.+) \| (\S+) \| (\S+) \| (\S+)$", re.MULTILINE)
_LEAST = 1e-9  # of the picture's axis, error over limit


def read(report: Path) -> tuple[Result, ...]:
    """The rows in a TRX file, each with the name of its test; of several cases of one row the worst."""
    root = ElementTree.parse(report).getroot()
    space = root.tag.partition("}")[0] + "}"
    names = {test.get("id"): str(test.find(f"{space}TestMethod").get("className")).rpartition(".")[2]
             for test in root.iter(f"{space}UnitTest")}
    worst: dict[str, Result] = {}
    for case in root.iter(f"{space}UnitTestResult"):
        for what, *numbers in _ROW.findall(case.findtext(f"{space}Output/{space}StdOut") or ""):
            value, reference, limit = map(float, numbers)
            name = names[case.get("testId")]
            solver = next((word for word in ("explicit", "xpbd", "pbd") if word in what.lower()), "direct")
            row = Result(f"{what} ({name})", solver, value, reference, abs(value - reference), limit,
                         error_in="absolute")
            if what not in worst or not row.error / limit <= worst[what].error / limit:
                worst[what] = row
    return tuple(worst[what] for what in sorted(worst))


@functools.lru_cache(maxsize=None)
def _made() -> tuple[Result, ...]:
    """The rows of a run of these tests alone."""
    building.build_tested(lambda _: None)
    name = building.DOTNET_TESTS[0]
    library = building.HEADLESS / name / "bin" / "Release" / "net10.0" / f"{name}.dll"
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([building.dotnet()[0], "test", str(library), "--nologo", "--filter", "TestCategory=Row",
                               "--logger", "trx;LogFileName=rows.trx", "--results-directory", folder],
                              capture_output=True, text=True, check=False,
                              env={**os.environ, "GUIDEWIRE_ALL": "1"})
        if not (Path(folder) / "rows.trx").is_file():
            raise PreparationError(f"the tests of Core did not run: {(done.stderr or done.stdout).strip()[-200:]}")
        return read(Path(folder) / "rows.trx")


def _tested() -> Plan:
    yield []
    results = _made()

    def draw(figure: Figure) -> None:
        axes = figure.add_subplot()
        classes = [row.what.rpartition("(")[2].rstrip(")") for row in results]
        axes.plot([max(row.error / row.gate, _LEAST) for row in results], classes, "o", fillstyle="none")
        axes.set_xscale("log")
        axes.axvline(1.0, color="0.3", linestyle="--", linewidth=1.0)
        axes.set_xlabel("error over limit (1)")

    return Finding(results, draw, "Error over limit of what tests of Core hold. The tests that the lines name wrote "
                                  "these figures when they ran.", width=12.0)


CHECKS = (Check("tested", "Held by tests of Core", "rows that tests hold", _tested),)
