"""Brings the gradebook to a source whose cells have changed, also where submissions are there already.

nbgrader refuses that. Here, a new cell gets an empty row for each submission, and a removed one's rows
go. Where points have changed, what was judged by the old ones no longer counts. What a person gave
stays; if its cell is removed, it is first written to the student's folder in `course/replaced/`.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from nbgrader import api
from nbgrader.preprocessors import SaveCells
from sqlalchemy import delete, select

from autograder.files import put_in_place
from autograder.lms.sheet import as_csv, harmless
from autograder.nbgrader_glue.shelf import REPLACED
from autograder.terminal import plain, shown_names, shown_points

HEAD = ("assignment", "cell", "points_by_a_person", "extra_credit", "comment")


class SaveChangedCells(SaveCells):
    """For `generate_assignment`, instead of nbgrader's SaveCells."""

    def _create_notebook(self, nb):
        try:
            notebook = self.gradebook.find_notebook(self.notebook_id, self.assignment_id)
        except api.MissingEntry:
            pass
        else:
            if notebook.submissions:
                root = Path(self.parent.parent.coursedir.root)
                wanted = {
                    api.GradeCell: self.new_grade_cells,
                    api.SolutionCell: self.new_solution_cells,
                    api.TaskCell: self.new_task_cells,
                    api.SourceCell: self.new_source_cells,
                }
                for line in bring(self.gradebook.db, notebook, wanted, root):
                    self.log.warning(plain(line))
        super()._create_notebook(nb)


def bring(
    db, notebook: api.Notebook, wanted: Mapping[Any, Mapping[str, Mapping]], root: Path
) -> list[str]:
    """Give a notebook in the gradebook these cells, and its submissions rows for them, all at once; what
    a person has to look at, in lines.

    wanted: by nbgrader's class of cells, name → settings. root: the course's folder.
    """
    lines: list[str] = []
    try:
        for kind, cells in wanted.items():
            there = {one.name: one for one in db.scalars(
                select(kind).where(kind.notebook_id == notebook.id))}  # fmt: skip
            for name in there.keys() - cells.keys():
                lines += _remove(db, notebook, there[name], root)
            for name in cells.keys() - there.keys():
                _add(db, notebook, kind(name=name, notebook_id=notebook.id, **cells[name]))
            if kind in (api.GradeCell, api.TaskCell):
                for name in there.keys() & cells.keys():
                    if there[name].max_score != cells[name]["max_score"]:
                        lines += _with_new_points(db, there[name], cells[name]["max_score"])
        db.commit()
    except BaseException:
        db.rollback()
        raise
    db.expire_all()
    return lines


def _add(db, notebook: api.Notebook, cell) -> None:
    db.add(cell)
    db.flush()
    rows = {api.GradeCell: (api.Grade,), api.SolutionCell: (api.Comment,),
            api.TaskCell: (api.Grade, api.Comment)}.get(type(cell), ())  # fmt: skip
    for submission in notebook.submissions:
        db.add_all([row(cell_id=cell.id, notebook_id=submission.id) for row in rows])


def _remove(db, notebook: api.Notebook, cell, root: Path) -> Iterator[str]:
    """Remove a cell with its rows. What a person gave is written down first."""
    if not isinstance(cell, api.SourceCell):
        kept = [
            student for submission in notebook.submissions
            if _write_down(db, notebook, cell, submission, root) and (student := submission.student.id)
        ]  # fmt: skip
        if kept:
            yield (
                f"{cell.name}: what a person gave to {shown_names(kept)} is in "
                f"{REPLACED}/<student>/{notebook.assignment.name}/"
            )
        for row in (api.Grade, api.Comment):
            db.execute(delete(row).where(row.cell_id == cell.id))
    db.delete(cell)
    db.flush()


def _write_down(db, notebook: api.Notebook, cell, submission, root: Path) -> bool:
    """Write what a person gave to a cell of a submission into a file; whether there was anything."""
    of = {"cell_id": cell.id, "notebook_id": submission.id}
    grade = db.scalars(select(api.Grade).filter_by(**of)).first()
    comment = db.scalars(select(api.Comment).filter_by(**of)).first()
    given = grade.manual_score if grade else None
    extra = grade.extra_credit if grade else None
    said = comment.manual_comment if comment else None
    if given is None and not extra and not said:
        return False
    assignment = notebook.assignment.name
    folder = root / REPLACED / submission.student.id / assignment
    folder.mkdir(parents=True, exist_ok=True)
    row = [assignment, cell.name, *("" if one is None else f"{one:g}" for one in (given, extra)),
           said or ""]  # fmt: skip
    taken = len(list(folder.glob("removed-*.csv")))
    text = as_csv([HEAD, [harmless(part) for part in row]])
    put_in_place(folder / f"removed-{taken + 1}.csv", text)
    return True


def _with_new_points(db, cell, points: float) -> Iterator[str]:
    """Drop what was judged out of the old points. What a person gave stays, and comes back to be read if
    it is more than the new points.
    """
    stays, too_many = [], []
    for grade in db.scalars(select(api.Grade).where(api.Grade.cell_id == cell.id)):
        if grade.manual_score is None:
            grade.auto_score, grade.needs_manual_grade = None, True
        elif grade.manual_score > points:
            grade.needs_manual_grade = True
            too_many.append(grade.notebook.student.id)
        else:
            stays.append(grade.notebook.student.id)
    new, old = shown_points(points), shown_points(cell.max_score)
    if too_many:
        yield (
            f"{cell.name}: a person gave more than the new {new} points to {shown_names(too_many)}: "
            "mark these again with `autograder mark`"
        )
    if stays:
        yield (
            f"{cell.name} has {new} points now, and had {old}; what a person gave stays as it is for "
            f"{shown_names(stays)}"
        )
