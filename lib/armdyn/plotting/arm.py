"""Draws an arm, and the path of its tip."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator
from armdyn.parameters import state_vector
from armdyn.plotting.pose import direction, pose, skeleton
from armdyn.plotting.style import OKABE_ITO

LINK = "#777777"


def draw_arm(ax: Axes, model: Manipulator, q: ArrayLike) -> None:
    """Draw an arm at q on `ax`: links, joints, centres of mass, each angle from its own zero.

    model: a Pendulum, a Planar2R or a PlanarChain. A Pendulum, which has no length, is drawn as the
    uniform rod with its m, ℓc and I. q: (n,), rad. The axes are in m, x to the right,
    y up, and the same size for every q, so that pictures can be compared. Raises TypeError for
    another model and ValueError for a q of another shape.
    """
    reach = skeleton(model).reach
    q = state_vector("q", q, model.n)
    if q.ndim != 1:
        raise ValueError(f"q: got shape {q.shape}; one arm at a time, ({model.n},)")
    stands = pose(model, q)
    draw_links(ax, stands.joints, LINK)
    names = ["$q$"] if model.n == 1 else [f"$q_{i + 1}$" for i in range(model.n)]
    for name, joint, zero, angle in zip(names, stands.joints[:-1], stands.zeros, q, strict=True):
        _draw_angle(ax, joint, zero, angle, reach / 4, name)
    ax.plot(*stands.joints[:-1].T, "o", color="black", markersize=9, markerfacecolor="white")
    ax.plot(*stands.centres.T, "o", color=OKABE_ITO["blue"], markersize=8)
    edge = 1.15 * reach
    head, tail = (-0.9 * edge, 0.6 * edge), (-0.9 * edge, 0.95 * edge)
    ax.annotate("", head, tail, arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 2})
    ax.text(-0.82 * edge, 0.78 * edge, "gravity", fontsize=9)
    ax.plot(-0.9 * edge, -0.9 * edge, "o", color=OKABE_ITO["blue"], markersize=8)
    ax.text(-0.82 * edge, -0.9 * edge, "centre of mass", fontsize=9, va="center")
    plane(ax, edge)


def draw_trace(
    ax: Axes, model: Manipulator, q: ArrayLike, color: str = OKABE_ITO["vermilion"]
) -> None:
    """Draw the path of the tip on `ax`, from a hollow circle to a square; q: (T, n), rad.

    A pendulum's tip is the end of the rod that `draw_arm` draws. Axes in m as there, over which the
    path can be drawn. Raises TypeError for a model that `draw_arm` does not draw, ValueError for a q of
    another shape.
    """
    path = tip(model, q)
    if path.ndim != 2 or len(path) == 0:
        raise ValueError(f"q: got shape {np.shape(q)}; needs angles over time, (T, {model.n})")
    ax.plot(*path.T, "-", color=color, linewidth=1.2)
    ax.plot(*path[0], "o", color=color, markersize=8, markerfacecolor="white")
    ax.plot(*path[-1], "s", color=color, markersize=7)
    plane(ax, 1.15 * skeleton(model).reach)


def tip(model: Manipulator, q: ArrayLike) -> np.ndarray:
    """x and y of the tip of the last link, (..., 2), m; q: (..., n), rad. Raises as `draw_arm`."""
    return pose(model, q).joints[..., -1, :]


def draw_links(ax: Axes, joints: np.ndarray, color: str, width: float = 7) -> None:
    """The links between joints, (n + 1, 2), m."""
    ax.plot(*joints.T, "-", color=color, linewidth=width, solid_capstyle="round")


def plane(ax: Axes, edge: float) -> None:
    """Axes of the plane of the arm, in m, from −edge to edge both ways."""
    ax.locator_params(nbins=5)
    ax.set(xlim=(-edge, edge), ylim=(-edge, edge), xlabel="x (m)", ylabel="y (m)")
    ax.set_aspect("equal")


def _draw_angle(ax, joint, zero, angle, radius, name) -> None:
    """A dotted line where the angle is zero, and the arc from it to the link."""
    end = joint + 2 * radius * direction(zero)
    ax.plot(*np.stack([joint, end]).T, linestyle=":", color="black", linewidth=1)
    start, stop = np.degrees(sorted((zero, zero + angle)))
    ax.add_patch(Arc(joint, 2 * radius, 2 * radius, theta1=start, theta2=stop, linewidth=1.2))
    ax.text(*(joint + 1.7 * radius * direction(zero + angle / 2)), name, ha="center", va="center")
