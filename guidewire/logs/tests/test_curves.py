"""Distances from a smooth curve, against those of a circle."""

import numpy as np

from guidewire.logs.curves import by_arc, offsets, smooth


def test_offsets_are_those_of_the_circle_and_do_not_jump_between_pieces():
    """From a circle a point at the distance r from its centre has the offset r - R along its radius; inside it, too."""
    radius = 50.0
    angles = np.linspace(0.0, 3.0, 17)
    nodes = radius * np.stack([np.cos(angles), np.sin(angles), 0.0 * angles], axis=1)
    at = np.linspace(0.3, 2.7, 500)
    directions = np.stack([np.cos(at), np.sin(at), 0.0 * at], axis=1)
    for distance in (-20.0, -2.0, 0.5, 30.0):
        found, along = offsets((radius + distance) * directions, smooth(nodes))
        assert np.max(np.abs(found - distance * directions)) < 2e-4 * radius
        assert np.max(np.abs(along - at / 3.0 * 128.0)) < 0.02


def test_points_beyond_the_ends_are_measured_from_the_ends():
    line = np.array([[0.0, 0.0], [1.0, 0.0]])
    found, along = offsets(np.array([[-3.0, 4.0], [0.25, 2.0], [2.0, 0.0]]), line)
    assert np.allclose(found, [[-3.0, 4.0], [0.0, 2.0], [1.0, 0.0]]) and np.allclose(along, [0.0, 0.25, 1.0])


def test_fractions_of_a_chain_are_of_its_length():
    line = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 3.0]])
    found = by_arc(line, np.array([0.125, 0.25, 0.5, 1.0]))
    assert np.allclose(found, [[0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, 3.0]])


def test_points_that_coincide_are_one():
    """A wire that is seen end on is a point, and one that is seen nearly so has some points in one place."""
    found, along = offsets(np.array([[3.0, 4.0]]), np.zeros((9, 2)))
    assert np.allclose(found, [[3.0, 4.0]]) and np.allclose(along, 0.0)
    line = np.array([[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [2.0, 0.0]])
    found, along = offsets(np.array([[1.5, 2.0], [0.5, -1.0]]), line)
    assert np.allclose(found, [[0.0, 2.0], [0.0, -1.0]]) and np.allclose(along, [3.0, 1.0])
