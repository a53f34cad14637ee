"""Files that are hardly notebooks, through nbgrader's own commands in one batch with right ones."""

import pytest

from tests.autograder.nbgrader_glue.test_nbgrader import NOTEBOOK, P3, Course, automatic
from tests.submissions import p3_pendulum
from tests.submissions.hostile_files import FILES, READABLE
from tests.submissions.p3_pendulum import POINTS

UNREADABLE = [name for name in FILES if name not in READABLE]


def student(name: str) -> str:
    """Students are graded in the order of their names: those who cannot be read one after the other."""
    return name if name in READABLE else f"unreadable_{name}"


# A right submission after each file that can be read, and after all the others.
NEXT = [f"{name}_next" for name in READABLE] + ["unreadable_z_next"]


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    course = Course(tmp_path_factory.mktemp("course"))
    course.nbgrader("generate_assignment", P3)
    release = course.notebook(f"course/release/{NOTEBOOK}")
    for name, make in FILES.items():
        folder = course.root / "course" / "submitted" / student(name) / P3
        folder.mkdir(parents=True)
        (folder / f"{P3}.ipynb").write_bytes(make(release))
    for name in NEXT:
        course.submit(name, p3_pendulum.right(release))
    course.log = course.nbgrader("autograde", P3, status=1)
    return course


@pytest.mark.parametrize("name", NEXT)
def test_the_next_submission_is_unharmed(course, name):
    assert automatic(course.scores(name)) == POINTS


@pytest.mark.parametrize("name", READABLE)
def test_what_can_be_read_earns_what_it_should(course, name):
    assert automatic(course.scores(name)) == READABLE[name]


@pytest.mark.parametrize("name", UNREADABLE)
def test_what_cannot_be_read_earns_nothing_and_is_named(course, name):
    assert f"error processing assignment '{P3}' for student '{student(name)}'" in course.log
    assert not (course.root / "course" / "autograded" / student(name) / NOTEBOOK).exists()


def test_the_instructor_is_told(course):
    for note in (
        "was damaged: its type, text or settings were missing",
        "duplicated_cells: p3-M was there more than once",
    ):
        assert note in course.log
