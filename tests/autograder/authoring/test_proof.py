"""The proof of a mechanism's problem: the grader marks its lines, as it does in the course's own."""

import copy
from dataclasses import replace

import pytest

from autograder import check, derivation, hint, solution
from autograder.authoring import proof
from autograder.authoring.problem import notebook
from autograder.authoring.rehearsal import rehearsed
from autograder.mechanisms import MECHANISMS
from autograder.notebook.answers import model_answers
from autograder.notebook.grade import grade
from autograder.notebook.scores import with_verdicts
from autograder.notebook.suggestion import suggestion_of
from autograder.problems import UnknownCheckError
from autograder.student import hint_counts
from tests.autograder.proofs.models import marked
from tests.submissions.answers import answered, cell_of

CART = MECHANISMS["cart-pole"]
SOURCE = notebook(CART, ["C"])
WRONG = """
def skew_lines():
    return [("= (Mdot - 2 C) - (Mdot - 2 C)", "energy balance"), ("= 0", "algebra")]
"""


def test_lines_handed_in_suggest_points_and_the_grader_shows_the_marks():
    handed_in = answered(copy.deepcopy(SOURCE), **{"cart-pole-skew": WRONG})
    graded = with_verdicts(grade(handed_in, SOURCE, "seed"))
    cards = [cell_of(graded, f"cart-pole-{kind}").outputs[-1].data["text/plain"].splitlines()[0]
             for kind in ("E", "skew")]  # fmt: skip
    assert cards == ["cart-pole-E: complete", "cart-pole-skew: 1 of 2 lines hold"]
    found = suggestion_of(cell_of(graded, "cart-pole-proof"))
    assert found.points == 2
    assert found.comment == (
        "cart-pole-E: all 8 lines hold. cart-pole-skew: line 1 of 2 does not hold. "
        "The lines suggest 2 of 4 points: rows 1 and 2 of the table."
    )


@pytest.mark.parametrize("friction", [False, True])
def test_the_worked_lines_can_be_opened(friction):
    source = notebook(MECHANISMS["planar-2r"], ["C", "f"] if friction else ["C"])
    answers = model_answers(source)
    for lines in proof.lines_of("planar-2r", friction):
        namespace = {}
        exec(answers[lines.id], namespace)
        assert marked(lines.id, namespace[lines.function]).done
        assert "SOLUTION" not in answers[lines.id]


def test_try_says_of_lines_that_are_not_complete(monkeypatch):
    assert all(line.good for line in rehearsed(CART, {}, ["C"]))
    right = proof.lines_of

    def shorter(name, friction):
        return tuple(replace(lines, model=lines.model[:-1]) for lines in right(name, friction))

    monkeypatch.setattr(proof, "lines_of", shorter)
    _, first, *_ = rehearsed(CART, {}, ["C"])
    assert not first.good
    assert "cart-pole-E: 7 of 7 lines hold" in first.text
    assert "cart-pole-C" not in first.text


def test_all_calls_of_a_student_know_them(capsys, monkeypatch, tmp_path):
    folder = tmp_path / "cart-pole"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setattr(hint_counts, "_here", {})
    derivation("cart-pole-E", proof.lines_of("cart-pole", friction=False)[0].model)
    assert capsys.readouterr().out.startswith("cart-pole-E: complete\n")
    hint("cart-pole-skew")
    assert 'Hint 1 of 3. For the next one, run hint("cart-pole-skew")' in capsys.readouterr().out
    solution("cart-pole-E-friction")
    assert "There is no worked answer for cart-pole-E-friction yet." in capsys.readouterr().out
    with pytest.raises(UnknownCheckError, match="no check judges 'cart-pole-E': call derivation"):
        check("cart-pole-E")
    with pytest.raises(UnknownCheckError, match="'cart-pole-e'; did you mean 'cart-pole-E'"):
        derivation("cart-pole-e")
    with pytest.raises(UnknownCheckError, match="'cart-pole'; did you mean 'cart-pole-E'"):
        derivation("cart-pole")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(UnknownCheckError, match="'cart-pole'; they are p1-symmetry"):
        derivation("cart-pole")
