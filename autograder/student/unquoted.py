"""Says what to do where the letter of a choice was typed without quotes: Python takes it for a name.

The cell stops at `my_moon = b`, above its check, so that no card can say it.
"""

import ast
import sys

from autograder.lesson_checks import known, typed
from autograder.lesson_checks.choice import Choice
from autograder.student.display import say


def watch() -> None:
    """Look at each cell of this shell that fails, from now on; nothing outside IPython."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    if shell is not None:
        shell.events.register("post_run_cell", _ended)


def _ended(result) -> None:
    if isinstance(result.error_in_exec, NameError) and (said := advice(result.info.raw_cell or "")):
        say(said)


def advice(cell: str) -> str:
    """What to do about a choice in this cell that lacks its quotes; "" where none does."""
    try:
        lines = ast.parse(cell).body
    except SyntaxError:  # a magic of IPython's beside it
        return ""
    for line in lines:
        match line:
            case ast.Assign(targets=[ast.Name(id=name)], value=ast.Name(id=letter)):
                asked = _choice_of(name, cell)
                if asked and letter.lower() in asked.by_letter:
                    quoted = f'{name} = "{letter}"'
                    return f"{letter} is a letter here and no name: put it in quotes, {quoted}."
    return ""


def _choice_of(name: str, cell: str) -> Choice | None:
    """The choice that is answered by this variable and checked in this cell."""
    for node in ast.walk(ast.parse(cell)):
        match node:
            case ast.Call(func=ast.Name(id="check"), args=[ast.Constant(value=str(id)), *_]):
                asked = known(id)
                if isinstance(asked, Choice) and typed.name_of(id) == name:
                    return asked
    return None
