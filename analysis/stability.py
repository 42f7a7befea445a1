"""Stability limits found by bisection, and those of theory.

**Gains.** While a wire is nearly straight, a sweep is linear in the distances u from rest, u -> S u, and so is a step
with its prediction: u_{k+1} = S^m (2 u_k - u_{k-1}). With an eigenvalue s of S and a = s^m the roots of
r^2 - 2 a r + a = 0 say how the motion grows from step to step; a wire holds where none is above 1. For many sweeps that
asks for |s| < 1, and a damping d, which makes the equation r^2 - (2 - d) a r + (1 - d) a = 0, changes little. A
Gauss-Seidel sweep over equal links that takes back the part f of each error holds up to f = 2:
2 for the stretch gain across the wire, 2 (1 + 2 wq l^2/w) along it, where the part 4 wq l^2 of the correction is lost,
and l for the bend gain, of which 2/l acts. The link at the held sphere moves one sphere only and is softer than the
others, which a wire of few long elements feels; `limit_along` and `limit_across` have the whole chain.

**Explicit steps** hold up to 2/omega_max of the linear chain (`limit_explicit`).
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from analysis.validation.wire import Wire
from guidewire.logs.logs import LogError
from guidewire.studies.bisection import FRONTIER
from guidewire.studies.frontiers import BEND, LENGTH, MASS, STRETCH
from guidewire.studies.keys import RESULTS

_GROWTH = 1e-3  # of a step, from which it counts: turns about the held sphere are neutral, and eigenvalues are rounded
_HALVINGS = 40


@dataclass(frozen=True)
class Frontier:
    """What a bisection found at one point of its grid.

    Attributes
    ----------
    variant : str
    values : of the grid's axes, by key.
    low, high : neighbouring values of the parameter, one of which holds; not numbers where there is no frontier.
    fails : outcome of the run that does not hold.
    """

    variant: str
    values: Mapping[str, float]
    low: float
    high: float
    fails: str

    @property
    def middle(self) -> float:
        """Return the middle between the two."""
        return 0.5 * (self.low + self.high)


def read_frontiers(folder: Path) -> list[Frontier]:
    """Return what a bisection found.

    Raises
    ------
    LogError : there is no such table, or it has other columns.
    """
    found = []
    for row in _read(folder / FRONTIER):
        try:
            low, high = (float(row.pop(end) or math.nan) for end in ("low", "high"))
            variant, fails, _, _ = (row.pop(name) for name in ("variant", "fails", "note", "key"))
            found.append(Frontier(variant, {key: float(value) for key, value in row.items()}, low, high, fails))
        except (KeyError, ValueError) as error:
            raise LogError(f"{folder / FRONTIER}: not a table of frontiers ({error})") from error
    return found


def read_results(folder: Path) -> list[dict[str, str]]:
    """Return the lines of a study's runs.csv."""
    return _read(folder / RESULTS)


def _read(path: Path) -> list[dict[str, str]]:
    try:
        with path.open(newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except OSError as error:
        raise LogError(f"{path}: {error.strerror}") from error


def closed_form_along(elements: int) -> float:
    """2 (1 + 2 wq l^2/w), the largest stretch gain along a wire without ends."""
    return 2.0 * (1.0 + 2.0 * (LENGTH / elements) ** 2 * MASS / (elements + 1))


def limit_along(elements: int, sweeps: int, damping: float = 0.0) -> float:
    """Largest stretch gain of a straight wire that is moved along itself, and loses a fraction of its speed a step."""
    return _largest(lambda gain: _sweep_along(elements, gain), sweeps, 1.0, 100.0, damping)


def limit_across(elements: int, sweeps: int, bisected: str) -> float:
    """Largest gain, "stretchStiffness" or "bendStiffness", of a wire that is moved a little across itself."""
    if bisected == "stretchStiffness":
        return _largest(lambda gain: _sweep_across(elements, gain, BEND), sweeps, 1.0, 100.0)
    return _largest(lambda gain: _sweep_across(elements, STRETCH, gain), sweeps, 0.1, 1000.0)


def _largest(
    sweep: Callable[[float], np.ndarray], sweeps: int, low: float, high: float, damping: float = 0.0
) -> float:
    """Return the gain at which steps begin to grow, between one that is small enough and one that is too large."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        holds = _growth(sweep(middle), sweeps, damping) < 1.0 + _GROWTH
        low, high = (middle, high) if holds else (low, middle)
    return low


def _growth(sweep: np.ndarray, sweeps: int, damping: float) -> float:
    """Largest factor from one step to the next."""
    with np.errstate(over="ignore", invalid="ignore"):
        a = np.linalg.eigvals(sweep).astype(complex) ** sweeps
        half = (1.0 - 0.5 * damping) * a
        root = np.sqrt(half * half - (1.0 - damping) * a)
        growth = np.abs(np.concatenate([half + root, half - root]))
    return float(np.max(growth)) if np.all(np.isfinite(growth)) else math.inf


def lost_turns(elements: int, sweeps: int, part: float, turns: np.ndarray, steps: int) -> np.ndarray:
    """Return whether a straight wire with gains loses a turn whose element 0 is turned about itself by so much in each
    step.

    All turns are about one axis, so an element is its half angle h. Within a step h goes on by atan(sin(its last way)):
    the speed is read off a sine. A joint of half angle e gives its two elements each the half angle
    atan2(c cos e, 1 - c sin e) back, with c = part sin e, and twice that c to the other one where the first is held.

    Parameters
    ----------
    elements, sweeps : int
    part : of a small angle that a joint takes from each of its elements, bend gain over l.
    turns : (k,), rad a step.
    steps : int

    Returns
    -------
    ndarray of bool, shape (k,)
    """
    half = np.zeros((elements, len(turns)))
    before = half
    lost = np.zeros(len(turns), dtype=bool)
    for step in range(1, steps + 1):
        moved = half + np.arctan(np.sin(half - before))
        moved[0] = 0.5 * step * turns
        before = half
        for _ in range(sweeps):
            for j in range(elements - 1):
                error = moved[j + 1] - moved[j]
                given = part * np.sin(error) * (1.0 if j else 2.0)
                back = np.arctan2(given * np.cos(error), 1.0 - given * np.sin(error))
                if j:
                    moved[j] += back
                moved[j + 1] -= back
        half = moved
        lost |= np.max(np.abs(np.diff(half, axis=0)), axis=0) > 0.5 * math.pi
    return lost


def _inverse_masses(elements: int) -> np.ndarray:
    return np.array([0.0, *np.full(elements, (elements + 1) / MASS)])


def _sweep_along(elements: int, gain: float) -> np.ndarray:
    """S of the places of spheres 1 to n, shape (n, n)."""
    l, w = LENGTH / elements, _inverse_masses(elements)
    sweep = np.eye(elements + 1)
    for j in range(elements):
        fraction = gain / (w[j] + w[j + 1] + 4.0 * l * l)
        stretch = sweep[j + 1] - sweep[j]
        sweep[j] += w[j] * fraction * stretch
        sweep[j + 1] -= w[j + 1] * fraction * stretch
    return sweep[1:, 1:]


def _sweep_across(elements: int, stretch_gain: float, bend_gain: float) -> np.ndarray:
    """S of the places of spheres 1 to n, and the angles of elements 0 to n - 1, shape (2 n, 2 n)."""
    l, w = LENGTH / elements, _inverse_masses(elements)
    sweep = np.eye(2 * elements + 1)
    places, angles = sweep[:elements + 1], sweep[elements + 1:]  # views: rows are what a value is made of
    for j in range(elements):
        fraction = stretch_gain / (w[j] + w[j + 1] + 4.0 * l * l)
        error = (places[j + 1] - places[j]) / l - angles[j]
        places[j] += w[j] * l * fraction * error
        places[j + 1] -= w[j + 1] * l * fraction * error
        angles[j] += 4.0 * l * l * fraction * error
    for j in range(elements - 1):
        turn = bend_gain / l * (angles[j + 1] - angles[j])
        angles[j] += turn
        angles[j + 1] -= turn
    return sweep[1:, 1:]


def limit_explicit(wire: Wire, elements: int) -> float:
    """2/omega_max of a free straight chain with lumped masses, in s."""
    return 2.0 / highest_frequency(wire, elements)


def highest_frequency(wire: Wire, n: int) -> float:
    """Return the highest frequency of small motions of a free chain with lumped masses, rad/s: across it, with elements
    that turn, and along it."""
    length = wire.length / n
    turning = np.full(n, wire.second_moment / wire.area)
    mass = wire.line_density * length * np.array([0.5, *np.ones(n - 1), 0.5, *turning])
    shear = np.zeros((n, 2 * n + 1))  # (y' - angle), of n+1 places and n angles
    for j in range(n):
        shear[j, [j, j + 1, n + 1 + j]] = -1.0 / length, 1.0 / length, -1.0
    bend = np.diff(np.eye(2 * n + 1)[n + 1:], axis=0)
    stiffness = wire.shearing * length * shear.T @ shear + wire.bending / length * bend.T @ bend
    across = np.linalg.eigvalsh(stiffness / np.sqrt(np.outer(mass, mass)))[-1]
    side = np.diff(np.eye(n + 1), axis=0)
    along = np.linalg.eigvalsh(
        wire.stretching / length * side.T @ side / np.sqrt(np.outer(mass[:n + 1], mass[:n + 1])))[-1]
    return math.sqrt(max(across, along))
