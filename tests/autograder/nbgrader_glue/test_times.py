"""When something was handed in, in the forms in which people and programs write it."""

from datetime import datetime

import pytest
from nbgrader import utils

from autograder.nbgrader_glue import times

NOON = datetime(2026, 11, 28, 12, 0)
READ = {
    "2026-11-28 12:00:00 UTC": NOON,  # as nbgrader's exchange writes it
    "2026-11-28 12:00:00.000000 UTC": NOON,
    "2026-11-28 12:00:00": NOON,
    "2026-11-28 13:00:00 +0100": NOON,
    "2026-11-28 13:00:00 +01:00": NOON,
    "2026-11-28T13:00:00+01:00": NOON,
    "2026-11-28T12:00:00Z": NOON,
    "2026-11-28 04:00:00 PST": NOON,
    "2026-11-28 13:00:00 CET": NOON,
    "2026-07-28 14:00:00 CEST": datetime(2026, 7, 28, 12, 0),
    "2026-11-28 13:00:00 Europe/Berlin": NOON,
    "2026-07-28 14:00:00 Europe/Berlin": datetime(2026, 7, 28, 12, 0),
    "Sat Nov 28 13:00:00 CET 2026": NOON,
    "Sat, 28 Nov 2026 07:00:00 -0500": NOON,
    "2026-11-28 13:00:00 GMT+1": NOON,
    "": None,
}
NO_TIME = [
    "never ever",
    "2025",
    "12:00:00",
    "01/02/2026 12:00",
    "28 Nov 12:00",
    "2026-11-28 25:00:00 UTC",
    "2026-11-28 12:00:00 IST",
    "2026-11-28 12:00:00 XYZ",
    "2026-11-28 12:00:00 No/Where",
    "2026-11-28 12:00:00 +9999",
    "0001-01-01 00:00:00 +0100",
]


@pytest.mark.parametrize("text", READ)
def test_a_time_is_read_with_its_zone(text):
    assert times.read(f" {text}\n") == READ[text]


@pytest.mark.parametrize("text", NO_TIME)
def test_what_is_no_certain_time_is_refused(text):
    with pytest.raises(ValueError, match=r"."):
        times.read(text)


@pytest.mark.parametrize("text", READ)
def test_nbgrader_reads_the_same_afterwards_and_nothing_is_lost(tmp_path, text):
    file = tmp_path / times.FILE
    file.write_text(text)
    assert times.of(tmp_path) == times.of(tmp_path) == READ[text]
    if text:
        assert utils.parse_utc(file.read_text().strip()) == READ[text]
    kept = tmp_path / times.ORIGINAL
    assert text in (file.read_text(), kept.read_text() if kept.exists() else "")
    assert times.note(tmp_path) == ""


@pytest.mark.parametrize("text", NO_TIME)
def test_no_time_is_put_aside_until_there_is_one(tmp_path, text):
    file = tmp_path / times.FILE
    file.write_text(text)
    assert times.of(tmp_path) is None
    assert not file.exists()
    assert (tmp_path / times.ORIGINAL).read_text() == text
    assert f"{text!r}" in times.note(tmp_path)
    file.write_text("2026-11-28 12:00:00 UTC")
    assert times.of(tmp_path) == NOON
    assert times.note(tmp_path) == ""
