"""A check says when it judges a function that a failed cell should have replaced, and only then."""

import pytest
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from autograder.student.definitions import Definitions, watched


@pytest.fixture
def shell(monkeypatch):
    """An IPython that shows no traceback."""
    monkeypatch.setattr(InteractiveShell, "_instance", None)
    shell = InteractiveShell.instance()
    shell.history_manager.enabled = False
    yield shell
    InteractiveShell.clear_instance()


@pytest.fixture
def old(shell):
    """Runs cells one after the other; gives the errors that keep M old, or missing."""
    definitions = Definitions(shell, {"M", "C"})

    def run(*cells: str) -> str:
        for cell in cells:
            with capture_output():
                shell.run_cell(cell)
        return definitions.old("M"), definitions.missing("M")

    return run


GOOD = "def M(q, pend):\n    return 1"
SYNTAX = "def M(q, pend):\n    return 2 +"


@pytest.mark.parametrize(
    ("cells", "said"),
    [
        ([GOOD, SYNTAX], "SyntaxError: invalid syntax, line 2"),
        ([GOOD, "def M(q, pend):\nreturn 2"], "IndentationError: expected an indented block "),
        ([GOOD, "1 / 0\n" + GOOD], "ZeroDivisionError: division by zero"),
        ([GOOD, "cos\nM = lambda q, pend: cos"], "NameError: name 'cos' is not defined"),
        ([GOOD, "M = cos"], "NameError: name 'cos' is not defined"),
        ([GOOD, SYNTAX, "x = M", "1 / 0"], "SyntaxError: invalid syntax, line 2"),
        ([GOOD, SYNTAX, "def M(q, pend):\n    return (2"], "SyntaxError: "),
        ([GOOD, "@nothing\n" + GOOD], "NameError: name 'nothing' is not defined"),
    ],
)
def test_a_function_that_was_not_replaced_is_old(old, cells, said):
    error, missing = old(*cells)
    assert error.startswith(said)
    assert missing == ""


@pytest.mark.parametrize(
    "cells",
    [
        [GOOD],
        [SYNTAX],  # none was there before
        [GOOD, SYNTAX, GOOD],
        [GOOD, SYNTAX, "M = lambda q, pend: 3"],
        [GOOD, SYNTAX, "def C(q): return 1\nglobals()['M'] = C"],
        [GOOD, SYNTAX, "del M"],
        [GOOD, GOOD + "\n1 / 0"],  # replaced, and then the cell failed
        [GOOD, "1 / 0"],
        [GOOD, "def C(q, qd):\n    return 2 +"],
        [GOOD, "def Mass(q):\n    return 2 +"],
        [GOOD, "def outer():\n    def M(q):\n        pass\n1 / 0"],
        [GOOD, "M == 1 / 0"],
        [GOOD, "print(M(1, 2)) +"],
    ],
)
def test_there_is_no_false_alarm(old, cells):
    assert old(*cells)[0] == ""


@pytest.mark.parametrize(
    ("cells", "said"),
    [
        ([SYNTAX], "SyntaxError: invalid syntax, line 2"),
        (["x = cos\n" + GOOD], "NameError: name 'cos' is not defined"),
        ([GOOD, "del M", SYNTAX], "SyntaxError: invalid syntax, line 2"),
        ([SYNTAX, GOOD, "del M"], ""),
        ([SYNTAX, GOOD], ""),
        (["1 / 0"], ""),
        ([], ""),
    ],
)
def test_what_keeps_a_function_missing_is_known(old, cells, said):
    assert old(*cells)[1] == said


def test_outside_ipython_nothing_is_watched(monkeypatch):
    monkeypatch.setattr(InteractiveShell, "_instance", None)
    assert watched({"M"}) is None
