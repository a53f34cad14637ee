"""What is kept of marked answers: whole, private, and of several programs at once."""

import json
import os
import stat
from concurrent.futures import ThreadPoolExecutor

import pytest

from autograder.marking.kept import COUNTS, FIRST, SECOND, Given, Kept, KeptError, Met, counting

GIVEN = Given((Met("why", 1.0, 0.5),), 0.5, "Go on.", "abc", "2026-01-01T00:00:00+00:00")


@pytest.fixture
def kept(tmp_path):
    (tmp_path / "course").mkdir(mode=0o700)
    return Kept(tmp_path)


def put(kept, student, cell="p-proof"):
    kept.change("p", cell, student, lambda entry: entry | {FIRST: GIVEN})


def test_what_is_kept_comes_back(kept):
    put(kept, "ada")
    assert kept.of("p", "p-proof") == {"ada": {FIRST: GIVEN}}
    assert kept.of("p", "other") == {}
    kept.change("p", "p-proof", "ada", lambda entry: {})
    assert kept.of("p", "p-proof") == {}


@pytest.mark.skipif(os.name != "posix", reason="only POSIX has these permissions")
@pytest.mark.parametrize(("course", "folder", "file"), [
    (0o700, 0o700, 0o600), (0o755, 0o700, 0o600), (0o2770, 0o770, 0o660),
])  # fmt: skip
def test_only_those_read_it_who_share_the_course(tmp_path, course, folder, file):
    (tmp_path / "course").mkdir()
    (tmp_path / "course").chmod(course)
    put(Kept(tmp_path), "ada")
    where = tmp_path / "course" / "marking"
    modes = [stat.S_IMODE(path.stat().st_mode) for path in (where, where / "p.json")]
    assert modes == [folder, file]


def test_of_many_writers_none_is_lost(kept):
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda number: put(kept, f"s{number}"), range(40)))
    assert len(kept.of("p", "p-proof")) == 40


@pytest.mark.parametrize(
    "text", ["{", "[]", '{"p-proof": 1}', '{"p-proof": {"ada": {"first": {}}}}']
)
def test_a_damaged_file_is_named_and_stays(kept, text):
    path = kept.folder() / "p.json"
    path.write_text(text)
    with pytest.raises(KeptError, match=r"p\.json is damaged: put a copy of it back"):
        put(kept, "ada")
    assert path.read_text() == text


def test_a_student_is_forgotten(kept):
    for student in ("ada", "bob"):
        put(kept, student)
    (path,) = kept.naming("ada")
    kept.forget(path, "ada")
    assert kept.naming("ada") == []
    assert json.loads(path.read_text()).keys() == {"p-proof"}
    assert kept.of("p", "p-proof").keys() == {"bob"}


def test_rows_stand_only_behind_the_points_that_count():
    other = Given((), 0.75, "", "", "")
    assert counting({FIRST: GIVEN}, 0.5) == GIVEN
    assert counting({FIRST: GIVEN}, 0.75) is None
    assert counting({FIRST: GIVEN, COUNTS: other}, 0.75) == other
    assert counting({SECOND: GIVEN}, 0.5) is None
    assert counting({FIRST: GIVEN}, None) is None
