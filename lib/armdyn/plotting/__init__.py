"""Figures of arms, of the terms of their equation of motion and of how they move.

This is the only part of armdyn that uses matplotlib. It leaves matplotlib's settings
(matplotlib.rcParams) alone: the course's style is in the figures that `figure` makes. It does not
use pyplot: a figure is an object like any other, it is drawn when you ask for it, and you need not
close it. A notebook shows a figure as a `Picture`, and a motion as an `Animation`; both carry a
description for those who do not see them.

The colours are those of M. Okabe, K. Ito (2008), Color Universal Design, which people can tell
apart whatever their colour vision; maps of a quantity use cividis, whose lightness rises evenly.
Lines also differ by dashes, bars by hatch and points by shape, so that nothing depends on colour
alone.
"""

from armdyn.plotting.animation import Animation
from armdyn.plotting.arm import draw_arm, draw_trace, tip
from armdyn.plotting.block_diagram import draw_block_diagram
from armdyn.plotting.ellipse import draw_inertia_ellipse, inertia_ellipses
from armdyn.plotting.landscape import energy_landscape
from armdyn.plotting.live import Live, live
from armdyn.plotting.phase import draw_phase, phase_portrait
from armdyn.plotting.picture import OVERSAMPLING, PIXELS_PER_INCH, Picture
from armdyn.plotting.style import DASHES, LINES, OKABE_ITO, STYLE, figure
from armdyn.plotting.torques import TERMS, draw_torque_terms, terms, torque_axes, torque_terms

__all__ = [
    "DASHES",
    "LINES",
    "OKABE_ITO",
    "OVERSAMPLING",
    "PIXELS_PER_INCH",
    "STYLE",
    "TERMS",
    "Animation",
    "Live",
    "Picture",
    "draw_arm",
    "draw_block_diagram",
    "draw_inertia_ellipse",
    "draw_phase",
    "draw_torque_terms",
    "draw_trace",
    "energy_landscape",
    "figure",
    "inertia_ellipses",
    "live",
    "phase_portrait",
    "terms",
    "tip",
    "torque_axes",
    "torque_terms",
]
