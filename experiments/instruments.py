"""`guidewire.py instrument`: a table of all instruments, or one with its bench tests."""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from analysis.instruments import benches, bent_tube, elastica
from analysis.instruments.library import FOLDER, Stated, find_files, read_stated
from analysis.instruments.wire import Wire, wire_of
from experiments.prepare import ROOT, PreparationError
from experiments.runner import Request, Runner
from experiments.whole_files import whole_file

BEYOND_A_GATE = 1
GATE = 0.01  # of EI, GJ and the tip load
_GAUGE = 0.02  # m of the tip that is free of the clamp in the test of its load
_DEFLECTION = 0.005  # m
_BARE = {"solver": "direct", "proximalEnd": "clamped", "maxSimulationSteps": 0}


@dataclass(frozen=True)
class Line:
    """A line of the bench tests: the figure, what it is compared with, and the relative error; nan without one."""

    test: str
    value: float
    unit: str
    expected: float = math.nan
    error: float = math.nan

    @property
    def passed(self) -> bool:
        """Whether the error, if there is one, is within the gate."""
        return math.isnan(self.expected) or abs(self.error) <= GATE


class Bench:
    """Makes the runs of bench tests in a folder, with one runner."""

    def __init__(self, runner: Runner, folder: Path) -> None:
        self._runner = runner
        self._folder = folder
        self._count = 0

    def make(self, parameters: Mapping[str, Any]) -> Path:
        """The folder of a run. Raises PreparationError with the runner's line where it cannot be made."""
        self._count += 1
        out = self._folder / str(self._count)
        answer = self._runner.run(Request(out.name, None, out, dict(parameters)))
        if answer.exit_code != 0:
            raise PreparationError(answer.message.removeprefix("command line: "))
        return out

    def wire(self, name: str) -> Wire:
        """An instrument as it is simulated."""
        folder = self.make({**_BARE, "instrument": name})
        return wire_of(json.loads((folder / "parameters.json").read_text(encoding="utf-8")))

    def stiffness(self, wire: Wire) -> Iterator[Line]:
        """Three-point bending of the shaft and of the taper, torque of the shaft, load of the tip."""
        span = benches.span_of(wire)
        places = {"three-point bending, shaft": 0.0,
                  "three-point bending, taper": min(wire.shaft + 0.1 * span, wire.straight - 1.2 * span)}
        for test, start in places.items():
            bent = benches.read_three_point(self.make(benches.three_point(wire, start)))
            expected = benches.expected_stiffness(wire, start, bent.arms)
            if start == 0.0 or expected < (1.0 - GATE) * wire.bending[0]:  # else it has no straight taper
                yield _compared(test, bent.stiffness, "N m2", expected)
        torsional = benches.read_torque(self.make(benches.torque(wire)))
        yield _compared("torque test, GJ", torsional, "N m2", wire.torsional[0])
        load = elastica.load_at(wire, _GAUGE, _DEFLECTION)
        tip = benches.read_tip(self.make(benches.tip_load(wire, _GAUGE, load.force)))
        reached = float(tip[0] - elastica.rest_tip(wire, _GAUGE)[0])
        expected = elastica.load_at(wire, _GAUGE, reached).force
        yield _compared(f"tip load at {1e3 * reached:.3g} mm, {1e3 * _GAUGE:.0f} mm free", load.force, "N", expected)

    def tube(self, name: str, friction: float | None) -> bent_tube.TubeTest:
        """The test in the bent tube."""
        drive = self._folder / "drive.csv"
        bent_tube.write_drive(drive)
        return bent_tube.read_tube(self.make(bent_tube.bent_tube({"instrument": name}, drive, friction)))


@contextmanager
def opened(command: Sequence[str]) -> Iterator[Bench]:
    """A bench whose runs are forgotten at the end."""
    runner = Runner(command)
    try:
        with tempfile.TemporaryDirectory() as folder:
            yield Bench(runner, Path(folder))
    finally:
        runner.close()


def files() -> dict[str, Path]:
    """Name to file: the current folder's instruments first, then the program's."""
    return find_files([Path.cwd() / FOLDER, ROOT / FOLDER])


def show(bench: Bench, name: str, out: Path) -> int:
    """Print what an instrument's file states and its bench tests, and draw it; 1 where a gate is not passed."""
    from analysis.figures.instrument import draw_instrument

    wire = bench.wire(name)
    print("\n".join(stated_lines(read_stated(files()[name]))))
    tube, smooth = bench.tube(name, None), bench.tube(name, 0.0)
    results = [*bench.stiffness(wire), *tube_lines(tube, smooth)]
    print("\n".join(bench_lines(results)))
    out.mkdir(parents=True, exist_ok=True)
    picture = out / f"{name}.png"
    figure = draw_instrument(name, wire, tube, smooth)
    with whole_file(picture) as partial:
        figure.savefig(partial)
    print(f"picture: {os.path.relpath(picture)}")
    return 0 if all(line.passed for line in results) and tube.passages + smooth.passages == 0 else BEYOND_A_GATE


def table(bench: Bench) -> list[str]:
    """All instruments, a line each."""
    lines = [f"{'name':30} {'diameter':9} {'length':7} {'EI shaft':9} {'':8} {'GJ':9} {'EI tip':9} {'friction':21} tip"]
    for name, file in files().items():
        wire = bench.wire(name)
        stated = {item.what: item for item in read_stated(file)}
        stiffness = stated.get("bendingStiffness", stated.get("flexuralModulus"))
        lines.append(f"{name:30} {stated['diameter'].value:9} {stated['length'].value:7} {wire.bending[0]:9.3g}"
                     f" {stiffness.basis if stiffness else '':8} {wire.torsional[0]:9.3g} {wire.bending[-1]:9.3g}"
                     f" {stated['friction'].value:21} {stated['tip'].value}")
    return [*lines, "EI, GJ: N m2. 'instrument NAME' states source and basis of each number and makes the bench tests."]


def stated_lines(stated: Sequence[Stated]) -> list[str]:
    """What a file states, a line each."""
    return [f"{item.what:36} {item.value:22} {item.basis:9} {item.source}" for item in stated]


def bench_lines(results: Sequence[Line]) -> list[str]:
    """Bench tests, a line each."""
    return [f"{line.test:36} {line.value:.4g} {line.unit}" + (
        "" if math.isnan(line.expected) else f", expected {line.expected:.4g}, error {100.0 * line.error:+.2f} %, gate"
        f" {100.0 * GATE:.0f} %: " + ("passed" if line.passed else "NOT passed")) for line in results]


def tube_lines(tube: bent_tube.TubeTest, smooth: bent_tube.TubeTest) -> list[Line]:
    """What the tests in the bent tube give; nothing to compare with."""
    return [Line("bent tube: force at the end", tube.force, "N"),
            Line("bent tube: force without friction", smooth.force, "N"),
            Line("bent tube: tip over hub, 1080 deg", tube.response, ""),
            Line("bent tube: largest lag of the tip", math.degrees(tube.largest_lag), "deg"),
            Line("bent tube: largest torque", tube.torque, "N m"),
            Line("bent tube: passages", float(tube.passages + smooth.passages), "")]


def _compared(test: str, value: float, unit: str, expected: float) -> Line:
    return Line(test, value, unit, expected, value / expected - 1.0)
