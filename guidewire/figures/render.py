"""Pictures and short films of a run: the wire as a tube, and the far wall of the vessel, so that the inside is visible.

No Unity takes part: the wire and the catheters come from the log, walls are triangles that the caller brings, the
pixels are made by guidewire.figures.raster. One moment of a wire alone is coloured by curvature, instruments in one
another have a colour each; several moments in one picture have a colour each.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps, get_data_path
from PIL import Image, ImageDraw, ImageFont

from guidewire.figures.raster import Camera, Picture, draw
from guidewire.logs.logs import LogError, PositionLog, extent
from guidewire.logs.paths import lengths_of, through_tips
from guidewire.logs.runs import Run
from guidewire.logs.surfaces import Surface, curvature, refine, tube

GREY, RED = np.array([0.82, 0.84, 0.88]), np.array([0.95, 0.1, 0.05])
WALL = np.array([0.72, 0.6, 0.58])
PLAIN_WALL = np.array([0.56, 0.57, 0.6])  # behind instruments that have a colour each
OBSTACLE = np.array([0.45, 0.6, 0.75])
INSTRUMENTS = (np.array([0.29, 0.66, 1.0]), np.array([1.0, 0.62, 0.18]), np.array([0.71, 0.55, 1.0]),
               np.array([0.37, 0.83, 0.55]))  # as on the page, the wire's first
SIZE = (960, 600)
_FILM_SIZE = (640, 400)
_FILM_COLOURS = 256
_LEARNT_FROM = 8  # pictures of a film, its colours
_OVERSAMPLING = 2
_THINNEST = 1.0 / 400.0  # radius of the wire over what the picture spans: less would be no pixel wide
_OPACITY = 0.6  # how much a catheter tints what is in it
_LATER_COVERS = 0.03  # fraction of its radius by which a wire lies over one before it in the same place
_PIECES = 12  # triangles are cut to so small a part of what the picture spans: one behind the camera is not drawn
_TEXT = (225, 225, 230)
_BEHIND_TEXT = (20, 23, 31)
_LETTERS = 14  # pixels
_SHEATH = 2.0  # radius of a sheath over that of the widest instrument in it, as on the page
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
class Instrument:
    """A wire or a catheter over it, as it is drawn.

    name : what it is called; radius : its outer one, units; colour : (3,) in [0, 1]; hub : (k, 2), insertion in m and
    turn in rad at each entry of the log, or None where the log does not have them.
    """

    name: str
    radius: float
    colour: np.ndarray
    hub: np.ndarray | None = None

    def line(self, entry: int | None) -> str:
        """Return its name, and where its hub is at an entry of the log."""
        if entry is None or self.hub is None:
            return self.name
        insertion, turn = self.hub[entry]
        return f"{self.name}: {1e3 * insertion:.0f} mm in, turned by {math.degrees(turn):.0f}°"


def instruments_of(described: Sequence[Mapping[str, Any]], hubs: Sequence[np.ndarray | None]) -> tuple[Instrument, ...]:
    """Return a run's instruments, the wire's first, as `Session.describe` lists them, with their hubs."""
    return tuple(Instrument(one["title"], max(one["radii"]), INSTRUMENTS[k % len(INSTRUMENTS)], hub)
                 for k, (one, hub) in enumerate(zip(described, hubs, strict=True)))


@dataclass(frozen=True)
class Stage:
    """What stays the same in all pictures of a run: its vessel, drawn once, and the camera.

    background : the far walls; obstacles : bodies in the wire's way, and a sheath; radius : of the wire as it is drawn,
    units; bend : 1/unit, curvature shown as full red; instruments : the wire and the catheters over it, with the radii
    that they are drawn with, none for a wire alone; metres : that a unit is, 0 where it is none in particular;
    has_sheath : whether a sheath is among the obstacles.
    """

    camera: Camera
    background: Picture
    obstacles: tuple[Surface, ...]
    radius: float
    bend: float
    instruments: tuple[Instrument, ...] = ()
    metres: float = 0.0
    has_sheath: bool = False


def bend_colours(values: np.ndarray, full: float) -> np.ndarray:
    """Grey to red, shape (v, 3), for curvatures (v,) in 1/unit; ``full`` is the curvature of full red."""
    fraction = np.clip(values / full, 0.0, 1.0)[:, None]
    return (1.0 - fraction) * GREY + fraction * RED


def set_stage(run: Run, log: PositionLog, walls: Sequence[Surface], view: View,
              instruments: Sequence[Instrument] = (), sheath: np.ndarray | None = None,
              moved: Sequence[Surface] | None = None) -> Stage:
    """Draw what does not move.

    Parameters
    ----------
    run : the run.
    log : its positions, all spheres.
    walls : the vessel first, where the run has one, and the obstacles.
    view : where to look from.
    instruments : the wire and the catheters over it; none for a wire alone.
    sheath : (2, 3), units, from its exit back; or None.
    moved : the walls as they are drawn, where they give way; None: at rest.
    """
    middle, diagonal = _framed(run, log, walls)
    seen = (diagonal if view.distance is None else min(diagonal, view.distance)) / view.nearer
    radius = view.radius or max(_radius(run), _THINNEST * seen)
    distance = 1.05 * (diagonal + 4.0 * radius) if view.distance is None else view.distance
    camera = Camera(tuple(middle) if view.target is None else view.target, distance / view.nearer, view.yaw, view.pitch)
    background = Picture.blank(SIZE[0] * _OVERSAMPLING, SIZE[1] * _OVERSAMPLING)
    has_vessel = bool(run.parameters.get("vessel"))
    shown = walls if moved is None else moved
    for surface in shown[:1] if has_vessel else ():
        surface = refine(surface, max(diagonal / view.nearer, 10.0 * radius) / _PIECES)
        wall = PLAIN_WALL if instruments else WALL
        draw(background, camera, surface, np.broadcast_to(wall, surface.vertices.shape), 0.75)
    bends = [float(curvature(positions).max()) for positions in log.positions if np.isfinite(positions).all()]
    drawn = tuple(replace(one, radius=one.radius * radius / _radius(run)) for one in instruments)
    obstacles = list(shown[1:] if has_vessel else shown)
    if sheath is not None:
        widest = max([radius, *(one.radius for one in drawn)])
        obstacles.append(tube(np.linspace(sheath[0], sheath[1], 9), _SHEATH * widest))
    return Stage(camera, background, tuple(obstacles), radius, _round_up(max([*bends, 0.1 / diagonal])), drawn,
                 run.number("metresPerUnit") if "wireRadius" in run.parameters else 0.0, sheath is not None)


def frame(stage: Stage, wires: Sequence[tuple[np.ndarray, np.ndarray | None]], lines: Sequence[str],
          catheters: Sequence[Sequence[np.ndarray]] = (), entry: int | None = None,
          size: tuple[int, int] = SIZE) -> Image.Image:
    """Draw one picture.

    Parameters
    ----------
    stage : what does not move.
    wires : from the first moment to the last, positions (n+1, 3) in units, and the wire's colour (3,) in [0, 1], or
        None: its own where there are catheters over it, else by curvature.
    lines : text in the lower left corner; line k in the colour of wire k, where that has one.
    catheters : positions (m+1, 3) of those of the stage at each moment, outermost first. One sees through them.
    entry : of the log, where the picture is of one moment.
    size : pixels.
    """
    picture = stage.background.copy()
    own = stage.instruments[0].colour if stage.instruments else None
    for k, (positions, colour) in enumerate(wires):
        surface = tube(positions, (1.0 + _LATER_COVERS * k) * stage.radius)
        colour = own if colour is None else colour
        plain = None if colour is None else np.broadcast_to(colour, surface.vertices.shape)
        draw(picture, stage.camera, surface, bend_colours(surface.values, stage.bend) if plain is None else plain)
    for positions, one in ((positions, one) for moment in catheters
                           for positions, one in zip(moment, stage.instruments[1:])):
        surface = tube(positions, one.radius)
        draw(picture, stage.camera, surface, np.broadcast_to(one.colour, surface.vertices.shape), _OPACITY)
    for obstacle in stage.obstacles:  # a tint over what is behind them: a sheath must not hide the wire
        draw(picture, stage.camera, obstacle, np.broadcast_to(OBSTACLE, obstacle.vertices.shape), 0.35)
    pixels = Image.fromarray((255.0 * np.clip(picture.colour, 0.0, 1.0) + 0.5).astype(np.uint8))
    pixels = pixels.resize(size, Image.LANCZOS)
    pen = ImageDraw.Draw(pixels)
    height = _LETTERS + 5
    for k, line in enumerate(lines):
        colour = wires[k][1] if k < len(wires) else None
        _write(pen, (12, size[1] - 10 - height * (len(lines) - k)), line, _TEXT if colour is None else _pixel(colour))
    first = 1 if entry is None else 0  # of several moments the wire has the colours that the lines below have
    legend = [(one.line(entry), one.colour) for one in stage.instruments[first:]]
    for k, (line, colour) in enumerate([*legend, *([("sheath", OBSTACLE)] if legend and stage.has_sheath else [])]):
        _write(pen, (12, 8 + height * k), line, _pixel(colour))
    _draw_scale(pen, stage, size)
    return pixels


def _draw_scale(pen: ImageDraw.ImageDraw, stage: Stage, size: tuple[int, int]) -> None:
    """A bar of a round length, as it is seen where the camera looks at, in the lower right corner."""
    pixels = 0.5 * size[1] / math.tan(0.5 * math.radians(stage.camera.field_of_view)) / stage.camera.distance
    unit = 1e3 * stage.metres or 1.0
    length = 1.0 / _round_up(1.0 / (0.25 * size[0] / pixels * unit))
    right, y = size[0] - 16, size[1] - 16
    pen.line((right - length / unit * pixels, y, right, y), fill=_TEXT, width=2)
    text = f"{length:g} {'mm' if stage.metres else 'units'}"
    _write(pen, (right - pen.textlength(text, font=_letters()), y - _LETTERS - 8), text, _TEXT)


def _write(pen: ImageDraw.ImageDraw, place: tuple[float, float], text: str, colour: tuple[int, ...]) -> None:
    pen.text(place, text, fill=colour, font=_letters(), stroke_width=2, stroke_fill=_BEHIND_TEXT)


@cache
def _letters() -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(str(Path(get_data_path(), "fonts", "ttf", "DejaVuSans.ttf")), _LETTERS)


def _pixel(colour: np.ndarray) -> tuple[int, ...]:
    return tuple(int(255 * part) for part in colour)


def draw_picture(run: Run, log: PositionLog, walls: Sequence[Surface], view: View, times: Sequence[float],
                 instruments: Sequence[Instrument] = (), sheath: np.ndarray | None = None,
                 moved: Callable[[int], Sequence[Surface]] | None = None) -> Image.Image:
    """Return a picture of a run: its last moment, or several.

    Parameters
    ----------
    run, log, walls, view, instruments, sheath : as of `set_stage`.
    times : s, in-game; of each the nearest moment of the log is drawn, in a colour of its own. None: the last moment,
        as a film shows it.
    moved : walls that give way as they are drawn at an entry of the log; of several the last one counts.
    """
    chosen = sorted({nearest(log, time) for time in times}) or [len(log.time) - 1]
    if view.follows_tip and len(chosen) > 1:
        raise LogError("the tip is followed in a film or at one moment: give one of --times")
    stage = set_stage(run, log, walls, _at_tip(view, log, chosen[-1]), instruments, sheath,
                      moved and moved(chosen[-1]))
    if not times:
        return _frame_at(stage, log, chosen[0], SIZE)
    colours = colormaps["plasma"](np.linspace(0.4, 0.95, len(chosen)))[:, :3]
    return frame(stage, [(_path(log, k), colour) for k, colour in zip(chosen, colours)],
                 [f"t = {log.time[k]:.4g} s   step {log.steps[k]}" for k in chosen],
                 [_catheters_at(log, k) for k in chosen])


def draw_film(run: Run, log: PositionLog, walls: Sequence[Surface], view: View, frames: int,
              tell: Callable[[int, int], None] = lambda done, count: None,
              instruments: Sequence[Instrument] = (), sheath: np.ndarray | None = None,
              moved: Callable[[int], Sequence[Surface]] | None = None) -> list[Image.Image]:
    """Pictures of a run, evenly spaced in time; the first is the start, the last the end.

    Parameters
    ----------
    run, log, walls, view, instruments, sheath : as of `set_stage`.
    frames : how many at most: a log of fewer entries has no more.
    tell : called after each picture with how many are drawn, and of how many.
    moved : as of `draw_picture`.
    """
    stage = set_stage(run, log, walls, _at_tip(view, log, 0), instruments, sheath, moved and moved(0))
    chosen = np.unique(np.linspace(0, len(log.time) - 1, frames).astype(int))
    images = []
    for k in chosen:
        if (view.follows_tip or moved) and images:
            stage = set_stage(run, log, walls, _at_tip(view, log, k), instruments, sheath, moved and moved(k))
        images.append(_frame_at(stage, log, k, _FILM_SIZE))
        tell(len(images), len(chosen))
    return _of_few_colours(images)


def _of_few_colours(images: Sequence[Image.Image]) -> list[Image.Image]:
    """Return the same with one palette for all: what does not move stays the same, which makes a small file."""
    shown = images[:: max(1, len(images) // _LEARNT_FROM)]
    sample = Image.new("RGB", (images[0].width, len(shown) * images[0].height))
    for k, image in enumerate(shown):
        sample.paste(image, (0, k * image.height))
    palette = sample.quantize(_FILM_COLOURS, method=Image.Quantize.MAXCOVERAGE)
    return [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]


def _frame_at(stage: Stage, log: PositionLog, k: int, size: tuple[int, int]) -> Image.Image:
    return frame(stage, [(_path(log, k), None)], [_caption(log, k, stage)], [_catheters_at(log, k)], k, size)


def save_images(images: Sequence[Image.Image], path: Path) -> None:
    """Write one picture, or pictures as a GIF that begins anew at its end."""
    if path.suffix == ".gif":
        images[0].save(path, save_all=True, append_images=list(images[1:]), duration=80, loop=0, optimize=True)
    else:
        images[0].save(path, optimize=True)


def nearest(log: PositionLog, time: float) -> int:
    """Return the log's entry that is nearest to a moment of the run."""
    slack = 1e-9 + (float(np.diff(log.time).max()) if len(log.time) > 1 else 0.0)
    if not log.time[0] - slack <= time <= log.time[-1] + slack:
        raise LogError(f"{log.source}: --times {time:g} is beyond the run, whose log goes from {log.time[0]:g} s to "
                       f"{log.time[-1]:g} s")
    return int(np.argmin(np.abs(log.time - time)))


def _at_tip(view: View, log: PositionLog, k: int) -> View:
    """Return a view of the tip at one entry of the log, where it is followed."""
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
    """Return the wire's radius in units: with gains what meets walls, with a material its own."""
    if "wireRadius" in run.parameters:
        return run.number("wireRadius") / run.number("metresPerUnit")
    return run.number("sphereRadius")


def _finite(log: PositionLog, k: int) -> np.ndarray:
    if not np.isfinite(log.positions[k]).all():
        raise LogError(f"{log.source}: step {log.steps[k]} has a position that is not finite; give --times before it")
    return log.positions[k]


def _path(log: PositionLog, k: int) -> np.ndarray:
    """Return points of the wire at one entry, the tips of catheters that it comes out of among them."""
    nodes = _finite(log, k)
    return through_tips(nodes, _catheters_at(log, k), lengths_of(log.positions))[0] if log.catheters else nodes


def _catheters_at(log: PositionLog, k: int) -> list[np.ndarray]:
    return [positions[k] for positions in log.catheters]


def _caption(log: PositionLog, k: int, stage: Stage) -> str:
    bend = "" if stage.instruments else f"   red: bent to a radius of {1.0 / stage.bend:.4g} units"
    return f"t = {log.time[k]:.4g} s   step {log.steps[k]}{bend}"


def _round_up(value: float) -> float:
    """Return the next number of the form 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if value <= step * power * (1.0 + 1e-12))
