"""`with look_at("p1-M"):` opens a cell of the course that uses a student's functions."""

import contextlib
import io
import sys

from autograder.judging.verdict import State
from autograder.problems import known_check
from autograder.protocol import Look
from autograder.student.cell import verdict_on

SECONDS = 20.0


def look_at(*ids: str) -> Look:
    """A block that uses the functions of these checks. If one fails, a line names it and its card.

    After an error the cell goes on below the block, so that "Run All Cells" goes on too; an interrupt
    stops both. ids: each after those that it builds on. UnknownCheckError where no check has one.
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
        # A function that gives no numbers stops most cells, and the functions that call it; one
        # that gives wrong numbers stops few.
        failing = [id for id in ids if states[id] is State.ERROR]
        return next(iter(failing + ([raising] if raising in wrong else wrong)), None)

    return Look(ids, namespace, blame, SECONDS)
