"""The terms of the checks, on which an error is projected: their sum, and that each is found."""

import numpy as np
import pytest

from autograder.judging.check import HIDDEN_CASES, VISIBLE_CASES
from autograder.judging.models import AtPoints
from autograder.problems import CHECKS
from autograder.protocol import Reply, real

WITH_TERMS = [id for id, check in CHECKS.items() if check.terms]
# Of these they are what an error may look like, not the parts of the right answer.
NOT_ITS_PARTS = ("p2-M_dot", "p2-C_other", "p3-M")


def terms_of(check):
    return check.terms() if callable(check.terms) else check.terms


def numbers(check, model, call):
    """What a reference or a term gives for a call."""
    if isinstance(model, AtPoints):
        return model.for_calls([call])[0]
    args = [*map(real, call.args)]
    if call.at:
        return np.array([model(*point.values()) for point in call.at], float)
    return np.asarray(model(*args), float)


@pytest.mark.parametrize("check_id", [id for id in WITH_TERMS if id not in NOT_ITS_PARTS])
def test_the_terms_add_up_to_the_right_answer(check_id):
    """But for what is no term, as q̇ in ẋ."""
    check = CHECKS[check_id]
    for call in check.calls(np.random.default_rng(3), VISIBLE_CASES):
        right = numbers(check, check.reference, call)
        parts = [numbers(check, term.model, call) for term in terms_of(check)]
        total, right = np.squeeze(sum(parts)), np.squeeze(right)
        where = total != 0
        assert np.any(where)
        np.testing.assert_allclose(total[where], right[where], rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("check_id", WITH_TERMS)
def test_each_term_is_found_where_it_is_too_large(check_id):
    """By its name; or by a factor of all, where a criterion sees that term alone."""
    check = CHECKS[check_id]
    general = {own.text for criterion in check.criteria for own in criterion.said}
    for term in terms_of(check):

        def ask(calls, term=term):
            return [
                Reply(
                    value=numbers(check, check.reference, c) + 0.37 * numbers(check, term.model, c)
                )
                for c in calls
            ]

        verdict = check.run(ask, np.random.default_rng(1), HIDDEN_CASES)
        explained = [sentence for sentence in verdict.diagnosis if sentence not in general]
        # What fails in a closed loop is accounted for by what is said of the law itself.
        silent = [
            k
            for k, (row, criterion) in enumerate(zip(verdict.rows, check.criteria, strict=True))
            if not (row.met or row.said or criterion.in_loop)
        ]
        assert explained
        assert all(len(row.said) <= 1 for row in verdict.rows)
        # With a wrong C_other q̇ the distance from skew-symmetric is 0 by definition: no second mistake.
        product_is_wrong = check_id == "p2-C_other" and not verdict.rows[0].met
        assert silent == ([1] if product_is_wrong else [])
        for sentence in explained:
            assert any(
                f"{who} 37 % too large" in sentence
                for who in (f"{term.name} comes out", "every value is")
            )
