"""Shows a student's own arm below a set-up cell: its table and its picture."""

import cmath
import math
from html import escape

from autograder.problems.material.conventions import BOOK, Convention

UNITS = {"l": "m", "m": "kg", "I": "kg·m²", "g": "m/s²", "v": "N·m·s/rad", "c": "N·m"}
BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#888888"
# Directions of the links in the picture, at which every angle of every member is positive.
SHOWN = (math.radians(40), math.radians(165))
SCALE, WIDTH, HEIGHT = 130.0, 400, 300
SHOULDER = complex(190, 200)


def mimebundle(own: Convention, whose: str, arm: object, code: str) -> dict[str, str]:
    """The arm for a notebook's output: plain text, and HTML with a picture.

    whose: "the arm of s1234". arm: its parameters, or None. code: the functions that are given.
    """
    title = f"This is {whose}" + (
        ": the one that the table above describes." if own == BOOK else "."
    )
    rows = [
        ("q1 = 0", f"{own.zero_at[0]}; q1 grows counter-clockwise"),
        ("q2 = 0", f"{own.zero_at[1]}; q2 grows counter-clockwise"),
        ("gravity", f"{own.facts[2].removeprefix('gravity ')}"),
        *([("parameters", _numbers(arm))] if arm is not None else []),
    ]
    note = (
        ""
        if own == BOOK
        else "What is said here of the angles and of gravity counts, not what is said above."
    )
    text = "\n".join(
        [title, *(f"  {name:11} {value}" for name, value in rows), *filter(None, [note])]
    )
    cells = "".join(
        f'<tr><th style="text-align: left; vertical-align: top; padding-right: 0.8em">'
        f"{escape(name)}</th>"
        f'<td style="text-align: left">{escape(value)}</td></tr>'
        for name, value in rows
    )
    given = f"<p>These functions are given:</p><pre>{escape(code)}</pre>" if code else ""
    html = (
        f'<div class="armdyn-arm" role="group" aria-label="{escape(title)}"'
        f' style="border-left: 5px solid {BLUE}; padding: 0.4em 0.9em; max-width: 46em">'
        f"<p><strong>{escape(title)}</strong> {escape(note)}</p>"
        f"{picture(own) if own != BOOK else ''}<table>{cells}</table>{given}</div>"
    )
    return {"text/plain": text + (f"\n\n{code}" if code else ""), "text/html": html}


def _numbers(arm: object) -> str:
    return ", ".join(
        f"{name} = {_shown(value)} {UNITS[name[0] if not name.startswith('coul') else 'c']}"
        if not name.startswith("lc")
        else f"{name} = {_shown(value)} m"
        for name, value in vars(arm).items()
    )


def _shown(value) -> str:
    return f"{value:g}" if isinstance(value, int | float) else str(value)


def picture(own: Convention) -> str:
    """The arm as an SVG: both links, a dashed line where each angle is 0, and the pull of gravity."""
    first, second = (cmath.rect(SCALE, -angle) for angle in SHOWN)  # y grows downwards in an SVG
    elbow = SHOULDER + first
    hand = elbow + 0.85 * second
    zeros = own.zeros
    start = SHOWN[0] if own.turns[1, 0] else 0.0  # from where q2 = 0 is counted
    from_2 = start + (zeros[1] - zeros[0] if own.turns[1, 0] else zeros[1])
    parts = [
        _arrow(SHOULDER, SHOULDER + 80, GREY) + _text(SHOULDER + 92, "x", GREY),
        _arrow(SHOULDER, SHOULDER - 80j, GREY) + _text(SHOULDER - 90j, "y", GREY),
        f'<path d="M{_at(SHOULDER)}l-10 16h20z" fill="#dddddd" stroke="{GREY}"/>',
        *(
            _line(at, at + cmath.rect(95, -angle), f'stroke="{GREY}" stroke-dasharray="5 4"')
            for at, angle in ((SHOULDER, zeros[0]), (elbow, from_2))
        ),
        _line(SHOULDER, elbow, f'stroke="{BLUE}" stroke-width="9" stroke-linecap="round"'),
        _line(elbow, hand, 'stroke="#56B4E9" stroke-width="9" stroke-linecap="round"'),
        *(
            f'<circle cx="{at.real:.1f}" cy="{at.imag:.1f}" r="5" fill="{ORANGE}"/>'
            for at in ((SHOULDER + elbow) / 2, (elbow + hand) / 2)
        ),
        *(
            f'<circle cx="{at.real:.1f}" cy="{at.imag:.1f}" r="5" fill="#ffffff" stroke="#222222"/>'
            for at in (SHOULDER, elbow)
        ),
        _arc(SHOULDER, zeros[0], SHOWN[0], "q1"),
        _arc(elbow, from_2, SHOWN[1], "q2"),
        _arrow(45 + 40j, 45 + 40j + cmath.rect(60, -own.pull), ORANGE),
        _text(30 + 60j, "g", ORANGE),
    ]
    said = (
        f"A planar arm with two links. q1 is 0 where {own.zero_at[0]}, q2 where {own.zero_at[1]}; "
        f"{own.facts[2]}."
    )
    return (
        f'<svg role="img" aria-label="{escape(said)}" viewBox="0 0 {WIDTH} {HEIGHT}"'
        f' width="{WIDTH}" height="{HEIGHT}" style="max-width: 100%; height: auto; background: #ffffff"'
        f' font-family="serif" font-size="16"><title>{escape(said)}</title>{"".join(parts)}</svg>'
    )


def _at(point: complex) -> str:
    return f"{point.real:.1f} {point.imag:.1f}"


def _line(start: complex, end: complex, look: str) -> str:
    return f'<path d="M{_at(start)}L{_at(end)}" fill="none" {look}/>'


def _arrow(start: complex, end: complex, colour: str) -> str:
    back = (start - end) / abs(end - start) * 9
    barbs = (end + back * cmath.rect(1, turn) for turn in (0.4, -0.4))
    head = "L".join(map(_at, (end, *barbs)))
    shaft = _line(start, end, f'stroke="{colour}" stroke-width="2"')
    return f'{shaft}<path d="M{head}z" fill="{colour}"/>'


def _text(at: complex, text: str, colour: str) -> str:
    return (
        f'<text x="{at.real:.1f}" y="{at.imag + 5:.1f}" text-anchor="middle" fill="{colour}"'
        f' font-style="italic">{text}</text>'
    )


def _arc(centre: complex, start: float, end: float, name: str) -> str:
    """Counter-clockwise from one angle to another, with an arrowhead and the angle's name."""
    radius = 42.0
    a, b = (centre + cmath.rect(radius, -angle) for angle in (start, end))
    large = int(end - start > math.pi)
    along = cmath.rect(8, -(end + math.pi / 2 - 0.15))
    head = "L".join(map(_at, (b, *(b - along * cmath.rect(1, turn) for turn in (0.45, -0.45)))))
    middle = centre + cmath.rect(radius + 16, -(start + end) / 2)
    return (
        f'<path d="M{_at(a)}A{radius} {radius} 0 {large} 0 {_at(b)}" fill="none"'
        f' stroke="#222222" stroke-width="1.5"/><path d="M{head}z" fill="#222222"/>'
        f"{_text(middle, name, '#222222')}"
    )
