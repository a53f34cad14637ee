"""Students' ids as folders may be called: each is graded or has a line of its own, on every way."""

import contextlib
import csv
import io
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from nbgrader.api import Gradebook
from nbgrader.converters import Autograde
from nbgrader.coursedir import CourseDirectory

from autograder.cli import main
from autograder.nbgrader_glue import names
from autograder.nbgrader_glue.grades import GradesExporter
from autograder.pipeline.alike import alike
from autograder.terminal import shown_name
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3, submit
from tests.submissions import p3_pendulum

# Unfit names, and what is said of them. Some are graded in the others' place where nobody looks.
UNFIT = {
    "a\nb": r"contains '\n', which no list can show",
    "red\x1b[31m": r"contains '\x1b', which no list can show",
    "\u202egpj": r"contains '\u202e', which no list can show",
    "b[1]": "contains [, which nbgrader takes for a pattern",
    "B[1]": "contains [, which nbgrader takes for a pattern",
    "b?": "contains ?, which nbgrader takes for a pattern",
    "*": "contains *, which nbgrader takes for a pattern",
    ".hidden": "starts with a dot, so nbgrader does not see it",
    "l" * 200: "has 200 characters; the gradebook takes 128 at most",
}
BESIDE = ["\x1b]0;data\x07.csv", "data[1].csv", "two\nlines.csv"]  # files of zoe's
if sys.platform == "linux":  # elsewhere a name is text
    UNFIT |= {os.fsdecode(b"caf\xe9"): "is not UTF-8"}
    BESIDE.append(os.fsdecode(b"donn\xe9es.csv"))
FIT = ["b1", "dom\\ain", '=1, "y" <i>z {0} %s #\'', "Jose\u0301 \u0634\u0643"]


def ours(root: Path, *arguments: str, status: int = 0) -> str:
    """What the `autograder` command printed; it must end with this status."""
    with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.chdir(root):
        assert main([*arguments]) == status
    return printed.getvalue()


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    root = courses.new_course(tmp_path_factory.mktemp("names") / "course")
    right = p3_pendulum.right(courses.release(root))
    for name in [*UNFIT, *FIT, "zoe"]:
        submit(root, name, right)
    for name in BESIDE:
        (root / "course" / "submitted" / "zoe" / P3 / name).touch()
    graded = ours(root, "grade", P3, "--jobs", "2", status=1)
    reported = ours(root, "report", P3)
    before = courses.rows(courses.database(root))
    # As an earlier version may have left them; and one student has no graded notebook yet.
    done = root / "course" / "autograded"
    for name in UNFIT:
        shutil.copytree(done / "zoe", done / name)
    shutil.rmtree(done / "zoe")
    autograded = courses.run(root, "nbgrader", "autograde", P3, status=1)
    feedback = courses.run(root, "nbgrader", "generate_feedback", P3, status=1)
    return SimpleNamespace(
        root=root, graded=graded, reported=reported, autograded=autograded, feedback=feedback,
        before=before,
    )  # fmt: skip


def test_a_fit_name_is_graded(course):
    all_of_them = len(FIT) + len(UNFIT) + 1
    assert course.reported.startswith(f"{len(FIT) + 1} of {all_of_them} graded, ")
    assert "the checks alone: mean 10, " in course.reported
    for name in FIT:
        assert re.search(rf"^{re.escape(name)} +10 of 15  6 correct", course.graded, re.MULTILINE)
    students = {dict(row)["id"] for row in course.before["student"]}
    assert students == {*FIT, "zoe"}
    done = course.root / "course" / "autograded"
    for name in [*FIT, "zoe"]:
        assert (done / name / P3 / NOTEBOOK).is_file()
    assert {path.name for path in (done / "zoe" / P3).iterdir()} >= {*BESIDE}


@pytest.mark.parametrize("name", UNFIT, ids=ascii)
def test_an_unfit_name_has_a_line_of_its_own(course, name):
    why = re.escape(f"the folder's name {UNFIT[name]}: rename the folder")
    line = f"^{re.escape(shown_name(name))} +could not be graded +{why}$"
    assert len(re.findall(line, course.graded, re.MULTILINE)) == 1
    page = (course.root / "course" / "report" / f"{P3}.html").read_text()
    assert f"the folder&#39;s name {UNFIT[name].replace(chr(39), '&#39;')}" in page
    for step, printed in (("submitted", course.autograded), ("autograded", course.feedback)):
        said = f"{shown_name(name)} was left out: the folder's name {UNFIT[name]}: rename the folder in"
        assert f"{said} course/{step}" in printed


def test_names_that_read_the_same_are_pointed_out(course):
    for name in ("b[1]", "B[1]"):
        assert f"looks like {name!a}: do these folders belong to one student?" in course.graded
    assert course.graded.count("looks like") == 2


@pytest.mark.parametrize("other", ["ADA é", "ada\u00a0e\u0301", " Ada É ", "\uff41da é"])
def test_ids_read_the_same_but_for_case_spaces_and_forms(other):
    assert alike(["ada é", "bob", other, "adae"]) == {"ada é": [other], other: ["ada é"]}


def test_no_name_stops_the_others(course):
    for name in [*FIT, "zoe"]:
        page = course.root / "course" / "feedback" / name / P3 / f"{P3}.html"
        assert "p3-M: correct" in page.read_text()
    pages = (course.root / "course" / "feedback").glob("*/*/*.html")
    assert len(list(pages)) == len(FIT) + 1
    assert courses.rows(courses.database(course.root)) == course.before


def test_no_name_reaches_the_terminal_as_more_than_text(course):
    assert r"\x1b]0;data\x07.csv ->" in course.autograded
    for printed in (course.graded, course.reported, course.autograded, course.feedback):
        assert printed.replace("\n", "").isprintable()


def test_no_name_is_a_formula_in_the_exported_table(course, tmp_path):
    table = tmp_path / "grades.csv"
    with Gradebook(courses.database(course.root)) as gradebook:
        GradesExporter(to=str(table)).export(gradebook)
    with table.open(newline="", encoding="utf-8") as file:
        rows = {row["student_id"]: row for row in csv.DictReader(file)}
    assert rows.keys() == {f"'{name}" if name[0] == "=" else name for name in [*FIT, "zoe"]}
    assert {row["score"] for row in rows.values()} == {"10.0"}


NAMES = st.sets(
    (st.text(max_size=20).map(lambda text: text.encode(errors="ignore"))
     | st.binary(max_size=20) | st.text("a*?[]\n.\\", max_size=4).map(str.encode))
    .filter(lambda name: name not in (b"", b".", b"..") and not {0, 47} & {*name}),
    max_size=6,
)  # fmt: skip


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere a name is text")
@settings(max_examples=25)
@given(NAMES)
@example({b"*", b"ab", b"a\n", b"a[b]", b".x"})
def test_nbgrader_is_left_with_exactly_the_fit_names(made):
    """It finds each one's own notebook, and reads from its path the name that the folder has."""
    with tempfile.TemporaryDirectory(prefix="names[1]-") as holder:
        root = Path(holder)
        for name in made:
            folder = root / "submitted" / os.fsdecode(name) / P3
            folder.mkdir(parents=True)
            (folder / NOTEBOOK).touch()
        course = CourseDirectory(root=str(root))
        found = names.folders(course, "submitted", "*", P3)
    assert sorted(found.values()) == sorted(map(os.fsdecode, made))
    with tempfile.TemporaryDirectory(prefix="names-") as holder:
        root = Path(holder)
        for name in [*made, b"zoe"]:
            folder = root / "submitted" / os.fsdecode(name) / P3
            folder.mkdir(parents=True, exist_ok=True)
            (folder / NOTEBOOK).touch()
        course = CourseDirectory(root=str(root), assignment_id=P3)
        converter = Autograde(coursedir=course)
        converter.log.disabled = True
        converter.init_notebooks()
        names.leave_out_unfit(converter)
        fit = {
            os.fsdecode(name) for name in made | {b"zoe"} if not names.refusal(os.fsdecode(name))
        }
        assert {str(root / "submitted" / name / P3): [str(root / "submitted" / name / P3 / NOTEBOOK)]
                for name in fit} == converter.assignments  # fmt: skip
        read = {converter.init_single_notebook_resources(path)["nbgrader"]["student"]
                for paths in converter.assignments.values() for path in paths}  # fmt: skip
        assert read == fit


@given(st.text())
def test_a_refusal_is_one_printable_line(name):
    assert names.refusal(name).isprintable()
