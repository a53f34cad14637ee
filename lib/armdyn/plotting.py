"""Figures of arms and of the terms of their equation of motion; the only module with matplotlib.

Importing it sets the course's figure style in matplotlib.rcParams. No pyplot: a figure is an object
like any other, drawn when it is asked for, with nothing to close. A notebook shows one as a
`Picture`, which carries its description for those who do not see it.

Colours: M. Okabe, K. Ito (2008), Color Universal Design, told apart with any colour vision. Bars
also differ by hatch and carry their names, so that nothing rests on colour alone.
"""

import base64
import html
import io
import math
from dataclasses import dataclass
from functools import singledispatch

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc
from PIL import Image

from armdyn.models import Pendulum, Planar2R
from armdyn.parameters import state_vector

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

# The terms of the equation of motion: name in mathtext, colour, hatch.
TERMS = (
    (r"$M\ddot q$", OKABE_ITO["sky"], "//"),
    (r"$C\dot q$", OKABE_ITO["orange"], "\\\\"),
    (r"$g$", OKABE_ITO["green"], ".."),
    (r"$f$", OKABE_ITO["purple"], "xx"),
    (r"$u$", OKABE_ITO["yellow"], ""),
)

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

PIXELS_PER_INCH = 96
OVERSAMPLING = 1.5


@dataclass(frozen=True)
class Picture:
    """A figure with the text that stands for it; as a cell's last line it shows itself.

    `alt` says what the figure shows, for readers who do not see it: it becomes the image's
    alternative text in JupyterLab and in nbconvert's pages, and the plain text of the output.
    JupyterLab has no alternative text for image/png outputs, hence the HTML beside it.
    Raises ValueError where alt is empty.
    """

    figure: Figure
    alt: str

    def __post_init__(self):
        if not self.alt.strip():
            raise ValueError("alt: needs a sentence that says what the figure shows")

    def _repr_mimebundle_(self, include=None, exclude=None):
        png = base64.b64encode(_png(self.figure)).decode()
        inches = self.figure.get_size_inches()
        width, height = (round(PIXELS_PER_INCH * length) for length in inches)
        alt = html.escape(self.alt)
        image = f'<img src="data:image/png;base64,{png}" alt="{alt}" width="{width}">'
        data = {"text/html": image, "image/png": png, "text/plain": self.alt}
        return data, {"image/png": {"alt": self.alt, "width": width, "height": height}}


def figure(width: float = 7.0, height: float = 3.2, columns: int = 1) -> tuple[Figure, Axes]:
    """A figure in the course's style, and its axes (an array of axes where columns > 1); inches."""
    fig = Figure(figsize=(width, height))
    return fig, fig.subplots(1, columns)


def draw_arm(ax: Axes, model, q) -> None:
    """Draw an arm at q on `ax`: links, joints, centres of mass, each angle from its own zero.

    model: a Pendulum or a Planar2R. q: (n,), rad. The axes are in m, x to the right, y up, and the
    same size for every q, so that pictures can be compared. Raises TypeError for another model and
    ValueError for a q of another shape.
    """
    q = state_vector("q", q, model.n)
    if q.ndim != 1:
        raise ValueError(f"q: got shape {q.shape}; one arm at a time, ({model.n},)")
    pose = _pose(model, q)
    ax.plot(*pose.joints.T, "-", color="#777777", linewidth=7, solid_capstyle="round")
    names = ["$q$"] if model.n == 1 else [f"$q_{i + 1}$" for i in range(model.n)]
    for number, (joint, zero, angle) in enumerate(zip(pose.joints, pose.zeros, q, strict=False)):
        _draw_angle(ax, joint, zero, angle, pose.reach / 4, names[number])
    ax.plot(*pose.joints[: model.n].T, "o", color="black", markersize=9, markerfacecolor="white")
    ax.plot(*pose.centres.T, "o", color=OKABE_ITO["blue"], markersize=8)
    edge = 1.15 * pose.reach
    head, tail = (-0.9 * edge, 0.6 * edge), (-0.9 * edge, 0.95 * edge)
    ax.annotate("", head, tail, arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 2})
    ax.text(-0.82 * edge, 0.78 * edge, "gravity", fontsize=9)
    ax.plot(-0.9 * edge, -0.9 * edge, "o", color=OKABE_ITO["blue"], markersize=8)
    ax.text(-0.82 * edge, -0.9 * edge, "centre of mass", fontsize=9, va="center")
    ax.locator_params(nbins=5)
    ax.set(xlim=(-edge, edge), ylim=(-edge, edge), xlabel="x (m)", ylabel="y (m)")
    ax.set_aspect("equal")


def torque_terms(model, q, qd, qdd, limit: float | None = None) -> Figure:
    """The arm at q, and beside it each joint's M q̈, C q̇, g, f and their sum u as bars, in N·m.

    q (rad), qd (rad/s), qdd (rad/s²): (n,). limit: the bars' axes run from −limit to limit (N·m),
    for figures that are compared; a longer bar is cut, its number is not. Without it, bars fit.
    """
    values = terms(model, q, qd, qdd)
    limit = 1.25 * max(np.abs(values).max(), 1e-9) if limit is None else limit
    fig = Figure(figsize=(8, 3.8))
    arm, bars = fig.subfigures(1, 2, width_ratios=(1, 1.15))
    draw_arm(arm.subplots(), model, q)
    axes = bars.subplots(model.n, 1, sharex=True, squeeze=False)[:, 0]
    for joint, ax in enumerate(axes):
        _draw_bars(ax, values[:, joint], limit)
        ax.set_ylabel(f"joint {joint + 1} (N·m)" if model.n > 1 else "torque (N·m)")
    return fig


def terms(model, q, qd, qdd) -> np.ndarray:
    """M q̈, C q̇, g, f and u = their sum, as the rows of a (5, n) array, N·m."""
    qd, qdd = state_vector("qd", qd, model.n), state_vector("qdd", qdd, model.n)
    parts = [model.M(q) @ qdd, model.C(q, qd) @ qd, model.g_vec(q), model.f_vec(qd)]
    return np.stack([*parts, sum(parts)])


def _png(figure: Figure) -> bytes:
    """PNG with 64 colours: a third of the size, which counts in a notebook that is committed."""
    drawn, small = io.BytesIO(), io.BytesIO()
    figure.savefig(drawn, format="png", dpi=OVERSAMPLING * PIXELS_PER_INCH)
    with Image.open(drawn) as image:
        colours = image.convert("RGB").quantize(64, Image.Quantize.FASTOCTREE)
    colours.save(small, format="png", optimize=True)
    return small.getvalue()


@dataclass(frozen=True)
class _Pose:
    """Joints and tip (n + 1, 2) and centres of mass (n, 2), m; zeros of the angles, rad; reach, m."""

    joints: np.ndarray
    centres: np.ndarray
    zeros: np.ndarray
    reach: float


@singledispatch
def _pose(model, q) -> _Pose:
    raise TypeError(f"draw_arm: draws a Pendulum or a Planar2R, got {type(model).__name__}")


@_pose.register
def _(model: Pendulum, q) -> _Pose:
    centre = model.lc * _direction(q[0] - math.pi / 2)
    joints = np.stack([np.zeros(2), centre])
    return _Pose(joints, centre[np.newaxis], np.array([-math.pi / 2]), model.lc or 1.0)


@_pose.register
def _(model: Planar2R, q) -> _Pose:
    along1, along2 = _direction(q[0]), _direction(q[0] + q[1])
    elbow = model.l1 * along1
    joints = np.stack([np.zeros(2), elbow, elbow + model.l2 * along2])
    centres = np.stack([model.lc1 * along1, elbow + model.lc2 * along2])
    reach = max(model.l1 + model.l2, abs(model.lc1), model.l1 + abs(model.lc2))
    return _Pose(joints, centres, np.array([0.0, q[0]]), reach)


def _direction(angle: float) -> np.ndarray:
    return np.array([math.cos(angle), math.sin(angle)])


def _draw_angle(ax, joint, zero, angle, radius, name) -> None:
    """A dotted line where the angle is zero, and the arc from it to the link."""
    end = joint + 2 * radius * _direction(zero)
    ax.plot(*np.stack([joint, end]).T, linestyle=":", color="black", linewidth=1)
    start, stop = np.degrees(sorted((zero, zero + angle)))
    ax.add_patch(Arc(joint, 2 * radius, 2 * radius, theta1=start, theta2=stop, linewidth=1.2))
    ax.text(*(joint + 1.7 * radius * _direction(zero + angle / 2)), name, ha="center", va="center")


def _draw_bars(ax, values, limit) -> None:
    for place, (value, (_, colour, hatch)) in enumerate(zip(values, TERMS, strict=True)):
        ax.bar(place, value, 0.6, color=colour, hatch=hatch, edgecolor="black", linewidth=0.8)
        height = np.clip(value, -0.8 * limit, 0.8 * limit)
        gap, side = (0.03, "bottom") if value >= 0 else (-0.03, "top")
        # + 0.0 turns a rounded −0.0 into 0.0
        label = f"{round(value, 1) + 0.0:.1f}"
        ax.text(place, height + gap * limit, label, ha="center", va=side, fontsize=9)
    ax.axhline(0, color="black", linewidth=1)
    ax.set(ylim=(-limit, limit), xticks=range(len(TERMS)), xticklabels=[name for name, *_ in TERMS])
