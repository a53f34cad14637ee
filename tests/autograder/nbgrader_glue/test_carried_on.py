"""The instructor's choice for errors carried on, in real grading runs."""

import re

import pytest

from autograder.cli import main
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3, run, submit
from tests.submissions import p3_pendulum

# The inertia of a point mass in L, and M as it follows; and a P twice as large.
LAGRANGIAN = "m*lc**2*qd**2/2 + 2*m*g*lc*sp.cos(q)"


@pytest.fixture
def course(tmp_path, monkeypatch):
    root = courses.new_course(tmp_path / "course")
    answer = p3_pendulum.function
    notebook = p3_pendulum.right_but(
        courses.release(root),
        lagrangian=answer("lagrangian", LAGRANGIAN),
        M=answer("M", "np.array([[pend.m * pend.lc**2]])"),
        g_vec=answer("g_vec", "2 * pend.m * pend.g * pend.lc * np.sin(q)"),
    )
    submit(root, "ada", notebook)
    monkeypatch.chdir(root)
    return root


def graded(capsys) -> str:
    assert main(["grade", P3, "--jobs", "1"]) == 0
    return " ".join(capsys.readouterr().out.split())


def choose(course, share: str) -> None:
    config = course / "nbgrader_config.py"
    text = re.sub("carried_on = .*", f"carried_on = {share}", config.read_text())
    config.write_text(text)


def test_the_course_chooses_what_an_error_carried_on_gives(course, capsys):
    M, g = p3_pendulum.POINTS["p3-M"], p3_pendulum.POINTS["p3-g_vec"]
    said = graded(capsys)
    half = float(said.split(" of 15")[0].split()[-1])
    page = (course / "course" / "autograded" / "ada" / P3 / NOTEBOOK).read_text()
    assert "this gives 50 % of these points" in page
    for share in (0, 1):
        choose(course, str(share))
        said = graded(capsys)
        assert "1 graded, 0 unchanged" in said  # another choice is another result
        assert f"ada {half + (share - 0.5) * (M + g):g} of 15" in said
    assert "1 unchanged" in graded(capsys)
    rows = courses.rows(courses.database(course))
    run(course, "nbgrader", "autograde", P3, "--force")
    assert courses.rows(courses.database(course))["grade"] == rows["grade"]


def test_a_share_that_is_none_is_refused(course, capsys):
    choose(course, "50")
    assert main(["grade", P3, "--jobs", "1"]) != 0
    printed = capsys.readouterr()
    assert "carried_on" in printed.out + printed.err
    assert "Traceback" not in printed.err
