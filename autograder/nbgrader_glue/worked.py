"""Opens an assignment's worked answers to students: at a time, or to those who have full marks.

`course/worked-answers.json` holds when. The answers are the source's; before their time no file that a
student may get holds them.
"""

import copy
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbgrader.coursedir import CourseDirectory
from traitlets.config import Config

from autograder import worked_answers
from autograder.nbgrader_glue.names import release_first
from autograder.nbgrader_glue.release import configuration
from autograder.notebook.answers import model_answers
from autograder.notebook.grade import is_judged
from autograder.notebook.outputs import display, read_marks, read_verdict
from autograder.notebook.own_arm import drawn_for
from autograder.notebook.recognise import grade_id
from autograder.problems import check_for, families

SETTINGS = Path("course/worked-answers.json")


def open_answers(root: Path, when: dict[str, str]) -> Iterator[str]:
    """Open each assignment's answers, if it is time; else let students read when. Yields what it did.

    root: the course's folder. when: by assignment, a time or FULL_MARKS. ValueError if it is no time, or
    where an assignment is not released.
    """
    for assignment, said in when.items():
        time = worked_answers.time_of(said)
        folders = places(root, assignment)
        if not folders:
            raise ValueError(f"{assignment} is not released: {release_first(assignment)}")
        said = said if time is None else time.isoformat(timespec="minutes")
        worked_answers.write(root / SETTINGS, settings(root) | {assignment: said})
        is_open = time is not None and time <= datetime.now().astimezone()
        answers = answers_of(root, assignment) if is_open else {}
        for folder in folders:
            worked_answers.write(folder / worked_answers.OPENS, {worked_answers.WHEN: said})
            if is_open:
                worked_answers.write(folder / worked_answers.OPEN, answers)
            else:  # an earlier time was withdrawn
                (folder / worked_answers.OPEN).unlink(missing_ok=True)
        if is_open:
            yield f"{assignment}: open, in {', '.join(map(str, folders))}"
        elif time is None:
            yield f"{assignment}: on the feedback pages, for each check with full marks"
        else:
            yield f"{assignment}: closed until {said}; run `autograder open-solution` again then"


def settings(root: Path) -> dict[str, str]:
    """When answers open, by assignment."""
    return worked_answers.read(root / SETTINGS)


def answers_of(root: Path, assignment: str) -> dict[str, str]:
    """The source's answers, by grade_id."""
    return model_answers(_source(root, assignment))


def with_answers(notebook: NotebookNode, root: Path, assignment: str, student: str) -> NotebookNode:
    """A graded notebook with a worked answer below each check that has full marks, and below each
    derivation that is complete, if they open so.
    """
    if settings(root).get(assignment) != worked_answers.FULL_MARKS:
        return notebook
    source = _source(root, assignment)
    answers, drawn = model_answers(source), drawn_for(source, student)
    notebook = copy.deepcopy(notebook)
    for cell in notebook.cells:
        derived = _complete(cell)
        if derived in answers:
            shown = worked_answers.mimebundle(derived, answers[derived], False)
            cell.outputs.append(display(shown))
    for cell in filter(is_judged, notebook.cells):
        found = next(filter(None, map(read_verdict, cell.outputs)), None)
        check = check_for(found["check"]) if found else None
        if found and found["credit"] >= 1 and found["check"] in answers:
            differs = check is not None and families.differs(drawn.own if drawn else None, check)
            remark = worked_answers.OF_THE_BOOK if differs else ""
            shown = worked_answers.mimebundle(
                found["check"], answers[found["check"]], False, remark
            )
            cell.outputs.append(display(shown))
    return notebook


def _complete(cell: NotebookNode) -> str:
    """The id of the derivation whose marks a graded cell shows, if it is complete; "" otherwise."""
    found = next(filter(None, map(read_marks, cell.get("outputs", []))), None)
    if found and found["done"] and found["derivation"] == grade_id(cell):
        return found["derivation"]
    return ""


def _source(root: Path, assignment: str) -> NotebookNode:
    config = configuration(root)
    config.CourseDirectory.assignment_id = assignment
    course = CourseDirectory(config=config)
    folder = Path(course.format_path(course.source_directory, ".", assignment))
    return nbformat.read(folder / f"{assignment}.ipynb", as_version=4)


def places(root: Path, assignment: str) -> list[Path]:
    """The folders that are there of those from which students get the assignment."""
    config = configuration(root)
    course = CourseDirectory(config=config)
    exchange = Path(_exchange(config, root)) / course.course_id / "outbound"
    found = (
        Path(course.format_path(course.release_directory, ".", assignment)),
        exchange / assignment,
        root / "problems" / assignment,
    )
    return [folder for folder in found if folder.is_dir()]


def _exchange(config: Config, root: Path) -> str:
    given = config.Exchange.get("root")
    return given if isinstance(given, str) else str(root / "course" / "exchange")
