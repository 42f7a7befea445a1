"""The wall of a vessel in a segmentation: extracted by marching cubes, smoothed without loss of volume, decimated to a
stated error."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import binary_fill_holes
from scipy.ndimage import label as label_regions

from guidewire.anatomy.images import Image
from guidewire.anatomy.mesh import AnatomyError, Mesh, find_bodies, signed_volume
from guidewire.anatomy.surfaces import contour, decimate, farthest, smooth

# Windowed sinc: over random axes and places the mean radius of a tube of 4 voxels' radius is 4.001 voxels then, that of
# a tube of 2 voxels 2.008, each from 8 tubes; at band 0.02 a tube of 2 loses a quarter.
_PASSES, _BAND = 20, 0.1
_ERROR = 0.1  # of decimation, of a voxel's smallest side
_LISTED = 6  # regions, and values of voxels, that a line lists
_AROUND = np.ones((3, 3, 3))  # neighbours of a voxel that touch it at a corner at least


def mesh_of_image(image: Image, label: float | None, threshold: float | None, error: float | None,
                  region: int | None = None) -> tuple[Mesh, list[str]]:
    """The wall of a region, in mm; and what was done.

    Parameters
    ----------
    label : value of the voxels in the vessel.
    threshold : or, of an image, their least value. With neither all voxels other than 0 are in it, if they are equal.
    error : largest displacement by the decimation, mm; None: a tenth of a voxel.
    region : which of the connected regions, 1 the largest; None: that.

    Raises
    ------
    AnatomyError : no voxel, or every voxel, is in the vessel, or there is no such region; or it is not said which.
    """
    regions, count = label_regions(_inside(image.values, label, threshold), structure=_AROUND)
    sizes = np.bincount(regions.ravel())[1:]
    order = np.argsort(-sizes, kind="stable")
    if region is not None and not 1 <= region <= count:
        raise AnatomyError(f"--region {region}: there {'is 1 region' if count == 1 else f'are {count} regions'}")
    chosen = (region or 1) - 1
    inside = regions == 1 + order[chosen]
    spacing = np.linalg.norm(image.to_space[:3, :3], axis=0)
    voxel = float(abs(np.linalg.det(image.to_space[:3, :3])))
    low = np.argwhere(inside).min(axis=0)
    high = np.argwhere(inside).max(axis=0) + 1
    to_part = image.to_space @ np.block([[np.eye(3), (low - 2.0)[:, None]], [np.zeros(3), 1.0]])
    own = np.pad(inside[tuple(slice(a, b) for a, b in zip(low, high))], 2)
    whole, joined = _in_one_piece(own, to_part)
    filled = binary_fill_holes(whole)
    marched = contour(filled.astype(np.float32), 0.5, spacing * (low - 2.0), spacing)
    bodies = find_bodies(marched)
    if bodies.max() > 0:    # a region of voxels that share faces, without cavities, has one surface
        raise AnatomyError(f"the surface of region {chosen + 1} is of {bodies.max() + 1} pieces")
    smoothed = smooth(marched, _PASSES, _BAND)
    allowed = error or _ERROR * float(spacing.min())
    mesh = decimate(smoothed, allowed)
    volumes = [voxel * int(own.sum()), *(_volume(one, image, spacing) for one in (marched, smoothed, mesh))]
    notes = [f"{int(inside.sum())} voxels of {' x '.join(f'{s:.3g}' for s in spacing)} mm in region {chosen + 1} of "
             f"{count}; smoothed, wall moved by {farthest(marched, smoothed, 3000):.2g} mm at most",
             f"{len(smoothed.triangles)} triangles decimated to {len(mesh.triangles)}, wall moved by "
             f"{farthest(smoothed, mesh):.2g} mm at most (allowed: {allowed:.2g} mm)",
             *joined]
    if (filled != whole).any():
        notes.append(f"{int((filled & ~whole).sum())} voxels of cavities within it filled, around "
                     f"{_middle(filled & ~whole, to_part)}")
    notes.append("volume: voxels {:.5g} mm3, their surface {:.5g}, smoothed {:.5g}, decimated {:.5g} mm3 ({:+.2%})".format(
        *volumes, volumes[-1] / volumes[0] - 1.0))
    if count > 1:
        listed = [f"{k} of {sizes[at]} voxels around {_middle(regions == 1 + at, image.to_space)}"
                  for k, at in enumerate(order[:_LISTED], 1)]
        left = int(sizes.sum() - sizes[order[chosen]])
        notes.append(f"regions, of which --region takes one: {', '.join(listed)}{', ..' if count > _LISTED else ''}; "
                     f"{left} voxels, {voxel * left:.4g} mm3, are left out")
    axes = image.to_space[:3, :3] / spacing
    vertices = mesh.vertices @ axes.T + image.to_space[:3, 3]
    return Mesh(vertices, mesh.triangles if np.linalg.det(axes) > 0.0 else mesh.triangles[:, ::-1]), notes


def _volume(mesh: Mesh, image: Image, spacing: np.ndarray) -> float:
    """Of a mesh along the image's own axes, in mm^3 of space."""
    return abs(signed_volume(mesh)) * float(abs(np.linalg.det(image.to_space[:3, :3] / spacing)))


def _in_one_piece(inside: np.ndarray, to_space: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """A region in which parts that touch at edges or corners of voxels only are joined by voxels between them, at one
    place each; and what was done. A surface joins voxels through their faces alone."""
    parts, count = label_regions(inside)
    if count == 1:
        return inside, []
    inside, lines = inside.copy(), []
    steps = np.array([step for step in np.ndindex(3, 3, 3) if step != (1, 1, 1)]) - 1
    sizes = np.bincount(parts.ravel())
    main = int(np.argmax(sizes[1:])) + 1
    places = np.argwhere((parts != 0) & (parts != main))
    own = parts[tuple(places.T)]
    around = parts[tuple(np.moveaxis(places[:, None] + steps, 2, 0))]
    group = np.arange(count + 1)
    for at, step in np.argwhere((around != 0) & (around != own[:, None])):
        one, other = own[at], around[at, step]
        if group[one] == group[other]:
            continue
        group[group == group[one]] = group[other]
        place, added = places[at].copy(), 0
        for axis in np.flatnonzero(steps[step])[:-1]:
            place[axis] += steps[step][axis]
            added += not inside[tuple(place)]
            inside[tuple(place)] = True
        small = min(one, other, key=lambda part: sizes[part])
        lines.append(f"a part of {sizes[small]} voxels touches the rest at an edge or a corner of voxels only: "
                     f"joined by {added} voxel{'s' if added > 1 else ''} at "
                     f"{_listed((to_space @ np.r_[places[at], 1.0])[:3])}")
    return inside, lines if len(lines) <= _LISTED else [
        *lines[:_LISTED], f"{len(lines) - _LISTED} further parts were joined so"]


def _inside(values: np.ndarray, label: float | None, threshold: float | None) -> np.ndarray:
    if threshold is not None:
        inside = values > threshold
        asked = f"--threshold {threshold:g}: "
    elif label is not None:
        inside = np.isclose(values, label, rtol=1e-6, atol=1e-6)    # a file's own factor may round
        asked = f"--label {label:g}: "
    else:
        found = np.unique(values)
        if len(found) > 2:
            listed = (", ".join(f"{value:g}" for value in found) if len(found) <= _LISTED
                      else f"from {found[0]:g} to {found[-1]:g}")
            raise AnatomyError(f"the voxels have {len(found)} values ({listed}): give --label N for a mask, "
                               "or --threshold T for an image")
        inside, asked = values != 0, ""
    if not inside.any() or inside.all():
        raise AnatomyError(f"{asked}{'no' if not inside.any() else 'every'} voxel is in the vessel; the values go from "
                           f"{values.min():g} to {values.max():g}")
    return inside


def _middle(inside: np.ndarray, to_space: np.ndarray) -> str:
    return _listed((to_space @ np.r_[np.argwhere(inside).mean(axis=0), 1.0])[:3])


def _listed(point: np.ndarray) -> str:
    return "[" + ", ".join(f"{number:.4g}" for number in point) + "]"
