"""The calendar of a term: times with their zones, penalties, extensions; errors name the line."""

from datetime import UTC, datetime

import pytest
from hypothesis import given
from hypothesis import strategies as st

from autograder import term_calendar
from autograder.term_calendar import NONE, ZERO, CalendarError, Penalty

GOOD = """
time-zone = "Europe/Berlin"
penalty = { percent-per-day = 10, most-percent = 50 }

[p3-pendulum]
due = "2026-03-28 18:00"

[p3-pendulum.extensions]
ada = "2026-03-30 18:00"
"bob x" = 2026-04-01

[p1-inertia]
due = 2026-05-01T12:00:00Z
penalty = "zero"
counts = false

[c6-regressor]
counts = true
"""


@pytest.fixture
def course(tmp_path):
    for name in ("p1-inertia", "p3-pendulum", "c6-regressor", "c7-recursive"):
        (tmp_path / "solutions" / name).mkdir(parents=True)
    (tmp_path / "course").mkdir()
    return tmp_path


def read(course, text: str):
    (course / "course" / "calendar.toml").write_text(text, encoding="utf-8")
    return term_calendar.read_if_there(course)


def test_times_have_the_zone_of_the_course_also_across_a_change_of_the_clock(course):
    of = read(course, GOOD).of("p3-pendulum")
    assert of.due == datetime(2026, 3, 28, 17, tzinfo=UTC)
    assert of.due_for("ada") == datetime(2026, 3, 30, 16, tzinfo=UTC)  # summer time by then
    assert of.due_for("bob x") == datetime(2026, 4, 1, 21, 59, 59, tzinfo=UTC)  # the day's end
    assert of.due_for("eve") == of.due
    assert of.penalty == Penalty(percent_per_day=10, most_percent=50)


def test_what_counts(course):
    calendar = read(course, GOOD)
    assert calendar.of("p1-inertia").penalty == ZERO
    counted = {name: calendar.counts(name)
               for name in ("p1-inertia", "p3-pendulum", "c6-regressor", "c7-recursive")}  # fmt: skip
    assert counted == {
        "p1-inertia": False,
        "p3-pendulum": True,
        "c6-regressor": True,
        "c7-recursive": False,
    }


def test_without_a_file_nothing_is_due_and_challenges_do_not_count(course):
    calendar = term_calendar.read_if_there(course)
    assert calendar.of("p3-pendulum") == term_calendar.Assignment()
    assert calendar.counts("p3-pendulum")
    assert not calendar.counts("c6-regressor")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('time-zone = "Mars/North"', "line 1: 'Mars/North' is no zone, such as Europe/Berlin"),
        ("time-zone = 1", "line 1: 1 is no zone"),
        ('timezone = "UTC"', "line 1: timezone is no setting; did you mean time-zone?"),
        ("\nlate = 3", "line 2: late is no setting; an assignment is written as [late]"),
        ("[p3-pendulum]\ndue = 2026-11-29T18:00", "line 2: Expected"),
        ("[p3-pendulum", ", at its end: Expected"),
        ('[p3-pendulum]\n\ndue = "soon"', "line 3: 'soon' is no time"),
        ("[p3-pendulum]\ndue = 18:00:00", "is no time"),
        (
            'time-zone = "Europe/Berlin"\n[p3-pendulum]\ndue = "2026-03-29 02:30"',
            "line 3: there is no 2026-03-29 02:30:00 in Europe/Berlin, where clocks go forward then",
        ),
        ('[p3-pendulum]\ndeu = "2026-01-01"', "line 2: deu is no setting; there are due,"),
        ("[p3-pendulum]\ncounts = 1", "line 2: 1 is neither true nor false"),
        ('[p3-pendulum]\npenalty = "half"', 'line 2: \'half\' is neither "none" nor "zero"'),
        ("penalty = {a-day = 1}", "line 1: a penalty has no a-day, but points-per-day"),
        ("penalty = {points-per-day = -1}", "line 1: points-per-day = -1 is no number from 0 on"),
        ("penalty = {points-per-day = true}", "line 1: points-per-day = True is no number"),
        ("penalty = {points-per-day = nan}", "line 1: points-per-day = nan is no number"),
        ('[p3-pendulum.extensions]\nada = "2026-01-01"', "line 1: there are extensions, but p3"),
        ('[p3-pendulum]\nextensions = "2026-01-01"', "line 2: extensions are written below"),
        (
            '[p1-inertia]\n[p3-pendlum]\ndue = "2026-01-01"',
            "line 2: there is no assignment p3-pendlum",
        ),
        (
            '[p3-pendulum]\ndue = "2026-01-01"\n[p3-pendulum.extensions]\n\nada = "tomorrow"',
            "line 5: 'tomorrow' is no time",
        ),
    ],
)
def test_what_is_wrong_is_named_with_its_line(course, text, said):
    with pytest.raises(CalendarError) as refused:
        read(course, text)
    assert said in str(refused.value)
    assert str(refused.value).startswith(str(course / "course" / "calendar.toml"))


def test_an_extension_for_nobody_is_a_slip(course):
    (course / "course" / "class.csv").write_text("id\nada\n")
    with pytest.raises(
        CalendarError, match=r"line 10: the class list, .*class\.csv, has no student bob x"
    ):
        read(course, GOOD)


@pytest.mark.parametrize(
    ("penalty", "points", "hours", "lost"),
    [
        (Penalty(points_per_day=1), 10, 0.01, 1),
        (Penalty(points_per_day=1), 10, 24, 1),
        (Penalty(points_per_day=1), 10, 24.01, 2),
        (Penalty(points_per_day=1), 0.5, 99, 0.5),
        (Penalty(percent_per_day=10), 15, 1, 1.5),
        (Penalty(percent_per_day=10, most_percent=50), 15, 240, 7.5),
        (Penalty(points_per_day=2, most_points=3), 15, 72, 3),
        (Penalty(points_per_day=1, grace_minutes=15), 10, 0.25, 0),
        (Penalty(points_per_day=1, grace_minutes=15), 10, 0.26, 1),
        (ZERO, 15, 0.01, 15),
        (NONE, 15, 99, 0),
    ],
)
def test_what_is_lost(penalty, points, hours, lost):
    assert penalty.of(points, hours * 3600) == pytest.approx(lost)


AMOUNTS = st.floats(0, 1000)


@given(
    st.builds(Penalty, AMOUNTS, AMOUNTS, AMOUNTS, AMOUNTS),
    AMOUNTS,
    st.floats(0, 1e7),
    st.floats(0, 1e7),
)
def test_nobody_loses_more_than_there_is_and_later_is_never_cheaper(penalty, points, one, other):
    early, late = sorted((one, other))
    assert 0 <= penalty.of(points, early) <= penalty.of(points, late) <= points


def test_a_students_extensions_are_taken_out_and_every_other_line_stays():
    text, taken = term_calendar.without_extensions(GOOD, "bob x")
    assert taken == 1
    assert text == GOOD.replace('"bob x" = 2026-04-01\n', "")
    assert term_calendar.without_extensions(GOOD, "due") == (GOOD, 0)
