"""The course as an instructor runs it: nbgrader's own commands, from a folder of the course's files.

One course is set up for the whole file. One student works through the exchange; the others' notebooks
are put where `nbgrader collect` would put them.
"""

import csv
import getpass
import html
import json
import re
import shutil
from pathlib import Path

import nbformat
import pytest
from nbgrader.api import Gradebook

from autograder.nbgrader_glue import handed_in
from tests.autograder import courses
from tests.autograder.course_problems import problem, without_plots
from tests.autograder.verdicts import sentences
from tests.submissions import p3_pendulum
from tests.submissions.dressed import dressed
from tests.submissions.p3_pendulum import BAD_ANSWERS, POINTS

ROOT = Path(__file__).parents[3]
P3 = "p3-pendulum"
NOTEBOOK = f"{P3}/{P3}.ipynb"
WHOLE = ("right", "wrong", "partly_right", "blank", "crashing", "mangled")
NOTHING = dict.fromkeys(POINTS, 0.0)
# One of the faulty answers; test_grade.py hands in them all.
FAULTY, SAID_OF_IT = BAD_ANSWERS["syntax_error"]


class Course:
    """A course folder on which nbgrader is run; p3 is without its figures."""

    def __init__(self, root: Path):
        self.root = root
        shutil.copy(ROOT / "nbgrader_config.py", root)
        shutil.copytree(ROOT / "solutions", root / "solutions")
        nbformat.write(without_plots(problem(P3).source), root / "solutions" / NOTEBOOK)

    def nbgrader(self, *arguments: str, status: int = 0) -> str:
        """What the command printed; it must end with this status."""
        return courses.run(self.root, "nbgrader", *arguments, status=status)

    def notebook(self, path: str):
        return nbformat.read(self.root / path, as_version=4)

    def submit(self, student: str, notebook) -> None:
        folder = self.root / "course" / "submitted" / student / P3
        folder.mkdir(parents=True)
        # As it is: nbformat would put damaged cells right on writing.
        (folder / f"{P3}.ipynb").write_text(json.dumps(notebook))

    def scores(self, student: str) -> dict[str, float | None]:
        """The automatic score of each grade cell in the gradebook."""
        with Gradebook(f"sqlite:///{self.root / 'course' / 'gradebook.db'}") as gradebook:
            notebook = gradebook.find_submission_notebook(P3, P3, student)
            return {grade.name: grade.auto_score for grade in notebook.grades}

    def feedback(self, student: str) -> str:
        """The words on the student's feedback page."""
        page = (self.root / "course" / "feedback" / student / P3 / f"{P3}.html").read_text()
        words = html.unescape(re.sub(r"<[^>]+>", " ", page))
        return re.sub(r"\s+", " ", words)


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    course = Course(tmp_path_factory.mktemp("course"))
    course.nbgrader("generate_assignment", P3)
    course.nbgrader("release_assignment", P3)
    release = course.notebook(f"course/release/{NOTEBOOK}")

    course.nbgrader("fetch_assignment", P3)
    mine = course.root / "problems" / NOTEBOOK
    nbformat.write(p3_pendulum.right(course.notebook(f"problems/{NOTEBOOK}")), mine)
    course.validated = course.nbgrader("validate", str(mine))
    course.nbgrader("submit", P3)
    course.nbgrader("collect", P3)

    for name in WHOLE:
        made = p3_pendulum.CLASS[name](release)
        course.submit(name, dressed(made) if name == "right" else made)
    course.submit("faulty", p3_pendulum.right_but(release, g_vec=FAULTY))
    course.log = course.nbgrader("autograde", P3)
    course.nbgrader("generate_feedback", P3)
    course.nbgrader("export")
    course.release = release
    return course


def test_release_holds_no_solution_and_no_hidden_check(course):
    text = "\n".join(cell.source for cell in course.release.cells)
    assert "SOLUTION" not in text
    assert "HIDDEN" not in text
    assert "fresh" not in text
    assert text.count("raise NotImplementedError") == len(POINTS) + 1  # the lines of p3-L


def test_points_in_gradebook(course):
    with Gradebook(f"sqlite:///{course.root / 'course' / 'gradebook.db'}") as gradebook:
        cells = {cell.name: cell.max_score for cell in gradebook.find_notebook(P3, P3).grade_cells}
    assert cells == POINTS | {"p3-derivation": 5.0}


def test_student_through_the_exchange(course):
    assert "Success! Your notebook passes all the tests." in course.validated
    assert automatic(course.scores(getpass.getuser())) == POINTS


def test_what_the_exchange_puts_beside_a_submission_is_not_the_students(course):
    submitted = course.root / "course" / "submitted" / getpass.getuser() / P3
    assert len(list(submitted.glob("*.txt"))) == 2
    beside = handed_in.beside(submitted, course.root / "solutions" / P3, [], [])
    assert beside.documents == ()
    assert not [name for name in beside.laid if name.endswith(".txt")]


def automatic(scores):
    return {name: score for name, score in scores.items() if name in POINTS}


@pytest.mark.parametrize(
    ("student", "expected"),
    [
        ("right", POINTS),
        ("wrong", NOTHING),
        ("partly_right", POINTS | {"p3-lagrangian": 1.5, "p3-g_vec": 0.0}),
        ("blank", NOTHING),
        ("crashing", POINTS | {"p3-M": 0.0, "p3-g_vec": 0.0, "p3-C": 0.0}),
        ("mangled", POINTS),
        ("faulty", POINTS | {"p3-g_vec": 0.0}),
    ],
)
def test_scores(course, student, expected):
    assert automatic(course.scores(student)) == expected


@pytest.mark.parametrize(
    ("student", "phrases"),
    [
        ("right", ["p3-M: correct", "p3-lagrangian: correct", "p3-g_vec: correct"]),
        (
            "wrong",
            [
                *sentences(
                    "p3-lagrangian", "½ of K missing", "sine for cosine / the weight of the body"
                ),
                *sentences("p3-M", "parallel axis added / the rotation of the body / m / I"),
                *sentences("p3-C", "point-mass centrifugal term"),
                *sentences("p3-g_vec", "cosine for sine / the weight of the body"),
                *sentences("p3-inertia_about_pivot", "inertia about the centre of mass"),
                *sentences("p3-small_angle_frequency", "point mass"),
            ],
        ),
        (
            "partly_right",
            [
                "p3-lagrangian: partly correct (50 %)",
                "met: kinetic part of L (50 %)",
                "not met: potential part of L (50 %)",
                *sentences("p3-lagrangian", "energy for L"),
                *sentences("p3-g_vec", "cosine for sine / the weight of the body"),
            ],
        ),
        ("blank", [f"{name}: not attempted" for name in POINTS]),
        (
            "crashing",
            [
                "Python itself stopped while M(q, pend) was running",
                "this cell ended Python itself",
                "C(q, qd, pend) raised AttributeError",
                "pend.J * qd",
            ],
        ),
        ("mangled", [f"{name}: correct" for name in POINTS]),
        ("faulty", [SAID_OF_IT]),
    ],
)
def test_feedback_says(course, student, phrases):
    page = course.feedback(student)
    for phrase in phrases:
        assert phrase in page


def test_feedback_shows_no_hidden_input_and_no_reference(course):
    page = course.feedback("wrong")
    assert "Worst case: off by" in page
    assert "gave" not in page.partition("p3-g_vec: incorrect")[2].partition("Change your")[0]
    assert "autograder/problems" not in page
    assert "p3_pendulum.py" not in page
    assert "HIDDEN TESTS" not in page


def test_instructor_is_told_what_was_mended(course):
    for note in (
        "p3-M was there more than once; the last one counts",
        "answer-M was there more than once; the last one counts",
        "p3-g_vec was missing; it was put back",
        "the nbgrader settings of p3-C had been changed",
        "p3-lagrangian had been made a markdown cell",
        "answer-small_angle_frequency had lost its nbgrader settings; they were put back",
        "the text of p3-inertia_about_pivot had been changed; the original was put back",
    ):
        assert f"mangled: {note}" in course.log


def test_derivation_waits_for_a_person(course):
    assert course.scores("right")["p3-derivation"] is None
    assert course.scores("blank")["p3-derivation"] == 0


def test_export(course):
    with (course.root / "course" / "grades.csv").open(newline="") as file:
        rows = {row["student_id"]: row for row in csv.DictReader(file)}
    assert float(rows["right"]["score"]) == sum(POINTS.values())
    assert float(rows["partly_right"]["score"]) == sum(POINTS.values()) - 3.5
    assert float(rows["blank"]["score"]) == 0
    assert float(rows["right"]["max_score"]) == sum(POINTS.values()) + 5


def test_same_seed_gives_the_same_notebooks_again(course):
    path = f"course/autograded/wrong/{NOTEBOOK}"
    before = course.notebook(path)
    course.nbgrader("autograde", P3, "--student=wrong", "--force")
    assert course.notebook(path).cells == before.cells


def test_damaged_file_stops_nobody_else(course):
    for student in ("a_before", "z_after"):
        course.submit(student, p3_pendulum.right(course.release))
    folder = course.root / "course" / "submitted" / "damaged" / P3
    folder.mkdir(parents=True)
    (folder / f"{P3}.ipynb").write_text('{"cells": [')
    (folder.parents[1] / "z_after" / P3 / "timestamp.txt").write_text("2026-11-30 09:00 UTC")
    calendar = 'penalty = { percent-per-day = 10 }\n[p3-pendulum]\ndue = "2026-11-29"\n'
    (course.root / "course" / "calendar.toml").write_text(calendar)
    said = course.nbgrader("autograde", P3, status=1)
    assert "error processing assignment 'p3-pendulum' for student 'damaged'" in said
    assert "| ERROR] p3-pendulum.ipynb is not valid JSON: ask the student for it again\n" in said
    assert "Traceback" not in said
    # The calendar counts at once, also where somebody's work could not be graded.
    assert "late: 1 points off, and not 0" in said
    with Gradebook(f"sqlite:///{course.root / 'course' / 'gradebook.db'}") as gradebook:
        assert gradebook.find_submission(P3, "z_after").late_submission_penalty == 1.0
    assert (folder / f"{P3}.ipynb").read_text() == '{"cells": ['
    for student in ("a_before", "z_after"):
        assert automatic(course.scores(student)) == POINTS
