"""Prepares a Jupyter server for the course, however the server was started.

`make lab`, `autograder lab` and plain `jupyter lab` all load this server extension. It changes
nothing in a server that is started outside a course.
"""

import logging
import os
from pathlib import Path
from typing import Any

import zmq
from jupyter_server.extension.serverextension import toggle_server_extension_python
from jupyter_server.serverapp import ServerApp
from jupyter_server.services.contents.largefilemanager import AsyncLargeFileManager
from traitlets import Bool

# Files that students do not need. Files that they add to the course's folder are shown.
NOT_FOR_STUDENTS = (
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "LICENSE",
    "Makefile",
    "README.md",
    "SECURITY.md",
    "archive",
    "armdyn.egg-info",
    "armdyn.json",
    "autograder",
    "build",
    "constraints.txt",
    "containers",
    "course",
    "docs",
    "lib",
    "nbgrader_config.py",
    "pyproject.toml",
    "solutions",
    "tests",
)


# By which a course's folder is known: the instructor's, or one that a class was given.
MARKS = ("nbgrader_config.py", "armdyn.json")


class CourseContents(AsyncLargeFileManager):
    """The course's files; a notebook that is only opened stays unchanged."""

    for_student = Bool(False, help="Show only the files that a student needs.").tag(config=True)

    async def get(self, path: str, *arguments: Any, **options: Any) -> dict[str, Any]:
        """The model of a file or a folder, as AsyncLargeFileManager gives it."""
        model = await super().get(path, *arguments, **options)
        if model["content"] is None:
            return model
        if model["type"] == "directory" and self.for_student and not path.strip("/"):
            model["content"] = [e for e in model["content"] if e["name"] not in NOT_FOR_STUDENTS]
        elif model["type"] == "notebook":
            _know_language(model["content"]["metadata"])
        return model


def _know_language(metadata: dict[str, Any]) -> None:
    """Write this Python's version into a notebook that it will run.

    JupyterLab writes the version into each notebook that it opens; if there was none, or another one,
    it takes the notebook for changed.
    """
    from ipykernel.ipkernel import IPythonKernel  # takes half a second

    if metadata.get("kernelspec", {}).get("name") == "python3":
        metadata["language_info"] = dict(IPythonKernel.language_info)


def course_of(folder: Path) -> Path | None:
    """The course that the folder is, or is in."""
    for candidate in (folder, *folder.parents):
        known = any((candidate / mark).is_file() for mark in MARKS)
        if known and (candidate / "lessons").is_dir():
            return candidate
    return None


def is_needed(record: logging.LogRecord) -> bool:
    """False of nbgrader's warning, at the start and at each Validate, that a student has no settings."""
    return "No nbgrader_config.py file found" not in record.getMessage()


def enable() -> None:
    """Let every Jupyter server of this environment load this; OSError if that cannot be written."""
    toggle_server_extension_python(__name__, enabled=True)


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": __name__}]


def _link_jupyter_server_extension(server: ServerApp) -> None:
    course = course_of(Path(server.root_dir).resolve())
    if course is None:
        return
    # `jupyter lab lessons/…` would show lessons/ alone, where no link to a problem leads anywhere.
    server.root_dir = str(course)
    # Assignment List looks for nbgrader_config.py in problems/, and here.
    paths = [str(course), *filter(None, [os.environ.get("JUPYTER_CONFIG_PATH")])]
    os.environ["JUPYTER_CONFIG_PATH"] = os.pathsep.join(paths)
    if not (course / "nbgrader_config.py").is_file():
        logging.getLogger("NbGrader").addFilter(is_needed)
    if "contents_manager_class" not in server.config.ServerApp:
        server.contents_manager_class = CourseContents
    if zmq.has("curve"):
        # Without this, each kernel warns in the terminal that others could read its traffic.
        server.config.MappingKernelManager.setdefault("transport_encryption", "auto")


def _load_jupyter_server_extension(server: ServerApp) -> None:
    """Jupyter calls this, and before nbgrader's: the first that serves an address is asked."""
    course = course_of(Path(server.root_dir).resolve())
    if course is not None and (course / "nbgrader_config.py").is_file():
        from autograder.nbgrader_glue import people_shown
        from autograder.nbgrader_glue.buttons import show_in_words

        show_in_words(server)
        people_shown.serve(server.web_app, server.base_url)
    if course is not None:
        # This takes a second, which is not always needed.
        from autograder.nbgrader_glue import environment, validating

        environment.mend()
        validating.serve(server.web_app, server.base_url)
