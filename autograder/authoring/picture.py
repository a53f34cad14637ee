"""Draws a mechanism in one position as an SVG, with the shapes that it is made of."""

from xml.sax.saxutils import escape

import numpy as np

from autograder.mechanisms import Mechanism
from autograder.mechanisms import shapes as of
from autograder.pictures.drawing import PAPER, drawn, hinges, in_order, joint

WIDTH, HEIGHT, MARGIN = 480, 320, 70


def picture(mechanism: Mechanism) -> str:
    """The SVG's text. A teacher draws angles and dimensions into it, or another in its place."""
    arm = mechanism.drawn(np.random.default_rng(3))
    q = np.array(
        [0.5 + 0.4 * i if c.unit == "rad" else 0.4 for i, c in enumerate(mechanism.coordinates)]
    )
    shapes = mechanism.shapes(q, arm)
    places = np.array([place for shape in shapes for place in of.places(shape)], dtype=float)
    low, high = places.min(axis=0), places.max(axis=0)
    room = np.array([WIDTH, HEIGHT - 20]) - 2 * MARGIN
    scale = np.min(room / np.maximum(high - low, 0.1))
    middle = (low + high) / 2

    def at(place):
        x, y = (np.array(place, dtype=float) - middle) * scale
        return WIDTH / 2 + x, HEIGHT / 2 - 10 - y

    bodies = "\n".join(f"  {drawn(shape, at, PAPER)}" for shape in in_order(shapes))
    joints = "\n".join(f"  {joint(at(place), PAPER)}" for place in hinges(shapes))
    title = escape(f"{mechanism.name} at {_position(mechanism, q)}")
    return f"""\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">
  <title>{title}</title>
  <rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>
{bodies}
{joints}
  <text x="12" y="{HEIGHT - 14}" font-family="sans-serif" font-size="14">{title}</text>
</svg>
"""


def _position(mechanism: Mechanism, q) -> str:
    return ", ".join(
        f"{c.name} = {value:g} {c.unit}" for c, value in zip(mechanism.coordinates, q, strict=True)
    )
