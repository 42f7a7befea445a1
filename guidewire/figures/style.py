"""The common style of all figures: style file, panel letters, and the caption drawn under the panels."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import ParamSpec, TypeVar

import matplotlib.style
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties

STYLE = Path(__file__).resolve().parent / "guidewire.mplstyle"
CAPTION_ID = "caption"  # gid of the caption's text in the figure

_CAPTION_SIZE = 8.5  # points
_LINE_SPACING = 1.35
_MARGIN = 0.15  # inches around the caption
_SURELY = 0.95  # of a line's width: up to there its words by themselves say that they fit

MOST_WORDS = 60  # of a caption inside a picture
_SENTENCE = re.compile(r"(?<=[.?!]) (?=[^a-z])")    # where one ends and the next begins

P = ParamSpec("P")
R = TypeVar("R")


def styled(function: Callable[P, R]) -> Callable[P, R]:
    """Runs a function that draws or saves under the shared style, and leaves matplotlib's settings as they were."""

    @wraps(function)
    def inner(*args: P.args, **kwargs: P.kwargs) -> R:
        with matplotlib.style.context(str(STYLE)):
            return function(*args, **kwargs)

    return inner


class _StyledFigure(Figure):
    """A figure that is saved under the style it was drawn in: ticks made only then ask for it again."""

    @styled
    def savefig(self, *args, **kwargs) -> None:
        super().savefig(*args, **kwargs)


def new_figure(width: float, height: float) -> Figure:
    """Return a figure with room for panels of the given size in inches; a caption makes it taller."""
    figure = _StyledFigure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def letter(axes: Axes, name: str, title: str) -> None:
    """Titles a panel "(a) title"."""
    axes.set_title(f"({name}) {title}")


def add_caption(figure: Figure, caption: str) -> None:
    """Writes the caption under the panels, over the figure's width, and makes the figure taller by its height."""
    width, height = figure.get_size_inches()
    font = FontProperties(size=_CAPTION_SIZE)
    lines = _wrap(figure, caption, font, (width - 2 * _MARGIN) * figure.dpi)
    text_height = len(lines) * _CAPTION_SIZE * _LINE_SPACING / 72.0
    below = text_height + 2 * _MARGIN
    figure.set_size_inches(width, height + below)
    fraction = below / (height + below)
    figure.get_layout_engine().set(rect=(0.0, fraction, 1.0, 1.0 - fraction))
    figure.text(
        _MARGIN / width,
        (below - _MARGIN) / (height + below),
        "\n".join(lines),
        fontproperties=font,
        linespacing=_LINE_SPACING,
        va="top",
        ha="left",
        gid=CAPTION_ID,
        parse_math=False,
    )


def captioned(figure: Figure, caption: str) -> tuple[Figure, str]:
    """Return a figure with the caption's opening under it, and the whole caption, which stands below the picture in an
    index."""
    add_caption(figure, opening(caption))
    return figure, caption


def opening(caption: str) -> str:
    """Return the first whole sentences of a caption, of MOST_WORDS words at most."""
    sentences = _SENTENCE.split(caption)
    count = len(sentences)
    while count > 1 and len(" ".join(sentences[:count]).split()) > MOST_WORDS:
        count -= 1
    return " ".join(sentences[:count])


def _wrap(figure: Figure, text: str, font: FontProperties, width: float) -> list[str]:
    """Breaks a text between words so that no line is wider than ``width`` pixels; "n = 60" stays together."""
    renderer = figure.canvas.get_renderer()

    def measured(part: str) -> float:
        return renderer.get_text_width_height_descent(part, font, False)[0]

    lines: list[str] = []
    sum_of_words = 0.0
    space = measured("a a") - measured("aa")
    for word in text.replace(" = ", "\u00a0=\u00a0").split(" "):
        longer = f"{lines[-1]} {word}" if lines else word
        sum_of_words += space + measured(word)
        fits = sum_of_words < _SURELY * width or (sum_of_words * _SURELY < width and measured(longer) <= width)
        if lines and fits:
            lines[-1] = longer
        else:
            lines.append(word)
            sum_of_words = measured(word)
    return lines
