"""The page of all that is said of mistakes is what is said today."""

import re

import pytest

from autograder.mechanisms import MECHANISMS
from autograder.mutation.answers import ANSWERS
from tests.autograder.mutation import said

RENEW = "make it anew and review what changes: python -m tests.autograder.mutation.said said.txt"
# Few terms, and yet angles, a length, a coupling and a weight.
FEW = ("pendulum", "cart-pole")


@pytest.mark.parametrize("name", FEW)
def test_what_is_said_has_been_reviewed(name):
    reviewed = set(said.PAGE.read_text(encoding="utf-8").splitlines())
    mechanism = MECHANISMS[name]
    for answer in ANSWERS:
        for text in (*said.mistakes(mechanism, answer), *said.hints(mechanism, answer)):
            assert said.form(text, mechanism) in reviewed, f"{RENEW}\n{text}"


@pytest.mark.long
def test_the_page_is_what_is_said_today():
    assert said.PAGE.read_text(encoding="utf-8") == said.page(), RENEW


def test_every_sentence_on_the_page_is_whole():
    """Nothing was left out of it, and no code is in it."""
    for line in said.PAGE.read_text(encoding="utf-8").splitlines():
        said_there = line.strip().removeprefix("as: ")
        if not line.startswith("    of:"):
            assert not re.search(r"  |\(\)|\*\*|\{|\}|None| [,?]| \.(?!\.\.)", said_there), line
