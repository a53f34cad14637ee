"""The student version of an assignment, written without the gradebook."""

import shutil
import tempfile
from pathlib import Path

from traitlets.config import Config, PyFileConfigLoader


def configuration(root: Path) -> Config:
    """What nbgrader_config.py in the course's folder says."""
    return PyFileConfigLoader("nbgrader_config.py", path=str(root)).load_config()


def write_problem(root: Path, assignment: str, to: Path) -> None:
    """The student version of an assignment in the folder `to`; no file that is there is touched.

    root: the course's folder. The gradebook is not touched either.
    """
    with tempfile.TemporaryDirectory(prefix="release-") as folder:
        _generate(root, assignment, folder)
        _copy_new(Path(folder) / assignment, to)


def _generate(root: Path, assignment: str, folder: str) -> None:
    from nbgrader.converters import GenerateAssignment  # takes seconds
    from nbgrader.coursedir import CourseDirectory

    config = configuration(root)
    config.CourseDirectory.release_directory = folder
    config.CourseDirectory.assignment_id = assignment
    config.GenerateAssignment.no_database = True
    config.SaveCells.enabled = False
    coursedir = CourseDirectory(config=config)
    GenerateAssignment(coursedir=coursedir, config=config).start()


def _copy_new(folder: Path, to: Path) -> None:
    for path in folder.rglob("*"):
        target = to / path.relative_to(folder)
        if path.is_file() and not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, target)
