"""Shows a verdict in a notebook as a card; whatever the colour says, the text says too."""

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape

from autograder.judging.passages import Passage, filled
from autograder.judging.percent import percent
from autograder.judging.verdict import State, Verdict, plain

# Mark and colour (Okabe and Ito's palette, safe for colour-blind readers).
LOOKS = {
    State.CORRECT: ("✓", "#009E73"),
    State.PARTLY_CORRECT: ("◐", "#E69F00"),
    State.INCORRECT: ("✗", "#D55E00"),
    State.ERROR: ("!", "#CC79A7"),
    State.NOT_ATTEMPTED: ("○", "#888888"),
    State.CHECK_FAILED: ("?", "#0072B2"),
    State.NOT_HERE: ("→", "#56B4E9"),
}
PARAGRAPH = "margin: 0.3em 0"
# Python may break anywhere, so that a long array needs no bar to scroll with.
CODE = (
    "font-size: 0.9em; background: none; padding: 0; white-space: pre-wrap; overflow-wrap: anywhere"
)
BLOCK = (
    "margin: 0.2em 0 0.4em; padding: 0 0 0 1em; border: 0; background: none; white-space: pre-wrap"
)
NOT_MET = LOOKS[State.INCORRECT][1]
LINKS = ("#0072B2", "#56B4E9")  # in turn, so that a folded arm shows both


@dataclass(frozen=True)
class Line:
    """A line at the end of a card: as plain text, and as HTML where that can do more, such as a link.

    html: ours, with whatever it quotes escaped; "" for the text itself. inside: what of the text is
    Python, which does not run when it is broken.
    """

    text: str
    html: str = ""
    inside: str = ""

    @classmethod
    def with_code(cls, said: str, code: str) -> "Line":
        """said: a sentence with {} where the code stands."""
        return cls(
            said.format(code), said.format(f'<code style="{CODE}">{escape(code)}</code>'), code
        )


def html_card(verdict: Verdict, lines: Iterable[Line] = (), last: Iterable[Line] = ()) -> str:
    """The verdict as HTML, readable by a screen reader from top to bottom. lines: more to look at,
    before a change of an answer that gave numbers; last: what ends the card.

    The arm of the worst case stands beside the text, and below it where the notebook is narrow.
    """
    mark, colour = LOOKS[verdict.state]
    pose = verdict.witness.pose if verdict.witness else ()
    then = [f'<p style="{PARAGRAPH}">{line.html or escape(line.text)}</p>' for line in lines]
    step = [_passage(verdict.step)] if verdict.step.text else []
    parts = [
        *map(_passage, verdict.passages_above()),
        _rows(verdict) if verdict.rows else "",
        *(_passage(Passage("diagnosis", sentence)) for sentence in verdict.of_the_whole),
        *map(_passage, verdict.passages_below()),
        *([*then, *step] if verdict.step_is_last else [*step, *then]),
        *(f'<div style="{PARAGRAPH}">{line.html or escape(line.text)}</div>' for line in last),
    ]
    text = (
        f'<p style="margin: 0.2em 0"><strong><span aria-hidden="true">{mark} </span>'
        f"{escape(verdict.headline)}</strong></p>{''.join(parts)}"
    )
    return (
        f'<div class="armdyn-verdict" data-state="{verdict.state.name.lower().replace("_", "-")}"'
        f' role="group" aria-label="{escape(verdict.headline)}"'
        f' style="border-left: 5px solid {colour}; padding: 0.4em 0.9em; max-width: 46em">'
        f"{_beside(text, drawing(pose)) if pose else text}</div>"
    )


def mimebundle(
    verdict: Verdict, lines: Iterable[Line] = (), last: Iterable[Line] = ()
) -> dict[str, str]:
    """The card for a notebook's output, as plain text and as HTML; lines and last as in `html_card`."""
    lines, last = tuple(lines), tuple(last)
    below, end = ([filled(own.text, kept=own.inside) for own in some] for some in (lines, last))
    return {
        "text/plain": plain(verdict, below, end),
        "text/html": html_card(verdict, lines, last),
    }


def drawing(pose: tuple[tuple[float, float], ...], size: int = 110) -> str:
    """An arm as an SVG picture, with a text for those who cannot see it. A dashed line shows where
    each angle starts: at the x axis, or along the link before.

    pose: the arm's joints and its hand, (x, y) in m, from the base. size: the longer side, px.
    """
    points = [complex(*point) for point in pose]
    links = [b - a for a, b in itertools.pairwise(points)]
    reach = sum(map(abs, links)) or 1.0
    along = [1 + 0j, *(link / abs(link) if link else 1 + 0j for link in links)]
    zeros = [(at, at + 0.3 * reach * way) for at, way in zip(points[:-1], along, strict=False)]
    seen = [*points, *(end for _, end in zeros)]
    left, right = min(p.real for p in seen), max(p.real for p in seen)
    low, high = min(p.imag for p in seen), max(p.imag for p in seen)
    scale = size / max(right - left, high - low)
    edge = 10  # for the width of the strokes

    def at(point: complex) -> tuple[str, str]:
        return (
            f"{edge + scale * (point.real - left):.1f}",
            f"{edge + scale * (high - point.imag):.1f}",
        )

    def line(start: complex, end: complex, look: str) -> str:
        (x1, y1), (x2, y2) = at(start), at(end)
        return f'<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" {look}/>'

    def dot(point: complex, radius: float, look: str) -> str:
        x, y = at(point)
        return f'<circle cx="{x}" cy="{y}" r="{radius}" {look}/>'

    width, height = scale * (right - left) + 2 * edge, scale * (high - low) + 2 * edge
    parts = [line(*zero, 'stroke="#888888" stroke-dasharray="3 3"') for zero in zeros]
    for k, ends in enumerate(itertools.pairwise(points)):
        look = f'stroke="{LINKS[k % 2]}" stroke-width="5" stroke-linecap="round"'
        parts.append(line(*ends, look))
    x, y = at(points[0])
    parts.append(f'<path d="M{x} {y}l-6 9h12z" fill="#888888"/>')
    open_joint = 'fill="var(--jp-layout-color0, #fff)" stroke="currentColor"'
    parts += [dot(point, 3.5, open_joint) for point in points[:-1]]
    parts.append(dot(points[-1], 3.5, 'fill="currentColor"'))
    text = escape(f"The arm in the worst case: {_describe(links)}.")
    return (
        f'<svg role="img" aria-label="{text}" width="{width:.0f}" height="{height:.0f}"'
        f' viewBox="0 0 {width:.1f} {height:.1f}" style="flex: none"><title>{text}</title>'
        f"{''.join(parts)}</svg>"
    )


def _describe(links: list[complex]) -> str:
    """The links' directions in whole degrees, each from the link before."""
    said = [f"link 1 at {_degrees(links[0])} from the x axis"] if links else []
    for k, (before, link) in enumerate(itertools.pairwise(links), 2):
        said.append(f"link {k} at {_degrees(link * before.conjugate())} from link {k - 1}")
    return ", ".join(said)


def _degrees(direction: complex) -> str:
    # cmath.phase overflows on the smallest numbers.
    angle = math.degrees(math.atan2(direction.imag, direction.real))
    return f"{angle:.0f}°".replace("-", "−")


def _beside(text: str, picture: str) -> str:
    return (
        '<div style="display: flex; flex-wrap: wrap; align-items: center; gap: 0.5em 1.5em">'
        f'<div style="flex: 1; min-width: min(20em, 100%)">{text}</div>{picture}</div>'
    )


def _passage(passage: Passage) -> str:
    """A passage as a paragraph, and its code below it, or folded below it."""
    weight = "; font-weight: 600" if passage.kind == "diagnosis" else ""
    # Only a problem may quote a student. As a formula, the quote could be a link that runs code.
    kind = f"armdyn-{passage.kind}"
    kind += " tex2jax_ignore mathjax_ignore" if passage.kind == "problem" else ""
    said, inside = escape(passage.text), escape(passage.inside)
    if inside:
        said = said.replace(inside, f'<code style="{CODE}">{inside}</code>', 1)
    code = f'<pre style="{BLOCK}"><code style="{CODE}">{escape(passage.code)}</code></pre>'
    if passage.folded:
        summary = f'<summary style="cursor: pointer">{said}</summary>'
        return f'<details class="{kind}" style="{PARAGRAPH}">{summary}{code}</details>'
    below = code if passage.code else ""
    return f'<p class="{kind}" style="{PARAGRAPH}{weight}">{said}</p>{below}'


def _rows(verdict: Verdict) -> str:
    """The criteria, each with what is said of it. Those not met differ by word, by mark and by a bar.

    A single criterion has the whole credit, so its share says nothing.
    """
    items = []
    for row, said in verdict.said_of_rows():
        mark, bar = ("✓", "transparent") if row.met else ("✗", NOT_MET)
        sentences = "".join(_passage(Passage("diagnosis", sentence)) for sentence in said)
        share = f" ({percent(row.share)})" if len(verdict.rows) > 1 else ""
        items.append(
            f'<li style="border-left: 3px solid {bar}; padding-left: 0.6em; margin: 0.3em 0">'
            f'<span aria-hidden="true">{mark} </span>'
            f"<span>{'met' if row.met else 'not met'}: {escape(row.text)}{share}</span>"
            f"{sentences}</li>"
        )
    # Without its bullets, a list is none to some screen readers unless its role says so.
    look = "list-style: none; margin: 0.3em 0; padding: 0"
    return f'<ul role="list" style="{look}">{"".join(items)}</ul>'
