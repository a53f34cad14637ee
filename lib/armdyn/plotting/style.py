"""The course's figure style: colours, dashes, fonts, axes of angles."""

import math

import matplotlib
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

STYLE = {
    "axes.axisbelow": True,
    "axes.grid": True,
    "axes.prop_cycle": matplotlib.cycler(
        color=[OKABE_ITO[name] for name in LINES], linestyle=DASHES
    ),
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
matplotlib.rcParams.update(STYLE)


def figure(width: float = 7.0, height: float = 3.2, columns: int = 1) -> tuple[Figure, Axes]:
    """A figure in the course's style, and its axes (an array of axes where columns > 1); inches."""
    fig = Figure(figsize=(width, height))
    return fig, fig.subplots(1, columns)


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
