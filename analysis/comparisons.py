"""One row for each value of a study whose runs are compared with a reference run (thesis, sections 4.2 and 4.3).

The reference is the first run of its own study; that study's other runs differ from it in one parameter each and show
how much of a distance is the reference's own. Two clocks are used: the same in-game time, as in the thesis, up to the
reference's end, and the same step number, up to the last step that all runs have.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from analysis.distances import Trajectory, distances, trajectory
from guidewire.logs.logs import LogError, read_log
from guidewire.logs.runs import Run, read_study

_SAME = 1e-9  # relative difference up to which two times are the same


@dataclass(frozen=True)
class WireRun:
    """A run with the positions of all its spheres over time."""

    run: Run
    motion: Trajectory

    @property
    def end(self) -> float:
        """In-game time of the last entry, in s."""
        return float(self.motion.time[-1])

    def scaled_to(self, displacement: float) -> WireRun:
        """Return the run as it would be with another displacement if every sphere moved in proportion to it."""
        factor = displacement / self.run.number("displacement")
        rest = self.run.rest_positions
        return replace(self, motion=replace(self.motion, positions=rest + factor * (self.motion.positions - rest)))


@dataclass(frozen=True)
class ComparedRun:
    """What one value of a study's parameter led to, beside the reference.

    Attributes
    ----------
    value : of the parameter that the study varies, in its unit.
    run : its run.
    arc_length : (s,), of its spheres, in units.
    end_positions : (s, 3), at the reference's end, in units.
    end_distance : (s,), to the reference at its end, in units.
    mean_distance : over spheres and entries up to the reference's end, at the same in-game time, in units.
    step_distance : over spheres and the steps that all runs have, at the same step number, in units.
    other_distances : as ``mean_distance``, to the other runs of the reference's study.
    swing : highest minus lowest y of the last sphere over the same steps, in units.
    """

    value: float
    run: Run
    arc_length: np.ndarray
    end_positions: np.ndarray
    end_distance: np.ndarray
    mean_distance: float
    step_distance: float
    other_distances: tuple[float, ...]
    swing: float


@dataclass(frozen=True)
class ComparisonTable:
    """A study's rows in ascending order of the parameter ``key``.

    Attributes
    ----------
    study, key : what was varied.
    rows : runs that last as long as the reference.
    reference : what they are compared with.
    others : the other runs of the reference's study.
    common_steps : step up to which runs are compared step by step.
    missing : names of the runs that left nothing to read or ended before the reference, with the reason.
    """

    study: str
    key: str
    rows: tuple[ComparedRun, ...]
    reference: WireRun
    others: tuple[WireRun, ...]
    common_steps: int
    missing: tuple[str, ...]

    def column(self, name: str) -> np.ndarray:
        """Return a number of all rows, shape (rows,)."""
        return np.array([getattr(row, name) for row in self.rows], dtype=float)


def read_reference(folder: Path) -> tuple[WireRun, ...]:
    """Return the runs of a reference's study, the reference first.

    Raises
    ------
    LogError : the reference left no log.
    """
    study = read_study(folder)
    if not study.untimed or study.missing:
        raise LogError(f"{folder}: not all runs of this study have a log")
    return tuple(read_wire(run) for run in study.untimed)


def read_wire(run: Run) -> WireRun:
    """Return a run with its log of all spheres."""
    return WireRun(run, trajectory(run, read_log(run.folder, spheres="all")))


def read_comparison(folder: Path, reference_folder: Path, key: str, proportional: bool = False) -> ComparisonTable:
    """Compares every run of a study that varies ``key`` with a reference.

    Parameters
    ----------
    folder, reference_folder : folders of the two studies.
    key : the parameter that the study varies.
    proportional : scale every motion to the reference's displacement first.

    Raises
    ------
    LogError : a file cannot be read, the study varies more than ``key``, or no run lasts as long as the reference.
    """
    reference, *others = read_reference(reference_folder)
    study = read_study(folder)
    wires = [read_wire(run) for run in study.along(key)]
    missing = [f"{name}: not run" for name in study.missing]
    missing += [
        f"{wire.run.key}: {wire.run.outcome} at t = {wire.end:g} s" for wire in wires if not _lasts(wire, reference)
    ]
    wires = [wire for wire in wires if _lasts(wire, reference)]
    if not wires:
        raise LogError(f"{folder}: no run of this study lasts as long as the reference")
    if proportional:
        wires = [wire.scaled_to(reference.run.number("displacement")) for wire in wires]
    common = min(int(wire.motion.steps[-1]) for wire in (reference, *wires))
    rows = [_compare(wire, wire.run.number(key), reference, others, common) for wire in wires]
    rows.sort(key=lambda row: row.value)
    return ComparisonTable(study.name, key, tuple(rows), reference, tuple(others), common, tuple(missing))


def _lasts(wire: WireRun, reference: WireRun) -> bool:
    return wire.end >= reference.end * (1.0 - _SAME)


def _compare(
    wire: WireRun, value: float, reference: WireRun, others: list[WireRun], common_steps: int
) -> ComparedRun:
    by_time = distances(wire.motion, reference.motion)
    by_step = distances(wire.motion, reference.motion, match="step")
    last = np.searchsorted(wire.motion.steps, by_time.steps[-1])
    early = wire.motion.steps <= common_steps
    return ComparedRun(
        value=value,
        run=wire.run,
        arc_length=wire.motion.arc_length,
        end_positions=wire.motion.positions[last],
        end_distance=by_time.final,
        mean_distance=by_time.mean,
        step_distance=float(by_step.values[by_step.steps <= common_steps].mean()),
        other_distances=tuple(distances(wire.motion, other.motion).mean for other in others),
        swing=float(np.ptp(wire.motion.positions[early, -1, 1])),
    )
