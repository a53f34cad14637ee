"""`worst_case` gives the arguments of the call that a card shows, as values to work with."""

from autograder.judging.verdict import State, Verdict
from autograder.lesson_checks import known as known_in_lesson
from autograder.problems import known_check
from autograder.protocol import real
from autograder.student.own_arm import drawn_for

_last: dict[str, Verdict] = {}
WHY_NONE = {
    State.CORRECT: "its last verdict is correct",
    State.NOT_ATTEMPTED: "its function is not written yet",
    State.CHECK_FAILED: "the check itself failed",
    State.NOT_HERE: "it is judged when you hand it in",
}


class NoWorstCaseError(LookupError):
    """A check has shown no call. In a notebook it is one line, without the way through our code."""

    def _render_traceback_(self):
        return [str(self)]


def worst_case(id: str | None = None):
    """The arguments of the worst call of the last verdict on the check `id`, or of the one that failed.

    `q, arm = worst_case("p1-M")`: NumPy arrays, floats, arms, symbols, in the order of the function's
    arguments, and new copies each time; of a function of one argument, that argument alone.
    NoWorstCaseError if the check has not run, is correct, or failed without a call; UnknownCheckError
    if no check has this id.
    """
    check = known_in_lesson(id) or known_check(id, drawn_for(id))
    verdict = _last.get(check.id)
    if verdict is None:
        raise NoWorstCaseError(f'check("{check.id}") has not run yet: run its cell first')
    if verdict.worst is None:
        why = WHY_NONE.get(verdict.state, "its last verdict shows no call")
        raise NoWorstCaseError(f"{check.id} has no worst case: {why}")
    if not verdict.worst.args:
        raise NoWorstCaseError(f"{verdict.worst.name} takes no arguments")
    values = tuple(map(real, verdict.worst.args))
    return values if len(values) > 1 else values[0]


def remember(verdict: Verdict) -> None:
    """Take this as the last verdict on its check."""
    _last[verdict.check] = verdict
