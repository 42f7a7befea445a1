"""One step of the thesis's rod a second time, in numpy, written from the equations only and slow.

Prediction (thesis, eqs. 2.5 to 2.7), stretch and bend-twist constraints (Kugelstadt and Schoemer 2016) multiplied by
gains, velocity update (thesis, eq. 2.4). Quaternions are arrays x, y, z, w. Nothing here is shared with the C# code.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

E3_CONJUGATE = np.array([0.0, 0.0, -1.0, 0.0])


@dataclass(frozen=True)
class Rod:
    """What does not change during a run.

    Attributes
    ----------
    element_length : l, units.
    inverse_masses : shape (n+1,), 1/mass unit; 0 holds a sphere.
    stretch_gain, bend_gain : multiply every correction.
    iterations : m.
    bilateral : sweep from both ends inwards instead of from sphere 0 to the last.
    verlet : prediction from the last two positions instead of from the velocity.
    time_step : s.
    damping : fraction of the velocity lost a step.
    gravity : shape (3,), units/s^2.
    """

    element_length: float
    inverse_masses: np.ndarray
    stretch_gain: float
    bend_gain: float
    iterations: int
    bilateral: bool
    verlet: bool
    time_step: float
    damping: float
    gravity: np.ndarray


@dataclass
class State:
    """What a step changes: x, v (n+1, 3), q (n, 4), angular velocity in the body frame (n, 3), x one step before."""

    positions: np.ndarray
    velocities: np.ndarray
    orientations: np.ndarray
    angular_velocities: np.ndarray
    positions_before: np.ndarray | None = None
    prediction_error: float = 0.0


def step(rod: Rod, state: State) -> State:
    """The state one time step later."""
    predicted, turned = predict(rod, state)
    x, q = predicted.copy(), turned.copy()
    elements = sweep_order(len(q), rod.bilateral)
    joints = sweep_order(len(q) - 1, rod.bilateral)
    for _ in range(rod.iterations):
        for j in elements:
            stretch(rod, x, q, j)
        for j in joints:
            bend_twist(rod, q, j)
    free = rod.inverse_masses[:, np.newaxis] > 0.0
    return State(
        positions=x,
        velocities=np.where(free, (x - state.positions) / rod.time_step, 0.0),
        orientations=q,
        angular_velocities=np.array([
            2.0 / rod.time_step * product(conjugate(old), new)[:3] for old, new in zip(state.orientations, q)
        ]),
        positions_before=state.positions,
        prediction_error=float(np.linalg.norm(predicted[-1] - x[-1])),
    )


def predict(rod: Rod, state: State) -> tuple[np.ndarray, np.ndarray]:
    """Positions (n+1, 3) and orientations (n, 4) without constraints."""
    dt, d = rod.time_step, rod.damping
    if rod.verlet and state.positions_before is not None:
        ahead = (2.0 - d) * state.positions - (1.0 - d) * state.positions_before + dt**2 * rod.gravity
    else:
        ahead = state.positions + dt * ((1.0 - d) * state.velocities + dt * rod.gravity)
    free = rod.inverse_masses[:, np.newaxis] > 0.0
    turned = np.array([
        q + 0.5 * dt * product(q, pure(w)) for q, w in zip(state.orientations, state.angular_velocities)
    ])
    return np.where(free, ahead, state.positions), turned / np.linalg.norm(turned, axis=1, keepdims=True)


def stretch(rod: Rod, x: np.ndarray, q: np.ndarray, j: int) -> None:
    """Correct spheres j, j + 1 and orientation j in place: the element's chord against its third director."""
    l, w0, w1, wq = rod.element_length, rod.inverse_masses[j], rod.inverse_masses[j + 1], 1.0
    third_director = product(product(q[j], np.array([0.0, 0.0, 1.0, 0.0])), conjugate(q[j]))[:3]
    gamma = (x[j + 1] - x[j]) / l - third_director
    denominator = w0 + w1 + 4.0 * wq * l**2
    turn = 2.0 * wq * l**2 / denominator * product(product(pure(gamma), q[j]), E3_CONJUGATE)
    x[j] += rod.stretch_gain * w0 * l * gamma / denominator
    x[j + 1] -= rod.stretch_gain * w1 * l * gamma / denominator
    q[j] = unit(q[j] + rod.stretch_gain * turn)


def bend_twist(rod: Rod, q: np.ndarray, j: int) -> None:
    """Correct orientations j and j + 1 in place: the Darboux vector between them against 0, a straight rest shape."""
    omega = 2.0 / rod.element_length * product(conjugate(q[j]), q[j + 1])[:3]
    first = 0.5 * product(q[j + 1], pure(omega))
    second = -0.5 * product(q[j], pure(omega))
    q[j], q[j + 1] = unit(q[j] + rod.bend_gain * first), unit(q[j + 1] + rod.bend_gain * second)


def sweep_order(count: int, bilateral: bool) -> list[int]:
    """0, 1, 2, ... or, from both ends inwards, 0, count - 1, 1, count - 2, ..."""
    upwards = list(range(count))
    if not bilateral:
        return upwards
    pairs = zip(upwards, reversed(upwards))
    return [index for pair in pairs for index in pair][:count]


def product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Hamilton's product of two quaternions."""
    vector = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.append(vector, a[3] * b[3] - a[:3] @ b[:3])


def conjugate(q: np.ndarray) -> np.ndarray:
    """The quaternion with its vector part reversed."""
    return q * (-1.0, -1.0, -1.0, 1.0)


def pure(v: np.ndarray) -> np.ndarray:
    """The quaternion of a vector, scalar part 0."""
    return np.append(v, 0.0)


def unit(q: np.ndarray) -> np.ndarray:
    """The quaternion scaled to length 1."""
    return q / np.linalg.norm(q)
