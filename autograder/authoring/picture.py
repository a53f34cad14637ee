"""Draws a mechanism in one position as an SVG, with the shapes that it is made of."""

import math
from xml.sax.saxutils import escape

import numpy as np

from autograder.mechanisms import Mechanism
from autograder.mechanisms import shapes as of

WIDTH, HEIGHT, MARGIN = 480, 320, 70
BLUE, DARK = "#4472a8", "#333333"
LINE = f'fill="none" stroke="{DARK}" stroke-width="2"'


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

    # What stands still lies behind, and joints lie in front.
    order = sorted(shapes, key=lambda shape: isinstance(shape, of.Link | of.Mass))
    drawn = "\n".join(f"  {_DRAW[type(shape)](shape, at)}" for shape in order)
    hinges = [s.start if isinstance(s, of.Link) else s.at
              for s in shapes if isinstance(s, of.Link | of.Cart)]  # fmt: skip
    joints = "\n".join(f"  {_joint(at(place))}" for place in hinges)
    title = escape(f"{mechanism.name} at {_position(mechanism, q)}")
    return f"""\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img">
  <title>{title}</title>
  <rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>
{drawn}
{joints}
  <text x="12" y="{HEIGHT - 14}" font-family="sans-serif" font-size="14">{title}</text>
</svg>
"""


def _position(mechanism: Mechanism, q) -> str:
    return ", ".join(
        f"{c.name} = {value:g} {c.unit}" for c, value in zip(mechanism.coordinates, q, strict=True)
    )


def _path(points) -> str:
    return "M " + " L ".join(f"{x:.1f} {y:.1f}" for x, y in points)


def _joint(at) -> str:
    x, y = at
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="6" fill="white" stroke="black" stroke-width="2"/>'


def _link(shape, at) -> str:
    path = _path([at(shape.start), at(shape.end)])
    return f'<path d="{path}" stroke="{BLUE}" stroke-width="8" stroke-linecap="round"/>'


def _mass(shape, at) -> str:
    x, y = at(shape.at)
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="11" fill="{BLUE}" stroke="black"/>'


def _cart(shape, at) -> str:
    x, y = at(shape.at)
    wheels = "".join(
        f'<circle cx="{x + side:.1f}" cy="{y + 19:.1f}" r="6" fill="white" stroke="black" '
        'stroke-width="2"/>'
        for side in (-18, 18)
    )
    box = f'<rect x="{x - 32:.1f}" y="{y - 13:.1f}" width="64" height="26" rx="3"'
    return f'{box} fill="#c9d7e8" stroke="black" stroke-width="2"/>{wheels}'


def _slide(shape, at) -> str:
    (a, b), (x, y) = at(shape.start), at(shape.at)
    turn = math.degrees(math.atan2(y - b, x - a))
    return (
        f'<rect x="{x - 20:.1f}" y="{y - 12:.1f}" width="40" height="24" rx="3" fill="#c9d7e8" '
        f'stroke="black" stroke-width="2" transform="rotate({turn:.1f} {x:.1f} {y:.1f})"/>'
    )


def _spring(shape, at) -> str:
    start, end = np.array(at(shape.start)), np.array(at(shape.end))
    along = end - start
    across = np.array([-along[1], along[0]]) / max(np.hypot(*along), 1e-9) * 8
    turns = [start + along * (k + 1.5) / 13 + across * (-1) ** k for k in range(11)]
    inner = [start, start + along / 13, *turns, start + along * 12 / 13, end]
    return f'<path d="{_path(inner)}" {LINE} stroke-linejoin="round"/>'


def _ground(shape, at) -> str:
    x, y = at(shape.at)
    side = -1 if shape.above else 1
    stand = _path([(x, y), (x - 14, y + side * 20), (x + 14, y + side * 20), (x, y)])
    return f'<path d="{stand}" {LINE}/>{_hatched(x - 22, x + 22, y + side * 20, side)}'


def _rail(shape, at) -> str:
    left, height = at((shape.left, shape.height))
    right, _ = at((shape.right, shape.height))
    return _hatched(left - 40, right + 40, height + 26)


def _hatched(left: float, right: float, y: float, side: int = 1) -> str:
    lines = [_path([(left, y), (right, y)])]
    lines += [_path([(x, y), (x - 7, y + side * 8)]) for x in np.arange(left + 7, right + 1, 9)]
    return f'<path d="{" ".join(lines)}" {LINE}/>'


def _wall(shape, at) -> str:
    x, y = at(shape.at)
    lines = [_path([(x, y - 26), (x, y + 26)])]
    lines += [_path([(x, v), (x - 8, v + 7)]) for v in np.arange(y - 26, y + 20, 9)]
    return f'<path d="{" ".join(lines)}" {LINE}/>'


_DRAW = {
    of.Link: _link,
    of.Mass: _mass,
    of.Cart: _cart,
    of.Slide: _slide,
    of.Spring: _spring,
    of.Ground: _ground,
    of.Rail: _rail,
    of.Wall: _wall,
}
