"""Pictures and a short film of a run, as the Unity scene shows it.

``python3 -m analysis.render RUN --out DIR``: the wire is drawn as a tube coloured by curvature; of the vessel only the
far wall is, so that one looks inside. No Unity takes part: the triangles come from the log and the vessel's file, the
pixels from analysis.raster.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from analysis.logs import LogError, PositionLog, read_log
from analysis.raster import Camera, Picture, draw
from analysis.runs import Run, read_run
from analysis.surfaces import SurfaceError, tube, wall

GREY, RED = np.array([0.82, 0.84, 0.88]), np.array([0.95, 0.1, 0.05])
VESSEL = np.array([0.72, 0.6, 0.58])
FULL_BEND = 0.01  # 1/unit
SIZE = (960, 600)
_OVERSAMPLING = 2


@dataclass(frozen=True)
class Stage:
    """What stays the same in all pictures of a run: its vessel, drawn once, and the camera.

    background : the far wall; radius : of the wire, units; bend : 1/unit, curvature shown as full red.
    """

    camera: Camera
    background: Picture
    radius: float
    bend: float


def bend_colours(values: np.ndarray, full: float) -> np.ndarray:
    """Grey to red, shape (v, 3), for curvatures (v,) in 1/unit; ``full`` is the curvature of full red."""
    share = np.clip(values / full, 0.0, 1.0)[:, None]
    return (1.0 - share) * GREY + share * RED


def set_stage(run: Run, log: PositionLog, camera: Camera | None) -> Stage:
    """Draw what does not move.

    Parameters
    ----------
    run : the run.
    log : its positions, all spheres.
    camera : where to look from; None looks at all that the wire passes from the side.
    """
    every = log.positions.reshape(-1, 3)
    every = every[np.isfinite(every).all(axis=1)]
    low, high = every.min(axis=0), every.max(axis=0)
    radius = run.number("sphereRadius")
    if camera is None:
        extent = float(np.linalg.norm(high - low)) + 4.0 * radius
        camera = Camera(tuple(0.5 * (low + high)), 1.05 * extent)
    background = Picture.blank(SIZE[0] * _OVERSAMPLING, SIZE[1] * _OVERSAMPLING)
    surface = wall(run.parameters, log.positions[-1, -1], 90.0)
    if surface is not None:
        draw(background, camera, surface, np.broadcast_to(VESSEL, surface.vertices.shape), 0.75)
    return Stage(camera, background, radius, FULL_BEND)


def frame(stage: Stage, positions: np.ndarray, caption: str) -> Image.Image:
    """One picture.

    Parameters
    ----------
    stage : what does not move.
    positions : ndarray (n+1, 3), units.
    caption : one line in the lower left corner.
    """
    picture = stage.background.copy()
    surface = tube(positions, stage.radius)
    draw(picture, stage.camera, surface, bend_colours(surface.values, stage.bend))
    pixels = Image.fromarray((255.0 * np.clip(picture.colour, 0.0, 1.0) + 0.5).astype(np.uint8))
    pixels = pixels.resize(SIZE, Image.LANCZOS)
    ImageDraw.Draw(pixels).text((12, SIZE[1] - 22), caption, fill=(225, 225, 230))
    return pixels


def render(folder: Path, out: Path, frames: int, camera: Camera | None = None) -> list[Path]:
    """Draw a run's last state into NAME.png and, with more than one frame, its course into NAME.gif.

    Parameters
    ----------
    folder : the run.
    out : folder of the pictures.
    frames : pictures of the film, evenly spaced in time; 1 makes none.
    camera : where to look from.

    Raises
    ------
    LogError, SurfaceError
        The run cannot be read, or its vessel not drawn.
    """
    run = read_run(folder)
    log = read_log(folder, "all")
    stage = set_stage(run, log, camera)
    out.mkdir(parents=True, exist_ok=True)
    name = folder.resolve().name

    def caption(k: int) -> str:
        bend = f"red: curvature of 1/{1.0 / stage.bend:.0f} units and more"
        return f"t = {log.time[k]:.2f} s   step {log.steps[k]}   {bend}"

    written = [out / f"{name}.png"]
    frame(stage, log.positions[-1], caption(-1)).save(written[0], optimize=True)
    if frames > 1:
        chosen = np.unique(np.linspace(0, len(log.time) - 1, frames).astype(int))
        images = [frame(stage, log.positions[k], caption(k)).resize((640, 400), Image.LANCZOS)
                  .quantize(64) for k in chosen]
        written.append(out / f"{name}.gif")
        images[0].save(written[1], save_all=True, append_images=images[1:], duration=80, loop=0, optimize=True)
    return written


def main(arguments: list[str] | None = None) -> int:
    """The command line of the module."""
    parser = argparse.ArgumentParser(prog="analysis.render",
                                     description="Pictures of a run, as the Unity scene shows it.")
    parser.add_argument("run", type=Path, help="folder of a run")
    parser.add_argument("--out", type=Path, default=Path("results/pictures"), help="folder of the pictures")
    parser.add_argument("--frames", type=int, default=40, help="pictures of the film; 1 makes none (40)")
    parser.add_argument("--target", type=float, nargs=3, metavar=("X", "Y", "Z"), help="point in the middle, units")
    parser.add_argument("--distance", type=float, help="of the camera from it, units")
    options = parser.parse_args(arguments)
    camera = Camera(tuple(options.target), options.distance) if options.target and options.distance else None
    try:
        for path in render(options.run, options.out, options.frames, camera):
            print(path)
    except (LogError, SurfaceError) as error:
        print(f"guidewire: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
