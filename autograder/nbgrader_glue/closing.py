"""What nbgrader knows of a year that is to be closed: its gradebook, and what is still to be done."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from nbgrader import api
from nbgrader.coursedir import CourseDirectory
from nbgrader.utils import notebook_hash
from sqlalchemy import Engine, MetaData, create_engine, make_url, select

from autograder.lms.marks import GRADED, UNGRADED, UNREAD, Marks
from autograder.nbgrader_glue.folders import QUIET
from autograder.nbgrader_glue.marks import pages_of
from autograder.nbgrader_glue.release import configuration
from autograder.terminal import shown_name

GRADEBOOK = Path("course") / "gradebook.db"
MOST_NAMED = 5
VERSIONS = "alembic_version"


class Closing:
    """One course. root: its folder. ValueError if it keeps students' work elsewhere than in course/."""

    def __init__(self, root: Path):
        self.root = root
        self._config = configuration(root)
        self._course = CourseDirectory(config=self._config, log=QUIET)
        self.name: str = self._course.course_id
        inside = (root / "course").resolve()
        for step in ("release", "submitted", "autograded", "feedback"):
            folder = Path(self._course.root, getattr(self._course, f"{step}_directory"))
            top = Path(self._course.root, "course", folder.name)
            if not folder.resolve().is_relative_to(inside) and not top.is_symlink():
                raise ValueError(
                    f"{folder} is not in course/, which is what an archive keeps: put it there, and "
                    f"set {step}_directory in nbgrader_config.py"
                )

    @property
    def file_of_gradebook(self) -> Path | None:
        """None where the gradebook is no file, but on a server."""
        url = make_url(self._course.db_url)
        return Path(url.database) if url.drivername.startswith("sqlite") and url.database else None

    @property
    def address_of_gradebook(self) -> str:
        return make_url(self._course.db_url).render_as_string(hide_password=True)

    @property
    def exchange_elsewhere(self) -> Path | None:
        """The exchange where it is not in course/, and so in no archive."""
        given = self._config.Exchange.get("root")
        if not isinstance(given, str) or Path(given).resolve().is_relative_to(
            (self.root / "course").resolve()
        ):
            return None
        return Path(given) / self.name

    def copy_gradebook(self, to: Path) -> None:
        """Write the gradebook as it is at one moment, as a file that nbgrader reads."""
        if file := self.file_of_gradebook:
            with closing(sqlite3.connect(file)) as held, closing(sqlite3.connect(to)) as new:
                held.backup(new)
        else:
            source, target = create_engine(self._course.db_url), create_engine(f"sqlite:///{to}")
            try:
                _copy_tables(source, target)
            finally:
                source.dispose()
                target.dispose()

    def still_open(self, marks: Marks) -> Iterator[str]:
        """What has to be done before a year is over, in lines that name students."""
        for column in marks.columns:
            state = {one: {id for id, mark in column.marks.items() if mark.state == one}
                     for one in (UNREAD, UNGRADED, GRADED)}  # fmt: skip
            pages = {
                id: found for id, found in pages_of(self.root, column.assignment).items() if found
            }
            unreleased = {id for id in state[GRADED]
                          if any(not self._released(page) for page in pages.get(id, ()))}  # fmt: skip
            found = {
                "a proof not yet marked": state[UNREAD],
                "handed in and not graded": state[UNGRADED],
                "graded, and no feedback page is made": state[GRADED] - pages.keys(),
                "the feedback page is not released, or has changed since": unreleased,
            }
            for what, students in found.items():
                if students:
                    yield f"{column.assignment}: {what}: {_named(students)}"
        if waiting := set(self._uncollected()):
            yield f"handed in and not collected: {_named(waiting)}"

    def _released(self, page: Path) -> bool:
        """Whether students can fetch this page; also true where they handed in by another way."""
        secret = page.parent / "submission_secret.txt"
        given = self._config.Exchange.get("root")
        if not secret.is_file() or not isinstance(given, str):
            return True
        name = notebook_hash(secret=secret.read_text(), notebook_id=page.stem)
        there = Path(given) / self.name / "feedback" / f"{name}.html"
        return there.is_file() and there.read_bytes() == page.read_bytes()

    def _uncollected(self) -> Iterator[str]:
        given = self._config.Exchange.get("root")
        inbound = Path(given) / self.name / "inbound" if isinstance(given, str) else Path()
        for folder in sorted(inbound.glob("*+*+*")):
            student, assignment, when, *_ = folder.name.split("+")
            held = Path(
                self._course.format_path(self._course.submitted_directory, student, assignment)
            )
            time = held / "timestamp.txt"
            if not held.is_dir() or (time.is_file() and time.read_text().strip() < when):
                yield student


def _copy_tables(source: Engine, target: Engine) -> None:
    """All that nbgrader keeps, from one database into another, which is empty."""
    versions = MetaData()
    versions.reflect(source, only=[VERSIONS])
    with source.connect() as old, target.begin() as new:
        for table in [*api.Base.metadata.sorted_tables, versions.tables[VERSIONS]]:
            table.create(new)
            if rows := [dict(row) for row in old.execute(select(table)).mappings()]:
                new.execute(table.insert(), rows)


def _named(students: set[str]) -> str:
    shown = [shown_name(one) for one in sorted(students)]
    more = f" and {len(shown) - MOST_NAMED} more" if len(shown) > MOST_NAMED else ""
    return f"{len(shown)} ({', '.join(shown[:MOST_NAMED])}{more})"
