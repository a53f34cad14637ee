"""Every mistake of every check, as a student would type it: it is named, and by its own sentence."""

import fnmatch
from collections import Counter

import pytest

from autograder.judging.verdict import State
from autograder.problems import CHECKS
from tests.autograder.every_mutant import assert_each_is_found
from tests.autograder.problems.row import Row, names_in, verdict_on
from tests.autograder.problems.tables import ROWS
from tests.autograder.verdicts import sentences

GENERATED = [check_id for check_id, check in CHECKS.items() if check.catalogue]
FEW = 15


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_a_wrong_answer_shows_its_mistake(row: Row):
    """Exactly these mistakes, their sentences, the credit left, and a worst case with its unit."""
    verdict = verdict_on(row)
    assert names_in(verdict) == row.names, verdict.diagnosis
    assert verdict.diagnosis == sentences(row.check, *row.names)
    assert abs(verdict.credit - row.credit) < 1e-12
    assert verdict.state is (State.PARTLY_CORRECT if row.credit else State.INCORRECT)
    check = CHECKS[row.check]
    assert f"{check.name}(" in verdict.witness.call
    met = [row_of.met for row_of in verdict.rows]
    criterion = check.criteria[met.index(False)]
    if criterion.is_truth:
        truths = ("True; the right answer is False", "False; the right answer is True",
                  f"a result for which “{criterion.text}” has the answer no")  # fmt: skip
        assert verdict.witness.returned.startswith(truths)
    else:
        assert criterion.unit in verdict.witness.off


@pytest.mark.parametrize("check_id", CHECKS)
def test_every_mistake_has_a_row(check_id):
    alone = {row.names for row in ROWS if row.check == check_id}
    missing = [m.name for m in CHECKS[check_id].mistakes if (m.name,) not in alone]
    assert not missing, f"no row of a table.py shows these mistakes of {check_id}: {missing}"


@pytest.mark.parametrize("check_id", CHECKS)
def test_the_mistakes_of_a_check_have_different_names(check_id):
    """A row finds its mistake by the name, and so does a reader of the class report."""
    counts = Counter(mistake.name for mistake in CHECKS[check_id].known_mistakes)
    assert max(counts.values(), default=1) == 1, counts.most_common(3)


@pytest.mark.parametrize("check_id", GENERATED)
def test_some_mutants_are_found_beside_the_written_mistakes(check_id):
    assert_each_is_found(CHECKS[check_id], FEW)


@pytest.mark.long
@pytest.mark.parametrize("check_id", GENERATED)
def test_each_mutant_is_found_beside_the_written_mistakes(check_id):
    assert_each_is_found(CHECKS[check_id], None)


@pytest.mark.parametrize("check_id", GENERATED)
def test_every_sentence_is_said_of_a_mutant(check_id):
    """A row that fits none is mistyped; one that is never the most specific says nothing."""
    catalogue = CHECKS[check_id].catalogue
    names = [mistake.name for mistake in catalogue.mistakes()]
    assert not [row for row in catalogue.rows if not fnmatch.filter(names, row)]
    said = {mistake.sentence for mistake in catalogue.mistakes()}
    assert not [row for row, sentence in catalogue.rows.items() if sentence not in said]
