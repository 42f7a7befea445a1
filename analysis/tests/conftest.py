"""Runs and studies that several tests read, made once."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from analysis.tests.chain import Chain, small, write_study
from analysis.tests.waves import Wave


@pytest.fixture(scope="session")
def default_chain() -> Chain:
    """The default run."""
    return Chain()


@pytest.fixture(scope="session")
def default_study(tmp_path_factory: pytest.TempPathFactory, default_chain: Chain) -> Path:
    return write_study(tmp_path_factory.mktemp("default"), "default", None, [default_chain])


@pytest.fixture(scope="session")
def studies(tmp_path_factory: pytest.TempPathFactory, default_study: Path) -> dict[str, Path]:
    """Every study that a figure asks for, in small."""
    made = {
        "constraint-solver-steps": (
            "constraintSolverSteps", [small(constraint_solver_steps=m) for m in (80, 120, 160, 200)]
        ),
        "rod-elements": ("numberRodElements", [small(elements=n) for n in (3, 5, 8, 10)]),
        "displacement": ("displacement", [small(displacement=size) for size in (1.0, 10.0, 100.0)]),
        "time-step": ("timeStep", [small(time_step=dt) for dt in (1e-4, 1e-3, 1e-2, 1e-1)]),
        "total-mass": ("totalMass", [small(total_mass=mass) for mass in (1e-3, 1e-2, 5e-2)]),
    }
    folders = {"default": default_study}
    for name, (key, chains) in made.items():
        folders[name] = write_study(tmp_path_factory.mktemp(name), name, key, chains)
    for name, (key, waves) in WAVES.items():
        folders[name] = write_study(tmp_path_factory.mktemp(name), name, key, waves, repeats=0)
    return folders


REFERENCE = Wave(steps=500, constraint_solver_steps=1000, elements=20, time_step=0.002)
WAVES: dict[str, tuple[str, list[Wave]]] = {
    "transversal-reference": ("constraintSolverSteps", [REFERENCE, replace(REFERENCE, constraint_solver_steps=400)]),
    "transversal-solver-steps": (
        "constraintSolverSteps", [Wave(constraint_solver_steps=m) for m in range(100, 1001, 50)]
    ),
    "transversal-time-step": ("timeStep", [Wave(steps=max(k, 100), time_step=1.0 / k) for k in (20, 50, 100, 400)]),
    "transversal-rod-elements": ("numberRodElements", [Wave(elements=n) for n in (5, 10, 15, 20)]),
    "transversal-total-mass": ("totalMass", [Wave(total_mass=mass) for mass in (1e-3, 1e-2, 1e-1)]),
    "transversal-displacement": ("displacement", [Wave(displacement=size) for size in (1.0, 10.0, 100.0)]),
}
