"""`guidewire.py render --fluoroscopy`: X-ray pictures of a run's log, taken by the core."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from guidewire.commands.angiography import Angiography
from guidewire.logs.logs import LogError, PositionLog
from guidewire.logs.runs import PARAMETERS_NAME, Run
from guidewire.logs.walls import drawn_of
from guidewire.prepare import PreparationError
from guidewire.sessions.session import SessionError, session_of

_OWN = {"lao": 0.0, "cranial": 0.0, "field": None, "vessel": "roadmap", "pixels": 512, "noise": 0.03, "blur": 0.15}
_OTHERS = ("zoom", "view", "distance", "yaw", "pitch", "radius")  # of a drawn picture
_FOLLOWED = 80.0  # mm, side of a picture that follows the tip
_FILM_COLOURS = 48


def check(arguments: argparse.Namespace) -> None:
    """Whether options of drawn pictures and of X-ray pictures stand together. Raises PreparationError, one line."""
    if arguments.fluoroscopy:
        wrong = [name for name in _OTHERS if getattr(arguments, name) is not None]
        if len(arguments.times) > 1:
            raise PreparationError("--fluoroscopy shows one moment: give one of --times")
        if wrong:
            raise PreparationError(f"--{wrong[0]} is for drawn pictures: --fluoroscopy takes --lao, --cranial, --field")
    else:
        wrong = [name for name in (*_OWN, "inject") if getattr(arguments, name) is not None]
        wrong += [name for name in ("subtract", "road_map") if getattr(arguments, name)]
        if wrong:
            raise PreparationError(f"--{wrong[0].replace('_', '-')} is for X-ray pictures: add --fluoroscopy")


def draw(run: Run, log: PositionLog, arguments: argparse.Namespace, is_film: bool,
         tell: Callable[[int, int], None]) -> list[Image.Image]:
    """Pictures of a run: its last moment or one that was asked for, or a film.

    Parameters
    ----------
    run, log : the run and its positions, all spheres.
    arguments : of `render`.
    is_film : whether `arguments.frames` pictures are taken, evenly spaced in time.
    tell : called after each picture with how many there are, and of how many.

    Raises
    ------
    PreparationError : the run's parameters cannot be used any more, or a value is not allowed; one line.
    LogError : a position that is not finite, or a moment beyond the run.
    """
    view = {name: own if getattr(arguments, name) is None else getattr(arguments, name) for name, own in _OWN.items()}
    field = view.pop("field")
    chosen = _chosen(log, arguments, is_film)
    drawn = drawn_of(run, log)
    images = []
    try:
        with session_of(run.folder / PARAMETERS_NAME) as session:
            is_known = session.describe()["patient"] is not None
            angiography = Angiography(session, arguments)
            for k in chosen:
                if not np.isfinite(log.positions[k]).all():
                    raise LogError(f"{log.source}: step {log.steps[k]} has a position that is not finite")
                centre = log.positions[k][-1].tolist() if arguments.follow else arguments.target
                side = field or (_FOLLOWED if arguments.follow else None)
                grey = angiography.picture(drawn[k], float(log.time[k]),
                                           {"centre": centre, "field_of_view": side, "seed": int(log.steps[k]), **view})
                images.append(_with_caption(grey, view, log.time[k], is_known))
                tell(len(images), len(chosen))
    except SessionError as error:
        raise PreparationError(str(error).removeprefix("request: ")) from error
    return [image.quantize(_FILM_COLOURS) for image in images] if is_film else images


def _chosen(log: PositionLog, arguments: argparse.Namespace, is_film: bool) -> Sequence[int]:
    from guidewire.figures.render import nearest

    if is_film:
        return np.unique(np.linspace(0, len(log.time) - 1, arguments.frames).astype(int)).tolist()
    return [nearest(log, arguments.times[0])] if arguments.times else [len(log.time) - 1]


def _with_caption(grey: np.ndarray, view: dict[str, Any], time: float, is_known: bool) -> Image.Image:
    """Return the picture with the C-arm's angles, as on a screen of an angiography room, and the time; without the
    words for sides of a patient whose axes are unknown."""
    image = Image.fromarray(grey)
    pen = ImageDraw.Draw(image)
    angles = [f"{'LAO' if view['lao'] >= 0 else 'RAO'} {abs(view['lao']):.0f}",
              f"{'CRAN' if view['cranial'] >= 0 else 'CAUD'} {abs(view['cranial']):.0f}"] if is_known else [
                  f"turned by {view['lao']:.0f}", f"tilted by {view['cranial']:.0f}\naxes unknown"]
    text = "   ".join([*angles, f"t = {time:.4g} s"])
    pen.text((8, len(grey) - 20 - 14 * text.count("\n")), text, fill=20)
    return image
