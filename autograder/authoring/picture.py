"""Draws a mechanism in one position as an SVG: its points, the lines between them, and the ground."""

from xml.sax.saxutils import escape

import numpy as np

from autograder.mechanisms import Mechanism

WIDTH, HEIGHT, MARGIN = 480, 320, 60


def picture(mechanism: Mechanism) -> str:
    """The SVG's text. A teacher draws angles and dimensions into it, or another in its place."""
    rng = np.random.default_rng(3)
    arm = mechanism.drawn(rng)
    q = np.array([0.5 if c.unit == "rad" else 0.4 for c in mechanism.coordinates])
    points = np.array([(float(x), float(y)) for x, y in mechanism.points(q, arm)])
    size = max(np.ptp(points[:, 0]), np.ptp(points[:, 1]), 0.1)
    scale = min(WIDTH, HEIGHT) - 2 * MARGIN
    at = (points - points.mean(axis=0)) / size * scale
    at = np.column_stack([WIDTH / 2 + at[:, 0], HEIGHT / 2 - at[:, 1]])
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
    circles = "\n".join(
        f'  <circle cx="{x:.1f}" cy="{y:.1f}" r="7" fill="white" stroke="black" stroke-width="2"/>'
        for x, y in at
    )
    title = escape(f"{mechanism.name} at {_position(mechanism, q)}")
    return f"""\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">
  <title>{title}</title>
  <rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>
  <polyline points="{path}" fill="none" stroke="#4472a8" stroke-width="8"
    stroke-linecap="round" stroke-linejoin="round"/>
{circles}
  <text x="12" y="{HEIGHT - 14}" font-family="sans-serif" font-size="14">{title}</text>
</svg>
"""


def _position(mechanism: Mechanism, q) -> str:
    return ", ".join(
        f"{c.name} = {value:g} {c.unit}" for c, value in zip(mechanism.coordinates, q, strict=True)
    )
