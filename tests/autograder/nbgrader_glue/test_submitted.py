"""What was handed in besides plain files, on both ways of grading; and the pages of the rest."""

import os
import shutil
from types import SimpleNamespace

import pytest
import sqlalchemy
from nbformat.v4 import new_markdown_cell

from autograder.nbgrader_glue.submitted import RefusedError, check
from autograder.notebook.version import stamp
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3, submit
from tests.autograder.nbgrader_glue.test_hostile_pages import live
from tests.submissions import p3_pendulum
from tests.submissions.hostile_pages import LIVE

NO_TIME = ("no_time", "no_text")  # graded, and told of
REFUSED = {
    "a_link": f"{NOTEBOOK} is a link out of the submission",
    "a_linked_file": "key.ipynb is a link out of the submission",
    "a_linked_folder": "key is a link out of the submission",
    "a_linked_submission": f"the folder {P3} is a link",
    "a_linked_student": "the folder a_linked_student is a link",
    "a_link_to_nothing": f"{NOTEBOOK} leads nowhere",
    "a_pipe": f"{NOTEBOOK} is a pipe, a device or the like",
    "of_last_year": f"{NOTEBOOK} is of another version of this problem (0000; the course has",
}
# nbgrader reads these itself, before anything of ours.
BATCH = {
    "a_pipe_beside": "data is a pipe, a device or the like",
    "a_pipe_of_time": "timestamp.txt is a pipe, a device or the like",
}


def hand_in(root, release):
    right = p3_pendulum.right(release)
    key = root / "solutions" / P3 / NOTEBOOK
    for student in [*REFUSED, *BATCH, *NO_TIME]:
        submit(root, student, right)
    at = {name: root / "course" / "submitted" / name / P3 for name in [*REFUSED, *BATCH, *NO_TIME]}

    for name, target in (("a_link", key), ("a_link_to_nothing", "nothing.ipynb")):
        (at[name] / NOTEBOOK).unlink()
        (at[name] / NOTEBOOK).symlink_to(target)
    (at["a_linked_file"] / "key.ipynb").symlink_to(key)
    (at["a_linked_folder"] / "key").symlink_to(key.parent)
    (at["a_pipe"] / NOTEBOOK).unlink()
    for name, pipe in (("a_pipe", NOTEBOOK), ("a_pipe_beside", "data"),
                       ("a_pipe_of_time", "timestamp.txt")):  # fmt: skip
        os.mkfifo(at[name] / pipe)
    older = p3_pendulum.right(release)
    stamp(older, P3, "0000", {})
    submit(root, "of_last_year", older)
    others = submit(root, "z_right", right, "2025-01-31 23:59:59 UTC").parent
    shutil.rmtree(at["a_linked_submission"])
    at["a_linked_submission"].symlink_to(others)
    shutil.rmtree(at["a_linked_student"].parent)
    at["a_linked_student"].parent.symlink_to(others.parent)
    (at["no_time"] / "timestamp.txt").write_text("never ever")
    (at["no_text"] / "timestamp.txt").write_bytes(b"\xff\xfe\x00")

    # Links within a submission are nobody's business.
    (others / "data").mkdir()
    (others / "data" / "same.ipynb").symlink_to("../" + NOTEBOOK)
    live_text = p3_pendulum.right(release)
    live_text.cells.insert(0, new_markdown_cell(LIVE))
    submit(root, "z_live", live_text)


def points(root) -> dict[str, float]:
    engine = sqlalchemy.create_engine(courses.database(root))
    with engine.connect() as connection:
        found = connection.execute(sqlalchemy.text(
            "SELECT a.student_id, SUM(g.auto_score) FROM grade g JOIN submitted_notebook n"
            " ON g.notebook_id = n.id JOIN submitted_assignment a ON n.assignment_id = a.id"
            " GROUP BY a.student_id"))  # fmt: skip
        scores = {student: score or 0 for student, score in found}
    engine.dispose()
    return scores


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("submitted") / "course")
    hand_in(root, courses.release(root))
    printed = courses.run(root, "autograder", "grade", P3, "--jobs", "2", status=1)
    lines = {line.split()[0]: " ".join(line.split()[1:]) for line in printed.splitlines() if line}
    return SimpleNamespace(root=root, lines=lines, printed=printed)


@pytest.fixture(scope="module")
def nbgrader_course(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("submitted") / "course")
    hand_in(root, courses.release(root))
    printed = courses.run(root, "nbgrader", "autograde", P3, status=1)
    return SimpleNamespace(root=root, printed=printed)


def nothing_for_the_refused(course, refused):
    all_points = sum(p3_pendulum.POINTS.values())
    scores = points(course.root)
    right = {"z_right", "z_live", *NO_TIME}
    assert {scores[name] for name in right} == {all_points}
    assert {name: scores.get(name, 0) for name in refused} == dict.fromkeys(refused, 0)
    graded = (course.root / "course" / "autograded").glob(f"*/{P3}/*.ipynb")
    assert {path.parts[-3] for path in graded} == right


def test_only_plain_files_are_graded(course):
    nothing_for_the_refused(course, REFUSED | BATCH)


@pytest.mark.parametrize("name", REFUSED | BATCH)
def test_the_table_says_why(course, name):
    assert course.lines[name].startswith(f"could not be graded {(REFUSED | BATCH)[name]}")
    assert "Traceback" not in course.printed


@pytest.mark.parametrize(("name", "held"), [("no_time", "'never ever'"), ("no_text", "'��")])
def test_what_is_no_time_is_put_aside_and_told_of(course, nbgrader_course, name, held):
    for each in (course, nbgrader_course):
        folder = each.root / "course" / "submitted" / name / P3
        assert not (folder / "timestamp.txt").exists()
        assert (folder / "timestamp-original.txt").read_bytes() in (b"never ever", b"\xff\xfe\x00")
        assert f"timestamp.txt held no time that can be read ({held}" in each.printed
        assert "there is no penalty until you write the time into timestamp.txt" in each.printed


def test_nbgrader_itself_grades_only_plain_files(nbgrader_course):
    nothing_for_the_refused(nbgrader_course, REFUSED | BATCH)


@pytest.mark.parametrize("said", REFUSED.values(), ids=REFUSED)
def test_the_log_of_nbgrader_says_why(nbgrader_course, said):
    assert f"| ERROR] {said}" in nbgrader_course.printed
    assert "Traceback" not in nbgrader_course.printed


def test_the_feedback_page_runs_nothing(nbgrader_course):
    root = nbgrader_course.root
    courses.run(root, "nbgrader", "generate_feedback", P3, "--student", "z_live")
    page = (root / "course" / "feedback" / "z_live" / P3 / f"{P3}.html").read_text()
    assert "full marks" in page
    assert live(page) == []
    assert 'data-state="correct"' in page  # the cards stay


def test_a_course_may_lie_behind_a_link(tmp_path):
    folder = tmp_path / "disk" / "submitted" / "bitdiddle" / P3
    folder.mkdir(parents=True)
    (folder / NOTEBOOK).touch()
    (tmp_path / "course").symlink_to(tmp_path / "disk")
    top = tmp_path / "course" / "submitted"
    check(top / "bitdiddle" / P3, top)
    (folder / "out").symlink_to(tmp_path)
    with pytest.raises(RefusedError, match=r"^out is a link"):
        check(top / "bitdiddle" / P3, top)
