"""Where the border of an image cuts a lumen: an end there, flat and with the border's normal.

The section of the border's slice is prolonged beyond it, so that smoothing meets a lumen that goes on, and the wall is
cut by the plane of the border. Thin parts that hang on the lumen in the last slices only, as segmentations have them,
are taken off before.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import binary_dilation, distance_transform_edt
from scipy.ndimage import label as label_regions

from guidewire.anatomy.distance_grid import cut_open
from guidewire.anatomy.images import Image
from guidewire.anatomy.mesh import Mesh

PRISM = 6  # voxels, by which a section is prolonged: the smoothing of its lid does not come to the border
_THIN = 0.5  # of a section's inscribed radius: narrower parts in the last slices are no part of the lumen
_GOES_ON = 0.25  # of a thin part's section, that a vessel has one radius inside at least
_STANDS_OUT = 1.5  # voxels: a thin part is no corner of a section of few voxels
_SLIVER = 0.5  # of the largest radius near it: a smaller section is that of a wall that touches the border
_LONG = 4.0  # widths: a longer section is that of a lumen along the border
_AROUND = np.ones((3, 3))


@dataclass(frozen=True)
class Border:
    """axis, face : the border, and its index there, on the outer face of the voxels; section : ndarray of bool, of the
    slice at the border, two indices; is_end : whether the lumen is cut there, or only touches it."""

    axis: int
    face: float
    section: np.ndarray
    is_end: bool

    @property
    def is_low(self) -> bool:
        """Whether the border is at the first index."""
        return self.face < 0.0

    def middle(self) -> np.ndarray:
        """Return (3,): indices of the section's middle, on the border."""
        return np.insert(np.argwhere(self.section).mean(axis=0), self.axis, self.face)

    def told(self, image: Image, low: np.ndarray) -> str:
        """Return a line of a report, for a section of a part from an index (3,) on."""
        place = ", ".join(f"{number:.4g}" for number in image.place(self.middle() + low))
        side = f"{'first' if self.is_low else 'last'} slice along index {self.axis + 1}"
        area = float(self.section.sum() * np.prod(np.delete(image.spacing, self.axis)))
        return (f"the border of the image, {side}, cuts the lumen at [{place}]: an open end there, of {area:.4g} "
                f"{image.unit or 'unit'}2" if self.is_end else
                f"the lumen touches the border of the image, {side}, at [{place}]: closed there, no end")


def find_borders(inside: np.ndarray, low: np.ndarray, shape: tuple[int, ...]
                 ) -> tuple[list[Border], np.ndarray, np.ndarray]:
    """Return where a part (i, j, k) of an image, from an index (3,) on, meets the border; the part without thin parts
    there; and these."""
    kept, found = inside.copy(), []
    for axis in range(3):
        for is_low in (True, False):
            if low[axis] > 0 if is_low else low[axis] + inside.shape[axis] < shape[axis]:
                continue
            ahead = np.moveaxis(kept if is_low else np.flip(kept, axis), axis, 0)    # views, from the border inwards
            _take_off_thin(ahead)
            labels, count = label_regions(ahead[0], _AROUND)
            face = -0.5 if is_low else inside.shape[axis] - 0.5
            found += [Border(axis, face, labels == k, _is_cut(ahead, labels == k)) for k in range(1, count + 1)]
    # Where two borders meet in an edge of the image, the larger section is the end.
    ends: list[Border] = []
    for border in sorted(found, key=lambda one: -int(one.section.sum())):
        touches = any(one.axis != border.axis and (_voxels(one, kept.shape) & _voxels(border, kept.shape)).any()
                      for one in ends if one.is_end)
        ends.append(replace(border, is_end=border.is_end and not touches))
    return ends, kept, inside & ~kept


def prolonged(field: np.ndarray, borders: list[Border], pad: int) -> np.ndarray:
    """Return a field (i, j, k), positive inside, with so many voxels on all sides: outside, but behind ends' sections,
    which go on."""
    padded = np.pad(field, pad, mode="edge")
    outside = np.ones(padded.shape, dtype=bool)
    outside[pad:-pad, pad:-pad, pad:-pad] = False
    for border in borders:
        if border.is_end:
            beyond = np.moveaxis(outside, border.axis, 0)
            beyond = beyond[2:pad] if border.is_low else beyond[-pad:-2]
            beyond &= ~binary_dilation(np.pad(border.section, pad), iterations=2)
    padded[outside] = np.minimum(padded[outside], -1.0)
    return padded


def cut_at(mesh: Mesh, borders: list[Border], low: np.ndarray, spacing: np.ndarray) -> Mesh:
    """Return a mesh, its coordinates spacing times index, without what lies behind the ends at borders."""
    for border in borders:
        if border.is_end:
            normal = np.zeros(3)
            normal[border.axis] = 1.0 if border.is_low else -1.0
            reach = float(np.linalg.norm(np.ptp(np.argwhere(border.section), axis=0) + PRISM) * spacing.max())
            mesh = cut_open(mesh, spacing * (border.middle() + low), normal, reach)
    return mesh


def _take_off_thin(ahead: np.ndarray) -> None:
    """Takes off, from a border inwards, what is thin beside the section and does not go on inside."""
    labels, count = label_regions(ahead[0], _AROUND)
    for k in range(1, count + 1):
        radius = float(distance_transform_edt(np.pad(labels == k, 1)).max())
        depth = min(len(ahead), 2 + int(np.ceil(radius)))
        parts = label_regions(ahead[:depth], np.ones((3, 3, 3)))[0]
        zone = parts == parts[0][labels == k][0]
        off = np.stack([_off_discs(one, _THIN * radius) for one in zone])
        pieces, number = label_regions(off > 0.0, np.ones((3, 3, 3)))
        for piece in range(1, number + 1):
            areas = (pieces == piece).sum(axis=(1, 2))
            if areas[0] and areas[-1] < _GOES_ON * areas.max() and off[pieces == piece].max() > _STANDS_OUT:
                ahead[:depth][pieces == piece] = False


def _off_discs(section: np.ndarray, radius: float) -> np.ndarray:
    """Return how far each voxel of a section is off all discs of a radius that lie in it, voxels; 0 within them."""
    middles = distance_transform_edt(np.pad(section, 1))[1:-1, 1:-1] > radius
    off = np.maximum(distance_transform_edt(~middles) - radius, 0.0) if middles.any() else np.zeros(section.shape)
    return np.where(section, off, 0.0)


def _is_cut(ahead: np.ndarray, section: np.ndarray) -> bool:
    """Return whether a border cuts a lumen across, from which inwards it is not much wider than its section."""
    radius = float(distance_transform_edt(np.pad(section, 1)).max())
    parts = label_regions(ahead[:2 + 2 * int(np.ceil(radius))], np.ones((3, 3, 3)))[0]
    zone = parts == parts[0][section][0]
    widest = max(float(distance_transform_edt(np.pad(one, 1)).max()) for one in zone)
    longest = float((np.ptp(np.argwhere(section), axis=0) + 1).max())
    return radius >= _SLIVER * widest and longest <= _LONG * 2.0 * radius


def _voxels(border: Border, shape: tuple[int, ...]) -> np.ndarray:
    """Return (i, j, k): the voxels of a section."""
    found = np.zeros(shape, dtype=bool)
    np.moveaxis(found, border.axis, 0)[0 if border.is_low else -1] = border.section
    return found
