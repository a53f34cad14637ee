"""What a mechanism is drawn with: links, carts, slides, springs, masses and what does not move.

Positions are (x, y) in m; how large a cart or a mass is drawn is the picture's affair.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

Place = tuple[float, float]


@dataclass(frozen=True)
class Link:
    """A rigid link with a joint at `start`."""

    start: Place
    end: Place


@dataclass(frozen=True)
class Spring:
    """A spring between two places."""

    start: Place
    end: Place


@dataclass(frozen=True)
class Slide:
    """A sleeve at `at` that slides along the line from `start` through it."""

    start: Place
    at: Place


@dataclass(frozen=True)
class Cart:
    """A cart on wheels whose hinge is at `at`."""

    at: Place


@dataclass(frozen=True)
class Mass:
    """A body drawn as a disc."""

    at: Place


@dataclass(frozen=True)
class Ground:
    """What does not move, below a joint at `at`, or above it."""

    at: Place
    above: bool = False


@dataclass(frozen=True)
class Rail:
    """A level rail under a cart or slider, from x = `left` to `right`, whose hinge runs at `height`."""

    left: float
    right: float
    height: float = 0.0


@dataclass(frozen=True)
class Wall:
    """An upright wall at `at`, to which a spring is fixed."""

    at: Place


Shape = Link | Spring | Slide | Cart | Mass | Ground | Rail | Wall
SHAPES = (Link, Spring, Slide, Cart, Mass, Ground, Rail, Wall)


def places(shape: Shape) -> list[Place]:
    """The places that a picture has to hold."""
    if isinstance(shape, Rail):
        return [(shape.left, shape.height), (shape.right, shape.height)]
    return [shape.at] if isinstance(shape, Ground) else list(vars(shape).values())


def rod(start: Place, centre: Place, spread: float) -> tuple[Link, Mass]:
    """A body that turns about `start`: the uniform rod with its inertia, and its centre of mass.

    spread: √(I/m), I about the centre of mass, as a share of the distance from start to centre. A point
    mass (0) ends the rod. One of length L ends L/2 beyond its centre, and I/m = L²/12.
    """
    longer = 1 + math.sqrt(3) * spread
    x, y = longer * (centre[0] - start[0]), longer * (centre[1] - start[1])
    return Link(start, (start[0] + x, start[1] + y)), Mass(centre)


def arm(points: list[Place]) -> list[Shape]:
    """Links through the points, on the ground at the first, with a mass at the last."""
    links = [Link(a, b) for a, b in pairwise(points)]
    hangs = len(points) > 1 and points[1][1] < points[0][1]
    return [Ground(points[0], hangs), *links, Mass(points[-1])]
