"""The border between the two surfaces of a double wall."""

from __future__ import annotations

import re

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.double_wall import _least_border, inner_wall  # noqa: E402
from guidewire.anatomy.inspection import inspect  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError, Edges, Mesh, close_rims, find_rims  # noqa: E402
from guidewire.anatomy.repair import repair  # noqa: E402
from guidewire.anatomy.surfaces import distances  # noqa: E402
from guidewire.anatomy.tests.solids import SLANT, double_walled, frame, joined, tube  # noqa: E402


@pytest.mark.parametrize("seed", range(3))
def test_the_border_is_at_the_lips_where_a_fifth_of_the_triangles_speak_for_the_wrong_side(seed: int) -> None:
    mesh = double_walled()
    count = len(tube(rings=16).triangles)
    is_inner = np.zeros(len(mesh.triangles), dtype=bool)
    is_inner[count:2 * count] = True
    is_lip = np.arange(len(is_inner)) >= 2 * count
    wrong = np.random.default_rng(seed).uniform(size=len(is_inner)) < 0.2
    areas = np.linalg.norm(mesh.area_vectors(), axis=1)
    chosen = _least_border(mesh, np.where(is_lip, 0.0, areas * np.where(is_inner ^ wrong, 1.0, -1.0)), cost=1.0)
    assert (chosen[~is_lip] == is_inner[~is_lip]).all()
    alone = _least_border(mesh, np.where(is_inner ^ wrong, areas, -areas), cost=0.0)
    assert (alone != is_inner)[~is_lip].mean() == pytest.approx(wrong[~is_lip].mean())  # without a cost none is mended


def test_the_inner_wall_has_the_lumens_radius_and_the_thickness_is_the_walls() -> None:
    part, thickness = inner_wall(double_walled(3.0, 4.0))
    middle = (part.vertices @ SLANT > 2.0) & (part.vertices @ SLANT < 38.0)
    radii = np.linalg.norm(part.vertices - (part.vertices @ SLANT)[:, None] * SLANT, axis=1)
    assert np.allclose(radii[middle], 3.0) and np.ptp(part.vertices @ SLANT) > 35.0
    assert thickness == pytest.approx(1.0, rel=0.02)


def bulged(mesh: Mesh, size: float, *places: float) -> Mesh:
    """The mesh displaced sideways by a size at places along its axis, smoothly over 5 mm."""
    along = mesh.vertices @ SLANT
    bump = sum(np.exp(-((along - place) / 5.0)**2) for place in places)
    return Mesh(mesh.vertices + size * bump[:, None] * frame(SLANT)[0], mesh.triangles)


def part_bulged(mesh: Mesh, count: int, size: float, *places: float) -> Mesh:
    """A double wall, the vertices of its inner wall, from `count` on, displaced."""
    moved = bulged(mesh, size, *places).vertices
    return Mesh(np.concatenate([mesh.vertices[:count], moved[count:]]), mesh.triangles)


def closed(mesh: Mesh) -> Mesh:
    return close_rims(mesh, find_rims(mesh, Edges.of(mesh)))


def inner_and_outer(kind: str, size: float, *places: float) -> tuple[Mesh, Mesh]:
    """A double wall of radii 3 and 4 whose inner wall is displaced, and that inner wall alone."""
    fine, inner = tube(4.0, sides=36, rings=60), bulged(tube(3.0, sides=36, rings=60), size, *places)
    if kind == "open":
        return joined(fine, inner), inner
    short = tube(3.0, 36.0, sides=36, rings=54)
    inner = closed(bulged(Mesh(short.vertices + 2.0 * SLANT, short.triangles), size, *places))
    return joined(closed(fine), inner), inner


@pytest.mark.parametrize("kind, places", [
    ("open", (20.0,)), ("closed", (10.0, 30.0)),
    *(pytest.param(*both, marks=pytest.mark.long("each kind crosses, and so do walls at one place and at two"))
      for both in (("open", (10.0, 30.0)), ("closed", (20.0,))))])
def test_of_two_nested_walls_that_cross_the_inner_one_is_kept_and_every_stretch_named(kind: str, places) -> None:
    both, inner = inner_and_outer(kind, 1.7, *places)
    crossings = inspect(both).crossings
    repaired = repair(both)
    assert distances(repaired.mesh.vertices, inner).max() < 1e-9
    assert distances(inner.vertices, repaired.mesh).max() < 1e-9
    named = [change for change in repaired.changes if "nested walls" in change.name]
    assert sum(change.count for change in named) == len(crossings) > 100
    for place in places:
        assert min(abs(change.place @ SLANT - place) for change in named) < 3.0


def test_of_two_nested_walls_that_touch_the_inner_one_is_kept() -> None:
    inner = tube(3.0)
    inner = Mesh(inner.vertices + 1.0 * frame(SLANT)[0], inner.triangles)  # 4 - 3: they touch along a line
    repaired = repair(joined(tube(4.0), inner))
    assert distances(repaired.mesh.vertices, inner).max() < 1e-6 and len(repaired.rims) == 2
    assert sum(change.count for change in repaired.changes if "nested walls" in change.name) > 10


@pytest.mark.parametrize("size", [1.7, pytest.param(9.0, marks=pytest.mark.long("a bulge of the wall's thickness"))])
def test_of_a_phantom_whose_walls_cross_the_lumen_is_kept_and_the_crossings_named(size: float) -> None:
    bent = part_bulged(double_walled(), len(tube(rings=16).vertices), size, 20.0)
    inner = bulged(tube(rings=16), size, 20.0)
    repaired = repair(bent)
    assert len(repaired.rims) == 2 and distances(repaired.mesh.vertices, inner).max() < 1e-9
    # Nothing is missing but one thickness of the wall, 1, at each end.
    assert distances(inner.vertices, repaired.mesh).max() < 1.1
    assert sum(change.count for change in repaired.changes if "double wall" in change.name) == len(
        inspect(bent).crossings) > 20


def test_a_phantom_whose_walls_cross_at_its_ends_too_is_refused_with_every_stretch() -> None:
    phantom, count = double_walled(), len(tube(rings=16).vertices)
    aside = phantom.vertices + np.where(np.arange(2 * count) < count, 0.0, 1.3)[:, None] * frame(SLANT)[0]
    with pytest.raises(AnatomyError, match=r"cross each other, \d+ times around \[") as error:
        repair(Mesh(aside, phantom.triangles))
    numbers = [int(number) for number in re.findall(r"(\d+) times", str(error.value))]
    assert sum(numbers) == len(inspect(Mesh(aside, phantom.triangles)).crossings) and "\n" not in str(error.value)


def test_a_fold_of_one_wall_near_an_end_of_a_phantom_is_no_crossing_of_the_walls() -> None:
    """A vertex of the outer wall, one ring from the end, is moved past its neighbour around the tube."""
    phantom = double_walled(outer=5.0)
    vertices = phantom.vertices.copy()
    vertices[24 + 5] += 1.5 * (vertices[24 + 6] - vertices[24 + 5])
    folded = Mesh(vertices, phantom.triangles)
    assert len(inspect(folded).crossings) > 0
    repaired = repair(folded)
    assert len(repaired.rims) == 2
    assert distances(repaired.mesh.vertices, tube(rings=16)).max() < 1e-9


def test_the_lumen_of_a_phantom_does_not_depend_on_the_side_that_its_normals_point_to() -> None:
    phantom = double_walled(outer=5.0)
    one, other = repair(phantom), repair(phantom.turned())
    assert np.array_equal(one.mesh.vertices, other.mesh.vertices)
    assert np.array_equal(one.mesh.triangles, other.mesh.triangles)
    assert [change.count for change in other.changes if "double wall" in change.name] == [len(phantom.triangles)]
