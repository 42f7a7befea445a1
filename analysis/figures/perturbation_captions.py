"""Captions of Figures 4.10 to 4.18: what the tables show, and which statements of the thesis they confirm.

As in every caption here, a sentence that claims a relation stands behind a test of it on the table.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.signal import find_peaks

from analysis.comparisons import ComparisonTable, WireRun
from analysis.distances import distances
from guidewire.figures.wording import number, percent, relative_spread, span

_PROMINENCE = 0.03  # of the range of a curve: lower maxima are not described
_RIPPLE = 0.1  # of the range of a curve that is said to grow: by so much it may fall back on the way
_SAME = 1e-9  # relative spread up to which values that should be one number are one
_SMALL_TIME_STEP = 1e-3  # s, up to which the thesis sees nearly no distance in the collision
_HEAVY = 0.5  # units of mass, beyond which the thesis sees the distance fall
_LINEAR = 0.05  # of the displacement: wires that far apart at most are called proportional


def reference_caption(runs: tuple[WireRun, ...]) -> str:
    """Caption of Figure 4.10."""
    reference, *others = runs
    y = reference.motion.positions[:, -1, 1]
    sideways = np.max(np.abs(reference.motion.positions[..., 0]))
    start = reference.run.displacement[1]
    sentences = [
        f"Figure 4.10. Transversal displacement of {start:g} units, last sphere of the reference run: "
        f"{describe(reference)}, M = {reference.run.number('totalMass'):g}.",
        f"(a) No sphere leaves x = 0 by more than {number(sideways, 1)} units: the wave keeps to the y-z plane, as the "
        f"thesis says." if sideways < 1e-9 else f"(a) x leaves 0 by up to {number(sideways)} units.",
        f"(b to e) y swings to {number(y.min())} units and stands at {number(y[-1])} at the end.",
        _rotation(reference),
    ]
    ends = [other.motion.positions[-1, -1, 1] for other in others]
    described = "; ".join(f"{number(end)} with {describe(other)}" for other, end in zip(others, ends))
    twice = float(np.interp(0.5 * reference.end, reference.motion.time, y))
    sentences.append(
        f"The reference is large, not a limit: at the same moment y is {described}; and since without forces the "
        "positions at step k are the same for every Δt, twice the Δt shows the first half of this very run at half "
        f"the pace (dashed) and ends at {number(twice)}. More iterations in a second of in-game time, or more "
        "elements, make another, stiffer wire. Distances to such a reference in the next figures are distances between "
        "two wires of different stiffness, not errors that go to 0."
    )
    return " ".join(sentence for sentence in sentences if sentence)


def _rotation(reference: WireRun) -> str:
    """Return what is left of the motion in the second half of the run, where the wave has died out."""
    late = reference.motion.time >= 0.5 * reference.end
    y, steps = reference.motion.positions[late, -1, 1], reference.motion.steps[late]
    rates = np.diff(y) / np.diff(steps)
    line = np.polyfit(steps, y, 1)
    misfit = np.max(np.abs(y - np.polyval(line, steps)))
    if misfit > 0.05 * abs(y[-1] - y[0]):
        return f"Over the second half it still moves between {number(y.min())} and {number(y.max())}."
    return (
        f"The wave has decayed before the second half; what remains is a rotation about the held first sphere, whose "
        f"frame is free: {number(np.mean(rates), 2)} units a step without end, so this run has no steady state."
    )


def perturbation_caption(figure: str, table: ComparisonTable) -> str:
    """Caption of one of Figures 4.11 to 4.18."""
    scene = _SCENES[figure].format(push=table.reference.run.number("displacement"))
    symbol = _SYMBOLS[table.key]
    x, mean = table.column("value"), table.column("mean_distance")
    sentences = [
        f"Figure {figure}. {scene}, {symbol} = {x.min():g} to {x.max():g}{_UNITS[table.key]} ({x.size} runs, else "
        f"Table 4.1{_BETWEEN if figure in _PLATES else ''}). The reference run has {describe(table.reference)}. "
        f"{_other_references(table)}",
        f"(a, b) At the end the wires are {span([row.end_distance.mean() for row in table.rows])} units from the "
        f"reference on average over their spheres.",
        f"(c) Over the run the mean distance is {number(mean.min())} units at {symbol} = {x[mean.argmin()]:.4g} to "
        f"{number(mean.max())} at {symbol} = {x[mean.argmax()]:.4g}.",
    ]
    sentences += _CLAIMS[figure](table)
    return " ".join(sentence for sentence in sentences if sentence) + _left_out(table)


def _other_references(table: ComparisonTable) -> str:
    """Return how far the reference is from the runs that differ from it in one parameter: what its own choice is
    worth."""
    if not table.others:
        return ""
    described = " and ".join(
        f"{number(distances(other.motion, table.reference.motion).mean, 2)} units from {describe(other)}"
        for other in table.others
    )
    return f"The reference is itself, on average over the run, {described} (grey in (c)): it is no limit."


def describe(wire: WireRun) -> str:
    """m, n and dt of a run in words."""
    run = wire.run
    return (
        f"m = {run.number('constraintSolverSteps'):g}, n = {run.number('numberRodElements'):g}, "
        f"Δt = {run.number('timeStep'):g} s"
    )


_SYMBOLS = {"constraintSolverSteps": "m", "timeStep": "Δt", "numberRodElements": "n", "totalMass": "M",
            "displacement": "Δy0"}
_UNITS = {"constraintSolverSteps": "", "timeStep": " s", "numberRodElements": "", "totalMass": " units of mass",
          "displacement": " units"}
_SCENES = {f"4.{k}": "Transversal displacement" for k in ("11", "12", "13", "14", "14b")}
_SCENES |= {f"4.{k}": "Push of {push:g} units against a wall" for k in ("15", "16", "17", "18")}


def maxima(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Find where a curve has local maxima that stand out by _PROMINENCE of its range, as values of x."""
    if y.size < 3 or np.ptp(y) == 0.0:
        return np.array([])
    return x[find_peaks(y, prominence=_PROMINENCE * np.ptp(y))[0]]


def _listed(values: np.ndarray) -> str:
    """Maxima as a list, the first six of many."""
    listed = ", ".join(f"{value:.4g}" for value in values[:6])
    return listed if values.size <= 6 else f"{listed} and {values.size - 6} more"


def _resonance(table: ComparisonTable, low: float, high: float, claim: str) -> list[str]:
    """Return whether a maximum of the mean distance stands where the thesis saw one, and whether it can be a
    resonance."""
    symbol, x = _SYMBOLS[table.key], table.column("value")
    found = maxima(x, table.column("mean_distance"))
    there = found[(found >= low) & (found <= high)]
    if found.size == 0:
        seen = f"with {x.size} runs there is no local maximum at all."
    elif (low, high) == (x[0], x[-1]):
        seen = f"local maxima stand at {symbol} = {_listed(found)}."
    else:
        count = f"{there.size} of them there" if there.size else "none of them there"
        seen = f"the finer sweep has local maxima at {symbol} = {_listed(found)}, {count}."
    sentences = [f"The thesis sees {claim}: {seen}"]
    for k, other in enumerate(table.others):
        peaks = maxima(x, np.array([row.other_distances[k] for row in table.rows]))
        stand = f"stand at {symbol} = {_listed(peaks)}" if peaks.size else "are none"
        sentences.append(f"Against {describe(other)} there {stand}.")
    swing = table.column("swing")
    if relative_spread(swing) < _SAME:
        sentences.append(
            f"A resonance would show in the run itself, but the last sphere swings by {number(swing[0])} units in "
            "every one of them."
        )
    elif maxima(x, swing).size == 0:
        sentences.append(
            f"A resonance would show in the run itself, but the last sphere's swing has no local maximum: it goes from "
            f"{number(swing[0])} units at {symbol} = {x[0]:.4g} to {number(swing[-1])} at {x[-1]:.4g}. Maxima of the "
            f"distance are then times at which run and reference are out of step."
        )
    else:
        sentences.append(
            f"The last sphere's swing itself, over the first {table.common_steps} steps, is largest near {symbol} = "
            f"{_listed(maxima(x, swing))}."
        )
    return sentences


def _equal_steps(table: ComparisonTable) -> str:
    steps = table.column("step_distance")
    spread = relative_spread(steps)
    if table.key == "timeStep" and spread < _SAME:
        return (
            f"(d) At equal step number all these runs are one and the same, {number(steps[0])} units from the "
            f"reference (relative spread {number(spread, 1)}): without forces the method does not contain Δt, and all "
            "of (c) is the clock."
        )
    x, symbol = table.column("value"), _SYMBOLS[table.key]
    return (
        f"(d) At equal step number the distance goes from {number(steps[0])} units at {symbol} = {x[0]:.4g} to "
        f"{number(steps[-1])} at {x[-1]:.4g}."
    )


def _rises(y: np.ndarray) -> bool:
    """Return whether values grow from the first to the last, and never fall back by more than _RIPPLE of their
    range."""
    return y.size > 2 and y[-1] > y[0] and float(np.max(np.maximum.accumulate(y) - y)) <= _RIPPLE * float(np.ptp(y))


def _falls(table: ComparisonTable) -> bool:
    """Return whether the mean distance falls with the parameter, but for ripples."""
    return _rises(-table.column("mean_distance"))


def _transversal_steps(table: ComparisonTable) -> list[str]:
    mean = table.column("mean_distance")
    verdict = (
        f"As the thesis says, more solver steps come closer to the reference, by {percent(1.0 - mean[-1] / mean[0])} "
        f"from the first run to the last." if _falls(table) else
        "The thesis says that more solver steps come closer; the distance does not fall all the way."
    )
    return [verdict, *_resonance(table, 650, 750, "a small increase near m = 700 and suspects a resonance"),
            _equal_steps(table)]


def _transversal_time_step(table: ComparisonTable) -> list[str]:
    mean = table.column("mean_distance")
    factor = mean.max() / mean.min()
    verdict = (
        f"The thesis calls it almost constant; it varies by a factor of {number(factor, 2)}, and smaller steps "
        f"do not lead to the reference." if factor > 1.5 and mean[0] > 1.5 * mean.min() else
        f"The thesis calls it almost constant; it varies by a factor of {number(factor, 2)}." if factor > 1.5 else
        f"Almost constant, as the thesis says: within {percent(mean.max() / mean.min() - 1.0)}."
    )
    return [verdict,
            *_resonance(table, 0.8e-2, 1.25e-2, "a small increase at Δt = 0.01 s and suspects a resonance"),
            _equal_steps(table)]


def _transversal_elements(table: ComparisonTable) -> list[str]:
    mean = table.column("mean_distance")
    change = 1.0 - mean[-1] / mean[0]
    verdict = (
        f"More elements come closer, as the thesis says, but by {percent(change)} only from the first run to the last: "
        f"most of the distance is not one of n." if 0.0 < change < 0.3 else
        f"From the first run to the last the distance changes by {percent(-change)}."
    )
    return [verdict, *_resonance(table, x_low(table), x_high(table), "more than one peak and suspects resonances"),
            _equal_steps(table)]


def x_low(table: ComparisonTable) -> float:
    """Smallest value of the parameter."""
    return float(table.column("value")[0])


def x_high(table: ComparisonTable) -> float:
    """Largest value of the parameter."""
    return float(table.column("value")[-1])


def _transversal_mass(table: ComparisonTable) -> list[str]:
    x, mean = table.column("value"), table.column("mean_distance")
    own = table.reference.run.number("totalMass")
    best = x[mean.argmin()]
    verdict = "" if 0.8 < best / own < 1.25 else (
        f"The reference has M = {own:g}, but the nearest run has M = {best:.4g}."
    )
    factor = mean.max() / mean.min()
    return [f"{verdict} Between the masses the distance differs by a factor of {number(factor, 2)}.",
            *_resonance(table, x_low(table), x_high(table), "a distance that oscillates with M"),
            _equal_steps(table)]


def _proportional(table: ComparisonTable) -> list[str]:
    size = table.reference.run.number("displacement")
    ends = np.array([row.end_positions for row in table.rows])
    off = np.max(np.linalg.norm(ends - ends[0], axis=-1), axis=1) / size
    x = table.column("value")
    linear = x[off < _LINEAR].max()
    return [
        f"All motions are scaled to the reference's displacement of {size:g} units, so that in a linear problem all "
        f"wires would lie on the one of the smallest displacement. Those up to {linear:g} units do, to "
        f"{percent(_LINEAR, 1)} of the displacement; at {x[-1]:g} units the farthest sphere is {percent(off[-1])} of "
        "it away.",
        _equal_steps(table),
    ]


def _collision_steps(table: ComparisonTable) -> list[str]:
    mean, x = table.column("mean_distance"), table.column("value")
    verdict = (
        f"As the thesis says, the distance falls with more solver steps, by {percent(1.0 - mean[-1] / mean[0])} from "
        "the first run to the last." if _falls(table) else
        f"The thesis says that it falls with more solver steps; it goes from {number(mean[0])} units at m = {x[0]:g} "
        f"to {number(mean[-1])} at m = {x[-1]:g}, with local maxima at m = {_listed(maxima(x, mean))}."
    )
    return [verdict, _equal_steps(table), _sunk(table)]


def _collision_time_step(table: ComparisonTable) -> list[str]:
    mean, x = table.column("mean_distance"), table.column("value")
    small = mean[x <= _SMALL_TIME_STEP]
    if small.size == 0:
        return [_equal_steps(table), _sunk(table)]
    fraction = small.max() / mean.max()
    verdict = (
        f"As the thesis says, it is nearly zero up to Δt = {_SMALL_TIME_STEP:g} s: at most {percent(fraction)} of its "
        "largest value." if fraction < 0.05 else
        f"The thesis has it nearly zero up to Δt = {_SMALL_TIME_STEP:g} s; it is {span(small)} units there, up to "
        f"{percent(fraction)} of its largest value."
    )
    top = int(mean.argmax())
    if not _rises(mean[: top + 1]):
        growth = "It does not simply grow with Δt."
    elif top + 1 == x.size:
        growth = "It grows with Δt, as the thesis says."
    else:
        growth = f"It grows with Δt, as the thesis says, but only up to Δt = {x[top]:.3g} s."
    for k, other in enumerate(table.others):
        nearest = min(row.other_distances[k] for row in table.rows)
        if nearest < 0.05 * mean.min():
            growth += f" Against {describe(other)}, of as many elements, it does go down to {number(nearest, 2)} units."
    return [verdict, growth, _equal_steps(table), _sunk(table)]


def _collision_elements(table: ComparisonTable) -> list[str]:
    mean, x = table.column("mean_distance"), table.column("value")
    verdict = (
        f"As the thesis says, it falls with more elements, by {percent(1.0 - mean[-1] / mean[0])} from the first run "
        "to the last." if _falls(table) else
        f"The thesis sees a decreasing trend; it goes from {number(mean[0])} units at n = {x[0]:g} to "
        f"{number(mean[-1])} at n = {x[-1]:g}."
    )
    return [verdict, *_resonance(table, x_low(table), x_high(table), "some kind of resonance"), _equal_steps(table),
            _sunk(table)]


def _collision_mass(table: ComparisonTable) -> list[str]:
    mean, x = table.column("mean_distance"), table.column("value")
    light, heavy = mean[x <= _HEAVY], mean[x >= _HEAVY]
    rising = _rises(light)
    falling = heavy.size > 2 and heavy[-1] < heavy[0]
    own = (
        f"According to the thesis it grows with M and falls beyond M = {_HEAVY:g}. Here it "
        f"{'grows' if rising else 'does not simply grow'} up to there (from {number(light[0])} to {number(light[-1])} "
        f"units)"
    )
    if heavy.size > 2:
        own += f" and {'falls' if falling else 'does not fall'} beyond (to {number(heavy[-1])})"
    return [own + ".", *_resonance(table, x_low(table), x_high(table), "oscillations with M"), _equal_steps(table),
            _sunk(table)]


def _sunk(table: ComparisonTable) -> str:
    """Return how far the wire sinks into the wall, which the gain of the contact and the number of sweeps decide."""
    deepest = max(row.run.measured("maxPenetration") for row in table.rows)
    passed = sum(row.run.measured("passages") for row in table.rows)
    radius = table.reference.run.number("sphereRadius")
    passages = "no point of the wire passes it" if passed == 0 else f"{passed:,} points of the wire pass it"
    return (
        f"With k_C = {table.reference.run.number('collisionStiffness'):g} the wall is soft: the wire sinks in by up to "
        f"{number(deepest)} of r = {radius:g} units; {passages}."
    )


_PLATES = ("4.15", "4.16", "4.17", "4.18")
_BETWEEN = (
    "; the first two thirds of the wire lie between two plates, because a wire that is held at one point only turns "
    "away from the wall and round for ever"
)
_CLAIMS: dict[str, Callable[[ComparisonTable], list[str]]] = {
    "4.11": _transversal_steps,
    "4.12": _transversal_time_step,
    "4.13": _transversal_elements,
    "4.14": _transversal_mass,
    "4.14b": _proportional,
    "4.15": _collision_steps,
    "4.16": _collision_time_step,
    "4.17": _collision_elements,
    "4.18": _collision_mass,
}


def _left_out(table: ComparisonTable) -> str:
    return f" Not shown: {'; '.join(table.missing)}." if table.missing else ""
