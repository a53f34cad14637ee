"""Tells where solutions/, the release and the gradebook differ, before anything is graded by them."""

import copy
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbgrader import api, utils
from nbgrader.coursedir import CourseDirectory

from autograder.notebook.editions import Edition, of_release, of_source
from autograder.notebook.recognise import known_cells
from autograder.notebook.released import essence
from autograder.terminal import shown_points

MOST = 5  # differences that one sentence names


@dataclass(frozen=True)
class Known:
    """A cell in the gradebook: its points if it has any, and what nbgrader makes of a locked one."""

    cell_type: str
    locked: bool
    source: str
    checksum: str
    points: float | None
    answered: bool  # students write in it


class DisagreementError(ValueError):
    """An assignment cannot be graded by what there is; the message says what to run."""


def of_gradebook(notebook: api.Notebook) -> dict[str, Known]:
    """Its cells, by grade_id."""
    points = {one.name: float(one.max_score)
              for one in (*notebook.grade_cells, *notebook.task_cells)}  # fmt: skip
    answers = {one.name for one in (*notebook.solution_cells, *notebook.task_cells)}
    return {
        one.name: Known(one.cell_type, one.locked, one.source, one.checksum,
                        points.get(one.name), one.name in answers)
        for one in notebook.source_cells
    }  # fmt: skip


def again(assignment: str) -> str:
    return f"run `nbgrader generate_assignment {assignment} --force`"


def require(source: NotebookNode, cells: Mapping[str, Known], assignment: str) -> None:
    """DisagreementError if the gradebook has other cells, points or texts than solutions/."""
    found = from_gradebook(source, cells)
    if found:
        raise DisagreementError(
            f"solutions/{assignment} has changed since the assignment was generated: {few(found)}. "
            f"Nothing was graded: {again(assignment)}, and then this command again"
        )


def from_gradebook(source: NotebookNode, cells: Mapping[str, Known]) -> list[str]:
    """How the gradebook differs from the source, a cell a line."""
    found: list[str] = []
    known = {name: cell for name, cell in known_cells(source).items() if _is_kept(cell)}
    for name, cell in known.items():
        points = _points(cell.metadata["nbgrader"])
        if name not in cells:
            found.append(f"{_with_points(name, points)} is not in the gradebook")
        elif points != cells[name].points:
            was = _in_words(cells[name].points)
            found.append(f"{name} has {_in_words(points)}, but {was} in the gradebook")
        elif _is_answer(cell) != cells[name].answered:
            how = "an answer" if _is_answer(cell) else "no answer"
            found.append(f"{name} is {how}, unlike in the gradebook")
        elif not _can_be_put_right(cell, cells[name]):
            found.append(f"{name} is another kind of cell than in the gradebook")
    for name, one in cells.items():
        if name not in known:
            found.append(
                f"{_with_points(name, one.points)} is in the gradebook, but no longer in solutions/"
            )
    return found


def from_release(source: NotebookNode, released: str) -> list[str]:
    """How a released notebook, as JSON, differs from the source in what is graded, a cell a line."""
    now, then = of_source(source), of_release(released)
    found = []
    for name, settings in now.settings.items():
        points = _points(settings)
        if name not in then.settings:
            found.append(f"{_with_points(name, points)} is new")
        elif points != (was := _points(then.settings[name])):
            found.append(f"{name} has {_in_words(points)}, but {_in_words(was)} there")
        elif _is_locked(settings) and _text(now, name) != _text(then, name):
            found.append(f"{name} has another text")
    return found + [f"{name} is no longer in solutions/"
                    for name in then.settings if name not in now.settings]  # fmt: skip


def said_of_release(source: NotebookNode, released: Path, assignment: str) -> str:
    """What to tell the instructor where students would fetch another notebook than is graded; ""
    otherwise.
    """
    if not released.is_file():
        return ""
    found = from_release(source, released.read_text(encoding="utf-8"))
    if not found:
        return ""
    return (
        f"course/release/{assignment} is not what solutions/{assignment} makes: {few(found)}. "
        f"Before other students get it, {again(assignment)}, and release it again"
    )


def check_before(course: CourseDirectory, assignment: str) -> str:
    """DisagreementError if an assignment cannot be graded; what is to be said of its release."""
    source = folder_of(course, course.source_directory, assignment) / f"{assignment}.ipynb"
    if not source.is_file():
        return ""
    notebook = nbformat.read(source, as_version=4)
    with api.Gradebook(course.db_url, course.course_id) as gradebook:
        try:
            cells = of_gradebook(gradebook.find_notebook(assignment, assignment))
        except api.MissingEntry:
            return ""  # nbgrader says so
    require(notebook, cells, assignment)
    return said_of_release(notebook, released(course, assignment), assignment)


def released(course: CourseDirectory, assignment: str) -> Path:
    """Where the released notebook is."""
    return folder_of(course, course.release_directory, assignment) / f"{assignment}.ipynb"


def folder_of(course: CourseDirectory, step: str, assignment: str) -> Path:
    return Path(course.format_path(step, ".", assignment))


def _can_be_put_right(cell: NotebookNode, known: Known) -> bool:
    """Whether nbgrader's OverwriteCells can make a submission's locked cell the one in the gradebook."""
    if cell.cell_type != known.cell_type:
        return False
    if not known.locked:
        return True
    cell = copy.deepcopy(cell)
    cell.source = known.source
    cell.metadata["nbgrader"]["locked"] = True
    return utils.compute_checksum(cell) == known.checksum


def _points(settings: Mapping) -> float | None:
    if settings.get("grade") or settings.get("task"):
        return float(settings.get("points") or 0)
    return None


def _is_kept(cell: NotebookNode) -> bool:
    """Whether nbgrader keeps the cell in the gradebook: not one that is neither graded nor locked."""
    return utils.is_grade(cell) or _is_answer(cell) or utils.is_locked(cell)


def _is_answer(cell: NotebookNode) -> bool:
    return utils.is_solution(cell) or utils.is_task(cell)


def _is_locked(settings: Mapping) -> bool:
    return not settings.get("solution") and bool(settings.get("grade") or settings.get("locked"))


def _text(edition: Edition, name: str) -> tuple[str, str]:
    return edition.types[name], essence(edition.texts[name])


def _in_words(points: float | None) -> str:
    if points is None:
        return "no points"
    return f"{shown_points(points)} {'point' if points == 1 else 'points'}"


def _with_points(name: str, points: float | None) -> str:
    return name if points is None else f"{name} ({_in_words(points)})"


def few(found: Iterable[str]) -> str:
    """Differences as one text; "" if there are none."""
    lines = list(found)
    more = [f"and {len(lines) - MOST} more"] if len(lines) > MOST else []
    return "; ".join([*lines[:MOST], *more])
