"""Common parts of the checks of a wire in tubes: the tubes, and starts along them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from analysis.validation import scenes
from analysis.validation.wire import Wire

SECTION = "In the vessel"
GRAVITY = 9.81  # m/s^2
WIRE = Wire(radius=0.4e-3)
THIN = Wire(radius=0.18e-3)


def in_vessel(wire: Wire, vessel: Mapping[str, Any], step: float, steps: int, **more: Any) -> dict[str, Any]:
    """Parameters of a wire between walls that begins at the origin, by the scheme that they are met with."""
    return {**scenes.wire_parameters(wire), "integrator": "implicitEuler", "deltaThreshold": 0.0,
            "guidewireOffset": 0.0, "vessel": vessel, "timeStep": step, "maxSimulationSteps": steps, **more}


def tube(knots: Sequence[Sequence[float]], radius: float | list[float], friction: float = 0.0) -> dict[str, Any]:
    """Return a vessel: an open tube along a line of knots; units."""
    places = [[float(x) for x in knot] for knot in knots]
    return {"shape": "tube", "knots": places, "radius": radius, "openStart": True, "openEnd": True,
            "frictionCoefficient": friction}


def bend(radius: float, angle: float, pieces: int, before: float, after: float) -> np.ndarray:
    """Knots of a bend in the y-z plane that begins at the origin along z, straight before and after it.

    Parameters
    ----------
    radius, before, after : units.
    angle : rad.
    pieces : of the bend.

    Returns
    -------
    ndarray, shape (pieces + 3, 3)
    """
    turns = np.linspace(0.0, angle, pieces + 1)
    return np.concatenate([[[0.0, 0.0, -before]], [at_bend(radius, t) for t in turns],
                           [at_bend(radius, angle) + after * along_bend(angle)]])


def at_bend(radius: float, turn: float) -> np.ndarray:
    """Say where the centreline of a bend from the origin is when it has turned so far, units."""
    return radius * np.array([0.0, 1.0 - math.cos(turn), math.sin(turn)])


def along_bend(turn: float) -> np.ndarray:
    """Return its direction there."""
    return np.array([0.0, math.sin(turn), math.cos(turn)])


def frame_about_x(turn: float) -> list[float]:
    """Orientation of an element along a bend that has turned so far."""
    return [-math.sin(0.5 * turn), 0.0, 0.0, math.cos(0.5 * turn)]


def untwisted_frames(nodes: np.ndarray) -> list[list[float]]:
    """Orientations of elements between nodes (n + 1, 3), each the one before turned the short way, the first from z."""
    chords = np.diff(nodes, axis=0)
    chords /= np.linalg.norm(chords, axis=1)[:, None]
    frames, before, q = [], np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, 0.0, 1.0])
    for direction in chords:
        turn = np.array([*np.cross(before, direction), 1.0 + before @ direction])
        q = _product(turn / np.linalg.norm(turn), q)
        frames.append((q / np.linalg.norm(q)).tolist())
        before = direction
    return frames


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Multiply quaternions x, y, z, w."""
    return np.array([*(a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])), a[3] * b[3] - a[:3] @ b[:3]])
