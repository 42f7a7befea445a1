"""Pictures and short films of a run: the wire as a tube, of the vessel the far wall, so that one looks inside.

No Unity takes part: the wire and the catheters come from the log, walls are triangles that the caller brings, the pixels are made by
analysis.raster. One moment is coloured by curvature; several moments in one picture have a colour each.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

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
CATHETERS = (np.array([1.0, 0.62, 0.18]), np.array([0.71, 0.55, 1.0]), np.array([0.37, 0.83, 0.55]))  # as on the page
SIZE = (960, 600)
_FILM_SIZE = (640, 400)
_OVERSAMPLING = 2
_THINNEST = 1.0 / 400.0  # radius of the wire over what the picture spans: less would be no pixel wide
_SEEN_THROUGH = 0.5  # how much a catheter tints what is in it
_LATER_COVERS = 0.03  # fraction of its radius by which a wire lies over one before it in the same place
_PIECES = 12  # triangles are cut to so small a part of what the picture spans: one behind the camera is not drawn
_TEXT = (225, 225, 230)
_FOLLOWING = 4.0  # zoom where the tip is followed and nothing else is said
VIEWS = {"side": (-90.0, 15.0), "front": (0.0, 0.0), "top": (-90.0, 90.0), "back": (90.0, 15.0)}  # yaw, pitch


@dataclass(frozen=True)
class View:
    """Where a picture is seen from; None is chosen so that all is seen that the wire passes, and of a wire in a sheath
    what is out of it, and the vessel.

    target : point in the middle, units; distance : of the camera from it, units; yaw, pitch : degrees, 0 and 0 look
    along +z, yaw -90 looks along -x, pitch 90 down; radius : of the wire as it is drawn, units; zoom : so many times as
    near as the distance says; follows_tip : the tip is in the middle at every moment.
    """

    target: tuple[float, float, float] | None = None
    distance: float | None = None
    yaw: float = -90.0
    pitch: float = 15.0
    radius: float | None = None
    zoom: float | None = None
    follows_tip: bool = False

    @property
    def nearer(self) -> float:
        """How many times as near the camera is."""
        return self.zoom or (_FOLLOWING if self.follows_tip else 1.0)


@dataclass(frozen=True)
class Catheter:
    """A catheter over the wire, as it is drawn.

    name : what it is called; radius : its outer one, units; colour : (3,) in [0, 1].
    """

    name: str
    radius: float
    colour: np.ndarray


def catheters_of(instruments: Sequence[Mapping[str, Any]]) -> tuple[Catheter, ...]:
    """Those among a run's instruments, as `Session.describe` lists them."""
    return tuple(Catheter(one["title"], max(one["radii"]), CATHETERS[k % len(CATHETERS)])
                 for k, one in enumerate(instruments[1:]))


@dataclass(frozen=True)
class Stage:
    """What stays the same in all pictures of a run: its vessel, drawn once, and the camera.

    background : the far walls; obstacles : bodies in the wire's way; radius : of the wire as it is drawn, units;
    bend : 1/unit, curvature shown as full red; catheters : over the wire, with the radii that they are drawn with.
    """

    camera: Camera
    background: Picture
    obstacles: tuple[Surface, ...]
    radius: float
    bend: float
    catheters: tuple[Catheter, ...] = ()


def bend_colours(values: np.ndarray, full: float) -> np.ndarray:
    """Grey to red, shape (v, 3), for curvatures (v,) in 1/unit; ``full`` is the curvature of full red."""
    fraction = np.clip(values / full, 0.0, 1.0)[:, None]
    return (1.0 - fraction) * GREY + fraction * RED


def set_stage(run: Run, log: PositionLog, walls: Sequence[Surface], view: View,
              catheters: Sequence[Catheter] = ()) -> Stage:
    """Draw what does not move.

    Parameters
    ----------
    run : the run.
    log : its positions, all spheres.
    walls : the vessel first, where the run has one, and the obstacles.
    view : where to look from.
    catheters : those over the wire.
    """
    middle, diagonal = _framed(run, log, walls)
    seen = (diagonal if view.distance is None else min(diagonal, view.distance)) / view.nearer
    radius = view.radius or max(_radius(run), _THINNEST * seen)
    distance = 1.05 * (diagonal + 4.0 * radius) if view.distance is None else view.distance
    camera = Camera(tuple(middle) if view.target is None else view.target, distance / view.nearer, view.yaw, view.pitch)
    background = Picture.blank(SIZE[0] * _OVERSAMPLING, SIZE[1] * _OVERSAMPLING)
    has_vessel = bool(run.parameters.get("vessel"))
    for surface in walls[:1] if has_vessel else ():
        surface = refine(surface, max(diagonal / view.nearer, 10.0 * radius) / _PIECES)
        draw(background, camera, surface, np.broadcast_to(WALL, surface.vertices.shape), 0.75)
    bends = [float(curvature(positions).max()) for positions in log.positions if np.isfinite(positions).all()]
    return Stage(camera, background, tuple(walls[1:] if has_vessel else walls), radius,
                 _round_up(max([*bends, 0.1 / diagonal])),
                 tuple(replace(one, radius=one.radius * radius / _radius(run)) for one in catheters))


def frame(stage: Stage, wires: Sequence[tuple[np.ndarray, np.ndarray | None]], lines: Sequence[str],
          catheters: Sequence[Sequence[np.ndarray]] = ()) -> Image.Image:
    """One picture.

    Parameters
    ----------
    stage : what does not move.
    wires : from the first moment to the last, positions (n+1, 3) in units, and the wire's colour (3,) in [0, 1], or None: coloured by curvature.
    lines : text in the lower left corner; line k in the colour of wire k, where that has one.
    catheters : positions (m+1, 3) of those of the stage at each moment, outermost first. One sees through them.
    """
    picture = stage.background.copy()
    for k, (positions, colour) in enumerate(wires):
        surface = tube(positions, (1.0 + _LATER_COVERS * k) * stage.radius)
        plain = None if colour is None else np.broadcast_to(colour, surface.vertices.shape)
        draw(picture, stage.camera, surface, bend_colours(surface.values, stage.bend) if plain is None else plain)
    for positions, one in ((positions, one) for moment in catheters for positions, one in zip(moment, stage.catheters)):
        surface = tube(positions, one.radius)
        draw(picture, stage.camera, surface, np.broadcast_to(one.colour, surface.vertices.shape), _SEEN_THROUGH)
    for obstacle in stage.obstacles:  # a tint over what is behind them: a sheath must not hide the wire
        draw(picture, stage.camera, obstacle, np.broadcast_to(OBSTACLE, obstacle.vertices.shape), 0.35)
    pixels = Image.fromarray((255.0 * np.clip(picture.colour, 0.0, 1.0) + 0.5).astype(np.uint8))
    pixels = pixels.resize(SIZE, Image.LANCZOS)
    pen = ImageDraw.Draw(pixels)
    for k, line in enumerate(lines):
        colour = wires[k][1] if k < len(wires) else None
        fill = _TEXT if colour is None else tuple(int(255 * part) for part in colour)
        pen.text((12, SIZE[1] - 22 - 16 * (len(lines) - 1 - k)), line, fill=fill)
    for k, one in enumerate(stage.catheters if catheters else ()):
        pen.text((12, 10 + 16 * k), one.name, fill=tuple(int(255 * part) for part in one.colour))
    return pixels


def draw_picture(run: Run, log: PositionLog, walls: Sequence[Surface], view: View, times: Sequence[float],
                 catheters: Sequence[Catheter] = ()) -> Image.Image:
    """A picture of a run: its last moment, or several.

    Parameters
    ----------
    run, log, walls, view, catheters : as of `set_stage`.
    times : s, in-game; of each the nearest moment of the log is drawn, in a colour of its own. None: the last moment,
        coloured by curvature.
    """
    chosen = sorted({nearest(log, time) for time in times}) or [len(log.time) - 1]
    if view.follows_tip and len(chosen) > 1:
        raise LogError("the tip is followed in a film or at one moment: give one of --times")
    stage = set_stage(run, log, walls, _at_tip(view, log, chosen[-1]), catheters)
    if not times:
        return frame(stage, [(_finite(log, -1), None)], [_caption(log, -1, stage)], [_catheters_at(log, -1)])
    colours = colormaps["plasma"](np.linspace(0.4, 0.95, len(chosen)))[:, :3]
    return frame(stage, [(_finite(log, k), colour) for k, colour in zip(chosen, colours)],
                 [f"t = {log.time[k]:.4g} s   step {log.steps[k]}" for k in chosen],
                 [_catheters_at(log, k) for k in chosen])


def draw_film(run: Run, log: PositionLog, walls: Sequence[Surface], view: View, frames: int,
              tell: Callable[[int, int], None] = lambda done, count: None,
              catheters: Sequence[Catheter] = ()) -> list[Image.Image]:
    """Pictures of a run, evenly spaced in time, coloured by curvature; the first is the start, the last the end.

    Parameters
    ----------
    run, log, walls, view, catheters : as of `set_stage`.
    frames : how many at most: a log of fewer entries has no more.
    tell : called after each picture with how many are drawn, and of how many.
    """
    stage = set_stage(run, log, walls, _at_tip(view, log, 0), catheters)
    chosen = np.unique(np.linspace(0, len(log.time) - 1, frames).astype(int))
    images = []
    for k in chosen:
        if view.follows_tip and images:
            stage = set_stage(run, log, walls, _at_tip(view, log, k), catheters)
        images.append(frame(stage, [(_finite(log, k), None)], [_caption(log, k, stage)], [_catheters_at(log, k)])
                      .resize(_FILM_SIZE, Image.LANCZOS).quantize(64))
        tell(len(images), len(chosen))
    return images


def save_images(images: Sequence[Image.Image], path: Path) -> None:
    """Write one picture, or pictures as a GIF that begins anew at its end."""
    if path.suffix == ".gif":
        images[0].save(path, save_all=True, append_images=list(images[1:]), duration=80, loop=0, optimize=True)
    else:
        images[0].save(path, optimize=True)


def nearest(log: PositionLog, time: float) -> int:
    """The log's entry that is nearest to a moment of the run."""
    slack = 1e-9 + (float(np.diff(log.time).max()) if len(log.time) > 1 else 0.0)
    if not log.time[0] - slack <= time <= log.time[-1] + slack:
        raise LogError(f"{log.source}: --times {time:g} is beyond the run, whose log goes from {log.time[0]:g} s to "
                       f"{log.time[-1]:g} s")
    return int(np.argmin(np.abs(log.time - time)))


def _at_tip(view: View, log: PositionLog, k: int) -> View:
    """A view of the tip at one entry of the log, where it is followed."""
    return replace(view, target=tuple(_finite(log, k)[-1])) if view.follows_tip else view


def out_of_sheath(run: Run, log: PositionLog) -> tuple[np.ndarray, float]:
    """Middle (3,) and diagonal, units, of the box around all places that the wire passes; of a wire in a sheath, which
    is straight and may be metres long, around those that lie beyond the sheath's exit.

    Raises LogError as `extent`.
    """
    middle, diagonal = extent(log)
    outside = int(((run.summary or {}).get("hub") or {}).get("spheresInBody") or 0)
    if run.parameters.get("sheath") is None or not 0 < outside < len(log.final_positions):
        return middle, diagonal
    inside = log.final_positions[-outside - 1]
    every = log.positions.reshape(-1, 3)
    every = every[np.isfinite(every).all(axis=1)]
    every = every[(every - inside) @ (log.final_positions[-outside] - inside) >= 0.0]
    low, high = every.min(axis=0), every.max(axis=0)
    return 0.5 * (low + high), float(np.linalg.norm(high - low))


def _framed(run: Run, log: PositionLog, walls: Sequence[Surface]) -> tuple[np.ndarray, float]:
    """Middle (3,) and diagonal, units, of what a picture shows: where the wire passes, and with a sheath its vessel."""
    middle, diagonal = out_of_sheath(run, log)
    if run.parameters.get("sheath") is None or (run.parameters.get("vessel") or {}).get("shape") != "mesh":
        return middle, diagonal
    half = 0.5 * diagonal / np.sqrt(3.0)
    low = np.minimum(middle - half, walls[0].vertices.min(axis=0))
    high = np.maximum(middle + half, walls[0].vertices.max(axis=0))
    return 0.5 * (low + high), float(np.linalg.norm(high - low))


def _radius(run: Run) -> float:
    """The wire's radius in units: with gains what meets walls, with a material its own."""
    if "wireRadius" in run.parameters:
        return run.number("wireRadius") / run.number("metresPerUnit")
    return run.number("sphereRadius")


def _finite(log: PositionLog, k: int) -> np.ndarray:
    if not np.isfinite(log.positions[k]).all():
        raise LogError(f"{log.source}: step {log.steps[k]} has a position that is not finite; give --times before it")
    return log.positions[k]


def _catheters_at(log: PositionLog, k: int) -> list[np.ndarray]:
    return [positions[k] for positions in log.catheters]


def _caption(log: PositionLog, k: int, stage: Stage) -> str:
    bend = f"red: bent to a radius of {1.0 / stage.bend:.4g} units"
    return f"t = {log.time[k]:.4g} s   step {log.steps[k]}   {bend}"


def _round_up(value: float) -> float:
    """The next number of the form 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if value <= step * power * (1.0 + 1e-12))
