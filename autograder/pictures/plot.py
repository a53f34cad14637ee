"""A plot as SVG: a few lines over one axis, with units, ticks, and labels at the lines."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

BLUE, VERMILION = "#0072B2", "#D55E00"  # Okabe and Ito's; both are seen on light and on dark
FONT = 'font-family="sans-serif" font-size="12"'
LEFT, RIGHT, TOP, BOTTOM = 58, 58, 14, 40
HALO = ' paint-order="stroke" stroke="var(--jp-layout-color0, #fff)" stroke-width="4"'
CLOSE = 13.0  # px from one label to the next, at least
HIGH = 1e12  # what a student's curve may reach, and a number in a picture


@dataclass(frozen=True)
class Axis:
    """What it shows, with its unit: "q1 (rad)". logarithmic: whether it shows powers of ten."""

    label: str
    logarithmic: bool = False


@dataclass(frozen=True)
class Line:
    """A line of a plot: x, y (k,). is_theirs: drawn in full, the right one dashed."""

    label: str
    x: np.ndarray
    y: np.ndarray
    is_theirs: bool = False


def plot(lines: Sequence[Line], x: Axis, y: Axis, width: float, height: float) -> str:
    """An SVG group of this size, px. Numbers that are not finite, or huge, are left out."""
    to_x = _scale([line.x for line in lines], x, LEFT, width - RIGHT)
    to_y = _scale([line.y for line in lines], y, height - BOTTOM, TOP)
    parts = [_axis_x(to_x, x, width, height), _axis_y(to_y, y, width, height)]
    ways = []
    for line in lines:
        points = np.column_stack([to_x.at(line.x), to_y.at(line.y)])
        points = points[np.all(np.isfinite(points), axis=1)]
        if not len(points):
            continue
        colour, dash = (VERMILION, "") if line.is_theirs else (BLUE, ' stroke-dasharray="7 4"')
        d = "M" + " ".join(f"{px:.1f},{py:.1f}" for px, py in points)
        parts.append(f'<path d="{d}" fill="none" stroke="{colour}" stroke-width="2.2"{dash}/>')
        ways.append((points, line.label, colour))
    return "".join(parts) + _labels(ways)


def document(body: str, width: float, height: float, alt: str) -> str:
    """A whole SVG. In a page it takes the colours of JupyterLab's theme; as an image, dark on white."""
    text = escape(alt)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" role="img"'
        f' aria-label="{text}" width="{width:g}" height="{height:g}"'
        ' style="color: var(--jp-ui-font-color1, #222); max-width: 100%; height: auto">'
        f'<rect width="{width:g}" height="{height:g}" fill="var(--jp-layout-color0, #fff)"/>{body}</svg>'
    )


def cursor(width: float, height: float) -> str:
    """A line that the player moves over a plot of this size, as time goes on."""
    span = width - RIGHT - LEFT
    return (
        f'<path data-cursor="{span:g}" d="M{LEFT},{TOP} V{height - BOTTOM:g}" stroke="currentColor"'
        ' stroke-opacity="0.7" display="none"/>'
    )


def nice_step(size: float, at_least: bool = False) -> float:
    """1, 2 or 5 times a power of ten: the largest up to the size, or the least from it on."""
    power = 10.0 ** math.floor(math.log10(size))
    if at_least:
        return next(s * power for s in (1, 2, 5, 10) if s * power >= size * (1 - 1e-9))
    return next(s * power for s in (5, 2, 1) if s * power <= size)


@dataclass(frozen=True)
class _Scale:
    low: float
    high: float
    start: float
    end: float
    logarithmic: bool

    def at(self, values) -> np.ndarray:
        with np.errstate(all="ignore"):
            numbers = np.log10(values) if self.logarithmic else np.asarray(values, dtype=float)
            share = (numbers - self.low) / (self.high - self.low)
        # What lies beyond the axis is no number, or too large to be drawn.
        share = np.where(np.abs(share - 0.5) < 1, share, np.nan)
        return self.start + share * (self.end - self.start)

    @property
    def ticks(self) -> list[tuple[float, str]]:
        """Values and what is written at them."""
        if self.logarithmic:
            powers = range(math.floor(self.low), math.ceil(self.high) + 1)
            marks = (1, 2, 5) if self.high - self.low < 2.5 else (1,)
            every = max(1, math.ceil(len(powers) / 6))
            values = [mark * 10.0**k for k in powers[::every] for mark in marks]
            return [
                (v, _power(v))
                for v in values
                if self.low - 1e-9 <= math.log10(v) <= self.high + 1e-9
            ]
        step = nice_step((self.high - self.low) / 5, at_least=True)
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [(k * step, f"{k * step:.6g}".replace("-", "−")) for k in range(first, last + 1)]


def _power(value: float) -> str:
    written = f"{value:g}" if value >= 0.01 else f"{value:.0e}"
    return written.replace("e-0", "e-").replace("-", "−")


def _scale(values: Sequence[np.ndarray], axis: Axis, start: float, end: float) -> _Scale:
    numbers = np.concatenate([np.ravel(v) for v in values])
    numbers = numbers[np.isfinite(numbers) & (np.abs(numbers) < HIGH)]
    if axis.logarithmic:
        numbers = np.log10(numbers[numbers > 0])
    low, high = (numbers.min(), numbers.max()) if numbers.size else (0.0, 1.0)
    if high - low < 1e-9 * max(abs(low), abs(high), 1e-9):
        low, high = low - 0.5, high + 0.5
    edge = 0.06 * (high - low) if start > end else 0.0  # above and below the lines
    return _Scale(float(low - edge), float(high + edge), start, end, axis.logarithmic)


def _text(x: float, y: float, text: str, anchor: str = "middle", more: str = "") -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="currentColor" {FONT}{more}>'
        f"{escape(text)}</text>"
    )


def _grid(x1: float, y1: float, x2: float, y2: float) -> str:
    return (
        f'<path d="M{x1:.1f},{y1:.1f} {x2:.1f},{y2:.1f}" stroke="currentColor"'
        ' stroke-opacity="0.18"/>'
    )


def _axis_x(scale: _Scale, axis: Axis, width: float, height: float) -> str:
    floor = height - BOTTOM
    parts = []
    for value, written in scale.ticks:
        x = float(scale.at(value))
        parts += [_grid(x, TOP, x, floor), _text(x, floor + 15, written)]
    parts.append(_text((LEFT + width - RIGHT) / 2, height - 8, axis.label))
    return "".join(parts)


def _axis_y(scale: _Scale, axis: Axis, width: float, height: float) -> str:
    parts = []
    for value, written in scale.ticks:
        y = float(scale.at(value))
        parts += [_grid(LEFT, y, width - RIGHT, y), _text(LEFT - 6, y + 4, written, "end")]
    middle = (TOP + height - BOTTOM) / 2
    parts.append(_text(13, middle, axis.label, more=f' transform="rotate(-90 13 {middle:.1f})"'))
    return "".join(parts)


def _labels(ways: list[tuple[np.ndarray, str, str]]) -> str:
    """Each at its line's end; where the ends meet, where the lines are furthest apart."""
    if len(ways) == 2 and abs(ways[0][0][-1, 1] - ways[1][0][-1, 1]) < CLOSE:
        (one, name, colour), (other, other_name, other_colour) = ways
        common = min(len(one), len(other))
        gaps = one[:common, 1] - other[:common, 1]
        k = int(np.argmax(np.abs(gaps)))
        if abs(gaps[k]) >= 2 * CLOSE:
            lower = bool(gaps[k] > 0)
            return _beside(one[k], name, colour, lower) + _beside(
                other[k], other_name, other_colour, not lower
            )
    parts, free = [], -math.inf
    for points, label, colour in sorted(ways, key=lambda way: way[0][-1, 1]):
        x, y = points[-1]
        at = max(float(y), free)
        free = at + CLOSE
        parts.append(_dot(x, y, colour) + _text(x + 6, at + 4, label, "start", HALO))
    return "".join(parts)


def _beside(point: np.ndarray, label: str, colour: str, is_lower: bool) -> str:
    """Between the two lines."""
    x, y = point
    anchor = "start" if x < 2 * LEFT else "middle"
    return _dot(x, y, colour) + _text(x, y + (-8 if is_lower else 17), label, anchor, HALO)


def _dot(x: float, y: float, colour: str) -> str:
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>'
