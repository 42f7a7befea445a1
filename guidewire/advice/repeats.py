"""Whether the result of a run holds with finer settings: the run beside itself with half the time step and, where it is
asked for, twice the elements.

Stick-slip, a branch that is just met or just missed, and a snap make two ends of one motion; such a run ends elsewhere
with other steps, and neither end is wrong in itself.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from guidewire.advice.trials import Trial, finer
from guidewire.figures.wording import number, percent
from guidewire.logs.logs import read_log
from guidewire.logs.runs import Run

TIP = 0.01  # of the wire's length, by which its tip may end elsewhere
FORCE = 0.1  # of the largest force of the hub, by which that at the end may differ
_FORCES = {  # of the summary, and in words
    "hub.force": "force of the hub, N", "hub.torque": "torque of the hub, N m",
    "extremes.axialForce": "largest force of the hub, N", "largestWallForce": "largest force of the walls",
}


@dataclass(frozen=True)
class Ending:
    """How a run ended.

    Attributes
    ----------
    outcome, is_reliable : as its summary says.
    tip : (3,), units.
    forces : by their names in the summary; not a number where there is none.
    """

    outcome: str
    is_reliable: bool
    tip: np.ndarray
    forces: Mapping[str, float]


def trials_of(run: Run, elements: bool) -> list[Trial]:
    """Return the settings with which a run is repeated: half the time step and, if asked for, twice the elements."""
    return finer(run.parameters, elements)


def ending_of(run: Run) -> Ending:
    """Raises LogError where the run left no summary or no log."""
    return Ending(run.outcome, run.is_reliable, read_log(run.folder).positions[-1, -1],
                  {name: _found(run, name) for name in _FORCES})


def differences(run: Run, repeats: Mapping[str, Run]) -> list[str]:
    """Say in what repeats by name end otherwise than the run, one phrase each; none where the result holds."""
    end, found = ending_of(run), []
    for name, repeat in repeats.items():
        other = ending_of(repeat)
        if other.outcome != end.outcome:
            found.append(f"with {name} it ends {other.outcome}, not {end.outcome}")
            continue
        if other.is_reliable != end.is_reliable:
            found.append(f"with {name} it is {'' if other.is_reliable else 'not '}reliable")
        moved = _moved(run, end, other)
        if not moved <= TIP:
            found.append(f"with {name} the tip ends {_distance(end, other)} units elsewhere, {percent(moved)} of the "
                         "wire's length")
        largest = abs(end.forces["extremes.axialForce"])
        change = abs(other.forces["hub.force"] - end.forces["hub.force"])
        if change > FORCE * largest:
            found.append(f"with {name} the force of the hub at the end differs by {number(change)} N, "
                         f"{percent(change / largest)} of its largest")
    return found


def as_markdown(run: Run, repeats: Mapping[str, Run]) -> str:
    """Return one table: the run, and what is other in its repeats."""
    end, others = ending_of(run), {name: ending_of(repeat) for name, repeat in repeats.items()}
    rows = [["", "this run", *others], ["---"] * (2 + len(others)),
            ["outcome", end.outcome, *(other.outcome for other in others.values())],
            ["reliable", _yes(end), *map(_yes, others.values())],
            ["tip, moved by", "-", *(f"{_distance(end, other)} units ({percent(_moved(run, end, other))} of L)"
                                     for other in others.values())]]
    rows += [[said, number(end.forces[name]), *(number(other.forces[name]) for other in others.values())]
             for name, said in _FORCES.items() if math.isfinite(end.forces[name])]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows) + "\n"


def verdict(run: Run, repeats: Mapping[str, Run]) -> str:
    """Say it in one line."""
    found = differences(run, repeats)
    return "the result does not hold: " + "; ".join(found) if found else \
        f"the result holds with {' and with '.join(repeats)}"


def _found(run: Run, name: str) -> float:
    value = run.summary
    for part in name.split("."):
        value = None if value is None else value.get(part)
    return math.nan if value is None else float(value)


def _distance(end: Ending, other: Ending) -> str:
    return number(float(np.linalg.norm(other.tip - end.tip)))


def _moved(run: Run, end: Ending, other: Ending) -> float:
    return float(np.linalg.norm(other.tip - end.tip)) / run.number("guidewireLength")


def _yes(end: Ending) -> str:
    return "yes" if end.is_reliable else "no"
