"""What a card says of an answer is true of it: the unit of its entry, and of C what C q̇ shows."""

import numpy as np
import pytest

from autograder.judging.claims import Claim
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.mistakes import mistakes_of
from autograder.mutation.references import reference
from autograder.problems import CHECKS
from tests.autograder.mutation.test_mistakes import judged

CART = MECHANISMS["cart-pole"]
MIXED = ("cart-pole", "turn-and-slide", "spring-cart")
TORQUE = {"rad": "N·m", "m": "N"}
RATE = {"rad": "rad/s", "m": "m/s"}


def unit_at(mechanism, answer, at):
    """Of one entry, by what its coordinates measure."""
    kinds = [c.unit for c in mechanism.coordinates]
    i = at[0]
    if answer == "g_vec":
        return TORQUE[kinds[i]]
    if answer == "f":
        return RATE[kinds[i % mechanism.n]] + ("²" if i >= mechanism.n else "")
    lengths = [kinds[k] for k in at].count("m")
    return ("kg·m²", "kg·m", "kg")[lengths] + ("/s" if answer == "M_dot" else "")


@pytest.mark.parametrize("name", MIXED)
@pytest.mark.parametrize("answer", ["M", "M_dot", "g_vec", "f"])
def test_the_worst_case_has_the_unit_of_its_entry(name, answer):
    mechanism = MECHANISMS[name]
    check, right = check_of(mechanism, answer), reference(mechanism, answer)
    for at in np.ndindex(ANSWERS[answer].shape(mechanism.n)):

        def wrong(*given, at=at):
            value = np.array(right(*given))
            value[at] += 3.7
            return value

        assert judged(check, wrong).witness.off.startswith(
            f"3.7 {unit_at(mechanism, answer, at)}"
        ), at


@pytest.mark.parametrize("name", MIXED)
def test_the_worst_case_of_C_has_the_unit_of_its_row(name):
    mechanism = MECHANISMS[name]
    right = reference(mechanism, "C")
    for i, c in enumerate(mechanism.coordinates):

        def wrong(q, qd, arm, i=i):
            C = right(q, qd, arm)
            C[i, i] += 2.3
            return C

        assert TORQUE[c.unit] in judged(check_of(mechanism, "C"), wrong).witness.off.split()


@pytest.mark.parametrize(("row", "units"), [(0, ["m/s²", "rad/s²"]), (1, ["m²/s²", "m/s²"])])
def test_the_worst_case_of_a_column_has_the_unit_of_its_row(row, units):
    """A force or a torque, over kg and over kg·m."""
    check, right = check_of(MECHANISMS["cart-pole"], "regressor"), reference(CART, "regressor")
    columns = [criterion.text for criterion in check.criteria]
    for of, unit in zip(("column of m + mc", "column of m·lc"), units, strict=True):
        place = columns.index(of)

        def wrong(*given, column=place):
            Y = np.array(right(*given))
            Y[row, column] += 2.3
            return Y

        assert judged(check, wrong).witness.off.split()[:2] == ["2.3", unit]


def test_what_is_said_of_C_is_true_of_more_than_C_times_q_dot():
    """Each mistake in C with a matrix added that sends q̇ to 0: C q̇ is the mistake's, and C is not."""
    check = check_of(CART, "C")
    claims = [m for m in mistakes_of(CART, "C") if m.claim is Claim.JUDGED]
    assert len(claims) > 20
    for mistake in claims[::3]:

        def wrong(q, qd, arm, mistake=mistake):
            nothing = np.outer([0.7, 1.9], [-qd[1], qd[0]])  # times q̇ it is 0
            return mistake.wrong(q, qd, arm) + nothing

        said = judged(check, wrong).diagnosis
        assert mistake.sentence not in said
        assert any("not skew-symmetric" in one for one in said), mistake.name


def test_two_entries_of_C_are_still_named_together():
    mechanism = MECHANISMS["planar-2r"]

    def wrong(q, qd, arm):
        h = -arm.m2 * arm.l1 * arm.lc2 * np.sin(q[1])
        return [[0, h * (qd[0] + qd[1])], [h * qd[0], 0]]

    said = judged(check_of(mechanism, "C"), wrong).diagnosis
    assert len(said) == 2
    assert all(" C11" in one or " C21" in one for one in said)


@pytest.mark.parametrize("name", ["cart-pole", "planar-2r", "furuta"])
def test_C_less_its_transpose_is_named(name):
    right = reference(MECHANISMS[name], "C")

    def skew(q, qd, arm):
        return right(q, qd, arm) - right(q, qd, arm).T

    (one,) = judged(check_of(MECHANISMS[name], "C"), skew).diagnosis
    assert one.startswith("You return C less its transpose")


def test_a_right_C_times_q_dot_is_said_where_it_is_right():
    mechanism = MECHANISMS["planar-2r"]
    right = reference(mechanism, "C")

    def with_right_product(q, qd, arm):
        return right(q, qd, arm) + 0.37 * np.array([[-qd[1], qd[0]], [0, 0]])

    for check in (check_of(mechanism, "C"), CHECKS["p2-C"]):
        assert "A right C q̇ is not enough" in judged(check, with_right_product).diagnosis[-1]
        wrong = judged(check, lambda q, qd, arm: right(q, qd, arm) + 0.37 * np.diag(qd))
        assert not any("A right C q̇" in said for said in wrong.diagnosis)
        assert any("not skew-symmetric" in said for said in wrong.diagnosis)


def test_an_arm_that_is_asked_about_is_not_called_false():
    arm = {"l1": 1, "l2": 1, "lc1": 0.5, "lc2": 0.5, "m1": 1, "m2": 1, "I1": 0.1, "I2": 0.1}
    verdict = judged(CHECKS["p1-singular_arm"], lambda: (arm, [0.3, 1.0]))
    assert verdict.witness.returned == "a result for which “is M(q) singular?” has the answer no"
    truth = judged(CHECKS["p1-is_spd"], lambda A: True)
    assert truth.witness.returned.startswith("True; the right answer is False")


def test_a_regressor_is_told_of_its_own_rows():
    mechanism = MECHANISMS["planar-2r"]
    right = reference(mechanism, "regressor")

    def wrong(q, qd, qdd, arm):
        """Without q̇2² at joint 1."""
        Y = np.array(right(q, qd, qdd, arm))
        Y[0, 3] += arm.l1 * np.sin(q[1]) * qd[1] ** 2
        return Y

    (said,) = judged(check_of(mechanism, "regressor"), wrong).diagnosis
    assert said.startswith("Your Y lacks the product of velocities q̇2² in row 1.")
