"""Draws the terms of the equation of motion as bars."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator
from armdyn.parameters import state_vector
from armdyn.plotting.arm import draw_arm
from armdyn.plotting.style import OKABE_ITO, StyledFigure, styled

# The terms of the equation of motion: name in mathtext, colour, hatch.
TERMS = (
    (r"$M\ddot q$", OKABE_ITO["sky"], "//"),
    (r"$C\dot q$", OKABE_ITO["orange"], "\\\\"),
    (r"$g$", OKABE_ITO["green"], ".."),
    (r"$f$", OKABE_ITO["purple"], "xx"),
    (r"$u$", OKABE_ITO["yellow"], ""),
)


@styled
def torque_terms(
    model: Manipulator, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, limit: float | None = None
) -> Figure:
    """The arm at q, and beside it each joint's M q̈, C q̇, g, f and their sum u as bars, in N·m.

    q (rad), qd (rad/s), qdd (rad/s²): (n,). limit: the bars' axes run from −limit to limit (N·m),
    so that figures can be compared; a longer bar is cut, but its number is not. Without it, the
    axes fit the bars.
    """
    values = terms(model, q, qd, qdd)
    limit = 1.25 * max(np.abs(values).max(), 1e-9) if limit is None else limit
    fig = torque_axes(model.n, limit)
    draw_torque_terms(fig, model, q, qd, qdd)
    return fig


@styled
def torque_axes(joints: int, limit: float) -> Figure:
    """A figure for `draw_torque_terms`: axes for an arm, and for the torques of each of its joints.

    limit: the axes of the torques run from −limit to limit, N·m.
    """
    fig = StyledFigure(figsize=(8, 3.8))
    parts: Any = fig.subfigures(1, 2, width_ratios=(1, 1.15))
    arm, bars = parts
    arm.subplots()
    axes = bars.subplots(joints, 1, sharex=True, squeeze=False)[:, 0]
    for joint, ax in enumerate(axes):
        ax.axhline(0, color="black", linewidth=1)
        names = [name for name, *_ in TERMS]
        ax.set(ylim=(-limit, limit), xticks=range(len(TERMS)), xticklabels=names)
        ax.set(xlim=(-0.6, len(TERMS) - 0.4))
        ax.set_ylabel(f"joint {joint + 1} (N·m)" if joints > 1 else "torque (N·m)")
    return fig


@styled
def draw_torque_terms(
    figure: Figure, model: Manipulator, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike
) -> None:
    """Draw the arm at q, and M q̈, C q̇, g, f and u as bars, on a figure of `torque_axes`.

    q (rad), qd (rad/s), qdd (rad/s²): (n,).
    """
    arm, *bars = figure.axes
    draw_arm(arm, model, q)
    for ax, values in zip(bars, terms(model, q, qd, qdd).T, strict=True):
        _draw_bars(ax, values)


def terms(model: Manipulator, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> np.ndarray:
    """M q̈, C q̇, g, f and u = their sum, as the rows of a (5, n) array, N·m."""
    qd, qdd = state_vector("qd", qd, model.n), state_vector("qdd", qdd, model.n)
    parts = [model.M(q) @ qdd, model.C(q, qd) @ qd, model.g_vec(q), model.f_vec(qd)]
    return np.stack([*parts, sum(parts)])


def _draw_bars(ax, values) -> None:
    limit = ax.get_ylim()[1]
    for place, (value, (_, colour, hatch)) in enumerate(zip(values, TERMS, strict=True)):
        ax.bar(place, value, 0.6, color=colour, hatch=hatch, edgecolor="black", linewidth=0.8)
        height = np.clip(value, -0.8 * limit, 0.8 * limit)
        gap, side = (0.03, "bottom") if value >= 0 else (-0.03, "top")
        # + 0.0 turns a rounded −0.0 into 0.0
        label = f"{round(value, 1) + 0.0:.1f}"
        ax.text(place, height + gap * limit, label, ha="center", va=side, fontsize=9)
