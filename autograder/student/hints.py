"""`hint` shows a check's hints, one more each time: from a nudge to nearly the whole way."""

from html import escape

from autograder.problems import CHECKS, known_check
from autograder.proofs import DERIVATIONS
from autograder.student.own_arm import drawn_for

_given: dict[str, int] = {}


def hint(id: str | None = None) -> None:
    """Show one more hint for the check or derivation `id`, below those you have seen. Hints cost no
    points.

    The count starts again with the kernel. UnknownCheckError where nothing has this id.
    """
    proof = DERIVATIONS.get(id) if isinstance(id, str) else None
    known = proof or known_check(id, drawn_for(id))
    id, hints = known.id, known.hints
    given = min(_given.get(id, 0) + 1, len(hints))
    _given[id] = given
    if not hints:
        left = "There are no hints for this check."
    elif given < len(hints):
        left = f'Hint {given} of {len(hints)}. For the next one, run hint("{id}") again.'
    else:
        left = "That was the last hint."
        if proof or id in CHECKS:
            left += " The matching lesson has the rest."
    _show(hints[:given], f"Hints for {id}", left)


def _show(hints: tuple[str, ...], title: str, left: str) -> None:
    numbered = [f"{number}. {text}" for number, text in enumerate(hints, 1)]
    text = "\n".join([title, *numbered, left])
    try:
        from IPython import get_ipython
        from IPython.display import display
    except ImportError:
        print(text)
        return
    if get_ipython() is None:
        print(text)
    else:
        display({"text/plain": text, "text/html": _html(hints, title, left)}, raw=True)


def _html(hints: tuple[str, ...], title: str, left: str) -> str:
    items = "".join(f'<li style="margin: 0.3em 0">{escape(text)}</li>' for text in hints)
    return (
        f'<div class="armdyn-hint" role="group" aria-label="{escape(title)}"'
        ' style="border-left: 5px solid #56B4E9; padding: 0.4em 0.9em; max-width: 46em">'
        f'<p style="margin: 0.2em 0"><strong>{escape(title)}</strong></p>'
        f'<ol style="margin: 0.3em 0">{items}</ol>'
        f'<p style="margin: 0.3em 0"><em>{escape(left)}</em></p></div>'
    )
