"""Which argument is 0, or equal to another, in the calls that gave no number, and in no other."""

import numpy as np
import pytest

from autograder.judging.zeros import sentence
from autograder.protocol import Call
from tests.autograder.problems.p5_state_space.table import rate
from tests.autograder.verdicts import judged


def calls(*pairs):
    return [Call("u", tuple(map(np.array, pair))) for pair in pairs]


A, B, Z = [1.0, 2.0], [3.0, -1.0], [0.0, 2.0]


@pytest.mark.parametrize(
    ("pairs", "bad", "said"),
    [
        ([(Z, A), (A, B), (B, A)], [0], "qd[0] is 0; in the calls that work no entry of qd is."),
        ([(Z, A), (A, B), (Z, B)], [0, 2], "qd[0] is 0; in the calls that work no entry of qd is."),
        ([(A, A), (A, B), (B, A)], [0], "qd and v are equal; in the calls that work they are not."),
        ([(Z, A), (A, B), (Z, B)], [0], ""),  # one that works has a 0 too
        ([(Z, A), (A, B), (B, A)], [0, 1], ""),  # one that fails has none
        ([(Z, A)], [0], ""),  # none works
    ],
)
def test_what_tells_the_calls_apart(pairs, bad, said):
    found = sentence("u(qd, v)", calls(*pairs), bad)
    assert found == (f"In this call {said}" if said else "")


def test_a_velocity_by_its_size_is_no_number_at_rest():
    """What many write for a sign."""
    verdict = judged("p5-f", rate("u - C @ qd - g - d * qd - k * qd / np.abs(qd)"))
    assert "NumPy met 0/0" in verdict.problem
    assert "is 0; in the calls that work no entry of x is." in verdict.problem
    dry = "[k[i].item() * qd[i].item() / abs(qd[i].item()) for i in range(2)]"
    verdict = judged("p5-f", rate(f"u - C @ qd - g - d * qd - {dry}"))
    assert "ZeroDivisionError" in verdict.problem
    assert "is 0; in the calls that work no entry of x is." in verdict.problem
