"""How a verdict looks in a notebook: a card whose text says everything its colour says."""

from html import escape

from autograder.verdict import State, Verdict, worst_case

# Mark and colour (Okabe and Ito's palette, safe for colour-blind readers).
LOOKS = {
    State.CORRECT: ("✓", "#009E73"),
    State.PARTLY_CORRECT: ("◐", "#E69F00"),
    State.INCORRECT: ("✗", "#D55E00"),
    State.ERROR: ("!", "#CC79A7"),
    State.NOT_ATTEMPTED: ("○", "#888888"),
    State.CHECK_FAILED: ("?", "#0072B2"),
}


def html_card(verdict: Verdict) -> str:
    """The verdict as HTML, readable by a screen reader from top to bottom."""
    mark, colour = LOOKS[verdict.state]
    lines = [_paragraph("problem", verdict.problem)]
    lines += [_rows(verdict)] if verdict.rows else []
    lines += [_paragraph("diagnosis", sentence) for sentence in verdict.diagnosis]
    if verdict.witness:
        lines.append(_paragraph("witness", worst_case(verdict.witness)))
        lines += [drawing(verdict.witness.pose)] if verdict.witness.pose else []
    lines.append(_paragraph("next", verdict.next_step))
    return (
        f'<div class="armdyn-verdict" data-state="{verdict.state.name.lower().replace("_", "-")}"'
        f' role="group" aria-label="{escape(verdict.headline)}"'
        f' style="border-left: 5px solid {colour}; padding: 0.4em 0.9em; max-width: 46em">'
        f'<p style="margin: 0.2em 0"><strong><span aria-hidden="true">{mark} </span>'
        f"{escape(verdict.headline)}</strong></p>{''.join(lines)}</div>"
    )


def mimebundle(verdict: Verdict) -> dict[str, str]:
    """The verdict for a notebook's output: plain text, and the card."""
    return {"text/plain": str(verdict), "text/html": html_card(verdict)}


def drawing(pose: tuple[tuple[float, float], ...], size: int = 120) -> str:
    """An arm's joints as an SVG picture with a text for who cannot see it. pose: (x, y) in m."""
    reach = max(abs(c) for point in pose for c in point) or 1.0
    at = [(size / 2 * (1 + 0.88 * x / reach), size / 2 * (1 - 0.88 * y / reach)) for x, y in pose]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
    joints = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="#fff"/>' for x, y in at[:-1])
    x, y = pose[-1]
    text = f"The arm in the worst case: its hand is at x = {x:.2f} m, y = {y:.2f} m."
    base = f'<path d="M{size / 2 - 10:.0f} {size / 2:.0f}h20" stroke="#888888"/>'
    return (
        f'<svg role="img" aria-label="{escape(text)}" width="{size}" height="{size}"'
        f' viewBox="0 0 {size} {size}" stroke="currentColor"><title>{escape(text)}</title>{base}'
        f'<polyline points="{line}" fill="none" stroke="#0072B2" stroke-width="5"'
        f' stroke-linecap="round" stroke-linejoin="round"/>{joints}</svg>'
    )


def _paragraph(kind: str, text: str) -> str:
    if not text:
        return ""
    weight = "; font-weight: 600" if kind == "diagnosis" else ""
    # Only there may a student's own words stand. As a formula they could be a link that runs code.
    plain = " tex2jax_ignore mathjax_ignore" if kind == "problem" else ""
    return f'<p class="armdyn-{kind}{plain}" style="margin: 0.3em 0{weight}">{escape(text)}</p>'


def _rows(verdict: Verdict) -> str:
    items = "".join(
        f"<li>{'met' if row.met else 'not met'}: {escape(row.text)} ({row.share:.0%})</li>"
        for row in verdict.rows
    )
    return f'<ul style="margin: 0.3em 0">{items}</ul>'
