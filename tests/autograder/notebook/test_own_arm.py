"""A student's own arm in grading: drawn from the student and the released notebook alone."""

import copy

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_notebook, new_output

from autograder.judging.verdict import State
from autograder.notebook.grade import grade
from autograder.notebook.own_arm import drawn_for, set_up
from autograder.problems import arm_card
from autograder.problems.material.conventions import BOOK, FAMILY, drawn, folded
from tests.autograder.course_problems import problem, states
from tests.submissions import own_arms
from tests.submissions.answers import cell_of

YEAR = 2026
# A student of each member of the family.
STUDENTS = {drawn(f"s{number}", YEAR): f"s{number}" for number in range(300)}


def graded(name, own, student, edit=lambda notebook: None, source=None):
    notebook = own_arms.right(problem(name).release, name, own)
    edit(notebook)
    return grade(notebook, source or problem(name).source, "seed", student=student)


def as_jupyter_saves(output):
    """With its keys in the order of the alphabet, so that text/html comes before text/plain."""
    notebook = new_notebook(cells=[new_code_cell("own", outputs=[output])])
    return nbformat.reads(nbformat.writes(notebook), 4).cells[0].outputs[0]


def all_for(everybody: bool, name="p1-inertia"):
    """The source with one arm for all, or with a family, by one line."""
    source = copy.deepcopy(problem(name).source)
    cell = cell_of(source, f"{name[:2]}-setup")
    cell.source = cell.source.replace(", same_for_all=True", "")
    if everybody:
        cell.source = cell.source.replace("year=2026", "year=2026, same_for_all=True")
    return source


@pytest.mark.parametrize("name", own_arms.PROBLEMS)
def test_a_problem_asks_for_a_family_in_its_set_up_cell(name):
    asked = set_up(problem(name).source)
    assert (asked.problem, asked.year) == (name[:2], YEAR)
    assert asked.cell == f"{name[:2]}-setup"


def test_other_problems_do_not():
    assert set_up(problem("p3-pendulum").source) is None
    assert drawn_for(problem("p3-pendulum").source, "ada") is None


@pytest.mark.parametrize("name", own_arms.PROBLEMS)
@pytest.mark.parametrize("own", [FAMILY[6], FAMILY[9], FAMILY[15]], ids=lambda own: own.name)
def test_the_right_answers_of_the_own_arm_are_correct_and_no_cell_fails(name, own):
    result = graded(name, own, STUDENTS[own], source=all_for(False, name))
    assert set(states(result).values()) == {State.CORRECT}
    assert [note for note in result.notes if "set" in note] == []
    for cell in result.notebook.cells:
        for output in cell.get("outputs", []):
            assert output.output_type != "error", cell.source
            assert output.get("name") != "stderr", output.text
    shown = cell_of(result.notebook, f"{name[:2]}-setup").outputs[-1].data
    assert f"This is the arm of {STUDENTS[own]}." in shown["text/plain"]
    assert own.zero_at[1] in shown["text/html"]


def test_gravity_from_jacobians_agrees_with_the_gradient_on_every_arm():
    for own in FAMILY[3::4]:
        result = graded("p4-gravity", own, STUDENTS[own], source=all_for(False, "p4-gravity"))
        (printed,) = cell_of(result.notebook, "p4-jacobians").outputs
        energy, jacobians = (line.partition(":")[2].split() for line in printed.text.splitlines())
        assert energy == jacobians


def test_two_students_have_two_arms_and_a_copy_is_named():
    mine, theirs = FAMILY[8], FAMILY[12]
    source = all_for(False)
    right = graded("p1-inertia", theirs, STUDENTS[theirs], source=source)
    copied = graded("p1-inertia", theirs, STUDENTS[mine], source=source)
    assert states(right)["p1-M"] is State.CORRECT
    assert states(copied)["p1-M"] is not State.CORRECT
    (said,) = copied.verdicts["p1-M"].diagnosis
    assert said.startswith("Your answer is right for an arm whose q2 is measured from the −y axis.")


@pytest.mark.parametrize(
    "claim",
    [
        'own_arm("p1", "{name}")',
        'from autograder import own_arm\nown = own_arm("p1", "{name}", arm=1, year=2026)',
        '__import__("autograder").lay_own_arm("p1", dict(turns=[[1, 0], [0, 1]], zeros=[0, 0], pull=0))',
    ],
)
def test_a_submission_that_claims_another_arm_is_judged_by_its_own(claim):
    mine, theirs = FAMILY[8], FAMILY[2]

    def edit(notebook):
        cell_of(notebook, "p1-setup").source += "\n" + claim.format(name=STUDENTS[theirs])
        notebook.cells.insert(0, new_code_cell(claim.format(name=STUDENTS[theirs])))

    result = graded("p1-inertia", theirs, STUDENTS[mine], edit, all_for(False))
    assert states(result)["p1-M"] is not State.CORRECT
    own = graded("p1-inertia", mine, STUDENTS[mine], edit, all_for(False))
    assert states(own)["p1-M"] is State.CORRECT


def test_a_line_in_the_released_notebook_gives_all_one_arm():
    mine = FAMILY[8]
    same, family = all_for(True), all_for(False)
    assert states(graded("p1-inertia", BOOK, STUDENTS[mine], source=same))["p1-M"] is State.CORRECT
    apart = graded("p1-inertia", BOOK, STUDENTS[mine], source=family)
    assert states(apart)["p1-M"] is not State.CORRECT
    # The switch of the submission is not looked at.
    edited = graded(
        "p1-inertia", BOOK, STUDENTS[mine],
        lambda notebook: notebook.cells.insert(0, new_code_cell("same_for_all = True")), family,
    )  # fmt: skip
    assert states(edited)["p1-M"] is not State.CORRECT


@pytest.mark.parametrize(
    "call", ["own_arm(problem)", 'own_arm("p3")', 'own_arm("p1", year=this_year)', "own_arm()"]
)
def test_a_set_up_cell_that_cannot_be_read_is_told_to_the_instructor(call):
    source = all_for(False)
    cell = cell_of(source, "p1-setup")
    cell.source = cell.source.replace('own_arm("p1", arm=cutter, year=2026)', call)
    with pytest.raises(ValueError, match=r"p1-setup: own_arm needs a problem \(p1, p2, p4, p5\)"):
        drawn_for(source, "ada")


@pytest.mark.parametrize(
    ("name", "noted"),
    [("j.doe", "the arm of j.doe"), (None, "the arm of the book"), ("  S{} ", "")],
)
@pytest.mark.parametrize("kept", [copy.deepcopy, as_jupyter_saves], ids=["in memory", "saved"])
def test_the_instructor_reads_where_the_student_saw_another_arm(name, noted, kept):
    mine = FAMILY[8]
    number = STUDENTS[mine].removeprefix("s")
    whose = f"the arm of {name.format(number).strip()}" if name else "the arm of the book"
    shown = arm_card.mimebundle(BOOK if name is None else FAMILY[3], whose, None, "")

    def edit(notebook):
        cell_of(notebook, "p1-setup").outputs = [kept(new_output("display_data", data=shown))]

    notes = graded("p1-inertia", mine, STUDENTS[mine], edit, all_for(False)).notes
    expected = f"p1-setup showed the student {noted}; judged was the arm of {STUDENTS[mine]}"
    assert list(notes) == ([expected] if noted else [])


def test_the_grader_takes_spaces_capitals_and_accents_as_the_student_sees_them():
    for typed, folder in [
        ("Ada  Lovelace", "ada lovelace"),
        (" ada\u00a0lovelace", "Ada Lovelace"),
        ("U\u0308nal", "\u00fcnal"),
    ]:
        assert drawn(typed, YEAR) == drawn(folder, YEAR)
        assert folded(typed) == folded(folder)
