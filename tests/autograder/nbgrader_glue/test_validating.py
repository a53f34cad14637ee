"""What Validate says of a notebook that nbgrader could not judge, and how long a cell may take."""

import shutil

import nbformat
import pytest
from nbgrader.preprocessors import Execute
from nbgrader.server_extensions.validate_assignment.handlers import ValidateAssignmentHandler
from traitlets.config import Config

from autograder.nbgrader_glue import validating
from autograder.nbgrader_glue.release import configuration
from autograder.nbgrader_glue.validating import Handler, fault_of
from tests.autograder.courses import P3, ROOT


@pytest.fixture
def handed_out(tmp_path):
    """Writes p3's notebook, changed, and says what Validate does."""

    def said(change):
        path = ROOT / "solutions" / P3 / f"{P3}.ipynb"
        notebook = nbformat.read(path, as_version=4)
        change(notebook)
        nbformat.write(notebook, tmp_path / "one.ipynb")
        return fault_of(tmp_path / "one.ipynb")

    return said


def at(notebook, name):
    return next(
        place for place, cell in enumerate(notebook.cells)
        if cell.metadata.get("nbgrader", {}).get("grade_id") == name
    )  # fmt: skip


def split(notebook):
    """As JupyterLab splits a cell: both halves keep its settings."""
    place = at(notebook, "answer-M")
    half = nbformat.v4.new_code_cell("x = 1", metadata=notebook.cells[place].metadata)
    notebook.cells.insert(place + 1, half)


def without_settings(notebook):
    for cell in notebook.cells:
        cell.metadata.pop("nbgrader", None)


def one_check_without_settings(notebook):
    notebook.cells[at(notebook, "p3-M")].metadata.pop("nbgrader")


def to_try_things_in(notebook):
    without_settings(notebook)
    notebook.cells = [notebook.cells[-1], nbformat.v4.new_code_cell('check("p3-M")')]


class Server(Handler):
    """The part of a server that Validate asks for."""

    def __init__(self, folder):
        self._folder = folder

    @property
    def settings(self):
        return {"config": Config()}

    @property
    def root_dir(self):
        return str(self._folder)

    def load_config(self):
        return Config()


def test_a_kernel_that_is_not_there_is_told_in_a_sentence(tmp_path):
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("x = 1")])
    notebook.metadata.kernelspec = {"name": "none", "display_name": "None", "language": "python"}
    nbformat.write(notebook, tmp_path / "one.ipynb")
    said = Server(tmp_path).validate_notebook("one.ipynb")
    assert not said["success"]
    assert said["value"].startswith("This notebook asks for a kernel that is not installed here.")


@pytest.mark.parametrize(
    ("own", "seconds"), [({}, 1), ({"Execute": {"timeout": 2}}, 2)], ids=["none", "the course's"]
)
def test_a_cell_has_our_time_unless_the_course_says_another(monkeypatch, tmp_path, own, seconds):
    monkeypatch.setattr(ValidateAssignmentHandler, "load_config", lambda self: Config(own))
    monkeypatch.setattr(validating, "VALIDATE_SECONDS", 1)
    assert Execute(config=Handler.load_config(Server(tmp_path))).timeout == seconds


def test_the_course_gives_a_cell_that_time(tmp_path):
    shutil.copy(ROOT / "nbgrader_config.py", tmp_path)
    assert Execute(config=configuration(tmp_path)).timeout == validating.VALIDATE_SECONDS > 30


def test_a_cell_that_is_there_twice_is_named(handed_out):
    assert handed_out(split).startswith("This notebook has the cell answer-M more than once")


def test_a_notebook_without_settings_is_no_success(handed_out):
    assert "have lost nbgrader's settings" in handed_out(without_settings)


@pytest.mark.parametrize(
    "change", [lambda notebook: None, one_check_without_settings, to_try_things_in]
)
def test_what_nbgrader_judges_is_left_to_it(handed_out, change):
    assert handed_out(change) == ""


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"cells": [1]}', '{"cells": [{}]}'])
def test_what_is_no_notebook_is_left_to_nbgrader(tmp_path, text):
    (tmp_path / "one.ipynb").write_text(text)
    assert fault_of(tmp_path / "one.ipynb") == ""
    assert fault_of(tmp_path / "none.ipynb") == ""
