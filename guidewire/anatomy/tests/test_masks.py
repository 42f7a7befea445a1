"""Walls out of voxels: no volume is lost, no error is larger than stated."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("vtkmodules", reason="VTK is not installed: apt-get install python3-vtk9, or pip install vtk")

from guidewire.anatomy.masks import Taking, mesh_of_image  # noqa: E402
from guidewire.anatomy.mesh import AnatomyError, find_bodies, signed_volume  # noqa: E402
from guidewire.anatomy.images import Image  # noqa: E402

SPACING = 0.5


def voxels(radius: float, axis: np.ndarray, shift: np.ndarray, size: int = 44) -> Image:
    """A tube of a radius in voxels through the middle of a cube of voxels of 0.5 mm."""
    grid = np.indices((size,) * 3).transpose(1, 2, 3, 0) - 0.5 * (size - 1) - shift
    along = grid @ axis
    inside = (np.linalg.norm(grid - along[..., None] * axis, axis=-1) < radius) & (np.abs(along) < 15.0)
    to_space = np.diag([SPACING, SPACING, SPACING, 1.0])
    to_space[:3, 3] = -SPACING * (0.5 * (size - 1) + shift)
    return Image(inside.astype(np.uint8), to_space)


@pytest.mark.parametrize("radius, allowed", [
    pytest.param(4.0, 0.02, marks=pytest.mark.long("a tube of half the voxels across")), (2.0, 0.05)])
def test_a_tube_keeps_its_radius_over_random_axes(radius: float, allowed: float) -> None:
    rng = np.random.default_rng(5)
    found, smooth = [], []
    for _ in range(4):
        axis = rng.standard_normal(3)
        axis /= np.linalg.norm(axis)
        mesh = mesh_of_image(voxels(radius, axis, rng.uniform(-0.5, 0.5, 3))).mesh
        assert find_bodies(mesh).max() == 0
        area, middle = mesh.area_vectors(), mesh.corners.mean(axis=1)
        size, along = np.linalg.norm(area, axis=1), middle @ axis
        away = middle - along[:, None] * axis
        inner = np.abs(along) < 4.0
        # Volume over area, twice: the radius of a tube, from sums over its wall.
        found.append(2.0 * 0.5 * np.einsum("ij,ij->", away[inner], area[inner]) / size[inner].sum() / SPACING)
        slope = np.einsum("ij,ij->i", area, away) / size / np.linalg.norm(away, axis=1)
        smooth.append(np.degrees(np.arccos(np.clip(slope[inner], -1.0, 1.0))).mean())
    assert np.mean(found) == pytest.approx(radius, rel=allowed)
    # Of marched voxels alone the normals are 22 degrees off.
    assert np.mean(smooth) < 10.0


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


def test_cavities_are_filled_and_the_volume_after_each_step_is_told() -> None:
    values = np.zeros((16, 16, 24), dtype=np.uint8)
    values[3:13, 3:13, 3:21] = 1
    values[7:9, 7:9, 10:12] = 0
    taken = mesh_of_image(Image(values, np.diag([0.5, 0.5, 0.5, 1.0])))
    mesh, notes = taken.mesh, taken.notes
    assert find_bodies(mesh).max() == 0 and any("8 voxels of cavities within it filled" in note for note in notes)
    told, = (note for note in notes if note.startswith("volume: voxels 224 mm3"))
    assert f"decimated {abs(signed_volume(mesh)):.5g} mm3" in told


def test_one_voxel_has_a_wall_though_no_decimation_leaves_one() -> None:
    inside = np.zeros((5, 5, 5), np.uint8)
    inside[2, 2, 2] = 1
    mesh = mesh_of_image(Image(inside, np.eye(4))).mesh
    assert len(mesh.triangles) and find_bodies(mesh).max() == 0
