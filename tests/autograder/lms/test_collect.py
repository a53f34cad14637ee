"""`autograder collect-zip` in a course: whose hand-in counts, what it says, that nothing is lost."""

import json
from datetime import UTC, datetime

import pytest

from autograder.cli import main
from tests.autograder.courses import ROOT, files
from tests.autograder.lms.platforms import (
    canvas_name,
    canvas_sheet,
    moodle_folder,
    moodle_sheet,
    zipped,
)

P3 = "p3-pendulum"
NOTEBOOK = f"{P3}.ipynb"
CLASS = """id,last_name,first_name,email,lms_id
ada,Lovelace,Ada,ada@x.org,11
bob,"Doe, Jr.",Bob,bob@x.org,12
eve,O'Neil,Ève,eve@x.org,13
lee1,Lee,Sam,sam1@x.org,14
lee2,Lee,Sam,sam2@x.org,15
"""
DUE = "[p3-pendulum]\ndue = 2026-11-28T17:00:00Z\n[p3-pendulum.extensions]\neve = 2026-12-01T00:00:00Z\n"
IN_TIME, LATE = "Saturday, 28 November 2026, 4:59 PM", "Sunday, 29 November 2026, 1:00 AM"


@pytest.fixture
def course(tmp_path, monkeypatch):
    root = tmp_path / "course [2026]"
    (root / "solutions" / P3).mkdir(parents=True)
    (root / "solutions" / P3 / NOTEBOOK).write_text("{}")
    (root / "course").mkdir()
    (root / "nbgrader_config.py").write_text((ROOT / "nbgrader_config.py").read_text())
    (root / "course" / "class.csv").write_text(CLASS)
    (root / "course" / "calendar.toml").write_text(f'time-zone = "UTC"\n{DUE}')
    monkeypatch.chdir(root)
    return root


def notebook(text: str) -> str:
    cell = {"cell_type": "markdown", "metadata": {}, "source": text}
    return json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 4})


def collect(capsys, *arguments: str, status: int = 0) -> str:
    assert main(["collect-zip", P3, *map(str, arguments)]) == status
    return capsys.readouterr().out


def submitted(course, student: str) -> dict[str, str]:
    folder = course / "course" / "submitted" / student / P3
    return {path.relative_to(folder).as_posix(): path.read_text()
            for path in sorted(folder.rglob("*")) if path.is_file()}  # fmt: skip


def test_moodles_archive_with_its_sheet(course, capsys):
    ada, bob, eve = (moodle_folder(*who) for who in
                     (("Ada Lovelace", 101), ("Bob Doe, Jr.", 102), ("Ève O'Neil", 103)))  # fmt: skip
    path = zipped(
        course / "a.zip",
        {
            f"{ada}/p3-pendulum (1).ipynb": notebook("ada"),
            f"{ada}/data.csv": "1,2",
            f"{ada}/timestamp.txt": "1999-01-01 00:00:00 UTC",
            f"{bob}/work/{NOTEBOOK}": notebook("bob"),
            f"{bob}/work/photo.png": "png",
            f"{eve}/{NOTEBOOK}": notebook("eve"),
            f"{eve}/p3-pendulum-Copy1.ipynb": notebook("older"),
        },
    )
    rows = [
        {"number": 101, "name": "Ada Lovelace", "email": "ada@x.org", "submitted": IN_TIME},
        {"number": 102, "name": "Bob Doe, Jr.", "email": "BOB@x.org", "submitted": LATE},
        {"number": 103, "name": "Ève O'Neil", "submitted": LATE},
    ]
    said = collect(capsys, path, "--sheet", moodle_sheet(course / "sheet.csv", rows))
    assert submitted(course, "ada") == {
        NOTEBOOK: notebook("ada"),
        "data.csv": "1,2",
        "timestamp.txt": "2026-11-28 16:59:00 UTC\n",
    }
    assert submitted(course, "bob") == {
        NOTEBOOK: notebook("bob"),
        "photo.png": "png",
        "timestamp.txt": "2026-11-29 01:00:00 UTC\n",
    }
    assert submitted(course, "eve")[NOTEBOOK] == notebook("eve")
    assert (
        "ada: taken, handed in 2026-11-28 16:59 UTC; its notebook is called p3-pendulum (1).ipynb"
        not in said
    )
    assert (
        "the student's own timestamp.txt was left out; its notebook is called p3-pendulum (1).ipynb"
        in said
    )
    assert f"p3-pendulum-Copy1.ipynb lies beside {NOTEBOOK}, which counts" in said
    assert "3 taken, 0 left as they were, 2 of the class not there" in said


@pytest.mark.parametrize("since", [True, False])
def test_moodles_archive_alone_knows_names_and_no_times(course, capsys, since):
    path = zipped(
        course / "a.zip", {f"{moodle_folder('Lovelace Ada', 7, since)}/{NOTEBOOK}": notebook("a")}
    )
    assert "ada: taken, handed in at no known time" in collect(capsys, path)
    assert submitted(course, "ada") == {NOTEBOOK: notebook("a")}


def test_canvas_by_its_numbers_with_what_is_late(course, capsys):
    path = zipped(
        course / "submissions.zip",
        {
            canvas_name("Lovelace, Ada", 11, 901, "p3-pendulum-1.ipynb"): notebook("ada"),
            canvas_name("Doe, Jr., Bob", 12, 902, NOTEBOOK, late=True): notebook("bob"),
            canvas_name("Lee, Sam", 15, 903, NOTEBOOK): notebook("lee2"),
            "oneilève_13_text.html": "<p>typed</p>",
        },
    )
    said = collect(capsys, path, status=1)
    assert submitted(course, "ada") == {NOTEBOOK: notebook("ada")}
    assert submitted(course, "bob")["timestamp.txt"] == "2026-11-28 17:00:01 UTC\n"
    assert "Canvas calls it LATE and not by how much" in said
    assert submitted(course, "lee2") == {NOTEBOOK: notebook("lee2")}
    assert "oneilève: text was typed into Canvas, and no file handed in: nothing of this" in said
    assert not (course / "course" / "submitted" / "eve").exists()


def test_a_time_that_was_put_right_by_hand_stays(course, capsys):
    path = zipped(
        course / "a.zip", {canvas_name("Doe, Bob", 12, 9, NOTEBOOK, late=True): notebook("b")}
    )
    collect(capsys, path)
    stamp = course / "course" / "submitted" / "bob" / P3 / "timestamp.txt"
    stamp.write_text("2026-11-30 08:00:00 UTC\n")
    assert "bob: left, handed in 2026-11-30 08:00 UTC" in collect(capsys, path)
    assert stamp.read_text() == "2026-11-30 08:00:00 UTC\n"


def test_two_students_of_one_name_need_the_sheet(course, capsys):
    one, two = moodle_folder("Sam Lee", 201), moodle_folder("Sam Lee", 202)
    path = zipped(
        course / "a.zip", {f"{one}/{NOTEBOOK}": notebook("1"), f"{two}/{NOTEBOOK}": notebook("2")}
    )
    said = collect(capsys, path, status=1)
    assert said.count("Sam Lee may be any of lee1, lee2") == 2
    assert not (course / "course" / "submitted").exists()
    rows = [
        {"number": 201, "name": "Sam Lee", "email": "sam2@x.org"},
        {"number": 202, "name": "Sam Lee", "email": "sam1@x.org"},
    ]
    collect(capsys, path, "--sheet", moodle_sheet(course / "sheet.csv", rows))
    assert submitted(course, "lee1") == {NOTEBOOK: notebook("2")}
    assert submitted(course, "lee2") == {NOTEBOOK: notebook("1")}


@pytest.mark.parametrize("give", ["Participant_1_assignsubmission_file/{}", "anon_a1_90_{}"])
def test_an_archive_that_names_nobody_is_one_line(course, capsys, give):
    files = {give.format(NOTEBOOK).replace("1", number): notebook(number) for number in "123"}
    said = collect(capsys, zipped(course / "a.zip", files), status=1)
    listed = said.partition("To be looked at:\n")[2].splitlines()
    assert listed[0] == "  a.zip: it names nobody: show the names, and download it again"
    assert len(listed) <= 2


def test_two_hand_ins_that_would_be_one_students_are_neither(course, capsys):
    """One of the class, and one of the same name who is not in the list."""
    files = {f"{moodle_folder('Ada Lovelace', n)}/{NOTEBOOK}": notebook(str(n)) for n in (1, 2)}
    said = collect(capsys, zipped(course / "a.zip", files), status=1)
    assert "Ada Lovelace (1) and Ada Lovelace (2) would both be ada: none was taken" in said
    assert not (course / "course" / "submitted").exists()


def test_bad_input_is_listed_and_stops_nobody(course, capsys):
    (course / "page.zip").write_text("<html>")
    bad = zipped(
        course / "bad.zip",
        {
            f"{moodle_folder('Ada Lovelace', 1)}/{NOTEBOOK}": notebook("ada"),
            f"{moodle_folder('Nobody Known', 2)}/{NOTEBOOK}": notebook("x"),
            f"{moodle_folder('Bob Doe, Jr.', 3)}/{NOTEBOOK}": "<!DOCTYPE html>",
            f"{moodle_folder('Ève O`Neil', 4)}/scan.pdf": "%PDF",
            "../../evil.ipynb": "x",
            "readme.txt": "x",
        },
    )
    said = collect(capsys, course / "page.zip", bad, status=1)
    assert submitted(course, "ada") == {NOTEBOOK: notebook("ada")}
    listed = said.partition("To be looked at:\n")[2].splitlines()
    assert [line.strip() for line in listed] == [
        "page.zip: it is damaged, or no zip archive: download it again",
        "bad.zip: ../../evil.ipynb: its path leads out of the archive",
        "bad.zip: readme.txt: no name of a hand-in",
        "bad.zip: Nobody Known is not in course/class.csv: add the student, or mend the name there",
        f"bob: {NOTEBOOK} is no notebook",
        "eve: there is no notebook, only scan.pdf",
    ]
    assert not (course.parent / "evil.ipynb").exists()


def test_a_damaged_file_leaves_its_student_and_nobody_else(course, capsys):
    names = [
        f"{moodle_folder('Ada Lovelace', 1)}/{NOTEBOOK}",
        f"{moodle_folder('Bob Doe Jr', 2)}/{NOTEBOOK}",
    ]
    path = zipped(course / "a.zip", {name: notebook("x" * 900) for name in names})
    data = bytearray(path.read_bytes())
    data[30 + len(names[0].encode()) + 20] ^= 0xFF
    path.write_bytes(data)
    said = collect(capsys, path, status=1)
    assert "a.zip: Ada Lovelace: it" in said
    assert "nothing of this hand-in was taken" in said
    assert submitted(course, "bob") == {NOTEBOOK: notebook("x" * 900)}


def attempts(course, *times: str):
    """An archive and a sheet a time, each with a hand-in of ada's and eve's."""
    made = []
    for number, time in enumerate(times, 1):
        files = {f"{moodle_folder(name, at)}/{NOTEBOOK}": notebook(f"{name} {number}")
                 for at, name in enumerate(("Ada Lovelace", "Ève ONeil"), 1)}  # fmt: skip
        rows = [{"number": at, "name": name, "submitted": time}
                for at, name in enumerate(("Ada Lovelace", "Ève ONeil"), 1)]  # fmt: skip
        made.append((zipped(course / f"{number}.zip", files),
                     moodle_sheet(course / f"{number}.csv", rows)))  # fmt: skip
    return made


def test_the_last_hand_in_before_the_deadline_counts_and_nothing_is_lost(course, capsys):
    """eve has an extension, so that hers is the late one."""
    (first, one), (second, other) = attempts(course, IN_TIME, LATE)
    collect(capsys, first, "--sheet", one)
    said = collect(capsys, second, "--sheet", other)
    assert submitted(course, "ada")[NOTEBOOK] == notebook("Ada Lovelace 1")
    assert "ada: left" in said
    assert (
        "the hand-in that is there counts: 2026-11-28 16:59:00 UTC, and not 2026-11-29 01:00:00"
        in said
    )
    assert submitted(course, "eve")[NOTEBOOK] == notebook("Ève ONeil 2")
    assert f"the hand-in before it is now in course/replaced/eve/{P3}/1" in said
    kept = course / "course" / "replaced" / "eve" / P3 / "1"
    assert (kept / NOTEBOOK).read_text() == notebook("Ève ONeil 1")
    assert (kept / "timestamp.txt").read_text() == "2026-11-28 16:59:00 UTC\n"

    said = collect(capsys, second, "--sheet", other, "--latest")
    assert submitted(course, "ada")[NOTEBOOK] == notebook("Ada Lovelace 2")
    before = files(course / "course")
    assert collect(capsys, second, "--sheet", other, "--latest").count("unchanged") == 2
    assert files(course / "course") == before


def test_of_several_archives_at_once_the_choice_is_noted(course, capsys):
    files = {"early": notebook("early"), "later": notebook("later")}
    late = canvas_name("Lovelace, Ada", 11, 8, NOTEBOOK, late=True)
    on_time = canvas_name("Lovelace, Ada", 11, 7, NOTEBOOK)
    one = zipped(course / "one.zip", {on_time: files["early"]})
    two = zipped(course / "two.zip", {late: files["later"]})
    said = collect(capsys, one, two)
    assert submitted(course, "ada") == {NOTEBOOK: files["early"]}
    assert (
        "of several, the last in time counts: that in one.zip, and not 2026-11-28 17:00:01" in said
    )
    said = collect(capsys, zipped(course / "three.zip", {on_time: files["later"]}), status=0)
    assert submitted(course, "ada") == {NOTEBOOK: files["later"]}


def test_what_cannot_be_read_takes_the_place_of_nothing(course, capsys):
    name = canvas_name("Lovelace, Ada", 11, 7, NOTEBOOK)
    collect(capsys, zipped(course / "a.zip", {name: notebook("good")}))
    said = collect(capsys, zipped(course / "b.zip", {name: "half a note"}), status=1)
    assert submitted(course, "ada") == {NOTEBOOK: notebook("good")}
    assert f"ada: {NOTEBOOK} is no notebook; the hand-in that is there stays" in said


def test_a_number_that_leads_to_another_name_is_said(course, capsys):
    path = zipped(course / "a.zip", {canvas_name("Turing, Alan", 12, 7, NOTEBOOK): notebook("t")})
    assert "Canvas calls the student turingalan" in collect(capsys, path)


def test_canvas_gradebook_names_students_without_numbers_in_the_list(course, capsys):
    text = "".join(line.rsplit(",", 1)[0] + "\n" for line in CLASS.splitlines())
    (course / "course" / "class.csv").write_text(text)
    rows = [{"name": "Lee, Sam", "number": 15, "login": "sam2@x.org"}]
    sheet = canvas_sheet(course / "book.csv", rows, {"P3 (1)": "15"})
    path = zipped(course / "a.zip", {canvas_name("Lee, Sam", 15, 7, NOTEBOOK): notebook("s")})
    collect(capsys, path, status=1)
    collect(capsys, path, "--sheet", sheet)
    assert submitted(course, "lee2") == {NOTEBOOK: notebook("s")}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda at: (at / "class.csv").unlink(), "there is no class list: write course/class.csv"),
        (
            lambda at: (at / "class.csv").write_text("id\na\na\n"),
            "class.csv, line 3: id 'a' is that",
        ),
        (lambda at: (at / "calendar.toml").write_text("x = 1"), "calendar.toml, line 1: x is no"),
    ],
)
def test_without_its_files_it_says_what_to_do(course, capsys, change, said):
    change(course / "course")
    path = zipped(course / "a.zip", {"x": "y"})
    assert main(["collect-zip", P3, str(path)]) == 2
    assert said in capsys.readouterr().err


def test_a_hostile_name_reaches_neither_terminal_nor_disk(course, capsys):
    evil = "Ada\x1b[31m\u202e Lovelace"
    path = zipped(
        course / "a.zip",
        {f"{evil}_1_assignsubmission_file/{NOTEBOOK}": notebook("a"),
         f"{moodle_folder('Bob Doe Jr', 2)}/a\x1b]0;x\x07.ipynb": "x"},
    )  # fmt: skip
    said = collect(capsys, path, status=1)
    assert "\x1b" not in said
    assert "\u202e" not in said
    assert not (course / "course" / "submitted" / "bob").exists()


def test_times_are_those_of_the_courses_zone(course, capsys):
    (course / "course" / "calendar.toml").write_text('time-zone = "America/New_York"')
    name = moodle_folder("Ada Lovelace", 1)
    path = zipped(course / "a.zip", {f"{name}/{NOTEBOOK}": notebook("a")})
    rows = [{"number": 1, "name": "Ada Lovelace", "submitted": "Saturday, 4 July 2026, 8:00 PM"}]
    said = collect(capsys, path, "--sheet", moodle_sheet(course / "s.csv", rows))
    assert "handed in 2026-07-04 20:00 EDT" in said
    stamp = submitted(course, "ada")["timestamp.txt"].strip()
    assert datetime.strptime(stamp, "%Y-%m-%d %H:%M:%S UTC") == datetime(
        2026, 7, 5, 0, 0, tzinfo=UTC
    ).replace(tzinfo=None)
