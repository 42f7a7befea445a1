"""Captions of Figures 4.10 to 4.18: sentences with numbers filled in. One that claims something stands where the table
bears it out, and nowhere else.
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
    ends = "; ".join(f"{number(other.motion.positions[-1, -1, 1])} with {describe(other)}" for other in others)
    twice = float(np.interp(0.5 * reference.end, reference.motion.time, y))
    return (
        f"Figure 4.10. Transversal displacement of {reference.run.displacement[1]:g} units, last sphere of the "
        f"reference run: {describe(reference)}, M = {reference.run.number('totalMass'):g}. (a) No sphere leaves x = 0 "
        f"by more than {number(sideways, 1)} units. (b to e) y swings to {number(y.min())} units and stands at "
        f"{number(y[-1])} at the end. {_rotation(reference)} The reference is large, not a limit: at the same moment y "
        f"is {ends}. Without forces the positions at step k are the same for every Δt: twice the Δt shows the first "
        f"half of this run at half the pace (dashed) and ends at {number(twice)}. Distances to such a reference are "
        "distances between two wires of different stiffness, not errors that go to 0."
    )


def _rotation(reference: WireRun) -> str:
    """Return what is left of the motion in the second half of the run, where the wave has died out."""
    late = reference.motion.time >= 0.5 * reference.end
    y, steps = reference.motion.positions[late, -1, 1], reference.motion.steps[late]
    misfit = np.max(np.abs(y - np.polyval(np.polyfit(steps, y, 1), steps)))
    if misfit > 0.05 * abs(y[-1] - y[0]):
        return f"Over the second half it still moves between {number(y.min())} and {number(y.max())}."
    return (f"What remains in the second half is a rotation about the held first sphere, whose frame is free: "
            f"{number(np.mean(np.diff(y) / np.diff(steps)), 2)} units a step without end.")


def perturbation_caption(figure: str, table: ComparisonTable) -> str:
    """Caption of one of Figures 4.11 to 4.18."""
    scene, symbol, numbers = _scene(figure, table), _SYMBOLS[table.key], _numbers(table)
    against = " and ".join(f"{number(distances(other.motion, table.reference.motion).mean, 2)} units from "
                           f"{describe(other)}" for other in table.others)
    against = f" It is {against} (grey in (c)), and so no limit." if against else ""
    start = (
        f"Figure {figure}. {scene}, {symbol} = {{first}} to {{last}}{_UNITS[table.key]} ({{count}} runs, else Table "
        f"4.1). The reference run has {describe(table.reference)}.{against} (a, b) At the end the wires are {{ends}} "
        "units from the reference on average over their spheres. (c) Over the run the mean distance is {least} units "
        f"at {symbol} = {{least_at}} to {{most}} at {symbol} = {{most_at}}."
    ).format(**numbers)
    said = [sentence.format(**numbers) for is_so, sentence in (*_CLAIMS[figure], *_STEPS) if is_so(table)]
    if figure in _PLATES:
        said.append(_sunk(table))
    return " ".join([start, *said]) + (f" Not shown: {'; '.join(table.missing)}." if table.missing else "")


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
_PLATES = ("4.15", "4.16", "4.17", "4.18")


def _scene(figure: str, table: ComparisonTable) -> str:
    return (f"Push of {table.reference.run.number('displacement'):g} units against a wall, the first two thirds of the "
            "wire between two plates" if figure in _PLATES else "Transversal displacement")


def maxima(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Find where a curve has local maxima that stand out by _PROMINENCE of its range, as values of x."""
    if y.size < 3 or np.ptp(y) == 0.0:
        return np.array([])
    return x[find_peaks(y, prominence=_PROMINENCE * np.ptp(y))[0]]


def _listed(values: np.ndarray) -> str:
    """Maxima as a list, the first six of many."""
    listed = ", ".join(f"{value:.4g}" for value in values[:6])
    return listed if values.size <= 6 else f"{listed} and {values.size - 6} more"


def _numbers(table: ComparisonTable) -> dict[str, str]:
    """What the sentences are filled with."""
    x, mean, swing, steps = (table.column(name) for name in ("value", "mean_distance", "swing", "step_distance"))
    small = mean[x <= _SMALL_TIME_STEP]
    return {
        "symbol": _SYMBOLS[table.key], "count": f"{x.size}", "first": f"{x[0]:g}", "last": f"{x[-1]:g}",
        "ends": span([row.end_distance.mean() for row in table.rows]),
        "least": number(mean.min()), "least_at": f"{x[mean.argmin()]:.4g}",
        "most": number(mean.max()), "most_at": f"{x[mean.argmax()]:.4g}",
        "fall": percent(1.0 - mean[-1] / mean[0]), "factor": number(mean.max() / mean.min(), 2),
        "maxima": _listed(maxima(x, mean)), "swings": _listed(maxima(x, swing)), "swing": number(swing[0]),
        "common": f"{table.common_steps}", "step_first": number(steps[0]), "step_last": number(steps[-1]),
        "own": f"{table.reference.run.number(table.key):g}",
        "small": percent(small.max() / mean.max()) if small.size else "", "linear": _linear(table),
    }


def _rises(y: np.ndarray) -> bool:
    """Return whether values grow from the first to the last, and never fall back by more than _RIPPLE of their
    range."""
    return y.size > 2 and y[-1] > y[0] and float(np.max(np.maximum.accumulate(y) - y)) <= _RIPPLE * float(np.ptp(y))


def _falls(table: ComparisonTable) -> bool:
    """Return whether the mean distance falls with the parameter, but for ripples."""
    return _rises(-table.column("mean_distance"))


def _grows_to_its_largest(table: ComparisonTable) -> bool:
    mean = table.column("mean_distance")
    return _rises(mean[:int(mean.argmax()) + 1])


def _varies(table: ComparisonTable) -> bool:
    mean = table.column("mean_distance")
    return bool(mean.max() > 1.5 * mean.min())


def _is_small_first(table: ComparisonTable) -> bool:
    x, mean = table.column("value"), table.column("mean_distance")
    return bool(np.any(x <= _SMALL_TIME_STEP) and mean[x <= _SMALL_TIME_STEP].max() < 0.05 * mean.max())


def _is_nearer_last(table: ComparisonTable) -> bool:
    mean = table.column("mean_distance")
    return bool(mean[-1] < mean[0])


def _grows_while_light(table: ComparisonTable) -> bool:
    return _rises(table.column("mean_distance")[table.column("value") <= _HEAVY])


def _falls_while_heavy(table: ComparisonTable) -> bool:
    heavy = table.column("mean_distance")[table.column("value") >= _HEAVY]
    return bool(heavy.size > 2 and heavy[-1] < heavy[0])


def _has_maxima(table: ComparisonTable) -> bool:
    return maxima(table.column("value"), table.column("mean_distance")).size > 0


def _swing_has_maxima(table: ComparisonTable) -> bool:
    return maxima(table.column("value"), table.column("swing")).size > 0


def _swing_is_one(table: ComparisonTable) -> bool:
    return relative_spread(table.column("swing")) < _SAME


def _steps_are_one(table: ComparisonTable) -> bool:
    return table.key == "timeStep" and relative_spread(table.column("step_distance")) < _SAME


def _linear(table: ComparisonTable) -> str:
    """Largest displacement up to which all wires, scaled, lie on the first within _LINEAR of it."""
    if table.key != "displacement":
        return ""
    ends = np.array([row.end_positions for row in table.rows])
    off = np.max(np.linalg.norm(ends - ends[0], axis=-1), axis=1) / table.reference.run.number("displacement")
    return f"{table.column('value')[off < _LINEAR].max():g}"


def _always(_: ComparisonTable) -> bool:
    return True


def _not(claim: Callable[[ComparisonTable], bool]) -> Callable[[ComparisonTable], bool]:
    return lambda table: not claim(table)


Claims = tuple[tuple[Callable[[ComparisonTable], bool], str], ...]


def _resonance(seen: str) -> Claims:
    """What the thesis sees, and whether it can be a resonance, which would show in the run itself."""
    return (
        (_always, f"The thesis sees {seen}."),
        (_has_maxima, "Here local maxima stand at {symbol} = {maxima}."),
        (_not(_has_maxima), "With {count} runs there is no local maximum at all."),
        (_swing_is_one, "The last sphere swings by {swing} units in every run: that is no resonance."),
        (lambda table: not _swing_is_one(table) and not _swing_has_maxima(table),
         "The last sphere's swing has no local maximum: maxima of the distance are times at which run and reference "
         "are out of step."),
        (_swing_has_maxima, "The last sphere's swing itself, over the first {common} steps, is largest near {symbol} = "
                            "{swings}."),
    )


_STEPS: Claims = (
    (_steps_are_one, "(d) At equal step number all these runs are one and the same, {step_first} units from the "
                     "reference: without forces the method does not contain Δt, and all of (c) is the clock."),
    (_not(_steps_are_one), "(d) At equal step number the distance goes from {step_first} units at {symbol} = {first} "
                           "to {step_last} at {last}."),
)
_CLAIMS: dict[str, Claims] = {
    "4.11": (
        (_falls, "As the thesis says, more solver steps come closer to the reference, by {fall} from the first run to "
                 "the last."),
        (_not(_falls), "The thesis says that more solver steps come closer; the distance does not fall all the way."),
        *_resonance("a small increase near m = 700 and suspects a resonance")),
    "4.12": (
        (_varies, "The thesis calls it almost constant; it varies by a factor of {factor}."),
        (_not(_varies), "Almost constant, as the thesis says: within a factor of {factor}."),
        *_resonance("a small increase at Δt = 0.01 s and suspects a resonance")),
    "4.13": (
        (_is_nearer_last, "More elements come closer, as the thesis says, by {fall} from the first run to the last."),
        *_resonance("more than one peak and suspects resonances")),
    "4.14": (
        (_always, "The reference has M = {own}; between the masses the distance differs by a factor of {factor}."),
        *_resonance("a distance that oscillates with M")),
    "4.14b": (
        (_always, "All motions are scaled to the reference's displacement, so that in a linear problem all wires would "
                  f"lie on one. Those up to {{linear}} units do, to {percent(_LINEAR, 1)} of the displacement."),),
    "4.15": ((_falls, "As the thesis says, the distance falls with more solver steps, by {fall} from the first run to "
                      "the last."),
             (_not(_falls), "The thesis says that it falls with more solver steps; it does not all the way.")),
    "4.16": ((_is_small_first, f"As the thesis says, it is nearly zero up to Δt = {_SMALL_TIME_STEP:g} s: at most "
                               "{small} of its largest value."),
             (_not(_is_small_first), f"The thesis has it nearly zero up to Δt = {_SMALL_TIME_STEP:g} s; it is not."),
             (_grows_to_its_largest, "It grows with Δt, as the thesis says, up to Δt = {most_at} s.")),
    "4.17": ((_falls, "As the thesis says, it falls with more elements, by {fall} from the first run to the last."),
             (_not(_falls), "The thesis sees a decreasing trend; it does not fall all the way."),
             *_resonance("some kind of resonance")),
    "4.18": ((_always, f"According to the thesis it grows with M up to {_HEAVY:g} and falls beyond."),
             (_grows_while_light, "Here it grows up to there."), (_falls_while_heavy, "Here it falls beyond."),
             *_resonance("oscillations with M")),
}


def _sunk(table: ComparisonTable) -> str:
    """Return how far the wire sinks into the wall, which the gain of the contact and the number of sweeps decide."""
    deepest = max(row.run.measured("maxPenetration") for row in table.rows)
    passed = sum(row.run.measured("passages") for row in table.rows)
    reference = table.reference.run
    return (f"With k_C = {reference.number('collisionStiffness'):g} the wall is soft: the wire sinks in by up to "
            f"{number(deepest)} of r = {reference.number('sphereRadius'):g} units, and {passed:,} of its points pass "
            "it.")
