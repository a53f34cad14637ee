"""Draws two motions of one mechanism side by side: a still picture, and how its parts move."""

import math
from dataclasses import dataclass

import numpy as np

from autograder.mechanisms import shapes as of
from autograder.pictures.drawing import Look, drawn, hinges, in_order, joint
from autograder.pictures.motion import Comparison, Motion
from autograder.pictures.plot import (
    BLUE,
    FONT,
    VERMILION,
    Axis,
    Line,
    cursor,
    document,
    nice_step,
    plot,
)

WIDTH, TITLE, PANEL, PLOT = 560, 22, 240, 140
EDGE = 34  # px around what moves, for what has no size in m
# Their motion may reach so many times as far as the right one before it leaves the picture.
FURTHEST = 1.5
GLYPHS = 0.6
MOVES = ' data-moves=""'
THEME = "currentColor", "currentColor", "var(--jp-layout-color0, #fff)"
Placed = tuple[float, float, float, float]  # x, y (px), turn (°) and length (px) of a part


@dataclass(frozen=True)
class _Part:
    """A part as it is drawn at the origin, along x; and where it is at each frame, (frames, 4)."""

    svg: str
    places: np.ndarray

    def transform(self, frame: int) -> str:
        x, y, turn, stretch = self.places[frame]
        return f"translate({x:.1f} {y:.1f}) rotate({turn:.1f}) scale({stretch:.3f} 1)"

    @property
    def moves(self) -> bool:
        return bool(np.any(np.ptp(self.places, axis=0) > 0.05))


@dataclass(frozen=True)
class Picture:
    """svg: both at the end, and faintly at the start. motion: what the player moves, for JSON."""

    svg: str
    motion: dict


def picture(both: Comparison, alt: str) -> Picture:
    """The two beside each other, and below them the coordinates over time."""
    window = _window(both)
    panels, moved = [], []
    for k, (motion, colour, title) in enumerate(
        ((both.right, BLUE, "right equations"), (both.theirs, VERMILION, f"with your {both.name}"))
    ):
        parts = _parts(both, motion, Look(colour, "none", *THEME, GLYPHS, steady=True), window)
        traces = _trace(both, both.right, window, BLUE, ' stroke-dasharray="5 4"')
        if k:
            traces += _trace(both, motion, window, VERMILION)
        panels.append(_panel(k, title, colour, traces, parts, window))
        moved.append([_steps(part) for part in parts if part.moves])
    plots = _plots(both)
    rows = math.ceil(len(plots) / 2)
    height = TITLE + PANEL + rows * PLOT
    body = "".join(panels) + "".join(
        f'<g transform="translate({_left(k, len(plots))} {TITLE + PANEL + k // 2 * PLOT})">{p}</g>'
        for k, p in enumerate(plots)
    )
    step = float(both.right.t[1] - both.right.t[0])
    return Picture(
        document(body, WIDTH, height, alt),
        {"step": step, "frames": len(both.right.t), "panels": moved},
    )


@dataclass(frozen=True)
class _Window:
    """From m to px in a panel."""

    middle: np.ndarray
    scale: float

    def at(self, place) -> tuple[float, float]:
        x, y = (np.array(place, dtype=float) - self.middle) * self.scale
        return WIDTH / 4 + float(x), PANEL / 2 - float(y)


def _shapes(both: Comparison, x: np.ndarray) -> list[of.Shape]:
    return both.mechanism.shapes(x[: both.mechanism.n], both.arm)


def _window(both: Comparison) -> _Window:
    right, theirs = (
        np.array([p for x in m.x for s in _shapes(both, x) for p in of.places(s)], dtype=float)
        for m in (both.right, both.theirs)
    )
    low, high = right.min(axis=0), right.max(axis=0)
    middle, size = (low + high) / 2, max(np.max(high - low), 0.1)
    near = np.clip(theirs, middle - FURTHEST * size, middle + FURTHEST * size)
    low, high = np.minimum(low, near.min(axis=0)), np.maximum(high, near.max(axis=0))
    room = np.array([WIDTH / 2, PANEL]) - 2 * EDGE
    return _Window((low + high) / 2, float(np.min(room / np.maximum(high - low, 0.1))))


def _parts(both: Comparison, motion: Motion, look: Look, window: _Window) -> list[_Part]:
    frames = [in_order(_shapes(both, x)) for x in motion.x]
    found = []
    for same in zip(*frames, strict=False):
        places = np.array([_placed(shape, window) for shape in same])
        length = places[0, 3]
        svg = drawn(
            _at_origin(same[0], length, window), lambda p: (float(p[0]), -float(p[1])), look
        )
        places[:, 2] = np.degrees(np.unwrap(np.radians(places[:, 2])))
        places[:, 3] = places[:, 3] / length if length > 1e-6 else 1.0
        found.append(_Part(svg, places))
    for same_hinge in zip(*map(hinges, frames), strict=False):
        places = np.array([(*window.at(place), 0.0, 1.0) for place in same_hinge])
        found.append(_Part(joint((0.0, 0.0), look), places))
    return found


def _placed(shape: of.Shape, window: _Window) -> Placed:
    match shape:
        case of.Link(start, end) | of.Spring(start, end):
            (x, y), (a, b) = window.at(start), window.at(end)
            return x, y, math.degrees(math.atan2(b - y, a - x)), math.hypot(a - x, b - y)
        case of.Slide(start, at):
            (a, b), (x, y) = window.at(start), window.at(at)
            return x, y, math.degrees(math.atan2(y - b, x - a)), 1.0
        case of.Rail(left, right, height):
            return *window.at((left, height)), 0.0, window.scale * (right - left)
    return *window.at(shape.at), 0.0, 1.0


def _at_origin(shape: of.Shape, length: float, window: _Window) -> of.Shape:
    """The same kind, at the origin, along x; lengths in px."""
    origin = (0.0, 0.0)
    match shape:
        case of.Link() | of.Spring():
            return type(shape)(origin, (length, 0.0))
        case of.Slide():
            return of.Slide((-1.0, 0.0), origin)
        case of.Rail():
            return of.Rail(0.0, length)
        case of.Ground(_, above):
            return of.Ground(origin, above)
    return type(shape)(origin)


def _trace(both: Comparison, motion: Motion, window: _Window, colour: str, dash: str = "") -> str:
    d = "M" + " ".join("{:.1f},{:.1f}".format(*window.at(tip)) for tip in both.tips(motion))
    return f'<path d="{d}" fill="none" stroke="{colour}" stroke-width="1.4"{dash}/>'


def _panel(
    k: int, title: str, colour: str, traces: str, parts: list[_Part], window: _Window
) -> str:
    """A panel is an SVG of its own, so that what leaves it is cut off."""
    faint = "".join(
        f'<g transform="{part.transform(0)}">{part.svg}</g>' for part in parts if part.moves
    )
    now = "".join(
        f'<g transform="{part.transform(-1)}"{MOVES if part.moves else ""}>{part.svg}</g>'
        for part in parts
    )
    inside = f'<g opacity="0.22">{faint}</g>{traces}{now}{"" if k else _scale_bar(window)}'
    half = WIDTH / 2
    return (
        f'<circle cx="{k * half + 14:g}" cy="12" r="5" fill="{colour}"/>'
        f'<text x="{k * half + 25:g}" y="16" fill="currentColor" font-weight="bold" {FONT}>'
        f"{title}</text>"
        f'<svg x="{k * half:g}" y="{TITLE}" width="{half - 6:g}" height="{PANEL}"'
        f' viewBox="0 0 {half - 6:g} {PANEL}" data-panel="{k}" role="none">'
        f'<rect width="100%" height="100%" fill="none" stroke="currentColor" stroke-opacity="0.25"/>'
        f"{inside}</svg>"
    )


def _scale_bar(window: _Window) -> str:
    length = nice_step(90 / window.scale)
    end = 12 + length * window.scale
    return (
        f'<path d="M12,{PANEL - 16} v6 H{end:.1f} v-6" fill="none" stroke="currentColor"/>'
        f'<text x="16" y="{PANEL - 14}" fill="currentColor" {FONT}>{length:g} m</text>'
    )


def _steps(part: _Part) -> list[float | list[float]]:
    """x, y, turn and stretch, each frame by frame, or one number where it stays; to what is seen."""
    columns: list[float | list[float]] = []
    for k, column in enumerate(part.places.T):
        values = [round(float(value), 3 if k == 3 else 1) for value in column]
        columns.append(values if np.ptp(values) else values[0])
    return columns


def _plots(both: Comparison) -> list[str]:
    coordinates = both.mechanism.coordinates
    width = WIDTH if len(coordinates) == 1 else WIDTH / 2
    found = []
    for i, c in enumerate(coordinates):
        lines = [
            Line("right", both.right.t, both.right.x[:, i]),
            Line("yours", both.theirs.t, both.theirs.x[:, i], is_theirs=True),
        ]
        y = Axis(f"{c.name} ({c.unit})")
        found.append(plot(lines, Axis("time (s)"), y, width, PLOT) + cursor(width, PLOT))
    return found


def _left(k: int, count: int) -> float:
    return 0 if count == 1 else k % 2 * WIDTH / 2
