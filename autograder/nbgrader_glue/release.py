"""The student version of an assignment, written without the gradebook."""

import shutil
import tempfile
from pathlib import Path

from traitlets.config import Config, PyFileConfigLoader

from autograder.files import put_in_place


def configuration(root: Path) -> Config:
    """What nbgrader_config.py in the course's folder says."""
    return PyFileConfigLoader("nbgrader_config.py", path=str(root)).load_config()


def write_problem(root: Path, assignment: str, to: Path) -> None:
    """The student version of an assignment in the folder `to`; no file that is there is touched.

    root: the course's folder. The gradebook is not touched either.
    """
    with tempfile.TemporaryDirectory(prefix="release-") as folder:
        _copy_new(_generate(root, assignment, Path(folder)), to)


def _generate(root: Path, assignment: str, course: Path) -> Path:
    """The student version's folder, in a course of this assignment alone, which is made.

    Not in the course itself: the path to that may hold what nbgrader takes for a pattern.
    """
    from nbgrader.converters import GenerateAssignment  # takes seconds
    from nbgrader.coursedir import CourseDirectory

    config = configuration(root)
    own = CourseDirectory(config=config)
    shutil.copytree(
        own.format_path(own.source_directory, ".", assignment), course / "source" / assignment
    )
    config.CourseDirectory = Config(root=str(course), assignment_id=assignment)
    config.GenerateAssignment.no_database = True
    config.SaveCells.enabled = False
    GenerateAssignment(coursedir=CourseDirectory(config=config), config=config).start()
    return course / "release" / assignment


def _copy_new(folder: Path, to: Path) -> None:
    for path in folder.rglob("*"):
        target = to / path.relative_to(folder)
        if path.is_file() and not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            put_in_place(
                target, path.read_bytes()
            )  # half a notebook would be kept as a student's own
