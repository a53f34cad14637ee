"""Judging a student's function by itself, for the tests of mistakes and of right variants."""

import numpy as np
import sympy as sp

from autograder.diagnosis import Mistake
from autograder.judge import HIDDEN_CASES
from autograder.problems import CHECKS
from autograder.verdict import State, Verdict
from autograder.wall import answer_all


def judged(check_id: str, body: str, seed: int = 0, count: int = HIDDEN_CASES) -> Verdict:
    """The verdict on a student's function: `body` is the expression it returns, or its whole body."""
    check = CHECKS[check_id]
    if "return" not in body:
        body = f"return {body}"
    lines = "\n".join(f"    {line}" for line in body.strip("\n").splitlines())
    namespace = {"__name__": "__main__", "np": np, "sp": sp}
    exec(f"def {check.signature}:\n{lines}", namespace)
    return check.run(lambda calls: answer_all(calls, namespace), np.random.default_rng(seed), count)


def assert_named(check_id: str, body: str, credit: float, *sentences: str) -> None:
    """This wrong answer gets exactly these sentences, this credit, and a witness with a unit."""
    verdict = judged(check_id, body)
    assert verdict.diagnosis == sentences
    assert abs(verdict.credit - credit) < 1e-12
    assert verdict.state is (State.PARTLY_CORRECT if credit else State.INCORRECT)
    assert verdict.witness.call.startswith(f"{CHECKS[check_id].name}(")
    unit = next(
        criterion.unit
        for criterion, row in zip(CHECKS[check_id].criteria, verdict.rows, strict=True)
        if not row.met
    )
    assert unit in verdict.witness.off


def sentences_of(mistakes) -> set[str]:
    """Every sentence in a module of mistakes, each of which needs a row in its table."""
    return {
        mistake.sentence
        for group in vars(mistakes).values()
        if isinstance(group, tuple)
        for mistake in group
        if isinstance(mistake, Mistake)  # and no Term
    }
