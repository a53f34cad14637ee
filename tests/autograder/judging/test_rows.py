"""A verdict's rows carry what the diagnosis says of each criterion, in every check of the course."""

import numpy as np
import pytest

from autograder.judging.check import VISIBLE_CASES
from autograder.judging.given import Given
from autograder.judging.verdict import AS_ABOVE, Row, State, Verdict
from autograder.problems import CHECKS
from autograder.protocol import Reply
from tests.autograder.verdicts import judged


def verdicts_on_mistakes(check):
    """The verdict on each mistake that a person wrote, where it gives numbers."""
    for mistake in check.mistakes[:6]:
        calls = check.calls(np.random.default_rng(1), VISIBLE_CASES)
        expected = check._quantities_of(check.reference, calls)
        given = check._quantities_of(mistake.wrong, calls)
        yield check.judge(calls, expected, Given.sound(given, len(calls) * [None]))


@pytest.mark.parametrize("id", [id for id in CHECKS if CHECKS[id].mistakes])
def test_what_is_said_belongs_to_criteria_that_are_not_met(id):
    seen = 0
    for verdict in verdicts_on_mistakes(CHECKS[id]):
        if verdict.state is State.CORRECT:
            continue
        of_rows = [sentence for row in verdict.rows for sentence in row.said]
        assert not [row for row in verdict.rows if row.met and row.said]
        assert tuple(dict.fromkeys(of_rows)) == verdict.diagnosis
        assert verdict.of_the_whole == ()
        seen += bool(verdict.diagnosis)
    assert seen


def test_two_mistakes_in_two_entries_stand_each_under_its_own():
    verdict = judged(
        "p1-M",
        """
a = arm.m2 * arm.l1 * arm.lc2 * np.cos(q[1])
M22 = arm.m2 * arm.lc2**2
M11 = arm.I1 + arm.m1 * arm.lc1**2 + arm.I2 + arm.m2 * (arm.l1**2 + arm.lc2**2) + a
M12 = arm.I2 + arm.m2 * arm.lc2**2 + a
return np.array([[M11, M12], [M12, M22]])
""",
    )
    first, both, second = verdict.rows
    assert (first.met, both.met, second.met) == (False, True, False)
    assert first.said
    assert second.said
    assert set(first.said).isdisjoint(second.said)
    assert verdict.diagnosis == (*first.said, *second.said)


def test_one_mistake_behind_several_criteria_is_said_of_each_and_shown_once():
    a = "arm.m2 * arm.l1 * arm.lc2"  # the coupling of the stretched arm
    verdict = judged(
        "p1-M",
        f"""
M22 = arm.I2 + arm.m2 * arm.lc2**2
M11 = arm.I1 + arm.m1 * arm.lc1**2 + M22 + arm.m2 * arm.l1**2 + 2 * {a}
return np.array([[M11, M22 + {a}], [M22 + {a}, M22]])
""",
    )
    (sentence,) = verdict.diagnosis
    assert [row.said for row in verdict.rows] == [(sentence,), (sentence,), ()]
    assert [said for _, said in verdict.said_of_rows()] == [[sentence], [AS_ABOVE], []]


def test_a_right_answer_is_led_further_and_a_wrong_one_is_not():
    for check in CHECKS.values():
        calls = check.calls(np.random.default_rng(0), VISIBLE_CASES)
        numbers = check._quantities_of(check.reference, calls)
        given = Given.sound(numbers, len(calls) * [None])
        assert check.judge(calls, numbers, given).further == check.further
    wrong = CHECKS["p3-M"].run(
        lambda calls: [Reply(value=np.zeros((1, 1))) for _ in calls], np.random.default_rng(0)
    )
    assert wrong.state is State.INCORRECT
    assert wrong.further == ""


def test_a_reason_is_called_the_one_above_only_where_no_other_stands_between():
    """is_spd takes positive entries for positive eigenvalues, and does not ask for symmetry."""
    verdict = judged("p1-is_spd", "np.all(A > 0)", count=VISIBLE_CASES)
    first, second, third, fourth = [said for _, said in verdict.said_of_rows()]
    assert first[0].startswith("You ask for positive entries.")
    assert second == [AS_ABOVE]
    assert third[0].startswith("You accept a matrix that is not symmetric.")
    assert fourth == first


def test_one_of_two_reasons_above_is_said_again():
    rows = (
        Row("M11", 0.5, False, ("a",)),
        Row("M12", 0.25, False, ("a", "b")),
        Row("M22", 0.25, False, ("a",)),
    )
    shown = [said for _, said in Verdict("id", State.INCORRECT, rows=rows).said_of_rows()]
    assert shown == [["a"], [AS_ABOVE, "b"], ["a"]]
