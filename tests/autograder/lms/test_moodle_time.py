"""Times as Moodle writes them out, in many languages."""

from datetime import datetime
from zoneinfo import ZoneInfo

import pytest

from autograder.lms import moodle_time

BERLIN = ZoneInfo("Europe/Berlin")


@pytest.mark.parametrize(
    "text",
    [
        "Sunday, 29 November 2026, 11:03 PM",
        "Sunday, 29 November 2026, 11:03\u202fPM",
        "Sonntag, 29. November 2026, 23:03",
        "dimanche 29 novembre 2026, 23:03",
        "domingo, 29 de noviembre de 2026, 23:03",
        "domenica, 29 novembre 2026, 23:03",
        "niedziela, 29 listopada 2026, 23:03",
        "neděle, 29. listopadu 2026, 23.03",
        "воскресенье, 29 ноября 2026, 23:03",
        "söndag, 29 november 2026, 23:03",
        "sunnuntai, 29. marraskuuta 2026, 23.03",
        "Κυριακή, 29 Νοεμβρίου 2026, 11:03 μμ",
        "2026年11月29日(日曜日) 23:03",
        "2026年11月29日 星期日 23:03",
        "29.11.2026, 23:03",
        "2026-11-29 23:03",
        "29 Nov 2026, 23:03",
    ],
)
def test_one_evening_in_many_languages(text):
    assert moodle_time.is_like_one(text)
    assert moodle_time.read(text, BERLIN) == datetime(2026, 11, 29, 23, 3, tzinfo=BERLIN)


def test_noon_and_midnight():
    assert moodle_time.read("Monday, 30 November 2026, 12:05 AM", BERLIN).hour == 0
    assert moodle_time.read("Monday, 30 November 2026, 12:05 PM", BERLIN).hour == 12


def test_a_word_for_two_months_is_told_by_the_day_of_the_week():
    """listopad is November in Polish and October in Croatian."""
    assert moodle_time.read("četvrtak, 29. listopada 2026, 23:03", BERLIN).month == 10


@pytest.mark.parametrize(
    "text",
    [
        *("-", "", "No submission", "yesterday", "03/04/2026 23:03", "29 listopada 2026, 23:03"),
        *("Sunday, 31 November 2026, 11:03 PM", "Monday, 29 November 2026, 11:03 PM"),
        *("29 November 2026", "Sunday, 29 November 2026, 25:03", "9" * 5000),
    ],
)
def test_what_is_not_clear_is_no_time(text):
    with pytest.raises(ValueError, match="is no time that can be read"):
        moodle_time.read(text, BERLIN)
