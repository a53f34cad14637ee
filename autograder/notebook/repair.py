"""Puts a submitted notebook's graded cells right, from the source version, before it is judged.

Students copy, delete, rename and retype cells, by accident or not. nbgrader trusts the cells'
metadata as submitted. Here it is rebuilt from the source, and every change is reported to the
instructor and, in the notebook's first cell, to the student.
"""

import copy
from collections.abc import Iterable, Sequence

from nbformat import NotebookNode

from autograder.notebook.editions import Edition, begun_with, of_source, settings_of
from autograder.notebook.form import NEW_CELL, give_form, tell_apart, without_surrogates
from autograder.notebook.letter import letter
from autograder.notebook.own_cells import point_to_own_cells
from autograder.notebook.recognise import Places, grade_id, is_untouched, known_cells, places
from autograder.notebook.released import essence, released
from autograder.protocol import one_line

MOST_NOTES = 50


def repair(
    submission: NotebookNode,
    source: NotebookNode,
    said: Iterable[str] = (),
    documents: Sequence[str] = (),
    earlier: Sequence[Edition] = (),
) -> tuple[NotebookNode, list[str]]:
    """The submission with each graded cell of `source` in it exactly once, and a note on each change.

    A locked cell gets the source's text again; what a student wrote into it becomes a cell of the
    student's own before it. An editable cell keeps the student's text; if it was deleted, an empty
    one is put in. A missing cell comes just before the next one of the source that is there, below what
    the student wrote in its place; a set-up cell comes first. If an answer is there several times, the
    last one counts that differs from what was handed out; of another cell, the last, as it does when the
    notebook runs. The others stay as ordinary cells, and those without an answer do not run. Cells that
    only claim to be graded stay too, without the claim. An empty answer that a person reads points to
    the student's own cells beside it, or documents.

    said: notes that come before all others. documents: files of the student's that may hold an
    answer. earlier: editions of the problem that students may have, the newest first: what differs
    from the source because it was so in the student's edition is put right without a note.
    """
    notebook, notes = copy.deepcopy(submission), list(said)
    for cell in notebook.cells:
        cell.pop("outputs", None)  # made anew
    clean = without_surrogates(notebook)
    if clean is not notebook:
        notes.append("broken Unicode was replaced by \ufffd")
        notebook = clean
    give_form(notebook, source, notes)
    known = known_cells(source)
    editions = [of_source(source), *earlier]
    begun = begun_with(notebook, editions)
    found = places(notebook, source)
    _tell_of(found, notes)
    for index, cell in enumerate(notebook.cells):
        claimed = grade_id(cell)
        if "nbgrader" in cell.metadata and (claimed is None or found.at.get(claimed) != index):
            del cell.metadata["nbgrader"]
            if claimed and claimed not in known and claimed not in begun.settings:
                notes.append(
                    f"a cell claims to be {one_line(claimed, 60)}, which this assignment does not have"
                )
    placed = {name: notebook.cells[index] for name, index in found.at.items()}
    for name, indices in found.copies.items():
        for index in set(indices) - {found.at[name]}:
            _keep_from_running(notebook.cells[index], known[name])
    for name in found.bare:
        placed[name].metadata["nbgrader"] = copy.deepcopy(known[name].metadata["nbgrader"])
    for name, original in known.items():
        if name in placed:
            _keep_changed_text(notebook, placed[name], original, begun, notes)
            _put_right(placed[name], original, begun, notes)
    put_back = _put_back(notebook, known, placed, begun, notes)
    notes += point_to_own_cells(notebook, source, documents, editions, put_back)
    if len(notes) > MOST_NOTES:
        notes = [*notes[:MOST_NOTES], f"and {len(notes) - MOST_NOTES} more notes like these"]
    if notes:
        notebook.cells.insert(0, letter(notes))
    tell_apart(notebook)
    return notebook, notes


def is_locked(cell: NotebookNode) -> bool:
    """Whether students may not change this cell, so that the source's text counts in it."""
    claims = cell.metadata["nbgrader"]
    return not claims.get("solution") and bool(claims.get("grade") or claims.get("locked"))


def _tell_of(found: Places, notes) -> None:
    for name, indices in found.copies.items():
        which = "the last one" if found.at[name] == indices[-1] else "the one with an answer"
        notes += [f"{name} was there more than once; {which} counts"] * (len(indices) - 1)
    if len(found.bare) == 1:
        notes.append(f"{found.bare[0]} had lost its nbgrader settings; they were put back")
    elif found.bare:
        notes.append(
            f"{len(found.bare)} cells had lost their nbgrader settings, which were put back: "
            f"{', '.join(found.bare)}"
        )


def _keep_changed_text(notebook, cell, original, begun: Edition, notes) -> None:
    """What was written into a locked cell runs as a cell of the student's own, before it."""
    if not is_locked(original):
        return
    if essence(cell.source) in (essence(released(original)), essence(original.source)):
        return
    if begun.has_text_of(cell):
        return
    name = grade_id(original)
    if not cell.source.strip():
        notes.append(f"{name} had been emptied; its text was put back")
        return
    notes.append(
        f"the text of {name} had been changed; the original was put back, and the changed text runs in "
        "a cell of its own before it"
    )
    own = NEW_CELL[cell.cell_type](source=cell.source)
    if "attachments" in cell:
        own.attachments = cell.attachments
    del own["id"]  # a random one
    notebook.cells.insert(_index(notebook.cells, cell), own)


def _put_right(cell, original, begun: Edition, notes) -> None:
    name = grade_id(original) or ""
    if not is_locked(original) and begun.has_text_of(cell):
        cell.source = released(original)  # no answer: what nbgrader knows as none
    if cell.cell_type != original.cell_type:
        if cell.cell_type != begun.types.get(name):
            notes.append(
                f"{name} had been made a {cell.cell_type} cell; it is a {original.cell_type} cell again"
            )
        cell.cell_type = original.cell_type
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
            cell.pop("attachments", None)
        else:
            cell.pop("outputs", None)
            cell.pop("execution_count", None)
    checksum = cell.metadata["nbgrader"].get("checksum")
    claims, wanted = settings_of(cell), dict(original.metadata["nbgrader"])
    differs = any(claims.get(key) != value for key, value in wanted.items())
    if differs and not begun.has_settings_of(cell):
        notes.append(f"the nbgrader settings of {name} had been changed; they were put back")
    cell.metadata["nbgrader"] = NotebookNode(
        wanted | ({"checksum": checksum} if isinstance(checksum, str) else {})
    )
    if is_locked(original):
        cell.source = original.source


def _keep_from_running(cell: NotebookNode, original: NotebookNode) -> None:
    """A copy without an answer, which runs below the answer, would put the stub in its place."""
    if cell.cell_type == "code" and not is_locked(original) and is_untouched(cell, original):
        cell.cell_type = "raw"
        for part in ("outputs", "execution_count"):
            cell.pop(part, None)


def _put_back(notebook, known, placed, begun: Edition, notes) -> list[NotebookNode]:
    """Put each missing cell just before the next one of the source that is there and stands below those
    before it, so that it comes below what the student wrote in its place; the cells.

    What the source has above all answers is what own cells need, too, so that it comes first.
    """
    names, put_back, last = list(known), [], -1
    answers = [number for number, name in enumerate(names) if not is_locked(known[name])]
    for number, name in enumerate(names):
        if name not in placed:
            original, was_there = known[name], name in begun.settings
            notes.append(
                f"{name} was missing; it was put back"
                if was_there
                else f"{name} is newer than the student's notebook; it was put in"
            )
            empty = "" if was_there else released(original)
            text = original.source if is_locked(original) else empty
            cell = NEW_CELL[original.cell_type](source=text)
            cell.metadata = copy.deepcopy(original.metadata)
            del cell["id"]  # a random one
            after = (_index(notebook.cells, placed[n]) for n in names[number + 1 :] if n in placed)
            position = next((index for index in after if index > last), len(notebook.cells))
            is_set_up = number < min(answers, default=0)
            notebook.cells.insert(last + 1 if is_set_up else position, cell)
            placed[name] = cell
            put_back.append(cell)
        last = _index(notebook.cells, placed[name])
    return put_back


def _index(cells, wanted) -> int:
    return next(index for index, cell in enumerate(cells) if cell is wanted)
