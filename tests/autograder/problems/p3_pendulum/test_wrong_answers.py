"""Wrong answers about the pendulum that are no known mistake."""

import pytest

from autograder.judging.criterion import TOLERANCE
from autograder.judging.verdict import State
from tests.autograder.problems.p3_pendulum.table import KINETIC, MGL, POTENTIAL
from tests.autograder.verdicts import judged


def test_a_c_of_no_known_kind_is_said_not_to_be_zero():
    verdict = judged("p3-C", "0.3 + q")
    assert verdict.credit == 0
    assert verdict.witness.call.startswith("C(")
    assert verdict.diagnosis == (
        "Your C is not zero. Every entry of C is made of derivatives of M with respect to q: how "
        "does this M change with q?",
    )


@pytest.mark.parametrize(
    ("check_id", "returned", "said"),
    [
        (
            "p3-M",
            "1.1 * pend.I",
            "inertia about the pivot, every value is 10 % too large. Which factor belongs to all terms?",
        ),
        (
            "p3-g_vec",
            f"{MGL} * np.sin(q) * 1.0001",
            "gravity torque, every value is 0.01 % too large. Is a constant rounded?",
        ),
        (
            "p3-g_vec",
            f"-{MGL} * np.sin(q) * 1.0001",
            "gravity torque, every value is −1 times the right one. Which factor belongs to all terms?",
        ),
        (
            "p3-inertia_about_pivot",
            "I_com + 0.9 * m * lc**2",
            "inertia moved to the pivot, the inertia of a point mass comes out 10 % too small.",
        ),
        (
            "p3-lagrangian",
            f"1.2 * {KINETIC} - {POTENTIAL}",
            "kinetic part of L, every value is 20 % too large. Which factor belongs to all terms?",
        ),
        (
            "p3-lagrangian",
            f"{KINETIC} - 0.7 * {POTENTIAL}",
            "potential part of L, every value is 30 % too small. Which factor belongs to all terms?",
        ),
    ],
)
def test_unknown_error_is_traced_to_its_term(check_id, returned, said):
    verdict = judged(check_id, returned)
    assert verdict.diagnosis == (f"In your {said}",)
    assert verdict.witness is not None


@pytest.mark.parametrize(
    ("check_id", "returned"),
    [("p3-M", "q[0]"), ("p3-g_vec", "q[0] ** 4"), ("p3-small_angle_frequency", "1.0")],
)
def test_an_answer_without_the_pendulum_is_told_so(check_id, returned):
    verdict = judged(check_id, returned)
    assert verdict.state is State.INCORRECT
    (said,) = verdict.diagnosis
    assert "the values do not depend on pend at all" in said
    assert verdict.witness is not None


def test_mistake_is_named_only_where_it_matches_to_rounding():
    close = f"{MGL} * np.cos(q) * (1 + {20 * TOLERANCE})"
    assert judged("p3-g_vec", close).diagnosis == ()
    assert judged("p3-g_vec", f"np.float32({MGL} * np.cos(q))").diagnosis != ()


def test_an_energy_that_no_mistake_explains_is_judged_all_the_same():
    """The terms of L are asked for by numbers that come one by one."""
    verdict = judged(
        "p3-lagrangian", "I * qd**2 / 2 - m * g * lc * (1 - sp.cos(q)) * sp.cos(q / 3)"
    )
    assert verdict.state is State.PARTLY_CORRECT, verdict.problem
