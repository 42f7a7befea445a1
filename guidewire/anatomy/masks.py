"""The wall of a vessel in voxels: contoured at the threshold of an image or between the voxels of a mask, smoothed
without shrinking, decimated to a stated error, and open where the border of the image cuts the lumen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_fill_holes, correlate1d
from scipy.ndimage import label as label_regions
from scipy.sparse import coo_matrix, diags

from guidewire.anatomy.borders import PRISM, cut_at, find_borders, prolonged
from guidewire.anatomy.images import Image
from guidewire.anatomy.labels import told_values, values_of, voxels_with
from guidewire.anatomy.mesh import AnatomyError, Edges, Mesh, find_bodies, find_rims, signed_volume
from guidewire.anatomy.surfaces import contour, decimate, farthest, smooth

_PASSES, _BAND = 20, 0.1  # of the windowed sinc; at band 0.02 a tube of 2 voxels' radius loses a quarter
_EVENED = 20  # passes of the mean over neighbours, for what the sinc moved along the normals
# A contour between values that are interpolated linearly is that of the values blurred by x (1 - x)/2, in the mean over
# x of a cell by 1/12 of the second difference: that much is taken off first.
_SHARPER = np.array([-1.0, 14.0, -1.0]) / 12.0
_CLEAR = 0.02  # of the step: how far from the threshold the value of a voxel is at least, so that it stays on its side
_ERROR = 0.1  # of decimation, of a voxel's smallest side
_ROUNDED = 1e-6  # of the largest value: so little is 0
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
    places = np.argwhere(inside)
    low, high = np.maximum(places.min(axis=0) - 2, 0), np.minimum(places.max(axis=0) + 3, inside.shape)
    part = tuple(slice(a, b) for a, b in zip(low, high))
    to_part = image.to_space @ np.block([[np.eye(3), low[:, None]], [np.zeros(3), 1.0]])
    borders, own, thin = find_borders(inside[part], low, inside.shape)
    whole, joined = _in_one_piece(own, to_part)
    pad = 2 + PRISM * bool(borders)
    filled = binary_fill_holes(np.pad(whole, 2))[2:-2, 2:-2, 2:-2]
    field = _field(filled, None if taking.threshold is None else image.values[part] - np.float32(taking.threshold))
    marched = contour(prolonged(field, borders, pad), 0.0, spacing * (low - pad), spacing)
    bodies = find_bodies(marched)
    if bodies.max() > 0:    # a region of voxels that share faces, without cavities, has one surface
        raise AnatomyError(f"the surface of region {chosen + 1} is of {bodies.max() + 1} pieces")
    smoothed = _smoothed(marched)
    allowed = taking.error or _ERROR * float(spacing.min())
    decimated = decimate(smoothed, allowed)
    mesh = cut_at(decimated, borders, low, spacing)
    volume = abs(signed_volume(mesh, find_rims(mesh, Edges.of(mesh)))) * voxel / float(np.prod(spacing))
    unit = image.unit or "unit"
    sides = " x ".join(f"{side:.3g}" for side in spacing)
    notes = [f"{int(inside.sum())} voxels of {sides} {unit} in region {chosen + 1} of {count}; smoothed, wall moved "
             f"by {farthest(marched, smoothed, 3000):.2g} {unit} at most",
             f"{len(smoothed.triangles)} triangles decimated to {len(decimated.triangles)}, wall moved by "
             f"{farthest(smoothed, decimated):.2g} {unit} at most (allowed: {allowed:.2g} {unit})",
             *(border.told(image, low) for border in borders), *joined]
    if (filled != whole).any():
        notes.append(f"{int((filled & ~whole).sum())} voxels of cavities within it filled, around "
                     f"{_middle(filled & ~whole, to_part)}")
    notes.append(f"volume: voxels {voxel * int(filled.sum()):.5g} {unit}3, within the wall {volume:.5g} {unit}3 "
                 f"({volume / (voxel * int(filled.sum())) - 1.0:+.2%})")
    if thin.any():
        left_out.append(f"{int(thin.sum())} voxels of thin parts beside the lumen at the border of the image, around "
                        f"{_middle(thin, to_part)}")
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


def _field(inside: np.ndarray, over: np.ndarray | None) -> np.ndarray:
    """Return (i, j, k): values that are above 0 in the voxels of a region and below 0 in all others; of an image what
    its values, sharpened, are over the threshold, and of a mask 1 and -1."""
    if over is None:
        return np.where(inside, np.float32(1.0), np.float32(-1.0))
    step = float(np.median(over[inside]))
    field = over.astype(np.float32)
    for axis in range(3):
        field = correlate1d(field, _SHARPER, axis=axis, mode="nearest")
    field /= step if step > 0.0 else 1.0
    # Voxels that were joined, and cavities that were filled, are inside though their values are not.
    field[inside & (over <= 0.0)] = 1.0
    return np.where(inside, np.maximum(field, _CLEAR), np.minimum(field, -_CLEAR))


def _smoothed(marched: Mesh) -> Mesh:
    """Return a contour without its steps. The sinc shrinks what is narrow, so that the mean over neighbours of what it
    moved along the normals is given back; and vertices are moved out of the wall until the triangles between them lie
    on it in the mean, not inside of it.

    Of a surface of second derivative H the mean of h over a triangle is that of its corners less the sum of e.H e/24
    over its edges e. The mean of the neighbours of a vertex is off it by the mean of e.H e/2: four times that.
    """
    mesh = smooth(marched, _PASSES, _BAND)
    ends, count = Edges.of(mesh).ends, len(mesh.vertices)
    graph = coo_matrix((np.ones(len(ends)), ends.T), shape=(count, count)).tocsr()
    graph = graph + graph.T
    mean = diags(1.0 / np.asarray(graph.sum(axis=1)).ravel()) @ graph
    normals = mesh.vertex_normals()
    off = np.einsum("ij,ij->i", marched.vertices - mesh.vertices, normals)
    for _ in range(_EVENED):
        off = 0.5 * (off + mean @ off)
    off -= 0.25 * np.einsum("ij,ij->i", mean @ mesh.vertices - mesh.vertices, normals)
    return Mesh(mesh.vertices + off[:, None] * normals, mesh.triangles)


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
        # After a slope and an intercept 0 is off by rounding.
        inside, asked = np.abs(values) > _ROUNDED * np.abs(found).max(), ""
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
