"""Runs and studies that several tests read, made once."""

from __future__ import annotations

from pathlib import Path

import pytest

from analysis.tests.chain import Chain, small, write_study


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
    return folders
