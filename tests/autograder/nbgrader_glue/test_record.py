"""`autograder grade` leaves what `nbgrader autograde` leaves: row for row, file for file."""

import copy
import json
import shutil
import warnings
from types import SimpleNamespace

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from nbgrader.api import Gradebook

from autograder.cli import main
from autograder.nbgrader_glue.by_hand import ByHand
from autograder.notebook import beside
from tests.autograder import courses
from tests.autograder.course_problems import problem
from tests.autograder.courses import NOTEBOOK, P3, files, rows, submit
from tests.submissions import p3_pendulum
from tests.submissions.answers import cell_of
from tests.submissions.p3_pendulum import function

WHOLE = ("right", "wrong", "partly_right", "blank", "crashing", "mangled")
ON_TIME, LATE = "2026-03-01 10:00:00 UTC", "2026-03-09 10:00:00 UTC"


SOURCE = problem(P3).source
COPY = "p3-pendulum-Copy1.ipynb"


def write(path, notebook):
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps(notebook))


def edited_locked_cells(folder, release):
    """`math` is imported in the set-up, an answer stands in its check's cell, a photo below its own."""
    notebook = p3_pendulum.right_but(
        release,
        M=cell_of(release, "answer-M").source,
        small_angle_frequency=function(
            "small_angle_frequency", "math.sqrt(pend.m * pend.g * pend.lc / pend.I)"
        ),
    )
    cell_of(notebook, "p3-setup").source += "\nimport math"
    check = cell_of(notebook, "p3-M")
    check.source = p3_pendulum.RIGHT["M"] + check.source
    raising = cell_of(notebook, "p3-C")
    raising.source = "1 / 0\n" + raising.source
    derivation = cell_of(notebook, "p3-derivation")
    derivation.source = cell_of(release, "p3-derivation").source
    photo = new_markdown_cell("![my derivation](attachment:photo.png)")
    photo.attachments = {"photo.png": {"image/png": "iVBORw0KGgo="}}
    notebook.cells.insert(notebook.cells.index(derivation) + 1, photo)
    write(folder / NOTEBOOK, notebook)


def copy_beside(folder, release):
    """A photo of a derivation as well, in no cell."""
    write(folder / COPY, p3_pendulum.right(release))
    (folder / "IMG 1234.jpg").write_bytes(b"\xff\xd8")


def damaged_beside(folder, release):
    copy_beside(folder, release)
    (folder / NOTEBOOK).write_text("")


def other_name(folder, release):
    """From an editor that keeps no settings of nbgrader's."""
    (folder / NOTEBOOK).unlink()
    notebook = copy.deepcopy(p3_pendulum.right(release))
    for cell in notebook.cells:
        cell.metadata = {}
    write(folder / "Pendulum final (2).ipynb", notebook)
    write(folder / "scratch.ipynb", new_notebook(cells=[new_markdown_cell("notes")]))


def two_other_names(folder, release):
    (folder / NOTEBOOK).unlink()
    for name in ("a.ipynb", "b.ipynb"):
        write(folder / name, p3_pendulum.right(release))


def in_a_subfolder(folder, release):
    (folder / NOTEBOOK).unlink()
    write(folder / "my work" / NOTEBOOK, p3_pendulum.right(release))


def as_an_archive(folder, release):
    (folder / NOTEBOOK).rename(folder / "p3-pendulum.zip")


def files_beside(folder, release):
    """A module, data, a script, names of the grader's own, and what is too large."""
    (folder / "my_gravity.py").write_text("def torque(q, p):\n    return p.m * p.g * p.lc * np_sin(q)\n"
                                          "from numpy import sin as np_sin\n")  # fmt: skip
    (folder / "my data").mkdir()
    (folder / "my data" / "ones.csv").write_text("1,1\n1,1\n")
    (folder / "script.py").write_text("half = 0.5\n")
    (folder / "runner.py").write_text("one = 1\n")
    (folder / "autograder.py").write_text("raise SystemExit('not me')\n")
    (folder / "numpy.py").write_text("raise SystemExit('nor me')\n")
    with (folder / "huge.npy").open("wb") as file:
        file.truncate(beside.MOST_BYTES + 1)
    notebook = p3_pendulum.right_but(
        release,
        lagrangian="%run script.py\nimport runner\n"
        + function("lagrangian", "half * 2 * sp.Rational(1, 2) * I * qd**2 + m*g*lc*sp.cos(q)"),
        g_vec="from my_gravity import torque\n" + function("g_vec", "torque(q, pend)"),
        M="ones = np.loadtxt('my data/ones.csv', delimiter=',')\n"
        + function("M", "ones[:1, :1] * pend.I * runner.one"),
        C="np.load('huge.npy')\n" + p3_pendulum.RIGHT["C"],
        inertia_about_pivot=function("inertia_about_pivot", "np.loadtxt('nowhere.csv')"),
    )
    write(folder / NOTEBOOK, notebook)


HAND_INS = {
    made.__name__: made
    for made in (edited_locked_cells, copy_beside, damaged_beside, other_name, two_other_names,
                 in_a_subfolder, as_an_archive, files_beside)
}  # fmt: skip


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """The same course graded by nbgrader, and by us."""
    theirs = courses.new_course(tmp_path_factory.mktemp("pair") / "theirs")
    with (theirs / "nbgrader_config.py").open("a") as config:
        config.write('c.LateSubmissionPlugin.penalty_method = "zero"\n')
    with Gradebook(courses.database(theirs)) as gradebook, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # SQLAlchemy's, about nbgrader's way with it
        gradebook.update_or_create_assignment(P3, duedate="2026-03-08 10:00:00 UTC")
        gradebook.add_student("excused", first_name="Emmy")
        gradebook.add_submission(P3, "excused")
        gradebook.grant_extension(P3, "excused", days=3)
    release = courses.release(theirs)
    for name in WHOLE:
        submit(theirs, name, p3_pendulum.CLASS[name](release), ON_TIME)
    submit(theirs, "late", p3_pendulum.partly_right(release), LATE)
    submit(theirs, "excused", p3_pendulum.partly_right(release), LATE)
    with_figure = p3_pendulum.right(release)
    with_figure.cells.append(new_code_cell("plt.plot([1.0, 0.5]);"))
    cell_of(with_figure, "answer-p3-L").source = cell_of(SOURCE, "answer-p3-L").source
    folder = submit(theirs, "with_files", with_figure).parent
    (folder / "pendulum.svg").write_text("the student's own")
    (folder / "data").mkdir()
    (folder / "data" / "run.csv").write_text("t,q\n")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        old = nbformat.writes(p3_pendulum.right(release), version=3)
    submit(theirs, "format_3", old)
    submit(theirs, "invalid", '{"cells": [', ON_TIME)
    submit(theirs, "no_cells", '{"nbformat": 4, "nbformat_minor": 5, "metadata": {}}')
    submit(theirs, "empty", "").unlink()
    for name, hand_in in HAND_INS.items():
        hand_in(submit(theirs, name, release).parent, release)
    ours = theirs.parent / "ours"
    shutil.copytree(theirs, ours)
    log = courses.run(theirs, "nbgrader", "autograde", P3, status=1)
    printed = courses.run(ours, "autograder", "grade", P3, "--jobs", "2", status=1)
    return SimpleNamespace(both=(theirs, ours), ours=ours, printed=printed, log=log)


@pytest.mark.parametrize("table", courses.TABLES)
def test_rows_are_nbgraders(pair, table):
    theirs, ours = (rows(courses.database(root))[table] for root in pair.both)
    assert ours == theirs
    assert len(ours) >= len(WHOLE)


def test_files_are_nbgraders(pair):
    theirs, ours = (files(root / "course" / "autograded") for root in pair.both)
    assert ours.keys() == theirs.keys()
    for name, expected in theirs.items():
        assert ours[name] == expected, name


def test_what_was_tested_is_not_trivial(pair):
    found = rows(courses.database(pair.ours))
    penalties = {row["assignment_id"]: row["late_submission_penalty"]
                 for row in map(dict, found["submitted_notebook"])}  # fmt: skip
    assert penalties[f"late/{P3}"] == 6.5
    assert penalties[f"excused/{P3}"] is None
    scores = [row["auto_score"] for row in map(dict, found["grade"])
              if row["notebook_id"] == f"format_3/{P3}/{P3}"]  # fmt: skip
    assert sum(filter(None, scores)) == 10


def test_marked_lines_suggest_points_and_a_person_still_reads(pair):
    """The same in both courses, as the rows are."""
    with Gradebook(courses.database(pair.ours)) as gradebook:
        grade = gradebook.find_grade("p3-derivation", P3, P3, "with_files")
        comment = gradebook.find_comment("p3-derivation", P3, P3, "with_files")
        assert (grade.auto_score, grade.needs_manual_grade) == (1.0, True)
        assert comment.auto_comment == (
            "p3-L: all 5 lines hold. The lines suggest 1 of 5 points: row 3 of the table."
        )
        without = gradebook.find_grade("p3-derivation", P3, P3, "right")
        assert (without.auto_score, without.needs_manual_grade) == (None, True)


@pytest.mark.parametrize(
    "line",
    [
        "right 10 of 15 6 correct, 1 to be read",
        "with_files 11 of 15 6 correct, 1 to be read",
        f"invalid could not be graded {NOTEBOOK} is not valid JSON: ask the student for it again",
        "format_3 10 of 15 6 correct, 1 to be read the notebook was in format 3; it was converted",
        f"other_name 10 of 15 6 correct, 1 to be read there is no {NOTEBOOK}; Pendulum final (2).ipynb",
        f"two_other_names could not be graded there is no {NOTEBOOK}, but there are a.ipynb and",
        f"in_a_subfolder could not be graded there is no {NOTEBOOK}, only my work/{NOTEBOOK}",
        f"as_an_archive could not be graded there is no {NOTEBOOK}, only p3-pendulum.zip",
        f"copy_beside 0 of 15 6 not attempted, 1 to be read {NOTEBOOK} was graded but has",
        f"damaged_beside could not be graded {NOTEBOOK} is not valid JSON: ask the student for it "
        f"again; {COPY}",
        "p3-derivation has no answer; it may be in the student's own cell below",
        "p3-derivation has no answer; it may be in the student's own file IMG 1234.jpg",
        "16 cells had lost their nbgrader settings",
        "edited_locked_cells 10 of 15 6 correct, 1 to be read the text of p3-setup had been",
        "files_beside 8 of 15 4 correct, 2 error in your code",
        f"empty could not be graded there is no {NOTEBOOK}",
        "p3-M was there more than once; the last one counts",
        "14 graded, 0 unchanged, 7 could not be graded",
    ],
)
def test_table_says(pair, line):
    assert line in " ".join(pair.printed.split())


@pytest.mark.parametrize(
    ("student", "sentence"),
    [
        ("copy_beside", f"{NOTEBOOK} was graded but has no answers; {COPY} beside it has some"),
        ("other_name", "Pendulum final (2).ipynb was graded instead"),
        ("edited_locked_cells", "the text of p3-setup had been changed; the original was put back"),
        (
            "edited_locked_cells",
            "this cell has no answer; it may be in the student's own cell below",
        ),
        (
            "files_beside",
            "The notebook does not define C: the cell that should define it stopped with "
            "FileNotFoundError: [Errno 2] No such file or directory: 'huge.npy' (huge.npy was handed "
            "in, but the notebook is graded without it: the files beside the notebook have more than "
            "8 MB)",
        ),
        ("files_beside", "nowhere.csv was not handed in with the notebook"),
    ],
)
def test_the_student_is_told(pair, student, sentence):
    notebook = nbformat.read(pair.ours / "course" / "autograded" / student / P3 / NOTEBOOK, 4)
    said = [cell.source.replace("\\", "") for cell in notebook.cells]
    said += [out["data"]["text/plain"] for cell in notebook.cells for out in cell.get("outputs", ())
             if "data" in out]  # fmt: skip
    assert sentence in " ".join("\n".join(said).split())


def test_nbgraders_log_says_the_same(pair):
    for said in (
        "other_name: there is no p3-pendulum.ipynb; Pendulum final (2).ipynb was graded instead",
        f"two_other_names/{P3}: there is no p3-pendulum.ipynb, but there are a.ipynb and b.ipynb",
        f"copy_beside: {NOTEBOOK} was graded but has no answers; {COPY} beside it has some",
        "edited_locked_cells: the text of p3-M had been changed",
        "edited_locked_cells: p3-derivation has no answer",
    ):
        assert said in pair.log


def test_a_persons_marks_stay(pair, monkeypatch, capsys):
    root = pair.ours
    monkeypatch.chdir(root)
    with Gradebook(courses.database(root)) as gradebook:
        grade = gradebook.find_grade("p3-derivation", P3, P3, "right")
        grade.manual_score, grade.needs_manual_grade = 4.0, False
        gradebook.db.commit()
    before = rows(courses.database(root))
    assert main(["grade", P3, "--jobs", "1"]) == 1
    said = capsys.readouterr().out
    assert "right 14 of 15 6 correct" in " ".join(said.split())
    assert "0 graded, 14 unchanged" in said
    assert rows(courses.database(root)) == before


def test_what_is_gone_is_put_back(pair, monkeypatch, capsys):
    root = pair.ours
    monkeypatch.chdir(root)
    before = rows(courses.database(root)), files(root / "course" / "autograded")
    shutil.rmtree(root / "course" / "autograded" / "wrong")
    (root / "course" / "autograded" / "blank" / P3 / NOTEBOOK).chmod(0o644)
    (root / "course" / "autograded" / "blank" / P3 / NOTEBOOK).write_text("{}")
    with Gradebook(courses.database(root)) as gradebook:
        gradebook.find_grade("p3-M", P3, P3, "partly_right").auto_score = 0.5
        gradebook.db.commit()
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert "3 graded, 11 unchanged" in capsys.readouterr().out
    assert (rows(courses.database(root)), files(root / "course" / "autograded")) == before


def test_with_another_file_beside_it_a_notebook_is_judged_again(pair, monkeypatch, capsys):
    root = pair.ours
    monkeypatch.chdir(root)
    (root / "course" / "submitted" / "files_beside" / P3 / "script.py").write_text("half = 0.7\n")
    assert main(["grade", P3, "--jobs", "1"]) == 1
    said = " ".join(capsys.readouterr().out.split())
    assert "1 graded, 13 unchanged" in said
    assert "files_beside 6.5 of 15" in said  # the kinetic part of L is wrong now


def test_no_answer_waits_to_be_marked_of_whom_nobody_could_grade(pair):
    book = ByHand(pair.ours)
    (proof,) = [proof for proof in book.proofs() if proof.assignment == P3]
    waiting = {paper.student for paper in book.papers(proof)}
    assert {"right", "late"} <= waiting
    assert not {"invalid", "no_cells"} & waiting


def test_a_hand_in_without_a_time_keeps_none_of_an_earlier_one(pair, monkeypatch, capsys):
    root = pair.ours
    monkeypatch.chdir(root)
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert "late, −" in capsys.readouterr().out
    (root / "course" / "submitted" / "late" / P3 / "timestamp.txt").unlink()
    assert main(["grade", P3, "--jobs", "1"]) == 1
    said = capsys.readouterr().out
    assert "1 graded, 13 unchanged" in said
    assert "late, −" not in said
