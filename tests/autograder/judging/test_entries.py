"""Which entry the worst case is, by its name; and numbers that are the same in every case."""

import numpy as np
import pytest

from autograder.problems import CHECKS, check_for
from autograder.protocol import Reply, real


def verdict(check, answer):
    def ask(calls):
        return [Reply(value=np.asarray(answer(*map(real, call.args)), float)) for call in calls]

    return check.run(ask, np.random.default_rng(3))


@pytest.mark.parametrize(("place", "name"), [((0, 1), "M12"), ((1, 0), "M21")])
@pytest.mark.parametrize("id", ["p1-M", "cart-pole-M", "elastic-joint-M"])
def test_the_worst_entry_of_a_matrix_has_its_name(id, place, name):
    check = check_for(id)

    def wrong(q, arm):
        M = np.array(check.reference(q, arm), dtype=float)
        M[place] += 5.0
        return M

    got = verdict(check, wrong).witness.returned
    assert f"({name})" in got
    assert "entry" not in got


def test_numbers_that_never_change_are_not_taken_for_terms():
    """1 is I2 + m2 ℓc2² without I2 and without the rest, but nobody who types it has left out both."""
    said = " ".join(verdict(CHECKS["p1-M"], lambda q, arm: np.eye(2)).diagnosis)
    assert "do not depend on arm at all" in said
    assert "lacks" not in said
