"""Rest shapes under random tip loads are what a minimiser from elsewhere finds, on an energy written down anew."""

from __future__ import annotations

import os
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import OptimizeResult, minimize

from analysis.validation.scenes import SCENE, at_rest
from analysis.validation.states import last_state, solver_report
from analysis.validation.wire import BASE
from experiments.tests.chain_energy import ChainEnergy
from guidewire.logs.runs import read_run
from guidewire.prepare import ROOT
from guidewire.runs.runner import Request, Runner

FULL = os.environ.get("GUIDEWIRE_ALL") == "1"
CASES = 5 if FULL else 1  # of each kind
MOST_ELEMENTS = 120 if FULL else 25  # the minimiser's time grows with the cube
MOVE = 1e-6  # of L, or rad: what a minimiser may still move
BALANCE = 1e-6  # EI/L^2
DISTURBANCE = 1e-3  # of L, or rad
_NEWTON_STEPS = 25


@dataclass(frozen=True)
class Load:
    """Loads of one case; `normal` is the unit normal of the plane that holds them, if one does."""

    elements: int
    force: np.ndarray  # N
    moment: np.ndarray  # N m
    normal: np.ndarray | None = None


def direction(random: np.random.Generator) -> np.ndarray:
    """Uniform on the sphere."""
    z, angle = random.uniform(-1.0, 1.0), random.uniform(0.0, 2.0 * np.pi)
    return np.array([*(np.sqrt(1.0 - z * z) * np.array([np.cos(angle), np.sin(angle)])), z])


def draw(seed: int, kind: str) -> Load:
    """F L^2/EI log-uniform from 0.1 to 100, couples to 4 pi EI/L, 15 to MOST_ELEMENTS elements."""
    random = np.random.default_rng([seed, len(kind)])
    elements = int(random.integers(15, MOST_ELEMENTS + 1))
    size = 10.0 ** random.uniform(-1.0, 2.0) * BASE.bending / BASE.length**2
    couple = random.uniform(-4.0, 4.0) * np.pi * BASE.bending / BASE.length
    towards = direction(random)
    if kind == "force":
        return Load(elements, size * towards, np.zeros(3))
    if kind == "space":
        return Load(elements, size * towards, couple * direction(random))
    across = random.uniform(0.0, 2.0 * np.pi)
    normal = np.array([np.cos(across), np.sin(across), 0.0])
    inside = towards - (towards @ normal) * normal
    return Load(elements, size * inside / np.linalg.norm(inside), couple * normal, normal)


@pytest.fixture(scope="module")
def ends(runner_command: list[str], tmp_path_factory: pytest.TempPathFactory) -> dict[tuple[str, int], tuple]:
    """Load, answer and folder of every case."""
    loads = {(kind, seed): draw(seed, kind) for kind in ("force", "plane", "space") for seed in range(CASES)}
    folder = tmp_path_factory.mktemp("rest")
    requests = [
        Request(f"{kind}-{seed}", ROOT / SCENE, folder / f"{kind}-{seed}", at_rest({
            "numberRodElements": load.elements, "tipForce": load.force.tolist(), "tipMoment": load.moment.tolist(),
        }))
        for (kind, seed), load in loads.items()
    ]
    with closing(Runner(runner_command)) as runner:
        answers = {request.name: runner.run(request) for request in requests}
    return {(k, s): (load, answers[f"{k}-{s}"], folder / f"{k}-{s}") for (k, s), load in loads.items()}


def chain(load: Load, folder: Path) -> ChainEnergy:
    """The energy about the shape that a run ended in."""
    state = last_state(read_run(folder))
    return ChainEnergy(BASE, state.positions, state.orientations, load.force, load.moment)


def free_directions(load: Load) -> np.ndarray:
    """The columns of each block's unknowns that a case leaves free, shape (6, k): all, or those in its plane."""
    if load.normal is None:
        return np.eye(6)
    axis = np.array([0.0, 0.0, 1.0])
    columns = np.zeros((6, 3))
    columns[:3, 0], columns[:3, 1], columns[3:, 2] = axis, np.cross(load.normal, axis), load.normal
    return columns


def descend(energy: ChainEnergy, load: Load, start: np.ndarray) -> OptimizeResult:
    """scipy's trust-region Newton method on the free unknowns, shape (n k,).

    In its plane a couple has the potential -m times the angle, and the frames' own axes keep the plane's normal.
    """
    columns, n = free_directions(load), energy.count
    width = columns.shape[1]
    wide = np.kron(np.eye(n), columns)
    couple = np.zeros(n * width)
    if load.normal is not None:
        couple[-1] = energy.scaled_moment @ load.normal

    def full(w: np.ndarray) -> np.ndarray:
        return w.reshape(n, width) @ columns.T

    return minimize(
        lambda w: float(np.sum(energy.terms(full(w)))) - couple @ w,
        start,
        jac=lambda w: (energy.gradient(full(w)) @ columns).ravel() - couple,
        hess=lambda w: wide.T @ energy.second_derivative(full(w)) @ wide,
        method="trust-exact",
        options={"gtol": 1e-10, "maxiter": _NEWTON_STEPS, "initial_trust_radius": 1.0, "max_trust_radius": 10.0},
    )


@pytest.mark.parametrize("seed", range(CASES))
@pytest.mark.parametrize("kind", ["force", "plane"])
@pytest.mark.few(1)
def test_minimiser_moves_nothing_and_comes_back(ends: dict, kind: str, seed: int) -> None:
    load, answer, folder = ends[kind, seed]
    assert answer.outcome == "converged", answer.message
    energy = chain(load, folder)
    columns = free_directions(load)
    size = energy.count * columns.shape[1]
    assert np.max(np.abs(energy.residual())) < BALANCE
    wide = np.kron(np.eye(energy.count), columns)
    curvature = wide.T @ energy.second_derivative(np.zeros((energy.count, 6))) @ wide
    assert np.linalg.eigvalsh(curvature)[0] > 0.0
    assert np.max(np.abs(descend(energy, load, np.zeros(size)).x)) < MOVE
    # Pulled aside by random forces it comes back: the minimiser does move.
    aside = np.linalg.solve(curvature, np.random.default_rng(seed).standard_normal(size))
    aside *= DISTURBANCE / np.max(np.abs(aside))
    assert np.max(np.abs(descend(energy, load, aside).x)) < MOVE
    assert np.max(energy.joint_angles()) < np.pi


@pytest.mark.parametrize("seed", range(CASES))
def test_couple_in_space_ends_in_a_shape_to_which_it_comes_back(ends: dict, seed: int) -> None:
    load, answer, folder = ends["space", seed]
    if answer.outcome == "failed":
        assert "tipMoment" in answer.message
        return
    assert answer.outcome == "converged"
    energy = chain(load, folder)
    assert np.max(np.abs(energy.residual())) < BALANCE
    # With drag l on turns and l/L^2 on shifts: in units of L and EI/L the drag of every unknown is 1/n.
    slowest = np.min(np.linalg.eigvals(energy.count * energy.tangent()).real)
    assert slowest > 0.0
    reported = solver_report(read_run(folder), "smallestEigenvalue") * BASE.length**2 / BASE.bending
    assert reported == pytest.approx(slowest, rel=1e-4, abs=1e-4)


def test_couples_in_space_often_have_a_rest_shape(ends: dict) -> None:
    outcomes = [answer.outcome for (kind, _), (_, answer, _) in ends.items() if kind == "space"]
    assert outcomes.count("converged") >= len(outcomes) // 3
