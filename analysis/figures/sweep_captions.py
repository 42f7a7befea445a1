"""Captions of Figures 4.5 to 4.9: what the table shows, in numbers, and how that compares with the thesis.

Each sentence of `_TEXT` stands in a caption where the table bears out what it claims, and nowhere else. `_numbers`
has what fills it in.
"""

from __future__ import annotations

import numpy as np

from analysis.slowest_mode import SlowestMode
from analysis.tables import StudyTable
from guidewire.figures.wording import beside, exponent, number, percent, relative_spread, span

_SAME = 1e-9  # relative spread up to which values that should be one number are one
_NEARLY = 0.12  # relative spread up to which a measured product is called constant

_STEADY = ("", "(c) The in-game time to the steady state goes {steady}.")
_STEP_TIME = ("is_timed", "(b) The step time is {step_time} ms (spread of the medians {step_time_spread}).")
_FOLLOWS = (
    ("", "(c) The in-game time to the steady state is {steady_in_tau} times τ."),
    ("has_wall", "(d) The computation time, its steps times the step time, goes {wall}."),
)
_TEXT: dict[str, tuple[tuple[str, str], ...]] = {
    "4.5": (
        ("", "Default run with m = {values} constraint solver steps. (a) τ goes {tau}."),
        ("is_by_iterations", "m τ/Δt is nearly constant, {sweeps} iterations: the wire relaxes by iterations, a fixed "
                             "fraction of the distance in each. The thesis speaks of growing stiffness parameters; "
                             "they stay, there are more iterations."),
        ("is_line", "(b) The step time grows by {slope} µs per solver step, a straight line to within {off_line} of "
                    "its largest value."),
        _STEADY,
        ("is_by_iterations", "The thesis did not expect it to fall; it falls because τ does."),
        ("has_wall", "(d) The cost up to there takes {wall_span} s and goes, counted in iterations and so independent "
                     "of the machine, {work}."),
        ("has_no_wall", "(d) The cost up to there goes, counted in iterations and so independent of the machine, "
                        "{work}."),
        ("waits_longer", "The thesis calls the computation time relatively constant. It rises because more iterations "
                         "leave a larger prediction error at the same distance from rest, so that the same threshold "
                         "takes {waited}."),
    ),
    "4.6": (
        ("", "Default run with n = {values} rod elements; dashed: n = 30, where neighbouring spheres touch. (a) τ is "
             "smallest, {least_tau} s, at n = {best} and largest, {most_tau} s, at n = {worst}."),
        ("varies", "The thesis sees only a small influence, here it is a factor of {factor}."),
        ("has_power", "From n = 30 on τ grows with the power {power} of n: an iteration passes a displacement on by "
                      "diffusion, in steps of one element."),
        ("loses_gain", "Below n = {best} it rises again, because long elements give most of each correction to the "
                       "orientations, along the quaternion, where normalising removes it: {best_gain} of a stretch is "
                       "taken out per iteration at n = {best}, {first_gain} at n = {first}."),
        ("is_line", "(b) The step time grows by {slope} µs per element, a straight line to within {off_line} of its "
                    "largest value."),
        *_FOLLOWS,
    ),
    "4.7": (
        ("", "Default run with displacements of {values} units. (a) τ = {tau_span} s."),
        ("is_linear", "It does not depend on the displacement (to {tau_spread} of its value), because along the wire a "
                      "step is linear in the distances from rest; the thesis finds the same and gives the solver's "
                      "efficiency as the reason."),
        _STEP_TIME,
        ("grows_by_decade", "(c, d) The time to the steady state is no constant: it grows by {by_decade} s per tenfold "
                            "displacement, as it must where a motion that decays with τ has to come below a threshold "
                            "of fixed length (τ ln 10 = {decay} s, in whole half periods of the oscillation). The "
                            "thesis sees barely any influence."),
    ),
    "4.8": (
        ("", "Default run with Δt = {values} s. (a) τ goes {tau}, τ/Δt = {tau_in_steps} steps."),
        ("is_one_motion", "It is perfectly linear, as in the thesis. The thesis's reason, more iterations in the same "
                          "in-game time, is only part of the answer: without forces the method, step by step, does not "
                          "contain Δt at all. All these runs are one and the same sequence of positions (same Δx at "
                          "the end, steady from step {first_steady} on) with another time written beside each step."),
        _STEP_TIME,
        _STEADY,
        ("has_wall", "(d) The computation time is {wall_of_all} s (spread of the medians {wall_spread})."),
    ),
    "4.9": (
        ("", "Default run with M = {values} units of mass. (a) τ goes {tau}."),
        ("is_by_gain", "The thesis explains this by inertia. But the spheres' masses cancel between spheres; M acts "
                       "only against the orientations, whose weight stays 1: heavy spheres leave most of each "
                       "correction to the orientations, where normalising removes it. {first_gain} of a stretch is "
                       "taken out per iteration at M = {first_mass}, {last_gain} at M = {last_mass}, and τ times this "
                       "fraction varies by {gain_spread} only. The two weights are equal at M = (n+1)/(2 l²) = {knee}; "
                       "far below, τ no longer depends on M."),
        _STEP_TIME,
        _STEADY,
        ("has_wall", "(d) The computation time is {wall_in_time} s of real time for each in-game second."),
        ("wall_is_time", "The thesis has it grow more than the in-game time, which no constant step time allows."),
    ),
}
_TEXT_OF_ALL = (
    ("has_ended_early", "(e) At the end Δx is {errors} units: the steps in which a run must hold still before it stops "
                        "are {relaxations} relaxation times, in which the error goes on decaying."),
    ("has_ended_late", "(e) At the end Δx is {errors} units."),
    ("", "Grey: the slowest mode in closed form, without a fit; it is within {off_tau} of τ{off_steady}. Fitted to all "
         "samples from a period after the first peak on, that mode has a τ within {off_fit} of that of the peaks."),
    ("has_repeats", "Wall times: median and range of {repeats} runs, made one at a time, {beside}; the range of the "
                    "step time is at most {widest} of the median."),
    ("has_no_repeats", "No run of this study was timed."),
)
_SYMBOLS = {"4.5": "m", "4.6": "n", "4.7": "", "4.8": "Δt", "4.9": "M"}


def sweep_caption(figure: str, table: StudyTable) -> str:
    """Return the caption of one of Figures 4.5 to 4.9."""
    if not np.any(np.isfinite(table.column("relaxation.time"))):
        return f"Figure {figure}. No run of this study relaxed." + _left_out(table)
    known = _numbers(table, _SYMBOLS[figure])
    said = [text.format(**known) for claim, text in (*_TEXT[figure], *_TEXT_OF_ALL) if not claim or known[claim]]
    return " ".join([f"Figure {figure}.", *said]) + _left_out(table)


def _numbers(table: StudyTable, symbol: str) -> dict[str, str | bool]:
    """What the sentences claim, true or false, and what they are filled with."""
    x, tau, dt, steady = (table.column(name) for name in (
        "value", "relaxation.time", "time_step", "steady_state_time"))
    wall, steady_step, errors = (table.column(name) for name in (
        "computation_time.median", "steady_state_step", "total_error"))
    modes = [SlowestMode.of(row.run) for row in table.rows]
    gains = np.array([mode.effective_gain for mode in modes])
    best, worst = int(np.nanargmin(tau)), int(np.nanargmax(tau))
    sweeps, work, waited, fine = x * tau / dt, x * steady_step, steady / tau, x >= 30
    run = table.rows[0].run
    length = run.number("guidewireLength") / run.number("numberRodElements")
    is_by_iterations = relative_spread(sweeps) < _NEARLY
    is_known = np.isfinite(steady)
    is_same = np.all(steady_step == steady_step[0]) and (np.all(np.isnan(errors)) or relative_spread(errors) < 1e-6)
    has_wall = bool(np.any(np.isfinite(wall)))
    return {
        "values": f"{x.min():g} to {x.max():g}", "tau": _ends(x, tau, symbol, " s"),
        "tau_span": span(tau, 4), "tau_spread": number(relative_spread(tau), 1), "tau_in_steps": span(tau / dt, 4),
        "steady": _ends(x, steady, symbol, " s"), "steady_in_tau": span(waited, 2),
        "has_wall": has_wall, "has_no_wall": not has_wall, "wall": _ends(x, wall, symbol, " s"),
        "wall_span": span(wall, 2), "wall_of_all": span(wall), "wall_spread": percent(relative_spread(wall)),
        "wall_in_time": span(wall / steady), "wall_is_time": relative_spread(wall / steady) < _NEARLY,
        "is_by_iterations": is_by_iterations, "sweeps": span(sweeps), "work": _ends(x, work, symbol, ""),
        "waits_longer": relative_spread(work) > _NEARLY and _rises(x, waited), "waited": _ends(x, waited, symbol, " τ"),
        "least_tau": number(tau[best]), "best": f"{x[best]:g}",
        "most_tau": number(tau[worst]), "worst": f"{x[worst]:g}",
        "varies": tau[worst] > 2.0 * tau[best], "factor": number(tau[worst] / tau[best], 2),
        "has_power": np.count_nonzero(fine) > 2,
        "power": number(exponent(x[fine], tau[fine]), 2) if np.count_nonzero(fine) > 2 else "",
        "loses_gain": best > 0 and _rises(x, gains), "best_gain": number(gains[best], 2), "first": f"{x[0]:g}",
        "first_gain": number(gains[0], 2), "last_gain": number(gains[-1], 2),
        "first_mass": number(x[0], 1), "last_mass": number(x[-1], 1),
        "is_by_gain": relative_spread(tau * gains) < 2.0 * _NEARLY and _rises(x, tau),
        "gain_spread": percent(relative_spread(tau * gains)),
        "knee": number((run.number("numberRodElements") + 1) / (2.0 * length * length), 2),
        "is_linear": relative_spread(tau) < 1e-3,
        "grows_by_decade": np.count_nonzero(is_known) > 2 and _rises(x[is_known], steady[is_known]),
        "by_decade": number(np.polyfit(np.log10(x[is_known]), steady[is_known], 1)[0])
        if np.count_nonzero(is_known) > 2 else "",
        "decay": number(np.nanmedian(tau) * np.log(10.0)),
        "is_one_motion": relative_spread(tau / dt) < _SAME and is_same, "first_steady": f"{steady_step[0]:g}",
        **_step_times(table), **_agreement(table, modes), **_end_of_run(table),
    }


def _ends(x: np.ndarray, y: np.ndarray, name: str, unit: str) -> str:
    """ "from Y unit at name = X to Y unit at name = X", over the rows that have a value."""
    known = np.flatnonzero(np.isfinite(y))
    if known.size == 0:
        return "nowhere, no run has a value"
    first, last = known[0], known[-1]
    ends = (f"{number(y[row])}{unit} at {name} = {x[row]:g}" for row in (first, last))
    return "from " + " to ".join(ends)


def _rises(x: np.ndarray, y: np.ndarray) -> bool:
    """Return whether y, a measured quantity, grows from the smallest x to the largest and on most of the way."""
    order = np.argsort(x)
    change = np.diff(y[order])
    return bool(y[order[-1]] > y[order[0]] and np.count_nonzero(change > 0) >= 0.75 * change.size)


def _step_times(table: StudyTable) -> dict[str, str | bool]:
    """Return the median step time, also as a straight line in the parameter, and what was timed."""
    x, y = table.column("value"), table.column("step_time.median")
    known = np.isfinite(y)
    spreads = [row.step_time for row in table.rows if row.step_time is not None]
    said: dict[str, str | bool] = {
        "is_timed": bool(known.any()), "step_time": span(y), "step_time_spread": percent(relative_spread(y)),
        "is_line": np.count_nonzero(known) > 2, "has_repeats": bool(spreads), "has_no_repeats": not spreads}
    if said["is_line"]:
        line = np.polyfit(x[known], y[known], 1)
        off = np.max(np.abs(y[known] - np.polyval(line, x[known]))) / np.max(y[known])
        said |= {"slope": number(1000.0 * line[0]), "off_line": percent(off)}
    if spreads:
        counts = sorted({spread.count for spread in spreads})
        said |= {"repeats": f"{counts[0]}" if len(counts) == 1 else f"{counts[0]} to {counts[-1]}",
                 "beside": beside([row.others_busy for row in table.rows]),
                 "widest": percent(max((one.highest - one.lowest) / one.median for one in spreads))}
    return said


def _agreement(table: StudyTable, modes: list[SlowestMode]) -> dict[str, str]:
    """Return how far the measured values are from the slowest mode's closed form, the grey lines."""
    tau = np.array([mode.relaxation_time for mode in modes]) / table.column("relaxation.time") - 1.0
    steady = np.array([mode.steady_state_time for mode in modes]) / table.column("steady_state_time") - 1.0
    own = np.abs(table.column("relaxation.slowest_time") / table.column("relaxation.time") - 1.0)
    return {"off_tau": percent(np.nanmax(np.abs(tau))), "off_fit": percent(np.nanmax(own)),
            "off_steady": f" and within {percent(np.nanmax(np.abs(steady)))} of the time to the steady state"
            if np.any(np.isfinite(steady)) else ""}


def _end_of_run(table: StudyTable) -> dict[str, str | bool]:
    """Return the total error at the end, which depends on where a run stops."""
    errors = table.column("total_error")
    waited = (table.column("steps") - table.column("steady_state_step")) * table.column("time_step")
    relaxations = waited / table.column("relaxation.time")
    known = np.isfinite(relaxations) & (errors > 0.0)
    has_error = bool(np.any(errors > 0.0))
    decays = bool(np.count_nonzero(known) >= 4
                  and all(relative_spread(values[known]) > _NEARLY for values in (relaxations, errors))
                  and np.corrcoef(relaxations[known], np.log(errors[known]))[0, 1] < -0.8)
    return {"has_ended_early": has_error and decays, "has_ended_late": has_error and not decays,
            "errors": span(errors), "relaxations": span(relaxations, 2)}


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
