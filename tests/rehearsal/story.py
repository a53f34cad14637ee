"""The order of the term, and the places where the ledger is held against the course."""

from collections.abc import Iterator
from datetime import timedelta

from tests.autograder.lms.platforms import canvas_sheet, moodle_sheet
from tests.rehearsal import differences
from tests.rehearsal.term import ITS_CELL, P1, P2, P3, P4, Term


def tell(term: Term) -> Iterator[str]:
    """Go through the term; where course and ledger differ, in lines."""
    term.set_up()
    for name in term.names:
        yield from differences.of_the_text(term, name)
        term.hand_in(name)
        if name == P1:
            yield from _the_own_test_is_mended(term)
        term.grade(name)
        term.read_proofs(name)
    term.grade(term.names[0])  # once more, after the proofs: nothing of a person's is lost
    term.settle()
    yield from differences.of_the_gradebook(term)
    if P2 in term.names:
        for late in term.late_ones(P2)[:1]:
            term.extend(P2, late, timedelta(days=8))
        same, _ = term.hand_in_again(P2)
        yield from differences.of_the_gradebook(term)
        term.withdraw(same)
    if P4 in term.names:
        term.change_points(P4, "p4-g_vec", 4)
    yield from differences.of_the_gradebook(term)
    yield from _exported(term)
    term.run("nbgrader", "generate_feedback", term.names[0])
    for name in [one for one in (P1, P2, P4) if one in term.names]:
        term.run("autograder", "report", name)
        yield from differences.of_the_report(term, name)
    term.run("autograder", "report")
    term.run("autograder", "archive", "--anyway")  # some proofs are unread, and hand-ins damaged
    yield from differences.of_the_files(term, term.names[0])


def _the_own_test_is_mended(term: Term) -> Iterator[str]:
    """Nobody passes it at first: the lecturer sees so, mends it, and has all judged again."""
    points = term.ledger.points[P1]
    asked, points[ITS_CELL] = points[ITS_CELL], 0.0
    term.grade(P1)
    term.read_proofs(P1)
    term.settle()
    yield from differences.of_the_gradebook(term)
    points[ITS_CELL] = asked
    term.think_again(P1)
    term.mend_the_own_test()
    yield from differences.of_the_gradebook(term)


def _exported(term: Term) -> Iterator[str]:
    course = term.root / "course"
    term.run("autograder", "export")
    yield from differences.of_the_long_table(term, course / "marks.csv")
    term.run("autograder", "export", "--wide", "--to", "wide.csv")
    yield from differences.of_the_wide_table(term, term.root / "wide.csv")
    if P3 in term.names:
        rows = [
            {"number": one.number, "name": one.name, "email": one.email} for one in term.students
        ]
        sheet = moodle_sheet(term.root / "worksheet.csv", rows)
        command = ["autograder", "export", P3, "--for", "moodle", "--sheet", str(sheet)]
        term.run(*command, "--to", "filled-moodle.csv")
        filled = term.root / "filled-moodle.csv"
        yield from differences.of_a_sheet(term, filled, P3, "Identifier", "Grade")
    if P4 in term.names:
        rows = [{"name": f"{one.last}, {one.first}", "number": one.number} for one in term.students]
        title = f"{P4} (77)"
        sheet = canvas_sheet(term.root / "book.csv", rows, {title: "16"})
        command = ["autograder", "export", P4, "--for", "canvas", "--sheet", str(sheet)]
        term.run(*command, "--to", "filled-canvas.csv")
        yield from differences.of_a_sheet(term, term.root / "filled-canvas.csv", P4, "ID", title)
