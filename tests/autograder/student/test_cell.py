"""check() where students call it: in a notebook's kernel, under nbgrader validate, and elsewhere."""

import itertools
import linecache
import re
import time

import nbclient
import nbformat
import numpy as np
import pytest

from autograder import check, hint, look_at
from autograder.judging.verdict import State
from autograder.problems import CHECKS, UnknownCheckError, nearest
from autograder.student.cell import NotCorrectError, verdict_on

START = "start-kinetic-energy"
BODIES = {
    State.CORRECT: "return I * qd**2 / 2",
    State.INCORRECT: "return I * qd**2",
    State.ERROR: "return None",
    State.NOT_ATTEMPTED: "raise NotImplementedError",
}
RAISING = [state for state in BODIES if state is not State.CORRECT]


def defined(state: State) -> str:
    return f"def kinetic_energy(I, qd):\n    {BODIES[state]}"


def executed(sources: list[str]):
    """The outputs of each cell, from a kernel as JupyterLab starts it."""
    cells = [nbformat.v4.new_code_cell(source) for source in sources]
    notebook = nbformat.v4.new_notebook(cells=cells)
    nbclient.NotebookClient(notebook, kernel_name="python3", allow_errors=True).execute()
    return [cell.outputs for cell in notebook.cells]


ASKED = ("near", "far", "hint", "empty")
CELLS = [
    *(f"{defined(state)}\ncheck('{START}')" for state in BODIES),
    "check('start-kinetic-energi')",
    "check('nothing like it')",
    "hint('p3-freq')",
    "check()",
    f"{defined(State.CORRECT)}\ncheck('{START}', fresh=True)",
    "def kinetic_energy(I, qd):\n    return I +",
    f"check('{START}')",
    "del kinetic_energy",
    "def kinetic_energy(I, qd):\n    return I +",
    f"check('{START}')",
]


@pytest.fixture(scope="module", params=["student", "validate"])
def kernel(request):
    """How the notebook is run, and the outputs of CELLS there."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYDEVD_DISABLE_FILE_VALIDATION", "1")
        patch.delenv("NBGRADER_EXECUTION", raising=False)
        if request.param == "validate":
            patch.setenv("NBGRADER_EXECUTION", "validate")
        first, *outputs = executed(["from autograder import check, hint", *CELLS])
    assert first == []
    return request.param, dict(
        zip(
            [*BODIES, *ASKED, "fresh", "broken", "old", "deleted", "again", "missing"],
            outputs,
            strict=True,
        )
    )


def lines_of(error) -> list[str]:
    """A traceback's lines, without colour."""
    return re.sub(r"\x1b\[[0-9;]*m", "", "\n".join(error.traceback)).splitlines()


@pytest.mark.parametrize("state", BODIES)
def test_the_card_is_shown(kernel, state):
    card = kernel[1][state][0]
    assert card.output_type == "display_data"
    assert f'data-state="{state.name.lower().replace("_", "-")}"' in card.data["text/html"]
    assert card.data["text/plain"].startswith(f"{START}: {state}")


def test_a_right_answer_raises_nothing(kernel):
    assert len(kernel[1][State.CORRECT]) == 1
    assert len(kernel[1]["fresh"]) == 1


@pytest.mark.parametrize("state", RAISING)
def test_the_error_is_one_line_for_a_student_and_the_whole_verdict_for_validate(kernel, state):
    who, outputs = kernel
    card, error = outputs[state]
    assert error.ename == "NotCorrectError"
    if who == "student":
        assert lines_of(error) == [f"{START}: {state}: see the card above."]
    else:
        assert lines_of(error) == card.data["text/plain"].splitlines()
        assert len(lines_of(error)) > 1


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("near", "there is no check 'start-kinetic-energi'; did you mean 'start-kinetic-energy'?"),
        ("far", f"there is no check 'nothing like it'; the checks are {', '.join(CHECKS)}"),
        ("hint", "there is no check 'p3-freq'; did you mean 'p3-small_angle_frequency'?"),
        ("empty", "give the id of a check, in quotes; you gave nothing"),
    ],
)
def test_an_unknown_id_is_answered_in_one_line(kernel, asked, said):
    (error,) = kernel[1][asked]
    assert (error.ename, error.evalue) == ("UnknownCheckError", said)
    assert lines_of(error) == [said]


def p3_M(q):
    """Stands for a function that was handed over in place of its id."""


@pytest.mark.parametrize(
    ("asked", "meant"),
    [
        ("p3-freq", ["p3-small_angle_frequency"]),
        ("p3-frequencey", ["p3-small_angle_frequency"]),
        ("P3-m", ["p3-M"]),
        ("p3_M", ["p3-M"]),
        ("p1-Mm", ["p1-M"]),
        ("M", ["p1-M", "p3-M"]),
        ("g_vec", ["p3-g_vec", "p4-g_vec"]),
        ("p5-step", ["p5-rk4_step"]),
        ("p5-rk4step", ["p5-rk4_step"]),
        ("p6-regressor", ["c6-regressor", "c8-regressor_r"]),
        ("p4", [id for id in CHECKS if id.startswith("p4-")]),
        ("p4-!", [id for id in CHECKS if id.startswith("p4-")]),
        ("", []),
        ("nothing like it", []),
    ],
)
def test_the_nearest_ids(asked, meant):
    assert nearest(asked) == meant


@pytest.mark.parametrize("function", [check, hint, look_at])
def test_an_answer_that_a_person_reads_is_said_to_be_one(function):
    said = "no check judges 'p3-derivation': a person reads it and gives its points"
    with pytest.raises(UnknownCheckError, match=said):
        function("p3-derivation")


@pytest.mark.parametrize("wrong", [None, 3, p3_M, ["p3-M"], check])
def test_what_is_no_text_is_said_to_be_none(wrong):
    # `hint()` serves the check that failed last.
    for function in (check, hint) if wrong is not None else (check,):
        with pytest.raises(UnknownCheckError, match="in quotes") as refused:
            function(wrong)
    assert ("'p3-M'" in str(refused.value)) == (wrong is p3_M)


def test_an_old_definition_is_said_to_be_one(kernel):
    (card,) = kernel[1]["old"]  # it is right: no error
    said = (
        "This is your old kinetic_energy: the cell that should define it again stopped with "
        "SyntaxError: invalid syntax, line 2."
    )
    assert said in " ".join(card.data["text/plain"].split())
    assert said in card.data["text/html"]
    assert "old" not in kernel[1]["fresh"][0].data["text/plain"]


def test_a_missing_function_is_blamed_on_the_cell_that_failed(kernel):
    card, error = kernel[1]["missing"]
    assert error.evalue == f"{START}: error in your code"
    said = (
        "The notebook does not define kinetic_energy: the cell that should define it stopped with "
        "SyntaxError: invalid syntax, line 2. Fix that line, "
    )
    assert said in " ".join(card.data["text/plain"].split())


def called(state: State, **how):
    """check() called from a module of its own, outside IPython."""
    namespace = {"__name__": "__main__", "check": check}
    exec(defined(state), namespace)
    exec(f"check({START!r}, **{how!r})", namespace)


def test_outside_ipython_the_verdict_is_printed(capsys):
    called(State.CORRECT)
    assert capsys.readouterr().out.startswith(f"{START}: correct\n")
    with pytest.raises(NotCorrectError, match="incorrect") as raised:
        called(State.INCORRECT)
    assert capsys.readouterr().out == f"{raised.value.verdict}\n"


def test_visible_cases_stay_and_fresh_ones_change():
    def worst(**how):
        with pytest.raises(NotCorrectError) as raised:
            called(State.INCORRECT, **how)
        return raised.value.verdict.witness

    assert worst() == worst()
    assert worst(fresh=True) != worst(fresh=True)


def test_a_busy_machine_changes_nothing_on_a_card(monkeypatch):
    wrong = {"g_vec": lambda q, pend: [pend.m * pend.g * pend.lc * np.cos(q[0])]}
    expected = verdict_on("p3-g_vec", wrong)
    ticks = itertools.count(step=3.0)
    monkeypatch.setattr(
        time, "monotonic", lambda: next(ticks)
    )  # hardly any of it is this program's
    assert verdict_on("p3-g_vec", wrong).witness.call == expected.witness.call


def test_an_answer_below_the_line_that_stops_it_is_told_apart_from_none():
    source = "def M(q, pend):\n    raise NotImplementedError\n    return np.array([[pend.I]])\n"
    name = "/tmp/ipykernel_1/stops_above.py"
    linecache.cache[name] = (len(source), None, source.splitlines(True), name)
    namespace = {"__name__": "__main__", "np": np}
    exec(compile(source, name, "exec"), namespace)
    verdict = verdict_on("p3-M", namespace)
    assert verdict.state is State.NOT_ATTEMPTED
    said = "stops at its line 2, raise NotImplementedError, and nothing below that line runs"
    assert said in str(verdict).replace("\n  ", " ")
