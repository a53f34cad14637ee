"""Writes the student version of an assignment, without the gradebook."""

import logging
import shutil
import tempfile
from pathlib import Path

from traitlets.config import Config, PyFileConfigLoader

from autograder.files import put_in_place
from autograder.nbgrader_glue.kept_editions import keep

PLAIN = "assignment"  # a name that is no pattern


def configuration(root: Path) -> Config:
    """The settings of nbgrader_config.py in the course's folder."""
    return PyFileConfigLoader("nbgrader_config.py", path=str(root)).load_config()


def write_problem(root: Path, assignment: str, to: Path) -> None:
    """Write the student version of an assignment into the folder `to`; files that are there stay.

    root: the course's folder. The gradebook stays as it is.
    """
    with tempfile.TemporaryDirectory(prefix="release-") as folder:
        made = generate(root, assignment, Path(folder))
        keep(root, assignment, made / f"{assignment}.ipynb")
        _copy_new(made, to)


def generate(root: Path, assignment: str, course: Path, log: logging.Logger | None = None) -> Path:
    """Make a course with only this assignment, and return the folder of the student version in it.

    course: an empty folder. log: where nbgrader writes what it does. The real course does not serve, as
    its path, and the assignment's name, may contain what nbgrader takes for a pattern.
    """
    from nbgrader.converters import GenerateAssignment  # takes seconds
    from nbgrader.coursedir import CourseDirectory

    config = configuration(root)
    own = CourseDirectory(config=config)
    shutil.copytree(
        own.format_path(own.source_directory, ".", assignment), course / "source" / PLAIN
    )
    config.CourseDirectory = Config(root=str(course), assignment_id=PLAIN)
    config.GenerateAssignment.no_database = True
    config.SaveCells.enabled = False
    more = {} if log is None else {"log": log}
    GenerateAssignment(coursedir=CourseDirectory(config=config), config=config, **more).start()
    return course / "release" / PLAIN


def _copy_new(folder: Path, to: Path) -> None:
    for path in folder.rglob("*"):
        target = to / path.relative_to(folder)
        if path.is_file() and not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            put_in_place(
                target, path.read_bytes()
            )  # half a notebook would be kept as a student's own
