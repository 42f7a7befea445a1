"""Walls out of voxels: no volume is lost, no error is larger than stated."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.masks import Taking, mesh_of_image  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError, Edges, find_bodies, find_rims, signed_volume  # noqa: E402
from guidewire.anatomy.images import Image  # noqa: E402

SPACING = 0.5


def voxels(radius: float, axis: np.ndarray, shift: np.ndarray, size: int = 44, parts: int = 1) -> Image:
    """A tube of a radius in voxels through the middle of a cube of voxels of 0.5 mm; of each voxel the fraction of its
    parts, so many along each axis, that are inside."""
    offsets = (np.arange(parts) + 0.5) / parts - 0.5
    grid = np.indices((size,) * 3).transpose(1, 2, 3, 0) - 0.5 * (size - 1) - shift
    values = np.zeros(grid.shape[:3])
    for offset in np.stack(np.meshgrid(offsets, offsets, offsets), -1).reshape(-1, 3):
        along = (grid + offset) @ axis
        across = np.linalg.norm(grid + offset - along[..., None] * axis, axis=-1)
        values += (across < radius) & (np.abs(along) < 0.34 * size)
    to_space = np.diag([SPACING, SPACING, SPACING, 1.0])
    to_space[:3, 3] = -SPACING * (0.5 * (size - 1) + shift)
    return Image(values / parts**3, to_space)


@pytest.mark.parametrize("radius, noise, allowed", [
    (2.0, None, 0.015), (1.5, None, 0.04), (1.0, None, 0.08), (2.0, 0.08, 0.03),
    *(pytest.param(*one, marks=pytest.mark.long("wider tubes and grey values without noise"))
      for one in ((4.0, None, 0.005), (2.0, 0.0, 0.015), (1.5, 0.0, 0.04), (1.0, 0.0, 0.08)))])
def test_facets_lie_on_a_tube_in_the_mean(radius: float, noise: float | None, allowed: float) -> None:
    """Over random axes and places; of grey values, the fractions of voxels inside, with a noise of so much of the
    step."""
    rng = np.random.default_rng(5)
    found, slopes = [], []
    for _ in range(8):
        axis = rng.standard_normal(3)
        axis /= np.linalg.norm(axis)
        image = voxels(radius, axis, rng.uniform(-0.5, 0.5, 3), 44 if radius > 2.0 else 32, 1 if noise is None else 4)
        if noise is not None:
            image = Image(image.values + noise * rng.standard_normal(image.values.shape), image.to_space)
        mesh = mesh_of_image(image, Taking(threshold=0.5)).mesh
        assert find_bodies(mesh).max() == 0
        area = mesh.area_vectors()
        size, along = np.linalg.norm(area, axis=1), mesh.corners.mean(axis=1) @ axis
        inner = np.abs(along) < 4.0
        # The middles of the edges integrate what is quadratic over a triangle exactly.
        middles = 0.5 * (mesh.corners + np.roll(mesh.corners, 1, axis=1))
        away = middles - (middles @ axis)[..., None] * axis
        found.append(np.average(np.linalg.norm(away, axis=2).mean(axis=1)[inner], weights=size[inner]) / SPACING)
        out = away.mean(axis=1)
        slope = np.einsum("ij,ij->i", area, out) / size / np.linalg.norm(out, axis=1)
        slopes.append(np.degrees(np.arccos(np.clip(slope[inner], -1.0, 1.0))).mean())
    assert np.mean(found) == pytest.approx(radius, rel=allowed)
    # Of marched voxels alone the normals are 22 degrees off.
    assert np.mean(slopes) < 10.0 + 8.0 * (radius < 2.0)


@pytest.mark.parametrize("is_grey", [False, True])
def test_the_border_of_an_image_cuts_a_lumen_flat_whatever_hangs_there(is_grey: bool) -> None:
    """A tube of a radius of 5 voxels along the third axis from border to border, with a lip in the last slices."""
    i, j, _ = np.indices((30, 30, 40)) - 14.5
    values = np.clip(5.5 - np.hypot(i, j), 0.0, 1.0) if is_grey else (np.hypot(i, j) < 5.0).astype(float)
    values[14:16, 18:27, -3:] = values[13:17, 25:28, -2:] = 1.0
    taken = mesh_of_image(Image(values, np.diag([0.5, 0.5, 0.5, 1.0])), Taking(threshold=0.5))
    rims = find_rims(taken.mesh, Edges.of(taken.mesh))
    assert sorted(rim.centre[2] for rim in rims) == pytest.approx([-0.25, 19.75], abs=1e-6)
    for rim in rims:
        assert rim.centre[:2] == pytest.approx([7.25, 7.25], abs=0.05) and rim.radius == pytest.approx(2.5, rel=0.03)
        assert np.ptp(taken.mesh.vertices[rim.vertices, 2]) < 1e-6
    assert sum("cuts the lumen" in note for note in taken.notes) == 2
    assert any("thin parts" in line for line in taken.left_out)


def test_a_lumen_along_the_border_or_that_touches_it_has_no_end_there() -> None:
    i, j, k = np.indices((16, 30, 60)) - np.array([1.5, 14.5, 29.5])[:, None, None, None]
    along = mesh_of_image(Image((np.hypot(i, j) < 5.0) & (np.abs(k) < 25.0), np.eye(4)))
    ball = mesh_of_image(Image(np.hypot(np.hypot(i - 4.5, j), k) < 6.5, np.eye(4)))
    for taken in (along, ball):
        assert not find_rims(taken.mesh, Edges.of(taken.mesh))
        assert sum("touches the border" in note for note in taken.notes) == 1


def test_zero_may_be_off_by_rounding() -> None:
    image = voxels(4.0, np.array([0.0, 0.0, 1.0]), np.zeros(3))
    off = Image(image.values * np.float64(1.0) - 6e-8, image.to_space)
    assert len(mesh_of_image(off).mesh.triangles) == len(mesh_of_image(image).mesh.triangles)


def test_decimation_stays_within_its_error() -> None:
    from guidewire.anatomy.surfaces import farthest

    image = voxels(4.0, np.array([0.6, 0.0, 0.8]), np.zeros(3))
    fine = mesh_of_image(image, Taking(error=1e-6)).mesh
    taken = mesh_of_image(image, Taking(error=0.03))
    coarse, notes = taken.mesh, taken.notes
    assert len(coarse.triangles) < 0.7 * len(fine.triangles)
    assert farthest(fine, coarse) <= 0.03
    assert "allowed: 0.03 mm" in notes[1]


def test_a_mirrored_image_keeps_its_place_and_its_orientation() -> None:
    from guidewire.anatomy.mesh import signed_volume

    image = voxels(3.0, np.array([0.0, 0.6, 0.8]), np.zeros(3))
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    plain = mesh_of_image(image).mesh
    mirrored = mesh_of_image(Image(image.values, mirror @ image.to_space)).mesh
    np.testing.assert_allclose(mirrored.vertices, plain.vertices * [-1.0, 1.0, 1.0], atol=1e-9)
    assert signed_volume(mirrored) == pytest.approx(signed_volume(plain), rel=1e-9)


def test_a_region_is_chosen_by_its_number_and_all_are_listed() -> None:
    values = np.zeros((30, 30, 30))
    values[2:28, 2:28, 2:6] = 1.0  # a table, larger than the vessel
    values[12:18, 12:18, 10:28] = 1.0
    image = Image(values, np.diag([0.5, 0.5, 0.5, 1.0]))
    largest, second = mesh_of_image(image), mesh_of_image(image, Taking(region=2))
    assert largest.mesh.vertices[:, 2].max() < 3.5 and second.mesh.vertices[:, 2].min() > 4.0
    assert any("2 of 648 voxels around [7.25, 7.25, 9.25]" in line for line in second.left_out)
    assert largest.inside.sum() == 2704 and second.inside.sum() == 648
    with pytest.raises(AnatomyError, match="--region 3: there are 2 regions"):
        mesh_of_image(image, Taking(region=3))


@pytest.mark.parametrize("label, threshold, expected", [
    ("7", None, "--label 7: no voxel"), (None, 9.0, "--threshold 9: no voxel"), (None, -1.0, "every voxel"),
    (None, None, "give --label N"),
])
def test_a_mask_without_the_label_is_one_line(label, threshold, expected) -> None:
    values = np.zeros((6, 6, 6))
    values[2:4, 2:4, 2:4] = [[[1.0, 2.0], [3.0, 1.0]], [[1.0, 1.0], [1.0, 1.0]]]
    with pytest.raises(AnatomyError, match=expected.replace("(", r"\(")):
        mesh_of_image(Image(values, np.eye(4)), Taking(label, threshold=threshold))


def test_blocks_that_touch_at_a_corner_are_one_surface_and_the_place_is_named() -> None:
    values = np.zeros((20, 20, 24), dtype=np.uint8)
    values[2:8, 2:8, 2:12] = 1
    values[8:13, 8:13, 12:20] = 1
    taken = mesh_of_image(Image(values, np.diag([0.5, 0.5, 0.5, 1.0])))
    mesh, notes = taken.mesh, taken.notes
    assert find_bodies(mesh).max() == 0 and mesh.vertices[:, 2].max() > 9.0 and mesh.vertices[:, 2].min() < 1.5
    assert any("a part of 200 voxels touches the rest at an edge or a corner of voxels only" in note for note in notes)


def test_cavities_are_filled_and_the_volume_within_the_wall_is_told() -> None:
    values = np.zeros((16, 16, 24), dtype=np.uint8)
    values[3:13, 3:13, 3:21] = 1
    values[7:9, 7:9, 10:12] = 0
    taken = mesh_of_image(Image(values, np.diag([0.5, 0.5, 0.5, 1.0])))
    mesh, notes = taken.mesh, taken.notes
    assert find_bodies(mesh).max() == 0 and any("8 voxels of cavities within it filled" in note for note in notes)
    told, = (note for note in notes if note.startswith("volume: voxels 225 mm3"))
    assert f"within the wall {abs(signed_volume(mesh)):.5g} mm3" in told


def test_one_voxel_has_a_wall_though_no_decimation_leaves_one() -> None:
    inside = np.zeros((5, 5, 5), np.uint8)
    inside[2, 2, 2] = 1
    mesh = mesh_of_image(Image(inside, np.eye(4))).mesh
    assert len(mesh.triangles) and find_bodies(mesh).max() == 0
