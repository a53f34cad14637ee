"""`hint` shows a check's hints, one more each time: from a nudge to nearly the whole way."""

from html import escape

from autograder.lesson_checks import known as known_in_lesson
from autograder.problems import CHECKS, UnknownCheckError, known_check
from autograder.proofs import derivation_of
from autograder.student import failing, hint_counts
from autograder.student.display import show
from autograder.student.own_arm import drawn_for

NONE_FAILED = (
    "no check has failed since this kernel started: run the cell of a check first, or name one, as in "
    'hint("p1-M")'
)


def hint(id: str | None = None) -> None:
    """Show one more hint for the check or derivation `id`, below those you have seen. Hints cost no
    points.

    Without an id, for the check that failed last. How many you have seen is kept beside the notebook
    and handed in with it; a new kernel first shows these again. UnknownCheckError where nothing has
    this id, or where none is given and no check has failed.
    """
    id = failing.last() if id is None else id
    if id is None:
        raise UnknownCheckError(NONE_FAILED)
    proof = derivation_of(id) if isinstance(id, str) else None
    in_lesson = known_in_lesson(id)
    known = proof or in_lesson or known_check(id, drawn_for(id))
    id, hints = known.id, known.hints
    seen = hint_counts.seen(id)
    again = hint_counts.is_first_call(id) and seen > 0
    given = min(seen if again else seen + 1, len(hints))
    if hints:
        hint_counts.keep(id, given, beside=not in_lesson)
    _show(hints[:given], f"Hints for {id}", _left(id, given, len(hints)))


def _left(id: str, given: int, most: int) -> str:
    """The line below the hints."""
    if not most:
        return "There are no hints for this check."
    if given < most:
        return f'Hint {given} of {most}. For the next one, run hint("{id}") again.'
    if id in CHECKS or derivation_of(id):
        return "That was the last hint. The matching lesson has the rest."
    return "That was the last hint."


def _show(hints: tuple[str, ...], title: str, left: str) -> None:
    numbered = [f"{number}. {text}" for number, text in enumerate(hints, 1)]
    text = "\n".join([title, *numbered, left])
    show({"text/plain": text, "text/html": _html(hints, title, left)})


def _html(hints: tuple[str, ...], title: str, left: str) -> str:
    items = "".join(f'<li style="margin: 0.3em 0">{escape(text)}</li>' for text in hints)
    return (
        f'<div class="armdyn-hint" role="group" aria-label="{escape(title)}"'
        ' style="border-left: 5px solid #56B4E9; padding: 0.4em 0.9em; max-width: 46em">'
        f'<p style="margin: 0.2em 0"><strong>{escape(title)}</strong></p>'
        f'<ol style="margin: 0.3em 0">{items}</ol>'
        f'<p style="margin: 0.3em 0"><em>{escape(left)}</em></p></div>'
    )
