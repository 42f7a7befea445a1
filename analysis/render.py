"""Pictures and short films of a run: the wire as a tube, of the vessel the far wall, so that one looks inside.

No Unity takes part: the wire comes from the log, walls are triangles that the caller brings, the pixels are made by
analysis.raster. One moment is coloured by curvature; several moments in one picture have a colour each.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib import colormaps
from PIL import Image, ImageDraw

from analysis.logs import LogError, PositionLog, extent
from analysis.raster import Camera, Picture, draw
from analysis.runs import Run
from analysis.surfaces import Surface, curvature, refine, tube

GREY, RED = np.array([0.82, 0.84, 0.88]), np.array([0.95, 0.1, 0.05])
WALL = np.array([0.72, 0.6, 0.58])
OBSTACLE = np.array([0.45, 0.6, 0.75])
SIZE = (960, 600)
_FILM_SIZE = (640, 400)
_OVERSAMPLING = 2
_THINNEST = 1.0 / 400.0  # radius of the wire over what the picture spans: less would be no pixel wide
_LATER_COVERS = 0.03  # share of its radius by which a wire lies over one before it in the same place
_PIECES = 12  # triangles are cut to so small a part of what the picture spans: one behind the camera is not drawn
_TEXT = (225, 225, 230)


@dataclass(frozen=True)
class View:
    """Where a picture is seen from; None is chosen so that all is seen that the wire passes.

    target : point in the middle, units; distance : of the camera from it, units; yaw, pitch : degrees, 0 and 0 look
    along +z, yaw -90 looks along -x, pitch 90 down; radius : of the wire as it is drawn, units.
    """

    target: tuple[float, float, float] | None = None
    distance: float | None = None
    yaw: float = -90.0
    pitch: float = 15.0
    radius: float | None = None


@dataclass(frozen=True)
class Stage:
    """What stays the same in all pictures of a run: its vessel, drawn once, and the camera.

    background : the far walls; obstacles : bodies in the wire's way; radius : of the wire as it is drawn, units;
    bend : 1/unit, curvature shown as full red.
    """

    camera: Camera
    background: Picture
    obstacles: tuple[Surface, ...]
    radius: float
    bend: float


def bend_colours(values: np.ndarray, full: float) -> np.ndarray:
    """Grey to red, shape (v, 3), for curvatures (v,) in 1/unit; ``full`` is the curvature of full red."""
    share = np.clip(values / full, 0.0, 1.0)[:, None]
    return (1.0 - share) * GREY + share * RED


def set_stage(run: Run, log: PositionLog, walls: Sequence[Surface], view: View) -> Stage:
    """Draw what does not move.

    Parameters
    ----------
    run : the run.
    log : its positions, all spheres.
    walls : the vessel first, where the run has one, and the obstacles.
    view : where to look from.
    """
    middle, diagonal = extent(log)
    seen = diagonal if view.distance is None else min(diagonal, view.distance)
    radius = view.radius or max(_radius(run), _THINNEST * seen)
    camera = Camera(
        tuple(middle) if view.target is None else view.target,
        1.05 * (diagonal + 4.0 * radius) if view.distance is None else view.distance, view.yaw, view.pitch)
    background = Picture.blank(SIZE[0] * _OVERSAMPLING, SIZE[1] * _OVERSAMPLING)
    has_vessel = bool(run.parameters.get("vessel"))
    for surface in walls[:1] if has_vessel else ():
        surface = refine(surface, max(diagonal, 10.0 * radius) / _PIECES)
        draw(background, camera, surface, np.broadcast_to(WALL, surface.vertices.shape), 0.75)
    bends = [float(curvature(positions).max()) for positions in log.positions if np.isfinite(positions).all()]
    return Stage(camera, background, tuple(walls[1:] if has_vessel else walls), radius,
                 _round_up(max([*bends, 0.1 / diagonal])))


def frame(stage: Stage, wires: Sequence[tuple[np.ndarray, np.ndarray | None]], lines: Sequence[str]) -> Image.Image:
    """One picture.

    Parameters
    ----------
    stage : what does not move.
    wires : from the first moment to the last, positions (n+1, 3) in units, and the wire's colour (3,) in [0, 1], or None: coloured by curvature.
    lines : text in the lower left corner; line k in the colour of wire k, where that has one.
    """
    picture = stage.background.copy()
    for k, (positions, colour) in enumerate(wires):
        surface = tube(positions, (1.0 + _LATER_COVERS * k) * stage.radius)
        plain = None if colour is None else np.broadcast_to(colour, surface.vertices.shape)
        draw(picture, stage.camera, surface, bend_colours(surface.values, stage.bend) if plain is None else plain)
    for obstacle in stage.obstacles:  # a tint over what is behind them: a sheath must not hide the wire
        draw(picture, stage.camera, obstacle, np.broadcast_to(OBSTACLE, obstacle.vertices.shape), 0.35)
    pixels = Image.fromarray((255.0 * np.clip(picture.colour, 0.0, 1.0) + 0.5).astype(np.uint8))
    pixels = pixels.resize(SIZE, Image.LANCZOS)
    pen = ImageDraw.Draw(pixels)
    for k, line in enumerate(lines):
        colour = wires[k][1] if k < len(wires) else None
        fill = _TEXT if colour is None else tuple(int(255 * part) for part in colour)
        pen.text((12, SIZE[1] - 22 - 16 * (len(lines) - 1 - k)), line, fill=fill)
    return pixels


def draw_picture(run: Run, log: PositionLog, walls: Sequence[Surface], view: View, times: Sequence[float]
                 ) -> Image.Image:
    """A picture of a run: its last moment, or several.

    Parameters
    ----------
    run, log, walls, view : as of `set_stage`.
    times : s, in-game; of each the nearest moment of the log is drawn, in a colour of its own. None: the last moment,
        coloured by curvature.
    """
    stage = set_stage(run, log, walls, view)
    if not times:
        return frame(stage, [(_finite(log, -1), None)], [_caption(log, -1, stage)])
    chosen = sorted({int(np.argmin(np.abs(log.time - time))) for time in times})
    colours = colormaps["plasma"](np.linspace(0.4, 0.95, len(chosen)))[:, :3]
    return frame(stage, [(_finite(log, k), colour) for k, colour in zip(chosen, colours)],
                 [f"t = {log.time[k]:.4g} s   step {log.steps[k]}" for k in chosen])


def draw_film(run: Run, log: PositionLog, walls: Sequence[Surface], view: View, frames: int) -> list[Image.Image]:
    """Pictures of a run, evenly spaced in time, coloured by curvature; the first is the start, the last the end.

    Parameters
    ----------
    run, log, walls, view : as of `set_stage`.
    frames : how many at most: a log of fewer entries has no more.
    """
    stage = set_stage(run, log, walls, view)
    chosen = np.unique(np.linspace(0, len(log.time) - 1, frames).astype(int))
    return [frame(stage, [(_finite(log, k), None)], [_caption(log, k, stage)]).resize(_FILM_SIZE, Image.LANCZOS)
            .quantize(64) for k in chosen]


def save_film(images: Sequence[Image.Image], path: Path) -> None:
    """Write pictures as a GIF that begins anew at its end."""
    images[0].save(path, save_all=True, append_images=list(images[1:]), duration=80, loop=0, optimize=True)


def _radius(run: Run) -> float:
    """The wire's radius in units: with gains what meets walls, with a material its own."""
    if "wireRadius" in run.parameters:
        return run.number("wireRadius") / run.number("metresPerUnit")
    return run.number("sphereRadius")


def _finite(log: PositionLog, k: int) -> np.ndarray:
    if not np.isfinite(log.positions[k]).all():
        raise LogError(f"{log.source}: step {log.steps[k]} has a position that is not finite; give --times before it")
    return log.positions[k]


def _caption(log: PositionLog, k: int, stage: Stage) -> str:
    bend = f"red: bent to a radius of {1.0 / stage.bend:.4g} units"
    return f"t = {log.time[k]:.4g} s   step {log.steps[k]}   {bend}"


def _round_up(value: float) -> float:
    """The next number of the form 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if value <= step * power * (1.0 + 1e-12))
