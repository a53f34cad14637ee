"""A class from the platform's archive to the platform's sheet, against a ledger kept apart."""

import csv
import io
import json
import re
import shutil
import zipfile
from contextlib import chdir, redirect_stdout
from types import SimpleNamespace

import pytest
from nbgrader.api import Gradebook
from nbgrader.utils import notebook_hash

from autograder.cli import main
from autograder.marking.kept import FIRST, Given, Kept
from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3
from tests.autograder.lms.platforms import (
    canvas_name,
    canvas_sheet,
    moodle_folder,
    moodle_sheet,
    zipped,
)
from tests.autograder.lti.platform import Platform, member, playing, registration
from tests.submissions import p3_pendulum
from tests.submissions.answers import blank

CLASS = """id,last_name,first_name,email,lms_id
ada,Lovelace,Ada,ada@x.org,11
bob,"Doe, Jr.",Bob,bob@x.org,12
dan,Day,Dan,dan@x.org,13
eve,O'Neil,Ève,eve@x.org,14
fay,=1+1,Fay,fay@x.org,15
gus,Gauß,Gus,gus@x.org,16
nil,Nihil,Nil,nil@x.org,17
"""
CALENDAR = """time-zone = "Europe/Berlin"
[p3-pendulum]
due = "2026-11-28 18:00"
penalty = { percent-per-day = 10 }
[p3-pendulum.extensions]
eve = "2026-12-01"
"""
IN_TIME, LATE = "Samstag, 28. November 2026, 17:59", "Sonntag, 29. November 2026, 18:30"
HANDED_IN = {"ada": IN_TIME, "bob": LATE, "dan": LATE, "eve": LATE, "fay": IN_TIME, "gus": IN_TIME}
# What the checks give, what a person gives the proof, and the days that have begun after the due date.
CHECKS = {"ada": 10, "bob": 6.5, "dan": 10, "eve": 6.5, "fay": 0}
PROOF = {"dan": 5}
DAYS = {"bob": 2, "dan": 2}
NAMES = {"ada": "Ada Lovelace", "bob": "Bob Doe, Jr.", "dan": "Dan Day", "eve": "Ève O'Neil",
         "fay": "Fay =1+1", "gus": "Gus Gauß", "nil": "Nil Nihil"}  # fmt: skip
NUMBERS = {student: str(300 + at) for at, student in enumerate(NAMES)}


def ledger(student: str) -> float | None:
    """The points of one who has a mark; ada's proof is not marked, gus's notebook not there."""
    if student in ("ada", "gus", "nil"):
        return None
    points = CHECKS[student] + PROOF.get(student, 0)
    return points - points * DAYS.get(student, 0) / 10


def said(*command: str) -> str:
    """What a command prints that ends with 1, as gus has no notebook."""
    with redirect_stdout(io.StringIO()) as printed:
        assert main([*command]) == 1
    return printed.getvalue()


@pytest.fixture(scope="module")
def term(tmp_path_factory):
    """Collected, graded, and dan's proof marked after that; with what the commands said."""
    root = courses.new_course(tmp_path_factory.mktemp("term") / "course")
    (root / "course" / "class.csv").write_text(CLASS, encoding="utf-8")
    (root / "course" / "calendar.toml").write_text(CALENDAR, encoding="utf-8")
    release = courses.release(root)
    right, partly = (
        json.dumps(make(release)) for make in (p3_pendulum.right, p3_pendulum.partly_right)
    )
    notebooks = {"ada": right, "bob": partly, "dan": right, "eve": partly}
    notebooks["fay"] = json.dumps(blank(release))
    folders = {student: moodle_folder(NAMES[student], NUMBERS[student]) for student in NAMES}
    files = {
        f"{folders[student]}/p3-pendulum (1).ipynb": text for student, text in notebooks.items()
    }
    archive = zipped(root / "all.zip", files | {f"{folders['gus']}/scan.pdf": "%PDF"})
    rows = [{"number": NUMBERS[student], "name": NAMES[student], "email": f"{student}@x.org",
             "submitted": HANDED_IN.get(student, "-")} for student in NAMES]  # fmt: skip
    sheet = moodle_sheet(root / "sheet.csv", rows, "de", "15,00")
    with chdir(root):
        taken = said("collect-zip", P3, str(archive), "--sheet", str(sheet))
        graded = said("grade", P3, "--jobs", "2")
    with Gradebook(courses.database(root)) as gradebook:
        before = gradebook.find_submission(P3, "dan").late_submission_penalty
        grade = gradebook.find_grade("p3-derivation", P3, P3, "dan")
        grade.manual_score, grade.needs_manual_grade = 5, False
        gradebook.db.commit()
    return SimpleNamespace(root=root, sheet=sheet, taken=taken, graded=graded, before=before)


@pytest.fixture
def course(term, tmp_path, monkeypatch):
    """The term's course, which is afterwards what it was before; its path is part of what was graded."""
    shutil.copytree(term.root, tmp_path / "before")
    monkeypatch.chdir(term.root)
    yield term.root
    shutil.rmtree(term.root)
    shutil.copytree(tmp_path / "before", term.root)


def table(path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8-sig") as file:
        return list(csv.DictReader(file))


def points(cell: str) -> float | None:
    return float(cell.replace(",", ".")) if cell else None


def penalty(root, student: str) -> float:
    with Gradebook(courses.database(root)) as gradebook:
        return gradebook.find_submission(P3, student).late_submission_penalty


def test_the_archive_was_taken_and_graded(term):
    assert "6 taken, 0 left as they were, 1 of the class not there" in term.taken
    assert "gus: there is no notebook, only scan.pdf" in term.taken
    graded = " ".join(term.graded.split())
    assert "bob 5.2 of 15 1 partly correct, 4 correct, 1 incorrect, late, −1.3" in graded
    assert "eve 6.5 of 15" in graded
    assert term.before == 2.0  # of dan's 10, before a person gave the proof's points


def test_moodles_sheet_is_the_ledger(course, capsys):
    assert main(["export", P3, "--for", "moodle", "--sheet", "sheet.csv", "--to", "out.csv"]) == 0
    rows = {row["ID"].removeprefix("Teilnehmer/in "): row for row in table(course / "out.csv")}
    for student, number in NUMBERS.items():
        assert points(rows[number]["Bewertung"]) == pytest.approx(ledger(student)), student
    said = capsys.readouterr().out
    assert "p3-pendulum: dan: late: 3 points off, and not 2" in said
    assert "4 marks written: out.csv" in said
    for left in ("1, could not be read", "1, nothing handed in", "1, proof not yet marked"):
        assert f"left as they were: {left}" in said
    assert not (course / "course" / "marks-moodle.csv").exists()  # --to is obeyed
    assert (course / "out.csv").stat().st_mode & 0o077 == 0  # marks are nobody else's business


def test_the_tables_are_the_ledger_and_tell_a_zero_from_nothing(course):
    assert main(["export"]) == 0
    rows = {row["student"]: row for row in table(course / "course" / "marks.csv")}
    assert list(rows) == list(NAMES)
    for student, row in rows.items():
        assert points(row["points"]) == pytest.approx(ledger(student)), student
    assert {student: row["status"] for student, row in rows.items()} == {
        "ada": "proof not yet marked",
        "bob": "graded, late, −1.3",
        "dan": "graded, late, −3",
        "eve": "graded",
        "fay": "graded",
        "gus": "could not be read",
        "nil": "nothing handed in",
    }
    assert rows["fay"]["points"] == "0"
    assert rows["fay"]["last_name"] == "'=1+1"
    assert rows["bob"]["last_name"] == "Doe, Jr."
    assert main(["export", "--wide", "--with-unread", "--to", "wide.csv"]) == 0
    wide = {row["student"]: row for row in table(course / "wide.csv")}
    assert wide["ada"]["total"] == "10"
    assert wide["gus"] | {"total": "0", "still_to_be_marked": "1"} == wide["gus"]


def test_canvas_sheet_is_the_ledger(course):
    rows = [{"name": "Somebody", "number": 11 + at} for at in range(len(NAMES))]
    canvas_sheet(
        course / "book.csv", rows, {"Homework 3 (77)": "15", "p3-pendulum extra (78)": "5"}
    )
    command = ["export", P3, "--for", "canvas", "--sheet", "book.csv", "--to", "out.csv"]
    assert main([*command, "--column", f"{P3}=Homework 3 (77)"]) == 0
    filled = [row for row in table(course / "out.csv") if row["ID"]][: len(NAMES)]
    for student, row in zip(NAMES, filled, strict=True):
        assert points(row["Homework 3 (77)"]) == pytest.approx(ledger(student)), student


def test_a_penalty_is_put_right_without_judging_or_asking_a_person_again(
    course, monkeypatch, capsys
):
    def never(*given):
        raise AssertionError("judged again")

    monkeypatch.setattr("autograder.pipeline.run._Run._settle", never)
    assert penalty(course, "dan") == 2.0
    assert main(["grade", P3, "--jobs", "1"]) == 1  # gus has no notebook
    assert penalty(course, "dan") == 3.0
    said = " ".join(capsys.readouterr().out.split())
    assert "dan 12 of 15 6 correct, late, −3" in said
    assert "0 graded, 5 unchanged, 1 could not be graded" in said


def test_a_changed_calendar_changes_marks_without_judging(course, capsys):
    """An extension after the hand-in, a due date that moves, and another penalty."""
    calendar = course / "course" / "calendar.toml"
    calendar.write_text(CALENDAR + 'bob = "2026-11-30"\n')
    assert main(["export"]) == 0
    assert penalty(course, "bob") == 0
    assert "p3-pendulum: bob: late: 0 points off, and not 1.3" in capsys.readouterr().out
    calendar.write_text(CALENDAR.replace("28 18:00", "29 18:00"))
    assert main(["export"]) == 0
    assert penalty(course, "bob") == pytest.approx(0.65)
    assert "an extension of" in capsys.readouterr().out  # bob's was taken back, which is said
    calendar.write_text(CALENDAR.replace("{ percent-per-day = 10 }", '"zero"'))
    assert main(["export"]) == 0
    assert (penalty(course, "bob"), penalty(course, "dan")) == (6.5, 15)  # nothing of dan's is kept


def test_a_marked_proof_is_read_again_only_if_its_text_has_changed(course, tmp_path, monkeypatch):
    def to_read(root) -> bool:
        with Gradebook(courses.database(root)) as gradebook:
            return gradebook.find_grade("p3-derivation", P3, P3, "dan").needs_manual_grade

    assert main(["grade", P3, "--jobs", "1", "--force"]) == 1
    assert not to_read(course)
    moved = tmp_path / "moved"  # its path is part of the settings, and all is recorded anew
    shutil.copytree(course, moved)
    monkeypatch.chdir(moved)
    path = moved / "course" / "submitted" / "dan" / P3 / NOTEBOOK
    notebook = json.loads(path.read_text())
    next(cell for cell in notebook["cells"] if "def M(" in cell["source"])["source"] += "\n# M"
    path.write_text(json.dumps(notebook))
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert not to_read(moved)
    (proof,) = (cell for cell in notebook["cells"]
                if cell["metadata"].get("nbgrader", {}).get("grade_id") == "p3-derivation")  # fmt: skip
    proof["source"] += "\nAnd so on."
    path.write_text(json.dumps(notebook))
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert to_read(moved)
    with Gradebook(courses.database(moved)) as gradebook:
        grade = gradebook.find_grade("p3-derivation", P3, P3, "dan")
        assert grade.manual_score == 5
        grade.needs_manual_grade = False
        gradebook.db.commit()
    (path.parent / "photo.png").write_bytes(b"another page")
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert to_read(moved)


def test_nbgraders_own_export_and_penalties_are_right_too(course):
    (course / "course" / "calendar.toml").write_text(CALENDAR.replace("penalty", "# penalty"))
    with (course / "nbgrader_config.py").open("a") as config:
        config.write('c.LateSubmissionPlugin.penalty_method = "zero"\n')
    courses.run(course, "nbgrader", "export", "--to", "theirs.csv")
    rows = {row["student_id"]: row for row in table(course / "theirs.csv")}
    assert (rows["dan"]["raw_score"], rows["dan"]["score"]) == ("15.0", "0.0")
    assert rows["eve"]["score"] == "6.5"
    assert (rows["bob"]["last_name"], rows["bob"]["email"]) == ("Doe, Jr.", "bob@x.org")


def test_feedback_for_moodle(course, capsys):
    courses.run(course, "nbgrader", "generate_feedback", P3, "--student", "fay")
    assert penalty(course, "dan") == 3.0  # as the pages must say
    pages = course / "course" / "feedback" / "fay" / P3
    command = ["export", P3, "--for", "moodle", "--sheet", "sheet.csv", "--to", "out.csv"]
    assert main([*command, "--feedback", "pages.zip"]) == 0
    with zipfile.ZipFile("pages.zip") as archive:
        (name,) = archive.namelist()
        assert archive.read(name) == (pages / f"{P3}.html").read_bytes()
    # As Moodle reads it: feedback/file/importziplib.php.
    person, number, kind, plugin = name.split("/")[0].split("_", 4)
    assert (person, number, kind, plugin) == ("Fay =1+1", NUMBERS["fay"], "assignfeedback", "file")
    assert "1 students' pages, 6 have none: pages.zip" in capsys.readouterr().out


def test_who_hands_in_again_and_who_is_not_in_the_list(course, capsys):
    name = canvas_name("Day, Dan", 13, 5, NOTEBOOK)
    zipped(course / "b.zip", {name: json.dumps(p3_pendulum.wrong(courses.release(course)))})
    assert main(["collect-zip", P3, "b.zip"]) == 0
    assert (
        "the hand-in before it is now in course/replaced/dan/p3-pendulum/1"
        in capsys.readouterr().out
    )
    (course / "course" / "class.csv").write_text(CLASS.replace("bob,", "rob,"))
    assert main(["export"]) == 0
    assert "not in the class list, and left out: bob" in capsys.readouterr().out


def test_a_student_is_forgotten_everywhere(course, capsys, monkeypatch):
    submitted = course / "course" / "submitted" / "bob" / P3
    (submitted / "submission_secret.txt").write_text("secret")
    inbound = course / "course" / "exchange" / "armdyn" / "inbound"
    (inbound / "bob+p3-pendulum+2026-11-28 10:00:00 UTC+abc").mkdir(parents=True)
    (inbound / "bobby+p3-pendulum+2026-11-28 10:00:00 UTC+abc").mkdir()
    name = notebook_hash(secret="secret", notebook_id=P3)
    page = course / "course" / "exchange" / "armdyn" / "feedback" / f"{name}.html"
    page.parent.mkdir()
    page.write_text("bob's page")
    (course / "course" / "replaced" / "bob").mkdir(parents=True)
    (course / "course" / "calendar.toml").write_text(CALENDAR + 'bob = "2026-11-30"\n')
    assert main(["export"]) == 0
    command = ["export", P3, "--for", "moodle", "--sheet", "sheet.csv"]  # which has no id of ours
    courses.run(course, "nbgrader", "generate_feedback", P3, "--student", "bob")
    assert main([*command, "--feedback", "course/pages.zip"]) == 0
    pages = zipped(course / "mine.zip", {"doejrbob_12_5_p3-pendulum.ipynb": "{}"})
    assert main(["report", P3]) == 0
    page = (course / "course" / "report" / f"{P3}.html").read_text()
    assert "1 of the class handed in nothing" in page
    assert "Nil Nihil" in page
    assert "late, −3" in page
    others = courses.rows(courses.database(course))["grade"]
    given = Given((), 1.0, "", "", "")
    for student in ("bob", "bobby"):
        Kept(course).change(P3, "p3-derivation", student, lambda entry: {FIRST: given})
    assert main(["forget", "BOB", "--yes"]) == 1
    assert "there is no student BOB. Did you mean bob?" in capsys.readouterr().err
    monkeypatch.setattr("builtins.input", lambda question: "n")
    assert main(["forget", "bob"]) == 1
    assert submitted.exists()
    capsys.readouterr()
    written(course / "course" / "notes.txt", "Bob Doe, Jr.: a talk on Monday\n")
    assert main(["forget", "bob", "--yes"]) == 0
    said = capsys.readouterr().out
    for name in ("course/notes.txt", pages.name, "all.zip", "sheet.csv"):
        assert f"{name} names the student, too, and will be left as it is" in said
    assert "notes" not in said.replace("course/notes.txt", "")
    (course / "course" / "notes.txt").unlink()
    for what in (
        *("submitted/bob", "autograded/bob", "replaced/bob", "inbound/bob+", "armdyn/feedback/"),
        *("cache-of-results", "the gradebook", "the line in course/class.csv", "1 extensions in"),
        *("course/marks.csv", f"course/report/{P3}.html", f"course/marking/{P3}.json"),
        *("course/marks-moodle.csv", "course/pages.zip"),
    ):
        assert what in said, what
    left = [path for path in (course / "course").rglob("*") if path.is_file()]
    traces = [path for path in left if re.search(
        rb"bob(?!by)|Doe, Jr", str(path.relative_to(course)).encode() + path.read_bytes(), re.I)
    ]  # fmt: skip
    assert traces == []
    assert list(Kept(course).of(P3, "p3-derivation")) == ["bobby"]
    assert (inbound / "bobby+p3-pendulum+2026-11-28 10:00:00 UTC+abc").exists()
    kept = courses.rows(courses.database(course))["grade"]
    assert kept == [row for row in others if "bob/" not in repr(row)]
    assert main(["grade", P3, "--jobs", "1"]) == 1
    assert "0 graded, 4 unchanged" in " ".join(capsys.readouterr().out.split())
    assert main(["forget", "bob", "--yes"]) == 1
    assert "keeps nothing about bob" in capsys.readouterr().err


def written(path, text: str):
    path.write_text(text, encoding="utf-8")
    return path


def test_the_marks_of_the_term_reach_a_platform_by_lti(course, capsys):
    """By the commands, and once more after ada's proof is marked: then hers alone is sent."""
    assert main(["lti", "send", P3]) == 2
    assert "there is no course/lti.toml: write into it" in capsys.readouterr().err
    assert main(["lti", "key"]) == 0
    platform = Platform(course / "course" / "lti-key-set.json")
    platform.members = [member(f"u-{id}", NAMES[id], email=f"{id}@x.org") for id in NAMES]
    with playing(platform):
        (course / "course" / "lti.toml").write_text(registration(platform))
        capsys.readouterr()
        assert main(["lti", "send", P3]) == 0
        printed = capsys.readouterr().out
        assert "p3-pendulum: 5 scores sent, in a new line item" in printed
        assert "  not sent: 1, could not be read\n  not sent: 1, nothing handed in" in printed
        (sent,) = platform.scores.values()
        given = {id: sent.get(f"u-{id}", {}).get("scoreGiven") for id in NAMES}
        assert given == {id: pytest.approx(ledger(id)) for id in NAMES}
        assert sent["u-ada"]["gradingProgress"] == "PendingManual"
        assert sent["u-bob"]["comment"] == "graded, late, −1.3"
        with Gradebook(courses.database(course)) as gradebook:
            grade = gradebook.find_grade("p3-derivation", P3, P3, "ada")
            grade.manual_score, grade.needs_manual_grade = 4, False
            gradebook.db.commit()
        assert main(["lti", "send"]) == 0
        printed = capsys.readouterr().out
        assert "p3-pendulum: 1 score sent\n  as they were sent before: 4" in printed
        assert sent["u-ada"]["scoreGiven"] == 14
        record = course / "course" / "lti-sent.json"
        assert '"bob"' in record.read_text()
        assert main(["forget", "bob", "--yes"]) == 0
        assert "course/lti-sent.json, the marks that were sent" in capsys.readouterr().out
        assert "bob" not in record.read_text()
        assert main(["lti", "send"]) == 0
        printed = capsys.readouterr().out
        assert "in the platform's course and not in course/class.csv: Bob Doe, Jr." in printed
        assert "p3-pendulum: 0 scores sent\n  as they were sent before: 4" in printed
