"""The thesis's main gain, elements longer than a sphere's diameter: their cost, error and passages, for each contact
rule."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from analysis.figures.outlines import draw_surroundings
from analysis.gain import RULES, ElementRow, ElementTable
from guidewire.figures.style import captioned, letter, new_figure, styled
from guidewire.figures.wording import beside, number, percent, span

_COLOURS = {"none": "C1", "barycentric": "C0", "thesis": "C3"}
_MARKERS = {"none": "s", "barycentric": "o", "thesis": "^"}


@styled
def draw_gain(name: str, scene: str, table: ElementTable) -> tuple[Figure, str]:
    """Return two pictures of the coarsest wire, then distance to the finest run, step time and passages against n."""
    figure = new_figure(10.0, 6.4)
    panels = figure.subplot_mosaic([["a", "a", "a", "b", "b", "b"], ["c", "c", "d", "d", "e", "e"]])
    for panel, rule in (("a", "none"), ("b", "barycentric")):
        row = table.of(rule)[0]
        letter(panels[panel], panel, f"$n$ = {row.elements}, {RULES[rule]}")
        draw_wire(panels[panel], row, _worst_entry(table.of("none")[0]), _COLOURS[rule])
    for rule, label in RULES.items():
        rows = table.of(rule)
        style = {"color": _COLOURS[rule], "marker": _MARKERS[rule], "label": label}
        n = [row.elements for row in rows]
        panels["c"].plot(n, [np.nan if row.mean_distance is None else row.mean_distance for row in rows], **style)
        timed = [row for row in rows if row.step_time is not None]
        panels["d"].errorbar(
            [row.elements for row in timed], [row.step_time.median for row in timed],
            yerr=[[row.step_time.median - row.step_time.lowest for row in timed],
                  [row.step_time.highest - row.step_time.median for row in timed]],
            capsize=2.0, elinewidth=0.8, **style,
        )
        panels["e"].plot(n, [row.passages for row in rows], **style)
    letter(panels["c"], "c", f"mean distance to $n$ = {table.reference.elements}")
    panels["c"].set_ylabel("mean distance (units)")
    letter(panels["d"], "d", "step time")
    panels["d"].set_ylabel("real time per step (ms)")
    letter(panels["e"], "e", "passages through the wall")
    panels["e"].set_ylabel("number of passages")
    panels["e"].set_yscale("symlog", linthresh=1.0)
    panels["e"].yaxis.set_major_locator(_counts(max(row.passages for row in table.rows)))
    run = table.reference.wire.run
    touching = run.number("guidewireLength") / (2.0 * run.number("sphereRadius"))
    for panel in "cde":
        panels[panel].axvline(touching, linestyle="--", color="0.3", linewidth=1.0, label="$l = 2r$")
        panels[panel].set_xlabel("number of rod elements $n$")
        panels[panel].set_ylim(bottom=0.0)
    panels["d"].legend(loc="upper left", fontsize=7)
    return captioned(figure, gain_caption(name, scene, table))


def _counts(highest: int):
    """Ticks at 0, 1, 10, 100 ... for counts."""
    return MaxNLocator(integer=True) if highest == 0 else _PowersOfTen()


class _PowersOfTen(MaxNLocator):
    """0 and the powers of ten."""

    def tick_values(self, vmin: float, vmax: float) -> np.ndarray:
        powers = 10.0 ** np.arange(0, np.ceil(np.log10(max(vmax, 10.0))) + 1)
        return np.array([0.0, *powers])


def draw_wire(axes: Axes, row: ElementRow, entry: int, colour: str) -> None:
    """A wire with its spheres between the walls, in the y-z plane."""
    run, positions = row.wire.run, row.wire.motion.positions[entry]
    z, y = positions[:, 2], positions[:, 1]
    draw_surroundings(axes, run)
    axes.plot(z, y, "-", color=colour, linewidth=1.6)
    radius = run.number("sphereRadius")
    angle = np.linspace(0.0, 2.0 * np.pi, 33)
    for centre_z, centre_y in zip(z, y):
        axes.plot(centre_z + radius * np.cos(angle), centre_y + radius * np.sin(angle), color=colour, linewidth=0.7)
    margin = 4.0 * radius
    axes.set_xlim(z.min() - margin, z.max() + margin)
    axes.set_ylim(y.min() - margin, y.max() + margin)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="$z$ (units)", ylabel="$y$ (units)")


def _worst_entry(row: ElementRow) -> int:
    """Return the last entry of a run: what it came to."""
    return len(row.wire.motion.steps) - 1


def gain_caption(name: str, scene: str, table: ElementTable) -> str:
    """Return what the rows show, in numbers."""
    spheres, elements, seed = (table.of(rule) for rule in ("none", "barycentric", "thesis"))
    radius = table.reference.wire.run.number("sphereRadius")
    sentences = [
        f"Figure {name}. {scene}, n = {elements[0].elements} to {elements[-1].elements} (dashed: l = 2r). (a, b) The "
        f"coarsest wire at the end of its run.",
        f"(c) Over the run the wires with element contact are {_distances(elements)} units from the one with n = "
        f"{table.reference.elements}, those with sphere contact only {_distances(spheres)}; with pbd another n is "
        f"another stiffness, so this is no error that goes to 0.",
        _cost(elements, spheres),
        "(e) " + _passed("With sphere contact only", spheres, radius),
        _passed("With element contact", elements, radius),
        _passed("With the thesis's rule", seed, radius) if seed else "",
        _again(table),
        _flat(table),
        _length(table),
    ]
    return " ".join(sentence for sentence in sentences if sentence)


def _distances(rows: list[ElementRow]) -> str:
    return span([np.nan if row.mean_distance is None else row.mean_distance for row in rows])


def _cost(elements: list[ElementRow], spheres: list[ElementRow]) -> str:
    if any(row.step_time is None for row in (*elements, *spheres)):
        return "(d) Not every run was timed."
    longest = elements[-1]
    touching = min(elements, key=lambda row: abs(row.element_length - 2.0 * row.wire.run.number("sphereRadius")))
    first = elements[0]
    extra = np.median([
        own.step_time.median / other.step_time.median - 1.0 for own, other in zip(elements, spheres)
    ])
    return (
        f"(d) With element contact a step takes {number(first.step_time.median, 2)} ms at n = {first.elements}, "
        f"{number(touching.step_time.median, 2)} at n = {touching.elements} and {number(longest.step_time.median, 2)} "
        f"at n = {longest.elements} (median of the steps, then of {first.step_time.count} runs, made one at a time, "
        f"{beside([row.others_busy for row in (*elements, *spheres)])}), in the median of all n {percent(abs(extra))} "
        f"{'more' if extra >= 0.0 else 'less'} than with spheres only."
    )


def _passed(subject: str, rows: list[ElementRow], radius: float) -> str:
    """Say at which n points of the wire passed the wall."""
    failed = [row for row in rows if row.passages > 0]
    if not failed:
        return f"{subject} no point of any wire passes the wall."
    count = sum(row.passages for row in failed)
    text = f"{subject} {count:,} point{'s pass' if count > 1 else ' passes'} it, at n = " + ", ".join(
        str(row.elements) for row in failed
    )
    shortest = min(row.element_length for row in failed)
    held = [row.element_length for row in rows if row.passages == 0]
    if held and max(held) < shortest:
        text += f": for l = {number(shortest)} units and more, and not for {number(max(held))} and less"
        text += f" (2r = {2 * radius:g})"
    return text + "."


def _again(table: ElementTable) -> str:
    """Return whether the count from the logs agrees."""
    rows = [row for row in table.rows if row.counted_again is not None]
    if not rows:
        return ""
    wrong = [row for row in rows if row.counted_again != row.passages]
    if not wrong:
        return f"Counted again from {len(rows)} of the logs by ray parity, the passages are the same."
    text = "; ".join(
        f"{row.counted_again} instead of {row.passages} with {RULES[row.rule]} at n = {row.elements}" for row in wrong
    )
    return f"Counted again from {len(rows)} of the logs by ray parity, the passages are {text}."


def _flat(table: ElementTable) -> str:
    """Why a plane is no trial of sphere contact."""
    vessel = table.reference.wire.run.value("vessel")
    if not vessel or vessel["shape"] != "plane":
        return ""
    return (
        "A plane is no trial of sphere contact: an element lies before it wherever both its spheres do. Only at an "
        "edge, here the plates', can a long element pass between two spheres."
    )


def _length(table: ElementTable) -> str:
    """Return how much of its length the finest wire has lost: few solver steps leave a wire of many elements
    compressed."""
    run, end = table.reference.wire.run, table.reference.wire.motion.positions[-1]
    length = np.linalg.norm(np.diff(end, axis=0), axis=1).sum()
    lost = 1.0 - length / run.number("guidewireLength")
    if lost < 0.02:
        return ""
    return (
        f"With m = {run.number('constraintSolverSteps'):g} the wire with n = {table.reference.elements} is compressed, "
        f"by {percent(lost)} of its length at the end: much of (c) is this lag."
    )
