"""Each answer of a mechanism leads to a section of a lesson, and a course's own file to another."""

from dataclasses import astuple, replace
from pathlib import Path

import pytest

from autograder.authoring.leads_on import led_on
from autograder.judging.section import Section
from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from autograder.mutation.checks import check_of
from autograder.mutation.sections import OF_ALL

ROOT = Path(__file__).parents[3]
CART = MECHANISMS["cart-pole"]


def test_the_section_of_each_answer_is_in_the_lesson():
    assert set(OF_ALL) == set(ANSWERS)
    sections = {answer: astuple(section) for answer, section in OF_ALL.items()}
    assert list(led_on(ROOT, replace(CART, sections=sections))) == []


def test_a_mechanism_of_ones_own_may_lead_elsewhere():
    own = ("my-carts", "my-cell", "Carts")
    cart = replace(CART, further={"M": "Push the cart slowly."}, sections={"M": own})
    assert check_of(cart, "M").section == Section(*own)
    assert check_of(cart, "M").further == "Push the cart slowly."
    assert check_of(cart, "C").section == OF_ALL["C"]
    assert check_of(cart, "C").further == check_of(CART, "C").further
    assert Section(*own).number == "my-carts"
    assert OF_ALL["C"].number == "02"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"further": {"M": ""}}, "further needs a dict of texts of one line"),
        ({"further": {"M": "one\ntwo"}}, "further needs a dict of texts of one line"),
        ({"further": "M is constant."}, "further needs a dict of texts of one line"),
        ({"sections": {"M": "03-inertia-matrix"}}, "sections needs a dict of (lesson, id of a"),
        ({"sections": {"M": ("03", "03-arm")}}, "sections needs a dict of (lesson, id of a cell"),
        ({"sections": [("M", "03")]}, "sections needs a dict of (lesson, id of a cell, heading)"),
        ({"sections": {"M": ("lessons/03.ipynb", "03-arm", "2")}}, "without folder and ending"),
    ],
)
def test_what_is_no_section_and_no_sentence_is_refused(given, said):
    with pytest.raises(ValueError, match=r"^mechanism 'cart-pole': ") as refused:
        replace(CART, **given)
    assert said in str(refused.value)
