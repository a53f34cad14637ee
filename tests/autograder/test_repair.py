"""Repair: whatever a student does to the released notebook, its graded cells are right afterwards."""

import copy
import sys
from collections import Counter

import nbformat
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from nbformat.v4 import new_code_cell, new_notebook

from autograder.repair import MOST_NOTES, NEW_CELL, grade_id, is_locked, repair
from tests.autograder.problems import problem
from tests.submissions import p3_pendulum
from tests.submissions.answers import blank, cell_of

P3 = "p3-pendulum"
SOURCE = problem(P3).source
KNOWN = {grade_id(cell): cell for cell in SOURCE.cells if grade_id(cell)}
INDEX = st.integers(0, 99)
EDITS = st.one_of(
    st.tuples(st.sampled_from(["delete", "strip", "grow", "invent", "unhook", "break"]), INDEX),
    st.tuples(st.sampled_from(["copy", "move", "swap"]), INDEX, INDEX),
    st.tuples(st.just("retype"), INDEX, st.sampled_from(["code", "markdown", "raw"])),
    st.tuples(st.just("points"), INDEX, st.integers(-5, 100)),
    st.tuples(
        st.just("flag"),
        INDEX,
        st.sampled_from(["grade", "solution", "locked", "task"]),
        st.booleans(),
    ),
    st.tuples(st.just("claim"), INDEX, st.sampled_from([*KNOWN, "p9-made-up"])),
)


@pytest.fixture(scope="module")
def release():
    return problem(P3).release


def edit(notebook, edits):
    """Each cell is marked, so that it is known again whatever happens to it."""
    notebook = copy.deepcopy(notebook)
    cells = notebook.cells
    for number, (what, at, *how) in enumerate(edits):
        if not cells:
            return notebook
        at %= len(cells)
        cell = cells[at]
        claims = cell.metadata.get("nbgrader")
        match what:
            case "delete":
                del cells[at]
            case "strip":
                cell.metadata.pop("nbgrader", None)
            case "grow":
                cell.source += f"\n# note {number}"
            case "invent":
                cell.metadata.nbgrader = nbformat.NotebookNode(grade=True, points=9, locked=False)
            case "unhook":
                cell.metadata.nbgrader = nbformat.NotebookNode(grade_id=[1], grade=True)
            case "break":
                cell.metadata.nbgrader = "p3-M"
            case "copy":
                cells.insert(how[0] % (len(cells) + 1), copy.deepcopy(cell))
            case "move":
                cells.insert(how[0] % len(cells), cells.pop(at))
            case "swap":
                other = cells[how[0] % len(cells)]
                cell.metadata, other.metadata = other.metadata, cell.metadata
            case "retype":
                cell.cell_type = how[0]
                for key in ("outputs", "execution_count", "attachments"):
                    cell.pop(key, None)
                if how[0] == "code":
                    cell.outputs, cell.execution_count = [], None
                elif number % 2:
                    cell.attachments = {}
            case "points" if isinstance(claims, dict):
                claims["points"] = how[0]
            case "flag" if isinstance(claims, dict):
                claims[how[0]] = how[1]
            case "claim" if isinstance(claims, dict):
                claims["grade_id"] = how[0]
    return notebook


@settings(
    max_examples=120,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(edits=st.lists(EDITS, max_size=12))
def test_graded_cells_are_right_after_any_edits(release, edits):
    submission = edit(p3_pendulum.right(release), edits)
    for number, cell in enumerate(submission.cells):
        cell.metadata["mark"] = number
    before = copy.deepcopy(submission)
    mended, _ = repair(submission, SOURCE)
    assert submission == before

    places = {}
    for index, cell in enumerate(mended.cells):
        name = grade_id(cell)
        assert name in KNOWN or "nbgrader" not in cell.metadata
        if name:
            assert name not in places
            places[name] = index
    assert places.keys() == KNOWN.keys()
    for name, original in KNOWN.items():
        cell = mended.cells[places[name]]
        claims = {k: v for k, v in cell.metadata["nbgrader"].items() if k != "checksum"}
        assert claims == original.metadata["nbgrader"]
        assert cell.cell_type == original.cell_type
        if is_locked(original):
            assert cell.source == original.source

    kept = [cell for cell in mended.cells if "mark" in cell.metadata]
    assert [cell.metadata["mark"] for cell in kept] == list(range(len(submission.cells)))
    for cell, was in zip(kept, submission.cells, strict=True):
        if not (grade_id(cell) and is_locked(cell)):
            assert cell.source == was.source

    again, notes = repair(mended, SOURCE)
    assert again == mended
    assert notes == []
    for cell in mended.cells:  # copies have one id between them, which is not ours to mend
        cell.id = str(mended.cells.index(cell))
        cell.metadata.pop("mark", None)
    nbformat.validate(mended)


@pytest.mark.parametrize("make", [blank, p3_pendulum.right, p3_pendulum.wrong])
def test_nothing_is_said_of_a_notebook_whose_answers_alone_changed(release, make):
    submission = make(release)
    mended, notes = repair(submission, SOURCE)
    assert notes == []
    assert len(mended.cells) == len(submission.cells)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(names=st.sets(st.sampled_from(sorted(KNOWN))))
def test_missing_cells_come_back_in_the_order_of_the_source(release, names):
    submission = copy.deepcopy(release)
    submission.cells = [cell for cell in submission.cells if grade_id(cell) not in names]
    mended, notes = repair(submission, SOURCE)
    assert [grade_id(cell) for cell in mended.cells if grade_id(cell)] == list(KNOWN)
    assert Counter(notes) == Counter(f"{name} was missing; it was put back" for name in names)
    assert all(not mended.cells[i].source for i, cell in enumerate(mended.cells)
               if grade_id(cell) in names and not is_locked(KNOWN[grade_id(cell)]))  # fmt: skip


def test_an_old_notebook_stays_valid(release):
    submission = copy.deepcopy(release)
    submission.nbformat_minor = 4
    submission.cells = submission.cells[:3]
    for cell in submission.cells:
        del cell["id"]
    nbformat.validate(repair(submission, SOURCE)[0])


@pytest.mark.parametrize("kind", NEW_CELL)
def test_an_empty_notebook_gets_all_cells(kind):
    empty = nbformat.v4.new_notebook(cells=[NEW_CELL[kind](source="mine")])
    mended, notes = repair(empty, SOURCE)
    assert len(notes) == len(KNOWN)
    assert mended.cells[-1].source == "mine"


def test_notes_say_what_was_mended(release):
    notes = repair(p3_pendulum.mangled(release), SOURCE)[1]
    assert Counter(notes) == Counter(
        [
            "p3-M was there more than once; the last one counts",
            "answer-M was there more than once; the last one counts",
            "p3-g_vec was missing; it was put back",
            "the nbgrader settings of p3-C had been changed",
            "p3-lagrangian had been made a markdown cell",
            "answer-small_angle_frequency was missing; it was put back",
        ]
    )


def test_of_several_copies_the_last_one_counts(release):
    submission = copy.deepcopy(release)
    for text in ("first", "second"):
        cell = copy.deepcopy(cell_of(submission, "answer-M"))
        cell.source = text
        submission.cells.insert(0 if text == "first" else len(submission.cells), cell)
    mended, notes = repair(submission, SOURCE)
    assert cell_of(mended, "answer-M").source == "second"
    assert mended.cells[0].source == "first"
    assert notes == ["answer-M was there more than once; the last one counts"] * 2


def test_an_unknown_claim_is_taken_away_and_told(release):
    submission = copy.deepcopy(release)
    cell = copy.deepcopy(cell_of(submission, "p3-M"))
    cell.metadata.nbgrader.grade_id = "p9-bonus"
    submission.cells.append(cell)
    mended, notes = repair(submission, SOURCE)
    assert notes == ["a cell that claims to be p9-bonus, which the source does not have"]
    assert "nbgrader" not in mended.cells[-1].metadata


def test_a_claim_cannot_pass_for_a_line_of_the_table():
    cell = new_code_cell("pass")
    forged = "x\nbitdiddle  15 of 15  6 correct\x1b[2J\u202e" + "y" * 9999
    cell.metadata.nbgrader = {"grade_id": forged}
    _, (note,) = repair(new_notebook(cells=[cell]), new_notebook())
    assert note.isprintable()
    assert len(note) < 150
    assert r"x\nbitdiddle  15 of 15" in note


def test_many_notes_are_counted():
    cells = [new_code_cell("pass") for _ in range(100)]
    for cell in cells:
        cell.metadata.nbgrader = {"grade_id": "p9-made-up"}
    _, notes = repair(new_notebook(cells=cells), new_notebook())
    assert len(notes) == MOST_NOTES + 1
    assert notes[-1] == f"and {100 - MOST_NOTES} more such notes"


def of_one_id(number):
    """Copies, beside cells that have the very ids that copies would get."""
    notebook = new_notebook()
    ids = ["same"] * number + [f"cell-{n}" for n in range(number)]
    notebook.cells = [new_code_cell("", id=name) for name in ids]
    return notebook


def test_copies_get_ids_that_no_other_cell_has():
    mended, _ = repair(of_one_id(50), new_notebook())
    ids = [cell.id for cell in mended.cells]
    assert len(set(ids)) == 100
    assert ids[0] == "same"
    assert ids[50:] == [f"cell-{n}" for n in range(50)]


def test_twice_the_copies_take_twice_the_work():
    def calls(number):
        notebook, made = of_one_id(number), Counter()
        sys.setprofile(lambda frame, event, of: made.update([event]))
        try:
            repair(notebook, new_notebook())
        finally:
            sys.setprofile(None)
        return made.total()

    assert calls(200) < 2.5 * calls(100)
