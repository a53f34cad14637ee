"""`own_arm`: the set-up cell of a problem draws the student's own arm, from the student's name."""

import getpass
import os
from pathlib import Path

from autograder.problems import PROBLEMS_WITH_FAMILIES, arm_card
from autograder.problems.material.conventions import BOOK, Convention, drawn
from autograder.problems.material.given import code
from autograder.protocol import OwnArm
from autograder.student.display import say, show

NO_NAME = (
    "No name is known here. Until you give yours, you have the arm of the book. Put these two lines, "
    "with the name under which you hand in, into a new cell above this one, and run both cells:"
)
TWO_LINES = '\n    from autograder import own_arm\n    own_arm("{problem}", "your name")\n'
OF_THE_BOOK = (
    "This check took the arm of the book, as no name is known. The grader takes your own arm: type your "
    "name as it says below the set-up cell."
)
_typed: list[str] = []
_nameless: set[str] = set()
_drawn: dict[str, Convention] = {}


def own_arm(
    problem: str, name: str | None = None, *, arm: object = None, year: int = 0,
    same_for_all: bool = False,
) -> OwnArm | None:  # fmt: skip
    """Draw this student's arm for a problem such as "p1", show it, and let the checks judge it.

    name: typed by a student: it is kept until the kernel ends, and the set-up cell then draws from
    it. Without, the name is JupyterHub's, or the one under which nbgrader fetched this folder. arm: the
    parameters, to be shown. year: changes who gets which arm. same_for_all: everybody has the arm of
    the book. The grader takes the name from the submission, and the rest from the released notebook.
    ValueError where a problem has no family, or the name is empty.
    """
    if problem not in PROBLEMS_WITH_FAMILIES:
        known = ", ".join(PROBLEMS_WITH_FAMILIES)
        raise ValueError(f"own_arm knows {known}; you gave {problem!r}")
    if name is not None:
        if not isinstance(name, str) or not name.strip():
            raise ValueError("type your name in quotes, as it stands on what you hand in")
        _typed[:] = [name]
        if arm is None:
            say(f"Your name is {name.strip()}. Now run the set-up cell, and all cells below it.")
            return None
    # The instructor's notebooks hold the answers for the arm of the book.
    same_for_all = same_for_all or Path.cwd().parent.name == "solutions"
    given = None if same_for_all else _name()
    own = BOOK if given is None else drawn(given, year)
    _drawn.pop(problem, None)
    _nameless.discard(problem)
    if given is not None:
        _drawn[problem] = own
    if given is None and not same_for_all:
        _nameless.add(problem)
        say(NO_NAME)
        print(TWO_LINES.format(problem=problem))
    whose = "the arm of the book" if given is None else f"the arm of {given.strip()}"
    show(arm_card.mimebundle(own, whose, arm, code(own, problem)))
    return own.own_arm(code(own, problem))


def drawn_for(check_id: object) -> Convention | None:
    """The arm that the set-up cell drew for the problem of this check; None where it drew none."""
    return _drawn.get(str(check_id).partition("-")[0])


def reminder(check_id: object) -> str:
    """What a student reads below each card until the name is known; "" where it is, or is not needed."""
    return OF_THE_BOOK if str(check_id).partition("-")[0] in _nameless else ""


def _name() -> str | None:
    if _typed:
        return _typed[0]
    return os.environ.get("JUPYTERHUB_USER", "").strip() or _of_fetched(Path.cwd())


def _of_fetched(folder: Path) -> str | None:
    """The name under which nbgrader hands in from here, where it released this assignment."""
    course = folder.parent.parent
    exchange = course / "course" / "exchange"
    if folder.parent.name != "problems" or not any(exchange.glob(f"*/outbound/{folder.name}")):
        return None
    try:
        return getpass.getuser()
    except (KeyError, OSError):  # a container's user may have no name
        return None
