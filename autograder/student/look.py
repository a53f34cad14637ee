"""What a problem's own cells open with where they use a student's functions: `with look_at("p1-M"):`."""

import contextlib
import io
import sys

from autograder.judging.verdict import State
from autograder.problems import known_check
from autograder.protocol import Look
from autograder.student.cell import verdict_on

SECONDS = 20.0


def look_at(*ids: str) -> Look:
    """A block that uses the functions of these checks; where one fails, a line names it and its card.

    ids: each after those that it builds on. The cell goes on after the block as if nothing had been
    raised, so that "Run All Cells" does; an interrupt ends both. UnknownCheckError for no check's id.
    """
    for id in ids:
        known_check(id)
    namespace = sys._getframe(1).f_globals

    def blame(raising: str | None) -> str | None:
        # What the functions print was printed in the cell already.
        aside = io.StringIO()
        with contextlib.redirect_stdout(aside), contextlib.redirect_stderr(aside):
            states = {id: verdict_on(id, namespace).state for id in ids}
        wrong = [id for id in ids if states[id] in (State.INCORRECT, State.PARTLY_CORRECT)]
        # Wrong numbers end few cells; a function that gives none, most, and those that call it.
        failing = [id for id in ids if states[id] is State.ERROR]
        return next(iter(failing + ([raising] if raising in wrong else wrong)), None)

    return Look(ids, namespace, blame, SECONDS)
