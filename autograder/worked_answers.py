"""The files beside a notebook with the answers that an instructor has opened, and with when others open.

They are two, because a student's folder keeps the files that it has: what says when must not stand in
the way of what comes then. Their names begin with a dot, so that no cell finds them in the sandbox.
"""

import json
from datetime import datetime
from html import escape
from pathlib import Path

from autograder.files import put_in_place

OPEN = ".worked-answers.json"  # grade_id → the answer
OPENS = ".worked-answers-open.json"  # the key WHEN → a time, or FULL_MARKS
WHEN = "when"
FULL_MARKS = "with full marks"
MOST_BYTES = 4 << 20
MOST_SHOWN = 60  # characters of what is no time
# nbgrader's feedback pages break code within words otherwise, and JupyterLab breaks its lines.
LOOK = "margin: 0.3em 0; white-space: pre-wrap; overflow-wrap: anywhere; word-break: normal"
OF_THE_BOOK = (
    "This is the answer for the arm of the book. Yours is described in another way, so that its "
    "formulas differ: what leads to them is the same."
)


def read(file: Path) -> dict[str, str]:
    """What a file holds; empty where there is none, or where it is damaged."""
    try:
        if file.stat().st_size > MOST_BYTES:
            return {}
        held = json.loads(file.read_text(encoding="utf-8"))
        return {key: text for key, text in held.items() if isinstance(text, str)}
    except (OSError, ValueError, AttributeError, RecursionError):
        return {}


def write(file: Path, held: dict[str, str]) -> None:
    """Put it into a file. OSError if it cannot be written."""
    put_in_place(file, json.dumps(held, ensure_ascii=False, indent=1))


def time_of(said: str) -> datetime | None:
    """The time at which answers open, with its zone; None where they do so with full marks.

    A time without a zone is of this machine's. ValueError if it is none.
    """
    if said == FULL_MARKS:
        return None
    try:
        return datetime.fromisoformat(said).astimezone()
    except (ValueError, OverflowError):
        raise ValueError(
            f"{said[:MOST_SHOWN]!r} is no time; write it as 2026-12-15 or 2026-12-15T12:00"
        ) from None


def mimebundle(id: str, answer: str, is_text: bool, remark: str = "") -> dict[str, str]:
    """An answer for a notebook's output. is_text: Markdown, and not code. remark: what to know of it."""
    title = f"A worked answer for {id}"
    plain = "\n".join(filter(None, [title, remark, answer]))
    if is_text:
        head = "\n\n".join(filter(None, [f"**{title}**", remark]))
        return {"text/plain": plain, "text/markdown": f"{head}\n\n{answer}"}
    said = f'<p style="margin: 0.3em 0">{escape(remark)}</p>' if remark else ""
    html = (
        f'<div class="armdyn-solution" role="group" aria-label="{escape(title)}"'
        ' style="border-left: 5px solid #009E73; padding: 0.4em 0.9em; max-width: 60em">'
        f'<p style="margin: 0.2em 0"><strong>{escape(title)}</strong></p>{said}'
        f'<pre class="tex2jax_ignore mathjax_ignore" style="{LOOK}">'
        f'<code style="white-space: inherit">{escape(answer)}</code></pre></div>'
    )
    return {"text/plain": plain, "text/html": html}
