"""Plain tests: an instructor's own Python in a grade cell, beside its check or in place of one.

A plain test runs in the room, as nbgrader runs it in a kernel: where the student's code can read it, and
change what it rests on. So it is weaker than a check. Nothing that it prints or returns is trusted to
be more than a number of points.
"""

import ast
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from nbformat import NotebookNode

from autograder.judging.verdict import State, Verdict
from autograder.notebook.beside import Beside
from autograder.protocol import one_line

# How NumPy shows a number of its own.
NUMPYS = re.compile(r"np\.\w+\((.*)\)")
TRUTH = {"True": True, "np.True_": True, "False": False, "np.False_": False}
# What these errors say is a whole sentence, and ours.
OURS = ("RoomLostError", "TimeoutError")


def plain_test(source: str, id: str) -> str:
    """What stands in a grade cell beside `check(id)`, on the lines where it stands; "" for nothing.

    A cell that Python alone cannot read, such as one with a magic, is given as it is: in the room,
    `check` does nothing.
    """
    try:
        body = ast.parse(source).body
    except (SyntaxError, ValueError):
        return source
    calls = [own for own in body if isinstance(own, ast.Expr) and _id(own.value) == id]
    lines = source.encode().split(b"\n")
    for call in reversed(calls):
        first, last = call.lineno - 1, (call.end_lineno or call.lineno) - 1
        before, after = lines[first][: call.col_offset], lines[last][call.end_col_offset :]
        lines[first : last + 1] = [before + b"pass" + after, *[b""] * (last - first)]
    rest = [own for own in body if own not in calls and not _says_nothing(own)]
    return b"\n".join(lines).decode() if rest else ""


def checks_called(cell: NotebookNode, source: NotebookNode) -> list[str | None]:
    """The id in each call of `check` in a cell; None where it is not written out.

    source: the notebook; where nothing in it is imported from `autograder`, `check` is a function of the
    instructor's own.
    """
    code = (own.source for own in source.cells if own.cell_type == "code")
    if not any("autograder" in text for text in code):
        return []
    return [_id(node) for node in python_in(cell.source) if _is_check(node)]


def python_in(source: str) -> Iterator[ast.AST]:
    """The nodes of a cell, its magics apart; none where it is no Python."""
    try:
        yield from ast.walk(ast.parse(_as_python(source)))
    except (SyntaxError, ValueError):
        return


@dataclass(frozen=True)
class Outcome:
    """What running a plain test came to.

    error: where it stopped and why, in words; "" if it ran to its end. kind: the name of that error.
    value: how its last expression shows its value, None for no value. shown: its other outputs.
    """

    error: str = ""
    kind: str = ""
    value: str | None = None
    shown: tuple[dict, ...] = ()

    @classmethod
    def read(cls, outputs: list[dict], beside: Beside) -> "Outcome":
        """From the outputs that the room sent, whatever they hold."""
        errors = [output for output in outputs if output.get("output_type") == "error"]
        rest = tuple(output for output in outputs if output.get("output_type") != "error")
        if errors:
            return cls(_why(errors[-1], beside), str(errors[-1].get("ename")), shown=rest)
        values = [output.get("data") for output in rest if output.get("value") is True]
        shows = values[-1].get("text/plain") if values and isinstance(values[-1], dict) else None
        return cls(value=shows if isinstance(shows, str) else None, shown=rest)


def with_test(verdict: Verdict, tested: Outcome) -> Verdict:
    """The verdict of a check beside which a plain test stands: if that failed, nothing is earned."""
    if not tested.error or verdict.credit == 0:
        return verdict
    said = f"Your instructor's own test in this cell failed: {tested.error}"
    return replace(
        verdict,
        state=State.INCORRECT,
        credit=0.0,
        problem=f"{_ended(said)} Without it, the cell earns nothing. {verdict.problem}".rstrip(),
        further="",
    )


def by_value(id: str, points: float, tested: Outcome, is_blank: bool) -> tuple[Verdict, str]:
    """The verdict on a grade cell without a check, by nbgrader's rule, and a note for the instructor.

    An error earns nothing; a number as the value of the last expression earns so many points, but no
    fewer than none and no more than there are; False earns nothing; all else earns all.
    is_blank: whether the answers above it are as they were handed out.
    """
    if tested.error:
        return _of_error(id, tested, is_blank), ""
    value, note = _points(tested.value, points), ""
    earned = min(max(value, 0.0), points) if math.isfinite(value) else 0.0
    if earned != value:
        given = one_line(str(tested.value), 30)
        note = f"{id}: its test gave {given} of {points:g} points; {earned:g} counted"
    credit = earned / points if points else 1.0
    if credit >= 1:
        return Verdict(id, State.CORRECT, 1.0), note
    state = State.PARTLY_CORRECT if credit else State.INCORRECT
    said = f"Your instructor's test gave {earned:g} of {points:g} points."
    return Verdict(id, state, credit, problem=said), note


def _of_error(id: str, tested: Outcome, is_blank: bool) -> Verdict:
    if is_blank:
        step = "Write your answer into the cell above, run it, then run this cell again."
        return Verdict(id, State.NOT_ATTEMPTED, next_step=step)
    state = State.INCORRECT if tested.kind == "AssertionError" else State.ERROR
    return Verdict(
        id, state, problem=_ended(f"Your instructor's test of this answer failed: {tested.error}")
    )


def _points(shows: str | None, points: float) -> float:
    """The points that a value stands for: all of them, where it is no number."""
    if shows is None:
        return points
    if shows in TRUTH:
        return points if TRUTH[shows] else 0.0
    number = NUMPYS.fullmatch(shows)
    try:
        return float(number[1] if number else shows)
    except ValueError:
        return points


def _why(error: dict, beside: Beside) -> str:
    kind, said = str(error.get("ename")), str(error.get("evalue"))
    if kind in OURS and not error.get("at"):
        return one_line(said)
    at, line = error.get("at"), str(error.get("line") or "")
    place = f"line {at}, " if isinstance(at, int) and at else ""
    # A line of the student's own is told; the test's lines are not.
    elsewhere = f" ({one_line(line)})" if line and not line.startswith("line ") else ""
    why = beside.explanation(f"{kind}: {said}")
    text = one_line(": ".join(filter(None, [kind, said])))
    return f"{place}{text}{elsewhere}{f' ({why})' if why else ''}"


def _ended(sentence: str) -> str:
    return sentence if sentence.endswith((".", "!", "?")) else f"{sentence}."


def _as_python(source: str) -> str:
    """The cell with its magics as Python, where there are some."""
    from IPython.core.inputtransformer2 import TransformerManager

    return TransformerManager().transform_cell(source)


def _is_check(node: ast.AST) -> bool:
    if not isinstance(node, ast.Call):
        return False
    of = node.func
    return (isinstance(of, ast.Name) and of.id == "check") or (
        isinstance(of, ast.Attribute)
        and of.attr == "check"
        and isinstance(of.value, ast.Name)
        and of.value.id == "autograder"
    )


def _id(node: ast.AST) -> str | None:
    """The id that a call of `check` has written out; None for anything else."""
    if not (isinstance(node, ast.Call) and _is_check(node)):
        return None
    given = [*node.args, *(own.value for own in node.keywords if own.arg == "id")]
    first = given[0] if given else None
    return str(first.value) if isinstance(first, ast.Constant) else None


def _says_nothing(node: ast.stmt) -> bool:
    """Whether a statement is only a text, or `pass`."""
    text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return text or isinstance(node, ast.Pass)
