"""Hints, one more each time they are asked for: from a nudge to nearly the way."""

from html import escape

from autograder.problems import CHECKS, known_check

_given: dict[str, int] = {}


def hint(id: str) -> None:
    """Show the hints of the check `id` so far, and one more. ValueError for an unknown id.

    The count starts again with the kernel. Nothing is taken off for hints.
    """
    hints = CHECKS[known_check(id)].hints
    given = min(_given.get(id, 0) + 1, len(hints))
    _given[id] = given
    if not hints:
        left = "There are no hints for this one."
    elif given < len(hints):
        left = f'{len(hints) - given} more: hint("{id}") again.'
    else:
        left = "That was the last one. The matching lesson has the rest."
    _show([f"{number + 1}. {text}" for number, text in enumerate(hints[:given])], id, left)


def _show(lines: list[str], id: str, left: str) -> None:
    text = "\n".join([f"Hints for {id}", *lines, left])
    try:
        from IPython import get_ipython
        from IPython.display import display
    except ImportError:
        print(text)
        return
    if get_ipython() is None:
        print(text)
        return
    items = "".join(f'<p style="margin: 0.3em 0">{escape(line)}</p>' for line in lines)
    html = (
        f'<div class="armdyn-hint" role="group" aria-label="Hints for {escape(id)}"'
        ' style="border-left: 5px solid #56B4E9; padding: 0.4em 0.9em; max-width: 46em">'
        f"{items}<p><em>{escape(left)}</em></p></div>"
    )
    display({"text/plain": text, "text/html": html}, raw=True)
