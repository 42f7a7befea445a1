"""The closed form against the sweep itself: as a matrix, and as a run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from guidewire.logs.relaxation import fit_relaxation
from analysis.slowest_mode import SlowestMode
from analysis.tests.chain import EPSILON, Chain
from guidewire.logs.runs import Run


def mode_of(chain: Chain) -> SlowestMode:
    return SlowestMode.of(Run(Path(), chain.parameters, None))


def slowest_factor(chain: Chain) -> float:
    """Largest eigenvalue of m sweeps, each the product of its links' corrections of the free spheres 1 to n."""
    n, l, weight = chain.elements, chain.length / chain.elements, (chain.elements + 1) / chain.total_mass
    sweep = np.eye(n + 1)
    for j in range(n):
        first = 0.0 if j == 0 else weight
        fraction = chain.stretch_gain / (first + weight + 4.0 * l * l)
        link = np.eye(n + 1)
        link[j, [j, j + 1]] += fraction * first * np.array([-1.0, 1.0])
        link[j + 1, [j, j + 1]] -= fraction * weight * np.array([-1.0, 1.0])
        sweep = link @ sweep
    return float(np.max(np.abs(np.linalg.eigvals(sweep[1:, 1:])))) ** chain.constraint_solver_steps


@pytest.mark.parametrize(
    "changed",
    [
        {},
        {"constraint_solver_steps": 100},
        {"constraint_solver_steps": 1000},
        {"elements": 60},
        {"elements": 10},
        {"total_mass": 1e-3},
        {"total_mass": 1.0},
        {"stretch_gain": 0.3},
    ],
)
def test_decay_is_the_slowest_eigenvalue_of_the_sweeps(changed: dict) -> None:
    """tau = -2 dt/ln a and cos(2 pi dt/T) = sqrt(a). The chain's discreteness costs the closed form below 1 %."""
    chain = Chain(**{"most_steps": 0, **changed})
    a, mode = slowest_factor(chain), mode_of(chain)
    assert mode.relaxation_time == pytest.approx(-2.0 * chain.time_step / np.log(a), rel=0.01)
    assert mode.period == pytest.approx(2.0 * np.pi * chain.time_step / np.arccos(a**0.5), rel=0.01)


def test_run_shows_the_closed_form(default_chain: Chain) -> None:
    """The fit contains the start, where other modes take part; at Table 4.1 they cost below 1 %."""
    mode = mode_of(default_chain)
    fit = fit_relaxation(
        default_chain.time, np.abs(default_chain.z[:, -1] - default_chain.rest[-1] - default_chain.displacement)
    )
    assert fit.time == pytest.approx(mode.relaxation_time, rel=0.01)
    assert fit.period == pytest.approx(mode.period, rel=0.01)
    # The envelope goes through the turning points, which the decay shifts: there |cos| is w tau/sqrt(1 + (w tau)^2).
    turn = 2.0 * np.pi * mode.relaxation_time / mode.period
    touching = turn / np.hypot(1.0, turn)
    assert fit.amplitude == pytest.approx(4.0 / np.pi * touching * default_chain.displacement, rel=0.02)
    # The envelope crosses the threshold at most half a period, the distance of its peaks, after the error itself.
    late = mode.steady_state_time - default_chain.steady_state_step * default_chain.time_step
    assert 0.0 <= late <= 0.5 * mode.period


def test_prediction_error_is_the_sweeps_fraction_of_the_next_distance(default_chain: Chain) -> None:
    """Delta_p = (1 - a)/a |u_{k+1}|, once the other modes are gone."""
    a = slowest_factor(default_chain)
    distance = np.abs(default_chain.z[:, -1] - default_chain.rest[-1] - default_chain.displacement)
    late = slice(100, 200)
    np.testing.assert_allclose(
        default_chain.prediction_error[late], (1.0 - a) / a * distance[late], rtol=1e-3, atol=1e-3 * EPSILON
    )


def test_below_the_threshold_from_the_start_is_steady_at_once() -> None:
    assert mode_of(Chain(displacement=1e-4, most_steps=0)).steady_state_time == 0.0


def test_without_a_threshold_there_is_no_steady_state() -> None:
    parameters = {**Chain(most_steps=0).parameters, "deltaThreshold": 0.0}
    assert SlowestMode.of(Run(Path(), parameters, None)).steady_state_time == np.inf
