"""The page of benchmarks keeps the figures of the run before beside the new ones."""

import re
from datetime import date
from pathlib import Path

import pytest

from tests.benchmarks import report
from tests.benchmarks.last_run import DATE, TABLE, beside_last, rows_of
from tests.benchmarks.timing import Row, table

PAGE = Path(__file__).parents[2] / "docs" / "benchmarks.md"
FIRST = """\
How it is timed.

| what | ours | peer | ratio |
|---|---|---|---|
| one state | 3 µs | Pinocchio 2 µs | 1.50 × |
| gone | 9 µs | Pinocchio 1 µs | 9.00 × |

Below the table.
"""
SECOND = FIRST.replace("3 µs", "1 µs").replace("1.50 ×", "0.50 ×").replace("gone", "new")
MEASURED = ("ours", "ratio")


def test_a_first_run_has_no_last_figures():
    assert (
        beside_last(FIRST, "", MEASURED, date(2026, 1, 2))
        == """\
How it is timed.

Measured on 2026-01-02.

| what | ours | last | peer | ratio | last |
|---|---|---|---|---|---|
| one state | 3 µs |  | Pinocchio 2 µs | 1.50 × |  |
| gone | 9 µs |  | Pinocchio 1 µs | 9.00 × |  |

Below the table.
"""
    )


def test_each_run_shows_the_run_before_it_and_no_older_one():
    page = beside_last(FIRST, "", MEASURED, date(2026, 1, 2))
    page = beside_last(SECOND, page, MEASURED, date(2026, 3, 4))
    assert "Measured on 2026-03-04; the last run was on 2026-01-02." in page
    assert "| one state | 1 µs | 3 µs | Pinocchio 2 µs | 0.50 × | 1.50 × |" in page
    assert "| new | 9 µs |  | Pinocchio 1 µs | 9.00 × |  |" in page
    assert "gone" not in page
    page = beside_last(SECOND, page, MEASURED, date(2026, 5, 6))
    assert "Measured on 2026-05-06; the last run was on 2026-03-04." in page
    assert "| one state | 1 µs | 1 µs | Pinocchio 2 µs | 0.50 × | 0.50 × |" in page
    assert "3 µs" not in page


def test_a_section_is_written_anew_and_the_others_stay(tmp_path):
    file = tmp_path / "page.md"
    rows = [Row("one state", 3e-6, "Pinocchio", 2e-6, 1.0)]
    report.put(file, "Library", table(rows), measured=MEASURED)
    report.put(file, "Feedback", "| check | time |\n|---|---|\n| p1-M | 30 ms |\n", ("time",))
    feedback = file.read_text(encoding="utf-8").partition("## Feedback\n")[2]
    report.put(file, "Library", table(rows), measured=MEASURED)
    text = file.read_text(encoding="utf-8")
    assert text.startswith(report.HEAD)
    assert text.partition("## Feedback\n")[2] == feedback
    assert "| one state | 3 µs | 3 µs | Pinocchio 2 µs | 1.50 × | 1.50 × | 1.00 × | no |" in text
    assert "\n\n## Feedback\n\n" in text


@pytest.mark.parametrize(
    ("title", "measured"),
    [
        ("The library", ("ours", "ratio")),
        ("Grading", ("ours", "ratio")),
        ("Feedback", ("time",)),
        ("Ports", ("start", "states/s", "RK4 steps/s")),
    ],
)
def test_the_next_run_finds_every_figure_of_the_page(title, measured):
    parts = re.split(r"^## ", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    (section,) = [part for part in parts if part.startswith(f"{title}\n")]
    assert DATE.search(section)
    rows = rows_of(TABLE.search(section).group())
    assert len({next(iter(row.values())) for row in rows}) == len(rows) > 3
    assert all(set(measured) <= set(row) for row in rows)
