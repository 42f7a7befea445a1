"""Captions of Figures 4.5 to 4.9: what the table shows, in numbers, and how that compares with the thesis.

A sentence that claims a relation stands behind a test of this relation on the table, so that a table that shows
something else gets another caption.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from analysis.slowest_mode import SlowestMode
from analysis.tables import StudyTable
from guidewire.figures.wording import beside, exponent, number, percent, relative_spread, span

_SAME = 1e-9  # relative spread up to which values that should be one number are one
_NEARLY = 0.12  # relative spread up to which a measured product is called constant


def sweep_caption(figure: str, table: StudyTable) -> str:
    """Return the caption of one of Figures 4.5 to 4.9."""
    if not np.any(np.isfinite(table.column("relaxation.time"))):
        return f"Figure {figure}. No run of this study relaxed." + _left_out(table)
    sentences = _CAPTIONS[figure](table) + [_end_of_run(table), _closed_form(table), _repeats(table)]
    return f"Figure {figure}. " + " ".join(sentence for sentence in sentences if sentence) + _left_out(table)


def _solver_steps(table: StudyTable) -> list[str]:
    m, tau, dt = table.column("value"), table.column("relaxation.time"), table.column("time_step")
    sentences = [f"Default run with m = {_values(m)} constraint solver steps. (a) τ goes {_ends(m, tau, 'm', ' s')}."]
    sweeps = m * tau / dt
    if relative_spread(sweeps) < _NEARLY:
        sentences.append(
            f"m τ/Δt is nearly constant, {span(sweeps)} iterations: the wire relaxes by iterations, a fixed "
            f"fraction of the distance in each. The thesis speaks of growing stiffness parameters; they stay, there "
            f"are more iterations."
        )
    sentences.append(_straight(table, "(b) The step time", "solver step"))
    sentences.append(_steady(table, "m"))
    if relative_spread(sweeps) < _NEARLY:
        sentences.append("The thesis did not expect it to fall; it falls because τ does.")
    work = m * table.column("steady_state_step")
    wall = table.column("computation_time.median")
    seconds = f"takes {span(wall, 2)} s and " if np.any(np.isfinite(wall)) else ""
    sentences.append(
        f"(d) The cost up to there {seconds}goes, counted in iterations and so independent of the machine, "
        f"{_ends(m, work, 'm', '')}."
    )
    waited = table.column("steady_state_time") / tau
    if relative_spread(work) > _NEARLY and _rises(m, waited):
        sentences.append(
            f"The thesis calls the computation time relatively constant. It rises because more iterations leave a "
            f"larger prediction error at the same distance from rest, so that the same threshold takes "
            f"{_ends(m, waited, 'm', ' τ')}."
        )
    return sentences


def _rod_elements(table: StudyTable) -> list[str]:
    n, tau = table.column("value"), table.column("relaxation.time")
    best = int(np.nanargmin(tau))
    gains = np.array([SlowestMode.of(row.run).effective_gain for row in table.rows])
    sentences = [
        f"Default run with n = {_values(n)} rod elements; dashed: n = 30, where neighbouring spheres touch. (a) τ is "
        f"smallest, {number(tau[best])} s, at n = {n[best]:g} and largest, {number(np.nanmax(tau))} s, at n = "
        f"{n[np.nanargmax(tau)]:g}."
    ]
    factor = np.nanmax(tau) / np.nanmin(tau)
    if factor > 2.0:
        sentences.append(f"The thesis sees only a small influence, here it is a factor of {number(factor, 2)}.")
    fine = n >= 30
    if np.count_nonzero(fine) > 2:
        sentences.append(
            f"From n = 30 on τ grows with the power {number(exponent(n[fine], tau[fine]), 2)} of n: an "
            f"iteration passes a displacement on by diffusion, in steps of one element."
        )
    if best > 0 and _rises(n, gains):
        sentences.append(
            f"Below n = {n[best]:g} it rises again, because long elements give most of each correction to the "
            f"orientations, along the quaternion, where normalising removes it: {number(gains[best], 2)} of a stretch "
            f"is taken out per iteration at n = {n[best]:g}, {number(gains[0], 2)} at n = {n[0]:g}."
        )
    sentences.append(_straight(table, "(b) The step time", "element"))
    sentences.append(_follows(table, n, "n"))
    return sentences


def _displacement(table: StudyTable) -> list[str]:
    size, tau, steady = table.column("value"), table.column("relaxation.time"), table.column("steady_state_time")
    sentences = [f"Default run with displacements of {_values(size)} units. (a) τ = {span(tau, 4)} s."]
    if relative_spread(tau) < 1e-3:
        sentences.append(
            f"It does not depend on the displacement (to {number(relative_spread(tau), 1)} of its value), because "
            f"along the wire a step is linear in the distances from rest; the thesis finds the same and gives the "
            f"solver's efficiency as the reason."
        )
    sentences.append(_constant(table, "(b) The step time"))
    known = np.isfinite(steady)
    if np.count_nonzero(known) > 2 and _rises(size[known], steady[known]):
        slope = np.polyfit(np.log10(size[known]), steady[known], 1)[0]
        expected = np.nanmedian(tau) * np.log(10.0)
        sentences.append(
            f"(c, d) The time to the steady state is no constant: it grows by {number(slope)} s per tenfold "
            f"displacement, as it must where a motion that decays with τ has to come below a threshold of fixed length "
            f"(τ ln 10 = {number(expected)} s, in whole half periods of the oscillation). The thesis sees barely any "
            f"influence."
        )
    return sentences


def _time_step(table: StudyTable) -> list[str]:
    dt, tau = table.column("value"), table.column("relaxation.time")
    in_steps, steps = tau / dt, table.column("steady_state_step")
    sentences = [
        f"Default run with Δt = {_values(dt)} s. (a) τ goes {_ends(dt, tau, 'Δt', ' s')}, τ/Δt = "
        f"{span(in_steps, 4)} steps."
    ]
    errors = table.column("total_error")
    same_motion = np.all(steps == steps[0]) and (np.all(np.isnan(errors)) or relative_spread(errors) < 1e-6)
    if relative_spread(in_steps) < _SAME and same_motion:
        sentences.append(
            "It is perfectly linear, as in the thesis. The thesis's reason, more iterations in the same in-game time, "
            "is only part of the answer: without forces the method, step by step, does not contain Δt at all. All "
            f"these runs are one and the same sequence of positions (same Δx at the end, steady from step {steps[0]:g} "
            "on) with another time written beside each step."
        )
    sentences.append(_constant(table, "(b) The step time"))
    sentences.append(_steady(table, "Δt"))
    sentences.append(_constant(table, "(d) The computation time", "computation_time", "s"))
    return sentences


def _total_mass(table: StudyTable) -> list[str]:
    mass, tau = table.column("value"), table.column("relaxation.time")
    gains = np.array([SlowestMode.of(row.run).effective_gain for row in table.rows])
    run = table.rows[0].run
    length = run.number("guidewireLength") / run.number("numberRodElements")
    knee = (run.number("numberRodElements") + 1) / (2.0 * length * length)
    sentences = [f"Default run with M = {_values(mass)} units of mass. (a) τ goes {_ends(mass, tau, 'M', ' s')}."]
    if relative_spread(tau * gains) < 2.0 * _NEARLY and _rises(mass, tau):
        sentences.append(
            f"The thesis explains this by inertia. But the spheres' masses cancel between spheres; M acts only against "
            f"the orientations, whose weight stays 1: heavy spheres leave most of each correction to the orientations, "
            f"where normalising removes it. {number(gains[0], 2)} of a stretch is taken out per iteration at M = "
            f"{number(mass[0], 1)}, {number(gains[-1], 2)} at M = {number(mass[-1], 1)}, and τ times this fraction "
            f"varies by {percent(relative_spread(tau * gains))} only. The two weights are equal at M = (n+1)/(2 l²) = "
            f"{number(knee, 2)}; far below, τ no longer depends on M."
        )
    sentences.append(_constant(table, "(b) The step time"))
    steady = table.column("steady_state_time")
    sentences.append(_steady(table, "M"))
    wall = table.column("computation_time.median")
    if np.any(np.isfinite(wall / steady)):
        sentences.append(
            f"(d) The computation time is {span(wall / steady)} s of real time for each in-game second."
        )
        if relative_spread(wall / steady) < _NEARLY:
            sentences.append("The thesis has it grow more than the in-game time, which no constant step time allows.")
    return sentences


_CAPTIONS: dict[str, Callable[[StudyTable], list[str]]] = {
    "4.5": _solver_steps,
    "4.6": _rod_elements,
    "4.7": _displacement,
    "4.8": _time_step,
    "4.9": _total_mass,
}


def _values(x: np.ndarray) -> str:
    """Return the range of the parameter, as it was set."""
    return f"{x.min():g} to {x.max():g}"


def _ends(x: np.ndarray, y: np.ndarray, name: str, unit: str) -> str:
    """ "from Y unit at name = X to Y unit at name = X", over the rows that have a value."""
    known = np.flatnonzero(np.isfinite(y))
    if known.size == 0:
        return "nowhere, no run has a value"
    first, last = known[0], known[-1]
    ends = (f"{number(y[row])}{unit} at {name} = {x[row]:g}" for row in (first, last))
    return "from " + " to ".join(ends)


def _steady(table: StudyTable, name: str) -> str:
    ends = _ends(table.column("value"), table.column("steady_state_time"), name, " s")
    return f"(c) The in-game time to the steady state goes {ends}."


def _rises(x: np.ndarray, y: np.ndarray) -> bool:
    """Return whether y, a measured quantity, grows from the smallest x to the largest and on most of the way."""
    order = np.argsort(x)
    change = np.diff(y[order])
    return bool(y[order[-1]] > y[order[0]] and np.count_nonzero(change > 0) >= 0.75 * change.size)


def _straight(table: StudyTable, subject: str, per: str) -> str:
    """Return the median step time as a straight line in the parameter, with what it misses."""
    x, y = table.column("value"), table.column("step_time.median")
    known = np.isfinite(y)
    if np.count_nonzero(known) < 3:
        return ""
    line = np.polyfit(x[known], y[known], 1)
    off = np.max(np.abs(y[known] - np.polyval(line, x[known]))) / np.max(y[known])
    return (
        f"{subject} grows by {number(1000.0 * line[0])} µs per {per}, a straight line to within {percent(off)} of its "
        f"largest value."
    )


def _constant(table: StudyTable, subject: str, name: str = "step_time", unit: str = "ms") -> str:
    y = table.column(f"{name}.median")
    if not np.any(np.isfinite(y)):
        return ""
    return f"{subject} is {span(y)} {unit} (spread of the medians {percent(relative_spread(y))})."


def _follows(table: StudyTable, x: np.ndarray, name: str) -> str:
    """Return how the in-game time to the steady state goes with tau, and what the computation time makes of it."""
    tau, steady = table.column("relaxation.time"), table.column("steady_state_time")
    wall = table.column("computation_time.median")
    sentence = f"(c) The in-game time to the steady state is {span(steady / tau, 2)} times τ."
    if not np.any(np.isfinite(wall)):
        return sentence
    return f"{sentence} (d) The computation time, its steps times the step time, goes {_ends(x, wall, name, ' s')}."


def _closed_form(table: StudyTable) -> str:
    """Return how far the measured values are from the slowest mode's closed form, the grey lines."""
    modes = [SlowestMode.of(row.run) for row in table.rows]
    tau = np.array([mode.relaxation_time for mode in modes]) / table.column("relaxation.time") - 1.0
    steady = np.array([mode.steady_state_time for mode in modes]) / table.column("steady_state_time") - 1.0
    off = f"{percent(np.nanmax(np.abs(tau)))} of τ"
    if np.any(np.isfinite(steady)):
        off += f" and within {percent(np.nanmax(np.abs(steady)))} of the time to the steady state"
    own = np.abs(table.column("relaxation.slowest_time") / table.column("relaxation.time") - 1.0)
    return f"Grey: the slowest mode in closed form, without a fit; it is within {off}. Fitted to all samples from a " \
           f"period after the first peak on, that mode has a τ within {percent(np.nanmax(own))} of that of the peaks."


def _end_of_run(table: StudyTable) -> str:
    """Return the total error at the end, which depends on where a run stops."""
    errors = table.column("total_error")
    if not np.any(errors > 0.0):
        return ""
    sentence = f"(e) At the end Δx is {span(errors)} units"
    waited = (table.column("steps") - table.column("steady_state_step")) * table.column("time_step")
    relaxations = waited / table.column("relaxation.time")
    known = np.isfinite(relaxations) & (errors > 0.0)
    varied = all(relative_spread(values[known]) > _NEARLY for values in (relaxations, errors))
    if np.count_nonzero(known) < 4 or not varied:
        return sentence + "."
    if np.corrcoef(relaxations[known], np.log(errors[known]))[0, 1] < -0.8:
        return (
            f"{sentence}: the steps in which a run must hold still before it stops are {span(relaxations, 2)} "
            f"relaxation times, in which the error goes on decaying."
        )
    return sentence + "."


def _repeats(table: StudyTable) -> str:
    spreads = [row.step_time for row in table.rows if row.step_time is not None]
    if not spreads:
        return "No run of this study was timed."
    counts = sorted({spread.count for spread in spreads})
    counted = f"{counts[0]}" if len(counts) == 1 else f"{counts[0]} to {counts[-1]}"
    widest = max((spread.highest - spread.lowest) / spread.median for spread in spreads)
    return (
        f"Wall times: median and range of {counted} runs, made one at a time, "
        f"{beside([row.others_busy for row in table.rows])}; the range of the step time is "
        f"at most {percent(widest)} of the median."
    )


def _left_out(table: StudyTable) -> str:
    """Return what the figure could not show."""
    notes = [f"{row.run.key}: {row.no_relaxation}" for row in table.rows if row.no_relaxation]
    notes += [
        f"{row.run.key}: no steady state ({row.run.outcome} at step {row.steps})"
        for row in table.rows if row.steady_state_step is None
    ]
    notes += [f"{row.run.key}: log cut short at step {row.steps}" for row in table.rows if row.warning]
    notes += [f"{key}: not run" for key in table.missing]
    return f" Not shown: {'; '.join(notes)}." if notes else ""
