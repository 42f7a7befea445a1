"""The wall of a vessel in a segmentation: extracted by marching cubes, smoothed without loss of volume, decimated to a
stated error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_fill_holes
from scipy.ndimage import label as label_regions

from guidewire.anatomy.images import Image
from guidewire.anatomy.labels import told_values, values_of, voxels_with
from guidewire.anatomy.mesh import AnatomyError, Mesh, find_bodies, signed_volume
from guidewire.anatomy.surfaces import contour, decimate, farthest, smooth

# Windowed sinc: over random axes and places the mean radius of a tube of 4 voxels' radius is 4.001 voxels then, that of
# a tube of 2 voxels 2.008, each from 8 tubes; at band 0.02 a tube of 2 loses a quarter.
_PASSES, _BAND = 20, 0.1
_ERROR = 0.1  # of decimation, of a voxel's smallest side
_LISTED = 6  # regions, and values of voxels, that a line lists
_AROUND = np.ones((3, 3, 3))  # neighbours of a voxel that touch it at a corner at least


@dataclass(frozen=True)
class Taking:
    """Which voxels of an image are the vessel.

    Attributes
    ----------
    labels : values or names, with commas between them, of its voxels in a mask.
    segments : names of 3D Slicer's segments, with commas between them.
    threshold : or, of an image, the value that they are above. With none of the three all voxels other than 0 are
        taken, if they are equal.
    region : which of the connected regions, 1 the largest; None: that.
    box : ndarray (2, 3), two corners within which voxels are taken, in the vessel's axes, mm.
    seed : ndarray (3,), a point in the region that is taken.
    error : largest displacement by the decimation, mm; None: a tenth of a voxel.
    """

    labels: str | None = None
    segments: str | None = None
    threshold: float | None = None
    region: int | None = None
    box: np.ndarray | None = None
    seed: np.ndarray | None = None
    error: float | None = None

    @property
    def needs_picture(self) -> bool:
        """Whether what is taken is not plain from the file alone."""
        return self.threshold is not None or self.box is not None or self.seed is not None


@dataclass(frozen=True)
class Taken:
    """mesh : the wall, in mm; notes : what was done; left_out : of the image; inside, others : ndarrays of bool
    (i, j, k), the voxels that are taken, and those of other regions."""

    mesh: Mesh
    notes: list[str]
    left_out: list[str]
    inside: np.ndarray
    others: np.ndarray


def mesh_of_image(image: Image, taking: Taking = Taking()) -> Taken:
    """Return the wall of a region.

    Raises
    ------
    AnatomyError : no voxel, or every voxel, is in the vessel, or there is no such region; or it is not said which.
    """
    asked, left_out = _inside(image, taking)
    regions, count = label_regions(asked, structure=_AROUND)
    sizes = np.bincount(regions.ravel())[1:]
    order = np.argsort(-sizes, kind="stable")
    region = taking.region
    if region is not None and not 1 <= region <= count:
        raise AnatomyError(f"--region {region}: there {'is 1 region' if count == 1 else f'are {count} regions'}")
    chosen = (region or 1) - 1
    if taking.seed is not None:
        chosen = int(np.flatnonzero(order == _seeded(image, regions, taking.seed) - 1)[0])
    inside = regions == 1 + order[chosen]
    spacing = image.spacing
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
    allowed = taking.error or _ERROR * float(spacing.min())
    mesh = decimate(smoothed, allowed)
    volumes = [voxel * int(own.sum()), *(_volume(one, image, spacing) for one in (marched, smoothed, mesh))]
    unit = image.unit or "unit"
    sides = " x ".join(f"{side:.3g}" for side in spacing)
    notes = [f"{int(inside.sum())} voxels of {sides} {unit} in region {chosen + 1} of {count}; smoothed, wall moved "
             f"by {farthest(marched, smoothed, 3000):.2g} {unit} at most",
             f"{len(smoothed.triangles)} triangles decimated to {len(mesh.triangles)}, wall moved by "
             f"{farthest(smoothed, mesh):.2g} {unit} at most (allowed: {allowed:.2g} {unit})",
             *joined]
    if (filled != whole).any():
        notes.append(f"{int((filled & ~whole).sum())} voxels of cavities within it filled, around "
                     f"{_middle(filled & ~whole, to_part)}")
    notes.append("volume: voxels {:.5g} {unit}3, their surface {:.5g}, smoothed {:.5g}, decimated {:.5g} {unit}3 "
                 "({:+.2%})".format(*volumes, volumes[-1] / volumes[0] - 1.0, unit=unit))
    if count > 1:
        listed = [f"{k} of {sizes[at]} voxels around {_middle(regions == 1 + at, image.to_space)}"
                  for k, at in enumerate(order[:_LISTED], 1)]
        left = int(sizes.sum() - sizes[order[chosen]])
        left_out.append(f"regions, of which --region or --seed takes one: {', '.join(listed)}"
                        f"{', ..' if count > _LISTED else ''}; {left} voxels, {voxel * left:.4g} {unit}3, are left out")
    axes = image.to_space[:3, :3] / spacing
    vertices = mesh.vertices @ axes.T + image.to_space[:3, 3]
    turned = Mesh(vertices, mesh.triangles if np.linalg.det(axes) > 0.0 else mesh.triangles[:, ::-1])
    return Taken(turned, [*image.notes, *notes], [*image.left_out, *left_out], inside, asked & ~inside)


def _volume(mesh: Mesh, image: Image, spacing: np.ndarray) -> float:
    """Return the volume of a mesh along the image's own axes, in mm^3 of space."""
    return abs(signed_volume(mesh)) * float(abs(np.linalg.det(image.to_space[:3, :3] / spacing)))


def _in_one_piece(inside: np.ndarray, to_space: np.ndarray) -> tuple[np.ndarray, list[str]]:
    """Return a region in which parts that touch at edges or corners of voxels only are joined by voxels between them,
    at one place each; and what was done. A surface joins voxels through their faces alone."""
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


def _inside(image: Image, taking: Taking) -> tuple[np.ndarray, list[str]]:
    """Return (i, j, k): the voxels that are asked for; and a line for each kind that is not."""
    values, left_out = image.values, []
    if taking.threshold is not None:
        if values.ndim == 4:
            raise AnatomyError("--threshold is of an image: this is a segmentation; --segment takes one of its "
                               "segments")
        inside, asked = values > taking.threshold, f"--threshold {taking.threshold:g}: "
    elif taking.labels is not None or taking.segments is not None or values.ndim == 4:
        inside, asked, others = voxels_with(image, taking.labels, taking.segments)
        if others:
            left_out.append(f"labels {', '.join(others[:_LISTED])}{', ..' if len(others) > _LISTED else ''}")
    else:
        found = values_of(values)
        if len(found) > 2:
            raise AnatomyError(f"the voxels have {len(found)} values ({told_values(image, found, _LISTED)}): give "
                               "--label N for a mask, or --threshold T for an image")
        inside, asked = values != 0, ""
    if taking.box is not None:
        whole, inside = inside, _in_box(inside, image, taking.box)
        left_out.append(f"{int(whole.sum() - inside.sum())} voxels outside of --box")
        asked += "--box: "
    if not inside.any() or inside.all():
        raise AnatomyError(f"{asked}{'no' if not inside.any() else 'every'} voxel is in the vessel; the values go from "
                           f"{values.min():g} to {values.max():g}")
    return inside, left_out


def _in_box(inside: np.ndarray, image: Image, box: np.ndarray) -> np.ndarray:
    """Return the voxels whose middles lie in a box along the axes of space."""
    low, high = box.min(axis=0), box.max(axis=0)
    corners = np.array([[box[k, axis] for axis, k in enumerate(which)] for which in np.ndindex(2, 2, 2)])
    back = np.linalg.inv(image.to_space)
    index = corners @ back[:3, :3].T + back[:3, 3]
    first = np.clip(np.floor(index.min(axis=0)), 0, inside.shape).astype(int)
    last = np.clip(np.ceil(index.max(axis=0)) + 1, 0, inside.shape).astype(int)
    part = tuple(slice(a, b) for a, b in zip(first, last))
    kept = np.zeros_like(inside)
    kept[part] = inside[part]
    grids = np.ogrid[part]
    for axis in range(3):
        at = sum(image.to_space[axis, k] * grids[k] for k in range(3)) + image.to_space[axis, 3]
        kept[part] &= (at >= low[axis]) & (at <= high[axis])
    return kept


def _seeded(image: Image, regions: np.ndarray, seed: np.ndarray) -> int:
    """Return the region, from 1, that a point lies in."""
    index = np.rint((np.linalg.inv(image.to_space) @ np.r_[seed, 1.0])[:3]).astype(int)
    if (index < 0).any() or (index >= regions.shape).any():
        ends = _listed(image.place(np.zeros(3))), _listed(image.place(np.array(regions.shape) - 1))
        raise AnatomyError(f"--seed {_listed(seed)} lies outside of the image, which goes from {ends[0]} to {ends[1]}")
    found = int(regions[tuple(index)])
    if found == 0:
        places = np.argwhere(regions) @ image.to_space[:3, :3].T + image.to_space[:3, 3]
        away = np.linalg.norm(places - seed, axis=1)
        value = f" has the value {image.values[tuple(index)]:g} and" if image.values.ndim == 3 else ""
        raise AnatomyError(f"--seed {_listed(seed)}: the voxel there{value} is not in the vessel; the nearest one that "
                           f"is lies {away.min():.3g} mm away, at {_listed(places[away.argmin()])}")
    return found


def _middle(inside: np.ndarray, to_space: np.ndarray) -> str:
    return _listed((to_space @ np.r_[np.argwhere(inside).mean(axis=0), 1.0])[:3])


def _listed(point: np.ndarray) -> str:
    return "[" + ", ".join(f"{number:.4g}" for number in point) + "]"
