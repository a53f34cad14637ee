"""A short term; `make rehearse` is the whole one."""

from tests.rehearsal import differences
from tests.rehearsal.story import tell
from tests.rehearsal.term import P1, P2, Term


def test_a_short_term_ends_with_the_marks_of_the_ledger(tmp_path):
    term = Term(tmp_path / "course", 12, (P1, P2))
    assert list(tell(term)) == []
    one = next(one for one in term.ledger.hand_ins.values() if one.read and not one.damaged)
    one.read += 0.5  # a ledger that is wrong, and a comparison that sees so
    assert any("score" in line for line in differences.of_the_gradebook(term))
