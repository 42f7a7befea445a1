"""The published contact rule compared with the lever rule: one element on a small fixed sphere at eleven positions."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from analysis.comparisons import WireRun, read_wire
from analysis.gain import RULES
from guidewire.figures.style import captioned, letter, new_figure, styled
from guidewire.figures.wording import number, span
from guidewire.logs.runs import read_study

_STYLE = {"barycentric": ("C0", "o"), "thesis": ("C3", "^")}
_ROUNDING = 1e-9  # units
_SAME = 1e-6  # of the largest push: two ends that are pushed alike


@dataclass(frozen=True)
class Rest:
    """One element beside a fixed sphere at the position s along it.

    Attributes
    ----------
    rule : elementContact.
    position : s, from 0 at the first end to 1 at the second.
    pushed : (2,), how far the first step moved each end away from the fixed sphere, in units.
    shrunk : how much shorter the element is at the end of the run, in units.
    depth : r less the distance of the element's axis from the fixed sphere at the end, in units.
    """

    rule: str
    position: float
    pushed: np.ndarray
    shrunk: float
    depth: float


def read_rests(folder: Path) -> list[Rest]:
    """Return the rests of a study, by rule and position.

    Raises
    ------
    LogError : a file cannot be read, or nothing was run.
    """
    rests = [_measure(read_wire(run)) for run in read_study(folder).required()]
    return sorted(rests, key=lambda rest: (rest.rule, rest.position))


def _measure(wire: WireRun) -> Rest:
    run, positions = wire.run, wire.motion.positions
    obstacle = run.value("obstacles")[0]
    centre, start, end = np.array(obstacle["centre"], float), positions[0], positions[-1]
    axis = start[1] - start[0]
    length = np.linalg.norm(axis)
    return Rest(
        rule=run.value("elementContact"),
        position=float((centre - start[0]) @ axis / length**2),
        pushed=positions[1, :, 1] - start[:, 1],
        shrunk=float(length - np.linalg.norm(end[1] - end[0])),
        depth=run.number("sphereRadius") - (_distance(centre, end[0], end[1]) - obstacle["radius"]),
    )


def _distance(point: np.ndarray, first: np.ndarray, second: np.ndarray) -> float:
    along = np.clip((point - first) @ (second - first) / np.sum((second - first) ** 2), 0.0, 1.0)
    return float(np.linalg.norm(point - first - along * (second - first)))


@styled
def draw_contact_rule(rests: list[Rest]) -> tuple[Figure, str]:
    """Push on both ends in the first step, for both rules, and how deep the element rests."""
    figure = new_figure(10.0, 3.1)
    panels = dict(zip(("barycentric", "thesis", "depth"), figure.subplots(1, 3)))
    for name, rule in (("a", "barycentric"), ("b", "thesis")):
        axes, (colour, marker) = panels[rule], _STYLE[rule]
        rows = [rest for rest in rests if rest.rule == rule]
        s = [rest.position for rest in rows]
        letter(axes, name, f"correction in the first step: {_NAMES[rule]}")
        axes.plot(s, [rest.pushed[0] for rest in rows], marker=marker, color=colour, label="first end")
        axes.plot(s, [rest.pushed[1] for rest in rows], marker=marker, color=colour, linestyle="--",
                  markerfacecolor="white", label="second end")
        axes.axhline(0.0, color="0.3", linewidth=0.8)
        axes.set(xlabel="position $s$ of the contact (element lengths)", ylabel="motion off the obstacle (units)")
        axes.legend(loc="best")
        panels["depth"].plot(s, [rest.depth for rest in rows], marker=marker, color=colour, label=_NAMES[rule])
    letter(panels["depth"], "c", "how deep the element rests")
    panels["depth"].set(xlabel="position $s$ of the contact (element lengths)", ylabel="depth at the end (units)")
    panels["depth"].set_ylim(bottom=min(0.0, panels["depth"].dataLim.y0))
    panels["depth"].legend(loc="best")
    return captioned(figure, contact_rule_caption(rests))


_NAMES = {"barycentric": "lever rule", "thesis": RULES["thesis"]}


def contact_rule_caption(rests: list[Rest]) -> str:
    """Return what the rests show, in numbers."""
    lever, seed = ([rest for rest in rests if rest.rule == rule] for rule in ("barycentric", "thesis"))
    return " ".join((
        "Figure contact-rule. One rod element that reaches 1 unit too deep onto a small fixed sphere at position s; no "
        "inertia, both ends free.",
        f"(a) Lever rule, weights 1 - s and s: {_which(lever)}.",
        f"(b) As published: {_sign(seed)}, because its normal is scaled to a hundredth and the point to which an end "
        f"is drawn lies almost on the obstacle; {_which(seed)}.",
        f"(c) At the end the element rests {_depths(lever)} under the lever rule and {_depths(seed)} under the "
        f"published one, whose element is {span([rest.shrunk for rest in seed], 2)} units shorter then (lever rule: at "
        f"most {number(max(abs(rest.shrunk) for rest in lever), 2)}).",
    ))


def _which(rests: list[Rest]) -> str:
    """Return whether the end nearer to the contact is pushed more, over all positions off the middle."""
    off = [rest for rest in rests if abs(rest.position - 0.5) > 1e-9]
    near = [rest.pushed[int(rest.position > 0.5)] for rest in off]
    far = [rest.pushed[int(rest.position < 0.5)] for rest in off]
    scale = max(np.max(np.abs([near, far])), 1e-300)
    more = sum(n > f + _SAME * scale for n, f in zip(near, far))
    text = f"the nearer end is moved off the obstacle more than the farther one at {more} of {len(off)} positions"
    return text + (", as it must be" if more == len(off) else "")


def _sign(rests: list[Rest]) -> str:
    both = sum(bool(np.all(rest.pushed < 0.0)) for rest in rests)
    return f"at {both} of {len(rests)} positions both ends are drawn towards the obstacle"


def _depths(rests: list[Rest]) -> str:
    """Return how deep the element rests; what is below rounding is none."""
    depths = np.array([rest.depth for rest in rests])
    return "at its surface" if np.all(np.abs(depths) < _ROUNDING) else f"{span(depths, 2)} units deep"
