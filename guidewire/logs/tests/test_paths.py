"""The path of a wire where it comes out of catheters."""

from __future__ import annotations

import numpy as np
import pytest

from guidewire.logs.paths import lengths_of, through_tips

BEND = 12.0  # mm, radius of a catheter's tip


def arc(stations: np.ndarray) -> np.ndarray:
    """A straight way of 30 mm, a quarter of a circle, then straight on."""
    angle = np.clip((stations - 30.0) / BEND, 0.0, 0.5 * np.pi)
    before, after = np.minimum(stations, 30.0), np.maximum(stations - 30.0 - 0.5 * np.pi * BEND, 0.0)
    return np.stack([BEND * (1.0 - np.cos(angle)) + after, 0.0 * stations, before + BEND * np.sin(angle)], axis=1)


TIP = 30.0 + 0.5 * np.pi * BEND  # the catheter ends at the end of the bend


@pytest.mark.parametrize("ahead", [0.5, 2.0, 4.9, 12.3])
def test_the_element_that_comes_out_is_bent_at_the_tip_and_no_other(ahead: float) -> None:
    wire = arc(TIP + ahead - 5.0 * np.arange(12)[::-1])
    catheter = arc(np.linspace(0.0, TIP, 40))
    points, of_pieces = through_tips(wire, [catheter], np.full(11, 5.0))
    assert len(points) == 13 and len(of_pieces) == 12
    at, = np.flatnonzero((points == catheter[-1]).all(axis=1))
    np.testing.assert_array_equal(np.delete(points, at, axis=0), wire)
    assert of_pieces[at - 1] == of_pieces[at] == 11 - int(np.ceil(ahead / 5.0))
    # The piece beyond lies on the wire's true way; the chord is off it.
    middle = 0.5 * (points[at] + points[at + 1])
    assert np.linalg.norm(arc(np.linspace(0.0, TIP + ahead, 20001)) - middle, axis=1).min() < 2e-3


def test_a_compressed_element_beside_a_tip_is_not_taken_for_the_one_that_comes_out() -> None:
    wire = arc(TIP + 0.3 - 5.0 * np.arange(12)[::-1])    # node 11 is 0.3 beyond the tip
    wire = np.concatenate([wire, wire[-1:] + [4.4, 0.0, 0.0]])    # of 5.0
    catheter = arc(np.linspace(0.0, TIP, 40))
    points, of_pieces = through_tips(wire, [catheter], np.full(12, 5.0))
    at, = np.flatnonzero((points == catheter[-1]).all(axis=1))
    assert of_pieces[at - 1] == of_pieces[at] == 10


def test_a_wire_inside_its_catheter_stays_as_it_is() -> None:
    catheter = arc(np.linspace(0.0, TIP, 40))
    for behind in (0.1, 3.0, 20.0):
        wire = arc(TIP - behind - 5.0 * np.arange(8)[::-1])
        assert through_tips(wire, [catheter], np.full(7, 5.0))[0] is wire


def test_of_two_catheters_both_tips_are_on_the_way() -> None:
    wire = arc(TIP + 13.0 - 5.0 * np.arange(12)[::-1])
    outer, inner = arc(np.linspace(0.0, 35.0, 20)), arc(np.linspace(0.0, TIP + 4.0, 40))
    points, of_pieces = through_tips(wire, [outer, inner], np.full(11, 5.0))
    assert len(points) == 14 and (np.diff(of_pieces) >= 0).all()
    order = [int(np.flatnonzero((points == one[-1]).all(axis=1))[0]) for one in (outer, inner)]
    assert order[0] < order[1]


def test_lengths_are_those_of_the_moments_in_which_elements_are_straight() -> None:
    moments = np.stack([arc(end - 5.0 * np.arange(12)[::-1]) for end in (30.0, 80.0, 110.0)])
    np.testing.assert_allclose(lengths_of(moments), 5.0, rtol=1e-9)
