"""One row for each number of elements and each rule of contact: error, step time and passages through the wall."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from analysis.comparisons import WireRun, read_wire
from analysis.distances import distances
from analysis.passages import Wall, count_passages
from analysis.tables import Spread
from guidewire.logs.logs import LogError
from guidewire.logs.runs import busiest, read_study
from guidewire.logs.surfaces import read_obj

RULES = {"none": "spheres only", "barycentric": "spheres and elements", "thesis": "as published"}


@dataclass(frozen=True)
class ElementRow:
    """What one run came to.

    Attributes
    ----------
    rule : its elementContact.
    elements : n.
    wire : the run and its motion.
    mean_distance : to the reference, over spheres and steps, in units; None where the run did not last as long.
    passages : as the run counted them.
    counted_again : from the log; None where that was not done.
    step_time : median wall time of a step in each timed repeat, in ms.
    others_busy : processors that other programs kept busy beside the repeat that they disturbed most; None where nobody
        looked.
    """

    rule: str
    elements: int
    wire: WireRun
    mean_distance: float | None
    passages: int
    counted_again: int | None
    step_time: Spread | None
    others_busy: float | None

    @property
    def element_length(self) -> float:
        """Return the length l of an element, units."""
        return self.wire.run.number("guidewireLength") / self.elements


@dataclass(frozen=True)
class ElementTable:
    """Rows in ascending order of n, by rule; the reference is the finest run with element contact."""

    rows: tuple[ElementRow, ...]
    reference: ElementRow

    def of(self, rule: str) -> list[ElementRow]:
        """Rows of a rule, without the finest run."""
        return [row for row in self.rows if row.rule == rule and row.elements < self.reference.elements]


def read_gain(folder: Path, count_again: int = 0) -> ElementTable:
    """Measures every run of a study that varies n and elementContact.

    Parameters
    ----------
    folder : the study's folder.
    count_again : count passages through a mesh from the logs too, for runs of at most so many elements.

    Raises
    ------
    LogError : a file cannot be read, or the study has no finished run with element contact.
    """
    study = read_study(folder)
    wires = [read_wire(run) for run in study.untimed]
    whole = [
        wire for wire in wires
        if wire.run.value("elementContact") == "barycentric" and wire.run.outcome == "finished"
    ]
    if not whole:
        raise LogError(f"{folder}: no run with element contact was completed")
    finest = max(whole, key=lambda wire: wire.run.number("numberRodElements"))
    rows = []
    for wire in wires:
        elements = int(wire.run.number("numberRodElements"))
        repeats = study.timed(wire.run.key)
        rows.append(ElementRow(
            rule=wire.run.value("elementContact"),
            elements=elements,
            wire=wire,
            mean_distance=distances(wire.motion, finest.motion).mean if wire.end >= finest.end else None,
            passages=int(wire.run.measured("passages")),
            counted_again=_count_again(wire) if elements <= count_again else None,
            step_time=Spread.of([repeat.measured("medianStepTime") for repeat in repeats]),
            others_busy=busiest(repeats),
        ))
    rows.sort(key=lambda row: row.elements)
    return ElementTable(tuple(rows), next(row for row in rows if row.wire is finest))


def _count_again(wire: WireRun) -> int | None:
    vessel = wire.run.value("vessel")
    if not vessel or vessel["shape"] != "mesh":
        return None
    surface = read_obj(Path(vessel["file"]))
    return count_passages(Wall.of(surface.vertices, surface.triangles), wire.motion.positions)
