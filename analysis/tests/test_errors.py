"""Displacement errors and the steady state."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from analysis.errors import displacement_errors, mean_error, steady_state_entry, total_error
from analysis.tests.chain import EPSILON, HOLD, Chain

REST = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 10.0]])


def test_displacement_error_is_the_distance_from_rest_plus_displacement() -> None:
    positions = np.array([[0.0, 0.0, 2.0], [3.0, 4.0, 12.0]])
    errors = displacement_errors(positions, REST, np.array([0.0, 0.0, 2.0]))
    np.testing.assert_allclose(errors, [0.0, 5.0])
    assert total_error(errors) == 5.0 and mean_error(errors) == 2.5


def test_errors_over_time_keep_the_shape() -> None:
    errors = displacement_errors(np.stack([REST, REST + 1.0, REST]), REST, np.zeros(3))
    np.testing.assert_allclose(errors, [[0.0, 0.0], [3.0**0.5] * 2, [0.0, 0.0]])
    np.testing.assert_allclose(total_error(errors), [0.0, 2.0 * 3.0**0.5, 0.0])


def test_mean_error_at_the_peak_near_2_19_s_is_what_the_thesis_prints(default_chain: Chain) -> None:
    """Fig. 4.4 prints 0.0049 units; the peak is entry 219 of the default run."""
    positions = np.zeros((*default_chain.z.shape, 3))
    positions[..., 2] = default_chain.z
    rest = np.zeros((default_chain.elements + 1, 3))
    rest[:, 2] = default_chain.rest
    errors = displacement_errors(positions, rest, np.array([0.0, 0.0, default_chain.displacement]))
    last = errors[:, -1]
    assert last[218] < last[219] > last[220]
    assert round(float(mean_error(errors)[219]), 4) == 0.0049


def test_steady_state_of_the_default_run_begins_at_step_197(default_chain: Chain) -> None:
    assert steady_state_entry(default_chain.prediction_error, EPSILON, HOLD) == 197


@pytest.mark.parametrize(
    ("error", "entry"),
    [
        ([0.0, 0.0, 0.0, 0.0], None),  # never above
        ([0.0, 2.0, 0.0, 0.0, 0.0], 2),
        ([2.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0, 0.0], 4),  # the first dip is too short, the later rise too late
        ([2.0, 0.0, 0.0], None),  # too short
        ([2.0, 0.0, 1.0, 0.0, 0.0], None),  # the threshold itself is not below it
        ([2.0, 0.0, np.nan, 0.0, 0.0, 0.0], 3),  # what is not a number is not below
        ([], None),
    ],
)
def test_steady_state_needs_three_entries_below_after_one_above(error: list[float], entry: int | None) -> None:
    assert steady_state_entry(np.array(error), 1.0, 3) == entry


def test_a_hold_of_zero_switches_it_off() -> None:
    assert steady_state_entry(np.array([2.0, 0.0, 0.0]), 1.0, 0) is None


@given(st.lists(st.booleans(), max_size=40), st.integers(1, 6))
def test_steady_state_agrees_with_counting(above: list[bool], hold: int) -> None:
    """Written out step by step, as a run itself has to find it."""
    expected, been_above, below = None, False, 0
    for entry, is_above in enumerate(above):
        been_above = been_above or is_above
        below = below + 1 if been_above and not is_above else 0
        if below == hold:
            expected = entry - hold + 1
            break
    assert steady_state_entry(np.where(above, 2.0, 0.5), 1.0, hold) == expected
