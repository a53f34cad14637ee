"""A short term; `make rehearse` is the whole one."""

from dataclasses import replace

import pytest

from tests.rehearsal import differences
from tests.rehearsal.mistakes import MISTAKES
from tests.rehearsal.story import tell
from tests.rehearsal.term import P1, P2, Term

# With these, twelve students make each mistake of both problems, one of them in a late hand-in.
DICE = 1511


@pytest.mark.timeout(1200)  # half a minute on a quiet machine
def test_a_short_term_ends_with_the_marks_of_the_ledger(tmp_path):
    term = Term(tmp_path / "course", 12, (P1, P2), DICE)
    assert list(tell(term)) == []
    hand_ins = term.ledger.hand_ins
    assert all(term.ledger.made(name, wrong) for name in (P1, P2) for wrong in MISTAKES[name])
    assert any(one.wrong and one.late > 0 and not one.damaged for one in hand_ins.values())
    # A ledger that is wrong, and a comparison that sees so.
    one = next(one for one in hand_ins.values() if one.read and not one.damaged)
    one.read += 0.5
    assert any("score" in line for line in differences.of_the_gradebook(term))
    one.read -= 0.5
    student, *_ = term.ledger.made(P2, MISTAKES[P2][0])
    hand_ins[student, P2] = replace(hand_ins[student, P2], wrong=None)
    assert any(student in line for line in differences.of_the_gradebook(term))
    assert any("not skew" in line for line in differences.of_the_report(term, P2))
