"""Judging a student's function by itself, for the tests of mistakes and of right variants."""

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize  # so that no call with a time limit pays for it
import sympy as sp

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES, Check
from autograder.judging.verdict import State, Verdict
from autograder.problems import CHECKS
from autograder.protocol import answer_all, calls
from tests.submissions.answers import indented


def function_of(check_id: str, body: str) -> str:
    """A student's function: `body` is the expression it returns, or its whole body."""
    return f"def {CHECKS[check_id].signature}:\n{indented(body)}\n"


def namespace_of(check_id: str, body: str) -> dict:
    """What a student's cells define that import the usual libraries and write this function."""
    namespace = {"__name__": "__main__", "np": np, "sp": sp, "scipy": scipy}
    exec(function_of(check_id, body), namespace)
    return namespace


def judged_in(namespace: dict, check_id: str, seed: int = 0, count: int = HIDDEN_CASES) -> Verdict:
    """The verdict on the function in this namespace, however slow the machine is."""
    return verdict_of(CHECKS[check_id], namespace, seed, count)


def judged(check_id: str, body: str, seed: int = 0, count: int = HIDDEN_CASES) -> Verdict:
    """The verdict on a student's function: `body` is the expression it returns, or its whole body."""
    return judged_in(namespace_of(check_id, body), check_id, seed, count)


def judged_by(check: Check, body: str, seed: int = 0, count: int = HIDDEN_CASES) -> Verdict:
    """As `judged`, by a check of one's own."""
    return verdict_of(check, namespace_of(check.id, body), seed, count)


def verdict_of(check: Check, namespace: dict, seed: int = 0, count: int = HIDDEN_CASES) -> Verdict:
    """As `judged_in`, by a check of one's own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(calls, "CALL_SECONDS", 60.0)
        return check.run(
            lambda asked: answer_all(asked, namespace), np.random.default_rng(seed), count
        )


def assert_told_apart(check: Check, seed: int) -> None:
    """Mistakes with different sentences give different answers, even to a visible check."""
    calls = check.calls(np.random.default_rng(seed), VISIBLE_CASES)
    answers = {}
    for mistake in check.mistakes:
        numbers = check._quantities_of(mistake.wrong, calls)
        flat = np.concatenate([np.ravel(part) for case in numbers for part in case])
        for other, theirs in answers.items():
            same = np.allclose(flat, theirs, rtol=1e-4, atol=1e-9)
            assert not same or mistake.sentence == other.sentence, mistake.name
        answers[mistake] = flat


def assert_right(verdict: Verdict) -> None:
    assert verdict.state is State.CORRECT, str(verdict)
    assert (verdict.credit, verdict.diagnosis, verdict.witness) == (1, (), None)


def sentences(check_id: str, *names: str) -> tuple[str, ...]:
    """What the check says of these mistakes: a test names a mistake, and types no sentence."""
    said = {mistake.name: mistake.sentence for mistake in CHECKS[check_id].known_mistakes}
    return tuple(said[name] for name in names)
