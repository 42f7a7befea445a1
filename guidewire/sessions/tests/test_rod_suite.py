"""The solver for a published suite, against a stand-in for the suite's interface."""

import enum
import importlib
import math
import sys
import types
from dataclasses import dataclass

import numpy as np
import pytest

End = enum.Enum("End", {"START": "start", "END": "end"})
Condition = enum.Enum("Condition", {"FREE": "free", "PINNED": "pinned", "CLAMPED": "clamped"})


@dataclass(frozen=True)
class Material:
    youngs_modulus: float = 1e6
    shear_modulus: float = 1e6 / 3.0
    density: float = 1000.0


@dataclass(frozen=True)
class Trajectory:
    times: np.ndarray
    positions: tuple
    directors: tuple


@dataclass(frozen=True)
class Load:
    force: tuple
    at: End = End.END


@dataclass(frozen=True)
class Motion:
    times: tuple
    displacement: tuple
    rotation: tuple
    slides_along: tuple | None = None


@dataclass(frozen=True)
class Cylinder:
    center: tuple
    axis: tuple
    radius: float
    length: float
    friction: float


@dataclass(frozen=True)
class Rod:
    centerline: tuple
    radius: float = 0.02
    material: Material = Material()
    normal: tuple = (0.0, 0.0, 1.0)
    start: Condition = Condition.FREE
    end: Condition = Condition.FREE
    loads: tuple = ()
    start_motion: Motion | None = None
    end_motion: Motion | None = None

    @property
    def length(self):
        return float(np.sum(np.linalg.norm(np.diff(self.centerline, axis=0), axis=1)))

    def nodes(self, n):
        arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.centerline, axis=0), axis=1))])
        points = np.asarray(self.centerline)
        return np.stack([np.interp(np.linspace(0.0, arc[-1], n + 1), arc, points[:, k]) for k in range(3)], axis=1)


@dataclass(frozen=True)
class Scenario:
    rods: tuple
    duration: float
    gravity: tuple = (0.0, 0.0, 0.0)
    quasi_static: bool = True
    obstacles: tuple = ()

    def slowest_frequency(self):
        return 3.516 * math.sqrt(1e6 * 0.02**2 / 4.0 / 1000.0)


@pytest.fixture
def solver(monkeypatch):
    interface = types.ModuleType("cosseratbench.solver")
    interface.Capability = enum.Enum("Capability", {"STRETCH": "stretch", "SHEAR": "shear",
                                                    "CYLINDER_CONTACT": "cylinder_contact"})
    interface.Diverged = type("Diverged", (FloatingPointError,), {
        "__init__": lambda self, message, time=None: FloatingPointError.__init__(self, message)})
    trajectory = types.ModuleType("cosseratbench.trajectory")
    trajectory.Trajectory = Trajectory
    for name, module in (("cosseratbench", types.ModuleType("cosseratbench")), ("cosseratbench.solver", interface),
                         ("cosseratbench.trajectory", trajectory)):
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.delitem(sys.modules, "guidewire.rod_suite", raising=False)
    made = importlib.import_module("guidewire.rod_suite").GuidewireSolver()
    yield made
    sys.modules.pop("guidewire.rod_suite", None)


def test_a_cantilever_of_the_suite_bends_as_a_beam(solver):
    # F L^3/(3 EI) = 0.0199 L: large deflections and shear make less than 1e-3 of it.
    rod = Rod(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), start=Condition.CLAMPED, loads=(Load((0.0, -7.5e-3, 0.0)),))
    found = solver.run(Scenario((rod,), 12.0), n_elements=20, n_frames=25)
    assert solver.name == "guidewire" and {c.name for c in solver.capabilities} == {"STRETCH", "SHEAR",
                                                                                    "CYLINDER_CONTACT"}
    assert found.positions[0].shape == (25, 21, 3) and found.directors[0].shape == (25, 20, 3)
    assert found.times[-1] == 12.0
    exact = 7.5e-3 / (3.0 * 1e6 * math.pi / 4.0 * 0.02**4)
    assert -found.positions[0][-1, -1, 1] == pytest.approx(exact, rel=1e-3)
    # The line on the surface starts at the normal, and stays across the elements.
    assert found.directors[0][0] == pytest.approx(np.tile([0.0, 0.0, 1.0], (20, 1)))
    chords = np.diff(found.positions[0][-1], axis=0)
    assert np.max(np.abs(np.sum(found.directors[0][-1] * chords, axis=1))) < 1e-4 * np.linalg.norm(chords[0])


def test_an_end_is_driven_in_all_directions(solver):
    turn = (0.6, 0.3, -0.2)
    motion = Motion((0.0, 1.0), ((0.0, 0.0, 0.0), (-0.1, 0.05, 0.02)), ((0.0, 0.0, 0.0), turn))
    rod = Rod(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), start=Condition.CLAMPED, end=Condition.CLAMPED, end_motion=motion)
    found = solver.run(Scenario((rod,), 1.5), n_elements=40, n_frames=4)
    assert found.positions[0][-1, -1] == pytest.approx([0.9, 0.05, 0.02], abs=1e-9)
    # The end's frame is turned by the vector; the last element's line is within what half an element bends.
    angle, axis = np.linalg.norm(turn), np.asarray(turn) / np.linalg.norm(turn)
    start = np.array([0.0, 0.0, 1.0])
    exact = start * math.cos(angle) + np.cross(axis, start) * math.sin(angle) + axis * (axis @ start) * (
        1.0 - math.cos(angle))
    assert np.linalg.norm(found.directors[0][-1, -1] - exact) < 0.1
    assert np.linalg.norm(found.directors[0][0, -1] - exact) > 0.5


def test_pins_hold_and_a_cylinder_is_met(solver):
    # A rod between pins falls onto a cylinder 30 mm below its middle, and rests on it.
    rod = Rod(((0.0, 0.0, 0.0), (0.5, 0.0, 0.1), (1.0, 0.0, 0.0)), radius=0.005, start=Condition.PINNED,
              end=Condition.PINNED)
    post = Cylinder((0.5, 0.0, -0.05), (0.0, 1.0, 0.0), 0.05, 0.2, 0.2)
    found = solver.run(Scenario((rod,), 1.0, gravity=(0.0, 0.0, -9.81), obstacles=(post,)), n_elements=20, n_frames=6)
    last = found.positions[0][-1]
    # Between walls the first node follows its support on a spring; it lags by less than the contact distance.
    assert last[0] == pytest.approx([0.0, 0.0, 0.0], abs=1e-4) and last[-1] == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)
    line = np.concatenate([last[:-1] + t * np.diff(last, axis=0) for t in np.linspace(0.0, 1.0, 101)])
    gap = np.hypot(line[:, 0] - 0.5, line[:, 2] + 0.05) - 0.055
    assert 0.0 < gap.min() < 5e-4  # the contact distance is a tenth of the radius


def test_what_the_program_does_not_have_is_refused_in_one_line(solver):
    rod = Rod(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), start=Condition.CLAMPED)
    ball = types.SimpleNamespace(friction=0.0)
    for scenario, words in ((Scenario((rod, rod), 1.0), "more than one rod"),
                            (Scenario((rod,), 1.0, obstacles=(ball,)), "an obstacle that is a SimpleNamespace")):
        with pytest.raises(NotImplementedError, match=words):
            solver.run(scenario, n_elements=5, n_frames=3)
