"""Draws the shapes of a mechanism as SVG."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from autograder.mechanisms import shapes as of

# From a place in m to one on the picture, px, y down.
At = Callable[[of.Place], tuple[float, float]]


@dataclass(frozen=True)
class Look:
    """Colours, and how large what has no size of its own is drawn: 1 on a page of 480 px.

    steady: whether a line keeps its width where the picture that holds it is stretched.
    """

    body: str
    pale: str
    line: str
    edge: str
    back: str
    size: float = 1.0
    steady: bool = False

    @property
    def stroke(self) -> str:
        return f'fill="none" stroke="{self.line}" stroke-width="{2 * self.size:g}"{self.held}'

    @property
    def held(self) -> str:
        return ' vector-effect="non-scaling-stroke"' if self.steady else ""

    @property
    def edged(self) -> str:
        return f'stroke="{self.edge}" stroke-width="{2 * self.size:g}"'


PAPER = Look("#4472a8", "#c9d7e8", "#333333", "black", "white")


def drawn(shape: of.Shape, at: At, look: Look) -> str:
    """The shape as an SVG element, its joints apart."""
    return _DRAW[type(shape)](shape, at, look)


def hinges(shapes: list[of.Shape]) -> list[of.Place]:
    """Where joints are drawn, in front of the shapes."""
    return [s.start if isinstance(s, of.Link) else s.at
            for s in shapes if isinstance(s, of.Link | of.Cart)]  # fmt: skip


def joint(at: tuple[float, float], look: Look) -> str:
    x, y = at
    return (
        f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{6 * look.size:g}" fill="{look.back}" {look.edged}/>'
    )


def in_order(shapes: list[of.Shape]) -> list[of.Shape]:
    """What stands still lies behind."""
    return sorted(shapes, key=lambda shape: isinstance(shape, of.Link | of.Mass))


def path(points) -> str:
    return "M " + " L ".join(f"{x:.1f} {y:.1f}" for x, y in points)


def _link(shape, at: At, look: Look) -> str:
    line = path([at(shape.start), at(shape.end)])
    width = f'stroke-width="{8 * look.size:g}"{look.held}'
    return f'<path d="{line}" stroke="{look.body}" {width} stroke-linecap="round"/>'


def _mass(shape, at: At, look: Look) -> str:
    x, y = at(shape.at)
    size = f'r="{11 * look.size:g}"'
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" {size} fill="{look.body}" stroke="{look.edge}"/>'


def _cart(shape, at: At, look: Look) -> str:
    (x, y), s = at(shape.at), look.size
    wheels = "".join(
        f'<circle cx="{x + side:.1f}" cy="{y + 19 * s:.1f}" r="{6 * s:g}" fill="{look.back}" '
        f"{look.edged}/>"
        for side in (-18 * s, 18 * s)
    )
    box = f'<rect x="{x - 32 * s:.1f}" y="{y - 13 * s:.1f}" width="{64 * s:g}" height="{26 * s:g}"'
    return f'{box} rx="{3 * s:g}" fill="{look.pale}" {look.edged}/>{wheels}'


def _slide(shape, at: At, look: Look) -> str:
    (a, b), (x, y), s = at(shape.start), at(shape.at), look.size
    turn = math.degrees(math.atan2(y - b, x - a))
    return (
        f'<rect x="{x - 20 * s:.1f}" y="{y - 12 * s:.1f}" width="{40 * s:g}" height="{24 * s:g}" '
        f'rx="{3 * s:g}" fill="{look.pale}" {look.edged} '
        f'transform="rotate({turn:.1f} {x:.1f} {y:.1f})"/>'
    )


def _spring(shape, at: At, look: Look) -> str:
    start, end = np.array(at(shape.start)), np.array(at(shape.end))
    along = end - start
    across = np.array([-along[1], along[0]]) / max(np.hypot(*along), 1e-9) * 8 * look.size
    turns = [start + along * (k + 1.5) / 13 + across * (-1) ** k for k in range(11)]
    inner = [start, start + along / 13, *turns, start + along * 12 / 13, end]
    return f'<path d="{path(inner)}" {look.stroke} stroke-linejoin="round"/>'


def _ground(shape, at: At, look: Look) -> str:
    (x, y), s = at(shape.at), look.size
    side = -s if shape.above else s
    stand = path([(x, y), (x - 14 * s, y + side * 20), (x + 14 * s, y + side * 20), (x, y)])
    hatched = _hatched(x - 22 * s, x + 22 * s, y + side * 20, look, -1 if shape.above else 1)
    return f'<path d="{stand}" {look.stroke}/>{hatched}'


def _rail(shape, at: At, look: Look) -> str:
    left, height = at((shape.left, shape.height))
    right, _ = at((shape.right, shape.height))
    s = look.size
    return _hatched(left - 40 * s, right + 40 * s, height + 26 * s, look)


def _hatched(left: float, right: float, y: float, look: Look, side: int = 1) -> str:
    s = look.size
    lines = [path([(left, y), (right, y)])]
    lines += [
        path([(x, y), (x - 7 * s, y + side * 8 * s)])
        for x in np.arange(left + 7 * s, right + 1, 9 * s)
    ]
    return f'<path d="{" ".join(lines)}" {look.stroke}/>'


def _wall(shape, at: At, look: Look) -> str:
    (x, y), s = at(shape.at), look.size
    lines = [path([(x, y - 26 * s), (x, y + 26 * s)])]
    lines += [
        path([(x, v), (x - 8 * s, v + 7 * s)]) for v in np.arange(y - 26 * s, y + 20 * s, 9 * s)
    ]
    return f'<path d="{" ".join(lines)}" {look.stroke}/>'


_DRAW: dict[type, Callable[..., str]] = {
    of.Link: _link,
    of.Mass: _mass,
    of.Cart: _cart,
    of.Slide: _slide,
    of.Spring: _spring,
    of.Ground: _ground,
    of.Rail: _rail,
    of.Wall: _wall,
}
