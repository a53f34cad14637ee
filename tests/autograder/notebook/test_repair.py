"""Repair: whatever a student does to the released notebook, its graded cells are right afterwards."""

import copy
import html
import re
import sys
from collections import Counter

import nbformat
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_raw_cell

from autograder.nbgrader_glue.markdown import markdown2html
from autograder.notebook.form import NEW_CELL
from autograder.notebook.letter import letter
from autograder.notebook.recognise import grade_id
from autograder.notebook.released import TEXT_STUB, released
from autograder.notebook.repair import MOST_NOTES, is_locked, repair
from tests.autograder.course_problems import NAMES, problem
from tests.submissions import p3_pendulum
from tests.submissions.answers import blank, cell_of

P3 = "p3-pendulum"
SOURCE = problem(P3).source
CHANGED = (
    "the text of {} had been changed; the original was put back, and the changed text runs in a cell "
    "of its own before it"
)
BELOW = "p3-derivation has no answer; it may be in the student's own cell below"
KNOWN = {grade_id(cell): cell for cell in SOURCE.cells if grade_id(cell)}
INDEX = st.integers(0, 99)
EDITS = st.one_of(
    st.tuples(
        st.sampled_from(["delete", "strip", "rename", "grow", "invent", "unhook", "break"]), INDEX
    ),
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
            case "rename":
                cell.id = f"new-{number}"
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

    texts = "\n".join(cell.source for cell in mended.cells)
    for cell in submission.cells:  # nothing that a student wrote is lost
        assert cell.source in texts

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


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
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
    missing = [f"{name} was missing; it was put back" for name in KNOWN]
    assert notes == [*missing, BELOW.replace("cell below", "cell above")]
    # Below what it needs, and above what looks at it.
    names = [grade_id(cell) for cell in mended.cells]
    assert names == [None, "p3-setup", None, *list(KNOWN)[1:]]
    assert mended.cells[2].source == "mine"


def test_notes_say_what_was_mended(release):
    notes = repair(p3_pendulum.mangled(release), SOURCE)[1]
    assert Counter(notes) == Counter(
        [
            "p3-M was there more than once; the last one counts",
            "answer-M was there more than once; the last one counts",
            "p3-g_vec was missing; it was put back",
            "the nbgrader settings of p3-C had been changed; they were put back",
            "p3-lagrangian had been made a markdown cell; it is a code cell again",
            "answer-small_angle_frequency had lost its nbgrader settings; they were put back",
            CHANGED.format("p3-inertia_about_pivot"),
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
    assert mended.cells[1].source == "first"
    assert notes == ["answer-M was there more than once; the last one counts"] * 2


def below(notebook, name, *cells):
    """A notebook with these cells below the one with a grade_id."""
    notebook = copy.deepcopy(notebook)
    at = notebook.cells.index(cell_of(notebook, name)) + 1
    notebook.cells[at:at] = cells
    return notebook


COPIES_OF_TWO = [
    # What each of the copies of an answer holds, in order; which of them counts.
    (("given", "mine"), 1, "the last one"),
    (("mine", "given"), 0, "the one with an answer"),
    (("mine", ""), 0, "the one with an answer"),
    (("mine", "other", "given"), 1, "the one with an answer"),
    (("given", "given"), 1, "the last one"),
]


@pytest.mark.parametrize("part", [None, "settings"])
@pytest.mark.parametrize(("texts", "counts", "said"), COPIES_OF_TWO)
@pytest.mark.parametrize("name", ["answer-M", "p3-derivation"])
def test_of_several_copies_the_one_with_an_answer_counts(release, name, texts, counts, said, part):
    first = cell_of(release, name)
    made = [copy.deepcopy(first) for _ in texts]
    for cell, text in zip(made, texts, strict=True):
        cell.source = first.source if text == "given" else text
    submission = below(release, name, *made)
    submission.cells.remove(cell_of(submission, name))
    mended, notes = repair(lost(submission, part) if part else submission, SOURCE)
    at = [cell.source for cell in mended.cells].index(made[0].source)
    ours = mended.cells[at : at + len(texts)]
    assert [grade_id(cell) for cell in ours] == [
        name if index == counts else None for index in range(len(texts))
    ]
    doubled = f"{name} was there more than once; {said} counts"
    assert notes.count(doubled) == len(texts) - 1
    # A stub below the answer would stand for it when the notebook runs.
    ran = [cell.source for cell in ours if cell.cell_type == "code"]
    assert (
        name != "answer-M"
        or ran == [text for text in texts if text in ("mine", "other")]
        or (set(texts) == {"given"} and len(ran) == 1)
    )


def test_a_picture_makes_a_copy_an_answer(release):
    copied = copy.deepcopy(cell_of(release, "p3-derivation"))
    copied.attachments = PICTURE
    submission = copy.deepcopy(release)
    submission.cells.insert(0, copied)
    mended, notes = repair(submission, SOURCE)
    assert "p3-derivation was there more than once; the one with an answer counts" in notes
    assert cell_of(mended, "p3-derivation").attachments == PICTURE


@pytest.mark.parametrize("deleted", [["p3-M"], ["answer-M", "p3-M"]])
def test_a_missing_check_comes_below_what_was_written_in_its_place(release, deleted):
    submission = below(release, "answer-M", new_code_cell("mine", id="mine"))
    submission.cells = [cell for cell in submission.cells if grade_id(cell) not in deleted]
    mended, _ = repair(submission, SOURCE)
    order = [cell.source if cell.source == "mine" else grade_id(cell) for cell in mended.cells]
    assert order.index("mine") < order.index("p3-M") < order.index("answer-C")
    assert [name for name in order if name in KNOWN] == list(KNOWN)


def test_the_last_check_comes_at_the_end_where_nothing_else_is(release):
    submission = copy.deepcopy(release)
    names = list(KNOWN)
    kept = names[: names.index("p3-M")]
    submission.cells = [cell for cell in submission.cells if grade_id(cell) in kept]
    submission.cells.append(new_code_cell("mine"))
    mended, _ = repair(submission, SOURCE)
    after = [grade_id(cell) for cell in mended.cells[mended.cells.index(submission.cells[-1]) :]]
    assert after == [None, *names[len(kept) :]]


def test_a_missing_cell_does_not_follow_one_that_was_moved_up(release):
    submission = copy.deepcopy(release)
    moved = cell_of(submission, "answer-C")
    submission.cells.remove(moved)
    submission.cells.insert(0, moved)
    submission.cells.remove(cell_of(submission, "p3-M"))
    names = [grade_id(cell) for cell in repair(submission, SOURCE)[0].cells]
    assert names.index("answer-M") < names.index("p3-M") < names.index("p3-C")


@pytest.mark.parametrize("settings", [{}, {"grade_id": ""}, {"grade": True}, "p3-M"])
def test_settings_that_name_no_cell_are_none(release, settings):
    submission = copy.deepcopy(release)
    cell_of(submission, "p3-M").metadata.nbgrader = settings
    mended, notes = repair(submission, SOURCE)
    assert notes == ["p3-M had lost its nbgrader settings; they were put back"]
    assert [grade_id(cell) for cell in mended.cells[1:]] == [grade_id(c) for c in release.cells]


def test_an_unknown_claim_is_taken_away_and_told(release):
    submission = copy.deepcopy(release)
    cell = copy.deepcopy(cell_of(submission, "p3-M"))
    cell.metadata.nbgrader.grade_id = "p9-bonus"
    submission.cells.append(cell)
    mended, notes = repair(submission, SOURCE)
    assert notes == ["a cell claims to be p9-bonus, which this assignment does not have"]
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
    assert notes[-1] == f"and {100 - MOST_NOTES} more notes like these"


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


def sources(notebook):
    return [cell.source for cell in notebook.cells]


@pytest.mark.parametrize("name", ["p3-setup", "p3-M"])
@pytest.mark.parametrize("kind", ["code", "markdown"])
def test_what_is_written_into_a_locked_cell_comes_before_it(release, name, kind):
    submission = copy.deepcopy(release)
    cell = cell_of(submission, name)
    cell.source += "\nimport math"
    changed, cell.cell_type = cell.source, kind
    mended, notes = repair(submission, SOURCE)
    assert CHANGED.format(name) in notes
    at = sources(mended).index(changed)
    assert mended.cells[at].cell_type == kind
    assert grade_id(mended.cells[at]) is None
    assert grade_id(mended.cells[at + 1]) == name
    assert mended.cells[at + 1].source == KNOWN[name].source
    assert letter(notes).source == mended.cells[0].source


@pytest.mark.parametrize(
    "edit_text", [lambda text: text.replace("\n", "\r\n"), lambda text: f"\n{text}  \n"]
)
def test_nothing_is_said_of_white_space_and_settings(release, edit_text):
    submission = copy.deepcopy(release)
    for cell in submission.cells:
        cell.metadata |= {"collapsed": True, "vscode": {"languageId": "python"}, "tags": ["x"]}
        if grade_id(cell) and is_locked(cell):
            cell.source = edit_text(cell.source)
    assert repair(submission, SOURCE)[1] == []


def test_an_emptied_locked_cell_is_told(release):
    submission = copy.deepcopy(release)
    cell_of(submission, "p3-M").source = " "
    mended, notes = repair(submission, SOURCE)
    assert notes == ["p3-M had been emptied; its text was put back"]
    assert len(mended.cells) == len(release.cells) + 1


def lost(notebook, *parts):
    """What an editor leaves that drops these parts of each cell."""
    notebook = copy.deepcopy(notebook)
    for cell in notebook.cells:
        if "id" in parts:
            cell.pop("id")
            notebook.nbformat_minor = 4
        if "id in its place" in parts:  # as Google's Colab
            cell.metadata["id"] = cell.pop("id")
            notebook.nbformat_minor = 0
        cell.metadata.pop("nbgrader", None)
    return notebook


@pytest.mark.parametrize("part", ["settings", "id in its place"])
def test_cells_without_settings_are_known_by_their_ids(release, part):
    right = p3_pendulum.right(release)
    mended, notes = repair(lost(right, part), SOURCE)
    assert [grade_id(cell) for cell in mended.cells[1:]] == [grade_id(c) for c in right.cells]
    assert cell_of(mended, "answer-M").source == cell_of(right, "answer-M").source
    assert notes == [
        f"{len(KNOWN)} cells had lost their nbgrader settings, which were put back: {', '.join(KNOWN)}"
    ]


def test_where_ids_are_lost_as_well_the_text_tells(release):
    right = p3_pendulum.right(release)
    mended, notes = repair(lost(right, "id"), SOURCE)
    order = [text for text in sources(mended) if text]
    for name in p3_pendulum.POINTS:  # each check stands behind its answer
        answer = cell_of(right, f"answer-{name.removeprefix('p3-')}").source
        assert order.index(answer) < order.index(KNOWN[name].source)
    assert "answer-M was missing; it was put back" in notes
    assert "p3-M was missing; it was put back" not in notes


def test_a_cell_with_settings_is_known_by_them_alone(release):
    submission = copy.deepcopy(release)
    other = new_code_cell("mine", id="answer-M")
    submission.cells.append(other)
    mended, notes = repair(submission, SOURCE)
    assert notes == [BELOW]
    assert grade_id(mended.cells[-1]) is None


def test_the_released_text_is_known_without_a_release():
    for name in NAMES:
        given = problem(name).release.cells
        assert [released(cell) for cell in problem(name).source.cells] == [
            cell.source for cell in given
        ]


PICTURE = {"photo.jpg": {"image/jpeg": "/9j/"}}
OWN = {
    "text": new_markdown_cell("K = ½ I q̇² because …"),
    "a_picture": new_markdown_cell("", attachments=PICTURE),
    "raw_text": new_raw_cell("L = K - P"),
    "code": new_code_cell("sp.diff(L, q)"),
}


def around(release, cell, *, below=0, text=None):
    """The release, its derivation as it was, or this text; a cell so far below it or above it."""
    submission = copy.deepcopy(release)
    answer = cell_of(submission, "p3-derivation")
    if text is not None:
        answer.source = text
    if cell is not None:
        at = submission.cells.index(answer) + (below if below > 0 else below + 1)
        submission.cells.insert(at, copy.deepcopy(cell))
    return submission


@pytest.mark.parametrize("kind", OWN)
@pytest.mark.parametrize(
    ("below", "where"), [(1, "cell below"), (2, "cell below"), (0, "cell above")]
)
def test_an_answer_beside_its_cell_is_left_for_a_person(release, kind, below, where):
    below = below or -1
    mended, notes = repair(around(release, OWN[kind], below=below), SOURCE)
    assert notes == [BELOW.replace("cell below", where)]
    text = cell_of(mended, "p3-derivation").source
    assert text.startswith(TEXT_STUB)
    assert f"the student's own {where}" in text


@pytest.mark.parametrize(
    "submission",
    [
        lambda release: release,
        lambda release: around(release, new_markdown_cell(" \n"), below=1),
        lambda release: around(release, OWN["text"], below=-3),  # above the problem's text
        lambda release: around(release, OWN["text"], below=1, text="my derivation"),
        lambda release: around(release, cell_of(release, "p3-derivation"), below=2),  # a copy
    ],
    ids=["untouched", "empty", "elsewhere", "answered", "copied"],
)
def test_an_answer_with_nothing_beside_it_stays_as_it_is(release, submission):
    submission = submission(release)
    mended, notes = repair(submission, SOURCE)
    assert BELOW not in notes
    assert cell_of(mended, "p3-derivation").source == cell_of(submission, "p3-derivation").source


def test_an_answer_in_the_cell_below_the_last_text_is_seen(release):
    submission = copy.deepcopy(release)
    submission.cells[-1].source = "My derivation: …"
    assert repair(submission, SOURCE)[1] == [BELOW]


def test_a_picture_attached_to_an_untouched_answer_is_seen(release):
    submission = copy.deepcopy(release)
    cell_of(submission, "p3-derivation").attachments = PICTURE
    mended, (note,) = repair(submission, SOURCE)
    assert note.endswith("own picture in this cell")
    assert cell_of(mended, "p3-derivation").attachments == PICTURE


def test_what_a_student_wrote_is_plain_text_in_the_letter():
    marks = "![x](javascript:1) <b> `a` *b* _c_ [d](e) | ~e~ # f\\"
    page = markdown2html({}, letter([marks]).source)
    assert html.unescape(re.search("<li>(.*?)</li>", page, re.DOTALL)[1]).strip() == marks


def test_a_document_beside_the_notebook_may_be_the_answer(release):
    documents = ["my_*derivation*.pdf", "other.jpg"]
    mended, (note,) = repair(release, SOURCE, documents=documents)
    assert (
        note
        == "p3-derivation has no answer; it may be in the student's own file my_*derivation*.pdf"
    )
    assert r"own file my\_\*derivation\*.pdf" in cell_of(mended, "p3-derivation").source
    assert repair(p3_pendulum.right(release), SOURCE, documents=documents)[1] == []


def answers_for_a_person(*names):
    """A source of nothing but answers that a person reads."""
    cells = [
        new_markdown_cell("### BEGIN SOLUTION\nyes\n### END SOLUTION", id=name) for name in names
    ]
    for cell, name in zip(cells, names, strict=True):
        cell.metadata.nbgrader = nbformat.NotebookNode(
            grade_id=name, grade=True, solution=True, locked=False, points=1
        )
    return new_notebook(cells=cells)


def untouched(source):
    notebook = copy.deepcopy(source)
    for cell in notebook.cells:
        cell.source = released(cell)
    return notebook


def test_the_letter_is_no_answer():
    source = answers_for_a_person("a")
    submission = untouched(source)
    submission.cells.append(copy.deepcopy(submission.cells[0]))
    mended, (note,) = repair(submission, source)
    assert note == "a was there more than once; the last one counts"
    mended.cells.pop(1)  # the copy, so that the letter stands directly above the answer
    again, notes = repair(mended, source)
    assert notes == []
    assert cell_of(again, "a").source == TEXT_STUB


def test_a_text_that_two_cells_have_tells_neither():
    source = answers_for_a_person("a", "b")
    _, notes = repair(lost(untouched(source), "id"), source)
    assert notes[:2] == ["a was missing; it was put back", "b was missing; it was put back"]


def test_an_id_does_not_count_against_other_settings(release):
    submission = copy.deepcopy(release)
    cell_of(submission, "answer-M").metadata.nbgrader = {"grade_id": "p9-made-up"}
    _, notes = repair(submission, SOURCE)
    assert "answer-M was missing; it was put back" in notes
