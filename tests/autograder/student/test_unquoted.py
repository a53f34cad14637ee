"""A choice that is typed without quotes: the student reads what to do, and not NameError alone."""

import pytest
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output

from autograder.lesson_checks import typed
from autograder.lesson_checks.choice import Choice
from autograder.lesson_checks.lesson_05 import CHECKS
from autograder.student import unquoted

ID = next(asked.id for asked in CHECKS if isinstance(asked, Choice))
NAME = typed.name_of(ID)
CHECK = f'check("{ID}")'


@pytest.fixture
def shell(monkeypatch):
    monkeypatch.setattr(InteractiveShell, "_instance", None)
    shell = InteractiveShell.instance()
    shell.history_manager.enabled = False
    shell.user_ns["check"] = lambda id: None
    unquoted.watch()
    yield shell
    InteractiveShell.clear_instance()


def said(shell, cell: str) -> str:
    with capture_output() as shown:
        shell.run_cell(cell)
    return shown.stdout + "".join(output.data["text/plain"] for output in shown.outputs)


@pytest.mark.parametrize("letter", ["a", "B"])
def test_a_letter_without_quotes_is_told_so(shell, letter):
    printed = said(shell, f"{NAME} = {letter}  # mine\n{CHECK}")
    assert f'put it in quotes, {NAME} = "{letter}".' in printed


@pytest.mark.parametrize(
    "cell",
    [
        f'{NAME} = "a"\n{CHECK}',
        f"{NAME} = angle\n{CHECK}",
        f"{NAME} = a",
        f"other = a\n{CHECK}",
        f"{NAME} = a +\n{CHECK}",
        f"a = 1\n{NAME} = a\n{CHECK}",
    ],
    ids=[
        "quoted",
        "another name",
        "no check",
        "another variable",
        "no Python",
        "a name that is there",
    ],
)
def test_nothing_is_said_of_anything_else(shell, cell):
    assert "put it in quotes" not in said(shell, cell)
