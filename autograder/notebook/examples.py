"""Gives `worst_case` in a graded notebook arguments to work with: no verdict is shown there."""

import json
from collections.abc import Mapping

import numpy as np
from nbformat import NotebookNode

from autograder.notebook.recognise import grade_id
from autograder.problems import check_for
from autograder.problems.material.conventions import Convention
from autograder.protocol import encode_call


def prelude(notebook: NotebookNode, own: Convention | None, mechanisms: Mapping[str, str]) -> str:
    """What runs in the room before the cells of a notebook that uses `worst_case`; "" for another.

    own: the student's own arm. mechanisms: the course's own, name of the file → its text.
    """
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    if not any("worst_case" in cell.source for cell in code):
        return ""
    laid = []
    for id in filter(None, map(grade_id, code)):
        try:
            check = check_for(id, own, mechanisms)
        except (
            ValueError
        ):  # a broken file of the course's own mechanism, which its grade cell names
            continue
        if check is not None:
            call, *_ = check.calls(np.random.default_rng(0), 1)
            text = json.dumps(encode_call(call))
            laid.append(f"__import__('autograder').lay_example({id!r}, {text!r})")
    return "\n".join(laid)
