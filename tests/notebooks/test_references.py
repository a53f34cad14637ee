"""The lessons cite what docs/references.toml has, all of it, and as it stands there."""

import re

import pytest

from tests.notebooks.references import (
    LESSONS,
    ROOT,
    cited_in,
    entry_of,
    listed_in,
    page,
    parts,
    references,
)

EVERY = references()


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_each_line_of_a_list_is_one_of_the_file(lesson):
    lines = listed_in(lesson)
    assert lines
    assert [line for line in lines if entry_of(line, EVERY) is None] == []


def test_each_of_the_file_is_listed_in_a_lesson():
    listed = {entry_of(line, EVERY) for lesson in LESSONS for line in listed_in(lesson)}
    assert [r.key for r in EVERY if r not in listed] == []


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_what_the_text_cites_is_in_the_lessons_list(lesson):
    listed = {entry_of(line, EVERY).key for line in listed_in(lesson)}
    assert set(cited_in(parts(lesson)[0])) <= listed


def test_keys_are_name_and_year_and_dois_are_dois():
    for r in EVERY:
        first = r.authors.partition(",")[0].split()[-1]
        assert r.key == f"{first} {r.year}"
        assert not r.doi or re.fullmatch(r"10\.\d{4,5}/\S+", r.doi), r.key
    dois = [r.doi for r in EVERY if r.doi]
    assert len(dois) == len(set(dois)) >= 20
    assert [r.year for r in EVERY] == sorted(r.year for r in EVERY)


def test_the_page_is_that_of_today():
    assert (ROOT / "docs" / "references.md").read_text(encoding="utf-8") == page()


@pytest.mark.parametrize(
    ("text", "keys"),
    [
        ("the hand (Khatib 1987).", ["Khatib 1987"]),
        ("Luh, Walker and Paul (1980) count", ["Luh 1980"]),
        ("Spong and Vidyasagar (1989) write", ["Spong 1989"]),
        ("again (Ortega et al. 2002)", ["Ortega 2002"]),
        ("in 1987 it was", []),
    ],
)
def test_what_a_text_cites(text, keys):
    assert cited_in(text) == keys


@pytest.mark.parametrize(
    ("line", "key"),
    [
        ("- P. Corke (2020 on), *bdsim: block diagram simulation for Python*.", "Corke 2020"),
        (
            "- J. J. Craig (1989), *Introduction to Robotics: Mechanics and Control*: easy.",
            "Craig 1989",
        ),
        ("- J. J. Craig (1988), *Introduction to Robotics: Mechanics and Control*.", None),
        ("- J. J. Craig (1989), *Introduction to Robotics*.", None),
        ("J. J. Craig (1989)", None),
    ],
)
def test_a_line_that_differs_is_noticed(line, key):
    entry = entry_of(line, EVERY)
    assert (entry and entry.key) == key
