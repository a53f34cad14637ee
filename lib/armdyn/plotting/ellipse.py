"""Draws the inertia matrix as an ellipse: the joint velocities with the same kinetic energy."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from armdyn.manipulator import Manipulator
from armdyn.parameters import positive, state_vector
from armdyn.plotting.arm import draw_links, plane
from armdyn.plotting.pose import pose, skeleton
from armdyn.plotting.style import DASHES, LINES, OKABE_ITO, figure

POINTS = 181


def draw_inertia_ellipse(ax: Axes, M: np.ndarray, energy: float = 1.0, **line) -> np.ndarray:
    """Draw the velocities with ½ q̇ᵀ M q̇ = energy (J) on `ax`: (q̇1, q̇2), rad/s; M: (2, 2), kg·m².

    The half-axes, which are drawn thin, are √(2·energy/λ) along the eigenvectors of M: they are
    long where little inertia resists. line: keywords of `Axes.plot`. Returns the curve, (P, 2).
    Raises ValueError for an M that is not (2, 2), not symmetric or not positive definite: the curve
    is then no ellipse.
    """
    M = state_vector("M", M, 2)
    energy = positive("energy", energy, "J")
    if M.shape != (2, 2) or not np.allclose(M, M.T, rtol=1e-10, atol=0):
        raise ValueError(f"M = {M}: needs a symmetric (2, 2) array")
    inertias, axes = np.linalg.eigh(M)
    if inertias[0] <= 0:
        raise ValueError(f"M = {M}: needs positive eigenvalues, got {inertias[0]:.3g} kg·m²")
    ends = axes * np.sqrt(2 * energy / inertias)
    turn = np.linspace(0, 2 * np.pi, POINTS)
    curve = np.stack([np.cos(turn), np.sin(turn)], axis=-1) @ ends.T
    (drawn,) = ax.plot(*curve.T, **line)
    for end in ends.T:
        ax.plot(*np.stack([-end, end]).T, "-", color=drawn.get_color(), linewidth=0.8)
    ax.set(xlabel=r"$\dot q_1$ (rad/s)", ylabel=r"$\dot q_2$ (rad/s)")
    ax.set_aspect("equal", adjustable="datalim")
    return curve


def inertia_ellipses(model: Manipulator, qs: ArrayLike, energy: float = 1.0) -> Figure:
    """An arm in several postures, and beside it the velocities of one kinetic energy in each.

    model: with two joints. qs: (k, 2), rad, k up to 5. energy in J. Raises ValueError for another
    number of joints or postures, and where M is singular.
    """
    qs = state_vector("qs", qs, 2)
    if model.n != 2:
        raise ValueError(f"model: needs two joints, has {model.n}")
    if qs.ndim != 2 or not 1 <= len(qs) <= len(LINES):
        raise ValueError(f"qs: got shape {qs.shape}, needs (k, 2) with k from 1 to {len(LINES)}")
    fig, (arm, ellipses) = figure(8, 3.8, columns=2)
    stands = pose(model, qs)
    for k, q in enumerate(qs):
        color = OKABE_ITO[LINES[k]]
        draw_links(arm, stands.joints[k], color, width=4)
        arm.plot(*stands.joints[k].T, "o", color=color, markersize=6, markerfacecolor="white")
        label = rf"$q_2$ = {np.degrees(q[1]) + 0.0:.0f}°"
        style = {"color": color, "linestyle": DASHES[k], "label": label}
        draw_inertia_ellipse(ellipses, model.M(q), energy, **style)
    plane(arm, 1.15 * skeleton(model).reach)
    ellipses.set_title(rf"$\frac{{1}}{{2}}\,\dot q^T M \dot q$ = {energy:g} J")
    ellipses.legend(fontsize=9, loc="upper right")
    return fig
