"""Units that are guessed: never wrong, and asked for where sizes do not tell."""

from __future__ import annotations

import os

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.inspection import UNITS, find_unit  # noqa: E402
from guidewire.anatomy.mesh import Mesh  # noqa: E402
from guidewire.anatomy.tests.solids import tube  # noqa: E402
from tools.testing import FULL_CAMPAIGNS  # noqa: E402

# Radius, length and edges in mm of vessels as they are imaged: aortas, iliac, carotid, coronary, cerebral arteries, and
# pieces of them.
VESSELS = [(14.0, 500.0, 2.0), (12.0, 300.0, 1.0), (10.0, 200.0, 1.5), (13.0, 120.0, 0.8), (8.0, 150.0, 1.0),
           (5.0, 200.0, 1.0), (4.0, 120.0, 0.6), (3.0, 150.0, 0.5), (3.0, 60.0, 0.5), (2.5, 40.0, 0.4),
           (2.3, 80.0, 0.4),
           (2.0, 60.0, 0.3), (1.8, 100.0, 0.3), (1.7, 25.0, 0.3), (1.5, 20.0, 0.3), (1.5, 15.0, 0.25), (1.2, 40.0, 0.2),
           (1.0, 15.0, 0.2), (0.9, 30.0, 0.2), (0.8, 20.0, 0.15)]


def vessel(radius: float, length: float, edge: float) -> Mesh:
    sides = int(np.clip(2.0 * np.pi * radius / edge, 8, 60))
    return tube(radius, length, sides=sides, rings=int(np.clip(length / edge, 4, 120)))


@pytest.mark.parametrize("unit", UNITS)
@pytest.mark.few(1)
def test_of_twenty_vessels_no_unit_is_wrong(unit: str) -> None:
    asked = 0
    for sizes in VESSELS:
        mesh = vessel(*sizes)
        found = find_unit(Mesh(mesh.vertices * 1e-3 / UNITS[unit], mesh.triangles))
        assert found.name == unit or not found.is_sure, (sizes, found)
        asked += not found.is_sure
    # A small artery in mm has the sizes of an aorta in cm: these are asked for.
    assert asked <= {"mm": 7, "cm": 8, "m": 0}[unit]


@pytest.mark.parametrize("radius, sides, edge", [(1.4, 12.0, 0.3), (1.4, 12.0, 0.1), (1.2, 15.0, 0.2)])
def test_a_stump_of_a_small_artery_is_asked_for(radius: float, sides: float, edge: float) -> None:
    found = find_unit(vessel(radius, sides * radius, edge))
    assert not found.is_sure and "--unit mm" in found.reason and "--unit cm" in found.reason


def test_no_guess_is_certain() -> None:
    """However far the sizes of the other units are from those of vessels."""
    for sizes in VESSELS if FULL_CAMPAIGNS in os.environ else VESSELS[::6]:
        mesh = vessel(*sizes)
        for metres in UNITS.values():
            assert "100" not in find_unit(Mesh(mesh.vertices * 1e-3 / metres, mesh.triangles)).reason.split("%")[0]


def test_a_unit_that_is_known_is_not_doubted() -> None:
    mesh = vessel(12.0, 300.0, 1.0)
    found = find_unit(Mesh(0.1 * mesh.vertices, mesh.triangles), "mm", "as the file says")
    assert found.is_sure and found.name == "mm" and "cm" not in found.reason
    assert find_unit(Mesh(0.1 * mesh.vertices, mesh.triangles)).reason.count("--unit") in (0, 2)
