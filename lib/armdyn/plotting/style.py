"""The course's figure style: colours, dashes, fonts, axes of angles."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any

import matplotlib
from cycler import cycler
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MultipleLocator

OKABE_ITO = {
    "black": "#000000",
    "orange": "#E69F00",
    "sky": "#56B4E9",
    "green": "#009E73",
    "yellow": "#F0E442",
    "blue": "#0072B2",
    "vermilion": "#D55E00",
    "purple": "#CC79A7",
}

LINES = ("blue", "vermilion", "green", "purple", "black")
DASHES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)))

# Another style may be in force, which an import can set: roboticstoolbox sets ggplot.
LOOKS = (
    *("axes.", "figure.edgecolor", "figure.subplot.", "font.", "grid.", "image.cmap", "legend."),
    *("lines.", "mathtext.", "patch.", "text.", "xtick.", "ytick."),
)
PLAIN = {
    name: value for name, value in matplotlib.rcParamsDefault.items() if name.startswith(LOOKS)
}

STYLE: Any = PLAIN | {
    "axes.axisbelow": True,
    "axes.grid": True,
    "axes.prop_cycle": cycler(color=[OKABE_ITO[name] for name in LINES], linestyle=DASHES),
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlesize": 11,
    "figure.constrained_layout.use": True,
    "figure.facecolor": "white",
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "grid.color": "#DDDDDD",
    "hatch.linewidth": 0.8,
    "lines.linewidth": 2,
}


def styled(method: Callable) -> Callable:
    """The method, run in the course's style; what matplotlib is set to elsewhere stays."""

    @wraps(method)
    def run(*args, **kwargs):
        with in_style():
            return method(*args, **kwargs)

    return run


@contextmanager
def in_style() -> Iterator[None]:
    """A block in the course's style; what matplotlib is set to elsewhere stays."""
    if _in_force:  # setting it again takes a third of a millisecond, at every curve and text
        yield
        return
    with matplotlib.rc_context(STYLE):
        _in_force.append(True)
        try:
            yield
        finally:
            _in_force.clear()


_in_force: list[bool] = []


class StyledAxes(Axes):
    """Axes that draw in the course's style, whatever matplotlib is set to."""


# matplotlib looks up widths, sizes and fonts when something is drawn on axes, not when they are made.
for _name in (
    *("annotate", "axhline", "axvline", "bar", "contour", "errorbar", "fill_between", "hlines"),
    *("legend", "plot", "set_title", "set_xlabel", "set_ylabel", "streamplot", "text", "vlines"),
):
    setattr(StyledAxes, _name, styled(getattr(Axes, _name)))


class StyledFigure(Figure):
    """A figure in the course's style, whatever matplotlib is set to."""

    __init__ = styled(Figure.__init__)
    colorbar = styled(Figure.colorbar)
    draw = styled(Figure.draw)  # ticks and their grid lines are made when they are drawn
    legend = styled(Figure.legend)
    subplots = styled(Figure.subplots)


def figure(width: float = 7.0, height: float = 3.2, columns: int = 1) -> tuple[Figure, Any]:
    """A figure in the course's style, and its axes (an array of axes where columns > 1); inches."""
    fig = StyledFigure(figsize=(width, height))
    return fig, fig.subplots(1, columns, subplot_kw={"axes_class": StyledAxes})


def angle_ticks(axis: Axis, limits: tuple[float, float]) -> None:
    """Ticks at multiples of π/2 for an axis in rad, so that right angles can be read off.

    Limits too close for two such ticks, or too far apart to tell them, keep plain numbers.
    """
    if not math.pi <= limits[1] - limits[0] <= 6 * math.pi:
        return
    axis.set_major_locator(MultipleLocator(math.pi / 2))
    axis.set_major_formatter(FuncFormatter(lambda value, _: _in_pi(round(value / math.pi * 2))))


def _in_pi(halves: int) -> str:
    if halves == 0:
        return "0"
    sign = "−" if halves < 0 else ""
    count, half = (abs(halves), "/2") if halves % 2 else (abs(halves) // 2, "")
    return f"{sign}{count if count > 1 else ''}π{half}"
