"""Which checks failed when they ran last in this kernel."""

from autograder.judging.verdict import State, Verdict

_failing: dict[str, None] = {}  # in the order in which they failed


def note(verdict: Verdict) -> None:
    """Take a verdict into account; a check that itself failed, or was not made, says
    nothing of the answer."""
    if verdict.state not in (State.CHECK_FAILED, State.NOT_HERE):
        _failing.pop(verdict.check, None)
        if verdict.state is not State.CORRECT:
            _failing[verdict.check] = None


def last() -> str | None:
    """The check that failed last and has not succeeded since; None where there is none."""
    return next(reversed(_failing), None)
