"""Reads and writes a course's submissions for `autograder collect-zip`, where nbgrader has them."""

import os
import shutil
from datetime import UTC
from pathlib import Path

from nbgrader.coursedir import CourseDirectory

from autograder.files import put_in_place
from autograder.lms.hand_in import RESERVED, HandIn
from autograder.nbgrader_glue import names, submitted
from autograder.nbgrader_glue.folders import QUIET
from autograder.nbgrader_glue.release import configuration
from autograder.roster import Person

REPLACED = Path("course") / "replaced"  # hand-ins that others took the place of
TIME = "%Y-%m-%d %H:%M:%S UTC"


class Submissions:
    """The submissions of one assignment. root: the course's folder."""

    def __init__(self, root: Path, assignment: str):
        config = configuration(root)
        config.CourseDirectory.assignment_id = assignment
        self._root, self._assignment = root, assignment
        self._course = CourseDirectory(config=config, log=QUIET)

    def held(self, person: Person) -> HandIn | None:
        """What is there of a student's; ValueError if the grader cannot read it, or its name."""
        if why := names.refusal(person.id):
            raise ValueError(why)
        folder = self._folder(person.id)
        if not folder.is_dir():
            return None
        submitted.check(folder, Path(self._course.root) / self._course.submitted_directory)
        when = submitted.timestamp(folder)
        files = {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in sorted(folder.rglob("*"))
            if path.is_file() and path.name not in RESERVED and not _is_checkpoint(path)
        }
        shown = os.path.relpath(folder, self._root)
        return HandIn(person, shown, files, when.replace(tzinfo=UTC) if when else None)

    def put(self, new: HandIn) -> str:
        """Put a hand-in there; where that which was there before is now, or ""."""
        folder = self._folder(new.person.id)
        part = folder.parent / f".new-{folder.name}"
        shutil.rmtree(part, ignore_errors=True)
        try:
            for name, data in new.files.items():
                target = part / name
                target.parent.mkdir(parents=True, exist_ok=True)
                put_in_place(target, data)
            if new.when:
                part.mkdir(parents=True, exist_ok=True)
                put_in_place(part / "timestamp.txt", new.when.astimezone(UTC).strftime(TIME) + "\n")
            before = self._set_aside(new.person.id, folder)
            part.rename(folder)
        except BaseException:
            shutil.rmtree(part, ignore_errors=True)
            raise
        return before

    def _set_aside(self, student: str, folder: Path) -> str:
        if not folder.exists():
            return ""
        above = self._root / REPLACED / student / self._assignment
        above.mkdir(parents=True, exist_ok=True)
        number = 1 + max(
            (int(one.name) for one in above.iterdir() if one.name.isdecimal()), default=0
        )
        kept = above / str(number)
        folder.rename(kept)
        return str(kept.relative_to(self._root))

    def _folder(self, student: str) -> Path:
        course = self._course
        return Path(course.format_path(course.submitted_directory, student, self._assignment))


def _is_checkpoint(path: Path) -> bool:
    return ".ipynb_checkpoints" in path.parts
