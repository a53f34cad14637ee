"""Draws the pictures of a control: once what stays, and each time what moves."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import update_wrapper
from inspect import signature
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from armdyn.plotting.picture import (
    OVERSAMPLING,
    PIXELS_PER_INCH,
    check_alt,
    image_tag,
    picture_bundle,
    quick_png,
    size_in_pixels,
)
from armdyn.plotting.strokes import strokes_of
from armdyn.plotting.style import STYLE, in_style


def live(figure: Figure) -> Callable[[Callable[..., str]], "Live"]:
    """A decorator: of a function that draws on the figure it makes one that gives a picture, fast.

    The function gets the figure and what it is called with, draws on the figure's axes, and returns
    the picture's alternative text. What is on the figure before (axes, limits, labels, curves) stays.
    What the function adds is taken off after each picture, so it draws as if for the first time;
    titles are its own. Of the axes only limits, labels and scales are looked at again: set ticks
    before. A call raises TypeError where the function returns no text, ValueError where it is empty.
    """
    return lambda function: Live(figure, function)


@dataclass(frozen=True)
class Shot:
    """One picture of a control; as a cell's last line it shows itself, as a `Picture` does."""

    png: str
    alt: str
    size: tuple[int, int]

    def _repr_mimebundle_(self, include=None, exclude=None):
        tag = image_tag(self.png, self.alt, *self.size)
        return picture_bundle(self.png, self.alt, self.size, tag)


class Live:
    """What `live` makes: called as the function itself, it gives a picture."""

    def __init__(self, figure: Figure, function: Callable[..., str]):
        update_wrapper(self, function)
        figure_first = signature(function)
        given = list(figure_first.parameters.values())[1:]
        self.__signature__ = figure_first.replace(parameters=given, return_annotation=Shot)
        self.figure = figure
        self._function = function
        self._stays = {id(artist) for artist in _artists(figure)}
        self.background_changed = False  # at the last call, of those after the first
        self._axes_drawn: Any = None
        self._background: Any = None

    def __call__(self, *args, **values) -> Shot:
        with self._moving(args, values) as (alt, moving):
            canvas = self.figure.canvas
            canvas.restore_region(self._background)  # type: ignore[attr-defined]
            for artist in moving:
                artist.draw(canvas.get_renderer())  # type: ignore[attr-defined]
            pixels = _pixels(canvas)
        return Shot(quick_png(pixels), alt, size_in_pixels(self.figure))

    def strokes(self, *args, **values) -> tuple[list[str], str]:
        """The picture without what stays, as SVG, an entry an artist; and the alternative text."""
        with self._moving(args, values) as (alt, moving):
            return [strokes_of(artist, self.figure) for artist in moving], alt

    def background(self) -> Image.Image:
        """What stays, as it was at the last picture. Raises ValueError before the first."""
        if self._background is None:
            raise ValueError("no picture yet: call the function first")
        self.figure.canvas.restore_region(self._background)  # type: ignore[attr-defined]
        return _pixels(self.figure.canvas)

    @contextmanager
    def _moving(self, args, values) -> Iterator[tuple[str, list[Artist]]]:
        """The alternative text and what the function draws, from below to above."""
        with in_style():
            try:
                for ax in self.figure.axes:
                    ax.set_prop_cycle(STYLE["axes.prop_cycle"])
                    for side in ("left", "center", "right"):
                        ax.set_title("", loc=side)
                alt = self._function(self.figure, *args, **values)
                if not isinstance(alt, str):
                    raise TypeError(
                        f"{self._function.__name__} returned {type(alt).__name__}: needs the "
                        "sentence that says what the picture shows"
                    )
                check_alt(alt)
                moving = sorted(self._added() + _titles(self.figure), key=Artist.get_zorder)
                self._draw_what_stays(moving)
                yield alt, moving
            finally:
                for artist in self._added():
                    artist.remove()

    def _added(self) -> list[Artist]:
        return [a for a in _artists(self.figure) if id(a) not in self._stays]

    def _draw_what_stays(self, moving: list[Artist]) -> None:
        """Lays the figure out and keeps its pixels, where the axes are not as they were."""
        axes = [_limits_and_labels(ax) for ax in self.figure.axes]
        self.background_changed = self._axes_drawn not in (None, axes)
        if axes == self._axes_drawn:
            for ax in self.figure.axes:
                ax.apply_aspect()
            return
        self._axes_drawn = axes
        self.figure.set_dpi(OVERSAMPLING * PIXELS_PER_INCH)
        canvas = FigureCanvasAgg(self.figure)
        self.figure.set_layout_engine("constrained")
        self.figure.draw_without_rendering()
        self.figure.set_layout_engine("none")  # a long title later on moves nothing
        for artist in moving:
            artist.set_animated(True)
        canvas.draw()
        for artist in moving:
            artist.set_animated(False)
        self._background = canvas.copy_from_bbox(self.figure.bbox)


def _pixels(canvas: Any) -> Image.Image:
    return Image.fromarray(np.asarray(canvas.buffer_rgba())[..., :3])


def _artists(figure: Any) -> list[Artist]:
    """What stands on a figure, its parts and its axes, but not these themselves."""
    parts = [figure, *figure.subfigs]
    holders = [*parts, *figure.axes]
    return [a for holder in holders for a in holder.get_children() if a not in holders]


def _titles(figure: Figure) -> list[Artist]:
    return [ax.title for ax in figure.axes]


def _limits_and_labels(ax: Axes) -> list[tuple]:
    limits = (ax.get_xlim(), ax.get_ylim())
    both = zip(limits, (ax.xaxis, ax.yaxis), strict=True)
    return [(limit, axis.get_label_text(), axis.get_scale()) for limit, axis in both]
