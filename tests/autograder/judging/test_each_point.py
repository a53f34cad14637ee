"""Each point that is lost traces to a sentence: over all wrong answers that the tests have."""

import pytest

from autograder.judging.verdict import AS_ABOVE, State
from autograder.problems import CHECKS
from tests.autograder.problems.tables import ROWS, gathered
from tests.autograder.verdicts import judged

# What a problem's table of unknown errors holds beside its text: what is said of it.
UNKNOWN = [
    (id, row if isinstance(row, str) else row[0])
    for kind in ("TRACED", "UNEXPLAINED", "NEARLY")
    for id, rows in gathered("unknown", kind).items()
    for row in rows
]
WRONG = [(row.check, row.body, len(row.names)) for row in ROWS]
WRONG += [(id, body, 1) for id, body in UNKNOWN]


FEW = [(id, body, 1) for id, body in UNKNOWN]
FEW += [(row.check, row.body, len(row.names)) for row in ROWS if len(row.names) > 1]


@pytest.mark.parametrize("check_id", CHECKS)
def test_each_lost_point_has_its_sentence(check_id):
    """In answers that no mistake explains, or more than one."""
    assert_each_lost_point_has_its_sentence([row for row in FEW if row[0] == check_id])


@pytest.mark.long
@pytest.mark.parametrize("check_id", CHECKS)
def test_each_lost_point_of_each_wrong_answer_has_its_sentence(check_id):
    assert_each_lost_point_has_its_sentence([row for row in WRONG if row[0] == check_id])


def assert_each_lost_point_has_its_sentence(wrong):
    """One, or as many as there are mistakes in the answer; and none where nothing is lost."""
    for id, body, mistakes in wrong:
        verdict = judged(id, body, count=6)
        lost = sum(row.share for row in verdict.rows if not row.met)
        assert verdict.credit == pytest.approx(1 - lost)
        for row, said in verdict.said_of_rows():
            whole = " ".join(said)
            if row.met:
                assert said == [], body
                continue
            assert 1 <= len(said) <= max(mistakes, 1), (body, row.text, said)
            assert whole in (AS_ABOVE, " ".join(row.said), row.seen) or AS_ABOVE in said


def test_an_answer_without_numbers_says_why_in_one_place():
    for body, state in (
        ("1 / 0", State.ERROR),
        ("None", State.ERROR),
        ("...", State.NOT_ATTEMPTED),
    ):
        verdict = judged("p4-g_vec", body)
        assert verdict.state is state
        assert verdict.rows == ()
        assert bool(verdict.problem) is (state is State.ERROR)
        assert verdict.next_step


def test_what_nothing_explains_says_in_how_many_cases_it_is_wrong():
    verdict = judged("p4-potential_energy", "q[0] ** 2 + q[1]")
    first, second = (said for _, said in verdict.said_of_rows())
    assert first[0].endswith("It is wrong in 72 of 72 cases. Begin with the worst case.")
    assert second[0].endswith("It is wrong in 72 of 72 cases.")
    assert "72 of 72" in str(verdict)
    assert verdict.diagnosis == ()  # it is no mistake that a class could share
