"""Draws the phase plane: angle against velocity."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from armdyn.equilibria import equilibria
from armdyn.manipulator import Manipulator
from armdyn.parameters import positive, state_vector
from armdyn.plotting.style import angle_ticks, figure

POINTS = 41


def phase_portrait(
    model: Manipulator,
    states: Iterable[np.ndarray] = (),
    q_limits: tuple[float, float] = (-np.pi, np.pi),
    qd_limit: float | None = None,
) -> Figure:
    """How each state (q, q̇) of a free one-joint arm moves on, with its equilibria and given runs.

    model: with one joint. states: runs, each (T, 2), [q; q̇] over time in rad and rad/s, as
    `simulate` gives them; drawn from a hollow circle to a square. q_limits in rad; q̇ from −qd_limit
    to qd_limit, rad/s: without it, a third more than the velocity with which a swing from the top
    passes the bottom. Raises ValueError for another number of joints, states of another shape and
    limits that do not increase, and as `equilibria` for an arm without gravity.
    """
    if model.n != 1:
        raise ValueError(f"model: needs one joint, has {model.n}; see draw_phase for the others")
    low, high = q_limits
    if not low < high:
        raise ValueError(f"q_limits = {q_limits}: needs two increasing numbers, in rad")
    if qd_limit is None:
        turn = np.linspace(-np.pi, np.pi, POINTS)[:, np.newaxis]
        height = np.ptp(model.potential_energy(turn))
        qd_limit = 4 / 3 * np.sqrt(2 * height / model.M([0.0])[0, 0]) or 1.0
    top = positive("qd_limit", qd_limit, "rad/s")
    q, qd = np.linspace(low, high, POINTS), np.linspace(-top, top, POINTS)
    rates = model.state_derivative(np.stack(np.meshgrid(q, qd), axis=-1), [0.0])
    fig, ax = figure(6.4, 4.0)
    ax.streamplot(
        q, qd, rates[..., 0], rates[..., 1], color="#999999", linewidth=0.8, arrowsize=0.9
    )
    for x in states:
        draw_phase(ax, model, x)
    for point in equilibria(model):
        full = "black" if point.kind == "minimum" else "white"
        places = point.between(low, high)[:, 0]
        style: dict[str, Any] = {"markerfacecolor": full, "markeredgecolor": "black"}
        style |= {"clip_on": False, "zorder": 5}
        ax.plot(
            places, 0 * places, "D", markersize=8, label=f"equilibrium: {point.kind} of P", **style
        )
    ax.set(xlim=q_limits, ylim=(-top, top))
    _name_axes(ax, "q", r"\dot q")
    angle_ticks(ax.xaxis, q_limits)
    if ax.get_legend_handles_labels()[0]:
        fig.legend(loc="outside lower center", ncols=2, frameon=False)
    return fig


def draw_phase(ax: Axes, model: Manipulator, x: ArrayLike, joint: int = 0, **line) -> None:
    """Draw one joint's angle against its velocity on `ax`, from a hollow circle to a square.

    x: states over time, (T, 2n), rad and rad/s. joint counts from 0. line: keywords of `Axes.plot`.
    For n > 1 this is a projection: its curve may cross itself. Raises ValueError for an x of
    another shape and for a joint that the model does not have.
    """
    x = state_vector("x", x, 2 * model.n)
    if x.ndim != 2 or len(x) == 0:
        raise ValueError(f"x: got shape {x.shape}, needs states over time, (T, {2 * model.n})")
    if joint not in range(model.n):
        raise ValueError(f"joint = {joint!r}: needs a whole number from 0 to {model.n - 1}")
    q, qd = x[:, joint], x[:, model.n + joint]
    (drawn,) = ax.plot(q, qd, **line)
    ends: dict[str, Any] = {"color": drawn.get_color(), "markersize": 7}
    ax.plot(q[0], qd[0], "o", markerfacecolor="white", **ends)
    ax.plot(q[-1], qd[-1], "s", **ends)
    number = f"_{joint + 1}" if model.n > 1 else ""
    _name_axes(ax, f"q{number}", rf"\dot q{number}")


def _name_axes(ax, q, qd) -> None:
    ax.set(xlabel=f"${q}$ (rad)", ylabel=f"${qd}$ (rad/s)")
