"""Draws the potential energy over the two joint angles, with its equilibria."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from armdyn.equilibria import equilibria
from armdyn.manipulator import Manipulator
from armdyn.plotting.style import angle_ticks, figure

POINTS = 121
MARKS = {"minimum": "o", "saddle": "D", "maximum": "^"}


def energy_landscape(model: Manipulator, limits: tuple[float, float] = (-np.pi, np.pi)) -> Figure:
    """P over (q1, q2), J, from limits[0] to limits[1] (rad) both ways, and its equilibria.

    At a minimum of P the arm rests without torque and stays; it leaves a saddle or a maximum.
    model: with two joints. Raises ValueError for another number of joints, for limits that are not
    two increasing numbers, and as `equilibria` where the equilibria are not isolated.
    """
    if model.n != 2:
        raise ValueError(f"model: needs two joints, has {model.n}")
    low, high = limits
    if not low < high:
        raise ValueError(f"limits = {limits}: needs two increasing numbers, in rad")
    angles = np.linspace(low, high, POINTS)
    P = model.potential_energy(np.stack(np.meshgrid(angles, angles), axis=-1))
    fig, ax = figure(6.4, 4.6)
    filled = ax.contourf(angles, angles, P, levels=14, cmap="cividis")
    ax.contour(angles, angles, P, levels=filled.levels, colors="black", linewidths=0.3)
    fig.colorbar(filled, ax=ax, label="P (J)")
    found = equilibria(model)
    for kind, marker in MARKS.items():
        places = [
            place for point in found if point.kind == kind for place in point.between(low, high)
        ]
        style: dict[str, Any] = {
            "markersize": 11,
            "markerfacecolor": "white",
            "markeredgecolor": "black",
        }
        if places:
            ax.plot(
                *np.transpose(places),
                marker,
                label=f"equilibrium: {kind}",
                clip_on=False,
                zorder=5,
                **style,
            )
    ax.set(xlabel="$q_1$ (rad)", ylabel="$q_2$ (rad)", xlim=limits, ylim=limits)
    ax.set_aspect("equal")
    ax.grid(False)
    angle_ticks(ax.xaxis, limits)
    angle_ticks(ax.yaxis, limits)
    if ax.lines:
        fig.legend(loc="outside lower center", ncols=3, frameon=False)
    return fig
