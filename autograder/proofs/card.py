"""Shows a judged derivation: its lines with their marks, what is still to be shown, what may be used."""

from html import escape

from autograder.proofs.derivation import Derivation
from autograder.proofs.marks import Marked, MarkedLine
from autograder.protocol import one_line

MOST_SHOWN = 160  # of a formula
# Okabe and Ito's palette, as on the cards of checks.
GREEN, RED, GREY = "#009E73", "#D55E00", "#888888"
CODE = (
    "font-size: 0.9em; background: none; padding: 0; white-space: normal; overflow-wrap: anywhere"
)


def text(marked: Marked, with_names: bool = True) -> str:
    """The card in plain text. with_names: whether it says what may be used, where there are no lines."""
    lines = [marked.headline]
    if marked.problem:
        lines.append(f"  {marked.problem}")
    for line in marked.lines:
        by = f"   ({_reasons(line)})" if line.reasons else ""
        lines.append(f"  {'✓' if line.holds else '✗'} {_formula(line)}{by}")
        lines += [f"      {line.said}"] if line.said else []
    lines += [f"  {marked.still}"] if marked.still else []
    lines += [f"  {said}" for said in earned(marked)]
    if with_names and not marked.lines:
        lines += ["", *(f"  {said}" for said in _given(marked.derivation))]
    return "\n".join(lines)


def earned(marked: Marked) -> list[str]:
    """A sentence for each row of the table of points that the lines earn."""
    return [
        f"Row {row.number} of the table ({row.points:g} {'point' if row.points == 1 else 'points'}): "
        "all its lines hold. The person who reads your text decides on it."
        + (f" The text should still say: {row.left}." if row.left else "")
        for row in marked.earned
    ]


def html_card(marked: Marked, with_names: bool = True) -> str:
    """The card as HTML, readable by a screen reader from top to bottom. with_names: whether it has what
    may be used, folded where there are lines.

    What a student typed is shown as code, and never as a formula, which could hold a link.
    """
    colour = GREEN if marked.done else RED if marked.lines or marked.problem else GREY
    rows = "".join(map(_item, marked.lines))
    parts = [
        f'<p style="margin: 0.2em 0"><strong>{escape(marked.headline)}</strong></p>',
        _paragraph(marked.problem),
        f'<ol style="margin: 0.3em 0; padding-left: 1.6em">{rows}</ol>' if rows else "",
        _paragraph(marked.still, bold=True),
        *map(_paragraph, earned(marked)),
        _fold(marked) if with_names else "",
    ]
    return (
        f'<div class="armdyn-derivation tex2jax_ignore mathjax_ignore" role="group"'
        f' aria-label="{escape(marked.headline)}" style="border-left: 5px solid {colour};'
        f' padding: 0.4em 0.9em; max-width: 46em">{"".join(parts)}</div>'
    )


def mimebundle(marked: Marked, with_names: bool = True) -> dict[str, str]:
    """The card for a notebook's output: plain text, and HTML."""
    return {
        "text/plain": text(marked, with_names),
        "text/html": html_card(marked, with_names),
    }


def _item(line: MarkedLine) -> str:
    mark, colour, said = ("✓", GREEN, "holds") if line.holds else ("✗", RED, "does not hold")
    why = f'<br><span style="font-weight: 600">{escape(line.said)}</span>' if line.said else ""
    by = f" <em>{escape(_reasons(line))}</em>" if line.reasons else ""
    return (
        f'<li style="margin: 0.3em 0"><span role="img" aria-label="{said}" style="color: {colour};'
        f' font-weight: 700">{mark}</span> <code style="{CODE}">{escape(_formula(line))}</code>'
        f"{by}{why}</li>"
    )


def _paragraph(said: str, bold: bool = False) -> str:
    weight = "; font-weight: 600" if bold else ""
    return f'<p style="margin: 0.3em 0{weight}">{escape(said)}</p>' if said else ""


def _fold(marked: Marked) -> str:
    derivation = marked.derivation
    start, *_ = _given(derivation)
    names = "".join(
        f"<li><code>{escape(name)}</code>: {escape(meaning)}</li>"
        for name, meaning in derivation.subject.meanings.items()
    )
    reasons = "".join(
        f"<li><strong>{escape(reason.name)}</strong>: {escape(reason.says)}</li>"
        for reason in derivation.subject.reasons
    )
    opened = "" if marked.lines else " open"
    return (
        f'<details style="margin: 0.3em 0"{opened}><summary>Names and reasons</summary>'
        f'<p style="margin: 0.3em 0">{escape(start)}</p>'
        f'<p style="margin: 0.3em 0">Names:</p><ul style="margin: 0.3em 0">{names}</ul>'
        f'<p style="margin: 0.3em 0">Reasons, one or two to a line:</p>'
        f'<ul style="margin: 0.3em 0">{reasons}<li><strong>algebra</strong>: no fact is used</li>'
        "</ul></details>"
    )


def _given(derivation: Derivation) -> list[str]:
    """Where the derivation starts, and what it may use, line by line."""
    subject = derivation.subject
    return [
        f"Start from {derivation.start}. Write a' for the transpose of a, a^-1 for an inverse, "
        "d/dt(...) for a derivative; or paste a formula in LaTeX.",
        "Names:",
        *(f"  {name}: {meaning}" for name, meaning in subject.meanings.items()),
        "Reasons, one or two to a line:",
        *(f"  {reason.name}: {reason.says}" for reason in subject.reasons),
        "  algebra: no fact is used",
    ]


def _formula(line: MarkedLine) -> str:
    return one_line(line.text, MOST_SHOWN)


def _reasons(line: MarkedLine) -> str:
    return one_line(", ".join(line.reasons), MOST_SHOWN)
