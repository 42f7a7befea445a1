"""The wall of a vessel in a segmentation: extracted by marching cubes, smoothed without loss of volume, decimated to a
stated error."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import label as label_regions

from guidewire.anatomy.mesh import AnatomyError, Mesh, find_bodies
from guidewire.anatomy.reading import Image
from guidewire.anatomy.surfaces import contour, decimate, farthest, smooth

# Windowed sinc: over random axes and places the mean radius of a tube of 4 voxels' radius is 4.001 voxels then, that of
# a tube of 2 voxels 2.008, each from 8 tubes; at band 0.02 a tube of 2 loses a quarter.
_PASSES, _BAND = 20, 0.1
_ERROR = 0.1  # of decimation, of a voxel's smallest side


_LISTED = 6  # regions, and values of voxels, that a line lists


def mesh_of_image(image: Image, label: float | None, threshold: float | None, error: float | None,
                  region: int | None = None) -> tuple[Mesh, str, list[str]]:
    """The wall of a region, in mm; its unit; and what was done.

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
    regions, count = label_regions(_inside(image.values, label, threshold), structure=np.ones((3, 3, 3)))
    sizes = np.bincount(regions.ravel())[1:]
    order = np.argsort(-sizes, kind="stable")
    if region is not None and not 1 <= region <= count:
        raise AnatomyError(f"--region {region}: there {'is 1 region' if count == 1 else f'are {count} regions'}")
    chosen = (region or 1) - 1
    inside = regions == 1 + order[chosen]
    spacing = np.linalg.norm(image.to_space[:3, :3], axis=0)
    low = np.argwhere(inside).min(axis=0)
    high = np.argwhere(inside).max(axis=0) + 1
    part = np.pad(inside[tuple(slice(a, b) for a, b in zip(low, high))], 2).astype(np.float32)
    marched = contour(part, 0.5, spacing * (low - 2.0), spacing)
    marched = marched.part(find_bodies(marched) == 0)
    smoothed = smooth(marched, _PASSES, _BAND)
    allowed = error or _ERROR * float(spacing.min())
    mesh = decimate(smoothed, allowed)
    axes = image.to_space[:3, :3] / spacing
    notes = [f"{int(inside.sum())} voxels of {' x '.join(f'{s:.3g}' for s in spacing)} mm in region {chosen + 1} of "
             f"{count}; smoothed, wall moved by {farthest(marched, smoothed, 3000):.2g} mm at most",
             f"{len(smoothed.triangles)} triangles decimated to {len(mesh.triangles)}, wall moved by "
             f"{farthest(smoothed, mesh):.2g} mm at most (allowed: {allowed:.2g} mm)"]
    if image.note:
        notes.append(image.note)
    if count > 1:
        listed = [f"{k} of {sizes[at]} voxels around {_middle(regions == 1 + at, image.to_space)}"
                  for k, at in enumerate(order[:_LISTED], 1)]
        notes.append(f"regions, of which --region takes one: {', '.join(listed)}{', ..' if count > _LISTED else ''}")
    vertices = mesh.vertices @ axes.T + image.to_space[:3, 3]
    return Mesh(vertices, mesh.triangles if np.linalg.det(axes) > 0.0 else mesh.triangles[:, ::-1]), "mm", notes


def _inside(values: np.ndarray, label: float | None, threshold: float | None) -> np.ndarray:
    if threshold is not None:
        inside = values > threshold
        asked = f"--threshold {threshold:g}: "
    elif label is not None:
        inside = values == label
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
    middle = to_space @ np.r_[np.argwhere(inside).mean(axis=0), 1.0]
    return "[" + ", ".join(f"{number:.4g}" for number in middle[:3]) + "]"
