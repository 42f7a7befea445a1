"""Runs and studies that several tests read, made once."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from analysis.figures import FIGURES, stability
from analysis.stability import closed_form_along, limit_explicit
from analysis.tests.chain import Chain, small, write_study
from analysis.tests.outcomes import write_outcomes
from analysis.tests.waves import Wave
from analysis.validation.wire import Wire
from guidewire.studies.bisection import FRONTIER
from guidewire.studies.frontiers import LENGTH
from guidewire.studies.keys import RESULTS


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
        if name.startswith("transversal"):  # the collision's figures are drawn from runs of the same make
            folders[name.replace("transversal", "collision")] = folders[name]
    mesh = tmp_path_factory.mktemp("meshes") / "box.obj"
    write_box(mesh)
    made_of = {
        "wall-gain": {"shape": "plane", "point": [0, 0, 200], "normal": [0, 0.5, -1]},
        "vessel-gain": {"shape": "mesh", "file": str(mesh)},
    }
    for name, vessel in made_of.items():
        waves = [gain_wave(rule, n, vessel) for rule in ("none", "barycentric", "thesis") for n in (4, 8, 16)]
        rules = [wave.more["elementContact"] for wave in waves]
        folders[name] = write_study(tmp_path_factory.mktemp(name), name, "numberRodElements", waves, variants=rules)
    for name, named in NAMED_WAVES.items():
        folders[name] = write_study(tmp_path_factory.mktemp(name), name, None, list(named.values()), repeats=0,
                                    variants=list(named))
    folders |= write_maps(tmp_path_factory.mktemp("maps"))
    folders |= write_outcomes(tmp_path_factory.mktemp("outcomes"))
    folders["twist"] = write_study(
        tmp_path_factory.mktemp("twist"), "twist", "constraintSolverSteps", list(TWISTED_WAVES.values()), repeats=0,
        variants=[lumen for lumen, _ in TWISTED_WAVES],
    )
    return folders


def write_maps(folder: Path) -> dict[str, Path]:
    """Tables of frontiers a little above the limits in closed form, and of long steps of which one is lost."""
    folders = {name: folder / name for name in stability.STUDIES}
    for path in folders.values():
        path.mkdir()
    gains = {
        "limit-stretch-across": lambda n: 2.0, "limit-stretch-along": closed_form_along,
        "limit-bend": lambda n: LENGTH / n,
    }
    for name, limit in gains.items():
        rows = [f"verlet,{m},{n},gain,{limit(n)},{1.01 * limit(n)},diverged,holds below" for m in (20, 100)
                for n in (20, 30)]
        (folders[name] / FRONTIER).write_text("\n".join(
            ["variant,constraintSolverSteps,numberRodElements,key,low,high,fails,note", *rows]) + "\n")
    steps = [(n, limit_explicit(Wire(), n)) for n in (4, 8)]
    (folders["limit-explicit"] / FRONTIER).write_text("\n".join(
        ["variant,numberRodElements,wireRadius,key,low,high,fails,note",
         *(f",{n},{Wire().radius},timeStep,{step},{1.002 * step},diverged,holds below" for n, step in steps)]) + "\n")
    (folders["long-steps"] / RESULTS).write_text(
        "variant,integrator,timeStep,outcome\nsags,bdf2,0.1,finished\nsags,esdirk4,0.1,diverged\n")
    return folders


BOX = np.array([[-50.0, -4.7, -400.0], [50.0, 25.0, 400.0]])  # corners of a lumen that the waves leave at y = -4.7
LUMEN = {"shape": "tube", "knots": [[0, 0, -200], [0, 0, 100], [0, 100, 100]], "radius": 8}


def write_box(path: Path) -> None:
    """BOX as a mesh of twelve triangles."""
    corners = [BOX[[i, j, k], [0, 1, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    quads = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += [f"f {a} {b} {c}\nf {a} {c} {d}" for a, b, c, d in quads]
    path.write_text("\n".join(lines) + "\n")


def gain_wave(rule: str, elements: int, vessel: dict) -> Wave:
    """A run of the studies of long elements, with so many passages as its box allows it."""
    wave = Wave(elements=elements, more={"elementContact": rule, "vessel": vessel})
    passages = box_passages(wave) if rule == "none" and vessel["shape"] == "mesh" else 0
    return replace(wave, measured={"passages": passages})


def box_passages(wave: Wave) -> int:
    """Of the wave's samples through the lower side of BOX, from its closed form."""
    y = wave.positions[..., 1]
    fraction = np.arange(10) / 10
    samples = ((1.0 - fraction) * y[:, :-1, None] + fraction * y[:, 1:, None]).reshape(len(y), -1)
    samples = np.concatenate([samples, y[:, -1:]], axis=1)
    low = BOX[0, 1]
    return int(np.count_nonzero((samples[:-1] > low) & (samples[1:] < low)))


def _rest(rule: str, position: float) -> Wave:
    obstacle = {"shape": "sphere", "centre": [0, -4.6, 60.0 * position], "radius": 0.6}
    return Wave(steps=10, elements=1, length=60.0, offset=0.0, displacement=-1.0,
                more={"elementContact": rule, "obstacles": [obstacle]})


NAMED_WAVES: dict[str, dict[str, Wave]] = {
    "contact-rule": {
        f"{rule},s={s:g}": _rest(rule, s) for rule in ("barycentric", "thesis") for s in (0.0, 0.25, 0.5, 0.75, 1.0)
    },
    "drives": {
        key: Wave(length=100.0, more={"vessel": LUMEN}, displacement=size)
        for key, size in (("axis-published", 12.0), ("axis", 8.0), ("push", 2.0), ("force", 3.0))
    },
}
TWISTED_WAVES: dict[tuple[str, int], Wave] = {  # by lumen and solver steps
    (lumen, m): Wave(steps=60, constraint_solver_steps=m, turning=True, more={"twistPerStep": 0.01, "vessel": LUMEN})
    for lumen in ("straight", "bent") for m in (20, 100)
}


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


class Drawn(dict[str, "tuple[Figure, str]"]):
    """Figures and their captions by name, each drawn when it is first asked for."""

    def __init__(self, studies: dict[str, Path]) -> None:
        super().__init__()
        self._studies = studies

    def __missing__(self, name: str) -> tuple[Figure, str]:
        self[name] = FIGURES[name].draw(self._studies)
        return self[name]


@pytest.fixture(scope="session")
def drawn(studies: dict[str, Path]) -> Drawn:
    """Every figure and its caption, for reading only."""
    return Drawn(studies)
