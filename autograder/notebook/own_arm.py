"""A student's own arm in a graded notebook: which it is, what its cells need, and what they show.

Whether a problem asks for a family is read in the released notebook, and the arm drawn from the name of
the folder in which the submission lies: whatever the submission says of it does not count.
"""

import ast
import re
from dataclasses import dataclass

from nbformat import NotebookNode

from autograder.notebook import outputs
from autograder.notebook.recognise import grade_id
from autograder.problems import PROBLEMS_WITH_FAMILIES, arm_card
from autograder.problems.material.conventions import BOOK, Convention, drawn, folded
from autograder.problems.material.given import code
from autograder.protocol import one_line

# The first line of what `arm_card` shows as plain text.
SHOWN = re.compile(
    r"^This is (the arm of .*?)(?:\.|: the one that the table above describes\.)$", re.M
)


@dataclass(frozen=True)
class SetUp:
    """What a released notebook asks of `own_arm`. cell: the grade_id of the cell that calls it."""

    cell: str
    problem: str
    year: int
    same_for_all: bool


@dataclass(frozen=True)
class Drawn:
    """The arm of one submission. own: None where all have one arm, which the plain checks judge."""

    set_up: SetUp
    whose: str
    own: Convention | None

    @property
    def prelude(self) -> str:
        """What runs in the room before the notebook's cells, so that `own_arm` finds the arm there."""
        own = self.own or BOOK
        described = {
            "turns": own.turns.tolist(),
            "zeros": own.zeros.tolist(),
            "pull": own.pull,
            "code": self._code,
        }
        return f"__import__('autograder').lay_own_arm({self.set_up.problem!r}, {described!r})"

    @property
    def shown(self) -> NotebookNode:
        """The output of the set-up cell: the arm's table and picture, by the grader itself."""
        own = self.own or BOOK
        return outputs.display(arm_card.mimebundle(own, self.whose, None, self._code))

    @property
    def _code(self) -> str:
        return code(self.own or BOOK, self.set_up.problem)

    def apart(self, submission: NotebookNode) -> str:
        """A note where the student's own kernel showed another arm, such as for a mistyped name."""
        if self.own is None:
            return ""
        for cell in submission.cells:
            shown = cell.get("outputs") or [] if grade_id(cell) == self.set_up.cell else []
            said = SHOWN.search("\n".join(map(_plain, shown)))
            if said and folded(said[1]) != folded(self.whose):
                return (
                    f"{self.set_up.cell} showed the student {one_line(said[1], 60)}; judged was "
                    f"{one_line(self.whose, 60)}"
                )
        return ""


def _plain(output: object) -> str:
    """The plain text of an output, which the student's editor may have kept as lines; "" for none."""
    data = output.get("data") if isinstance(output, dict) else None
    text = data.get("text/plain") if isinstance(data, dict) else None
    if isinstance(text, list):
        text = "".join(map(str, text))
    return text if isinstance(text, str) else ""


def drawn_for(source: NotebookNode, student: str | None) -> Drawn | None:
    """The arm of this student; None for a problem that does not call `own_arm`.

    student: None where nobody's submission is graded, which has the arm of the book.
    """
    asked = set_up(source)
    if asked is None:
        return None
    if asked.same_for_all or student is None:
        return Drawn(asked, "the arm of the book", None)
    return Drawn(asked, f"the arm of {student}", drawn(student, asked.year))


def set_up(source: NotebookNode) -> SetUp | None:
    """What the locked set-up cell of a released notebook asks for; None where none calls `own_arm`.

    ValueError if the call has other arguments than literal ones, or names no problem with a family.
    """
    for cell in source.cells:
        claims = cell.metadata.get("nbgrader") or {}
        if cell.cell_type == "code" and claims.get("locked") and "own_arm(" in cell.source:
            for node in ast.walk(ast.parse(cell.source)):
                if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "own_arm":
                    return _read(grade_id(cell) or "", node)
    return None


def _read(cell: str, call: ast.Call) -> SetUp:
    given = {word.arg: word.value for word in call.keywords if word.arg != "arm"}
    try:
        (problem,) = map(ast.literal_eval, call.args)
        words = {name: ast.literal_eval(value) for name, value in given.items()}
        asked = SetUp(
            cell, str(problem), int(words.get("year", 0)), bool(words.get("same_for_all"))
        )
    except (TypeError, ValueError):
        asked = None
    if asked is None or asked.problem not in PROBLEMS_WITH_FAMILIES:
        raise ValueError(
            f"{cell}: own_arm needs a problem ({', '.join(PROBLEMS_WITH_FAMILIES)}), "
            "and year and same_for_all as plain values"
        )
    return asked
