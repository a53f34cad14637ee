"""Derivations in grading: lines cross the wall as text, and are marked outside it."""

import copy
import json

import pytest
from nbformat.v4 import new_code_cell

from autograder.notebook.grade import grade
from autograder.notebook.scores import with_verdicts
from autograder.notebook.suggestion import KEY, suggest, suggestion_of
from autograder.proofs import DERIVATIONS
from autograder.proofs.derivation import Row
from autograder.proofs.marks import Marked, MarkedLine
from autograder.protocol import HandedIn, decode_handed_in, encode_handed_in
from autograder.protocol.proofs import MOST_CHARACTERS, MOST_LINES, MOST_PARTS
from tests.autograder.course_problems import problem
from tests.autograder.proofs.models import models
from tests.submissions.answers import answered, cell_of


def lines_in(name: str, **sources: str):
    """A blank p2 or p3 whose answers of these ids, with _ for -, are these sources."""
    given = {id.replace("_", "-"): source for id, source in sources.items()}
    return answered(problem(name).release, **given)


def function(name: str, lines) -> str:
    return f"def {name}():\n    return {lines!r}"


def with_models(name="p2-energy-skew"):
    return lines_in(
        name,
        p2_E=function("energy_lines", models()["p2-E"]),
        p2_skew=function("skew_lines", models()["p2-skew"]),
    )


def graded(notebook, name="p2-energy-skew", seed="seed"):
    return grade(notebook, problem(name).source, seed)


def suggested(notebook):
    return suggestion_of(cell_of(with_verdicts(graded(notebook)), "p2-proof"))


def test_marks_stand_below_the_lines_and_suggest_points():
    result = with_verdicts(graded(with_models()))
    shown = [cell_of(result, id).outputs[-1].data for id in ("p2-E", "p2-skew")]
    assert [data["text/plain"].splitlines()[0] for data in shown] == [
        "p2-E: complete",
        "p2-skew: complete",
    ]
    assert all("armdyn-derivation" in data["text/html"] for data in shown)
    found = suggestion_of(cell_of(result, "p2-proof"))
    assert found.points == 3
    assert found.comment == (
        "p2-E: all 8 lines hold. p2-skew: all 2 lines hold. The lines suggest 3 of 5 points: rows 1, 2 "
        "and 4 of the table."
    )


def test_wrong_lines_suggest_what_the_others_earn():
    wrong = [*models()["p2-E"][:5], ("= qd' u + qd' C qd", "equation of motion")]
    found = suggested(lines_in("p2-energy-skew", p2_E=function("energy_lines", wrong)))
    assert found.points == 1
    assert found.comment == (
        "p2-E: line 6 of 6 does not hold. The lines suggest 1 of 5 points: row 1 of the table."
    )


def test_right_lines_that_show_too_little_are_not_called_the_whole():
    one = function("skew_lines", [("= 0", "Christoffel symbols")])
    assert suggested(lines_in("p2-energy-skew", p2_skew=one)).comment == (
        "p2-skew: its line holds, and does not show the whole yet. The lines suggest 0 of 5 points."
    )


def test_without_lines_nothing_is_suggested():
    blank = graded(copy.deepcopy(problem("p2-energy-skew").release))
    assert [marked.lines for marked in blank.marks["p2-proof"]] == [(), ()]
    assert suggestion_of(cell_of(with_verdicts(blank), "p2-proof")) is None


def test_a_submission_cannot_suggest_points_itself():
    for name, cell in (("p3-pendulum", "p3-derivation"), ("c6-regressor", "c6-discussion")):
        notebook = copy.deepcopy(problem(name).release)
        cell_of(notebook, cell).metadata[KEY] = {"points": 5, "comment": "well done"}
        assert suggestion_of(cell_of(with_verdicts(graded(notebook, name)), cell)) is None


def test_points_are_never_more_than_the_cells():
    derivation = DERIVATIONS["p2-E"]
    cell = copy.deepcopy(cell_of(problem("p2-energy-skew").source, "p2-proof"))
    marks = [Marked(derivation, (MarkedLine("K", (), True, ""),), True, "", (Row(1, 9.0),))]
    suggest(cell, marks)
    assert suggestion_of(cell).points == cell.metadata["nbgrader"]["points"]


FORGED = {
    "another print": "import builtins\nbuiltins.print = lambda *a, **k: None",
    "another answer": (
        "import autograder\n"
        'autograder.print_lines = lambda id: print(\'{"lines": [["= qd u", "given"]], "problem": ""}\')'
    ),
    "no answer": "import autograder\nautograder.print_lines = lambda id: print('well done, 5 points')",
    "deep": "import autograder\nautograder.print_lines = lambda id: print('[' * 100_000)",
    "ending Python": "import os, autograder\nautograder.print_lines = lambda id: os._exit(0)",
    "raising": "import autograder\nautograder.print_lines = lambda id: 1 / 0",
    "marked already": (
        'import autograder\nautograder.print_lines = lambda id: print(\'{"done": true, "lines": []}\')'
    ),
}


@pytest.mark.parametrize("source", FORGED.values(), ids=FORGED)
def test_a_forged_reply_earns_nothing(source):
    notebook = copy.deepcopy(problem("p3-pendulum").release)
    notebook.cells.insert(2, new_code_cell(source))
    found = graded(notebook, "p3-pendulum").marks["p3-derivation"][0]
    assert found.earned == ()
    assert not found.done


def test_nothing_but_the_card_stands_below_a_derivation():
    """A card that the cell prints itself, by whatever name, would stand before the grader's."""
    notebook = copy.deepcopy(problem("p2-energy-skew").release)
    fake = "import autograder\nautograder.derivation = lambda *a: print('p2-E: complete')"
    notebook.cells.insert(2, new_code_cell(fake))
    printing = function("skew_lines", models()["p2-skew"]).replace(
        "    return", "    print('✓')\n    return"
    )
    cell_of(notebook, "answer-p2-skew").source = printing
    result = graded(notebook).notebook
    for id in ("p2-E", "p2-skew"):
        (shown,) = cell_of(result, id).outputs
        assert shown.data["text/plain"].startswith(f"{id}: not attempted\n")
        assert "Names" not in shown.data["text/plain"] + shown.data["text/html"]


def test_an_error_stands_before_the_card():
    notebook = copy.deepcopy(problem("p2-energy-skew").release)
    cell_of(notebook, "answer-p2-E").source = "energy = 1"
    error, shown = cell_of(graded(notebook).notebook, "p2-E").outputs
    assert error.evalue == "name 'energy_lines' is not defined"
    assert shown.data["text/plain"].startswith("p2-E: not attempted")


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("return 1 / 0", "ZeroDivisionError: division by zero"),
        ("return 3", "Give a list of lines"),
        ("return [('u = <b>bold</b>', '<i>')]", "Write one ="),
    ],
)
def test_what_is_wrong_with_the_lines_is_shown_and_escaped(body, said):
    notebook = lines_in("p3-pendulum", p3_L=f"def pendulum_lines():\n    {body}")
    data = cell_of(graded(notebook, "p3-pendulum").notebook, "p3-L").outputs[-1].data
    assert said in data["text/plain"]
    assert "<b>" not in data["text/html"]
    assert "<i>" not in data["text/html"]


def test_lines_survive_a_cell_that_ends_python():
    notebook = lines_in("p3-pendulum", p3_L=function("pendulum_lines", models()["p3-L"]))
    at = notebook.cells.index(cell_of(notebook, "p3-L"))
    notebook.cells.insert(at, new_code_cell("import os\nos._exit(1)"))
    assert graded(notebook, "p3-pendulum").marks["p3-derivation"][0].done


LINES = HandedIn((("Edot", "algebra"), ("= Kdot\ud800", "x")), "a problem")


def test_lines_cross_as_json():
    assert decode_handed_in(encode_handed_in(LINES)) == LINES


@pytest.mark.parametrize(
    "said",
    [
        "", "null", "[]", "{}", '{"lines": {}, "problem": ""}', '{"lines": [["K"]]}', "[" * 100_000,
        '{"lines": ["K"], "problem": ""}', '{"lines": [[]], "problem": ""}',
        '{"lines": [[3]], "problem": ""}', '{"lines": [["K"]], "problem": 3}', "NaN",
        json.dumps({"lines": [["K"]] * (MOST_LINES + 2), "problem": ""}),
        json.dumps({"lines": [["K"] * (MOST_PARTS + 1)], "problem": ""}),
        json.dumps({"lines": [["K" * 10**6]], "problem": ""}),
    ],
)  # fmt: skip
def test_what_is_no_such_json_is_refused(said):
    assert decode_handed_in(said) is None


def test_long_texts_are_cut():
    said = json.dumps({"lines": [["K" * 5000]], "problem": "p" * 5000})
    found = decode_handed_in(said)
    assert len(found.lines[0][0]) == MOST_CHARACTERS + 1
    assert len(found.problem) <= 300
