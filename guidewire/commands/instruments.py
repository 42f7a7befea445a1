"""`guidewire.py instrument`: a table of all instruments, or one with its bench tests."""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from guidewire.benches import benches, bent_tube, elastica
from guidewire.benches.library import Stated, files, read_stated
from guidewire.benches.wire import Wire, wire_of
from guidewire.commands.sheet import derived_lines
from guidewire.logs.logs import LogError
from guidewire.prepare import PreparationError
from guidewire.runs.runner import Request, Runner
from guidewire.runs.whole_files import whole_file

BEYOND_A_GATE = 1
GATE = 0.01  # of EI, GJ and the tip load
_GAUGE = 0.02  # m of the tip that is free of the clamp in the test of its load, deflected by a quarter of that
_BARE = {"solver": "direct", "proximalEnd": "clamped", "maxSimulationSteps": 0}


@dataclass(frozen=True)
class Line:
    """A line of the bench tests: the figure, what it is compared with (nan: nothing), or why there is no figure."""

    test: str
    value: float
    unit: str
    expected: float = math.nan
    reason: str = ""

    @property
    def error(self) -> float:
        """Relative error; nan where there is nothing to compare with."""
        return self.value / self.expected - 1.0

    @property
    def passed(self) -> bool:
        """Whether there is a figure, and its error, if any, is within the gate."""
        return not self.reason and not abs(self.error) > GATE


class Bench:
    """Makes the runs of bench tests in a folder, with one runner."""

    def __init__(self, runner: Runner, folder: Path) -> None:
        self._runner = runner
        self._folder = folder
        self._count = 0

    def make(self, parameters: Mapping[str, Any]) -> Path:
        """Return the folder of a run. Raises PreparationError with the runner's line where it cannot be made."""
        self._count += 1
        out = self._folder / str(self._count)
        answer = self._runner.run(Request(out.name, None, out, dict(parameters)))
        if answer.exit_code != 0:
            raise PreparationError(answer.message.removeprefix("set: "))
        return out

    def wire(self, name: str) -> Wire:
        """Return an instrument as it is simulated."""
        folder = self.make({**_BARE, "instrument": name})
        return wire_of(json.loads((folder / "parameters.json").read_text(encoding="utf-8")))

    def stiffness(self, wire: Wire) -> Iterator[Line]:
        """Three-point bending of the shaft and of the taper, torque of the shaft, load of the tip."""
        span = benches.span_of(wire)
        taper = min(wire.shaft + 0.1 * span, wire.straight - 1.2 * span)
        if wire.shaft >= 1.2 * span:
            yield _tried("three-point bending, shaft", "N m2", lambda: self._bend(wire, 0.0))
            yield _tried("torque test, GJ", "N m2", lambda: self._twist(wire))
        if taper > wire.shaft - 0.9 * span:  # else there is no straight taper as long as the span
            yield _tried("three-point bending, taper", "N m2", lambda: self._bend(wire, taper))
        gauge = min(_GAUGE, 0.5 * wire.length)
        label = f"tip load at {250.0 * gauge:.3g} mm, {1e3 * gauge:.3g} mm free"
        yield _tried(label, "N", lambda: self._load(wire, gauge, 0.25 * gauge))

    def _bend(self, wire: Wire, start: float) -> tuple[float, float]:
        bent = benches.read_three_point(self.make(benches.three_point(wire, start)))
        return bent.stiffness, benches.expected_stiffness(wire, start, bent.arms)

    def _twist(self, wire: Wire) -> tuple[float, float]:
        return benches.read_torque(self.make(benches.torque(wire))), wire.torsional[0]

    def _load(self, wire: Wire, gauge: float, deflection: float) -> tuple[float, float]:
        """Return the simulated tip under the load for a deflection, and the load for the deflection that it then
        has."""
        load = elastica.load_at(wire, gauge, deflection)
        tip = benches.read_tip(self.make(benches.tip_load(wire, gauge, load)))
        return load, elastica.load_at(wire, gauge, float(tip[0] - elastica.rest_tip(wire, gauge)[0]))

    def tube(self, wire: Wire, friction: float | None) -> bent_tube.TubeTest:
        """Return the test of an instrument in the bent tube. Raises PreparationError where it gives no figure."""
        drive = self._folder / "drive.csv"
        bent_tube.write_drive(drive)
        try:
            return bent_tube.read_tube(self.make(bent_tube.bent_tube(wire, drive, friction)))
        except LogError as error:
            raise PreparationError(str(error)) from error


@contextmanager
def opened(command: Sequence[str]) -> Iterator[Bench]:
    """Provide a bench whose runs are forgotten at the end."""
    runner = Runner(command)
    try:
        with tempfile.TemporaryDirectory() as folder:
            yield Bench(runner, Path(folder))
    finally:
        runner.close()


def show(bench: Bench, name: str | None, out: Path) -> int:
    """Print what an instrument's file states and its bench tests, and draw it; 1 where a gate is not passed. Without a
    name print the table of all."""
    from guidewire.benches.figure import draw_instrument

    if name is None:
        print("\n".join(table(bench)))
        return 0
    wire = bench.wire(name)
    file = files()[name]
    print("\n".join([*stated_lines(read_stated(file)), *derived_lines(file, wire)]))
    results = list(bench.stiffness(wire))
    print("\n".join(bench_lines(results)), flush=True)
    tube, smooth = bench.tube(wire, None), bench.tube(wire, 0.0)
    print("\n".join(bench_lines(tube_lines(tube, smooth))))
    out.mkdir(parents=True, exist_ok=True)
    picture = out / f"{name}.png"
    figure = draw_instrument(name, wire, tube, smooth)
    with whole_file(picture) as partial:
        figure.savefig(partial)
    print(f"picture: {os.path.relpath(picture)}")
    return 0 if all(line.passed for line in results) and tube.passages + smooth.passages == 0 else BEYOND_A_GATE


def table(bench: Bench) -> list[str]:
    """Return all instruments, a line each."""
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
    """Return what a file states, a line each."""
    return [f"{item.what:36} {item.value:22} {item.basis:9} {item.source}" for item in stated]


def bench_lines(results: Sequence[Line]) -> list[str]:
    """Bench tests, a line each."""
    lines = []
    for line in results:
        text = f"{line.test:36} "
        if line.reason:
            lines.append(f"{text}no figure, NOT passed: {line.reason}")
        elif math.isnan(line.expected):
            lines.append(f"{text}{line.value:.4g} {line.unit}".rstrip())
        else:
            lines.append(f"{text}{line.value:.4g} {line.unit}, expected {line.expected:.4g}, error"
                         f" {100.0 * line.error:+.2f} %, gate {100.0 * GATE:.0f} %: "
                         f"{'passed' if line.passed else 'NOT passed'}")
    return lines


def tube_lines(tube: bent_tube.TubeTest, smooth: bent_tube.TubeTest) -> list[Line]:
    """Return what the tests in the bent tube give; nothing to compare with."""
    return [Line("bent tube: force at the end", tube.force, "N"),
            Line("bent tube: force without friction", smooth.force, "N"),
            Line("bent tube: tip over hub, 1080 deg", tube.response, ""),
            Line("bent tube: largest lag of the tip", math.degrees(tube.largest_lag), "deg"),
            Line("bent tube: largest torque", tube.torque, "N m"),
            Line("bent tube: passages", float(tube.passages + smooth.passages), "")]


def _tried(test: str, unit: str, bench: Callable[[], tuple[float, float]]) -> Line:
    """Return a bench test, or why it gives no figure."""
    try:
        value, expected = bench()
        return Line(test, value, unit, expected)
    except (LogError, elastica.ElasticaError, PreparationError) as error:
        return Line(test, math.nan, unit, reason=str(error))
