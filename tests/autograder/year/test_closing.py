"""`autograder archive`: refused while something is open; whole; and only then an empty course."""

import csv
import os
import shutil
import stat
import zipfile
from collections import Counter

import pytest
from nbgrader.api import Gradebook
from nbgrader.utils import notebook_hash

from autograder.cli import main
from tests.autograder import courses
from tests.autograder.courses import P3
from tests.submissions import p3_pendulum

CLASS = """id,last_name,first_name,email
ada-l,Lovelace,Ada,ada@x.org
bob-d,"Doe, Jr.",Bob,bob@x.org
nil-n,Nihil,Nil,nil@x.org
"""
CALENDAR = """time-zone = "Europe/Berlin"
penalty = { percent-per-day = 10 }

[p3-pendulum]
due = "2026-11-28 18:00"  # a Saturday

[p3-pendulum.extensions]
ada-l = "2026-12-01"
"""
PERSONAL = ("ada", "bob", "nil", "lovelace", "doe", "nihil", "x.org")


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    """Ada has a mark and her page, Bob's proof is not marked, Nil handed in nothing."""
    root = courses.new_course(tmp_path_factory.mktemp("year") / "course")
    (root / "course" / "class.csv").write_text(CLASS)
    (root / "course" / "calendar.toml").write_text(CALENDAR)
    release = courses.release(root)
    for student, make in {"ada-l": "partly_right", "bob-d": "right"}.items():
        path = courses.submit(
            root, student, p3_pendulum.CLASS[make](release), "2026-11-29 09:00:00 UTC"
        )
        (path.parent / "submission_secret.txt").write_text(f"secret of {student}")
    before = os.getcwd()
    os.chdir(root)
    try:
        assert main(["grade", P3, "--jobs", "1"]) == 0
    finally:
        os.chdir(before)
    return root


@pytest.fixture
def course(graded, tmp_path, monkeypatch):
    root = shutil.copytree(graded, tmp_path / "course")
    monkeypatch.chdir(root)
    return root


@pytest.fixture
def closed(course):
    """All is done: the course can be archived."""
    finish(course)
    return course


def finish(root):
    with Gradebook(courses.database(root)) as gradebook:
        for student in ("ada-l", "bob-d"):
            grade = gradebook.find_grade("p3-derivation", P3, P3, student)
            grade.manual_score, grade.needs_manual_grade = 4, False
        gradebook.db.commit()
    for student in ("ada-l", "bob-d"):  # as generate_feedback and release_feedback leave them
        page = root / "course" / "feedback" / student / P3 / f"{P3}.html"
        page.parent.mkdir(parents=True)
        page.write_text(f"the page of {student}")
        shutil.copy(
            root / "course" / "submitted" / student / P3 / "submission_secret.txt", page.parent
        )
        name = notebook_hash(secret=f"secret of {student}", notebook_id=P3)
        released = root / "course" / "exchange" / "armdyn" / "feedback" / f"{name}.html"
        released.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(page, released)


def table(path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8-sig") as file:
        return list(csv.DictReader(file))


def unpacked(path, to):
    with zipfile.ZipFile(path) as archive:
        archive.extractall(to)
        for info in archive.infolist():  # as `unzip` does, and Python does not
            os.chmod(to / info.filename, info.external_attr >> 16)
    return to / path.stem


def test_it_is_refused_while_something_is_open(course, capsys):
    inbound = course / "course" / "exchange" / "armdyn" / "inbound"
    (inbound / f"nil-n+{P3}+2026-11-28 10:00:00 UTC+x").mkdir(parents=True)
    (inbound / f"ada-l+{P3}+2026-11-28 10:00:00 UTC+x").mkdir()  # before the one that was collected
    assert main(["archive", "--empty", "--yes"]) == 1
    said = capsys.readouterr().err
    assert f"{P3}: a proof not yet marked: 1 (bob-d)" in said
    assert "handed in and not collected: 1 (nil-n)" in said
    assert "nothing was written" in said
    assert not (course / "archive").exists()
    assert (course / "course" / "gradebook.db").exists()


def test_feedback_that_nobody_can_fetch_is_open_too(closed, capsys):
    page = closed / "course" / "feedback" / "bob-d" / P3 / f"{P3}.html"
    page.write_text("changed since it was released")
    assert main(["archive"]) == 1
    said = capsys.readouterr().err
    assert "the feedback page is not released, or has changed since: 1 (bob-d)" in said
    page.unlink()
    assert main(["archive"]) == 1
    assert "no feedback page is made: 1 (bob-d)" in capsys.readouterr().err
    # Who handed in by a platform has no secret, and gets the page there.
    page.write_text("a page")
    (page.parent / "submission_secret.txt").unlink()
    assert main(["archive", "--to", "year.zip"]) == 0


def test_with_anyway_it_is_written_and_says_what_is_open(course, capsys):
    assert main(["archive", "--anyway", "--to", "year.zip"]) == 0
    assert "a proof not yet marked: 1 (bob-d)" in capsys.readouterr().err
    rows = {
        row["student"]: row for row in table(unpacked(course / "year.zip", course) / "marks.csv")
    }
    assert (rows["ada-l"]["points"], rows["bob-d"]["points"]) == ("6.5", "")
    assert rows["nil-n"]["status"] == "nothing handed in"


def test_the_archive_is_private_and_is_a_course_of_its_own(closed, tmp_path, monkeypatch, capsys):
    (closed / "course" / "submitted" / "bob-d" / P3 / "etc").symlink_to("/etc")
    assert main(["archive"]) == 1  # something is left out, and named
    said = capsys.readouterr().out
    assert f"submitted/bob-d/{P3}/etc is not kept: it is a link, to /etc" in said
    (path,) = (closed / "archive").iterdir()
    assert "read back and found whole" in said
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700
    again = unpacked(path, tmp_path)
    assert stat.S_IMODE((again / "course").stat().st_mode) == 0o700
    for name in ("class.csv", "calendar.toml", "seed", f"release/{P3}/{P3}.ipynb"):
        assert (again / "course" / name).read_bytes() == (closed / "course" / name).read_bytes()
    for step in ("submitted", "autograded", "feedback"):
        assert (again / "course" / step / "ada-l" / P3).is_dir()
    assert not (again / "course" / "cache-of-results").exists()
    about = (again / "ABOUT.txt").read_text()
    assert "Students: 3\nAssignments: p3-pendulum (15 points)" in about
    assert "Kit: armdyn " in about
    assert courses.rows(courses.database(again)) == courses.rows(courses.database(closed))
    monkeypatch.chdir(again)
    assert main(["export", "--to", "again.csv"]) == 0
    assert (again / "again.csv").read_bytes() == (again / "marks.csv").read_bytes()
    rows = {row["student"]: row for row in table(again / "marks.csv")}
    assert list(rows) == ["ada-l", "bob-d", "nil-n"]
    assert rows["bob-d"]["last_name"] == "Doe, Jr."
    assert rows["bob-d"]["status"] == "graded, late, −1.4"
    wide = {row["student"]: row for row in table(again / "marks-by-student.csv")}
    assert float(wide["bob-d"]["total"]) == pytest.approx(14 * 0.9)


def test_it_never_takes_the_place_of_another_archive_and_never_lies_in_course(closed, capsys):
    assert main(["archive", "--to", "year.zip"]) == 0
    assert main(["archive", "--to", "year.zip"]) == 2
    assert "is there already: name another file with --to" in capsys.readouterr().err
    assert main(["archive"]) == main(["archive"]) == 0
    first, second = sorted((closed / "archive").iterdir())
    capsys.readouterr()
    assert main(["forget", "nil-n", "--yes"]) == 0
    said = capsys.readouterr().out
    assert f"archive/{first.name} names the student, too, and will be left as it is" in said
    assert second.exists()
    assert main(["archive", "--to", "course/year.zip"]) == 2
    assert "lies in course/" in capsys.readouterr().err
    assert main(["archive", "--keep-class"]) == 2
    assert "add --empty" in capsys.readouterr().err


def test_the_second_archive_names_nobody(closed, tmp_path):
    assert main(["archive", "--pseudonyms", "--to", "year.zip"]) == 0
    path = closed / "year-without-names.zip"
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    with zipfile.ZipFile(path) as archive:
        held = {name: archive.read(name).decode("utf-8-sig") for name in archive.namelist()}
    assert {name.split("/")[1] for name in held} - {""} == {
        *("ABOUT.txt", "SHA256SUMS", "marks.csv", "marks-by-student.csv")
    }
    for name, text in held.items():
        for word in PERSONAL:
            assert word not in f"{name}{text}".lower(), (name, word)
    nameless = table(unpacked(path, tmp_path) / "marks.csv")
    named = table(unpacked(closed / "year.zip", tmp_path) / "marks.csv")
    for column in ("points", "status", "most"):
        assert Counter(row[column] for row in nameless) == Counter(row[column] for row in named)
    assert all(row["handed_in_utc"] == "" for row in nameless)


def test_the_order_of_those_without_names_is_not_that_of_the_class():
    from autograder.lms.marks import GRADED, Column, Mark, Marks
    from autograder.roster import Person
    from autograder.year.without_names import without_names

    people = [Person(f"id{number}") for number in range(100)]
    marks = {one.id: Mark(GRADED, number) for number, one in enumerate(people)}
    found = without_names(Marks(people, [Column(P3, 100, None, marks)]))
    points = [found.columns[0].of(one.id).points for one in found.people]
    assert sorted(points) == list(range(100))
    assert points != list(range(100))


def test_course_is_emptied_of_what_the_archive_holds_after_asking(closed, monkeypatch, capsys):
    monkeypatch.setattr("builtins.input", lambda question: "n")
    before = set(courses.files(closed / "course"))
    assert main(["archive", "--empty", "--to", "no.zip"]) == 1
    assert set(courses.files(closed / "course")) == before

    def somebody_hands_in(question):
        assert question.startswith("Remove these ")
        (closed / "course" / "submitted" / "nil-n").mkdir()
        (closed / "course" / "submitted" / "nil-n" / "new.ipynb").write_text("{}")
        (closed / "course" / "seed").write_text("another")
        return "y"

    monkeypatch.setattr("builtins.input", somebody_hands_in)
    command = ["archive", "--empty", "--keep-class", "--keep-calendar", "--to", "year.zip"]
    assert main(command) == 1  # the seed is not what was archived
    assert "course/seed has changed since it was archived, and stays" in capsys.readouterr().out
    course = closed / "course"
    left = {path.relative_to(course).as_posix() for path in course.rglob("*") if path.is_file()}
    assert left == {
        *("class.csv", "calendar-of-last-year.toml", "seed", "submitted/nil-n/new.ipynb"),
        "grading.lock",
    }
    last = (course / "calendar-of-last-year.toml").read_text()
    assert last == CALENDAR.replace('ada-l = "2026-12-01"\n', "")
    assert (closed / "solutions" / P3 / f"{P3}.ipynb").exists()


def test_without_asking_and_without_keeping_nothing_of_last_year_is_left(closed):
    assert main(["archive", "--empty", "--yes", "--to", "year.zip"]) == 0
    left = [path.name for path in (closed / "course").rglob("*")]
    assert left == ["grading.lock"]


def test_a_calendar_whose_names_are_not_found_stops_it_before_anything_is_written(closed, capsys):
    inline = 'extensions = { ada-l = "2026-12-01" }\n'
    text = CALENDAR.split("[p3-pendulum.ext")[0] + inline
    (closed / "course" / "calendar.toml").write_text(text)
    assert main(["archive", "--empty", "--yes", "--keep-calendar", "--to", "year.zip"]) == 2
    assert "on lines of their own below" in capsys.readouterr().err
    assert not (closed / "year.zip").exists()
