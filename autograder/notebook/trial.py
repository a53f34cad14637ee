"""Tries a source's plain tests on its own model answers, in the room, before a submission meets them.

A test that fails there would fail for everybody, and is to blame itself. What cannot work in the room,
such as reading a file that does not lie beside the notebook, shows up in the same way.
"""

import ast
import os
from collections.abc import Iterator

from nbformat import NotebookNode

from autograder.notebook.beside import Beside
from autograder.notebook.grade import is_judged
from autograder.notebook.own_arm import drawn_for
from autograder.notebook.plain_tests import (
    Outcome,
    by_value,
    checks_called,
    plain_test,
    python_in,
)
from autograder.notebook.recognise import grade_id
from autograder.notebook.sitting import Sitting
from autograder.problems import check_for, nearest
from autograder.sandbox.room import Room

SANDBOX = "in the sandbox is no network, and no file but those beside the notebook"


def refusals(source: NotebookNode, beside: Beside) -> list[str]:
    """Why a source cannot be graded as it is written, a sentence for each cell; none if it can.

    beside: the files beside the source. OSError if no sandbox starts.
    """
    tests: dict[str, str] = {}
    said: list[str] = []
    for cell in source.cells:
        if cell.cell_type == "code":
            said += _written(cell, source, beside)
            if is_judged(cell) and (text := _test(cell, beside)):
                tests[grade_id(cell) or ""] = text
    return said or (list(_tried(source, beside, tests)) if tests else [])


def refusal(assignment: str, source: NotebookNode, beside: Beside) -> str:
    """Why an assignment cannot be graded by this source, a line for each cell; "" if it can."""
    said = refusals(source, beside)
    return "\n".join([f"solutions/{assignment} cannot be graded as it is:", *said]) if said else ""


def without_check(source: NotebookNode, beside: Beside) -> list[str]:
    """The grade cells of a source that no check grades."""
    return [
        grade_id(cell) or ""
        for cell in source.cells
        if is_judged(cell) and not _check(cell, beside)
    ]


def _written(cell: NotebookNode, source: NotebookNode, beside: Beside) -> Iterator[str]:
    """What a cell's text alone tells."""
    name = grade_id(cell)
    if _imports_armdyn(cell.source):
        yield (
            f"{name or 'a cell'} imports armdyn, which has the answers, so that no graded notebook can: "
            "write what it needs into the notebook, or into a file beside it"
        )
    if name is None or not is_judged(cell):
        return
    if "### AUTOTEST" in cell.source or "### HASHED AUTOTEST" in cell.source:
        yield f"{name} has an AUTOTEST, which the grader does not run: write the tests out as asserts"
        return
    called, known = checks_called(cell, source), _check(cell, beside)
    others = [id for id in called if id != name]
    if others:
        given = "a check that it does not name" if others[0] is None else f'check("{others[0]}")'
        near = nearest(name) if not known else []
        hint = f" (is {' or '.join(near)} meant?)" if near else ""
        yield f"{name} calls {given}, but a check judges the cell whose grade_id is its id{hint}"
    elif called and not known:
        near = nearest(name)
        hint = f": is {' or '.join(near)} meant?" if near else ""
        yield f'{name} calls check("{name}"), and there is no such check{hint}'
    elif known and not called:
        yield (
            f'{name} is the id of a check, and its cell does not call check("{name}"): call it, or give '
            "the cell another grade_id"
        )
    elif not known and not _test(cell, beside):
        yield f"{name} tests nothing, so that everybody would get its points"


def _tried(source: NotebookNode, beside: Beside, tests: dict[str, str]) -> Iterator[str]:
    if not hasattr(os, "fork"):
        raise OSError("this system has no sandbox")
    try:
        drawn = drawn_for(source, None)
    except ValueError as error:
        yield str(error)
        return
    with Sitting(lambda: Room.loaded(files=beside.laid)) as sitting:
        if drawn is not None:
            sitting.run(drawn.prelude)
        for cell in source.cells:
            name = grade_id(cell) or ""
            if cell.cell_type != "code" or (is_judged(cell) and name not in tests):
                continue
            shown = sitting.run(
                tests[name] if is_judged(cell) else cell.source, not is_judged(cell)
            )
            if not is_judged(cell):
                continue
            tested = Outcome.read(shown, Beside())
            if tested.error:
                yield (
                    f"the test of {name} fails with the model answer of the source: {tested.error} "
                    f"({SANDBOX})"
                )
            elif not _check(cell, beside):
                points = float(cell.metadata["nbgrader"]["points"])
                verdict, note = by_value(name, points, tested, is_blank=False)
                if verdict.credit < 1 or note:
                    yield (
                        f"the test of {name} gives the model answer of the source {tested.value} of "
                        f"{points:g} points"
                    )


def _test(cell: NotebookNode, beside: Beside) -> str:
    """What runs of a grade cell; "" for nothing."""
    text = plain_test(cell.source, grade_id(cell) or "")
    return cell.source if text and not _check(cell, beside) else text


def _check(cell: NotebookNode, beside: Beside) -> bool:
    try:
        return check_for(grade_id(cell) or "", None, beside.mechanisms) is not None
    except ValueError:  # a broken file of the course's own mechanism, which the grader tells
        return True


def _imports_armdyn(source: str) -> bool:
    for node in python_in(source):
        names = [own.name for own in node.names] if isinstance(node, ast.Import) else []
        names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
        if any(name.partition(".")[0] == "armdyn" for name in names):
            return True
    return False
