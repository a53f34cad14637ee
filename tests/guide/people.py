"""What students and instructors do between the commands of a page."""

import json
from datetime import UTC, datetime
from pathlib import Path

from nbgrader.api import Gradebook

from tests.autograder import courses
from tests.autograder.courses import NOTEBOOK, P3
from tests.submissions import p3_pendulum

COURSE = "armdyn"
IN_TIME = datetime(2026, 11, 28, 10, tzinfo=UTC)


def notebook(root: Path, kind: str) -> str:
    """A submission to p3 as it is released in the course `root`, of a kind of tests/submissions."""
    return json.dumps(p3_pendulum.CLASS[kind](courses.release(root)))


def hand_in(root: Path, student: str, kind: str, when: datetime = IN_TIME) -> None:
    """As Submit puts it into the exchange."""
    time = f"{when:%Y-%m-%d %H:%M:%S.%f} UTC"
    inbound = root / "course" / "exchange" / COURSE / "inbound"
    folder = inbound / f"{student}+{P3}+{time}+secret-of-{student}"
    folder.mkdir()
    (folder / NOTEBOOK).write_text(notebook(root, kind))
    (folder / "timestamp.txt").write_text(time)
    (folder / "submission_secret.txt").write_text(f"secret of {student}")


def lay_in(root: Path, student: str, kind: str, when: datetime = IN_TIME) -> None:
    """As an instructor puts a notebook that came by mail into its folder."""
    courses.submit(root, student, json.loads(notebook(root, kind)), f"{when:%Y-%m-%d %H:%M:%S} UTC")


def mark_proofs(root: Path) -> None:
    """As the formgrader does: each proof that waits gets 4 points."""
    with Gradebook(courses.database(root)) as gradebook:
        for submission in gradebook.assignment_submissions(P3):
            for one in submission.notebooks:
                for grade in one.grades:
                    if grade.needs_manual_grade:
                        grade.manual_score, grade.needs_manual_grade = 4, False
        gradebook.db.commit()
