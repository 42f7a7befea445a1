"""A mass on one spring, or on a rod, let go level and turned by its weight, by diagonally implicit Runge-Kutta schemes.

It has one fast direction, which turns, and one slow one: what a wire has that swings, without its elements, its joints
and its solver.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

LENGTH, GRAVITY = 0.2, 9.81  # m, m/s^2: as slow as a rod of 0.3 m on a ball joint

ESDIRK4 = (  # Kennedy and Carpenter 2003, ARK4(3)6L[2]SA, the implicit part
    (0.0,), (0.25, 0.25), (8611 / 62500, -1743 / 31250, 0.25),
    (5012029 / 34652500, -654441 / 2922500, 174375 / 388108, 0.25),
    (15267082809 / 155376265600, -71443401 / 120774400, 730878875 / 902184768, 2285395 / 8070912, 0.25),
    (82889 / 524892, 0.0, 15625 / 83664, 69875 / 102672, -2260 / 8211, 0.25),
)
_D, _W = 1.0 - np.sqrt(0.5), 0.25 * np.sqrt(2.0)
TRBDF2 = ((0.0,), (_D, _D), (_W, _W, _D))


def largest_energy(scheme: Sequence[Sequence[float]], step: float, steps: int, stiffness: float | None) -> float:
    """The largest energy on the way over m g L; it starts at 0. `stiffness` is the spring's over the mass, 1/s^2; None:
    a rod, whose angle is all that there is."""
    rate, derivative, state, energy = _rod() if stiffness is None else _spring(stiffness)
    largest = 0.0
    for _ in range(steps):
        rates: list[np.ndarray] = []
        for row in scheme:
            base = state + step * sum((a * k for a, k in zip(row, rates)), np.zeros_like(state))
            if row[-1] == 0.0:
                rates.append(rate(state))
                continue
            solved = _solve(rate, derivative, base, state, step * row[-1])
            rates.append((solved - base) / (step * row[-1]))
        state = solved
        largest = max(largest, energy(state))
    return largest


def _solve(rate: Callable, derivative: Callable, base: np.ndarray, guess: np.ndarray, part: float) -> np.ndarray:
    """z = base + part rate(z), by Newton's method."""
    z = guess.copy()
    for _ in range(200):
        change = np.linalg.solve(np.eye(len(z)) - part * derivative(z), base + part * rate(z) - z)
        z = z + change
        if np.linalg.norm(change) < 1e-11:
            return z
    raise ArithmeticError("a stage has no solution")


def _spring(stiffness: float) -> tuple:
    def rate(state: np.ndarray) -> np.ndarray:
        place, length = state[:2], np.linalg.norm(state[:2])
        return np.concatenate([state[2:], -stiffness * (1.0 - LENGTH / length) * place - [0.0, GRAVITY]])

    def derivative(state: np.ndarray) -> np.ndarray:
        length = np.linalg.norm(state[:2])
        along = np.outer(state[:2], state[:2]) / length**2
        pull = along + (1.0 - LENGTH / length) * (np.eye(2) - along)
        return np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness * pull, np.zeros((2, 2))]])

    def energy(state: np.ndarray) -> float:
        stretch = np.linalg.norm(state[:2]) - LENGTH
        moving = 0.5 * state[2:] @ state[2:]
        return float(moving + 0.5 * stiffness * stretch**2 + GRAVITY * state[1]) / (GRAVITY * LENGTH)

    return rate, derivative, np.array([LENGTH, 0.0, 0.0, 0.0]), energy


def _rod() -> tuple:
    pull = GRAVITY / LENGTH

    def energy(state: np.ndarray) -> float:
        return float(0.5 * state[1] ** 2 / pull + np.sin(state[0]))

    return (lambda state: np.array([state[1], -pull * np.cos(state[0])]),
            lambda state: np.array([[0.0, 1.0], [pull * np.sin(state[0]), 0.0]]), np.zeros(2), energy)
