"""A picture of the voxels that are taken for a vessel, over the image: slices through one place, and projections."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from guidewire.anatomy.images import Image
from guidewire.anatomy.masks import Taken, Taking

_TAKEN, _LEFT, _GIVEN = "#ff7f0e", "#4aa8ff", "#37d383"
_SAMPLES = 200_000  # voxels, from which the greys are chosen
_GREYS = (1.0, 99.7)  # percentiles, from black to white
_WORDS = (("right", "left"), ("front", "back"), ("feet", "head"))  # towards smaller and larger numbers in LPS


def draw_taken(image: Image, taken: Taken, taking: Taking, title: str) -> Figure:
    """Above the slices through the seed, or else through the middle of what is taken; below the largest values along
    each axis of the voxels."""
    place = _place(image, taken, taking)
    figure = Figure(figsize=(13.0, 9.0), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(2, 3)
    point = ", ".join(f"{number:.4g}" for number in image.place(place))
    figure.suptitle(f"{title}: orange is taken ({int(taken.inside.sum())} voxels), blue is left out; slices through "
                    f"[{point}]", fontsize=11)
    thinned = image.values.ravel()[:: max(1, image.values.size // _SAMPLES)]
    greys = dict(zip(("vmin", "vmax"), np.percentile(thinned, _GREYS)))
    for depth in range(3):
        i, j = [axis for axis in range(3) if axis != depth]
        extent = [-0.5 * image.spacing[i], (image.values.shape[i] - 0.5) * image.spacing[i],
                  -0.5 * image.spacing[j], (image.values.shape[j] - 0.5) * image.spacing[j]]
        for row, cut in enumerate((lambda one: one.take(place[depth], axis=depth), lambda one: one.max(axis=depth))):
            panel = panels[row, depth]
            panel.imshow(cut(image.values).T, cmap="gray", origin="lower", extent=extent, aspect="equal", **greys)
            for voxels, colour in ((taken.others, _LEFT), (taken.inside, _TAKEN)):
                flat = cut(voxels)
                if flat.any():
                    at = [np.arange(n) * image.spacing[axis] for n, axis in zip(flat.shape, (i, j))]
                    panel.contour(*at, flat.T.astype(float), levels=[0.5], colors=[colour], linewidths=1.0)
            _draw_given(panel, image, taking, i, j)
            panel.set(xlim=extent[:2], ylim=extent[2:])
            panel.set_xlabel(_towards(image, i))
            panel.set_ylabel(_towards(image, j))
        panels[0, depth].set_title(f"slice {place[depth] + 1} of {image.values.shape[depth]}", fontsize=10)
        panels[1, depth].set_title("largest values", fontsize=10)
    return figure


def _place(image: Image, taken: Taken, taking: Taking) -> np.ndarray:
    """Return (3,): the seed's voxel, or that of the vessel which is nearest to the middle of it."""
    if taking.seed is not None:
        return np.rint((np.linalg.inv(image.to_space) @ np.r_[taking.seed, 1.0])[:3]).astype(int)
    places = np.argwhere(taken.inside)
    return places[int(np.linalg.norm(places - places.mean(axis=0), axis=1).argmin())]


def _draw_given(panel, image: Image, taking: Taking, i: int, j: int) -> None:
    """The box and the seed."""
    back = np.linalg.inv(image.to_space)

    def at(points: np.ndarray) -> np.ndarray:
        return ((points @ back[:3, :3].T + back[:3, 3]) * image.spacing)[:, [i, j]]

    if taking.box is not None:
        for axis in range(3):
            for one in np.ndindex(2, 2):
                corners = np.insert(np.array([one, one]), axis, [0, 1], axis=1)
                line = at(np.array([[taking.box[corner[k], k] for k in range(3)] for corner in corners]))
                panel.plot(*line.T, color=_GIVEN, linewidth=1.0)
    if taking.seed is not None:
        panel.plot(*at(taking.seed[None])[0], "+", color=_GIVEN, markersize=12, markeredgewidth=2.0)


def _towards(image: Image, axis: int) -> str:
    if not image.axes.is_known:
        return f"along index {axis + 1}, mm"
    column = image.to_space[:3, axis] / image.spacing[axis]
    nearest = int(np.abs(column).argmax())
    return f"mm towards the {_WORDS[nearest][int(column[nearest] > 0.0)]}"
