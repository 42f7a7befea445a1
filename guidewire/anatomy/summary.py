"""The first lines of a report, for people: what the vessel is, what was chosen and why, what was changed."""

from __future__ import annotations

from dataclasses import dataclass

from guidewire.anatomy.centreline import Centreline, End
from guidewire.anatomy.inspection import Inspection
from guidewire.anatomy.output import neck_line
from guidewire.anatomy.reading import Source
from guidewire.anatomy.repair import Repaired

_ENDS, _LEFT, _DONE = 6, 2, 3  # that have a line each, of a page of twenty lines
_LONGEST = 300  # characters of a line


@dataclass(frozen=True)
class Choice:
    """Where a wire starts, and where it is pushed to. is_inlet_given, is_target_given : by the user."""

    inlet: End
    target: End
    is_inlet_given: bool = False
    is_target_given: bool = False


def summarise(source: Source, found: Inspection, repaired: Repaired | None = None, line: Centreline | None = None,
              choice: Choice | None = None) -> list[str]:
    """At most eighteen lines; ends have the numbers of the picture."""
    mm = 1e3 * found.unit.metres
    size = " x ".join(f"{side:.4g}" for side in mm * (found.high - found.low))
    lines = [source.axes.describe(), f"unit: {found.unit.name} ({found.unit.reason})", f"size: {size} mm"]
    if line is not None:
        lines += [_end(end, mm) for end in line.ends[:_ENDS]]
        if len(line.ends) > _ENDS:
            lines.append(f"ends {_ENDS + 1} to {len(line.ends)}: below")
    else:
        lines += [f"{'hole in the side' if rim.is_hole else 'open end'} {rim.number}: radius {mm * rim.radius:.3g} mm"
                  for rim in found.rims[:_ENDS]] or ["no open end"]
    if choice is not None:
        lines += [_inlet(choice, source), _target(choice)]
        path = set() if line is None else set(line.path(choice.inlet.point, choice.target.point).tolist())
        lines += [f"{neck_line(neck, mm)}: inlet and target are on its two sides, and may be of an artery and of a vein"
                  for neck in line.necks if path & set(neck.points)][:1]
    if repaired is not None:
        lines += _mended(repaired, mm)
    left = [_short(one) for one in source.left_out] + ([] if repaired is None else [
        f"{change.name}: {change.count}" for change in repaired.changes if change.leaves_out])
    lines += [f"left out: {one}" for one in left[:_LEFT]] or ["left out: nothing"]
    if len(left) > _LEFT:
        lines.append(f"left out: {len(left) - _LEFT} more, below")
    return lines


def _end(end: End, mm: float) -> str:
    state = "open" if end.is_open else "closed"
    return (f"end {end.number} '{end.name}': {state}, radius {mm * end.radius:.3g} mm"
            + (", the dome of a sac: no inlet" if end.is_sac else ""))


def _inlet(choice: Choice, source: Source) -> str:
    why = ("as given" if choice.is_inlet_given else "the widest" if source.begin is None
           else "where the lines of the file begin")
    return f"inlet: end {choice.inlet.number} ({why}; --inlet changes it)"


def _target(choice: Choice) -> str:
    why = ("as given" if choice.is_target_given
           else "of the ends about as far as the farthest, the one with the widest path")
    return f"target: end {choice.target.number} ({why}; --target changes it)"


def _mended(repaired: Repaired, mm: float) -> list[str]:
    done = [change for change in repaired.changes if not change.leaves_out]
    lines = [f"mended: {change.name}: {change.count}" for change in done[:_DONE]] or ["mended: nothing"]
    if len(done) > _DONE:
        lines[-1] = f"mended: {len(done) - _DONE + 1} more, below"
    lines[-1] += f"; the wall moved by {mm * repaired.moved:.2g} mm at most" if done else ""
    return lines


def _short(text: str) -> str:
    return text if len(text) <= _LONGEST else text[:_LONGEST - 3] + "..."
