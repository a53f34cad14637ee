"""What an archive says of itself."""

import shutil
import subprocess
from collections.abc import Iterable
from datetime import datetime
from importlib.metadata import version
from pathlib import Path

from autograder.lms.marks import Marks
from autograder.lms.sheet import written

WHOLE = """\
The course {course} as it was on {when:%Y-%m-%d %H:%M %Z}, written by `autograder archive`.

Kit: {kit}
Students: {students}
Assignments: {assignments}

marks.csv              a row for each student and assignment
marks-by-student.csv   a row for each student
course/                all that the course held: gradebook.db, submitted/, autograded/, feedback/,
                       release/, seed, and class.csv and calendar.toml if there were such files
solutions/, checks/, nbgrader_config.py   by which it was graded
SHA256SUMS             a sum of each file

Is it whole?  In this folder:  sha256sum --check --quiet SHA256SUMS
To look at it again, install that version of the kit and start its commands in this folder,
such as  autograder export --to again.csv

This archive names students. Keep it where nobody else can read it, and for no longer than your
university's rules say.
{left}"""
NAMELESS = """\
The marks of the course {course}, {when:%Y}, without names, written by `autograder archive --pseudonyms`.

Kit: {kit}
Students: {students}
Assignments: {assignments}

The students are in a random order, and no list of who is who was kept. Nothing that a student wrote
is in here, and no time of a hand-in. In a small class, somebody who knows a few marks of a student
may still find the row.
"""


def about(text: str, course: str, root: Path, marks: Marks, left: Iterable[str] = ()) -> bytes:
    """ABOUT.txt of an archive. text: WHOLE or NAMELESS. left: what is not in it, in lines."""
    names = [f"{one.assignment} ({written(one.most)} points)" for one in marks.columns]
    given = {
        "course": course,
        "when": datetime.now().astimezone(),
        "kit": _kit(root),
        "students": len(marks.people),
        "assignments": ", ".join(names) or "none",
        "left": "".join(f"\nNot in it: {line}" for line in left) + "\n",
    }
    return text.format(**given).rstrip().encode() + b"\n"


def _kit(root: Path) -> str:
    """The version, and the commit where the course's folder is a checkout."""
    git, said = shutil.which("git"), f"armdyn {version('armdyn')}"
    if git and (root / ".git").exists():
        asked = [git, "-C", str(root), "rev-parse", "HEAD"]
        found = subprocess.run(asked, capture_output=True, text=True, timeout=60, check=False)
        if found.returncode == 0:
            said += f", commit {found.stdout.strip()}"
    return said
