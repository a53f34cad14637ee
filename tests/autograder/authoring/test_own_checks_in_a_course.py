"""Checks of the course's own in a whole course: released, judged, and given out in numbers."""

import json
import shutil
import subprocess
import sys
import sysconfig

import nbformat
import pytest

from autograder.bundle.archive import write_bundle
from autograder.nbgrader_glue import write_problem
from autograder.pipeline.run import grade_all
from autograder.problems import own_checks
from autograder.problems.own_checks import files_of
from tests.autograder.authoring.my_cart import (
    CART,
    COUPLED,
    HALF,
    HELD,
    MISTAKES,
    RIGHT,
    WRONG,
    with_answers,
    written,
)
from tests.autograder.courses import P3, new_course, run, submit
from tests.autograder.courses import release as released_p3


@pytest.fixture(scope="module")
def course(tmp_path_factory):
    """A course with a problem of its own and a mistake added to p3. Ada is right, Bob is not."""
    root = new_course(tmp_path_factory.mktemp("own") / "course")
    (root / "lessons").mkdir()
    written(root, "my-cart", CART)
    written(root, P3, MISTAKES)
    run(root, "autograder", "new-problem", "my-cart")
    model = with_answers(root / "solutions" / "my-cart" / "my-cart.ipynb", RIGHT, COUPLED)
    run(root, "nbgrader", "generate_assignment", "my-cart")
    for student in ("ada", "bob"):
        handed_in = nbformat.read(root / "course" / "release" / "my-cart" / "my-cart.ipynb", 4)
        for cell, answer in zip(handed_in.cells, model.cells, strict=True):
            if answer.metadata.get("nbgrader", {}).get("grade_id", "").startswith("answer-"):
                cell.source = answer.source
                if student == "bob":
                    cell.source = cell.source.replace(RIGHT, WRONG)
        to = root / "course" / "submitted" / student / "my-cart"
        to.mkdir(parents=True)
        nbformat.write(handed_in, to / "my-cart.ipynb")
    notebook = released_p3(root)
    for cell in notebook.cells:
        if cell.metadata.get("nbgrader", {}).get("grade_id") == "answer-M":
            cell.source = "def M(q, pend):\n    return np.array([[pend.I / 2]])"
    submit(root, "bob", notebook)
    return root


def cards(root, student, assignment):
    path = root / "course" / "autograded" / student / assignment / f"{assignment}.ipynb"
    return [
        "".join(output["data"]["text/plain"])
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]
        for output in cell.get("outputs", [])
        if "text/plain" in output.get("data", {})
    ]


def test_nothing_of_the_file_is_handed_out(course):
    files = [path for path in (course / "course" / "release").rglob("*") if path.is_file()]
    assert sorted(path.name for path in files if path.parent.name == "my-cart") == ["my-cart.ipynb"]
    assert not any(b"arm.mt + arm.ml" in path.read_bytes() for path in files)


def test_both_ways_to_grade_judge_by_it_and_name_its_mistakes(course):
    for command in (
        ("autograder", "grade", "my-cart", "--jobs", "1"),
        ("nbgrader", "autograde", "my-cart", "--force"),
    ):
        run(course, *command)
        ada, bob = (" ".join(cards(course, name, "my-cart")) for name in ("ada", "bob"))
        assert "my-cart-small_swing: correct" in ada
        assert "my-cart-small_swing: incorrect" in bob
        assert HELD in " ".join(bob.split())
    run(course, "autograder", "grade", P3, "--jobs", "1")
    assert HALF in " ".join("\n".join(cards(course, "bob", P3)).split())
    run(course, "nbgrader", "generate_feedback", "my-cart")
    page = course / "course" / "feedback" / "bob" / "my-cart" / "my-cart.html"
    assert "trolley which stands still" in " ".join(page.read_text(encoding="utf-8").split())
    run(course, "autograder", "report", "my-cart")
    report = course / "course" / "report" / "my-cart.html"
    told = " ".join(report.read_text(encoding="utf-8").split())
    assert "trolley which stands still" in told
    assert "trolley held" not in told  # the mistake's name


@pytest.mark.parametrize(("student", "wrong"), [("ada", False), ("bob", True)])
def test_validate_judges_by_the_courses_own_check(course, student, wrong):
    notebook = course / "course" / "submitted" / student / "my-cart" / "my-cart.ipynb"
    said = run(course, "nbgrader", "validate", str(notebook))
    assert ("my-cart" in said and "incorrect" in said) == wrong
    assert "UnknownCheckError" not in said


def test_a_changed_file_is_judged_anew_and_a_broken_one_grades_nobody(course):
    path = course / "checks" / "my-cart.py"
    run(course, "autograder", "grade", "my-cart", "--jobs", "1")  # others than nbgrader's stay
    assert "0 graded, 2 unchanged" in run(course, "autograder", "grade", "my-cart", "--jobs", "1")
    path.write_text(CART.replace("frequency is that", "swing is that"), encoding="utf-8")
    assert "2 graded" in run(course, "autograder", "grade", "my-cart", "--jobs", "1")
    assert "swing is that" in " ".join("\n".join(cards(course, "bob", "my-cart")).split())
    path.write_text(f"{CART}\nx = y\n", encoding="utf-8")
    said = run(course, "autograder", "grade", "my-cart", "--jobs", "1", status=2)
    assert f"checks/my-cart.py, line {len(CART.splitlines()) + 2}: NameError" in said
    said = run(course, "nbgrader", "autograde", "my-cart", "--force", "--student", "bob")
    assert "my-cart-M could not be judged: checks/my-cart.py, line" in said
    path.write_text(CART, encoding="utf-8")


def test_the_sandbox_does_not_see_it(course, needs):
    needs("bubblewrap")  # without its walls, a student's code may read what the grader may
    notebook = released_p3(course)
    for cell in notebook.cells:
        if cell.metadata.get("nbgrader", {}).get("grade_id") == "answer-M":
            cell.source = (
                "import os, sys\nfound = [p for top in ('/', '..', sys.prefix) for p, _, names in "
                "os.walk(top) if 'my-cart.py' in names]\nprint('found', found, 'course_checks' in "
                "str(sys.modules))"
            )
    submit(course, "eve", notebook)
    grade_all(course, P3, _recorder, 1)
    path = course / "course" / "autograded" / "eve" / P3 / f"{P3}.ipynb"
    assert "found [] False" in path.read_text(encoding="utf-8")


def _recorder(root, assignment):
    from autograder.nbgrader_glue.recorder import Recorder

    return Recorder(root, assignment)


def test_a_class_gets_it_in_numbers(course, tmp_path):
    """The student's package, installed, names the course's mistakes without its formulas."""
    made = write_bundle(course, ["my-cart", P3], tmp_path / "archive", write_problem)
    shutil.unpack_archive(made.path, tmp_path)
    (wheel,) = (tmp_path / "armdyn").glob("*.whl")
    package = tmp_path / "package"
    shutil.unpack_archive(wheel, package, "zip")
    text = "\n".join(
        path.read_text(encoding="utf-8", errors="replace") for path in package.rglob("*.py")
    )
    assert "course_checks" in "\n".join(map(str, package.rglob("*.py")))
    assert "arm.ml" not in text
    assert "trolley held" not in text
    code = f"""
from autograder import check
import autograder, numpy as np
print(autograder.__file__)
def small_swing(arm):
    {WRONG}
def M(q, arm):
    {COUPLED}
def tried(id):
    try:
        check(id)
    except Exception as error:
        print(type(error).__name__)
tried("my-cart-small_swing")
tried("my-cart-M")
def M(q, pend):
    return np.array([[pend.I / 2]])
tried("p3-M")
"""
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c",
         f"import sys; sys.path[:0] = [{str(package)!r}, {sysconfig.get_paths()['purelib']!r}]\n{code}"],
        cwd=tmp_path, capture_output=True, text=True, check=True, timeout=300,
    )  # fmt: skip
    said = " ".join(done.stdout.split())
    assert str(package) in said
    assert HELD in said
    assert "my-cart-M: correct" in said
    assert HALF in said


def test_the_right_file_belongs_to_each_problem(course):
    assert list(files_of(course / "solutions" / "my-cart")) == ["checks/my-cart.py"]
    assert files_of(course / "solutions" / "p1-inertia") == {}
    assert own_checks.course_of(course / "solutions" / "my-cart") == course
